"""The named groups of a Gmsh mesh (format 4.1, text or binary): where surfaces, lines and points with conditions lie.

The engine reads and checks a mesh before; here only coordinates and groups are taken from it.
"""

import re
import shlex
from functools import cached_property

import numpy as np

NODES = {1: 2, 2: 3, 3: 4, 4: 4, 5: 8, 8: 3, 9: 6, 10: 9, 11: 10, 12: 27, 15: 1, 16: 8, 17: 20}  # by Gmsh's number of a type
CORNERS = {1: 2, 2: 3, 3: 4, 4: 4, 5: 8, 8: 2, 9: 3, 10: 4, 11: 4, 12: 8, 15: 1, 16: 4, 17: 8}  # they come first among the nodes


class _Text:
    """Numbers of a section that is written as text."""

    def __init__(self, section):
        self._words, self._place = section.split(), 0

    def take(self, count, kind):
        """The next numbers of a kind."""
        words = self._words[self._place : self._place + count]
        self._place += count
        return np.array(words, dtype=float).astype(kind)


class _Binary:
    """Numbers of a section that is written in the machine's own form."""

    def __init__(self, section):
        self._bytes, self._place = section, 0

    def take(self, count, kind):
        """The next numbers of a kind."""
        found = np.frombuffer(self._bytes, kind, count, self._place)
        self._place += found.nbytes
        return found


class MeshGroups:
    """The groups of a mesh file, with coordinates times a scale [m]."""

    def __init__(self, path, scale=1.0):
        self._content = path.read_bytes()
        self._scale = scale
        self._is_binary = int(self._section("MeshFormat").split()[1]) == 1

    def _section(self, name):
        begin = self._content.find(b"$" + name.encode())
        if begin < 0:
            return b""
        begin = self._content.index(b"\n", begin) + 1
        return self._content[begin : self._content.index(b"$End" + name.encode(), begin)]

    def _numbers(self, name):
        section = self._section(name)
        return _Binary(section) if self._is_binary else _Text(section)

    @cached_property
    def _names(self):
        """Name of each named group by dimension and number."""
        rows = re.findall(r"^\s*(\d)\s+(\d+)\s+(\".*\")\s*$", self._section("PhysicalNames").decode("utf-8"), re.MULTILINE)
        return {(int(dimension), int(number)): shlex.split(name)[0] for dimension, number, name in rows}

    @cached_property
    def _groups(self):
        """Numbers of the groups of each entity, by dimension and number of the entity."""
        numbers, found = self._numbers("Entities"), {}
        for dimension, count in enumerate(numbers.take(4, np.int64)):
            for _ in range(count):
                tag = int(numbers.take(1, np.int32)[0])
                numbers.take(6 if dimension else 3, np.float64)
                found[dimension, tag] = np.abs(numbers.take(int(numbers.take(1, np.int64)[0]), np.int32))
                if dimension:
                    numbers.take(int(numbers.take(1, np.int64)[0]), np.int32)
        return found

    @cached_property
    def _points(self):
        """Coordinates [m] by number of the node: rows (largest number + 1, 3)."""
        numbers = self._numbers("Nodes")
        blocks, _, _, largest = numbers.take(4, np.int64)
        points = np.full((largest + 1, 3), np.nan)
        for _ in range(blocks):
            dimension, _, parametric = numbers.take(3, np.int32)
            tags = numbers.take(int(numbers.take(1, np.int64)[0]), np.int64)
            width = 3 + (int(dimension) if parametric else 0)
            points[tags] = numbers.take(len(tags) * width, np.float64).reshape(-1, width)[:, :3]
        return points * self._scale

    @cached_property
    def _elements(self):
        """Blocks of elements: (dimension, number of the entity, type, numbers (n,), nodes (n, k))."""
        numbers, found = self._numbers("Elements"), []
        for _ in range(numbers.take(4, np.int64)[0]):
            dimension, entity, kind = (int(number) for number in numbers.take(3, np.int32))
            count = int(numbers.take(1, np.int64)[0])
            rows = numbers.take(count * (1 + NODES[kind]), np.int64).reshape(count, -1)
            found.append((dimension, entity, kind, rows[:, 0], rows[:, 1:]))
        return found

    def _names_of(self, dimension, entity):
        """The names of the groups of an entity; a group without a name goes by its number."""
        return [self._names.get((dimension, int(number)), str(number)) for number in self._groups.get((dimension, entity), ())]

    def _blocks(self, name, dimensions):
        for dimension, entity, kind, _, nodes in self._elements:
            if dimension in dimensions and (name is None or name in self._names_of(dimension, entity)):
                yield dimension, kind, nodes

    def regions(self, dimension):
        """The names of the groups of the elements of a dimension, each where an element of it first comes in the file."""
        names = [self._names_of(dimension, entity) for found, entity, *_ in self._elements if found == dimension]
        return list(dict.fromkeys(each[0] for each in names if each))

    def region_of_elements(self, dimension):
        """The name of the group of every element of a dimension, by the number of the element."""
        return {
            int(number): names[0] for found, entity, _, numbers, _ in self._elements if found == dimension
            for names in [self._names_of(dimension, entity)] if names for number in numbers
        }

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
