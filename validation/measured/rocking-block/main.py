"""A block that rocks freely: what is left of its angular velocity at each impact, as measured."""

import numpy as np

import sazare

WIDTH = 0.2  # m
MEASURED = {3: 0.97, 5: 0.95}  # by height over width: measured on concrete, over Housner's
RELEASED = 0.5  # tilt at the beginning over that of the balance point

CASE = """
[case]
title = "Rocking block"
method = "rectangles"
[[blocks]]
name = "block"
material = "concrete"
lower = [0.0, 0.0, 0.0]
upper = [{right}, {top}, 0.0]
angle = {degrees}
[[materials]]
name = "concrete"
density = 2400.0
face_normal_stiffness = 2e9
face_shear_stiffness = 2e9
[contact]
face_normal_stiffness = 2e9
face_shear_stiffness = 2e9
damping_ratio = 1.0
friction_angle = 60.0
[[walls]]
name = "floor"
from = [-5.0, 0.0, 0.0]
to = [5.0, 0.0, 0.0]
[gravity]
acceleration = [0.0, -9.81, 0.0]
[time]
end = {end}
"""


def left_after_impact(aspect, impacts=3):
    """Angular velocity after over before an impact, mean of the first ones, from the potential energies of the farthest tilts between them."""
    height = aspect * WIDTH
    slenderness = np.arctan(1.0 / aspect)
    end = 5.0 * (impacts + 1) * np.sqrt(0.5 * np.hypot(WIDTH, height) / 9.81)
    text = CASE.format(right=WIDTH, top=height, degrees=np.degrees(RELEASED * slenderness), end=end)
    centre = []
    with sazare.build(text) as run:
        while run.time < end:
            run.advance(2e-3)
            centre.append(run.positions[0, 1])
    raised = np.array(centre) - 0.5 * height
    tops = raised[1:-1][(raised[1:-1] > raised[:-2]) & (raised[1:-1] >= raised[2:])]
    return np.mean(np.sqrt(tops[:impacts] / np.r_[raised[0], tops[: impacts - 1]]))


def housner(aspect):
    """The same of a rigid block that keeps its angular momentum about its new foot: Housner, Bull. Seism. Soc. Am. 53 (1963) 403."""
    return 1.0 - 1.5 * np.sin(np.arctan(1.0 / aspect)) ** 2


def main():
    for aspect, measured in MEASURED.items():
        print(f"aspect-{aspect},{left_after_impact(aspect):.6g},{measured * housner(aspect):.6g}")


if __name__ == "__main__":
    main()
