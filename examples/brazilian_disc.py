"""The tensile strength of joints from a Brazilian test: that for which a disc pressed over its diameter splits at the measured load.

    python examples/brazilian_disc.py 5000

The load is that on the platen [N], for a disc 50 mm across and 25 mm thick with two flats. A brittle elastic disc of tensile strength s splits at
P = pi D t s/2 (ISRM, 1978). A body of irregular polygons is weaker than its joints, since their facets stand at all angles and break one by one, so its joints
need more: how much is sought here, by root finding in a few runs. Cracks find other ways at other strengths, so the load scatters by some 5 % about a line.
"""

import math
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

import sazare
from sazare.cases import rectangles

DIAMETER, THICKNESS, SIZE = 0.05, 0.025, 0.0025  # m
FLAT = math.radians(10.0)  # half of the angle over which a platen bears


def strength_of(load):
    """Tensile strength [Pa] of a brittle elastic disc that splits at a load [N]."""
    return 2.0 * load / (math.pi * DIAMETER * THICKNESS)


def outline():
    """Corners of the disc [m], which end with the first."""
    right = np.linspace(FLAT - 0.5 * math.pi, 0.5 * math.pi - FLAT, 57)
    angles = [*right, *(right + math.pi), right[0]]
    return [(0.5 * DIAMETER * math.cos(angle), 0.5 * DIAMETER * math.sin(angle)) for angle in angles]


def disc(tensile_strength, speed=0.05):
    """The case: a disc of irregular polygons between two platens, the upper one coming down until it has split."""
    flat, top = 0.5 * DIAMETER, 0.5 * DIAMETER * math.cos(FLAT)
    end = 2e-10 * tensile_strength
    return rectangles.Case(
        title="Brazilian test",
        elements=rectangles.Elements(thickness=THICKNESS),
        blocks=[rectangles.Block(name="disc", material="rock", shape="polygon", elements="polygons", element_size=SIZE, points=outline())],
        materials=[rectangles.Material(name="rock", density=2600.0, youngs_modulus=2e10, poisson_ratio=0.2, damping_ratio=0.3,
                                       tensile_strength=tensile_strength, cohesion=3.0 * tensile_strength, friction_angle=35.0)],
        contact=rectangles.Contact(face_normal_stiffness=2e10, face_shear_stiffness=8e9, damping_ratio=0.3, friction_angle=20.0),
        walls=[
            rectangles.Wall(name="bed", from_=(-flat, -top, 0.0), to=(flat, -top, 0.0)),
            rectangles.Wall(name="platen", from_=(flat, top, 0.0), to=(-flat, top, 0.0), velocity=(0.0, -speed, 0.0)),
        ],
        time=rectangles.Time(end=end, history_interval=end / 240, snapshot_interval=end / 12),
    )


def splitting_load(history):
    """The load [N] on the platen from which it first falls by a tenth. Raises RuntimeError where it never does."""
    load = np.abs(history["platen.force_y"])
    largest = np.maximum.accumulate(load)
    fallen = np.flatnonzero((load < 0.9 * largest) & (largest > 0.3 * load.max()))
    if not fallen.size:
        raise RuntimeError("the disc does not split before the case ends")
    return float(largest[fallen[0]])


def breaking_load(tensile_strength, folder):
    """The load [N] at which a disc splits whose joints have this tensile strength [Pa]."""
    return splitting_load(sazare.run(disc(float(tensile_strength)), folder, overwrite=True, progress=False).history)


def calibrate(measured, low=1.5, high=4.0, tolerance=1e-2):
    """The joints' strength [Pa] for which the disc splits at the measured load [N], to a share of it, and the loads on the way.

    It is sought between two multiples of the strength of a brittle disc.
    """
    tried = {}
    with tempfile.TemporaryDirectory() as folder:

        def too_strong(strength):
            tried[strength] = breaking_load(strength, Path(folder) / "disc")
            return tried[strength] - measured

        brittle = strength_of(measured)
        return brentq(too_strong, low * brittle, high * brittle, xtol=tolerance * brittle), tried


def main(measured):
    """Prints every trial and the answer; returns the answer."""
    strength, tried = calibrate(measured)
    for each, load in tried.items():
        print(f"joints of {each / 1e6:6.3f} MPa split at {load:7.0f} N")
    print(f"{measured:.0f} N were measured, {strength_of(measured) / 1e6:.2f} MPa of a brittle disc: the joints have {strength / 1e6:.2f} MPa")
    return strength


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1]) if len(sys.argv) > 1 else 5000.0) is None)
