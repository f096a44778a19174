"""A caisson on one's own ground: springs of any law under its base, and a wave against its side, both written here in Python.

    python examples/ground_spring.py

The engine computes the caisson, blocks of concrete joined to each other; before every step it asks for the forces of the ground and of the wave. The
ground under each block of the base follows a hyperbola, softer the more it is pressed, and lets go when the base lifts; dashpots take energy out.
"""

import sys

import numpy as np

import sazare
from sazare.cases import rectangles

WIDTH, HEIGHT, SIZE = 16.0, 12.0, 2.0  # m; per metre across the plane
DENSITY = 2000.0  # kg/m3
WEIGHT = DENSITY * WIDTH * HEIGHT * 9.81  # N/m


def caisson(end):
    """The case: blocks that are joined, under gravity, with nothing below."""
    return rectangles.Case(
        title="Caisson on its owner's ground",
        blocks=[rectangles.Block(name="caisson", material="concrete", element_size=SIZE, lower=(0.0, 0.0, 0.0), upper=(WIDTH, HEIGHT, 0.0))],
        materials=[rectangles.Material(name="concrete", density=DENSITY, youngs_modulus=2e9, poisson_ratio=0.2, damping_ratio=0.1)],
        contact=rectangles.Contact(face_normal_stiffness=1e9, face_shear_stiffness=1e9, friction_angle=30.0),
        gravity=rectangles.Gravity(acceleration=(0.0, -9.81, 0.0)),
        time=rectangles.Time(end=end, history_interval=end / 100, snapshot_interval=end / 10),
    )


class Ground:
    """Springs under the blocks of the base: p = k u/(1 + u/r) [Pa] at a settlement u [m], and nothing where the base has lifted."""

    def __init__(self, stiffness=4e7, reference=0.02, shear_stiffness=2e7, damping=2e6):
        self.stiffness, self.reference, self.shear_stiffness, self.damping = stiffness, reference, shear_stiffness, damping
        self.base = self.start = None

    def pressure(self, settlement):
        """Pressure [Pa] at settlements [m]."""
        pressed = np.maximum(settlement, 0.0)
        return self.stiffness * pressed / (1.0 + pressed / self.reference)

    def forces(self, simulation):
        """Forces on all blocks [N/m] (n, 3)."""
        places, velocities = simulation.positions, simulation.velocities
        if self.base is None:
            self.base = np.flatnonzero(places[:, 1] < SIZE)
            self.base = self.base[np.argsort(places[self.base, 0])]  # from the sea to the land
            self.start = places[self.base].copy()
        moved, speed = places[self.base] - self.start, velocities[self.base]
        touches = moved[:, 1] < 0.0
        found = np.zeros(places.shape)
        found[self.base, 1] = SIZE * np.where(touches, np.maximum(self.pressure(-moved[:, 1]) - self.damping * speed[:, 1], 0.0), 0.0)
        found[self.base, 0] = -SIZE * np.where(touches, self.shear_stiffness * moved[:, 0] + self.damping * speed[:, 0], 0.0)
        return found

    def settlement(self, weight, width):
        """Settlement at rest [m] under a weight [N/m] on a width [m], exactly; infinite where the ground does not bear it."""
        needed = weight / width
        limit = self.stiffness * self.reference
        return needed / (self.stiffness * (1.0 - needed / limit)) if needed < limit else np.inf


def main(end=12.0, wave_at=6.0, wave_force=4e5, out=None):
    """Lets the caisson settle, then strikes it with a wave of one second. Returns its settlement [m], and how far it goes [m] and tilts [rad]."""
    ground = Ground()

    def forces(simulation):
        found = ground.forces(simulation)
        since = simulation.time - wave_at
        if 0.0 < since < 1.0:
            seaward = simulation.positions[:, 0] < ground.start[0, 0] + 0.5 * SIZE
            found[seaward, 0] += wave_force * np.sin(np.pi * since) * SIZE / HEIGHT
        return found

    seen = {"farthest": 0.0, "tilt": 0.0}

    def watch(now):
        moved = now.positions[ground.base] - ground.start
        seen["farthest"] = max(seen["farthest"], moved[:, 0].max())
        seen["tilt"] = max(seen["tilt"], (moved[0, 1] - moved[-1, 1]) / (WIDTH - SIZE))

    with sazare.build(caisson(end), out, overwrite=True, forces=forces) as simulation:
        simulation.advance_to(wave_at)
        seen["settlement"] = (ground.start - simulation.positions[ground.base])[:, 1].mean()
        simulation.every(0.02, watch)
        simulation.run()
    exact = ground.settlement(WEIGHT, WIDTH)
    print(f"settlement {1e3 * seen['settlement']:.4f} mm, of a rigid caisson exactly {1e3 * exact:.4f} mm")
    print(f"the wave of {1e-3 * wave_force:.0f} kN/m moves it by {1e3 * seen['farthest']:.1f} mm and tilts it by {1e3 * seen['tilt']:.2f} mrad")
    return seen


if __name__ == "__main__":
    sys.exit(main() is None)
