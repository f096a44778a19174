"""The ball of cases/penetration-25k against LIGGGHTS's."""

import csv
import subprocess
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
MEETS_FLOOR = 0.028  # s
END = 0.05  # s


def reference():
    """(height [m], velocity [m/s]) by time in units of 1e-4 s."""
    with open(HERE / "liggghts.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {round(1e4 * float(row["time[s]"])): (float(row["z[m]"]), float(row["vz[m/s]"])) for row in rows}


def ours():
    """The same of the case, run to END on one thread."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["build/release/apps/sazare/sazare", "run", "cases/penetration-25k/case.toml", "--out", folder, "--overwrite", "--threads", "1",
                        "--set", f"time.end={END}"], check=True, stdout=subprocess.DEVNULL)
        with open(Path(folder) / "gauges.csv", newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    return {round(1e4 * float(row["time [s]"])): (float(row["ball.position_z [m]"]), float(row["ball.velocity_z [m/s]"])) for row in rows}


def main():
    theirs, found = reference(), ours()
    before = [abs(found[time][0] - theirs[time][0]) for time in found if time <= round(1e4 * MEETS_FLOOR)]
    print(f"before-the-floor,{1e3 * max(before):.6g}")
    print(f"lowest,{1e3 * min(place for place, _ in found.values()):.6g},{1e3 * min(place for place, _ in theirs.values()):.6g}")
    print(f"velocity,{found[round(1e4 * END)][1]:.6g},{theirs[round(1e4 * END)][1]:.6g}")


if __name__ == "__main__":
    main()
