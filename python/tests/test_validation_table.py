"""The table of the validation: verdicts of exact answers and of measurements, and its page."""

import importlib.util
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]

specification = importlib.util.spec_from_file_location("validation_run", ROOT / "validation" / "run.py")
table = importlib.util.module_from_spec(specification)
specification.loader.exec_module(table)

EXACT, MEASURED = "analytic/fem-beam", "measured/rocking-block"


def verdict(folder, ours, recorded=""):
    entry = {"row": "one", "quantity": "", "unit": "-", "expected": "1", "compare": "absolute", "tolerance": "0.1", "source": "",
             "recorded": recorded, "why": "a reason"}
    return table.compare_row(folder, entry, {"one": (ours, None)}, "")


def test_a_measured_row_is_within_or_outside_and_fails_beyond_what_was_recorded():
    assert verdict(EXACT, 1.05).verdict == table.PASSED
    assert verdict(EXACT, 1.2).verdict == table.FAILED
    assert verdict(MEASURED, 1.05).verdict == table.WITHIN
    assert verdict(MEASURED, 1.2).verdict == table.FAILED
    assert verdict(MEASURED, 1.2, "1.15 1.25").verdict == table.OUTSIDE
    assert verdict(MEASURED, 1.3, "1.15 1.25").verdict == table.FAILED
    assert verdict(MEASURED, float("nan"), "1.15 1.25").verdict == table.FAILED


def test_only_rows_outside_tell_why():
    assert verdict(MEASURED, 1.2, "1.15 1.25").why == "a reason"
    assert verdict(MEASURED, 1.05, "1.15 1.25").why == ""


def test_the_page_has_the_experiments_last_and_keeps_what_was_not_run(tmp_path):
    page = tmp_path / "validation.md"
    table.write_docs([verdict(EXACT, 1.05), verdict(MEASURED, 1.2, "1.15 1.25")], page)
    table.write_docs([verdict(EXACT, 1.2)], page)
    text = page.read_text(encoding="utf-8")
    assert text.index("analytic/fem-beam]") < text.index("papers/") < text.index("## Measurements") < text.index("measured/rocking-block]")
    assert "`one` is outside: a reason" in text
    assert "1 FAILED" in text and "1 outside the scatter" in text
    assert "Fitted: Nothing." in text


def test_what_is_no_row_is_told():
    with pytest.raises(ValueError, match="a word"):
        table.parse_output("one,1\na word\n")


@pytest.mark.parametrize("folder", [folder for folder in table.all_folders() if folder.startswith(table.MEASURED)])
def test_experiments_say_what_was_fitted_and_why_a_row_is_outside(folder):
    assert table.fitted(folder)
    for entry in table.expected_rows(folder):
        assert bool(entry.get("recorded")) == bool(entry.get("why"))
        assert entry["source"]
