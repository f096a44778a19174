"""Names beside points, placed so that they cover neither each other nor the points."""

import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg

from sazare import style

STEPS = ((1, 0), (1, 1), (1, -1), (-1, 0), (-1, 1), (-1, -1), (0, 1), (0, -1))  # where a name may stand, the best first
GAPS = (7.0, 14.0, 24.0, 38.0, 55.0, 80.0, 110.0)  # from the point, in points of a letter
NEAR = 7.0  # beyond this gap a line leads to the name
COVERED = 20.0  # area that a point counts for which a name would cover, in squares of a point of a letter


def place_names(axes, marks, places, drawn=()):
    """Writes the name of each mark beside its place (n, 2) in the axes, whose limits are set; drawn: points (k, 2) of what names had better not cover."""
    figure = axes.figure
    renderer = FigureCanvasAgg(figure).get_renderer()
    style.write_names_plainly(figure)
    figure.draw_without_rendering()
    pixels = axes.transData.transform(np.reshape(places, (-1, 2)))
    scale = figure.dpi / 72.0
    taken = [np.array([spot - 4.0 * scale, spot + 4.0 * scale]) for spot in pixels]
    taken += [np.array(text.get_window_extent(renderer).get_points()) for text in axes.texts if text.get_text()]
    frame = np.array(axes.get_window_extent(renderer).get_points())
    drawn = axes.transData.transform(np.reshape(drawn, (-1, 2)))
    for mark, place, pixel in zip(marks, places, pixels):
        text = axes.annotate(
            mark.name, place, xytext=(0, 0), textcoords="offset points", parse_math=False, fontsize=8, color=mark.color, zorder=20, annotation_clip=False,
            bbox={"boxstyle": "round,pad=0.12", "facecolor": "white", "edgecolor": "none", "alpha": 0.8},
        )
        text.set_in_layout(False)
        extent = text.get_window_extent(renderer)
        size = np.array([extent.width, extent.height]) + 4.0 * scale
        gap, step = min(((gap, step) for gap in GAPS for step in STEPS), key=lambda way: _cost(way, pixel, size, scale, taken, frame, drawn))
        text.set_position(np.array(step) * gap)
        text.set_horizontalalignment({1: "left", -1: "right", 0: "center"}[step[0]])
        text.set_verticalalignment({1: "bottom", -1: "top", 0: "center"}[step[1]])
        if gap > NEAR:
            axes.annotate(
                "", place, xytext=np.array(step) * gap, textcoords="offset points", zorder=19, annotation_clip=False,
                arrowprops={"arrowstyle": "-", "color": mark.color, "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0},
            ).set_in_layout(False)
        taken.append(_box(pixel, size, np.array(step), gap * scale))


def _box(pixel, size, step, gap):
    """Lower and upper corner of a name in pixels."""
    low = pixel + step * gap + np.where(step > 0, 0.0, np.where(step < 0, -size, -0.5 * size))
    return np.array([low, low + size])


def _cost(way, pixel, size, scale, taken, frame, drawn):
    """How bad a place is: by the area that it covers, by what is outside, then by its distance."""
    gap, step = way
    box = _box(pixel, size, np.array(step), gap * scale)
    covered = sum(_common(box, other) for other in taken)
    outside = np.prod(size) - _common(box, frame)
    hidden = np.count_nonzero(np.all((drawn >= box[0]) & (drawn <= box[1]), axis=1)) * COVERED * scale**2
    return round(covered + outside + hidden), gap, STEPS.index(step)


def _common(one, other):
    """The area that two boxes have in common."""
    sides = np.minimum(one[1], other[1]) - np.maximum(one[0], other[0])
    return float(np.prod(np.maximum(sides, 0.0)))
