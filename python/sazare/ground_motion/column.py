"""Horizontal layers over a half-space under vertical shear waves: transfer functions, and records carried from one place to another.

Layers of complex modulus G (1 + 2 i h), with waves up (A) and down (B) in each [Kramer1996, section 7.2.1.4; Thomson1950; Haskell1953]:

    u = A exp(i (w t + k z)) + B exp(i (w t - k z))      z down from the top of the layer, k = w / Vs*, Vs*^2 = G (1 + 2 i h) / density

Stress is 0 at the surface, so A = B there; stress and displacement are continuous from layer to layer.
"""

import math
from dataclasses import dataclass

import numpy as np

from sazare.ground_motion.correction import MOST_SAMPLES, butterworth
from sazare.ground_motion.record import Record

WITHIN, OUTCROP = "within", "outcrop"


@dataclass(frozen=True)
class Layer:
    """thickness [m] (inf for the half-space), density [kg/m3], s_wave_velocity [m/s], damping_ratio [-]."""

    thickness: float
    density: float
    s_wave_velocity: float
    damping_ratio: float = 0.0

    def __post_init__(self):
        for name, unit in (("thickness", "m"), ("density", "kg/m3"), ("s_wave_velocity", "m/s")):
            value = getattr(self, name)
            if not (value > 0.0 and (math.isfinite(value) or name == "thickness")):
                raise ValueError(f"the {name} of a layer must be above 0 {unit}, found {value:g}")
        if not 0.0 <= self.damping_ratio < 1.0:
            raise ValueError(f"the damping_ratio of a layer must be 0 or more and below 1, found {self.damping_ratio:g}")


@dataclass(frozen=True)
class Place:
    """Where a motion is: at the top of a layer (0 is the surface, -1 the half-space), within the ground or where that layer crops out."""

    layer: int
    kind: str = WITHIN

    def __post_init__(self):
        if self.kind not in (WITHIN, OUTCROP):
            raise ValueError(f"a motion is {WITHIN} or {OUTCROP}, found {self.kind}")


SURFACE, BASE_WITHIN, BASE_OUTCROP = Place(0), Place(-1), Place(-1, OUTCROP)


class Column:
    """Layers from the surface down; the last one is the half-space, of infinite thickness."""

    def __init__(self, layers):
        """Raises ValueError where no layer lies on the half-space, or one above it is infinite."""
        self.layers = tuple(layers)
        if len(self.layers) < 2:
            raise ValueError(f"a column has at least one layer and the half-space below it, found {len(self.layers)} rows")
        *above, below = self.layers
        if any(math.isinf(layer.thickness) for layer in above):
            raise ValueError("only the last layer, the half-space, has an infinite thickness")
        if not math.isinf(below.thickness):
            raise ValueError(f"the last layer is the half-space: its thickness must be inf, found {below.thickness:g} m")

    @property
    def height(self):
        """From the surface to the half-space [m]."""
        return sum(layer.thickness for layer in self.layers[:-1])

    @property
    def travel_time(self):
        """Of a wave from the half-space to the surface [s]."""
        return sum(layer.thickness / layer.s_wave_velocity for layer in self.layers[:-1])

    def waves(self, frequency):
        """Amplitudes up and down at the top of each layer, for 1 and 1 at the surface: two complex arrays (layers, n). frequency: (n,) [Hz]."""
        omega = 2.0 * np.pi * np.asarray(frequency, dtype=float)
        speeds = [layer.s_wave_velocity * np.sqrt(1.0 + 2.0j * layer.damping_ratio) for layer in self.layers]
        impedances = [layer.density * speed for layer, speed in zip(self.layers, speeds)]
        up, down = [np.ones(len(omega), dtype=complex)], [np.ones(len(omega), dtype=complex)]
        for number, layer in enumerate(self.layers[:-1]):
            turn = np.exp(1j * omega / speeds[number] * layer.thickness)
            ratio = impedances[number] / impedances[number + 1]
            rising, falling = up[-1] * turn, down[-1] / turn
            up.append(0.5 * (rising * (1.0 + ratio) + falling * (1.0 - ratio)))
            down.append(0.5 * (rising * (1.0 - ratio) + falling * (1.0 + ratio)))
        return np.array(up), np.array(down)

    def transfer(self, frequency, source=BASE_OUTCROP, target=SURFACE):
        """The complex amplitude at one Place over that at another one (n,) [-]. frequency: (n,) [Hz].

        Raises ValueError for a layer that there is not.
        """
        for place in (source, target):
            if not -len(self.layers) <= place.layer < len(self.layers):
                raise ValueError(f"there is no layer {place.layer}; the column has {len(self.layers)}, from 0")
        up, down = self.waves(frequency)

        def amplitude(place):
            return 2.0 * up[place.layer] if place.kind == OUTCROP else up[place.layer] + down[place.layer]

        return amplitude(target) / amplitude(source)

    def carry(self, record, source=SURFACE, target=BASE_OUTCROP, highest=None):
        """A record at one Place of the column, from that at another one; from the surface down it is deconvolution.

        The record returned begins `lead(record)` earlier, since waves at depth come before those at the surface, and goes on for the same time
        longer. highest: frequencies above it [Hz] are taken out first (Butterworth, zero phase): on the way down they grow with depth and damping.

        Raises ValueError as `transfer`, and where the motion at the target grows without bound.
        """
        record = record if highest is None else butterworth(record, high=highest)
        before = round(self.lead(record) / record.step)
        if before > MOST_SAMPLES:
            raise ValueError(f"a wave takes {self.travel_time:.4g} s from the half-space to the surface: check thicknesses and velocities")
        samples = np.pad(record.acceleration, before)
        count = 2 * len(samples)
        frequency = np.fft.rfftfreq(count, record.step)
        with np.errstate(over="ignore", invalid="ignore"):
            moved = np.fft.irfft(np.fft.rfft(samples, count) * self.transfer(frequency, source, target), count)[: len(samples)]
        if not np.isfinite(moved).all():
            raise ValueError("the motion grows without bound on the way down: give a highest frequency, or less damping")
        return Record(record.step, moved, record.name)

    def lead(self, record):
        """The time [s] by which `carry` lets a record begin earlier and end later: a whole number of steps, twice the travel time and more."""
        return record.step * math.ceil(2.0 * self.travel_time / record.step + 1.0)
