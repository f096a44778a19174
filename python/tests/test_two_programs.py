"""A hybrid case as two programs that exchange files: the bits of one program, stopped, killed and resumed, and with other finite elements."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from sazare import partner
from sazare.partner.messages import file_name

ROOT = Path(__file__).resolve().parents[2]
COMMAND = ROOT / "build/release/apps/sazare/sazare"
OSCILLATOR = ROOT / "cases/two-mass-oscillator/case.toml"
BEAM = ROOT / "cases/sphere-on-beam/case.toml"
SEAWALL = ROOT / "cases/seawall-shaking-table/case.toml"
APART = ROOT / "cases/seawall-two-programs/case.toml"
BLOCK = ROOT / "cases/block-on-soft-ground/case.toml"
ROCK = ROOT / "cases/rock-fall-on-slab/case.toml"
ENDS = {OSCILLATOR: 0.02, BEAM: 1e-4, SEAWALL: 0.05, BLOCK: 0.1, ROCK: 0.0014}  # s


def settings(case, scheme, extra=()):
    """Arguments that make a case short."""
    end = ENDS[case]
    chosen = [f"coupling.scheme={scheme}", *(f"{side}.time.{key}={end}" for side in ("continuum", "bodies") for key in ("end", "snapshot_interval"))]
    return [word for each in (*chosen, *extra) for word in ("--set", each)]


def start(case, folder, side, *arguments, time_out=60):
    """The program of a side."""
    return subprocess.Popen(
        [COMMAND, "run", case, "--side", side, "--exchange", folder / "exchange", "--out", folder / side, "--time-out", str(time_out), "--quiet", *arguments],
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )


def start_both(case, folder, *arguments):
    return {side: start(case, folder, side, *arguments) for side in ("continuum", "bodies")}


def finish(programs):
    """Exit codes and words of programs, once they have ended."""
    return {side: (program.communicate(timeout=120)[0], program.returncode) for side, program in programs.items()}


def wait_for(folder, message):
    """Until the continuum has sent a message."""
    deadline = time.monotonic() + 60
    while not any(path.name >= file_name("continuum", message) for path in (folder / "exchange").glob("continuum-*.message")):
        assert time.monotonic() < deadline, "the run does not go on"
        time.sleep(0.001)


def figures(folder):
    """What a run found, without how long it took."""
    manifest = json.loads((folder / "manifest.json").read_text())
    assert manifest["status"] == "done"
    return manifest["state_hash"], {name: value for name, value in manifest["results"].items() if name != "wall_seconds" and not name.startswith("exchange_")}


def rows(folder):
    """The history as text, without the clock on the wall."""
    lines = [line.split(",") for line in (folder / "history.csv").read_text().splitlines()]
    keep = [number for number, name in enumerate(lines[0]) if not name.startswith("wall_seconds")]
    return [[line[number] for number in keep] for line in lines]


def check_same(one, two):
    """Both sides of a run in one program and of one in two programs, to the bit."""
    for side in ("continuum", "bodies"):
        assert figures(one / side) == figures(two / side)
        assert rows(one / side) == rows(two / side)
        assert len(rows(two / side)) > 5


@pytest.fixture(scope="module")
def one(tmp_path_factory):
    """The run of a case in one program."""
    made = {}

    def run(case, scheme):
        if (case, scheme) not in made:
            folder = made[case, scheme] = tmp_path_factory.mktemp("one") / "run"
            subprocess.run([COMMAND, "run", case, "--out", folder, "--quiet", *settings(case, scheme)], check=True)
        return made[case, scheme]

    return run


@pytest.mark.parametrize(("case", "scheme"), [(OSCILLATOR, "lagged"), (OSCILLATOR, "impulse"), (OSCILLATOR, "iterative"), (BEAM, "impulse"), (SEAWALL, "impulse"),
                                                (BLOCK, "impulse"), (BLOCK, "iterative"), (ROCK, "impulse")])
def test_two_programs_have_the_bits_of_one(one, tmp_path, case, scheme):
    for side, (words, code) in finish(start_both(case, tmp_path, *settings(case, scheme))).items():
        assert code == 0, f"{side}: {words}"
    check_same(one(case, scheme), tmp_path)
    parts = (tmp_path / "continuum/timing.csv").read_text()
    assert "exchange of files" in parts and "waiting for the partner" in parts
    results = json.loads((tmp_path / "continuum/manifest.json").read_text())["results"]
    assert 0.0 < results["exchange_processor_seconds"] and 0.0 < results["exchange_seconds"] < results["wall_seconds"]


def test_script_runs_the_sea_wall_in_two_programs(one, tmp_path):
    """The case of the two programs is that of the one, and its script starts both."""
    script = [APART.with_name("run"), *settings(SEAWALL, "impulse")]
    subprocess.run(script, check=True, cwd=tmp_path, env={**os.environ, "SAZARE": str(COMMAND)}, stdout=subprocess.DEVNULL)
    check_same(one(SEAWALL, "impulse"), tmp_path / "runs/seawall-two-programs")


@pytest.mark.parametrize("scheme", ["impulse", "iterative"])
@pytest.mark.parametrize("victim", ["continuum", "bodies"])
@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGKILL])
def test_either_side_is_stopped_and_both_go_on(one, tmp_path, scheme, victim, how):
    arguments = settings(OSCILLATOR, scheme, ["output.checkpoint_interval=0.02"])
    programs = start_both(OSCILLATOR, tmp_path, *arguments)
    wait_for(tmp_path, 60)
    programs[victim].send_signal(how)
    ended = finish(programs)
    other = "bodies" if victim == "continuum" else "continuum"
    assert ended[victim][1] == (-signal.SIGKILL if how == signal.SIGKILL else 4), ended[victim]
    assert ended[other][1] == 4, ended[other]
    expected = "died without notice. Resume both sides" if how == signal.SIGKILL else f"--resume --side {other}"
    assert expected in ended[other][0]
    for side, (words, code) in finish(start_both(OSCILLATOR, tmp_path, "--resume", *arguments)).items():
        assert code == 0, f"{side}: {words}"
    check_same(one(OSCILLATOR, scheme), tmp_path)


def test_side_that_is_alone_is_stopped(tmp_path):
    program = start(OSCILLATOR, tmp_path, "continuum", *settings(OSCILLATOR, "impulse"))
    while not (tmp_path / "exchange/continuum.here").exists():
        time.sleep(0.01)
    program.send_signal(signal.SIGINT)
    words, code = finish({"continuum": program})["continuum"]
    assert code == 4 and "stopped before the first step" in words


def test_partner_that_does_not_come(tmp_path):
    words, code = finish({"bodies": start(OSCILLATOR, tmp_path, "bodies", *settings(OSCILLATOR, "impulse"), time_out=0.2)})["bodies"]
    assert code == 4 and "the continuum's program did not come within 0.2 s" in words


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ([ROOT / "cases/column-ricker/case.toml", "--side", "bodies"], "--side is only for cases of method hybrid, which have two sides: remove it"),
        ([OSCILLATOR, "--side", "ground"], "--side: ground not in {continuum,bodies}"),
        ([OSCILLATOR, "--exchange", "there"], "--exchange requires --side"),
    ],
)
def test_words_of_the_command(arguments, words):
    asked = subprocess.run([COMMAND, "run", *arguments], capture_output=True, text=True, check=False)
    assert asked.returncode == 2 and words in asked.stderr + asked.stdout


@pytest.mark.parametrize(
    ("window", "width", "words"),
    [(2e-4, 0.1, "its window [s] is 0.0002, and 0.0001 is expected"), (1e-4, 0.2, "its width [m] is 0.2, and 0.1 is expected")],
)
def test_surface_of_another_case_is_refused(tmp_path, window, width, words):
    program = start(OSCILLATOR, tmp_path, "bodies", *settings(OSCILLATOR, "impulse"))
    with pytest.raises(partner.Failed, match="the surfaces do not match"):
        with partner.Continuum(tmp_path / "exchange", [[0.0, 0.1], [0.1, 0.1]], [[0, 1]], window, width=width, time_out=30.0):
            pass
    said, code = finish({"bodies": program})["bodies"]
    assert code == 2 and words in said


def test_other_finite_elements_move_as_ours(one, tmp_path):
    """scikit-fem has the same beam of the same elements; the rest is the solver's rounding, which the contact makes larger."""
    pytest.importorskip("skfem", reason="scikit-fem is not installed: run make setup")
    sys.path.insert(0, str(ROOT / "examples"))
    import beam_of_scikit_fem

    time_, deflection, push = beam_of_scikit_fem.main(end=ENDS[BEAM], out=tmp_path)
    names, *lines = [line.split(",") for line in (one(BEAM, "impulse") / "history.csv").read_text().splitlines()]
    history = dict(zip(names, np.array(lines, float).T, strict=True))
    every = round((history["time [s]"][1] - history["time [s]"][0]) / (time_[1] - time_[0]))
    ours = history["surface.force_y [N]"][1:]
    assert ours.min() < -100.0
    np.testing.assert_allclose(push[every - 1 :: every], ours, rtol=0, atol=1e-6 * np.abs(ours).max())
    assert deflection.min() < 0.0


def test_caisson_of_other_finite_elements_moves_as_ours(tmp_path):
    """Until the armour tumbles, which makes rounding large; by then it has hit the caisson."""
    pytest.importorskip("skfem", reason="scikit-fem is not installed: run make setup")
    sys.path.insert(0, str(ROOT / "examples"))
    import caisson_of_scikit_fem

    _, own, theirs = caisson_of_scikit_fem.main(end=0.35, out=tmp_path)
    largest = np.abs(own).max(axis=1)
    assert largest[0] > 1e-6 and largest[1] > 100.0  # m, N
    assert (np.abs(own - theirs).max(axis=1) < 1e-6 * largest).all()


def opensees():
    """The example in which OpenSees drives the caisson."""
    try:
        import openseespy.opensees  # noqa: F401
    except (ImportError, RuntimeError) as error:
        pytest.skip(f"OpenSeesPy is not installed, or not with libblas3 and liblapack3: {error}")
    sys.path.insert(0, str(ROOT / "examples"))
    import caisson_of_opensees

    return caisson_of_opensees


def test_opensees_shakes_the_caisson_as_we_do():
    """Same mesh, same elements, same Newmark step, same record: equal to the tolerance of our equilibrium, measured on the deformation."""
    own, theirs = opensees().alone()
    assert np.abs(own).max() > 5e-5  # m
    assert np.abs(own - theirs).max() < 1e-6 * np.abs(own).max()


def test_caisson_of_opensees_in_front_of_armour_moves_as_ours(tmp_path):
    """Until the armour tumbles, which makes rounding large; by then it has hit the caisson."""
    _, own, theirs = opensees().main(end=0.34, out=tmp_path)
    largest = np.abs(own).max(axis=1)
    assert largest[0] > 5e-7 and largest[1] > 50.0  # m, N
    apart = np.abs(own - theirs).max(axis=1) / largest
    assert apart[0] < 1e-6
    assert apart[1] < 1e-5, "contacts make rounding larger"
