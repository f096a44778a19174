"""Discs of a set of joints, scattered at random: a Poisson process of centres in a box that is larger than the rock by the largest radius (Baecher's model).

G. B. Baecher, N. A. Lanney, H. H. Einstein, Statistical description of rock properties and sampling, 18th U.S. Symposium on Rock Mechanics (1977).
"""

import zlib

import numpy as np
from scipy.stats import poisson

from sazare.blast_model.joints import Disc
from sazare.blast_model.orientations import sample_normals
from sazare.blast_model.sheet import Problems

MOST_DRAWN = 1_000_000  # discs in the box around the rock
BEYOND = 1.11  # radius of the corners of a polygon over that of its circle, for six of them or more
MOST_DISCS = 300  # that reach into the rock, of one set: more than a mesh of tetrahedra can follow


def scattered(path, joint_set, layout):
    """The discs of a set that reach into the rock, in axes of the pattern. The same for the same seed, name and rock.

    Raises ValueError, at the line of the set in the table `path`, where there are more than a mesh can have.
    """
    scatter = joint_set.scatter
    reach = BEYOND * 0.5 * scatter.sizes.largest
    low, sides = layout.lower - reach, layout.upper - layout.lower + 2.0 * reach
    expected = scatter.p32 * float(np.prod(sides)) / scatter.sizes.mean_area
    if expected > MOST_DRAWN:
        _refuse(path, joint_set, expected)
    random = np.random.Generator(np.random.PCG64([scatter.seed, zlib.crc32(joint_set.name.encode())]))
    count = int(poisson.ppf(random.random(), expected))
    centres = low + sides * random.random((count, 3))
    normals = sample_normals(layout.frame.axes @ scatter.normal, scatter.fisher, random.random(count), random.random(count))
    radii = 0.5 * scatter.sizes.sample(random.random(count))
    near = _near(centres, normals, radii, layout)
    discs = [Disc(centres[i], normals[i], float(radii[i]), 0, joint_set.name) for i in np.flatnonzero(near)]
    discs = [disc for disc in discs if area_inside(disc.polygon(), layout) > 0.0]
    if len(discs) > MOST_DISCS:
        _refuse(path, joint_set, len(discs))
    return [disc.returned(layout.frame) for disc in discs]


def _refuse(path, joint_set, count):
    problems = Problems(path)
    problems.error(
        joint_set.line, f"the set {joint_set.name} has about {count:.0f} discs in and around the rock, more than the {MOST_DISCS} that a mesh can follow",
        "a smaller p32 or larger discs: a diameter_min of about the size of an element leaves out those that the mesh cannot tell from its own faces",
    )
    problems.tell()


def _near(centres, normals, radii, layout):
    """Whether the box around each disc reaches into that around the rock, (n,)."""
    reach = BEYOND * radii[:, None] * np.sqrt(np.maximum(0.0, 1.0 - normals**2))
    return np.all((centres + reach > layout.lower) & (centres - reach < layout.upper), axis=1)


def area_inside(polygon, layout):
    """Area [m2] of a polygon (n, 3) [m] of the model in its rock; holes count as rock."""
    return sum(polygon_area(clipped(polygon, planes)) for planes in layout.convex_parts)


def polygon_area(polygon):
    """Area of a flat polygon (n, 3)."""
    if len(polygon) < 3:
        return 0.0
    return 0.5 * float(np.linalg.norm(np.cross(polygon[1:-1] - polygon[0], polygon[2:] - polygon[0]).sum(axis=0)))


def clipped(polygon, planes):
    """What of a convex polygon (n, 3) lies inside of planes (k, 4). Sutherland and Hodgman (1974)."""
    for *normal, offset in planes:
        if len(polygon) == 0:
            return polygon
        above = polygon @ np.array(normal) - offset
        if np.all(above <= 0.0):
            continue
        corners = []
        for i in range(len(polygon)):
            before, here = above[i - 1], above[i]
            if (before > 0.0) != (here > 0.0):
                corners.append(polygon[i - 1] + before / (before - here) * (polygon[i] - polygon[i - 1]))
            if here <= 0.0:
                corners.append(polygon[i])
        polygon = np.array(corners).reshape(-1, 3)
    return polygon
