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


def hoop_stress(r, angle):
    """Stress around the hole [Pa], by Kirsch."""
    ratio = (RADIUS / r) ** 2
    return -(ACROSS + ALONG) / 2 * (1 + ratio) + (ACROSS - ALONG) / 2 * (1 + 3 * ratio**2) * np.cos(2 * angle)


def hoop_share(elements, place, r, angle):
    """Our stress around the hole near it over Kirsch's, by least squares, and the root of the mean square of what differs over that of his."""
    near = r < NEAR * RADIUS
    normal, shear = np.asarray(elements["normal_stress"])[near], np.asarray(elements["shear_stress"])[near]
    sine, cosine = np.sin(angle[near]), np.cos(angle[near])
    ours = normal[:, 0] * sine**2 + normal[:, 1] * cosine**2 - 2 * shear[:, 0] * sine * cosine
    exact = hoop_stress(r[near], angle[near])
    return ours @ exact / (exact @ exact), np.linalg.norm(ours - exact) / np.linalg.norm(exact)


def compare(size_factor, deformable, folder):
    """Our displacement along the radius near the hole over Kirsch's, by least squares: of its uniform part, and of its part with the cosine
    of twice the angle. With them the kinetic energy at the end over its maximum, and the stress around the hole over his."""
    command = [PROGRAM, "run", HERE / "case.toml", "--out", folder, "--quiet", "--set", f"mesh.size_factor={size_factor}"]
    if deformable:
        command += ["--set", "materials.0.deformable=true", "--set", "materials.0.bulk_damping_ratio=0.5"]
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
    return *shares, kinetic[-1] / kinetic.max(), *hoop_share(elements, place, r, angle)


def main():
    with tempfile.TemporaryDirectory() as folder:
        for name, size_factor, deformable in (("coarse", 1.0, False), ("fine", 0.6, False), ("deformable", 1.0, True)):
            uniform, varying, kinetic, hoop, scatter = compare(size_factor, deformable, Path(folder) / name)
            print(f"uniform-{name},{uniform}")
            print(f"varying-{name},{varying}")
            print(f"at-rest-{name},{kinetic}")
            print(f"hoop-{name},{hoop}")
            print(f"hoop-scatter-{name},{scatter}")


if __name__ == "__main__":
    main()
