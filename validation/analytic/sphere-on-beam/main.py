"""A ball on an elastic beam: the case against the beam's modes with Hertz's contact."""

import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = ROOT / "build/release/apps/sazare/sazare"
LENGTH, SIDE, RADIUS = 0.3, 0.01, 0.01  # m
MODULUS, DENSITY, POISSON, SPEED = 2.1e11, 7850.0, 0.3, 1.0
END, STEP, MODES = 1e-3, 2e-8, 40


def frequencies():
    """Angular frequencies [rad/s] of modes 1, 3, 5 .. of Timoshenko's beam on two supports: those that a force in the middle excites."""
    area, inertia, shear = SIDE**2, SIDE**4 / 12, 5 / 6 * 0.5 * MODULUS
    found = []
    for number in range(1, 2 * MODES, 2):
        k = number * math.pi / LENGTH
        a, b, c = DENSITY / shear, -(area / inertia + k**2 * (1 + MODULUS / shear)), MODULUS * k**4 / DENSITY
        found.append(math.sqrt((-b - math.sqrt(b**2 - 4 * a * c)) / (2 * a)))
    return np.array(found)


def theory():
    """Time [s], deflection of the middle [m] and force [N], by central differences of the modes and the ball."""
    omega = frequencies()
    mass = 4 / 3 * math.pi * RADIUS**3 * DENSITY
    stiffness = 4 / 3 * MODULUS / (2 * (1 - POISSON**2)) * math.sqrt(RADIUS)
    modal_mass = 0.5 * DENSITY * SIDE**2 * LENGTH
    amplitudes, rates = np.zeros(MODES), np.zeros(MODES)
    place, speed, force = 0.0, SPEED, 0.0
    rows = []
    for step in range(round(END / STEP)):
        speed -= STEP * force / mass
        rates += STEP * (force / modal_mass - omega**2 * amplitudes)
        place += STEP * speed
        amplitudes += STEP * rates
        force = stiffness * max(place - amplitudes.sum(), 0.0) ** 1.5
        rows.append((STEP * (step + 1), amplitudes.sum(), force))
    return np.array(rows).T


def run(scheme, folder):
    command = [PROGRAM, "run", ROOT / "cases/sphere-on-beam/case.toml", "--out", folder, "--quiet", "--set", f"coupling.scheme={scheme}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return sazare.open(folder)


def first_contact(time, force):
    """When the force of the first touch ends [s]."""
    after = np.flatnonzero((force <= 1e-3 * force.max()) & (time > time[np.argmax(force)]))
    return time[after[0]]


def main():
    time, deflection, force = theory()
    with tempfile.TemporaryDirectory() as folder:
        results = run("iterative", Path(folder) / "run")
        lagged = run("impulse", Path(folder) / "lagged")
        gauges, history = results.sides["continuum"].gauge_table, results.history
        ours, ours_time = -gauges["middle.displacement_y"], gauges["time"]
        pushing = -history["surface.last_force_y"]
        until = time <= 0.5e-3
        print(f"deflection,{ours[ours_time <= 0.5e-3].max()},{deflection[until].max()}")
        print(f"contact-time,{first_contact(history['time'], pushing)},{first_contact(time, force)}")
        print(f"peak-force,{pushing.max()},{force.max()}")
        difference = np.abs(np.interp(ours_time, time, deflection) - ours).max()
        print(f"course,{difference / np.abs(deflection).max()}")
        print(f"energy-made,{abs(results.figures['energy_coupling_error']) / results.figures['energy_work_on_nodes']}")
        made = np.abs(lagged.history["energy_coupling_error"]).max()
        print(f"energy-made-lagged,{made / np.abs(lagged.history['energy_work_on_nodes']).max()}")


if __name__ == "__main__":
    main()
