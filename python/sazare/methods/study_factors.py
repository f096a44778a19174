"""Pictures of a study of factors of safety: displacement against the factor, and where the ground slips. Each returns a Figure, or None."""

from functools import partial

import numpy as np

from sazare import style
from sazare.methods import Section, Sheet
from sazare.style import count, quantity

MOST_SHOWN = 6  # cases in a picture
FOUND = ("bodies", "lower", "upper", "factor", "trials", "displacement", "elastic", "seconds")  # columns of study.csv that are no parameters


def _cases(results):
    """Number and name of each case, those of the smallest factors first where there are many."""
    table = results.study
    order = np.argsort(table["factor"], kind="stable")[:MOST_SHOWN]
    names = [name for name in table if name not in ("case", "family", *FOUND)]
    for row in sorted(order):
        values = "".join(f", {name} {table[name][row]:g}" for name in names)
        yield int(table["case"][row]), f"{table['family'][row]}{values}", float(table["factor"][row])


@style.styled
def displacements(results):
    """The largest displacement of each trial against the factor by which the strength was divided."""
    if results.study.rows == 0:
        return None
    figure = style.figure(7.0, 4.0)
    axes = figure.subplots()
    for number, (case, name, factor) in enumerate(_cases(results)):
        trials = results.trials(case)
        if trials.rows == 0:
            continue
        color = style.RUBBLE(number)
        order = np.argsort(trials["factor"])
        stands = trials["stands"][order] > 0
        x, y = trials["factor"][order], trials["displacement"][order]
        axes.semilogy(x[stands], y[stands], "o-", color=color, markersize=4, label=f"{name}: {factor:.3g}")
        axes.semilogy(x[~stands], y[~stands], "x", color=color, markersize=6)
        axes.axvline(factor, color=color, linewidth=0.8, linestyle="--")
    if not axes.lines:
        return None
    axes.set_xlabel("strength divided by")
    axes.set_ylabel("largest displacement [m]")
    axes.legend(fontsize=8)
    return figure


@style.styled
def slip_surfaces(results):
    """Plastic shear strain at the end of the last trial that failed."""
    found = [] if results.study.rows == 0 else [(name, results.slip_surface(case)) for case, name, _ in _cases(results)]
    found = [(name, table) for name, table in found if table.rows > 0]
    if not found:
        return None
    figure = style.figure(8.0, 2.9 * len(found))
    for axes, (name, table) in zip(np.atleast_1d(figure.subplots(len(found), 1)), found):
        deep = np.ptp(table["z"]) > 0.0  # a body in space is seen from the front
        across = table["z"] if deep else table["y"]
        order = np.argsort(table["slip"])
        spread = axes.scatter(table["x"][order], across[order], c=table["slip"][order], s=4, cmap=style.SPEED, linewidths=0,
                              vmax=max(np.quantile(table["slip"], 0.99), 1e-12))
        figure.colorbar(spread, ax=axes, label="plastic shear strain")
        axes.set_aspect("equal")
        axes.set_title(name)
        axes.set_xlabel("x [m]")
        axes.set_ylabel("z [m]" if deep else "y [m]")
    return figure


def sections(results):
    missing = "No case of the study is done."
    return [
        Section("displacements", "Displacement against the factor",
                "Dots: the ground came to rest; crosses: it failed, with the displacement at which the trial ended; dashed: the factor of safety. "
                f"At most {MOST_SHOWN} cases, those with the smallest factors.", partial(displacements, results), missing),
        Section("slip", "Slip surface",
                "Plastic shear strain of particles or elements, where they were at the beginning, at the end of the last trial that failed.",
                partial(slip_surfaces, results), missing),
    ]


def sheets(results):
    """The bounds of every case."""
    table = results.study
    if table.rows == 0:
        return []
    names = [name for name in table if name not in ("case", "family", *FOUND)]
    rows = [(count(int(table["case"][i])), str(table["family"][i]), *(f"{table[name][i]:g}" for name in names),
             *(f"{table[name][i]:.4g}" for name in ("factor", "lower", "upper")), quantity(float(table["displacement"][i]), "m"),
             quantity(float(table["elastic"][i]), "m"), count(int(table["trials"][i])))
            for i in range(table.rows)]
    return [Sheet("factors", "Factors of safety",
                  ("case", "family", *names, "factor", "stands at", "fails at", "displacement", "of elastic ground", "trials"), rows,
                  "The displacement is that at the largest factor with which the ground stands, and that of the same ground without a limit of strength.")]


def verdict(results):
    """The smallest factor; below 1 the ground does not stand."""
    least = results.figures.get("smallest_factor")
    if least is None:
        return "fair", "No case of the study is done."
    if least < 1.0:
        return "bad", f"The smallest factor of safety is {least:.3g}: this ground does not stand with the strength of its case."
    return "good", f"The smallest factor of safety is {least:.3g}."
