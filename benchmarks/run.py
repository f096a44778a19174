"""Measures speed and memory, and puts the figures beside those of others.

    python benchmarks/run.py [--only PART_OF_AN_ID ...] [--repeats N] [--largest ELEMENTS] [--long] [--keep]

Written is build/bench/results.csv (id,quantity,unit,ours,peer,peer_value,ratio,limit). Every row is in it; one that has no
value says why. Ends with 1 when a limit was missed or a chosen row could not be measured.
"""

import argparse
import os
import platform
import re
import sys
from pathlib import Path

import block_rows
import coupled_rows
import full_rows
import particle_rows
import slab_rows
import square_rows
import sphere_rows
from bench import ROOT, Bench, Options
from table import NotChosen, keep, print_summary, write_table


def read_options():
    """The command line."""
    parser = argparse.ArgumentParser(description="Measure speed and memory.")
    parser.add_argument("--only", nargs="*", default=[], metavar="PART", help="only rows with this in their id")
    parser.add_argument("--list", action="store_true", help="print all rows and measure nothing")
    parser.add_argument("--repeats", type=int, default=3, help="runs of each scene, the fastest counts (default 3)")
    parser.add_argument("--largest", type=int, default=1_000_000, help="elements of the largest block (default 1000000)")
    parser.add_argument("--long", action="store_true", help="also the scenes that take more than ten minutes")
    parser.add_argument("--time-limit", type=float, default=3600.0, help="of one run [s] (default 3600)")
    parser.add_argument("--build", default="build/release", help="where the programs were built (default build/release)")
    parser.add_argument("--keep", action="store_true", help="also write benchmarks/results/<machine>/blocks.csv")
    return parser.parse_args()


def machine_name():
    """Processor model and number of cores, as part of a path: intel-xeon-processor-2-cores."""
    model = platform.processor() or platform.machine()
    information = Path("/proc/cpuinfo")
    if information.exists():
        found = re.search(r"^model name\s*:\s*(.+)$", information.read_text(encoding="utf-8"), re.MULTILINE)
        model = found[1] if found else model
    plain = re.sub(r"\((R|TM)\)", "", model, flags=re.IGNORECASE)
    return re.sub(r"[^a-z0-9.]+", "-", f"{plain} {os.cpu_count()} cores".lower()).strip("-")


def choose(rows, only):
    """The rows to measure; the others say that they are not."""
    chosen = [row for row in rows if not only or any(part in row.id for part in only)]
    for row in rows:
        if row not in chosen:
            row.leave_out(NotChosen("not chosen by --only"))
    return chosen


def measure(row, bench):
    """Fills a row and says what it found."""
    print(f"{row.id}: {row.quantity}", flush=True)
    row.fill(bench)
    unit = f" {row.unit}" if row.has_value and row.unit != "-" else ""
    verdict = f"  ({row.limit}: {row.verdict})" if row.has_value and row.limit else ""
    print(f"    {row.cells['ours']}{unit}{verdict}", flush=True)


def main():
    options = read_options()
    rows = slab_rows.rows() + full_rows.rows() + block_rows.rows() + particle_rows.rows() + square_rows.rows() + sphere_rows.rows() + coupled_rows.rows()
    if options.list:
        print("\n".join(f"{row.id}: {row.quantity}" for row in rows))
        return 0
    out = ROOT / "build" / "bench"
    out.mkdir(parents=True, exist_ok=True)
    bench = Bench(Options(ROOT / options.build, out, options.repeats, options.time_limit, options.long, options.largest))
    chosen = choose(rows, options.only)
    for row in chosen:
        measure(row, bench)
        write_table([row.cells for row in rows], out / "results.csv")  # each time: an interrupted campaign keeps its rows
    print()
    print_summary(chosen)
    if bench.busy:
        print(f"The machine was busy with other work, times are too long, in: {', '.join(bench.busy)}.")
    written = [out / "results.csv"]
    if options.keep:
        written.append(ROOT / "benchmarks" / "results" / machine_name() / "blocks.csv")
        keep(rows, written[-1])
    missed, failed = (sum(row.verdict == verdict for row in chosen) for verdict in ("MISSED", "not run"))
    measured, files = sum(row.has_value for row in rows), ", ".join(str(path.relative_to(ROOT)) for path in written)
    print(f"{measured} of {len(rows)} rows measured, {failed} could not be, {missed} missed their limit; {files}")
    return 1 if missed or failed or not chosen else 0


if __name__ == "__main__":
    sys.exit(main())
