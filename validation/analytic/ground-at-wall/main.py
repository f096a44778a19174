"""Ground of moving particles that meets finite elements: at rest behind a wall, under a wave from below, and as it runs into a wall."""

import tempfile
from pathlib import Path

import numpy as np

import sazare

HERE = Path(__file__).resolve().parent
AMPLITUDE, FREQUENCY, BASE_PEAK = 0.01, 20.0, 0.05  # m/s, Hz, s
THRUST = 57552.0  # N, at rest
GRAVITY = np.array([0.0, -9.81, 0.0])


def run(name, folder, **overrides):
    return sazare.run(HERE / f"{name}.toml", folder, overrides=overrides, overwrite=True, progress=False)


def thrust(place):
    history = run("thrust", place / "thrust").history
    print(f"thrust,{history['surface.force_x'][-1]:.6g}")
    print(f"thrust-level,{abs(history['surface.force_y'][-1] / history['surface.force_x'][-1]):.3g}")


def soft(place):
    """The thrust on a wall that yields, and how it changes from the common equilibrium on."""
    force = run("soft", place / "soft").history["surface.force_x"]
    print(f"soft-thrust,{force[0] / THRUST:.6g}")
    print(f"soft-rest,{np.abs(force - force[0]).max() / force[0]:.3g}")


def ricker(time):
    """Velocity of the base [m/s], as theory/mps.md has it."""
    share = (np.pi * FREQUENCY * (time - BASE_PEAK)) ** 2
    return AMPLITUDE * (2.0 * share - 1.0) * np.exp(-share)


def wave(place):
    results = run("wave", place / "wave")
    below, above = (results.sides[side].gauge_table for side in ("continuum", "bodies"))
    time, middle, top = below["time"], below["middle.velocity_y"], above["top.velocity_y"]
    print(f"wave-rest,{np.abs(top[time < 0.03]).max() / AMPLITUDE:.3g}")
    print(f"wave-top,{np.abs(top).max() / AMPLITUDE:.6g}")
    print(f"wave-delay,{time[np.argmax(np.abs(top))] - BASE_PEAK:.6g}")
    before_return = time < 0.115  # what the free top sends back has not come yet
    thrown_back = (middle - ricker(time - 5.0 / 300.0))[before_return]
    print(f"wave-back,{np.abs(thrown_back).max() / AMPLITUDE:.3g}")


def collapse(place):
    results = run("collapse", place / "collapse")
    sand = results.sides["bodies"].particle_snapshots
    mass = 1600.0 * 0.1**2
    off = []
    for snapshot in sand:
        row = int(np.argmin(np.abs(results.history["time"] - snapshot.time)))
        velocity = np.asarray(snapshot.elements["velocity"])
        given = np.array([results.history[f"impulse_given_{axis}"][row] for axis in "xyz"])
        gained = mass * velocity.sum(axis=0)
        off.append(np.linalg.norm(gained + given - mass * len(velocity) * GRAVITY * snapshot.time))
    print(f"collapse-impulse,{max(off) / np.linalg.norm(given):.3g}")
    history = results.sides["bodies"].history
    off = np.abs(history["energy_residual"]).max() + np.abs(results.history["energy_coupling_error"]).max()
    print(f"collapse-energy,{off / np.abs(history['energy_work_gravity']).max():.3g}")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        for part in (thrust, soft, wave, collapse):
            part(Path(folder))
