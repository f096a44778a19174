"""The command `sazare motion`: its arguments, and what it writes and prints."""

import json
import math
import warnings
from pathlib import Path

from sazare.arguments import not_negative, positive, whole
from sazare.folders import require_room
from sazare.ground_motion import words
from sazare.ground_motion.column import BASE_OUTCROP, BASE_WITHIN, SURFACE
from sazare.ground_motion.correction import (
    MOST_DEGREE, butterworth, end_at_rest, factor_for_spectrum, resample, scale_to_peak, take_off_baseline,
)
from sazare.ground_motion.files import read_column, read_target_spectrum, write_spectra
from sazare.ground_motion.intensity import figures
from sazare.ground_motion.record import read_record, write_record
from sazare.ground_motion.spectra import response_spectrum, usual_periods

WRITTEN = ("record.csv", "spectra.csv", "figures.json", "motion.png")
PLACES = {"surface": SURFACE, "base-outcrop": BASE_OUTCROP, "base-within": BASE_WITHIN}


def add_to(commands):
    """Adds the command to the commands of a parser."""
    text = "read, correct and scale a record of ground motion; figures, response spectra, deconvolution"
    motion = commands.add_parser(
        "motion", help=text, description=text + ". What is asked for is done in the order of the options below.",
    )
    motion.add_argument("file", metavar="FILE", help="the record: PEER (.AT2), K-NET (.EW, .NS, .UD) or CSV")
    motion.add_argument("--baseline", metavar="N", type=whole(0, MOST_DEGREE), help="take a polynomial of this degree off the acceleration (0 constant, 1 linear)")
    motion.add_argument("--high-pass", metavar="HZ", type=positive, help="filter out what is slower")
    motion.add_argument("--low-pass", metavar="HZ", type=positive, help="filter out what is faster")
    motion.add_argument("--order", metavar="N", type=whole(1, 10), default=4, help="order of the Butterworth filters (default %(default)d)")
    motion.add_argument("--causal", action="store_true", help="filter forwards alone; otherwise also backwards, which moves no phase")
    motion.add_argument("--step", metavar="S", type=positive, help="resample to this step [s]")
    _add_column(motion)
    motion.add_argument("--at-rest", action="store_true", help="let velocity and displacement end at 0, by a straight line in the acceleration")
    _add_scaling(motion)
    motion.add_argument("--damping", metavar="H", type=not_negative, nargs="+", default=[0.05], help="damping ratios of the spectra (default 0.05)")
    motion.add_argument("--shortest-period", metavar="S", type=positive, default=0.02, help="of the spectra [s] (default %(default)g)")
    motion.add_argument("--longest-period", metavar="S", type=positive, default=10.0, help="of the spectra [s] (default %(default)g)")
    motion.add_argument("--out", metavar="DIR", help="folder for " + ", ".join(WRITTEN) + " (default: runs/motion-NAME)")
    motion.add_argument("--overwrite", action="store_true", help="replace those files where they are there")
    motion.set_defaults(function=motion_command, blame="{file}: this record cannot be worked on", advice="Please report it")


def _add_column(motion):
    motion.add_argument("--column", metavar="FILE", help="carry the record through layers: thickness, density, s_wave_velocity, damping_ratio (CSV)")
    motion.add_argument("--recorded-at", choices=PLACES, default="surface", help="where the record is from (default: %(default)s)")
    motion.add_argument("--wanted-at", choices=PLACES, default="base-outcrop", help="where it is wanted (default: %(default)s)")
    motion.add_argument("--highest-frequency", metavar="HZ", type=positive, default=20.0, help="that is carried through the layers (default %(default)g)")


def _add_scaling(motion):
    scaling = motion.add_mutually_exclusive_group()
    scaling.add_argument("--peak-acceleration", metavar="M/S2", type=positive, help="scale to this peak acceleration [m/s2]")
    scaling.add_argument("--peak-velocity", metavar="M/S", type=positive, help="scale to this peak velocity [m/s]")
    scaling.add_argument("--target", metavar="FILE", help="scale by one factor to a target spectrum: period, acceleration (CSV), for the first damping ratio")
    motion.add_argument("--from-period", metavar="S", type=positive, help="with --target: the shortest period that counts [s]")
    motion.add_argument("--to-period", metavar="S", type=positive, help="with --target: the longest period that counts [s]")


def _prepared(record, chosen):
    """The record as it was asked for, but for its scale."""
    if chosen.baseline is not None:
        record = take_off_baseline(record, chosen.baseline)
    if chosen.high_pass or chosen.low_pass:
        record = butterworth(record, chosen.high_pass, chosen.low_pass, chosen.order, chosen.causal)
    if chosen.step is not None:
        record = resample(record, chosen.step)
    if chosen.column is not None:
        column = read_column(chosen.column)
        record = column.carry(record, PLACES[chosen.recorded_at], PLACES[chosen.wanted_at], _carried(record, chosen))
        print(f"{chosen.column}: {len(column.layers) - 1} layers, {column.height:g} m, {chosen.recorded_at} to {chosen.wanted_at}; the record begins {column.lead(record):.4g} s earlier")
    return end_at_rest(record) if chosen.at_rest else record


def _carried(record, chosen):
    """The highest frequency [Hz] that goes through a column; None where the record has no higher ones."""
    return chosen.highest_frequency if chosen.highest_frequency < 0.5 / record.step else None


def _scaled(record, chosen, target):
    """The record at its scale, which is told."""
    if target is not None:
        factor, off = factor_for_spectrum(record, *target, chosen.damping[0], chosen.from_period, chosen.to_period)
        print(f"scaled by {factor:.4g}; the spectrum is off the target by a factor of {math.exp(off):.3g} (root mean square)")
        return record.scaled(factor)
    if chosen.peak_acceleration or chosen.peak_velocity:
        scaled = scale_to_peak(record, chosen.peak_acceleration, chosen.peak_velocity)
        print(f"scaled by {abs(scaled.acceleration).max() / abs(record.acceleration).max():.4g}")
        return scaled
    return record


def motion_command(chosen):
    """Carries out the command."""
    from sazare import style
    from sazare.ground_motion import pictures

    if (chosen.from_period or chosen.to_period) and chosen.target is None:
        raise ValueError("--from-period and --to-period go with --target, whose range they choose")
    folder = require_room(chosen.out or Path("runs") / f"motion-{Path(chosen.file).stem}", WRITTEN, chosen.overwrite)
    periods = usual_periods(chosen.shortest_period, chosen.longest_period)
    target = None if chosen.target is None else read_target_spectrum(chosen.target)
    with warnings.catch_warnings(record=True) as doubts:
        warnings.simplefilter("always", UserWarning)
        record = _scaled(_prepared(read_record(chosen.file), chosen), chosen, target)
        found = figures(record)
        if not all(math.isfinite(value) for value in found.values()):
            raise ValueError(f"{chosen.file}: there is no motion in this record\nhelp: are its values in the unit of its header?")
        spectra = [response_spectrum(record, periods, damping) for damping in dict.fromkeys(chosen.damping)]
    print(*words.lines(record, found), sep="\n")
    for doubt in dict.fromkeys(str(warning.message) for warning in doubts):
        print(f"  warning: {doubt}")
    folder.mkdir(parents=True, exist_ok=True)
    write_record(folder / "record.csv", record)
    write_spectra(folder / "spectra.csv", spectra)
    (folder / "figures.json").write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")
    style.save(pictures.motion(record, spectra, target), folder / "motion.png")
    print(f"{folder}: {', '.join(WRITTEN)}")
