"""Running cases from Python: the same bits and words as the command, step by step, and the engine's rows as arrays."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import sazare
from sazare.progress import ProgressLine

ROOT = Path(__file__).resolve().parents[2]
COMMAND = ROOT / "build/release/apps/sazare/sazare"
BLOCK = ROOT / "tests/regression/block/case.toml"
COLUMN = ROOT / "cases/column-ricker/case.toml"
RECORD = ROOT / "cases/soil-column-el-centro/el-centro-1940-ns.AT2"
SHORT = {
    "blocks": (BLOCK, {"time.end": 4e-5}),
    "mps": (COLUMN, {"time.end": 0.4}),
    "rectangles": (ROOT / "cases/toppling-columns/case.toml", {}),
    "spheres": (ROOT / "cases/rotating-drum/case.toml", {}),
}

ABSURD = {"time.limiter": "none", "time.base_step": 2e-5, "time.history_interval": 2e-5, "time.end": 1e-3, "time.snapshot_interval": 1e-3}


@pytest.fixture(scope="module")
def block(tmp_path_factory):
    """The small block, run to its end by `run`."""
    return sazare.run(BLOCK, tmp_path_factory.mktemp("block") / "run", progress=False)


def python(code, **options):
    """A Python of its own that runs some code."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "python")}
    return subprocess.Popen([sys.executable, "-c", code], env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, **options)


def test_a_run_has_the_bits_of_the_command(block, tmp_path):
    subprocess.run([COMMAND, "run", BLOCK, "--out", tmp_path / "run", "--quiet"], check=True, cwd=ROOT)
    compared = sazare.compare(block, tmp_path / "run")
    assert compared.same_bits
    assert compared.largest_difference == 0.0
    assert (tmp_path / "run" / "case.toml").read_text() == block.case_text.replace(str(block.path), str(tmp_path / "run"))
    assert sorted(path.name for path in block.path.rglob("*")) == sorted(path.name for path in (tmp_path / "run").rglob("*"))


def test_a_text_runs_like_its_file(block, tmp_path):
    text = sazare.run(BLOCK.read_text(), tmp_path / "text", folder=BLOCK.parent, progress=False)
    assert sazare.compare(block, text).same_bits


def test_errors_have_the_words_of_the_command(tmp_path):
    wrong = tmp_path / "case.toml"
    wrong.write_text(COLUMN.read_text().replace("density", "densty"))
    printed = subprocess.run([COMMAND, "check", wrong], capture_output=True, text=True, check=False)
    assert printed.returncode == 2
    with pytest.raises(sazare.UserError) as caught:
        sazare.check(wrong)
    assert str(caught.value).strip() == printed.stderr.strip()


def test_a_folder_that_holds_a_run_is_not_overwritten(block):
    with pytest.raises(sazare.UserError, match="this folder already contains a run"):
        sazare.run(BLOCK, block.path, progress=False)


def test_check_says_what_the_command_says():
    printed = subprocess.run([COMMAND, "check", COLUMN], capture_output=True, text=True, check=True).stdout
    assert printed.startswith(sazare.check(COLUMN))


def test_physics_that_fails_is_an_error_of_its_own(tmp_path):
    with pytest.raises(sazare.PhysicsError, match="can be resumed|is kept in") as failure:
        sazare.run(BLOCK, tmp_path / "run", overrides=ABSURD, progress=False)
    again = sazare.run(BLOCK, tmp_path / "run", overrides={"time.end": 4e-5}, overwrite=True, progress=False)
    assert again.manifest["status"] == "done" and failure.value, "while the error is held, the folder is free"


def test_steps_have_the_bits_of_a_whole_run(block, tmp_path):
    with sazare.build(BLOCK, tmp_path / "run") as simulation:
        while not simulation.is_over:
            simulation.advance(7e-6)
            assert np.isfinite(simulation.forces).all(), "looking changes nothing"
    assert sazare.compare(block, simulation.results).same_bits


@pytest.mark.parametrize("method", SHORT)
def test_rows_are_looked_at_where_they_lie(method):
    case, overrides = SHORT[method]
    with sazare.build(case, overrides=overrides) as simulation:
        rows = simulation.positions, simulation.velocities, simulation.forces
        for array in rows:
            assert array.shape == (len(rows[0]), 3)
            assert array.dtype == np.float64
            assert not array.flags.owndata and not array.flags.writeable
        before, places = rows[0].copy(), [array.ctypes.data for array in rows]
        simulation.advance(3 * simulation.end / simulation.steps)
        again = simulation.positions, simulation.velocities, simulation.forces
        assert [array.ctypes.data for array in again] == places, "the same memory"
        assert np.shares_memory(rows[0], again[0])
        assert np.array_equal(rows[0], again[0]), "an array that is kept shows the present"
        assert np.isfinite(rows[2]).all()
        assert before.shape == rows[0].shape


def test_arrays_outlive_the_simulation():
    simulation = sazare.build(BLOCK, overrides={"time.end": 4e-5})
    simulation.advance(4e-6)
    rows, expected = simulation.velocities, simulation.velocities.copy()
    simulation.stop()
    del simulation
    assert np.array_equal(rows, expected)


def test_velocities_are_the_rate_of_positions_and_forces_that_of_momenta():
    case, overrides = SHORT["mps"]
    with sazare.build(case, overrides=overrides) as simulation:
        simulation.advance(0.2)
        step = simulation.end / simulation.steps
        seen = []
        for _ in range(3):
            seen.append((simulation.positions.copy(), simulation.velocities.copy(), simulation.forces.copy()))
            simulation.advance(step)
    rate = (seen[2][0] - seen[0][0]) / (2 * step)
    assert np.allclose(rate, seen[1][1], atol=1e-3 * np.abs(rate).max())
    change = (seen[2][1] - seen[0][1]) / (2 * step)
    inner = np.abs(change).max(axis=1) > 0.2 * np.abs(change).max()
    inner &= np.abs(seen[1][2]).max(axis=1) > 0
    masses = (seen[1][2][inner] * change[inner]).sum(axis=1) / (change[inner] ** 2).sum(axis=1)
    usual = np.median(masses)
    assert np.all(np.isclose(masses, usual, rtol=1e-3) | np.isclose(masses, usual / 2, rtol=1e-3)), "or half of it, at a viscous base"
    assert np.mean(np.isclose(masses, usual, rtol=1e-3)) > 0.9


def test_momentum_of_free_bodies_follows_from_the_forces():
    case, overrides = SHORT["spheres"]
    with sazare.build(case, overrides=overrides) as simulation:
        step = simulation.end / simulation.steps
        simulation.advance(20 * step)
        velocity, force = simulation.velocities.copy(), simulation.forces.copy()
        simulation.advance(step)
        after = simulation.forces.copy()
        change = (simulation.velocities - velocity) / step
    free = (np.abs(change).max(axis=1) > 0) & (np.abs(force).max(axis=1) > 0)
    mean = 0.5 * (force + after)[free]
    mass = (mean * change[free]).sum(axis=1) / (change[free] ** 2).sum(axis=1)
    assert np.all(mass > 0)
    assert np.allclose(mean, mass[:, None] * change[free], rtol=1e-6, atol=1e-6 * np.abs(mean).max())


def test_calls_come_at_their_times():
    at, every = [], []
    with sazare.build(COLUMN, overrides={"time.end": 0.4}) as simulation:
        step = simulation.end / simulation.steps
        simulation.at([0.1, 0.25], lambda now: at.append(now.time))
        simulation.every(0.05, lambda now: every.append(now.time))
        simulation.run()
        assert simulation.is_over
    assert np.allclose(at, [0.1, 0.25], atol=step) and min(np.array(at) - [0.1, 0.25]) >= -1e-9
    assert np.allclose(every, 0.05 * np.arange(1, 9), atol=8 * step)
    with pytest.raises(ValueError, match="is past"):
        simulation.at(0.1, print)


def test_a_call_that_returns_true_ends_the_walk_and_the_run_goes_on_later(tmp_path, block):
    with sazare.build(BLOCK, tmp_path / "run") as simulation:
        simulation.every(1e-5, lambda now: bool(np.abs(now.velocities).max() > 0.1))
        reached = simulation.run()
        assert 0.0 < reached < simulation.end
    assert simulation.results.manifest["status"] == "stopped"
    with pytest.raises(RuntimeError, match="resume=True"):
        simulation.run()
    assert simulation.positions.shape[1] == 3, "what it was stays"
    assert sazare.compare(block, sazare.run(BLOCK, tmp_path / "run", resume=True, progress=False)).same_bits


def test_ctrl_c_leaves_a_checkpoint(tmp_path):
    # Under a parent that ignores Ctrl-C, as in the background of a shell, Python would ignore it too.
    heed = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
    code = f"{heed}; import sazare; print('go', flush=True); sazare.run({str(COLUMN)!r}, {str(tmp_path / 'run')!r}, overrides={{'time.end': 500.0}})"
    running = python(code)
    assert running.stdout.readline() == "go\n"
    history = tmp_path / "run" / "history.csv"
    until = time.monotonic() + 60
    while not (history.exists() and len(history.read_text().splitlines()) > 3) and time.monotonic() < until:
        time.sleep(0.05)
    asked = time.monotonic()
    running.send_signal(signal.SIGINT)
    _, errors = running.communicate(timeout=60)
    assert time.monotonic() - asked < 30
    assert "KeyboardInterrupt" in errors
    assert sazare.open(tmp_path / "run").manifest["status"] == "stopped"
    assert (tmp_path / "run" / "checkpoint" / "state.h5").exists()


def test_other_threads_of_python_go_on_meanwhile():
    simulation = sazare.build(COLUMN)
    counted = 0
    worker = threading.Thread(target=simulation.advance_to, args=(2.0,))
    worker.start()
    while worker.is_alive():
        counted += 1
        time.sleep(0.001)
    assert counted > 10, "with Python's lock held the count would stand still"
    simulation.stop()


def test_a_simulation_at_work_is_not_disturbed():
    simulation = sazare.build(COLUMN)
    worker = threading.Thread(target=simulation._live.walk, args=(simulation.steps, 0.5))
    worker.start()
    time.sleep(0.1)
    with pytest.raises(RuntimeError, match="running in another thread"):
        simulation.positions  # noqa: B018
    worker.join()
    simulation.stop()


def test_the_import_takes_no_time():
    code = "import sys; sys.path.insert(0, 'python'); import sazare; print(sorted(name for name in sys.modules if name in ('numpy', 'vtk', 'matplotlib')))"
    running = python(code, cwd=ROOT)
    assert running.communicate(timeout=60)[0].strip() == "[]", "nothing that takes time is loaded with the package"


class Terminal:
    """A stream that counts what was written."""

    def __init__(self, terminal):
        self.text, self.terminal = "", terminal

    def isatty(self):
        return self.terminal

    def write(self, text):
        self.text += text

    def flush(self):
        pass


def test_progress_is_one_line_on_a_terminal_and_rare_lines_elsewhere():
    on, off = Terminal(True), Terminal(False)
    for stream in (on, off):
        with ProgressLine(True, stream) as line:
            line.show(lambda: "10 %")
            line.show(lambda: "20 %")
    assert on.text == "\r10 %\r20 %\r    \r"
    assert off.text == "", "seconds must pass before the first line"


def test_progress_is_one_line_in_a_notebook(monkeypatch):
    kernel = SimpleNamespace(kernel=object())
    monkeypatch.setitem(sys.modules, "IPython", SimpleNamespace(get_ipython=lambda: kernel))
    page = Terminal(False)
    with ProgressLine(True, page) as line:
        line.show(lambda: "10 %")
        line.show(lambda: "20 %")
    assert page.text == "\r10 %\r20 %\r    \r", "written over, and gone at the end"


def test_a_relative_folder_is_that_of_the_beginning(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    case, overrides = SHORT["blocks"]
    (tmp_path / "elsewhere").mkdir()
    with sazare.build(case, "run", overrides=overrides) as simulation:
        monkeypatch.chdir(tmp_path / "elsewhere")
        simulation.run()
        assert simulation.results.manifest["status"] == "done"
    assert (tmp_path / "run" / "manifest.json").exists() and not list((tmp_path / "elsewhere").iterdir())


def test_a_process_forked_after_a_run_is_told_to_spawn(tmp_path):
    code = f"""
import os, sazare
sazare.run({str(BLOCK)!r}, {str(tmp_path / "run")!r}, overrides={{"time.end": 4e-5}}, progress=False)
child = os.fork()
if child == 0:
    try:
        sazare.run({str(BLOCK)!r}, {str(tmp_path / "fork")!r}, progress=False)
    except RuntimeError as error:
        os._exit(7 if "spawn" in str(error) else 1)
    os._exit(1)
print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""
    process = python(code)
    out, errors = process.communicate(timeout=120)
    assert out.strip() == "7", errors


def test_more_threads_than_processors_are_not_used(tmp_path):
    done = subprocess.run(
        [COMMAND, "run", BLOCK, "--out", tmp_path / "run", "--set", "time.end=4e-5", "--threads", "4000"], capture_output=True, text=True
    )
    assert done.returncode == 0 and "warning: --threads 4000" in done.stderr
    assert sazare.open(tmp_path / "run").manifest["machine"]["threads"] <= os.cpu_count()


def test_a_full_disk_behind_the_standard_output_is_an_error(tmp_path):
    with open("/dev/full", "w") as full:
        done = subprocess.run([COMMAND, "check", BLOCK], stdout=full, stderr=subprocess.PIPE, text=True)
    assert done.returncode == 4 and "standard output cannot be written" in done.stderr


@pytest.mark.parametrize("words", [["motion", "--help"], ["--help"], ["motion", RECORD]], ids=["help", "main-help", "table"])
@pytest.mark.parametrize("buffering", ["", "1"], ids=["buffered", "unbuffered"])
def test_a_full_disk_behind_the_output_of_a_python_command_is_an_error(tmp_path, buffering, words):
    with open("/dev/full", "w") as full:
        environment = {**os.environ, "PYTHONPATH": str(ROOT / "python"), "PYTHONUNBUFFERED": buffering}
        done = subprocess.run([sys.executable, "-m", "sazare", *words], stdout=full, stderr=subprocess.PIPE, text=True, env=environment, cwd=tmp_path)
    assert done.returncode == 4 and "error: " in done.stderr
    assert "Traceback" not in done.stderr and "Exception ignored" not in done.stderr


def test_a_missing_folder_for_temporary_files_is_told_of(tmp_path):
    done = subprocess.run([COMMAND, "check", BLOCK], capture_output=True, text=True, env={**os.environ, "TMPDIR": str(tmp_path / "none")})
    assert done.returncode == 4 and "set TMPDIR to a folder that is there" in done.stderr


def test_the_users_own_case_is_not_replaced(tmp_path):
    for file in BLOCK.parent.iterdir():
        if file.is_file():
            (tmp_path / file.name).write_bytes(file.read_bytes())
    before = (tmp_path / "case.toml").read_bytes()
    for option in ([], ["--overwrite"]):
        done = subprocess.run([COMMAND, "run", "case.toml", "--out", ".", *option], cwd=tmp_path, capture_output=True, text=True)
        assert done.returncode == 2 and "belongs to no run" in done.stderr
    assert (tmp_path / "case.toml").read_bytes() == before


def test_the_advice_to_resume_can_be_pasted(tmp_path):
    folder = tmp_path / "it's a run"
    process = subprocess.Popen([COMMAND, "run", COLUMN, "--out", folder, "--quiet"], stderr=subprocess.PIPE, text=True)
    while not (folder / "checkpoint" / "state.h5").exists():
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    if process.returncode == 4:
        assert "'\\''s a run'" in errors


def test_the_end_of_the_interpreter_waits_for_a_run_in_a_daemon_thread(tmp_path):
    code = f"""
import sazare, threading, time
def run():
    sazare.run({str(BLOCK)!r}, {str(tmp_path / "run")!r}, overrides={{"time.end": 4e-1}}, progress=False)
threading.Thread(target=run, daemon=True).start()
while not list(__import__("pathlib").Path({str(tmp_path)!r}).glob("run/history.csv")):
    time.sleep(0.05)
time.sleep(0.5)
"""
    process = python(code)
    _, errors = process.communicate(timeout=120)
    assert process.returncode == 0, errors
    assert "terminate" not in errors
    assert sazare.open(tmp_path / "run").manifest["status"] == "stopped"
