"""Charges of a run of method blocks: the pressure of their gas, and where its energy goes."""

import numpy as np

from sazare import style
from sazare.plot import time_axis

MOST_CHARGES = 8
LEAST_PRESSURE = 1e-4  # of the largest; below, a curve on an axis of logarithms tells nothing
WIDE_RANGE = 20  # of pressures, from which on the axis is one of logarithms


def names(results):
    """Names of the charges of the run."""
    ending = ".released"
    return [column.removesuffix(ending) for column in results.history if column.endswith(ending)]


@style.styled
def charges(results):
    """Pressure [Pa] of the gas of the charges, and the energy [J] that they have released and their gas has given, against time.

    Beyond eight charges, those that have the largest pressures have curves of their own; energies are those of all.
    """
    history = results.history
    found = names(results)
    if not found or history.rows < 2 or not any(np.any(history[f"{name}.pressure"] > 0.0) for name in found):
        return None
    peaks = {name: history[f"{name}.pressure"].max() for name in found}
    shown = sorted(found, key=lambda name: -peaks[name])[:MOST_CHARGES]
    time, label = time_axis(history)
    figure = style.figure(9.4, 3.6)
    left, right = figure.subplots(1, 2)
    factor, prefix = style.prefix_for(max(peaks.values()))
    curves = {name: history[f"{name}.pressure"] / factor for name in found if name in shown}
    for name, pressure in curves.items():
        pressure[pressure <= LEAST_PRESSURE * max(peaks.values()) / factor] = np.nan
        left.plot(time, pressure, linewidth=1.4, label=name)
    if max(peaks.values()) / factor > WIDE_RANGE * min(np.nanmin(pressure) for pressure in curves.values()):
        left.set_yscale("log")
    else:
        left.set_ylim(bottom=0)
    left.set_ylabel(f"pressure of the gas [{prefix}Pa]")
    if len(found) > 1:
        left.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4)
    released, work, lost, in_cracks = (sum(history[f"{name}.{what}"] for name in found) for what in ("released", "work", "lost", "in_cracks"))
    factor, prefix = style.prefix_for(released.max())
    right.plot(time, released / factor, color=style.ACCENT, label="released by detonation")
    right.plot(time, work / factor, color=style.SECOND, label="work on the rock")
    if np.any(lost > 0.0):
        right.plot(time, (work + lost) / factor, color=style.OUTSIDE, label="work, and gas that has left")
    if np.any(in_cracks > 0.0):
        right.fill_between(
            time, (work + lost) / factor, (work + lost + in_cracks) / factor, facecolor=style.GROUND[0], linewidth=0, label="gas in cracks"
        )
    right.fill_between(
        time, (work + lost + in_cracks) / factor, released / factor, facecolor=style.STONE, edgecolor=style.STONE_EDGE, label="gas in the holes"
    )
    right.set_ylabel(f"energy [{prefix}J]")
    right.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    for axes in (left, right):
        axes.set_xlabel(label)
        axes.set_xlim(time[0], time[-1])
    right.set_ylim(bottom=0)
    return figure
