"""Cases of method hybrid, written by tools/write_case_classes.py from `sazare schema`."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from sazare.cases import Case as AnyCase
from sazare.cases import Part


@dataclass(kw_only=True, eq=False)
class Sides(Part):
    """The two cases that are coupled: continuum and bodies."""

    continuum: str
    """Case of finite elements, relative to this file; its time step is the coupling window, at whose ends the two solvers
    exchange force and motion; it may also be run alone.
    """
    bodies: str
    """Case of method spheres, rectangles, blocks or mps with the same end and intervals; its time step divides the coupling
    window, and is chosen accordingly where it is not given.
    """


@dataclass(kw_only=True, eq=False)
class Surface(Part):
    """Coupling surface."""

    group: str
    """Physical group of outer faces of the continuum (lines in 2-D), which acts on the bodies as a moving wall."""
    material: str | None = None
    """Material of the bodies' case that the surface has in contact; rectangles and blocks have one contact law. (required for
    bodies of method spheres, and only for them)
    """
    friction_coefficient: float | None = None
    """Friction between the ground and the surface; of a wall often two thirds of the ground's friction angle, as a tangent. The
    surface has no cohesion with the ground. (required for bodies of method mps, and only for them) At least 0.
    """
    width: float | None = None
    """Width along z of the slab of bodies, by which forces are divided: a continuum in 2-D takes them per metre. [m] (required
    for spheres and blocks where the continuum is in 2-D, and only there) Greater than 0.
    """


@dataclass(kw_only=True, eq=False)
class Coupling(Part):
    """Coupling scheme: how force and motion are exchanged."""

    scheme: Literal["automatic", "lagged", "impulse", "iterative"] | None = None
    """Force on the continuum in a coupling window: lagged: that at the end of the window before; impulse: the mean of the window
    before; iterative: found by repeating the window until force and motion agree; automatic: the mean of the window before,
    and windows in which more than a hundredth of the force differs are repeated. Default: "automatic".
    """
    tolerance: float | None = None
    """Difference between the assumed and the resulting force, divided by the larger of the two. (scheme iterative) Default: 1e-4.
    At least 1e-13 and at most 0.1.
    """
    max_passes: int | None = None
    """Maximum passes through a coupling window. (schemes iterative and automatic) Default: 20. At least 2 and at most 1000."""


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
    """The two cases that are coupled: continuum and bodies."""
    surface: Surface
    """Coupling surface."""
    coupling: Coupling | None = None
    """Coupling scheme: how force and motion are exchanged."""
    output: Output | None = None
    """What is written besides histories and snapshots."""
