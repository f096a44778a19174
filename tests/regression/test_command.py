"""The command line: what it prints, and its exit codes."""

import json
import os
import pty
import subprocess
from pathlib import Path

import pytest
from conftest import DONE, PHYSICS_FAILED, ROOT, USER_ERROR, manifest

SHORT = "time.end=4e-5"


def test_run_ends_with_the_figures_and_where_the_files_are(sazare, tmp_path):
    done = sazare.run_block(tmp_path / "run", SHORT)
    assert done.returncode == DONE
    assert done.stderr == ""
    for words in ("Small block: ", "broken joints", "fragments", "energy", "residual", "wall-clock time", f"results in      {tmp_path / 'run'}"):
        assert words in done.stdout


def test_run_without_out_names_the_folder_after_the_case(sazare, tmp_path):
    done = sazare("run", sazare.block, "--set", SHORT, cwd=tmp_path)
    assert done.returncode == DONE
    assert manifest(tmp_path / "runs" / "block")["status"] == "done"


def test_quiet_run_says_nothing(sazare, tmp_path):
    done = sazare.run_block(tmp_path / "run", SHORT, options=["--quiet"])
    assert (done.returncode, done.stdout, done.stderr) == (DONE, "", "")


def test_progress_is_a_bar_on_a_terminal(sazare, tmp_path):
    ours, theirs = pty.openpty()
    arguments = sazare.command("run", sazare.block, "--out", tmp_path / "run", "--set", "time.end=2e-3", "--threads", 1)
    process = subprocess.Popen(arguments, stdout=theirs, stderr=theirs)
    os.close(theirs)
    text = b""
    while chunk := read_some(ours):
        text += chunk
    assert process.wait(timeout=120) == DONE
    assert b"] " in text and b" left" in text and b"evaluations/s" in text


def read_some(descriptor):
    try:
        return os.read(descriptor, 4096)
    except OSError:  # the other end has closed
        return b""


def test_a_run_is_not_overwritten_in_silence(sazare, tmp_path):
    assert sazare.run_block(tmp_path, SHORT).returncode == DONE
    again = sazare.run_block(tmp_path, SHORT)
    assert again.returncode == USER_ERROR
    assert "this folder already contains a run, which is complete. Use --overwrite to replace it" in again.stderr
    resumed = sazare.run_block(tmp_path, SHORT, options=["--resume"])
    assert resumed.returncode == USER_ERROR
    assert "is complete, there is nothing to resume" in resumed.stderr
    assert sazare.run_block(tmp_path, SHORT, options=["--overwrite"]).returncode == DONE


@pytest.mark.parametrize("mistake", ["gauges.0.point=[9, 9, 9]", "time.strict=true"])
def test_a_run_stands_until_the_one_that_replaces_it_begins(sazare, tmp_path, mistake):
    assert sazare.run_block(tmp_path, SHORT).returncode == DONE
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    bad = sazare.run_block(tmp_path, mistake, "time.limiter=none", "time.base_step=2e-6", options=["--overwrite"])
    assert bad.returncode == USER_ERROR
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


def test_a_case_with_errors_is_not_run(sazare, tmp_path):
    bad = sazare.run_block(tmp_path / "run", "materials.0.density=-1", "joints.0.cohesion=-2")
    assert bad.returncode == USER_ERROR
    assert "2 errors; nothing was run" in bad.stderr
    assert not (tmp_path / "run").exists()


def test_a_gauge_outside_is_an_error_at_its_line(sazare, tmp_path):
    bad = sazare.run_block(tmp_path / "run", "gauges.0.point=[9, 9, 9]")
    assert bad.returncode == USER_ERROR
    assert 'gauge "G1" at (9, 9, 9) m is in no element' in bad.stderr
    assert not (tmp_path / "run" / "manifest.json").exists()


def test_a_motion_that_makes_no_sense_ends_the_run(sazare, tmp_path):
    absurd = ("time.limiter=none", "time.base_step=2e-5", "time.history_interval=2e-5", "time.end=4e-3", "time.snapshot_interval=4e-3")
    failed = sazare.run_block(tmp_path, *absurd)
    assert failed.returncode == PHYSICS_FAILED
    assert "warning: step above the stability limit" in failed.stderr
    assert "the physics failed: element " in failed.stderr
    assert "is kept in" in failed.stderr
    assert manifest(tmp_path)["status"] == "failed"
    assert (tmp_path / "checkpoint" / "state.h5").exists()


def test_long_base_steps_of_a_blast_run_to_their_end(sazare, tmp_path):
    """Pairs of blocks then part in the base step in which they would rest."""
    long = ("--set", "time.base_step=2.5e-5", "--set", "time.history_interval=2.5e-5")
    done = sazare("run", ROOT / "cases/free-face-blast/case.toml", "--out", tmp_path / "run", "--threads", 1, *long)
    assert done.returncode == DONE
    figures = manifest(tmp_path / "run")["results"]
    assert abs(figures["energy_residual"]) < 1e-4 * figures["energy_work"]


def test_a_strict_case_refuses_a_step_above_stability(sazare, tmp_path):
    strict = sazare.run_block(tmp_path, "time.limiter=none", "time.base_step=2e-6", "time.strict=true")
    assert strict.returncode == USER_ERROR
    assert "error: step above the stability limit" in strict.stderr


def test_check_tells_what_the_case_will_do(sazare):
    checked = sazare("check", sazare.block)
    assert checked.returncode == DONE, checked.stderr
    for words in ("Small block", "initial levels", "elements that limit the step", "The case is valid"):
        assert words in checked.stdout


def test_check_of_a_file_without_end_is_an_error(sazare):
    checked = sazare("check", "/dev/zero")
    assert checked.returncode == 2
    assert "/dev/zero has more than 64 million characters, and so is no case file" in checked.stderr


def test_check_of_a_bad_case_is_an_error(sazare):
    checked = sazare("check", sazare.block, "--set", "mesh.file=none.msh")
    assert checked.returncode == USER_ERROR
    assert "none.msh" in checked.stderr


def test_blocks_on_finite_elements_are_warned_of_like_blocks_alone(sazare, tmp_path):
    case, long = ROOT / "cases/rock-fall-on-slab/case.toml", ("--set", "bodies.time.limiter=none", "--set", "bodies.time.base_step=2e-5")
    strict = sazare("run", case, "--out", tmp_path / "run", *long, "--set", "bodies.time.strict=true")
    assert strict.returncode == USER_ERROR
    assert "error: step above the stability limit" in strict.stderr


def test_check_keeps_the_mesh_that_its_error_tells_of(sazare, tmp_path):
    words = sazare("check", sazare.block, "--set", "mesh.file=block.geo", "--set", "gauges.0.point=[9, 9, 9]",
                   env=os.environ | {"TMPDIR": str(tmp_path)}).stderr
    assert "is in no element" in words
    kept = words.split("the mesh that gmsh generated for the case is kept in ")[1].strip()
    assert [path.name for path in Path(kept).iterdir()] == ["mesh.msh"]
    assert "numbers of elements are those of mesh.msh" in sazare("check", sazare.block, "--set", "mesh.file=block.geo",
                                                            env=os.environ | {"TMPDIR": str(tmp_path)}).stdout
    assert list(tmp_path.iterdir()) == [Path(kept)]


def test_case_of_a_geometry_is_meshed_into_the_folder(sazare, tmp_path):
    done = sazare.run_block(tmp_path / "run", SHORT, "mesh.file=block.geo")
    assert done.returncode == DONE, done.stderr
    assert (tmp_path / "run" / "mesh.msh").exists()
    again = sazare("run", tmp_path / "run" / "case.toml", "--out", tmp_path / "again", "--threads", 1)
    assert manifest(tmp_path / "again")["state_hash"] == manifest(tmp_path / "run")["state_hash"], again.stderr


def test_schema_is_json_and_the_page_of_the_reference(sazare):
    schemas = json.loads(sazare("schema").stdout)["oneOf"]
    known = [schema["properties"] for schema in schemas]
    assert len(known) == 6
    for properties, table in zip(known, ("joints", "particles", "walls", "spheres", "solver")):
        assert table in properties
    assert sazare("schema", "--markdown").stdout == (ROOT / "docs" / "reference" / "case.md").read_text()


COLUMN = ROOT / "cases" / "column-ricker" / "case.toml"


def test_column_of_particles_is_checked_run_and_its_resolved_case_gives_the_same_bits(sazare, tmp_path):
    settings = ("--set", "particles.spacing=2", "--set", "time.end=0.4")
    checked = sazare("check", COLUMN, *settings)
    assert checked.returncode == DONE, checked.stderr
    for words in ("limit 0.00816", "predicted from the largest frequency", "250 particles", "The case is valid"):
        assert words in checked.stdout
    done = sazare("run", COLUMN, "--out", tmp_path / "run", "--threads", 1, *settings)
    assert done.returncode == DONE, done.stderr
    assert "particle-steps per second" in done.stdout
    again = sazare("run", tmp_path / "run" / "case.toml", "--out", tmp_path / "again", "--threads", 2)
    assert manifest(tmp_path / "again")["state_hash"] == manifest(tmp_path / "run")["state_hash"], again.stderr


def test_step_above_the_limit_is_an_error_and_nothing_is_run(sazare, tmp_path):
    refused = sazare("run", COLUMN, "--out", tmp_path / "run", "--set", "time.step=5e-3", "--set", "time.history_interval=5e-3")
    assert refused.returncode == USER_ERROR
    assert "times the predicted limit of" in refused.stderr
    assert not (tmp_path / "run").exists()


def test_study_writes_its_table(sazare, tmp_path):
    text = (ROOT / "cases" / "stability-study" / "study.toml").read_text()
    folder = tmp_path / "study"
    folder.mkdir()
    for name in ("column-s.toml", "column-p.toml"):
        (folder / name).write_text((ROOT / "cases" / "stability-study" / name).read_text())
    short = text.replace("[0.5, 1.0, 2.0, 3.2]", "[3.2]").replace("[100.0, 200.0, 400.0, 800.0]", "[100.0]")
    (folder / "study.toml").write_text(short.replace("0.001, 0.0022, 0.0048, 0.01, 0.022, 0.048, 0.1, 0.22, 0.48, ", "0.1, "))
    done = sazare("study", folder / "study.toml", "--out", tmp_path / "out", "--threads", 2)
    assert done.returncode == DONE, done.stderr
    assert "within" in done.stdout and "4 of 4 cases" in done.stdout
    assert len((tmp_path / "out" / "study.csv").read_text().splitlines()) == 5
    assert sazare("study", folder / "study.toml", "--out", tmp_path / "out", "--resume").returncode == USER_ERROR


def test_info_and_version(sazare):
    info = sazare("info")
    assert info.returncode == DONE
    for words in ("sazare ", "commit ", "compiler ", "threads ", "MPI "):
        assert words in info.stdout
    assert sazare("--version").stdout.startswith("sazare 0.")


def test_a_wrong_command_line_is_an_error_of_the_user(sazare):
    assert sazare("run").returncode == USER_ERROR
    assert sazare("dance").returncode == USER_ERROR
    assert sazare("run", sazare.block, "--resume", "--overwrite").returncode == USER_ERROR


def test_report_of_no_run_is_an_error_of_the_user(sazare, tmp_path):
    assert sazare("report", tmp_path / "none").returncode == USER_ERROR
