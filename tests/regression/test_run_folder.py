"""The page of what a run writes comes from the program and is true of its folders: runs of every method, and all that they leave."""

import csv
import json
import os
import re
from pathlib import Path

import h5py
import pytest
from conftest import BLOCK, DONE, ROOT

PAGE = ROOT / "docs" / "reference" / "run-folder.md"
CASES = ROOT / "cases"


def clocks(end, row, table="time"):
    """Settings that end a run with its second row, which is a snapshot."""
    return [f"{table}.end={end}", f"{table}.history_interval={row}", f"{table}.snapshot_interval={end}"]


def sides(end, row):
    """`clocks` for both sides of a hybrid case."""
    return clocks(end, row, "continuum.time") + clocks(end, row, "bodies.time")


RUNS = {
    "blocks": (BLOCK, clocks(2e-4, 1e-4)),
    "mps": (CASES / "column-ricker/case.toml", clocks(0.02, 0.01)),
    "mps that fails": (CASES / "slope-el-centro/case.toml", [*clocks(0.04, 0.02), "gravity.settle=false", "gravity.acceleration=[0.0, 0.0, 0.0]"]),
    "rectangles": (CASES / "block-on-slope/case.toml", clocks(0.01, 0.005)),
    "spheres": (CASES / "bonded-beam/case.toml", clocks(2e-3, 1e-3)),
    "fem": (CASES / "cantilever-fem/case.toml", clocks(2e-3, 1e-3)),
    "hybrid": (CASES / "two-mass-oscillator/case.toml", sides(1e-3, 5e-4)),
    "hybrid of rectangles": (CASES / "block-on-soft-ground/case.toml", sides(0.02, 0.01)),
    "hybrid of ground": (CASES / "slope-hits-wall/case.toml", sides(0.04, 0.02)),
    "hybrid of blocks": (CASES / "rock-fall-on-slab/case.toml", sides(2e-4, 1e-4)),
}
FIELDS = ("CellData", "PointData")


def test_the_page_is_written_by_the_program(sazare):
    """SAZARE_WRITE_REFERENCE=1 in the environment writes it anew."""
    text = sazare("schema", "--folder").stdout
    if os.environ.get("SAZARE_WRITE_REFERENCE"):
        PAGE.write_text(text)
    assert text == PAGE.read_text()


def names_on_the_page():
    """What the page tells of, as patterns."""
    words = re.findall(r"`([A-Za-z0-9_.]+)`", PAGE.read_text())
    return [re.compile(re.escape(word).replace("NAME", ".+")) for word in words]


def without_axis(name):
    return re.sub(r"_[xyz]$", "_x", name)


def left_by(folder):
    """Names of figures, columns and fields in a folder and those of its sides."""
    for manifest in folder.rglob("manifest.json"):
        yield from ((manifest, name) for name in json.loads(manifest.read_text())["results"])
    for table in folder.rglob("*.csv"):
        with table.open() as lines:
            yield from ((table, title.rpartition(" [")[0] or title) for title in next(csv.reader(lines)))
    for snapshot in folder.rglob("*_00000.vtkhdf"):
        with h5py.File(snapshot) as file:
            yield from ((snapshot, name) for kind in FIELDS for name in file["VTKHDF"].get(kind, ()))


@pytest.mark.parametrize("kind", RUNS)
def test_all_that_a_run_leaves_is_on_the_page(sazare, tmp_path, kind):
    case, settings = RUNS[kind]
    done = sazare("run", case, "--out", tmp_path / "run", *(word for setting in settings for word in ("--set", setting)))
    assert done.returncode == DONE, done.stderr
    told = names_on_the_page()
    left = list(left_by(tmp_path / "run"))
    assert {Path(file).suffix for file, _ in left} == {".json", ".csv", ".vtkhdf"}
    missing = {(str(file.relative_to(tmp_path)), name) for file, name in left
               if not any(pattern.fullmatch(spelling) for pattern in told for spelling in (name, without_axis(name)))}
    assert not missing
