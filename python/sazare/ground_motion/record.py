"""A ground motion: equal steps of acceleration, with straight lines between them, and what it is read from and written to."""

import math
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np

from sazare.tables import write_table

GRAVITY = 9.80665  # m/s2, standard; what records in g are read with
GAL = 0.01  # m/s2


@dataclass(frozen=True, eq=False)
class Record:
    """A ground motion that begins at rest at t = 0 [s]. The acceleration is linear between its samples, as the engine takes it.

    step: time between samples [s]; acceleration: (n,) [m/s2]; name: in words.

    Raises ValueError for fewer than 2 samples, numbers that are not finite, or a step that is not above 0.
    """

    step: float
    acceleration: np.ndarray
    name: str = "record"

    def __post_init__(self):
        values = np.array(self.acceleration, dtype=float)
        values.setflags(write=False)
        object.__setattr__(self, "acceleration", values)
        if not (math.isfinite(self.step) and self.step > 0.0):
            raise ValueError(f"{self.name}: the step must be a finite number above 0 s, found {self.step}")
        if values.ndim != 1 or len(values) < 2:
            raise ValueError(f"{self.name}: a record has at least 2 samples in one row, found {values.shape}")
        if not np.isfinite(values).all():
            raise ValueError(f"{self.name}: sample {int(np.argmin(np.isfinite(values)))} is not a finite number; gaps in a record are not filled")

    @property
    def time(self):
        """(n,) [s]."""
        return self.step * np.arange(len(self.acceleration))

    @property
    def duration(self):
        """From the first to the last sample [s]."""
        return self.step * (len(self.acceleration) - 1)

    @cached_property
    def velocity(self):
        """(n,) [m/s], the exact integral of the straight lines from rest."""
        a = self.acceleration
        return np.concatenate([[0.0], np.cumsum(0.5 * self.step * (a[1:] + a[:-1]))])

    @cached_property
    def displacement(self):
        """(n,) [m], the exact integral of `velocity` from 0."""
        a, v, h = self.acceleration, self.velocity, self.step
        return np.concatenate([[0.0], np.cumsum(h * v[:-1] + h * h * (2.0 * a[:-1] + a[1:]) / 6.0)])

    def with_acceleration(self, acceleration):
        """The same record with other samples [m/s2]."""
        return replace(self, acceleration=acceleration)

    def scaled(self, factor):
        """The record times a factor [-]."""
        return self.with_acceleration(factor * self.acceleration)


def from_samples(step, values, quantity="acceleration", name="record"):
    """The Record of equal steps [s] of acceleration [m/s2], velocity [m/s] or displacement [m], whose differences are central.

    Raises ValueError as Record, and for another quantity.
    """
    orders = {"acceleration": 0, "velocity": 1, "displacement": 2}
    if quantity not in orders:
        raise ValueError(f"{quantity} is none of {', '.join(orders)}")
    values = Record(step, values, name).acceleration
    for _ in range(orders[quantity]):
        values = np.gradient(values, step)
    return Record(step, values, name)


def read_record(path):
    """The record of a file, read as a case reads it: PEER (.AT2), K-NET and KiK-net (.EW, .NS, .UD) or CSV (`time [s],acceleration [m/s2]`; also
    g and gal, and velocities and displacements).

    Raises ValueError, with line and column, for a file that is none of these or is damaged.
    """
    from sazare.engine import engine

    path = Path(path)
    try:
        quantity, step, values = engine().motion_file(path)
    except engine().UserError as error:
        raise ValueError(str(error)) from error
    return from_samples(step, values, quantity, path.stem)


def write_record(path, record):
    """Writes a record as a CSV that a case can name: `time [s],acceleration [m/s2]`; returns its path."""
    return write_table(path, {"time [s]": record.time, "acceleration [m/s2]": record.acceleration})
