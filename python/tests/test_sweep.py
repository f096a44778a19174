"""Families of runs: what is varied, what is carried out, and the table that comes of it."""

import csv
import json
import shutil

import pytest

from sazare.__main__ import main
from sazare.sweep import Parameter, Sweep, parameter_of
from sazare.sweep.family import read_sweep
from sazare.tables import NotARun

CASE = """[case]
title = "Spring"
method = "mps"

[particles]
spacing = 1.0

[[regions]]
name = "column"
lower = [0.0, 0.0, 0.0]
upper = [2.0, 4.0, 0.0]

[[materials]]
name = "soil"
regions = ["column"]
density = 1500.0
s_wave_velocity = 100.0
poisson_ratio = 0.25

[[motions]]
name = "wavelet"
type = "ricker"
frequency = 100.0
peak_time = 0.01

[[boundaries]]
side = "bottom"
kind = "prescribed"
motion_x = "wavelet"

[time]
end = 0.02
history_interval = 0.005
"""


@pytest.fixture
def case(tmp_path):
    (tmp_path / "case.toml").write_text(CASE, encoding="utf-8")
    return tmp_path / "case.toml"


def test_values_are_parted_at_commas_that_stand_alone():
    assert parameter_of("charges.0.delay=0,1e-3") == Parameter("charges.0.delay", ("0", "1e-3"))
    assert parameter_of("mesh.parameters={a=1,b=2}, {a=3,b=4}").values == ("{a=1,b=2}", "{a=3,b=4}")
    assert parameter_of('x.y=[1,[2,3]],"a,b"').values == ("[1,[2,3]]", '"a,b"')


@pytest.mark.parametrize("text", ["a.b", "a.b=", "a.b=1,,2", "=1,2"])
def test_what_names_no_values_is_refused(text):
    with pytest.raises(ValueError, match="names no values"):
        parameter_of(text)


def test_a_value_that_stands_twice_is_refused():
    with pytest.raises(ValueError, match="twice"):
        parameter_of("a.b=1,2,1")


def test_every_combination_has_its_settings_and_its_folder(case, tmp_path):
    sweep = Sweep(case, [Parameter("a.b", ("1", "2")), Parameter("c.d", ("x", "y", "z"))], tmp_path / "out", ["e.f=7"])
    assert len(sweep.combinations) == 6
    assert sweep.overrides(0) == ["e.f=7", "a.b=1", "c.d=x"] and sweep.overrides(5) == ["e.f=7", "a.b=2", "c.d=z"]
    assert sweep.folder(5).name == "006" and sweep.status(5) == ""
    assert read_sweep(tmp_path / "out").combinations == sweep.combinations


def test_keys_that_are_joined_have_the_same_value(case, tmp_path):
    sweep = Sweep(case, [parameter_of("a.b & c.d=1,2")], tmp_path / "out")
    assert sweep.overrides(1) == ["a.b=2", "c.d=2"]
    with pytest.raises(ValueError, match="each once"):
        Sweep(case, [parameter_of("a.b&a.b=1,2")], tmp_path / "other")


def test_a_folder_with_something_else_is_refused(case, tmp_path):
    one = [Parameter("a.b", ("1", "2"))]
    Sweep(case, one, tmp_path / "out")
    with pytest.raises(ValueError, match="a sweep over other values"):
        Sweep(case, [Parameter("a.b", ("1", "3"))], tmp_path / "out")
    with pytest.raises(ValueError, match="no sweep"):
        Sweep(case, one, tmp_path)
    with pytest.raises(NotARun):
        read_sweep(tmp_path)


def test_a_key_that_is_varied_twice_is_refused(case, tmp_path):
    with pytest.raises(ValueError, match="each once"):
        Sweep(case, [Parameter("a.b", ("1", "2")), Parameter("a.b", ("3",))], tmp_path / "out")


def test_the_command_runs_all_and_goes_on_where_runs_are_missing(case, tmp_path, capsys):
    arguments = ["sweep", str(case), "--over", "materials.0.density=1500,3000", "--out", str(tmp_path / "out"), "--figures", "energy_kinetic"]
    assert main(arguments) == 0
    assert "2 of 2" in capsys.readouterr().out
    with (tmp_path / "out/sweep.csv").open(newline="") as file:
        rows = list(csv.DictReader(file))
    assert [row["status"] for row in rows] == ["done", "done"]
    # Energies of the same motion are proportional to the density where the wave velocity is given.
    assert float(rows[1]["energy_kinetic"]) == pytest.approx(2.0 * float(rows[0]["energy_kinetic"]), rel=1e-9)
    assert float(rows[0]["energy_kinetic"]) > 0.0 and (tmp_path / "out/sweep.png").is_file()

    kept = (tmp_path / "out/001/manifest.json").read_text()
    shutil.rmtree(tmp_path / "out/002")
    assert main(arguments) == 0
    assert "1 of 2" not in capsys.readouterr().out
    assert (tmp_path / "out/001/manifest.json").read_text() == kept
    assert json.loads((tmp_path / "out/002/manifest.json").read_text())["status"] == "done"


def test_a_run_that_fails_is_told_and_the_others_are_carried_out(case, tmp_path, capsys):
    assert main(["sweep", str(case), "--over", "materials.0.density=1500,-1", "--out", str(tmp_path / "out")]) == 2
    told = capsys.readouterr()
    assert "run 002 failed" in told.err and "density" in told.err
    with (tmp_path / "out/sweep.csv").open(newline="") as file:
        assert [row["status"] for row in csv.DictReader(file)] == ["done", "not begun"]


def test_a_figure_that_no_run_has_is_told_with_those_there_are(case, tmp_path, capsys):
    assert main(["sweep", str(case), "--over", "materials.0.density=1500", "--out", str(tmp_path / "out"), "--figures", "p51"]) == 2
    assert "energy_kinetic" in capsys.readouterr().err
