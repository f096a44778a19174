"""Heights of surfaces over a grid that lies along the throw, in sparse cells: flyrock may be far away."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Heights:
    """Cells of a size [m]: numbers along and across the throw (n, 2) of those that something covers, and the height of its top in each (n,) [m]."""

    size: float
    cells: np.ndarray
    tops: np.ndarray

    def at(self, cells, default):
        """Tops (k,) [m] of other cells (k, 2); `default` where nothing covers one."""
        if not len(self.cells) or not len(cells):
            return np.full(len(cells), default)
        lowest = np.minimum(self.cells.min(axis=0), cells.min(axis=0))
        width = int(max(self.cells[:, 1].max(), cells[:, 1].max()) - lowest[1] + 1)
        own, wanted = ((one - lowest) @ np.array([width, 1]) for one in (self.cells, cells))
        order = np.argsort(own)
        place = np.minimum(np.searchsorted(own[order], wanted), len(own) - 1)
        return np.where(own[order][place] == wanted, self.tops[order][place], default)


def axes_of(direction):
    """Along and across a horizontal direction (3,), as columns (3, 2)."""
    return np.column_stack([direction, [-direction[1], direction[0], 0.0]])


def _highest(size, cells, tops):
    if not len(cells):
        return Heights(size, np.zeros((0, 2), dtype=int), np.zeros(0))
    found, inverse = np.unique(cells, axis=0, return_inverse=True)
    highest = np.full(len(found), -np.inf)
    np.maximum.at(highest, np.ravel(inverse), tops)
    return Heights(size, found, highest)


def heights_of_balls(centres, radii, direction, size):
    """The Heights of spheres (n, 3), (n,) [m], by the vertical lines through the middles of cells."""
    flat = centres @ axes_of(direction)
    cells, tops = [np.zeros((0, 2), dtype=int)], [np.zeros(0)]
    reach = np.ceil(radii / size).astype(int) + 1
    for steps in np.unique(reach):
        own = reach == steps
        around = np.stack(np.meshgrid(*2 * [np.arange(-steps, steps + 1)], indexing="ij"), axis=-1).reshape(-1, 2)
        number = np.floor(flat[own] / size).astype(int)[:, None] + around
        beside = np.sum(((number + 0.5) * size - flat[own][:, None]) ** 2, axis=2)
        over = radii[own][:, None] ** 2 - beside
        hit = over > 0.0
        cells.append(number[hit])
        tops.append((centres[own][:, 2][:, None] + np.sqrt(np.maximum(over, 0.0)))[hit])
    return _highest(size, np.concatenate(cells), np.concatenate(tops))


def heights_of_triangles(triangles, direction, size):
    """The Heights of triangles (n, 3, 3) [m], by the vertical lines through the middles of cells."""
    flat = triangles @ axes_of(direction)
    cells, tops = [np.zeros((0, 2), dtype=int)], [np.zeros(0)]
    for corners, heights in zip(flat, triangles[:, :, 2]):
        sides = corners[1:] - corners[0]
        area = sides[0, 0] * sides[1, 1] - sides[0, 1] * sides[1, 0]
        low, high = np.floor(corners.min(axis=0) / size).astype(int), np.floor(corners.max(axis=0) / size).astype(int)
        if abs(area) < 1e-12 * size**2:
            continue
        number = np.stack(np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1), indexing="ij"), axis=-1).reshape(-1, 2)
        offset = (number + 0.5) * size - corners[0]
        second = (offset[:, 0] * sides[1, 1] - offset[:, 1] * sides[1, 0]) / area
        third = (offset[:, 1] * sides[0, 0] - offset[:, 0] * sides[0, 1]) / area
        hit = (second >= -1e-9) & (third >= -1e-9) & (second + third <= 1.0 + 1e-9)
        cells.append(number[hit])
        tops.append((heights[0] + second * (heights[1] - heights[0]) + third * (heights[2] - heights[0]))[hit])
    return _highest(size, np.concatenate(cells), np.concatenate(tops))
