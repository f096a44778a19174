"""The picture of a sweep: figures over its first parameter."""

import numpy as np

from sazare import style

MOST = 6  # panels


@style.styled
def figures_over(sweep, columns, names):
    """Figures by name over the first parameter of a sweep, a dot for each run, and the line of the means at each value; None where no run has one of them."""
    known = [name for name in names if name in columns and np.any(np.isfinite(columns[name]))][:MOST]
    if not known:
        return None
    first = sweep.parameters[0]
    numbers = [_number(value) for value in first.values]
    plain = all(number is not None for number in numbers)
    places = dict(zip(first.values, numbers if plain else range(len(numbers))))
    x = np.array([places[value] for value in columns[first.key]], dtype=float)
    figure = style.figure(3.4 * min(len(known), 3), 3.0 * (1 + (len(known) - 1) // 3))
    panels = np.ravel(figure.subplots(1 + (len(known) - 1) // 3, min(len(known), 3), squeeze=False))
    for axes, name in zip(panels, known):
        values = np.asarray(columns[name], dtype=float)
        axes.plot(x, values, "o", color=style.ACCENT, markersize=4)
        there = [place for place in sorted(set(x)) if np.any(np.isfinite(values[x == place]))]
        axes.plot(there, [np.nanmean(values[x == place]) for place in there], color="#555555", linewidth=1.2)
        axes.set_title(name, fontsize=9)
        axes.set_xlabel(first.key)
        axes.set_ylim(bottom=min(0.0, np.nanmin(values)))
        if not plain:
            axes.set_xticks(list(places.values()), list(places))
    for axes in panels[len(known) :]:
        axes.set_visible(False)
    return figure


def _number(text):
    try:
        return float(text)
    except ValueError:
        return None
