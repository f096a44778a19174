"""Cases as objects: the same thing as their text, both ways, and as the schema has them."""

import importlib.util
import io
import json
import tomllib
from pathlib import Path

import pytest

import sazare
from sazare.cases import case_from_text, mps, read_case
from sazare.engine import engine
from sazare.simulation import source_of

ROOT = Path(__file__).resolve().parents[2]
CASES = [path for path in sorted(ROOT.glob("cases/*/*.toml")) if "case" in tomllib.loads(path.read_text())]

specification = importlib.util.spec_from_file_location("write_case_classes", ROOT / "tools" / "write_case_classes.py")
write_case_classes = importlib.util.module_from_spec(specification)
specification.loader.exec_module(write_case_classes)


def name_of(path):
    return f"{path.parent.name}/{path.stem}"


def test_there_are_cases_of_every_method():
    methods = {each["properties"]["case"]["properties"]["method"]["const"] for each in json.loads(engine().schema_json())["oneOf"]}
    assert {read_case(path).method for path in CASES} <= methods
    assert len(CASES) > 10


@pytest.mark.parametrize("path", CASES, ids=name_of)
def test_a_case_is_its_text_both_ways(path):
    text = path.read_text()
    case = read_case(path)
    assert case.to_dict() == tomllib.loads(text)
    again = case_from_text(case.to_toml(), path.parent)
    assert again == case
    assert source_of(case).resolved() == source_of(path).resolved(), "the engine reads the same"


def test_the_classes_are_what_the_schema_says(monkeypatch, capsys):
    monkeypatch.setattr("sys.stdin", io.StringIO(engine().schema_json()))
    assert write_case_classes.main(["--check"]) == 0, capsys.readouterr().out


def test_classes_that_the_schema_no_longer_says_are_found(monkeypatch, capsys):
    changed = engine().schema_json().replace("Velocity of S waves.", "Velocity of shear waves.")
    monkeypatch.setattr("sys.stdin", io.StringIO(changed))
    assert write_case_classes.main(["--check"]) == 1
    assert "mps.py" in capsys.readouterr().out


def test_a_changed_object_is_a_changed_case():
    case = read_case(ROOT / "cases/column-ricker/case.toml")
    case.time.end = 0.5
    case.materials[0].density = 1800
    case.title = 'a "new" one'
    case.gauges = [*case.gauges, mps.Gauge(name="new", point=(0.5, 1.0, 0.0))]
    read = tomllib.loads(source_of(case).resolved())
    assert read["time"]["end"] == 0.5
    assert read["materials"][0]["density"] == 1800.0
    assert read["case"]["title"] == 'a "new" one'
    assert read["gauges"][-1] == {"name": "new", "point": [0.5, 1.0, 0.0]}


def test_required_keys_must_be_given():
    with pytest.raises(TypeError, match="spacing"):
        mps.Particles()


def test_what_is_wrong_in_an_object_is_said_as_for_a_file():
    case = read_case(ROOT / "cases/column-ricker/case.toml")
    case.particles.spacing = -1.0
    with pytest.raises(sazare.UserError, match=r"case:\d+:\d+: error") as caught:
        sazare.check(case)
    assert "spacing" in str(caught.value)


def test_an_unknown_key_of_a_text_is_said_in_the_words_of_the_command():
    text = (ROOT / "cases/column-ricker/case.toml").read_text().replace("spacing", "spacings")
    with pytest.raises(sazare.UserError, match="did you mean"):
        case_from_text(text)


def test_a_text_that_is_no_toml_is_said_in_the_words_of_the_command():
    with pytest.raises(sazare.UserError, match=r"case:1:\d+: error"):
        case_from_text("[case\ntitle = 1\n")


def test_a_misspelt_key_is_refused():
    case = read_case(ROOT / "cases/column-ricker/case.toml")
    with pytest.raises(AttributeError, match="has no key 'spacng'; did you mean 'spacing'"):
        case.particles.spacng = 0.1
    with pytest.raises(AttributeError, match="has no key 'tiem'; did you mean 'time'"):
        case.tiem = case.time
    case.particles.spacing = 0.25
    assert case.to_dict()["particles"]["spacing"] == 0.25


@pytest.mark.parametrize("name, value, words", [("time", 5, "time cannot be 5: write a Time"), ("gauges", ["top"], "gauges cannot be 'top': write a Gauge")])
def test_a_table_that_is_none_is_told_of(name, value, words):
    case = read_case(ROOT / "cases/column-ricker/case.toml")
    setattr(case, name, value)
    with pytest.raises(TypeError, match=words):
        case.to_toml()


@pytest.mark.parametrize("title", ["a\x7fb", 'quotes " and \\', "tab\tand\nline", "\u2028 \x00 \x1f", "震動 𝄞"])
def test_a_title_of_any_characters_is_read_back(title):
    case = read_case(ROOT / "cases/column-ricker/case.toml")
    case.title = title
    assert tomllib.loads(case.to_toml())["case"]["title"] == title


def test_a_title_that_is_no_text_is_refused():
    with pytest.raises(ValueError, match="cannot stand in a case"):
        mps.Case(title="\udc80", particles=mps.Particles(spacing=1.0), regions=[], materials=[], time=mps.Time(end=1.0)).to_toml()
