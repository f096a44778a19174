"""The page of what a run writes names every column and every field that the engine writes."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs/reference/run-folder.md").read_text(encoding="utf-8")
RECORDS = ["run_record", "fragments", "gauges", "rank_times", "run_times", "mps_record", "rectangles_record", "spheres_record", "fem_record", "hybrid_record", "snapshots"]
COLUMN = re.compile(r'"((?:[a-z_]+\.)?[a-z_]+ \[[^\]"]+\])"')
FIELD = re.compile(r'(?:cell_data|of_vectors|of_integers)\("([a-z_]+)"|\{"([a-z_]+)", 1, std::span')


def source(record):
    return (ROOT / "sazare/runs" / f"{record}.cpp").read_text(encoding="utf-8")


@pytest.mark.parametrize("record", RECORDS)
def test_every_column_and_field_is_on_the_page(record):
    text = source(record)
    columns = {re.sub(r"_[yz] \[", "_x [", name) for name in COLUMN.findall(text)}
    fields = {name for pair in FIELD.findall(text) for name in pair if name}
    assert columns or fields, "the record is written otherwise than this test knows"
    missing = [name for name in columns if f"{name}`" not in PAGE] + [name for name in fields if f"`{name}`" not in PAGE]
    assert not missing
