"""Cycles of shear of one finite element against the mean curves of measured sands.

`main.py --plot FILE` draws stiffness and damping beside the measured ones.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

import sazare

STRAINS = (0.1, 0.3, 1.0, 3.0)  # over the reference strain
REFERENCE = 0.0352e-2  # strain, eq. 7.26a of Darendeli (2001): no plasticity, 1 atm
CURVATURE, CYCLES, LEAST_DAMPING = 0.919, 10, 0.8005  # eqs 7.26b and 7.28a; -, -, %
MODULUS = 1e8  # Pa
STEPS = 100  # of a quarter of a cycle

CASE = """
[case]
title = "Cycles of shear"
method = "fem"
[mesh]
file = "{folder}/square.geo"
dimension = 2
[[materials]]
name = "sand"
regions = ["sand"]
density = 2000.0
youngs_modulus = {young}
poisson_ratio = 0.25
{backbone}
[[motions]]
name = "cycles"
type = "record"
file = "{folder}/cycles.csv"
[[boundaries]]
group = "foot"
kind = "fixed"
[[boundaries]]
group = "head"
kind = "prescribed"
axes = ["y"]
motion_x = "cycles"
[time]
analysis = "static"
step = 1.0
end = {end}.0
history_interval = 1.0
snapshot_interval = {end}.0
"""

SQUARE = """
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1, 2, 3, 4} = 2; Transfinite Surface{1}; Recombine Surface{1};
Physical Surface("sand") = {1}; Physical Curve("foot") = {1}; Physical Curve("head") = {3};
"""


def measured_modulus(strain):
    """Mean of G/G0 at a strain over the reference strain, eq. 7.25, and its standard deviation, eq. 7.29."""
    mean = 1.0 / (1.0 + strain**CURVATURE)
    return mean, np.exp(-4.23) + np.sqrt((0.25 - (mean - 0.5) ** 2) / np.exp(3.62))


def measured_damping(strain):
    """Mean damping ratio [%], eqs 7.27 and 7.28, and its standard deviation, eq. 7.30."""
    a = CURVATURE
    masing = 100.0 / np.pi * (4.0 * (strain - np.log(1.0 + strain)) / (strain**2 / (1.0 + strain)) - 2.0)
    factors = (-1.1143 * a**2 + 1.8618 * a + 0.2523, 0.0805 * a**2 - 0.0710 * a - 0.0095, -0.0005 * a**2 + 0.0002 * a + 0.0003)
    adjusted = sum(factor * masing**power for power, factor in enumerate(factors, 1))
    mean = (0.6329 - 0.0057 * np.log(CYCLES)) * measured_modulus(strain)[0] ** 0.1 * adjusted + LEAST_DAMPING
    return mean, np.exp(-5.0) + np.exp(-0.25) * np.sqrt(mean)


def exponent():
    """Of Ramberg and Osgood's formula, whose damping is 2/pi (r - 1)/(r + 1) (1 - G/G0), such that it damps as measured at the reference strain."""
    largest = np.pi * 2.0 * (measured_damping(1.0)[0] - LEAST_DAMPING) / 100.0
    return (2.0 + largest) / (2.0 - largest)


def backbones():
    return {
        "hyperbolic": f'backbone = "hyperbolic"\nreference_strain = {REFERENCE}',
        "ramberg-osgood": f'backbone = "ramberg_osgood"\nreference_strain = {REFERENCE}\nramberg_osgood_exponent = {exponent()}\n'
        f"shear_strength = {10.0 * MODULUS * REFERENCE}",
    }


def cycle(backbone, strain, folder):
    """G/G0 and damping ratio [%] of the second cycle between two strains."""
    half = np.linspace(1.0, -1.0, 2 * STEPS + 1)[1:]
    course = np.concatenate([np.linspace(0.0, 1.0, STEPS + 1), half, -half, half, -half])
    moved = strain * REFERENCE * course
    (folder / "square.geo").write_text(SQUARE, encoding="utf-8")
    sazare.write_table(folder / "cycles.csv", {"time [s]": np.arange(len(moved), dtype=float), "displacement [m]": moved})
    text = CASE.format(folder=folder, young=2.5 * MODULUS, backbone=backbone, end=len(moved) - 1)
    history = sazare.run(text, folder / "run", overwrite=True).history
    stress = np.asarray(history["head.force_x"])[-4 * STEPS - 1 :]
    moved = moved[-4 * STEPS - 1 :]
    loss = abs(np.trapezoid(stress, moved))
    most = 0.5 * np.ptp(stress)
    return most / (strain * REFERENCE) / MODULUS, 100.0 * loss / (2.0 * np.pi * most * strain * REFERENCE)


def plot(found, path):
    import matplotlib  # noqa: PLC0415

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt  # noqa: PLC0415

    figure, axes = plt.subplots(1, 2, figsize=(10, 3.6), layout="constrained")
    strains = np.geomspace(0.03, 5.0, 100)
    for axis, measured, title in zip(axes, (measured_modulus, measured_damping), ("G/G0", "damping ratio [%]"), strict=True):
        mean, deviation = measured(strains)
        percent = 100 * REFERENCE * strains
        axis.fill_between(percent, mean - 2 * deviation, mean + 2 * deviation, color="0.85", label="measured, two standard deviations")
        axis.plot(percent, mean, "k", label="measured, mean")
        axis.set(xscale="log", xlabel="shear strain [%]", ylabel=title)
    for (name, answers), mark in zip(found.items(), "os", strict=True):
        for axis, number in zip(axes, (0, 1), strict=True):
            axis.plot([100 * REFERENCE * strain for strain in answers], [answer[number] for answer in answers.values()], mark, label=name)
    axes[1].legend(loc="upper left")
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plot", type=Path)
    chosen = parser.parse_args()
    found = {}
    with tempfile.TemporaryDirectory() as folder:
        for name, backbone in backbones().items():
            hysteresis = {strain: cycle(backbone, strain, Path(folder)) for strain in STRAINS}
            found[name] = {strain: (modulus, damping + LEAST_DAMPING) for strain, (modulus, damping) in hysteresis.items()}
    for name, answers in found.items():
        for strain, (modulus, damping) in answers.items():
            if strain != 1.0:  # there half of the stiffness is left by definition
                print(f"{name}-modulus-{strain:g},{modulus:.6g},{measured_modulus(strain)[0]:.6g}")
            if strain != 1.0 or name == "hyperbolic":  # the exponent is fitted there
                print(f"{name}-damping-{strain:g},{damping:.6g},{measured_damping(strain)[0]:.6g}")
    if chosen.plot:
        plot(found, chosen.plot)


if __name__ == "__main__":
    main()
