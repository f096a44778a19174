"""The numbers of a muck pile in one place, and as tables."""

import json
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sazare.blast.sizes import Distribution
from sazare.folders import own
from sazare.muck_pile.back_break import at_edge_of, back_breaks
from sazare.muck_pile.balls import union_volumes
from sazare.muck_pile.breaking import breaking_of
from sazare.muck_pile.flight import flight_times, ranges
from sazare.muck_pile.landed import RESTING, ends_of, landed_of
from sazare.muck_pile.pile import Pile
from sazare.muck_pile.support import in_the_air
from sazare.tables import finite, write_table


@dataclass(frozen=True)
class Farthest:
    """The fragment that was thrown farthest: its number, mass [kg], size [m], start speed [m/s], throw [m]; and the range of a flight without drag to the
    ground [m], in closed form."""

    number: int
    mass: float
    size: float
    speed: float
    throw: float
    range: float


class PileNumbers:
    """The numbers of a muck pile. results: the run of blasting; model: its Model; flown: the run in which its fragments have flown and landed."""

    def __init__(self, results, model, flown):
        self.results, self.model, self.flown = results, model, flown
        snapshots = flown.particle_snapshots
        before, self.landed = (landed_of(model, snapshots[place]) for place in (max(len(snapshots) - 2, 0), -1))
        self.flying = in_the_air(model, before, self.landed)
        self.ends = ends_of(model, self.landed, self.flying)

    @cached_property
    def starts(self):
        """Centres of mass of the fragments before the blast (m, 3) [m]."""
        model = self.model
        masses = model.elements.masses[model.loose]
        total = np.zeros((len(model.bodies), 3))
        np.add.at(total, model.owner, masses[:, None] * model.elements.start[model.loose].mean(axis=1))
        return total / model.bodies.mass[:, None]

    @cached_property
    def throws(self):
        """Horizontal distances (m,) [m] from where the fragments were before the blast."""
        return np.linalg.norm((self.ends - self.starts)[:, :2], axis=1)

    @cached_property
    def distribution(self):
        """The throws as a Distribution: throws in the place of sizes."""
        return Distribution.of(self.throws, self.model.bodies.mass, np.bincount(self.model.owner))

    @cached_property
    def beyond_toe(self):
        """Mass [kg] of the fragments that lie beyond the toe along the throw."""
        return float(self.model.bodies.mass[self.ends @ self.model.direction > self.model.toe].sum())

    @cached_property
    def cast(self):
        """Share of the mass that lies beyond the toe."""
        return self.beyond_toe / float(self.model.bodies.mass.sum())

    @cached_property
    def farthest(self):
        """The Farthest fragment that is not among the fines."""
        bodies, model = self.model.bodies, self.model
        one = int(np.argmax(np.where(model.fines, -1.0, self.throws)))
        reach = ranges(model.heights[one : one + 1], bodies.velocity[one : one + 1], model.gravity)[0]
        return Farthest(
            int(bodies.numbers[one]), float(bodies.mass[one]), float(bodies.sizes[one]), float(np.linalg.norm(bodies.velocity[one])), float(self.throws[one]),
            float(reach),
        )

    @cached_property
    def pile(self):
        """The Pile."""
        bodies = self.model.bodies
        size = Distribution.of(bodies.sizes, bodies.mass, np.ones(len(bodies))).size_at(0.5)
        return Pile(self.model, self.landed, self.flying, size)

    @cached_property
    def solid(self):
        """Volume of the fragments without fines [m3]."""
        return float(self.model.bodies.volume[~self.model.fines].sum())

    @cached_property
    def sphere_share(self):
        """Volume of the spheres, each place once, over that of the fragments without fines."""
        return float(self._unions.sum()) / self.solid

    @cached_property
    def _unions(self):
        return union_volumes(self.model.balls, len(self.model.bodies))

    @cached_property
    def swell_of_spheres(self):
        """Bulk volume of the pile over the volume of its spheres."""
        spheres = float(self._unions[self.pile.seen].sum())
        return self.pile.bulk / spheres if spheres > 0.0 else float("nan")

    @cached_property
    def rms_speed(self):
        """Root of the mean square of the speed at the end by mass [m/s], without fines and what still flies."""
        masses = np.where(self.flying | self.model.fines, 0.0, self.model.bodies.mass)
        return self.landed.rms_speed(masses) if masses.sum() > 0.0 else float("inf")

    @property
    def rests(self):
        """Whether the pile rests at the end."""
        return self.rms_speed < RESTING

    @cached_property
    def breaking(self):
        """The Breaking at the end of the run of blasting."""
        return breaking_of(self.results)

    @cached_property
    def back_breaks(self):
        """The BackBreaks by depth."""
        return back_breaks(self.results, self.model)

    @cached_property
    def at_edge(self):
        """Whether rock came loose up to the sides of the model (AtEdge); None without holes."""
        return at_edge_of(self.results, self.model)


def tables_of(numbers):
    """The tables of PileNumbers: columns by the name of their file."""
    model, bodies = numbers.model, numbers.model.bodies
    throw = {"fragment [-]": bodies.numbers, "mass [kg]": bodies.mass, "size [m]": bodies.sizes}
    throw |= {f"start_{axis} [m]": numbers.starts[:, i] for i, axis in enumerate("xyz")}
    throw |= {f"end_{axis} [m]": numbers.ends[:, i] for i, axis in enumerate("xyz")}
    throw |= {
        "throw [m]": numbers.throws, "start_speed [m/s]": np.linalg.norm(bodies.velocity, axis=1),
        "range_without_drag [m]": ranges(model.heights, bodies.velocity, model.gravity),
        "flight_without_drag [s]": flight_times(model.heights, bodies.velocity, model.gravity), "in_the_air [-]": numbers.flying, "fines [-]": model.fines,
    }
    slices = numbers.pile.slices
    profile = {
        "along [m]": [one.along for one in slices], "highest [m]": [one.highest for one in slices], "mean [m]": [one.mean for one in slices],
        "top [m]": [one.top for one in slices], "volume [m3]": [one.volume for one in slices],
    }
    tables = {"throw.csv": throw, "pile.csv": profile}
    if numbers.back_breaks:
        broken = numbers.back_breaks
        tables["back_break.csv"] = {
            "lower [m]": [one.lower for one in broken], "upper [m]": [one.upper for one in broken], "behind [m]": [one.behind for one in broken],
            "left [m]": [one.left for one in broken], "right [m]": [one.right for one in broken], "volume_behind [m3]": [one.volume for one in broken],
        }
    return tables


def summary_of(numbers):
    """The numbers of a pile as a dict for JSON, SI units; shares are 0 to 1."""
    model, bodies, farthest, breaking = numbers.model, numbers.model.bodies, numbers.farthest, numbers.breaking
    total = float(bodies.mass.sum())
    return {
        "fragments": len(bodies), "mass": total, "solid_volume": float(bodies.volume.sum()), "sphere_count": len(model.balls), "sphere_share": numbers.sphere_share,
        "buried_mass": model.buried, "ground": model.ground, "direction": model.direction[:2].tolist(), "toe": model.toe, "gravity": model.gravity,
        "energy_kept": float(bodies.kinetic_energy.sum() / bodies.energy.sum()) if bodies.energy.sum() > 0.0 else None,
        "stiffness": model.stiffnesses.tolist(), "fines": int(model.fines.sum()), "mass_of_fines": float(bodies.mass[model.fines].sum()),
        "end": numbers.landed.time, "rms_speed": numbers.rms_speed, "rests": numbers.rests,
        "in_the_air": int(np.sum(numbers.flying & ~model.fines)), "mass_in_the_air": float(bodies.mass[numbers.flying & ~model.fines].sum()),
        "throw": {f"p{100 * share:.0f}": numbers.distribution.size_at(share) for share in (0.5, 0.9, 0.99)},
        "beyond_toe": numbers.beyond_toe, "cast": numbers.cast,
        "farthest": {
            "fragment": farthest.number, "mass": farthest.mass, "size": farthest.size, "start_speed": farthest.speed, "throw": farthest.throw,
            "range_without_drag": farthest.range,
        },
        "pile": {
            "bulk_volume": numbers.pile.bulk, "swell": numbers.pile.swell, "swell_of_spheres": numbers.swell_of_spheres, "height": numbers.pile.height,
            "repose": numbers.pile.repose,
            "covered_mass": float(bodies.mass[numbers.pile.covered].sum()),
        },
        "back_break": max((one.behind for one in numbers.back_breaks), default=None),
        "over_break": {side: max((getattr(one, side) for one in numbers.back_breaks), default=None) for side in ("left", "right")},
        "at_edge_of_model": None if numbers.at_edge is None else {side: getattr(numbers.at_edge, side) for side in ("behind", "left", "right")},
        "breaking": {"last_tenth": breaking.broken, "rate": breaking.rate, "work_of_gas_last_tenth": breaking.worked, "gas_pressure": breaking.pressure},
    }


def write_numbers(numbers, folder):
    """Writes the tables and numbers.json into a folder. Raises NotARun where a link stands in a file's place."""
    for name, columns in tables_of(numbers).items():
        write_table(own(folder / name), columns)
    own(folder / "numbers.json").write_text(json.dumps(finite(summary_of(numbers)), indent=2) + "\n", encoding="utf-8")
