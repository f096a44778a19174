"""The named groups of a Gmsh mesh: where surfaces, lines and points with conditions lie."""

import numpy as np

from sazare.engine import engine

CORNERS = {1: 2, 2: 3, 3: 4, 4: 4, 5: 8, 8: 2, 9: 3, 10: 4, 11: 4, 12: 8, 15: 1, 16: 4, 17: 8}  # by Gmsh's number of a type; they come first


class MeshGroups:
    """The groups of a mesh file, with coordinates times a scale [m]."""

    def __init__(self, path, scale=1.0):
        points, self._elements = engine().mesh_file(path)
        self._points = scale * points

    def _blocks(self, name, dimensions):
        for dimension, names, kind, _, nodes in self._elements:
            if dimension in dimensions and (name is None or name in names):
                yield dimension, kind, nodes

    def regions(self, dimension):
        """The names of the groups of the elements of a dimension, each where an element of it first comes in the file."""
        return list(dict.fromkeys(names[0] for found, names, *_ in self._elements if found == dimension and names))

    def region_of_elements(self, dimension):
        """The name of the group of every element of a dimension, by the number of the element."""
        return {int(number): names[0] for found, names, _, numbers, _ in self._elements if found == dimension and names for number in numbers}

    def corners(self, name, dimension):
        """Corners (k, 3) [m] of each element of a group, or of all (None): of faces (dimension 2), or of lines (1) or points (0)."""
        return [face for _, kind, nodes in self._blocks(name, (dimension,)) for face in self._points[nodes[:, : CORNERS[kind]]]]

    def dimension(self, name, below):
        """The largest dimension under `below` in which there is a group of a name; None where there is none."""
        return max((dimension for dimension, _, _ in self._blocks(name, range(below))), default=None)

    def shared_edges(self, first, second):
        """Edges (n, 2, 3) [m] along which two groups of plane elements meet."""
        both = _edges(self._blocks(first, (2,))) & _edges(self._blocks(second, (2,)))
        return self._points[np.array(sorted(both), dtype=int).reshape(-1, 2)]

    def shared_points(self, first, second, dimension):
        """Nodes (n, 3) [m] that two groups of a dimension have in common."""
        one, other = (np.concatenate([nodes.ravel() for _, _, nodes in self._blocks(name, (dimension,))]) for name in (first, second))
        return self._points[np.intersect1d(one, other)]


def _edges(blocks):
    """The edges of plane elements, each as its two nodes in ascending order."""
    found = set()
    for _, kind, nodes in blocks:
        ring = nodes[:, : CORNERS[kind]]
        pairs = np.sort(np.stack([ring, np.roll(ring, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
        found.update(map(tuple, pairs.tolist()))
    return found
