"""The ball of cases/penetration-25k against LIGGGHTS's: the mean of several starts, as roundings alone move its rebound."""

import csv
import math
import statistics
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
MEETS_FLOOR = 0.028  # s
END = 0.05  # s
STARTS = 5  # runs
DENSITY, CHANGE = 7200.0, 1e-12  # kg/m3 of the ball; by this share of it a start differs from the next one


def ticks(time):
    """A time in units of 1e-4 s."""
    return round(1e4 * float(time))


def reference():
    """(height [m], velocity [m/s]) by time in ticks."""
    with open(HERE / "liggghts.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {ticks(row["time[s]"]): (float(row["z[m]"]), float(row["vz[m/s]"])) for row in rows}


def ours(start):
    """Height and velocity, as in `reference`, of the case run to END on one thread from a start; the first start is the case as it is."""
    density = DENSITY * (1 + start * CHANGE)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["build/release/apps/sazare/sazare", "run", "cases/penetration-25k/case.toml", "--out", folder, "--overwrite", "--threads", "1",
                        "--set", f"time.end={END}", "--set", f"materials.1.density={density!r}"], check=True, stdout=subprocess.DEVNULL)
        with open(Path(folder) / "gauges.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    return {ticks(row["time [s]"]): (float(row["ball.position_z [m]"]), float(row["ball.velocity_z [m/s]"])) for row in rows}


def main():
    theirs, runs = reference(), [ours(start) for start in range(STARTS)]
    before = [abs(run[time][0] - theirs[time][0]) for run in runs for time in run if time <= ticks(MEETS_FLOOR)]
    lowest = [min(place for place, _ in run.values()) for run in runs]
    velocities = [run[ticks(END)][1] for run in runs]
    print(f"before-the-floor,{1e3 * max(before):.6g}")
    print(f"lowest,{1e3 * statistics.mean(lowest):.6g},{1e3 * min(place for place, _ in theirs.values()):.6g}")
    print(f"velocity,{statistics.mean(velocities):.6g},{theirs[ticks(END)][1]:.6g}")
    print(f"velocity-standard-error,{statistics.stdev(velocities) / math.sqrt(STARTS):.6g},{0.1 * theirs[ticks(END)][1]:.6g}")


if __name__ == "__main__":
    main()
