"""The rock that stays and the ground: what fragments land on."""

from functools import cached_property

import numpy as np

from sazare.muck_pile.elements import FACES, outer_faces

FAR_END = 0.05  # of the extent of the rock along the throw, in which the height of its surface is that of the ground


def surface_of(triangles):
    """Triangles (n, 3, 3) [m] as a surface (pyvista.PolyData)."""
    import pyvista

    faces = np.column_stack([np.full(len(triangles), 3), np.arange(3 * len(triangles)).reshape(-1, 3)])
    return pyvista.PolyData(triangles.reshape(-1, 3), faces.ravel())


def distances(surface, points):
    """Distances [m] (n,) of points (n, 3) from a surface."""
    _, nearest = surface.find_closest_cell(points, return_closest_point=True)
    return np.linalg.norm(nearest - points, axis=1)


class Standing:
    """The surface of the Elements that stay, with `chosen` (n,) saying which, as far as it is above the ground [m]; cracks within it are closed."""

    def __init__(self, elements, chosen, ground):
        self.corners = elements.corners[chosen]
        nodes = elements.nodes[chosen]
        triangles = _closed(self.corners, nodes)[:, FACES][outer_faces(nodes)]
        self.triangles = triangles[triangles[:, :, 2].max(axis=1) > ground]

    def __bool__(self):
        return len(self.triangles) > 0

    @cached_property
    def _surface(self):
        return surface_of(self.triangles)

    @cached_property
    def _solid(self):
        import pyvista

        cells = np.column_stack([np.full(len(self.corners), 4), np.arange(4 * len(self.corners)).reshape(-1, 4)])
        return pyvista.UnstructuredGrid(cells.ravel(), np.full(len(self.corners), pyvista.CellType.TETRA), self.corners.reshape(-1, 3))

    def distance(self, points):
        """Distance [m] (n,) of points (n, 3) from the surface; inf where nothing stays."""
        return distances(self._surface, points) if self else np.full(len(points), np.inf)

    def holds(self, points):
        """Which points (n, 3) lie within the rock that stays."""
        if not self:
            return np.zeros(len(points), dtype=bool)
        return np.asarray(self._solid.find_containing_cell(points)) >= 0

    def write_stl(self, path):
        """Writes the surface as a binary STL [m]."""
        edges = self.triangles[:, 1:] - self.triangles[:, :1]
        normal = np.cross(edges[:, 0], edges[:, 1])
        record = np.zeros(len(self.triangles), dtype=[("numbers", "<f4", (4, 3)), ("rest", "<u2")])
        record["numbers"][:, 0] = normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
        record["numbers"][:, 1:] = self.triangles
        path.write_bytes(b"rock that stays".ljust(80) + np.uint32(len(record)).tobytes() + record.tobytes())


def _closed(corners, nodes):
    """Corners (n, 4, 3) of elements, each in the mean place of those that met in it."""
    _, inverse = np.unique(nodes, return_inverse=True)
    inverse = np.ravel(inverse)
    total = np.zeros((inverse.max(initial=-1) + 1, 3))
    np.add.at(total, inverse, corners.reshape(-1, 3))
    return (total / np.bincount(inverse, minlength=len(total))[:, None])[inverse].reshape(-1, 4, 3)


def ground_height(elements, stays, direction):
    """Height [m] of the ground, and how it was found, in words.

    The highest point of the rock that stays at its far end along the throw (3,), which on a bench is the floor in front; where nothing stays, or where more
    than half of what is loose lies below that, the lowest point of what is loose.
    """
    loose = ~stays
    lowest = float(elements.corners[loose][:, :, 2].min())
    if np.any(stays):
        points = elements.corners[stays].reshape(-1, 3)
        along = points @ direction
        height = float(points[along >= along.max() - FAR_END * np.ptp(along), 2].max())
        under = elements.centres[loose][:, 2] < height
        if elements.masses[loose][under].sum() <= 0.5 * elements.masses[loose].sum():
            return height, "the rock that stays at its far end along the throw"
    return lowest, "the lowest point of the loose rock"
