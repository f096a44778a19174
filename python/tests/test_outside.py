"""The outside of meshes of every kind of cell in space."""

import numpy as np
import pyvista
import pytest

from sazare.outside import outside_of

EDGES = {
    pyvista.CellType.TETRA: ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)),
    pyvista.CellType.HEXAHEDRON: ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
}
QUADRATIC = {pyvista.CellType.TETRA: pyvista.CellType.QUADRATIC_TETRA, pyvista.CellType.HEXAHEDRON: pyvista.CellType.QUADRATIC_HEXAHEDRON}


def box(kind):
    """A cube of linear cells, 3 by 3 by 3 cubes."""
    cubes = pyvista.StructuredGrid(*np.meshgrid(*3 * [np.arange(4.0)], indexing="ij")).cast_to_unstructured_grid()
    return cubes if kind == pyvista.CellType.HEXAHEDRON else cubes.triangulate()


def quadratic(grid, kind):
    """The same cells with a node in the middle of every edge."""
    points, number, cells = [tuple(point) for point in grid.points], {}, []
    for corners in grid.cells_dict[kind]:
        middles = []
        for pair in EDGES[kind]:
            edge = tuple(sorted(corners[list(pair)]))
            if edge not in number:
                number[edge] = len(points)
                points.append(tuple(np.mean([points[end] for end in edge], axis=0)))
            middles.append(number[edge])
        cells.append([len(corners) + len(middles), *corners, *middles])
    return pyvista.UnstructuredGrid(np.concatenate(cells), [QUADRATIC[kind]] * len(cells), np.array(points))


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("kind", list(EDGES))
def test_every_triangle_is_a_part_of_a_face_of_its_cell(kind, order):
    grid = box(kind) if order == 1 else quadratic(box(kind), kind)
    outside = outside_of(grid)
    corners = np.asarray(grid.points)[outside.corners]
    for points, cell in zip(outside.corners, outside.cells, strict=True):
        assert set(points) <= set(grid.get_cell(cell).point_ids)
    areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    assert areas.sum() == pytest.approx(6 * 9.0)
    on_the_cube = np.isclose(corners, 0.0) | np.isclose(corners, 3.0)
    assert on_the_cube.all(axis=1).any(axis=1).all()
