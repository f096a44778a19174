"""A run that is interrupted in any way, and resumed, gives the bits of one that is not."""

import itertools
import signal
import time
from subprocess import TimeoutExpired

import pytest
from conftest import DONE, MACHINE_FAILED, PHYSICS_FAILED, ROOT, USER_ERROR, manifest, rows_without_wall_time, settling_block

OFTEN = "output.checkpoint_interval=0.02"
LATER = "time.end=4e-3"


def assert_same_results(whole, parts):
    one, many = manifest(whole), manifest(parts)
    assert one["status"] == many["status"] == "done"
    assert one["state_hash"] == many["state_hash"]
    one["results"].pop("wall_seconds")
    many["results"].pop("wall_seconds")
    assert one["results"] == many["results"]
    assert rows_without_wall_time(whole / "history.csv") == rows_without_wall_time(parts / "history.csv")
    for name in ("gauges.csv", "fragments.csv"):
        assert (whole / name).read_bytes() == (parts / name).read_bytes()
    assert snapshots(whole) == snapshots(parts)


def snapshots(folder):
    return sorted(path.name for path in (folder / "snapshots").iterdir())


@pytest.fixture
def whole(sazare, tmp_path):
    """The run that nobody disturbs."""
    done = sazare.run_block(tmp_path / "whole", OFTEN, LATER)
    assert done.returncode == DONE, done.stderr
    return tmp_path / "whole"


def start(sazare, folder, *options):
    return sazare.start("run", sazare.block, "--out", folder, "--threads", 1, "--set", OFTEN, "--set", LATER, *options)


def test_killed_again_and_again(sazare, tmp_path, whole):
    parts = tmp_path / "parts"
    kills = 0
    # Kills ever later, so that they come at any moment and the run gets to its end on any machine.
    for wait in itertools.accumulate(itertools.repeat(0.03), initial=0.01):
        process = start(sazare, parts, "--resume", "--quiet")
        try:
            process.communicate(timeout=wait)
        except TimeoutExpired:
            process.send_signal(signal.SIGKILL)
            process.communicate()
            kills += 1
            if (parts / "manifest.json").exists() and manifest(parts)["status"] == "done":
                break  # killed between its last file and its end
            continue
        assert process.returncode == DONE
        break
    assert kills > 3
    assert_same_results(whole, parts)


def test_killed_before_its_first_row(sazare, tmp_path, whole):
    """The checkpoint of the beginning comes before any row, and no other follows."""
    parts = tmp_path / "parts"
    seldom = ["--set", "output.checkpoint_interval=1000"]
    process = start(sazare, parts, *seldom)
    wait_for(parts / "checkpoint" / "state.h5")
    process.send_signal(signal.SIGKILL)
    process.communicate()
    resumed = start(sazare, parts, "--resume", *seldom)
    out, words = resumed.communicate(timeout=120)
    assert resumed.returncode == DONE, words
    assert "resumed at t = 0 s" in out
    assert_same_results(whole, parts)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_stopped_by_a_signal(sazare, tmp_path, whole, number):
    parts = tmp_path / "parts"
    process = start(sazare, parts)
    wait_for(parts / "checkpoint" / "state.h5")
    process.send_signal(number)
    _, words = process.communicate(timeout=60)
    assert process.returncode == MACHINE_FAILED
    assert "stopped at t = " in words and "with a checkpoint. To resume:" in words
    assert f"--out {parts} --resume" in words
    assert manifest(parts)["status"] == "stopped"
    resumed = start(sazare, parts, "--resume")
    out, words = resumed.communicate(timeout=120)
    assert resumed.returncode == DONE, words
    assert "resumed at t = " in out
    assert_same_results(whole, parts)


def test_killed_after_it_has_settled(sazare, tmp_path):
    case = settling_block(tmp_path)
    options = ["--threads", 1, "--set", OFTEN, "--set", LATER]
    done = sazare("run", case, "--out", tmp_path / "whole", *options)
    assert done.returncode == DONE, done.stderr
    assert "finding the equilibrium before the run begins" in done.stdout
    parts = tmp_path / "parts"
    process = sazare.start("run", case, "--out", parts, *options)
    wait_for(parts / "checkpoint" / "state.h5")
    time.sleep(0.2)
    process.send_signal(signal.SIGKILL)
    process.communicate()
    resumed = sazare("run", case, "--out", parts, *options, "--resume")
    assert resumed.returncode == DONE, resumed.stderr
    assert "resumed at t = " in resumed.stdout and "finding" not in resumed.stdout
    assert_same_results(tmp_path / "whole", parts)


def test_stopped_with_gas_in_cracks(sazare, tmp_path):
    short = ["--threads", 1, "--set", "mesh.parameters.size=0.02", "--set", "time.end=4e-5", "--set", OFTEN]
    case = ROOT / "cases/cylinder-blast/case.toml"
    done = sazare("run", case, "--out", tmp_path / "whole", *short)
    assert done.returncode == DONE, done.stderr
    parts = tmp_path / "parts"
    process = sazare.start("run", case, "--out", parts, *short)
    wait_for(parts / "history.csv")
    while rows_with_gas_in_cracks(parts / "history.csv") < 3:
        time.sleep(0.02)
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=60)
    assert process.returncode == MACHINE_FAILED
    resumed = sazare("run", case, "--out", parts, *short, "--resume")
    assert resumed.returncode == DONE, resumed.stderr
    assert_same_results(tmp_path / "whole", parts)


def rows_with_gas_in_cracks(history):
    """How many whole rows of a table that is being written have some."""
    lines = history.read_text(encoding="utf-8").splitlines()
    if not lines:
        return 0
    titles, *rows = lines
    column = titles.split(",").index("cord.in_cracks [J]")
    cells = [row.split(",") for row in rows]
    return sum(float(row[column]) > 0.0 for row in cells if len(row) == titles.count(",") + 1 and row[-1])


def test_stopped_before_the_ground_has_come_to_rest(sazare, tmp_path):
    process = sazare.start("run", ROOT / "cases/slope-el-centro/case.toml", "--out", tmp_path / "run", "--threads", 1)
    assert "Slopes" in process.stdout.readline()
    for line in process.stdout:
        if line == "finding the equilibrium under gravity\n":
            break
        assert line.startswith("  "), line  # what the supports hold
    process.send_signal(signal.SIGINT)
    _, words = process.communicate(timeout=60)
    assert process.returncode == MACHINE_FAILED
    assert "stopped before the first step" in words and f"--out {tmp_path / 'run'} --resume" in words
    assert manifest(tmp_path / "run")["status"] == "stopped"


DEEP = ('time.limiter="travel"', "time.travel_length=1e-6", "time.base_step=2e-6")  # a base step of up to 17 million ticks
ABSURD = "blasts.0.peak_pressure=5e13"  # Pa: a base step takes many minutes


def test_stopped_on_the_way_to_the_next_base_step(sazare, tmp_path):
    settings = [word for setting in (*DEEP, ABSURD) for word in ("--set", setting)]
    process = sazare.start("run", sazare.block, "--out", tmp_path / "run", "--threads", 1, *settings)
    wait_for(tmp_path / "run" / "checkpoint" / "state.h5")
    time.sleep(1)
    process.send_signal(signal.SIGTERM)
    _, words = process.communicate(timeout=60)
    assert process.returncode == MACHINE_FAILED
    assert "with a checkpoint. To resume:" in words


def test_motion_that_is_no_number_ends_a_run_on_the_way_to_the_next_base_step(sazare, tmp_path):
    failed = sazare.run_block(tmp_path, *DEEP, "blasts.0.peak_pressure=5e16")
    assert failed.returncode == PHYSICS_FAILED
    assert "has a motion that is no longer a number, found at t = 2.01" in failed.stderr
    assert "the checkpoint of t = 0 s is kept" in failed.stderr


def test_two_at_once_are_kept_apart(sazare, tmp_path):
    first = start(sazare, tmp_path / "run")
    wait_for(tmp_path / "run" / "checkpoint" / "state.h5")
    second = sazare.run_block(tmp_path / "run", options=["--resume"])
    first.send_signal(signal.SIGTERM)
    first.communicate(timeout=60)
    assert second.returncode == USER_ERROR
    assert "another sazare process is using this folder" in second.stderr


@pytest.mark.parametrize("threads", [2, 4])
def test_threads_do_not_change_the_bits(sazare, tmp_path, whole, threads):
    done = sazare("run", sazare.block, "--out", tmp_path / "threads", "--threads", threads, "--set", OFTEN, "--set", LATER)
    assert done.returncode == DONE, done.stderr
    assert manifest(tmp_path / "threads")["state_hash"] == manifest(whole)["state_hash"]


def wait_for(path):
    end = time.monotonic() + 60
    while not path.exists():
        assert time.monotonic() < end, f"{path} did not appear"
        time.sleep(0.002)
