"""Columns of grains that are let go on a level floor, by spheres and by moving particles, against run-outs that were measured.

`main.py --plot FILE` draws the deposits and the run-outs beside the laws of the experiments.
"""

import argparse
import tempfile
from pathlib import Path

import numpy as np

import sazare

CASE = Path(__file__).resolve().parents[3] / "cases/column-collapse-mps/case.toml"
ASPECTS = (1, 2, 4)
GRAVITY = 9.81  # m/s2
DIAMETER, HALF_WIDTH, THICKNESS = 0.005, 0.05, 0.025  # m; of the mean grain, of the column, of the periodic slice
BIN = 2  # grains in the width of a bin, beside which single grains leave no empty ones
LUBE_BENDS = 2.3  # h/r; between 1.8 and 2.8 as the authors say
SOLID = 0.6  # volume of the grains over that of a deposit, for the number of grains and for what covers the floor

GRAINS = """
[case]
title = "Column of grains"
method = "spheres"
[domain]
periodic = ["y"]
lower = [0.0, 0.0, 0.0]
upper = [0.0, {thickness}, 0.0]
[[materials]]
name = "grain"
density = 2500.0
youngs_modulus = 1.0e7
poisson_ratio = 0.3
[contact]
restitution = 0.5
friction_coefficient = 0.5
rolling_friction = 0.1
[[spheres]]
name = "grains"
material = "grain"
{source}
[[walls]]
name = "floor"
material = "grain"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
{sides}
[gravity]
acceleration = [0.0, 0.0, -9.81]
[time]
end = {end}
"""

SIDES = """
[[walls]]
name = "left"
material = "grain"
point = [-{at}, 0.0, 0.0]
normal = [1.0, 0.0, 0.0]
[[walls]]
name = "right"
material = "grain"
point = [{at}, 0.0, 0.0]
normal = [-1.0, 0.0, 0.0]
"""


def front(place, volume, width, floor):
    """How far a deposit reaches: to the last of the bins beside each other, from the middle outwards, that hold half of a layer of grains.

    place: distances from the middle (n,) [m], volume: of the grains (n,) [m3 or m2], width: of a bin [m], floor: what a layer that covers a
    bin holds [m3 or m2]."""
    ends = []
    for side in (place, -place):
        filled = np.bincount((side[side >= 0.0] / width).astype(int), volume[side >= 0.0]) >= 0.5 * floor
        ends.append(width * (len(filled) if filled.all() else np.argmin(filled)))
    return float(np.mean(ends))


def settled(height, folder):
    """A column that came to rest between two walls, cut at a height: a table of radius, x, y, z."""
    count = int(1.15 * SOLID * 2.0 * HALF_WIDTH * THICKNESS * height / (np.pi / 6.0 * DIAMETER**3))
    source = f'''source = "random"
radius = {0.45 * DIAMETER}
largest_radius = {0.55 * DIAMETER}
count = {count}
rain = true
lower = [-{HALF_WIDTH}, 0.0, 0.0]
upper = [{HALF_WIDTH}, {THICKNESS}, {2.2 * height}]'''
    text = GRAINS.format(thickness=THICKNESS, source=source, sides=SIDES.format(at=HALF_WIDTH), end=1e-3)
    done = sazare.run(text, folder / f"settled-{height:.3f}", overwrite=True)
    grains = done.particle_snapshots[-1].elements
    radius = np.asarray(grains["radius"])
    place = np.asarray(grains.points)
    keep = place[:, 2] < height
    if keep.all():
        raise RuntimeError("the column is too low")
    return np.column_stack([radius, place])[keep]


def spheres(aspect, folder):
    """Run-out over half width, and the deposit (x, z) in half widths."""
    height = aspect * HALF_WIDTH
    grains = settled(height, folder)
    np.savetxt(folder / f"column-{aspect}.csv", grains, delimiter=",", header="radius,x,y,z", comments="")
    source = f'source = "file"\nfile = "{folder}/column-{aspect}.csv"'
    text = GRAINS.format(thickness=THICKNESS, source=source, sides="", end=8.0 * np.sqrt(height / GRAVITY))
    with sazare.build(text) as run:
        run.run()
        place = np.array(run.positions)
    volume = 4.0 / 3.0 * np.pi * grains[:, 0] ** 3
    width = BIN * DIAMETER
    reach = front(place[:, 0], volume, width, SOLID * width * DIAMETER * THICKNESS)
    return (reach - HALF_WIDTH) / HALF_WIDTH, place[:, [0, 2]] / HALF_WIDTH


def particles(aspect):
    """The same by the case of moving particles, whose half width is 1 m."""
    case = sazare.read_case(CASE)
    spacing = case.particles.spacing
    column, floor = case.regions
    column.upper = (1.0, float(aspect), 0.0)
    floor.lower, floor.upper = (-14.0, -2.0 * spacing, 0.0), (14.0, 0.0, 0.0)
    case.time.end = case.time.snapshot_interval * np.ceil(8.0 * np.sqrt(aspect / GRAVITY) / case.time.snapshot_interval)
    with sazare.build(case) as run:
        start = np.array(run.positions)
        run.run()
        place = np.array(run.positions)[start[:, 1] > 0.0]
    reach = front(place[:, 0], np.full(len(place), spacing**2), BIN * spacing, BIN * spacing**2)
    return reach - 1.0, place[:, :2]


def laws(aspect):
    """Run-outs that Lube and others (2005) and Lajeunesse and others (2005) measured, over the half width."""
    lube = np.where(aspect < LUBE_BENDS, 1.2 * aspect, 1.9 * aspect ** (2 / 3))
    return lube, np.where(aspect < 3.0, 1.8 * aspect, 2.3 * aspect ** (2 / 3))


def plot(found, path):
    import matplotlib  # noqa: PLC0415

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt  # noqa: PLC0415

    panels = [["spheres", "laws"], ["moving particles", "laws"]]
    figure, axes = plt.subplot_mosaic(panels, figsize=(11, 4.2), layout="constrained", width_ratios=(2, 1))
    aspects = np.linspace(0.8, 5.0, 400)
    axes["laws"].fill_between(aspects, *laws(aspects), color="0.85", label="Lube (2005) to Lajeunesse (2005)")
    for (method, answers), mark in zip(found.items(), "os", strict=True):
        axes["laws"].plot(answers.keys(), [reach for reach, _ in answers.values()], mark, markerfacecolor="none", markersize=8, label=method)
        for aspect, (_, deposit) in reversed(answers.items()):
            axes[method].plot(*deposit.T, ".", markersize=2, label=f"h/r = {aspect}")
        axes[method].set(title=method, aspect="equal", xlabel="x/r", ylabel="y/r", xlim=(-12, 12), ylim=(-0.2, 3.5))
        axes[method].legend(markerscale=4, ncols=3)
    axes["laws"].set(xlabel="h/r", ylabel="run-out/r", xlim=(0, 5), ylim=(0, 9))
    axes["laws"].legend(loc="upper left")
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plot", type=Path)
    chosen = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        found = {"spheres": {aspect: spheres(aspect, Path(folder)) for aspect in ASPECTS}}
    found["moving particles"] = {aspect: particles(aspect) for aspect in ASPECTS}
    for method, answers in found.items():
        for aspect, (reach, _) in answers.items():
            print(f"{'spheres' if method == 'spheres' else 'mps'}-{aspect},{reach:.6g}")
    if chosen.plot:
        plot(found, chosen.plot)


if __name__ == "__main__":
    main()
