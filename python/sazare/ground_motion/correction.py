"""Preparation of a record: baseline, filters, other steps, and scaling. Each function returns a new Record."""

import numpy as np

from sazare.ground_motion.intensity import peak_acceleration, peak_velocity
from sazare.ground_motion.record import Record
from sazare.ground_motion.spectra import response_spectrum

MOST_DEGREE = 5  # of a baseline
PAD = 1.5  # zeros before and behind a record in a filter of both directions [periods of its lowest corner times its order]
SLOWEST = 0.1  # lowest corner of a filter [1/duration]
MOST_SAMPLES = 50_000_000  # of a record
PASSED = 0.4  # of the new sampling frequency that passes when a record gets longer steps


def take_off_baseline(record, degree=1):
    """Takes a polynomial of time off the acceleration: the one for which the velocity, 0 at the beginning, has no trend left by least squares.

    degree: of the polynomial of the acceleration, 0 to 5; 0 and 1 are `baseline = "constant"` and `"linear"` of a case.

    Raises ValueError for another degree, or a record with fewer samples than the polynomial has numbers.
    """
    if not 0 <= degree <= MOST_DEGREE:
        raise ValueError(f"the degree of a baseline is 0 to {MOST_DEGREE}, found {degree}")
    count = len(record.acceleration)
    if count < degree + 3:
        raise ValueError(f"{record.name} has {count} samples, too few for a baseline of degree {degree}")
    time = np.arange(count) / count
    powers = np.arange(1, degree + 2)
    trend, *_ = np.linalg.lstsq(time[:, None] ** powers, record.velocity, rcond=None)
    return record.with_acceleration(record.acceleration - (time[:, None] ** (powers - 1)) @ (powers * trend) / (record.step * count))


def end_at_rest(record):
    """Adds the straight line to the acceleration with which velocity and displacement end at 0.

    Of all corrections that do so it is the one with the smallest integral of its square.
    """
    length, velocity, displacement = record.duration, record.velocity[-1], record.displacement[-1]
    first, slope = np.linalg.solve([[length, length**2 / 2.0], [length**2 / 2.0, length**3 / 6.0]], [velocity, displacement])
    return record.with_acceleration(record.acceleration - first - slope * record.time)


def butterworth(record, low=None, high=None, order=4, causal=False):
    """A Butterworth filter that passes frequencies from `low` to `high` [Hz]; without one of them it is a low-pass or high-pass filter.

    The filter runs forwards and backwards, so that it moves no phase, reduces the amplitude at a corner to 1/2 and has twice the `order`; with
    `causal` it runs forwards alone, with 1/sqrt(2) at a corner. Zeros stand before and behind the record while it is filtered.

    Raises ValueError for corners that are not above 0, not below half of the sampling frequency, so low that a record is shorter than a tenth of a period,
    or not in order, and an order that is none.
    """
    from scipy import signal  # takes a second to load

    nyquist = 0.5 / record.step
    corners = [corner for corner in (low, high) if corner is not None]
    if not corners:
        raise ValueError("a filter needs a lower or an upper corner frequency")
    for corner in corners:
        if not 0.0 < corner < nyquist:
            raise ValueError(f"a corner frequency lies above 0 and below half of the sampling frequency, {nyquist:.4g} Hz, found {corner:g} Hz")
        if corner * record.duration < SLOWEST:
            raise ValueError(f"{record.name} lasts {record.duration:.4g} s, too short for a corner at {corner:g} Hz")
    if len(corners) == 2 and low >= high:
        raise ValueError(f"the lower corner must be below the upper one, found {low:g} and {high:g} Hz")
    if not 1 <= order <= 10:
        raise ValueError(f"the order of a filter is 1 to 10, found {order}")
    kind = "bandpass" if len(corners) == 2 else "highpass" if high is None else "lowpass"
    sections = signal.butter(order, corners if len(corners) == 2 else corners[0], kind, fs=1.0 / record.step, output="sos")
    if causal:
        return record.with_acceleration(signal.sosfilt(sections, record.acceleration))
    pad = int(np.ceil(PAD * order / min(corners) / record.step))
    padded = np.pad(record.acceleration, pad)
    return record.with_acceleration(signal.sosfiltfilt(sections, padded, padlen=0)[pad : pad + len(record.acceleration)])


def resample(record, step):
    """The record with other steps [s]. Shorter ones lie on the straight lines between the samples, so that the motion is the same.

    For longer ones frequencies above 0.4/step are filtered out first. Raises ValueError for a step that is not above 0 or longer than a quarter of
    the record.
    """
    if not 0.0 < step <= 0.25 * record.duration:
        raise ValueError(f"a step lies above 0 and up to a quarter of the record, {0.25 * record.duration:.4g} s, found {step:g} s")
    if record.duration / step > MOST_SAMPLES:
        raise ValueError(f"a step of {step:g} s gives more than {MOST_SAMPLES} samples")
    smooth = butterworth(record, high=PASSED / step, order=8) if step > record.step * (1.0 + 1e-9) else record
    time = step * np.arange(int(np.floor(record.duration / step * (1.0 + 1e-12))) + 1)
    return Record(step, np.interp(time, record.time, smooth.acceleration), record.name)


def scale_to_peak(record, acceleration=None, velocity=None):
    """The record times the factor that gives it a peak acceleration [m/s2] or a peak velocity [m/s].

    Raises ValueError unless one of both is given and above 0, or where the record has no motion.
    """
    if (acceleration is None) == (velocity is None):
        raise ValueError("scaling takes one of both: a peak acceleration or a peak velocity")
    wanted, own = (acceleration, peak_acceleration(record)) if velocity is None else (velocity, peak_velocity(record))
    if not (np.isfinite(wanted) and wanted > 0.0):
        raise ValueError(f"a peak is a finite number above 0, found {wanted}")
    if own == 0.0:
        raise ValueError(f"{record.name} has no motion, so it cannot be scaled")
    return record.scaled(wanted / own)


def factor_for_spectrum(record, period, target, damping=0.05, shortest=None, longest=None):
    """The factor [-] with which the pseudo acceleration spectrum of a record comes nearest to a target, and how far it is off.

    period [s], target [m/s2]: (n,), the target spectrum, which is straight in logarithms between its points; shortest, longest: the range of periods
    that counts [s], that of the target where none is given. The factor makes the squares of the differences of logarithms over equal
    steps of log(T) smallest. Second comes the root mean square of the remaining differences of natural logarithms [-].

    Raises ValueError for a target that is no spectrum, or a range outside it.
    """
    period, target = np.asarray(period, dtype=float), np.asarray(target, dtype=float)
    if len(period) < 2 or len(period) != len(target) or not (np.all(period > 0.0) and np.all(np.diff(period) > 0.0) and np.all(target > 0.0)):
        raise ValueError("a target spectrum has at least 2 points, with periods that rise and accelerations above 0")
    shortest, longest = shortest or period[0], longest or period[-1]
    if not period[0] <= shortest < longest <= period[-1]:
        raise ValueError(f"the target spectrum goes from {period[0]:g} to {period[-1]:g} s, which must hold the range {shortest:g} to {longest:g} s")
    chosen = np.geomspace(shortest, longest, 101)
    chosen[[0, -1]] = shortest, longest
    own = response_spectrum(record, chosen, damping).pseudo_acceleration
    if not np.all(own > 0.0):
        raise ValueError(f"{record.name} has no motion, so it cannot be scaled")
    off = np.interp(np.log(chosen), np.log(period), np.log(target)) - np.log(own)
    return float(np.exp(off.mean())), float(off.std())
