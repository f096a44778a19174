"""Limits of vibration of two guidelines over frequency."""

from dataclasses import dataclass

import numpy as np

INCH = 0.0254  # m


@dataclass(frozen=True)
class Limit:
    """A limit on the largest component of the peak particle velocity.

    frequencies [Hz], velocities [m/s]: corners of the limit, between which it is straight, on axes of logarithms or not; above the last one its
    value stands.
    """

    name: str
    words: str
    frequencies: tuple[float, ...]
    velocities: tuple[float, ...]
    logarithmic: bool

    def at(self, frequency):
        """The limit [m/s] at frequencies [Hz] (n,), nan below the first one of the guideline."""
        frequency = np.asarray(frequency, dtype=float)
        known = np.where(frequency >= self.frequencies[0], frequency, np.nan)
        if self.logarithmic:
            return np.exp(np.interp(np.log(known), np.log(self.frequencies), np.log(self.velocities)))
        return np.interp(known, self.frequencies, self.velocities)


def _din(line, words, velocities):
    """DIN 4150-3 (1999 and 2016), table 1: guideline values for short-term vibration at the foundation, straight over frequency; above 100 Hz at least
    the value of 100 Hz may be taken."""
    return Limit(f"DIN 4150-3, line {line}", words, (1.0, 10.0, 50.0, 100.0), tuple(1e-3 * one for one in velocities), False)


def _usbm(words, plateau):
    """Siskind, Stagg, Kopp and Dowding (1980), USBM RI 8507, appendix B: velocities of 2 pi f d with the displacements d of 0.030 in below the
    plateau [in/s] and of 0.008 in above it, up to 2.0 in/s from 40 Hz on."""
    low, high, most = 0.030, 0.008, 2.0
    rise, leave, end = plateau / (2 * np.pi * low), plateau / (2 * np.pi * high), most / (2 * np.pi * high)
    velocities = (2 * np.pi * low * 1.0, plateau, plateau, most, most)
    return Limit("USBM RI 8507", words, (1.0, rise, leave, end, 100.0), tuple(INCH * one for one in velocities), True)


LIMITS = (
    _din(1, "commercial and industrial buildings", (20.0, 20.0, 40.0, 50.0)),
    _din(2, "dwellings", (5.0, 5.0, 15.0, 20.0)),
    _din(3, "buildings that are sensitive to vibration", (3.0, 3.0, 8.0, 10.0)),
    _usbm("houses with drywall", 0.75),
    _usbm("houses with plaster", 0.50),
)
