"""Runs the whole specimen on 2, 8 and 24 processes, and prints what the shares of their work allow."""

import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[3] / "common"))

from ranks import last_of_each, processor_times, run

SHORT = ("time.end=2.5e-5", "time.snapshot_interval=2.5e-5")
OPTIONS = ("--balance-interval", "10")


def main():
    with tempfile.TemporaryDirectory() as folder:
        least = None
        for ranks in (2, 8, 24):
            results = run("free-face-blast-full", Path(folder) / str(ranks), ranks, *OPTIONS, settings=SHORT)
            times = processor_times(results)
            least = least or sum(times)
            print(f"bound-{ranks},{sum(times) / max(times)}")
            if ranks > 2:
                print(f"acceleration-{ranks},{least / max(times)}")
            print(f"megabytes-{ranks},{1e-6 * sum(last_of_each(results, 'bytes_sent')) / results.figures['steps']}")


if __name__ == "__main__":
    main()
