"""Method hybrid: finite elements and bodies of another method, coupled over a surface."""

from dataclasses import replace
from functools import partial

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import EllipseCollection, PolyCollection
from matplotlib.colors import Normalize

from sazare import plot, style
from sazare.methods import Figure, Method, Section, common, fem, method_of, spheres
from sazare.moments import moments_of
from sazare.outside import outer_faces
from sazare.snapshots import elements_once

MOST_PICTURES = 4
AMBIENT = 0.4  # share of the light that reaches sides in the shade
FLAT = 0.3  # height over width below which panels stand one above the other
AXES = "xyz"


def is_plane(results):
    """Whether the continuum is in the plane, with y upwards."""
    return "continuum" in results.sides and "dimension = 2" in results.sides["continuum"].case_text


def _along(history, name):
    """The axis along which a vector of the history is largest, and its column."""
    columns = [history[f"{name}_{axis}"] for axis in AXES]
    axis = int(np.argmax([np.abs(column).max() for column in columns]))
    return AXES[axis], columns[axis]


def _corners(grid):
    """(n, 2) corners, in the plane, of every body that is no sphere: squares and polygons, supports left out."""
    corners = np.split(np.asarray(grid.points)[:, :2], np.asarray(grid.offset)[1:-1])
    return [corners[i] for i in np.flatnonzero(_is_body(grid))]


def _is_body(grid):
    """Which cells are bodies."""
    return np.asarray(grid.cell_data["block"]) >= 0 if "block" in grid.cell_data else np.ones(grid.n_cells, dtype=bool)


def _radii(cloud):
    """Radius of every body [m] where bodies are round: spheres, and particles of ground, which are as wide as their spacing; else None."""
    if "radius" in cloud.cell_data:
        return np.asarray(cloud.cell_data["radius"])
    return 0.5 * np.asarray(cloud.cell_data["spacing"]) if "spacing" in cloud.cell_data else None


def _speed(grid):
    """Speed of every body [m/s]."""
    return np.linalg.norm(np.asarray(grid.cell_data["velocity"])[_is_body(grid)], axis=1)


def _frame(meshes, clouds):
    """Lower and upper corner, in the plane, of all that is drawn."""
    corners = [np.asarray(mesh.points)[:, :2] for mesh in meshes]
    for cloud in clouds:
        if (radii := _radii(cloud)) is not None:
            points, radius = np.asarray(cloud.points)[:, :2], radii[:, None]
            corners += [points - radius, points + radius]
        else:
            corners += _corners(cloud) if "block" in cloud.cell_data else [np.asarray(cloud.points)[:, :2]]
    corners = np.concatenate(corners)
    return corners.min(axis=0), corners.max(axis=0)


def _spheres(axes, cloud):
    order = np.argsort(np.asarray(cloud.points)[:, 2])
    points, widths = np.asarray(cloud.points)[order, :2], 2.0 * _radii(cloud)[order]
    return EllipseCollection(widths, widths, np.zeros(len(widths)), units="xy", offsets=points, transOffset=axes.transData,
                             array=_speed(cloud)[order], cmap=style.SPEED, edgecolors="#000000aa", linewidths=0.3)


def _polygons(cloud):
    """Squares and polygons, or the outside of tetrahedra seen along z."""
    if "block" in cloud.cell_data:
        corners, speed = _corners(cloud), _speed(cloud)
    else:
        faces, cells = outer_faces(cloud)
        order = np.argsort(faces[:, :, 2].mean(axis=1))
        corners, speed = list(faces[order, :, :2]), _speed(cloud)[cells[order]]
    return PolyCollection(corners, array=speed, cmap=style.SPEED, edgecolors="#000000aa", linewidths=0.4)


def _draw_sides(axes, mesh, cloud, top):
    """The mesh of a continuum in the plane and the bodies, seen along z."""
    cells = [np.asarray(mesh.points)[cell, :2] for cell in fem.outlines(mesh)]
    colors = [style.GROUND[int(region) % len(style.GROUND)] for region in np.asarray(mesh.cell_data["region"])]
    axes.add_collection(PolyCollection(cells, facecolors=colors, edgecolors="#ffffff", linewidths=0.4))
    drawn = axes.add_collection(_spheres(axes, cloud) if _radii(cloud) is not None else _polygons(cloud))
    drawn.set_clim(0.0, top)
    axes.set_aspect("equal")
    axes.grid(False)
    return drawn


def _chosen(results):
    """Meshes and bodies at times between which both together move equally far, each side counted alike, as (time, mesh, bodies)."""
    if len(results.sides) < 2:
        return []
    meshes, clouds = results.sides["continuum"].all_snapshots, results.sides["bodies"].all_snapshots
    return [(meshes[i].time, meshes[i].elements, clouds[i].elements) for i in moments_of([meshes, clouds], MOST_PICTURES)]


def moving(results):
    """(time [s], figure) of every snapshot of both sides, with the same axes and colours."""
    chosen = _chosen(results)
    if not chosen:
        return
    meshes, clouds = results.sides["continuum"].all_snapshots, results.sides["bodies"].all_snapshots
    top, clipped = style.clipped_top(np.concatenate([_speed(cloud) for _, _, cloud in chosen]))
    extent = _frame([mesh for _, mesh, _ in chosen], [cloud for _, _, cloud in chosen])
    for mesh, cloud in zip(meshes, clouds, strict=False):  # a run that was stopped may lack one
        yield mesh.time, _moment((mesh.time, elements_once(mesh), elements_once(cloud)), top, extent, clipped)


@style.styled
def _moment(frame, top, extent, clipped):
    """A figure of both sides at one time, with a scale of colours up to `top`, which may be clipped."""
    figure, panels = _in_plane([frame], top, extent) if fem.is_flat(frame[1]) else _in_space([frame], top)
    panels[0].set_title(style.quantity(frame[0], "s") if frame[0] else "0 s")
    style.colorbar(figure, ScalarMappable(Normalize(0.0, top), style.SPEED), list(panels), "speed of the bodies [m/s]", clipped, shrink=0.9)
    return figure


@style.styled
def together(results):
    """Both sides at some times, the bodies coloured by speed: seen along z, or from a corner where the continuum is in space."""
    frames = _chosen(results)
    if not frames:
        return None
    top, clipped = style.clipped_top(np.concatenate([_speed(cloud) for _, _, cloud in frames]))
    figure, panels = (_in_plane if fem.is_flat(frames[0][1]) else _in_space)(frames, top)
    for axes, (time, _, _) in zip(panels, frames):
        axes.set_title(style.quantity(time, "s"))
    for axes in panels[len(frames):]:
        axes.set_axis_off()
    scale = ScalarMappable(Normalize(0.0, top), style.SPEED)
    style.colorbar(figure, scale, list(panels), "speed of the bodies [m/s]", clipped, shrink=0.9)
    return figure


def _in_plane(frames, top, extent=None):
    """A figure of both sides, seen along z; `extent`: lower and upper corner of the panels, where they are not those of the frames."""
    low, high = extent or _frame([mesh for _, mesh, _ in frames], [cloud for _, _, cloud in frames])
    ratio = (high[1] - low[1]) / (high[0] - low[0])
    columns = 1 if ratio < FLAT else min(2, len(frames))
    rows = -(-len(frames) // columns)
    figure = style.figure(9.0, 0.4 + rows * (min(7.6 / columns * ratio, 5.0) + 0.7))
    panels = np.ravel(figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True))
    for axes, (_, mesh, cloud) in zip(panels, frames):
        _draw_sides(axes, mesh, cloud, top)
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), xlabel="x [m]", ylabel="y [m]")
        axes.label_outer()
    return figure, panels


def _in_space(frames, top):
    """A figure of both sides, seen from a corner: of the first frame, whatever flies off later."""
    from sazare.scenes import Layer, SolidView, render, sheet, trimmed_alike

    corners = np.concatenate([np.asarray(grid.points) for grid in frames[0][1:]])
    view = SolidView(tuple(np.stack([corners.min(axis=0), corners.max(axis=0)]).T.ravel()), np.array([1.0, -1.0, 1.0]), trim=False)
    images = []
    for _, mesh, cloud in frames:
        ground = mesh.extract_surface(nonlinear_subdivision=1)
        bodies = _bodies(cloud)
        coloured = {"scalars": "speed", "cmap": style.SPEED, "clim": (0.0, top)}
        images.append(render(view, [
            Layer(ground, {"color": style.GROUND[0], "show_edges": True, "edge_color": "white", "line_width": 1.0, "ambient": AMBIENT}),
            Layer(bodies, {**coloured, "show_edges": _radii(cloud) is None, "edge_color": style.INK, "line_width": 1.0, "ambient": AMBIENT}),
        ]).image)
    return sheet(trimmed_alike(images))


def _bodies(cloud):
    """Round bodies as balls, or the outside of other ones, with their speed [m/s]."""
    if (radii := _radii(cloud)) is not None:
        round_bodies = cloud.copy()
        round_bodies.cell_data["radius"] = radii
        return spheres.balls(round_bodies)
    outside = cloud.copy()
    outside.cell_data["speed"] = np.linalg.norm(cloud.cell_data["velocity"], axis=1)
    return outside.extract_surface()


@style.styled
def surface(results):
    """Force [N] of the bodies on the coupling surface and its mean displacement [m], each along the axis on which it is largest."""
    history = results.history
    if history.rows < 2:
        return None
    figure = style.figure(9.0, 4.6)
    upper, lower = figure.subplots(2, 1, sharex=True)
    time, label = plot.time_axis(history)
    for axes, name, unit, color in ((upper, "force", "N", style.ACCENT), (lower, "displacement", "m", style.SECOND)):
        axis, values = _along(history, f"surface.{name}")
        factor, prefix = style.prefix_of(values)
        axes.plot(time, values / factor, color=color, linewidth=1.1)
        axes.set_ylabel(f"{name} along {axis} [{prefix}{unit}]")
        axes.margins(x=0)
    lower.set_xlabel(label)
    return figure


@style.styled
def exchange(results):
    """Work [J] of the bodies on the nodes of the coupling surface, and energy [J] created by the coupling, against time."""
    history = results.history
    if history.rows < 2:
        return None
    factor, prefix = style.prefix_for(max(np.abs(history["energy_work_on_nodes"]).max(), np.abs(history["energy_coupling_error"]).max()))
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    time, label = plot.time_axis(history)
    for name, words, color in (("energy_work_on_nodes", "work on the nodes", style.SECOND), ("energy_work_on_bodies", "work on the bodies", "#9bbf8a"),
                               ("energy_coupling_error", "created by the coupling", style.ACCENT)):
        axes.plot(time, history[name] / factor, color=color, linewidth=1.1, label=words)
    axes.set_xlabel(label)
    axes.set_ylabel(f"energy [{prefix}J]")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=2)
    axes.margins(x=0)
    return figure


def sections(results):
    """The pictures of a run: both solver sides together, the coupling surface, then those of each side."""
    return [
        Section(
            "together", "Finite elements and bodies",
            "Finite elements, and bodies coloured by speed, at times between which both sides move equally far.", partial(together, results),
            "No snapshots of both sides can be drawn together.",
        ),
        Section(
            "surface", "Coupling surface", "Mean force of the bodies on the surface in each window, and mean displacement of its nodes.",
            partial(surface, results), common.NO_HISTORY,
        ),
        Section(
            "exchange", "Work across the coupling surface",
            "Work of the bodies on the nodes and of the nodes on the bodies; their sum is energy created by the coupling scheme.",
            partial(exchange, results), common.NO_HISTORY, wide=False,
        ),
        *(section for name, side in results.sides.items() for section in _sections_of_side(name, side, is_plane(results))),
        common.timing_section(results),
    ]


def _sections_of_side(name, side, in_one_picture):
    """The pictures of one side under its name, without those that the whole run has itself."""
    method = method_of(side)
    if method is METHOD:  # a side is no coupled run
        return
    for section in method.sections(side):
        if section.name != "timing" and not (section.places and in_one_picture):
            heading = f"{name.capitalize()}: {section.heading[0].lower()}{section.heading[1:]}"
            yield replace(section, name=f"{name}_{section.name}", heading=heading)


def verdict(results):
    """The verdict of a run by the energy that the coupling has made, and by the energy balances of both sides."""
    table, work = results.history, ["energy_work_on_nodes", "energy_work_on_bodies"]
    made = common.largest_share(table, ["energy_coupling_error"], work)
    sides = common.largest_share(table, ["energy_residual_continuum", "energy_residual_bodies"], [*work, "energy_coupling_error"])
    if made is None:
        return ("good", "The run is complete. Nothing went over the surface.") if table.rows else common.graded(None, "", "")
    words = f"The run is complete. The energy created by the coupling is {made:.1e} of the work across the surface."
    if sides is not None and sides > max(made, common.BAD_BALANCE):
        return common.graded(sides, f"{words} The energy residual of the two sides is {sides:.1e} of it.", "use smaller steps")
    better = "" if 'scheme = "iterative"' in results.case_text else f'scheme = "{_next_scheme(results.case_text)}", or '
    return common.graded(made, words, f"use {better}a shorter coupling window")


def _next_scheme(case_text):
    """The scheme that makes less energy than that of a case."""
    return "iterative" if 'scheme = "automatic"' in case_text else "automatic"


METHOD = Method(
    sections=sections,
    sheets=common.structure_sheets,
    tables=common.structure_tables,
    verdict=verdict,
    moving=moving,
    headlines=(
        Figure("particles", "particles"),
        Figure("peak_displacement", "peak displacement", "m"),
        Figure("step", "time step of the bodies", "s"),
        Figure("degrees_of_freedom", "degrees of freedom"),
        Figure("windows", "coupling windows", note=common.count_note("passes", "passes")),
        Figure("peak_force", "peak surface force", "N"),
    ),
)
