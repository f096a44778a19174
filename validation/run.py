"""Runs the validation programs and puts their results beside the expected values.

    python validation/run.py [--build build/release] [--only PART_OF_A_FOLDER ...] [--jobs 2] [--write-docs]

Each folder with an expected.csv has one program of the same path under <build>/validation, or a main.py. It prints `row,ours` or, where
the expected value is computed by other means, `row,ours,expected`. Written are build/validation/results.csv
(id,quantity,unit,expected,source,ours,tolerance,verdict) and the same as a page, build/validation/index.html; with
--write-docs also docs/reference/validation.md. With --only these two are not written: the table has all rows or none; of the page only
the sections of the chosen folders are. Ends with 1 when a row failed or could not be run.

Rows under measured/ compare with experiments: they are `within` the scatter of the measurement or not. A row that is known not to be names in
`recorded` the values between which ours was found, and in `why` a reason; it is `outside`, and fails when it leaves these too.
"""

import argparse
import csv
import html
import math
import os
import re
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
COLUMNS = ("id", "quantity", "unit", "expected", "source", "ours", "tolerance", "verdict")
PASSED, FAILED, NOT_RUN = "passed", "FAILED", "not run"
WITHIN, OUTSIDE = "within", "outside"  # of the scatter of a measurement
MEASURED = "measured/"  # folders of experiments
TIME_LIMIT = 1800  # seconds of one program
BEGUN_FIRST = tuple(f"papers/blasting-dem/{name}" for name in ("figure-15", "figure-14", "figure-13", "section-4-3"))  # the longest
INTRODUCTION = ("Expected values beside ours, as `make validate` found them. The folder of a row, under `validation/`, says "
                "in its README what is compared and why the tolerance is what it is.")
OF_MEASUREMENTS = ("Published experiments beside ours. The tolerance is the scatter of the measurement, chosen before the run: ours is `within` it "
                   "or `outside`. What was fitted to the measurement is said of each.")


@dataclass
class Row:
    id: str
    quantity: str
    unit: str
    expected: str
    source: str
    ours: str
    tolerance: str
    verdict: str
    why: str = ""  # it is outside

    def cells(self):
        return tuple(getattr(self, name) for name in COLUMNS)


def short(value):
    """A number with five significant digits, whole numbers in full."""
    whole = math.isfinite(value) and value == int(value) and abs(value) < 1e9
    return f"{value:.0f}" if whole else f"{value:.5g}"


def tolerance_text(entry):
    """How the comparison of a row reads in the table."""
    compare, tolerance = entry["compare"], entry["tolerance"]
    if compare == "relative":
        return f"{short(100 * float(tolerance))} %"
    if compare == "absolute":
        return f"+-{short(float(tolerance))}" if float(tolerance) else "equal"
    return compare


def agrees(compare, tolerance, expected, ours):
    """Whether our value is as it should be."""
    if not math.isfinite(ours):
        return False
    if compare == "relative":
        return abs(ours - expected) <= float(tolerance) * abs(expected)
    if compare == "absolute":
        return abs(ours - expected) <= float(tolerance)
    if compare == "at most":
        return ours <= expected
    if compare == "at least":
        return ours >= expected
    raise ValueError(f"unknown comparison {compare!r}: use relative, absolute, at most or at least")


def parse_output(text):
    """What a program printed by row, as (ours, expected or None)."""
    values = {}
    for line in csv.reader(text.splitlines()):
        if len(line) not in (2, 3):
            raise ValueError(",".join(line))
        values[line[0]] = (float(line[1]), float(line[2]) if len(line) > 2 else None)
    return values


def run_program(program):
    """What a program printed by row; or why there is nothing. A program that ends badly has no rows that count."""
    if not program.exists():
        return {}, f"{program} is not built"
    command = [sys.executable, program] if program.suffix == ".py" else [program]
    # One thread each, since several programs run at once; whoever asks for more does not spin while it waits for the others.
    environment = os.environ | {"OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"}
    try:
        done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True, timeout=TIME_LIMIT,
                              check=False)
    except subprocess.TimeoutExpired:
        return {}, f"no end after {TIME_LIMIT} s"
    if done.returncode != 0:
        return {}, f"exit code {done.returncode}: {done.stderr.strip()[-200:]}"
    try:
        return parse_output(done.stdout), ""
    except ValueError as error:
        return {}, f"printed what is no row: {error}"


def compare_row(folder, entry, values, why):
    """One row of the table."""
    row = Row(f"{folder}/{entry['row']}", entry["quantity"], entry["unit"], entry["expected"], entry["source"], "",
              tolerance_text(entry), NOT_RUN)
    if entry["row"] not in values:
        row.ours = why or "not printed by the program"
        return row
    ours, computed = values[entry["row"]]
    expected = float(entry["expected"]) if computed is None else computed
    row.expected, row.ours = short(expected), short(ours)
    row.verdict = verdict_of(folder, entry, agrees(entry["compare"], entry["tolerance"], expected, ours), ours)
    row.why = entry["why"] if row.verdict == OUTSIDE else ""
    return row


def verdict_of(folder, entry, agreed, ours):
    """The verdict of a row by whether it agrees with what is expected."""
    if not folder.startswith(MEASURED):
        return PASSED if agreed else FAILED
    if agreed:
        return WITHIN
    if not entry.get("recorded"):
        return FAILED
    low, high = (float(bound) for bound in entry["recorded"].split())
    return OUTSIDE if low <= ours <= high else FAILED


def all_folders():
    return sorted(path.parent.relative_to(ROOT / "validation").as_posix() for path in (ROOT / "validation").rglob("expected.csv"))


def expected_rows(folder):
    with open(ROOT / "validation" / folder / "expected.csv", newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def validate(folder, build):
    """All rows of one folder, as soon as they are known also on the screen."""
    began = time.monotonic()
    entries = expected_rows(folder)
    script = ROOT / "validation" / folder / "main.py"
    values, why = run_program(script if script.exists() else build / "validation" / folder)
    rows = [compare_row(folder, entry, values, why) for entry in entries]
    for name in sorted(values.keys() - {entry["row"] for entry in entries}):
        rows.append(Row(f"{folder}/{name}", "", "", "", "not in expected.csv", short(values[name][0]), "", FAILED))
    lines = [f"{folder} ({time.monotonic() - began:.0f} s)"]
    for row in rows:
        name = row.id.rsplit("/", 1)[1]
        lines.append(f"  {row.verdict:8s} {name}: ours {row.ours} {row.unit}, expected {row.expected} ({row.tolerance})")
    print("\n".join(lines), flush=True)
    return rows


def summary(verdicts):
    counts = {verdict: verdicts.count(verdict) for verdict in (PASSED, FAILED, NOT_RUN, WITHIN, OUTSIDE)}
    told = [f"{counts[verdict]} {verdict}" for verdict in (PASSED, FAILED, NOT_RUN)]
    told += [f"{counts[verdict]} {verdict} the scatter of a measurement" for verdict in (WITHIN, OUTSIDE) if counts[verdict]]
    return f"{len(verdicts)} rows: " + ", ".join(told)


def write_csv(rows, path):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(COLUMNS)
        writer.writerows(row.cells() for row in rows)


def write_page(rows, path):
    """The table as a page that opens in a browser."""
    colors = {PASSED: "#e6f4e6", WITHIN: "#e6f4e6", OUTSIDE: "#fff3cd", FAILED: "#f9d6d5", NOT_RUN: "#fff3cd"}
    lines = ["<!doctype html>", '<html lang="en"><meta charset="utf-8"><title>Sazare: validation</title>',
             "<style>body{font-family:sans-serif;margin:2em}td,th{padding:.2em .6em;text-align:left;vertical-align:top}",
             "table{border-collapse:collapse;font-size:90%}tr{border-bottom:1px solid #ddd}</style>", "<h1>Validation</h1>",
             f"<p>{html.escape(INTRODUCTION)}</p>", f"<p>{summary([row.verdict for row in rows])}.</p>",
             "<table><tr>" + "".join(f"<th>{column}</th>" for column in COLUMNS) + "</tr>"]
    for row in rows:
        cells = "".join(f"<td>{html.escape(cell)}</td>" for cell in row.cells())
        lines.append(f'<tr style="background:{colors[row.verdict]}">{cells}</tr>')
    path.write_text("\n".join(lines) + "\n</table></html>\n", encoding="utf-8")


def fitted(folder):
    """What the README of an experiment says under its heading of what was fitted."""
    text = (ROOT / "validation" / folder / "README.md").read_text(encoding="utf-8")
    return " ".join(text.split("\n## What was fitted\n", 1)[1].split("\n## ", 1)[0].split())


def docs_section(folder, rows):
    """The section of a folder on the page of the documentation."""
    measured = folder.startswith(MEASURED)
    lines = [f"{'###' if measured else '##'} [{folder}](../../validation/{folder}/README.md)", ""]
    if measured:
        lines += [f"Fitted: {fitted(folder)}", ""]
    lines += ["| row | " + " | ".join(COLUMNS[1:]) + " |", "|" + "---|" * len(COLUMNS)]
    for row in rows:
        cells = (row.id.rsplit("/", 1)[1], *row.cells()[1:])
        lines.append("| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in cells) + " |")
    outside = [f"- `{row.id.rsplit('/', 1)[1]}` is outside: {row.why}" for row in rows if row.why]
    lines += ["", *outside] if outside else []
    return "\n".join(lines) + "\n"


def sections_of(page):
    """The sections of the page by folder, as they stand there."""
    sections = {}
    for section in re.split(r"\n(?=##+ )", page)[1:]:
        mark, _, rest = section.partition(" [")
        folder = rest.split("]", 1)[0]
        if set(mark) == {"#"} and (ROOT / "validation" / folder / "expected.csv").exists():
            sections[folder] = section.rstrip("\n") + "\n"
    return sections


def verdicts_in(section):
    """The last cells of a section's table."""
    lines = [line for line in section.splitlines() if line.startswith("| ")]
    return [line.rsplit("| ", 1)[1].removesuffix(" |") for line in lines[1:]]


def write_docs(rows, path):
    """The table as a page of the documentation: one section per folder, and the experiments together at its end. Sections of folders without
    rows here stay as they are; folders that have none yet are said not to have been run."""
    sections = sections_of(path.read_text(encoding="utf-8")) if path.exists() else {}
    for folder in dict.fromkeys(row.id.rsplit("/", 1)[0] for row in rows):
        sections[folder] = docs_section(folder, [row for row in rows if row.id.rsplit("/", 1)[0] == folder])
    for folder in set(all_folders()) - set(sections):
        sections[folder] = docs_section(folder, [compare_row(folder, entry, {}, "not run yet") for entry in expected_rows(folder)])
    verdicts = [verdict for section in sections.values() for verdict in verdicts_in(section)]
    head = ["# Validation", "", "<!-- written by validation/run.py --write-docs -->", "", INTRODUCTION, "", f"{summary(verdicts)}.", ""]
    calculated = [sections[folder] for folder in sorted(sections) if not folder.startswith(MEASURED)]
    measured = [sections[folder] for folder in sorted(sections) if folder.startswith(MEASURED)]
    path.write_text("\n".join([*head, *calculated, f"## Measurements\n\n{OF_MEASUREMENTS}\n", *measured]), encoding="utf-8")


def parse_arguments():
    parser = argparse.ArgumentParser(description="Compare with theory, papers and experiments.")
    parser.add_argument("--build", default="build/release", help="where the programs were built")
    parser.add_argument("--only", nargs="*", default=[], help="parts of the names of folders")
    parser.add_argument("--jobs", type=int, default=2, help="programs at a time")
    parser.add_argument("--write-docs", action="store_true", help="write docs/reference/validation.md as well")
    return parser.parse_args()


def main():
    options = parse_arguments()
    chosen = [folder for folder in all_folders() if not options.only or any(part in folder for part in options.only)]
    began = time.monotonic()
    with ThreadPoolExecutor(max_workers=max(1, options.jobs)) as pool:
        order = sorted(chosen, key=lambda folder: folder not in BEGUN_FIRST)
        found = {folder: pool.submit(validate, folder, ROOT / options.build) for folder in order}
        rows = [row for folder in chosen for row in found[folder].result()]
    if not options.only:
        out = ROOT / "build" / "validation"
        out.mkdir(parents=True, exist_ok=True)
        write_csv(rows, out / "results.csv")
        write_page(rows, out / "index.html")
    if options.write_docs:
        write_docs(rows, ROOT / "docs" / "reference" / "validation.md")
    for row in rows:
        if row.verdict not in (PASSED, WITHIN):
            print(f"{row.verdict}: {row.id}: ours {row.ours} {row.unit}, expected {row.expected} ({row.tolerance})")
    where = "" if options.only else "; build/validation/results.csv and index.html"
    print(f"{summary([row.verdict for row in rows])}, in {time.monotonic() - began:.0f} s{where}")
    return 0 if rows and not any(row.verdict in (FAILED, NOT_RUN) for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
