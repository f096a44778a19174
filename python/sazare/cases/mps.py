"""Cases of method mps, written by tools/write_case_classes.py from `sazare schema`."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from sazare.cases import Case as AnyCase
from sazare.cases import Part


@dataclass(kw_only=True, eq=False)
class Particles(Part):
    """The lattice on which particles stand."""

    spacing: float
    """Distance of neighbouring particles on the lattice, twice the particle's radius. [m] Greater than 0."""
    dimension: int | None = None
    """2 for plane strain in x and y (up), 3 for a body in x, y and z (up). Default: 2. At least 2 and at most 3."""
    influence: float | None = None
    """Influence radius over the spacing: particles nearer than this are linked. Default: 1.5. Greater than 1 and at most 3."""
    fit: Literal["exact", "inside"] | None = None
    """Whether rectangles must be whole multiples of the spacing, or hold as many particles as fit inside. Default: "exact"."""
    periodic: list[Literal["x", "y", "z"]] | None = None
    """Axes along which the body repeats itself: its two ends are linked, as in a layer without end. Default: []."""
    rotation: Literal["mean_rotation", "mean_angle"] | None = None
    """How rotation is taken out of deformations: by the mean of two rotations, or by the mean angle (2-D only). Default:
    "mean_rotation".
    """


@dataclass(kw_only=True, eq=False)
class Region(Part):
    """What is filled with particles."""

    name: str
    """Name by which materials refer to the region; where regions overlap, the last one counts."""
    shape: Literal["rectangle", "polygon", "mesh"] | None = None
    """A rectangle (in 3-D a box), a polygon (2-D), or a volume group of a Gmsh mesh. Default: "rectangle"."""
    lower: tuple[float, float, float] | None = None
    """Corner with the smallest coordinates; z is 0 in 2-D. [m] (required for a rectangle)"""
    upper: tuple[float, float, float] | None = None
    """Corner with the largest coordinates; z is 0 in 2-D. [m] (required for a rectangle)"""
    points: list[tuple[float, float]] | None = None
    """Corners in order, first and last the same. [m] (required for a polygon)"""
    file: str | None = None
    """Gmsh mesh (.msh, format 4.1) or geometry (.geo); in 2-D its section z = 0. (required for a mesh)"""
    group: str | None = None
    """Physical volume group of the mesh that is filled. (required for a mesh)"""


@dataclass(kw_only=True, eq=False)
class Material(Part):
    """What the regions are made of."""

    name: str
    """Name of the material in messages."""
    regions: list[str]
    """Regions that are made of it."""
    density: float
    """Mass per volume. [kg/m3] Greater than 0."""
    s_wave_velocity: float | None = None
    """Velocity of S waves. [m/s] (exactly two of s_wave_velocity, p_wave_velocity and poisson_ratio) Greater than 0."""
    p_wave_velocity: float | None = None
    """Velocity of P waves. [m/s] (exactly two of s_wave_velocity, p_wave_velocity and poisson_ratio) Greater than 0."""
    poisson_ratio: float | None = None
    """Poisson's ratio. (exactly two of s_wave_velocity, p_wave_velocity and poisson_ratio) At least 0 and less than 0.5."""
    damping_ratio: float | None = None
    """Share of critical damping at the frequencies f1 and f2 of [damping]. Default: 0.0. At least 0 and at most 2."""
    cohesion: float | None = None
    """Cohesion of Mohr and Coulomb's strength. [Pa] (default: the material is elastic and never fails) At least 0."""
    friction_angle: float | None = None
    """Angle of friction, in the ground and, once links are broken, between particles. [deg] (required with a cohesion) At least 0
    and at most 60.
    """
    dilation_angle: float | None = None
    """Angle of dilation; at most the friction angle. [deg] (only with a cohesion) Default: 0.0. At least 0 and at most 60."""
    tensile_strength: float | None = None
    """Largest tensile stress; at most cohesion/tan(friction_angle). [Pa] (only with a cohesion) Default: 0.0. At least 0."""
    rupture_strain: float | None = None
    """Plastic slip (of engineering shear strain) or opening at which links break. (only with a cohesion) Default: 0.1. Greater
    than 0.
    """


@dataclass(kw_only=True, eq=False)
class Damping(Part):
    """Rayleigh damping: its two frequencies."""

    f1: float | None = None
    """Lower frequency at which the damping is that of the material. [Hz] (required where a material has a damping_ratio) Greater
    than 0.
    """
    f2: float | None = None
    """Higher frequency at which the damping is that of the material. [Hz] (required where a material has a damping_ratio) Greater
    than 0.
    """


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
class Boundary(Part):
    """How the sides are held; all others are free."""

    side: Literal["left", "right", "bottom", "top", "front", "back", "all"]
    """Particles without a neighbour in this direction: left and right are x, front and back y in 3-D, bottom and top the
    vertical; all takes every particle.
    """
    kind: Literal["fixed", "roller", "prescribed", "viscous"]
    """fixed does not move, roller is held across the side, prescribed moves as given (E + F), viscous lets waves leave and a wave
    E enter.
    """
    axes: list[Literal["x", "y", "z"]] | None = None
    """Axes along which a roller is held. (kind roller only; none: across the side) Default: []."""
    motion_x: str | None = None
    """Motion along x. (kinds prescribed and viscous only)"""
    motion_y: str | None = None
    """Motion along y. (kinds prescribed and viscous only)"""
    motion_z: str | None = None
    """Motion along z. (kinds prescribed and viscous only)"""


@dataclass(kw_only=True, eq=False)
class Contact(Part):
    """Contacts of particles whose links broke."""

    damping_ratio: float | None = None
    """Dashpots of contacts between particles whose links broke, over critical ones. Default: 0.2. At least 0 and at most 2."""


@dataclass(kw_only=True, eq=False)
class Gravity(Part):
    """Body force."""

    acceleration: tuple[float, float, float] | None = None
    """Acceleration of free fall. [m/s2] Default: [0.0, 0.0, 0.0]."""
    settle: bool | None = None
    """Begin at rest under gravity: the equilibrium is found first, viscous boundaries carry what they carry in it, and
    displacements count from there. Default: false.
    """
    max_settling_steps: int | None = None
    """After so many steps without rest the ground is said not to stand. Default: 200000. At least 1 and at most 1e+09."""


@dataclass(kw_only=True, eq=False)
class Noise(Part):
    """Small random motion at the start, so that whatever can grow does."""

    velocity: float | None = None
    """Largest random velocity of every degree of freedom at the start (of rotations: over half a spacing). [m/s] Default: 0.0. At
    least 0.
    """
    seed: int | None = None
    """Which random numbers are taken. Default: 1. At least 1 and at most 1e+06."""


@dataclass(kw_only=True, eq=False)
class Gauge(Part):
    """Points whose motion is recorded."""

    name: str
    """Name of the gauge; its columns in gauges.csv begin with it."""
    point: tuple[float, float, float]
    """Where it is at the start: it takes the motion of the nearest particle, at most a spacing away. [m]"""


@dataclass(kw_only=True, eq=False)
class Time(Part):
    """How long, in which steps, and when results are written."""

    end: float
    """Time at which the run ends; it begins at 0. [s] Greater than 0."""
    step: float | None = None
    """Step of all particles; above the predicted limit the case is refused. [s] (default: stability_fraction of the predicted
    limit, or a little less) Greater than 0.
    """
    stability_fraction: float | None = None
    """Step over the predicted limit where no step is given. Default: 0.9. Greater than 0 and less than 1."""
    integrator: Literal["verlet", "leapfrog", "euler"] | None = None
    """How a step goes. Default: "verlet"."""
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
    """A case of method mps."""

    method: ClassVar[str] = "mps"
    tables: ClassVar[dict[str, type[Part]]] = {
        "particles": Particles,
        "regions": Region,
        "materials": Material,
        "damping": Damping,
        "motions": Motion,
        "boundaries": Boundary,
        "contact": Contact,
        "gravity": Gravity,
        "noise": Noise,
        "gauges": Gauge,
        "time": Time,
        "output": Output,
    }

    particles: Particles
    """The lattice on which particles stand."""
    regions: list[Region]
    """What is filled with particles."""
    materials: list[Material]
    """What the regions are made of."""
    damping: Damping | None = None
    """Rayleigh damping: its two frequencies."""
    motions: list[Motion] = field(default_factory=list)
    """Waves and histories of the ground's motion."""
    boundaries: list[Boundary] = field(default_factory=list)
    """How the sides are held; all others are free."""
    contact: Contact | None = None
    """Contacts of particles whose links broke."""
    gravity: Gravity | None = None
    """Body force."""
    noise: Noise | None = None
    """Small random motion at the start, so that whatever can grow does."""
    gauges: list[Gauge] = field(default_factory=list)
    """Points whose motion is recorded."""
    time: Time
    """How long, in which steps, and when results are written."""
    output: Output | None = None
    """What is written besides histories and snapshots."""
