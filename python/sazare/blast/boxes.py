"""The sieve size of a fragment: the smallest square opening that its smallest box passes."""

import numpy as np
from scipy.spatial import ConvexHull

ALIKE = 1e-6  # normals of faces that differ by less count as one
SQUARE_ROOT_OF_2 = np.sqrt(2.0)


def smallest_box(points):
    """Edges (3,) of the smallest box that holds some points (n, 3) [m], the longest first.

    The box with the least volume of those that have a side in a face of the points' convex hull, and an edge along an edge of what is seen of the hull
    along that face's normal: exact for prisms, and for other bodies a little larger than the least of all boxes, no side of which need lie in a
    face (O'Rourke, 1985, Finding minimal enclosing boxes, Int. J. Comput. Inf. Sci. 14, 183-199). Raises ValueError where the points lie in a plane.
    """
    points = np.asarray(points, dtype=float)
    points = points - points.mean(axis=0)
    scale = np.abs(points).max(initial=0.0)
    if len(points) < 4 or scale == 0.0 or np.linalg.svd(points, compute_uv=False)[2] < 1e-9 * scale:
        raise ValueError("these points lie in a plane and have no box")
    hull = ConvexHull(points / scale)
    corners = hull.points[hull.vertices]
    normals = hull.equations[:, :3]
    rounded = np.round(np.where(_turned(normals)[:, None], -normals, normals) / ALIKE)
    _, different = np.unique(rounded, axis=0, return_index=True)
    boxes = np.array([_box_along(corners, normal) for normal in normals[different]])
    return np.sort(boxes[np.argmin(boxes.prod(axis=1))])[::-1] * scale


def _turned(normals):
    """Which of the normals (n, 3) point against the one that stands for both directions."""
    signs = np.sign(np.round(normals / ALIKE))
    first = np.argmax(signs != 0.0, axis=1)
    return signs[np.arange(len(signs)), first] < 0.0


def _box_along(corners, normal):
    """Edges (3,) of the smallest box of corners (n, 3) with a side across a unit normal (3,)."""
    right = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    right /= np.linalg.norm(right)
    seen = np.stack([corners @ right, corners @ np.cross(normal, right)], axis=1)
    outline = seen[ConvexHull(seen).vertices]
    edges = np.roll(outline, -1, axis=0) - outline
    along = edges / np.linalg.norm(edges, axis=1)[:, None]
    across = np.stack([-along[:, 1], along[:, 0]], axis=1)
    widths = np.stack([np.ptp(outline @ along.T, axis=0), np.ptp(outline @ across.T, axis=0)], axis=1)
    return np.array([*widths[np.argmin(widths.prod(axis=1))], np.ptp(corners @ normal)])


def opening(box):
    """The side [m] of the smallest square opening that a box (3,) [m] passes lengthwise: its middle edge, or less where the box is so flat that it
    passes with its section along the diagonal of the square."""
    _, middle, short = np.sort(np.asarray(box, dtype=float))[::-1]
    return float(min(middle, (middle + short) / SQUARE_ROOT_OF_2))


def sieve_size(points):
    """The sieve size [m] of a fragment by its corners (n, 3) [m]: the side of the smallest square opening that its smallest box passes.

    The size by which sieves sort aggregate is that of the smallest square opening that a particle passes (Mathematical Problems in Engineering 2021,
    6659285); the box makes it a little too large for fragments whose corners are cut off.
    """
    return opening(smallest_box(points))
