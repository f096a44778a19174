"""Solids of flat faces as closed surfaces: unions of convex bodies, their volume, and files of triangles."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import ConvexHull, cKDTree

TOLERANCE = 1e-9  # of the size of a solid: points nearer than this are one, and points nearer to a plane lie on it


@dataclass(frozen=True)
class Solid:
    """A closed surface. points (n, 3) [m]; triangles (m, 3), numbers of points, counter-clockwise as seen from outside."""

    points: np.ndarray
    triangles: np.ndarray

    @property
    def corners(self):
        """Corners of the triangles (m, 3, 3) [m]."""
        return self.points[self.triangles]

    @property
    def volume(self):
        """Volume within [m3], by the divergence theorem."""
        a, b, c = self.corners.transpose(1, 0, 2)
        return float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6.0)

    @property
    def open_edges(self):
        """How many edges do not belong to two triangles that pass it in opposite senses."""
        edges = np.concatenate([self.triangles[:, [0, 1]], self.triangles[:, [1, 2]], self.triangles[:, [2, 0]]])
        sorted_, sense = np.sort(edges, axis=1), np.where(edges[:, 0] < edges[:, 1], 1, -1)
        _, where, count = np.unique(sorted_, axis=0, return_inverse=True, return_counts=True)
        return int(np.sum((count != 2) | (np.bincount(where.ravel(), sense) != 0)))

    def scaled(self, factor):
        """The same solid, its lengths times a factor."""
        return Solid(factor * self.points, self.triangles)

    @property
    def mean_half_width(self):
        """Mean distance from the centre of the corners to a plane that touches the solid, over all directions of the plane [m]."""
        number = np.arange(2000) + 0.5  # directions on a spiral around the sphere
        polar, turn = np.arccos(1.0 - number / 1000.0), np.pi * (1.0 + 5.0**0.5) * number
        directions = np.array([np.cos(turn) * np.sin(polar), np.sin(turn) * np.sin(polar), np.cos(polar)])
        return float(np.mean(np.ptp(self.points @ directions, axis=0)) / 2.0)


class Convex:
    """The convex hull of points (n, 3): its triangles (m, 3, 3) with their outer side, and its planes, normal (k, 3) and distance (k,)."""

    def __init__(self, points):
        points = np.asarray(points, float)
        hull = ConvexHull(points)
        normals = hull.equations[:, :3]
        triangles = points[hull.simplices]
        turned = np.einsum("ij,ij->i", np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), normals) < 0
        triangles[turned] = triangles[turned][:, ::-1]
        self.triangles, self.size = triangles, float(np.ptp(points, axis=0).max())
        planes = np.unique(np.round(hull.equations, 9), axis=0, return_index=True)[1]
        self.normals, self.distances = normals[planes], -hull.equations[planes, 3]

    def outside(self, polygon, keep_shared):
        """What of a convex polygon (n, 3) lies outside, as polygons; what lies in a face of this body counts as outside where `keep_shared`."""
        rest, pieces, shared, near = polygon, [], False, TOLERANCE * self.size
        across = np.cross(polygon[1] - polygon[0], polygon[2] - polygon[0])
        for normal, distance in zip(self.normals, self.distances):
            height = rest @ normal - distance
            if np.all(height < near):
                shared |= bool(np.all(height > -near)) and across @ normal > 0
                continue
            if np.all(height > -near):
                return [polygon]
            pieces.append(_part(rest, height, near))
            rest = _part(rest, -height, near)
        return [polygon] if shared and keep_shared else pieces


def _part(polygon, height, near):
    """The part of a convex polygon where the heights of its corners above a plane are positive; what lies in the plane belongs to it."""
    corners = []
    for number in range(len(polygon)):
        one, two = height[number - 1], height[number]
        if max(one, two) > near and min(one, two) < -near:
            corners.append(polygon[number - 1] + (polygon[number] - polygon[number - 1]) * (one / (one - two)))
        if two > -near:
            corners.append(polygon[number])
    return np.array(corners)


def union(bodies):
    """The Solid that is the union of Convex bodies, which overlap or share faces that look the same way, and do not merely touch."""
    polygons = []
    for number, body in enumerate(bodies):
        for triangle in body.triangles:
            pieces = [triangle]
            for other, another in enumerate(bodies):
                if other != number:
                    pieces = [part for piece in pieces for part in another.outside(piece, number < other)]
            polygons += pieces
    return _joined(polygons, TOLERANCE * max(body.size for body in bodies))


def _joined(polygons, near):
    """A Solid of convex polygons that cover a surface: corners that lie on the edge of another polygon become corners of it."""
    every = np.concatenate(polygons)
    groups = cKDTree(every).query_ball_point(every, 10.0 * near)
    first = np.array([min(group) for group in groups])
    kept, number = np.unique(first, return_inverse=True)
    points = every[kept]
    tree, numbers, start = cKDTree(points), [], 0
    for polygon in polygons:
        corners = number[start : start + len(polygon)]
        start += len(polygon)
        ring = [one for place, one in enumerate(corners) if one != corners[place - 1]]
        if len(ring) > 2:
            numbers.append(_with_points_between(ring, points, tree, 10.0 * near))
    return _triangulated(numbers, points)


def _with_points_between(ring, points, tree, near):
    """A ring of numbers of points, with those that lie on its edges."""
    full = []
    for place, end in enumerate(ring):
        start = ring[place - 1]
        way = points[end] - points[start]
        length = np.linalg.norm(way)
        found = np.array(tree.query_ball_point((points[start] + points[end]) / 2.0, length / 2.0 + near))
        share = (points[found] - points[start]) @ way / length**2
        off = np.linalg.norm(points[found] - points[start] - share[:, None] * way, axis=1)
        between = (off < near) & (share * length > near) & (share * length < length - near)
        full += [*found[between][np.argsort(share[between])].tolist(), end]
    return full


def _triangulated(rings, points):
    """Triangles of convex rings; those with more than three corners get one in their middle, since corners may stand in a row."""
    points, triangles = list(points), []
    for ring in rings:
        if len(ring) == 3:
            triangles.append(ring)
            continue
        points.append(np.mean([points[one] for one in ring], axis=0))
        triangles += [[ring[place - 1], one, len(points) - 1] for place, one in enumerate(ring)]
    used, numbers = np.unique(np.array(triangles), return_inverse=True)
    return Solid(np.array(points)[used], numbers.reshape(-1, 3))


def write_stl(solid, path):
    """Writes a Solid as text; every corner has the same digits in all its triangles."""
    lines = ["solid unit"]
    for corners in solid.corners:
        lines += ["facet normal 0 0 0", "outer loop", *(f"vertex {x:.8g} {y:.8g} {z:.8g}" for x, y, z in corners.tolist()), "endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid unit", ""]), encoding="ascii")


def read_stl(path):
    """The Solid of a file of triangles, text or binary. Raises ValueError where it is no closed surface with the outside out."""
    if not path.is_file():
        raise ValueError(f"{path}: no such file: the surface of a rock is an .stl")
    data = path.read_bytes()
    if len(data) >= 84 and len(data) == 84 + 50 * int.from_bytes(data[80:84], "little"):
        corners = np.frombuffer(data, np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("rest", "<u2")]), offset=84)["corners"].astype(float)
    else:
        words = data.decode("ascii", "replace").split()
        try:
            corners = np.array([[float(word) for word in words[place + 1 : place + 4]] for place, word in enumerate(words) if word == "vertex"]).reshape(-1, 3, 3)
        except ValueError:
            raise ValueError(f"{path}: no file of triangles: an .stl has three numbers after each word vertex, and three of them in a triangle") from None
    if len(corners) < 4 or not np.all(np.isfinite(corners)):
        raise ValueError(f"{path}: no file of triangles: an .stl of four triangles or more is wanted")
    points, triangles = np.unique(corners.reshape(-1, 3), axis=0, return_inverse=True)
    solid = Solid(points, triangles.reshape(-1, 3))
    if solid.open_edges:
        raise ValueError(
            f"{path}: the surface is not closed: {solid.open_edges} edges do not belong to two triangles with the same side out; "
            "programs that mend meshes close holes and unify normals"
        )
    if solid.volume <= 0.0:
        raise ValueError(f"{path}: the surface is inside out: turn its triangles round, as programs that mend meshes do")
    return solid
