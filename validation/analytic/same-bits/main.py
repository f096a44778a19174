"""The blast with 1, 2 and 4 threads, and killed again and again: the states at the end."""

import itertools
import subprocess
import sys
import tempfile
from pathlib import Path

import sazare

ROOT = Path(__file__).resolve().parents[3]
COMMAND = [ROOT / "build/release/apps/sazare/sazare", "run", ROOT / "cases/free-face-blast/case.toml", "--quiet"]
OFTEN = ["--set", "output.checkpoint_interval=0.02"]  # s of wall time


def run(folder, *options):
    done = subprocess.run([*COMMAND, "--out", folder, *options], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return sazare.open(folder)


def run_and_kill(folder, first=0.05, later=0.05):
    """Killed ever later, so that it comes to its end on any machine. Returns how often, and the results."""
    for kills in itertools.count():
        resume = ["--resume"] if kills else []
        try:
            subprocess.run([*COMMAND, "--out", folder, "--threads", "1", *OFTEN, *resume], timeout=first + later * kills, check=True)
        except subprocess.TimeoutExpired:  # it was sent SIGKILL
            continue
        return kills, sazare.open(folder)


def hashes(*results):
    """How many different ones."""
    return len({each.manifest["state_hash"] for each in results})


def main():
    with tempfile.TemporaryDirectory() as place:
        runs = [run(Path(place) / str(threads), "--threads", str(threads), *OFTEN) for threads in (1, 2, 4)]
        kills, killed = run_and_kill(Path(place) / "killed")
        level = runs[0].snapshots[-1].elements["level"]
        print(f"hashes,{hashes(*runs)}")
        print(f"hashes-killed,{hashes(runs[0], killed)}")
        print(f"kills,{kills}")
        print(f"broken,{runs[0].figures['broken_joints']}")
        print(f"levels,{level.max() - level.min()}")


if __name__ == "__main__":
    main()
