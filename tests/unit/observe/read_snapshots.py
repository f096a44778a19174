"""Reads the snapshots of write_snapshots back with pyvista: python read_snapshots.py WRITER FOLDER."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pyvista


def main(writer: str, folder: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    subprocess.run([writer, str(folder)], check=True)

    listed = json.loads((folder / "elements.vtkhdf.series").read_text())["files"]
    assert [entry["time"] for entry in listed] == [0.0, 2.5e-5, 5e-5], listed
    for number, entry in enumerate(listed):
        elements = pyvista.read(folder / entry["name"])
        assert isinstance(elements, pyvista.UnstructuredGrid), type(elements)
        assert elements.points.dtype == np.float64
        np.testing.assert_array_equal(elements.points[1], [1.0 + number, 0, 0])
        np.testing.assert_array_equal(elements.cells_dict[pyvista.CellType.TETRA], [[0, 1, 2, 3], [1, 2, 3, 4]])
        assert sorted(elements.cell_data) == ["level", "velocity"], sorted(elements.cell_data)
        assert elements.cell_data["level"].dtype == np.int32
        np.testing.assert_array_equal(elements.cell_data["level"], [3, -5])
        np.testing.assert_array_equal(elements.cell_data["velocity"], [[1, 2, 3], [4, 5, 1 / 3]])
        np.testing.assert_array_equal(elements.field_data["time"], [entry["time"]])
        assert elements.volume > 0

    joints = pyvista.read(folder / "joints_00000.vtkhdf")
    np.testing.assert_array_equal(joints.cells_dict[pyvista.CellType.TRIANGLE], [[1, 2, 3]])
    np.testing.assert_array_equal(joints.cell_data["state"], [2])

    empty = pyvista.read(folder / "empty.vtkhdf")
    assert empty.n_points == 0 and empty.n_cells <= 0  # VTK 9.5 counts -1 cells in a grid without any


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
