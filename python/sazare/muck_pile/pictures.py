"""Pictures of a muck pile. Each function returns a matplotlib Figure, or None without data."""

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.colors import LogNorm
from matplotlib.patches import Rectangle

from sazare import style
from sazare.blast.holes import holes_of
from sazare.muck_pile.elements import FACES, outer_faces
from sazare.muck_pile.heights import axes_of, heights_of_triangles

SHOWN = 0.98  # of the mass that a picture of places shows: flyrock lies far away
MIDDLE = 0.5  # of the width of the pile, over which the heights of a section are averaged


def pictures_of(numbers):
    """The pictures that there is data for: (name, matplotlib Figure)."""
    drawn = {"profile": profile(numbers), "throw": throw_distribution(numbers), "plan": plan(numbers), "back_break": back_break(numbers)}
    return [(name, figure) for name, figure in drawn.items() if figure is not None]


def _reach(values, masses):
    """From where to where most of the mass lies."""
    order = np.argsort(values)
    share = np.cumsum(masses[order]) / masses.sum()
    low, high = np.interp([0.5 * (1.0 - SHOWN), 0.5 * (1.0 + SHOWN)], share, values[order])
    return float(low), float(high)


def _section(heights, across, along, default):
    """Mean tops of Heights in columns (k,) [m] along the throw over a range across it; `default` where nothing is there."""
    size = heights.size
    middle = (heights.cells[:, 1] + 0.5) * size
    own = (middle >= across[0]) & (middle <= across[1])
    number, tops = heights.cells[own, 0], heights.tops[own]
    place = np.searchsorted(along, number)
    known = (place < len(along)) & (along[np.minimum(place, len(along) - 1)] == number)
    total, count = (np.bincount(place[known], weights, minlength=len(along)) for weights in (tops[known], None))
    return np.where(count > 0, total / np.maximum(count, 1), default)


@style.styled
def profile(numbers):
    """Section of the pile along the throw, with the rock before the blast and the rock that stays: means over the middle of the width."""
    model, pile = numbers.model, numbers.pile
    axes_here, masses = axes_of(model.direction), model.bodies.mass
    loose = model.elements.start[model.loose]
    across = (loose @ axes_here)[:, :, 1]
    centre, half = 0.5 * (across.min() + across.max()), 0.5 * MIDDLE * (across.max() - across.min())
    over = (centre - half, centre + half)
    low, high = _reach(numbers.ends @ model.direction, masses)
    ahead = model.elements.start @ model.direction
    low, high = min(low, float(ahead.min())), max(high, float(ahead[model.loose].max()))
    size = pile.heights.size
    along = np.arange(int(np.floor(low / size)) - 2, int(np.ceil(high / size)) + 2)
    before = heights_of_triangles(model.elements.start[:, FACES][outer_faces(model.elements.nodes)], model.direction, size)
    places = (along + 0.5) * size
    rock = np.maximum(_section(pile.rock, over, along, model.ground), model.ground)
    top = np.maximum(_section(pile.heights, over, along, model.ground), rock)  # what lies under an overhang is not seen
    figure = style.figure(8.4, 3.6)
    axes = figure.subplots()
    bottom = model.ground - 0.15 * max(float(before.tops.max()) - model.ground, size)
    axes.fill_between(places, bottom, rock, color=style.STONE, linewidth=0.0, label="rock that stays, ground")
    axes.fill_between(places, rock, top, where=top > rock, color=style.SECOND, alpha=0.55, linewidth=0.0, label="muck pile")
    axes.plot(places, _section(before, over, along, np.nan), color=style.ACCENT, linewidth=1.4, linestyle="--", label="before the blast")
    axes.axvline(model.toe, color=style.INK, linewidth=0.8, linestyle=":", label="toe")
    axes.set_xlim(places[0], places[-1])
    axes.set_ylim(bottom, None)
    axes.set_aspect("equal")
    axes.set_xlabel("along the throw [m]")
    axes.set_ylabel("z [m]")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.28), ncols=4)
    return figure


@style.styled
def throw_distribution(numbers):
    """Mass that was thrown less far, over the horizontal throw; the farthest fragment and its flight without drag."""
    distribution, farthest = numbers.distribution, numbers.farthest
    figure = style.figure(7.0, 3.8)
    axes = figure.subplots()
    axes.plot(np.append(0.0, distribution.sizes), 100.0 * np.append(0.0, distribution.shares), color=style.INK, linewidth=1.8)
    for share in (0.5, 0.9):
        throw = distribution.size_at(share)
        axes.plot([throw, throw], [0.0, 100.0 * share], color=style.ACCENT, linewidth=0.9, linestyle="--")
        axes.annotate(f"{share:.0%}: {style.quantity(throw, 'm')}", (throw, 100.0 * share), xytext=(5, -11), textcoords="offset points", color=style.ACCENT)
    axes.axvline(farthest.throw, color=style.SECOND, linewidth=1.0, linestyle=":", label=f"farthest fragment: {style.quantity(farthest.throw, 'm')}")
    axes.set_xlim(0.0, 1.1 * farthest.throw)
    axes.set_ylim(0.0, 104.0)
    axes.set_xlabel("horizontal throw [m]")
    axes.set_ylabel("mass thrown less far [%]")
    axes.legend(loc="lower right")
    return figure


@style.styled
def plan(numbers):
    """Plan of where the fragments lie, by size; the rock before the blast, the holes and the toe."""
    model, bodies = numbers.model, numbers.model.bodies
    axes_here = axes_of(model.direction)
    ends = numbers.ends @ axes_here
    low, high = (np.array(pair) for pair in zip(*(_reach(ends[:, axis], bodies.mass) for axis in (0, 1))))
    corners = (model.elements.start @ axes_here).reshape(-1, 2)
    low, high = np.minimum(low, corners.min(axis=0)), np.maximum(high, corners.max(axis=0))
    shown = np.all((ends >= low) & (ends <= high), axis=1) & ~model.fines
    order = np.flatnonzero(shown)[np.argsort(-bodies.sizes[shown])]
    figure = style.figure(7.6, 5.2)
    axes = figure.subplots()
    box = corners.min(axis=0), corners.max(axis=0)
    axes.add_patch(Rectangle(box[0], *(box[1] - box[0]), facecolor=style.STONE, edgecolor=style.STONE_EDGE, linewidth=0.8, label="model before the blast"))
    drawn = EllipseCollection(
        bodies.sizes[order], bodies.sizes[order], np.zeros(len(order)), units="xy", offsets=ends[order], transOffset=axes.transData, array=bodies.sizes[order],
        cmap=style.SIZE, norm=LogNorm(), linewidths=0.2, edgecolors=style.INK,
    )
    axes.add_collection(drawn)
    axes.axvline(model.toe, color=style.INK, linewidth=0.8, linestyle=":", label="toe")
    holes = holes_of(numbers.results)
    if holes:
        axes.plot(*(np.array([hole.first for hole in holes]) @ axes_here).T, "o", color=style.ACCENT, markersize=4, label="holes")
    axes.set_xlim(low[0] - 0.5, high[0] + 0.5)
    axes.set_ylim(low[1] - 0.5, high[1] + 0.5)
    axes.set_aspect("equal")
    axes.set_xlabel(f"along the throw [m]; outside the picture: {int(np.sum(~shown & ~model.fines))} fragments")
    axes.set_ylabel("across the throw [m]")
    bar = figure.colorbar(drawn, ax=axes, label="size [m]", shrink=0.8, format="{x:g}")
    bar.ax.yaxis.set_minor_formatter("{x:g}")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=3)
    return figure


@style.styled
def back_break(numbers):
    """How far rock came loose behind the line of holes and beside the outermost ones, by height; None without holes."""
    found = numbers.back_breaks
    if not found:
        return None
    figure = style.figure(6.0, 3.6)
    axes = figure.subplots()
    edges = np.array([one.upper for one in found] + [found[-1].lower])
    sides = (("behind", style.ACCENT, "behind the line of holes"), ("left", style.SECOND, "beside them, left of the throw"), ("right", style.INK, "right of the throw"))
    for name, color, label in sides:
        axes.stairs([getattr(one, name) for one in found][::-1], edges[::-1], orientation="horizontal", color=color, linewidth=1.6, label=label, baseline=None)
    axes.set_xlim(0.0, None)
    axes.set_xlabel("distance up to which rock came loose [m]")
    axes.set_ylabel("z [m]")
    axes.legend()
    return figure
