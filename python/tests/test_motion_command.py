"""The command `sazare motion`: what it prints, writes and refuses."""

import json
import re

import numpy as np
import pytest
from matplotlib.image import imread

import sazare
import sazare.ground_motion as ground_motion
from sazare.__main__ import main
from sazare.tables import read_table
from test_ground_motion import CASES, CENTRO

LAYERS = "thickness [m],density [kg/m3],s_wave_velocity [m/s],damping_ratio [-]\n10,1800,200,0.05\ninf,2200,600,0\n"


@pytest.fixture
def motion(tmp_path, monkeypatch, capsys):
    """Calls the command in an empty folder: (exit code, what it printed, its errors)."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "layers.csv").write_text(LAYERS)
    (tmp_path / "target.csv").write_text("period [s],acceleration [g]\n0.1,0.8\n0.6,0.8\n3,0.16\n")

    def called(*arguments, file=CENTRO):
        code = main(["motion", str(file), *arguments])
        told = capsys.readouterr()
        return code, told.out, told.err

    return called


def test_a_record_is_described_drawn_and_written(motion, tmp_path):
    code, told, _ = motion("--damping", "0.02", "0.05")
    folder = tmp_path / "runs/motion-el-centro-1940-ns"
    assert code == 0 and "3.127 m/s2 (312.7 gal)" in told and "1560 samples every 0.02 s" in told
    figures = json.loads((folder / "figures.json").read_text())
    centro = ground_motion.read_record(CENTRO)
    assert figures == ground_motion.figures(centro)
    spectra = read_table(folder / "spectra.csv")
    assert spectra.unit("h=0.02 pseudo_acceleration") == "m/s2"
    assert spectra["h=0.05 displacement"] == pytest.approx(ground_motion.response_spectrum(centro, spectra["period"]).displacement)
    assert ground_motion.read_record(folder / "record.csv").acceleration == pytest.approx(centro.acceleration, abs=0.0)
    assert imread(folder / "motion.png")[..., :3].std() > 0.02


def test_nothing_is_replaced_that_was_not_asked_for(motion, tmp_path):
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine/record.csv").write_text("precious")
    code, _, words = motion("--out", "mine")
    assert code == 2 and "--overwrite replaces them" in words and (tmp_path / "mine/record.csv").read_text() == "precious"
    assert motion("--out", "mine", "--overwrite")[0] == 0
    (tmp_path / "mine/spectra.csv").unlink()
    (tmp_path / "mine/spectra.csv").symlink_to(tmp_path / "elsewhere.csv")
    code, _, words = motion("--out", "mine", "--overwrite")
    assert code == 2 and "lead elsewhere" in words and not (tmp_path / "elsewhere.csv").exists()


def test_corrections_come_in_their_order_and_the_scale_last(motion, tmp_path):
    options = "--baseline 1 --high-pass 0.1 --low-pass 15 --step 0.01 --at-rest --peak-velocity 0.5 --out a".split()
    assert motion(*options)[0] == 0
    record = ground_motion.read_record(tmp_path / "a/record.csv")
    assert record.step == 0.01 and ground_motion.peak_velocity(record) == pytest.approx(0.5, rel=1e-9)
    assert abs(record.velocity[-1]) < 1e-9 and abs(record.displacement[-1]) < 1e-9
    own = ground_motion.take_off_baseline(ground_motion.read_record(CENTRO), 1)
    own = ground_motion.end_at_rest(ground_motion.resample(ground_motion.butterworth(own, 0.1, 15.0), 0.01))
    assert record.acceleration == pytest.approx(ground_motion.scale_to_peak(own, velocity=0.5).acceleration, abs=1e-9)


def test_a_record_goes_through_a_column_and_a_case_takes_it(motion, tmp_path):
    code, told, _ = motion("--column", "layers.csv", "--out", "rock")
    assert code == 0 and "1 layers, 10 m, surface to base-outcrop; the record begins 0.12 s earlier" in told
    column, centro = ground_motion.read_column(tmp_path / "layers.csv"), ground_motion.read_record(CENTRO)
    rock = ground_motion.read_record(tmp_path / "rock/record.csv")
    assert rock.acceleration == pytest.approx(column.carry(centro, highest=20.0).acceleration)
    assert motion("--column", "layers.csv", "--recorded-at", "base-outcrop", "--wanted-at", "surface", "--out", "back", file="rock/record.csv")[0] == 0
    case = (CASES / "soil-column-el-centro/case.toml").read_text().replace("el-centro-1940-ns.AT2", "rock/record.csv")
    (tmp_path / "case.toml").write_text(case)
    assert "el-centro" in sazare.check(tmp_path / "case.toml")


def test_a_target_spectrum_is_met_by_one_factor(motion, tmp_path):
    code, told, _ = motion("--target", "target.csv", "--from-period", "0.2", "--to-period", "2", "--out", "a")
    factor = float(re.search(r"scaled by (\S+);", told)[1])
    period, target = ground_motion.read_target_spectrum(tmp_path / "target.csv")
    exact, off = ground_motion.factor_for_spectrum(ground_motion.read_record(CENTRO), period, target, shortest=0.2, longest=2.0)
    assert code == 0 and factor == pytest.approx(exact, rel=1e-3) and f"factor of {np.exp(off):.3g}" in told


def test_a_short_record_is_warned_of(motion, tmp_path):
    (tmp_path / "short.csv").write_text("time [s],acceleration [gal]\n" + "\n".join(f"{0.01 * n:.2f},{n % 7 - 3}" for n in range(300)))
    code, told, _ = motion(file="short.csv")
    assert code == 0 and "warning: short lasts 2.99 s, less than the longest period of 10 s" in told


@pytest.mark.parametrize(
    "name, text, words",
    [("layers.csv", LAYERS.replace("10,", "0,"), "layers.csv:2: the thickness of a layer must be above 0 m"), ("layers.csv", LAYERS.replace("10,", ","), "thickness"),
     ("layers.csv", LAYERS.replace("0.05", "-0.05"), "damping_ratio"), ("layers.csv", LAYERS.replace("[m/s]", "[km/s]"), "the unit of s_wave_velocity is km/s"),
     ("layers.csv", LAYERS.replace("inf", "20"), "half-space"), ("layers.csv", "", "empty"), ("layers.csv", "a,b\n1,2\n", "the columns are a, b"),
     ("target.csv", "period [s],acceleration [ft/s2]\n1,2\n2,3\n", "ft/s2"), ("target.csv", "period [s],acceleration [g]\n1,2\n0.5,3\n", "rise"),
     ("target.csv", "period [s],acceleration [g]\n1,two\n", "has words, and numbers in g were expected")],
)
def test_a_damaged_table_is_refused(motion, tmp_path, name, text, words):
    (tmp_path / name).write_text(text)
    code, _, told = motion("--column" if name == "layers.csv" else "--target", name)
    assert code == 2 and words in told and told.startswith(("error: ", "layers.csv", "target.csv")) and "Traceback" not in told
    assert not (tmp_path / "runs").exists(), "nothing is written"


@pytest.mark.parametrize(
    "options, words",
    [(["--column", "no.csv"], "there is no such file"), (["--low-pass", "30"], "below half of the sampling frequency"), (["--from-period", "0.1"], "go with --target"),
     (["--shortest-period", "2", "--longest-period", "1"], "to a longer one")],
)
def test_options_that_make_no_sense_are_refused(motion, options, words):
    code, _, told = motion(*options)
    assert code == 2 and words in told


@pytest.mark.parametrize("options", [["--damping", "-0.1"], ["--damping", "nan"], ["--step", "0"], ["--baseline", "9"], ["--peak-acceleration", "1", "--peak-velocity", "1"]])
def test_numbers_out_of_range_are_refused_before_anything_is_read(motion, options):
    with pytest.raises(SystemExit) as ended:
        motion(*options)
    assert ended.value.code == 2


@pytest.mark.parametrize("text, words", [("", "empty"), ("time [s],acceleration [m/s2]\n0,1\n0.1,2\n0.4,1\n", "not uniform"), ("time [s],force [N]\n0,1\n", "wrong header")])
def test_a_damaged_record_is_refused(motion, tmp_path, text, words):
    (tmp_path / "bad.csv").write_text(text)
    code, _, told = motion(file="bad.csv")
    assert code == 2 and words in told and "bad.csv" in told


@pytest.mark.parametrize("value", [0.0, 1e-320])
def test_a_record_without_motion_is_refused(motion, tmp_path, value):
    (tmp_path / "still.csv").write_text("time [s],acceleration [m/s2]\n" + "".join(f"{0.01 * n:.2f},{value}\n" for n in range(200)))
    code, told, error = motion(file=tmp_path / "still.csv")
    assert code == 2 and "there is no motion in this record" in error
    assert not (tmp_path / "runs").exists()
