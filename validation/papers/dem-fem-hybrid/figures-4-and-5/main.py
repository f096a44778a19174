"""The sea wall on a shaking table against what the paper says of its figures 4 and 5. With --plot FILE it draws figure 5."""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare

ROOT = Path(__file__).resolve().parents[4]
PROGRAM = ROOT / "build/release/apps/sazare/sazare"
SHAKEN_FROM, SHAKEN_TO = 1.0, 4.5  # s
WAVE = 0.5  # s
SEAWARDS = -1.0  # direction of x


def run(folder):
    command = [PROGRAM, "run", ROOT / "cases/seawall-shaking-table/case.toml", "--out", folder, "--quiet"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return sazare.open(folder)


def draw(course, file):
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8, 8), layout="constrained")
    rows = figure.subplots(4, 1, sharex=True)
    for axes, (words, values) in zip(rows, course["drawn"].items()):
        axes.plot(course["time"], values, linewidth=1.0)
        axes.set_ylabel(words)
        axes.grid(True, alpha=0.4)
        axes.margins(x=0)
    rows[-1].set_xlabel("time [s]")
    figure.savefig(file, dpi=130)


def course_of(results):
    """What figure 5 shows."""
    gauges, history = results.sides["continuum"].gauge_table, results.history
    time = gauges["time"]
    slip = SEAWARDS * (gauges["crest.displacement_x"] - gauges["table.displacement_x"])
    acceleration = SEAWARDS * gauges["crest.acceleration_x"]
    return {
        "time": time, "slip": slip, "acceleration": acceleration, "table": SEAWARDS * gauges["table.acceleration_x"],
        "drawn": {"(a) caisson, seawards [mm]": 1e3 * slip, "(b) armour on it [N]": -SEAWARDS * history["surface.force_x"],
                  "(c) caisson [m/s²]": acceleration, "(d) table [m/s²]": SEAWARDS * gauges["table.acceleration_x"]},
    }


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--plot")
    options.add_argument("--run", help="the folder of a run that is there already")
    chosen = options.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        course = course_of(sazare.open(chosen.run) if chosen.run else run(Path(folder) / "run"))
    if chosen.plot:
        draw(course, chosen.plot)
    time, slip = course["time"], course["slip"]
    shaken = (time >= SHAKEN_FROM) & (time <= SHAKEN_TO)
    before, after = (time > SHAKEN_FROM - 0.3) & (time <= SHAKEN_FROM), time > SHAKEN_TO
    moved = slip[after].mean() - slip[before].mean()
    back = (np.maximum.accumulate(slip[shaken]) - slip[shaken]).max()
    speed = np.gradient(slip[shaken], time[shaken])
    print(f"back,{back / moved}")
    print(f"steps,{count_steps(time[shaken], speed)}")
    print(f"moving,{(speed > 0.5 * moved / (SHAKEN_TO - SHAKEN_FROM)).mean()}")
    print(f"flattened,{-course['acceleration'][shaken].min() / course['acceleration'][shaken].max()}")


def count_steps(time, speed):
    """The waves, of the five, in which the caisson goes seawards at more than a fifth of its largest speed."""
    waves = np.floor((time - SHAKEN_FROM) / WAVE).astype(int)
    largest = np.array([speed[waves == wave].max() for wave in range(1, 6)])
    return int((largest > 0.2 * largest.max()).sum())


if __name__ == "__main__":
    main()
