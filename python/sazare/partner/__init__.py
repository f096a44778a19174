"""Anyone's solver as a partner of Sazare in a coupled run: two programs that exchange files in a folder.

A solver of the continuum (finite elements, say) leads, window by window:

    from sazare import partner

    with partner.Continuum(folder, nodes, faces, window=1e-3) as bodies:
        for step in range(steps):
            ...  # one step with the forces `bodies.force.mean` [N]
            bodies.exchange(displacement, velocity)

and whoever has the bodies follows:

    with partner.Bodies(folder) as continuum:
        for motion in continuum:
            ...  # walk through the window while the surface moves to motion.displacement
            continuum.answer(mean, last)

Needs numpy and nothing else of Sazare. The protocol: docs/reference/coupling-files.md.
"""

from dataclasses import dataclass

import numpy as np

from sazare.partner.exchange import FileExchange
from sazare.partner.messages import (
    Busy, Damaged, Died, Failed, Message, Mismatch, NotFinite, OtherVersion, PartnerError, Stale, Stopped, TimedOut,
)

__all__ = [
    "Bodies", "Busy", "Continuum", "Damaged", "Died", "Failed", "Force", "Mismatch", "Motion", "NotFinite", "OtherVersion", "PartnerError",
    "Shape", "Stale", "Stopped", "TimedOut",
]


@dataclass(frozen=True)
class Shape:
    """The surface at the beginning.

    nodes: places [m] (n, 2) or (n, 3). faces: their nodes from 0, (m, 2) segments or (m, 3) triangles; the bodies are to the left of a segment,
    and on the side from which a triangle turns counterclockwise. window: length of a window [s]. width: of the slab of bodies that a plane
    stands for [m]; 1 in 3-D.
    """

    nodes: np.ndarray
    faces: np.ndarray
    window: float
    width: float = 1.0

    def __post_init__(self):
        object.__setattr__(self, "nodes", np.asarray(self.nodes, float))
        object.__setattr__(self, "faces", np.asarray(self.faces, np.int32))
        shape, faces = self.nodes.shape, self.faces
        if len(shape) != 2 or shape[0] == 0 or shape[1] not in (2, 3):
            raise Mismatch(f"the surface cannot be taken: its nodes are an array of shape {shape}, not (n, 2) or (n, 3)")
        if faces.ndim != 2 or len(faces) == 0 or faces.shape[1] != shape[1]:
            raise Mismatch(f"the surface cannot be taken: its faces are an array of shape {faces.shape}, not (m, {shape[1]})")
        if faces.min() < 0 or faces.max() >= shape[0]:
            raise Mismatch(f"the surface cannot be taken: a face has a node that is not there; there are {shape[0]}, counted from 0")
        if not self.window > 0 or not self.width > 0:
            raise Mismatch("the surface cannot be taken: windows and width must be above 0")

    @property
    def dimension(self):
        """2 or 3."""
        return self.nodes.shape[1]

    @property
    def force_unit(self):
        """The unit of forces on nodes; in 2-D they are per metre of width."""
        return "N/m" if self.dimension == 2 else "N"

    def to_message(self):
        """As it travels."""
        details = {"dimension": self.dimension, "width": float(self.width), "window_length": float(self.window)}
        return Message("shape", -1, details=details, tables={"nodes": (self.nodes, "m"), "faces": (self.faces.astype(float), "1")})

    @classmethod
    def of(cls, message):
        """The shape that a message brings."""
        dimension = int(message.details["dimension"])
        faces = message.table("faces", None, dimension, "1").astype(np.int32)
        nodes = message.table("nodes", None, dimension, "m")
        return cls(nodes, faces, float(message.details["window_length"]), float(message.details["width"]))

    def check_same(self, got, where):
        """Raises Mismatch with what differs from this shape."""
        for name in ("dimension", "width", "window"):
            if getattr(self, name) != getattr(got, name):
                raise Mismatch(f"{where}: the surfaces do not match: its {name} is {getattr(got, name)}, and {getattr(self, name)} is expected")
        for name in ("nodes", "faces"):
            ours, theirs = getattr(self, name), getattr(got, name)
            if ours.shape != theirs.shape:
                raise Mismatch(f"{where}: the surfaces do not match: {len(theirs)} {name}, and {len(ours)} are expected")
            if not np.array_equal(ours, theirs):
                first = np.argwhere(ours != theirs)[0][0]
                raise Mismatch(f"{where}: the surfaces do not match: number {first} of the {name} is {theirs[first]}, and {ours[first]} is expected")

    def rows(self, values, what):
        """An array with a row for every node. Raises Mismatch when it is none."""
        values = np.asarray(values, float)
        if values.shape != self.nodes.shape:
            raise Mismatch(f"{what} is an array of shape {values.shape}, and the surface needs {self.nodes.shape}")
        return values


@dataclass(frozen=True)
class Motion:
    """Where the nodes are at the end of a window: displacement since the beginning [m], velocity [m/s], both as the shape's nodes.

    A motion whose `again` is true takes the bodies back to the beginning of the same window.
    """

    window: int
    pass_: int
    time: float
    displacement: np.ndarray
    velocity: np.ndarray

    @property
    def again(self):
        """Whether the window is gone through once more."""
        return self.pass_ > 0


@dataclass(frozen=True)
class Force:
    """What the nodes got from the bodies in a window, in the plane [N/m] and in space [N], as the shape's nodes.

    mean: impulse over the window by its length. last: at the window's end.
    """

    window: int
    pass_: int
    time: float
    mean: np.ndarray
    last: np.ndarray


class _Side:
    """What both sides share: the place in the folder, the farewell, and where a run can go on."""

    def __init__(self, folder, side, resume, keeps_checkpoints, time_out):
        self._place = folder, side, resume, keeps_checkpoints, time_out
        self._files = None
        self._start = (resume["window"], resume["next"]) if resume else (0, 0)  # window at whose beginning this side stands, and its sequence
        self._is_done = False

    def __enter__(self):
        self._files = FileExchange(*self._place)
        try:
            self._begin()
        except BaseException as error:
            self.__exit__(type(error), error, None)
            raise
        return self

    def __exit__(self, kind, error, _):
        try:
            if kind is None and self._is_done:
                self._files.part("done", self._start[0])
            elif kind is None or issubclass(kind, (KeyboardInterrupt, Stopped)):
                self._files.part("stopped", self._start[0])
            else:
                self._files.part("failed", self._start[0], f"{kind.__name__}: {error}")
        finally:
            self._files.close()

    def mark(self):
        """For a checkpoint of the beginning of a window: a dict of text and numbers, later handed in as `resume`.

        The continuum stands at the beginning of the next window between two exchanges. The bodies stand at the beginning of the window whose
        motion they have got, and after Stopped at that of the window which it names.
        """
        window, sequence = self._start
        return {"run": self._files.run, "next": sequence, "window": window}

    def keep(self, mark):
        """Tells that a checkpoint with this mark is on the disk: messages that nobody needs any more are removed."""
        self._files.keep_from(mark["next"])


class Continuum(_Side):
    """The side of the continuum: it leads. A context; its end is the end of the run.

    folder: of the exchange, the same for both programs; made where it is not there.
    nodes, faces, window, width: see Shape.
    time_out: how long to wait for the partner [s].
    checkpoints: whether this side can be resumed (see `mark` and `keep`); the partner then keeps its messages until a checkpoint has passed.
    resume: the mark of a checkpoint.

    Raises the errors of this module.
    """

    def __init__(self, folder, nodes, faces, window, *, width=1.0, time_out=600.0, checkpoints=False, resume=None):
        self.shape = Shape(nodes, faces, window, width)
        super().__init__(folder, "continuum", resume, checkpoints, time_out)
        self._resumed = resume is not None
        self._pass, self._last = 0, None  # of the last window: its passes, and its beginning
        self._before = self._displacement = None if self._resumed else np.zeros_like(self.shape.nodes)  # at both ends of the last window
        self.force = None  # the last one; after a resume none, until the next exchange
        self._is_done = True  # unless an error comes

    def _begin(self):
        self._files.meet()
        if self._resumed:
            Shape.of(self._files.own(0)).check_same(self.shape, "the resumed run")
            return
        self._files.send(self.shape.to_message())
        self.force = self._receive(-1, 0)
        self._start = (0, self._files.next)

    def exchange(self, displacement, velocity=None, *, again=False):
        """Tells where the nodes are at the end of the next window, and returns the bodies' Force of it.

        displacement: since the beginning [m], as the nodes. velocity [m/s]; where it is None, the mean one of the window (after a resume the
        first one must be given).
        again: goes through the last window once more, instead of accepting it.
        """
        displacement = self.shape.rows(displacement, "displacement")
        if again and self._last is None:
            raise ValueError("there is no window yet that could be repeated")
        if again:
            self._start = self._last
        else:
            self._before, self._last = self._displacement, self._start
        if velocity is None:
            if self._before is None:
                raise ValueError("after a resume the velocity must be given, since the displacement before is not known")
            velocity = (displacement - self._before) / self.shape.window
        self._pass = self._pass + 1 if again else 0
        window = self._start[0]
        tables = {"displacement": (displacement, "m"), "velocity": (self.shape.rows(velocity, "velocity"), "m/s")}
        self._files.send(Message("motion", window, self._pass, (window + 1) * self.shape.window, tables=tables))
        self.force = self._receive(window, self._pass)
        self._start, self._displacement = (window + 1, self._files.next), displacement.copy()
        return self.force

    def _receive(self, window, pass_):
        message = self._files.receive(self._files.next - 1)
        if (message.kind, message.window, message.pass_) != ("force", window, pass_):
            raise Stale(f"the bodies answer with a {message.kind} of window {message.window}, pass {message.pass_}: they are out of step")
        rows, columns = self.shape.nodes.shape
        mean, last = (message.table(name, rows, columns, self.shape.force_unit) for name in ("mean", "last"))
        return Force(window, pass_, message.time, mean, last)


class Bodies(_Side):
    """The side of the bodies: it follows. A context, and an iterator over motions until the continuum closes; each is to be answered.

    The forces at the beginning are answered before the first motion; where they are not, they are taken as none.
    shape: what the surface should be, a Shape; None for any. The other arguments as for Continuum.
    """

    def __init__(self, folder, *, shape=None, time_out=600.0, checkpoints=False, resume=None):
        super().__init__(folder, "bodies", resume, checkpoints, time_out)
        self._expected, self._motion = shape, None
        self.shape = shape

    def _begin(self):
        self._files.meet()
        message = self._files.receive(0)
        if message.kind != "shape":
            raise Stale(f"a {message.kind} came, and the shape is awaited")
        self.shape = Shape.of(message)
        if self._expected is not None:
            self._expected.check_same(self.shape, "the continuum's surface")

    def __iter__(self):
        while (motion := self.receive()) is not None:
            yield motion
            if self._motion is not None:
                raise RuntimeError(f"the motion of window {motion.window} was not answered")

    def receive(self):
        """Waits for the next Motion; None when the continuum has closed."""
        if self._files.next == 0:
            self.answer(np.zeros_like(self.shape.nodes))
        try:
            message = self._files.receive(self._files.next)
        except Stopped as stop:
            self._stand_at(stop.window)
            raise
        self._stand_at(message.window)
        if message.kind == "farewell":
            self._is_done = True
            return None
        rows, columns = self.shape.nodes.shape
        displacement = message.table("displacement", rows, columns, "m")
        self._motion = Motion(message.window, message.pass_, message.time, displacement, message.table("velocity", rows, columns, "m/s"))
        return self._motion

    def _stand_at(self, window):
        if window != self._start[0]:  # else it is gone through once more, or given up
            self._start = (window, self._files.next)

    def answer(self, mean, last=None):
        """Answers the motion, or before the first one the shape: forces on the nodes as Force has them; `last` is `mean` where it is None."""
        mean = self.shape.rows(mean, "mean")
        last = mean if last is None else self.shape.rows(last, "last")
        unit, motion = self.shape.force_unit, self._motion
        window, pass_, time = (motion.window, motion.pass_, motion.time) if motion else (-1, 0, 0.0)
        self._files.send(Message("force", window, pass_, time, tables={"mean": (mean, unit), "last": (last, unit)}))
        if motion is None:
            self._start = (0, self._files.next)
        self._motion = None
