"""`sazare.partner`: both sides of a coupled run by files, without the engine."""

import os
import signal
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

from sazare import partner
from sazare.partner.exchange import FileExchange
from sazare.partner.messages import Message, file_name

ROOT = Path(__file__).resolve().parents[2]
NODES = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
FACES = np.array([[0, 1], [1, 2]])


def continuum(folder, **options):
    return partner.Continuum(folder, NODES, FACES, 1e-3, **{"time_out": 20.0, **options})


def bodies(folder, **options):
    return partner.Bodies(folder, **{"time_out": 20.0, **options})


def motion(window, pass_=0):
    """A displacement with bits that are easily lost."""
    return np.array([[0.1 * (window + 1), -0.0], [5e-324, 1 / 3 + pass_], [1e300, np.nextafter(1.0, 2.0)]])


def together(*sides):
    """Carries out both sides at once, and returns what they return; an error of the first that has one is raised."""
    with ThreadPoolExecutor(len(sides)) as pool:
        return [each.result() for each in [pool.submit(side) for side in sides]]


def error_of(side):
    """The words of the error that a side ends with."""

    def ended():
        try:
            side()
        except partner.PartnerError as error:
            return error
        return None

    return ended


def follow(folder, seen=None, **options):
    """Bodies whose force is minus the displacement."""
    with bodies(folder, **options) as other:
        other.answer(np.ones_like(NODES))
        for each in other:
            if seen is not None:
                seen.append(each)
            other.answer(-each.displacement, each.velocity)


def lead(folder, windows=3, **options):
    """A continuum that goes through windows, and returns the forces."""
    with continuum(folder, **options) as other:
        return [other.force, *(other.exchange(motion(window)) for window in range(windows))]


def test_every_bit_arrives(tmp_path):
    seen = []
    forces, _ = together(lambda: lead(tmp_path), lambda: follow(tmp_path, seen))
    assert [force.window for force in forces] == [-1, 0, 1, 2]
    assert (forces[0].mean == 1.0).all()
    for window, (got, force) in enumerate(zip(seen, forces[1:], strict=True)):
        assert got.displacement.tobytes() == motion(window).tobytes()
        assert force.mean.tobytes() == (-motion(window)).tobytes()
        assert got.time == force.time == (window + 1) * 1e-3
        assert not got.again


def test_velocity_is_the_mean_one_where_none_is_given(tmp_path):
    seen = []

    def leading():
        with continuum(tmp_path) as other:
            other.exchange(NODES)
            other.exchange(3 * NODES)
            other.exchange(4 * NODES, again=True)
            other.exchange(4 * NODES, velocity=NODES)

    together(leading, lambda: follow(tmp_path, seen))
    assert [(each.window, each.pass_, each.again) for each in seen] == [(0, 0, False), (1, 0, False), (1, 1, True), (2, 0, False)]
    for each, expected in zip(seen, (1e3 * NODES, 2e3 * NODES, 3e3 * NODES, NODES), strict=True):
        np.testing.assert_allclose(each.velocity, expected, rtol=1e-15)


def test_surface_in_space(tmp_path):
    def following():
        with bodies(tmp_path) as other:
            assert list(other) == []
            return other.shape

    def leading():
        with partner.Continuum(tmp_path, np.eye(3), [[0, 1, 2]], 0.5, width=1.0, time_out=20.0) as other:
            return other.force

    force, shape = together(leading, following)
    assert shape.force_unit == "N" and shape.faces.tolist() == [[0, 1, 2]] and (force.mean == 0).all()


def test_forces_at_the_beginning_are_none_where_nobody_says_them(tmp_path):
    def following():
        with bodies(tmp_path) as other:
            for _ in other:
                other.answer(NODES)

    forces, _ = together(lambda: lead(tmp_path), following)
    assert (forces[0].mean == 0).all() and (forces[1].mean == NODES).all() and (forces[1].last == NODES).all()


@pytest.mark.parametrize("behind", ["nobody", "continuum", "bodies"])
def test_run_that_was_stopped_goes_on(tmp_path, behind):
    """Both are stopped after window 6; the one that is behind goes on from its checkpoint after window 2, the other one from where it stopped."""
    marks = {}

    def leading(first, end, mark=None):
        with continuum(tmp_path, checkpoints=True, resume=mark) as other:
            for window in range(first, end):
                if window == 2:
                    marks["continuum", 2] = other.mark()
                force = other.exchange(motion(window), NODES)
                assert (force.window, force.mean.tobytes()) == (window, (-motion(window)).tobytes())
            marks["continuum", end] = other.mark()
            if mark is None:
                raise KeyboardInterrupt

    def following(first, mark=None):
        window = first
        try:
            with bodies(tmp_path, checkpoints=True, resume=mark) as other:
                if mark is None:
                    other.answer(np.zeros_like(NODES))
                for each in other:
                    assert each.window == window
                    if window == 2:
                        marks["bodies", 2] = other.mark()
                    other.answer(-each.displacement)
                    window += 1
        except partner.Stopped as stop:
            assert stop.window == window
            marks["bodies", window] = other.mark()
        return window

    with ThreadPoolExecutor(2) as pool:
        led, followed = pool.submit(leading, 0, 6), pool.submit(following, 0)
        with pytest.raises(KeyboardInterrupt):
            led.result()
        assert followed.result() == 6
    of_continuum, of_bodies = 2 if behind == "continuum" else 6, 2 if behind == "bodies" else 6
    together(lambda: leading(of_continuum, 9, marks["continuum", of_continuum]), lambda: following(of_bodies, marks["bodies", of_bodies]))


def test_window_that_is_given_up_begins_anew_on_both_sides(tmp_path):
    """The continuum is stopped in the second pass of window 1, when the bodies have answered it already."""
    marks = []

    def interrupted(*_):
        answered.wait()
        raise KeyboardInterrupt

    def leading():
        with pytest.raises(KeyboardInterrupt), continuum(tmp_path, checkpoints=True) as other:
            other.exchange(NODES)
            other.exchange(NODES)
            other._receive = interrupted
            try:
                other.exchange(NODES, again=True)
            finally:
                marks.append(other.mark())

    def following():
        with pytest.raises(partner.Stopped) as stop, bodies(tmp_path, checkpoints=True) as other:
            for each in other:
                other.answer(NODES)
                if each.again:
                    answered.set()
        assert stop.value.window == 1
        marks.append(other.mark())

    answered = threading.Event()
    together(leading, following)
    assert marks[0] == marks[1] == {"run": marks[0]["run"], "next": 2, "window": 1}


def test_messages_are_removed_when_both_have_passed_a_checkpoint(tmp_path):
    def leading():
        with continuum(tmp_path, checkpoints=True) as other:
            for window in range(8):
                other.exchange(motion(window))
                other.keep(other.mark())
            return sorted(path.name for path in tmp_path.glob("*.message"))

    def following():
        with bodies(tmp_path, checkpoints=True) as other:
            for each in other:
                other.keep(other.mark())
                other.answer(-each.displacement)

    left, _ = together(leading, following)
    assert len(left) < 8 and file_name("continuum", 0) in left and file_name("continuum", 3) not in left


def test_without_checkpoints_few_files_are_left(tmp_path):
    together(lambda: lead(tmp_path, 30), lambda: follow(tmp_path))
    assert len(list(tmp_path.iterdir())) < 16


def test_nobody_comes(tmp_path):
    with pytest.raises(partner.TimedOut, match=r"the bodies' program did not come within 0.1 s"):
        lead(tmp_path, time_out=0.1)


def test_partner_is_silent(tmp_path):
    quiet = FileExchange(tmp_path, "bodies")
    error, _ = together(error_of(lambda: lead(tmp_path, time_out=0.3)), quiet.meet)
    assert isinstance(error, partner.TimedOut) and "has sent nothing for 0.3 s" in str(error)
    quiet.close()


def test_partner_is_killed(tmp_path):
    code = f"""
import time
from sazare import partner
with partner.Bodies({str(tmp_path)!r}) as other:
    other.receive()
    print('here', flush=True)
    time.sleep(60)
"""
    victim = subprocess.Popen(
        [sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": str(ROOT / "python")}, stdout=subprocess.PIPE, text=True
    )

    def kill():
        assert victim.stdout.readline() == "here\n"
        victim.send_signal(signal.SIGKILL)
        victim.wait()

    error, _ = together(error_of(lambda: lead(tmp_path)), kill)
    assert isinstance(error, partner.Died) and f"process {victim.pid}" in str(error)


def test_partner_that_fails_says_why(tmp_path):
    def following():
        with pytest.raises(ZeroDivisionError), bodies(tmp_path) as other:
            other.receive()
            _ = 1 / 0

    error, _ = together(error_of(lambda: lead(tmp_path)), following)
    assert isinstance(error, partner.Failed) and "ZeroDivisionError: division by zero" in str(error)


def test_second_program_on_a_side(tmp_path):
    first = FileExchange(tmp_path, "bodies")
    with pytest.raises(partner.Busy, match="another program is the bodies"):
        FileExchange(tmp_path, "bodies")
    first.close()


def test_what_an_older_run_has_left_is_nobody(tmp_path):
    together(lambda: lead(tmp_path), lambda: follow(tmp_path))
    with pytest.raises(partner.TimedOut):
        follow(tmp_path, time_out=0.2)
    together(lambda: lead(tmp_path), lambda: follow(tmp_path))


def put(folder, bytes_, sequence=1):
    """A file in place of a message of the bodies."""
    (folder / file_name("bodies", sequence)).write_bytes(bytes_)


def led_against(folder, make):
    """The error of a continuum whose first motion is answered with the bytes that `make` makes of a sound message."""

    def following():
        with bodies(folder) as other:
            other.answer(NODES)
            message = Message("force", 0, 0, 1e-3, tables={"mean": (NODES, "N/m"), "last": (NODES, "N/m")})
            message.side, message.run, message.sequence = "bodies", other._files.run, 1
            put(folder, make(message))
            other._files._parted = True
            done.wait()

    done = threading.Event()

    def leading():
        try:
            return error_of(lambda: lead(folder, 1))()
        finally:
            done.set()

    return together(leading, following)[0]


def changed(message, **fields):
    for name, value in fields.items():
        setattr(message, name, value)
    return message.encode()


@pytest.mark.parametrize(
    ("make", "kind", "words"),
    [
        (lambda sound: sound.encode()[:150], partner.Damaged, "is half written: 150 of"),
        (lambda sound: sound.encode()[:20], partner.Damaged, "is half written: it ends in its head"),
        (lambda sound: sound.encode().replace(b"window 0", b"window 1"), partner.Damaged, "its checksum is not that of its bytes"),
        (lambda sound: changed(sound, run="other"), partner.Stale, "it is of run other, and this is run"),
        (lambda sound: changed(sound, sequence=5), partner.Stale, "it holds message 5, and 1 is awaited"),
        (lambda sound: changed(sound, window=5), partner.Stale, "out of step"),
        (lambda sound: sound.encode().replace(b"coupling 1", b"coupling 2"), partner.OtherVersion, "speaks version 2 of the protocol"),
        (lambda sound: b"something else\n", partner.OtherVersion, "is no file of a coupling"),
        (lambda sound: changed(sound, tables={"mean": (NODES, "N"), "last": (NODES, "N")}), partner.Mismatch, r"in \[N\] a row, and 2 in \[N/m\]"),
        (lambda sound: changed(sound, tables={"mean": (NODES[:2], "N/m")}), partner.Mismatch, "has 2 rows, and the surface has 3 nodes"),
        (lambda sound: changed(sound, tables={}), partner.Mismatch, "has no table 'mean'"),
        (lambda sound: changed(sound, tables={"mean": (np.full_like(NODES, np.inf), "N/m")}), partner.NotFinite, "the bodies' program: mean of node 0 in window 0"),
    ],
)
def test_what_is_wrong_is_told_apart(tmp_path, make, kind, words):
    error = led_against(tmp_path, make)
    assert type(error) is kind, repr(error)
    with pytest.raises(kind, match=words):
        raise error


def test_slow_writer_is_waited_for(tmp_path):
    def slowly(sound):
        whole = sound.encode()
        threading.Timer(0.2, lambda: put(tmp_path, whole)).start()
        return whole[:100]

    assert led_against(tmp_path, slowly) is None


def test_no_number_leaves(tmp_path):
    def leading():
        with continuum(tmp_path) as other:
            other.exchange(NODES * np.nan)

    leads, follows = together(error_of(leading), error_of(lambda: follow(tmp_path)))
    assert isinstance(leads, partner.NotFinite) and "this side: displacement of node 0" in str(leads)
    assert isinstance(follows, partner.Failed) and "NotFinite" in str(follows)


@pytest.mark.parametrize(
    ("nodes", "faces", "words"),
    [
        (NODES[:, 0], FACES, r"shape \(3,\)"),
        (NODES, [[0, 1, 2]], r"faces are an array of shape \(1, 3\), not \(m, 2\)"),
        (NODES, [[0, 3]], "a face has a node that is not there"),
    ],
)
def test_shapes_that_are_none(nodes, faces, words):
    with pytest.raises(partner.Mismatch, match=words):
        partner.Shape(nodes, faces, 1e-3)


def test_surfaces_that_do_not_match(tmp_path):
    expected = partner.Shape(NODES + [[0, 0], [0, 0], [0, 1e-9]], FACES, 1e-3)
    follows, leads = together(error_of(lambda: follow(tmp_path, shape=expected)), error_of(lambda: lead(tmp_path)))
    assert isinstance(follows, partner.Mismatch) and "number 2 of the nodes" in str(follows)
    assert isinstance(leads, partner.Failed) and "the surfaces do not match" in str(leads)
    with pytest.raises(partner.Mismatch, match="its window is 0.002"):
        partner.Shape(NODES, FACES, 1e-3).check_same(partner.Shape(NODES, FACES, 2e-3), "here")


def test_resumed_side_and_new_one_do_not_go_together(tmp_path):
    mark = {"run": "0123", "next": 4, "window": 3}
    errors = together(error_of(lambda: lead(tmp_path)), error_of(lambda: follow(tmp_path, resume=mark)))
    assert {type(error) for error in errors} == {partner.Mismatch}
    assert all("is at another run" in str(error) for error in errors)


def test_bytes_are_those_of_the_engine():
    """tests/unit/exchange/message_test.cpp has the same text."""
    of_engine = (
        b"sazare-coupling 1\nfrom continuum\nkind farewell\nrun r\nsequence 0\nwindow 0\npass 0\ntime 0\ndata\nchecksum a6bfae41\n"
    )
    message = Message.decode(of_engine, "file")
    assert (message.side, message.kind, message.run, message.time) == ("continuum", "farewell", "r", 0.0)
    assert message.encode()[: len(of_engine) - 25] == of_engine[:-25]


def test_import_takes_numpy_only():
    code = "import sys; from sazare import partner; assert not {'sazare._engine', 'matplotlib', 'pyvista', 'scipy'} & set(sys.modules)"
    subprocess.run([sys.executable, "-c", code], check=True, env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
