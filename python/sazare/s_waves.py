"""How fast S waves of small strains are in the ground of a run, and how long they take from place to place."""

import math

import numpy as np
from scipy.spatial import cKDTree

from sazare.ground_motion.gauges import case_of
from sazare.model.parts import Opened, region_names

VERTEX = 1  # a cell that is a particle, as VTK numbers them
LEVELS = 400  # at which a vertical line looks for the velocity


def _speed(material):
    """The S-wave velocity [m/s] of a material of a case."""
    if "s_wave_velocity" in material:
        return material["s_wave_velocity"]
    return math.sqrt(material["youngs_modulus"] / (2.0 * (1.0 + material["poisson_ratio"]) * material["density"]))


def s_velocities(results, grid):
    """The S-wave velocity of small strains [m/s] in every cell of a snapshot (n,); None where case and mesh do not tell."""
    opened = Opened(results, case_of(results))
    try:
        speeds = {material["name"]: _speed(material) for material in opened.all("materials")}
        if "material" in grid.cell_data:
            return np.array(list(speeds.values()))[np.asarray(grid.cell_data["material"])]
        found = [speeds[opened.material_of(name)] for name in region_names(opened)]
        return np.array(found)[np.asarray(grid.cell_data["region"])]
    except (KeyError, IndexError, TypeError, ValueError):
        return None


def centres(grid):
    """The middle of every cell at the beginning [m] (n, 3)."""
    if int(np.asarray(grid.celltypes)[0]) == VERTEX:
        return np.asarray(grid.points) - np.asarray(grid.cell_data["displacement"])
    return np.asarray(cells_at_rest(grid).cell_centers().points)


def cells_at_rest(grid):
    """The cells of finite elements where they are at the beginning."""
    before = grid.copy(deep=False)
    before.points = np.asarray(grid.points) - np.asarray(grid.point_data["displacement"])
    return before


def travel_times(grid, speeds, line):
    """Travel times [s] (n,) from the first of some places on a line [m] (n, 3) to each of them, by the velocities of the cells of a snapshot [m/s]."""
    _, nearest = cKDTree(centres(grid)).query(0.5 * (line[1:] + line[:-1]))
    return np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1) / speeds[nearest])])
