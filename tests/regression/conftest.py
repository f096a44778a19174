"""Runs the program on the small block. SAZARE_PROGRAM names the program; without it the one of build/release is tested."""

import csv
import json
import os
import signal
import subprocess
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("SAZARE_PROGRAM", ROOT / "build/release/apps/sazare/sazare"))
BLOCK = Path(__file__).parent / "block" / "case.toml"
# Open MPI never gives back some of its memory, which is no news where the address sanitizer watches.
MPI_ENVIRONMENT = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "ASAN_OPTIONS": "detect_leaks=0"}
DONE, USER_ERROR, PHYSICS_FAILED, MACHINE_FAILED = 0, 2, 3, 4


class Sazare:
    """The program, with what tests ask of it."""

    program = PROGRAM
    block = BLOCK

    def command(self, *arguments):
        """The arguments of a process, as text."""
        return [str(PROGRAM), *map(str, arguments)]

    def ranks_command(self, ranks, *arguments):
        """The arguments that start the program as so many processes."""
        return ["mpirun", "--oversubscribe", "-n", str(ranks), *self.command(*arguments)]

    def on_ranks(self, ranks, *arguments):
        """Runs to the end as so many processes; output as text."""
        return subprocess.run(
            self.ranks_command(ranks, *arguments), capture_output=True, text=True, check=False, timeout=600, env=MPI_ENVIRONMENT
        )

    def __call__(self, *arguments, **options):
        """Runs to the end; output as text."""
        return subprocess.run(self.command(*arguments), capture_output=True, text=True, check=False, timeout=120, **options)

    def start(self, *arguments):
        """A process that goes on."""
        return subprocess.Popen(self.command(*arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    def start_on(self, ranks, *arguments):
        """So many processes that go on; 0 stands for one without a launcher."""
        if ranks == 0:
            return self.start(*arguments)
        return subprocess.Popen(
            self.ranks_command(ranks, *arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=MPI_ENVIRONMENT
        )

    def run_block(self, folder, *settings, options=(), **more):
        """Runs the small block into a folder."""
        sets = [word for setting in settings for word in ("--set", setting)]
        return self("run", BLOCK, "--out", folder, "--threads", 1, *sets, *options, **more)


def kill_one(launcher):
    """Kills a process of a run that is not the first one."""
    children = subprocess.run(["pgrep", "-P", str(launcher.pid)], capture_output=True, text=True, check=True).stdout.split()
    os.kill(int(children[-1]), signal.SIGKILL)


def wait_for(path):
    end = time.monotonic() + 60
    while not path.exists():
        assert time.monotonic() < end, f"{path} did not appear"
        time.sleep(0.002)


def settling_block(folder):
    """The small block on an absorbing face, at its equilibrium under a heavy weight before its blast, beside its mesh."""
    text = BLOCK.read_text(encoding="utf-8").replace('"block.msh"', f'"{BLOCK.parent}/block.msh"')
    text += '\n[gravity]\nacceleration = [0.0, 0.0, -9810.0]\nsettle = true\n\n[[boundaries]]\nsurface = "far"\nkind = "absorbing"\n'
    case = folder / "settling.toml"
    case.write_text(text, encoding="utf-8")
    return case


@pytest.fixture
def sazare():
    return Sazare()


def manifest(folder):
    """manifest.json of a run."""
    return json.loads((folder / "manifest.json").read_text())


def rows_without_wall_time(table):
    """The lines of history.csv without their last column."""
    return [line.rpartition(",")[0] for line in table.read_text().splitlines()]


def assert_same_results(one, many):
    """The same bits in the state and in every table and snapshot, whoever worked for which part and however often it was stopped."""
    first, second = manifest(one), manifest(many)
    assert first["status"] == second["status"] == "done"
    assert first["state_hash"] == second["state_hash"]
    first["results"].pop("wall_seconds")
    second["results"].pop("wall_seconds")
    assert first["results"] == second["results"]
    assert rows_without_wall_time(one / "history.csv") == rows_without_wall_time(many / "history.csv")
    tables = {"gauges.csv", "gauge_peaks.csv", "fragments.csv", "walls.csv"} & {path.name for path in one.iterdir()}
    snapshots = [path.relative_to(one) for path in (one / "snapshots").glob("*.vtkhdf")]
    assert snapshots
    for name in (*sorted(tables), *snapshots):
        assert (one / name).read_bytes() == (many / name).read_bytes(), name


def rank_rows(folder):
    """The rows of ranks.csv, with numbers by the names of their columns without units."""
    with open(folder / "ranks.csv", newline="") as stream:
        return [{title.split(" ")[0]: float(text) for title, text in row.items()} for row in csv.DictReader(stream)]
