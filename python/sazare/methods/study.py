"""Pictures of a study: of factors of safety those of `study_factors`, of limit steps those of Yoshida, Ohba and Nakase (2010), figures 4 to 10. Each returns a Figure, or None."""

from functools import partial

import numpy as np

from sazare import curve_styles, style
from sazare.methods import Figure, Method, Section, common, study_factors

COLORS = ["#2f6f8f", "#b5472f", "#7a9a3f", "#8e7cc3", "#c9a66b", "#2b2b2b"]
NEEDED = ("spacing", "velocity", "damping")
# Table 2 of the paper: b11 b12 b13, b21 b22 b23.
PAPER = {"S": ((0.264375, 1.621563, 2.540176), (0.04089, 0.262491, 0.438239)),
         "P": ((0.304301, 1.666102, 2.614558), (0.046261, 0.263985, 0.392512))}


def _columns(results):
    """Arrays of the study by name and the radius; None where it varies other parameters."""
    table = results.study
    if any(name not in table for name in NEEDED) or table.rows < 8:
        return None
    columns = {name: np.asarray(table[name]) for name in (*NEEDED, "limit", "predicted", "family")}
    columns["radius"] = 0.5 * columns["spacing"]
    return columns


def _families(columns):
    return list(dict.fromkeys(columns["family"]))


def _grid(figure, count):
    return np.atleast_1d(figure.subplots(1, count, sharey=True))


def _lines(results, x, groups, panels, panel_name, select=None):
    """Limit against one parameter, a line for each value of another, a panel for each value of a third."""
    columns = _columns(results)
    if columns is None:
        return None
    family = _families(columns)[0]
    kept = columns["family"] == family
    if select is not None:
        kept &= np.isin(columns[select[0]], select[1])
    values = [value for value in np.unique(columns[panels][kept])]
    figure = style.figure(9.0, 3.6)
    for axes, value in zip(_grid(figure, len(values)), values):
        for number, group in enumerate(np.unique(columns[groups][kept])):
            look = curve_styles.look(number)
            rows = kept & (columns[panels] == value) & (columns[groups] == group)
            order = np.argsort(columns[x][rows])
            axes.loglog(columns[x][rows][order], columns["limit"][rows][order], "o", color=look["color"], markersize=3.5)
            axes.loglog(columns[x][rows][order], columns["predicted"][rows][order], linewidth=1.0, label=f"{group:g}", **look)
        axes.set_title(f"{family} waves, {panel_name} {value:g}")
        axes.set_xlabel(x if x != "radius" else "particle radius [m]")
        axes.legend(title=groups, fontsize=8)
    figure.axes[0].set_ylabel("stability limit [s]")
    return figure


@style.styled
def damping_curves(results):
    """Figure 4: limit against damping, by wave velocity, for two radii."""
    return _lines(results, "damping", "velocity", "radius", "radius [m]", ("radius", (0.25, 1.0)))


@style.styled
def radius_curves(results):
    """Figure 5: limit against radius, by wave velocity, for two damping ratios."""
    return _lines(results, "radius", "velocity", "damping", "h", ("damping", (0.001, 0.048)))


@style.styled
def scaled(results):
    """Figures 6 and 8: limit against radius over velocity, by damping, with the lines of (14)."""
    columns = _columns(results)
    if columns is None:
        return None
    families = _families(columns)
    figure = style.figure(9.0, 4.2)
    for axes, family in zip(_grid(figure, len(families)), families):
        own = columns["family"] == family
        shades = np.linspace(0.15, 0.95, len(np.unique(columns["damping"][own])))
        for shade, damping in zip(shades, np.unique(columns["damping"][own])):
            rows = own & (columns["damping"] == damping)
            ratio = columns["radius"][rows] / columns["velocity"][rows]
            slope, level = np.polyfit(np.log10(ratio), np.log10(columns["limit"][rows]), 1)
            ends = np.array([ratio.min(), ratio.max()])
            color = style.SPEED(shade)
            axes.loglog(ratio, columns["limit"][rows], "o", color=color, markersize=3, label=f"{damping:g}")
            axes.loglog(ends, 10.0**level * ends**slope, "-", color=color, linewidth=0.9)
        axes.set_title(f"{family} waves")
        axes.set_xlabel("radius / velocity [s]")
        axes.legend(title="h", fontsize=7, ncols=2)
    figure.axes[0].set_ylabel("stability limit [s]")
    return figure


@style.styled
def families_compared(results):
    """Figure 7: limits of the families against radius over velocity, for two damping ratios."""
    columns = _columns(results)
    if columns is None or len(_families(columns)) < 2:
        return None
    figure = style.figure(6.2, 4.0)
    axes = figure.subplots()
    for marker, damping in zip("os", (0.001, 0.1)):
        for color, family in zip(COLORS, _families(columns)):
            rows = (columns["family"] == family) & (columns["damping"] == damping)
            axes.loglog(columns["radius"][rows] / columns["velocity"][rows], columns["limit"][rows], marker, color=color, markersize=4,
                        fillstyle="none" if marker == "s" else "full", label=f"{family}, h = {damping:g}")
    axes.set_xlabel("radius / velocity [s]")
    axes.set_ylabel("stability limit [s]")
    axes.legend()
    return figure


@style.styled
def coefficients(results):
    """Figure 9: a1 and a2 of (14) against damping, with the curves of (15) and (16), ours and the paper's."""
    lines, table = results.regression_lines, results.regression
    if lines.rows < 3 or table.rows < 1:
        return None
    figure = style.figure(9.0, 3.8)
    first, second = figure.subplots(1, 2)
    for index, family in enumerate(table["family"]):
        own = lines["family"] == family
        damping = np.geomspace(lines["damping"][own].min(), 0.22, 60)
        for axes, name, row in ((first, "a1", ("b11", "b12", "b13")), (second, "a2", ("b21", "b22", "b23"))):
            axes.loglog(lines["damping"][own], lines[name][own], "o", color=COLORS[index], markersize=4, label=f"{family}")
            ours = np.polyval([table[key][index] for key in row], np.log10(damping))
            axes.loglog(damping, 10.0**ours, "-", color=COLORS[index], linewidth=1.1)
            if family in PAPER:
                paper = np.polyval(PAPER[family][0 if name == "a1" else 1], np.log10(damping))
                axes.loglog(damping, 10.0**paper, "--", color=COLORS[index], linewidth=1.1, label=f"{family}, paper")
            axes.set_title(f"coefficient {name}")
            axes.set_xlabel("damping ratio h")
    first.legend()
    return figure


def _fitted(columns, rows, first, second):
    x = np.log10(columns["damping"][rows])
    ratio = columns["radius"][rows] / columns["velocity"][rows]
    return 10.0 ** np.polyval(first, x) * ratio ** (10.0 ** np.polyval(second, x))


@style.styled
def fit_quality(results):
    """Figure 10: limits by the regression against those found, and by the prediction of the linearised operator."""
    columns, table = _columns(results), results.regression
    if columns is None or table.rows < 1:
        return None
    figure = style.figure(9.0, 4.2)
    panels = _grid(figure, 3)
    for index, family in enumerate(table["family"]):
        rows = (columns["family"] == family) & (columns["damping"] <= 0.2201)
        found = columns["limit"][rows]
        ours = _fitted(columns, rows, [table[f"b1{i}"][index] for i in (1, 2, 3)], [table[f"b2{i}"][index] for i in (1, 2, 3)])
        sets = [("regression, this study", ours), ("regression, paper", _fitted(columns, rows, *PAPER[family]) if family in PAPER else None)]
        for axes, (title, values) in zip(panels, sets):
            if values is None:
                continue
            error = np.sqrt(np.mean(np.log(values / found) ** 2))
            axes.loglog(found, values, "o", color=COLORS[index], markersize=3, label=f"{family}: rms {error:.3f}")
            axes.set_title(title)
        every = columns["family"] == family
        error = np.max(np.abs(np.log(columns["predicted"][every] / columns["limit"][every])))
        panels[2].loglog(columns["limit"][every], columns["predicted"][every], "o", color=COLORS[index], markersize=3,
                         label=f"{family}: at most {100 * error:.2f} %")
    panels[2].set_title("linearised operator, all h")
    ends = np.array([columns["limit"].min(), columns["limit"].max()])
    for axes in panels:
        axes.loglog(ends, ends, color="#8a8a8a", linewidth=0.8, zorder=0)
        axes.set_xlabel("stability limit by bisection [s]")
        axes.legend(fontsize=8)
    panels[0].set_ylabel("estimated stability limit [s]")
    return figure


def _seeks_factors(results):
    return "factor" in results.study or "smallest_factor" in results.figures


def sections(results):
    """The figures of the paper, or those of factors of safety."""
    if _seeks_factors(results):
        return study_factors.sections(results)
    missing = "The study varies other parameters or is not complete."
    pictures = [
        ("damping", "Stability limit against damping", "Dots: bisection; lines: predicted from the linearised operator. Figure 4 of the paper.",
         damping_curves),
        ("radius", "Stability limit against radius", "Dots: bisection; lines: predicted. Figure 5 of the paper.", radius_curves),
        ("scaled", "Stability limit against radius / velocity", "Dots: bisection; lines: (14). Figures 6 and 8 of the paper.", scaled),
        ("families", "Comparison of families", "Figure 7 of the paper.", families_compared),
        ("coefficients", "Regression coefficients", "Dots: (14) for each damping ratio; lines: (15), (16), this study and the paper. Figure 9.", coefficients),
        ("quality", "Estimated against computed limits", "Regressions, and the prediction from the linearised operator. Figure 10.", fit_quality),
    ]
    return [Section(name, heading, caption, partial(draw, results), missing) for name, heading, caption, draw in pictures]


def verdict(results):
    """A completed study is good; the largest error of the prediction is given."""
    if _seeks_factors(results):
        return study_factors.verdict(results)
    largest = results.figures.get("largest_log_difference", 0.0)
    return "good", f"The study is complete. Prediction and bisection differ by at most {100 * largest:.2f} %."


METHOD = Method(
    sections=sections,
    verdict=verdict,
    sheets=lambda results: study_factors.sheets(results) if _seeks_factors(results) else [],
    headlines=(Figure("cases", "cases", note=common.count_note("cases_done", "complete")),),
    has_case=False,
)
