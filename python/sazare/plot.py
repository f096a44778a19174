"""Curves that several methods share: energy balance, gauges, fragments, timing. Each returns a matplotlib Figure, or None without data."""

import numpy as np
from matplotlib.ticker import NullFormatter

from sazare import curve_styles, style
from sazare.ground_motion.gauges import from_below

MOST_GAUGES = 6
MOST_FORCES = 6
LEAST_FORCE = 1e-3  # of the one that varies most


def time_axis(table):
    """Times in a readable unit, and the axis label."""
    factor, prefix = style.prefix_for(table["time"].max(initial=0.0))
    return table["time"] / factor, f"time [{prefix}s]"


@style.styled
def energy(results, terms, works=("energy_work",)):
    """Stored and dissipated energy [J] by cause, stacked, and the work; below, the residual as a share of the work [-]. Without work,
    which some runs do not record, the energies alone.

    terms: column of the history -> (name, colour), from the bottom of the stack up. works: columns whose sum is the work.
    """
    history = results.history
    known = [name for name in works if name in history]
    shown = [name for name in terms if name in history and np.any(history[name] != 0.0)]
    if history.rows < 2 or not (known or shown):
        return None
    time, label = time_axis(history)
    stored = np.array([np.maximum(history[name], 0.0) for name in shown]).reshape(len(shown), -1)
    work = sum(history[name] for name in known) if known else None
    factor, prefix = style.prefix_for(max(np.abs(work).max() if known else 0.0, stored.sum(axis=0).max(initial=0.0)))
    balanced = known and "energy_residual" in history
    figure = style.figure(9.0, 5.2 if balanced else 3.8)
    axes = figure.subplots(2, 1, sharex=True, height_ratios=(3.4, 1.0)) if balanced else [figure.subplots()]
    upper = axes[0]
    if shown:
        upper.stackplot(
            time, stored / factor, labels=[terms[name][0] for name in shown], colors=[terms[name][1] for name in shown],
            linewidth=0.4, edgecolor="white",
        )
    if known:
        # Some methods count the energy that the body has at the start, as ground under its own weight does.
        begun = float(stored[:, 0].sum()) if len(stored) else 0.0
        words = "external work" if begun <= 1e-3 * np.abs(work).max() else "energy at the start\nand external work"
        upper.plot(time, (work + begun) / factor, color=style.INK, linewidth=1.6, linestyle="--", label=words)
    upper.set_ylabel(f"energy [{prefix}J]")
    handles, labels = upper.get_legend_handles_labels()
    upper.legend(handles[::-1], labels[::-1], loc="center left", bbox_to_anchor=(1.0, 0.5))
    upper.margins(x=0)
    axes[-1].set_xlabel(label)
    if balanced:
        _residual(axes[1], time, history["energy_residual"], work)
    return figure


def _residual(axes, time, residual, work):
    """The residual as a share of the largest work so far."""
    scale = np.maximum.accumulate(np.abs(work))
    share = np.divide(residual, scale, out=np.zeros_like(work), where=scale > 0.0)
    # The first samples divide round-off by almost no work.
    share[scale < 1e-3 * scale.max()] = np.nan
    axes.plot(time, share, color=style.ACCENT, linewidth=1.3)
    axes.axhline(0.0, color="#8a8a8a", linewidth=0.8)
    axes.set_ylabel("residual\n/ work [-]")
    axes.ticklabel_format(axis="y", style="sci", scilimits=(-2, 2))


@style.styled
def gauges(results):
    """Velocity [m/s] at every gauge against time, components and magnitude, with its peak."""
    kept = curve_styles.spread(from_below(results, list(results.gauges)), MOST_GAUGES)
    chosen = [gauge for gauge in results.gauges.values() if gauge.name in kept]
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
    rows[0].legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=4, borderaxespad=0.2)
    rows[-1].set_xlabel(f"time [{prefix}s]")
    curve_styles.tell_left_out(figure, list(results.gauges), kept, "gauges.csv")
    return figure


def force_columns(history):
    """Names of the columns of a history that are forces of boundaries which are not zero throughout."""
    return [name for name in history if name[:-2].endswith(".force") and np.any(history[name] != 0.0)]


@style.styled
def boundary_forces(results):
    """Forces [N] of the boundaries on the body against time, those that vary most."""
    history = results.history
    names = force_columns(history)
    if not names or history.rows < 2:
        return None
    time, time_label = time_axis(history)
    ranges = {name: np.ptp(history[name]) for name in names}
    names = sorted((name for name in names if ranges[name] > LEAST_FORCE * max(ranges.values())), key=lambda name: -ranges[name])
    factor, prefix = style.prefix_for(max(np.abs(history[name]).max() for name in names))
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    curve_styles.tell_left_out(figure, names, names[:MOST_FORCES], "history.csv")
    for name in names[:MOST_FORCES]:
        group, axis = name[:-2].removesuffix(".force"), name[-1]
        axes.plot(time, history[name] / factor, linewidth=1.1, label=f"{group} along {axis}")
    axes.set_xlabel(time_label)
    axes.set_ylabel(f"force on the body [{prefix}N]")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3)
    axes.margins(x=0)
    return figure


def passing(sizes, volumes):
    """The size distribution: sizes ascending [m] (n,), and the share of the volume in fragments up to each size [-] (n,)."""
    order = np.argsort(sizes)
    total = volumes.sum()
    return sizes[order], np.cumsum(volumes[order]) / total if total > 0.0 else np.zeros(len(order))


@style.styled
def fragment_curve(results):
    """Cumulative volume passing [%] against fragment size [m], with P50 and P80."""
    fragments = results.fragments
    if fragments.rows < 1:
        return None
    sizes, share = passing(fragments["size"], fragments["volume"])
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    # Straight in size, as P50 and P80 are read from it; on an axis of logarithms that is curved.
    between = np.unique(np.concatenate([sizes, np.linspace(sizes[0], sizes[-1], 2000), np.geomspace(max(sizes[0], 1e-12), sizes[-1], 500)]))
    axes.plot(between, 100.0 * np.interp(between, sizes, share), color=style.SECOND, linewidth=1.8)
    axes.plot(sizes, 100.0 * share, "o", color=style.SECOND, markersize=2.5)
    axes.set_xscale("log")
    spread = np.log10(sizes[-1] / sizes[0]) if sizes[0] > 0.0 else 0.0
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter("{x:g}" if spread < 1.0 else NullFormatter())
    axes.set_ylim(0, 104)
    axes.set_xlabel("fragment size: equivalent sphere diameter [m]")
    axes.set_ylabel("cumulative volume passing [%]")
    for level in (50.0, 80.0):
        size = float(np.interp(0.01 * level, share, sizes))
        axes.plot([size, size, sizes[0]], [0.0, level, level], color=style.ACCENT, linewidth=1.0, linestyle="--")
        axes.annotate(
            f"P{level:.0f} = {style.quantity(size, 'm')}", (sizes[0], level), xytext=(2, 3), textcoords="offset points", color=style.ACCENT,
        )
    return figure


@style.styled
def timing(results):
    """Computing time [s] by part."""
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
