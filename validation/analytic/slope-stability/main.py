"""Looks for the factor by which the strength of a slope may be divided before it slides under gravity."""

import math
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare
from sazare import slope

HERE = Path(__file__).resolve().parent
PROGRAM = HERE.parents[2] / "build/release/apps/sazare/sazare"
COHESION, FRICTION = 10e3, 20.0  # Pa, degrees
PUBLISHED = 1.380
NOT_AT_REST = 3  # exit code of failed physics
SLIDING = 1.5  # times the settlement with the whole strength: where it begins to grow fast


def settlement(factor, spacing, folder):
    """Largest displacement under gravity [m], until the rest or the last step."""
    friction = math.degrees(math.atan(math.tan(math.radians(FRICTION)) / factor))
    settings = {"particles.spacing": spacing, "materials.0.cohesion": COHESION / factor, "materials.0.friction_angle": friction,
                "gravity.max_settling_steps": int(4000 / spacing)}
    command = [PROGRAM, "run", HERE / "case.toml", "--out", folder, "--overwrite", "--quiet"]
    command += [word for key, value in settings.items() for word in ("--set", f"{key}={value}")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode not in (0, NOT_AT_REST):
        sys.exit(done.stderr)
    return sazare.open(folder).figures["settlement"]


def reduction_factor(spacing, folder):
    low, high = 1.0, 2.0
    most = SLIDING * settlement(low, spacing, folder)
    while high - low > 0.005:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if settlement(middle, spacing, folder) < most else (low, middle)
    return 0.5 * (low + high)


def main():
    with tempfile.TemporaryDirectory() as folder:
        coarse, fine = (reduction_factor(spacing, Path(folder) / "run") for spacing in (0.5, 0.25))
    print(f"factor-coarse,{coarse}")
    print(f"factor-fine,{fine}")
    print(f"refinement,{(fine - PUBLISHED) / (coarse - PUBLISHED)}")
    unit_weight = 20e3
    example = slope.Slope(height=10.0, angle=math.degrees(math.atan(0.5)), cohesion=COHESION, friction_angle=FRICTION,
                          density=unit_weight / slope.GRAVITY, firm_base=0.0)
    print(f"bishop,{slope.safety_factor(example)[0]}")
    pulse = np.r_[np.full(100, 5.0), np.zeros(400)]  # 1 s of 5 m/s2, held back by 2 m/s2
    print(f"newmark,{slope.sliding_block(pulse, 0.01, 2.0)}")


if __name__ == "__main__":
    main()
