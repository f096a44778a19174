"""Packing density, thickness and porosity of an armour layer on the plane of a slope, as they are surveyed."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sazare.tables import NotARun

FINE = 0.125  # nominal diameters, the size of cells
FOOT = 0.25  # nominal diameters, the radius of the spherical foot with which surfaces are surveyed
EDGE = 0.1  # share of the units at the lower and at the upper end of the layer beyond whose centres nothing counts


@dataclass(frozen=True)
class Plane:
    """The plane of a slope. point, normal (3,): of the case; up (3,): along the slope, against gravity."""

    point: np.ndarray
    normal: np.ndarray
    up: np.ndarray

    @property
    def frame(self):
        """Axes up the slope, along the shore and out of it (3, 3), as rows."""
        return np.array([self.up, np.cross(self.normal, self.up), self.normal])


def plane_of(case, against_gravity, name=None):
    """The Plane of the wall of a resolved case with this name, or with the name slope where none is given; None where there is no such wall.

    Raises NotARun where the wall that is named is none, is no plane, or is level.
    """
    walls = {wall["name"]: wall for wall in case.get("walls", [])}
    wall = walls.get(name or "slope", {})
    if "normal" in wall:
        normal = np.array(wall["normal"], float) / np.linalg.norm(wall["normal"])
        up = against_gravity - (against_gravity @ normal) * normal
        if np.linalg.norm(up) > 1e-6:
            return Plane(np.array(wall["point"], float), normal, up / np.linalg.norm(up))
    if name:
        planes = [one for one, each in walls.items() if "normal" in each]
        fault = "is level" if "normal" in wall else "is no plane" if wall else "is no wall"
        raise NotARun(f'the slope "{name}" {fault}; planes are {", ".join(planes) or "none"}')
    return None


class Layer:
    """The layer of units in one snapshot on a slope.

    units: the Spheres of the units; volumes (n,) of the units [m3]; others: centres (m, 3) and radii (m,) of all other spheres, which are the ground [m];
    plane: the Plane of the slope, which is ground too; width: along the shore [m]; size: D_n [m]; window: lower and upper end [m] along the slope from the point of the
    plane, None for those between which the middle 80 % of the units' centres are.

    The surface of units and ground is surveyed with a spherical foot of D_n/2 in diameter, as heights out of the slope. Along the shore it repeats.
    """

    def __init__(self, units, volumes, others, plane, width, size, window=None):
        self.size, self.width = size, width
        own, ground = ((points - plane.point) @ plane.frame.T for points in (units.points, others[0]))
        centres = units.mean(own)[:, 0]
        self.window = window or tuple(float(end) for end in np.quantile(centres, (EDGE, 1.0 - EDGE)))
        if self.window[1] - self.window[0] < size:
            raise NotARun(f"the middle {100.0 - 200.0 * EDGE:g} % of the units are within a nominal diameter up the slope: too short for a packing density")
        share = units.radii**3 / np.bincount(units.owner, units.radii**3)[units.owner] * volumes[units.owner]  # of the volume of a unit, by sphere
        self.volume = float(share[(own[:, 0] > self.window[0]) & (own[:, 0] < self.window[1])].sum())
        self._shape = math.ceil((self.window[1] - self.window[0]) / (FINE * size)), math.ceil(width / (FINE * size))
        self.base = self._survey(ground, others[1], np.zeros(self._shape))
        self.top = self._survey(own, units.radii, self.base)

    def _survey(self, points, radii, base):
        """Heights of the lowest point of the foot where it rests on spheres, or on what is below them, over the middles of cells."""
        foot, heights = FOOT * self.size, base.copy()
        steps = np.array([(self.window[1] - self.window[0]) / self._shape[0], self.width / self._shape[1]])
        for point, radius in zip(points, radii + foot):
            first = np.floor((point[:2] - [self.window[0], 0.0] - radius) / steps).astype(int)
            last = np.ceil((point[:2] - [self.window[0], 0.0] + radius) / steps).astype(int)
            along, shore = np.arange(max(first[0], 0), min(last[0], self._shape[0])), np.arange(first[1], last[1])
            if not len(along):
                continue
            away = ((along + 0.5) * steps[0] + self.window[0] - point[0])[:, None] ** 2 + ((shore + 0.5) * steps[1] - point[1])[None, :] ** 2
            height = np.where(away < radius**2, point[2] + np.sqrt(np.maximum(radius**2 - away, 0.0)) - foot, -np.inf)
            np.maximum.at(heights, np.ix_(along, shore % self._shape[1]), height)
        return heights

    @property
    def area(self):
        """Of the slope within the window [m2]."""
        return (self.window[1] - self.window[0]) * self.width

    @property
    def packing(self):
        """N D_n^2 / A, where N is the volume of the units within the window over that of one."""
        return self.volume / (self.size * self.area)

    @cached_property
    def thickness(self):
        """Mean height of the units' surface over the ground [m]."""
        return float(np.mean(self.top - self.base))

    @property
    def porosity(self):
        """n = 1 - N V / (A t)."""
        return 1.0 - self.volume / (self.area * self.thickness)
