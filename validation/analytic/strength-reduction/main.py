"""Factors of safety that `sazare study` finds by strength reduction, beside Taylor's friction circle and Bishop's slices."""

import csv
import math
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import friction_circle

from sazare import slope

HERE = Path(__file__).resolve().parent
PROGRAM = HERE.parents[2] / "build/release/apps/sazare/sazare"
HEIGHT, DENSITY = 10.0, 2000.0  # m, kg/m3


@dataclass(frozen=True)
class Ground:
    """A slope: its angle and friction angle [degrees], cohesion over density, gravity and height, and depth of the base below the toe [m]."""

    angle: float
    friction: float
    cohesion: float
    depth: float = 1.0
    behind: float = 9.0
    before: float = 3.0

    def case(self, name, **more):
        """The text of a case."""
        run = HEIGHT / math.tan(math.radians(self.angle))
        numbers = {"RUN_AND_BEHIND": run + self.behind, "RUN": run, "BEHIND": self.behind, "BEFORE": self.before, "DEPTH": self.depth,
                   "SLOPE": self.angle, "FRICTION": self.friction, "COHESION": self.cohesion * DENSITY * slope.GRAVITY * HEIGHT, **more}
        text = (HERE / name).read_text()
        for word, value in numbers.items():
            text = text.replace(word, str(value))
        return text

    def taylor(self):
        return friction_circle.safety_factor(self.cohesion, self.friction, self.angle)

    def bishop(self):
        ground = slope.Slope(HEIGHT, self.angle, self.cohesion * DENSITY * slope.GRAVITY * HEIGHT, self.friction, DENSITY, self.depth)
        return slope.safety_factor(ground)[0]


def factors(cases, lower, upper, folder):
    """What a study finds for the cases (name -> text)."""
    (folder / "slope.geo").write_text((HERE / "slope.geo").read_text())
    lines = ["[study]", 'title = "slopes"', 'find = "factor_of_safety"']
    for name, text in cases.items():
        (folder / f"{name}.toml").write_text(text)
        lines += ["[[families]]", f'name = "{name}"', f'case = "{name}.toml"']
    lines += ["[factor]", f"lower = {lower}", f"upper = {upper}", "ratio = 1.01"]
    (folder / "study.toml").write_text("\n".join(lines) + "\n")
    done = subprocess.run([PROGRAM, "study", folder / "study.toml", "--out", folder / "out", "--overwrite", "--quiet", "--threads", "1"],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    with (folder / "out/study.csv").open(newline="") as file:
        return {row["family [-]"]: float(row["factor [-]"]) for row in csv.DictReader(file)}


STEEP = Ground(60, 0, 0.25, depth=2.5, behind=15.0, before=5.0)  # clay: a wide circle through the toe
SANDY = Ground(45, 20, 0.10)
MIXED = Ground(60, 15, 0.20)
BASE = Ground(math.degrees(math.atan(0.5)), 0, 0.25, depth=10.0, behind=20.0, before=20.0)  # a circle down to the base
FIRM = Ground(math.degrees(math.atan(0.5)), 0, 0.25, depth=0.0, behind=12.0, before=0.0)  # the same above firm ground
FRICTION = Ground(math.degrees(math.atan(0.5)), 20, 0.05, depth=0.0, behind=12.0, before=0.0)


def main():
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        grounds = {"steep": STEEP, "sandy": SANDY, "mixed": MIXED}
        meshed = {**grounds, "base": BASE, "firm": FIRM, "friction": FRICTION}
        elements = factors({name: one.case("elements.toml", SIZE=1.8 if name == "base" else 1.0) for name, one in meshed.items()}, 0.8, 3.0, folder)
        coarse = factors({"sandy": SANDY.case("particles.toml", SPACING=0.5)}, 0.8, 3.0, folder)
        fine = factors({name: one.case("particles.toml", SPACING=0.25) for name, one in grounds.items()}, 0.8, 3.0, folder)
    for name, ground in grounds.items():
        print(f"taylor-elements-{name},{elements[name]},{ground.taylor()}")
        print(f"taylor-particles-{name},{fine[name]},{ground.taylor()}")
    for name in ("sandy", "mixed"):
        print(f"bishop-elements-{name},{elements[name]},{grounds[name].bishop()}")
        print(f"bishop-particles-{name},{fine[name]},{grounds[name].bishop()}")
    for name in ("base", "firm", "friction"):
        print(f"published-elements-{name},{elements[name]}")
    exact = SANDY.taylor()
    print(f"refinement,{(fine['sandy'] - exact) / (coarse['sandy'] - exact)}")
    print(f"circle-60,{friction_circle.stability_number(60, 0)}")


if __name__ == "__main__":
    main()
