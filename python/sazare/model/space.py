"""The picture of a model in space: seen from a corner, and through the body where surfaces of it have conditions."""

from dataclasses import dataclass, replace

import numpy as np
import pyvista
from matplotlib.ticker import MaxNLocator

from sazare import scenes, style
from sazare.model import sheet
from sazare.model.parts import BODY, BOUNDARY, INSIDE, WALL
from sazare.scenes import Layer

PIXELS = 1500
MARGINS = np.array([[-0.14, -0.13], [0.12, 0.04]])  # of the larger side, for the numbers along the edges and for names
OUTSIDE = "from outside"
# From the body to the eye, by the axis that leads up, and the signs with which it may be taken: the usual ones first.
TOWARD = {2: np.array([0.55, -1.0, 0.55]), 1: np.array([0.55, 0.55, 1.0])}
SIGNS = {2: np.array([[1, 1, 1], [-1, 1, 1], [1, -1, 1], [-1, -1, 1]]), 1: np.array([[1, 1, 1], [-1, 1, 1], [1, 1, -1], [-1, 1, -1]])}
SHORT = 0.12  # of the picture; an edge under it has numbers at its ends alone
SLAB = 0.35  # a body is a slab where its smallest extent is under this part of the next one
SHEER, SEEN_THROUGH = 0.55, 0.25  # how opaque conditions are on a body that is not seen through, and on one that is
MOST_EDGES = 40000  # elements whose edges are drawn
FINE_BELOW = 3000  # balls; more of them are drawn with fewer faces
MATT = {"ambient": 0.36, "diffuse": 0.74, "specular": 0.0}  # light that leaves a colour as it is in the legend
LIFT = 2e-3  # of the extent, by which conditions stand out of the body


@dataclass(frozen=True)
class View:
    """Looks at a box (2, 3) [m] in parallel projection; `right` and `up` (3,) are the axes of the picture."""

    box: np.ndarray
    right: np.ndarray
    up: np.ndarray

    @property
    def toward(self):
        """From the body to the eye (3,)."""
        return np.cross(self.right, self.up)

    @property
    def corners(self):
        """The corners of the box (8, 3) [m]."""
        return np.array([[self.box[i, 0], self.box[j, 1], self.box[k, 2]] for i in (0, 1) for j in (0, 1) for k in (0, 1)])

    def place(self, points):
        """Where points (n, 3) stand in the picture (n, 2) [m]."""
        return points @ np.array([self.right, self.up]).T

    @property
    def window(self):
        """Lower and upper corner of the picture (2, 2) [m]."""
        seen = self.place(self.corners)
        low, high = seen.min(axis=0), seen.max(axis=0)
        return np.array([low, high]) + MARGINS * (high - low).max()

    @property
    def size(self):
        """Width and height in pixels."""
        width, height = np.ptp(self.window, axis=0)
        return int(PIXELS * width / max(width, height)), int(PIXELS * height / max(width, height))

    def aim(self, plotter):
        """Points the camera."""
        middle = self.window.mean(axis=0)
        depth = self.box.mean(axis=0) @ self.toward
        focus = middle[0] * self.right + middle[1] * self.up + depth * self.toward
        distance = 5.0 * np.linalg.norm(np.ptp(self.box, axis=0))
        plotter.camera.position = focus + distance * self.toward
        plotter.camera.focal_point = focus
        plotter.camera.up = self.up
        plotter.camera.clipping_range = (0.01 * distance, 3.0 * distance)
        plotter.enable_parallel_projection()
        plotter.camera.parallel_scale = 0.5 * np.ptp(self.window, axis=0)[1]

    def picture(self, image):
        """The image as it is."""
        return image


def _corner_view(box, model):
    """From above and from the corner at which most of the outside is free; of equal ones from the front. Without gravity y may lead up as well as z, where the method leaves it open."""
    areas, outward = _held_faces(model, box.mean(axis=0))
    either = [2, 1] if model.up is None else [model.up]
    ways = [(vertical, sign * TOWARD[vertical]) for vertical in (either if model.gravity is None else [_vertical(model.gravity)]) for sign in SIGNS[vertical]]
    held = np.array([areas @ np.maximum(outward @ toward, 0.0) for _, toward in ways])
    vertical, toward = ways[int(np.argmin(np.round(held / max(held.max(), 1e-30), 1)))]
    toward = toward / np.linalg.norm(toward)
    right = np.cross(np.eye(3)[vertical], toward)
    right = right / np.linalg.norm(right)
    return View(box, right, np.cross(toward, right))


def _held_faces(model, center):
    """The areas [m2] (n,) and the normals out of the body (n, 3) of faces with conditions."""
    faces = [face for part in model.parts if part.role == BOUNDARY for face in part.faces]
    if not faces:
        return np.zeros(0), np.zeros((0, 3))
    normals = np.array([0.5 * np.cross(face[1] - face[0], face[-1] - face[0]) for face in faces])
    areas = np.linalg.norm(normals, axis=1)
    normals = normals / np.maximum(areas, 1e-300)[:, None]
    away = np.array([np.mean(face, axis=0) for face in faces]) - center
    return areas, normals * np.where(np.sum(normals * away, axis=1) < 0.0, -1.0, 1.0)[:, None]


def _slab_view(box, thin):
    """Along the thin axis of a slab."""
    right, up = {0: (1, 2), 1: (0, 2), 2: (0, 1)}[thin]
    return View(box, np.eye(3)[right], np.eye(3)[up])


def _vertical(gravity):
    """The axis that leads up: that of gravity, where there is one in y; else z."""
    return 1 if gravity is not None and int(np.argmax(np.abs(gravity))) == 1 else 2


def _views(model, box):
    """The views of a model, each with its title and whether the body is seen through."""
    corner = _corner_view(box, model)
    if not any(part.role not in (BODY, WALL) for part in model.parts):
        return [(corner, "", False)]
    body = np.concatenate([part.corners for part in model.parts if part.role == BODY])
    extents = np.ptp(body, axis=0)
    thin = int(np.argmin(extents))
    lies = model.gravity is not None and thin == _vertical(model.gravity)  # seen along gravity, things would stand on it
    if extents[thin] < SLAB * np.sort(extents)[1] and not lies:
        return [(_slab_view(box, thin), f"seen along {'xyz'[thin]}", False), (corner, "through the body", True)]
    return [(corner, OUTSIDE, False), (corner, "through the body", True)]


@style.styled
def draw(model, title):
    """A matplotlib Figure."""
    corners = np.concatenate([part.corners for part in model.parts])
    box = np.array([corners.min(axis=0), corners.max(axis=0)])
    views = _views(model, box)
    width = sheet.WIDTH + 2.0 if len(views) > 1 else sheet.WIDTH
    share = max(view.size[1] / view.size[0] for view, _, _ in views)
    figure = style.figure(width, min(0.93 * width / len(views) * share, 7.5) + 1.1 + 0.14 * (len(model.parts) + 1))
    *panels, corner = figure.subplots(1, len(views) + 1, width_ratios=[20 / len(views)] * len(views) + [1])
    for axes, (view, words, through) in zip(panels, views):
        _draw_view(axes, view, model, through)
        axes.set_title(words)
    sheet.draw_gravity(corner, model.gravity, views[-1][0].place)
    sheet.write_words(figure, title, model)
    sheet.write_legend(figure, model)
    # The names last: they need the places of all axes. From outside, what they name is hidden.
    for axes, (view, words, _) in zip(panels, views):
        hides = words == OUTSIDE
        shown = replace(model, gauges=[]) if hides else model
        sheet.draw_marks(axes, shown, view.place, float(np.ptp(view.window, axis=0).max()), pieces=not hides)
    return figure


def _draw_view(axes, view, model, through):
    (left, bottom), (right, top) = view.window
    axes.imshow(scenes.render(view, _layers(view, model, through)), extent=(left, right, bottom, top), interpolation="antialiased")
    axes.set(xlim=(left, right), ylim=(bottom, top))
    axes.set_axis_off()
    axes.set_anchor("N")
    axes.grid(False)
    _draw_ruler(axes, view)


def _layers(view, model, through):
    """What is rendered of each part."""
    lift = LIFT * np.linalg.norm(np.ptp(view.box, axis=0)) * view.toward
    layers = []
    for part in model.parts:
        for mesh in _meshes(part):
            layers += _body_layers(part, mesh, through, model.crowd < MOST_EDGES) if part.role == BODY else _other_layers(part, mesh, through, lift)
    return layers


def _body_layers(part, mesh, through, has_edges):
    if not through or part.radii is not None:
        edges = part.radii is None and has_edges
        return [Layer(mesh, {"color": part.color, "show_edges": edges, "edge_color": "#777777", "line_width": 0.6, **MATT})]
    outline = _outline(mesh)
    return [
        Layer(mesh, {"color": part.color, "opacity": 0.09, "show_edges": False}),
        Layer(outline, {"color": "#555555", "line_width": 2.0, "lighting": False}),
    ]


def _other_layers(part, mesh, through, lift):
    """Walls and conditions let others show through, loads do not."""
    if part.role == WALL:
        return [
            Layer(mesh, {"color": part.color, "opacity": 0.1, "show_edges": False, "lighting": False}),
            Layer(_outline(mesh), {"color": part.color, "line_width": 2.0, "lighting": False, "opacity": 0.8}),
        ]
    raised = mesh.translate(lift, inplace=False)
    solid = {"color": part.color, "lighting": False, "line_width": 6.0, "point_size": 10.0, "opacity": 1.0}
    if part.role in (BOUNDARY, INSIDE):
        solid["opacity"] = SEEN_THROUGH if through else SHEER
    borders = raised.extract_feature_edges(boundary_edges=True, feature_edges=False, non_manifold_edges=False, manifold_edges=False)
    return [Layer(raised, solid), Layer(borders, {"color": part.color, "line_width": 5.0, "lighting": False})]


def _outline(mesh):
    """The sharp edges of a surface."""
    return mesh.clean().extract_feature_edges(25.0, boundary_edges=True, non_manifold_edges=False, manifold_edges=False)


def _meshes(part):
    """The faces, lines, points and balls of a part as surfaces of pyvista."""
    if len(part.faces):
        counts = [len(face) for face in part.faces]
        starts = np.concatenate([[0], np.cumsum(counts)[:-1]])
        cells = np.concatenate([[count, *range(start, start + count)] for start, count in zip(starts, counts)])
        yield pyvista.PolyData(np.concatenate([np.reshape(face, (-1, 3)) for face in part.faces]).astype(float), cells).clean()
    if len(part.lines):
        ends = np.arange(2 * len(part.lines)).reshape(-1, 2)
        yield pyvista.PolyData(np.reshape(part.lines, (-1, 3)).astype(float), lines=np.insert(ends, 0, 2, axis=1).ravel())
    if len(part.points):
        cloud = pyvista.PolyData(np.reshape(part.points, (-1, 3)).astype(float))
        yield cloud if part.radii is None else _balls(cloud, np.asarray(part.radii))


def _balls(cloud, radii):
    cloud.point_data["radius"] = radii
    corners = 16 if len(radii) < FINE_BELOW else 8
    return cloud.glyph(geom=pyvista.Sphere(radius=1.0, theta_resolution=corners, phi_resolution=corners), scale="radius", orient=False)


def _draw_ruler(axes, view):
    """Numbers along three edges of the box, each the outermost one of its direction."""
    factor, unit = sheet.length_unit(float(np.ptp(view.box, axis=0).max()))
    middle = view.place(view.box.mean(axis=0)[None, :])[0]
    for axis in range(3):
        start, end = _ruler_edge(view, axis)
        first, last = view.place(np.array([start, end]))
        if np.linalg.norm(last - first) < 0.05 * np.ptp(view.window, axis=0).max():
            continue
        axes.plot([first[0], last[0]], [first[1], last[1]], color="#8a8a8a", linewidth=0.8, zorder=10)
        away = _away(first, last, middle)
        length = 0.012 * np.ptp(view.window, axis=0).max()
        for value in _numbers(start[axis] / factor, end[axis] / factor, np.linalg.norm(last - first) / np.ptp(view.window, axis=0).max()):
            point = np.array(start)
            point[axis] = value * factor
            spot = view.place(point[None, :])[0]
            tick = spot + length * away
            axes.plot([spot[0], tick[0]], [spot[1], tick[1]], color="#8a8a8a", linewidth=0.8, zorder=10)
            axes.text(*(spot + 1.5 * length * away), f"{value:.4g}".replace("-", "−"), fontsize=7.5, color="#555555", zorder=11, **_beside(away))
        axes.text(*(0.5 * (first + last) + (9.0 if abs(away[0]) > 0.7 else 7.0) * length * away), f"{'xyz'[axis]} [{unit}]", fontsize=8.5, color=style.INK, ha="center", va="center", zorder=11)


def _beside(away):
    """How a number stands at the end of its tick."""
    across = "right" if away[0] < -0.2 else "left" if away[0] > 0.2 else "center"
    return {"ha": across, "va": "top" if away[1] < -0.5 else "center"}


def _numbers(low, high, share):
    """Round numbers between two ends, fewer where the edge is short in the picture; of a very short one its ends."""
    if share < SHORT:
        return [round(float(end), 12) for end in (low, high)]
    numbers = MaxNLocator(max(int(9 * share), 2), steps=[1, 2, 5, 10]).tick_values(low, high)
    inside = 1e-9 * (high - low)
    return [round(float(value), 12) for value in numbers if low - inside <= value <= high + inside]


def _ruler_edge(view, axis):
    """The edge of the box along an axis that lies outermost in the picture: lowest for level ones, leftmost for the vertical one."""
    others = [other for other in range(3) if other != axis]
    ends = []
    for i in (0, 1):
        for j in (0, 1):
            start = np.zeros(3)
            start[others[0]], start[others[1]] = view.box[i, others[0]], view.box[j, others[1]]
            start[axis] = view.box[0, axis]
            end = start.copy()
            end[axis] = view.box[1, axis]
            ends.append((start, end))
    way = np.abs(view.place(np.eye(3)[[axis]])[0])
    across = 0 if way[1] > 2.0 * way[0] else 1
    # Where edges cover each other, the one nearest to the eye is taken.
    return min(ends, key=lambda edge: (round(float(view.place(np.mean(edge, axis=0)[None, :])[0][across]), 9), -float(np.mean(edge, axis=0) @ view.toward)))


def _away(first, last, middle):
    """Across an edge, away from the body (2,)."""
    way = (last - first) / np.linalg.norm(last - first)
    away = np.array([-way[1], way[0]])
    return away if away @ (0.5 * (first + last) - middle) >= 0.0 else -away
