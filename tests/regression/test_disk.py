"""A disk that is full or not writable ends a run with words, and nothing half-written under a final name."""

import os
import resource
import subprocess

import pytest
from conftest import DONE, MACHINE_FAILED, manifest

CHECKPOINTS = "output.checkpoint_interval=0.02"


def assert_nothing_half_written(folder):
    left = [path.relative_to(folder).as_posix() for path in folder.rglob("*") if path.name.endswith(".part")]
    assert left == []
    for table in folder.glob("*.csv"):
        text = table.read_text()
        assert text.endswith("\n")
        assert len({line.count(",") for line in text.splitlines()}) == 1


def limit_file_size(size):
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, resource.RLIM_INFINITY))


def test_file_that_may_not_grow(sazare, tmp_path):
    """The history grows past the limit while the run goes on."""
    limited = sazare.run_block(tmp_path, "time.history_interval=1e-7", "time.snapshot_interval=4e-4", CHECKPOINTS,
                               preexec_fn=limit_file_size(700_000))
    assert limited.returncode == MACHINE_FAILED, limited.stdout + limited.stderr
    assert "history.csv: cannot be written" in limited.stderr
    assert "the checkpoint of t = " in limited.stderr
    assert_nothing_half_written(tmp_path)


def test_resumed_when_there_is_room_again(sazare, tmp_path):
    settings = ("time.history_interval=1e-7", "time.snapshot_interval=4e-4", CHECKPOINTS)
    sazare.run_block(tmp_path / "run", *settings, preexec_fn=limit_file_size(700_000))
    assert manifest(tmp_path / "run")["status"] == "stopped"
    resumed = sazare.run_block(tmp_path / "run", *settings, options=["--resume"])
    assert resumed.returncode == DONE, resumed.stderr
    whole = sazare.run_block(tmp_path / "whole", *settings)
    assert whole.returncode == DONE
    assert manifest(tmp_path / "run")["state_hash"] == manifest(tmp_path / "whole")["state_hash"]


@pytest.fixture
def small_disk(tmp_path):
    """A file system with room for a few hundred kilobytes; only root can make one."""
    disk = tmp_path / "disk"
    disk.mkdir()
    made = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=600k", "tmpfs", disk], capture_output=True, check=False)
    if made.returncode != 0:
        yield None
        return
    yield disk
    subprocess.run(["umount", disk], check=True)


def test_full_disk(sazare, tmp_path, small_disk):
    """Where no file system can be made, the limit on the size of files stands in for it: snapshots are the first to meet it."""
    folder = (small_disk or tmp_path) / "run"
    limits = {} if small_disk else {"preexec_fn": limit_file_size(60_000)}
    full = sazare.run_block(folder, "time.snapshot_interval=2e-6", **limits)
    assert full.returncode == MACHINE_FAILED, full.stdout + full.stderr
    assert "cannot be written" in full.stderr
    assert "--out" in full.stderr
    assert_nothing_half_written(folder)


def test_folder_that_is_not_writable(sazare, tmp_path):
    folder = tmp_path / "closed"
    folder.mkdir()
    target = folder / "run"
    if os.geteuid() == 0:  # root may write anywhere but where there are no files at all
        target = "/proc/sazare-run"
    else:
        folder.chmod(0o555)
    closed = sazare.run_block(target)
    assert closed.returncode == MACHINE_FAILED
    assert f"{target}: cannot be written" in closed.stderr
    assert "--out" in closed.stderr


@pytest.mark.parametrize("arguments", [["--help"], ["--version"], ["run", "--help"], ["schema"]])
def test_full_disk_behind_standard_output(sazare, arguments):
    with open("/dev/full", "w") as full:
        done = subprocess.run([sazare.program, *arguments], stdout=full, stderr=subprocess.PIPE, text=True, timeout=60)
    assert done.returncode == MACHINE_FAILED
    assert done.stderr.startswith("the machine failed: ")
