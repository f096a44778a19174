"""Cases of method spheres, written by tools/write_case_classes.py from `sazare schema`."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from sazare.cases import Case as AnyCase
from sazare.cases import Part


@dataclass(kw_only=True, eq=False)
class Domain(Part):
    """The periodic domain."""

    periodic: list[Literal["x", "y", "z"]] | None = None
    """Axes along which the domain is periodic: what leaves at one end comes in at the other. Default: []."""
    lower: tuple[float, float, float] | None = None
    """Lower ends of the periodic axes; the other axes do not count. [m] (required where an axis is periodic)"""
    upper: tuple[float, float, float] | None = None
    """Upper ends of the periodic axes; the other axes do not count. [m] (required where an axis is periodic)"""


@dataclass(kw_only=True, eq=False)
class Material(Part):
    """What spheres and walls are made of."""

    name: str
    """Name by which spheres, walls and pairs refer to it."""
    density: float
    """Mass per volume. [kg/m3] Greater than 0."""
    youngs_modulus: float | None = None
    """Young's modulus. [Pa] (required for models hertz, jkr and mindlin_deresiewicz) Greater than 0."""
    poisson_ratio: float | None = None
    """Poisson's ratio. (required for models hertz, jkr and mindlin_deresiewicz) At least 0 and at most 0.5."""


@dataclass(kw_only=True, eq=False)
class Contact(Part):
    """The contact law of spheres and walls."""

    model: Literal["hertz", "linear", "jkr", "mindlin_deresiewicz"] | None = None
    """Hertz-Mindlin from the elasticity of the materials, linear springs, the adhesion of Johnson, Kendall and Roberts between
    elastic spheres, or Hertz contacts with partial slip, after Mindlin and Deresiewicz: for oblique impacts below some 30
    degrees to the normal and small cycles of shear, at a higher cost. Default: "hertz".
    """
    restitution: float
    """Coefficient of restitution: relative velocity after a central impact with one contact over that before. A rigid body that
    lands on several of its spheres at once loses more, and fast impacts lose less where the step is too long for them: a
    warning then says up to which speed the step is right. Greater than 0 and at most 1.
    """
    friction_coefficient: float | None = None
    """Coefficient of friction; 0.0 for contacts without friction. (exactly one of friction_coefficient and friction_angle) At
    least 0.
    """
    friction_angle: float | None = None
    """Angle whose tangent is the coefficient of friction. [deg] (exactly one of friction_coefficient and friction_angle) At least
    0 and less than 90.
    """
    rolling_friction: float | None = None
    """Coefficient of rolling friction: largest moment against rolling over normal force and reduced radius. Default: 0.0. At
    least 0.
    """
    twisting_friction: float | None = None
    """Coefficient of twisting friction: largest moment about the normal over normal force and reduced radius. Default: 0.0. At
    least 0.
    """
    contact_stiffness: float | None = None
    """Normal stiffness: normal force per overlap. [N/m] (required for model linear, here or in every pair) Greater than 0."""
    contact_shear_stiffness: float | None = None
    """Shear stiffness: tangential force per tangential displacement. [N/m] (required for model linear, here or in every pair)
    Greater than 0.
    """
    surface_energy: float | None = None
    """Work of adhesion w: energy per area that separates the two surfaces; for one material, twice the surface energy of a free
    surface. [J/m2] (required for model jkr, here or in every pair) At least 0.
    """
    overlap_limit: float | None = None
    """Largest overlap at the start over the smaller radius; more is refused. Default: 0.05. At least 0 and at most 1."""
    margin: float | None = None
    """Spheres nearer than this, over the smallest diameter, are kept as candidate pairs; it changes the computing time only, and
    with levels also the error of the step. Default: 0.1. Greater than 0 and at most 10.
    """


@dataclass(kw_only=True, eq=False)
class Pair(Part):
    """Contact properties of two given materials, where they differ from [contact]."""

    between: tuple[str, str]
    """The two materials; the same twice for spheres of one."""
    restitution: float | None = None
    """As in [contact]. (default: that of [contact]) Greater than 0 and at most 1."""
    friction_coefficient: float | None = None
    """As in [contact]. (default: that of [contact]) At least 0."""
    rolling_friction: float | None = None
    """As in [contact]. (default: that of [contact]) At least 0."""
    twisting_friction: float | None = None
    """As in [contact]. (default: that of [contact]) At least 0."""
    contact_stiffness: float | None = None
    """As in [contact]. [N/m] (default: that of [contact]) Greater than 0."""
    contact_shear_stiffness: float | None = None
    """As in [contact]. [N/m] (default: that of [contact]) Greater than 0."""
    surface_energy: float | None = None
    """As in [contact]. [J/m2] (default: that of [contact]) At least 0."""


@dataclass(kw_only=True, eq=False)
class Shape(Part):
    """Bodies made of spheres, rigid or bonded."""

    name: str
    """Name by which [[spheres]] refer to it."""
    source: Literal["tetrapod", "file", "mesh"] | None = None
    """Where its spheres come from: a tetrapod, a file of spheres, or what fits into a closed surface. Default: "tetrapod"."""
    height: float | None = None
    """From the ground to the end of the upper leg. [m] (required for a tetrapod) Greater than 0."""
    leg_spheres: int | None = None
    """Spheres along each leg of a tetrapod, besides the one in its centre. Default: 4. At least 1 and at most 100."""
    file: str | None = None
    """Rows of radius, x, y, z, of spheres that hang together; or the triangles of an .stl or a .msh without holes, all with the
    same side out: the body has the mass and inertia of the solid within them. (required for a file and for a mesh)
    """
    scale: float | None = None
    """Length of the file's unit in m. Default: 1.0. Greater than 0."""
    count: int | None = None
    """Spheres that fill a mesh, at most. Default: 40. At least 1 and at most 10000."""
    bonds: str | None = None
    """Name of the [[bonds]] that join neighbouring spheres of a body, so that it bends and breaks. (none: rigid)"""


@dataclass(kw_only=True, eq=False)
class Sphere(Part):
    """Groups of spheres."""

    name: str
    """Name of the group, for gauges and messages."""
    material: str
    """What it is made of."""
    source: Literal["one", "file", "lattice", "random", "bodies"] | None = None
    """One sphere, a file of them, a cubic lattice in a box, random places in a box without overlap, or rigid bodies, each with
    its own spheres, from two files. Default: "one".
    """
    centre: tuple[float, float, float] | None = None
    """Where the sphere is at the start. [m] (required for one)"""
    radius: float | None = None
    """Radius; of random spheres the smallest, where largest_radius is given. [m] (required except for a file, bodies or a shape)
    Greater than 0.
    """
    largest_radius: float | None = None
    """Largest radius: radii are distributed uniformly between the two, and the largest spheres are placed first. [m] (random
    only; default: radius) Greater than 0.
    """
    file: str | None = None
    """Rows of radius, x, y, z in m, with blanks, commas or semicolons between them; titles in the first line must be those of the
    columns, and lines that begin with # are skipped. Of a shape: rows of x, y, z in m and its rotation vector rx, ry, rz in
    rad. Of bodies: rows of the number of a body, and radius, x, y, z of one of its spheres. (required for a file and for
    bodies)
    """
    bodies_file: str | None = None
    """Rows of body, volume, x, y, z, vx, vy, vz, wx, wy, wz, ixx, iyy, izz, ixy, iyz, izx: its number, volume in m3, centre of
    mass in m, velocity in m/s, angular velocity in rad/s, and the matrix of its inertia about that centre over its density in
    m5. (required for bodies)
    """
    lower: tuple[float, float, float] | None = None
    """Corner of the box with the smallest coordinates. [m] (required for lattice and random)"""
    upper: tuple[float, float, float] | None = None
    """Corner of the box with the largest coordinates. [m] (required for lattice and random)"""
    spacing: float | None = None
    """Distance of neighbours on the lattice; as many as fit stand in the middle of the box. [m] (lattice only; default: the
    diameter) Greater than 0.
    """
    count: int | None = None
    """Number of spheres. (required for random) At least 1 and at most 5e+07."""
    seed: int | None = None
    """Seed of the random numbers. Default: 1. At least 1 and at most 1e+06."""
    velocity: tuple[float, float, float] | None = None
    """At the start. [m/s] Default: [0.0, 0.0, 0.0]."""
    angular_velocity: tuple[float, float, float] | None = None
    """Angular velocity at the start. [rad/s] Default: [0.0, 0.0, 0.0]."""
    noise: float | None = None
    """Largest random velocity along each axis, beside the velocity. [m/s] Default: 0.0. At least 0."""
    held: bool | None = None
    """Whether the spheres keep their initial velocity and angular velocity, whatever forces act on them. Default: false."""
    lowered: bool | None = None
    """Whether each sphere or body in turn is lowered along gravity until it touches a plane or what was placed before, as units
    are placed on a quay; how high its place is does not count. Default: false.
    """
    rain: bool | None = None
    """Whether the group falls under gravity and comes to rest before the run begins; all others, and the walls, stand still
    meanwhile. Default: false.
    """
    drag_coefficient: float | None = None
    """Drag coefficient of the group's bodies. (with [water], whose own is the default) At least 0 and at most 100."""
    inertia_coefficient: float | None = None
    """Inertia coefficient C_M of the group's bodies. (with [water], whose own is the default) At least 1."""
    shape: str | None = None
    """Shape of [[shapes]]: the group is of rigid or bonded bodies, places are those of their centres of mass. (none: single
    spheres)
    """
    rotation: tuple[float, float, float] | None = None
    """Rotation vector of a shape at the start. [rad] Default: [0.0, 0.0, 0.0]."""
    random_rotation: bool | None = None
    """Whether every body of a shape has a random orientation instead. Default: false."""


@dataclass(kw_only=True, eq=False)
class Bond(Part):
    """Which spheres are bonded, and how strongly."""

    name: str
    """Name for messages."""
    between: tuple[str, str] | None = None
    """The two groups; the same twice for bonds within one, of groups of bonded bodies from body to body. Where several entries
    match a pair the last one wins. (required unless a shape names the bonds)
    """
    reach: float | None = None
    """Spheres are bonded whose gap at the start is at most this, over the sum of their radii. Default: 0.01. At least 0."""
    radius_ratio: float | None = None
    """Radius of the bond over that of the smaller sphere. Default: 1.0. Greater than 0."""
    youngs_modulus: float | None = None
    """Young's modulus: the bond is a round beam from centre to centre. [Pa] (or bond_normal_stiffness) Greater than 0."""
    poisson_ratio: float | None = None
    """Poisson's ratio. (required with youngs_modulus) At least 0 and at most 0.5."""
    bond_normal_stiffness: float | None = None
    """Normal stiffness of a cemented contact: normal stress per opening; it resists bending as well. [Pa/m] (or youngs_modulus)
    Greater than 0.
    """
    bond_shear_stiffness: float | None = None
    """Shear stiffness of a cemented contact: shear stress per slip; it resists torsion as well. [Pa/m] (required with
    bond_normal_stiffness) Greater than 0.
    """
    damping_ratio: float | None = None
    """Damping ratio of two spheres that a bond joins, without others. Default: 0.0. At least 0."""
    tensile_strength: float | None = None
    """Tensile strength: tensile stress at the rim, bending included, at which the bond begins to fail. [Pa] (none: not limited)
    Greater than 0.
    """
    cohesion: float | None = None
    """Cohesion: shear stress at the rim, torsion included, at which the bond begins to fail without pressure. [Pa] (none: not
    limited) Greater than 0.
    """
    friction_angle: float | None = None
    """Friction angle: its tangent times the pressure is added to the cohesion. [deg] Default: 0.0. At least 0 and less than 90.
    """
    fracture_energy: float | None = None
    """Fracture energy: energy per area that softening dissipates in tension. [N/m] (none: brittle) Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Wall(Part):
    """Planes and surfaces that spheres cannot pass. Those of one material and one motion are one surface."""

    name: str
    """Name of the wall; its columns in walls.csv begin with it."""
    material: str
    """What it is made of."""
    shape: Literal["plane", "box", "mesh"] | None = None
    """A plane with spheres on one side, the six planes of a box with spheres inside, or the triangles of a file. Default:
    "plane".
    """
    point: tuple[float, float, float] | None = None
    """Any point of the plane. [m] (required for a plane)"""
    normal: tuple[float, float, float] | None = None
    """Normal of the plane, towards the spheres; of any length. (required for a plane)"""
    lower: tuple[float, float, float] | None = None
    """Corner with the smallest coordinates. [m] (required for a box)"""
    upper: tuple[float, float, float] | None = None
    """Corner with the largest coordinates. [m] (required for a box)"""
    file: str | None = None
    """Triangles: .stl (text or binary) or a Gmsh .msh (format 4.1). (required for a mesh)"""
    group: str | None = None
    """Physical surface group that is the wall. (mesh of a .msh; default: all)"""
    scale: float | None = None
    """Length of the file's unit in m. Default: 1.0. Greater than 0."""
    motion_x: str | None = None
    """Motion along x. (none: at rest)"""
    motion_y: str | None = None
    """Motion along y. (none: at rest)"""
    motion_z: str | None = None
    """Motion along z. (none: at rest)"""
    angular_velocity: tuple[float, float, float] | None = None
    """Constant angular velocity about the pivot. [rad/s] Default: [0.0, 0.0, 0.0]."""
    pivot: tuple[float, float, float] | None = None
    """A point of the axis of rotation, at the start. [m] Default: [0.0, 0.0, 0.0]."""


@dataclass(kw_only=True, eq=False)
class Motion(Part):
    """Histories of the walls' motion."""

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
class Gravity(Part):
    """Body force."""

    acceleration: tuple[float, float, float] | None = None
    """Gravitational acceleration. [m/s2] Default: [0.0, 0.0, 0.0]."""


@dataclass(kw_only=True, eq=False)
class Water(Part):
    """Water around bodies: buoyancy, drag and inertia."""

    level: float
    """Elevation of the still water's surface: along z where gravity acts along -z, in general against gravity. [m]"""
    density: float | None = None
    """Mass per volume of the water; sea water 1025. [kg/m3] Default: 1000.0. At least 0.001 and at most 100000."""
    viscosity: float | None = None
    """Dynamic viscosity, which decides the drag of small or slow spheres without a drag_coefficient. [Pa s] Default: 1e-3.
    Greater than 0.
    """
    drag_coefficient: float | None = None
    """Drag coefficient of bodies; their area is that of a sphere of their volume. A group may have its own. (default: that of a
    smooth sphere by its Reynolds number) At least 0 and at most 100.
    """
    inertia_coefficient: float | None = None
    """Inertia coefficient C_M of Morison's equation: 1 and the coefficient of added mass, which is 0.5 for a sphere. A group may
    have its own. Default: 1.5. At least 1.
    """
    current: tuple[float, float, float] | None = None
    """Horizontal velocity of all the water, to which that of waves is added. [m/s] Default: [0.0, 0.0, 0.0]."""
    waves: Literal["none", "airy", "stokes2", "solitary", "table"] | None = None
    """Still water, linear (Airy) waves, Stokes waves of second order, a solitary wave, or a table of surface elevation and
    velocity over time. Default: "none".
    """
    bed: float | None = None
    """Elevation of the level bed over which waves travel, below the water. [m] (required for waves by a theory)"""
    wave_height: float | None = None
    """Height of the waves from trough to crest. [m] (required for waves by a theory) Greater than 0."""
    wave_period: float | None = None
    """Wave period; the wave length follows from the dispersion relation. [s] (required for airy and stokes2) At least 0.001 and
    at most 100000.
    """
    wave_direction: float | None = None
    """Direction in which waves travel, or the velocity of a table goes, from the x axis counter-clockwise as seen from above:
    with gravity along -z, from x towards y. [deg] (with waves) Default: 0.0. At least -360 and at most 360.
    """
    wave_crest: float | None = None
    """Where a crest stands at t = 0, along the direction of the waves from the origin. [m] (waves by a theory) Default: 0.0."""
    wave_ramp: float | None = None
    """Time in which waves grow from still water to their height. [s] (airy and stokes2) Default: 0.0. At least 0."""
    wave_file: str | None = None
    """CSV with the header "time [s],elevation [m],velocity [m/s]": elevation of the surface above level, and velocity along
    wave_direction, both the same everywhere; linear between rows, constant before and after. (required for a table)
    """


@dataclass(kw_only=True, eq=False)
class Gauge(Part):
    """Groups whose motion is recorded."""

    name: str
    """Name of the gauge; its columns in gauges.csv begin with it."""
    group: str
    """Group of spheres whose centre of mass is recorded."""


@dataclass(kw_only=True, eq=False)
class Time(Part):
    """How long, in which steps, and when results are written."""

    end: float
    """Time at which the run ends; it begins at 0. [s] Greater than 0."""
    step: float | None = None
    """Time step of all spheres; above the stability limit the case is refused. [s] (default: stability_fraction of the limit, or
    a little less) Greater than 0.
    """
    levels: Literal["automatic", "per_sphere", "uniform"] | None = None
    """Whether every sphere, or every clump, has its own time level, or all take the smallest stable step of any. Automatic takes
    levels where spheres then need less than half of the steps, no step is given, and nothing is coupled. Default: "automatic".
    """
    stability_fraction: float | None = None
    """Ratio of the step to the stability limit where no step is given: the Rayleigh time step of the smallest sphere, or with
    linear springs 2/frequency of a contact, or the limit of the bonds; with levels each sphere's own. Default: 0.2. Greater
    than 0 and less than 1.
    """
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
    """A case of method spheres."""

    method: ClassVar[str] = "spheres"
    tables: ClassVar[dict[str, type[Part]]] = {
        "domain": Domain,
        "materials": Material,
        "contact": Contact,
        "pairs": Pair,
        "shapes": Shape,
        "spheres": Sphere,
        "bonds": Bond,
        "walls": Wall,
        "motions": Motion,
        "gravity": Gravity,
        "water": Water,
        "gauges": Gauge,
        "time": Time,
        "output": Output,
    }

    domain: Domain | None = None
    """The periodic domain."""
    materials: list[Material]
    """What spheres and walls are made of."""
    contact: Contact
    """The contact law of spheres and walls."""
    pairs: list[Pair] = field(default_factory=list)
    """Contact properties of two given materials, where they differ from [contact]."""
    shapes: list[Shape] = field(default_factory=list)
    """Bodies made of spheres, rigid or bonded."""
    spheres: list[Sphere]
    """Groups of spheres."""
    bonds: list[Bond] = field(default_factory=list)
    """Which spheres are bonded, and how strongly."""
    walls: list[Wall] = field(default_factory=list)
    """Planes and surfaces that spheres cannot pass. Those of one material and one motion are one surface."""
    motions: list[Motion] = field(default_factory=list)
    """Histories of the walls' motion."""
    gravity: Gravity | None = None
    """Body force."""
    water: Water | None = None
    """Water around bodies: buoyancy, drag and inertia."""
    gauges: list[Gauge] = field(default_factory=list)
    """Groups whose motion is recorded."""
    time: Time
    """How long, in which steps, and when results are written."""
    output: Output | None = None
    """What is written besides histories and snapshots."""
