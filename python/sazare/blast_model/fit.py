"""Discs that a mesh can follow: those that come too near to others, to the surface or to a hole are moved a little, or left out."""

from dataclasses import dataclass, field, replace

import numpy as np

from sazare.blast_model.clearance import Polygons, corner_gaps, crossings, edge_gaps, end_gaps, segment_gaps
from sazare.blast_model.geometry import prism
from sazare.blast_model.joints import CORNERS
from sazare.blast_model.layout import GROWTH
from sazare.blast_model.scatter import area_inside

CLEAR = 0.2  # least distance of corners and edges that do not meet, over the size of elements there
LEAST_ANGLE = 15.0  # at which two discs, or a disc and a surface, cross [deg]
SIDE = 0.5  # wanted length of the sides of a polygon over the size of elements there
FEWEST_CORNERS = 6
ROUND_OFF, MEET = 1e-9, 1e-7  # m; segments that come nearer than the second meet
TRIES = 80  # places at which a disc is tried, of which the first few only turn its polygon
TURNS = 3
FURTHEST = 0.8  # of its own, over the size of elements there


@dataclass
class Fitted:
    """What became of discs; all in axes of the model, places by number in the list that was given."""

    discs: list = field(default_factory=list)
    kept: list[int] = field(default_factory=list)
    moved: dict = field(default_factory=dict)  # by number, how far [m]
    too_small: list[int] = field(default_factory=list)
    too_near: list[int] = field(default_factory=list)


def fitted(discs, layout):
    """Discs (in axes of the model) of which no two, and none with the rock's surface and holes, have corners or edges nearer than a fifth of an element.

    Earlier lines of a table come first, then larger discs. A disc that is in the way is tried at other places near its own, and left out where none suits.
    """
    found = Fitted()
    scene = _Scene(layout)
    for number in sorted(range(len(discs)), key=lambda i: (discs[i].line == 0, -discs[i].radius if discs[i].line == 0 else 0.0)):
        disc = _with_corners(discs[number], layout)
        if disc is None:
            found.too_small.append(number)
            continue
        placed = next((trial for trial in _trials(disc, layout) if scene.takes(trial)), None)
        if placed is None:
            found.too_near.append(number)
        else:
            found.kept.append(number)
            found.discs.append(placed)
            away = float(np.linalg.norm(placed.centre - disc.centre))
            if away > 0.0:
                found.moved[number] = away
    return found


def size_at(points, layout):
    """Size of elements at points (..., 3) [m]: it grows with the distance from the holes."""
    sizes = np.full(points.shape[:-1], layout.far)
    for hole in layout.holes:
        way = hole.toe - hole.collar
        share = ((points - hole.collar) @ way / (way @ way)).clip(0.0, 1.0)
        away = np.linalg.norm(points - hole.collar - share[..., None] * way, axis=-1) - 0.5 * hole.diameter
        sizes = np.minimum(sizes, layout.near(hole) + GROWTH * np.maximum(0.0, away))
    return sizes


def _with_corners(disc, layout):
    """The disc with as many corners as its sides bear; None where even six are too close."""
    size = float(size_at(disc.polygon(), layout).min())
    for corners in range(CORNERS, FEWEST_CORNERS - 1, -1):
        shaped = replace(disc, corners=corners)
        ring = shaped.polygon()
        side = float(np.linalg.norm(ring[1] - ring[0]))
        if side >= SIDE * size or (corners == FEWEST_CORNERS and side >= CLEAR * size):
            return shaped
    return None


def _trials(disc, layout):
    """The disc, and then it at places around its own: ever further, turned in its plane; evenly spread by Halton's sequences."""
    yield disc
    size = float(size_at(disc.centre, layout))
    for number in range(1, TRIES):
        shares = np.array([_halton(number, base) for base in (2, 3, 5, 7)])
        way = 2.0 * shares[:3] - 1.0
        # Turns alone come first: a round disc does not change by them.
        share = FURTHEST * size * max(0.0, (number - TURNS) / (TRIES - 1 - TURNS)) / max(1.0, np.linalg.norm(way))
        yield replace(disc, centre=disc.centre + share * way, turn=float(shares[3]))


def _halton(number, base):
    share, result = 1.0, 0.0
    while number:
        share /= base
        result += share * (number % base)
        number //= base
    return result


class _Scene:
    """What is in the rock already: its surface and holes first, then discs; each with the segments in which others cross it."""

    def __init__(self, layout):
        self._layout = layout
        rings = [*_outer_faces(layout), *(face for hole in layout.holes for face in _walls(hole, layout.options.around))]
        self._holes_from = len(_outer_faces(layout))  # walls of holes begin here
        self._rings, self._normals = rings, [_normal(ring) for ring in rings]
        self._fixed = len(rings)
        self._segments = [[] for _ in rings]
        self._edges = np.concatenate([_edges(ring) for ring in rings])
        self._refresh()

    def _refresh(self):
        self._all = Polygons.of(self._rings, self._normals)
        self._centres = np.array([ring.mean(axis=0) for ring in self._rings])
        self._reaches = np.array([np.linalg.norm(ring - ring.mean(axis=0), axis=1).max() for ring in self._rings])

    def takes(self, disc):
        """Whether a disc comes too near to nothing; it is in the scene then."""
        ring = disc.polygon()
        if area_inside(ring, self._layout) == 0.0:
            return False
        near = self._near(disc, ring)
        one, others = Polygons.of([ring], [disc.normal]), self._all.chosen(near)
        segments = []
        if len(near):
            if not self._clear(one, others):
                return False
            meets, ends = crossings(one, others)
            if np.any(np.abs(others.normals[meets] @ disc.normal) > np.cos(np.radians(LEAST_ANGLE))):
                return False
            segments = [(int(other), segment) for other, segment in zip(near[meets], ends[meets])]
            if not self._segments_clear(segments, ring):
                return False
        for other, segment in segments:
            self._segments[other].append(segment)
        self._rings.append(ring)
        self._normals.append(disc.normal)
        self._segments.append([segment for _, segment in segments])
        self._refresh()
        return True

    def _near(self, disc, ring):
        """Numbers of what may come nearer to a disc than a gap: by balls around both, then by the side of each other's planes on which both stand."""
        gap = CLEAR * self._layout.far
        near = np.flatnonzero(np.linalg.norm(self._centres - disc.centre, axis=1) < self._reaches + np.linalg.norm(ring[0] - disc.centre) + gap)
        corners, normals = self._all.corners[near], self._all.normals[near]
        heights = [(corners - disc.centre) @ disc.normal, np.einsum("mi,mni->mn", normals, ring[None] - corners[:, :1])]
        return near[np.all([(height.min(axis=1) < gap) & (height.max(axis=1) > -gap) for height in heights], axis=0)]

    def _clear(self, one, others):
        gaps, places = edge_gaps(one, others)
        if self._too_near(gaps, places, CLEAR * self._layout.far):
            return False
        mine = np.broadcast_to(one.corners, (len(others.corners), *one.corners.shape[1:]))
        if self._too_near(corner_gaps(one.corners, others), mine):
            return False
        repeated = Polygons(np.repeat(one.corners, len(others.corners), axis=0), np.repeat(one.normals, len(others.corners), axis=0))
        return not self._too_near(corner_gaps(others.corners, repeated), others.corners)

    def _segments_clear(self, segments, ring):
        """Whether the new segments keep clear of each other on the disc, but for those of the surface and of holes, and of older ones on what they cross."""
        lines = np.array([segment for _, segment in segments]).reshape(-1, 2, 3)
        fixed = np.array([other < self._fixed for other, _ in segments], dtype=bool)
        if self._too_near(np.linalg.norm(lines[:, 1] - lines[:, 0], axis=1), lines.mean(axis=1)):
            return False
        if not self._surface_clear([segment for other, segment in segments if other >= self._fixed]):
            return False
        if len(lines) > 1:
            gaps, places = end_gaps(lines, lines)
            paired = np.triu(np.ones((len(lines), len(lines)), dtype=bool), 1) & ~(fixed[:, None] & fixed[None])
            if self._too_near(gaps[paired], places[paired]):
                return False
            if self._thin(lines[:, None], lines[None], paired):
                return False
        for other, segment in segments:
            on_other = np.array(self._segments[other]).reshape(-1, 2, 3)
            if len(on_other) and (self._too_near(*end_gaps(segment[None], on_other)) or self._thin(segment[None], on_other)):
                return False
            if not self._holes_from <= other < self._fixed and self._thin(segment[None], _edges(self._rings[other])):
                return False
        return not len(lines) or not self._thin(lines[:, None], _edges(ring)[None])

    def _thin(self, lines, others, which=True):
        """Whether two segments (..., 2, 3) in one plane meet in the rock under a small angle, between which elements would be thin."""
        d, e = lines[..., 1, :] - lines[..., 0, :], others[..., 1, :] - others[..., 0, :]
        gaps, places = segment_gaps(lines[..., 0, :], d, others[..., 0, :], e)
        lengths = np.linalg.norm(d, axis=-1) * np.linalg.norm(e, axis=-1)
        sines = np.linalg.norm(np.cross(d, e), axis=-1) / np.maximum(lengths, ROUND_OFF**2)
        thin = (gaps < MEET) & (sines < np.sin(np.radians(LEAST_ANGLE))) & which
        return bool(np.any(self._inside(places[thin], ROUND_OFF)))

    def _surface_clear(self, lines):
        """Whether what lies in the rock of the segments of two discs is long enough, and keeps clear of the edges of the surface and of holes."""
        pieces = [_piece(line, planes) for line in lines for planes in self._layout.convex_parts]
        pieces = np.array([piece for piece in pieces if piece is not None]).reshape(-1, 2, 3)
        if len(pieces) == 0:
            return True
        if self._too_near(np.linalg.norm(pieces[:, 1] - pieces[:, 0], axis=1), pieces.mean(axis=1)):
            return False
        return not self._too_near(*end_gaps(pieces, self._edges))

    def _too_near(self, gaps, places, beyond=ROUND_OFF):
        """Whether a gap is below what the size of elements at its place wants; what lies further beyond the rock than so much [m] is cut away, and does not count."""
        close = gaps < CLEAR * self._layout.far
        gaps, places = gaps[close], places[close]
        return bool(np.any((gaps < CLEAR * size_at(places, self._layout)) & self._inside(places, beyond)))

    def _inside(self, places, beyond):
        return np.any([np.all(places @ planes[:, :3].T <= planes[:, 3] + beyond * np.linalg.norm(planes[:, :3], axis=1), axis=-1) for planes in self._layout.convex_parts], axis=0)


def _edges(ring):
    """Edges (n, 2, 3) of a polygon."""
    return np.stack([ring, np.roll(ring, -1, axis=0)], axis=1)


def _piece(line, planes):
    """What of a segment (2, 3) lies inside of planes (k, 4); None for nothing."""
    heights, low, high = line @ planes[:, :3].T - planes[:, 3], 0.0, 1.0
    for start, end in heights.T:
        if start > 0.0 and end > 0.0:
            return None
        if (start > 0.0) != (end > 0.0):
            share = start / (start - end)
            low, high = (max(low, share), high) if start > 0.0 else (low, min(high, share))
    return line[0] + np.outer([low, high], line[1] - line[0]) if low < high else None


def _outer_faces(layout):
    """Convex polygons around the rock."""
    y0, y1 = layout.lower[1], layout.upper[1]
    outline = [np.array([x, 0.0, z]) for x, z in layout.profile]
    across = [np.array([0.0, y, 0.0]) for y in (y0, y1)]
    faces = [np.array([a + across[0], b + across[0], b + across[1], a + across[1]]) for a, b in zip(outline, [*outline[1:], outline[0]])]
    parts = [outline]
    if layout.bench:  # the side of a bench, which is not convex, as two
        start, end, floor, toe, crest, back = outline
        behind = np.array([back[0], 0.0, toe[2]])
        parts = [[start, end, floor, toe, behind], [behind, toe, crest, back]]
    return faces + [np.array(part) + y for part in parts for y in across]


def _walls(hole, around):
    """The sides and the toe of the prism of a hole, to the surface."""
    ring, way = prism(hole, around)
    top = ring + way * (-ring[:, 2] / way[2])[:, None]
    sides = [np.array([ring[i - 1], ring[i], top[i], top[i - 1]]) for i in range(around)]
    return [*sides, ring]


def _normal(ring):
    normal = np.cross(ring[1] - ring[0], ring[2] - ring[0])
    return normal / np.linalg.norm(normal)
