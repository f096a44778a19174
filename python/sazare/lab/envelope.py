"""The strength of a rock under several confinements: straight and curved envelopes of the peaks."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class MohrCoulomb:
    """A straight envelope: shear strength = cohesion [Pa] + tan(friction_angle [deg]) x normal stress."""

    cohesion: float
    friction_angle: float

    def strength(self, confinement):
        """Axial stress at failure [Pa] under a confinement [Pa]."""
        slope = np.tan(np.radians(45.0 + 0.5 * self.friction_angle))
        return 2.0 * self.cohesion * slope + np.asarray(confinement) * slope**2


@dataclass(frozen=True)
class HoekBrown:
    """The envelope of intact rock by Hoek and Brown (1980): s1 = s3 + strength (m s3/strength + 1)^0.5, strength in uniaxial compression [Pa]."""

    uniaxial_strength: float
    m: float

    def strength(self, confinement):
        """Axial stress at failure [Pa] under a confinement [Pa]."""
        confinement = np.asarray(confinement)
        return confinement + self.uniaxial_strength * np.sqrt(np.maximum(0.0, self.m * confinement / self.uniaxial_strength + 1.0))


def mohr_coulomb(confinements, strengths):
    """The straight line through peaks over confinements [Pa], by least squares. Raises ValueError with fewer than two confinements, or
    where the strength does not grow with them by more than the confinement itself."""
    _need(confinements, 2)
    slope, intercept = np.polyfit(confinements, strengths, 1)
    if slope <= 1.0:
        raise ValueError("the peaks grow less than the confinement, so there is no angle of friction")
    root = np.sqrt(slope)
    return MohrCoulomb(float(intercept / (2.0 * root)), float(2.0 * np.degrees(np.arctan(root)) - 90.0))


def hoek_brown(confinements, strengths):
    """Hoek and Brown's envelope of peaks over confinements [Pa]: (s1 - s3)^2 is a straight line over s3, by least squares. Raises ValueError
    with fewer than three confinements, or where that line has no positive slope and intercept."""
    _need(confinements, 3)
    confinements, strengths = np.asarray(confinements), np.asarray(strengths)
    slope, intercept = np.polyfit(confinements, (strengths - confinements) ** 2, 1)
    if slope <= 0.0 or intercept <= 0.0:
        raise ValueError("the peaks do not follow a Hoek-Brown envelope")
    strength = np.sqrt(intercept)
    return HoekBrown(float(strength), float(slope / strength))


def coulomb(normal_stresses, shear_stresses):
    """The straight line through shear strengths over normal stresses [Pa], by least squares. Raises ValueError with fewer than two."""
    _need(normal_stresses, 2)
    slope, intercept = np.polyfit(normal_stresses, shear_stresses, 1)
    return MohrCoulomb(float(intercept), float(np.degrees(np.arctan(slope))))


def _need(values, count):
    if len(set(values)) < count:
        raise ValueError(f"an envelope needs {count} different pressures or more, found {len(set(values))}")
