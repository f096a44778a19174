"""The laboratory: specimens, measurement, figures, envelopes, calibration, and tests of a coarse specimen from the command line."""

import os
import signal
import subprocess
import time
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import sazare
import sazare.lab as lab
from sazare.__main__ import main
from sazare.lab import command, figures, folders, measure, specimens, words
from sazare.lab.calibrate import Targets

CASE = Path(__file__).parents[2] / "cases/uniaxial-compression/case.toml"
COARSE = lab.Options(elements=3)


@pytest.fixture(scope="module")
def rock():
    return lab.rock_of(CASE)


def test_rock_is_found_in_a_case_of_blocks(rock):
    assert (rock.name, rock.youngs_modulus, rock.joint.cohesion) == ("rock", 50e9, 25e6)
    # Mohr and Coulomb: 2 c cos(phi)/(1 - sin(phi)), and (1 + sin(phi))/(1 - sin(phi)) per confinement, at 45 degrees.
    assert rock.strength_under(0.0) == pytest.approx(2 * 25e6 * np.cos(np.pi / 4) / (1 - np.sin(np.pi / 4)))
    assert rock.strength_under(1e6) - rock.strength_under(0.0) == pytest.approx(1e6 * (1 + np.sin(np.pi / 4)) / (1 - np.sin(np.pi / 4)))
    assert lab.rock_of(CASE, overrides={"joints.0.cohesion": 5e6}).joint.cohesion == 5e6


@pytest.mark.parametrize(
    ("case", "material", "words"),
    [
        ("column-ricker", None, "this case is of method mps"),
        ("uniaxial-compression", "marble", "no material 'marble' in the case; there are: rock"),
        ("direct-shear", None, "youngs_modulus"),
    ],
)
def test_rock_that_cannot_be_tested_is_refused(case, material, words):
    with pytest.raises(ValueError, match=words):
        lab.rock_of(CASE.parents[1] / case / "case.toml", material)


def every_trial(rock):
    steel = replace(COARSE, platens="steel")
    yield from (lab.trial_of(name, rock, COARSE) for name in ("uniaxial", "brazilian", "direct-tension", "point-load"))
    yield from (lab.trial_of("triaxial", rock, options, 10e6) for options in (COARSE, steel, replace(COARSE, platens="held")))
    yield lab.trial_of("direct-shear", rock, COARSE, 5e6)


@pytest.mark.parametrize("number", range(8))
def test_case_of_every_test_is_valid_and_starts_in_equilibrium(rock, number, tmp_path):
    trial = list(every_trial(rock))[number]
    (tmp_path / "specimen.geo").write_text(trial.specimen.geometry)
    sazare.write_table(tmp_path / "platen.csv", trial.platen_rows())
    sazare.write_table(tmp_path / "pressure.csv", {"time [s]": [0.0, 1.0], "pressure [Pa]": [trial.pressure] * 2})
    case = trial.case()
    case.folder = tmp_path
    words = sazare.check(case)
    assert "equilibrium" not in words
    assert "lose it at once" not in words


def test_platen_reaches_its_speed_smoothly_and_keeps_it(rock):
    trial = lab.trial_of("uniaxial", rock, COARSE)
    times, speeds = (np.array(column) for column in trial.platen_rows().values())
    moved = np.concatenate([[0.0], np.cumsum(0.5 * (speeds[1:] + speeds[:-1]) * np.diff(times))])
    assert np.allclose(-moved, trial.displacement(times), rtol=0, atol=1e-3 * trial.displacement(times[20]))
    assert speeds[0] == 0.0
    assert speeds[-1] == pytest.approx(-trial.strain_rate * trial.specimen.length)
    assert times[-1] >= trial.end


def test_extensometer_reads_a_uniform_strain_whatever_the_body_does_besides():
    positions = np.random.default_rng(1).uniform(0.0, 1.0, (200, 3))
    strain = np.diag([2e-3, 4e-3, -9e-3]) + 1e-3 * np.array([[0, 1, 0], [-1, 0, 2], [0, -2, 0]])
    read = measure.Extensometer(positions, axis=2, length=1.0).read(positions + positions @ strain.T + [0.1, -0.2, 0.3])
    assert read == pytest.approx((-9e-3, 3e-3), abs=1e-12)


def test_residual_stress_and_its_scatter_are_those_of_the_last_quarter(rock):
    trial = lab.trial_of("direct-shear", rock, COARSE, 1e6)
    displacement = np.linspace(0.0, 4e-4, 401)
    swing = np.where(np.arange(401) % 2 == 0, 0.1e6, -0.1e6)
    stress = np.where(displacement < 1e-4, 1e11 * displacement, np.where(displacement < 3e-4, 2e6, 0.6e6 + swing))
    curve = {"stress": stress, "opposite_stress": stress, "displacement": displacement, "platen_strain": displacement / 0.05, "broken_joints": np.zeros(401)}
    found = figures.figures_of(trial, curve)
    assert found["residual_stress"] == pytest.approx(0.6e6, rel=2e-2) and found["residual_scatter"] == pytest.approx(0.1e6, rel=2e-2)


@pytest.mark.parametrize(
    ("test", "options", "changed", "message"),
    [
        ("direct-shear", {}, {"imbalance": 0.0734}, "differ by up to 7.3 % of it, so the test is not quasi-static: --strain-rate 1.4 is half as fast"),
        ("uniaxial", {}, {"imbalance": 0.06}, "the test is not quasi-static"),
        ("direct-tension", {"strain_rate": 5.0}, {"imbalance": 0.2}, "inertia has a part in it"),
        ("direct-shear", {}, {"residual_scatter": 0.3e6, "residual_stress": 3e6}, "the residual stress scatters"),
        ("direct-shear", {}, {"residual_stress": 2.44e6}, "the residual stress is 0.49 of the normal stress, less than the friction of contacts, 0.6: broken pieces turn on the spheres"),
        ("direct-shear", {}, {}, None),
    ],
)
def test_what_makes_a_test_doubtful_is_told(rock, test, options, changed, message):
    trial = lab.trial_of(test, rock, lab.Options(elements=8, **options), 5e6 if test == "direct-shear" else 0.0)
    found = {"failed": True, "imbalance": 0.01, "energy_residual": 0.0} | ({"residual_stress": 3e6, "residual_scatter": 0.1e6} if test == "direct-shear" else {}) | changed
    told = list(words.doubts(SimpleNamespace(trial=trial, figures=found)))
    assert len(told) == (message is not None) and all(message in line for line in told)


def test_figures_of_a_curve_whose_figures_are_known(rock):
    trial = lab.trial_of("triaxial", rock, COARSE, 10e6)
    strain = np.linspace(0.0, 4e-3, 401)
    rising = strain <= 3e-3
    stress = 10e6 + np.where(rising, 40e9 * strain, 20e6)
    curve = {
        "time": strain, "stress": stress, "opposite_stress": stress - 1e6, "displacement": strain, "platen_strain": 1.1 * strain, "axial_strain": strain,
        "lateral_strain": 0.2 * strain, "volumetric_strain": np.where(strain < 2e-3, -0.6 * strain, -1.2e-3 + 5.0 * (strain - 2e-3)),
        "broken_joints": np.where(strain < 2.5e-3, 0, 200) + np.where(rising, 0, 100),
    }
    found = figures.figures_of(trial, curve)
    assert found["peak_stress"] == pytest.approx(130e6)
    assert found["deviatoric_stress"] == pytest.approx(120e6)
    assert found["peak_strain"] == pytest.approx(3.3e-3)
    assert found["youngs_modulus"] == pytest.approx(40e9)
    assert found["poisson_ratio"] == pytest.approx(0.2)
    assert found["crack_initiation_stress"] == pytest.approx(110e6)
    assert found["crack_damage_stress"] == pytest.approx(90e6)
    assert found["imbalance"] == pytest.approx(1e6 / 130e6)
    assert (found["failed"], found["cracks_at_peak"], found["cracks"]) == (True, 200, 300)


def test_envelopes_find_the_line_that_peaks_lie_on():
    confinements = np.array([0.0, 5e6, 10e6, 30e6])
    straight = lab.MohrCoulomb(20e6, 40.0)
    found = lab.mohr_coulomb(confinements, straight.strength(confinements))
    assert (found.cohesion, found.friction_angle) == pytest.approx((20e6, 40.0))
    curved = lab.HoekBrown(100e6, 15.0)
    found = lab.hoek_brown(confinements, curved.strength(confinements))
    assert (found.uniaxial_strength, found.m) == pytest.approx((100e6, 15.0))
    found = lab.coulomb([1e6, 3e6], [5e6, 7e6])
    assert (found.cohesion, found.friction_angle) == pytest.approx((4e6, 45.0))
    with pytest.raises(ValueError, match="needs 3 different pressures"):
        lab.hoek_brown([0.0, 1e6, 1e6], [1e8, 2e8, 2e8])
    with pytest.raises(ValueError, match="no angle of friction"):
        lab.mohr_coulomb([0.0, 1e6], [1e8, 1.005e8])


def test_specimens_have_the_areas_by_which_forces_are_divided():
    assert specimens.cylinder(0.05, 0.1, 0.01).area == pytest.approx(np.pi * 0.025**2)
    assert specimens.disc(0.05, 0.025, 0.01).area == pytest.approx(np.pi * 0.05 * 0.025 / 2)  # ISRM (1978)
    assert specimens.core(0.05, 0.04, 0.01).area == pytest.approx(4 * 0.05 * 0.04 / np.pi)  # ISRM (1985)
    assert specimens.shear_box(0.1, 0.08, 0.01).area == pytest.approx(0.01)


def test_calibration_finds_strengths_that_give_the_measured_peaks(rock, tmp_path):
    """With peaks that follow both strengths, as those of specimens do."""

    def machine(trial, folder):
        folder.mkdir(parents=True)
        cohesion, tension, friction = trial.rock.joint.cohesion, trial.rock.joint.tensile_strength, trial.rock.friction
        peak = {"uniaxial": 6 * cohesion**0.7 * tension**0.3, "brazilian": tension**0.6 * cohesion**0.4, "triaxial": 9 * cohesion * friction}[trial.test]
        return SimpleNamespace(figures={"peak_stress": peak * (1.0 + 0.01 * (trial.options.seed - 1))})

    found = lab.calibrate(rock, Targets(150e6, 15e6, confined=250e6, confinement=10e6), COARSE, tmp_path, machine=machine)
    cohesion, tension = found.rock.joint.cohesion, found.rock.joint.tensile_strength
    assert found.converged
    assert 6 * cohesion**0.7 * tension**0.3 == pytest.approx(150e6, rel=0.021)
    assert tension**0.6 * cohesion**0.4 == pytest.approx(15e6, rel=0.021)
    assert 9 * cohesion * found.rock.friction == pytest.approx(250e6, rel=0.021)
    assert [row["mesh"] for row in found.scatter] == [1, 2, 3]
    assert (tmp_path / "calibration.csv").exists()
    assert (tmp_path / "scatter.csv").exists()


def test_cylinder_fails_and_measures_its_own_elasticity(tmp_path):
    tested = lab.test("uniaxial", CASE, tmp_path / "ucs", elements=4, threads=1)
    assert tested.figures["failed"]
    assert tested.figures["youngs_modulus"] == pytest.approx(50e9, rel=0.1)
    assert tested.figures["poisson_ratio"] == pytest.approx(0.25, abs=0.05)
    assert tested.figures["imbalance"] < 0.02
    assert abs(tested.figures["energy_residual"]) < 2e-3
    # Cohesion 25 MPa at 45 degrees: 121 MPa where the plane of failure is free.
    assert 0.8 < tested.figures["peak_stress"] / tested.trial.expected_stress < 1.3
    with pytest.raises(FileExistsError, match="--overwrite"):
        lab.test("uniaxial", CASE, tmp_path / "ucs", elements=4)


def test_confined_cylinder_begins_at_rest_and_is_stronger(tmp_path):
    tested = lab.test("triaxial", CASE, tmp_path / "confined", pressure=20e6, elements=3, threads=1)
    # The ends of the mesh have the area of the circle, though they are polygons.
    assert tested.curve["stress"][0] == pytest.approx(20e6, rel=1e-6)
    assert abs(tested.curve["lateral_strain"][1]) < 1e-3 * tested.figures["peak_strain"]
    assert tested.figures["deviatoric_stress"] > 1.3 * tested.trial.rock.strength_under(0.0)


def test_command_writes_tables_and_pictures(tmp_path, capsys):
    out = tmp_path / "disc"
    words = ["lab", "brazilian", str(CASE), "--elements", "4", "--threads", "1", "--quiet", "--out", str(out)]
    assert main(words) == 0
    assert {path.name for path in out.iterdir()} >= {"case.toml", "specimen.geo", "platen.csv", "curve.csv", "figures.json", "curve.png", "cracks.png", "run"}
    assert "peak stress" in capsys.readouterr().out
    assert main(words) == 2
    assert "--overwrite" in capsys.readouterr().err


def test_command_replaces_only_tests(tmp_path, capsys):
    (tmp_path / "thesis.txt").write_text("years of work")
    assert main(["lab", "brazilian", str(CASE), "--out", str(tmp_path), "--overwrite", "--quiet"]) == 2
    assert "no test" in capsys.readouterr().err
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.txt"]


def test_folder_of_a_test_is_replaced_by_the_same_test_alone(tmp_path):
    folders.claim(tmp_path / "series", "triaxial", [0.0, 5e6])
    (tmp_path / "series/envelope.png").write_text("old")
    (tmp_path / "series/notes.txt").write_text("mine")
    with pytest.raises(FileExistsError, match="--overwrite replaces it"):
        folders.claim(tmp_path / "series", "triaxial", [0.0, 5e6])
    for test, pressures in (("triaxial", [5e6]), ("uniaxial", [0.0])):
        with pytest.raises(FileExistsError, match="another test in it .triaxial at 5 MPa"):
            folders.claim(tmp_path / "series", test, pressures, overwrite=True)
    folders.claim(tmp_path / "series", "triaxial", [0.0, 5e6], overwrite=True)
    assert {path.name for path in (tmp_path / "series").iterdir()} == {"lab.json", "notes.txt"}
    (tmp_path / "file").write_text("")
    with pytest.raises(FileExistsError, match="a folder is wanted"):
        folders.claim(tmp_path / "file", "uniaxial", overwrite=True)


@pytest.mark.parametrize(
    ("test", "options", "words"),
    [
        ("uniaxial", {"elements": 1}, "2 elements"),
        ("brazilian", {"contact_angle": 180.0}, "jaws cannot bear on an arc of 180 degrees"),
        ("brazilian", {"contact_angle": 0.001}, "jaws cannot bear"),
        ("point-load", {"tip_radius": 0.025}, "points cannot press"),
        ("uniaxial", {"scatter_seed": 7}, "no weibull_modulus"),
        ("uniaxial", {"strain_rate": 1e6}, "before a wave has passed the specimen"),
        ("uniaxial", {"strain": 1e-12}, "has not reached its speed"),
    ],
)
def test_specimens_and_rates_that_make_no_sense_are_refused(rock, test, options, words):
    with pytest.raises(ValueError, match=words):
        lab.trial_of(test, rock, lab.Options(**options))


def test_envelope_leaves_out_specimens_that_did_not_fail(rock, tmp_path, capsys):
    def tested(pressure, peak, failed):
        trial = lab.trial_of("triaxial", rock, COARSE, pressure)
        return lab.Tested(trial, tmp_path, {"platen_strain": np.arange(2.0), "stress": np.arange(2.0)}, {"peak_stress": peak, "failed": failed})

    command._write_envelope("triaxial", [tested(0.0, 100e6, True), tested(5e6, 130e6, True), tested(10e6, 20e6, False)], tmp_path)
    said = capsys.readouterr().out
    straight = lab.mohr_coulomb([0.0, 5e6], [100e6, 130e6])
    assert "did not fail are left out" in said
    assert f"cohesion {1e-6 * straight.cohesion:.4g} MPa" in said
    assert "Hoek-Brown: none: an envelope needs 3 different pressures" in said
    assert (tmp_path / "envelope.png").exists()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["brazilian", "--platens", "steel"], "invalid choice: 'steel'"),
        (["triaxial"], "--confinement"),
        (["triaxial", "--confinement", "-5"], "must be 0, or 1000 to 1e+10 Pa, found -5"),
        (["triaxial", "--confinement", "-5e6"], "must be 0, or 1000 to 1e+10 Pa, found -5e6"),
        (["direct-shear", "--normal-stress", "5"], "found 5; did you mean 5e+06?"),
        (["uniaxial", "--diameter", "0"], "must be 0.0001 to 10 m, found 0"),
        (["uniaxial", "--diameter", "50"], "did you mean 0.05?"),
        (["uniaxial", "--strain", "1e300"], "--strain: must be"),
        (["uniaxial", "--strain-rate", "nan"], "found nan"),
        (["uniaxial", "--elements", "2.5"], "whole number"),
        (["calibrate", "--uniaxial", "1e8"], "--tensile"),
    ],
)
def test_command_says_what_is_wrong(words, message, capsys):
    with pytest.raises(SystemExit) as stopped:
        main(["lab", words[0], str(CASE), *words[1:]])
    assert stopped.value.code == 2
    said = capsys.readouterr().err
    assert message in said
    assert said.splitlines()[0].startswith("error: ") and said.splitlines()[1:] == [f"      help: sazare lab {words[0]} --help shows the options"]


def test_unknown_options_are_told_as_of_their_command(capsys):
    with pytest.raises(SystemExit):
        main(["lab", "uniaxial", str(CASE), "--nosuch"])
    assert capsys.readouterr().err == "error: unrecognized arguments: --nosuch\n      help: sazare lab uniaxial --help shows the options\n"


def test_friction_of_platens_that_are_not_of_steel_is_refused(tmp_path, capsys):
    assert main(["lab", "uniaxial", str(CASE), "--platen-friction", "0.3", "--out", str(tmp_path / "out")]) == 2
    assert "add --platens steel" in capsys.readouterr().err
    assert lab.Options(platens="steel", platen_friction=0.3).platen_friction == 0.3


def test_command_refuses_a_confined_strength_without_its_confinement(capsys):
    assert main(["lab", "calibrate", str(CASE), "--uniaxial", "1e8", "--tensile", "1e7", "--triaxial", "2e8"]) == 2
    assert "go together" in capsys.readouterr().err


def test_stopped_test_keeps_what_was_measured(tmp_path):
    command = Path(__file__).parents[2] / "build/release/apps/sazare/sazare"
    out = tmp_path / "stopped"
    words = [command, "lab", "uniaxial", CASE, "--elements", "8", "--threads", "1", "--quiet", "--out", out]
    test = subprocess.Popen(words, start_new_session=True, stderr=subprocess.PIPE, text=True)
    while not (out / "run/history.csv").exists() and test.poll() is None:
        time.sleep(0.1)
    time.sleep(1.0)
    os.killpg(test.pid, signal.SIGINT)
    _, said = test.communicate(timeout=60)
    assert (test.returncode, said) == (4, "stopped\n")
    assert (out / "curve.csv").read_text().startswith("time [s],stress [Pa],")
    assert (out / "run/checkpoint").exists()
