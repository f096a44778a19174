"""Cases of method rectangles, written by tools/write_case_classes.py from `sazare schema`."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from sazare.cases import Case as AnyCase
from sazare.cases import Part


@dataclass(kw_only=True, eq=False)
class Elements(Part):
    """Thickness of all elements."""

    thickness: float | None = None
    """Out-of-plane thickness of all elements. [m] Default: 1.0. Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Block(Part):
    """Bodies: squares joined on a lattice, polygons, or one rectangle."""

    name: str
    """Name of the block in messages."""
    material: str
    """Material of the block."""
    shape: Literal["rectangle", "polygon", "image"] | None = None
    """A rectangle, a polygon (filled with the squares whose centres lie inside; convex where elements are polygons), or the dark
    pixels of an image. Default: "rectangle".
    """
    elements: Literal["squares", "circles", "polygons"] | None = None
    """Squares, the circles inscribed in them (with springs = 1 the usual circular elements), or the Voronoi polygons of irregular
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
    """Seed of the irregular nuclei where no file gives them. Default: 1. At least 1 and at most 1e+06."""
    lower: tuple[float, float, float] | None = None
    """Corner with the smallest coordinates before it is turned; z is 0. [m] (required for a rectangle and an image)"""
    upper: tuple[float, float, float] | None = None
    """Corner with the largest coordinates before it is turned; z is 0. [m] (required for a rectangle)"""
    points: list[tuple[float, float]] | None = None
    """Corners in order, first and last the same; the lattice starts at their smallest coordinates. [m] (required for a polygon)
    """
    file: str | None = None
    """Grey-scale image (.pgm): white is empty, neighbouring pixels of one grey are joined, others only touch. (required for an
    image)
    """
    angle: float | None = None
    """Rotation of the block about its lower corner, counter-clockwise. [deg] Default: 0.0."""


@dataclass(kw_only=True, eq=False)
class Material(Part):
    """Materials of the blocks."""

    name: str
    """Name by which blocks refer to it."""
    density: float
    """Mass per volume. [kg/m3] Greater than 0."""
    face_normal_stiffness: float | None = None
    """k_n: normal stiffness: stress per strain between the centres of joined elements. [Pa] (face_normal_stiffness and
    face_shear_stiffness, or youngs_modulus and poisson_ratio) Greater than 0.
    """
    face_shear_stiffness: float | None = None
    """k_s: shear stiffness: stress per strain between the centres of joined elements. [Pa] (face_normal_stiffness and
    face_shear_stiffness, or youngs_modulus and poisson_ratio) Greater than 0.
    """
    youngs_modulus: float | None = None
    """Young's modulus in plane strain, from which both stiffnesses follow: for squares by those of a square lattice, for polygons
    by the mean over all directions. [Pa] (face_normal_stiffness and face_shear_stiffness, or youngs_modulus and poisson_ratio)
    Greater than 0.
    """
    poisson_ratio: float | None = None
    """Poisson's ratio; below 0.25 for polygons. (face_normal_stiffness and face_shear_stiffness, or youngs_modulus and
    poisson_ratio) At least 0 and less than 0.5.
    """
    damping_ratio: float | None = None
    """h_n: damping ratio of two joined elements. Default: 0.0. At least 0."""
    tensile_strength: float | None = None
    """Tensile strength: normal stress at which a spring breaks for good. [Pa] Default: inf. Greater than 0."""
    cohesion: float | None = None
    """Cohesion: shear strength at zero normal stress, of springs that are not broken. [Pa] Default: inf. At least 0."""
    friction_angle: float | None = None
    """Friction angle of the springs. [deg] Default: 0.0. At least 0 and less than 90."""
    springs: int | None = None
    """N: number of springs on each face; with 1 the elements rotate like circles. Default: 5. At least 1 and at most 1000."""
    layout: Literal["centres", "ends"] | None = None
    """Position of the springs: at the centres of N equal parts of the face, or (N = 2) at its two ends. Default: "centres"."""
    increments: Literal["small", "exact"] | None = None
    """Formula for the displacements of the springs: (15) for small relative rotations, or (3) for any. Default: "small"."""


@dataclass(kw_only=True, eq=False)
class Contact(Part):
    """Springs, dashpots and friction between elements that touch without being joined."""

    face_normal_stiffness: float
    """k_n in contact: between elements that are not joined, and between elements and supports. [Pa] Greater than 0."""
    face_shear_stiffness: float
    """k_s in contact. [Pa] Greater than 0."""
    damping_ratio: float | None = None
    """h_n in contact: damping ratio; the normal force is never attractive. Default: 0.0. At least 0."""
    friction_angle: float
    """Friction angle of contacts. [deg] At least 0 and less than 90."""


@dataclass(kw_only=True, eq=False)
class Wall(Part):
    """Straight supports."""

    name: str
    """Name of the wall; its columns in history.csv begin with it."""
    from_: tuple[float, float, float]
    """Start point; seen towards the end point, the free side is on the left and the solid one on the right. [m]"""
    to: tuple[float, float, float]
    """End point; z is 0. [m]"""
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
    """Centre; z is 0. [m]"""
    radius: float
    """Radius; the roller does not turn. [m] Greater than 0."""
    velocity: tuple[float, float, float] | None = None
    """Constant velocity. [m/s] Default: [0.0, 0.0, 0.0]."""
    motion_x: str | None = None
    """Motion along x. (not with a velocity)"""
    motion_y: str | None = None
    """Motion along y. (not with a velocity)"""


@dataclass(kw_only=True, eq=False)
class Motion(Part):
    """Ground motions: wavelets, sines, records and functions of time."""

    name: str
    """Name by which boundaries refer to it."""
    type: Literal["ricker", "sine", "record", "function"]
    """A Ricker wavelet, a sine from t = 0, a record from a file, or a function that the caller gives in Python."""
    quantity: Literal["displacement", "velocity", "acceleration"] | None = None
    """What the formula describes; the other two follow by integration from rest or differentiation. Displacements count from
    where things stand at t = 0. After the end of a formula, a record or a function, what was given is the last displacement,
    no velocity or no acceleration; velocity that a record of accelerations leaves goes on. (not for a record, whose file
    states it) Default: "acceleration".
    """
    amplitude: float | None = None
    """Amplitude of the formula, in m, m/s or m/s2 according to the quantity, with which a wavelet has the value -amplitude at its
    peak time; for a record or a function, a dimensionless factor. Default: 1.0.
    """
    frequency: float | None = None
    """Frequency of the sine, central frequency of the wavelet. [Hz] (required for a wavelet and a sine) Greater than 0."""
    peak_time: float | None = None
    """Time of the wavelet's peak; at least 1/frequency, so that the wavelet begins at rest. [s] (required for a wavelet) Greater
    than 0.
    """
    cycles: float | None = None
    """Number of periods of the sine; 0: unlimited. Default: 0.0. At least 0."""
    file: str | None = None
    """CSV with a header that states the unit, such as "time [s],acceleration [gal]" (m/s2, g, gal or cm/s2, m/s, cm/s, m, cm),
    PEER .AT2, or K-NET ASCII (.EW .NS .UD). (required for a record)
    """
    baseline: Literal["none", "constant", "linear"] | None = None
    """Baseline correction: what is subtracted from a record so that its integral has no trend: nothing, a constant or a straight
    line. It is fitted to the whole record by least squares, so that a small velocity may be left at its end, which check
    tells. Default: "none".
    """


@dataclass(kw_only=True, eq=False)
class BaseFriction(Part):
    """Base-friction model of a slope: a plate beneath the elements that drags them by friction."""

    friction_coefficient: float | None = None
    """Coefficient of friction between all elements and the plate on which they lie; 0: no friction. Default: 0.0. At least 0."""
    velocity: tuple[float, float, float] | None = None
    """Velocity with which the plate is pulled beneath them. [m/s] Default: [0.0, 0.0, 0.0]."""
    gravity: float | None = None
    """Gravitational acceleration normal to the plane, which presses the elements on the plate. [m/s2] Default: 9.81. Greater than
    0.
    """


@dataclass(kw_only=True, eq=False)
class Gravity(Part):
    """Body force."""

    acceleration: tuple[float, float, float] | None = None
    """Gravitational acceleration. [m/s2] Default: [0.0, 0.0, 0.0]."""


@dataclass(kw_only=True, eq=False)
class Gauge(Part):
    """Elements whose motion is recorded."""

    name: str
    """Name of the gauge; its columns in gauges.csv begin with it."""
    point: tuple[float, float, float]
    """Initial position: the gauge records the motion of the element that contains it. [m]"""


@dataclass(kw_only=True, eq=False)
class Time(Part):
    """Duration, time step and intervals of output."""

    end: float
    """Time at which the run ends; it begins at 0. [s] Greater than 0."""
    step: float | None = None
    """Time step of all elements; above the predicted stability limit the case is refused. [s] (default: stability_fraction of the
    predicted stability limit, or a little less) Greater than 0.
    """
    stability_fraction: float | None = None
    """Ratio of the step to the predicted stability limit where no step is given. Default: 0.8. Greater than 0 and less than 1."""
    history_interval: float | None = None
    """Time between rows of the histories; the end is a whole multiple of it. [s] (default: about end/200) Greater than 0."""
    snapshot_interval: float | None = None
    """Time between snapshots; a whole multiple of history_interval, of which the end is a whole multiple. [s] (default: about
    end/20) Greater than 0.
    """
    strict: bool | None = None
    """Treat warnings as errors. Default: false."""


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
    """Thickness of all elements."""
    blocks: list[Block]
    """Bodies: squares joined on a lattice, polygons, or one rectangle."""
    materials: list[Material]
    """Materials of the blocks."""
    contact: Contact
    """Springs, dashpots and friction between elements that touch without being joined."""
    walls: list[Wall] = field(default_factory=list)
    """Straight supports."""
    rollers: list[Roller] = field(default_factory=list)
    """Circular supports and platens."""
    motions: list[Motion] = field(default_factory=list)
    """Ground motions: wavelets, sines, records and functions of time."""
    base_friction: BaseFriction | None = None
    """Base-friction model of a slope: a plate beneath the elements that drags them by friction."""
    gravity: Gravity | None = None
    """Body force."""
    gauges: list[Gauge] = field(default_factory=list)
    """Elements whose motion is recorded."""
    time: Time
    """Duration, time step and intervals of output."""
    output: Output | None = None
    """What is written besides histories and snapshots."""
