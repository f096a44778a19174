"""Runs the blast on 8 and 24 processes with fixed and re-allocated ranges, and prints how the processor times of the latter differ."""

import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[3] / "common"))

from ranks import processor_times, run

CASE = "free-face-blast"


def main():
    with tempfile.TemporaryDirectory() as folder:
        same = 0
        alone = run(CASE, Path(folder) / "alone", 1).manifest["state_hash"]
        for ranks in (8, 24):
            for balance, interval in (("fixed", 50), ("measured", 50), ("predicted", 20)):
                options = ("--balance", balance, "--balance-interval", str(interval))
                results = run(CASE, Path(folder) / f"{balance}{ranks}", ranks, *options)
                times = processor_times(results)
                if balance != "fixed":
                    print(f"{balance}-{ranks},{max(times) / min(times)}")
                same += results.manifest["state_hash"] == alone
        print(f"same-bits,{same}")


if __name__ == "__main__":
    main()
