"""Cases of method fem, written by tools/write_case_classes.py from `sazare schema`."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from sazare.cases import Case as AnyCase
from sazare.cases import Part


@dataclass(kw_only=True, eq=False)
class Mesh(Part):
    """The body."""

    file: str
    """Gmsh mesh (.msh, format 4.1) or geometry (.geo, meshed by gmsh when the case is run), relative to the case file."""
    scale: float | None = None
    """Factor on all coordinates, such as 0.001 for a mesh in millimetres. Default: 1.0. Greater than 0."""
    size_factor: float | None = None
    """Factor on all element sizes (gmsh -clscale). (only for a .geo file) Default: 1.0. Greater than 0."""
    parameters: dict[str, float] | None = None
    """Values for constants that the geometry declares with DefineConstant (gmsh -setnumber). (only for a .geo file) Default: {}.
    """
    dimension: int | None = None
    """2 for plane strain in x and y (up), with forces per metre out of plane; 3 for a body in x, y and z (up). Default: 2. At
    least 2 and at most 3.
    """


@dataclass(kw_only=True, eq=False)
class Elements(Part):
    """Mass matrix and numerical integration."""

    mass: Literal["consistent", "lumped"] | None = None
    """Mass matrix: consistent, or lumped at the nodes. Default: "consistent"."""
    integration: Literal["full", "reduced"] | None = None
    """Integration of the stiffness: full, or reduced, with fewer points in 8-node quadrilaterals and 20-node hexahedra, which
    avoids locking in bending and plastic flow. Default: "full".
    """


@dataclass(kw_only=True, eq=False)
class Material(Part):
    """Materials of the regions."""

    name: str
    """Name of the material in messages."""
    regions: list[str]
    """Physical groups of the mesh that consist of the material: surfaces in 2-D, volumes in 3-D."""
    density: float
    """Mass per volume. [kg/m3] Greater than 0."""
    youngs_modulus: float
    """Young's modulus. [Pa] Greater than 0."""
    poisson_ratio: float
    """Poisson's ratio. At least 0 and less than 0.5."""
    damping_ratio: float | None = None
    """Damping ratio at the frequencies f1 and f2 of [damping]. Default: 0.0. At least 0 and at most 2."""
    water_table: float | None = None
    """Elevation of the water table, y in 2-D and z in 3-D: below it the ground has saturated_density and a hydrostatic pore
    pressure, and its strength and stiffness are those of the effective stress. [m] (default: no water in the pores)
    """
    saturated_density: float | None = None
    """Density of the ground below the water table, with the water in its pores. [kg/m3] (required with a water_table) Greater
    than 0.
    """
    pore_water_density: float | None = None
    """Density of the water in the pores. [kg/m3] (only with a water_table) Default: 1000.0. Greater than 0."""
    drainage: Literal["drained", "undrained", "flow"] | None = None
    """drained: the pore pressure stays hydrostatic; undrained: the water moves with the ground, and its pressure follows the
    volume; flow: it also flows through the pores (consolidation), with Darcy's law. (only with a water_table) Default:
    "drained".
    """
    porosity: float | None = None
    """Volume of the pores per volume of the ground. (required for drainage undrained and flow) Greater than 0 and less than 1."""
    water_bulk_modulus: float | None = None
    """Bulk modulus of the water in the pores; a little air lowers it much. [Pa] (drainage undrained and flow) Default: 2.2e9.
    Greater than 0.
    """
    hydraulic_conductivity: float | None = None
    """Coefficient of permeability k of Darcy's law, the velocity of flow under a gradient of 1: gravel some 1e-2, sand 1e-4, silt
    1e-6, clay below 1e-8 m/s. [m/s] (required for drainage flow) Greater than 0.
    """
    cohesion: float | None = None
    """Cohesion of the Mohr-Coulomb strength. [Pa] (default: the material is elastic and never yields) At least 0."""
    friction_angle: float | None = None
    """Friction angle. [deg] (required with a cohesion) At least 0 and at most 60."""
    dilation_angle: float | None = None
    """Dilation angle; at most the friction angle. [deg] (only with a cohesion) Default: 0.0. At least 0 and at most 60."""
    tensile_strength: float | None = None
    """Tension cut-off: largest tensile stress; at most cohesion/tan(friction_angle). [Pa] (only with a cohesion; default:
    cohesion/tan(friction_angle), without friction none) At least 0.
    """
    blow_count: float | None = None
    """Sand that contracts under cycles of shear (Byrne 1991), by the blow count (N1)60 of the standard penetration test:
    contraction_rate = 8.7 (N1)60^-1.25. (with a cohesion; not with contraction_rate; default: cycles of shear take no volume)
    Greater than 0 and at most 100.
    """
    contraction_rate: float | None = None
    """C1 of the contraction C1 g/2 exp(-C2 e/g) in a half cycle of shear strain g after a contraction e; C2 is 0.4/C1. (with a
    cohesion; not with blow_count) Greater than 0 and at most 10.
    """
    contraction_threshold: float | None = None
    """Amplitude of shear strain up to which a half cycle takes no volume. (only with blow_count or contraction_rate) Default:
    1e-4. At least 0 and at most 0.1.
    """
    backbone: Literal["hyperbolic", "ramberg_osgood", "table", "general_hyperbolic"] | None = None
    """Soil that degrades with shear strain and dissipates by Masing's rules: stress of a first loading in shear, a hyperbola, the
    curve of Ramberg and Osgood, a table of G/G0, or the general hyperbolic equation (GHE). G0 is the shear modulus of the
    elastic material. (default: the stiffness does not depend on the strain; not with a cohesion)
    """
    reference_strain: float | None = None
    """Shear strain at which G/G0 = 0.5. (hyperbolic and ramberg_osgood; default of hyperbolic: shear_strength/G0) Greater than 0
    and at most 1.
    """
    shear_strength: float | None = None
    """Shear strength, at which the backbone ends. [Pa] (with a backbone; required for ramberg_osgood and general_hyperbolic;
    default of hyperbolic: G0 reference_strain, of a table: the stress of its last row) Greater than 0.
    """
    ramberg_osgood_exponent: float | None = None
    """Exponent r of strain = stress/G0 (1 + (2 stress/(G0 reference_strain))^(r - 1)). (required for ramberg_osgood) Greater than
    1 and at most 20.
    """
    ghe_c1_end: float | None = None
    """C1 of the general hyperbolic equation at large strains; at none it is 1. (required for general_hyperbolic) Greater than 0.
    """
    ghe_c2_begin: float | None = None
    """C2 of the general hyperbolic equation at no strain. (required for general_hyperbolic) Greater than 0."""
    ghe_c2_end: float | None = None
    """C2 of the general hyperbolic equation at large strains. (required for general_hyperbolic) Greater than 0."""
    ghe_alpha: float | None = None
    """Strain over reference strain (shear_strength/G0) at which C1 is half way. (required for general_hyperbolic) Greater than 0.
    """
    ghe_beta: float | None = None
    """Strain over reference strain at which C2 is half way. (required for general_hyperbolic) Greater than 0."""
    modulus_reduction: str | None = None
    """CSV with the header "shear_strain [-],modulus_ratio [-]", strains in - or %: G/G0 falls from 1. A third column
    "damping_ratio [-]" (or %) is only compared with what Masing's rules give. (required for a table)
    """
    yield_surfaces: int | None = None
    """Number of elastic-perfectly plastic parts, which are the corners of the backbone; a table has one for each row. (not of a
    table) Default: 30. At least 3 and at most 200.
    """


@dataclass(kw_only=True, eq=False)
class Joint(Part):
    """Zero-thickness interfaces that slip and open."""

    name: str
    """Name of the joint in results and messages."""
    between: tuple[str, str] | None = None
    """The two regions between whose shared faces the joint lies. (exactly one of between and group)"""
    group: str | None = None
    """Physical group of faces inside the body (lines in 2-D) along which the joint lies. (exactly one of between and group)"""
    joint_normal_stiffness: float
    """Normal stiffness: pressure per overlap of the faces. [Pa/m] Greater than 0."""
    joint_shear_stiffness: float
    """Shear stiffness: shear stress per elastic shear displacement. [Pa/m] Greater than 0."""
    cohesion: float | None = None
    """Cohesion: shear strength at zero pressure, where the faces touch. [Pa] Default: 0.0. At least 0."""
    friction_angle: float
    """Friction angle between the faces. [deg] At least 0 and at most 89."""


@dataclass(kw_only=True, eq=False)
class Damping(Part):
    """Rayleigh damping: its two frequencies."""

    f1: float | None = None
    """Lower frequency at which the damping ratio equals that of the material. [Hz] (required where a material has a
    damping_ratio) Greater than 0.
    """
    f2: float | None = None
    """Higher frequency at which the damping ratio equals that of the material. [Hz] (required where a material has a
    damping_ratio) Greater than 0.
    """
    relative_to_base: bool | None = None
    """Mass-proportional damping acts on the velocity relative to the base along an axis along which all supports follow one
    prescribed motion; elsewhere, and with false, on the velocity in space. Default: true.
    """


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
class Boundary(Part):
    """Boundary conditions of groups; all other nodes are free."""

    group: str
    """Physical group of the mesh to whose nodes it applies: faces, lines or points."""
    kind: Literal["fixed", "roller", "prescribed", "viscous", "free_field"]
    """fixed: held along all axes; roller: held along some; prescribed: moved along the axes that have a motion; viscous: lets
    waves leave and incident waves enter; free_field: a vertical side that follows a column of its own layers on the same base,
    and lets waves leave (both for groups of faces only).
    """
    axes: list[Literal["x", "y", "z"]] | None = None
    """Axes along which a roller is held; for kind prescribed, those that are held without a motion. (required for a roller)
    Default: [].
    """
    motion_x: str | None = None
    """Motion along x. (kinds prescribed and viscous only)"""
    motion_y: str | None = None
    """Motion along y. (kinds prescribed and viscous only)"""
    motion_z: str | None = None
    """Motion along z. (kinds prescribed and viscous only)"""


@dataclass(kw_only=True, eq=False)
class IncidentWave(Part):
    """Plane wave that comes in at an angle, through all viscous and free-field boundaries."""

    kind: Literal["sv", "sh", "p"]
    """sv: shear wave whose motion lies in the vertical plane in which it travels, towards x and down for an angle above 0; sh:
    shear wave whose motion is horizontal and across that plane (3-D only); p: compression wave.
    """
    motion: str
    """Name of one of the [[motions]]: that of the ground in the incident wave alone, along its direction of motion, where the
    wave reaches the base first. Half of what outcropping rock does, if the wave comes up vertically.
    """
    angle: float
    """Angle from the vertical at which the wave travels in the ground at the base; above 0 towards x, or along the azimuth. Below
    the critical angle of all layers. [deg] At least -89 and at most 89.
    """
    azimuth: float | None = None
    """Horizontal direction in which the wave travels, from x towards y. [deg] (3-D only) Default: 0.0. At least -180 and at most
    180.
    """


@dataclass(kw_only=True, eq=False)
class Ty(Part):
    """Opposite sides whose nodes have their displacement in common."""

    group: str
    """Physical group of one side: faces, lines or points."""
    opposite: str
    """Physical group of the other side, with a node opposite every node of the group: the two move as one, like sides of ground
    that goes on alike.
    """


@dataclass(kw_only=True, eq=False)
class Load(Part):
    """Tractions on outer faces."""

    name: str
    """Name of the load in messages."""
    group: str
    """Physical group of outer faces (lines in 2-D) on which it acts."""
    traction: tuple[float, float, float]
    """Traction: force per area; z is 0 in 2-D. [Pa]"""
    ramp: float | None = None
    """Time in which the load grows linearly from 0 to its full value; 0: applied at once at t = 0. [s] Default: 0.0. At least 0.
    """


@dataclass(kw_only=True, eq=False)
class WaterPressure(Part):
    """Pressure of still water on outer faces, and in joints."""

    name: str
    """Name of the water in results and messages."""
    group: str | None = None
    """Physical group of outer faces (lines in 2-D) on which it presses. (exactly one of group and joint)"""
    joint: str | None = None
    """Name of one of the [[joints]] in which it stands: it pushes both sides apart, and the joint carries what is left, the
    effective pressure. (exactly one of group and joint)
    """
    level: float
    """Elevation of the still water, y in 2-D and z in 3-D: the pressure is density g (level - elevation) below it and 0 above; g
    is that of [gravity]. [m]
    """
    far_level: float | None = None
    """Uplift: the level at the far end of a base. The level falls evenly from one end to the other. [m] (default: the level
    everywhere; for the faces of a base, and for joints)
    """
    direction: tuple[float, float, float] | None = None
    """Horizontal direction from the end of the base with level to the one with far_level; the default is along x. (only with
    far_level) Default: [1.0, 0.0, 0.0].
    """
    density: float | None = None
    """Density of the water; of sea water about 1030. [kg/m3] Default: 1000.0. Greater than 0."""
    ramp: float | None = None
    """Time in which the pressure grows linearly from 0 to its full value; 0: it is there at t = 0, and settle includes it. [s]
    Default: 0.0. At least 0.
    """
    added_mass: Literal["none", "westergaard"] | None = None
    """Mass of water that moves with the faces, across them: none, or Westergaard's for steep walls, 7/8 density sqrt(H y) per
    area, with the depth H of the water and the depth y below the level. Default: "none".
    """
    bed: float | None = None
    """Elevation of the bed of the water, from which H counts. [m] (westergaard only; default: the lowest point of the group)"""


@dataclass(kw_only=True, eq=False)
class Member(Part):
    """Beams, bars, springs and dashpots between nodes."""

    name: str
    """Name of the member in results and messages."""
    kind: Literal["beam", "bar", "spring", "dashpot"]
    """beam: bends and stretches (Euler and Bernoulli); bar: stretches only, such as an anchor; spring and dashpot: along the line
    between two nodes.
    """
    group: str | None = None
    """Physical group of lines of the mesh, along which the member runs from node to node. (either group, or from and to)"""
    from_: tuple[float, float, float] | None = None
    """One end of a straight member: the nearest node, which must be within 1 % of the extent of the mesh. [m] (either group, or
    from and to)
    """
    to: tuple[float, float, float] | None = None
    """The other end. [m] (either group, or from and to)"""
    spacing: float | None = None
    """Distance of such members across the plane: section, mass, prestress, limits, stiffness and damping of each are divided by
    it, and forces in results are per metre. [m] (2-D only) Default: 1.0. Greater than 0.
    """
    youngs_modulus: float | None = None
    """Young's modulus. [Pa] (required for beams and bars) Greater than 0."""
    area: float | None = None
    """Area of the section. [m2] (required for beams and bars) Greater than 0."""
    second_moment: float | None = None
    """Second moment of area against bending, in space the same in all directions (a round or square section). [m4] (required for
    beams) Greater than 0.
    """
    density: float | None = None
    """Mass per volume. [kg/m3] (beams and bars; beams require one above 0) Default: 0.0. At least 0."""
    damping_ratio: float | None = None
    """Damping ratio of Rayleigh damping at the two frequencies of [damping]. (beams and bars) Default: 0.0. At least 0 and less
    than 1.
    """
    prestress: float | None = None
    """Tension of a bar before the body gives way to it; settle includes it. [N] (bars only) Default: 0.0."""
    yield_force: float | None = None
    """Axial force at which it yields, perfectly plastic, in tension and in compression. [N] (bars and springs; without it
    elastic) Greater than 0.
    """
    compression_force: float | None = None
    """Compression at which it gives way (buckles) and shortens without damage; 0 for a tie rod or a cable that goes slack. It
    bears again when it has its length back. [N] (bars and springs; without it that of yield_force) At least 0.
    """
    yield_moment: float | None = None
    """Plastic moment of the section, at which hinges turn at the ends of its elements, whatever its axial force. [N m] (beams;
    without it elastic) Greater than 0.
    """
    stiffness: float | None = None
    """Force per elongation. [N/m] (required for springs) Greater than 0."""
    damping: float | None = None
    """Force per velocity of elongation. [N s/m] (required for dashpots) Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Drain(Part):
    """Faces at which pore water is free to flow out and in."""

    group: str
    """Physical group of faces (lines in 2-D) through which water leaves saturated ground with drainage flow: the excess pore
    pressure is 0 there. The water table, faces under [[water_pressures]], and ground with drainage drained beside it drain by
    themselves; all other sides are impervious.
    """


@dataclass(kw_only=True, eq=False)
class Gravity(Part):
    """Body force."""

    acceleration: tuple[float, float, float] | None = None
    """Gravitational acceleration. [m/s2] Default: [0.0, 0.0, 0.0]."""
    settle: bool | None = None
    """Begin in equilibrium under gravity and the pressure of water: it is found first, viscous boundaries and free-field sides
    keep carrying their reactions in it, and displacements count from it. Default: false.
    """


@dataclass(kw_only=True, eq=False)
class Solver(Part):
    """Convergence of the Newton iteration and step cuts."""

    tolerance: float | None = None
    """Convergence: unbalanced force divided by the largest of the internal, external and inertial forces. Default: 1e-8. At least
    1e-13 and at most 0.01.
    """
    max_iterations: int | None = None
    """Maximum Newton iterations per step. Default: 20. At least 1 and at most 1000."""
    max_cuts: int | None = None
    """Maximum number of times that a step that does not converge is halved. Default: 8. At least 0 and at most 20."""


@dataclass(kw_only=True, eq=False)
class Gauge(Part):
    """Points whose motion is recorded."""

    name: str
    """Name of the gauge; its columns in gauges.csv begin with it."""
    point: tuple[float, float, float]
    """Initial position: the gauge records the motion of the nearest node. [m]"""


@dataclass(kw_only=True, eq=False)
class Time(Part):
    """Duration, time step and intervals of output."""

    end: float
    """Time at which the run ends; it begins at 0. [s] Greater than 0."""
    step: float
    """Time step; the implicit step is unconditionally stable, so choose it by the frequencies of interest. [s] Greater than 0."""
    analysis: Literal["dynamic", "static"] | None = None
    """dynamic, or static: each step is an equilibrium, and time only parametrises loads and motions, and the flow of pore water.
    Default: "dynamic".
    """
    alpha: float | None = None
    """Parameter of HHT-alpha: negative values add numerical damping of high frequencies; 0 is Newmark's constant average
    acceleration. (dynamic only) Default: 0.0. At least -0.333333 and at most 0.
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
    """A case of method fem."""

    method: ClassVar[str] = "fem"
    tables: ClassVar[dict[str, type[Part]]] = {
        "mesh": Mesh,
        "elements": Elements,
        "materials": Material,
        "joints": Joint,
        "damping": Damping,
        "motions": Motion,
        "boundaries": Boundary,
        "incident_wave": IncidentWave,
        "ties": Ty,
        "loads": Load,
        "water_pressures": WaterPressure,
        "members": Member,
        "drains": Drain,
        "gravity": Gravity,
        "solver": Solver,
        "gauges": Gauge,
        "time": Time,
        "output": Output,
    }

    mesh: Mesh
    """The body."""
    elements: Elements | None = None
    """Mass matrix and numerical integration."""
    materials: list[Material]
    """Materials of the regions."""
    joints: list[Joint] = field(default_factory=list)
    """Zero-thickness interfaces that slip and open."""
    damping: Damping | None = None
    """Rayleigh damping: its two frequencies."""
    motions: list[Motion] = field(default_factory=list)
    """Ground motions: wavelets, sines, records and functions of time."""
    boundaries: list[Boundary] = field(default_factory=list)
    """Boundary conditions of groups; all other nodes are free."""
    incident_wave: IncidentWave | None = None
    """Plane wave that comes in at an angle, through all viscous and free-field boundaries."""
    ties: list[Ty] = field(default_factory=list)
    """Opposite sides whose nodes have their displacement in common."""
    loads: list[Load] = field(default_factory=list)
    """Tractions on outer faces."""
    water_pressures: list[WaterPressure] = field(default_factory=list)
    """Pressure of still water on outer faces, and in joints."""
    members: list[Member] = field(default_factory=list)
    """Beams, bars, springs and dashpots between nodes."""
    drains: list[Drain] = field(default_factory=list)
    """Faces at which pore water is free to flow out and in."""
    gravity: Gravity | None = None
    """Body force."""
    solver: Solver | None = None
    """Convergence of the Newton iteration and step cuts."""
    gauges: list[Gauge] = field(default_factory=list)
    """Points whose motion is recorded."""
    time: Time
    """Duration, time step and intervals of output."""
    output: Output | None = None
    """What is written besides histories and snapshots."""
