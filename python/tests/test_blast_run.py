"""Numbers, tables, pictures and the report of a blast from the folder of a run."""

import csv
import json
import shutil

import numpy as np
import pytest
from synthetic_run import write_table

import sazare
from sazare.__main__ import main
from sazare.blast import BlastNumbers, Settings, read_settings
from sazare.blast.energies import MEANINGS, absorbed_by_boundary, parts_of
from sazare.blast.holes import holes_of
from sazare.blast.sizes import by_sieve, by_sphere, sieve_sizes
from sazare.methods import blocks_views
from sazare.methods.blocks_body import Body
from sazare.report import sections_of, write_report
from sazare.style import quantity

AXES = "xyz"


@pytest.fixture(scope="module")
def blasted(solid, tmp_path_factory):
    """The synthetic solid with tables that fit its last snapshot: a loose fragment, a hole, gauges that were watched, an absorbing boundary."""
    run = shutil.copytree(solid, tmp_path_factory.mktemp("blasted") / "run")
    mesh = sazare.open(run).snapshots[-1].elements
    corners = np.asarray(mesh.points)[np.asarray(mesh.cell_connectivity).reshape(-1, 4)]
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6.0
    number = np.asarray(mesh.cell_data["fragment"])
    volume = np.array([volumes[number == one].sum() for one in (0, 1)])
    columns = {"fragment [-]": [0, 1], "elements [-]": [np.sum(number == one) for one in (0, 1)], "volume [m3]": volume, "mass [kg]": 2390.0 * volume}
    columns |= {"size [m]": np.cbrt(6.0 * volume / np.pi), "throw [m]": [0.0, 1e-3], "stays [-]": [1, 0]}
    write_table(run / "fragments.csv", columns)
    hole = {"hole": ["shot"], "delay [s]": [0.0], **{f"first_{a} [m]": [v] for a, v in zip(AXES, (2.0, 1.2, 0.5))}}
    write_table(run / "holes.csv", hole | {f"last_{a} [m]": [v] for a, v in zip(AXES, (2.0, 1.2, 1.5))} | {"diameter [m]": [0.1]})
    cast = {"hole": ["rim_1", "rim_2", "cut"], "length [m]": [1.0, 3.0, 4.0], "half_cast [m]": [1.0, 1.5, 0.0], "whole [m]": [0.25, 0.0, 0.0]}
    write_table(run / "half_casts.csv", cast | {"standing [-]": [0.6, 0.3, 0.1]})
    peaks = {"gauge": ["G1", "G2"], **{f"point_{a} [m]": v for a, v in zip(AXES, ([1.0, 0.5], [1.2, 1.2], [1.0, 1.0]))}}
    peaks |= {"ppv [m/s]": [3.3, 1.3], "time [s]": [3e-5, 3e-5], **{f"peak_{a} [m/s]": v for a, v in zip(AXES, ([2.7, 1.0], [2.0, 0.8], [0.0, 0.0]))}}
    write_table(run / "gauge_peaks.csv", peaks)
    history = (run / "history.csv").read_text().splitlines()
    (run / "history.csv").write_text("\n".join([history[0] + ",far.absorbed [J]", *(f"{line},{50.0 * i}" for i, line in enumerate(history[1:]))]) + "\n")
    return run


def rows_of(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def test_sizes_are_those_of_what_has_come_loose(blasted):
    run = sazare.open(blasted)
    assert len(by_sphere(run).sizes) == 1
    assert by_sphere(run).size_at(0.5) == pytest.approx(run.fragments["size"][1])
    assert by_sieve(run).size_at(0.5) == pytest.approx(sieve_sizes(run.snapshots[-1].elements, np.array([1]))[0])


def test_masses_are_those_of_the_charges_unless_they_are_given(blasted):
    table = blasted / "holes.csv"
    titles, row = table.read_text(encoding="utf-8").splitlines()
    assert holes_of(sazare.open(blasted))[0].charge is None
    table.write_text(f"{titles},mass [kg]\n{row},12.5\n", encoding="utf-8")
    assert holes_of(sazare.open(blasted))[0].charge == 12.5
    assert holes_of(sazare.open(blasted), (3.0,))[0].charge == 3.0
    table.write_text(f"{titles},mass [kg]\n{row},0\n", encoding="utf-8")
    assert holes_of(sazare.open(blasted))[0].charge is None


def test_fragments_that_no_snapshot_shows_have_no_sieve_size(blasted):
    assert sieve_sizes(sazare.open(blasted).snapshots[-1].elements, np.array([0, 7])) is None


def test_a_run_without_fragments_has_no_sizes(tmp_path):
    (tmp_path / "manifest.json").write_text("{}")
    run = sazare.open(tmp_path)
    assert len(by_sphere(run).sizes) == 0 and by_sieve(run) is None
    assert BlastNumbers(run).shaken == [] and BlastNumbers(run).damages == []


def test_a_gauge_has_the_peak_of_the_manifest_where_rows_miss_it(blasted):
    gauges = sazare.open(blasted).gauges
    assert gauges["G1"].ppv == pytest.approx(max(3.1, gauges["G1"].speed.max()))
    assert gauges["G1"].ppv >= gauges["G1"].speed.max()


def test_the_command_writes_tables_pictures_and_what_it_was_given(blasted, tmp_path, capsys):
    run = shutil.copytree(blasted, tmp_path / "run")
    assert main(["blast", str(run), "--oversize", "0.2", "--charge-mass", "4"]) == 0
    printed = capsys.readouterr().out
    for words in ("equivalent sphere", "sieve size", "above 200 mm", "R/W^(1/2) 0.5", "joint dashpots", "through boundaries: far 5 kJ"):
        assert words in printed, words
    folder = run / "blast"
    vibration = rows_of(folder / "vibration.csv")
    assert [row["gauge"] for row in vibration] == ["G1", "G2"]
    assert float(vibration[0]["ppv [m/s]"]) == 3.3 and float(vibration[0]["distance [m]"]) == pytest.approx(1.0)
    assert float(vibration[0]["R/W^(1/2) [m/kg^(1/2)]"]) == pytest.approx(0.5)
    assert float(vibration[0]["R/W^(1/3) [m/kg^(1/3)]"]) == pytest.approx(4.0 ** (-1.0 / 3.0))
    assert {"sizes.csv", "size_curve.csv", "damage.csv", "damage_rings.csv", "damage_directions.csv", "energy.csv", "radiated.csv", "sizes.png", "damage.png"} <= {
        path.name for path in folder.iterdir()
    }
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["sizes"]["oversize_share"] == 1.0 and "shot" in summary["damage"]
    assert read_settings(sazare.open(run)) == Settings(0.2, (4.0,))


def test_the_half_cast_factor_is_that_of_the_contour_holes(blasted, tmp_path, capsys):
    run = shutil.copytree(blasted, tmp_path / "run")
    assert BlastNumbers(sazare.open(run)).half_casts[2].length == 4.0
    assert main(["blast", str(run)]) == 0
    assert "half-casts: 31% of 8 m of holes" in capsys.readouterr().out  # 2.5 of 8 m
    assert main(["blast", str(run), "--contour", "rim_*"]) == 0
    printed = capsys.readouterr().out
    assert "half-casts: 62% of 4 m of contour holes" in printed and "of it 250 mm have not broken out" in printed and "cut" not in printed
    assert [(row["hole"], float(row["half barrel left [m]"])) for row in rows_of(run / "blast/half_casts.csv")] == [("rim_1", 1.0), ("rim_2", 1.5)]
    assert json.loads((run / "blast/summary.json").read_text())["half_cast_factor"] == 0.625
    page = write_report(run).read_text()
    assert "Half-cast factor of contour holes: 62%" in page and "rim_2" in page


def test_a_contour_hole_that_is_none_is_told_with_the_holes_there_are(blasted, capsys):
    assert main(["blast", str(blasted), "--contour", "rim_*", "wall_*"]) == 2
    printed = capsys.readouterr().err
    assert 'contour hole "wall_*"' in printed and "rim_1, rim_2, cut" in printed


def test_a_run_that_was_stopped_is_told(blasted, tmp_path, capsys):
    run = shutil.copytree(blasted, tmp_path / "run")
    manifest = json.loads((run / "manifest.json").read_text())
    (run / "manifest.json").write_text(json.dumps(manifest | {"status": "stopped"}))
    assert main(["blast", str(run)]) == 0
    assert capsys.readouterr().out.startswith("the run has not come to its end (status stopped)")


def test_the_report_uses_what_the_command_was_given(blasted, tmp_path, capsys):
    run = shutil.copytree(blasted, tmp_path / "run")
    page = write_report(run).read_text()
    assert "above 200 mm" not in page
    assert main(["blast", str(run), "--oversize", "0.2"]) == 0
    page = write_report(run).read_text()
    for words in ("above 200 mm", "Where the energy has gone", "crushing around the holes", "Radii of damage", "Peak particle velocity", "far 5 kJ"):
        assert words in page, words
    drawn = {path.stem for path in (run / "report").iterdir()}
    assert {"fragment_curve", "fragment_sizes", "slices", "damage", "attenuation", "radiated"} <= drawn


@pytest.mark.parametrize("arguments", [["--oversize", "0"], ["--charge-mass", "-1"], ["--charge-mass", "nan"]])
def test_sizes_and_masses_must_be_above_0(blasted, arguments, capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["blast", str(blasted), *arguments])
    assert stopped.value.code == 2
    assert "above 0" in capsys.readouterr().err


def test_masses_must_be_as_many_as_the_holes(blasted, capsys):
    assert main(["blast", str(blasted), "--charge-mass", "1", "2"]) == 2
    assert "2 masses of charges for 1 holes" in capsys.readouterr().err


def test_nothing_is_written_or_read_through_a_link(blasted, tmp_path, capsys):
    run, outside = shutil.copytree(blasted, tmp_path / "run"), tmp_path / "outside"
    outside.mkdir()
    (run / "blast").symlink_to(outside)
    assert main(["blast", str(run)]) == 2
    assert "a link" in capsys.readouterr().err and not list(outside.iterdir())
    (run / "blast").unlink()
    (run / "blast").mkdir()
    (run / "blast" / "sizes.csv").symlink_to(outside / "kept.csv")
    assert main(["blast", str(run)]) == 2
    assert not (outside / "kept.csv").exists()


@pytest.mark.parametrize("text", ["[]", "{", '{"oversize": -1, "charges": []}', '{"oversize": null, "charges": ["x"]}', '{"oversize": null}', '{"oversize": NaN, "charges": []}'])
def test_damaged_settings_are_refused(blasted, tmp_path, text):
    run = shutil.copytree(blasted, tmp_path / "run")
    (run / "blast").mkdir()
    (run / "blast" / "settings.json").write_text(text)
    with pytest.raises(sazare.NotARun, match="settings.json"):
        read_settings(sazare.open(run))


def test_energy_is_told_in_words_with_its_share(blasted):
    parts = parts_of(sazare.open(blasted).figures)
    assert {part.key for part in parts} == set(MEANINGS)
    assert parts[0].key == "energy_kinetic" and parts[0].share == pytest.approx(0.3)
    assert sum(part.share for part in parts) == pytest.approx(1.0)
    assert absorbed_by_boundary(sazare.open(blasted)) == {"far": 5000.0}


def test_damage_takes_every_joint_once(blasted):
    run = sazare.open(blasted)
    damage = BlastNumbers(run).damages[0]
    joints = run.snapshots[-1].joints
    assert len(damage.areas) == joints.n_cells and damage.broken.sum() == np.sum(joints.cell_data["state"] >= 2)
    assert damage.areas.sum() == pytest.approx(run.snapshots[0].joints.compute_cell_sizes()["Area"].sum())


def test_volumes_keep_their_unit():
    assert quantity(0.0123, "m³") == "0.0123 m³" and quantity(2500.0, "m") == "2.5 km"


# Pictures of the body


def test_classes_of_sizes_hold_all_sizes_in_few_steps():
    for smallest, largest in ((0.03, 0.6), (0.1, 0.1), (1e-4, 30.0), (0.2, 0.5)):
        bounds = blocks_views.size_classes(smallest, largest)
        assert bounds[0] <= smallest and bounds[-1] >= largest and 2 <= len(bounds) <= 10
        assert np.all(np.diff(bounds) > 0.0)


def test_fragments_are_drawn_from_a_corner_in_plan_and_in_sections(blasted):
    run = sazare.open(blasted)
    titles = [axes.get_title(loc="left") for axes in blocks_views.fragments_by_size(Body(run.snapshots), run).axes]
    assert titles[0] == "oblique view" and [title.split(" = ")[0] for title in titles[1:4]] == ["plan, plane z", "section, plane y", "section, plane x"]


def test_slices_show_a_solid_and_no_slab(blasted, slab):
    titles = [axes.get_title(loc="left") for axes in blocks_views.crack_slices(Body(sazare.open(blasted).snapshots)).axes]
    assert sum("plane" in title for title in titles) == blocks_views.SLICES
    assert blocks_views.crack_slices(Body(sazare.open(slab).snapshots)) is None


def test_the_picture_of_sizes_says_what_it_lacks(blasted, slab, tmp_path):
    assert "fragment_sizes" not in {section.name for section in sections_of(sazare.open(slab))}
    run = shutil.copytree(blasted, tmp_path / "run")
    text = (run / "fragments.csv").read_text().splitlines()
    (run / "fragments.csv").write_text("\n".join([*text, "7" + text[2][1:]]) + "\n")
    section = next(section for section in sections_of(sazare.open(run)) if section.name == "fragment_sizes")
    assert section.draw() is None and "No snapshot shows" in section.missing


class Flying:
    """A snapshot in which a splinter has flown far, beside the body that it came from."""

    def __init__(self, first, splinter, way):
        mesh = first.copy()
        moved = np.zeros((mesh.n_cells, 3))
        moved[:, 0] = 1e-3
        moved[splinter, 0] = way
        mesh.points = np.asarray(mesh.points) + np.repeat(moved, 4, axis=0)
        mesh.cell_data["displacement"] = moved
        mesh.cell_data["fragment"] = np.where(np.isin(np.arange(mesh.n_cells), splinter), 1, 0)
        self.elements = mesh


def test_magnification_follows_the_rock_and_not_a_splinter(solid):
    body = Body(sazare.open(solid).snapshots)
    still, thrown = Flying(body.first, [0], 1e-3), Flying(body.first, [0], 2.0)
    # 4 % of 3 m over 1 mm is 120.
    assert body.exaggeration(still) == body.exaggeration(thrown) == 100.0
    mesh, shown = body.displaced(thrown, 100.0)
    assert len(shown) == body.first.n_cells - 1 and 0 not in shown
    assert np.ptp(np.asarray(mesh.points)[:, 0]) < 1.2 * body.extents[0]


def test_an_element_that_has_turned_keeps_its_shape(solid):
    body = Body(sazare.open(solid).snapshots)
    snapshot = Flying(body.first, [0], 1e-3)
    points = np.asarray(snapshot.elements.points)
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    centre = points[:4].mean(axis=0)
    points[:4] = (points[:4] - centre) @ quarter.T + centre
    snapshot.elements.points = points
    mesh, _ = body.displaced(snapshot, 100.0)
    drawn = np.asarray(mesh.points)[np.asarray(mesh.cell_connectivity).reshape(-1, 4)[0]]
    assert drawn.mean(axis=0) == pytest.approx(centre + [0.099, 0.0, 0.0], abs=1e-6)
    assert drawn - drawn.mean(axis=0) == pytest.approx(points[:4] - centre, abs=1e-6)


def test_magnification_is_less_where_much_of_the_body_flies(solid):
    body = Body(sazare.open(solid).snapshots)
    many = Flying(body.first, np.arange(body.first.n_cells // 5), 0.02)
    # 15 % of 3 m over 20 mm is 22.5.
    assert body.exaggeration(many) == 20.0
