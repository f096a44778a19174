"""Grains that flow through a hole in the floor of a silo, against Beverloo's law."""

import tempfile
from pathlib import Path

import numpy as np

import sazare

DIAMETER, DENSITY, GRAVITY = 0.005, 2500.0, 9.81  # m, kg/m3, m/s2
WIDTH, COUNT = 20, 8000  # of the square silo in grains, grains
HOLES = (6, 8)  # diameters in grains
FACTOR, LOST = 0.58, 1.4  # Beverloo's constants
STEADY_FROM, STEADY_TO = 0.1, 0.35  # s
SIDES = 64  # of the hole

CASE = """
[case]
title = "Silo"
method = "spheres"
[[materials]]
name = "glass"
density = {density}
youngs_modulus = 1.0e7
poisson_ratio = 0.25
[contact]
restitution = 0.6
friction_coefficient = 0.3
[[spheres]]
name = "grains"
material = "glass"
{source}
[[walls]]
name = "floor"
material = "glass"
{floor}
{sides}
[gravity]
acceleration = [0.0, 0.0, -9.81]
[time]
end = {end}
"""

CLOSED = "point = [0.0, 0.0, 0.0]\nnormal = [0.0, 0.0, 1.0]"


def sides():
    """The four walls as planes."""
    at = 0.5 * WIDTH * DIAMETER
    planes = [((-at, 0.0), (1.0, 0.0)), ((at, 0.0), (-1.0, 0.0)), ((0.0, -at), (0.0, 1.0)), ((0.0, at), (0.0, -1.0))]
    return "\n".join(
        f'[[walls]]\nname = "side {number}"\nmaterial = "glass"\npoint = [{x}, {y}, 0.0]\nnormal = [{along}, {across}, 0.0]'
        for number, ((x, y), (along, across)) in enumerate(planes, 1)
    )


def write_floor(hole, path):
    """A floor with a hole of a diameter [m], as triangles between the hole and a square wider than the silo, whose corners are among the rays."""
    angles = 2.0 * np.pi * (np.arange(SIDES) + 0.5) / SIDES
    angles = np.sort(np.r_[angles, np.pi * (0.25 + 0.5 * np.arange(4))])
    ray = np.column_stack([np.cos(angles), np.sin(angles), np.zeros(len(angles))])
    outer = 0.52 * WIDTH * DIAMETER * ray / np.abs(ray).max(axis=1, keepdims=True)
    inner = 0.5 * hole * ray
    lines = ["solid floor"]
    for this in range(len(ray)):
        following = (this + 1) % len(ray)
        for corners in ((inner[this], outer[this], outer[following]), (inner[this], outer[following], inner[following])):
            lines += ["facet normal 0 0 1", "outer loop", *(f"vertex {x:.9f} {y:.9f} {z:.9f}" for x, y, z in corners), "endloop", "endfacet"]
    path.write_text("\n".join([*lines, "endsolid floor"]) + "\n", encoding="utf-8")


def filled(folder):
    """Radii and places (n, 4) of the grains at rest, and the bulk density [kg/m3] away from floor and surface."""
    at = 0.5 * WIDTH * DIAMETER
    source = f'''source = "random"
radius = {0.475 * DIAMETER}
largest_radius = {0.525 * DIAMETER}
count = {COUNT}
rain = true
lower = [{-at}, {-at}, 0.0]
upper = [{at}, {at}, {50 * DIAMETER}]'''
    text = CASE.format(density=DENSITY, source=source, floor=CLOSED, sides=sides(), end=1e-3)
    grains = sazare.run(text, folder / "filled", overwrite=True).particle_snapshots[-1].elements
    radius, place = np.asarray(grains["radius"]), np.asarray(grains.points)
    low, high = 4.0 * DIAMETER, 0.8 * np.quantile(place[:, 2], 0.99)
    inside = (place[:, 2] > low) & (place[:, 2] < high)
    mass = DENSITY * 4.0 / 3.0 * np.pi * (radius[inside] ** 3).sum()
    return np.column_stack([radius, place]), mass / ((WIDTH * DIAMETER) ** 2 * (high - low))


def discharge(grains, hole, folder):
    """Mass flow [kg/s] while it is steady."""
    write_floor(hole * DIAMETER, folder / "floor.stl")
    np.savetxt(folder / "grains.csv", grains, delimiter=",", header="radius,x,y,z", comments="")
    source = f'source = "file"\nfile = "{folder}/grains.csv"'
    text = CASE.format(density=DENSITY, source=source, floor=f'shape = "mesh"\nfile = "{folder}/floor.stl"', sides=sides(), end=STEADY_TO)
    mass = DENSITY * 4.0 / 3.0 * np.pi * grains[:, 0] ** 3
    with sazare.build(text) as run:
        run.advance(STEADY_FROM)
        before = mass[run.positions[:, 2] < 0.0].sum()
        run.run()
        return (mass[run.positions[:, 2] < 0.0].sum() - before) / (STEADY_TO - STEADY_FROM)


def main():
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        grains, bulk = filled(folder)
        for hole in HOLES:
            law = FACTOR * bulk * np.sqrt(GRAVITY) * ((hole - LOST) * DIAMETER) ** 2.5
            print(f"hole-{hole},{discharge(grains, hole, folder):.6g},{law:.6g}")


if __name__ == "__main__":
    main()
