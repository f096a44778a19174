"""The table of methods: what each gives, and that nothing else knows their names."""

import ast
import json
from pathlib import Path

import pytest

import sazare
from sazare.methods import MODULES, Figure, Headline, Method, Section, method_named, method_of

PACKAGE = Path(sazare.__file__).parent
# Files and keys that are called as a method is: snapshots of squares, packed data of the 3-D view, the file of a study, the table of squares in a case.
ALIKE = {"results.py": {"rectangles"}, "view3d.py": {"blocks"}, "simulation.py": {"study"}, "structures.py": {"blocks"}}


@pytest.fixture
def empty(tmp_path):
    """A function that opens a folder with nothing but a manifest, and a case where one is given."""

    def opened(manifest, case=""):
        (tmp_path / "manifest.json").write_text(json.dumps(manifest))
        (tmp_path / "case.toml").write_text(case)
        return sazare.open(tmp_path)

    return opened


@pytest.mark.parametrize("name", MODULES)
def test_a_method_gives_all_that_is_asked_of_it(name, empty):
    method = method_named(name)
    assert isinstance(method, Method)
    results = empty({"method": name, "status": "done", "results": {}})
    sections = method.sections(results)
    assert sections and all(isinstance(section, Section) for section in sections)
    assert len({section.name for section in sections}) == len(sections)
    assert all(section.draw() is None for section in sections), "nothing is drawn of a run that wrote nothing"
    tone, sentence = method.verdict(results)
    assert tone in ("good", "fair", "bad") and sentence.endswith(".")
    assert all(isinstance(figure, Figure) for figure in method.headlines)


@pytest.mark.parametrize(
    "residual, load, tone",
    [(0.5, 0.3, "good"), (4.0, 0.3, "fair"), (10.0, 0.3, "bad"), (-48.0, 0.3, "bad"), (0.5, 1.7, "fair"), (10.0, 1.7, "bad"),
     (None, 0.3, "bad")],
)
def test_the_verdict_of_spheres_reads_the_energy_balance_and_the_step(empty, residual, load, tone):
    results = {"energy_work": 100.0, "energy_residual": residual, "step_load": load}
    found, sentence = method_named("spheres").verdict(empty({"method": "spheres", "status": "done", "results": results}))
    assert found == tone
    assert ("stability_fraction" in sentence) == (tone != "good" and residual is not None)
    assert ("gained energy" in sentence) == (load > 1.0)


@pytest.mark.parametrize("residual, tone", [(0.05, "good"), (-0.5, "fair"), (10.0, "bad"), (-11.0, "bad"), (None, "bad")])
@pytest.mark.parametrize("cause", ["gravity", "viscous", "boundary", "applied"])
def test_the_verdict_of_mps_compares_the_residual_with_the_work_of_every_cause(empty, cause, residual, tone):
    """The ground has come to rest, so that nothing is left of the work but the residual."""
    results = {f"energy_work_{cause}": -100.0, "energy_kinetic": 1e-3, "energy_elastic": 0.0, "energy_residual": residual}
    found, sentence = method_named("mps").verdict(empty({"method": "mps", "status": "done", "results": results}))
    assert (found, "stability_fraction" in sentence) == (tone, tone != "good" and residual is not None)


def test_the_verdict_of_mps_without_an_energy_balance_is_not_good(empty):
    found, sentence = method_named("mps").verdict(
        empty({"method": "mps", "status": "done", "results": {"step": 1e-3, "predicted_limit": 2e-3}}))
    assert found == "fair" and "not available. The time step is 0.50" in sentence


def test_a_method_is_found_by_the_manifest_then_by_the_case(empty):
    case = '[case]\nmethod = "mps"\n'
    assert method_of(empty({"method": "fem"}, case)) is method_named("fem")
    assert method_of(empty({}, case)) is method_named("mps")
    for manifest, text in (({}, ""), ({"method": "magic"}, "[case"), ({}, "case = 1")):
        assert method_of(empty(manifest, text)) is method_named("blocks")
    with pytest.raises(sazare.tables.NotARun, match="must be a string"):
        method_of(empty({"method": ["fem"]}, ""))


def test_a_figure_becomes_words():
    figure = Figure("p50", "P50", "m", lambda figures: f"of {len(figures)}")
    assert figure.headline({"p50": 0.12}) == Headline("P50", "120 mm", "of 1")
    assert figure.headline({"p50": None}) is None


def test_shared_files_name_no_method():
    names = set(MODULES)
    for path in sorted(PACKAGE.rglob("*.py")):
        place = path.relative_to(PACKAGE)
        if place.parts[0] in ("methods", "cases"):
            continue
        words = {node.value for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, ast.Constant) and isinstance(node.value, str)}
        assert words & names <= ALIKE.get(place.name, set()), place
