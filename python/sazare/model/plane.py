"""The picture of a model in the plane, x to the right and y up."""

import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection, PolyCollection

from sazare import style
from sazare.model import sheet
from sazare.model.parts import BODY, BOUNDARY, LOAD, WALL

MARGIN = 0.07
TALLEST, FLATTEST = 6.5, 1.6  # height of the axes [inch]
MOST_EDGES = 4000  # elements; of more of them the edges would cover the colours
ORDER = {BODY: 1, WALL: 3, BOUNDARY: 4, LOAD: 5}


@style.styled
def draw(model, title):
    """A matplotlib Figure."""
    low, high = _window(model)
    factor, unit = sheet.length_unit(float((high - low).max()))
    low, high = low / factor, high / factor
    height = np.clip(0.82 * sheet.WIDTH * (high[1] - low[1]) / (high[0] - low[0]), FLATTEST, TALLEST)
    figure = style.figure(sheet.WIDTH, float(height) + 1.1 + 0.14 * (len(model.parts) + 1))
    axes, corner = figure.subplots(1, 2, width_ratios=(20, 1))
    for part in model.parts:
        _draw_part(axes, part, factor, model.crowd < MOST_EDGES)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal", xlabel=f"x [{unit}]", ylabel=f"y [{unit}]")
    axes.grid(False)

    def place(points):
        return points[:, :2] / factor

    sheet.draw_gravity(corner, model.gravity, lambda points: points[:, :2])
    sheet.write_words(figure, title, model)
    sheet.write_legend(figure, model)
    sheet.draw_marks(axes, model, place, float((high - low).max()))
    return figure


def _window(model):
    """Lower and upper corner (2,) [m] that hold the body, its gauges and arrows, and of each wall what is nearest."""
    low, high = model.box[:, :2]
    found = [low, high, *(np.asarray(gauge.point)[:2] for gauge in model.gauges)]
    reach = sheet.ARROW * (high - low).max()
    for arrow in model.arrows:
        way = np.asarray(arrow.direction, dtype=float)[:2]
        way = reach * way / max(np.linalg.norm(way), 1e-30)
        found.append(np.asarray(arrow.point)[:2] + (-way if arrow.ends else way))
    for part in model.parts:
        if part.role == WALL:
            found += [_nearest(first[:2], last[:2], 0.5 * (low + high)) for first, last in _edges(part)]
            found += list(np.reshape(part.corners[len(np.reshape(part.lines, (-1, 3))):], (-1, 3))[:, :2]) if part.radii is not None else []
    low, high = np.min(found, axis=0), np.max(found, axis=0)
    margin = MARGIN * max((high - low).max(), 1e-9)
    return low - margin, high + margin


def _edges(part):
    """The lines of a part and the edges of its faces, as pairs of ends."""
    for face in part.faces:
        yield from zip(face, np.roll(face, -1, axis=0))
    yield from np.reshape(part.lines, (-1, 2, 3))


def _nearest(first, last, point):
    """The point of a line between two ends that is nearest to a point."""
    way = last - first
    share = np.clip(((point - first) @ way) / max(way @ way, 1e-300), 0.0, 1.0)
    return first + share * way


def _draw_part(axes, part, factor, has_edges):
    order = ORDER[part.role]
    if len(part.faces):
        outlines = [np.asarray(face)[:, :2] / factor for face in part.faces]
        axes.add_collection(PolyCollection(outlines, zorder=order, label=part.label, **_fill(part, has_edges)))
    if len(part.lines):
        lines = np.asarray(part.lines)[:, :, :2] / factor
        width = 2.2 if part.role == WALL else 3.5
        axes.add_collection(LineCollection(lines, colors=part.color, linewidths=width, zorder=order, capstyle="round", label=part.label))
    if len(part.points):
        _draw_points(axes, part, factor, order, has_edges)


def _fill(part, has_edges):
    """How outlines are filled: bodies with fine edges, walls with their edges alone, conditions plainly."""
    if part.role == WALL:
        return {"facecolors": "none", "edgecolors": part.color, "linewidths": 1.8}
    edge = 0.35 if part.role == BODY and has_edges else 0.0
    return {"facecolors": part.color, "edgecolors": "#00000066" if edge else "face", "linewidths": edge}


def _draw_points(axes, part, factor, order, has_edges):
    """Balls seen along z, the nearest on top, or points as small squares."""
    points = np.asarray(part.points) / factor
    if part.radii is None:
        axes.plot(points[:, 0], points[:, 1], "s", color=part.color, markersize=5, zorder=order + 0.5, label=part.label)
        return
    deep = np.argsort(points[:, 2])
    widths = 2.0 * np.asarray(part.radii)[deep] / factor
    axes.add_collection(EllipseCollection(
        widths, widths, np.zeros(len(widths)), units="xy", offsets=points[deep, :2], transOffset=axes.transData, facecolors=part.color,
        edgecolors="#00000088", linewidths=0.4 if has_edges else 0.0, zorder=order, label=part.label,
    ))
