"""Discs of granite that a wave splits, at three rates of loading, against measured splitting stresses.

`main.py --rate-law WORD` does it with a rate law of the joints.
"""

import argparse
import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare

sys.path.append(str(Path(__file__).resolve().parents[2] / "common"))

from bar_waves import incident_velocity

CASE = Path(__file__).resolve().parents[3] / "cases/dynamic-brazilian/case.toml"
DIAMETER, THICKNESS = 0.0408, 0.016  # m
STEEL_DENSITY, STEEL_YOUNG, STEEL_POISSON = 7850.0, 205e9, 0.29
SIZE, STEP = 0.003, 5e-6  # m, s; of elements, and of the record
# Speed of the striker [m/s]: stress of the incident wave [Pa], its rise, plateau and fall [s], and the end of the run [s].
WAVES = {5: (115e6, 120e-6, 45e-6, 115e-6, 220e-6), 10: (225e6, 55e-6, 150e-6, 35e-6, 90e-6), 20: (400e6, 35e-6, 140e-6, 30e-6, 80e-6)}


def wave(stress, rise, plateau, fall, end):
    """Times [s] and velocities [m/s] with which a wave of this stress enters a steel bar."""
    times = np.arange(0.0, end + STEP, STEP)
    stresses = np.interp(times, np.cumsum([0.0, rise, plateau, fall]), [0.0, stress, stress, 0.0])
    return times, incident_velocity(stresses, STEEL_DENSITY, STEEL_YOUNG, STEEL_POISSON)


def splitting_stress(speed, folder, settings):
    """Largest 2 F/(pi D t) [Pa] by the force F at the far end of the second bar."""
    *shape, end = WAVES[speed]
    folder.mkdir()
    for name in ("case.toml", "disc.geo"):
        (folder / name).write_bytes((CASE.parent / name).read_bytes())
    rows = "".join(f"{time:.7g},{velocity:.7g}\n" for time, velocity in zip(*wave(*shape, end)))
    (folder / "wave.csv").write_text("time [s],velocity [m/s]\n" + rows)
    done = sazare.run(
        folder / "case.toml", folder / "run", progress=False, overrides={"time.end": end, "mesh.parameters.size": SIZE, **settings}
    )
    force = np.abs(np.asarray(done.history["far end.force_x"]))
    return 2.0 * force.max() / (np.pi * DIAMETER * THICKNESS)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--rate-law", metavar="WORD")
    chosen = parser.parse_args()
    settings = {"joints.0.rate_law": chosen.rate_law} if chosen.rate_law else {}
    with tempfile.TemporaryDirectory() as place:
        stress = {speed: splitting_stress(speed, Path(place) / str(speed), settings) for speed in WAVES}
    for speed, value in stress.items():
        print(f"stress-{speed},{value / 1e6:.6g}")
    for speed in (10, 20):
        print(f"growth-{speed},{stress[speed] / stress[5]:.6g}")


if __name__ == "__main__":
    main()
