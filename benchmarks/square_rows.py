"""Rows of method rectangles: element-steps per second, against the circular element (one spring on a face) in the same run."""

import os
import subprocess

from table import Limit, NotRun, Row

RATES = {"lattice-10k-N1": "10 000 circular elements, 1 spring on a face", "lattice-10k-N5": "10 000 squares, 5 springs on a face",
         "lattice-100k-N5": "100 000 squares, 5 springs on a face", "lattice-1m-N5": "1 million squares, 5 springs on a face",
         "packing-10k-N5": "10 000 irregular polygons, 5 springs on a face",
         "packing-100k-N5": "100 000 irregular polygons, 5 springs on a face",
         "bent-10k-N5": "10 000 squares, every link slipping, 5 springs on a face"}
MOST_FOR_FIVE = 1.6  # time of 5 springs over that of 1; the paper reports less than 2
MOST_GROWTH = 1.3  # linear: rates of one scene vary by a quarter from run to run
_found = {}


def rates_of(bench, threads):
    """Element-steps per second by scene. Raises NotRun."""
    if threads not in _found:
        program = bench.options.build / "benchmarks" / "squares"
        done = subprocess.run([program, str(threads)], capture_output=True, text=True, check=False,
                              env=os.environ | {"GOMP_SPINCOUNT": "10000"})
        if done.returncode != 0:
            raise NotRun(f"exit code {done.returncode}: {done.stderr.strip()}")
        _found[threads] = {row.split(",")[0]: float(row.split(",")[2]) for row in done.stdout.splitlines()}
    return _found[threads]


def ratio(slow, fast, threads=1):
    """Time per element-step of one scene over that of another."""
    return lambda bench: rates_of(bench, threads)[fast] / rates_of(bench, threads)[slow]


def two_threads(bench):
    """Rate of the largest scene with a second thread over that without."""
    if (os.cpu_count() or 1) < 2:
        raise NotRun("this machine has one core")
    return rates_of(bench, 2)["lattice-1m-N5"] / rates_of(bench, 1)["lattice-1m-N5"]


def rows():
    """All rows of method rectangles."""
    return [
        *(Row(f"rectangles/ourselves-{scene}-rate", f"element-steps per second, {words}, 1 thread", "1/s",
              lambda bench, scene=scene: rates_of(bench, 1)[scene], more_is_better=True) for scene, words in RATES.items()),
        Row("rectangles/ourselves-five-springs",
            "time per step with 5 springs on a face over that of the circular element, whole links", "-",
            ratio("lattice-10k-N5", "lattice-10k-N1"), limit=Limit("ours", high=MOST_FOR_FIVE)),
        Row("rectangles/ourselves-five-springs-slipping", "the same, every link slipping", "-",
            ratio("bent-10k-N5", "bent-10k-N1")),
        Row("rectangles/ourselves-growth", "time per element-step of 1 million elements over that of 100 000, both from memory", "-",
            ratio("lattice-1m-N5", "lattice-100k-N5"), limit=Limit("ours", high=MOST_GROWTH)),
        Row("rectangles/ourselves-cache", "time per element-step of 1 million elements over that of 10 000, which the cache holds", "-",
            ratio("lattice-1m-N5", "lattice-10k-N5")),
        Row("rectangles/ourselves-two-threads", "rate of 1 million elements with 2 threads over that with 1", "-", two_threads,
            more_is_better=True),
    ]
