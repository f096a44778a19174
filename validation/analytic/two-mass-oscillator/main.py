"""Two masses on two springs, one of finite elements and one a ball: error and energy of the three schemes against the window.

With --plot FILE it also draws them, and with --table FILE writes them as CSV.
"""

import argparse
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = ROOT / "build/release/apps/sazare/sazare"
SPRING, WEIGHT = 1e5, 10.0  # N/m, N; both masses are 1 kg
END, BALL_STEP = 0.1, 2.5e-6  # s
SCHEMES = ("lagged", "impulse", "iterative")
WINDOWS = (2.5e-5, 5e-5, 1e-4, 2e-4, 5e-4, 1e-3, 2e-3)
COLUMNS = ("scheme", "window [s]", "error [-]", "energy gained [-]", "energy made at the surface [-]", "left the surface [-]")


def exact(time):
    """Displacement of the mass of finite elements [m]."""
    squares, modes = np.linalg.eigh(np.array([[2 * SPRING, -SPRING], [-SPRING, SPRING]]))
    rest = -WEIGHT / SPRING * np.ones(2)
    swings = np.cos(np.sqrt(squares)[:, None] * time) * (modes.T @ -rest)[:, None]
    return rest[0] + modes[0] @ swings


def run(scheme, window, folder):
    """The largest error of the mass over its displacement at rest; the energy that both have gained and that the surface has made, over
    the weight's work on the way to rest; and whether the ball has left the surface."""
    interval = max(window, 2e-4) if window != 5e-4 else 5e-4
    settings = {"coupling.scheme": scheme, "continuum.time.step": window, "bodies.time.step": BALL_STEP,
                "continuum.time.history_interval": interval, "bodies.time.history_interval": interval,
                "continuum.time.snapshot_interval": END, "bodies.time.snapshot_interval": END}
    command = [PROGRAM, "run", ROOT / "cases/two-mass-oscillator/case.toml", "--out", folder, "--overwrite", "--quiet"]
    done = subprocess.run(command + [word for key, value in settings.items() for word in ("--set", f"{key}={value}")],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    results = sazare.open(folder)
    continuum, bodies = results.sides["continuum"], results.sides["bodies"]
    gauges, elements, ball = continuum.gauge_table, continuum.history, bodies.history
    scale = WEIGHT**2 / SPRING
    error = np.abs(gauges["mass.displacement_y"] - exact(gauges["time"])).max() / (WEIGHT / SPRING)
    energy = 0.1 * (elements["energy_kinetic"] + elements["energy_elastic"]) + sum(
        ball[f"energy_{name}"] for name in ("translation", "rotation", "elastic", "tangential", "potential"))
    gained = (energy[-1] - energy[0]) / scale
    return error, gained, results.history["energy_coupling_error"][-1] / scale, float(ball["contacts"].min() == 0)


def draw(table, file):
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 3.8), layout="constrained")
    left, right = figure.subplots(1, 2)
    for scheme in SCHEMES:
        rows = np.array([row[1:] for row in table if row[0] == scheme])
        stays = rows[:, 4] == 0
        left.loglog(rows[:, 0], rows[:, 1], "o-", label=scheme)
        right.loglog(rows[stays, 0], np.abs(rows[stays, 3]), "o-", label=scheme)
        left.plot(rows[~stays, 0], rows[~stays, 1], "x", color="k", markersize=9)
    left.set(xlabel="window [s]", ylabel="largest error / rest [-]")
    right.set(xlabel="window [s]", ylabel="energy made / work of the weight [-]")
    left.legend()
    for axes in (left, right):
        axes.grid(True, which="major", alpha=0.4)
    figure.savefig(file, dpi=130)


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--plot")
    options.add_argument("--table")
    chosen = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        table = [(scheme, window, *run(scheme, window, Path(folder) / "run")) for scheme in SCHEMES for window in WINDOWS]
    if chosen.table:
        with open(chosen.table, "w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows([COLUMNS, *([row[0], *(f"{value:.4g}" for value in row[1:])] for row in table)])
    if chosen.plot:
        draw(table, chosen.plot)
    found = {(row[0], row[1]): row[2:] for row in table}
    for scheme in SCHEMES:
        print(f"order-{scheme},{np.log2(found[scheme, 5e-5][0] / found[scheme, 2.5e-5][0])}")
        print(f"error-{scheme},{found[scheme, 5e-5][0]}")
        print(f"made-{scheme},{found[scheme, 5e-5][2]}")
        print(f"energy-balance-{scheme},{abs(found[scheme, 5e-5][1] - found[scheme, 5e-5][2])}")
        print(f"longest-window-{scheme},{max(window for window in WINDOWS if found[scheme, window][3] == 0)}")


if __name__ == "__main__":
    main()
