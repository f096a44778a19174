"""Response spectra, exact for a record that is linear between its samples, and the Fourier spectrum."""

import math
import warnings
from dataclasses import dataclass

import numpy as np
from scipy.linalg import expm

POINTS = 40  # times within a period at which the response is looked at: a peak is missed by 0.3 % at most
FEWEST = 4  # times within a step at which it is looked at, since the ground bends the velocity there, however slow the oscillator
STATES = 4_000_000  # samples times oscillators that are held at once
MOST = 2000  # times within a step at which it is looked at; oscillators that need more are rigid
SHORTEST = 1e-4  # period [steps]


@dataclass(frozen=True, eq=False)
class ResponseSpectrum:
    """Largest responses of linear oscillators, at rest at first, within the duration of a record; all arrays are (n,).

    period: natural periods [s]; damping: damping ratio [-]; displacement [m] and velocity [m/s]: relative to the ground;
    absolute_acceleration [m/s2].
    """

    period: np.ndarray
    damping: float
    displacement: np.ndarray
    velocity: np.ndarray
    absolute_acceleration: np.ndarray

    @property
    def pseudo_velocity(self):
        """2 pi/T times the displacement [m/s]."""
        return 2.0 * np.pi / self.period * self.displacement

    @property
    def pseudo_acceleration(self):
        """(2 pi/T)^2 times the displacement [m/s2]."""
        return (2.0 * np.pi / self.period) ** 2 * self.displacement


def usual_periods(shortest=0.02, longest=10.0, per_decade=50):
    """Periods [s] in equal steps of their logarithm, with both ends."""
    if not 0.0 < shortest < longest < math.inf:
        raise ValueError(f"periods go from a shortest one above 0 s to a longer one, found {shortest:g} and {longest:g} s")
    return np.geomspace(shortest, longest, 1 + math.ceil(per_decade * math.log10(longest / shortest)))


def response_spectrum(record, periods=None, damping=0.05):
    """The ResponseSpectrum of a record (`Record`) at natural periods [s], `usual_periods()` where none are given.

    The response is exact for straight lines between the samples [Nigam1969], and looked at POINTS times in a period and FEWEST times in a step.
    After its last sample a record is not followed. A record that is shorter than the longest period is warned of (UserWarning).

    Raises ValueError for a damping ratio below 0, or a period that is not above 0 or below 1e-4 of the step.
    """
    periods = np.atleast_1d(usual_periods() if periods is None else np.asarray(periods, dtype=float))
    _check(periods, damping)
    if periods.min(initial=np.inf) < SHORTEST * record.step:
        raise ValueError(f"periods below {SHORTEST:g} of the step, {SHORTEST * record.step:.4g} s, are those of rigid oscillators, found {periods.min():g} s")
    if periods.max(initial=0.0) > record.duration:
        warnings.warn(
            f"{record.name} lasts {record.duration:.4g} s, less than the longest period of {periods.max():.4g} s: its spectrum is too low there",
            stacklevel=2,
        )
    parts = math.ceil(len(periods) * len(record.acceleration) / STATES) or 1
    peaks = [_peaks(record, part, damping) for part in np.array_split(periods, min(parts, len(periods) or 1))]
    displacement, velocity, acceleration = np.concatenate(peaks, axis=1)
    return ResponseSpectrum(periods, float(damping), displacement, velocity, acceleration)


def _check(periods, damping):
    if not (np.ndim(damping) == 0 and math.isfinite(damping) and damping >= 0.0):
        raise ValueError(f"a damping ratio is a finite number of 0 or more, found {damping}")
    if periods.ndim != 1 or not (np.isfinite(periods).all() and np.all(periods > 0.0)):
        raise ValueError("periods are finite numbers above 0 s, in one row")


def _propagators(frequency, damping, time):
    """What takes (w u, v, ag, w^-1 dag/dt) of an oscillator over a time: (n, 2, 4) for angular frequencies w (n,) [rad/s] and times (n,) [s].

    u'' + 2 h w u' + w^2 u = -ag, with a ground acceleration ag of constant slope. In these variables all of the generator is of size w.
    """
    generator = np.zeros((len(frequency), 4, 4))
    generator[:, 0, 1] = 1.0
    generator[:, 1, 0] = -1.0
    generator[:, 1, 1] = -2.0 * damping
    generator[:, 1, 2] = -1.0 / frequency
    generator[:, 2, 3] = 1.0
    return expm(generator * (frequency * time)[:, None, None])[:, :2]


def _states(record, frequency, damping):
    """(w u, v) of each oscillator at the samples of a record (samples, n, 2) [m/s]."""
    step = _propagators(frequency, damping, np.full(len(frequency), record.step))
    a = record.acceleration
    slope = np.diff(a) / record.step
    pushes = a[:-1, None, None] * step[:, :, 2] + slope[:, None, None] * (step[:, :, 3] / frequency[:, None])
    states = np.zeros((len(a), len(frequency), 2))
    turn = step[:, :, :2]
    for number, push in enumerate(pushes):
        states[number + 1] = np.einsum("nij,nj->ni", turn, states[number]) + push
    return states


def _peaks(record, periods, damping):
    """Largest relative displacement [m], relative velocity [m/s] and absolute acceleration [m/s2] of each period: (3, n)."""
    frequency = 2.0 * np.pi / periods
    states = _states(record, frequency, damping)
    found = np.zeros((3, len(periods)))
    ground = np.stack([record.acceleration[:-1], np.diff(record.acceleration) / record.step], axis=1)
    for number, w in enumerate(frequency):
        between = min(MOST, max(FEWEST, math.ceil(POINTS * record.step / periods[number])))
        times = record.step * np.arange(1, between) / between
        steps = _propagators(np.full(len(times), w), damping, times)
        steps[:, :, 3] /= w
        begins = np.concatenate([states[:-1, number], ground], axis=1)
        parts = np.array_split(begins, math.ceil(len(begins) * between / STATES))
        for own in (states[:, number], *(np.einsum("nj,tij->tni", part, steps).reshape(-1, 2) for part in parts)):
            total = own[:, 0] + 2.0 * damping * own[:, 1]
            found[:, number] = np.maximum(found[:, number], [np.abs(own[:, 0]).max() / w, np.abs(own[:, 1]).max(), w * np.abs(total).max()])
    return found


def fourier_amplitude(record, resolution=None):
    """Frequencies [Hz] above 0 and the amplitude of the Fourier transform of the acceleration [m/s] (the sum over the samples times the step).

    resolution: the largest difference of two frequencies [Hz], for which zeros are added behind the record.
    """
    count = len(record.acceleration)
    if resolution is not None:
        count = max(count, math.ceil(1.0 / (resolution * record.step)))
    frequency = np.fft.rfftfreq(count, record.step)
    return frequency[1:], record.step * np.abs(np.fft.rfft(record.acceleration, count))[1:]
