"""Curves of a blast: sizes of fragments, vibration, damage. Each function returns a matplotlib Figure, or None without data."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.ticker import FuncFormatter, MaxNLocator

from sazare import style
from sazare.blast.fits import size_fits
from sazare.blast.limits import LIMITS
from sazare.blast.sizes import SHARES
from sazare.blast.vibration import attenuation

FIT_COLORS = ("#7a9a3f", "#8069c0")
LIMIT_COLORS = ("#8d8d9e", "#5e9c45", "#3f74b5", "#d1b13c", "#d9774a")


@style.styled
def size_distribution(sphere, sieve, oversize=None):
    """Cumulative mass passing [%] over size [m] of detached fragments, by sphere and by sieve (Distributions; the second may be None), with fits,
    P20, P50 and P80, the limit of the mesh and the share above a size [m]."""
    if not len(sphere.sizes):
        return None
    chosen, measured = (sphere, "equivalent sphere") if sieve is None else (sieve, "sieve size")
    figure = style.figure(7.4, 4.4)
    axes = figure.subplots()
    axes.set_xscale("log")
    least = min(one.sizes[0] for one in (sphere, sieve) if one is not None)
    most = max(one.sizes[-1] for one in (sphere, sieve) if one is not None)
    axes.set_xlim(0.8 * least, 1.4 * most)
    if sieve is not None:
        axes.plot(*_steps(sphere), color=style.SECOND, linewidth=1.0, alpha=0.55, label="equivalent sphere")
    axes.plot(*_steps(chosen), color=style.INK, linewidth=2.0, label=measured)
    for fit, color in zip(size_fits(chosen), FIT_COLORS):
        sizes = np.geomspace(fit.lower, fit.upper, 200)
        axes.plot(sizes, 100.0 * fit.passing(sizes), color=color, linewidth=1.4, linestyle="--", label=_fit_words(fit))
    _mark_shares(axes, chosen)
    _mark_limit(axes, chosen.mesh_limit)
    if oversize:
        axes.axvline(oversize, color=style.ACCENT, linewidth=1.0, linestyle=":", label=f"{chosen.oversize(oversize):.0%} above {style.quantity(oversize, 'm')}")
    axes.set_ylim(0, 104)
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter("{x:g}" if most < 5.0 * least else FuncFormatter(_two_and_five))
    axes.set_xlabel(f"fragment size [m]; percentages and fits by {measured}")
    axes.set_ylabel("cumulative mass passing [%]")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    return figure


def _two_and_five(size, _):
    """The label of a size between powers of ten: only of 2 and 5 times such a power."""
    return f"{size:g}" if round(size / 10.0 ** np.floor(np.log10(size))) in (2, 5) else ""


def _steps(distribution, count=800):
    sizes = np.unique(np.concatenate([distribution.sizes, np.geomspace(distribution.sizes[0], distribution.sizes[-1], count)]))
    return sizes, 100.0 * distribution.passing(sizes)


def _fit_words(fit):
    numbers = ", ".join(f"{name} = {value:.3g}" for name, value in fit.parameters.items())
    return f"{fit.name}: {numbers}\nr² = {fit.r2:.3f}, off by {100.0 * fit.worst:.1f} % at most"


def _mark_shares(axes, distribution):
    left = axes.get_xlim()[0]
    for share in SHARES:
        size = distribution.size_at(share)
        axes.plot([size, size, left], [0.0, 100.0 * share, 100.0 * share], color=style.ACCENT, linewidth=0.9, linestyle="--")
        axes.annotate(
            f"P{100 * share:.0f} = {style.quantity(size, 'm')}", (left, 100.0 * share), xytext=(3, 3), textcoords="offset points", color=style.ACCENT,
        )


def _mark_limit(axes, limit):
    """Shades the sizes that are those of elements."""
    if limit > 0.0:
        left, right = axes.get_xlim()
        axes.axvspan(left, min(limit, right), color="#9a9a9a", alpha=0.2, linewidth=0.0, label="sizes of elements: the mesh\ncannot see smaller fragments")


@style.styled
def attenuation_curve(shaken):
    """Peak particle velocity [m/s] over distance or scaled distance of Shakings, with the power law and its bands."""
    known = [one for one in shaken if one.distance and one.ppv > 0.0]
    if not known:
        return None
    ways = [("distance from the nearest charge [m]", "R", [one.distance for one in known])]
    if known[0].charge is not None:
        ways = [
            ("scaled distance R / √W [m/√kg]", "(R/√W)", [one.scaled_distance(0.5) for one in known]),
            ("scaled distance R / ∛W [m/∛kg]", "(R/∛W)", [one.scaled_distance(1.0 / 3.0) for one in known]),
        ]
    figure = style.figure(5.6 * len(ways) + 0.4, 4.0)
    for axes, (label, symbol, distances) in zip(np.ravel(figure.subplots(1, len(ways), squeeze=False)), ways):
        _attenuation_panel(axes, known, distances, label, symbol)
    return figure


def _attenuation_panel(axes, known, distances, label, symbol):
    axes.set_xscale("log")
    axes.set_yscale("log")
    law = attenuation(known, distances)
    if law is not None:
        x = np.geomspace(0.9 * min(distances), 1.1 * max(distances), 100)
        lower, upper = law.confidence(x)
        axes.fill_between(x, lower, upper, color=style.SECOND, alpha=0.18, linewidth=0.0, label="95 % confidence band of the line")
        axes.plot(x, law.at(x), color=style.SECOND, linewidth=1.6, label=f"{law.factor:.3g} {symbol}^{law.exponent:.2f}, r² = {law.r2:.2f}")
        axes.plot(x, law.prediction(x)[1], color=style.SECOND, linewidth=1.0, linestyle="--", label="95 % prediction band of a gauge")
        axes.plot(x, law.prediction(x)[0], color=style.SECOND, linewidth=1.0, linestyle="--")
    for one, distance in zip(known, distances):
        axes.plot(distance, one.ppv, "^" if one.rises else "o", color=style.ACCENT, markersize=6, markerfacecolor="none" if one.rises else style.ACCENT)
        axes.annotate(one.name, (distance, one.ppv), xytext=(6, 4), textcoords="offset points", fontsize=8, color="#555555")
    if any(one.rises for one in known):
        axes.plot([], [], "^", color=style.ACCENT, markerfacecolor="none", label="still rising at the end: not fitted")
    ppv = [one.ppv for one in known]
    axes.set_xlim(0.75 * min(distances), 1.6 * max(distances))
    axes.set_ylim(0.3 * min(ppv), 4.0 * max(ppv))
    for axis, values in ((axes.xaxis, distances), (axes.yaxis, ppv)):
        axis.set_major_formatter("{x:g}")
        axis.set_minor_formatter("{x:g}" if max(values) < 3.0 * min(values) else FuncFormatter(_two_and_five))
    axes.set_xlabel(label)
    axes.set_ylabel("peak particle velocity [m/s]")
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="best", fontsize=8)


@style.styled
def limit_curves(shaken):
    """The strongest component [mm/s] of gauges over its frequency [Hz], with the limits of DIN 4150-3 and of USBM RI 8507."""
    known = [one for one in shaken if one.frequency is not None and one.ppv > 0.0]
    if not known:
        return None
    figure = style.figure(7.8, 4.4)
    axes = figure.subplots()
    top = 1.5 * max(100.0, *(one.frequency for one in known))
    for limit, color in zip(LIMITS, LIMIT_COLORS):
        told = np.geomspace(limit.frequencies[0], limit.frequencies[-1], 300)
        axes.loglog(told, 1e3 * limit.at(told), color=color, linewidth=1.6, label=f"{limit.name}: {limit.words}")
        axes.loglog([limit.frequencies[-1], top], 1e3 * limit.at([limit.frequencies[-1]] * 2), color=color, linewidth=1.0, linestyle=":")
    named = []
    for one in sorted(known, key=lambda one: -one.ppv):
        place = np.array([one.frequency, 1e3 * one.peaks[one.axis]])
        axes.plot(*place, "o", color=style.ACCENT, markersize=6)
        if all(np.abs(np.log(place / other)).max() > 0.4 for other in named):  # names that would lie on each other are left out
            axes.annotate(one.name, place, xytext=(6, 4), textcoords="offset points", fontsize=8, color="#555555")
            named.append(place)
    handles, labels = axes.get_legend_handles_labels()
    handles.append(Line2D([], [], color=style.ACCENT, marker="o", linestyle=""))
    axes.legend(handles, [*labels, "gauge: strongest component"], loc="center left", bbox_to_anchor=(1.0, 0.5), fontsize=8)
    axes.set_xlim(1.0, top)
    axes.xaxis.set_major_formatter("{x:g}")
    axes.yaxis.set_major_formatter("{x:g}")
    axes.set_xlabel("frequency of the half cycle with the peak [Hz]")
    axes.set_ylabel("velocity [mm/s]")
    return figure


@style.styled
def damage_curves(damages):
    """Share of broken joint area [%] over the distance from the axis of each hole, and the broken area by direction about it."""
    known = [damage for damage in damages if damage.rings() is not None]
    if not known:
        return None
    figure = style.figure(9.6, 4.2)
    left = figure.add_subplot(1, 2, 1)
    right = figure.add_subplot(1, 2, 2, projection="polar")
    colors = style.RUBBLE.colors
    for number, damage in enumerate(known):
        edges, share = damage.rings()
        color = colors[number % len(colors)]
        left.stairs(100.0 * share, edges, color=color, linewidth=1.0, alpha=0.6)
        distances, broken = damage.decrease
        left.plot(distances, 100.0 * broken, color=color, linewidth=1.8, label=f"{damage.name}: 50 % within {style.quantity(damage.radius(0.5), 'm')}")
        sectors, area = damage.by_direction()
        right.stairs(area, sectors, color=color, linewidth=1.5, fill=len(known) == 1, alpha=0.6 if len(known) == 1 else 1.0)
    left.set_xlabel("distance from the axis [m]")
    left.set_ylabel("broken share of the joint area in a ring [%]")
    left.set_ylim(0.0, 105.0)
    left.set_xlim(0.0, max(damage.rings()[0][-1] for damage in known))
    left.legend(loc="upper right", fontsize=8)
    right.set_title("broken area [m²] by direction about the axis")
    right.set_xticks(np.linspace(0.0, 2.0 * np.pi, 4, endpoint=False), _direction_words(known[0]))
    right.tick_params(labelsize=8)
    right.yaxis.set_major_locator(MaxNLocator(4))
    return figure


def _direction_words(damage):
    """What the four directions are, as axes of the model where they lie along them."""
    words = []
    for direction in (damage.right, damage.up, -damage.right, -damage.up):
        axis = int(np.argmax(np.abs(direction)))
        plain = abs(direction[axis]) > 0.999
        words.append(f"{'+' if direction[axis] > 0 else '−'}{'xyz'[axis]}" if plain else "(" + ", ".join(f"{value:.2f}" for value in direction) + ")")
    return words


@style.styled
def absorbed_energy(results):
    """Energy [J] that has left through each boundary over time."""
    history = results.history
    names = [name for name in history if name.endswith(".absorbed") and np.any(history[name] != 0.0)]
    if not names or history.rows < 2:
        return None
    factor, prefix = style.prefix_for(history["time"].max(initial=0.0))
    unit, energy_prefix = style.prefix_for(max(np.abs(history[name]).max() for name in names))
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    for name in sorted(names, key=lambda name: -history[name][-1]):
        axes.plot(history["time"] / factor, history[name] / unit, linewidth=1.5, label=f"{name.removesuffix('.absorbed')}: {style.quantity(history[name][-1], 'J')}")
    axes.set_xlabel(f"time [{prefix}s]")
    axes.set_ylabel(f"energy absorbed [{energy_prefix}J]")
    axes.margins(x=0)
    axes.legend(loc="upper left", fontsize=8)
    return figure
