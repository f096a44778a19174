"""Damage of an armour layer as engineers count it, and as tables."""

import json
import tomllib
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sazare.armour.layer import Layer, plane_of
from sazare.armour.profile import Profile
from sazare.armour.units import groups_of, others_in, snapshot_at, units_of
from sazare.folders import own
from sazare.tables import NotARun, finite, write_table

DISPLACED = 1.0  # nominal diameters, from which on a unit counts as displaced
SHIFTED = 0.5  # nominal diameters, from which on it counts as shifted
ROCKING = np.radians(5.0)  # of a unit that has not been shifted


@dataclass(frozen=True)
class Options:
    """What the damage is of. groups: names, or None for all groups of a shape; start: time from which movement counts [s]; width: of the slope along the shore
    [m], or None for the length of a periodic axis; along: that axis, "x" or "y"; slope: name of the wall that is the plane of the slope, or None for "slope"."""

    groups: tuple | None = None
    start: float | None = None
    width: float | None = None
    along: str | None = None
    slope: str | None = None


class Damage:
    """The damage of the armour of a run (sazare.Results) since a time. Raises NotARun where the run has no units, no snapshots or no width."""

    def __init__(self, results, options=Options()):  # noqa: B008
        self.results, self.options = results, options
        self.units, self.before, self.after, self.began = units_of(results, options.groups, options.start)
        self.case = tomllib.loads(results.case_text)

    @cached_property
    def up(self):
        """Against gravity (3,)."""
        gravity = np.array(self.case.get("gravity", {}).get("acceleration", [0.0, 0.0, 0.0]), dtype=float)
        return -gravity / np.linalg.norm(gravity) if np.any(gravity) else np.array([0.0, 0.0, 1.0])

    @cached_property
    def along(self):
        """The axis along the shore: its number, and the width of the slope along it [m] or None."""
        domain = self.case.get("domain", {})
        periodic = ["xyz".index(axis) for axis in domain.get("periodic", [])]
        level = [axis for axis in periodic if abs(self.up[axis]) < 1e-6]
        if self.options.along is not None:
            axis = "xyz".index(self.options.along)
        elif len(level) == 1:
            axis = level[0]
        else:
            return None, self.options.width
        length = domain["upper"][axis] - domain["lower"][axis] if axis in periodic else None
        return axis, self.options.width or length

    @property
    def ratio(self):
        """Displacements over nominal diameters (n,)."""
        return self.units.moved / self.units.size

    @property
    def displaced(self):
        """Units moved by a nominal diameter or more."""
        return int(np.sum(self.ratio >= DISPLACED))

    @property
    def shifted(self):
        """Units moved by half a nominal diameter to a whole one."""
        return int(np.sum((self.ratio >= SHIFTED) & (self.ratio < DISPLACED)))

    @property
    def rocked(self):
        """Units not even shifted, that turned by 5 degrees or more at some time."""
        return int(np.sum((self.ratio < SHIFTED) & (self.units.largest_turn >= ROCKING)))

    @property
    def broken(self):
        """Bonded units with broken bonds."""
        return int(np.sum(self.units.broken > 0))

    @property
    def size(self):
        """Mean nominal diameter D_n [m]."""
        return float(self.units.size.mean())

    @property
    def per_width(self):
        """N_od, the number of displaced units over the width of the slope in nominal diameters (Van der Meer 1988); None without a width."""
        width = self.along[1]
        return None if width is None else self.displaced * self.size / width

    @property
    def settlement(self):
        """Mean lowering of the units [m]."""
        return float(np.mean((self.units.start - self.units.end) @ self.up))

    @cached_property
    def profile(self):
        """The Profile of the layer before and after; None where the axis along the shore is not known."""
        axis = self.along[0]
        return None if axis is None else Profile(self.before, self.after, self.up, np.eye(3)[axis], self.size)

    @property
    def erosion(self):
        """S, the eroded area of the cross-section over the squared nominal diameter (Van der Meer 1988); None without a profile."""
        return None if self.profile is None else self.profile.eroded / self.size**2

    @cached_property
    def layers(self):
        """The Layer before and after, within one window; None where the plane of the slope or the width is not known, or the layer is too short. Raises NotARun
        where a slope that is asked for has none."""
        plane, width = plane_of(self.case, self.up, self.options.slope), self.along[1]
        if plane is None or width is None:
            if self.options.slope:
                raise NotARun(f"{self.results.path}: the layer needs a width: give --width")
            return None
        snapshots, volumes = self.results.particle_snapshots, self.units.size**3
        try:
            before = Layer(self.before, volumes, others_in(snapshots[snapshot_at(self.results, self.options.start)].mesh), plane, width, self.size)
            return before, Layer(self.after, volumes, others_in(snapshots[-1].mesh), plane, width, self.size, before.window)
        except NotARun:
            if self.options.slope:
                raise
            return None


def write_damage(damage, folder):
    """Writes units.csv, profile.csv where there is one, and damage.json into a folder. Raises NotARun where one of them is a link."""
    folder = own(folder)
    folder.mkdir(exist_ok=True)
    units = damage.units
    way = units.end - units.start
    names = [group["name"] for group in groups_of(damage.case)]
    columns = {"unit [-]": [str(number) for number in units.number], "group [-]": [names[number] for number in units.group]}
    columns |= {f"displacement_{axis} [m]": way[:, n] for n, axis in enumerate("xyz")}
    columns |= {"displacement/D_n [-]": damage.ratio, "rotation [deg]": np.degrees(units.turn), "largest_rotation [deg]": np.degrees(units.largest_turn), "broken_fraction [-]": units.broken}
    write_table(own(folder / "units.csv"), columns)
    if damage.profile is not None:
        write_table(own(folder / "profile.csv"), damage.profile.columns())
    figures = {
        "units": len(units), "nominal_diameter": damage.size, "displaced": damage.displaced, "shifted": damage.shifted, "rocked": damage.rocked, "broken": damage.broken,
        "N_od": damage.per_width, "S": damage.erosion, "settlement": damage.settlement,
    }
    if damage.layers is not None:
        for when, layer in zip(("before", "after"), damage.layers):
            figures |= {f"{name}_{when}": getattr(layer, name) for name in ("packing", "thickness", "porosity")}
    own(folder / "damage.json").write_text(json.dumps(finite(figures), indent=2) + "\n")


def check_along(results, options):
    """Raises NotARun where the axis along the shore is given and is that of gravity."""
    damage = Damage(results, options)
    axis = damage.along[0]
    if axis is not None and abs(damage.up[axis]) > 1e-6:
        raise NotARun(f"{results.path}: gravity acts along {'xyz'[axis]}; the axis along the shore is level")
    return damage
