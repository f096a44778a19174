"""The case of an armour layer, and the folder in which it is written with its units and their places."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sazare.armour_model import words
from sazare.armour_model.layout import Layout
from sazare.armour_model.solids import write_stl
from sazare.cases import spheres
from sazare.folders import require_room
from sazare.intervals import round_end, round_interval

GRAVITY = 9.81  # m/s2
SOFT = 2.0e4  # Young's modulus over density, gravity and D_n where none is given, so that a step is a fixed share of the time in which a unit falls by D_n
CONCRETE = 3.0e10  # Pa, of units that break
REST = 5.0  # length of the run in times of sqrt(D_n/g)
FILES = ("case.toml", "model.md", "unit.stl", "places.csv", "underlayer.csv", "toe.csv")


@dataclass(frozen=True)
class Material:
    """Of units and stones. density [kg/m3]; youngs_modulus [Pa], None for a soft one, or that of concrete where units break; friction: coefficient; tensile_strength
    [Pa] of units that break, None where they are rigid; count: of spheres in a unit, at most."""

    density: float = 2400.0
    youngs_modulus: float | None = None
    friction: float = 0.6
    tensile_strength: float | None = None
    count: int = 40


@dataclass(frozen=True)
class ArmourModel:
    """An armour layer that can be written as a case. file: that of the solid of a rock, for model.md."""

    layout: Layout
    material: Material = Material()
    file: Path | None = None

    @property
    def mass(self):
        """Of a unit [kg]."""
        return self.material.density * self.layout.volume

    @property
    def youngs_modulus(self):
        """Of units and stones [Pa]."""
        if self.material.youngs_modulus:
            return self.material.youngs_modulus
        return CONCRETE if self.material.tensile_strength else float(f"{SOFT * self.material.density * GRAVITY * self.layout.size:.2g}")

    def case(self):
        """The case, which names the files beside it."""
        layout, slope = self.layout, self.layout.slope
        end = REST * math.sqrt(layout.size / GRAVITY)
        stones = [("underlayer", layout.underlayer), ("toe", layout.toe)]
        held = [spheres.Sphere(name=name, material="stone", source="file", file=f"{name}.csv", held=True) for name, rows in stones if len(rows)]
        return spheres.Case(
            title=f"A slope of {layout.number} units: {layout.kind.name}",
            domain=spheres.Domain(periodic=["y"], lower=(0.0, 0.0, 0.0), upper=(0.0, slope.width, 0.0)),
            materials=[
                spheres.Material(name=name, density=self.material.density, youngs_modulus=self.youngs_modulus, poisson_ratio=0.2) for name in ("unit", "stone")
            ],
            contact=spheres.Contact(restitution=0.4, friction_coefficient=self.material.friction),
            shapes=[spheres.Shape(name=layout.kind.name, source="mesh", file="unit.stl", count=self.material.count, bonds="unit" if self.material.tensile_strength else None)],
            spheres=[*held, spheres.Sphere(name="armour", material="unit", source="file", file="places.csv", shape=layout.kind.name, lowered=True, rain=True)],
            bonds=[self._bond()] if self.material.tensile_strength else [],
            walls=[
                spheres.Wall(name="slope", material="stone", point=(0.0, 0.0, slope.toe), normal=tuple(np.round(slope.normal, 12).tolist())),
                spheres.Wall(name="ground", material="stone", point=(0.0, 0.0, slope.toe), normal=(0.0, 0.0, 1.0)),
            ],
            gravity=spheres.Gravity(acceleration=(0.0, 0.0, -GRAVITY)),
            gauges=[spheres.Gauge(name="armour", group="armour")],
            time=spheres.Time(end=round_end(end, 5)[0], history_interval=round_interval(end / 100), snapshot_interval=round_end(end, 5)[1]),
        )

    def _bond(self):
        """Of concrete: shear strength twice the tensile one, as in the case tetrapod-drop, but brittle, since what a bond can soften by depends on its length."""
        strength = self.material.tensile_strength
        return spheres.Bond(
            name="unit", youngs_modulus=self.youngs_modulus, poisson_ratio=0.2, damping_ratio=0.05, tensile_strength=strength, cohesion=2.0 * strength,
            friction_angle=35.0,
        )


def write_model(model, folder, overwrite=False, command=""):
    """Writes solid, places, case and model.md into a folder, and returns the path of the case.

    command: the line by which a user makes the folder again, for model.md. Raises Occupied as `require_room`.
    """
    folder, layout = require_room(folder, FILES, overwrite), model.layout
    texts = {"case.toml": model.case().to_toml(), "model.md": words.page(model, command)}
    folder.mkdir(parents=True, exist_ok=True)
    write_stl(layout.solid, folder / "unit.stl")
    _write_rows(folder / "places.csv", "x, y, z, rx, ry, rz", np.column_stack([layout.places, layout.turns]))
    for name, rows in (("underlayer", layout.underlayer), ("toe", layout.toe)):
        _write_rows(folder / f"{name}.csv", "radius, x, y, z", rows)
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    return folder / "case.toml"


def _write_rows(path, titles, rows):
    """Writes a table, or removes it where it has no rows."""
    if not len(rows):
        path.unlink(missing_ok=True)
        return
    lines = [", ".join(f"{value:.7g}" for value in row) for row in rows.tolist()]
    path.write_text("\n".join([titles, *lines, ""]), encoding="ascii")
