"""The 3-D view of the report: what is packed is what the snapshots hold, and a browser shows it without a network."""

import base64
import json
import re
import shutil
import subprocess
import zlib
from types import SimpleNamespace

import numpy as np
import pytest
import pyvista
from matplotlib.colors import to_rgb
from matplotlib.image import imread

import sazare
from sazare import style
from sazare.report import write_report
from sazare.view3d import _bulk_range, _range, _shapes, packed_view, read_frames

CHROMIUM = next((found for name in ("chromium", "chromium-browser", "google-chrome") if (found := shutil.which(name))), None)


def unpacked(view, name):
    block = view["blocks"][name]
    return np.frombuffer(zlib.decompress(base64.b64decode(block["data"])), dtype=block["type"])


def test_places_and_fields_are_those_of_the_snapshots(slab):
    results = sazare.open(slab)
    view, frames = json.loads(packed_view(results)), read_frames(results)
    count, times = len(frames.start), len(view["times"])
    assert np.allclose(view["times"], results.snapshots.times)
    start = unpacked(view, "start").reshape(-1, 3)
    low, high = view["displacement"]["low"], view["displacement"]["high"]
    moved = low + (high - low) / 65535 * unpacked(view, "displacement").reshape(times, count, 3)
    points = results.snapshots[-1].elements.points[frames.shapes.points]
    assert np.allclose(start + moved[-1], points, atol=2e-5 * (high - low) + 1e-6)
    speed = view["fields"][0]
    assert (speed["name"], speed["unit"]) == ("speed", "m/s")
    shown = speed["low"] + (speed["high"] - speed["low"]) / 255 * unpacked(view, "field0").reshape(times, -1)[-1]
    true = np.linalg.norm(results.snapshots[-1].elements.cell_data["velocity"], axis=1)[frames.shapes.cells]
    assert np.allclose(shown, np.minimum(true, speed["high"]), atol=speed["high"] / 255)


def test_the_outside_and_the_broken_faces_are_drawn(slab):
    results = sazare.open(slab)
    grid, joints = results.snapshots[0].elements, results.snapshots[-1].joints
    triangles = read_frames(results).shapes.triangles
    outside = grid.clean(tolerance=1e-9).extract_surface().n_cells
    broken = int(np.sum(np.asarray(joints.cell_data["state"]) == 2))
    assert broken > 0
    assert len(triangles) == outside + 2 * broken, "both sides of a broken joint"


def test_every_triangle_has_the_colour_of_its_element(slab):
    shapes = read_frames(sazare.open(slab)).shapes
    cells = shapes.cell_of_point[shapes.triangles]
    assert np.all(cells == cells[:, :1])


def test_of_any_other_grid_the_outside_is_drawn():
    grid = pyvista.ImageData(dimensions=(4, 3, 3)).cast_to_unstructured_grid()
    shapes = _shapes([SimpleNamespace(elements=grid, joints=None)])
    faces = 2 * (3 * 2 + 3 * 2 + 2 * 2)
    assert len(shapes.triangles) == 2 * faces
    corners = np.asarray(grid.points)[shapes.points][shapes.triangles]
    area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1).sum()
    assert area == pytest.approx(faces)


def test_cells_that_share_points_keep_their_colours():
    """Two squares of eight nodes, side by side: three points are of both."""
    ring = [[0, 0], [2, 0], [2, 2], [0, 2], [1, 0], [2, 1], [1, 2], [0, 1]]
    points = np.array([*ring, [4, 0], [4, 2], [3, 0], [4, 1], [3, 2]], dtype=float)
    cells = [8, 0, 1, 2, 3, 4, 5, 6, 7, 8, 1, 8, 9, 2, 10, 11, 12, 5]
    grid = pyvista.UnstructuredGrid(cells, [23, 23], np.c_[points, np.zeros(len(points))])
    shapes = _shapes([SimpleNamespace(elements=grid)])
    colours = shapes.cells[shapes.cell_of_point[shapes.triangles]]
    assert np.all(colours == colours[:, :1]) and set(colours[:, 0]) == {0, 1}
    middles = grid.points[shapes.points][shapes.triangles].mean(axis=1)
    assert np.all((middles[:, 0] > 2.0) == (colours[:, 0] == 1))


def test_stresses_are_coloured_by_the_bulk_of_them():
    frames = np.stack([np.linspace(0.0, 50.0, 1000), np.linspace(-10.0, 100.0, 1000)])
    frames[:, -40:] = 9000.0  # more than two in a hundred
    low, high = _bulk_range(frames)
    assert -10.0 <= low < 0.0 and 100.0 < high < 300.0
    assert _range(frames)[1] == 9000.0


def test_a_run_without_snapshots_has_no_view(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run", ignore=shutil.ignore_patterns("snapshots"))
    assert packed_view(sazare.open(copy)) is None
    assert 'class="view3d"' not in write_report(copy).read_text()


@pytest.fixture(scope="module")
def page(slab, tmp_path_factory):
    """The page of the slab's report."""
    return write_report(shutil.copytree(slab, tmp_path_factory.mktemp("browser") / "run"))


def test_the_page_asks_for_nothing_from_outside(page):
    text = page.read_text()
    assert 'class="view3d"' in text
    assert not re.search(r"<(?:script|link|img|iframe)[^>]+(?:src|href)\s*=\s*\"(?!data:)", text)
    assert "import(" not in text and "fetch(\"" not in text


def screen(page, address, folder):
    """What a browser without network shows of a page: the picture (h, w, 3), and the document."""
    options = [
        CHROMIUM, "--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
        "--window-size=1200,1000", "--virtual-time-budget=10000", "--proxy-server=127.0.0.1:9", f"--user-data-dir={folder / 'profile'}",
    ]
    picture = folder / "screen.png"
    target = f"{page.as_uri()}#{address}"
    subprocess.run([*options, f"--screenshot={picture}", target], check=True, capture_output=True, timeout=120)
    document = subprocess.run([*options, "--dump-dom", target], check=True, capture_output=True, text=True, timeout=120).stdout
    return imread(picture)[..., :3], document


def share_of(image, colour, tolerance):
    """Share of the pixels that are near a colour."""
    return float(np.mean(np.linalg.norm(image - np.array(colour), axis=-1) < tolerance))


def share_that_differs(one, other):
    """Share of the pixels that are not alike in two pictures."""
    return float(np.mean(np.abs(one - other).max(axis=-1) > 0.01))


@pytest.mark.skipif(CHROMIUM is None, reason="no Chromium here: scripts/setup browser installs it")
def test_a_browser_shows_the_body_and_its_motion(page, tmp_path):
    images = {}
    for address in ("view=0,0", "view=99,0", "view=99,99"):
        folder = tmp_path / address.replace(",", "-")
        folder.mkdir()
        images[address], document = screen(page, address, folder)
        assert 'data-state="ready"' in document
        assert "<canvas" in document
    first, last, other = (image[300:850, 80:1120] for image in images.values())
    body = ~np.all(last > 0.97, axis=-1)
    assert 0.1 < body.mean() < 0.95, "a body before a white ground"
    assert share_of(first, to_rgb(style.STONE), 0.35) > 0.1, "at the start all of it has the colour of rest"
    assert share_that_differs(first, last) > 0.05, "time changes the picture"
    assert share_that_differs(other, last) > 0.02, "the last field, another picture than the first"
