"""A charge in elastic rock: the wave of a detonation that is faster than it, and the rest that the gas and the rock come to."""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare

HERE = Path(__file__).resolve().parent
PROGRAM = HERE.parents[2] / "build/release/apps/sazare/sazare"
MODULUS, RATIO, INNER, OUTER, LENGTH = 50e9, 0.25, 0.02, 0.4, 0.5  # Pa, -, m
EXPONENT, START = 1.5, 20e6  # of the gas, and its pressure in the volume of the charge [Pa]
ENERGY = 1000.0 * 40e3 * np.pi / 4 * 0.25 * (2 * INNER) ** 2 * LENGTH  # J, of a quarter


ANGLES = (15, 25, 35, 45, 55, 65, 75)  # of the gauges, from x [deg]


def arrival(results, gauges):
    """When the speed away from the hole is first half of its largest, the mean of the gauges of one name [s]."""
    table = results.gauge_table
    arrivals = []
    for angle in ANGLES:
        x, y = (table[f"{gauges} {angle}.velocity_{axis}"] for axis in "xy")
        speed = x * np.cos(np.radians(angle)) + y * np.sin(np.radians(angle))
        after = int(np.argmax(speed > 0.5 * speed.max()))
        arrivals.append(np.interp(0.5 * speed.max(), speed[after - 1 : after + 1], table["time"][after - 1 : after + 1]))
    return np.mean(arrivals)


def round_share(points):
    """Area of the polygon that the mesh has for the hole over that of the circle: the gas presses on it."""
    is_corner = (np.abs(np.hypot(points[:, 0], points[:, 1]) - INNER) < 1e-6) & (np.abs(points[:, 2]) < 1e-9)
    angle = np.pi / 2 / (len(np.unique(points[is_corner].round(7), axis=0)) - 1)
    return np.sin(angle) / angle


def lame(r):
    """Displacement along the radius over the pressure within a thick cylinder in plane strain [m/Pa]."""
    return (1 + RATIO) * INNER**2 / (MODULUS * (OUTER**2 - INNER**2)) * ((1 - 2 * RATIO) * r + OUTER**2 / r)


def main():
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place) / "run"
        done = subprocess.run([PROGRAM, "run", HERE / "case.toml", "--out", folder, "--quiet"], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stderr)
        results = sazare.open(folder)
        end = {name: results.history[name][-1] for name in ("hole.pressure", "hole.volume", "hole.released", "hole.work", "energy_work")}
        elements = results.snapshots[-1].elements
        moved = np.asarray(elements["displacement"])
        centres = elements.cell_centers().points - moved
        radial = np.einsum("ij,ij->i", moved[:, :2], centres[:, :2]) / np.hypot(centres[:, 0], centres[:, 1])
        pushed = round_share(np.asarray(results.snapshots[0].elements.points)) * end["hole.pressure"]
        r = np.hypot(centres[:, 0], centres[:, 1])
        for name, low, high in (("near", INNER, 0.05), ("far", 0.3, 0.35)):
            within = (r > low) & (r < high)
            exact = lame(r[within]) * pushed
            print(f"displacement-{name},{radial[within] @ exact / (exact @ exact)}")
        print(f"mach-delay,{arrival(results, 'far') - arrival(results, 'near')}")
        print(f"detonation-delay,{arrival(results, 'near') - arrival(results, 'low')}")
        room = end["hole.volume"] / (ENERGY / (1000.0 * 40e3))
        print(f"pressure,{end['hole.pressure'] / (START * room**-EXPONENT)}")
        print(f"released,{end['hole.released'] / ENERGY}")
        print(f"work,{end['energy_work'] / end['hole.work']}")


if __name__ == "__main__":
    main()
