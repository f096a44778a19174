"""Soil with a hyperbolic backbone on an elastic half-space under shear waves from below, by central differences in one dimension.

It shares no line with the engine, neither the element, the step, the law in space nor the corners of the backbone.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Ground:
    """height [m], density [kg/m3], modulus [Pa] and reference strain [-] of the soil, density [kg/m3] and S-wave velocity [m/s] of the rock below."""

    height: float
    density: float
    modulus: float
    reference: float
    rock_density: float
    rock_velocity: float


@dataclass(frozen=True, eq=False)
class Motion:
    """time [s] (n,); displacement [m] of the surface over the foot of the soil and velocity [m/s] of the surface (n,); peak strains from the foot
    up [-] (cells,); dissipated energy [J/m2]."""

    time: np.ndarray
    behind: np.ndarray
    velocity: np.ndarray
    peak: np.ndarray
    dissipated: float


class Parts:
    """Springs in parallel that slide: tangents of the hyperbola, far more than the engine takes. Iwan, J. Appl. Mech. 34 (1967) 612-617."""

    def __init__(self, ground, cells, count=240):
        modulus, reference = ground.modulus, ground.reference
        at = np.geomspace(2e-3, 100.0, count) * reference
        slope = np.r_[modulus, modulus / (1.0 + at / reference) ** 2, 0.0]
        stress = modulus * at / (1.0 + at / reference)
        zero = np.r_[0.0, stress - slope[1:-1] * at, modulus * reference]
        self.modulus = -np.diff(slope)[:, None]
        self.most = np.diff(zero)[:, None]
        self.stress = np.zeros((count + 1, cells))

    def shear(self, change):
        """Total stress [Pa] (cells,) after a change of strain (cells,)."""
        self.stress += self.modulus * change
        np.clip(self.stress, -self.most, self.most, out=self.stress)
        return self.stress.sum(axis=0)


def differences(ground, incoming, cells, step, end):
    """The Motion. incoming: velocity [m/s] of the wave that goes up at the foot of the soil, a function of the time [s]."""
    parts, width = Parts(ground, cells), ground.height / cells
    mass = np.full(cells + 1, ground.density * width)
    mass[[0, -1]] *= 0.5
    moved, velocity = np.zeros(cells + 1), np.zeros(cells + 1)
    stress, peak, work = np.zeros(cells), np.zeros(cells), 0.0
    impedance = ground.rock_density * ground.rock_velocity
    count = round(end / step)
    coming = 2.0 * impedance * incoming(step * np.arange(count))
    behind, surface = np.zeros(count + 1), np.zeros(count + 1)
    for number in range(count):
        force = np.zeros(cells + 1)
        force[:-1] += stress
        force[1:] -= stress
        foot = velocity[0]
        velocity += step / mass * force
        velocity[0] = (mass[0] / step * foot + force[0] + coming[number] - 0.5 * impedance * foot) / (mass[0] / step + 0.5 * impedance)
        moved += step * velocity
        change = step * np.diff(velocity) / width
        before = stress
        stress = parts.shear(change)
        work += width * np.sum(0.5 * (stress + before) * change)
        peak = np.maximum(peak, np.abs(np.diff(moved)) / width)
        behind[number + 1] = moved[-1] - moved[0]
        surface[number + 1] = velocity[-1]
    stored = 0.5 * width * np.sum(parts.stress**2 / parts.modulus)
    return Motion(step * np.arange(count + 1), behind, surface, peak, work - stored)
