"""Bodies of three methods at rest on finite elements: what the ground carries against their weight."""

import math
import subprocess
import sys
import tempfile
from pathlib import Path

import sazare

HERE = Path(__file__).resolve().parent
PROGRAM = HERE.parents[2] / "build/release/apps/sazare/sazare"
VOLUMES = {"case": 8 * 4 / 3 * math.pi * 0.05**3, "rectangle": 0.2 * 0.2 * 0.25, "blocks": 0.2**3}  # m3
WIDTH = {"rectangle": 0.25}  # m, of a slab whose ground is in the plane


def main():
    for name, volume in VOLUMES.items():
        weight = 2500.0 * 9.81 * volume  # N
        row = "" if name == "case" else f"{name}-"
        with tempfile.TemporaryDirectory() as folder:
            command = [PROGRAM, "run", HERE / f"{name}.toml", "--out", Path(folder) / "run", "--quiet"]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            if done.returncode != 0:
                sys.exit(done.stderr)
            results = sazare.open(Path(folder) / "run")
            bottom = results.sides["continuum"].history
            up, level = ("y", "x") if name in WIDTH else ("z", "xy")
            force = math.hypot(*(results.history[f"surface.force_{axis}"][-1] for axis in level))
            print(f"{row}surface,{-results.history[f'surface.force_{up}'][-1]},{weight}")
            print(f"{row}bottom,{WIDTH.get(name, 1.0) * bottom[f'bottom.force_{up}'][-1]},{weight}")
            print(f"{row}level,{force / weight}")


if __name__ == "__main__":
    main()
