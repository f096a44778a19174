"""Pictures of runs of method rectangles, from runs of the program where it is built."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

from sazare.methods import rectangles
from sazare.report import write_report
from sazare.results import open_run
from sazare.summary import headlines

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = ROOT / "build/release/apps/sazare/sazare"


@pytest.fixture(scope="module")
def beam_run(tmp_path_factory):
    """The mortar beam, loaded fast so that it breaks soon."""
    folder = tmp_path_factory.mktemp("beam") / "run"
    settings = ["rollers.2.velocity=[0,-0.1,0]", "time.end=0.004", "time.snapshot_interval=1e-3"]
    command = [PROGRAM, "run", ROOT / "cases/mortar-beam/case.toml", "--out", folder, "--quiet", "--threads", "1"]
    subprocess.run([*command, *(word for setting in settings for word in ("--set", setting))], check=True, timeout=120)
    return folder


def test_snapshots_hold_elements_and_supports(beam_run):
    grid = open_run(beam_run).square_snapshots[0].elements
    assert grid.n_cells == 144 + 3
    assert list(grid.cell_data["kind"][-3:]) == [rectangles.CIRCLE] * 3
    assert list(grid.cell_data["block"][-3:]) == [-1] * 3


def test_supports_are_named_in_the_order_of_the_case(beam_run):
    assert rectangles.support_names(open_run(beam_run)) == ["left", "right", "platen"]


def test_broken_faces_are_in_the_last_snapshot(beam_run):
    snapshots = open_run(beam_run).square_snapshots
    assert not snapshots[0].elements.cell_data["broken_faces"].any()
    assert snapshots[-1].elements.cell_data["broken_faces"].any()


def test_report_has_all_pictures(beam_run):
    page = write_report(beam_run)
    drawn = {path.name for path in (beam_run / "report").glob("*.png")}
    assert {"moving.png", "supports.png", "square_gauges.png", "energy.png"} <= drawn
    assert "broken springs" in page.read_text()
    assert any(row.name == "broken springs" for row in headlines(open_run(beam_run)))


def test_manifest_names_the_figures(beam_run):
    results = json.loads((beam_run / "manifest.json").read_text())["results"]
    assert {"elements", "steps", "step", "predicted_limit", "broken_springs", "broken_links", "peak_force_platen"} <= results.keys()
    assert abs(results["energy_residual"]) < 1e-3 * results["energy_work"]


def test_panels_follow_the_movement_and_have_prefixes(beam_run):
    figure = rectangles.moving(open_run(beam_run))
    titles = [axes.get_title(loc="left") for axes in figure.axes[:-1]]
    assert titles[0] == "0 s" and titles[-1] == "4 ms"
    assert "displacement [mm]" in figure.axes[-1].get_ylabel()


@pytest.fixture(scope="module")
def packing_run(tmp_path_factory):
    """The beam of irregular polygons, loaded fast so that it breaks soon."""
    folder = tmp_path_factory.mktemp("packing") / "run"
    settings = ["rollers.2.velocity=[0,-0.1,0]", "time.end=0.003", "time.snapshot_interval=1e-3"]
    command = [PROGRAM, "run", ROOT / "cases/irregular-beam/case.toml", "--out", folder, "--quiet", "--threads", "1"]
    subprocess.run([*command, *(word for setting in settings for word in ("--set", setting))], check=True, timeout=120)
    return folder


def test_snapshots_hold_polygons_that_fill_the_beam(packing_run):
    grid = open_run(packing_run).square_snapshots[0].elements
    kind = np.asarray(grid.cell_data["kind"])
    assert (kind[:-3] == rectangles.POLYGON).all()
    areas = [0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1))) for x, y in (c.T for c in rectangles._corners(grid))]
    assert np.sum(np.array(areas)[kind == rectangles.POLYGON]) == pytest.approx(0.16 * 0.04, rel=1e-6)


def test_cracks_of_polygons_are_shared_by_both_sides(packing_run):
    """At the moment of breaking both faces of a facet still lie beside one another."""
    grid = open_run(packing_run).square_snapshots[-1].elements
    cracks = rectangles._cracks(rectangles._corners(grid), np.asarray(grid.cell_data["kind"]), np.asarray(grid.cell_data["broken_faces"]))
    assert cracks and len(cracks) % 2 == 0
    lengths = np.sort([np.linalg.norm(ends[1] - ends[0]) for ends in cracks])
    assert lengths[::2] == pytest.approx(lengths[1::2], abs=1e-6)
    assert write_report(packing_run).exists()
