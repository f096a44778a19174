"""Cases of method blocks, written by tools/write_case_classes.py from `sazare schema`."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from sazare.cases import Case as AnyCase
from sazare.cases import Part


@dataclass(kw_only=True, eq=False)
class Mesh(Part):
    """The body: tetrahedra with named volumes and surfaces."""

    file: str
    """Gmsh mesh (.msh, format 4.1) or geometry (.geo, meshed by gmsh when the case is run), relative to the case file."""
    scale: float | None = None
    """Factor on all coordinates, such as 0.001 for a mesh in millimetres. Default: 1.0. Greater than 0."""
    size_factor: float | None = None
    """Factor on all element sizes (gmsh -clscale). (only for a .geo file) Default: 1.0. Greater than 0."""
    parameters: dict[str, float] | None = None
    """Values for constants that the geometry declares with DefineConstant (gmsh -setnumber). (only for a .geo file) Default: {}.
    """


@dataclass(kw_only=True, eq=False)
class Material(Part):
    """What the named volumes are made of."""

    name: str
    """Name by which joints refer to the material."""
    regions: list[str]
    """Physical volume groups of the mesh that are made of it."""
    density: float
    """Mass per volume. [kg/m3] Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Joint(Part):
    """How faces hold together; where several entries match a face, the last one wins."""

    name: str
    """Name of the joint in results and messages."""
    between: tuple[str, str] | None = None
    """The two materials (the same one twice for faces inside a material) whose shared faces it joins. (exactly one of between and
    surface)
    """
    surface: str | None = None
    """Physical surface group inside the body whose faces it joins, such as a fault. (exactly one of between and surface)"""
    bonded: bool | None = None
    """False for faces that never were bonded, such as an existing crack or a slit. Default: true."""
    normal_stiffness: float | None = None
    """Normal stress per opening. [Pa/m] (required when bonded) Greater than 0."""
    shear_stiffness: float | None = None
    """Shear stress per elastic slip. [Pa/m] (required when bonded) At least 0."""
    normal_damping: float | None = None
    """Normal stress per opening velocity (dashpot). [Pa s/m] Default: 0.0. At least 0."""
    shear_damping: float | None = None
    """Shear stress per slip velocity (dashpot). [Pa s/m] Default: 0.0. At least 0."""
    cohesion: float | None = None
    """Shear strength without normal stress. [Pa] (required when bonded) At least 0."""
    friction_coefficient: float | None = None
    """Shear strength per compressive stress. (when bonded, exactly one of friction_coefficient and friction_angle) At least 0."""
    friction_angle: float | None = None
    """Angle whose tangent is the friction coefficient. [deg] (when bonded, exactly one of friction_coefficient and
    friction_angle) At least 0 and less than 90.
    """
    tensile_strength: float | None = None
    """Normal stress at which softening begins; at most sqrt(2 fracture_energy normal_stiffness). [Pa] (required when bonded)
    Greater than 0.
    """
    fracture_energy: float | None = None
    """Energy per area that opening the joint in tension takes. [N/m] (required when bonded) Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Contact(Part):
    """What acts between faces after failure and between free faces."""

    normal_stiffness: float
    """Force per overlap of a pair of contact spheres. [N/m] Greater than 0."""
    normal_damping: float | None = None
    """Force per approach velocity of a pair (dashpot); never attracts. [N s/m] Default: 0.0. At least 0."""
    friction_coefficient: float | None = None
    """Largest tangential force per normal force. (exactly one of friction_coefficient and friction_angle) At least 0."""
    friction_angle: float | None = None
    """Angle whose tangent is the friction coefficient. [deg] (exactly one of friction_coefficient and friction_angle) At least 0
    and less than 90.
    """
    damping_cap: Literal["literal", "critical", "step"] | None = None
    """How a dashpot too stiff for the masses acts: literal as given, at most critical, or built up over the steps as fast as they
    bear. Default: "step".
    """
    edge_division: int | None = None
    """Contact spheres sit at the interior points when each edge of a face is divided into this many equal parts. Default: 5. At
    least 3 and at most 20.
    """


@dataclass(kw_only=True, eq=False)
class Blast(Part):
    """Pressure on the walls of holes: a pulse, a table from a CSV file, or a function given in Python."""

    name: str | None = None
    """Name of the hole in results and messages. (default: the surface's name)"""
    surface: str
    """Physical surface group of the hole's wall."""
    delay: float | None = None
    """Time at which the pressure begins. [s] Default: 0.0. At least 0."""
    peak_pressure: float | None = None
    """Largest pressure P0 of the pulse. [Pa] (required without table and function) Greater than 0."""
    rise_time: float | None = None
    """Time a from zero to the largest pressure. [s] (required without table and function) Greater than 0."""
    decay_ratio: float | None = None
    """Time b from the largest pressure to zero, over the rise time. (required without table and function) Greater than 0."""
    table: str | None = None
    """CSV file with header "time [s],pressure [Pa]" and times that increase; linear between rows. (instead of peak_pressure,
    rise_time and decay_ratio)
    """
    function: bool | None = None
    """The pressure is a function of the time since the delay that the caller gives in Python. (instead of peak_pressure,
    rise_time and decay_ratio) Default: false.
    """
    cut_distance: float | None = None
    """The pressure on a face ends for good once the face has moved this far; inf: never. [m] Default: inf. Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Gravity(Part):
    """Body force."""

    acceleration: tuple[float, float, float] | None = None
    """Acceleration of free fall. [m/s2] Default: [0.0, 0.0, 0.0]."""


@dataclass(kw_only=True, eq=False)
class Boundary(Part):
    """How outer faces are held; all others are free."""

    surface: str
    """Physical surface group on the outside of the body."""
    kind: Literal["fixed", "frictionless", "absorbing"]
    """fixed stands on ground like it, with its own springs and dashpots, frictionless slides along the plane of each face,
    absorbing lets waves leave (dashpots).
    """


@dataclass(kw_only=True, eq=False)
class Constraint(Part):
    """Axes along or about which whole volumes cannot move."""

    regions: list[str]
    """Physical volume groups whose elements are held."""
    translation: list[Literal["x", "y", "z"]] | None = None
    """Axes along which the elements cannot move. Default: []."""
    rotation: list[Literal["x", "y", "z"]] | None = None
    """Axes about which the elements cannot turn. Default: []."""


@dataclass(kw_only=True, eq=False)
class InitialVelocity(Part):
    """Volumes that move at the start."""

    regions: list[str]
    """Physical volume groups that move at the start."""
    velocity: tuple[float, float, float]
    """Their velocity at the start. [m/s]"""


@dataclass(kw_only=True, eq=False)
class Gauge(Part):
    """Points whose velocity is recorded."""

    name: str
    """Name of the gauge; its columns in gauges.csv begin with it."""
    point: tuple[float, float, float]
    """Where it is fixed to the body at the start: a point inside an element. [m]"""


@dataclass(kw_only=True, eq=False)
class Time(Part):
    """How long, in which steps, and when results are written."""

    end: float
    """Time at which the run ends; it begins at 0. [s] Greater than 0."""
    levels: Literal["per_element", "uniform"] | None = None
    """Whether every element has its own time level, or all take the finest that any asks for. Default: "per_element"."""
    limiter: Literal["stability", "travel", "none"] | None = None
    """What sets the step of an element: its own stable step, the distance it travels in a step, or nothing (base_step for all).
    Default: "stability".
    """
    base_step: float | None = None
    """The largest step; level k steps base_step / 2^k. [s] (default: chosen from the stable steps; required for limiter travel
    and none) Greater than 0.
    """
    stability_fraction: float | None = None
    """Step of an element over the limit of its own springs and dashpots with its neighbours held; 0.5 allows for neighbours that
    move as well. Default: 0.5. Greater than 0 and at most 1.
    """
    travel_length: float | None = None
    """Largest distance an element travels in a step (limiter travel). [m] Default: 10e-9. Greater than 0."""
    neighbor_levels: int | None = None
    """Largest difference of level between elements that are linked. Default: 2. At least 0 and at most 20."""
    history_interval: float | None = None
    """Time between rows of the histories; the end is a whole multiple of it. [s] (default: about end/200) Greater than 0."""
    snapshot_interval: float | None = None
    """Time between snapshots; a whole multiple of history_interval, and the end one of it. [s] (default: about end/20) Greater
    than 0.
    """
    strict: bool | None = None
    """Refuse what would only be warned about, such as a step above the stable one. Default: false."""


@dataclass(kw_only=True, eq=False)
class Output(Part):
    """What is written besides histories and snapshots."""

    checkpoint_interval: float | None = None
    """Wall-clock time between checkpoints. [s] Default: 60.0. Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Case(AnyCase):
    """A case of method blocks."""

    method: ClassVar[str] = "blocks"
    tables: ClassVar[dict[str, type[Part]]] = {
        "mesh": Mesh,
        "materials": Material,
        "joints": Joint,
        "contact": Contact,
        "blasts": Blast,
        "gravity": Gravity,
        "boundaries": Boundary,
        "constraints": Constraint,
        "initial_velocities": InitialVelocity,
        "gauges": Gauge,
        "time": Time,
        "output": Output,
    }

    mesh: Mesh
    """The body: tetrahedra with named volumes and surfaces."""
    materials: list[Material]
    """What the named volumes are made of."""
    joints: list[Joint]
    """How faces hold together; where several entries match a face, the last one wins."""
    contact: Contact
    """What acts between faces after failure and between free faces."""
    blasts: list[Blast] = field(default_factory=list)
    """Pressure on the walls of holes: a pulse, a table from a CSV file, or a function given in Python."""
    gravity: Gravity | None = None
    """Body force."""
    boundaries: list[Boundary] = field(default_factory=list)
    """How outer faces are held; all others are free."""
    constraints: list[Constraint] = field(default_factory=list)
    """Axes along or about which whole volumes cannot move."""
    initial_velocities: list[InitialVelocity] = field(default_factory=list)
    """Volumes that move at the start."""
    gauges: list[Gauge] = field(default_factory=list)
    """Points whose velocity is recorded."""
    time: Time
    """How long, in which steps, and when results are written."""
    output: Output | None = None
    """What is written besides histories and snapshots."""
