"""Runs cases as several processes and reads what their ranks did."""

import os
import subprocess
import sys
from pathlib import Path

import sazare

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "build/release/apps/sazare/sazare"


def run(case, folder, ranks, *options, settings=()):
    """Carries out a case of the folder cases; the run's results."""
    command = [PROGRAM, "run", ROOT / "cases" / case / "case.toml", "--out", folder, "--threads", "1", "--quiet", *options]
    command += [word for setting in settings for word in ("--set", setting)]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-n", str(ranks), *command]
    environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    try:
        done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    except FileNotFoundError as missing:
        sys.exit(f"{missing.filename} is missing: install Open MPI")
    if done.returncode != 0:
        sys.exit(done.stderr)
    return sazare.open(folder)


def processor_times(results):
    """Processor time of every rank over the whole run [s]."""
    return last_of_each(results, "processor_time")


def last_of_each(results, column):
    """The last value of a column for every rank."""
    table = results.ranks
    return [table[column][table["rank"] == rank][-1] for rank in sorted(set(table["rank"]))]
