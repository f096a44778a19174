"""How near the corners and edges of flat convex polygons come to each other where they do not meet: the lengths that make thin elements.

Polygons are arrays (m, n, 3) of m polygons whose corners go around them; those with fewer than n corners repeat their last one.
"""

from dataclasses import dataclass

import numpy as np

TINY = 1e-12


@dataclass(frozen=True)
class Polygons:
    """Flat convex polygons."""

    corners: np.ndarray  # (m, n, 3) [m]
    normals: np.ndarray  # (m, 3)

    @classmethod
    def of(cls, rings, normals):
        """Polygons of rings of different lengths, each (k, 3)."""
        widest = max((len(ring) for ring in rings), default=3)
        padded = [np.concatenate([ring, np.repeat(ring[-1:], widest - len(ring), axis=0)]) for ring in rings]
        return cls(np.array(padded).reshape(-1, widest, 3), np.array(normals).reshape(-1, 3))

    def chosen(self, which):
        """Some of the polygons, by a mask or by numbers."""
        return Polygons(self.corners[which], self.normals[which])


def edge_gaps(one, others):
    """Least distances of the edges of one polygon (1) from those of others (m), and the places between them: (m, e), (m, e, 3), e pairs of edges each."""
    a, da = one.corners[0], np.roll(one.corners[0], -1, axis=0) - one.corners[0]
    b, db = others.corners, np.roll(others.corners, -1, axis=1) - others.corners
    gaps, places = segment_gaps(a[None, :, None], da[None, :, None], b[:, None], db[:, None])
    return gaps.reshape(len(b), -1), places.reshape(len(b), -1, 3)


def segment_gaps(p, d, q, e):
    """Least distances of segments p..p + d and q..q + e, of arrays that broadcast, and the places in the middle. Ericson (2005), section 5.1.9."""
    r = p - q
    a, ee, b = _dot(d, d), _dot(e, e), _dot(d, e)
    c, f = _dot(d, r), _dot(e, r)
    determinant = a * ee - b * b
    s = np.where(determinant > 1e-9 * a * ee, (b * f - c * ee) / np.maximum(determinant, TINY**2), 0.0).clip(0.0, 1.0)
    t = (b * s + f) / np.maximum(ee, TINY**2)
    outside = (t < 0.0) | (t > 1.0)
    t = t.clip(0.0, 1.0)
    s = np.where(outside, ((b * t - c) / np.maximum(a, TINY**2)).clip(0.0, 1.0), s)
    first, second = p + s[..., None] * d, q + t[..., None] * e
    return np.linalg.norm(first - second, axis=-1), 0.5 * (first + second)


def corner_gaps(corners, polygon):
    """Distances of corners (..., n, 3) from polygons (m) on which they stand upright, inf for others, as (m, n). `corners` is (m, n, 3) or (1, n, 3)."""
    normal, ring = polygon.normals, polygon.corners
    height = _dot(corners - ring[:, :1], normal[:, None])
    feet = corners - height[..., None] * normal[:, None]
    return np.where(_within(feet, ring, normal), np.abs(height), np.inf)


def _within(points, rings, normals):
    """Whether points (m, n, 3) in the planes of polygons (m, k, 3) lie within them, (m, n)."""
    sides = np.roll(rings, -1, axis=1) - rings
    inward = np.cross(normals[:, None], sides)
    turn = np.sign(_dot(inward, rings.mean(axis=1, keepdims=True) - rings).sum(axis=1))  # of rings that go the other way round
    return np.all(turn[:, None, None] * _dot(inward[:, None], points[:, :, None] - rings[:, None]) >= -1e-9, axis=2)


def crossings(one, others):
    """Where one polygon (1) crosses others (m): whether (m,), and the ends of the segments (m, 2, 3), on both of them."""
    line = np.cross(one.normals[0], others.normals)
    sine = np.linalg.norm(line, axis=1)
    along = line / np.maximum(sine, TINY)[:, None]
    ends = np.stack([_span(np.repeat(one.corners, len(others.corners), axis=0), others, along), _span(others.corners, one, along)])
    low, high = ends[..., 0].max(axis=0), ends[..., 1].min(axis=0)
    # A point of both planes, from which positions along their line count.
    offsets = np.stack([np.full(len(line), one.normals[0] @ one.corners[0, 0]), _dot(others.normals, others.corners[:, 0])], axis=1)
    base = (offsets[:, :1] * np.cross(others.normals, line) + offsets[:, 1:] * np.cross(line, one.normals)) / np.maximum(sine**2, TINY)[:, None]
    meets = (sine > 1e-6) & (low < high)
    low, high = np.where(meets, low, 0.0), np.where(meets, high, 0.0)
    return meets, base[:, None] + np.stack([low, high], axis=1)[..., None] * along[:, None]


def _span(rings, planes, along):
    """From where to where along their common line polygons (m, n, 3) are cut by planes (1 or m), (m, 2); an empty span where they are not."""
    height = _dot(rings - planes.corners[:, :1], planes.normals[:, None])
    after = np.roll(height, -1, axis=1)
    cut = (height > 0.0) != (after > 0.0)
    share = np.where(cut, height / np.where(cut, height - after, 1.0), 0.0)
    place = _dot(rings + share[..., None] * (np.roll(rings, -1, axis=1) - rings), along[:, None])
    return np.stack([np.where(cut, place, np.inf).min(axis=1), np.where(cut, place, -np.inf).max(axis=1)], axis=1)


def end_gaps(segments, others):
    """Distances of the ends of segments (k, 2, 3) from others (l, 2, 3), and of the ends of those from the first, with their places: (k, l, 4), (k, l, 4, 3)."""
    first, second = segments[:, None], others[None]
    gaps, places = [], []
    for points, lines in ((first, second), (second, first)):
        way = lines[..., 1, :] - lines[..., 0, :]
        for end in (0, 1):
            share = (_dot(points[..., end, :] - lines[..., 0, :], way) / np.maximum(_dot(way, way), TINY**2)).clip(0.0, 1.0)
            foot = lines[..., 0, :] + share[..., None] * way
            gaps.append(np.linalg.norm(points[..., end, :] - foot, axis=-1))
            places.append(np.broadcast_to(points[..., end, :], foot.shape))
    return np.stack(gaps, axis=-1), np.stack(places, axis=-2)


def _dot(a, b):
    return np.einsum("...i,...i->...", *np.broadcast_arrays(a, b))
