"""A rod of granite that spalls, against the measured motion of its free end.

`main.py --plot FILE` draws the velocity of the free end beside what was measured.
"""

import argparse
import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare

sys.path.append(str(Path(__file__).resolve().parents[2] / "common"))

from bar_waves import incident_velocity

DENSITY, BAR_SPEED, POISSON = 2660.0, 4050.0, 0.15  # kg/m3, m/s
YOUNG = DENSITY * BAR_SPEED**2  # Pa, as the paper has it
STRENGTH = 8e6  # Pa, static, of specimens of the same size
LENGTH, WIDTH = 0.116, 0.0399  # m; from the strain gauge to the free end, and the side of a square with the area of the rod
PULSE_TIME, PULSE_STRESS = (0.0, 35e-6, 55e-6), (0.0, 41.5e6, 0.0)  # s, Pa of compression at the gauge
MEASURED = {"first maximum": (0.0, 7.75), "minimum": (18e-6, 4.25), "rebound": (28e-6, 4.95)}  # s after the maximum, m/s
LASTING = 4e-6  # s
END, STEP = 1.1e-4, 5e-6  # s; of the run, and of the record, on which the pulse bends

GEOMETRY = """SetFactory("Built-in");
Point(1) = {{0, {h}, {h}}}; Point(2) = {{0, -{h}, {h}}}; Point(3) = {{0, -{h}, -{h}}}; Point(4) = {{0, {h}, -{h}}};
For i In {{1:4}}
  Line(i) = {{i, 1 + i % 4}};
EndFor
Curve Loop(1) = {{1, 2, 3, 4}};
Plane Surface(1) = {{1}};
out[] = Extrude {{{length}, 0, 0}} {{ Surface{{1}}; }};
Physical Surface("struck", 1) = {{1}};
Physical Volume("rod", 2) = {{out[1]}};
Mesh.MeshSizeMin = {size};
Mesh.MeshSizeMax = {size};
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
"""

CASE = """
[case]
title = "Granite rod that spalls"
method = "blocks"
[mesh]
file = "rod.geo"
[[materials]]
name = "granite"
regions = ["rod"]
density = {density}
youngs_modulus = {young}
poisson_ratio = {poisson}
deformable = true
[[joints]]
name = "granite"
between = ["granite", "granite"]
law = "mixed_mode"
damping_ratio = 0.02
tensile_strength = {strength}
fracture_energy = {energy}
cohesion = 22.8e6
friction_angle = 50.0
shear_fracture_energy = 1000.0
{rate}
[contact]
contact_stiffness = 1e8
friction_coefficient = 0.6
[[motions]]
name = "wave"
type = "record"
file = "wave.csv"
[[boundaries]]
surface = "struck"
kind = "absorbing"
motion_x = "wave"
[[gauges]]
name = "free end"
point = [{gauge}, 0.0, 0.0]
[time]
end = {end}
history_interval = 5e-7
snapshot_interval = 1e-5
"""


def free_end(folder, rate="", energy=70.0, size=0.004):
    """Time [s] and velocity [m/s] of the middle of the free end."""
    folder.mkdir(parents=True)
    (folder / "rod.geo").write_text(GEOMETRY.format(h=0.5 * WIDTH, length=LENGTH, size=size))
    times = np.arange(0.0, END + STEP, STEP)
    wave = "\n".join(f"{time:.7g},{incident_velocity(np.interp(time, PULSE_TIME, PULSE_STRESS), DENSITY, YOUNG, POISSON):.9g}" for time in times)
    (folder / "wave.csv").write_text("time [s],velocity [m/s]\n" + wave + "\n")
    (folder / "case.toml").write_text(
        CASE.format(density=DENSITY, young=YOUNG, poisson=POISSON, strength=STRENGTH, energy=energy, rate=rate, end=END, gauge=LENGTH - 1e-4)
    )
    gauge = sazare.run(folder / "case.toml", folder / "run", progress=False).gauges["free end"]
    return np.asarray(gauge.time), np.asarray(gauge.velocity)[:, 0]


def pull_back(time, speed):
    """First maximum of the velocity, and the minimum after it [m/s]: the first one below which it does not fall in the next LASTING seconds."""
    first = int(np.argmax(speed))
    for place in range(first, len(speed)):
        if speed[place] <= speed[(time >= time[place]) & (time <= time[place] + LASTING)].min():
            return float(speed[first]), float(speed[place])
    raise RuntimeError("the velocity falls to the end of the run")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--plot", metavar="FILE")
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        runs = {"static": free_end(folder / "static"), "by-rate": free_end(folder / "by-rate", 'rate_law = "fib_2010"')}
    for name, (time, speed) in runs.items():
        most, least = pull_back(time, speed)
        if name == "static":  # nothing has broken until then
            print(f"{name}-first-maximum,{most:.6g}")
        print(f"{name}-pull-back,{most - least:.6g}")
    if chosen.plot:
        draw(runs, chosen.plot)


def draw(runs, file):
    """Velocity of the free end over time, with the points of the measured curve at the first maximum and after it."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(figsize=(6.4, 3.8), layout="constrained")
    names = {"static": "strength of slow tests", "by-rate": "fib_2010"}
    for name, (time, speed) in runs.items():
        axes.plot(1e6 * time, speed, label=names[name])
    time, speed = runs["static"]
    begin = time[int(np.argmax(speed))]
    axes.plot([1e6 * (begin + after) for after, _ in MEASURED.values()], [value for _, value in MEASURED.values()], "ko", label="measured: maximum, minimum, rebound")
    axes.set_xlabel("time after the wave has passed the gauge [µs]")
    axes.set_ylabel("velocity of the free end [m/s]")
    axes.legend()
    axes.grid(alpha=0.3)
    figure.savefig(file, dpi=150)


if __name__ == "__main__":
    main()
