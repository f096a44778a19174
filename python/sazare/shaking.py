"""Motion at the gauges of a run under an earthquake or another load in time. Each picture is a Figure, or None without data."""

import warnings

import numpy as np

from sazare import curve_styles, style
from sazare.ground_motion.gauges import base_of, from_below, gauge_motions, input_axes, residual, stacks, tilt, up_axis
from sazare.ground_motion.intensity import arias_intensity, husid
from sazare.ground_motion.pictures import add_gal
from sazare.ground_motion.profiles import shear_history_of
from sazare.ground_motion.record import GAL
from sazare.ground_motion.spectra import response_spectrum, usual_periods

MOST_ROWS = 12  # gauges with axes of their own
AXES = "xyz"


def gauge_history(results, name, quantity):
    """(n, 3) of displacement [m], velocity [m/s] or acceleration [m/s2] at a gauge."""
    table = results.gauge_table
    return np.stack([table[f"{name}.{quantity}_{axis}"] for axis in AXES], axis=1)


def main_axis(results):
    """The axis of the input motion, 0 to 2: of several the one along which the lowest gauge is accelerated most, and without any the one
    along which the gauges are."""
    axes, motions = input_axes(results), gauge_motions(results)
    looked_at = [base_of(results, motions).name] if axes and motions else results.gauges
    peaks = [np.abs(gauge_history(results, name, "acceleration")).max(axis=0) for name in looked_at]
    if not peaks:
        return 0
    axes = axes or range(3)
    return axes[int(np.argmax(np.max(peaks, axis=0)[list(axes)]))]


@style.styled
def accelerations(results):
    """Acceleration [m/s2] at every gauge against time, the highest one on top."""
    every = from_below(results, list(results.gauges))
    if not every or results.gauge_table.rows < 2:
        return None
    names = curve_styles.spread(every, MOST_ROWS)
    axis, time = main_axis(results), results.gauge_table["time"]
    figure = style.figure(9.0, 0.7 + 1.35 * len(names))
    rows = figure.subplots(len(names), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    for axes, name in zip(rows, reversed(names)):
        values = gauge_history(results, name, "acceleration")[:, axis]
        peak = int(np.argmax(np.abs(values)))
        axes.plot(time, values, color=style.SECOND, linewidth=1.0)
        axes.plot(time[peak], values[peak], "o", color=style.ACCENT, markersize=4)
        axes.set_title(f"{name}: {values[peak]:.3g} m/s² ({values[peak] / GAL:.3g} gal) at {time[peak]:.3g} s")
        axes.margins(x=0)
    rows[len(rows) // 2].set_ylabel(f"acceleration along {AXES[axis]} [m/s²]")
    rows[-1].set_xlabel("time [s]")
    curve_styles.tell_left_out(figure, every, names, "gauges.csv")
    return figure


@style.styled
def spectra(results):
    """Fourier amplitude spectra [m/s] of the acceleration at the lowest and the highest gauge, and their ratio [-]."""
    names = from_below(results, list(results.gauges))
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
    # Where the lower gauge hardly moves the ratio says nothing.
    strong = shown & (first > 1e-3 * first.max())
    right.semilogx(frequency[strong], last[strong] / first[strong], color=style.INK, linewidth=0.9)
    right.set_ylabel(f"spectral ratio {names[-1]} / {names[0]} [-]")
    right.set_ylim(bottom=0)
    for axes in (left, right):
        axes.set_xlabel("frequency [Hz]")
    return figure


def _drawn(results, motions):
    """Gauges from below, as many as can be told apart, each with its colour and line; the lowest and the highest are always among them, and of
    many have thicker lines."""
    named = {motion.name: motion for motion in motions}
    names = curve_styles.spread(from_below(results, list(named)))
    ends = (0, len(names) - 1) if len(names) > curve_styles.MOST_INSIDE else ()
    return [(named[name], {**curve_styles.look(number), "linewidth": 2.0 if number in ends else 1.1}) for number, name in enumerate(names)]


def _tell(figure, results, motions, drawn, source):
    """Says which gauges have no curve, and where their numbers are."""
    curve_styles.tell_left_out(figure, from_below(results, [motion.name for motion in motions]), [motion.name for motion, _ in drawn], source)


@style.styled
def response_spectra(results):
    """Pseudo acceleration spectra [m/s2] with 5 % damping at the gauges, and their ratio to the lowest one [-]."""
    motions = gauge_motions(results)
    if not motions:
        return None
    base, axis = base_of(results, motions), main_axis(results)
    rows = motions[0].record(axis)
    periods = usual_periods(max(0.02, 2.0 * rows.step), max(0.04, 4.0 * rows.step, min(10.0, rows.duration)))
    figure = curve_styles.figure(9.0, 3.6, len(motions))
    left, right = figure.subplots(1, 2)

    def spectrum_of(motion):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", UserWarning)  # a run is as long as it is
            return response_spectrum(motion.record(axis), periods).pseudo_acceleration

    below = spectrum_of(base)
    strong = below > 1e-3 * below.max()  # elsewhere the ratio says nothing
    drawn = _drawn(results, motions)
    for motion, look in drawn:
        own = below if motion is base else spectrum_of(motion)
        left.semilogx(periods, own, label=motion.name, **look)
        if motion is not base:
            right.semilogx(periods[strong], own[strong] / below[strong], **look)
    _tell(figure, results, motions, drawn, "gauges.csv, from which sazare.ground_motion.response_spectrum in Python finds their spectra")
    left.set_ylabel(f"pseudo acceleration along {AXES[axis]} [m/s²]")
    left.set_ylim(bottom=0.0)
    curve_styles.legend(left, right)
    add_gal(left)
    right.set_ylabel(f"ratio to {base.name} [-]")
    right.set_ylim(bottom=0.0)
    for axes in (left, right):
        axes.set_xlabel("period [s]")
    return figure


@style.styled
def husid_curves(results):
    """Arias intensity [m/s] that has come by a time, at every gauge."""
    motions = gauge_motions(results)
    if not motions:
        return None
    axis = main_axis(results)
    figure = curve_styles.figure(6.2, 3.4, len(motions))
    axes = figure.subplots()
    drawn = _drawn(results, motions)
    for motion, look in drawn:
        record = motion.record(axis)
        whole = arias_intensity(record)
        axes.plot(motion.time, whole * husid(record), label=f"{motion.name}: {whole:.3g} m/s", **look)
    _tell(figure, results, motions, drawn, "ground_motion.csv for their Arias intensity, gauges.csv for its growth")
    axes.set(xlabel="time [s]", ylabel=f"Arias intensity along {AXES[axis]} [m/s]")
    axes.set_ylim(bottom=0.0)
    axes.margins(x=0)
    curve_styles.legend(axes)
    return figure


@style.styled
def profiles(results):
    """Peak acceleration [m/s2], velocity [m/s] and displacement [m] of gauges above each other, against their height [m], and below the peak
    shear strain [-] and shear stress [Pa] between them, where the motion is horizontal."""
    motions = gauge_motions(results)
    found = stacks(results, motions) if motions else []
    if not found:
        return None
    axis, up = main_axis(results), up_axis(results, motions)
    labels = [f"{stack[0].name} to {stack[-1].name}" for stack in found]
    drawn = [(stack, curve_styles.look(number)) for number, stack in enumerate(found[: curve_styles.MOST])]
    sheared = [] if axis == up else [(one, look) for stack, look in drawn if (one := shear_history_of(results, stack, axis, up)) is not None]
    figure = style.figure(9.0, 4.2 if not sheared else 8.0)
    grid = figure.subplots(1 + bool(sheared), 3, sharey=True, squeeze=False)
    panels = grid[0]
    for (stack, look), label in zip(drawn, labels):
        heights = [motion.point[up] for motion in stack]
        for axes, quantity in zip(panels, ("acceleration", "velocity", "displacement")):
            peaks = [np.abs(getattr(motion, quantity)[:, axis]).max() for motion in stack]
            axes.plot(peaks, heights, marker="o", linewidth=1.2, markersize=4, label=label, **look)
    for axes, words in zip(panels, ("acceleration [m/s²]", "velocity [m/s]", "displacement [m]")):
        axes.set_xlabel(f"peak {words}, along {AXES[axis]}")
        axes.set_xlim(0.0, 1.08 * axes.dataLim.x1)
    beside = panels[0].secondary_xaxis("top", functions=(lambda value: value / GAL, lambda value: GAL * value))
    beside.set_xlabel("[gal]")
    panels[0].set_ylabel(f"{AXES[up]} [m]")
    if len(found) > 1:
        curve_styles.legend(panels[-1])
    curve_styles.tell_left_out(figure, labels, labels[: len(drawn)], "ground_motion.csv and profiles.csv")
    if sheared:
        _draw_shear(grid[1], sheared, f"{AXES[up]} [m]")
    return figure


def _draw_shear(panels, sheared, label):
    """Peak strain and stress of each stack (its ShearHistory, and its colour and line); panels without data are taken away."""
    percent = 100.0
    peaks = [(one.height, *one.peaks(), look) for one, look in sheared]
    stresses = [(height, stress, look) for height, _, stress, look in peaks if np.isfinite(stress).any()]
    for height, strain, _, look in peaks:
        panels[0].plot(percent * strain, height, marker="s", linewidth=1.2, markersize=4, **look)
    if any(np.isnan(strain).any() for _, strain, _, _ in peaks):
        panels[0].set_title("not where gauges are too far apart for the waves", fontsize="small")
    panels[0].set_xlabel("peak shear strain [%]")
    panels[0].set_ylabel(label)
    factor, prefix = style.prefix_of(*(stress[np.isfinite(stress)] for _, stress, _ in stresses)) if stresses else (1.0, "")
    for height, stress, look in stresses:
        panels[1].plot(stress / factor, height, marker="s", linewidth=1.2, markersize=4, **look)
    panels[1].set_xlabel(f"peak shear stress [{prefix}Pa]")
    for axes in panels[:2]:
        axes.set_xlim(left=0.0)
    for axes in panels[1 + bool(stresses) :]:
        axes.set_axis_off()


@style.styled
def relative_displacements(results):
    """Displacement of the gauges less that of the lowest one [m], along the axis of the input motion."""
    motions = gauge_motions(results)
    if len(motions) < 2:
        return None
    base, axis = base_of(results, motions), main_axis(results)
    others = [motion for motion in motions if motion is not base]
    drawn = _drawn(results, others)
    moved = [motion.displacement[:, axis] - base.displacement[:, axis] for motion, _ in drawn]
    factor, prefix = style.prefix_of(*moved)
    figure = curve_styles.figure(9.0, 3.6, len(others))
    axes = figure.subplots()
    for (motion, look), values in zip(drawn, moved):
        axes.plot(motion.time, values / factor, label=f"{motion.name}: {_remains(motion, base, axis)}", **look)
    _tell(figure, results, others, drawn, "gauges.csv")
    axes.set(xlabel="time [s]", ylabel=f"displacement along {AXES[axis]} less that of {base.name} [{prefix}m]")
    axes.margins(x=0)
    curve_styles.legend(axes)
    return figure


def _remains(motion, base, axis):
    """What remains of the displacement against the base, in words."""
    moved, turned = residual(motion, base), tilt(motion, base)
    if moved is None:
        return "not at rest at the end"
    words = f"{style.quantity(float(moved[axis]), 'm')} remain"
    return words if turned is None else f"{words}, turned by {style.quantity(turned, 'rad')}"
