"""Many curves in one picture: which of them are drawn, how they are told apart, and what is said of the others."""

import numpy as np

from sazare import style

COLOURS = (style.ACCENT, style.SECOND, "#7a9a3f", "#8069c0", style.INK, "#d1b13c")
LINES = ("-", (0, (4.0, 1.5)), (0, (1.0, 1.2)))
MOST = len(COLOURS) * len(LINES)  # curves that differ
MOST_INSIDE = 6  # entries of a legend within the axes
SMALL = {"fontsize": 8.0, "labelspacing": 0.3}
ENTRY = 0.165  # height of an entry of a legend beside the axes [inch]
MOST_NAMED = 8  # names in a line below a figure


def look(number):
    """Colour and line of the curve of a number, as options of Matplotlib; those of MOST curves differ."""
    return {"color": COLOURS[number % len(COLOURS)], "linestyle": LINES[number // len(COLOURS) % len(LINES)]}


def spread(names, most=MOST):
    """As many of some names as are drawn, evenly spread in their order; the first and the last are always among them."""
    return [names[number] for number in np.linspace(0, len(names) - 1, min(most, len(names))).round().astype(int)]


def tell_left_out(figure, names, shown, source):
    """Says below a figure which of the names have no curve in it, and in what file or by what function their numbers are found."""
    more = [name for name in names if name not in shown]
    if not more:
        return
    words = ", ".join(more[:MOST_NAMED]) + (f" and {len(more) - MOST_NAMED} others" if len(more) > MOST_NAMED else "")
    figure.supxlabel(f"{len(more)} more, {words}: see {source}", x=0.01, ha="left", fontsize=8.0, color=style.INK)


def figure(width, height, count):
    """An empty figure [inch] for so many curves, higher where the legend of many is, and wider where it is narrow."""
    if count <= MOST_INSIDE:
        return style.figure(width, height)
    return style.figure(min(width + 2.0, 9.0), max(height, 1.0 + ENTRY * min(count, MOST)))


def legend(axes, beside=None):
    """The legend of axes, of many curves to the right of the axes, or of `beside`, the rightmost ones of their row; the curve drawn last on top,
    as curves are drawn from below."""
    handles, labels = axes.get_legend_handles_labels()
    many = len(labels) > MOST_INSIDE
    options = {"loc": "center left", "bbox_to_anchor": (1.0, 0.5), **SMALL} if many else {}
    owner = beside if many and beside is not None else axes
    owner.legend(handles[::-1], labels[::-1], **options)
