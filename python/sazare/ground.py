"""Pictures of a run of method mps: motion at the gauges, spectra, the displaced particles. Each returns a Figure, or None without data."""

import numpy as np

from sazare import style

MOST_GAUGES = 8
AXES = "xyz"


def gauge_history(results, name, quantity):
    """(n, 3) of displacement [m], velocity [m/s] or acceleration [m/s2] at a gauge."""
    table = results.gauge_table
    return np.stack([table[f"{name}.{quantity}_{axis}"] for axis in AXES], axis=1)


def main_axis(results):
    """The axis along which the gauges are accelerated most, 0 to 2."""
    peaks = [np.abs(gauge_history(results, name, "acceleration")).max(axis=0) for name in results.gauges]
    return int(np.argmax(np.max(peaks, axis=0))) if peaks else 0


@style.styled
def accelerations(results):
    """Acceleration at every gauge against time, one above the other in the order of the case."""
    names = list(results.gauges)[:MOST_GAUGES]
    if not names or results.gauge_table.rows < 2:
        return None
    axis, time = main_axis(results), results.gauge_table["time"]
    figure = style.figure(9.0, 0.7 + 1.35 * len(names))
    rows = figure.subplots(len(names), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    for axes, name in zip(rows, reversed(names)):
        values = gauge_history(results, name, "acceleration")[:, axis]
        peak = int(np.argmax(np.abs(values)))
        axes.plot(time, values, color=style.SECOND, linewidth=1.0)
        axes.plot(time[peak], values[peak], "o", color=style.ACCENT, markersize=4)
        axes.set_title(f"{name}: {values[peak]:.3g} m/s² at {time[peak]:.3g} s")
        axes.margins(x=0)
    rows[len(rows) // 2].set_ylabel(f"acceleration along {AXES[axis]} [m/s²]")
    rows[-1].set_xlabel("time [s]")
    return figure


@style.styled
def spectra(results):
    """Fourier amplitude of the acceleration at the first and the last gauge, and their ratio."""
    names = list(results.gauges)
    if len(names) < 2 or results.gauge_table.rows < 16:
        return None
    axis, time = main_axis(results), results.gauge_table["time"]
    step = (time[-1] - time[0]) / (len(time) - 1)
    frequency = np.fft.rfftfreq(len(time), step)[1:]
    first, last = (np.abs(np.fft.rfft(gauge_history(results, name, "acceleration")[:, axis]))[1:] * step for name in (names[0], names[-1]))
    shown = frequency <= min(25.0, frequency[-1])
    figure = style.figure(9.0, 3.4)
    left, right = figure.subplots(1, 2)
    left.loglog(frequency[shown], first[shown], color=style.SECOND, linewidth=0.9, label=names[0])
    left.loglog(frequency[shown], last[shown], color=style.ACCENT, linewidth=0.9, label=names[-1])
    left.set_ylabel("Fourier amplitude [m/s]")
    left.legend()
    # Where the first gauge hardly moves the ratio says nothing.
    strong = shown & (first > 1e-3 * first.max())
    right.semilogx(frequency[strong], last[strong] / first[strong], color=style.INK, linewidth=0.9)
    right.set_ylabel(f"{names[-1]} / {names[0]}")
    right.set_ylim(bottom=0)
    for axes in (left, right):
        axes.set_xlabel("frequency [Hz]")
    return figure


def _enlargement(displacement, extent):
    """A round factor with which the largest displacement is some percent of the body; 1 where it is that large itself."""
    largest = np.linalg.norm(displacement, axis=1).max(initial=0.0)
    if largest <= 0.0 or largest > 0.02 * extent:
        return 1.0
    factor = 0.04 * extent / largest
    power = 10.0 ** np.floor(np.log10(factor))
    return float(power * max(step for step in (1, 2, 5) if step * power <= factor))


@style.styled
def displaced(results):
    """Particles where they are at four times, coloured by displacement; enlarged where the title says so."""
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
        factor = _enlargement(moved, extent)
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
def failure(results):
    """Slip of the ground and the share of its links that broke, at the end, where the particles are."""
    snapshots = results.particle_snapshots
    if not len(snapshots) or "slip" not in snapshots[-1].elements.cell_data:
        return None
    grid = snapshots[-1].elements
    points = np.asarray(grid.points)
    up = 2 if np.ptp(points[:, 2]) > 0.0 else 1
    fields = [("slip", "plastic slip [-]"), ("broken_share", "links broken [-]")]
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
    """Kinetic and elastic energy against time, and what damping and failing have dissipated."""
    history = results.history
    if "energy_kinetic" not in history or history.rows < 2:
        return None
    figure = style.figure(6.2, 3.6)
    axes = figure.subplots()
    names = [("energy_kinetic", "kinetic", "#35618f"), ("energy_elastic", "elastic", "#6fa3c7"), ("energy_damping", "damping", "#b9b3a8"),
             ("energy_flow", "flow", "#c98a3d"), ("energy_rupture", "rupture", "#a64b3c"), ("energy_contact", "contacts", "#8a8f3d")]
    shown = [(history[key], label, color) for key, label, color in names if key in history]
    factor, prefix = style.prefix_for(sum(values for values, _, _ in shown).max(initial=0.0))
    axes.stackplot(history["time"], *[values / factor for values, _, _ in shown], labels=[label for _, label, _ in shown],
                   colors=[color for _, _, color in shown], linewidth=0)
    axes.set_xlabel("time [s]")
    axes.set_ylabel(f"energy [{prefix}J]")
    axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=len(shown))
    axes.margins(x=0)
    return figure
