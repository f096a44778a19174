"""Reading the folder of a run."""

import json
import os
import shutil

import numpy as np
import pytest

import sazare
from sazare.tables import read_table


def test_tables_are_columns_by_name_with_units(slab):
    history = sazare.open(slab).history
    assert list(history)[:3] == ["time", "broken_joints", "fragments"]
    assert history.unit("time") == "s" and history.unit("broken_joints") == "-"
    assert history["time"][-1] == pytest.approx(5e-4)
    assert history.rows == 101
    balance = sum(history[name] for name in history if name.startswith("energy_") and name != "energy_work")
    assert balance == pytest.approx(history["energy_work"])


def test_a_column_of_words_stays_words(slab):
    timing = sazare.open(slab).timing
    assert timing["part"][0] == "joints"
    assert timing["share"].sum() == pytest.approx(1.0)


def test_gauges_have_their_peak(slab):
    gauges = sazare.open(slab).gauges
    assert list(gauges) == ["G1", "G2"]
    gauge = gauges["G1"]
    assert gauge.velocity.shape == (101, 3)
    assert gauge.ppv == pytest.approx(np.abs(gauge.velocity).max() / 0.8)


def test_a_gauge_may_have_dots_in_its_name(tmp_path):
    (tmp_path / "manifest.json").write_text("{}")
    (tmp_path / "gauges.csv").write_text(
        "time [s],no. 1.velocity_x [m/s],no. 1.velocity_y [m/s],no. 1.velocity_z [m/s]\n0,3,4,0\n"
    )
    assert sazare.open(tmp_path).gauges["no. 1"].ppv == 5.0


def test_a_gauge_in_saturated_ground_has_its_excess_pore_pressure(tmp_path):
    (tmp_path / "manifest.json").write_text("{}")
    (tmp_path / "gauges.csv").write_text(
        "time [s],sand.velocity_x [m/s],sand.velocity_y [m/s],sand.velocity_z [m/s],wall.velocity_x [m/s],wall.velocity_y [m/s],wall.velocity_z [m/s],"
        "sand.excess_pore_pressure [Pa]\n0,0,0,0,0,0,0,5e3\n1,0,0,0,0,0,0,-2e3\n"
    )
    gauges = sazare.open(tmp_path).gauges
    assert gauges["sand"].excess_pore_pressure.tolist() == [5e3, -2e3]
    assert gauges["wall"].excess_pore_pressure is None


def test_snapshots_are_meshes_by_time(slab):
    snapshots = sazare.open(slab).snapshots
    assert snapshots.times == pytest.approx(np.linspace(0.0, 5e-4, 6))
    snapshot = snapshots.at(3.1e-4)
    assert snapshot.time == pytest.approx(3e-4)
    assert snapshot.elements.n_cells == 720
    assert set(np.unique(snapshot.joints.cell_data["state"])) == {0, 1, 2}
    assert snapshot.elements.field_data["time"][0] == pytest.approx(3e-4)
    assert snapshot.elements.volume == pytest.approx(1.2 * 1.0 * 0.15, rel=0.05)


def test_a_run_stays_open_where_the_folder_changes(slab, tmp_path, monkeypatch):
    monkeypatch.chdir(slab.parent)
    results = sazare.open(slab.name)
    monkeypatch.chdir(tmp_path)
    assert results.history.rows == sazare.open(slab).history.rows > 0


def test_snapshots_are_found_without_their_list(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run")
    (copy / "snapshots" / "elements.vtkhdf.series").unlink()
    assert sazare.open(copy).snapshots.times == pytest.approx(np.linspace(0.0, 5e-4, 6))


def test_listed_snapshots_that_are_not_there_are_left_out(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run")
    (copy / "snapshots" / "elements_00005.vtkhdf").unlink()
    assert len(sazare.open(copy).snapshots) == 5


def test_what_a_run_did_not_write_reads_as_empty(tmp_path):
    (tmp_path / "manifest.json").write_text(json.dumps({"case": "Bare", "status": "failed"}))
    run = sazare.open(tmp_path)
    assert (run.title, run.figures, run.gauges, run.case_text) == ("Bare", {}, {}, "")
    assert run.history.rows == run.fragments.rows == len(run.snapshots) == 0
    with pytest.raises(sazare.NotARun, match="the run has no snapshots"):
        run.snapshots.at(0.0)


def test_the_cut_last_line_of_a_killed_run_is_left_out(tmp_path):
    path = tmp_path / "history.csv"
    path.write_text("time [s],broken_joints [-]\n0,1\n1,2\n2")
    assert read_table(path)["time"].tolist() == [0.0, 1.0]


@pytest.mark.parametrize(
    "text, words",
    [
        ("", "history.csv: the file is empty; a run writes a header line first"),
        ("time [s],a [-]\n0,1\n1\n2,3\n", "history.csv:3: 1 values where the header names 2 columns"),
    ],
)
def test_damaged_tables_are_refused(tmp_path, text, words):
    (tmp_path / "history.csv").write_text(text)
    with pytest.raises(sazare.NotARun) as error:
        _ = sazare.open(tmp_path).history
    assert words in str(error.value)


def test_folders_that_are_no_run_are_refused(tmp_path):
    with pytest.raises(sazare.NotARun, match="no such folder; a run makes one: sazare run CASE --out"):
        sazare.open(tmp_path / "absent")
    with pytest.raises(sazare.NotARun, match="neither manifest.json, history.csv nor snapshots/ is in it"):
        sazare.open(tmp_path)
    (tmp_path / "file").touch()
    with pytest.raises(sazare.NotARun, match="not a folder; give the folder of a run"):
        sazare.open(tmp_path / "file")


def test_damaged_files_are_named(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run")
    (copy / "manifest.json").write_text("{")
    with pytest.raises(sazare.NotARun, match="manifest.json: not valid JSON"):
        _ = sazare.open(copy).manifest
    (copy / "snapshots" / "elements.vtkhdf.series").write_text("[]")
    with pytest.raises(sazare.NotARun, match="elements.vtkhdf.series: not a list of snapshots"):
        _ = sazare.open(copy).snapshots
    (copy / "snapshots" / "elements.vtkhdf.series").unlink()
    (copy / "snapshots" / "elements_00000.vtkhdf").write_bytes(b"not HDF5")
    with pytest.raises(sazare.NotARun, match="elements_00000.vtkhdf: not a readable VTKHDF file"):
        _ = sazare.open(copy).snapshots


def test_a_table_becomes_a_frame_of_pandas(slab):
    table = sazare.open(slab).history
    frame = table.to_pandas()
    assert list(frame.columns) == list(table)
    assert np.array_equal(frame["time"].to_numpy(), table["time"])
    assert frame.attrs["units"]["time"] == "s"


def test_a_run_compared_with_itself_is_the_same(slab):
    compared = sazare.compare(slab, sazare.open(slab))
    assert compared.largest_difference == 0.0
    assert compared.same_bits is (True if sazare.open(slab).manifest.get("state_hash") else None)
    assert all(first == second for first, second in compared.figures.values())
    assert compared.ppv == {name: (peak, peak) for name, peak in sazare.open(slab).figures["ppv"].items()}
    for gauge in compared.ppv:
        assert f"peak velocity, {gauge}" in str(compared)
    assert "ratio 1.000" in str(compared)


def test_what_differs_between_two_runs_is_found(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run")
    rows = (copy / "history.csv").read_text().splitlines()
    column = rows[0].split(",").index("energy_kinetic [J]")
    cells = rows[-1].split(",")
    cells[column] = repr(1.5 * float(cells[column]))
    (copy / "history.csv").write_text("\n".join([*rows[:-1], ",".join(cells)]) + "\n")
    compared = sazare.compare(slab, copy)
    history = sazare.open(slab).history
    expected = 0.5 * abs(history["energy_kinetic"][-1]) / np.abs(history["energy_kinetic"]).max()
    assert compared.history["energy_kinetic"] == pytest.approx(expected)
    assert compared.largest_difference == compared.history["energy_kinetic"]
    assert "energy_elastic" in compared.history and compared.history["energy_elastic"] == 0.0
    assert "differ by at most" in str(compared)


def test_a_run_that_is_not_complete_is_named_in_a_comparison(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run")
    manifest = json.loads((copy / "manifest.json").read_text())
    manifest["status"] = "stopped"
    (copy / "manifest.json").write_text(json.dumps(manifest))
    assert "the second run is not complete (status stopped, it has rows to 0.0005 s)" in str(sazare.compare(slab, copy))
    assert "not complete" not in str(sazare.compare(slab, slab))


def test_snapshots_are_found_whatever_the_method(slab):
    results = sazare.open(slab)
    assert len(results.all_snapshots) == len(results.snapshots)
    assert results.all_snapshots[-1].mesh is results.all_snapshots[-1].elements


@pytest.mark.parametrize(
    "manifest",
    [
        "[]", '"text"', '{"results": 3}', '{"machine": []}', '{"case": 7}', '{"status": {}}', '{"results": {"steps": [1]}}', "[" * 100000,
        '{"results": {"steps": "many"}}', '{"results": {"steps": {}}}', '{"results": {"steps": true}}', '{"results": {"ppv": 3e0, "steps": {"a": 1}}}',
        '{"results": {"ppv": {"G1": "fast"}}}', '{"results": {"energy_work": NaN}}', '{"results": {"steps": 1' + 400 * "0" + "}}",
    ],
)
def test_a_manifest_of_other_kinds_is_told_of(manifest, tmp_path):
    (tmp_path / "manifest.json").write_text(manifest)
    with pytest.raises(sazare.NotARun, match="manifest.json"):
        sazare.open(tmp_path).manifest


def test_a_table_without_a_column_is_told_of(tmp_path):
    (tmp_path / "history.csv").write_text("time [s]\n0\n")
    history = sazare.open(tmp_path).history
    with pytest.raises(sazare.NotARun, match="history.csv has no column 'energy_work'; it has: time"):
        history["energy_work"]
    assert "energy_work" not in history and history.get("energy_work") is None


def test_a_table_with_words_for_numbers_is_told_of(tmp_path):
    (tmp_path / "history.csv").write_text("time [s],energy_work [J]\n0,1\n1,much\n")
    with pytest.raises(sazare.NotARun, match="history.csv: the column 'energy_work' has words, and numbers in J were expected"):
        sazare.open(tmp_path).history


@pytest.mark.parametrize("name", ["manifest.json", "case.toml", "history.csv", "snapshots/particles.vtkhdf.series", "snapshots/particles_00000.vtkhdf"])
def test_a_pipe_in_the_place_of_a_file_is_told_of(tmp_path, name):
    (tmp_path / "snapshots").mkdir()
    if name.endswith("00000.vtkhdf"):
        (tmp_path / "snapshots" / "particles.vtkhdf.series").write_text('{"files": [{"name": "particles_00000.vtkhdf", "time": 0}]}')
    os.mkfifo(tmp_path / name)
    run = sazare.open(tmp_path)
    with pytest.raises(sazare.NotARun, match=f"{name}: not a file"):
        run.manifest, run.case_text, run.history, run.particle_snapshots


def test_a_list_of_snapshots_has_times(tmp_path):
    (tmp_path / "snapshots").mkdir()
    (tmp_path / "snapshots" / "particles.vtkhdf.series").write_text('{"files": [{"name": "particles_00000.vtkhdf", "time": NaN}]}')
    with pytest.raises(sazare.NotARun, match="has no time"):
        sazare.open(tmp_path).particle_snapshots


def test_a_table_that_is_no_text_is_told_of(tmp_path):
    (tmp_path / "history.csv").write_bytes(b"time [s]\n\xff\xfe\n")
    with pytest.raises(sazare.NotARun, match="not a table"):
        sazare.open(tmp_path).history
