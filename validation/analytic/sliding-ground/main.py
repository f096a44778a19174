"""Lets a layer of broken ground slide down an incline and prints its acceleration, and the residual of its energy balance."""

import tempfile
from pathlib import Path

import numpy as np

import sazare

CASE = Path(__file__).resolve().parent / "case.toml"
ANGLES = (15, 20, 25)  # of friction, degrees
BEGIN, END = 2.0, 4.0  # s


def slide(angle, folder):
    """Acceleration of the centre of mass [m/s2], and residual over the work of gravity."""
    case = sazare.read_case(CASE)
    case.materials[1].friction_angle = float(angle)
    run = sazare.run(case, folder, overwrite=True, progress=False)
    places = [snapshot.elements for snapshot in run.particle_snapshots if snapshot.time in (BEGIN, END)]
    ground = np.asarray(places[0]["material"]) == 1
    speeds = [np.asarray(elements["velocity"])[ground, 0].mean() for elements in places]
    history = run.history
    residual = abs(history["energy_residual"][-1] / history["energy_work_gravity"][-1])
    return (speeds[1] - speeds[0]) / (END - BEGIN), residual


if __name__ == "__main__":
    worst = 0.0
    with tempfile.TemporaryDirectory() as place:
        for angle in ANGLES:
            acceleration, residual = slide(angle, Path(place) / str(angle))
            worst = max(worst, residual)
            print(f"phi-{angle},{acceleration:.6g}")
    print(f"residual,{worst:.6g}")
