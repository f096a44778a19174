"""Method mps: moving particles of an elastic ground that may fail, in an earthquake."""

from functools import partial

import numpy as np

from sazare import plot, style
from sazare.base_motion import SeenFromBase
from sazare.methods import Figure, Headline, Method, Section, common
from sazare.moments import moments, movement
from sazare.snapshots import elements_once

ENERGIES = {
    "energy_kinetic": ("kinetic", style.KINETIC),
    "energy_elastic": ("elastic", style.ELASTIC),
    "energy_damping": ("Rayleigh damping", style.DASHPOT),
    "energy_plastic": ("plastic flow", style.SLIP),
    "energy_fracture": ("rupture", style.RUPTURE),
    "energy_contact": ("contacts and broken ground", style.CONTACT_DASHPOT),
    "energy_surface_contact": ("contact with the coupling surface", style.FRICTION),
}
# Causes of work, whose sum the energies above and the residual make up.
WORKS = ("energy_work_gravity", "energy_work_viscous", "energy_work_boundary", "energy_work_applied", "energy_work_surface")
KINDS = (
    (0, "free", style.STONE_EDGE), (1, "held", "#b5302a"), (2, "prescribed motion", "#d98a1f"), (3, "viscous boundary", "#1f5f9c"),
    (4, "free-field side", "#3f8f8f"),
)

GOOD_BALANCE = 1e-3  # of the work; flow and rupture in finite steps leave some 1e-4
LARGEST_SHEAR_STRAIN = 0.3  # of ground that has not broken: plastic strains are added up, which is exact for small ones only
MOST_PANELS = 4
FEWEST_MOVED = 10  # particles, that make a mass
FLAT, SLENDER = 0.3, 5.0  # height over width below which panels stand one above the other, and above which proportions are not true
MOVED, SMALL_PART = 0.05, 0.6  # a particle counts as moved from this share of the usual displacement on; see `_frame`
STRAY, STRAY_OF_MOVED = 0.5, 2.0  # percent of all particles, and of those that moved, that frames leave out on each side
USUAL = 99.0  # percentile up to which figures of a whole mass are read


def _up(points):
    """The axis that points upwards: z in space, y in the plane."""
    return 2 if np.ptp(points[:, 2]) > 0.0 else 1


def _starts(grid):
    """Where the particles of a snapshot were at the beginning (n, 3) [m]."""
    return np.asarray(grid.points) - np.asarray(grid.cell_data["displacement"])


def _frame(starts, ends, sizes):
    """Lower and upper corner (2, 2) [m] of what is shown: the body, without particles that strayed; of a body that moves in a small part
    only, that part and some more around it.

    starts, ends: places of the particles in the plane of the picture, of every panel (n, 2) [m]; sizes: how far each has moved (n,) [m].
    """
    whole = _holding([starts[0], *ends], 0.02)
    threshold = MOVED * max((np.percentile(size, USUAL) for size in sizes), default=0.0)
    moved = [place[size > threshold] for places in (starts, ends) for place, size in zip(places, sizes) if np.any(size > threshold)]
    part = _holding(moved, 0.2, STRAY_OF_MOVED) if threshold > 0.0 and moved else whole
    part = np.stack([np.maximum(part[0], whole[0]), np.minimum(part[1], whole[1])])
    return part if np.prod(np.ptp(part, axis=0)) < SMALL_PART * np.prod(np.ptp(whole, axis=0)) else whole


def _holding(clouds, margin, stray=STRAY, each_axis=False):
    """A frame of all places but `stray` percent of them on each side, and a margin as a share of its size, or of that along each axis."""
    corners = np.concatenate([np.percentile(cloud, (stray, 100.0 - stray), axis=0) for cloud in clouds])
    room = margin * (np.ptp(corners, axis=0) if each_axis else np.ptp(corners, axis=0).max())
    return np.stack([corners.min(axis=0) - room, corners.max(axis=0) + room])


def _marker(grid, frame, room):
    """Area of the mark of a particle [points²] with which neighbours touch, in axes of a size [inch]."""
    spacing = float(np.median(grid.cell_data["spacing"])) if "spacing" in grid.cell_data else 0.0
    points_per_metre = 72.0 * min(np.asarray(room) / np.ptp(frame, axis=0))
    return float(np.clip((1.05 * spacing * points_per_metre) ** 2, 1.5, 200.0))


def _show(axes, frame, up):
    """Limits and names of axes in true proportion."""
    axes.set(xlim=frame[:, 0], ylim=frame[:, 1], xlabel="x [m]", ylabel=f"{'xyz'[up]} [m]")
    axes.set_aspect("equal")
    axes.grid(False)
    axes.label_outer()


def _chosen(snapshots, sizes, base):
    """Snapshots between which the particles move equally far, seen from the base, and the one of the largest displacement where it is another one."""
    moved = movement(elements_once(snapshots[0]))
    chosen = moments(snapshots, MOST_PANELS + 1, lambda before, after: moved(base.seen(before), base.seen(after)))[1:]
    largest = int(np.argmax(sizes))
    return chosen if max(sizes[number] for number in chosen) > 0.95 * sizes[largest] else sorted({*chosen[1:], largest})


@style.styled
def displaced(results):
    """Particles at some times, coloured by displacement [m], relative to the base where a motion enters; magnified where the title says so."""
    snapshots = results.particle_snapshots
    if len(snapshots) < 2:
        return None
    base = SeenFromBase(results)
    sizes = [np.linalg.norm(base.mesh(snapshot).cell_data["displacement"], axis=1).max() for snapshot in snapshots]
    chosen = _chosen(snapshots, sizes, base)
    points = _starts(snapshots[0].elements)
    up = _up(points)
    extent = max(np.ptp(points[:, 0]), np.ptp(points[:, up]), 1e-9)
    thin = np.ptp(points[:, 0]) < 0.05 * extent  # a column of layers: along x the displacement counts, not the shape
    grids = [base.mesh(snapshots[index]) for index in chosen]
    moved = [np.asarray(grid.cell_data["displacement"]) for grid in grids]
    factors = [common.enlargement(way, extent, largest=0.02, shown=0.04) for way in moved]
    places = [(way + [[0.0, 1.0, 1.0]] * points if thin else points + factor * way)[:, [0, up]] for way, factor in zip(moved, factors)]
    values = [np.linalg.norm(way, axis=1) for way in moved]
    unit, prefix = style.prefix_for(style.clipped_top(np.concatenate(values))[0])
    start = points[:, [0, up]]
    frame = _holding(places, 0.05, 0.0, each_axis=True) if thin else _frame([start] * len(places), places, values)
    top, clipped = style.clipped_top(np.concatenate(values) / unit)

    tall = thin or np.ptp(frame, axis=0)[1] > np.ptp(frame, axis=0)[0]
    rows, columns = (1, len(chosen)) if tall else ((len(chosen) + 1) // 2, min(2, len(chosen)))
    ratio = np.ptp(frame, axis=0)[1] / np.ptp(frame, axis=0)[0]
    if ratio < FLAT:
        rows, columns = len(chosen), 1
    room = (7.6 / columns, 4.6 if tall else 7.6 / columns * ratio)
    figure = style.figure(9.0, 5.4 if tall else 0.3 + rows * (room[1] + 0.6))
    panels = np.ravel(figure.subplots(rows, columns, squeeze=False, sharex=not thin, sharey=True))
    for axes in panels[len(chosen):]:
        axes.set_axis_off()
    for axes, index, place, value, factor in zip(panels, chosen, places, values, factors):
        drawn = axes.scatter(*place.T, c=value / unit, cmap=style.SPEED, vmin=0.0, vmax=top, s=8.0 if thin else _marker(grids[0], frame, room),
                             linewidths=0)
        _show(axes, frame, up)
        if thin:
            axes.set_aspect("auto")
            axes.set_xlabel("displacement [m]")
            axes.locator_params(axis="x", nbins=2)
        axes.set_title(style.quantity(snapshots[index].time, "s") + (f", × {factor:g}" if factor != 1.0 and not thin else ""))
    style.colorbar(figure, drawn, list(panels), f"displacement{base.words} [{prefix}m]", clipped)
    return figure


@style.styled
def supports(results):
    """The particles that are held, moved or on a viscous or free-field boundary, where they begin; None where all are free."""
    snapshots = results.particle_snapshots
    if not len(snapshots) or "support" not in snapshots[0].elements.cell_data:
        return None
    grid = snapshots[0].elements
    points, kinds = np.asarray(grid.points), np.asarray(grid.cell_data["support"])
    if not np.any(kinds):
        return None
    places = points[:, [0, _up(points)]]
    frame = _holding([places], 0.04, 0.0, each_axis=True)
    ratio = np.ptp(frame, axis=0)[1] / np.ptp(frame, axis=0)[0]
    slender = ratio > SLENDER
    room = (2.4, 4.6) if slender else (8.2, 8.2 * min(ratio, 0.7))
    figure = style.figure(room[0] + 0.8, room[1] + 1.0)
    axes = figure.subplots()
    size = _marker(grid, frame, room)
    for kind, label, color in KINDS:
        chosen = kinds == kind
        if chosen.any():
            # Supports are a single row, which must be seen in a large body too.
            axes.scatter(*places[chosen].T, s=max(size, 9.0) if kind else size, c=color, linewidths=0, label=f"{label}: {style.count(chosen.sum())}")
    _show(axes, frame, _up(points))
    if slender:
        axes.set_aspect("auto")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=1 if slender else 4, markerscale=max(1.0, 5.0 / np.sqrt(size)))
    return figure


@style.styled
def failure(results):
    """Equivalent plastic shear strain [-] and share of broken links [-] of the particles at the end."""
    snapshots = results.particle_snapshots
    if not len(snapshots) or "plastic_shear_strain" not in snapshots[-1].elements.cell_data:
        return None
    grid = SeenFromBase(results).mesh(snapshots[-1])
    points = np.asarray(grid.points)
    columns = [0, _up(points)]
    moved = np.linalg.norm(grid.cell_data["displacement"], axis=1)
    frame = _frame([_starts(grid)[:, columns]], [points[:, columns]], [moved])
    fields = [("plastic_shear_strain", "equivalent plastic shear strain [-]"), ("broken_fraction", "share of broken links [-]")]
    room = (7.2, min(7.2 * np.ptp(frame, axis=0)[1] / np.ptp(frame, axis=0)[0], 4.5))
    figure = style.figure(9.0, 2.0 * (room[1] + 0.6))
    for axes, (name, label) in zip(figure.subplots(2, 1, sharex=True), fields):
        values = np.asarray(grid.cell_data[name])
        top, clipped = style.clipped_top(values)
        drawn = axes.scatter(*points[:, columns].T, c=values, cmap=style.SPEED, vmin=0.0, vmax=top, s=_marker(grid, frame, room), linewidths=0)
        _show(axes, frame, columns[1])
        axes.set_title(label)
        style.colorbar(figure, drawn, axes, "", clipped)
    return figure


@style.styled
def stresses(results):
    """Equivalent shear strain [-], shear and mean stress [Pa] of the particles in the snapshot in which the ground is sheared most; None without them."""
    snapshots = results.particle_snapshots
    if not len(snapshots) or "equivalent_shear_strain" not in snapshots[-1].elements.cell_data:
        return None
    sheared = [float(np.percentile(elements_once(snapshot).cell_data["equivalent_shear_strain"], USUAL)) for snapshot in snapshots]
    most = int(np.argmax(sheared))
    grid = snapshots[most].elements
    points = np.asarray(grid.points)
    columns = [0, _up(points)]
    frame = _holding([points[:, columns]], 0.04, STRAY, each_axis=True)
    ratio = np.ptp(frame, axis=0)[1] / np.ptp(frame, axis=0)[0]
    tall = ratio > 1.0
    fields = [("equivalent_shear_strain", "equivalent shear strain", ""), ("von_mises_stress", "von Mises stress", "Pa"), ("pressure", "pressure", "Pa")]
    room = (2.4, 4.6) if tall else (7.2, min(7.2 * ratio, 3.2))
    shape = (1, len(fields)) if tall else (len(fields), 1)
    figure = style.figure(9.0, 5.4 if tall else 0.3 + len(fields) * (room[1] + 0.6))
    for axes, (name, label, unit) in zip(np.ravel(figure.subplots(*shape, squeeze=False, sharex=True, sharey=True)), fields):
        values = np.asarray(grid.cell_data[name])
        low, high = style.bulk(values)
        factor, prefix = style.prefix_of([low, high]) if unit else (1.0, "")
        drawn = axes.scatter(*points[:, columns].T, c=values / factor, cmap=style.SPEED, vmin=low / factor, vmax=high / factor, s=_marker(grid, frame, room), linewidths=0)
        _show(axes, frame, columns[1])
        if ratio > SLENDER:
            axes.set_aspect("auto")
        axes.set_title(label)
        style.open_colorbar(figure, drawn, axes, values, factor, prefix, unit)
    figure.suptitle(style.quantity(snapshots[most].time, "s"))
    return figure


def run_out(start, end, spacing):
    """How far the front of a mass that has moved came, in which direction, and how high the mass lies: (run-out [m], words such as "+x",
    height [m], height at the start [m]); None where nothing has moved by more than twice the spacing. Of several masses, such as the two
    slopes of a cutting, the one that came farthest. Single particles do not count: all but one in a hundred do.

    start, end (n, 3): places of the particles [m]; spacing: theirs [m].
    """
    up = _up(start)
    moved = np.linalg.norm(end - start, axis=1) > 2.0 * spacing
    masses = [mass for mass in _masses(start[moved], end[moved], 3.0 * spacing) if len(mass[0]) >= FEWEST_MOVED]
    found = []
    for before, after in masses:
        far, words = max(
            (float(np.percentile(sign * after[:, axis], USUAL) - np.max(sign * before[:, axis])), f"{'+' if sign > 0 else '−'}{'xyz'[axis]}")
            for axis in range(up) for sign in (1.0, -1.0)
        )
        heights = [float(np.ptp(np.percentile(place[:, up], (100.0 - USUAL, USUAL)))) + spacing for place in (after, before)]
        found.append((max(far, 0.0), words, *heights))
    return max(found, default=None)


def _masses(start, end, gap):
    """Places of particles at the start and in the end, split where they left a gap along x [m] at the start."""
    order = np.argsort(start[:, 0])
    cuts = np.flatnonzero(np.diff(start[order, 0]) > gap) + 1
    return [(start[part], end[part]) for part in np.split(order, cuts)]


def measured(results):
    """Figures in words that are read from the last snapshot: displacement of the mass, and of ground that fails the run-out."""
    snapshots = results.particle_snapshots
    if len(snapshots) < 2:
        return []
    base = SeenFromBase(results)
    grid = base.mesh(snapshots[-1])
    moved = np.asarray(grid.cell_data["displacement"])
    size = np.linalg.norm(moved, axis=1)
    found = [Headline(
        "final displacement", style.quantity(float(np.percentile(size, USUAL)), "m"),
        f"99 % of the particles moved less{base.words}; largest {style.quantity(float(size.max()), 'm')}",
    )]
    if "plastic_shear_strain" in grid.cell_data:
        out = run_out(_starts(grid), np.asarray(grid.points), float(np.median(grid.cell_data["spacing"])))
        if out is not None:
            far, words, height, before = out
            found.append(Headline("run-out", style.quantity(far, "m"), f"of the front of the moved mass, along {words}"))
            found.append(Headline("height of the deposit", style.quantity(height, "m"), f"of the moved mass; {style.quantity(before, 'm')} at the start"))
    return found


def sections(results):
    """The pictures of a run."""
    failing = [
        Section(
            "failure", "Failure", "Equivalent plastic shear strain, and share of broken links of each particle, at the end, where the particles moved; where a motion enters, seen from the base.",
            partial(failure, results), common.NO_SNAPSHOTS,
        )
    ] if "energy_plastic" in results.history else []
    return [
        Section(
            "supports", "Supports", "Particles that are held, moved by a prescribed motion or on a viscous or free-field boundary, and how many.",
            partial(supports, results), "No particle is held, moved or on a viscous or free-field boundary.",
        ),
        *common.shaking_sections(results),
        *common.wave_sections(results),
        Section(
            "displaced", "Displaced particles", "Particles at times between which they move equally far, and at the largest displacement. Where a motion enters, they are "
            "seen from the base, the lowest particles. Displacements are magnified where the title says so; single particles far from the others are out of the picture.",
            partial(displaced, results), common.NO_SNAPSHOTS,
        ),
        Section(
            "stresses", "Stress and strain", "Equivalent shear strain, von Mises stress and pressure of the particles, in the snapshot in which the ground is sheared most. "
            "Colours are for the bulk of the values: where the bar is open, few are far beyond it, as beside a border to much stiffer ground and at free surfaces.",
            partial(stresses, results), common.NO_SNAPSHOTS,
        ),
        *failing,
        Section(
            "energies", "Energy balance",
            "Stored and dissipated energy by cause, stacked, and the work of gravity, boundaries, moving supports and forces; below, the "
            "residual as a share of the work.",
            partial(plot.energy, results, ENERGIES, WORKS), common.NO_HISTORY,
        ),
        common.timing_section(results),
    ]


def balance(figures):
    """The energy residual as a share of the work of all causes, or of the energy in the ground where that is more; None without a balance."""
    residual = figures.get("energy_residual")
    if residual is None:
        return None
    work = sum(abs(figures.get(name) or 0.0) for name in WORKS)
    stored = abs(figures.get("energy_kinetic") or 0.0) + abs(figures.get("energy_elastic") or 0.0)
    reference = max(work, stored)
    return abs(residual) / reference if reference else None


def verdict(results):
    """By the energy balance; the time step is compared with the stability limit."""
    share = balance(results.figures)
    if share is None:
        tone, words = common.missing_balance_verdict(results.figures)
    elif share > GOOD_BALANCE:
        words = common.balance_words(share)
        if share <= common.BAD_BALANCE:
            return "fair", f"{words} It should be below {GOOD_BALANCE:.0e}: consider a smaller stability_fraction."
        return "bad", f"{words} This is too large for reliable results: use a smaller stability_fraction."
    else:
        tone, words = "good", common.balance_words(share)
    sheared = results.figures.get("unbroken_shear_strain") or 0.0
    if sheared > LARGEST_SHEAR_STRAIN:
        tone = "fair" if tone == "good" else tone
        words += f" Ground has sheared by {sheared:.2g} without breaking: above {LARGEST_SHEAR_STRAIN} it is too weak and loses volume. Give a smaller rupture_strain."
    limit, step = results.figures.get("predicted_limit"), results.figures.get("step")
    return tone, words + (f" The time step is {step / limit:.2f} of the predicted stability limit." if limit and step else "")


METHOD = Method(
    sections=sections,
    verdict=verdict,
    headlines=(
        Figure("peak_speed", "peak speed", "m/s", note=common.said("of any particle")),
        Figure("particles", "particles"),
        Figure("broken_links", "broken links"),
        Figure("peak_acceleration", "peak acceleration", "m/s²", note=common.said("of any particle")),
        Figure("peak_displacement", "peak displacement", "m", note=common.said("of any particle")),
        Figure("step", "time step", "s", common.quantity_note("predicted_limit", "stability limit ", "s")),
    ),
    measured=measured,
    snapshots="particles",
    fields={
        "velocity": ("speed", "m/s"),
        "displacement": ("displacement", "m"),
        "plastic_shear_strain": ("equivalent plastic shear strain", ""),
        "broken_fraction": ("share of broken links", ""),
        "shear_strain_max": ("largest shear strain", ""),
        "equivalent_shear_strain": ("equivalent shear strain", ""),
        "von_mises_stress": ("von Mises stress", "Pa"),
        "pressure": ("pressure", "Pa"),
        "acceleration": ("acceleration", "m/s²"),
    },
    tables=common.shaking_tables,
    sheets=common.structure_sheets,
)
