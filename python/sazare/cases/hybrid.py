"""Cases of method hybrid, written by tools/write_case_classes.py from `sazare schema`."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from sazare.cases import Case as AnyCase
from sazare.cases import Part


@dataclass(kw_only=True, eq=False)
class Sides(Part):
    """The two cases that are coupled."""

    continuum: str
    """Case of method fem, relative to this file; its step is the window in which the sides exchange motion for force, and it may
    also be run alone.
    """
    bodies: str
    """Case of method spheres, rectangles or blocks with the same end and intervals; its step divides the window, and is chosen so
    where it is not given.
    """


@dataclass(kw_only=True, eq=False)
class Surface(Part):
    """Where they touch."""

    group: str
    """Physical group of outer faces of the continuum (in 2-D of lines) that the bodies feel as a moving wall."""
    material: str | None = None
    """Material of the bodies' case of which the surface is in contact; rectangles and blocks have one contact law. (required for
    bodies of method spheres, and only for them)
    """
    width: float | None = None
    """Width along z of the slab of bodies whose forces the plane gets per metre. [m] (required for spheres and blocks where the
    continuum is in 2-D, and only there) Greater than 0.
    """


@dataclass(kw_only=True, eq=False)
class Coupling(Part):
    """How force and motion are exchanged."""

    scheme: Literal["paper", "impulse", "repeat"] | None = None
    """Force with which the continuum goes through a window: paper takes that at the end of the window before, impulse the mean of
    the window before, repeat goes through it again until force and motion agree. Default: "impulse".
    """
    tolerance: float | None = None
    """Difference between the force that was tried and the one that came of it, over the larger. (scheme repeat) Default: 1e-4. At
    least 1e-13 and at most 0.1.
    """
    passes: int | None = None
    """Through a window, at most. (scheme repeat) Default: 20. At least 2 and at most 1000."""


@dataclass(kw_only=True, eq=False)
class Output(Part):
    """What is written besides histories and snapshots."""

    checkpoint_interval: float | None = None
    """Wall-clock time between checkpoints. [s] Default: 60.0. Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Case(AnyCase):
    """A case of method hybrid."""

    method: ClassVar[str] = "hybrid"
    tables: ClassVar[dict[str, type[Part]]] = {
        "sides": Sides,
        "surface": Surface,
        "coupling": Coupling,
        "output": Output,
    }

    sides: Sides
    """The two cases that are coupled."""
    surface: Surface
    """Where they touch."""
    coupling: Coupling | None = None
    """How force and motion are exchanged."""
    output: Output | None = None
    """What is written besides histories and snapshots."""
