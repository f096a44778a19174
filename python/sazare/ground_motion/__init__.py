"""Records of ground motion: figures, response spectra, correction, scaling, and the way through horizontal layers.

    import sazare.ground_motion as ground_motion
    record = ground_motion.read_record("cases/soil-column-el-centro/el-centro-1940-ns.AT2")
    ground_motion.figures(record)["arias_intensity"]
    spectrum = ground_motion.response_spectrum(record, damping=0.05)
    spectrum.period, spectrum.pseudo_acceleration

    rock = ground_motion.take_off_baseline(ground_motion.read_column("layers.csv").carry(record))
    ground_motion.write_record("rock.csv", rock)

All numbers are in SI units. A record is linear between its samples, as the engine takes it, and integrals and responses are exact for that.
"""

from sazare.ground_motion.column import BASE_OUTCROP, BASE_WITHIN, SURFACE, Column, Layer, Place
from sazare.ground_motion.correction import (
    butterworth, end_at_rest, factor_for_spectrum, resample, scale_to_peak, take_off_baseline,
)
from sazare.ground_motion.files import read_column, read_target_spectrum, write_spectra
from sazare.ground_motion.intensity import (
    arias_intensity, cumulative_absolute_velocity, figures, husid, mean_period, peak_acceleration, peak_displacement, peak_velocity,
    predominant_period, si_value, significant_duration, spectrum_intensity,
)
from sazare.ground_motion.profiles import ShearHistory, profile_table, shear_history, shear_history_of
from sazare.ground_motion.record import GRAVITY, Record, from_samples, read_record, write_record
from sazare.ground_motion.spectra import ResponseSpectrum, fourier_amplitude, response_spectrum, usual_periods

__all__ = [
    "BASE_OUTCROP", "BASE_WITHIN", "GRAVITY", "SURFACE", "Column", "Layer", "Place", "Record", "ResponseSpectrum", "ShearHistory", "arias_intensity", "butterworth",
    "cumulative_absolute_velocity", "end_at_rest", "factor_for_spectrum", "figures", "fourier_amplitude", "from_samples", "husid", "mean_period",
    "peak_acceleration", "peak_displacement", "peak_velocity", "predominant_period", "profile_table", "read_column", "read_record", "read_target_spectrum", "resample",
    "response_spectrum", "scale_to_peak", "shear_history",
    "shear_history_of", "si_value", "significant_duration", "spectrum_intensity", "take_off_baseline", "usual_periods",
    "write_record", "write_spectra",
]
