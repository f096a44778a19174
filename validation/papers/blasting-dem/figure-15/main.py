"""Runs the blast on 8 and 24 processes with fixed and re-allocated ranges, and prints how their processor times differ."""

import sys
import tempfile
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[3] / "common"))

from ranks import processor_times, run

CASE = "free-face-blast"


def main():
    with tempfile.TemporaryDirectory() as folder:
        same, spread = 0, {}
        alone = run(CASE, Path(folder) / "alone", 1).manifest["state_hash"]
        for ranks in (8, 24):
            for balance, interval in (("printed_fixed", 50), ("printed", 50), ("predicted", 20)):
                options = ("--balance", balance, "--balance-interval", str(interval))
                results = run(CASE, Path(folder) / f"{balance}{ranks}", ranks, *options)
                times = processor_times(results)
                spread[balance, ranks] = max(times) / min(times)
                same += results.manifest["state_hash"] == alone
                if balance != "printed_fixed":
                    print(f"{balance}-{ranks},{spread[balance, ranks]}")
        print(f"gain-24,{spread['printed_fixed', 24] / spread['printed', 24]}")
        print(f"same-bits,{same}")
        print(f"fixed shares: {spread['printed_fixed', 8]:.3g} on 8 and {spread['printed_fixed', 24]:.3g} on 24 ranks", file=sys.stderr)


if __name__ == "__main__":
    main()
