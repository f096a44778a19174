"""The outside of meshes, as triangles."""

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True)
class Outside:
    """Triangles on the outside of a mesh: numbers of their points (n, 3) and of their cells (n,) in the mesh."""

    corners: Any
    cells: Any


def outside_of(grid):
    """The Outside of an unstructured grid; faces of quadratic cells are divided at the nodes on their sides.

    The numbers are carried along as data: the vtkOriginalCellIds of VTK 9.5 are wrong for quadratic cells.
    """
    numbered = grid.copy(deep=False)
    numbered.clear_data()
    numbered.cell_data["number"], numbered.point_data["number"] = np.arange(grid.n_cells), np.arange(grid.n_points)
    surface = numbered.extract_surface(nonlinear_subdivision=1).triangulate()
    corners = np.asarray(surface.faces).reshape(-1, 4)[:, 1:]
    return Outside(np.asarray(surface.point_data["number"])[corners], np.asarray(surface.cell_data["number"]))


def outer_faces(grid):
    """Triangles (n, 3, 3) [m] on the outside of a grid, and the number of the cell of each."""
    outside = outside_of(grid)
    return np.asarray(grid.points)[outside.corners], outside.cells
