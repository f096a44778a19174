"""Fragments as rigid bodies, with the mass, inertia, momentum and angular momentum of their elements."""

from dataclasses import dataclass

import numpy as np

from sazare.tables import write_table


@dataclass(frozen=True)
class Bodies:
    """m rigid bodies. numbers (m,): of their fragments; mass [kg], volume [m3] (m,); centre, velocity, spin (m, 3); inertia (m, 3, 3) [kg m2] about the
    centre. energy: what the elements have of kinetic energy [J] (m,)."""

    numbers: np.ndarray
    mass: np.ndarray
    volume: np.ndarray
    centre: np.ndarray
    velocity: np.ndarray
    spin: np.ndarray
    inertia: np.ndarray
    energy: np.ndarray

    def __len__(self):
        return len(self.numbers)

    def of(self, chosen):
        """Those of them for which `chosen` (m,) is true, or whose places it has."""
        return Bodies(*(getattr(self, name)[chosen] for name in self.__dataclass_fields__))

    @property
    def sizes(self):
        """Diameters of spheres of equal volume (m,) [m]."""
        return np.cbrt(6.0 * self.volume / np.pi)

    @property
    def angular_momentum(self):
        """About the centre of each (m, 3) [N m s]."""
        return np.einsum("mij,mj->mi", self.inertia, self.spin)

    @property
    def kinetic_energy(self):
        """Of each as a rigid body (m,) [J]: less than that of its elements by what they move against each other."""
        return 0.5 * (self.mass * np.sum(self.velocity**2, axis=1) + np.sum(self.spin * self.angular_momentum, axis=1))


def second_moments(corners):
    """Integrals of x x^T (n, 3, 3) [m5] over tetrahedra (n, 4, 3), exact."""
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6.0
    total = corners.sum(axis=1)
    return volumes[:, None, None] / 20.0 * (np.einsum("nki,nkj->nij", corners, corners) + np.einsum("ni,nj->nij", total, total))


def _inertia(moments):
    return np.trace(moments, axis1=1, axis2=2)[:, None, None] * np.eye(3) - moments


def bodies_of(elements, chosen):
    """The Bodies of the fragments of some Elements, those for which `chosen` (n,) is true, in ascending numbers; and of each of these elements its body."""
    numbers, owner = np.unique(elements.fragment[chosen], return_inverse=True)
    owner = np.ravel(owner)
    corners, masses, velocity, spin = elements.corners[chosen], elements.masses[chosen], elements.velocity[chosen], elements.spin[chosen]

    def total(values):
        result = np.zeros((len(numbers), *values.shape[1:]))
        np.add.at(result, owner, values)
        return result

    mass = total(masses)
    centre = total(masses[:, None] * elements.centres[chosen]) / mass[:, None]
    mean = total(masses[:, None] * velocity) / mass[:, None]
    density = elements.density[chosen]
    inertia = total(density[:, None, None] * _inertia(second_moments(corners - centre[owner][:, None])))
    offset = elements.centres[chosen] - centre[owner]
    own = density[:, None, None] * _inertia(second_moments(corners - elements.centres[chosen][:, None]))
    own_momentum = np.einsum("nij,nj->ni", own, spin)
    momentum = total(masses[:, None] * np.cross(offset, velocity - mean[owner]) + own_momentum)
    energy = total(0.5 * (masses * np.sum(velocity**2, axis=1) + np.sum(spin * own_momentum, axis=1)))
    turn = np.linalg.solve(inertia, momentum[:, :, None])[:, :, 0]
    return Bodies(numbers, mass, total(elements.volumes[chosen]), centre, mean, turn, inertia, energy), owner


def write_bodies(path, bodies, density):
    """Writes the table of bodies of [[spheres]]. density [kg/m3]: that of the material of all; a fragment of others has the volume that gives its mass."""
    columns = {"body": bodies.numbers, "volume": bodies.mass / density}
    columns |= {name: bodies.centre[:, axis] for axis, name in enumerate("xyz")}
    columns |= {f"v{name}": bodies.velocity[:, axis] for axis, name in enumerate("xyz")}
    columns |= {f"w{name}": bodies.spin[:, axis] for axis, name in enumerate("xyz")}
    pairs = {"ixx": (0, 0), "iyy": (1, 1), "izz": (2, 2), "ixy": (0, 1), "iyz": (1, 2), "izx": (2, 0)}
    columns |= {name: bodies.inertia[:, row, column] / density for name, (row, column) in pairs.items()}
    write_table(path, columns)
