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
    """Materials of the named volumes."""

    name: str
    """Name by which joints refer to the material."""
    regions: list[str]
    """Physical volume groups of the mesh that consist of the material."""
    density: float
    """Mass per volume. [kg/m3] Greater than 0."""
    youngs_modulus: float | None = None
    """Young's modulus. With it the springs of each face follow from the two elements beside it, and waves run at one speed in
    elements of any size. [Pa] (with poisson_ratio, instead of the stiffnesses of joints) Greater than 0.
    """
    poisson_ratio: float | None = None
    """Poisson's ratio: up to 0.45 of rigid elements, and up to 0.49 of deformable ones. (with youngs_modulus, instead of the
    stiffnesses of joints) At least 0 and at most 0.49.
    """
    deformable: bool | None = None
    """Whether the elements strain and have a stress. False: they are rigid, and the joints between them are as elastic as the
    material. (needs youngs_modulus and poisson_ratio) Default: false.
    """
    bulk_damping_ratio: float | None = None
    """Damping ratio of the strain of a deformable element: its stress grows with the rate of its strain. (only with deformable =
    true) Default: 0.0. At least 0.
    """


@dataclass(kw_only=True, eq=False)
class Joint(Part):
    """Joints between faces; where several entries match a face, the last one applies."""

    name: str
    """Name of the joint in results and messages."""
    between: tuple[str, str] | None = None
    """The two materials (the same one twice for faces inside a material) whose shared faces it joins. (exactly one of between and
    surface)
    """
    surface: str | None = None
    """Physical surface group inside the body whose faces it joins, such as a fault. (exactly one of between and surface)"""
    bonded: bool | None = None
    """False for faces that only touch, with the properties of [contact], such as a slit. Default: true."""
    law: Literal["linear_softening", "mixed_mode", "barton_bandis"] | None = None
    """How a bonded joint fails. linear_softening: tension softens linearly until the joint breaks, and shear slips at the Mohr-
    Coulomb strength without end. mixed_mode: opening and slip use up one strength, each with its fracture energy, and friction
    remains. barton_bandis: a natural rock joint, which bears pressure and friction alone, closes under pressure, and dilates
    and wears as it slips. Default: "linear_softening".
    """
    joint_normal_stiffness: float | None = None
    """Normal stiffness: normal stress per opening. [Pa/m] (required when bonded, unless its materials have youngs_modulus)
    Greater than 0.
    """
    joint_shear_stiffness: float | None = None
    """Shear stiffness: shear stress per elastic shear displacement. [Pa/m] (required when bonded, unless its materials have
    youngs_modulus) At least 0.
    """
    joint_normal_damping: float | None = None
    """Normal dashpot: normal stress per opening velocity. [Pa s/m] Default: 0.0. At least 0."""
    joint_shear_damping: float | None = None
    """Shear dashpot: shear stress per sliding velocity, beside the strength; of law barton_bandis within it. [Pa s/m] Default:
    0.0. At least 0.
    """
    damping_ratio: float | None = None
    """Damping ratio of the two elements beside each face, which move against each other on its springs. (instead of
    joint_normal_damping and joint_shear_damping) At least 0.
    """
    cohesion: float | None = None
    """Cohesion: shear strength at zero normal stress. [Pa] (required when bonded, not for law barton_bandis) At least 0."""
    friction_coefficient: float | None = None
    """Coefficient of friction: shear strength per compressive stress. (when bonded, exactly one of friction_coefficient and
    friction_angle, not for law barton_bandis) At least 0.
    """
    friction_angle: float | None = None
    """Angle whose tangent is the friction coefficient. [deg] (when bonded, exactly one of friction_coefficient and
    friction_angle, not for law barton_bandis) At least 0 and less than 90.
    """
    tensile_strength: float | None = None
    """Tensile strength: normal stress at which softening begins; at most sqrt(2 fracture_energy k) with the normal stiffness k of
    each face. [Pa] (required when bonded, not for law barton_bandis) Greater than 0.
    """
    fracture_energy: float | None = None
    """Fracture energy: energy per area that the joint dissipates when it breaks in tension. [N/m] (required when bonded, not for
    law barton_bandis) Greater than 0.
    """
    weibull_modulus: float | None = None
    """Lets strengths and fracture energies scatter from face to face by Weibull's distribution with this modulus about those
    given here, which are the means. (default: all faces have the same strength; not for law barton_bandis) At least 1.
    """
    scatter_seed: int | None = None
    """Seed of the random strength factors of the faces. (only with a weibull_modulus) Default: 1. At least 0 and at most 1e+09.
    """
    shear_fracture_energy: float | None = None
    """Fracture energy in shear, mode II: energy per area that cohesion dissipates, beside friction, when slip uses it up. [N/m]
    (required for law mixed_mode) Greater than 0.
    """
    residual_friction_coefficient: float | None = None
    """Coefficient of friction of a joint of law mixed_mode without cohesion. (default: the friction coefficient of the joint) At
    least 0.
    """
    jrc: float | None = None
    """Joint roughness coefficient JRC, 0 to 20. (required for law barton_bandis) At least 0."""
    jcs: float | None = None
    """Joint wall compressive strength JCS, at least 0.1 MPa. [Pa] (required for law barton_bandis) Greater than 0."""
    residual_friction_angle: float | None = None
    """Residual friction angle of the joint, that of a JRC of 0; below 70 deg. [deg] (required for law barton_bandis) At least 0.
    """
    joint_length: float | None = None
    """Length of the joint in the ground, between others that cross it: its peak is at a slip of L/500 (JRC/L)^(1/3). [m]
    (required for law barton_bandis) Greater than 0.
    """
    laboratory_length: float | None = None
    """Length of the specimens that have jrc and jcs, at most joint_length. Of a longer joint both are less, by the scale
    correction of Bandis. [m] (default: joint_length) Greater than 0.
    """
    joint_aperture: float | None = None
    """Aperture of the joint under a small stress, at most 5 mm, from which its closure is estimated; the closure must come out
    below the aperture. [m] (for law barton_bandis; without it and tests the joint itself does not close) Greater than 0.
    """
    initial_normal_stiffness: float | None = None
    """Normal stiffness K_ni with which closure of the joint begins. [Pa/m] (for law barton_bandis, with the other of the two,
    instead of joint_aperture) Greater than 0.
    """
    maximum_closure: float | None = None
    """Largest closure V_m of the joint. [m] (for law barton_bandis, with the other of the two, instead of joint_aperture) Greater
    than 0.
    """
    damage_coefficient: float | None = None
    """Damage coefficient M, 1 to 2: the dilation angle is 1/M of what roughness adds to the friction angle. (default for law
    barton_bandis: 2) Greater than 0.
    """
    rate_law: Literal["none", "fib_2010", "malvar_ross", "cowper_symonds", "logarithmic"] | None = None
    """How tensile strength, cohesion and fracture energies grow with the rate of strain at which the joint is opened: not, as the
    fib Model Code 2010 or Malvar and Ross have it for concrete, or by a power or the logarithm of the rate. (not for law
    barton_bandis) Default: "none".
    """
    rate_energy_exponent: float | None = None
    """Power of the factor on the strength that fracture energies have: 0, they do not depend on the rate; 1, they grow as the
    strength; 2, the process zone of a crack keeps its length. (only with a rate_law) Default: 1.0. At least 0 and at most 2.
    """
    static_compressive_strength: float | None = None
    """Uniaxial compressive strength under static load, on which malvar_ross depends: weaker concrete gains more. [Pa] (required
    for malvar_ross) Greater than 0.
    """
    rate_scale: float | None = None
    """Strain rate of the rate law: that doubles the strength (cowper_symonds), or beyond which it grows (logarithmic). [1/s]
    (required for cowper_symonds and logarithmic) Greater than 0.
    """
    rate_exponent: float | None = None
    """Exponent q of Cowper and Symonds: the strength grows by the q-th root of the strain rate. (required for cowper_symonds)
    Greater than 0.
    """
    rate_slope: float | None = None
    """Growth of the strength, as a share of the static one, with every tenfold strain rate beyond rate_scale. (required for
    logarithmic) Greater than 0.
    """


@dataclass(kw_only=True, eq=False)
class Contact(Part):
    """Contact between free faces and between faces whose joint is broken."""

    contact_shape: Literal["spheres", "faces"] | None = None
    """What touches: spheres behind the faces, which is fast, but bumpy where faces slide; or the true faces, which slide over
    each other as planes and keep the energy. Default: "spheres".
    """
    contact_stiffness: float | None = None
    """Normal stiffness of a pair of contact spheres: force per overlap. [N/m] (required for spheres; with faces for a coupled run
    alone, whose surface spheres touch) Greater than 0.
    """
    contact_damping: float | None = None
    """Normal dashpot of a pair: force per approach velocity; never attractive. [N s/m] Default: 0.0. At least 0."""
    face_contact_stiffness: float | None = None
    """Normal stiffness of two faces that touch: pressure per overlap. [Pa/m] (required with contact_shape = "faces") Greater than
    0.
    """
    face_contact_damping: float | None = None
    """Normal dashpot of two faces that touch: pressure per approach velocity; never attractive. [Pa s/m] (with contact_shape =
    "faces") Default: 0.0. At least 0.
    """
    friction_coefficient: float | None = None
    """Coefficient of friction: largest tangential force per normal force. (exactly one of friction_coefficient and
    friction_angle) At least 0.
    """
    friction_angle: float | None = None
    """Angle whose tangent is the friction coefficient. [deg] (exactly one of friction_coefficient and friction_angle) At least 0
    and less than 90.
    """
    damping_cap: Literal["literal", "critical", "step"] | None = None
    """What limits a dashpot too stiff for the masses: literal: nothing; critical: critical damping; step: its force is built up
    over several steps, as fast as their stability allows. Default: "step".
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
    """Rise time a: from zero to the largest pressure. [s] (required without table and function) Greater than 0."""
    decay_ratio: float | None = None
    """Time b from the largest pressure back to zero, divided by the rise time. (required without table and function) Greater than
    0.
    """
    table: str | None = None
    """CSV file with header "time [s],pressure [Pa]" and increasing times; linear between rows. (instead of peak_pressure,
    rise_time and decay_ratio)
    """
    function: bool | None = None
    """The pressure is a function, given in Python, of the time since the delay. (instead of peak_pressure, rise_time and
    decay_ratio) Default: false.
    """
    cut_distance: float | None = None
    """Displacement of a face at which its pressure ends for good; inf: never. [m] Default: inf. Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Charge(Part):
    """Explosive in holes: the detonation runs along it, and its gas presses on the wall until it has expanded."""

    name: str | None = None
    """Name of the charge in results and messages. (default: the surface's name)"""
    surface: str
    """Physical surface group of the hole's wall. Several charges (decks) may stand in one hole."""
    collar: tuple[float, float, float]
    """Where the axis of the hole begins; depths along the hole count from here. [m]"""
    toe: tuple[float, float, float]
    """Where the axis of the hole ends. [m]"""
    diameter: float
    """Diameter of the hole. [m] Greater than 0."""
    charge_diameter: float | None = None
    """Diameter of the explosive. A smaller one leaves an annulus of air (decoupling) into which the gas expands first. [m]
    (default: that of the hole) Greater than 0.
    """
    share: float | None = None
    """Share of the hole that the mesh has: 0.5 where a plane of symmetry runs along its axis, 0.25 with two. Default: 1.0.
    Greater than 0 and at most 1.
    """
    top: float | None = None
    """Depth at which the explosive begins. Above it stands the stemming. [m] Default: 0.0. At least 0."""
    bottom: float | None = None
    """Depth at which the explosive ends. [m] (default: the toe) Greater than 0."""
    primer: float | None = None
    """Depth of the primer, from which the detonation runs in both directions. [m] (default: the bottom of the charge) At least 0.
    """
    vents: bool | None = None
    """The gas pushes the stemming out of the hole, and then leaves through the collar, at once where there is no stemming. False:
    the collar is closed for ever. Default: false.
    """
    stemming_density: float | None = None
    """Density of the stemming, which its inertia follows from where the collar vents. [kg/m3] Default: 1600.0. Greater than 0."""
    stemming_resistance: float | None = None
    """Shear stress between the wall of the hole and stemming that slides. [Pa] Default: 0.0. At least 0."""
    gas_in_cracks: Literal["none", "share", "flow"] | None = None
    """What the gas does in faces that have come apart and are connected with the hole. none: it stays in the hole; share: it acts
    in them at once, with a share of the pressure of the hole; flow: it flows through them, and leaves at free faces. Default:
    "none".
    """
    crack_pressure_share: float | None = None
    """Pressure in cracks over that in the hole. (with gas_in_cracks = "share") Default: 1.0. Greater than 0 and at most 1."""
    crack_aperture: float | None = None
    """Width that a crack has for gas even where its faces touch, because they are rough. It adds to what they are apart. The
    smaller it is, the shorter the steps of the elements beside it. [m] (with gas_in_cracks = "share" or "flow") Default: 5e-5.
    At least 1e-07 and at most 0.01.
    """
    discharge_coefficient: float | None = None
    """Coefficient of discharge of the openings between cracks. (with gas_in_cracks = "flow") Default: 0.6. Greater than 0 and at
    most 1.
    """
    explosive: Literal["ANFO", "C-4", "composition B", "pentolite", "PETN 1.26", "PETN 1.50", "PETN 1.77", "TNT", "custom"]
    """An explosive of the table, with its density, velocity, energy and gas; custom: one whose constants are given here."""
    density: float | None = None
    """Density of the explosive. [kg/m3] (required with explosive = "custom", else not given) Greater than 0."""
    detonation_velocity: float | None = None
    """Velocity of the detonation along the hole, such as a measured one. [m/s] (required with explosive = "custom"; default: that
    of the explosive) At least 100.
    """
    explosive_energy: float | None = None
    """Energy of the explosive per mass. [J/kg] (required with the constants of JWL; with gas_exponent the default follows from
    the velocity) Greater than 0.
    """
    gas_exponent: float | None = None
    """Exponent of a gas whose pressure falls as its volume to the power of minus this. (with explosive = "custom": this, or the
    five constants of JWL) Greater than 1 and at most 5.
    """
    jwl_a: float | None = None
    """Constant A of the equation of state of Jones, Wilkins and Lee. [Pa] (with explosive = "custom": all five, or gas_exponent)
    At least 0.
    """
    jwl_b: float | None = None
    """Constant B of the same equation. [Pa] (with explosive = "custom": all five, or gas_exponent) At least 0."""
    jwl_r1: float | None = None
    """Constant R1 of the same equation. (with explosive = "custom": all five, or gas_exponent) Greater than 0."""
    jwl_r2: float | None = None
    """Constant R2 of the same equation. (with explosive = "custom": all five, or gas_exponent) Greater than 0."""
    jwl_omega: float | None = None
    """Constant omega of the same equation. (with explosive = "custom": all five, or gas_exponent) Greater than 0."""
    delay: float | None = None
    """Time at which the primer fires. [s] Default: 0.0. At least 0."""
    delay_scatter: float | None = None
    """Standard deviation of that time, normally distributed, as of pyrotechnic detonators. [s] Default: 0.0. At least 0."""
    scatter_seed: int | None = None
    """Seed of the scatter of the delay. Default: 1. At least 0 and at most 1e+09."""
    cut_distance: float | None = None
    """Displacement of a face at which the gas leaves it for good; inf: never. [m] Default: inf. Greater than 0."""


@dataclass(kw_only=True, eq=False)
class Gravity(Part):
    """Body force."""

    acceleration: tuple[float, float, float] | None = None
    """Gravitational acceleration. [m/s2] Default: [0.0, 0.0, 0.0]."""
    settle: bool | None = None
    """Begin in equilibrium, under gravity and the initial stress together: it is found first, absorbing boundaries keep carrying
    their reactions in it, and displacements and energies count from it. Default: false.
    """


@dataclass(kw_only=True, eq=False)
class Water(Part):
    """Water around the body and its fragments: buoyancy and drag."""

    level: float
    """Elevation of the still water's surface: along z where gravity acts along -z, in general against gravity. [m]"""
    density: float | None = None
    """Mass per volume of the water; sea water 1025. [kg/m3] Default: 1000.0. At least 0.001 and at most 100000."""
    drag_coefficient: float | None = None
    """Drag coefficient of faces that water meets: free ones, and those of elements that have come apart. Default: 1.0. At least 0
    and at most 100.
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
class InitialStress(Part):
    """Stress in the body at the beginning, which bonded joints and boundaries carry."""

    normal_stress: tuple[float, float, float] | None = None
    """Stresses xx, yy, zz at the datum. [Pa] (instead of k0; tension positive) Default: [0.0, 0.0, 0.0]."""
    shear_stress: tuple[float, float, float] | None = None
    """Stresses xy, yz, zx at the datum. [Pa] (instead of k0; tension positive) Default: [0.0, 0.0, 0.0]."""
    normal_stress_per_depth: tuple[float, float, float] | None = None
    """What is added to xx, yy, zz per metre of depth below the datum. [Pa/m] (instead of k0; tension positive) Default: [0.0,
    0.0, 0.0].
    """
    shear_stress_per_depth: tuple[float, float, float] | None = None
    """What is added to xy, yz, zx per metre of depth below the datum. [Pa/m] (instead of k0; tension positive) Default: [0.0,
    0.0, 0.0].
    """
    k0: float | None = None
    """Ratio of horizontal to vertical stress; the vertical stress is the weight of the ground between a place and the datum, its
    surface. (instead of the stresses; needs gravity along an axis) At least 0.
    """
    datum: float | None = None
    """Height of the plane from which depth is measured: along z, or against gravity where there is gravity. [m] Default: 0.0."""
    settle: bool | None = None
    """Begin in equilibrium, under gravity and the initial stress together: it is found first, absorbing boundaries keep carrying
    their reactions in it, and displacements and energies count from it. Default: false.
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
    """Boundary conditions of outer faces; all others are free."""

    surface: str
    """Physical surface group on the outside of the body."""
    kind: Literal["fixed", "frictionless", "absorbing", "prescribed"]
    """fixed: joined to immobile ground of the same material by springs and dashpots of its own joint; frictionless: slides in the
    plane of each face; absorbing: dashpots that let waves leave and an incident wave (E) enter; prescribed: like fixed, on
    ground that moves.
    """
    motion_x: str | None = None
    """Motion of the ground, or of the incident wave, along x; along an axis without one the ground stands still. (not for kind
    fixed)
    """
    motion_y: str | None = None
    """Motion of the ground or the incident wave along y. (not for kind fixed)"""
    motion_z: str | None = None
    """Motion of the ground or the incident wave along z. (not for kind fixed)"""


@dataclass(kw_only=True, eq=False)
class Constraint(Part):
    """Axes along or about which whole volumes cannot move or turn."""

    regions: list[str]
    """Physical volume groups whose elements are constrained."""
    translation: list[Literal["x", "y", "z"]] | None = None
    """Axes along which the elements cannot move. Default: []."""
    rotation: list[Literal["x", "y", "z"]] | None = None
    """Axes about which the elements cannot turn. Default: []."""


@dataclass(kw_only=True, eq=False)
class InitialVelocity(Part):
    """Initial velocities of volumes."""

    regions: list[str]
    """Physical volume groups that have an initial velocity."""
    velocity: tuple[float, float, float]
    """Initial velocity. [m/s]"""


@dataclass(kw_only=True, eq=False)
class Gauge(Part):
    """Points whose velocity is recorded."""

    name: str
    """Name of the gauge; its columns in gauges.csv begin with it."""
    point: tuple[float, float, float]
    """Initial position: a point inside an element, with which it moves. [m]"""


@dataclass(kw_only=True, eq=False)
class Time(Part):
    """Duration, time steps and intervals of output."""

    end: float
    """Time at which the run ends; it begins at 0. [s] Greater than 0."""
    levels: Literal["per_element", "uniform"] | None = None
    """Whether every element has its own time level, or all have the finest that any element needs. Default: "per_element"."""
    limiter: Literal["stability", "travel", "none"] | None = None
    """What limits the step of an element: its stability limit, its travel in a step, or nothing (base_step for all). Default:
    "stability".
    """
    base_step: float | None = None
    """Largest time step; level k has the step base_step / 2^k. [s] (default: chosen from the stable steps; required for limiter
    travel and none) Greater than 0.
    """
    stability_fraction: float | None = None
    """Ratio of the step of an element to the stability limit of its springs and dashpots with its neighbours held; 0.5 allows for
    neighbours that move as well. Default: 0.5. Greater than 0 and at most 1.
    """
    travel_length: float | None = None
    """Largest travel of an element in a step (limiter travel). [m] Default: 10e-9. Greater than 0."""
    neighbor_levels: int | None = None
    """Largest difference of level between linked elements. Default: 2. At least 0 and at most 20."""
    history_interval: float | None = None
    """Time between rows of the histories; the end is a whole multiple of it. [s] (default: about end/200) Greater than 0."""
    snapshot_interval: float | None = None
    """Time between snapshots; a whole multiple of history_interval, of which the end is a whole multiple. [s] (default: about
    end/20) Greater than 0.
    """
    strict: bool | None = None
    """Treat warnings as errors, such as that of a step above the stability limit. Default: false."""


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
        "charges": Charge,
        "gravity": Gravity,
        "water": Water,
        "initial_stress": InitialStress,
        "motions": Motion,
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
    """Materials of the named volumes."""
    joints: list[Joint]
    """Joints between faces; where several entries match a face, the last one applies."""
    contact: Contact
    """Contact between free faces and between faces whose joint is broken."""
    blasts: list[Blast] = field(default_factory=list)
    """Pressure on the walls of holes: a pulse, a table from a CSV file, or a function given in Python."""
    charges: list[Charge] = field(default_factory=list)
    """Explosive in holes: the detonation runs along it, and its gas presses on the wall until it has expanded."""
    gravity: Gravity | None = None
    """Body force."""
    water: Water | None = None
    """Water around the body and its fragments: buoyancy and drag."""
    initial_stress: InitialStress | None = None
    """Stress in the body at the beginning, which bonded joints and boundaries carry."""
    motions: list[Motion] = field(default_factory=list)
    """Ground motions: wavelets, sines, records and functions of time."""
    boundaries: list[Boundary] = field(default_factory=list)
    """Boundary conditions of outer faces; all others are free."""
    constraints: list[Constraint] = field(default_factory=list)
    """Axes along or about which whole volumes cannot move or turn."""
    initial_velocities: list[InitialVelocity] = field(default_factory=list)
    """Initial velocities of volumes."""
    gauges: list[Gauge] = field(default_factory=list)
    """Points whose velocity is recorded."""
    time: Time
    """Duration, time steps and intervals of output."""
    output: Output | None = None
    """What is written besides histories and snapshots."""
