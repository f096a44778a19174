"""The script that compares the hashes of two programs: what it says of the small block, and of programs that only pretend to compute."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import PROGRAM, ROOT
from short_runs import RUNS, case_path, words_of_refusal

SCRIPT = Path(__file__).parent / "state_hashes.py"
SAME, DIFFERENT, REFUSED = 0, 1, 2
PRETENDER = """#!{python}
import json, pathlib, sys
if sys.argv[1] == "--version": print("sazare {version}")
elif sys.argv[1] == "info": print("compiler  none")
elif sys.argv[1] == "check": sys.exit(0 if "good" in open(sys.argv[2]).read() else "error: no such key")
elif {fails}: sys.exit("error: nothing works")
else:
    folder = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
    for part in ("", "bodies"):
        (folder / part).mkdir(parents=True, exist_ok=True)
        results = {{"energy_work": {work}, "steps": {version}, "ppv": {{}}}}
        (folder / part / "manifest.json").write_text(json.dumps({{"state_hash": "{state}" + part, "results": results}}))
"""


@pytest.fixture
def pretender(tmp_path):
    """Makes a program that leaves a hash and an energy without computing anything."""

    def make(name, state="abc", work=1.5, version=1, fails=False):
        program = tmp_path / name
        program.write_text(PRETENDER.format(python=sys.executable, state=state, work=work, version=version, fails=fails))
        program.chmod(0o755)
        return program

    return make


def script(*arguments):
    words = [sys.executable, str(SCRIPT), *map(str, arguments)]
    return subprocess.run(words, capture_output=True, text=True, check=False, timeout=300)


def rows(done, name):
    """The words of the lines of a case."""
    return [line.split() for line in done.stdout.splitlines() if line.split()[:1] and line.split()[0].split("/")[0] == name]


def test_every_case_of_the_tree_has_its_row_and_its_file():
    assert {name.partition("/")[0] for name in RUNS} == {file.name for file in (ROOT / "cases").iterdir()} | {"block"}
    assert all(case_path(name, ROOT / "cases").exists() for name in RUNS)


def test_the_small_block_has_the_same_hash_twice():
    done = script(PROGRAM, PROGRAM, "--case", "block", "--figures")
    assert done.returncode == SAME, done.stdout + done.stderr
    (row,) = rows(done, "block")
    assert row[1] == row[2] and row[3] == "same"
    assert "1 of 1 hashes are the same." in done.stdout


def test_every_manifest_of_a_run_is_compared(pretender):
    done = script(pretender("one"), pretender("two", version=2), "--case", "rock-fall-on-slab", "bonded-beam", "--figures")
    assert done.returncode == SAME, done.stdout + done.stderr
    assert [row[0] for row in rows(done, "rock-fall-on-slab")] == ["rock-fall-on-slab", "rock-fall-on-slab/bodies"]
    assert "4 of 4 hashes are the same." in done.stdout


def test_another_hash_is_named(pretender):
    done = script(pretender("one"), pretender("two", state="abd"), "--case", "bonded-beam")
    assert done.returncode == DIFFERENT
    assert rows(done, "bonded-beam")[0][1:4] == ["abc", "abd", "DIFFERENT"]
    assert "2 of 2 hashes are not the same: bonded-beam, bonded-beam/bodies." in done.stdout


def test_energies_are_compared_where_asked_for(pretender):
    one, two = pretender("one"), pretender("two", work=1.5000000000000002)
    assert script(one, two, "--case", "bonded-beam").returncode == SAME
    done = script(one, two, "--case", "bonded-beam", "--figures")
    assert done.returncode == DIFFERENT
    assert "energy_work: 1.5 before, 1.5000000000000002 after" in done.stdout


def test_a_program_that_fails_is_no_program_with_the_same_results(pretender):
    done = script(pretender("one", fails=True), pretender("two", fails=True), "--case", "bonded-beam")
    assert done.returncode == DIFFERENT
    assert "FAILED" in done.stdout and "before: the program ended with 1: error: nothing works" in done.stdout
    assert script(pretender("one", fails=True), "--case", "bonded-beam").returncode == DIFFERENT


def test_hashes_are_kept_and_compared_without_their_program(pretender, tmp_path):
    kept = tmp_path / "hashes.json"
    assert script(pretender("one"), "--case", "bonded-beam", "block", "--save", kept).returncode == SAME
    again = script(pretender("two", version=2), "--case", "bonded-beam", "--against", kept, "--figures")
    assert again.returncode == SAME and "sazare 1, none" in again.stdout and "sazare 2, none" in again.stdout
    other = script(pretender("two", state="abd"), "--case", "bonded-beam", "--against", kept)
    assert other.returncode == DIFFERENT
    lacking = script(pretender("two"), "--case", "mortar-beam", "--against", kept)
    assert f"Left out: mortar-beam: {kept} has no such case." in lacking.stdout


def test_settings_of_saved_hashes_are_told_where_they_were_others(pretender, tmp_path):
    kept = tmp_path / "hashes.json"
    assert script(pretender("one"), "--case", "bonded-beam", "--save", kept).returncode == SAME
    content = json.loads(kept.read_text())
    content["cases"]["bonded-beam"]["settings"] = ["time.end=1"]
    kept.write_text(json.dumps(content))
    told = script(pretender("two"), "--case", "bonded-beam", "--against", kept)
    assert "bonded-beam was shortened by other settings when its hashes were saved." in told.stdout


def test_hashes_of_other_instruction_sets_are_not_compared(pretender, tmp_path):
    kept = tmp_path / "hashes.json"
    assert script(pretender("one"), "--case", "bonded-beam", "--save", kept).returncode == SAME
    content = json.loads(kept.read_text())
    content["origin"] |= {"instructions": ["x86_64", "abacus"], "processor": "An older one"}
    kept.write_text(json.dumps(content))
    refused = script(pretender("one"), "--case", "bonded-beam", "--against", kept)
    assert refused.returncode == REFUSED
    assert "a processor with x86_64, abacus (An older one)" in refused.stderr
    assert "cannot be compared with those of this machine" in refused.stderr


def test_cases_of_each_program_may_lie_elsewhere(pretender, tmp_path):
    (tmp_path / "earlier" / "bonded-beam").mkdir(parents=True)
    (tmp_path / "earlier" / "bonded-beam" / "case.toml").touch()
    (tmp_path / "earlier" / "new-one").mkdir()
    (tmp_path / "earlier" / "new-one" / "case.toml").touch()
    done = script(pretender("one"), "--cases-before", tmp_path / "earlier")
    assert done.returncode == SAME, done.stdout + done.stderr
    assert {line.split()[0] for line in done.stdout.splitlines() if " abc" in line} == {
        "block", "block/bodies", "bonded-beam", "bonded-beam/bodies"}
    assert "Left out: new-one: the table of this script does not say how to run it." in done.stdout
    assert f"Left out: mortar-beam: {tmp_path / 'earlier'} has no such case." in done.stdout


@pytest.mark.parametrize(("words", "message"), [
    (["--case", "none"], "there is no case none"),
    (["--figures"], "--figures needs a second program"),
    (["--against", "nowhere.json"], "nowhere.json holds no hashes that this script has saved"),
    (["--cases-before", "nowhere"], "is no folder"),
    (["--save", "nowhere/hashes.json"], "there is no folder for nowhere/hashes.json"),
    (["--cases-after", "cases"], "--cases-after needs a second program"),
    (["two", "--save", "hashes.json"], "--save and --against go with one program"),
    (["two"], "two is no program that can be run"),
])
def test_what_cannot_be_done_is_refused(pretender, words, message):
    done = script(pretender("one"), *words)
    assert done.returncode == REFUSED
    assert message in done.stderr


def test_a_resolved_case_that_its_own_program_refuses_is_a_failure(pretender, tmp_path):
    program = pretender("program")
    (tmp_path / "run" / "bodies").mkdir(parents=True)
    (tmp_path / "run" / "case.toml").write_text("good = 1")
    assert words_of_refusal(program, tmp_path / "run") == ""
    (tmp_path / "run" / "bodies" / "case.toml").write_text("bad = 1")
    assert words_of_refusal(program, tmp_path / "run") == "the resolved case bodies/case.toml is refused: error: no such key"
