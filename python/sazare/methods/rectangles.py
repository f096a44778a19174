"""Method rectangles: blocks and beams in the plane, of squares or polygons that are joined along their faces."""

from functools import partial

import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Circle

from sazare import curve_styles, plot, style
from sazare.ground_motion.gauges import from_below
from sazare.methods import Figure, Method, Section, common
from sazare.moments import moments

ENERGIES = {
    "energy_kinetic": ("kinetic", style.KINETIC),
    "energy_elastic": ("elastic", style.ELASTIC),
    "energy_joint_dashpot": ("link dashpots", style.DASHPOT),
    "energy_slip": ("link slip", style.SLIP),
    "energy_fracture": ("fracture", style.RUPTURE),
    "energy_contact_dashpot": ("contact dashpots", style.CONTACT_DASHPOT),
    "energy_friction": ("contact friction", style.FRICTION),
}
MOST_PANELS = 4
MANY, STRAY = 200, 0.5  # elements; percent of so many that a frame leaves out on each side
RECTANGLE, CIRCLE, WALL, POLYGON = 0, 1, 2, 3
FACES = ((1, 2), (2, 3), (3, 0), (0, 1))  # corners of a rectangle's faces along +x, +y, -x, -y


def _corners(grid):
    """(n, 2) corners of each outline [m]."""
    return np.split(np.asarray(grid.points)[:, :2], np.asarray(grid.offset)[1:-1])


def _cracks(corners, kind, broken):
    """Ends of the faces that have broken; those of a polygon lead from its n-th corner to the next."""
    cracks = []
    for i in np.flatnonzero(broken):
        count = len(corners[i])
        faces = FACES if kind[i] == RECTANGLE else [(n, (n + 1) % count) for n in range(count)]
        cracks += [corners[i][list(ends)] for face, ends in enumerate(faces) if broken[i] >> face & 1]
    return cracks


def _window(frames):
    """x and y limits that hold the elements of some frames, but for single ones that have left many others, with a margin."""
    points = [np.concatenate([corners for corners, block in zip(_corners(grid), grid.cell_data["block"]) if block >= 0]) for grid in frames]
    stray = STRAY if frames[0].n_cells > MANY else 0.0
    ends = np.concatenate([points[0], *(np.percentile(place, (stray, 100.0 - stray), axis=0) for place in points)])
    lower, upper = ends.min(axis=0), ends.max(axis=0)
    margin = 0.06 * max(upper - lower)
    return lower - margin, upper + margin


def _draw(axes, grid, top, factor):
    """Elements by displacement in a unit of so many metres, broken faces, and supports."""
    corners, kind = _corners(grid), np.asarray(grid.cell_data["kind"])
    moved = np.linalg.norm(np.asarray(grid.cell_data["displacement"]), axis=1) / factor
    own = np.asarray(grid.cell_data["block"]) >= 0
    filled = own & ((kind == RECTANGLE) | (kind == POLYGON))
    edge = 0.5 if filled.sum() < 1500 else 0.0
    drawn = axes.add_collection(PolyCollection([corners[i] for i in np.flatnonzero(filled)], array=moved[filled], cmap=style.SPEED,
                                               edgecolors=style.INK, linewidths=edge))
    drawn.set_clim(0.0, top)
    cracks = _cracks(corners, kind, np.asarray(grid.cell_data["broken_faces"]))
    axes.add_collection(LineCollection(cracks, colors=style.ACCENT, linewidths=2.0))
    for i in np.flatnonzero(kind == CIRCLE):
        radius = 0.5 * np.linalg.norm(corners[i][1] - corners[i][0])
        axes.add_patch(Circle(corners[i].mean(axis=0), radius, facecolor=style.STONE, edgecolor=style.INK))
    walls = [corners[i][:2] for i in np.flatnonzero(kind == WALL)]
    axes.add_collection(LineCollection(walls, colors=style.INK, linewidths=2.0))
    return drawn


@style.styled
def moving(results):
    """Elements at up to four times, coloured by displacement [m]; broken faces are red."""
    snapshots = results.square_snapshots
    if not len(snapshots):
        return None
    chosen = moments(snapshots, MOST_PANELS)
    frames = [snapshots[i].elements for i in chosen]
    top, clipped = style.clipped_top(np.concatenate([np.linalg.norm(grid.cell_data["displacement"], axis=1) for grid in frames]))
    factor, prefix = style.prefix_for(top)
    lower, upper = _window(frames)
    wide = (upper - lower)[0] > 1.3 * (upper - lower)[1]
    rows, columns = (len(frames), 1) if wide else ((len(frames) + 1) // 2, 2)
    width = 9.0
    height = np.clip(rows * (0.8 * width / columns) * (upper - lower)[1] / (upper - lower)[0] + 0.6 * rows, 3.0, 11.0)
    figure = style.figure(width, float(height))
    panels = np.ravel(figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True))
    for axes in panels[len(frames):]:
        axes.set_axis_off()
    for axes, grid, index in zip(panels, frames, chosen):
        drawn = _draw(axes, grid, top / factor, factor)
        axes.set_xlim(lower[0], upper[0])
        axes.set_ylim(lower[1], upper[1])
        axes.set_aspect("equal")
        axes.set_title(style.quantity(snapshots[index].time, "s"))
        axes.set(xlabel="x [m]", ylabel="y [m]")
        axes.label_outer()
        axes.grid(False)
    style.colorbar(figure, drawn, list(panels), f"displacement [{prefix}m]", clipped, shrink=0.7)
    return figure


def support_names(results):
    """Supports in the order of the history."""
    ending = ".force_x"
    return [column.removesuffix(ending) for column in results.history if column.endswith(ending)]


@style.styled
def supports(results):
    """Magnitude of the force [N] at every support against time."""
    every, history = support_names(results), results.history
    if not every or history.rows < 2:
        return None
    time, time_label = plot.time_axis(history)
    forces = {name: np.hypot(history[f"{name}.force_x"], history[f"{name}.force_y"]) for name in every}
    names = sorted(every, key=lambda name: -forces[name].max())[: curve_styles.MOST]
    factor, prefix = style.prefix_for(max(force.max() for force in forces.values()))
    figure = curve_styles.figure(9.0, 3.6, len(names))
    axes = figure.subplots()
    curve_styles.tell_left_out(figure, every, names, "history.csv")
    for number, name in enumerate(name for name in every if name in names):
        axes.plot(time, forces[name] / factor, linewidth=1.1, label=f"{name}: peak {style.quantity(forces[name].max(), 'N')}", **curve_styles.look(number))
    axes.set_xlabel(time_label)
    axes.set_ylabel(f"force [{prefix}N]")
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    axes.margins(x=0)
    return figure


@style.styled
def gauges(results):
    """Displacement [m] and rotation [degrees] of the elements at the gauges against time."""
    every, table = from_below(results, list(results.gauges)), results.gauge_table
    if not every or table.rows < 2:
        return None
    names = curve_styles.spread(every)
    time, time_label = plot.time_axis(table)
    figure = curve_styles.figure(9.0, 3.6, len(names))
    left, right = figure.subplots(1, 2)
    moved = {name: np.hypot(table[f"{name}.displacement_x"], table[f"{name}.displacement_y"]) for name in names}
    factor, prefix = style.prefix_for(max(way.max() for way in moved.values()))
    for number, (name, way) in enumerate(moved.items()):
        look = curve_styles.look(number)
        left.plot(time, way / factor, linewidth=1.2, label=name, **look)
        right.plot(time, np.degrees(table[f"{name}.rotation"]), linewidth=1.2, **look)
    left.set_ylabel(f"displacement [{prefix}m]")
    right.set_ylabel("rotation [degrees]")
    curve_styles.legend(left, right)
    for axes in (left, right):
        axes.set_xlabel(time_label)
        axes.margins(x=0)
    curve_styles.tell_left_out(figure, every, names, "gauges.csv")
    return figure


def sections(results):
    """The pictures of a run."""
    return [
        Section(
            "moving", "Elements", "Elements coloured by displacement, at times between which they move equally far; broken faces are red.",
            partial(moving, results), common.NO_SNAPSHOTS, places=True,
        ),
        Section(
            "supports", "Support forces", "Magnitude of the force between each support and the elements.",
            partial(supports, results), "The case has no supports.",
        ),
        Section(
            "square_gauges", "Gauges", "Displacement and rotation of the elements at the gauges.", partial(gauges, results), common.NO_GAUGES,
        ),
        common.energy_section(results, ENERGIES, "the work of gravity and supports"),
        common.timing_section(results),
    ]


METHOD = Method(
    sections=sections,
    verdict=common.strict_balance_verdict,
    headlines=(
        Figure("peak_speed", "peak speed", "m/s", common.said("of any element")),
        Figure("energy_work", "external work", "J"),
        Figure("broken_springs", "broken springs", note=common.count_note("elements", "elements")),
        Figure("broken_links", "open links"),
        Figure("peak_displacement", "peak displacement", "m"),
        Figure("step", "time step", "s", common.quantity_note("predicted_limit", "stability limit ", "s")),
    ),
    snapshots="rectangles",
    fields={
        "velocity": ("speed", "m/s"),
        "displacement": ("displacement", "m"),
        "broken_faces": ("broken faces (bit mask)", ""),
    },
)
