"""A slope of saturated sand on the shaking table of a centrifuge, by method fem, against its accelerations and pore pressures at four depths.

`main.py --plot FILE` draws them beside the measured ones.
"""

import argparse
import csv
import tempfile
from pathlib import Path

import numpy as np

import sazare
from sazare import ground_motion

RECORDS = Path(__file__).resolve().with_name("cu2-motion1.csv")
GRAVITY = 9.81  # m/s2
PRESSURES = {"P1": 4.0, "P2": 3.0, "P3": 2.0, "P4": 1.0}  # m below the surface
ACCELERATIONS = {"AH1": 3.5, "AH2": 2.5, "AH3": 1.5, "AH4": 0.5}  # m below the surface
BASE = ("AH11", "AH12")
STEP = 0.005  # s
SAMPLING = 0.04  # s, of the records
MEAN_OVER = 1.0  # s; of the pressures, one cycle of the table, which takes off their noise too
SOFT, LIQUID = 7.9, 10.7  # s; until then hardly any excess pressure was measured, from then on it hardly rises

HALF_LENGTH, DEPTH, TANGENT = 10.0, 4.0, np.tan(np.radians(5.0))  # m; depth at half the length
LAYERS, CELLS = 8, 20
WATER = 6.0  # m, level of the open water above the base
GRAINS, DRY = 2648.0, 1599.0  # kg/m3
RELATIVE_DENSITY = 48.0  # %
POISSON, FRICTION, DAMPING = 0.3, 33.0, 0.03  # -, deg, -

VOID_RATIO = GRAINS / DRY - 1.0
POROSITY = VOID_RATIO / (1.0 + VOID_RATIO)
SATURATED = DRY + 1000.0 * POROSITY  # kg/m3
CONDUCTIVITY = (0.0207 * VOID_RATIO - 0.0009) / 100.0  # m/s; El Ghoraiby and others (2017)
CONTRACTION = 7600.0 * RELATIVE_DENSITY**-2.5  # C1 of Byrne (1991)

SAND = """
[[materials]]
name = "{name}"
regions = ["{name}"]
density = {density}
saturated_density = {density}
water_table = {water}
drainage = "flow"
porosity = {porosity}
hydraulic_conductivity = {conductivity}
youngs_modulus = {young}
poisson_ratio = {poisson}
damping_ratio = {damping}
cohesion = 0.0
friction_angle = {friction}
contraction_rate = {contraction}
"""

CASE = """
[case]
title = "Slope in a centrifuge"
method = "fem"
[mesh]
file = "{folder}/slope.geo"
dimension = 2
{materials}
[damping]
f1 = 1.0
f2 = 10.0
[[water_pressures]]
name = "water"
group = "surface"
level = {water}
[[motions]]
name = "table"
type = "record"
file = "{folder}/table.csv"
baseline = "linear"
[[boundaries]]
group = "base"
kind = "prescribed"
motion_x = "table"
axes = ["y"]
[[boundaries]]
group = "walls"
kind = "prescribed"
motion_x = "table"
[gravity]
acceleration = [0.0, -{gravity}, 0.0]
settle = true
{gauges}
[time]
step = {step}
end = {end:.2f}
history_interval = {step}
snapshot_interval = {end:.2f}
"""


def read_records():
    """The measured columns by name without their units, and the time."""
    with open(RECORDS, newline="", encoding="utf-8") as file:
        header, *lines = csv.reader(file)
    columns = np.array(lines, dtype=float).T
    return {name.split(" ")[0]: column for name, column in zip(header, columns, strict=True)}


def vertical_stress(depth):
    """Of the grains at a depth before the motion [kPa]."""
    return (SATURATED - 1000.0) * GRAVITY * depth / 1e3


def shear_modulus(depth):
    """Of sand with round grains at small strain [Pa], Hardin and Richart (1963), at the mean stress of ground that cannot spread."""
    at_rest = POISSON / (1.0 - POISSON)
    mean = vertical_stress(depth) * (1.0 + 2.0 * at_rest) / 3.0
    return 6908e3 * (2.17 - VOID_RATIO) ** 2 / (1.0 + VOID_RATIO) * np.sqrt(mean)


def slope(layers=LAYERS, cells=CELLS):
    """Layers of one row of 8-node quadrilaterals each, from a level base to the slope."""
    ends = (DEPTH + HALF_LENGTH * TANGENT, DEPTH - HALF_LENGTH * TANGENT)
    lines = []
    for i in range(layers + 1):
        left, right = (end * i / layers for end in ends)
        lines.append(f"Point({10 * i + 1}) = {{{-HALF_LENGTH}, {left}, 0}}; Point({10 * i + 2}) = {{{HALF_LENGTH}, {right}, 0}};")
        lines.append(f"Line({10 * i + 1}) = {{{10 * i + 1}, {10 * i + 2}}}; Transfinite Curve{{{10 * i + 1}}} = {cells + 1};")
    for i in range(layers):
        low, high = 10 * i, 10 * (i + 1)
        lines.append(f"Line({low + 3}) = {{{low + 2}, {high + 2}}}; Line({low + 4}) = {{{high + 1}, {low + 1}}};")
        lines.append(f"Transfinite Curve{{{low + 3}, {low + 4}}} = 2;")
        lines.append(f"Curve Loop({i + 1}) = {{{low + 1}, {low + 3}, -{high + 1}, {low + 4}}}; Plane Surface({i + 1}) = {{{i + 1}}};")
        lines.append(f'Transfinite Surface{{{i + 1}}}; Recombine Surface{{{i + 1}}}; Physical Surface("sand-{i + 1}") = {{{i + 1}}};')
    walls = ", ".join(f"{10 * i + 3}, {10 * i + 4}" for i in range(layers))
    lines.append(f'Physical Curve("base") = {{1}}; Physical Curve("surface") = {{{10 * layers + 1}}}; Physical Curve("walls") = {{{walls}}};')
    lines.append("Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;")
    return "\n".join(lines) + "\n"


def materials():
    depths = DEPTH * (1.0 - (np.arange(LAYERS) + 0.5) / LAYERS)
    return "".join(
        SAND.format(name=f"sand-{i + 1}", density=SATURATED, water=WATER, porosity=POROSITY, conductivity=CONDUCTIVITY, poisson=POISSON,
                    young=2.0 * (1.0 + POISSON) * shear_modulus(depth), damping=DAMPING, friction=FRICTION, contraction=CONTRACTION)
        for i, depth in enumerate(depths)
    )


def calculate(measured, folder):
    """Ours under the names of the instruments, in g and kPa, and the time of the table."""
    (folder / "slope.geo").write_text(slope(), encoding="utf-8")
    began = measured["time"][0]
    table = GRAVITY * np.mean([measured[name] for name in BASE], axis=0)
    sazare.write_table(folder / "table.csv", {"time [s]": measured["time"] - began, "acceleration [m/s2]": table})
    depths = sorted({*PRESSURES.values(), *ACCELERATIONS.values()})
    gauges = "".join(f'[[gauges]]\nname = "{depth:g} m"\npoint = [0.0, {DEPTH - depth}, 0.0]\n' for depth in depths)
    end = measured["time"][-1] - began
    text = CASE.format(folder=folder, materials=materials(), water=WATER, gravity=GRAVITY, gauges=gauges, step=STEP, end=end)
    found = sazare.run(text, folder / "run", overwrite=True, progress=False).gauges
    times = np.asarray(next(iter(found.values())).time)
    ours = {"time": times + began}
    ours |= {name: np.asarray(found[f"{depth:g} m"].excess_pore_pressure) / 1e3 for name, depth in PRESSURES.items()}
    for name, depth in ACCELERATIONS.items():
        ours[name] = np.gradient(np.asarray(found[f"{depth:g} m"].velocity)[:, 0], times) / GRAVITY
    return ours


def mean_over(times, values):
    """Moving mean of what was recorded in even steps."""
    width = 2 * round(0.5 * MEAN_OVER / (times[1] - times[0])) + 1
    return np.convolve(np.pad(values, width // 2, mode="edge"), np.full(width, 1.0 / width), "valid")


def first_time(times, values, level):
    """At which the values first reach a level; not a number where they never do."""
    reached = np.flatnonzero(values >= level)
    if not len(reached) or not reached[0]:
        return np.nan
    after = reached[0]
    return float(np.interp(level, values[after - 1 : after + 1], times[after - 1 : after + 1]))


def spectrum(accelerations, periods):
    """Of 5 % damping [g], for records with the sampling of the test."""
    record = ground_motion.from_samples(SAMPLING, GRAVITY * accelerations)
    return np.asarray(ground_motion.response_spectrum(record, np.asarray(periods)).pseudo_acceleration) / GRAVITY


def rows(measured, ours):
    """Of row by row ours and the measured one."""
    for name, depth in PRESSURES.items():
        sets = [(data["time"], mean_over(data["time"], data[name])) for data in (ours, measured)]
        for part in (25, 50):
            yield f"pressure-{part}-{depth:g}", *(first_time(*one, part / 100.0 * vertical_stress(depth)) for one in sets)
        yield f"pressure-late-{depth:g}", *(data[name][data["time"] >= LIQUID].mean() for data in (ours, measured))
    times = measured["time"]
    soft, liquid = times < SOFT, times >= LIQUID
    for name, depth in ACCELERATIONS.items():
        pair = [np.interp(times, ours["time"], ours[name]), measured[name]]
        spectra = [spectrum(one, [1.0 / 3.0, 1.0]) for one in pair]
        yield f"spectrum-0.33-{depth:g}", *(one[0] for one in spectra)
        yield f"spectrum-1-{depth:g}", *(one[1] for one in spectra)
        if name == "AH4":
            yield f"soft-{depth:g}", *(spectrum(one[soft], [1.0 / 3.0])[0] for one in pair)
            yield f"upslope-{depth:g}", *(-one[liquid].min() for one in pair)


def plot(measured, ours, path):
    import matplotlib  # noqa: PLC0415

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt  # noqa: PLC0415

    figure, axes = plt.subplots(4, 3, figsize=(12.5, 8), layout="constrained", width_ratios=(1.2, 1.2, 0.7), sharex="col")
    periods = np.geomspace(0.1, 3.0, 80)
    pairs = zip(sorted(ACCELERATIONS.items(), key=lambda one: one[1]), sorted(PRESSURES.items(), key=lambda one: one[1]), strict=True)
    for (left, middle, right), ((motion, high), (pressure, low)) in zip(axes, pairs, strict=True):
        left.plot(measured["time"], measured[pressure], color="0.75", label="measured")
        left.plot(measured["time"], mean_over(measured["time"], measured[pressure]), "k", label="measured, mean over 1 s")
        left.plot(ours["time"], ours[pressure], label="ours")
        left.axhline(vertical_stress(low), color="k", linestyle=":", label="vertical stress of the grains")
        left.set(ylabel="excess pressure [kPa]", title=f"{pressure}, {low:g} m deep")
        middle.plot(measured["time"], measured[motion], "k", label="measured")
        middle.plot(ours["time"], ours[motion], label="ours", linewidth=1.0)
        middle.set(ylabel="acceleration [g]", title=f"{motion}, {high:g} m deep", ylim=(-0.25, 0.25))
        right.plot(periods, spectrum(measured[motion], periods), "k")
        right.plot(periods, spectrum(np.interp(measured["time"], ours["time"], ours[motion]), periods))
        base = np.mean([measured[name] for name in BASE], axis=0)
        right.plot(periods, spectrum(base, periods), color="k", linestyle=":", label="base")
        right.set(xscale="log", ylabel="spectrum, 5 % [g]", ylim=(0.0, 1.3))
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside upper center", ncols=4)
    axes[0, 2].legend()
    axes[3, 0].set_xlabel("time [s]")
    axes[3, 1].set_xlabel("time [s]")
    axes[3, 2].set_xlabel("period [s]")
    figure.savefig(path, dpi=75)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plot", type=Path)
    chosen = parser.parse_args()
    measured = read_records()
    with tempfile.TemporaryDirectory() as folder:
        ours = calculate(measured, Path(folder))
    for name, found, expected in rows(measured, ours):
        print(f"{name},{found:.6g},{expected:.6g}")
    if chosen.plot:
        plot(measured, ours, chosen.plot)


if __name__ == "__main__":
    main()
