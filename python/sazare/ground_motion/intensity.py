"""Figures of a record: peaks, Arias intensity and the durations from it, cumulative velocity, spectrum intensities, periods.

Sources stand in docs/guide/ground-motions.md.
"""

import numpy as np

from sazare.ground_motion.record import GRAVITY
from sazare.ground_motion.spectra import fourier_amplitude, response_spectrum

INTENSITY_PERIODS = np.linspace(0.1, 2.5, 241)  # s, of both spectrum intensities
MEAN_PERIOD_BAND = 0.25, 20.0  # Hz
MEAN_PERIOD_RESOLUTION = 0.05  # Hz
PREDOMINANT_PERIODS = np.geomspace(0.02, 10.0, 181)  # s


def peak_acceleration(record):
    """PGA, the largest magnitude [m/s2]."""
    return float(np.abs(record.acceleration).max())


def peak_velocity(record):
    """PGV, the largest magnitude [m/s], which is where the acceleration passes 0."""
    before, after = record.acceleration[:-1], record.acceleration[1:]
    turns = before * after < 0.0
    time = record.step * before[turns] / (before[turns] - after[turns])
    between = record.velocity[:-1][turns] + 0.5 * before[turns] * time
    return float(max(np.abs(record.velocity).max(), np.abs(between).max(initial=0.0)))


def peak_displacement(record):
    """PGD, the largest magnitude at the samples [m]."""
    return float(np.abs(record.displacement).max())


def _squares(record):
    """Integral of a^2 over time up to each sample (n,) [m2/s3], exact for straight lines."""
    a = record.acceleration
    return np.concatenate([[0.0], np.cumsum(record.step / 3.0 * (a[1:] ** 2 + a[1:] * a[:-1] + a[:-1] ** 2))])


def arias_intensity(record):
    """pi/(2 g) times the integral of a^2 [m/s] [Arias1970]."""
    return float(np.pi / (2.0 * GRAVITY) * _squares(record)[-1])


def husid(record):
    """The share [-] of the Arias intensity that has come by each sample (n,) [Husid1969]; 0 for a record without motion."""
    squares = _squares(record)
    return squares / squares[-1] if squares[-1] > 0.0 else squares


def significant_duration(record, begin=0.05, end=0.95):
    """Time [s] in which the share of the Arias intensity grows from `begin` to `end` [Trifunac1975]; 0 for a record without motion.

    Raises ValueError where 0 <= begin < end <= 1 does not hold.
    """
    if not 0.0 <= begin < end <= 1.0:
        raise ValueError(f"shares of the Arias intensity rise from 0 to 1, found {begin:g} and {end:g}")
    share = husid(record)
    first, last = np.interp([begin, end], share, record.time) if share[-1] > 0.0 else (0.0, 0.0)
    return float(last - first)


def cumulative_absolute_velocity(record):
    """CAV, the integral of |a| over time [m/s] [EPRI1988], exact for straight lines."""
    before, after = record.acceleration[:-1], record.acceleration[1:]
    size = np.abs(before) + np.abs(after)
    crosses = before * after < 0.0
    means = np.where(crosses, (before**2 + after**2) / np.where(crosses, size, 1.0), size)
    return float(0.5 * record.step * means.sum())


def spectrum_intensity(record, damping=0.05):
    """Housner's spectrum intensity [m]: the integral of the pseudo velocity spectrum from 0.1 to 2.5 s [Housner1952]."""
    spectrum = response_spectrum(record, INTENSITY_PERIODS, damping)
    return float(np.trapezoid(spectrum.pseudo_velocity, spectrum.period))


def si_value(record):
    """The SI value of Japanese practice [m/s]: mean of the relative velocity spectrum with 20 % damping from 0.1 to 2.5 s [Katayama1988]."""
    spectrum = response_spectrum(record, INTENSITY_PERIODS, 0.2)
    return float(np.trapezoid(spectrum.velocity, spectrum.period) / np.ptp(spectrum.period))


def mean_period(record):
    """Tm [s]: mean of the periods of the Fourier spectrum from 0.25 to 20 Hz, weighted by the squares of its amplitudes [Rathje2004].

    NaN for a record without motion in that band.
    """
    frequency, amplitude = fourier_amplitude(record, MEAN_PERIOD_RESOLUTION)
    chosen = (frequency >= MEAN_PERIOD_BAND[0]) & (frequency <= MEAN_PERIOD_BAND[1])
    weight = amplitude[chosen] ** 2
    return float((weight / frequency[chosen]).sum() / weight.sum()) if weight.sum() > 0.0 else float("nan")


def predominant_period(record, damping=0.05):
    """Period [s], of 181 from 0.02 to 10 s that do not exceed the duration, at which the pseudo acceleration spectrum is largest."""
    periods = PREDOMINANT_PERIODS[PREDOMINANT_PERIODS <= max(record.duration, PREDOMINANT_PERIODS[0])]
    return float(periods[np.argmax(response_spectrum(record, periods, damping).pseudo_acceleration)])


FIGURES = {
    "peak_acceleration": ("m/s2", peak_acceleration),
    "peak_velocity": ("m/s", peak_velocity),
    "peak_displacement": ("m", peak_displacement),
    "arias_intensity": ("m/s", arias_intensity),
    "significant_duration_5_75": ("s", lambda record: significant_duration(record, 0.05, 0.75)),
    "significant_duration_5_95": ("s", significant_duration),
    "cumulative_absolute_velocity": ("m/s", cumulative_absolute_velocity),
    "spectrum_intensity": ("m", spectrum_intensity),
    "si_value": ("m/s", si_value),
    "mean_period": ("s", mean_period),
    "predominant_period": ("s", predominant_period),
}


def figures(record):
    """All figures of a record by name (dict of float), in SI units, which FIGURES names."""
    return {name: function(record) for name, (_, function) in FIGURES.items()}
