"""Existing joints: discs in the rock, read from a table."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sazare.blast_model.sheet import Problems, read_sheet

CORNERS = 12  # of the polygon that stands for a disc
NEEDED = ("x", "y", "z", "dip", "dip_direction", "radius")
UNITS = {"x": "m", "y": "m", "z": "m", "dip": "deg", "dip_direction": "deg", "radius": "m"}


@dataclass(frozen=True)
class Disc:
    """A flat round joint."""

    centre: np.ndarray  # (3,) [m]
    normal: np.ndarray  # (3,), a unit vector
    radius: float  # m
    line: int = 0  # of the table, in which it is described

    def polygon(self):
        """Corners of a regular polygon with the area of the disc, (CORNERS, 3) [m]."""
        first = np.cross(self.normal, np.eye(3)[np.argmin(np.abs(self.normal))])
        first /= np.linalg.norm(first)
        angles = 2.0 * np.pi * np.arange(CORNERS) / CORNERS
        reach = self.radius * math.sqrt(2.0 * math.pi / (CORNERS * math.sin(2.0 * math.pi / CORNERS)))
        return self.centre + reach * (np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * np.cross(self.normal, first))

    def placed(self, frame):
        """This disc in axes of a model."""
        return Disc(frame.place(self.centre), frame.axes @ self.normal, self.radius, self.line)


def upward_normal(dip, dip_direction):
    """The normal of a plane [deg], with x to the east, y to the north and z up: dip from the horizontal, dip direction from north by east."""
    slope, way = math.radians(dip), math.radians(dip_direction)
    return np.array([math.sin(slope) * math.sin(way), math.sin(slope) * math.cos(way), math.cos(slope)])


def read_discs(path):
    """Discs from a CSV file with centre, dip, dip direction and radius. Raises ValueError with all that is wrong, by line; OSError where it cannot be read."""
    path = Path(path)
    problems = Problems(path)
    rows = read_sheet(path, UNITS, NEEDED, problems)
    problems.tell()
    for row in rows:
        if not 0.0 <= row.cells["dip"] <= 90.0:
            problems.error(row.line, f"the dip is {row.cells['dip']:g} degrees", "a dip is 0 (level) to 90 degrees (upright)")
        if not row.cells["radius"] > 0.0:
            problems.error(row.line, f"the radius is {row.cells['radius']:g} m", "a radius is greater than 0")
    problems.tell()
    return [_disc(row) for row in rows]


def _disc(row):
    cells = row.cells
    return Disc(np.array([cells["x"], cells["y"], cells["z"]]), upward_normal(cells["dip"], cells["dip_direction"]), cells["radius"], row.line)


def refuse_outside(path, discs, layout):
    """Raises ValueError where a disc does not reach into the box around the rock."""
    problems = Problems(path)
    for disc in discs:
        corners = disc.placed(layout.frame).polygon()
        if np.any(corners.max(axis=0) <= layout.lower) or np.any(corners.min(axis=0) >= layout.upper):
            problems.error(
                disc.line, "this joint does not reach into the rock of the model",
                "its centre is in the coordinates of the pattern; remove it, or give more rock around the holes by --margin",
            )
    problems.tell()
