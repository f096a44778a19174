"""Finite elements of another package in a coupled run: scikit-fem has the beam of the case `sphere-on-beam`, Sazare the ball that hits it.

    pip install scikit-fem
    python examples/beam_of_scikit_fem.py

The two programs exchange files (docs/reference/coupling-files.md). Any other finite elements would do the same: tell where the surface's nodes
are, and take a step with the forces that come back.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementQuadS2, ElementVector, MeshQuad
from skfem.models.elasticity import lame_parameters, linear_elasticity

from sazare import partner

ROOT = Path(__file__).resolve().parents[1]
CASE = ROOT / "cases/sphere-on-beam/case.toml"


class Beam:
    """The beam of `cases/sphere-on-beam/beam.toml` in plane strain: 60 by 2 quadratic quadrilaterals, Newmark's step."""

    def __init__(self, step, length=0.3, height=0.01, along=60, across=2, modulus=2.1e11, density=7850.0):
        mesh = MeshQuad.init_tensor(np.linspace(-length / 2, length / 2, along + 1), np.linspace(-height / 2, height / 2, across + 1))
        basis = Basis(mesh, ElementVector(ElementQuadS2()), intorder=5)
        inertia = BilinearForm(lambda u, v, _: density * (u[0] * v[0] + u[1] * v[1]))
        self.mass = inertia.assemble(basis).tocsc()
        self.stiffness = linear_elasticity(*lame_parameters(modulus, 0.0)).assemble(basis).tocsc()
        unknowns = np.hstack([basis.nodal_dofs, basis.facet_dofs]).T  # along x and y, of each node at a corner or on a side
        x, y = basis.doflocs[:, unknowns[:, 0]]
        ends = [np.flatnonzero(np.isclose(x, end) & np.isclose(y, 0.0)) for end in (-length / 2, length / 2)]
        self.free = np.setdiff1d(np.arange(basis.N), [*unknowns[ends[0]].ravel(), *unknowns[ends[1], 1]])
        top = np.flatnonzero(np.isclose(y, height / 2))
        self.surface = unknowns[top[np.argsort(x[top])]]  # of its nodes from left to right (n, 2)
        self.nodes = basis.doflocs[:, self.surface[:, 0]].T
        self.step = step
        self.displacement, self.velocity = np.zeros(basis.N), np.zeros(basis.N)
        inner = np.ix_(self.free, self.free)
        self._solve_mass = splu(self.mass[inner]).solve
        self._solve_step = splu((self.mass + step**2 / 4 * self.stiffness)[inner]).solve

    def advance(self, force):
        """A step with forces on the surface's nodes (n, 2) [N/m] that act all through it; constant mean acceleration."""
        load = np.zeros_like(self.displacement)
        load[self.surface] = force
        free, step = self.free, self.step
        acceleration = np.zeros_like(load)
        acceleration[free] = self._solve_mass((load - self.stiffness @ self.displacement)[free])
        self.displacement += step * self.velocity + step**2 / 4 * acceleration
        self.velocity += step / 2 * acceleration
        acceleration[free] = self._solve_step((load - self.stiffness @ self.displacement)[free])
        self.displacement += step**2 / 4 * acceleration
        self.velocity += step / 2 * acceleration

    def of_surface(self, values):
        """Rows of the surface's nodes."""
        return values[self.surface]


def command():
    """The command `sazare`: the installed one, else that of the source tree."""
    return shutil.which("sazare") or ROOT / "build/release/apps/sazare/sazare"


def main(end=1e-3, step=1e-6, width=0.01, out=None):
    """Carries out the run; returns times [s], deflections of the middle [m] and forces on the beam [N], one for each window."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(out or temporary)
        settings = [f"{side}.time.{key}={value!r}" for side in ("continuum", "bodies") for key, value in (("end", end), ("snapshot_interval", end))]
        ball = subprocess.Popen(
            [command(), "run", CASE, "--side", "bodies", "--exchange", folder / "exchange", "--out", folder / "ball", "--quiet", "--overwrite",
             *(word for setting in settings for word in ("--set", setting))]
        )
        beam, rows = Beam(step), []
        faces = np.column_stack([np.arange(len(beam.nodes) - 1), np.arange(1, len(beam.nodes))])  # the ball is to the left of each
        middle = len(beam.nodes) // 2
        with partner.Continuum(folder / "exchange", beam.nodes, faces, step, width=width, time_out=60.0) as bodies:
            for window in range(round(end / step)):
                beam.advance(bodies.force.mean)
                force = bodies.exchange(beam.of_surface(beam.displacement), beam.of_surface(beam.velocity))
                rows.append(((window + 1) * step, beam.of_surface(beam.displacement)[middle, 1], width * force.mean[:, 1].sum()))
        if ball.wait() != 0:
            raise RuntimeError("the ball's program failed")
    time, deflection, push = np.array(rows).T
    print(f"the ball presses with up to {-push.min():.0f} N, the beam gives way by up to {-1e6 * deflection.min():.1f} um")
    return time, deflection, push


if __name__ == "__main__":
    sys.exit(main() is None)
