"""Holes of a blast: their axes, and what is near to which of them."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Hole:
    """A hole: name, delay [s], both ends of its axis [m] (3,), diameter [m], and the mass of its charge [kg], None where nobody said it."""

    name: str
    delay: float
    first: np.ndarray
    last: np.ndarray
    diameter: float
    charge: float | None = None

    def distance(self, points):
        """Distance [m] (n,) of points (n, 3) from the axis, or from its nearer end."""
        return np.linalg.norm(self.radius(points), axis=1)

    def radius(self, points):
        """Vectors [m] (n, 3) to points (n, 3) from the nearest point of the axis."""
        points = np.asarray(points, dtype=float)
        along = self.last - self.first
        square = float(along @ along)
        share = np.clip((points - self.first) @ along / square, 0.0, 1.0) if square > 0.0 else np.zeros(len(points))
        return points - self.first - share[:, None] * along


def holes_of(results, charges=()):
    """The holes of a run, in the order of its case; none where it wrote no holes.csv.

    charges: masses [kg], one for each hole, or one for all; without them those of holes.csv, which charges of a case have. Raises ValueError where there are as many as neither.
    """
    table = results.holes
    if charges and len(charges) not in (1, table.rows):
        raise ValueError(f"{len(charges)} masses of charges for {table.rows} holes: give one for all, or one for each in the order of the case")
    if not table.rows:
        return []
    first, last = (np.stack([table[f"{end}_{axis}"] for axis in "xyz"], axis=1) for end in ("first", "last"))
    # A column of names that are all numbers reads as one of numbers.
    names = [f"{name:g}" if isinstance(name, float) else str(name) for name in table["hole"]]
    masses = np.broadcast_to(charges, table.rows) if charges else _masses(table)
    return [
        Hole(names[number], float(table["delay"][number]), first[number], last[number], float(table["diameter"][number]), masses[number])
        for number in range(table.rows)
    ]


def _masses(table):
    """Masses of the charges that a run knows [kg]; None for each hole where it does not know all of them."""
    known = "mass" in table and bool(np.all(table["mass"] > 0.0))
    return [float(mass) for mass in table["mass"]] if known else [None] * table.rows


def nearest(holes, points):
    """Which hole is the nearest to each point (n, 3), and how far it is [m]: (n,), (n,)."""
    distances = np.stack([hole.distance(points) for hole in holes])
    return np.argmin(distances, axis=0), distances.min(axis=0)
