"""Armour units as solids of height 1: their proportions, and how engineers place them."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import product

import numpy as np

from sazare.armour_model.solids import Convex, read_stl, union

SIDES = 12  # of the polygon that stands for a circle
ROOT, TIP = 0.530, 0.302  # of a tetrapod: diameters of a leg in the centre and at its end, over the height
WAIST, END, CHAMFER = 0.32, 0.20, 0.057  # of a dolos: width of shank and flukes in the middle, of flukes at the end, and chamfer, over the height
NECK, NARROW, FACE = 0.25, 0.20, 0.49  # of the anvils: half a cube, half the foot of an anvil, and the width of its outer face, over the height; our own
BASE, TOP = 1.086, 1.005  # of an Antifer cube: sides of its squares over the height


def cube():
    """A cube of side 1."""
    return union([Convex([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])])


def antifer():
    """An Antifer cube of height 1, without its four grooves: a square of 1.086 below and of 1.005 above."""
    return union([Convex([(sign * side / 2, other * side / 2, z) for z, side in ((-0.5, BASE), (0.5, TOP)) for sign in (-1, 1) for other in (-1, 1)])])


def tetrapod():
    """A tetrapod of height 1, one leg up: four truncated cones, each a prismoid whose sections have the area of the circle."""
    area = math.sqrt(2.0 * math.pi / (SIDES * math.sin(2.0 * math.pi / SIDES)))  # radius of the polygon over that of its circle
    low = -1.0 / 3.0
    leg = 0.75 * (1.0 - TIP / 2.0 * area * math.sqrt(8.0) / 3.0)  # 0.643 of the height, so that it is 1; 0.644 is published
    directions = [(0.0, 0.0, 1.0), *((math.sqrt(8.0) / 3.0 * math.cos(turn), math.sqrt(8.0) / 3.0 * math.sin(turn), low) for turn in (0.0, 2.0 * math.pi / 3.0, -2.0 * math.pi / 3.0))]
    legs = []
    for direction in np.array(directions):
        one = np.array([-direction[1], direction[0], 0.0]) / np.hypot(*direction[:2]) if direction[2] < 0.5 else np.array([1.0, 0.0, 0.0])  # level
        turns = np.arange(SIDES) * 2.0 * math.pi / SIDES
        ring = area * (np.cos(turns)[:, None] * one + np.sin(turns)[:, None] * np.cross(direction, one))
        legs.append(Convex(np.concatenate([ROOT / 2 * ring, leg * direction + TIP / 2 * ring])))
    return union(legs)


def dolos(waist=WAIST):
    """A dolos of height 1: a shank along x with a fluke along z at one end and one along y at the other.

    waist: width of the shank, and of the flukes in their middle, over the height.
    """
    half = waist / 2
    arm = 0.5 - half  # from the centre to the axis of a fluke
    bodies = [Convex([(x, *point) for x in (-arm, arm) for point in _chamfered(half)])]
    for side, upright in ((-arm, True), (arm, False)):
        points = [(side + across, along, reach) for reach, width in ((-0.5, END / 2), (0.0, half), (0.5, END / 2)) for across, along in _chamfered(width)]
        bodies.append(Convex(points if upright else [(x, z, -y) for x, y, z in points]))
    return union(bodies)


def _chamfered(half):
    """Corners of a square of half a width with chamfers."""
    inner = half - CHAMFER
    return [(a * half, b * inner) for a in (-1, 1) for b in (-1, 1)] + [(a * inner, b * half) for a in (-1, 1) for b in (-1, 1)]


def anvils():
    """A unit of height 1 of two anvils, turned by a right angle, that grow out of a cube."""
    bodies = [Convex(list(product((-NECK, NECK), repeat=3)))]
    for turned in (False, True):
        points = [(s * NARROW, o * NARROW, 0.0) for s in (-1, 1) for o in (-1, 1)] + [(s * 0.5, o * FACE / 2, 0.5) for s in (-1, 1) for o in (-1, 1)]
        bodies.append(Convex([(y, x, -z) for x, y, z in points] if turned else points))
    return union(bodies)


@dataclass(frozen=True)
class Kind:
    """A kind of units. make: its solid of height 1, None where a file has it; volume: the published one over the cubed height; layers, layer_coefficient k and
    porosity n of a layer as it is designed, with their packing density n_layers k (1 - n)."""

    name: str
    words: str
    make: Callable | None
    volume: float | None
    layers: int
    layer_coefficient: float
    porosity: float

    def packing_density(self, layers):
        """N D_n^2 / A of so many layers."""
        return layers * self.layer_coefficient * (1.0 - self.porosity)


MANUAL = "Shore Protection Manual (1984), table 7-13"
KINDS = {
    kind.name: kind
    for kind in (
        Kind("tetrapod", "four conical legs", tetrapod, 0.280, 2, 1.04, 0.50),
        Kind("dolos", "two flukes at right angles on a shank, waist ratio 0.32", dolos, 0.16, 2, 0.94, 0.56),
        Kind("anvils", "two crossed anvils on a cube, a unit for one layer, accropode-like", anvils, 0.34, 1, 1.29, 0.50),
        Kind("cube", "a cube", cube, 1.0, 2, 1.10, 0.47),
        Kind("antifer", "an Antifer cube without its grooves", antifer, 1.0247, 2, 1.10, 0.47),
        Kind("rock", "the solid of an .stl", None, None, 2, 1.00, 0.37),
    )
}


def unit_solid(kind, *, size=None, height=None, file=None):
    """The Solid of a unit [m]. size: its nominal diameter, the cube root of its volume [m], or height: along its own z [m]; file: the .stl of a rock.

    Raises ValueError where the surface of a rock is not closed.
    """
    solid = read_stl(file) if kind.make is None else kind.make()
    if size is not None:
        return solid.scaled(size / solid.volume ** (1.0 / 3.0))
    return solid.scaled(height / float(np.ptp(solid.points[:, 2])))
