"""Bodies in 3-D through time: what of them is drawn, and the interactive view of the report, packed so that one page holds it.

Positions are kept as the first ones and the displacement of each vertex since, in steps of 1/65535 of the range of displacements; fields in
steps of 1/255 of their range. The page unpacks them itself (viewer/view.source.js says how).
"""

import base64
import json
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from matplotlib.colors import to_hex

from sazare import style
from sazare.methods import method_of
from sazare.outside import outside_of

BUDGET = 8e6  # bytes of vertices and fields before compression
FEWEST_TIMES = 6
MOST_POINTS = 150_000
MOST_VERTICES = 400_000
SLAB_RATIO = 0.35
VERTEX, QUADRILATERAL, TETRAHEDRON = 1, 9, 10  # kinds of cells, as VTK numbers them
CORNERS = np.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])


@dataclass(frozen=True)
class Shapes:
    """What is drawn of a grid: triangles between its points, or its points as balls."""

    points: np.ndarray  # of the grid, (v,)
    cells: np.ndarray  # of the grid, that have a colour, (c,)
    cell_of_point: np.ndarray | None  # place in `cells`, (v,); None: point and cell are one
    triangles: np.ndarray | None  # places in `points`, (t, 3)
    radius: np.ndarray | None  # of balls [m] (v,)


@dataclass(frozen=True)
class Field:
    """A value of every cell in every frame (f, c), and its range as it is coloured."""

    name: str
    unit: str
    values: np.ndarray
    low: float
    high: float

    @property
    def shares(self):
        """The values from 0 to 1 within the range (f, c)."""
        span = self.high - self.low
        return np.clip((self.values - self.low) / span, 0.0, 1.0) if span > 0.0 else np.zeros_like(self.values)


@dataclass(frozen=True)
class Frames:
    """The snapshots that are shown: times [s] (f,), first places [m] (v, 3), what moved since [m] (f, v, 3), fields, their colours, the camera."""

    shapes: Shapes
    times: list
    start: np.ndarray
    moved: np.ndarray
    fields: list
    colors: object  # colour map of matplotlib
    enlargements: list
    camera: dict


def read_frames(results):
    """The frames of a run; None where it has no snapshots, or too much to draw."""
    snapshots = results.all_snapshots
    if not len(snapshots):
        return None
    shapes = _shapes(snapshots)
    if len(shapes.points) == 0 or len(shapes.points) > MOST_VERTICES:
        return None
    method = method_of(results)
    last = snapshots[-1].elements
    names = [name for name in method.fields if name in last.cell_data or name in last.point_data]
    chosen = _chosen_times(len(snapshots), 6 * len(shapes.points) + len(names) * len(shapes.cells))
    grids = [snapshots[number].elements for number in chosen]
    start = np.asarray(grids[0].points)[shapes.points]
    moved = np.stack([np.asarray(grid.points)[shapes.points] - start for grid in grids])
    fields = []
    for name in names:
        values = np.stack([_of_cells(grid, name)[shapes.cells] for grid in grids])
        fields.append(Field(*method.fields[name], values, *(_bulk_range if method.fields[name][1] == "Pa" else _range)(values)))
    enlargements = _enlargements(moved, start)
    shown = None if method.extent is None else method.extent(grids[0])
    camera = _camera(start, start + enlargements[-1] * moved[-1]) if shown is None else _camera(shown, shown)
    return Frames(shapes, [snapshots[number].time for number in chosen], start, moved, fields, method.colors, enlargements, camera)


def packed_view(results):
    """The data of the view as JSON text; None where the run has no snapshots, or too much to draw."""
    frames = read_frames(results)
    if frames is None or not frames.fields:
        return None
    shapes = frames.shapes
    low, high = float(frames.moved.min()), float(frames.moved.max())
    span = high - low or 1.0
    blocks = {f"field{number}": _block(np.round(255 * field.shares), np.uint8) for number, field in enumerate(frames.fields)}
    blocks["start"] = _block(frames.start, np.float32)
    blocks["displacement"] = _block(np.round(65535 * (frames.moved - low) / span), np.uint16)
    if shapes.triangles is None:
        blocks["radius"] = _block(shapes.radius, np.float32)
    else:
        blocks["cell"] = _block(shapes.cell_of_point, np.uint32)
        blocks["index"] = _block(shapes.triangles, np.uint32)
    data = {
        "kind": "points" if shapes.triangles is None else "triangles",
        "times": frames.times,
        "fields": [{"name": field.name, "unit": field.unit, "low": field.low, "high": field.high} for field in frames.fields],
        "colors": [to_hex(frames.colors(place / 255)) for place in range(256)],
        "cells": len(shapes.cells),
        "displacement": {"low": low, "high": low + span},
        "enlargements": frames.enlargements,
        "enlargement": frames.enlargements[-1],
        **frames.camera,
        "blocks": blocks,
    }
    return json.dumps(data).replace("</", "<\\/")


def viewer_script():
    """The program of the view: three.js and viewer/view.source.js in one."""
    return Path(__file__).with_name("viewer").joinpath("view.js").read_text(encoding="utf-8")


def _block(numbers, kind):
    text = base64.b64encode(zlib.compress(np.ascontiguousarray(numbers, dtype=kind).tobytes(), 6)).decode()
    return {"type": np.dtype(kind).name, "data": text}


def _of_cells(grid, name):
    """A field of the cells, of vectors the magnitude; of a field of the points its mean in each cell."""
    of_points = name not in grid.cell_data
    values = np.asarray(grid.point_data[name] if of_points else grid.cell_data[name], dtype=float)
    values = np.linalg.norm(values, axis=1) if values.ndim == 2 else values
    if not of_points:
        return values
    points, offsets = np.asarray(grid.cell_connectivity), np.asarray(grid.offset)
    return np.add.reduceat(values[points], offsets[:-1]) / np.diff(offsets)


def _range(values):
    """The colour range: from 0, or the lowest 1st percentile of any frame, to the largest 99th percentile."""
    finite = np.where(np.isfinite(values), values, 0.0)
    return float(min(np.percentile(finite, 1, axis=1).min(), 0.0)), float(np.percentile(finite, 99, axis=1).max() or finite.max())


def _bulk_range(values):
    """The colour range of stresses: from 0, or the lowest end of the bulk of any frame, to the largest one."""
    ends = [style.bulk(frame) for frame in values]
    return min(0.0, *(low for low, _ in ends)), max(high for _, high in ends)


def _chosen_times(count, bytes_each):
    """Numbers of the snapshots that are shown: all, or evenly as many as fit; the last one always."""
    most = max(int(BUDGET / bytes_each), FEWEST_TIMES)
    return np.unique(np.round(np.linspace(0, count - 1, min(count, most))).astype(int))


def _shapes(snapshots):
    grid = snapshots[0].elements
    kinds = set(np.asarray(grid.celltypes).tolist())
    if kinds == {VERTEX}:
        return _balls(grid)
    if kinds == {TETRAHEDRON}:
        return _faces_of_tetrahedra(snapshots)
    if kinds == {QUADRILATERAL}:
        corners = np.asarray(grid.cells).reshape(-1, 5)[:, 1:]
        return _triangles(grid, np.concatenate([corners[:, [0, 1, 2]], corners[:, [0, 2, 3]]]), np.tile(np.arange(grid.n_cells), 2))
    return _outside(grid)


def _balls(grid):
    every = -(-grid.n_points // MOST_POINTS) or 1
    points = np.arange(0, grid.n_points, every)
    radius = grid.cell_data["radius"] if "radius" in grid.cell_data else 0.5 * np.asarray(grid.cell_data["spacing"])
    return Shapes(points, points, None, None, np.asarray(radius)[points])


def _triangles(grid, triangles, cell_of_triangle):
    """Triangles between points of a grid, and the cell of each. Each cell has points of its own, so that none takes the colour of another."""
    own = triangles + grid.n_points * np.asarray(cell_of_triangle, dtype=np.int64)[:, None]
    pairs, places = np.unique(own, return_inverse=True)
    cells, cell_places = np.unique(pairs // grid.n_points, return_inverse=True)
    return Shapes(pairs % grid.n_points, cells, cell_places, places.reshape(-1, 3), None)


def _outside(grid):
    """The surface of a grid of any cells."""
    outside = outside_of(grid)
    return _triangles(grid, outside.corners, outside.cells)


def _faces_of_tetrahedra(snapshots):
    """The faces outside, and those of joints that are broken in the last snapshot."""
    grid = snapshots[0].elements
    tetrahedra = np.asarray(grid.cells).reshape(-1, 5)[:, 1:]
    faces = tetrahedra[:, CORNERS].reshape(-1, 3)
    owners = np.repeat(np.arange(grid.n_cells), 4)
    step = 1e-7 * np.ptp(np.asarray(grid.bounds)) or 1.0
    keys = _keys(np.asarray(grid.points)[faces], step)
    _, place, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    drawn = count[place.ravel()] == 1
    first, last = snapshots[0].joints, snapshots[-1].joints
    if first is not None and last is not None and first.n_cells == last.n_cells:
        broken = np.asarray(last.cell_data["state"]) >= 2  # broken, or sheared and pressed together
        corners = np.asarray(first.cells).reshape(-1, 4)[broken, 1:]
        open_keys = {tuple(key) for key in _keys(np.asarray(first.points)[corners], step)}
        drawn |= np.fromiter((tuple(key) in open_keys for key in keys), dtype=bool, count=len(keys))
    return _triangles(grid, faces[drawn], owners[drawn])


def _keys(corners, step):
    """Whole numbers that tell a face (n, 3 corners, 3) by its middle, to some steps [m]."""
    return np.round(corners.mean(axis=1) / step / 8).astype(np.int64)


def _enlargements(moved, start):
    """Round magnification factors up to that which makes the typical large displacement a visible share of the body."""
    large = np.percentile(np.linalg.norm(moved[-1], axis=1), 90)
    most = 0.04 * np.ptp(start, axis=0).max() / large if large > 0 else 1.0
    found = [factor * 10**power for power in range(7) for factor in (1, 2, 5)]
    return [factor for factor in found if factor <= most] or [1]


def _camera(start, end):
    """Where the view begins: onto a slab along its thin axis, a little from the side; onto a body from a corner."""
    both = np.concatenate([start, end])
    low, high = both.min(axis=0), both.max(axis=0)
    extents = high - low
    thin = int(np.argmin(extents))
    up = np.eye(3)[1 if thin == 2 else 2]
    if extents[thin] == 0.0:
        toward = np.eye(3)[thin]
    elif extents[thin] < SLAB_RATIO * np.sort(extents)[1]:
        side = np.array([0.3, 0.0, 0.0]) if thin != 0 else np.array([0.0, 0.3, 0.0])
        toward = (1.0 if thin == 2 else -1.0) * np.eye(3)[thin] + 0.25 * up + side
    else:
        toward = np.array([0.75, -1.0, 0.6])
    toward = toward / np.linalg.norm(toward)
    right = np.cross(up, toward)
    right /= np.linalg.norm(right)
    axes = np.abs(np.array([right, np.cross(toward, right)]))
    return {
        "center": list(0.5 * (low + high)), "size": float(np.linalg.norm(extents)) or 1.0,
        "up": list(up), "from": list(toward), "view": [float(length) or 1.0 for length in axes @ extents],
    }
