"""Method spheres: grains that touch, are bonded, or stand together as rigid bodies."""

from functools import partial

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

from sazare import curve_styles, plot, style
from sazare.methods import Figure, Method, Section, common
from sazare.moments import growth, moments
from sazare.style import quantity

AXES = "xyz"
MOST_CURVES = 6
MOST_PICTURES = 4
CUT_ABOVE = 1000  # spheres; fewer do not hide each other
FINE_BELOW = 3000  # spheres; above it those of the usual size are drawn with fewer faces
STRAY = 0.005  # of the volume, which frames leave out on each side
MOST_COMMON, MOST_OWN = 4.0, 3.0  # sizes of frames over that of the first one, see `frames`
MOST_WALLS = 2.5  # size of walls over that of the spheres' frame, up to which all of them are shown
LARGE = 2.0  # usual radii; above it a sphere is drawn with more faces in any case
KINDS = [
    ("translation", "energy_translation"), ("rotation", "energy_rotation"),
    ("normal contact springs", "energy_elastic"), ("tangential contact springs", "energy_tangential"),
    ("contact dashpots", "energy_contact_dashpot"), ("friction", "energy_friction"),
]
KIND_COLORS = ["#35618f", "#6fa3c7", "#4f7f52", "#9bbf8a", "#b5472f", "#d9a441"]
# Where spheres begin to touch within a step, the balance misses some 1e-2 of what an impact loses at the default step.
GOOD_BALANCE, BAD_BALANCE = 1e-2, 5e-2
BOND_KINDS = [("bonds", "energy_bonds"), ("bond dashpots", "energy_bond_dashpot"), ("fracture", "energy_fracture")]
BOND_COLORS = ["#7d5ba6", "#c9a0dc", "#2b2b2b"]
WATER_COLOR = "#8ec9c0"


def balls(cloud):
    """Spheres as a surface, with their speed [m/s] and the share of their bonds that is broken."""
    import pyvista

    points = pyvista.PolyData(np.asarray(cloud.points))
    points["radius"] = np.asarray(cloud.cell_data["radius"])
    points["speed"] = np.linalg.norm(cloud.cell_data["velocity"], axis=1)
    if "broken_fraction" in cloud.cell_data:
        points["broken_fraction"] = np.asarray(cloud.cell_data["broken_fraction"])
    large = points["radius"] > LARGE * np.median(points["radius"])
    usual_corners = 16 if len(cloud.points) < FINE_BELOW else 7
    parts = [_glyphs(points, chosen, corners) for chosen, corners in ((~large, usual_corners), (large, 40)) if chosen.any()]
    return parts[0].merge(parts[1:]) if len(parts) > 1 else parts[0]


def _glyphs(points, chosen, corners):
    import pyvista

    ball = pyvista.Sphere(radius=1.0, theta_resolution=corners, phi_resolution=corners)
    return points.extract_points(chosen, include_cells=False).glyph(geom=ball, scale="radius", orient=False)


def _cut(mesh, bounds):
    """What lies behind the middle of the body, so that its inside shows."""
    middle = 0.5 * (bounds[2] + bounds[3])
    return mesh.clip(normal="-y", origin=(0.0, middle, 0.0))


@style.styled
def pictures(results):
    """The spheres at some times, coloured by speed [m/s]; the front half is cut away where there are many."""
    return _scenes(results, "speed", "speed [m/s]", style.SPEED)


@style.styled
def broken_bonds(results):
    """The spheres at some times, coloured by their share of broken bonds [-]; None where no bond is broken."""
    return _scenes(results, "broken_fraction", "share of broken bonds [-]", "YlOrRd", growth("broken_fraction")) if results.figures.get("broken_bonds", 0) > 0 else None


def _box(cloud):
    """Lower and upper corner [m] of a cloud of spheres without its outermost: all but a share STRAY of the volume on each side."""
    points, radius = np.asarray(cloud.points), np.asarray(cloud.cell_data["radius"])
    volume = radius**3
    corners = np.empty((2, 3))
    for axis in range(3):
        for side, sign in enumerate((1.0, -1.0)):
            order = np.argsort(sign * points[:, axis])
            beyond = np.cumsum(volume[order]) / volume.sum()
            one = order[min(np.searchsorted(beyond, STRAY, side="right"), len(order) - 1)]
            corners[side, axis] = points[one, axis] - sign * radius[one]
    return np.stack([corners.min(axis=0), corners.max(axis=0)])


def frames(clouds):
    """Lower and upper corner [m] of what the picture of each cloud of spheres shows: one frame for all; where they move so far or apart
    that they would be small in it, a frame for each, about the middle sphere and MOST_OWN times as large as the first at most."""
    boxes = [_box(cloud) for cloud in clouds]
    together = np.stack([np.min([box[0] for box in boxes], axis=0), np.max([box[1] for box in boxes], axis=0)])
    size = np.ptp(boxes[0], axis=0).max()
    if np.ptp(together, axis=0).max() <= MOST_COMMON * size:
        return [together] * len(clouds)
    room = 0.5 * MOST_OWN * size
    middles = [np.median(np.asarray(cloud.points), axis=0) for cloud in clouds]
    return [np.stack([np.maximum(box[0], middle - room), np.minimum(box[1], middle + room)]) for box, middle in zip(boxes, middles)]


def _with_walls(frame, walls):
    """A frame that holds the walls of triangles too, unless they are much larger; then grown by a quarter."""
    if walls is None:
        return frame
    box = np.array(walls.bounds).reshape(3, 2).T
    both = np.stack([np.minimum(frame[0], box[0]), np.maximum(frame[1], box[1])])
    size = np.ptp(frame, axis=0).max()
    if np.ptp(both, axis=0).max() <= MOST_WALLS * size:
        return both
    return frame + 0.25 * size * np.array([[-1.0], [1.0]])


def _wall_layers(walls, frame):
    """Walls of triangles within a frame, light and transparent, and their edges."""
    from sazare.scenes import Layer

    if walls is None:
        return []
    bounds = frame.T.ravel()
    shown = walls.extract_surface().clean().clip_box(bounds, invert=False).extract_surface()
    if not shown.n_cells:
        return []
    edges = shown.extract_feature_edges(30.0, boundary_edges=True, non_manifold_edges=False, manifold_edges=False)
    return [
        Layer(shown, {"color": style.WALL, "opacity": 0.22, "show_edges": False}),
        Layer(edges, {"color": style.WALL, "opacity": 0.8, "line_width": 1.5, "lighting": False}),
    ]


def _scenes(results, scalar, label, colors, change=None):
    """The spheres at some times, coloured by one field, with walls of triangles; the front half is cut away where there are many."""
    from sazare.scenes import Layer, SolidView, render, sheet, trimmed_alike

    snapshots = results.particle_snapshots
    if not len(snapshots):
        return None
    chosen = moments(snapshots, MOST_PICTURES, change)
    clouds = [snapshots[index].elements for index in chosen]
    speeds = np.concatenate([np.linalg.norm(cloud.cell_data["velocity"], axis=1) for cloud in clouds])
    top, clipped = (1.0, False) if scalar == "broken_fraction" else style.clipped_top(speeds)
    images, titles = [], []
    for index, cloud, spheres_frame in zip(chosen, clouds, frames(clouds)):
        time = snapshots[index].time
        walls = results.wall_snapshots.at(time).elements if len(results.wall_snapshots) else None
        frame = _with_walls(spheres_frame, walls)
        bounds = tuple(frame.T.ravel())
        mesh = _cut(balls(cloud), bounds) if cloud.n_points > CUT_ABOVE else balls(cloud)
        options = {"scalars": scalar, "cmap": colors, "clim": (0.0, top), "smooth_shading": False}
        view = SolidView(bounds, np.array([1.0, -1.0, 1.0]), trim=False)
        images.append(render(view, [Layer(mesh, options), *_wall_layers(walls, frame)]).image)
        outside = int(np.sum(~view.shows(cloud.points)))
        titles.append(style.quantity(time, "s") + (f"\n{style.count(outside)} of {style.count(cloud.n_points)} outside" if outside else ""))
    figure, panels = sheet(trimmed_alike(images))
    for axes, title in zip(panels, titles):
        axes.set_title(title)
    style.colorbar(figure, ScalarMappable(Normalize(0.0, top), colors), list(panels), label, clipped, shrink=0.7)
    return figure


@style.styled
def energies(results):
    """Stored and dissipated energy [J] by cause, stacked, and the residual [J]."""
    history = results.history
    if "energy_translation" not in history or history.rows < 2:
        return None
    bonded = results.figures.get("bonds", 0) > 0
    kinds, colors = (KINDS + BOND_KINDS, KIND_COLORS + BOND_COLORS) if bonded else (KINDS, KIND_COLORS)
    parts = np.array([history[column] for _, column in kinds])
    given_to_water = -history["energy_work_water"] if "energy_work_water" in history else np.zeros(1)
    if given_to_water.max(initial=0.0) > 0.0:
        kinds, colors = [*kinds, ("given to water", "energy_work_water")], [*colors, WATER_COLOR]
        parts = np.vstack([parts, given_to_water])
    factor, prefix = style.prefix_for(parts.sum(axis=0).max(initial=0.0))
    figure = style.figure(9.0, 4.4)
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=[3, 1])
    time, label = plot.time_axis(history)
    upper.stackplot(time, np.maximum(parts, 0.0) / factor, labels=[name for name, _ in kinds], colors=colors, linewidth=0)
    upper.set_ylabel(f"energy [{prefix}J]")
    upper.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    lower.plot(time, history["energy_residual"] / factor, color=style.INK, linewidth=0.9)
    lower.set_ylabel(f"residual [{prefix}J]")
    lower.set_xlabel(label)
    upper.margins(x=0)
    return figure


def _beside(table, name, axis):
    """What is drawn beside the position of a group: its velocity, or the force on it where its velocity never changes."""
    speeds = np.stack([table[f"{name}.velocity_{a}"] for a in AXES], axis=1)
    if f"{name}.force_x" not in table or np.ptp(speeds, axis=0).max() > 0:
        return "velocity", "m/s", axis
    forces = np.stack([table[f"{name}.force_{a}"] for a in AXES], axis=1)
    return "force", "N", int(np.argmax(np.abs(forces).max(axis=0)))


@style.styled
def groups(results):
    """Position [m] of the recorded groups along their axis of strongest motion; beside it their velocity [m/s], or the force [N] on those that are held."""
    table, names = results.gauge_table, list(results.gauges)[:MOST_CURVES]
    if not names or table.rows < 2:
        return None
    time, time_label = plot.time_axis(table)
    figure = style.figure(9.0, 0.6 + 2.4 * len(names))
    rows = figure.subplots(len(names), 2, sharex=True, squeeze=False)
    for (left, right), name in zip(rows, names):
        places = np.stack([table[f"{name}.position_{axis}"] for axis in AXES], axis=1)
        axis = int(np.argmax(np.ptp(places, axis=0)))
        factor, prefix = style.prefix_of(places[:, axis])
        left.plot(time, places[:, axis] / factor, color=style.SECOND, linewidth=1.2)
        left.set_ylabel(f"{AXES[axis]} [{prefix}m]")
        left.set_title(name)
        beside, unit, along = _beside(table, name, axis)
        values = table[f"{name}.{beside}_{AXES[along]}"]
        factor, prefix = style.prefix_of(values)
        right.plot(time, values / factor, color=style.ACCENT, linewidth=1.2)
        right.set_ylabel(f"{beside} along {AXES[along]} [{prefix}{unit}]")
        left.margins(x=0)
    for axes in rows[-1]:
        axes.set_xlabel(time_label)
    curve_styles.tell_left_out(figure, list(results.gauges), names, "gauges.csv")
    return figure


@style.styled
def walls(results):
    """Force [N] of the spheres on each wall along the axis on which it is largest, against time."""
    table = results.wall_table
    names = [column.removesuffix(".force_x") for column in table if column.endswith(".force_x")]
    if not names or table.rows < 2:
        return None
    time, time_label = plot.time_axis(table)
    figure = style.figure(9.0, 3.4)
    axes = figure.subplots()
    curve_styles.tell_left_out(figure, names, names[:MOST_CURVES], "walls.csv")
    forces = {name: np.stack([table[f"{name}.force_{axis}"] for axis in AXES], axis=1) for name in names[:MOST_CURVES]}
    factor, prefix = style.prefix_of(*forces.values())
    for name, force in forces.items():
        axis = int(np.argmax(np.abs(force).max(axis=0)))
        axes.plot(time, force[:, axis] / factor, linewidth=1.0, label=f"{name}, {AXES[axis]}")
    axes.set_xlabel(time_label)
    axes.set_ylabel(f"force [{prefix}N]")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3)
    axes.margins(x=0)
    return figure


@style.styled
def broken_bodies(results):
    """Number of broken bonded bodies and of broken bonds against time."""
    history = results.history
    if "broken_bodies" not in history or history.rows < 2:
        return None
    time, time_label = plot.time_axis(history)
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    axes.plot(time, history["broken_bodies"], color=style.ACCENT, linewidth=1.6)
    axes.set_xlabel(time_label)
    axes.set_ylabel("broken bodies", color=style.ACCENT)
    axes.set_ylim(bottom=0)
    other = axes.twinx()
    other.plot(time, history["broken_bonds"], color=style.SECOND, linewidth=1.2)
    other.set_ylabel("broken bonds", color=style.SECOND)
    other.set_ylim(bottom=0)
    other.grid(False)
    axes.margins(x=0)
    return figure


@style.styled
def contacts(results):
    """Number of contacts and maximum speed [m/s] against time."""
    history = results.history
    if "contacts" not in history or history.rows < 2:
        return None
    time, time_label = plot.time_axis(history)
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    axes.plot(time, history["contacts"], color=style.SECOND, linewidth=1.2)
    axes.set_xlabel(time_label)
    axes.set_ylabel("contacts")
    axes.set_ylim(bottom=0)
    other = axes.twinx()
    other.plot(time, history["speed_max"], color=style.ACCENT, linewidth=0.9)
    other.set_ylabel("maximum speed [m/s]")
    other.set_ylim(bottom=0)
    other.grid(False)
    axes.margins(x=0)
    return figure


def sections(results):
    """The pictures of a run."""
    bonded = [
        Section(
            "broken_bonds", "Broken bonds", "Spheres coloured by their share of broken bonds, at times between which equally many bonds break.", partial(broken_bonds, results), "No bond is broken.",
        )
    ] if results.figures.get("bonds", 0) > 0 else []
    return [
        Section(
            "spheres", "Spheres",
            "Spheres coloured by speed at times between which they move equally far; the front half is cut away where there are many. "
            "Walls of triangles are light and transparent. Where the spheres move far, each picture has a scale of its own, and the title says how "
            "many are outside of it.",
            partial(pictures, results), common.NO_SNAPSHOTS, places=True,
        ),
        *bonded,
        *(_piece_sections(results) if results.figures.get("bodies", 0) > 0 else []),
        Section(
            "groups", "Groups",
            "Centre of mass of the recorded groups along the axis of their largest displacement; beside it the velocity, or the "
            "force on groups of constant velocity.",
            partial(groups, results), common.NO_GAUGES,
        ),
        Section(
            "energies", "Energy balance",
            "Stored and dissipated energy by cause, stacked; below, the residual. Gravity, moving walls and waves supply energy.",
            partial(energies, results), common.NO_HISTORY,
        ),
        Section(
            "walls", "Wall forces", "Force of the spheres on each wall along the axis on which it is largest.", partial(walls, results),
            "The case has no walls.",
        ),
        Section(
            "contacts", "Contacts", "Number of contacts, and maximum speed of any sphere.", partial(contacts, results), common.NO_HISTORY,
            wide=False,
        ),
        common.timing_section(results),
    ]


def _piece_sections(results):
    """The pictures of a run with bonded bodies."""
    return [
        Section(
            "fragment_curve", "Fragment size distribution",
            "Cumulative volume passing of all bonded bodies; 50 % of the volume is in pieces smaller than P50.",
            partial(plot.fragment_curve, results), "The run is not complete.", wide=False,
        ),
        Section(
            "broken_bodies", "Broken bodies", "Number of bodies in more than one piece, and of broken bonds, over time.",
            partial(broken_bodies, results), common.NO_HISTORY, wide=False,
        ),
    ]


def _step_note(figures):
    """The stability limit of the time step, and the time levels where there are any."""
    limit = common.quantity_note("predicted_limit", "stability limit ", "s")(figures)
    if "levels" not in figures:
        return limit
    return f"{figures['levels']} time levels, smallest step {quantity(figures['smallest_step'], 's')}, {limit}"


def verdict(results):
    """The verdict of a run that is done: by its energy balance, and by how much its contacts loaded the step."""
    tone, words = common.strict_balance_verdict(results, GOOD_BALANCE, BAD_BALANCE, "reference energy")
    load = results.figures.get("step_load")
    if load is None or load <= 1.0:
        return tone, words
    return "bad" if tone == "bad" else "fair", (
        f"{words} The contacts of a sphere loaded the step {load:.2g} times as much as is stable, so the motion may have gained energy: use "
        f"a smaller stability_fraction."
    )


METHOD = Method(
    sections=sections,
    verdict=verdict,
    headlines=(
        Figure("broken_bodies", "broken bodies", note=common.share_note("broken_bodies", "bodies")),
        Figure("fragments", "fragments"),
        Figure("peak_speed", "peak speed", "m/s", common.said("of any sphere")),
        Figure("energy_work", "reference energy", "J"),
        Figure("particles", "particles"),
        Figure("contacts", "final contacts"),
        Figure("step", "time step", "s", _step_note),
    ),
    snapshots="particles",
    fields={
        "velocity": ("speed", "m/s"),
        "broken_fraction": ("share of broken bonds", ""),
        "angular_velocity": ("angular velocity", "rad/s"),
    },
)
