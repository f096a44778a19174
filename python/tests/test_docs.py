"""The documentation does what it says: its Python is run, its commands are checked, its notebook and examples too."""

import importlib.util
import json
import re
import shlex
import subprocess
import sys
from pathlib import Path

import matplotlib
import numpy as np
import pytest

import sazare
from sazare.lab.trials import TITLES

ROOT = Path(__file__).resolve().parents[2]
COMMAND = ROOT / "build/release/apps/sazare/sazare"
PAGES = [ROOT / "README.md", *sorted(ROOT.glob("docs/**/*.md")), *sorted(ROOT.glob("cases/*/README.md"))]
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def loaded(path):
    """A script as a module."""
    specification = importlib.util.spec_from_file_location(path.stem, path)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def blocks(page, *languages):
    """The code blocks of a page in some languages."""
    return [text for language, text in BLOCK.findall(page.read_text(encoding="utf-8")) if language in languages]


def page_name(page):
    return page.relative_to(ROOT).as_posix()


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    """A folder in which the pages' words hold: the cases are there, and the blast of the README has been run."""
    folder = tmp_path_factory.mktemp("docs")
    for name in ("cases", "docs", "examples", "tests"):
        (folder / name).symlink_to(ROOT / name)
    sazare.run(ROOT / "cases/free-face-blast/case.toml", folder / "build/blast", progress=False)
    return folder


# The Python of a case's own page takes its results, which take minutes; such blocks are compiled only.
RUN_PAGES = [page for page in PAGES if blocks(page, "python")]


@pytest.mark.parametrize("page", RUN_PAGES, ids=page_name)
def test_the_python_of_a_page_runs(page, place, monkeypatch):
    import pyvista

    monkeypatch.chdir(place)
    monkeypatch.setattr(pyvista, "OFF_SCREEN", True)
    words = {}
    for text in blocks(page, "python"):
        program = compile(text, page_name(page), "exec")
        if "RESULTS" not in text:
            exec(program, words)  # noqa: S102 - that is what this test is for


def test_the_natural_joint_of_the_guide_is_accepted(tmp_path):
    (joint,) = (text for text in blocks(ROOT / "docs/guide/joints-from-tests.md", "toml") if "barton_bandis" in text)
    (rock,) = (text for text in blocks(ROOT / "docs/guide/joints-from-tests.md", "toml") if "[[materials]]" in text)
    case = (ROOT / "cases/direct-shear/case.toml").read_text(encoding="utf-8")
    begin, end = case.index("[[materials]]"), case.index("[contact]")
    ground = rock.replace('["rock"]', '["lower", "upper"]') + joint.replace('"bedding"\nlaw', '"joint"\nlaw')
    for name in ("box.geo", "normal.csv", "push.csv"):
        (tmp_path / name).symlink_to(ROOT / "cases/direct-shear" / name)
    (tmp_path / "case.toml").write_text(case[:begin] + ground + case[end:], encoding="utf-8")
    asked = subprocess.run([COMMAND, "check", tmp_path / "case.toml"], capture_output=True, text=True, check=False)
    assert asked.returncode == 0, asked.stderr
    assert "closes by up to" in asked.stdout


def commands(page):
    """The lines of a page that call sazare, whole."""
    for text in blocks(page, "", "sh", "bash", "console"):
        for line in text.replace("\\\n", " ").splitlines():
            found = re.match(r"^(?:\$ )?(?:mpirun -n \S+ )?(?:build/release/apps/sazare/)?sazare (.*)$", line.strip())
            if found:
                yield shlex.split(found[1], comments=True)


RUNNING = [(page, line) for page in PAGES for line in commands(page) if line[0] in ("run", "check") and line[1].endswith(".toml")]


@pytest.mark.parametrize(("page", "line"), RUNNING, ids=[f"{page_name(page)}-{number}" for number, (page, _) in enumerate(RUNNING)])
def test_a_command_of_a_page_names_a_sound_case(page, line):
    settings = [part for name, value in zip(line, line[1:]) if name == "--set" for part in (name, value)]
    asked = subprocess.run([COMMAND, "check", line[1], *settings], cwd=ROOT, capture_output=True, text=True, check=False)
    understood = asked.returncode == 2 and "predicted limit" in asked.stderr and line[0] == "check"  # what the page shows
    assert asked.returncode == 0 or understood, asked.stderr


def test_the_options_of_the_pages_are_options_of_the_command():
    known = set(re.findall(r"--[a-z-]+", subprocess.run([COMMAND, "--help-all"], capture_output=True, text=True, check=True).stdout))
    for name in ("plot", "movie", "compare", "motion", "blast", "blast-model", "muck-pile", "armour", "armour-model", "sweep"):
        known |= set(re.findall(r"--[a-z-]+", subprocess.run([COMMAND, name, "--help"], capture_output=True, text=True, check=True).stdout))
    for test in (*TITLES, "calibrate"):
        known |= set(re.findall(r"--[a-z-]+", subprocess.run([COMMAND, "lab", test, "--help"], capture_output=True, text=True, check=True).stdout))
    for page in PAGES:
        for line in commands(page):
            unknown = {part.partition("=")[0] for part in line if part.startswith("--")} - known
            assert not unknown, f"{page_name(page)}: {line}"


def test_the_notebook_runs(tmp_path, monkeypatch):
    matplotlib.use("Agg")
    here = tmp_path / "docs/start"
    here.mkdir(parents=True)
    (tmp_path / "cases").symlink_to(ROOT / "cases")
    monkeypatch.chdir(here)
    words = {}
    for cell in json.loads((ROOT / "docs/start/first_blast.ipynb").read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            exec(compile("".join(cell["source"]), "first_blast.ipynb", "exec"), words)  # noqa: S102
    whole, half = words["blast"].figures["broken_joints"], words["half"].figures["broken_joints"]
    assert 0 < half < whole, "less pressure breaks less"
    assert words["page"].exists()


def test_the_joint_strength_of_a_beam_is_found_again(tmp_path):
    example = loaded(ROOT / "examples/joint_strength.py")
    measured = example.breaking_load(4e6, tmp_path / "beam")
    strength, tried = example.calibrate(measured)
    assert strength == pytest.approx(4e6, rel=0.02)
    assert len(tried) < 15


def test_a_caisson_rests_on_ground_of_ones_own_where_it_must(capsys):
    example = loaded(ROOT / "examples/ground_spring.py")
    seen = example.main()
    exact = example.Ground().settlement(example.WEIGHT, example.WIDTH)
    assert seen["settlement"] == pytest.approx(exact, rel=1e-4)
    assert seen["farthest"] > 1e-3 and seen["tilt"] > 1e-4, "the wave moves it"
    assert example.Ground().settlement(2 * example.Ground().stiffness * example.Ground().reference, 1.0) == np.inf
    assert "settlement" in capsys.readouterr().out


def test_the_joint_strength_of_a_disc_is_found_again(tmp_path):
    example = loaded(ROOT / "examples/brazilian_disc.py")
    measured = example.breaking_load(6e6, tmp_path / "disc")
    assert 0.3 * 6e6 < example.strength_of(measured) < 6e6, "weaker than its joints"
    strength, tried = example.calibrate(measured)
    assert min(abs(load - measured) for load in tried.values()) < 0.01 * measured
    assert strength == pytest.approx(6e6, rel=0.08), "the load over the strength scatters by 5 %"
    assert len(tried) < 12


def test_detonators_that_scatter_change_the_vibration(capsys):
    example = loaded(ROOT / "examples/hole_delays.py")
    seed = np.zeros((50, 3))
    seed[:10, 0] = 1.0
    apart = example.round_velocity(seed, 1.0, [0.0, 20.0, 40.0])
    assert apart[:, 0].max() == 1.0 and apart.sum() == pytest.approx(3 * seed.sum())
    assert example.round_velocity(seed, 1.0, [0.0, 5.0, 40.0])[:, 0].max() == 2.0
    found = example.main(end=1e-4, trials=50)
    assert np.ptp(found[0.0]) == 0.0
    assert np.ptp(found[max(found)]) > 0.0
    assert "one hole" in capsys.readouterr().out


def test_the_pages_of_the_site_are_made(capsys):
    assert loaded(ROOT / "tools/build_site.py").main(["--pages-only"]) == 0
    pages = ROOT / "build/site-pages"
    package = (pages / "docs/reference/python.md").read_text()
    assert "## `run(case, out=None" in package and "### `Simulation.advance(duration)`" in package
    assert "sazare run" in (pages / "docs/start/README.md").read_text()
    assert "movie" in (pages / "docs/reference/command.md").read_text()
    links = subprocess.run([sys.executable, ROOT / "tools/check_links.py", pages], capture_output=True, text=True, check=False)
    assert links.returncode == 0, links.stdout
