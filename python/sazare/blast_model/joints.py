"""Existing joints: discs in the rock, read from a table."""

import math
import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from sazare.blast_model.layout import polygon_radius
from sazare.blast_model.orientations import across
from sazare.blast_model.sheet import Problems, read_sheet

CORNERS = 12  # of the polygon that stands for a disc, unless its sides would be too short
NEEDED = ("x", "y", "z", "dip", "dip_direction", "radius")
UNITS = {"x": "m", "y": "m", "z": "m", "dip": "deg", "dip_direction": "deg", "radius": "m", "set": ""}


@dataclass(frozen=True)
class Disc:
    """A flat round joint."""

    centre: np.ndarray  # (3,) [m]
    normal: np.ndarray  # (3,), a unit vector
    radius: float  # m
    line: int = 0  # of the table, in which it is described; 0: of none, drawn at random
    set: str = ""  # the set it belongs to
    corners: int = CORNERS  # of its polygon
    turn: float = 0.0  # of the polygon in its plane, in parts of the angle between two corners

    @property
    def area(self):
        """Area [m2]."""
        return math.pi * self.radius**2

    @property
    def surface(self):
        """Name of the group of its faces."""
        return surface_of(self.set)

    def polygon(self):
        """Corners of a regular polygon with the area of the disc, (corners, 3) [m]."""
        first, second = across(self.normal)
        angles = 2.0 * np.pi * (np.arange(self.corners) + self.turn) / self.corners
        reach = polygon_radius(2.0 * self.radius, self.corners)
        return self.centre + reach * (np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * second)

    def placed(self, frame):
        """This disc in axes of a model."""
        return replace(self, centre=frame.place(self.centre), normal=frame.axes @ self.normal)

    def returned(self, frame):
        """This disc of a model in axes of the pattern."""
        return replace(self, centre=frame.back(self.centre), normal=frame.axes.T @ self.normal)


def surface_of(name):
    """The group of the faces of a set; that of discs of no set is `joints`."""
    return f"joints_{name}" if name else "joints"


def wrong_name(name):
    """Whether a set cannot have this name, of which that of a group is made."""
    return re.fullmatch(r"[A-Za-z0-9_]+", name) is None


def upward_normal(dip, dip_direction):
    """The normal of a plane [deg], with x to the east, y to the north and z up: dip from the horizontal, dip direction from north by east."""
    slope, way = math.radians(dip), math.radians(dip_direction)
    return np.array([math.sin(slope) * math.sin(way), math.sin(slope) * math.cos(way), math.cos(slope)])


def read_discs(path):
    """Discs from a CSV file with centre, dip, dip direction, radius and, where there is such a column, set. Raises ValueError with all that is wrong, by line; OSError where it cannot be read."""
    path = Path(path)
    problems = Problems(path)
    rows = read_sheet(path, UNITS, NEEDED, problems, {"radius": (-1e5, 1e5)})
    problems.tell()
    for row in rows:
        if not 0.0 <= row.cells["dip"] <= 90.0:
            problems.error(row.line, f"the dip is {row.cells['dip']:g} degrees", "a dip is 0 (level) to 90 degrees (upright)")
        if not row.cells["radius"] > 0.0:
            problems.error(row.line, f"the radius is {row.cells['radius']:g} m", "a radius is greater than 0")
        if wrong_name(row.cells.get("set", "joints")):
            problems.error(row.line, f"a set cannot be called {row.cells['set']!r}", "its name becomes a group of the mesh: use letters, digits and _")
    problems.tell()
    return [_disc(row) for row in rows]


def _disc(row):
    cells = row.cells
    return Disc(np.array([cells["x"], cells["y"], cells["z"]]), upward_normal(cells["dip"], cells["dip_direction"]), cells["radius"], row.line, cells.get("set", ""))


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
