"""A block at rest on finite elements: what the ground carries against the block's weight."""

import math
import subprocess
import sys
import tempfile
from pathlib import Path

import sazare

HERE = Path(__file__).resolve().parent
PROGRAM = HERE.parents[2] / "build/release/apps/sazare/sazare"
WEIGHT = 8 * 4 / 3 * math.pi * 0.05**3 * 2500.0 * 9.81  # N


def main():
    with tempfile.TemporaryDirectory() as folder:
        command = [PROGRAM, "run", HERE / "case.toml", "--out", Path(folder) / "run", "--quiet"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stderr)
        results = sazare.open(Path(folder) / "run")
        bottom = results.sides["continuum"].history
        force = math.hypot(*(results.history[f"surface.force_{axis}"][-1] for axis in "xy"))
        print(f"surface,{-results.history['surface.force_z'][-1]},{WEIGHT}")
        print(f"bottom,{bottom['force.bottom_z'][-1]},{WEIGHT}")
        print(f"level,{force / WEIGHT}")


if __name__ == "__main__":
    main()
