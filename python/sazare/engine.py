"""The compiled engine, `sazare._engine`, loaded on first use."""

import atexit
import os
import sys
import threading
from contextlib import contextmanager
from functools import cache


_process = None  # that has loaded the engine
_work = threading.Condition()
_threads_at_work = 0
_is_ending = False


@contextmanager
def at_work():
    """While the engine computes without the lock of the interpreter, whose end waits for it: a daemon thread that came back to none would abort the process.

    Raises SystemExit in a thread where the interpreter has begun to end.
    """
    global _threads_at_work
    with _work:
        leave_if_ending()
        _threads_at_work += 1
    try:
        yield
    finally:
        with _work:
            _threads_at_work -= 1
            _work.notify_all()


def leave_if_ending():
    """Raises SystemExit in a thread other than the main one where the interpreter has begun to end."""
    if _is_ending and threading.current_thread() is not threading.main_thread():
        raise SystemExit


def _wait_for_work():
    global _is_ending
    if _process != os.getpid():
        return
    with _work:
        _is_ending = True
        _work.wait_for(lambda: _threads_at_work == 0)


def refuse_after_fork():
    """Raises RuntimeError in a process that was forked off one with an engine: the threads of the engine are not there, and a run would wait for
    them for ever."""
    if _process is not None and _process != os.getpid():
        raise RuntimeError(
            "this process was forked off one that has used the engine, whose threads a fork does not take along: start workers by "
            'multiprocessing.get_context("spawn"), or use the engine in them alone'
        )


@cache
def engine():
    """The module `sazare._engine`. Raises ImportError, saying what to do, where it was not built."""
    # Idle threads spin for a moment only, as in the command: OpenMP reads this when the engine is loaded.
    if "OMP_WAIT_POLICY" not in os.environ:
        os.environ.setdefault("GOMP_SPINCOUNT", "10000")
    try:
        from sazare import _engine
    except ModuleNotFoundError as error:
        raise ImportError(
            "the engine of Sazare is not built for this Python "
            f"({sys.version_info.major}.{sys.version_info.minor}): run make build in the source tree, or pip install ."
        ) from error
    global _process
    _process = os.getpid()
    atexit.register(_wait_for_work)
    for name in ("UserError", "PhysicsError", "MachineError"):
        getattr(_engine, name).__module__ = "sazare"
    return _engine


@contextmanager
def errors_of_commands():
    """Raises errors of the engine as those that commands tell: ValueError what the user can mend, OSError what the machine or the physics failed in."""
    try:
        yield
    except engine().UserError as error:
        raise ValueError(error) from error
    except (engine().MachineError, engine().PhysicsError) as error:
        raise OSError(error) from error
