"""Finite elements of another package drive the caisson of the sea wall: scikit-fem has caisson, bed and backfill, Sazare the armour.

    pip install scikit-fem
    python examples/caisson_of_scikit_fem.py

The case is that of `elastic_caisson.py`. It is run with Sazare's own finite elements too, and the two are compared. They agree to rounding until
tetrapods tumble over one another, which makes any rounding large.
"""

import sys

import numpy as np
from elastic_caisson import compare, front_of, rayleigh
from scipy.sparse.linalg import splu
from skfem import Basis, BilinearForm, ElementQuad1, ElementVector, LinearForm, MeshQuad
from skfem.models.elasticity import lame_parameters, linear_elasticity


class Caisson:
    """Bed, caisson and backfill of a case of method fem in plane strain: quadrilaterals of four nodes, Newmark's step."""

    def __init__(self, case, points, quads, region, record):
        mesh = MeshQuad(points.T.copy(), quads.T.copy())
        basis = Basis(mesh, ElementVector(ElementQuad1()), intorder=3)
        self.mass = self.stiffness = self.damping = 0
        weight = np.zeros(basis.N)
        for number, name in enumerate(dict.fromkeys(region)):
            of = next(material for material in case["materials"] if name in material["regions"])
            part = Basis(mesh, ElementVector(ElementQuad1()), intorder=3, elements=np.flatnonzero(np.asarray(region) == name))
            density, (of_mass, of_stiffness) = of["density"], rayleigh(case, of["damping_ratio"])
            mass = BilinearForm(lambda u, v, _, rho=density: rho * (u[0] * v[0] + u[1] * v[1])).assemble(part)
            stiffness = linear_elasticity(*lame_parameters(of["youngs_modulus"], of["poisson_ratio"])).assemble(part)
            weight += LinearForm(lambda v, _, rho=density: rho * case["gravity"]["acceleration"][1] * v[1]).assemble(part)
            self.mass, self.stiffness = self.mass + mass, self.stiffness + stiffness
            self.damping = self.damping + of_mass * mass + of_stiffness * stiffness
        self.mass, self.stiffness, self.damping = self.mass.tocsc(), self.stiffness.tocsc(), self.damping.tocsc()
        x, y = mesh.p
        along, up = basis.nodal_dofs
        table, wall = np.isclose(y, y.min()), np.isclose(x, x.max())
        self.driven, self.held = along[table | wall], up[table]
        self.free = np.setdiff1d(np.arange(basis.N), np.concatenate([self.driven, self.held]))
        front = front_of(points)
        self.surface = np.column_stack([along, up])[front]
        self.weight, self.record, self.time, self.step = weight, record, 0.0, case["time"]["step"]
        self.displacement = np.zeros(basis.N)
        inner = np.ix_(self.free, self.free)
        self.displacement[self.free] = splu(self.stiffness[inner]).solve(weight[self.free])
        self.settled = self.displacement.copy()
        self.nodes = points[front] + self.of_surface(self.settled)
        self.velocity = np.zeros(basis.N)
        self._solve_mass = splu(self.mass[inner]).solve
        self._solve_step = splu((self.mass + self.step / 2 * self.damping + self.step**2 / 4 * self.stiffness)[inner]).solve

    def of_surface(self, values):
        """Rows of the surface's nodes."""
        return values[self.surface]

    def moved(self):
        """Displacement since the beginning [m] and velocity [m/s] of the surface (n, 2)."""
        return self.of_surface(self.displacement - self.settled), self.of_surface(self.velocity)

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


def main(end=2.0, step=1e-3, out=None):
    """Compares both as `elastic_caisson.compare` does."""
    return compare(Caisson, "scikit-fem", end, step, out)


if __name__ == "__main__":
    sys.exit(main() is None)
