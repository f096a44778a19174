"""Running cases: from start to end, or step by step with positions, velocities and forces as numpy arrays in between."""

import math
import re
import tempfile
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from sazare.cases import Case, toml_value
from sazare.engine import at_work, engine, leave_if_ending, refuse_after_fork
from sazare.histories import histories_of
from sazare.progress import ProgressLine
from sazare.results import open_run

GLANCE = 0.1  # s of wall time after which Python is back, for Ctrl-C and progress
WINDOW = 256  # steps for which functions of time are sampled ahead


@dataclass(frozen=True)
class Source:
    """Where a case comes from: a file, or a text with the folder in which its files are."""

    path: Path
    text: str | None = None
    overrides: list[str] = field(default_factory=list)
    name: str = "case"

    def with_settings(self, settings):
        """This source with more keys overridden, each as `table.key=value`."""
        return replace(self, overrides=[*self.overrides, *settings])

    def for_engine(self):
        """This source in the form that the engine takes."""
        return engine().CaseSource(self.text, self.path, self.overrides)

    def resolved(self):
        """The case as TOML with every key and default. Raises UserError with all that is wrong."""
        with at_work():
            return engine().resolved(self.for_engine())


def source_of(case, overrides=None, folder=None):
    """A path, a TOML text or a case object as a Source. A text is known by its line breaks or equal signs."""
    settings = [f"{key}={toml_value(value)}" for key, value in (overrides or {}).items()]
    if isinstance(case, Case):
        folder, case = folder or case.folder, case.to_toml()
    if isinstance(case, str) and ("\n" in case or "=" in case):
        return Source(Path(folder or ".") / "case", case, settings, _name_from_title(case))
    path = Path(case)
    full = path.absolute()
    return Source(path, None, settings, full.parent.name if full.stem in ("case", "study") else full.stem)


def _name_from_title(text):
    title = re.search(r"^\s*title\s*=\s*[\"'](.*?)[\"']", text, re.MULTILINE)
    return re.sub(r"[^a-z0-9]+", "-", title[1].lower()).strip("-") or "case" if title else "case"


def check(case, *, overrides=None, folder=None):
    """Describes what a case will do: the resolved case, its time steps and what limits them, as `sazare check`. Takes no step; a .geo is meshed by Gmsh.

    Raises UserError with all errors of the case.
    """
    source = source_of(case, overrides, folder)
    with at_work():
        return engine().check(source.for_engine())


def run(
    case,
    out=None,
    *,
    overrides=None,
    folder=None,
    threads=0,
    overwrite=False,
    resume=False,
    progress=True,
    functions=None,
    forces=None,
    stop=None,
):
    """Runs a case and opens its results.

    case: the path of a case file, its TOML text, or a case object of `sazare.cases`.
    out: the run's folder; runs/<name of the case> where it is None.
    overrides: keys to change, such as {"time.end": 1e-4, "joints.0.cohesion": 5e6}.
    folder: where the files named in a text are; the current folder where it is None.
    threads: number of threads; 0 uses all processors.
    overwrite, resume: what to do with an existing run in the folder; without either it is an error.
    functions: a function of time [s] for each motion of type "function" and each blast with `function`, by name. A motion's gives its quantity, a
        blast's the pressure [Pa] at a time since its delay. Evaluated once per step; linear in between.
    forces: a function of the simulation that gives forces [N] on the bodies, (n, 3) in the order of `positions`; of mps and fem in the plane [N/m]; of
        blocks also (n, 6), with moments about the centres [N m]. Evaluated before every step (blocks: base step; hybrid: window); they act from its
        beginning (in method fem, whose steps are implicit, at its end) and through it.
    stop: a function of the simulation, evaluated after every step; True ends the run there, with a checkpoint.

    A resumed run needs the same functions and forces again. Exceptions that they raise propagate unchanged, and a checkpoint is kept.

    Raises UserError, PhysicsError or MachineError with the messages of the command. Ctrl-C keeps a checkpoint, from which `resume` continues.
    """
    source = source_of(case, overrides, folder)
    where = Path(out or Path("runs") / source.name).absolute()
    simulation = Simulation(source, where, threads, overwrite, resume, progress, functions=functions, forces=forces)
    try:
        simulation.run(stop)
    finally:
        simulation.stop()
    return simulation.results


def build(
    case, out=None, *, overrides=None, folder=None, threads=0, overwrite=False, resume=False, progress=False, functions=None, forces=None, warns=True
):
    """Prepares a case to be advanced step by step, and returns its Simulation; arguments and errors as for `run`.

    warns: whether warnings about the case are printed.

    Without `out` the run is kept in a temporary folder, which is removed with the simulation.

        with sazare.build("cases/column-ricker/case.toml") as simulation:
            simulation.every(0.1, lambda now: print(now.time, now.velocities[:, 0].max()))
            simulation.run()
    """
    source = source_of(case, overrides, folder)
    temporary = tempfile.TemporaryDirectory(prefix="sazare-") if out is None else None
    where = Path(temporary.name) / source.name if temporary else Path(out).absolute()
    return Simulation(source, where, threads, overwrite, resume, progress, temporary, functions, forces, warns)


def _real_numbers(given):
    """What a caller's function of forces has returned, as an array of doubles."""
    what = "nothing" if given is None else "complex numbers" if np.iscomplexobj(given) else None
    if what is None:
        try:
            return np.ascontiguousarray(given, dtype=float)
        except (TypeError, ValueError):
            what = type(given).__name__
    raise ValueError(f"forces must return real numbers, a row for each body; found {what}")


class Simulation:
    """A case being run, made by `run` and `build`. As a context manager, it is stopped at the end of the block if it is not complete.

    Histories, gauges, snapshots and checkpoints are written along the way exactly as by the command, bit for bit.
    """

    def __init__(
        self, source, path, threads=0, overwrite=False, resume=False, progress=False, temporary=None, functions=None, forces=None, warns=True
    ):
        refuse_after_fork()
        begin = "resume" if resume else "overwrite" if overwrite else "fresh"
        self.path = path
        self._temporary = temporary
        self._progress = progress
        self._calls = []  # (next step, steps between or 0, function)
        with at_work():
            self._live = engine().LiveSimulation(source.for_engine(), path, begin, threads, warns=warns, takes_forces=forces is not None)
        self._histories = histories_of(self._live, functions or {})
        self._forces = forces
        self._pushed_at = None  # the step at which forces were given last
        self._asks_for_forces = False
        if forces is not None:
            self._live.require_forces()
            if not callable(forces):
                raise TypeError(f"forces must be a function of the simulation; found {type(forces).__name__}")
        try:
            self._prepare(0)
            self._compute(self._live.begin)
            self._pushed_at = None  # a resumed run begins at another step
        except KeyboardInterrupt:
            self.stop()
            raise

    def __repr__(self):
        return f"Simulation({self.title!r}: t = {self.time:.4g} s of {self.end:.4g} s)"

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        if kind is None or kind is KeyboardInterrupt:
            self.stop()

    @property
    def title(self):
        """Title of the case."""
        return self._live.title

    @property
    def words(self):
        """Number of bodies and time step, as text."""
        return self._live.words

    @property
    def warnings(self):
        """Warnings about the case; empty where there are none."""
        return self._live.warnings

    @property
    def time(self):
        """Simulated time [s]."""
        return self._live.time

    @property
    def end(self):
        """Time at which the case ends [s]."""
        return self._live.end

    @property
    def step(self):
        """Number of completed steps; in method blocks, base steps."""
        return self._live.step

    @property
    def steps(self):
        """Number of steps to the end."""
        return self._live.steps

    @property
    def is_over(self):
        """Whether the end has been reached."""
        return self.step >= self.steps

    @property
    def positions(self):
        """Centres [m] (n, 3) at `time`, in the order of the snapshots; z is 0 in the plane.

        The array is a read-only view of the engine's memory. It stays valid and holds the state at `time` after every
        `advance`, `run` and call: copy what is to be kept.
        """
        return self._live.positions

    @property
    def velocities(self):
        """Velocities [m/s] (n, 3), as `positions`."""
        return self._live.velocities

    @property
    def forces(self):
        """Resultant forces, including gravity [N] (n, 3), as `positions`; in the plane per unit length [N/m]."""
        return self._live.forces

    @property
    def results(self):
        """The run's folder as `sazare.open` reads it, as far as it has been written."""
        return open_run(self.path)

    def at(self, times, function):
        """Calls function(simulation) at a time [s], or at each of several; at the first step not before it.

        A function that returns True ends the advance there. Raises ValueError for a time in the past.
        """
        for time in times if hasattr(times, "__iter__") else [times]:
            if time < self.time:
                raise ValueError(f"t = {time} s is past: the simulation is at {self.time} s")
            self._calls.append((self._step_at(time), 0, function))

    def every(self, interval, function):
        """Calls function(simulation) at an interval of simulated time [s], in whole steps; True ends the advance there."""
        steps = max(1, round(interval / self.end * self.steps))
        self._calls.append((self.step + steps, steps, function))

    def advance(self, duration):
        """Advances by a duration [s], to the first step not before its end. Returns the time reached [s]."""
        return self._walk(self._step_at(self.time + duration))

    def advance_to(self, time):
        """Advances to a time [s], to the first step not before it. Returns the time reached [s]."""
        return self._walk(self._step_at(time))

    def run(self, stop=None):
        """Advances to the end, unless a call ends it or stop(simulation), evaluated after every step, is true. Returns the time reached [s]."""
        return self._walk(self.steps, stop)

    def stop(self):
        """Stops the run, with a checkpoint from which `resume` continues, and releases its folder.

        Does nothing where the run has ended. The arrays remain valid.
        """
        with at_work():
            self._live.finish()

    def _step_at(self, time):
        return min(self.steps, math.ceil(time / self.end * self.steps - 1e-6))

    def _walk(self, until, stop=None):
        try:
            with ProgressLine(self._progress) as line:
                while self.step < until:
                    target = self._next_pause(until, stop)
                    self._prepare(target)
                    self._compute(self._live.walk, target, GLANCE)
                    line.show(self._live.progress_text)
                    if self._call_what_is_due() or (stop is not None and stop(self)):
                        break
        except KeyboardInterrupt:
            self.stop()
            raise
        if self.is_over:
            self.stop()
        return self.time

    def _compute(self, function, *arguments):
        """Lets the engine compute. Where the interpreter ends meanwhile, a daemon thread leaves the run stopped, with a checkpoint."""
        with at_work():
            function(*arguments)
            try:
                leave_if_ending()
            except SystemExit:
                self._live.finish()
                raise

    def _next_pause(self, until, stop):
        """The next step at which Python has something to do."""
        if stop is not None or self._forces is not None:
            return self.step + 1
        window = [self.step + WINDOW] if self._histories else []
        return min([until, *window, *(step for step, _, _ in self._calls)])

    def _prepare(self, step):
        """Evaluates the caller's functions as far as the engine needs them to reach a step."""
        for history in self._histories:
            history.sample(self._live, step)
        if self._forces is not None and self._pushed_at != self.step:  # the engine may come back within a step
            self._push()
            self._pushed_at = self.step

    def _push(self):
        """Hands the caller's forces at this step to the engine; with six columns, moments too."""
        if self._asks_for_forces:
            raise RuntimeError("forces are asked for while a step is made: the function cannot advance the same simulation")
        self._asks_for_forces = True
        try:
            given = self._forces(self)
        finally:
            self._asks_for_forces = False
        forces = _real_numbers(given)
        bodies = len(self.positions)
        if forces.shape not in ((bodies, 3), (bodies, 6)):
            raise ValueError(f"forces must be of shape {(bodies, 3)}, a row for each body, or {(bodies, 6)} with moments in method blocks; found {forces.shape}")
        if not np.isfinite(forces).all():
            raise ValueError(f"forces at t = {self.time} s are not all finite numbers")
        if forces.shape[1] == 3:
            self._live.apply(forces)
        else:
            self._live.apply(np.ascontiguousarray(forces[:, :3]), np.ascontiguousarray(forces[:, 3:]))

    def _call_what_is_due(self):
        """Whether a call asks the advance to end."""
        due = [call for call in self._calls if call[0] <= self.step]
        self._calls = [call for call in self._calls if call[0] > self.step]
        self._calls += [(step + between, between, function) for step, between, function in due if between]
        return any([function(self) is True for _, _, function in due])
