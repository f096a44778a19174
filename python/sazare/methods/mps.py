"""Method mps: moving particles of an elastic ground that may fail, in an earthquake."""

from functools import partial

import numpy as np

from sazare import style
from sazare.methods import Figure, Method, Section, common

ENERGIES = [
    ("energy_kinetic", "kinetic", style.KINETIC), ("energy_elastic", "elastic", style.ELASTIC), ("energy_damping", "damping", "#b9b3a8"),
    ("energy_plastic", "plastic flow", "#c98a3d"), ("energy_fracture", "rupture", "#a64b3c"), ("energy_contact", "contacts", "#8a8f3d"),
]


GOOD_BALANCE = 1e-3  # of the work; flow and rupture in finite steps leave some 1e-4


@style.styled
def displaced(results):
    """Particles at four times, coloured by displacement [m]; magnified where the title says so."""
    snapshots = results.particle_snapshots
    if len(snapshots) < 2:
        return None
    size = [np.linalg.norm(snapshot.elements.cell_data["displacement"], axis=1).max() for snapshot in snapshots]
    chosen = sorted({*np.linspace(0, len(snapshots) - 1, 4).round().astype(int)[1:], int(np.argmax(size))})
    first = snapshots[0].elements
    points = np.asarray(first.points) - np.asarray(first.cell_data["displacement"])
    up = 2 if np.ptp(points[:, 2]) > 0.0 else 1
    extent = max(np.ptp(points[:, 0]), np.ptp(points[:, up]), 1e-9)
    tall = np.ptp(points[:, up]) > np.ptp(points[:, 0])
    thin = np.ptp(points[:, 0]) < 0.05 * extent  # a column of layers: along x the displacement counts, not the shape
    figure = style.figure(9.0, 5.2 if tall else 1.2 + 2.4 * ((len(chosen) + 1) // 2))
    panels = np.ravel(figure.subplots(1, len(chosen)) if tall else figure.subplots((len(chosen) + 1) // 2, 2, squeeze=False))
    for axes in panels[len(chosen):]:
        axes.set_axis_off()
    top = max(size) or 1.0
    for axes, index in zip(panels, chosen):
        grid = snapshots[index].elements
        moved = np.asarray(grid.cell_data["displacement"])
        factor = common.enlargement(moved, extent, largest=0.02, shown=0.04)
        places = moved + [[0.0, 1.0, 1.0]] * points if thin else points + factor * moved
        drawn = axes.scatter(places[:, 0], places[:, up], c=np.linalg.norm(moved, axis=1), cmap=style.SPEED, vmin=0.0, vmax=top, s=3.0,
                             linewidths=0)
        axes.set_aspect("auto" if thin else "equal")
        axes.set_title(f"{snapshots[index].time:.3g} s" + (f", × {factor:g}" if factor != 1.0 and not thin else ""))
        if thin:
            axes.set_xlabel("displacement [m]")
            axes.locator_params(axis="x", nbins=2)
        axes.grid(False)
    figure.colorbar(drawn, ax=list(panels), label="displacement [m]", shrink=0.8)
    return figure


@style.styled
def supports(results):
    """The particles that are held, moved or on a viscous boundary, where they begin."""
    snapshots = results.particle_snapshots
    if not len(snapshots) or "support" not in snapshots[0].elements.cell_data:
        return None
    grid = snapshots[0].elements
    points, kinds = np.asarray(grid.points), np.asarray(grid.cell_data["support"])
    up = 2 if np.ptp(points[:, 2]) > 0.0 else 1
    figure = style.figure(9.0, 3.2)
    axes = figure.subplots()
    for kind, label, color in ((0, "free", "#d8d3c8"), (1, "held", "#a64b3c"), (2, "prescribed motion", "#c98a3d"), (3, "viscous", "#3f6f8f")):
        chosen = kinds == kind
        if chosen.any():
            axes.scatter(points[chosen, 0], points[chosen, up], s=3.0, c=color, linewidths=0, label=f"{label}: {chosen.sum()}")
    axes.set_aspect("equal")
    axes.grid(False)
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4)
    return figure


@style.styled
def failure(results):
    """Equivalent plastic shear strain [-] and share of broken links [-] of the particles at the end."""
    snapshots = results.particle_snapshots
    if not len(snapshots) or "plastic_shear_strain" not in snapshots[-1].elements.cell_data:
        return None
    grid = snapshots[-1].elements
    points = np.asarray(grid.points)
    up = 2 if np.ptp(points[:, 2]) > 0.0 else 1
    fields = [("plastic_shear_strain", "equivalent plastic\nshear strain [-]"), ("broken_fraction", "share of broken links [-]")]
    figure = style.figure(9.0, 6.0)
    for axes, (name, label) in zip(figure.subplots(2, 1, sharex=True), fields):
        values = np.asarray(grid.cell_data[name])
        drawn = axes.scatter(points[:, 0], points[:, up], c=values, cmap=style.SPEED, vmin=0.0, vmax=max(values.max(initial=0.0), 1e-9), s=2.0,
                             linewidths=0)
        axes.set_aspect("equal")
        axes.grid(False)
        figure.colorbar(drawn, ax=axes, label=label, shrink=0.8)
    return figure


@style.styled
def energies(results):
    """Kinetic and elastic energy [J] against time, and energy dissipated by damping and failure."""
    history = results.history
    if "energy_kinetic" not in history or history.rows < 2:
        return None
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    shown = [(history[key], label, color) for key, label, color in ENERGIES if key in history]
    factor, prefix = style.prefix_for(sum(values for values, _, _ in shown).max(initial=0.0))
    axes.stackplot(history["time"], *[values / factor for values, _, _ in shown], labels=[label for _, label, _ in shown],
                   colors=[color for _, _, color in shown], linewidth=0)
    axes.set_xlabel("time [s]")
    axes.set_ylabel(f"energy [{prefix}J]")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3)
    axes.margins(x=0)
    return figure


def sections(results):
    """The pictures of a run."""
    failing = [
        Section(
            "failure", "Failure", "Equivalent plastic shear strain, and share of broken links of each particle, at the end.",
            partial(failure, results), common.NO_SNAPSHOTS,
        )
    ] if "energy_plastic" in results.history else []
    return [
        Section(
            "supports", "Supports", "Particles that are held, moved by a prescribed motion or on a viscous boundary, and how many.",
            partial(supports, results), common.NO_SNAPSHOTS,
        ),
        *common.shaking_sections(results),
        Section(
            "displaced", "Displaced particles", "Particle positions, coloured by displacement; displacements are magnified where the title says so.",
            partial(displaced, results), common.NO_SNAPSHOTS,
        ),
        *failing,
        Section(
            "energies", "Energy", "Kinetic and elastic energy of the particles, and energy dissipated by damping and failure.",
            partial(energies, results), common.NO_HISTORY, wide=False,
        ),
        common.timing_section(results),
    ]


def balance(figures):
    """The energy residual as a share of the work of all causes, or of the energy in the ground where that is more; None without a balance."""
    residual = figures.get("energy_residual")
    if residual is None:
        return None
    work = sum(abs(figures.get(f"energy_{cause}") or 0.0) for cause in ("gravity", "boundary", "prescribed", "applied"))
    stored = abs(figures.get("energy_kinetic") or 0.0) + abs(figures.get("energy_elastic") or 0.0)
    reference = max(work, stored)
    return abs(residual) / reference if reference else None


def verdict(results):
    """By the energy balance; the time step is compared with the stability limit."""
    share = balance(results.figures)
    if share is not None and share > GOOD_BALANCE:
        words = common.balance_words(share)
        if share <= common.BAD_BALANCE:
            return "fair", f"{words} It should be below {GOOD_BALANCE:.0e}: consider a smaller stability_fraction."
        return "bad", f"{words} This is too large for reliable results: use a smaller stability_fraction."
    limit, step = results.figures.get("predicted_limit"), results.figures.get("step")
    words = "The run is complete." if share is None else common.balance_words(share)
    return "good", words + (f" The time step is {step / limit:.2f} of the predicted stability limit." if limit and step else "")


METHOD = Method(
    sections=sections,
    verdict=verdict,
    headlines=(
        Figure("peak_speed", "peak speed", "m/s"),
        Figure("particles", "particles"),
        Figure("broken_links", "broken links"),
        Figure("final_displacement", "final displacement", "m"),
        Figure("peak_acceleration", "peak acceleration", "m/s²"),
        Figure("peak_displacement", "peak displacement", "m"),
        Figure("step", "time step", "s", common.quantity_note("predicted_limit", "stability limit ", "s")),
    ),
    snapshots="particles",
    fields={
        "velocity": ("speed", "m/s"),
        "displacement": ("displacement", "m"),
        "plastic_shear_strain": ("equivalent plastic shear strain", ""),
        "broken_fraction": ("share of broken links", ""),
        "acceleration": ("acceleration", "m/s²"),
    },
)
