"""The sea wall of `seawall-shaking-table`, its continuum made simple enough for a page of another finite element package: everything is elastic and
tied together, without joints and strength, and Newmark's step has a constant mean acceleration (alpha = 0). So the caisson rocks on its bed and
does not slide.

`caisson_of_scikit_fem.py` and `caisson_of_opensees.py` bring the finite elements.
"""

import re
import shutil
import subprocess
import tempfile
import tomllib
from pathlib import Path

import numpy as np

import sazare
from sazare import partner

ROOT = Path(__file__).resolve().parents[1]
CASE = ROOT / "cases/seawall-shaking-table"
WIDTH = 0.315  # of the armour along the shore [m]


def simple_case(folder, end, step, mass="consistent"):
    """The case in a folder, its continuum elastic and tied together; and the table of that continuum. mass: "consistent" or "lumped"."""
    for file in CASE.iterdir():
        shutil.copy(file, folder)
    text = (CASE / "caisson.toml").read_text()
    text = re.sub(r"\[\[joints\]\].*?(?=\n\[damping\])", "", text, flags=re.DOTALL)
    text = re.sub(r"^(cohesion|friction_angle|alpha) = .*\n", "", text, flags=re.MULTILINE)
    text = re.sub(r"^step = .*", f"step = {step!r}", text, flags=re.MULTILINE)
    text = text.replace("[damping]", f'[elements]\nmass = "{mass}"\n\n[damping]\nrelative_to_base = false')
    (folder / "caisson.toml").write_text(text)
    for side in ("caisson.toml", "armour.toml"):
        text = (folder / side).read_text()
        text = re.sub(r"^(end|snapshot_interval) = .*", rf"\1 = {end!r}", text, flags=re.MULTILINE)
        (folder / side).write_text(text)
    return tomllib.loads((folder / "caisson.toml").read_text())


class Record:
    """Motion of the table from the record of its acceleration, straight lines between the samples."""

    def __init__(self, file):
        self.time, self.acceleration = np.loadtxt(file, delimiter=",", skiprows=1).T
        step, a = np.diff(self.time), self.acceleration
        self.velocity = np.concatenate([[0.0], np.cumsum(step * (a[:-1] + a[1:]) / 2)])
        self.place = np.concatenate([[0.0], np.cumsum(step * self.velocity[:-1] + step**2 * (2 * a[:-1] + a[1:]) / 6)])

    def at(self, time):
        """Displacement, velocity and acceleration at a time."""
        i = min(np.searchsorted(self.time, time, side="right") - 1, len(self.time) - 2)
        past, slope = time - self.time[i], (self.acceleration[i + 1] - self.acceleration[i]) / (self.time[i + 1] - self.time[i])
        return (self.place[i] + past * self.velocity[i] + past**2 / 2 * self.acceleration[i] + past**3 / 6 * slope,
                self.velocity[i] + past * self.acceleration[i] + past**2 / 2 * slope, self.acceleration[i] + past * slope)


def rayleigh(case, ratio):
    """Factors of the mass and of the stiffness matrix for a damping ratio of a material."""
    f1, f2 = case["damping"]["f1"], case["damping"]["f2"]
    return 4 * np.pi * f1 * f2 / (f1 + f2) * ratio, ratio / (np.pi * (f1 + f2))


def command():
    """The command `sazare`: the installed one, else that of the source tree."""
    return shutil.which("sazare") or ROOT / "build/release/apps/sazare/sazare"


def mesh_of(folder):
    """Points (n, 2), quadrilaterals (m, 4) and names of their regions, of the geometry that the case names."""
    subprocess.run(["gmsh", "-2", "-format", "msh2", "-o", folder / "plain.msh", folder / "caisson.geo"], check=True, stdout=subprocess.DEVNULL)
    parts = dict(re.findall(r"\$(\w+)\n(.*?)\n\$End", (folder / "plain.msh").read_text(), flags=re.DOTALL))
    names = {int(tag): name.strip('"') for dimension, tag, name in (line.split(maxsplit=2) for line in parts["PhysicalNames"].splitlines()[1:])
             if dimension == "2"}
    points = np.array([line.split()[1:3] for line in parts["Nodes"].splitlines()[1:]], float)
    elements = [[int(word) for word in line.split()] for line in parts["Elements"].splitlines()[1:]]
    quads = [element for element in elements if element[1] == 3]
    return points, np.array([element[-4:] for element in quads]) - 1, [names[element[3]] for element in quads]


def front_of(points):
    """Numbers of the nodes of the surface, from the crest down: the armour is to the left."""
    front = np.flatnonzero(np.isclose(points[:, 0], 0.0) & (points[:, 1] >= -1e-9))
    return front[np.argsort(-points[front, 1])]


def compare(make_caisson, name, end, step, out, mass="consistent"):
    """Runs the simple case with Sazare's elements and with those of `make_caisson(case, points, quads, regions, record)`, a package's `name`.

    What it makes has `nodes`, places of the surface (n, 2) [m]; `advance(force)`, a step with forces (n, 2) [N/m] that act all through it; and
    `moved()`, displacement since the beginning and velocity of the surface (n, 2).

    Returns times [s] and, of both, the mean level displacement of the caisson's front [m] and the armour's level force on it [N], one for each
    row of the history.
    """
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(out or temporary)
        case = simple_case(folder, end, step, mass)
        quiet = ["--quiet", "--overwrite"]
        subprocess.run([command(), "run", folder / "case.toml", "--out", folder / "ours", *quiet], check=True)
        ours = sazare.open(folder / "ours")
        armour = subprocess.Popen([command(), "run", folder / "case.toml", "--side", "bodies", "--exchange", folder / "exchange",
                                   "--out", folder / "armour", "--time-out", "60", *quiet])
        caisson, rows = make_caisson(case, *mesh_of(folder), Record(folder / "shake.csv")), []
        faces = np.column_stack([np.arange(len(caisson.nodes) - 1), np.arange(1, len(caisson.nodes))])
        with partner.Continuum(folder / "exchange", caisson.nodes, faces, step, width=WIDTH, time_out=60.0) as bodies:
            for _ in range(round(end / step)):
                caisson.advance(bodies.force.mean)
                moved, velocity = caisson.moved()
                force = bodies.exchange(moved, velocity)
                rows.append((moved[:, 0].mean(), WIDTH * force.mean[:, 0].sum()))
        if armour.wait() != 0:
            raise RuntimeError("the armour's program failed")
        history = ours.history
        every = round(history["time"][1] / step)
        theirs = np.array(rows)[every - 1 :: every].T
        own = np.array([history["surface.displacement_x"], history["surface.force_x"]])[:, 1:]
        for what, unit, a, b in zip(("the front moves by up to", "the armour presses on average with"), ("m", "N"), own, theirs):
            size = np.mean if unit == "N" else lambda values: np.abs(values).max()
            print(f"{what} {size(a):.6g} {unit} with Sazare's elements and {size(b):.6g} {unit} with {name}'s")
        return history["time"][1:], own, theirs
