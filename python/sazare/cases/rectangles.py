"""Cases of method rectangles, written by tools/write_case_classes.py from `sazare schema`."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from sazare.cases import Case as AnyCase
from sazare.cases import Part


@dataclass(kw_only=True, eq=False)
class Elements(Part):
    """What all elements have in common."""

    thickness: float | None = None
    """Depth of all elements across the plane. [m] Default: 1.0. Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Block(Part):
    """Bodies of squares that are joined on a lattice, of polygons, or of one rectangle."""

    name: str
    """Name of the block in messages."""
    material: str
    """What it is made of."""
    shape: Literal["rectangle", "polygon", "image"] | None = None
    """A rectangle, a polygon (of which squares fill it whose centres lie inside; convex for polygons), or the dark pixels of an
    image. Default: "rectangle".
    """
    elements: Literal["squares", "circles", "polygons"] | None = None
    """Squares, the circles inside them (with springs = 1 the ordinary circular elements), or the polygons around irregular
    nuclei, always with increments "exact". Default: "squares".
    """
    element_size: float | None = None
    """Side of the squares on the lattice; of an image, the side of a pixel; of polygons, the side of a square of their mean area.
    [m] (required except for a rectangle, which is one element without it; not with nuclei) Greater than 0.
    """
    nuclei: str | None = None
    """Nuclei of polygons, from a CSV file with the first line "x [m],y [m]", inside the block before it is turned. (polygons
    only; not with element_size)
    """
    seed: int | None = None
    """Which irregular nuclei are taken where no file gives them. Default: 1. At least 1 and at most 1e+06."""
    lower: tuple[float, float, float] | None = None
    """Corner with the smallest coordinates before it is turned; z is 0. [m] (required for a rectangle and an image)"""
    upper: tuple[float, float, float] | None = None
    """Corner with the largest coordinates before it is turned; z is 0. [m] (required for a rectangle)"""
    points: list[tuple[float, float]] | None = None
    """Corners in order, first and last the same; the lattice begins at their smallest coordinates. [m] (required for a polygon)
    """
    file: str | None = None
    """Grey image (.pgm): white is empty, neighbouring pixels of one grey are joined, others only touch. (required for an image)
    """
    angle: float | None = None
    """By how much it is turned about its lower corner, counter-clockwise. [deg] Default: 0.0."""


@dataclass(kw_only=True, eq=False)
class Material(Part):
    """What the blocks are made of."""

    name: str
    """Name by which blocks refer to it."""
    density: float
    """Mass per volume. [kg/m3] Greater than 0."""
    normal_stiffness: float | None = None
    """k_n: normal stress per strain between the centres of joined elements. [Pa] (normal_stiffness and shear_stiffness, or
    youngs_modulus and poisson_ratio) Greater than 0.
    """
    shear_stiffness: float | None = None
    """k_s: shear stress per strain between the centres of joined elements. [Pa] (normal_stiffness and shear_stiffness, or
    youngs_modulus and poisson_ratio) Greater than 0.
    """
    youngs_modulus: float | None = None
    """Young's modulus in plane strain, from which both stiffnesses follow: for squares as for a square lattice, for polygons by
    the mean over all directions. [Pa] (normal_stiffness and shear_stiffness, or youngs_modulus and poisson_ratio) Greater than
    0.
    """
    poisson_ratio: float | None = None
    """Poisson's ratio; below 0.25 for polygons. (normal_stiffness and shear_stiffness, or youngs_modulus and poisson_ratio) At
    least 0 and less than 0.5.
    """
    damping_ratio: float | None = None
    """h_n: share of critical damping of two joined elements. Default: 0.0. At least 0."""
    tensile_strength: float | None = None
    """Normal stress at which a spring breaks for good. [Pa] Default: inf. Greater than 0."""
    cohesion: float | None = None
    """Shear strength without normal stress, of springs that never broke. [Pa] Default: inf. At least 0."""
    friction_angle: float | None = None
    """Shear strength grows with the normal stress by its tangent. [deg] Default: 0.0. At least 0 and less than 90."""
    springs: int | None = None
    """N: springs on each face; with 1 the elements turn as circles do. Default: 5. At least 1 and at most 1000."""
    layout: Literal["centres", "ends"] | None = None
    """Springs in the middles of N equal parts of the face, or (N = 2) at its two ends. Default: "centres"."""
    increments: Literal["small", "exact"] | None = None
    """Formula of the springs' displacements: (15) for small relative rotations, or (3) for any. Default: "small"."""


@dataclass(kw_only=True, eq=False)
class Contact(Part):
    """Springs, dashpots and friction where elements meet that are not joined."""

    normal_stiffness: float
    """k_n between elements that are not joined, and between elements and supports. [Pa] Greater than 0."""
    shear_stiffness: float
    """k_s of the same. [Pa] Greater than 0."""
    damping_ratio: float | None = None
    """h_n of the same; never attracts. Default: 0.0. At least 0."""
    friction_angle: float
    """Angle of friction of the same. [deg] At least 0 and less than 90."""


@dataclass(kw_only=True, eq=False)
class Wall(Part):
    """Straight supports."""

    name: str
    """Name of the wall; its columns in history.csv begin with it."""
    from_: tuple[float, float, float]
    """Where it begins; from here to its end the free side is on the left, the solid one on the right. [m]"""
    to: tuple[float, float, float]
    """Where it ends; z is 0. [m]"""
    velocity: tuple[float, float, float] | None = None
    """Constant velocity. [m/s] Default: [0.0, 0.0, 0.0]."""
    motion_x: str | None = None
    """Motion along x. (not with a velocity)"""
    motion_y: str | None = None
    """Motion along y. (not with a velocity)"""


@dataclass(kw_only=True, eq=False)
class Roller(Part):
    """Circular supports and platens."""

    name: str
    """Name of the roller; its columns in history.csv begin with it."""
    center: tuple[float, float, float]
    """Its middle; z is 0. [m]"""
    radius: float
    """Its radius; it does not turn. [m] Greater than 0."""
    velocity: tuple[float, float, float] | None = None
    """Constant velocity. [m/s] Default: [0.0, 0.0, 0.0]."""
    motion_x: str | None = None
    """Motion along x. (not with a velocity)"""
    motion_y: str | None = None
    """Motion along y. (not with a velocity)"""


@dataclass(kw_only=True, eq=False)
class Motion(Part):
    """Waves and histories of the ground's motion."""

    name: str
    """Name by which boundaries refer to it."""
    type: Literal["ricker", "sine", "record", "function"]
    """A Ricker wavelet, a sine from t = 0, a record from a file, or a function that the caller gives in Python."""
    quantity: Literal["displacement", "velocity", "acceleration"] | None = None
    """What the formula describes; the other two follow by integration from rest or differentiation. (not for a record, whose file
    says it) Default: "acceleration".
    """
    amplitude: float | None = None
    """Factor of the formula, in m, m/s or m/s2 as the quantity is; of a record or a function, a plain factor. Default: 1.0."""
    frequency: float | None = None
    """Frequency of the sine, central frequency of the wavelet. [Hz] (required for a wavelet and a sine) Greater than 0."""
    peak_time: float | None = None
    """Time of the wavelet's peak; at least 1/frequency, so that it begins from rest. [s] (required for a wavelet) Greater than 0.
    """
    cycles: float | None = None
    """Number of periods of the sine; 0: without end. Default: 0.0. At least 0."""
    file: str | None = None
    """CSV with units in its header, PEER .AT2, or K-NET ASCII (.EW .NS .UD). (required for a record)"""
    baseline: Literal["none", "constant", "linear"] | None = None
    """What is taken off a record so that its integral has no trend: nothing, a constant or a straight line. Default: "none"."""


@dataclass(kw_only=True, eq=False)
class BaseFriction(Part):
    """A plate that drags all elements: the base-friction model of a slope."""

    friction_coefficient: float | None = None
    """Friction between all elements and the plate on which they lie; 0: there is none. Default: 0.0. At least 0."""
    velocity: tuple[float, float, float] | None = None
    """Velocity with which the plate is drawn away below them. [m/s] Default: [0.0, 0.0, 0.0]."""
    gravity: float | None = None
    """Gravity across the plane, which presses the elements on the plate. [m/s2] Default: 9.81. Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Gravity(Part):
    """Body force."""

    acceleration: tuple[float, float, float] | None = None
    """Acceleration of free fall. [m/s2] Default: [0.0, 0.0, 0.0]."""


@dataclass(kw_only=True, eq=False)
class Gauge(Part):
    """Elements whose motion is recorded."""

    name: str
    """Name of the gauge; its columns in gauges.csv begin with it."""
    point: tuple[float, float, float]
    """Where it is at the start: it takes the motion of the element that holds it. [m]"""


@dataclass(kw_only=True, eq=False)
class Time(Part):
    """How long, in which steps, and when results are written."""

    end: float
    """Time at which the run ends; it begins at 0. [s] Greater than 0."""
    step: float | None = None
    """Step of all elements; above the predicted limit the case is refused. [s] (default: stability_fraction of the predicted
    limit, or a little less) Greater than 0.
    """
    stability_fraction: float | None = None
    """Step over the predicted limit where no step is given. Default: 0.8. Greater than 0 and less than 1."""
    history_interval: float | None = None
    """Time between rows of the histories; the end is a whole multiple of it. [s] (default: about end/200) Greater than 0."""
    snapshot_interval: float | None = None
    """Time between snapshots; a whole multiple of history_interval, and the end one of it. [s] (default: about end/20) Greater
    than 0.
    """
    strict: bool | None = None
    """Refuse what would only be warned about. Default: false."""


@dataclass(kw_only=True, eq=False)
class Output(Part):
    """What is written besides histories and snapshots."""

    checkpoint_interval: float | None = None
    """Wall-clock time between checkpoints. [s] Default: 60.0. Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Case(AnyCase):
    """A case of method rectangles."""

    method: ClassVar[str] = "rectangles"
    tables: ClassVar[dict[str, type[Part]]] = {
        "elements": Elements,
        "blocks": Block,
        "materials": Material,
        "contact": Contact,
        "walls": Wall,
        "rollers": Roller,
        "motions": Motion,
        "base_friction": BaseFriction,
        "gravity": Gravity,
        "gauges": Gauge,
        "time": Time,
        "output": Output,
    }

    elements: Elements | None = None
    """What all elements have in common."""
    blocks: list[Block]
    """Bodies of squares that are joined on a lattice, of polygons, or of one rectangle."""
    materials: list[Material]
    """What the blocks are made of."""
    contact: Contact
    """Springs, dashpots and friction where elements meet that are not joined."""
    walls: list[Wall] = field(default_factory=list)
    """Straight supports."""
    rollers: list[Roller] = field(default_factory=list)
    """Circular supports and platens."""
    motions: list[Motion] = field(default_factory=list)
    """Waves and histories of the ground's motion."""
    base_friction: BaseFriction | None = None
    """A plate that drags all elements: the base-friction model of a slope."""
    gravity: Gravity | None = None
    """Body force."""
    gauges: list[Gauge] = field(default_factory=list)
    """Elements whose motion is recorded."""
    time: Time
    """How long, in which steps, and when results are written."""
    output: Output | None = None
    """What is written besides histories and snapshots."""
