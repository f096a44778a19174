"""Colours, fonts and number formats of every picture."""

import functools
import importlib.util
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib import font_manager
from matplotlib.colors import LinearSegmentedColormap, ListedColormap
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.ticker import MaxNLocator

STONE = "#e9e4da"
STONE_EDGE = "#c9c1b2"
INK = "#2b2b2b"
OLD_CRACK = "#555555"
SOFTENING = "#7a9a3f"
SHEAR_CRACK, SHEAR_PRESSED = "#1f4e9c", "#7fb2e5"
OPEN_CRACK, OPEN_PRESSED = "#a8321c", "#ef9a7c"
WALL = "#7d8894"
# Finite elements by region, beside bodies that are coloured by speed.
GROUND = ("#a9bdd0", "#b9c9b4", "#c4b9d3", "#a8c9c6", "#c9cfd6")
ACCENT = "#b5472f"
SECOND = "#2f6f8f"
GRID = "#e3e3e3"

RUBBLE = ListedColormap(
    ["#d9774a", "#4f9d97", "#d1b13c", "#8069c0", "#5e9c45", "#cf6484", "#3f74b5", "#8a5a34", "#a9cf5a", "#7a7f88"]
)

BREAK_TIME = LinearSegmentedColormap.from_list("break_time", ["#3b0f2b", "#8c1d40", "#d1452b", "#f08a1d"])
SHEAR_TIME = LinearSegmentedColormap.from_list("shear_time", ["#10204d", "#1f4e9c", "#3f8fd6", "#8fd0f2"])
SPEED = LinearSegmentedColormap.from_list("speed", [STONE, "#efb273", "#d1452b", "#7d1d4a", "#2a0f36"])
LEVEL = "YlGnBu"
SIZE = "viridis"
STRESS = "RdBu_r"

# Energies: what is stored in cold colours, what is dissipated in warm ones.
KINETIC, ELASTIC, DASHPOT, SLIP, RUPTURE, RELEASE = "#35618f", "#6fa3c7", "#c9a66b", "#a8763e", "#b5472f", "#e08a76"
CONTACT_DASHPOT, FRICTION, OUTSIDE, SEEPAGE, YIELDED = "#9aa87c", "#5f7a4a", "#8d8d9e", "#c3b7d9", "#7d5a6b"

# Fonts for Japanese words where the package that brings one is missing, by the systems that have them.
JAPANESE_FONTS = ("IPAexGothic", "IPAGothic", "Noto Sans CJK JP", "Noto Sans JP", "Hiragino Sans", "Yu Gothic", "MS Gothic")


def _japanese_font():
    """The name of a font for Japanese words: IPAexGothic of the package matplotlib_fontja, or one of the system; None without any.

    The package is not imported, since that would change the settings of whoever uses Sazare in a program of their own.
    """
    package = importlib.util.find_spec("matplotlib_fontja")
    for folder in package.submodule_search_locations if package else ():
        if (file := Path(folder) / "fonts" / "ipaexg.ttf").exists():
            font_manager.fontManager.addfont(file)
    known = {font.name for font in font_manager.fontManager.ttflist}
    return next((name for name in JAPANESE_FONTS if name in known), None)


# Letters that the first font lacks come from the next one.
FONTS = [name for name in ("DejaVu Sans", _japanese_font()) if name]

SETTINGS = {
    "font.family": FONTS,
    "font.size": 9.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#8a8a8a",
    "axes.labelcolor": INK,
    "axes.titlesize": 10.5,
    "axes.titlelocation": "left",
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": 0.8,
    "xtick.color": "#555555",
    "ytick.color": "#555555",
    "legend.frameon": False,
    "savefig.dpi": 130,
    "savefig.bbox": "tight",
}


def styled(draw):
    """Runs a drawing function in the style of the report."""

    @functools.wraps(draw)
    def wrapped(*arguments, **options):
        with matplotlib.rc_context(SETTINGS):
            return draw(*arguments, **options)

    return wrapped


def figure(width, height):
    """An empty figure [inch]."""
    return Figure(figsize=(width, height), layout="constrained")


def write_names_plainly(figure):
    """Lets names of users stand as they are, with dollar signs too, which begin formulas elsewhere; labels of ticks are formulas."""
    for text in figure.findobj(Text):
        if "$" in text.get_text() and "\\mathdefault" not in text.get_text():
            text.set_parse_math(False)


LEAST_GAP = 0.6  # between labels of ticks, over their height


def _overlaps(boxes):
    return any(after.x0 - before.x1 < LEAST_GAP * before.height for before, after in zip(boxes, boxes[1:]))


def thin_out_labels(figure):
    """Leaves out labels of ticks along x that touch each other, as in narrow panels; that of 0 stays."""
    figure.draw_without_rendering()
    for axes in [one for parent in figure.axes for one in (parent, *parent.child_axes)]:
        if axes.name == "3d" or not isinstance(axes.xaxis.get_major_locator(), MaxNLocator):
            continue
        low, high = sorted(axes.get_xlim())
        labels = [(tick.get_loc(), label) for tick in axes.xaxis.get_major_ticks() for label in (tick.label1, tick.label2) if label.get_visible()]
        shown = [(float(place), label) for place, label in labels if low <= place <= high and label.get_text()]
        places, boxes = [place for place, _ in shown], [label.get_window_extent() for _, label in shown]
        every = 1
        while every < len(shown) and _overlaps(boxes[_first(places, every) :: every]):
            every += 1
        if every > 1:
            axes.set_xticks(places[_first(places, every) :: every])


def _first(places, every):
    """Where to begin, so that 0 is one of every so many."""
    return next((number % every for number, place in enumerate(places) if place == 0.0), 0)


@styled
def save(figure, path):
    """Writes a figure in the format of the path's ending; names of users stand as they are, and labels of ticks apart."""
    write_names_plainly(figure)
    thin_out_labels(figure)
    figure.savefig(path)


PREFIXES = ((1e9, "G"), (1e6, "M"), (1e3, "k"), (1.0, ""), (1e-3, "m"), (1e-6, "µ"), (1e-9, "n"))


def prefix_for(value):
    """The factor and SI prefix with which a value is between 1 and 1000; (1, "") for zero."""
    for factor, name in PREFIXES:
        if abs(value) >= 0.9995 * factor:
            return factor, name
    return PREFIXES[-1] if value else (1.0, "")


def prefix_of(*values):
    """The factor and SI prefix in which the largest magnitude of some arrays is between 1 and 1000."""
    return prefix_for(max((float(np.nanmax(np.abs(one), initial=0.0)) for one in values), default=0.0))


FEW = 200  # values, of which one in a hundred is not a stray one


def clipped_top(values, share=99.0):
    """Where a scale of colours ends, and whether values are beyond it: a percentile of many values, of few their largest; 1 where all are 0."""
    largest = float(np.max(values, initial=0.0))
    top = float(np.percentile(values, share)) if len(values) >= FEW else 0.0
    return (top, True) if 0.0 < top < largest else (largest or 1.0, False)


FAR_OUT = 3.0  # interquartile ranges beyond the quartiles


def bulk(values):
    """Lower and upper end of a scale of colours for the bulk of some values, such as stresses that are far off in single rows of particles.

    The 2nd and 98th percentile, but nothing that is far out by Tukey, Exploratory Data Analysis (1977): by more than three
    interquartile ranges beyond the quartiles. A scale of values that are hardly negative begins at 0. Of few values all are in it.
    """
    values = np.asarray(values, dtype=float)
    values = values[np.isfinite(values)]
    least, largest = (float(values.min()), float(values.max())) if len(values) else (0.0, 0.0)
    low, high = least, largest
    if len(values) >= FEW:
        low, first, third, high = (float(end) for end in np.percentile(values, (2.0, 25.0, 75.0, 98.0)))
        room = FAR_OUT * (third - first) or np.inf
        low, high = max(low, first - room), min(high, third + room)
        if low >= high:
            low, high = least, largest
    if -0.02 * high < low:
        low = 0.0
    return (low, high) if low < high else (low, low + 1.0)


def colorbar(figure, drawn, axes, label, clipped, **options):
    """A bar of colours that says where its scale is clipped."""
    words = ",\n".join(part for part in (label, "clipped at the\n99th percentile" if clipped else "") if part)
    figure.colorbar(drawn, ax=axes, label=words, **{"extend": "max" if clipped else "neither", "shrink": 0.8, **options})


def open_colorbar(figure, drawn, axes, values, factor=1.0, prefix="", unit=""):
    """A bar of colours, in prefix and unit, that is open where values [unit] lie beyond its scale, and says how far they go."""
    low, high = (factor * end for end in drawn.get_clim())
    least, largest = float(np.nanmin(values)), float(np.nanmax(values))
    slack = 1e-9 * (high - low)
    beyond = {"min": f"least {quantity(least, unit)}"} if least < low - slack else {}
    beyond |= {"max": f"largest {quantity(largest, unit)}"} if largest > high + slack else {}
    words, ends = ",\n".join([f"[{prefix}{unit or '-'}]", *beyond.values()]), list(beyond)
    figure.colorbar(drawn, ax=axes, label=words, shrink=0.8, extend="both" if len(ends) == 2 else ends[0] if ends else "neither")


def round_factor(most):
    """The largest of 1, 2, 5, 10, 20 ... and of their parts 0.5, 0.2, 0.1 ... that is at most a positive number."""
    power = 10.0 ** np.floor(np.log10(most))
    return float(power * max((step for step in (1, 2, 5) if step * power <= most), default=0.5))  # log10 may have rounded up


def quantity(value, unit="", digits=3):
    """A number with its unit in words for people: 0.00216, "m" gives `2.16 mm`; areas and volumes keep their unit, and have powers of ten."""
    if value is None:
        return "not known"
    factor, prefix = prefix_for(value) if unit and unit[-1] not in "²³" else (1.0, "")
    return f"{value / factor:.{digits}g} {prefix}{unit}".strip()


def count(value):
    """A whole number with thin spaces between thousands."""
    return "not known" if value is None else f"{int(value):,}".replace(",", "\u202f")
