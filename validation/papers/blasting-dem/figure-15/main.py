"""Runs the blast on 8 and 24 processes with fixed and re-allocated ranges, and prints how their processor times differ."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import sazare

ROOT = Path(__file__).resolve().parents[4]
PROGRAM = ROOT / "build/release/apps/sazare/sazare"
CASE = ROOT / "cases/free-face-blast/case.toml"


def run(folder, ranks, balance, interval=50):
    """Carries out the case; the run's results."""
    command = [PROGRAM, "run", CASE, "--out", folder, "--threads", "1", "--quiet", "--balance", balance,
               "--balance-interval", str(interval)]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-n", str(ranks), *command]
    environment = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return sazare.open(folder)


def processor_times(results, ranks):
    """Of every rank, over the whole run [s]."""
    table = results.ranks
    return [table["processor_time"][table["rank"] == rank][-1] for rank in range(ranks)]


def main():
    if shutil.which("mpirun") is None:
        sys.exit("there is no mpirun: install Open MPI")
    with tempfile.TemporaryDirectory() as folder:
        alone = run(Path(folder) / "alone", 1, "fixed").manifest["state_hash"]
        same = 0
        for ranks in (8, 24):
            for balance, interval in (("fixed", 50), ("measured", 50), ("predicted", 20)):
                results = run(Path(folder) / f"{balance}{ranks}", ranks, balance, interval)
                times = processor_times(results, ranks)
                print(f"{balance}-{ranks},{max(times) / min(times)}")
                same += results.manifest["state_hash"] == alone
        print(f"same-bits,{same}")


if __name__ == "__main__":
    main()
