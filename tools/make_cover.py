"""Makes the picture at the head of the README: the whole specimen of the blast, with displacements magnified.

    python tools/make_cover.py [RUN]

RUN is the folder of a finished run of cases/free-face-blast-full; without it the case is run first, into build/gallery, which takes a minute
or so on two cores.
"""

import sys
from pathlib import Path

import numpy as np
from PIL import Image

import sazare
from sazare import scenes

ROOT = Path(__file__).resolve().parents[1]
TARGET = ROOT / "docs/gallery/cover.png"
SIZE = (1500, 1080)  # pixels, as drawn
KEPT = (1100, 792)  # pixels, as kept
MAGNIFICATION = 25.0
LONGEST = 0.5  # drawn displacement [m] beyond which a splinter has left the picture
DIRECTION = np.array([0.85, 0.55, 0.95])  # from which the specimen is seen


def magnified(grid):
    """The elements moved by their displacement [m] times the magnification, without splinters that have left the picture."""
    moved = grid.cell_data["displacement"]
    drawn = (MAGNIFICATION - 1.0) * moved
    kept = np.flatnonzero(np.linalg.norm(drawn, axis=1) < LONGEST)
    corners = grid.cells.reshape(-1, 5)[kept, 1:]
    points = np.asarray(grid.points)[corners] + drawn[kept, None, :]
    cells = np.hstack([np.full((len(kept), 1), 4), np.arange(points.size // 3).reshape(-1, 4)])
    mesh = scenes.pyvista.UnstructuredGrid(cells.ravel(), np.full(len(kept), scenes.pyvista.CellType.TETRA), points.reshape(-1, 3))
    mesh.cell_data["displacement"] = np.linalg.norm(moved[kept], axis=1)
    return mesh


def draw(grid, target):
    """Writes the picture of a snapshot's elements."""
    mesh = magnified(grid)
    limit = np.percentile(mesh.cell_data["displacement"], 97.0)
    plotter = scenes.pyvista.Plotter(off_screen=True, window_size=SIZE, lighting="three lights")
    plotter.set_background("white")
    plotter.add_mesh(
        mesh.extract_surface(), scalars="displacement", cmap="inferno_r", clim=(0.0, limit), show_scalar_bar=False,
        show_edges=True, edge_color="#3a2a20", line_width=0.7, ambient=0.3, diffuse=0.75,
    )
    centre = np.array(grid.bounds).reshape(3, 2).mean(axis=1)
    plotter.camera_position = [tuple(centre + 8.0 * DIRECTION / np.linalg.norm(DIRECTION)), tuple(centre), (0.0, 1.0, 0.0)]
    plotter.reset_camera()
    plotter.camera.zoom(1.45)
    image = Image.fromarray(plotter.screenshot(return_img=True)).resize(KEPT, Image.Resampling.LANCZOS)
    image.quantize(128).save(target, optimize=True)


def main(folder):
    """Runs the case where no folder of it is given, and draws its last snapshot."""
    if folder is None:
        folder = ROOT / "build/gallery/free-face-blast-full"
        sazare.run(ROOT / "cases/free-face-blast-full/case.toml", folder, overwrite=True)
    draw(sazare.open(folder).snapshots[-1].elements, TARGET)
    print(TARGET)


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
