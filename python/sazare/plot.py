"""Curves of a run: energy, broken joints, gauges, fragments, steps, time. Each returns a matplotlib Figure, or None without data."""

import matplotlib
import numpy as np
from matplotlib.ticker import NullFormatter

from sazare import style

MOST_GAUGES = 6


def _time(table):
    """Times in a readable unit, and the axis label."""
    factor, prefix = style.prefix_for(table["time"].max(initial=0.0))
    return table["time"] / factor, f"time [{prefix}s]"


@style.styled
def energy(results):
    """Where the work of the loads went, stacked, against the work; below, what the ledger does not account for."""
    history = results.history
    if "energy_work" not in history or history.rows < 2:
        return None
    time, label = _time(history)
    terms = [name for name in style.ENERGY_TERMS if name in history and np.any(history[name] != 0.0)]
    work = history["energy_work"]
    factor, prefix = style.prefix_for(np.abs(work).max())
    figure = style.figure(9.0, 5.2)
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=(3.4, 1.0))
    if terms:
        upper.stackplot(
            time, [np.maximum(history[name], 0.0) / factor for name in terms],
            labels=[style.ENERGY_TERMS[name][0] for name in terms], colors=[style.ENERGY_TERMS[name][1] for name in terms],
            linewidth=0.4, edgecolor="white",
        )
    upper.plot(time, work / factor, color=style.INK, linewidth=1.6, linestyle="--", label="work of the loads")
    upper.set_ylabel(f"energy [{prefix}J]")
    handles, labels = upper.get_legend_handles_labels()
    upper.legend(handles[::-1], labels[::-1], loc="center left", bbox_to_anchor=(1.0, 0.5))
    scale = np.maximum.accumulate(np.abs(work))
    share = np.divide(history["energy_residual"], scale, out=np.zeros_like(work), where=scale > 0.0)
    # The first samples divide round-off by almost no work.
    share[scale < 1e-3 * scale.max()] = np.nan
    lower.plot(time, share, color=style.ACCENT, linewidth=1.3)
    lower.axhline(0.0, color="#8a8a8a", linewidth=0.8)
    lower.set_ylabel("residual\n/ work [-]")
    lower.set_xlabel(label)
    lower.ticklabel_format(axis="y", style="sci", scilimits=(-2, 2))
    lower.margins(x=0)
    return figure


@style.styled
def broken_joints(results):
    """Broken joints and fragments against time."""
    history = results.history
    if "broken_joints" not in history or history.rows < 2:
        return None
    time, label = _time(history)
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    axes.plot(time, history["broken_joints"], color=style.ACCENT, linewidth=2.0)
    axes.fill_between(time, history["broken_joints"], color=style.ACCENT, alpha=0.12, linewidth=0.0)
    axes.set_ylabel("broken joints", color=style.ACCENT)
    axes.set_xlabel(label)
    axes.margins(x=0)
    axes.set_ylim(bottom=0)
    if "fragments" in history:
        other = axes.twinx()
        other.grid(False)
        other.spines["right"].set_visible(True)
        other.plot(time, history["fragments"], color=style.SECOND, linewidth=1.6)
        other.set_ylabel("fragments", color=style.SECOND)
        other.set_ylim(bottom=0)
    return figure


@style.styled
def smallest_step(results):
    """The smallest step of any element against time."""
    history = results.history
    if "smallest_step" not in history or history.rows < 2 or not np.any(history["smallest_step"] > 0.0):
        return None
    time, label = _time(history)
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    axes.step(time, np.where(history["smallest_step"] > 0.0, history["smallest_step"], np.nan), color=style.SECOND, where="post")
    axes.set_yscale("log")
    axes.set_ylabel("smallest step [s]")
    axes.set_xlabel(label)
    axes.margins(x=0)
    return figure


@style.styled
def gauges(results):
    """The velocity at every gauge, in components and in magnitude, with its peak."""
    chosen = list(results.gauges.values())[:MOST_GAUGES]
    if not chosen or len(chosen[0].time) < 2:
        return None
    figure = style.figure(9.0, 0.7 + 1.9 * len(chosen))
    rows = figure.subplots(len(chosen), 1, sharex=True, squeeze=False)[:, 0]
    factor, prefix = style.prefix_for(chosen[0].time.max())
    for axes, gauge in zip(rows, chosen):
        time = gauge.time / factor
        for component, color in zip(range(3), (style.ACCENT, style.SECOND, "#7a9a3f")):
            axes.plot(time, gauge.velocity[:, component], color=color, linewidth=1.2, label="xyz"[component])
        axes.plot(time, gauge.speed, color=style.INK, linewidth=0.9, alpha=0.6, label="magnitude")
        peak = int(np.argmax(gauge.speed))
        axes.plot(time[peak], gauge.speed[peak], "o", color=style.INK, markersize=4)
        axes.set_title(f"{gauge.name}: peak particle velocity {style.quantity(gauge.ppv, 'm/s')}")
        axes.set_ylabel("velocity [m/s]")
        axes.margins(x=0)
    rows[0].legend(loc="upper right", ncols=4)
    rows[-1].set_xlabel(f"time [{prefix}s]")
    return figure


def passing(sizes, volumes):
    """The size curve: sizes ascending [m], and the share of the volume in fragments of at most that size."""
    order = np.argsort(sizes)
    total = volumes.sum()
    return sizes[order], np.cumsum(volumes[order]) / total if total > 0.0 else np.zeros(len(order))


@style.styled
def fragment_curve(results):
    """The share of the volume that passes a size, with X50 and X80."""
    fragments = results.fragments
    if fragments.rows < 1:
        return None
    sizes, share = passing(fragments["size"], fragments["volume"])
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    axes.step(sizes, 100.0 * share, where="post", color=style.SECOND, linewidth=1.8)
    axes.plot(sizes, 100.0 * share, "o", color=style.SECOND, markersize=2.5)
    axes.set_xscale("log")
    spread = np.log10(sizes[-1] / sizes[0]) if sizes[0] > 0.0 else 0.0
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter("{x:g}" if spread < 1.0 else NullFormatter())
    axes.set_ylim(0, 104)
    axes.set_xlabel("size: diameter of the sphere of the same volume [m]")
    axes.set_ylabel("passing by volume [%]")
    for name, level in (("x50", 50.0), ("x80", 80.0)):
        size = results.figures.get(name)
        if size:
            axes.plot([size, size, sizes[0]], [0.0, level, level], color=style.ACCENT, linewidth=1.0, linestyle="--")
            axes.annotate(
                f"{name.upper()} = {style.quantity(size, 'm')}", (sizes[0], level), xytext=(2, 3), textcoords="offset points",
                color=style.ACCENT,
            )
    return figure


@style.styled
def timing(results):
    """Where the computing time went."""
    table = results.timing
    if table.rows < 1:
        return None
    order = np.argsort(table["seconds"])
    figure = style.figure(6.2, 0.8 + 0.32 * len(order))
    axes = figure.subplots()
    bars = axes.barh(table["part"][order], table["seconds"][order], color=style.SECOND, height=0.65)
    axes.bar_label(bars, [f"{share:.0%}" for share in table["share"][order]], padding=4, color="#555555")
    axes.set_xlabel("time [s]")
    axes.grid(axis="y", visible=False)
    axes.margins(x=0.12)
    return figure


@style.styled
def ranks(results):
    """What every rank of a run did: processor time cumulated, imbalance of the intervals, and where the ranges are cut."""
    table = results.ranks
    if table.rows < 1:
        return None
    count = int(table["rank"].max()) + 1
    time = table["time"].reshape(-1, count)[:, 0] * 1e6
    worked, first = (table[name].reshape(-1, count) for name in ("processor_time", "first_element"))
    spent = np.diff(worked, axis=0, prepend=0)
    figure = style.figure(7.4, 7.2)
    total, share, cuts = figure.subplots(3, 1, sharex=True, gridspec_kw={"height_ratios": [3, 2, 3]})
    colors = matplotlib.colormaps["viridis"](np.linspace(0, 0.9, count))
    for rank in range(count):
        total.plot(time, worked[:, rank], color=colors[rank], linewidth=1.2)
        cuts.step(time, first[:, rank], color=colors[rank], linewidth=1.2, where="pre")
    total.set_ylabel("processor time [s]")
    total.set_title(f"{count} ranks; at the end largest over smallest {worked[-1].max() / worked[-1].min():.3g}")
    share.plot(time, spent.max(axis=1) / spent.mean(axis=1), color=style.ACCENT, linewidth=1.2)
    share.set_ylabel("largest over mean\nof an interval")
    share.set_ylim(bottom=1)
    cuts.set_ylabel("first element")
    cuts.set_xlabel("time [us]")
    figure.align_ylabels()
    return figure
