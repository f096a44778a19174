"""What pictures in the plane and in space have alike: the unit of lengths, the legend, gauges, arrows, gravity, the words above."""

import textwrap

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from sazare import style
from sazare.model.labels import place_names
from sazare.model.parts import BODY, INSIDE, LOAD, WALL, along

UNITS = ((1.0, 1.0, "m"), (0.1, 1e-2, "cm"), (0.0, 1e-3, "mm"))  # from this extent on [m], its factor and name
LETTERS = 58  # of a line of the legend
WIDTH = 9.0  # inch
GAUGE = {"marker": "o", "markersize": 5.0, "markerfacecolor": "white", "markeredgecolor": style.INK, "markeredgewidth": 1.3, "linestyle": "none"}
MOST_POINTS = 4000  # of what is drawn, that names are kept off
ARROW = 0.12  # of the extent of a picture


def length_unit(extent):
    """The factor and name of the unit for a body of an extent [m]."""
    return next((factor, name) for least, factor, name in UNITS if extent >= least)


def write_words(figure, title, model):
    """Title, and what the picture does not show, below it."""
    gravity = "no gravity" if model.gravity is None else f"gravity {along(model.gravity, 'm/s²')}"
    lines = textwrap.wrap("; ".join([*model.notes, gravity]), 115)
    figure.suptitle("\n".join([title, *lines]), x=0.01, ha="left", fontsize=10.5)


def write_legend(figure, model):
    """A line for each part, below the picture."""
    keys = [_key(part) for part in model.parts if len(part.corners)]
    if model.gauges:
        keys.append(Line2D([], [], label=f"gauge{'s' if len(model.gauges) > 1 else ''}", **GAUGE))
    for key in keys:
        key.set_label(textwrap.fill(key.get_label(), LETTERS))
    figure.legend(handles=keys, loc="outside lower left", ncols=2 if len(keys) > 1 else 1)


def _key(part):
    if part.role == BODY or (part.role == WALL and part.radii is not None):
        return Patch(facecolor=part.color, edgecolor="#00000066", label=part.label)
    if part.role == WALL and len(part.faces):
        return Patch(facecolor=part.color + "22", edgecolor=part.color, label=part.label)
    if len(part.points) and not len(part.faces) and not len(part.lines):
        return Line2D([], [], color=part.color, marker="s", markersize=5, linestyle="none", label=part.label)
    return Line2D([], [], color=part.color, linewidth=3.5, label=part.label)


def draw_marks(axes, model, place, extent, pieces=True):
    """Gauges with their names, names of pieces, and arrows; `place` leads from points [m] to the axes, `extent` is the larger side of the picture there."""
    for arrow in model.arrows:
        _draw_arrow(axes, arrow, place, ARROW * extent)
    names = [mark for part in model.parts for mark in part.names] if pieces else []
    gauges = place(np.array([gauge.point for gauge in model.gauges]).reshape(-1, 3))
    axes.plot(gauges[:, 0], gauges[:, 1], zorder=18, **GAUGE)
    marks = [*model.gauges, *names]
    place_names(axes, marks, place(np.array([mark.point for mark in marks]).reshape(-1, 3)), place(_kept_free(model)) if pieces else ())


def _kept_free(model):
    """Points (n, 3) [m] along what names had better not cover: loads, such as holes, and surfaces inside of the body."""
    parts = [part for part in model.parts if part.role in (LOAD, INSIDE)]
    points = [np.reshape(piece, (-1, 3)).mean(axis=0) for part in parts for piece in [*part.faces, *part.lines]]
    points = np.array(points, dtype=float).reshape(-1, 3)
    return points[:: max(1, len(points) // MOST_POINTS)]


def _draw_arrow(axes, arrow, place, length):
    """An arrow whose length in the axes tells its direction only; nothing where it leads along the line of sight."""
    point = np.asarray(arrow.point, dtype=float)
    start, direction = place(point[None, :])[0], np.asarray(arrow.direction, dtype=float)
    way = place((point + direction / np.linalg.norm(direction))[None, :])[0] - start
    if np.linalg.norm(way) < 1e-6 * length:
        return
    way = way / np.linalg.norm(way) * length
    tail, head = (start - way, start) if arrow.ends else (start, start + way)
    axes.annotate("", head, xytext=tail, zorder=17, annotation_clip=False,
                  arrowprops={"arrowstyle": "-|>", "color": arrow.color, "linewidth": 1.6, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 11})


def draw_gravity(axes, gravity, place):
    """The direction of gravity in axes of its own."""
    axes.set_axis_off()
    axes.set(xlim=(-1.0, 1.0), ylim=(-1.0, 1.0), aspect="equal", anchor="N")
    if gravity is None:
        return
    zero, end = place(np.array([np.zeros(3), gravity / np.linalg.norm(gravity)]))
    way = end - zero
    size = np.linalg.norm(way)
    way = 0.8 * way / max(size, 1e-9)
    if size > 0.05:
        axes.annotate("", way, xytext=-way, arrowprops={"arrowstyle": "-|>", "color": style.INK, "linewidth": 2.0, "shrinkA": 0, "shrinkB": 0})
    side = np.array([-way[1], way[0]])
    side = side if side[0] <= 0 else -side
    axes.text(*(0.5 * side / max(np.linalg.norm(side), 1e-9)), "g", ha="center", va="center", color=style.INK, style="italic", fontsize=11)
