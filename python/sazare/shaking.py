"""Motion at the gauges of a run under an earthquake or another load in time. Each picture is a Figure, or None without data."""

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
    """Acceleration [m/s2] at every gauge against time, one above the other in the order of the case."""
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
    """Fourier amplitude spectra [m/s] of the acceleration at the first and last gauge, and their ratio [-]."""
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
    right.set_ylabel(f"spectral ratio {names[-1]} / {names[0]} [-]")
    right.set_ylim(bottom=0)
    for axes in (left, right):
        axes.set_xlabel("frequency [Hz]")
    return figure
