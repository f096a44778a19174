"""Pictures of runs of method spheres, from a small folder made here."""

import json

import numpy as np
import pytest

from sazare.methods import spheres
from sazare.report import write_report
from sazare.results import open_run


@pytest.fixture
def granular_run(tmp_path):
    """A ball that falls along z onto a floor; no snapshots."""
    time = np.linspace(0.0, 1.0, 21)
    columns = [name for _, name in spheres.KINDS]
    rows = [[t, 1.0 - t, 0.1 * t, 0.0, 0.0, 0.0, 0.5 * t, 0.4 * t, 0.0, 1e-4 * t, 3.0, 2.0, 0.1] for t in time]
    head = ["time [s]", *(f"{name} [J]" for name in columns[:4]), "energy_potential [J]", *(f"{name} [J]" for name in columns[4:]),
            "energy_work_walls [J]", "energy_residual [J]", "contacts [-]", "speed_max [m/s]", "wall_seconds [s]"]
    _write(tmp_path / "history.csv", head, rows)
    gauge = [f"ball.{quantity}_{axis} [{unit}]" for quantity, unit in (("position", "m"), ("velocity", "m/s")) for axis in "xyz"]
    _write(tmp_path / "gauges.csv", ["time [s]", *gauge], [[t, 0.0, 0.0, 1.0 - t, 0.0, 0.0, -1.0] for t in time])
    wall = [f"floor.{quantity}_{axis} [{unit}]" for quantity, unit in (("force", "N"), ("moment", "N m")) for axis in "xyz"]
    _write(tmp_path / "walls.csv", ["time [s]", *wall], [[t, 0.0, 0.0, -5.0 * t, 0.0, 0.0, 0.0] for t in time])
    manifest = {"method": "spheres", "status": "done", "case": "drop",
                "results": {"particles": 1, "contacts": 3, "energy_work": 1.0, "energy_residual": 1e-4}}
    (tmp_path / "manifest.json").write_text(json.dumps(manifest))
    return tmp_path


def _write(path, head, rows):
    path.write_text("\n".join([",".join(head), *(",".join(f"{value:.9g}" for value in row) for row in rows)]) + "\n")


def test_groups_and_walls_are_drawn_along_their_main_axis(granular_run):
    results = open_run(granular_run)
    assert spheres.groups(results).axes[0].get_ylabel() == "z [m]"
    line = spheres.walls(results).axes[0].lines[0]
    assert line.get_label() == "floor, z"
    assert line.get_ydata()[-1] == pytest.approx(-5.0)


def test_report_has_its_pictures_and_says_what_is_missing(granular_run):
    page = write_report(granular_run).read_text()
    assert "The energy residual is 1.0e-04 of the reference energy." in page
    assert sorted(path.stem for path in (granular_run / "report").glob("*.png")) == ["contacts", "energies", "groups", "walls"]
    assert "The run wrote no snapshots." in page


def test_bonded_bodies_tell_how_many_broke(granular_run):
    manifest = json.loads((granular_run / "manifest.json").read_text())
    manifest["results"] |= {"bonds": 24, "broken_bonds": 3, "bodies": 2, "broken_bodies": 1, "fragments": 3}
    (granular_run / "manifest.json").write_text(json.dumps(manifest))
    _write(granular_run / "history.csv", ["time [s]", "broken_bonds [-]", "broken_bodies [-]"], [[0.0, 0, 0], [1.0, 3, 1]])
    _write(granular_run / "fragments.csv", ["fragment [-]", "elements [-]", "volume [m3]", "mass [kg]", "size [m]", "throw [m]"],
           [[0, 13, 2.0, 4.0, 1.6, 0.0], [1, 9, 1.5, 3.0, 1.4, 0.1], [2, 4, 0.5, 1.0, 1.0, 0.2]])
    results = open_run(granular_run)
    page = write_report(granular_run).read_text()
    assert "broken bodies" in page and "of 2, 50%" in page
    assert spheres.broken_bodies(results).axes[0].lines[0].get_ydata().tolist() == [0, 1]
    assert {"broken_bodies", "fragment_curve"} <= {path.stem for path in (granular_run / "report").glob("*.png")}


def test_a_run_without_bonded_bodies_has_no_such_picture(granular_run):
    assert spheres.broken_bodies(open_run(granular_run)) is None


def test_a_run_with_levels_tells_its_smallest_step(granular_run):
    manifest = json.loads((granular_run / "manifest.json").read_text())
    manifest["results"] |= {"step": 8e-6, "levels": 4, "smallest_step": 1e-6, "predicted_limit": 5e-6}
    (granular_run / "manifest.json").write_text(json.dumps(manifest))
    page = write_report(granular_run).read_text()
    assert "4 time levels, smallest step 1 µs, stability limit 5 µs" in page
