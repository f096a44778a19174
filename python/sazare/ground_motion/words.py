"""Figures of a record in words."""

from sazare.ground_motion.intensity import FIGURES
from sazare.ground_motion.record import GAL

NAMES = {
    "peak_acceleration": "peak acceleration",
    "peak_velocity": "peak velocity",
    "peak_displacement": "peak displacement",
    "arias_intensity": "Arias intensity",
    "significant_duration_5_75": "significant duration, 5 to 75 %",
    "significant_duration_5_95": "significant duration, 5 to 95 %",
    "cumulative_absolute_velocity": "cumulative absolute velocity",
    "spectrum_intensity": "spectrum intensity, 5 % damping",
    "si_value": "SI value, 20 % damping",
    "mean_period": "mean period",
    "predominant_period": "predominant period",
}
IN_CENTIMETRES = ("peak_velocity", "peak_displacement", "spectrum_intensity", "si_value")


def acceleration(value):
    """An acceleration [m/s2] in both units."""
    return f"{value:.4g} m/s2 ({value / GAL:.4g} gal)"


def _value(name, value):
    unit = FIGURES[name][0]
    if unit == "m/s2":
        return acceleration(value)
    beside = f" ({100.0 * value:.4g} c{unit})" if name in IN_CENTIMETRES else ""
    return f"{value:.4g} {unit}{beside}"


def lines(record, figures):
    """Lines about a record and its figures (dict)."""
    count = len(record.acceleration)
    yield f"{record.name}: {count} samples every {record.step:g} s, {record.duration:.4g} s"
    for name, value in figures.items():
        yield f"  {NAMES[name]:<34}{_value(name, value)}"
    yield f"  {'at the end':<34}{record.velocity[-1]:.3g} m/s, {record.displacement[-1]:.3g} m"
