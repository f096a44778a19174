"""Rows of method mps: particle-steps per second."""

import os
import subprocess

from table import Limit, NotRun, Row

SCENES = {"plane-4k": "2-D, 8 neighbours, 4000 particles", "plane-100k": "2-D, 8 neighbours, 100 000 particles",
          "solid-16k": "3-D, 18 neighbours, 16 000 particles"}
GOAL = 1e7  # particle-steps per second and core in 2-D


def rates_of(bench, threads):
    """Particle-steps per second by scene, the best of some runs. Raises NotRun."""
    if not _found:
        counts = [1, 2] if (os.cpu_count() or 1) > 1 else [1]
        for _ in range(bench.options.repeats):  # in turns, so that what disturbs the machine disturbs both
            for count in counts:
                best = _found.setdefault(count, {})
                for scene, rate in run_once(bench, count).items():
                    best[scene] = max(rate, best.get(scene, 0.0))
    return _found[threads]


def run_once(bench, threads):
    """Particle-steps per second by scene in one run. Raises NotRun."""
    program = bench.options.build / "benchmarks" / "particles"
    # Idle threads spin for a moment only, as in the command.
    done = subprocess.run([program, str(threads)], capture_output=True, text=True, check=False,
                          env=os.environ | {"GOMP_SPINCOUNT": "10000"})
    if done.returncode != 0:
        raise NotRun(f"exit code {done.returncode}: {done.stderr.strip()}")
    return {row.split(",")[0]: float(row.split(",")[2]) for row in done.stdout.splitlines()}


_found = {}  # by number of threads


def scene_rows(scene, words):
    """The rows of one scene: one thread, and what a second one brings."""

    def speed_up(bench):
        if (os.cpu_count() or 1) < 2:
            raise NotRun("this machine has one core")
        return rates_of(bench, 2)[scene] / rates_of(bench, 1)[scene]

    return [
        Row(f"mps/ourselves-{scene}-rate", f"particle-steps per second, {words}, 1 thread", "1/s",
            lambda bench: rates_of(bench, 1)[scene], limit=Limit("ours", low=GOAL) if scene.startswith("plane") else None,
            more_is_better=True),
        Row(f"mps/ourselves-{scene}-two-threads", f"rate with 2 threads over that with 1, {words}", "-", speed_up,
            limit=Limit("ours", low=1.8) if scene.startswith("plane") else None, more_is_better=True),
    ]


def rows():
    """All rows of method mps."""
    return [row for scene, words in SCENES.items() for row in scene_rows(scene, words)]
