"""Pictures of runs of method spheres, from a small folder made here."""

import json
import subprocess
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from sazare.methods import spheres
from sazare.scenes import SolidView
from sazare.report import write_report
from sazare.results import open_run
from synthetic_run import write_grid

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = ROOT / "build/release/apps/sazare/sazare"


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


def cloud(points, radius=0.1):
    """Spheres of one radius at some places."""
    points = np.asarray(points, dtype=float)
    return SimpleNamespace(points=points, cell_data={"radius": np.full(len(points), radius)}, n_points=len(points))


def test_spheres_that_stay_together_have_one_frame():
    here = np.random.default_rng(1).random((300, 3))
    first, second = spheres.frames([cloud(here), cloud(here + [0.5, 0.0, 0.0])])
    assert np.array_equal(first, second)
    assert np.all(first[0] < 0.02) and first[1, 0] > 1.48


def test_spheres_that_fall_far_have_frames_that_follow_them():
    here = np.random.default_rng(1).random((300, 3))
    first, second = spheres.frames([cloud(here), cloud(here - [0.0, 0.0, 100.0])])
    assert np.ptp(first, axis=0).max() < 1.5 and np.ptp(second, axis=0).max() < 1.5
    assert second[1, 2] < -98.0


def test_spheres_that_run_out_of_a_silo_do_not_make_it_small():
    here = np.random.default_rng(1).random((300, 3))
    falling = here.copy()
    falling[:100, 2] -= np.linspace(1.0, 200.0, 100)
    _, second = spheres.frames([cloud(here), cloud(falling)])
    assert np.ptp(second, axis=0).max() <= spheres.MOST_OWN * 1.3
    view = SolidView(tuple(second.T.ravel()), np.array([1.0, -1.0, 1.0]))
    assert 80 < np.sum(~view.shows(falling)) <= 100


def test_single_large_spheres_count_by_their_volume():
    points = np.concatenate([np.random.default_rng(1).random((500, 3)), [[0.5, 0.5, 4.0]]])
    both = cloud(points, 0.02)
    both.cell_data["radius"][-1] = 0.5
    (frame,) = spheres.frames([both])
    assert frame[1, 2] == pytest.approx(4.5)


@pytest.fixture
def walled_run(granular_run):
    """The ball in two snapshots, above a plate of two triangles that was written once."""
    folder = granular_run / "snapshots"
    folder.mkdir()
    for number, height in enumerate((1.0, 0.1)):
        write_grid(folder / f"particles_{number:05d}.vtkhdf", np.array([[0.0, 0.0, height]]), np.array([[0]]), 1, float(number), {
            "velocity": np.array([[0.0, 0.0, -1.0]]), "angular_velocity": np.zeros((1, 3)), "radius": np.array([0.1]),
            "broken_fraction": np.zeros(1),
        })
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float)
    write_grid(folder / "walls_00000.vtkhdf", corners, np.arange(6).reshape(2, 3), 5, 0.0, {"wall": np.zeros(2, np.int32)})
    return open_run(granular_run)


def test_walls_of_triangles_are_drawn_and_are_no_bodies(walled_run):
    assert len(walled_run.wall_snapshots) == 1 and len(walled_run.all_snapshots) == 2
    frame = spheres._with_walls(np.array([[-0.1, -0.1, 0.0], [0.1, 0.1, 1.1]]), walled_run.wall_snapshots[0].elements)
    assert frame[0].tolist() == [-1.0, -1.0, 0.0] and frame[1, 0] == 1.0
    with_walls = [axes.images[0].get_array() for axes in spheres.pictures(walled_run).axes[:2]]
    for path in (walled_run.path / "snapshots").glob("walls*"):
        path.unlink()
    without = spheres.pictures(open_run(walled_run.path)).axes[0].images[0].get_array()
    assert with_walls[0].shape[1] > 1.2 * without.shape[1]


def test_walls_much_larger_than_the_spheres_are_cut_off():
    import pyvista

    ground = pyvista.Plane(i_size=100.0, j_size=100.0)
    frame = spheres._with_walls(np.array([[-1.0, -1.0, 0.0], [1.0, 1.0, 1.0]]), ground)
    assert frame[:, 0].tolist() == [-1.5, 1.5]
    surface, edges = spheres._wall_layers(ground.cast_to_unstructured_grid(), frame)
    assert np.abs(np.array(surface.mesh.bounds)[:4]).max() == pytest.approx(1.5)
    assert surface.options["opacity"] < 0.5


@pytest.fixture(scope="module")
def drum_run(tmp_path_factory):
    """The rotating drum, for two snapshots."""
    folder = tmp_path_factory.mktemp("drum") / "run"
    settings = ["time.end=0.04", "time.snapshot_interval=0.04"]
    command = [PROGRAM, "run", ROOT / "cases/rotating-drum/case.toml", "--out", folder, "--quiet", "--threads", "1"]
    subprocess.run([*command, *(word for setting in settings for word in ("--set", setting))], check=True, timeout=120)
    return folder


def test_a_run_writes_its_walls_of_triangles_where_they_are(drum_run):
    first, last = (np.asarray(snapshot.elements.points) for snapshot in open_run(drum_run).wall_snapshots)
    angle = 3.0 * 0.04  # rad about the y axis
    turn = np.array([[np.cos(angle), 0.0, np.sin(angle)], [0.0, 1.0, 0.0], [-np.sin(angle), 0.0, np.cos(angle)]])
    np.testing.assert_allclose(last, first @ turn.T, atol=1e-9)
    assert np.hypot(first[:, 0], first[:, 2]) == pytest.approx(0.1, rel=1e-5)
