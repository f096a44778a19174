"""Finite elements of another package drive the caisson of the sea wall: scikit-fem has caisson, bed and backfill, Sazare the armour.

    pip install scikit-fem
    python examples/caisson_of_scikit_fem.py

The case is that of `seawall-shaking-table`, its continuum made simple enough for a page: everything is elastic and tied together, without
joints and strength, and Newmark's step has a constant mean acceleration (alpha = 0). So the caisson rocks on its bed and does not slide. The
same simple case is run with Sazare's own finite elements, and the two are compared. They agree to rounding until tetrapods tumble over one another,
which makes any rounding large.
"""

import re
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementQuad1, ElementVector, LinearForm, MeshQuad
from skfem.models.elasticity import lame_parameters, linear_elasticity

import sazare
from sazare import partner

ROOT = Path(__file__).resolve().parents[1]
CASE = ROOT / "cases/seawall-shaking-table"


def simple_case(folder, end, step):
    """The case in a folder, its continuum elastic and tied together; and the table of that continuum."""
    for file in CASE.iterdir():
        shutil.copy(file, folder)
    text = (CASE / "caisson.toml").read_text()
    text = re.sub(r"\[\[joints\]\].*?(?=\n\[damping\])", "", text, flags=re.DOTALL)
    text = re.sub(r"^(cohesion|friction_angle|alpha) = .*\n", "", text, flags=re.MULTILINE)
    text = re.sub(r"^step = .*", f"step = {step!r}", text, flags=re.MULTILINE)
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


class Caisson:
    """Bed, caisson and backfill of a case of method fem in plane strain: quadrilaterals of four nodes, Newmark's step."""

    def __init__(self, case, points, quads, region, record):
        mesh = MeshQuad(points.T.copy(), quads.T.copy())
        basis = Basis(mesh, ElementVector(ElementQuad1()), intorder=3)
        a1, a2 = 4 * np.pi * np.prod(list(case["damping"].values())) / sum(case["damping"].values()), 1 / (np.pi * sum(case["damping"].values()))
        self.mass = self.stiffness = self.damping = 0
        weight = np.zeros(basis.N)
        for number, name in enumerate(dict.fromkeys(region)):
            of = next(material for material in case["materials"] if name in material["regions"])
            part = Basis(mesh, ElementVector(ElementQuad1()), intorder=3, elements=np.flatnonzero(np.asarray(region) == name))
            density, ratio = of["density"], of["damping_ratio"]
            mass = BilinearForm(lambda u, v, _, rho=density: rho * (u[0] * v[0] + u[1] * v[1])).assemble(part)
            stiffness = linear_elasticity(*lame_parameters(of["youngs_modulus"], of["poisson_ratio"])).assemble(part)
            weight += LinearForm(lambda v, _, rho=density: rho * case["gravity"]["acceleration"][1] * v[1]).assemble(part)
            self.mass, self.stiffness = self.mass + mass, self.stiffness + stiffness
            self.damping = self.damping + a1 * ratio * mass + a2 * ratio * stiffness
        self.mass, self.stiffness, self.damping = self.mass.tocsc(), self.stiffness.tocsc(), self.damping.tocsc()
        x, y = mesh.p
        along, up = basis.nodal_dofs
        table, wall = np.isclose(y, y.min()), np.isclose(x, x.max())
        self.driven, self.held = along[table | wall], up[table]
        self.free = np.setdiff1d(np.arange(basis.N), np.concatenate([self.driven, self.held]))
        front = np.flatnonzero(np.isclose(x, 0.0) & (y >= -1e-9))
        self.surface = np.column_stack([along, up])[front[np.argsort(-y[front])]]  # from the crest down: the armour is to the left
        self.weight, self.record, self.time, self.step = weight, record, 0.0, case["time"]["step"]
        self.displacement = np.zeros(basis.N)
        inner = np.ix_(self.free, self.free)
        self.displacement[self.free] = splu(self.stiffness[inner]).solve(weight[self.free])
        self.settled = self.displacement.copy()
        self.nodes = mesh.p[:, front[np.argsort(-y[front])]].T + self.of_surface(self.settled)
        self.velocity = np.zeros(basis.N)
        self._solve_mass = splu(self.mass[inner]).solve
        self._solve_step = splu((self.mass + self.step / 2 * self.damping + self.step**2 / 4 * self.stiffness)[inner]).solve

    def of_surface(self, values):
        """Rows of the surface's nodes."""
        return values[self.surface]

    def _unbalance(self, force):
        """Unbalanced forces on the nodes, with the given ones on the surface; inertia is left out."""
        load = self.weight.copy()
        load[self.surface] += force
        return load - self.damping @ self.velocity - self.stiffness @ self.displacement

    def advance(self, force):
        """A step with forces on the surface's nodes (n, 2) [N/m] that act all through it; constant mean acceleration."""
        free, step, acceleration = self.free, self.step, np.zeros_like(self.velocity)
        acceleration[self.driven] = self.record.at(self.time)[2]
        acceleration[free] = self._solve_mass((self._unbalance(force) - self.mass @ acceleration)[free])
        self.displacement += step * self.velocity + step**2 / 4 * acceleration
        self.velocity += step / 2 * acceleration
        self.time += step
        place, speed, acceleration[self.driven] = self.record.at(self.time)
        acceleration[free] = 0.0
        self.displacement[self.driven] = self.settled[self.driven] + place
        self.velocity[self.driven] = speed
        acceleration[free] = self._solve_step((self._unbalance(force) - self.mass @ acceleration)[free])
        self.displacement[free] += step**2 / 4 * acceleration[free]
        self.velocity[free] += step / 2 * acceleration[free]


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


def main(end=2.0, step=1e-3, out=None):
    """Runs the simple case with Sazare's elements and with scikit-fem's; returns times [s] and, of both, the mean level displacement of the
    caisson's front [m] and the armour's level force on it [N], one for each row of the history."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(out or temporary)
        case = simple_case(folder, end, step)
        quiet = ["--quiet", "--overwrite"]
        subprocess.run([command(), "run", folder / "case.toml", "--out", folder / "ours", *quiet], check=True)
        ours = sazare.open(folder / "ours")
        armour = subprocess.Popen([command(), "run", folder / "case.toml", "--side", "bodies", "--exchange", folder / "exchange",
                                   "--out", folder / "armour", "--time-out", "60", *quiet])
        caisson, rows = Caisson(case, *mesh_of(folder), Record(folder / "shake.csv")), []
        faces = np.column_stack([np.arange(len(caisson.nodes) - 1), np.arange(1, len(caisson.nodes))])
        with partner.Continuum(folder / "exchange", caisson.nodes, faces, step, width=0.315, time_out=60.0) as bodies:
            for _ in range(round(end / step)):
                caisson.advance(bodies.force.mean)
                moved = caisson.of_surface(caisson.displacement - caisson.settled)
                force = bodies.exchange(moved, caisson.of_surface(caisson.velocity))
                rows.append((moved[:, 0].mean(), 0.315 * force.mean[:, 0].sum()))
        if armour.wait() != 0:
            raise RuntimeError("the armour's program failed")
        history = ours.history
        every = round(history["time"][1] / step)
        theirs = np.array(rows)[every - 1 :: every].T
        own = np.array([history["surface.displacement_x"], history["surface.force_x"]])[:, 1:]
        for name, unit, a, b in zip(("the front moves by up to", "the armour presses on average with"), ("m", "N"), own, theirs):
            size = np.mean if unit == "N" else lambda values: np.abs(values).max()
            print(f"{name} {size(a):.6g} {unit} with Sazare's elements and {size(b):.6g} {unit} with scikit-fem's")
        return history["time"][1:], own, theirs


if __name__ == "__main__":
    sys.exit(main() is None)
