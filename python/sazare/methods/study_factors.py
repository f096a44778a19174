"""Pictures of a study of factors of safety: displacement against the factor, and where the ground slips. Each returns a Figure, or None."""

import re
from dataclasses import dataclass
from functools import partial

import numpy as np

from sazare import style
from sazare.key_units import unit_of_key
from sazare.methods import Section, Sheet
from sazare.style import count, quantity

MOST_SHOWN = 6  # cases in a picture
MOST_NAMED = 6  # cases in a sentence
FOUND = ("bodies", "lower", "upper", "factor", "trials", "displacement", "elastic", "seconds")  # columns of study.csv that are no parameters
ROW_OF_FAILED = 0.035  # height of the row in which the failed trials of a case stand, over that of the axes
FAILED = {"linestyle": "none", "marker": "o", "markersize": 5, "fillstyle": "none"}
PANEL_WIDTH = 480.0  # of a slip surface [pt]
WITH_PREFIX = re.compile(r"(Pa|N|J)\b")  # units in which a thousand is written as 1 k
NOT_THERE = "-"


@dataclass(frozen=True)
class _Case:
    """A case: its number, its name with number and parameters, and its factor of safety with its bounds. `lower` is 0 where it failed in every trial,
    `upper` infinite where it stood in every one, and `factor` is then not a number."""

    number: int
    name: str
    lower: float
    upper: float
    factor: float

    @property
    def is_bracketed(self):
        return bool(np.isfinite(self.factor))

    @property
    def is_below(self):
        return not self.is_bracketed and bool(np.isfinite(self.upper))

    def factor_words(self, digits=3):
        """The factor; where the bounds of the search do not bracket it, on which side of them it lies."""
        if self.is_bracketed:
            return f"{self.factor:#.{digits}g}"
        return f"below {self.upper:.{digits}g}" if self.is_below else f"above {self.lower:.{digits}g}"

    def title(self):
        """Its name and its factor F, for legends."""
        return f"{self.name}: F {'= ' if self.is_bracketed else ''}{self.factor_words()}"

    def order(self):
        """The factor, or the bound beyond which it lies."""
        return self.factor if self.is_bracketed else self.upper if self.is_below else self.lower


def _parameters(table):
    return [name for name in table if name not in ("case", "family", *FOUND)]


def _amount(table, name, row):
    """The value of a parameter with its unit, that of the study or else of the key that it is named after: `12 kPa`."""
    value, unit = float(table[name][row]), table.unit(name)
    if unit in ("", "-"):
        unit = unit_of_key(name)
    factor, prefix = style.prefix_for(value) if WITH_PREFIX.match(unit) and abs(value) >= 1e3 else (1.0, "")
    return f"{value / factor:g} {prefix}{unit}".strip()


def _cases(results):
    """All cases, in the order of the table."""
    table = results.study
    for row in range(table.rows):
        values = "".join(f", {name} = {_amount(table, name, row)}" for name in _parameters(table))
        number = int(table["case"][row])
        yield _Case(number, f"case {number}, {table['family'][row]}{values}", *(float(table[name][row]) for name in ("lower", "upper", "factor")))


def _shown(cases):
    """Those of the smallest factors where there are many."""
    return sorted(sorted(cases, key=_Case.order)[:MOST_SHOWN], key=lambda case: case.number)


def _draw_trials(axes, case, trials, color, height):
    """The curve of the trials in which the ground stood; those in which it failed at a height of the axes, since the displacement at which a
    trial ends says nothing of how far the ground would go."""
    order = np.argsort(trials["factor"])
    factors, displacements, stands = (trials[name][order] for name in ("factor", "displacement", "stands"))
    stood = stands > 0
    axes.semilogy(factors[stood], displacements[stood], "o-", color=color, markersize=4, label=case.title())
    axes.plot(factors[~stood], np.full(np.sum(~stood), height), transform=axes.get_xaxis_transform(), color=color, **FAILED)
    axes.axvline(case.factor, color=color, linewidth=0.8, linestyle="--")


@style.styled
def displacements(results):
    """The largest displacement of each trial against the factor by which the strength was divided."""
    every = list(_cases(results))
    drawn = [(case, trials) for case in _shown(case for case in every if case.is_bracketed) if (trials := results.trials(case.number)).rows > 0]
    if not drawn:
        return None
    figure = style.figure(7.0, 4.6)
    axes = figure.subplots()
    for number, (case, trials) in enumerate(drawn):
        _draw_trials(axes, case, trials, style.RUBBLE(number), 1.0 - ROW_OF_FAILED * (number + 0.7))
    axes.plot([], [], color=style.INK, label="fails", **FAILED)
    low, high = axes.get_ylim()
    axes.set_ylim(low, low * (high / low) ** (1.0 / (1.0 - ROW_OF_FAILED * (len(drawn) + 0.7))))
    axes.set_xlabel("strength divided by")
    axes.set_ylabel("largest displacement [m]")
    figure.legend(loc="outside lower left", fontsize=8)
    return figure


def _dot(x, y):
    """Size of dots [pt^2] that nearly touch where so many fill a panel evenly."""
    width, height = np.ptp(x), np.ptp(y)
    spacing = np.sqrt(width * height / len(x)) / max(width, 1e-12)  # over the width
    return float(np.clip((0.7 * PANEL_WIDTH * spacing) ** 2, 4.0, 60.0))


@style.styled
def slip_surfaces(results):
    """Plastic shear strain at the end of the last trial that failed."""
    found = [(case.title(), table) for case in _shown(_cases(results)) if (table := results.slip_surface(case.number)).rows > 0]
    if not found:
        return None
    figure = style.figure(8.0, 2.9 * len(found))
    for axes, (name, table) in zip(np.atleast_1d(figure.subplots(len(found), 1)), found):
        deep = np.ptp(table["z"]) > 0.0  # a body in space is seen from the front
        across = table["z"] if deep else table["y"]
        order = np.argsort(table["slip"])
        top, clipped = style.clipped_top(table["slip"])
        spread = axes.scatter(table["x"][order], across[order], c=table["slip"][order], s=_dot(table["x"], across), cmap=style.SPEED, linewidths=0,
                              vmin=0.0, vmax=top)
        style.colorbar(figure, spread, axes, "plastic shear strain [-]", clipped)
        axes.set_aspect("equal")
        axes.set_title(name)
        axes.set_xlabel("x [m]")
        axes.set_ylabel("z [m]" if deep else "y [m]")
    return figure


def _outside(cases):
    """Which cases have no factor between the bounds of the search, in words; "" where all have one."""
    outside = [case for case in cases if not case.is_bracketed]
    told = "; ".join(f"{case.name}: {case.factor_words()}" for case in outside[:MOST_NAMED])
    more = f"; and {len(outside) - MOST_NAMED} more, see the table" if len(outside) > MOST_NAMED else ""
    return f"The bounds of the search do not bracket the factors of {len(outside)} of {len(cases)} cases ({told}{more})." if outside else ""


def sections(results):
    cases = list(_cases(results))
    none = "No case of the study is done."
    outside = _outside(cases)
    return [
        Section("displacements", "Displacement against the factor",
                "Dots on the curves: the ground came to rest; open circles at the upper edge: it failed, however little it had moved when the trial ended; "
                f"dashed: the factor of safety. At most {MOST_SHOWN} cases, those with the smallest factors.{' ' if outside else ''}{outside}",
                partial(displacements, results), outside or none),
        Section("slip", "Slip surface",
                "Plastic shear strain of particles or elements, where they were at the beginning, at the end of the last trial that failed.",
                partial(slip_surfaces, results), "No trial failed." if cases else none),
    ]


def _bound(value):
    return f"{value:#.4g}" if 0.0 < value < np.inf else NOT_THERE


def sheets(results):
    """The bounds of every case."""
    table = results.study
    if table.rows == 0:
        return []
    names = _parameters(table)
    rows = [(count(case.number), str(table["family"][i]), *(_amount(table, name, i) for name in names),
             case.factor_words(4), _bound(case.lower), _bound(case.upper), NOT_THERE if case.is_below else quantity(float(table["displacement"][i]), "m"),
             quantity(float(table["elastic"][i]), "m"), count(int(table["trials"][i])))
            for i, case in enumerate(_cases(results))]
    return [Sheet("factors", "Factors of safety",
                  ("case", "family", *names, "factor", "stands at", "fails at", "displacement", "of elastic ground", "trials"), rows,
                  "The displacement is that at the largest factor with which the ground stands, and that of the same ground without a limit of strength.")]


def verdict(results):
    """The smallest factor; below 1 the ground does not stand."""
    cases = list(_cases(results))
    if not cases:
        return "fair", "No case of the study is done."
    least, outside = min(cases, key=_Case.order), _outside(cases)
    fails = least.upper <= 1.0 if least.is_below else least.order() < 1.0
    told = f"The smallest factor of safety is {least.factor_words()} ({least.name}){': this ground does not stand with the strength of its case' if fails else ''}."
    return "bad" if fails else "fair" if least.is_below else "good", f"{told} {outside}".strip()
