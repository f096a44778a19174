"""Pictures of a record: its motion with the Husid curve, and its response spectra."""

import numpy as np

from sazare import curve_styles, style
from sazare.ground_motion.intensity import arias_intensity, husid, peak_acceleration, peak_displacement, peak_velocity
from sazare.ground_motion.record import GAL


def add_gal(axes, label="gal"):
    """A second scale in gal beside one in m/s2."""
    beside = axes.secondary_yaxis("right", functions=(lambda value: value / GAL, lambda value: GAL * value))
    beside.set_ylabel(f"[{label}]")
    beside.spines["right"].set_visible(True)
    return beside


def _history(axes, record, values, largest, label, unit):
    """One quantity over time, with its largest magnitude."""
    peak = int(np.argmax(np.abs(values)))
    axes.plot(record.time, values, color=style.SECOND, linewidth=0.9)
    axes.plot(record.time[peak], values[peak], "o", color=style.ACCENT, markersize=4)
    axes.set_title(f"{label}: up to {largest:.4g} {unit}, at {record.time[peak]:.4g} s")
    axes.set_ylabel(f"[{unit}]")
    axes.margins(x=0)


def _husid(axes, record):
    share = 100.0 * husid(record)
    axes.plot(record.time, share, color=style.INK, linewidth=1.2)
    for level in (5.0, 75.0, 95.0):
        axes.axhline(level, color=style.STONE_EDGE, linewidth=0.8, linestyle="--")
    axes.set_yticks([5, 50, 75, 95])
    axes.set_title(f"Husid curve; Arias intensity {arias_intensity(record):.4g} m/s")
    axes.set_ylabel("[%]")
    axes.set_xlabel("time [s]")
    axes.margins(x=0)


@style.styled
def motion(record, spectra, target=None):
    """A record over time beside its response spectra. spectra: list of ResponseSpectrum; target: periods [s] and accelerations [m/s2] or None."""
    figure = style.figure(11.5, 7.2)
    left, right = figure.subfigures(1, 2, width_ratios=(1.15, 1.0))
    rows = left.subplots(4, 1, sharex=True)
    _history(rows[0], record, record.acceleration, peak_acceleration(record), "acceleration", "m/s²")
    add_gal(rows[0])
    _history(rows[1], record, record.velocity, peak_velocity(record), "velocity", "m/s")
    _history(rows[2], record, record.displacement, peak_displacement(record), "displacement", "m")
    _husid(rows[3], record)
    upper, lower = right.subplots(2, 1, sharex=True)
    for number, spectrum in enumerate(spectra):
        look = {**curve_styles.look(number), "linewidth": 1.2, "label": f"damping {100.0 * spectrum.damping:g} %"}
        upper.semilogx(spectrum.period, spectrum.pseudo_acceleration, **look)
        lower.loglog(spectrum.period, spectrum.pseudo_velocity, **look)
    if target is not None:
        upper.semilogx(*target, color=style.INK, linewidth=1.2, linestyle="--", label="target")
    upper.set_ylabel("pseudo acceleration [m/s²]")
    upper.set_ylim(bottom=0.0)
    add_gal(upper)
    upper.legend()
    lower.set_ylabel("pseudo velocity [m/s]")
    lower.set_xlabel("period [s]")
    lower.margins(x=0)
    return figure
