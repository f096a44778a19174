"""Damage around holes: broken area of joints over the distance from the axes of holes, and by direction."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sazare.blast.holes import nearest

CRACK = 2  # from this `state` of a joint on, it is a crack
LEVELS = (0.9, 0.5, 0.1)
RINGS = 24
DIRECTIONS = 24


@dataclass(frozen=True)
class Damage:
    """Joints nearest to one hole: distances of their centres from its axis [m] (n,), areas [m2] (n,), whether they are broken (n,), and the angle of
    their centres about the axis [rad] (n,), from `right` toward `up`, two unit vectors (3,) across the mean axis of all holes."""

    name: str
    distances: np.ndarray
    areas: np.ndarray
    broken: np.ndarray
    angles: np.ndarray
    right: np.ndarray
    up: np.ndarray

    @cached_property
    def decrease(self):
        """Distances from the axis [m] (n,), ascending, and at each the broken share of the joint area (n,), 0 to 1, as a curve that never rises with the
        distance: the one that fits all joints best by least squares with their areas as weights (isotonic regression; Barlow, Bartholomew, Bremner and
        Brunk, 1972, Statistical Inference under Order Restrictions)."""
        from scipy.optimize import isotonic_regression  # here, since it takes long to load

        order = np.argsort(self.distances, kind="stable")
        fitted = isotonic_regression(self.broken[order].astype(float), weights=self.areas[order], increasing=False)
        return self.distances[order], fitted.x

    def radius(self, share):
        """The distance [m] from the axis up to which at least a share of the joint area is broken, by the curve that never rises; 0 where it is less
        everywhere."""
        distances, broken = self.decrease
        reached = np.flatnonzero(broken >= share)
        return float(distances[reached[-1]]) if len(reached) else 0.0

    def rings(self, count=RINGS):
        """Edges [m] (count + 1,) of rings about the axis, equally wide out to where the last joint is broken, and in each the share of the area of joints
        that is broken (count,), nan where there is none. None where no joint is broken."""
        if not self.broken.any():
            return None
        edges = np.linspace(0.0, float(self.distances[self.broken].max()) * (1.0 + 1e-9), count + 1)
        whole, _ = np.histogram(self.distances, edges, weights=self.areas)
        broken, _ = np.histogram(self.distances, edges, weights=np.where(self.broken, self.areas, 0.0))
        return edges, np.divide(broken, whole, out=np.full(count, np.nan), where=whole > 0.0)

    def by_direction(self, count=DIRECTIONS):
        """Edges [rad] (count + 1,) of sectors about the axis from 0 to 2 pi, and the broken area in each [m2] (count,)."""
        edges = np.linspace(0.0, 2.0 * np.pi, count + 1)
        broken, _ = np.histogram(np.mod(self.angles, 2.0 * np.pi), edges, weights=np.where(self.broken, self.areas, 0.0))
        return edges, broken


def mean_axis(holes):
    """The mean direction (3,) of the axes of holes, each taken the way of the first."""
    axes = [hole.last - hole.first for hole in holes]
    return sum(axis if axis @ axes[0] >= 0.0 else -axis for axis in axes)


def across(axis):
    """Two unit vectors (3,) across an axis (3,): as seen against it, to the right and up. x and y for an axis along z, and for one of no length."""
    length = np.linalg.norm(axis)
    along = axis / length if length > 0.0 else np.array([0.0, 0.0, 1.0])
    up = np.array([0.0, 0.0, 1.0]) if abs(along[2]) < 0.9 else np.array([0.0, 1.0, 0.0])
    up = up - (up @ along) * along
    up /= np.linalg.norm(up)
    return np.cross(up, along), up


def damage_of(results, holes):
    """The Damage around each hole by the last snapshot (list), every joint with its nearest hole; none without holes or without joints."""
    snapshots = results.snapshots
    if not holes or not len(snapshots) or snapshots[-1].joints is None:
        return []
    first, last = snapshots[0].joints, snapshots[-1].joints
    corners = np.asarray((first if first.n_cells == last.n_cells else last).points)
    corners = corners[np.asarray(last.cell_connectivity).reshape(-1, 3)]
    centres = corners.mean(axis=1)
    areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    broken = np.asarray(last.cell_data["state"]) >= CRACK
    own, distances = nearest(holes, centres)
    right, up = across(mean_axis(holes))
    found = []
    for number, hole in enumerate(holes):
        mine = own == number
        arms = hole.radius(centres[mine])
        found.append(Damage(hole.name, distances[mine], areas[mine], broken[mine], np.arctan2(arms @ up, arms @ right), right, up))
    return found
