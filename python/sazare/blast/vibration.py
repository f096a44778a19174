"""Vibration at the gauges of a blast: peaks, dominating frequencies, distances and scaled distances."""

from dataclasses import dataclass

import numpy as np

from sazare.blast.fits import LEAST_SPAN, power_law

STILL_RISING = 0.95  # of the peak at the end of the run
QUIET = 0.01  # of the peak: what is less counts as rest
FEWEST_SAMPLES = 8  # of a half cycle, for its frequency to be told


@dataclass(frozen=True)
class Shaking:
    """What a gauge has felt.

    ppv: largest magnitude of the velocity [m/s], at `time` [s]. peaks: largest magnitude of each component [m/s] (3,). frequency: of the half cycle with
    the peak of the strongest component [Hz]; None where that is not over by the end, or where too few rows show it. rises: whether the gauge moves as
    fast as its peak at the end, so that a longer run would have a higher one. distance: from the axis of the nearest hole [m]. charge: mass that
    is fired with the hole which is nearest for its charge [kg], and charge_distance, how far that is [m]; None without masses or holes.
    """

    name: str
    ppv: float
    time: float
    peaks: np.ndarray
    frequency: float | None
    rises: bool
    distance: float | None = None
    charge: float | None = None
    charge_distance: float | None = None

    @property
    def axis(self):
        """Number of the strongest component."""
        return int(np.argmax(self.peaks))

    def scaled_distance(self, power):
        """Distance over a power of the charge, R / W^(1/2) or R / W^(1/3) [m / kg^power]; None without a mass."""
        return None if self.charge is None else self.charge_distance / self.charge**power


def half_cycle_frequency(time, velocity):
    """Frequency [Hz] of the half cycle that holds the peak of a velocity (n,) at times [s] (n,); None where it is not whole or has too few samples.

    Half the reciprocal of the time between the zero crossings beside the peak, as blasting seismographs tell it; a crossing is also where the motion
    begins or ends, below a hundredth of the peak.
    """
    if len(time) < 2 or not np.any(velocity):
        return None
    peak = int(np.argmax(np.abs(velocity)))
    value = velocity * np.sign(velocity[peak])
    low = QUIET * value[peak]
    before, after = np.flatnonzero(value[:peak] <= low), np.flatnonzero(value[peak:] <= low)
    if not len(before) or not len(after):
        return None
    first, last = int(before[-1]), peak + int(after[0])
    if last - first < FEWEST_SAMPLES:
        return None
    return float(0.5 / (_crossing(time, value, last - 1, last) - _crossing(time, value, first, first + 1)))


def _crossing(time, value, one, other):
    """Where a value that is above 0 at one of two neighbouring samples is 0; the other sample where it does not get there."""
    low, high = (one, other) if value[one] <= value[other] else (other, one)
    if value[low] >= 0.0:
        return time[low]
    return time[low] + (time[high] - time[low]) * value[low] / (value[low] - value[high])


def shaking_of(results, holes=()):
    """The Shaking of every gauge of a run (list), in the order of the case. holes: list of Hole. Of a run that is not over, and has not written its peaks,
    they are those of its rows, without distances."""
    table = results.gauge_peaks
    found = []
    for number, gauge in enumerate(results.gauges.values()):
        if not len(gauge.time):
            continue
        if table.rows:
            peaks = np.array([table[f"peak_{axis}"][number] for axis in "xyz"])
            ppv, time = float(table["ppv"][number]), float(table["time"][number])
            point = np.array([table[f"point_{axis}"][number] for axis in "xyz"])
        else:
            peaks, ppv = np.abs(gauge.velocity).max(axis=0), gauge.ppv
            time, point = float(gauge.time[np.argmax(gauge.speed)]), None
        strongest = gauge.velocity[:, int(np.argmax(peaks))]
        found.append(
            Shaking(
                gauge.name, ppv, time, peaks, half_cycle_frequency(gauge.time, strongest), bool(ppv > 0.0 and gauge.speed[-1] >= STILL_RISING * ppv),
                *(_places(holes, point) if holes and point is not None else ()),
            )
        )
    return found


def _places(holes, point):
    """Distance from the nearest hole [m]; charge [kg] and distance [m] of the delay with the largest charge for its distance, None without masses."""
    distances = np.array([hole.distance(point[None])[0] for hole in holes])
    if holes[0].charge is None:
        return float(distances.min()), None, None
    delays = np.array([hole.delay for hole in holes])
    charges = np.array([hole.charge for hole in holes])
    fired = [(float(charges[delays == delay].sum()), float(distances[delays == delay].min())) for delay in np.unique(delays)]
    charge, distance = min(fired, key=lambda one: one[1] / np.sqrt(one[0]))
    return float(distances.min()), charge, distance


def attenuation(shaken, distances):
    """The PowerLaw of the peak particle velocity [m/s] over distances (n,) of Shakings, some of them None; None where it cannot be fitted, or where the peaks
    do not decrease with the distance, so that gauges differ in more than it, or where the farthest gauge is less than twice as far as the nearest.

    Gauges whose peak still rises are left out, and those that have not moved.
    """
    chosen = [(distance, one.ppv) for one, distance in zip(shaken, distances) if distance and one.ppv > 0.0 and not one.rises]
    far = [distance for distance, _ in chosen]
    law = power_law(*zip(*chosen)) if len(chosen) >= 3 and max(far) >= LEAST_SPAN * min(far) else None
    return law if law is not None and law.exponent < 0.0 else None
