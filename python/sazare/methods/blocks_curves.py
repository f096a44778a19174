"""Curves of a run of method blocks: broken joints, steps, ranks. Each returns a matplotlib Figure, or None without data."""

import matplotlib
import numpy as np
from matplotlib.ticker import MaxNLocator

from sazare import style
from sazare.plot import time_axis

MOST_TICKS = 8


@style.styled
def broken_joints(results):
    """Number of broken joints and of fragments against time."""
    history = results.history
    if "broken_joints" not in history or history.rows < 2:
        return None
    time, label = time_axis(history)
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    axes.plot(time, history["broken_joints"], color=style.ACCENT, linewidth=2.0)
    axes.fill_between(time, history["broken_joints"], color=style.ACCENT, alpha=0.12, linewidth=0.0)
    axes.set_ylabel("broken joints", color=style.ACCENT)
    axes.yaxis.set_major_locator(MaxNLocator(integer=True))
    axes.set_xlabel(label)
    axes.margins(x=0)
    axes.set_ylim(bottom=0)
    if "fragments" in history:
        other = axes.twinx()
        other.grid(False)
        other.spines["right"].set_visible(True)
        other.plot(time, history["fragments"], color=style.SECOND, linewidth=1.6)
        other.set_ylabel("fragments", color=style.SECOND)
        other.yaxis.set_major_locator(MaxNLocator(integer=True))
        other.set_ylim(bottom=0)
    return figure


@style.styled
def smallest_step(results):
    """Smallest time step [s] of any element against time."""
    history = results.history
    if "smallest_step" not in history or history.rows < 2 or not np.any(history["smallest_step"] > 0.0):
        return None
    time, label = time_axis(history)
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    steps = history["smallest_step"]
    axes.step(time, np.where(steps > 0.0, steps, np.nan), color=style.SECOND, where="post")
    axes.set_yscale("log", base=2)
    taken = np.unique(steps[steps > 0.0])
    shown = taken[:: -(-len(taken) // MOST_TICKS)]
    axes.set_yticks(shown, [style.quantity(step, "s") for step in shown])
    axes.minorticks_off()
    axes.set_ylim(taken[0] / 1.3, taken[-1] * 1.3)
    axes.set_ylabel("smallest time step")
    axes.set_xlabel(label)
    axes.margins(x=0)
    return figure


@style.styled
def ranks(results):
    """Processor time so far [s] and number of elements of every rank, and what waiting for each other costs: load imbalance of the
    intervals [-] and lock step [-]."""
    table = results.ranks
    if table.rows < 1:
        return None
    count = int(table["rank"].max()) + 1
    time = table["time"].reshape(-1, count)[:, 0] * 1e6
    worked, elements, lock_step = (table[name].reshape(-1, count) for name in ("processor_time", "elements", "lock_step"))
    spent = np.diff(worked, axis=0, prepend=0)
    figure = style.figure(7.4, 8.2)
    total, imbalance, step, own = figure.subplots(4, 1, sharex=True, gridspec_kw={"height_ratios": [3, 2, 2, 3]})
    colors = matplotlib.colormaps["viridis"](np.linspace(0, 0.9, count))
    for rank in range(count):
        total.plot(time, worked[:, rank], color=colors[rank], linewidth=1.2)
        own.step(time, elements[:, rank], color=colors[rank], linewidth=1.2, where="pre")
    total.set_ylabel("processor time [s]")
    total.set_title(f"{count} ranks; final max / min {worked[-1].max() / worked[-1].min():.3g}")
    imbalance.plot(time, spent.max(axis=1) / spent.mean(axis=1), color=style.ACCENT, linewidth=1.2)
    imbalance.set_ylabel("load imbalance,\nmax / mean [-]")
    imbalance.set_ylim(bottom=1)
    step.plot(time, lock_step[:, 0], color=style.ACCENT, linewidth=1.2)
    step.set_ylabel("lock step [-]")
    step.set_ylim(0, 1)
    own.set_ylabel("elements")
    own.set_ylim(bottom=0)
    own.set_xlabel("time [µs]")
    figure.align_ylabels()
    return figure
