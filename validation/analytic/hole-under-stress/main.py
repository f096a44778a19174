"""Displacements around a hole that is cut in stressed rock, once the waves of its unloading have left, against Kirsch's."""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare

HERE = Path(__file__).resolve().parent
PROGRAM = HERE.parents[2] / "build/release/apps/sazare/sazare"
MODULUS, RATIO, RADIUS = 20e9, 0.2, 1.0  # Pa, -, m
ACROSS, ALONG = 10e6, 20e6  # Pa, compression along x and along y
NEAR = 1.5  # radii: elements whose displacement is compared


def kirsch(r, angle):
    """Displacement along the radius [m] that the hole causes in plane strain, at a distance [m] and an angle from x: its two parts."""
    scale = -(1 + RATIO) / (2 * MODULUS) * RADIUS**2 / r
    return scale * (ACROSS + ALONG), scale * (ACROSS - ALONG) * (4 * (1 - RATIO) - (RADIUS / r) ** 2) * np.cos(2 * angle)


def compare(size_factor, folder):
    """Our displacement along the radius near the hole over Kirsch's, by least squares: of its uniform part, and of its part with the cosine
    of twice the angle. With them the kinetic energy at the end over its maximum."""
    command = [PROGRAM, "run", HERE / "case.toml", "--out", folder, "--quiet", "--set", f"mesh.size_factor={size_factor}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    results = sazare.open(folder)
    elements = results.snapshots[-1].elements
    moved = np.asarray(elements["displacement"])
    place = elements.cell_centers().points - moved
    r, angle = np.hypot(place[:, 0], place[:, 1]), np.arctan2(place[:, 1], place[:, 0])
    near = r < NEAR * RADIUS
    ours = (moved[:, 0] * np.cos(angle) + moved[:, 1] * np.sin(angle))[near]
    by_part = np.column_stack(kirsch(r[near], angle[near]))
    shares, *_ = np.linalg.lstsq(by_part, ours, rcond=None)
    kinetic = results.history["energy_kinetic"]
    return *shares, kinetic[-1] / kinetic.max()


def main():
    with tempfile.TemporaryDirectory() as folder:
        for name, size_factor in (("coarse", 1.0), ("fine", 0.6)):
            uniform, varying, kinetic = compare(size_factor, Path(folder) / name)
            print(f"uniform-{name},{uniform}")
            print(f"varying-{name},{varying}")
            print(f"at-rest-{name},{kinetic}")


if __name__ == "__main__":
    main()
