"""Rock that has come loose behind the line of holes and beside the outermost ones, by depth."""

from dataclasses import dataclass

import numpy as np

from sazare.blast.holes import holes_of
from sazare.muck_pile.elements import FACES, outer_faces
from sazare.muck_pile.heights import axes_of

LEVELS = 10  # from the top of the loose rock to the toes of the holes


@dataclass(frozen=True)
class BackBreak:
    """Between two heights [m]: how far behind the line of holes loose rock reached, and how far beside the outermost holes on the left and on the right of
    the throw [m]; 0 where none did, and the volume [m3] of what came loose behind the line."""

    lower: float
    upper: float
    behind: float
    left: float
    right: float
    volume: float


@dataclass(frozen=True)
class AtEdge:
    """Whether rock came loose up to the side of the model behind the line of holes, and beside the outermost ones on the left and on the right of the throw: how far
    it would break beyond nobody knows then."""

    behind: bool
    left: bool
    right: bool


def at_edge_of(results, model):
    """The AtEdge of a model; None where the run has no holes.

    The sides are the outer faces of the model before the blast that stand steeper than 45 degrees, each behind, ahead, left or right of the throw as its normal points;
    rock reaches one where an element has a corner on it.
    """
    holes = holes_of(results)
    if not holes:
        return None
    line, across, _ = _lines(holes, model)
    elements, axes = model.elements, axes_of(model.direction)
    loose = ~elements.stays
    flat = elements.start @ axes
    middle = elements.start.mean(axis=1) @ axes
    within = (middle[:, 1] >= across.min()) & (middle[:, 1] <= across.max()) if len(holes) > 1 else np.ones(len(middle), dtype=bool)
    on_side = _corners_on_sides(elements, axes)
    ahead = middle[:, 0] >= line
    found = ((~ahead & within, line - flat[:, :, 0]), (ahead, flat[:, :, 1] - across.max()), (ahead, across.min() - flat[:, :, 1]))
    return AtEdge(*(bool(np.any((loose & where)[:, None] & side & (beyond > 0.0))) for (where, beyond), side in zip(found, on_side)))


def _corners_on_sides(elements, axes):
    """Which corners (n, 4) of elements lie on the sides of the model behind, left and right of the throw (list of three)."""
    sides = elements.start[:, FACES]
    normals = np.cross(sides[:, :, 1] - sides[:, :, 0], sides[:, :, 2] - sides[:, :, 0])
    volumes = np.linalg.det(elements.start[:, 1:] - elements.start[:, :1])
    normals = normals * np.sign(volumes)[:, None, None]
    steep = outer_faces(elements.nodes) & (np.abs(normals[:, :, 2]) < np.linalg.norm(normals[:, :, :2], axis=2))
    flat = normals @ axes
    points = [(-flat[:, :, 0], np.abs(flat[:, :, 1])), (flat[:, :, 1], np.abs(flat[:, :, 0])), (-flat[:, :, 1], np.abs(flat[:, :, 0]))]
    return [np.isin(elements.nodes, elements.nodes[:, FACES][steep & (own >= other)]) for own, other in points]


def _lines(holes, model):
    """Where the rearmost hole is along the throw [m], where the holes are across it (k,), and the heights of their ends (k, 2) [m]."""
    ends = np.array([[hole.first, hole.last] for hole in holes])
    flat = ends @ axes_of(model.direction)
    return flat[:, :, 0].min(), flat[:, :, 1].mean(axis=1), ends[:, :, 2]


def back_breaks(results, model):
    """The BackBreaks from the top of the loose rock to the toes of the holes, highest first; none where the run has no holes.

    Elements count where they stood before the blast, by their farthest corner, in the level of their centre: those between the outermost holes for what is
    behind, those in front of the line for what is beside. Rock that is loose but lies where it was, counts as well, such as what
    is taken as rock that stays since it lies under the ground.
    """
    holes = holes_of(results)
    if not holes:
        return []
    axes = axes_of(model.direction)
    line, across, heights = _lines(holes, model)
    loose = ~model.elements.stays
    start = model.elements.start[loose]
    corners, middle, level = start @ axes, start.mean(axis=1) @ axes, start.mean(axis=1)[:, 2]
    volumes = model.elements.volumes[loose]
    edges = np.linspace(max(heights.max(), start[:, :, 2].max()), heights.min(), LEVELS + 1)  # holes are known where they are charged
    between = (middle[:, 1] >= across.min()) & (middle[:, 1] <= across.max()) if len(holes) > 1 else np.ones(len(middle), dtype=bool)
    back, ahead = middle[:, 0] < line, middle[:, 0] >= line
    found = []
    for upper, lower in zip(edges[:-1], edges[1:]):
        here = (level <= upper) & (level > lower)
        found.append(
            BackBreak(
                float(lower), float(upper), _most(line - corners[here & back & between, :, 0]), _most(corners[here & ahead, :, 1] - across.max()),
                _most(across.min() - corners[here & ahead, :, 1]), float(volumes[here & back & between].sum()),
            )
        )
    return found


def _most(distances):
    return float(np.maximum(distances, 0.0).max(initial=0.0))
