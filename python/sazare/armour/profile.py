"""The cross-section of an armour layer before and after."""

from functools import cached_property

import numpy as np

FINE = 0.25  # nominal diameters, the size of cells


class Profile:
    """Mean height of the layer's surface across the shore before and after. before, after: units.Spheres; up, along (3,): axes of length 1; size: D_n [m]."""

    def __init__(self, before, after, up, along, size):
        across = np.cross(along, up)
        self.cell = FINE * size
        frame = np.array([across, along, up])
        self.first, self.second = (self._tops(spheres.points @ frame.T, spheres.radii) for spheres in (before, after))

    def _tops(self, points, radii):
        """{cell: height of the highest sphere over its middle} in cells across and along the shore."""
        reach = int(np.ceil(radii.max() / self.cell)) + 1
        base = np.floor(points[:, :2] / self.cell).astype(int)
        tops = {}
        for i in range(-reach, reach + 1):
            for k in range(-reach, reach + 1):
                cells = base + [i, k]
                apart = np.sum(((cells + 0.5) * self.cell - points[:, :2]) ** 2, axis=1)
                over = np.flatnonzero(apart < radii**2)
                for cell, height in zip(map(tuple, cells[over]), points[over, 2] + np.sqrt(radii[over] ** 2 - apart[over])):
                    tops[cell] = max(tops.get(cell, -np.inf), height)
        return tops

    @cached_property
    def cells(self):
        """Numbers of the columns across the shore (k,)."""
        return np.unique([cell[0] for cell in (*self.first, *self.second)])

    def _means(self, own, other):
        """Mean heights (k,) of columns over the cells that hold a unit before and after; nan where none does."""
        total, count = {}, {}
        for cell in own.keys() & other.keys():
            total[cell[0]] = total.get(cell[0], 0.0) + own[cell]
            count[cell[0]] = count.get(cell[0], 0) + 1
        return np.array([total[k] / count[k] if k in count else np.nan for k in self.cells])

    @cached_property
    def heights(self):
        """Mean heights before and after (2, k) [m]."""
        return np.array([self._means(self.first, self.second), self._means(self.second, self.first)])

    @property
    def across(self):
        """Middles of the columns across the shore (k,) [m]."""
        return (self.cells + 0.5) * self.cell

    @property
    def eroded(self):
        """Area of the cross-section that was lost, over the columns that became lower [m2]."""
        fell = self.heights[0] - self.heights[1]
        return float(np.nansum(np.maximum(fell, 0.0)) * self.cell)

    def columns(self):
        """For a table."""
        return {"across [m]": self.across, "height_before [m]": self.heights[0], "height_after [m]": self.heights[1]}
