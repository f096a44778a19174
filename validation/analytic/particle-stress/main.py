"""Stress of the particles of method mps at rest under gravity and in a plane S wave, beside closed forms."""

import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare

HERE = Path(__file__).resolve().parent
GRAVITY, SPACING, HEIGHT, DENSITY = 9.81, 0.5, 20.0, 1800.0  # of at-rest.toml
BORDER = 40.0  # m, of wave.toml


def at_rest(folder):
    """Largest relative error of the vertical stress, and of the lateral one over it less K0, two spacings away from the outside."""
    elements = sazare.run(HERE / "at-rest.toml", folder, progress=False).particle_snapshots[-1].elements
    x, y = np.asarray(elements.points)[:, :2].T
    normal = np.asarray(elements["normal_stress"])
    depth = HEIGHT - y
    inner = (depth > 2.0 * SPACING) & (y > 2.0 * SPACING) & (x > 2.0 * SPACING) & (x < 6.0 - 2.0 * SPACING)
    weight = DENSITY * GRAVITY * depth
    vertical = np.abs(normal[:, 1] + weight) / weight
    lateral = normal[:, 0] / normal[:, 1]
    return vertical[inner].max(), vertical[depth > 2.0 * SPACING].max(), np.median(lateral[inner]), np.ptp(lateral[inner])


def wave(folder):
    """Largest error of the shear stress less -rho Vs v in the lower ground, over the largest one; the same of the strain; and of the stress in
    the upper ground. With --border also the stress in the second and first rows on both sides of the border over that near by."""
    snapshots = sazare.run(HERE / "wave.toml", folder, progress=False).particle_snapshots
    going_up = [snapshot.elements for snapshot in snapshots if snapshot.time < 0.16]
    velocity = np.concatenate([np.asarray(one["velocity"])[:, 0] for one in going_up])
    stress = np.concatenate([np.asarray(one["shear_stress"])[:, 0] for one in going_up])
    height = np.concatenate([np.asarray(one.points)[:, 1] for one in going_up])
    strain = np.concatenate([np.asarray(one["shear_strain"])[:, 0] for one in going_up])
    inner = (height > 1.0) & (height < BORDER - 2.0)
    expected = -2000.0 * 400.0 * velocity
    largest = np.abs(expected[inner]).max()
    error = np.abs(stress - expected)[inner].max() / largest
    strain_error = np.abs(strain + velocity / 400.0)[inner].max() * 400.0 / np.abs(velocity[inner]).max()
    last = snapshots[-1].elements
    height, velocity = np.asarray(last.points)[:, 1], np.asarray(last["velocity"])[:, 0]
    above = height > BORDER + 2.0
    passed = np.abs(np.asarray(last["shear_stress"])[above, 0] + 1600.0 * 200.0 * velocity[above]).max()
    if "--border" in sys.argv:
        print(f"second and first rows below and above the border: {at_border(snapshots)}", file=sys.stderr)
    return error, strain_error, passed / np.abs(1600.0 * 200.0 * velocity[above]).max()


def at_border(snapshots):
    one = min(snapshots, key=lambda snapshot: abs(snapshot.time - 0.26)).elements
    height, stress = np.asarray(one.points)[:, 1] - BORDER, np.asarray(one["shear_stress"])[:, 0]
    near = stress[(np.abs(height) > 0.5) & (np.abs(height) < 1.0)].mean()
    return tuple(stress[np.abs(height - place) < 0.1].mean() / near for place in (-0.375, -0.125, 0.125, 0.375))


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        inner, everywhere, ratio, spread = at_rest(Path(place) / "rest")
        print(f"vertical,{inner:.6g}")
        print(f"vertical-at-walls,{everywhere:.6g}")
        print(f"lateral,{ratio:.6g}")
        print(f"lateral-spread,{spread:.6g}")
        for name, value in zip(("wave", "wave-strain", "wave-above"), wave(Path(place) / "wave")):
            print(f"{name},{value:.6g}")
