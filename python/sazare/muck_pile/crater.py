"""The crater of a single charge below a free surface: the rock that flies out of it."""

from dataclasses import dataclass

import numpy as np

from sazare.blast.holes import holes_of
from sazare.muck_pile.elements import FACES, elements_of, outer_faces

GRAVITY = 9.81  # m/s2


@dataclass(frozen=True)
class Crater:
    """What a charge throws out: volume [m3] and mass [kg] of the fragments that rise higher than they are large, the radius [m] of the circle with the area that they had on the
    surface, the depth [m] of their deepest corner below it, their number, and their mean speed out of the rock by mass [m/s]. broken: volume [m3] of all rock that has come
    loose, with what stays in the crater or below it."""

    volume: float
    mass: float
    radius: float
    depth: float
    fragments: int
    speed: float
    broken: float


def crater_of(results):
    """The Crater of a run with holes, which point out of the surface from their ends to their collars. Raises ValueError where the run has no holes, or as elements_of."""
    holes = holes_of(results)
    if not holes:
        raise ValueError(f"{results.path}: no holes, so nobody knows which way is out of the rock")
    up = sum(hole.first - hole.last for hole in holes)
    return crater(elements_of(results), up / np.linalg.norm(up))


def crater(elements, up):
    """The Crater of Elements with a plane surface across `up` (3,), a unit vector. A fragment is thrown out where the square of its mean speed along `up` over 2 g is more than
    the diameter of the sphere of its volume."""
    loose = ~elements.stays
    numbers, owner = np.unique(elements.fragment, return_inverse=True)
    owner = np.ravel(owner)
    mass, volume, momentum = (np.bincount(owner, weights, minlength=len(numbers)) for weights in (elements.masses, elements.volumes, elements.masses * (elements.velocity @ up)))
    speed = momentum / mass
    thrown_fragment = (speed > 0.0) & (speed**2 / (2.0 * GRAVITY) > np.cbrt(6.0 * volume / np.pi))
    thrown = loose & thrown_fragment[owner]
    corners = elements.start @ up
    surface = corners.max()
    on_surface = outer_faces(elements.nodes) & np.all(corners[:, FACES] > surface - 1e-6 * np.ptp(corners), axis=2)
    faces = elements.start[:, FACES]
    areas = 0.5 * np.linalg.norm(np.cross(faces[:, :, 1] - faces[:, :, 0], faces[:, :, 2] - faces[:, :, 0]), axis=2)
    total = float(elements.masses[thrown].sum())
    return Crater(
        volume=float(elements.volumes[thrown].sum()), mass=total, radius=float(np.sqrt(areas[on_surface & thrown[:, None]].sum() / np.pi)),
        depth=float(surface - corners[thrown].min()) if np.any(thrown) else 0.0, fragments=len(np.unique(owner[thrown])),
        speed=float((elements.masses * (elements.velocity @ up))[thrown].sum() / total) if total > 0.0 else 0.0, broken=float(elements.volumes[loose].sum()),
    )
