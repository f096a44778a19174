"""Pictures of a run of method hybrid: both sides together, and what goes over the surface. Each returns a Figure, or None without data."""

import numpy as np
from matplotlib.collections import EllipseCollection, PolyCollection

from sazare import finite, style

MOST_PICTURES = 4
AXES = "xyz"


def _along(history, name):
    """The axis along which a vector of the history is largest, and its column."""
    columns = [history[f"{name}_{axis}"] for axis in AXES]
    axis = int(np.argmax([np.abs(column).max() for column in columns]))
    return AXES[axis], columns[axis]


def _frame(meshes, clouds):
    """Lower and upper corner, in the plane, of all that is drawn."""
    corners = [np.asarray(mesh.points)[:, :2] for mesh in meshes]
    for cloud in clouds:
        points, radius = np.asarray(cloud.points)[:, :2], np.asarray(cloud.cell_data["radius"])[:, None]
        corners += [points - radius, points + radius]
    corners = np.concatenate(corners)
    return corners.min(axis=0), corners.max(axis=0)


def _draw_sides(axes, mesh, spheres, top):
    """The mesh of a continuum in the plane and the spheres, seen along z."""
    cells = [np.asarray(mesh.points)[cell, :2] for cell in finite.outlines(mesh)]
    colors = [style.RUBBLE(int(region) % style.RUBBLE.N) for region in np.asarray(mesh.cell_data["region"])]
    axes.add_collection(PolyCollection(cells, facecolors=colors, edgecolors="#00000033", linewidths=0.3, alpha=0.55))
    order = np.argsort(np.asarray(spheres.points)[:, 2])
    points, widths = np.asarray(spheres.points)[order, :2], 2.0 * np.asarray(spheres.cell_data["radius"])[order]
    speed = np.linalg.norm(spheres.cell_data["velocity"], axis=1)[order]
    drawn = axes.add_collection(EllipseCollection(widths, widths, np.zeros(len(widths)), units="xy", offsets=points, transOffset=axes.transData,
                                                  array=speed, cmap=style.SPEED, edgecolors="#00000055", linewidths=0.2))
    drawn.set_clim(0.0, top)
    axes.set_aspect("equal")
    axes.grid(False)
    return drawn


@style.styled
def together(results):
    """Both sides at some times, seen along z, the spheres coloured by speed; None for a continuum in space."""
    if len(results.sides) < 2:
        return None
    meshes, clouds = results.sides["continuum"].element_snapshots, results.sides["bodies"].particle_snapshots
    if not len(meshes) or not len(clouds) or not finite.is_flat(meshes[0].elements):
        return None
    chosen = sorted(set(np.linspace(0, min(len(meshes), len(clouds)) - 1, MOST_PICTURES).round().astype(int)))
    top = max(float(np.percentile(np.linalg.norm(clouds[i].elements.cell_data["velocity"], axis=1), 99)) for i in chosen) or 1.0
    low, high = _frame([meshes[i].elements for i in chosen], [clouds[i].elements for i in chosen])
    rows = (len(chosen) + 1) // 2
    height = min(3.8 * (high[1] - low[1]) / (high[0] - low[0]), 5.0)
    figure = style.figure(9.0, 0.4 + rows * (height + 0.6))
    panels = np.ravel(figure.subplots(rows, min(2, len(chosen)), squeeze=False))
    for axes, index in zip(panels, chosen):
        drawn = _draw_sides(axes, meshes[index].elements, clouds[index].elements, top)
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]))
        axes.set_title(f"{meshes[index].time:.3g} s")
    for axes in panels[len(chosen):]:
        axes.set_axis_off()
    figure.colorbar(drawn, ax=list(panels), label="speed of the spheres [m/s]", shrink=0.9)
    return figure


@style.styled
def surface(results):
    """Force of the bodies on the surface and its mean displacement, each along the axis on which it is largest."""
    history = results.history
    if history.rows < 2:
        return None
    figure = style.figure(9.0, 4.6)
    upper, lower = figure.subplots(2, 1, sharex=True)
    for axes, name, words, color in ((upper, "surface.force", "force [N]", style.ACCENT), (lower, "surface.displacement", "displacement [m]", style.SECOND)):
        axis, values = _along(history, name)
        axes.plot(history["time"], values, color=color, linewidth=1.1)
        axes.set_ylabel(f"{words.split()[0]} along {axis} {words.split()[1]}")
        axes.margins(x=0)
    lower.set_xlabel("time [s]")
    return figure


@style.styled
def exchange(results):
    """Work of the bodies on the surface's nodes, and the energy that the surface made or lost."""
    history = results.history
    if history.rows < 2:
        return None
    factor, prefix = style.prefix_for(max(np.abs(history["work_on_nodes"]).max(), np.abs(history["energy_made"]).max()))
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    for name, words, color in (("work_on_nodes", "work on the nodes", style.SECOND), ("work_on_bodies", "work on the bodies", "#9bbf8a"),
                               ("energy_made", "made at the surface", style.ACCENT)):
        axes.plot(history["time"], history[name] / factor, color=color, linewidth=1.1, label=words)
    axes.set_xlabel("time [s]")
    axes.set_ylabel(f"energy [{prefix}J]")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    axes.margins(x=0)
    return figure
