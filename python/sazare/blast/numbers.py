"""All numbers of a blast in one place, and as tables."""

import csv
import io
import json
from dataclasses import dataclass
from functools import cached_property
from math import degrees

from sazare.blast.damage import LEVELS, damage_of
from sazare.blast.energies import absorbed_by_boundary, parts_of
from sazare.blast.fits import size_fits
from sazare.blast.half_casts import contour, factor, half_casts_of
from sazare.blast.holes import holes_of
from sazare.blast.settings import Settings, folder_of, write_settings
from sazare.blast.sizes import SHARES, by_sieve, by_sphere
from sazare.blast.vibration import attenuation, shaking_of
from sazare.folders import own
from sazare.tables import finite


class BlastNumbers:
    """The numbers of a run of blasting. settings: what the user said beside the case. Each is found when it is asked for, but holes and half_casts, the HalfCast of
    every contour hole. Raises ValueError where settings do not fit the holes of the run."""

    def __init__(self, results, settings=None):
        self.results = results
        self.settings = settings or Settings()
        self.holes = holes_of(results, self.settings.charges)
        self.half_casts = contour(half_casts_of(results), self.settings.contour)

    @cached_property
    def sphere(self):
        """Distribution of the detached fragments by equivalent sphere."""
        return by_sphere(self.results)

    @cached_property
    def sieve(self):
        """Distribution of the detached fragments by sieve size; None where no snapshot shows them."""
        return by_sieve(self.results)

    @cached_property
    def sizes(self):
        """The one of both by which fits and oversize are told: that by sieve size where there is one."""
        return self.sphere if self.sieve is None else self.sieve

    @cached_property
    def fits(self):
        """The SizeFits of `sizes`."""
        return size_fits(self.sizes)

    @cached_property
    def shaken(self):
        """The Shaking of every gauge."""
        return shaking_of(self.results, self.holes)

    @cached_property
    def damages(self):
        """The Damage around every hole."""
        return damage_of(self.results, self.holes)

    @cached_property
    def laws(self):
        """Power laws of the peak particle velocity by what they are over: distance, and where charges are known, scaled distances. Some may be None."""
        laws = {"R": attenuation(self.shaken, [one.distance for one in self.shaken])}
        if self.shaken and self.shaken[0].charge is not None:
            for name, power in (("R/W^(1/2)", 0.5), ("R/W^(1/3)", 1.0 / 3.0)):
                laws[name] = attenuation(self.shaken, [one.scaled_distance(power) for one in self.shaken])
        return laws


@dataclass(frozen=True)
class NumberTable:
    """A table of numbers: its file's name, its columns with their units, its rows."""

    name: str
    columns: tuple[str, ...]
    rows: list


def tables_of(numbers):
    """The tables (list of NumberTable) of BlastNumbers; those without rows are left out."""
    sphere, sieve, sizes = numbers.sphere, numbers.sieve, numbers.sizes
    curve = sizes.sizes
    tables = [
        NumberTable(
            "sizes.csv", ("share passing [%]", "size of the equivalent sphere [m]", "sieve size [m]"),
            [(100 * share, sphere.size_at(share), sieve.size_at(share) if sieve else None) for share in SHARES] if len(sphere.sizes) else [],
        ),
        NumberTable(
            "size_curve.csv", ("size [m]", "mass passing [%]", *(f"{fit.name} [%]" for fit in numbers.fits)),
            [(size, 100 * sizes.passing(size), *(_in_range(fit, size) for fit in numbers.fits)) for size in curve],
        ),
        NumberTable(
            "vibration.csv",
            ("gauge", "ppv [m/s]", "time [s]", "peak_x [m/s]", "peak_y [m/s]", "peak_z [m/s]", "frequency [Hz]", "rises at the end [-]", "distance [m]",
             "charge [kg]", "R/W^(1/2) [m/kg^(1/2)]", "R/W^(1/3) [m/kg^(1/3)]"),
            [(one.name, one.ppv, one.time, *one.peaks, one.frequency, int(one.rises), one.distance, one.charge, one.scaled_distance(0.5),
              one.scaled_distance(1.0 / 3.0)) for one in numbers.shaken],
        ),
        NumberTable(
            "damage.csv", ("hole", *(f"radius with {100 * level:.0f} % broken [m]" for level in LEVELS), "broken area [m2]"),
            [(one.name, *(one.radius(level) for level in LEVELS), float(one.areas[one.broken].sum())) for one in numbers.damages],
        ),
        NumberTable(
            "half_casts.csv", ("hole", "length [m]", "half barrel left [m]", "not broken out [m]", "wall left [%]"),
            [(one.name, one.length, one.half, one.whole, 100.0 * one.standing) for one in numbers.half_casts],
        ),
        NumberTable("damage_rings.csv", ("hole", "from [m]", "to [m]", "broken share of the joint area [%]"), list(_ring_rows(numbers.damages))),
        NumberTable("damage_directions.csv", ("hole", "from [deg]", "to [deg]", "broken area [m2]"), list(_sector_rows(numbers.damages))),
        NumberTable(
            "energy.csv", ("part", "energy [J]", "share of the work [%]"),
            [(part.name, part.value, None if part.share is None else 100 * part.share) for part in parts_of(numbers.results.figures)],
        ),
        NumberTable("radiated.csv", ("boundary", "energy [J]"), list(absorbed_by_boundary(numbers.results).items())),
    ]
    return [table for table in tables if table.rows]


def _in_range(fit, size):
    return 100.0 * float(fit.passing(size)) if fit.lower <= size <= fit.upper else None


def _ring_rows(damages):
    for one in damages:
        rings = one.rings()
        for low, high, share in zip(rings[0][:-1], rings[0][1:], rings[1]) if rings else ():
            yield one.name, low, high, 100.0 * share


def _sector_rows(damages):
    for one in damages:
        edges, area = one.by_direction()
        for low, high, broken in zip(edges[:-1], edges[1:], area):
            yield one.name, degrees(low), degrees(high), broken


def summary_of(numbers):
    """The numbers of a blast as a dict for JSON: sizes [m], shares (0 to 1), fits, laws of vibration, radii of damage [m]."""
    oversize = numbers.settings.oversize
    sizes = {"measured_by": "equivalent sphere" if numbers.sieve is None else "sieve size", "mesh_limit": numbers.sizes.mesh_limit}
    sizes |= {f"p{100 * share:.0f}": numbers.sizes.size_at(share) for share in SHARES}
    if oversize is not None:
        sizes |= {"oversize": oversize, "oversize_share": numbers.sizes.oversize(oversize)}
    return {
        "sizes": sizes,
        "fits": [{"name": fit.name, **fit.parameters, "from": fit.lower, "to": fit.upper, "r2": fit.r2, "largest_difference": fit.worst} for fit in numbers.fits],
        "vibration": {
            over: {"factor": law.factor, "exponent": law.exponent, "r2": law.r2, "gauges": law.points} for over, law in numbers.laws.items() if law is not None
        },
        "damage": {one.name: {f"radius_{100 * level:.0f}": one.radius(level) for level in LEVELS} for one in numbers.damages},
        "half_cast_factor": factor(numbers.half_casts),
    }


def write_numbers(numbers):
    """Writes the tables, summary.json and the settings of BlastNumbers into the folder `blast` of the run; returns the folder. Raises NotARun where a link
    stands in a file's place or in that of the folder."""
    folder = folder_of(numbers.results)
    folder.mkdir(exist_ok=True)
    texts = {table.name: _csv_text(table) for table in tables_of(numbers)}
    texts["summary.json"] = json.dumps(finite(summary_of(numbers)), indent=2) + "\n"
    for name, text in texts.items():
        own(folder / name).write_text(text, encoding="utf-8")
    write_settings(numbers.results, numbers.settings)
    return folder


def _csv_text(table):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(table.columns)
    writer.writerows([["" if value is None else value if isinstance(value, str) else repr(float(value)) for value in row] for row in table.rows])
    return text.getvalue()
