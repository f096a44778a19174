"""Cases of method mps, written by tools/write_case_classes.py from `sazare schema`."""

from dataclasses import dataclass, field
from typing import ClassVar, Literal

from sazare.cases import Case as AnyCase
from sazare.cases import Part


@dataclass(kw_only=True, eq=False)
class Particles(Part):
    """Lattice of the particles."""

    spacing: float
    """Distance between neighbouring particles on the lattice: twice the radius of a particle. [m] Greater than 0."""
    dimension: int | None = None
    """2 for plane strain in x and y (up), 3 for a body in x, y and z (up). Default: 2. At least 2 and at most 3."""
    influence: float | None = None
    """Influence radius divided by the spacing: particles nearer than this are linked. Default: 1.5. Greater than 1 and at most 3.
    """
    fit: Literal["exact", "inside"] | None = None
    """Whether rectangles must be whole multiples of the spacing, or hold as many particles as fit inside. Default: "exact"."""
    periodic: list[Literal["x", "y", "z"]] | None = None
    """Axes along which the body is periodic: its two ends are linked, as in an infinite layer. Default: []."""
    rotation: Literal["mean_rotation", "mean_angle"] | None = None
    """How rigid rotation is removed from the deformation of a link: by the mean of the two rotations, or by the mean angle (2-D
    only). Default: "mean_rotation".
    """
    rotation_torque: Literal["half", "whole"] | None = None
    """Torque of a link on each of its particles: half of its arm times its force, which keeps the angular momentum, or the whole,
    for comparisons: as with half the moment of inertia, elastic ground only. Default: "half".
    """


@dataclass(kw_only=True, eq=False)
class Region(Part):
    """Regions that are filled with particles."""

    name: str
    """Name by which materials refer to the region; where regions overlap, the last one applies."""
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
    """Materials of the regions."""

    name: str
    """Name of the material in messages."""
    regions: list[str]
    """Regions that consist of the material."""
    density: float
    """Mass per volume. [kg/m3] Greater than 0."""
    s_wave_velocity: float | None = None
    """Velocity of S waves. [m/s] (exactly two of s_wave_velocity, p_wave_velocity and poisson_ratio) Greater than 0."""
    p_wave_velocity: float | None = None
    """Velocity of P waves. [m/s] (exactly two of s_wave_velocity, p_wave_velocity and poisson_ratio) Greater than 0."""
    poisson_ratio: float | None = None
    """Poisson's ratio. (exactly two of s_wave_velocity, p_wave_velocity and poisson_ratio) At least 0 and less than 0.5."""
    damping_ratio: float | None = None
    """Damping ratio at the frequencies f1 and f2 of [damping]. Default: 0.0. At least 0 and at most 2."""
    cohesion: float | None = None
    """Cohesion of the Mohr-Coulomb strength. [Pa] (default: the material is elastic and never fails) At least 0."""
    friction_angle: float | None = None
    """Friction angle, of broken ground too. [deg] (required with a cohesion) At least 0 and at most 60."""
    dilation_angle: float | None = None
    """Dilation angle; at most the friction angle. [deg] (only with a cohesion) Default: 0.0. At least 0 and at most 60."""
    tensile_strength: float | None = None
    """Tension cut-off: largest tensile stress; at most cohesion/tan(friction_angle). [Pa] (only with a cohesion; default:
    cohesion/tan(friction_angle), without friction none) At least 0.
    """
    rupture_strain: float | None = None
    """Equivalent plastic shear strain (engineering) or tensile opening at which the ground breaks: it then has friction, but no
    cohesion and no links. (only with a cohesion) Default: 0.1. Greater than 0.
    """
    residual_cohesion: float | None = None
    """Cohesion to which that of ground that yields falls; the tensile strength falls with it. [Pa] (only with a cohesion, and
    with a softening_displacement; default: the cohesion stays) At least 0.
    """
    residual_friction_angle: float | None = None
    """Angle of friction to which that of ground that yields falls; its dilation ends with it. Ground that has broken has this
    friction. [deg] (only with a cohesion, and with a softening_displacement; default: friction and dilation stay) At least 0
    and at most 60.
    """
    softening_displacement: float | None = None
    """Slip across a shear band over which the strength would fall to the residual one at the rate at which it begins to; it does
    not depend on the spacing. [m] (required with a residual_cohesion or a residual_friction_angle) Greater than 0.
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
    """Boundary conditions of the sides; all others are free."""

    side: Literal["left", "right", "bottom", "top", "front", "back", "all"]
    """Side of the body, or of a region: left and right are along x, front and back along y in 3-D, bottom and top vertical; all:
    every particle.
    """
    extent: Literal["plane", "surface"] | None = None
    """plane: the outermost plane of particles; surface: all particles without a neighbour in this direction, on slope faces,
    overhangs and in cavities too. Default: "plane".
    """
    region: str | None = None
    """Region whose side is meant. (default: the whole body)"""
    kind: Literal["fixed", "roller", "prescribed", "viscous", "free_field"]
    """fixed: held along all axes; roller: held normal to the side; prescribed: moves with the within motion (E + F); viscous:
    lets waves leave and an incident wave (E) enter; free_field: left, right, front and back only, a side that moves as a
    column of its own layers on the same base does, and lets waves leave.
    """
    axes: list[Literal["x", "y", "z"]] | None = None
    """Axes along which a roller is held. (kind roller only; none: normal to the side) Default: []."""
    motion_x: str | None = None
    """Motion along x. (kinds prescribed and viscous only)"""
    motion_y: str | None = None
    """Motion along y. (kinds prescribed and viscous only)"""
    motion_z: str | None = None
    """Motion along z. (kinds prescribed and viscous only)"""


@dataclass(kw_only=True, eq=False)
class Contact(Part):
    """Broken ground, and contact between bodies."""

    damping_ratio: float | None = None
    """Damping ratio of broken ground, for the motion of its particles that is no smooth deformation, and of contacts. Default:
    0.2. At least 0 and at most 2.
    """


@dataclass(kw_only=True, eq=False)
class Gravity(Part):
    """Body force."""

    acceleration: tuple[float, float, float] | None = None
    """Gravitational acceleration. [m/s2] Default: [0.0, 0.0, 0.0]."""
    settle: bool | None = None
    """Begin in equilibrium under gravity: it is found first, viscous boundaries and free-field sides keep carrying their
    reactions in it, and displacements count from it. Default: false.
    """
    max_settling_steps: int | None = None
    """Maximum steps to reach equilibrium under gravity, with 1e-5 of gravity left as acceleration; after these the ground is
    reported as unstable where more than 1e-4 is left. Default: 200000. At least 1 and at most 1e+09.
    """


@dataclass(kw_only=True, eq=False)
class Noise(Part):
    """Small random initial motion, so that every instability can grow."""

    velocity: float | None = None
    """Largest random initial velocity of every degree of freedom (rotations: divided by half a spacing). [m/s] Default: 0.0. At
    least 0.
    """
    seed: int | None = None
    """Seed of the random numbers. Default: 1. At least 1 and at most 1e+06."""


@dataclass(kw_only=True, eq=False)
class Gauge(Part):
    """Points whose motion is recorded."""

    name: str
    """Name of the gauge; its columns in gauges.csv begin with it."""
    point: tuple[float, float, float]
    """Initial position: the gauge records the motion of the nearest particle, at most one spacing away. [m]"""


@dataclass(kw_only=True, eq=False)
class Time(Part):
    """Duration, time step and intervals of output."""

    end: float
    """Time at which the run ends; it begins at 0. [s] Greater than 0."""
    step: float | None = None
    """Time step of all particles; above the predicted stability limit the case is refused. [s] (default: stability_fraction of
    the predicted stability limit, or a little less) Greater than 0.
    """
    stability_fraction: float | None = None
    """Ratio of the step to the predicted stability limit where no step is given. Default: 0.9. Greater than 0 and less than 1."""
    integrator: Literal["verlet", "leapfrog", "euler"] | None = None
    """Time integration scheme. Default: "verlet"."""
    euler_damping: Literal["present", "lagged"] | None = None
    """Rate of the elastic forces by which Rayleigh damping acts in Euler's step: the present one, or lagged by a step, for
    comparisons. (integrator euler only) Default: "present".
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
    """Lattice of the particles."""
    regions: list[Region]
    """Regions that are filled with particles."""
    materials: list[Material]
    """Materials of the regions."""
    damping: Damping | None = None
    """Rayleigh damping: its two frequencies."""
    motions: list[Motion] = field(default_factory=list)
    """Ground motions: wavelets, sines, records and functions of time."""
    boundaries: list[Boundary] = field(default_factory=list)
    """Boundary conditions of the sides; all others are free."""
    contact: Contact | None = None
    """Broken ground, and contact between bodies."""
    gravity: Gravity | None = None
    """Body force."""
    noise: Noise | None = None
    """Small random initial motion, so that every instability can grow."""
    gauges: list[Gauge] = field(default_factory=list)
    """Points whose motion is recorded."""
    time: Time
    """Duration, time step and intervals of output."""
    output: Output | None = None
    """What is written besides histories and snapshots."""
