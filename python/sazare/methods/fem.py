"""Method fem: finite elements, implicit in time."""

from functools import partial

import numpy as np
from matplotlib.collections import PolyCollection
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from sazare import curve_styles, plot, style
from sazare.base_motion import SeenFromBase
from sazare.ground_motion.gauges import from_below
from sazare.methods import Figure, Method, Section, common

ENERGIES = {
    "energy_kinetic": ("kinetic", style.KINETIC),
    "energy_elastic": ("elastic", style.ELASTIC),
    "energy_friction": ("joint friction", style.FRICTION),
    "energy_seepage": ("flow of pore water", style.SEEPAGE),
    "energy_plastic": ("plastic flow", style.RUPTURE),
    "energy_members": ("members that yield", style.YIELDED),
    "energy_damping": ("Rayleigh damping", style.DASHPOT),
    "energy_radiation": ("radiation at boundaries", style.OUTSIDE),
}
MOST_JOINTS = 6
MOST_PANELS = 2
LONG = 5.0  # times as long as the median of the cells and as their own height: such cells stand for ground without end
# Points of a cell around its outline, by VTK's number of its type.
OUTLINES = {5: (0, 1, 2), 22: (0, 3, 1, 4, 2, 5), 9: (0, 1, 2, 3), 23: (0, 4, 1, 5, 2, 6, 3, 7), 28: (0, 4, 1, 5, 2, 6, 3, 7)}


def _enlargement(grid, extent):
    return common.enlargement(np.asarray(grid.point_data["displacement"]), extent, largest=0.03, shown=0.06)


def outlines(grid):
    """Point numbers around the outline of every cell of a plane mesh, in the order of the cells."""
    points, offsets, types = np.asarray(grid.cell_connectivity), np.asarray(grid.offset), np.asarray(grid.celltypes)
    return [points[offsets[i] + np.array(OUTLINES[int(kind)])] for i, kind in enumerate(types)]


def is_flat(grid):
    """Whether a mesh is two-dimensional."""
    return int(np.asarray(grid.celltypes)[0]) in OUTLINES


def _places(grid, factor):
    """Points with their displacement since the beginning times a factor."""
    moved = np.asarray(grid.point_data["displacement"])
    return np.asarray(grid.points) + (factor - 1.0) * moved, moved


def _shown_extent(grid):
    """Corners (2, 3) [m] of the part of a mesh that pictures show: without cells that are far longer than high and than the others."""
    points, offsets = np.asarray(grid.points)[np.asarray(grid.cell_connectivity)], np.asarray(grid.offset)[:-1]
    low, high = np.minimum.reduceat(points, offsets), np.maximum.reduceat(points, offsets)
    lengths, heights = (high - low)[:, 0], (high - low)[:, 1]
    shown = (lengths <= LONG * np.median(lengths)) | (lengths <= LONG * heights)
    return np.array([low[shown].min(axis=0), high[shown].max(axis=0)])


def _draw_flat(axes, grid, values, factor, top):
    """Cells of a plane mesh, coloured by a value of each."""
    places, _ = _places(grid, factor)
    cells = [places[cell, :2] for cell in outlines(grid)]
    edge = 0.3 if len(cells) < 3000 else 0.0
    drawn = axes.add_collection(PolyCollection(cells, array=values, cmap=style.SPEED, edgecolors="#00000055", linewidths=edge))
    drawn.set_clim(0.0, top)
    axes.set(xlabel="x [m]", ylabel="y [m]")
    axes.set_aspect("equal")
    axes.autoscale_view()
    (left, _, _), (right, _, _) = _shown_extent(grid)
    if right - left < np.ptp(np.asarray(grid.points)[:, 0]):
        axes.set_xlim(left, right)
    axes.grid(False)
    return drawn


def _draw_solid(axes, grid, values, factor, top):
    """The outside of a mesh in space, coloured by a value of each cell."""
    moved = grid.copy()
    moved.points, _ = _places(grid, factor)
    moved.cell_data["shown"] = values
    outside = moved.extract_surface(nonlinear_subdivision=1).triangulate()
    faces = np.asarray(outside.faces).reshape(-1, 4)[:, 1:]
    points = np.asarray(outside.points)
    shown = np.asarray(outside.cell_data["shown"])
    drawn = axes.add_collection3d(Poly3DCollection(points[faces], array=shown, cmap=style.SPEED, linewidths=0.0))
    drawn.set_clim(0.0, top)
    low, high = points.min(axis=0), points.max(axis=0)
    for set_limits, a, b in zip((axes.set_xlim, axes.set_ylim, axes.set_zlim), low, high):
        set_limits(a, max(b, a + 1e-9))
    axes.set_box_aspect(np.maximum(high - low, 1e-3 * (high - low).max()))
    return drawn


def _mean_by_cell(grid, values):
    """Mean over the points of every cell."""
    points, offsets = np.asarray(grid.cell_connectivity), np.asarray(grid.offset)
    return np.add.reduceat(values[points], offsets[:-1]) / np.diff(offsets)


def _panels(grids, values, label, factor, titles):
    """Meshes one above the other (or side by side, where they are tall) with one scale of colours."""
    flat = is_flat(grids[0])
    extent = np.ptp(_shown_extent(grids[0]), axis=0)
    tall = extent[1 if flat else 2] > extent[0]
    shape = (1, len(grids)) if tall else (len(grids), 1)
    ratio = max(extent[1] if flat else 0.7 * extent.max(), 0.12 * extent[0]) / max(extent[0], 1e-9)
    figure = style.figure(9.0, 5.4 if tall else len(grids) * (0.9 + min(7.5 * ratio, 4.5)))
    panels = np.ravel(figure.subplots(*shape, subplot_kw={} if flat else {"projection": "3d"}, squeeze=False))
    top, clipped = style.clipped_top(np.concatenate(values))
    for axes, grid, one, title in zip(panels, grids, values, titles):
        drawn = (_draw_flat if flat else _draw_solid)(axes, grid, one, factor, top)
        axes.set_title(title + (f", displacements × {factor:g}" if factor != 1.0 else ""), loc="left")
    style.colorbar(figure, drawn, list(panels), label, clipped)
    return figure


@style.styled
def displaced(results):
    """The deformed mesh at the largest displacement and at the end, coloured by displacement [m], relative to the base where a motion enters."""
    snapshots = results.element_snapshots
    if not len(snapshots):
        return None
    base = SeenFromBase(results)
    grids = [base.mesh(snapshot) for snapshot in snapshots]
    sizes = [np.linalg.norm(np.asarray(grid.point_data["displacement"]), axis=1) for grid in grids]
    chosen = sorted({int(np.argmax([size.max() for size in sizes])), len(grids) - 1})[:MOST_PANELS]
    extent = np.ptp(_shown_extent(grids[0]), axis=0).max()
    factor = min(_enlargement(grids[i], extent) for i in chosen)
    values = [_mean_by_cell(grids[i], sizes[i]) for i in chosen]
    unit, prefix = style.prefix_of(*values)
    titles = [style.quantity(snapshots[i].time, "s") for i in chosen]
    return _panels([grids[i] for i in chosen], [value / unit for value in values], f"displacement{base.words} [{prefix}m]", factor, titles)


@style.styled
def yielding(results):
    """Equivalent plastic shear strain [-] of every element at the end; None where no element has yielded."""
    snapshots = results.element_snapshots
    if not len(snapshots):
        return None
    grid = SeenFromBase(results).mesh(snapshots[-1])
    slip = np.asarray(grid.cell_data["plastic_shear_strain"])
    if slip.max(initial=0.0) <= 0.0:
        return None
    extent = np.ptp(_shown_extent(grid), axis=0).max()
    factor = _enlargement(grid, extent)
    return _panels([grid], [slip], "equivalent plastic shear strain [-]", factor, [style.quantity(snapshots[-1].time, "s")])


@style.styled
def joints(results):
    """Share of the area of each joint that is open and that slips [-], and its maximum slip [m], against time."""
    history = results.history
    every = [name.removesuffix(".slip_max") for name in history if name.endswith(".slip_max")]
    if not every or history.rows < 2:
        return None
    names = sorted(every, key=lambda name: -np.max(history[f"{name}.slip_max"]))[:MOST_JOINTS]
    time, time_label = plot.time_axis(history)
    figure = style.figure(9.0, 3.4)
    left, right = figure.subplots(1, 2)
    curve_styles.tell_left_out(figure, every, names, "history.csv")
    factor, prefix = style.prefix_of(*(history[f"{name}.slip_max"] for name in names))
    for name in names:
        line, = left.plot(time, history[f"{name}.sliding_fraction"], linewidth=1.0, label=f"{name}, slipping")
        left.plot(time, history[f"{name}.open_fraction"], linewidth=1.0, linestyle=":", color=line.get_color(),
                  label=f"{name}, open")
        right.plot(time, history[f"{name}.slip_max"] / factor, linewidth=1.0, color=line.get_color(), label=name)
    left.set_ylabel("share of area [-]")
    left.legend()
    right.set_ylabel(f"maximum slip [{prefix}m]")
    for axes in (left, right):
        axes.set_xlabel(time_label)
        axes.margins(x=0)
    return figure


@style.styled
def members(results):
    """Largest tension and compression of each member [N], and its largest bending moment [N m], against time."""
    history = results.history
    found = [name.removesuffix(".axial_force_max") for name in history if name.endswith(".axial_force_max")]
    if not found or history.rows < 2:
        return None
    names = found[:MOST_JOINTS]
    bent = [name for name in names if np.any(history[f"{name}.moment_max"] != 0.0)]
    limited = [name for name in names if _limit_ratio(history, name) is not None]
    time, time_label = plot.time_axis(history)
    figure = style.figure(9.0 if not (bent and limited) else 12.0, 3.4)
    curve_styles.tell_left_out(figure, found, names, "history.csv")
    panels = figure.subplots(1, 1 + bool(bent) + bool(limited), squeeze=False)[0]
    factor, prefix = style.prefix_of(*(history[f"{name}.axial_force_{end}"] for name in names for end in ("min", "max")))
    for name in names:
        line, = panels[0].plot(time, history[f"{name}.axial_force_max"] / factor, linewidth=1.0, label=name)
        panels[0].plot(time, history[f"{name}.axial_force_min"] / factor, linewidth=1.0, linestyle=":", color=line.get_color())
    panels[0].set_ylabel(f"axial force, tension positive [{prefix}N]")
    panels[0].legend()
    if bent:
        factor, prefix = style.prefix_of(*(history[f"{name}.moment_max"] for name in bent))
        for name in bent:
            color = next(line.get_color() for line in panels[0].lines if line.get_label() == name)
            panels[1].plot(time, history[f"{name}.moment_max"] / factor, linewidth=1.0, color=color)
        panels[1].set_ylabel(f"largest bending moment [{prefix}N m]")
    for name in limited:
        color = next(line.get_color() for line in panels[0].lines if line.get_label() == name)
        panels[-1].plot(time, _limit_ratio(history, name), linewidth=1.0, color=color)
    if limited:
        panels[-1].axhline(1.0, color=style.INK, linewidth=0.8, linestyle=":")
        panels[-1].set_ylim(bottom=0.0)
        panels[-1].set_ylabel("force or moment over its limit [-]")
    for axes in panels:
        axes.set_xlabel(time_label)
        axes.margins(x=0)
    return figure


def _limit_ratio(history, name):
    """Largest force or moment of a member over its limit [-] against time; None where it has none."""
    return next((history[column] for column in (f"{name}.force_ratio", f"{name}.moment_ratio") if column in history), None)


@style.styled
def plastic_members(results):
    """Plastic elongation of bars and springs [m] and plastic rotation of beams [rad], each the largest along a member, against time; None where nothing has yielded."""
    history = results.history
    shown = [name for name in history if name.endswith((".plastic_elongation", ".plastic_rotation")) and np.any(history[name] != 0.0)]
    if not shown or history.rows < 2:
        return None
    time, time_label = plot.time_axis(history)
    kinds = [kind for kind in ("plastic_elongation", "plastic_rotation") if any(name.endswith(kind) for name in shown)]
    figure = style.figure(4.5 * len(kinds), 3.4)
    kept = [name for kind in kinds for name in [name for name in shown if name.endswith(kind)][:MOST_JOINTS]]
    curve_styles.tell_left_out(figure, shown, kept, "history.csv")
    for axes, kind in zip(figure.subplots(1, len(kinds), squeeze=False)[0], kinds, strict=True):
        names = [name for name in kept if name.endswith(kind)]
        factor, prefix = style.prefix_of(*(history[name] for name in names))
        for name in names:
            axes.plot(time, history[name] / factor, linewidth=1.0, label=name.removesuffix(f".{kind}"))
        axes.set_ylabel(f"{kind.replace('_', ' ')} [{prefix}{'m' if kind == 'plastic_elongation' else 'rad'}]")
        axes.set_xlabel(time_label)
        axes.margins(x=0)
        axes.legend()
    return figure


@style.styled
def displacements(results):
    """Displacement [m] at the gauges along the axis of the largest one, against time."""
    table = results.gauge_table
    names = list(results.gauges)
    if not names or table.rows < 2:
        return None
    time, time_label = plot.time_axis(table)
    peaks = [max(np.abs(table[f"{name}.displacement_{axis}"]).max() for name in names) for axis in "xyz"]
    axis = "xyz"[int(np.argmax(peaks))]
    factor, prefix = style.prefix_for(max(peaks))
    curves = {name: table[f"{name}.displacement_{axis}"] / factor for name in from_below(results, names)}
    return _gauge_curves(time, time_label, curves, f"displacement along {axis} [{prefix}m]")


def _gauge_curves(time, time_label, curves, label):
    """Curves against time of gauges from below (name -> values), as many as can be told apart."""
    figure = curve_styles.figure(6.2, 3.4, len(curves))
    axes = figure.subplots()
    names = curve_styles.spread(list(curves))
    curve_styles.tell_left_out(figure, list(curves), names, "gauges.csv")
    for number, name in enumerate(names):
        axes.plot(time, curves[name], linewidth=1.1, label=name, **curve_styles.look(number))
    axes.set_xlabel(time_label)
    axes.set_ylabel(label)
    curve_styles.legend(axes)
    axes.margins(x=0)
    return figure


@style.styled
def pore_pressures(results):
    """Excess pore pressure [Pa] at the gauges against time; None where no gauge has one."""
    table = results.gauge_table
    suffix = ".excess_pore_pressure"
    names = [name.removesuffix(suffix) for name in table if name.endswith(suffix)]
    names = [name for name in names if np.abs(table[name + suffix]).max(initial=0.0) > 0.0]
    if not names or table.rows < 2:
        return None
    time, time_label = plot.time_axis(table)
    factor, prefix = style.prefix_of(*(table[name + suffix] for name in names))
    curves = {name: table[name + suffix] / factor for name in from_below(results, names)}
    return _gauge_curves(time, time_label, curves, f"excess pore pressure [{prefix}Pa]")


@style.styled
def pore_pressure_range(results):
    """Largest and smallest excess pore pressure of any node [Pa], and the smallest pressure in all, against time; None without any."""
    history = results.history
    names = {"excess_pore_pressure_max": "largest excess", "excess_pore_pressure_min": "smallest excess", "pore_pressure_min": "smallest in all"}
    shown = [name for name in names if name in history]
    if history.rows < 2 or not any(np.any(history[name] != 0.0) for name in shown):
        return None
    time, time_label = plot.time_axis(history)
    factor, prefix = style.prefix_of(*(history[name] for name in shown))
    figure = style.figure(6.2, 3.4)
    axes = figure.subplots()
    for name in shown:
        axes.plot(time, history[name] / factor, linewidth=1.1, label=names[name])
    axes.set_xlabel(time_label)
    axes.set_ylabel(f"pore pressure [{prefix}Pa]")
    axes.legend()
    axes.margins(x=0)
    return figure


@style.styled
def pore_pressure_ratio(results):
    """Pore pressure ratio [-] of every element at its largest and at the end; None where there is none."""
    snapshots = results.element_snapshots
    if not len(snapshots):
        return None
    grids = [snapshot.elements for snapshot in snapshots]
    ratios = [np.asarray(grid.cell_data["pore_pressure_ratio"]) for grid in grids]
    if max(ratio.max(initial=0.0) for ratio in ratios) <= 0.0:
        return None
    chosen = sorted({int(np.argmax([ratio.mean() for ratio in ratios])), len(grids) - 1})
    titles = [style.quantity(snapshots[i].time, "s") for i in chosen]
    return _panels([grids[i] for i in chosen], [np.clip(ratios[i], 0.0, None) for i in chosen], "pore pressure ratio [-]", 1.0, titles)


def _pore_sections(results):
    return [
        Section("pore_pressures", "Excess pore pressure", "Excess pore pressure at the gauges.", partial(pore_pressures, results), common.NO_GAUGES, wide=False),
        Section(
            "pore_pressure_range", "Range of the pore pressure",
            "Largest and smallest excess pore pressure of any node, and the smallest pressure with that at rest; water cavitates near −100 kPa.",
            partial(pore_pressure_range, results), "No pressure has changed.", wide=False,
        ),
        Section(
            "pore_pressure_ratio", "Pore pressure ratio",
            "Excess pore pressure over the vertical effective stress at the beginning, at its largest and at the end.",
            partial(pore_pressure_ratio, results), "No element has one.",
        ),
    ]


def sections(results):
    """The pictures of a run."""
    static = 'analysis = "static"' in results.case_text
    has_excess = "excess_pore_pressure_max" in results.history
    has_members = any(name.endswith(".axial_force_max") for name in results.history)
    has_joints = any(name.endswith(".slip_max") for name in results.history)
    return [
        Section(
            "displaced", "Deformed mesh", "Deformed mesh at the largest displacement and at the end, coloured by displacement; where a motion enters, seen from the base, the lowest nodes.",
            partial(displaced, results), common.NO_SNAPSHOTS,
        ),
        Section("yielding", "Yielding", "Equivalent plastic shear strain of the elements at the end.", partial(yielding, results), "No element has yielded."),
        common.boundary_force_section(results),
        Section(
            "displacements", "Displacements", "Displacement at the gauges along the axis of the largest one.",
            partial(displacements, results), common.NO_GAUGES, wide=False,
        ),
        *([_joint_section(results)] if has_joints else []),
        *(_member_sections(results) if has_members else []),
        *(_pore_sections(results) if has_excess else []),
        *([] if static else common.shaking_sections(results) + common.wave_sections(results)),
        common.energy_section(results, ENERGIES, "the external work"),
        common.timing_section(results),
    ]


def _joint_section(results):
    return Section("joints", "Joints", "Share of the joint area that slips or is open, and maximum slip.", partial(joints, results), "")


def _member_sections(results):
    limited = any(name.endswith((".force_ratio", ".moment_ratio")) for name in results.history)
    words = "Axial force along each member, its largest (full line) and smallest (dotted), and the largest bending moment."
    yielded = Section(
        "plastic_members", "Yielding of members", "Plastic elongation and plastic rotation, each the largest along a member.",
        partial(plastic_members, results), "No member has yielded.", wide=False,
    )
    return [
        Section("members", "Members", words + (" Where they have limits, how much of them they bear." if limited else ""), partial(members, results), ""),
        *([yielded] if limited else []),
    ]


def verdict(results):
    """The verdict of a run by its energy balance."""
    if common.is_round_off(results):
        return "good", "The run is complete. No work was done but that of round-off."
    share = common.largest_share(results.history, ["energy_residual"], ["energy_work", "energy_kinetic", "energy_elastic"])
    share = common.energy_balance(results.figures) if share is None else share
    return common.graded(share, "" if share is None else common.balance_words(share, "energy in play"),
                         "use a smaller step, or a smaller tolerance of the solver; an alpha below 0 dissipates energy itself")


METHOD = Method(
    sections=sections,
    verdict=verdict,
    headlines=(
        Figure("peak_speed", "peak speed", "m/s", common.said("of any node")),
        Figure("energy_work", "external work", "J"),
        Figure("final_displacement", "final displacement", "m"),
        Figure("peak_acceleration", "peak acceleration", "m/s²"),
        Figure("peak_displacement", "peak displacement", "m"),
        Figure("step", "time step", "s"),
        Figure("degrees_of_freedom", "degrees of freedom", note=common.count_note("nodes", "nodes")),
        Figure("newton_iterations", "Newton iterations", note=common.count_note("steps", "steps")),
    ),
    snapshots="finite_elements",
    fields={
        "displacement": ("displacement", "m"),
        "velocity": ("speed", "m/s"),
        "acceleration": ("acceleration", "m/s²"),
        "von_mises_stress": ("von Mises stress", "Pa"),
        "pressure": ("pressure", "Pa"),
        "plastic_shear_strain": ("equivalent plastic shear strain", ""),
        "shear_strain_max": ("largest shear strain", ""),
        "excess_pore_pressure": ("excess pore pressure", "Pa"),
        "pore_pressure_ratio": ("pore pressure ratio", ""),
    },
    extent=_shown_extent,
    tables=common.shaking_tables,
    sheets=common.structure_sheets,
)
