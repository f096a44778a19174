"""The motion of ground against its base, where an earthquake moves the base or comes in from below: meshes of snapshots as they look from there."""

import numpy as np

from sazare.ground_motion.gauges import case_of, input_axes
from sazare.snapshots import elements_once

LEVEL = 0.01  # of the height: as near to the lowest place at the beginning counts as the base


def motion_enters(results):
    """Whether the case has a prescribed motion, or a wave that comes in."""
    return bool(input_axes(results) or case_of(results).get("incident_wave"))


class SeenFromBase:
    """A run whose motion is looked at from its base: the lowest particles or nodes, by the middle one of their displacements along each axis.

    `words` is what to add to the name of a displacement; without an input motion it is empty, and meshes are left as they are.
    """

    def __init__(self, results):
        self.follows = motion_enters(results)
        self.words = " relative to the base" if self.follows else ""

    def mesh(self, snapshot):
        """The mesh of a snapshot, its points and their displacement [m] relative to the base."""
        return self.seen(elements_once(snapshot))

    def seen(self, grid):
        """A mesh whose points and displacement [m] are relative to the base."""
        data = next((data for data in (grid.cell_data, grid.point_data) if "displacement" in data), None)
        if not self.follows or data is None:
            return grid
        moved = np.asarray(data["displacement"])
        if len(moved) != grid.n_points:
            return grid
        base = base_displacement(np.asarray(grid.points) - moved, moved)
        copy = grid.copy()
        copy.points = np.asarray(grid.points) - base
        (copy.cell_data if "displacement" in grid.cell_data else copy.point_data)["displacement"] = moved - base
        return copy


def base_displacement(start, moved):
    """The displacement of the base (3,) [m]. start, moved (n, 3): places at the beginning and displacements of particles or nodes [m]."""
    up = 2 if np.ptp(start[:, 2]) > 0.0 else 1
    lowest = start[:, up] <= start[:, up].min() + LEVEL * np.ptp(start[:, up])
    return np.median(moved[lowest], axis=0)
