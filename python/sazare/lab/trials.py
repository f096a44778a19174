"""Laboratory tests as cases of method blocks: what is loaded, how fast, and what is expected.

Stresses and strains of a test are positive in the direction in which it loads. What is expected comes from the strengths of the joints and serves to
choose the speed of the platen and the end of the run; nothing that is measured depends on it otherwise.
"""

import math
from dataclasses import dataclass

import numpy as np

from sazare.cases import blocks
from sazare.lab import specimens
from sazare.lab.rock import Rock, with_keys
from sazare.lab.specimens import STEEL, Specimen

PASSES = 80.0  # of a P-wave from platen to platen until failure, in a quasi-static test
DAMPING = 0.2  # least damping ratio of joints in a quasi-static test
RAMP = 0.1  # share of the expected time to failure in which the platen reaches its speed
ROWS = 400  # of the history
PICTURES = 20  # snapshots
SHORTEST_ARC, WIDEST_ARC = 0.2, 60.0  # on which a jaw bears: in elements, and in degrees
SMALLEST_TIP, WIDEST_TIP = 0.1, 0.25  # radius of the circle on which a point presses: in elements, and over the diameter
PLATEN_FRICTION = 0.2  # of steel on rock
FEWEST_ACROSS = 6  # elements over the width of a specimen


class Platens:
    """How the ends of a specimen are loaded."""

    FRICTIONLESS = "frictionless"
    HELD = "held"
    STEEL = "steel"
    ALL = (FRICTIONLESS, HELD, STEEL)


@dataclass(frozen=True)
class Options:
    """What a test may be told, lengths in m. None: what suits the test."""

    diameter: float = 0.05
    height: float | None = None
    elements: int = 8  # over the diameter
    platens: str | None = None
    platen_friction: float | None = None  # of platens of steel: PLATEN_FRICTION
    contact_angle: float = 10.0  # over which jaws bear on a disc [deg]
    tip_radius: float = 0.0025  # of the circles on which points press [m]
    strain_rate: float | None = None  # of the platen's displacement over the length [1/s]; None: quasi-static
    strain: float | None = None  # at which the test ends
    seed: int = 1  # of the mesh
    scatter_seed: int | None = None  # of the strengths of faces, where they scatter

    def __post_init__(self):
        if self.elements < 2:
            raise ValueError("a specimen needs 2 elements over its diameter or more")
        if self.platen_friction is not None and self.platens != Platens.STEEL:
            raise ValueError(f"--platen-friction is that of platens of steel, which were not asked for: add --platens {Platens.STEEL}, or leave it out")

    @property
    def size(self):
        """Size of the elements [m]."""
        return self.diameter / self.elements


@dataclass(frozen=True)
class Trial:
    """One test of one specimen."""

    test: str
    rock: Rock
    specimen: Specimen
    options: Options
    sense: float  # of the moving platen along the specimen's axis: -1 presses, 1 pulls or pushes along
    platens: str
    expected_stress: float  # Pa
    expected_strain: float  # of the platen's displacement over the length
    longest: float = 2.0  # end of the run, over the expected strain
    pressure: float = 0.0  # around the specimen, or on the plane that is sheared [Pa]
    pressed: str | None = None  # surface on which the pressure acts
    stressed: tuple[float, float, float] = (0.0, 0.0, 0.0)  # at the start, over the pressure
    measures_strain: bool = False  # whether the middle of the specimen is strained uniformly
    ends_when_broken: bool = True

    def __post_init__(self):
        if self.options.scatter_seed is not None and self.rock.joint.weibull_modulus is None:
            raise ValueError("strengths of this rock do not scatter, so there is no seed of their scatter: its joint has no weibull_modulus")
        fastest = self.expected_strain * self.rock.wave_speed / self.specimen.length
        if self.strain_rate > fastest:
            raise ValueError(
                f"at a strain rate of {self.strain_rate:g} per s the rock fails before a wave has passed the specimen, so there is no stress of the "
                f"specimen: it may be {fastest:.3g} per s at most"
            )
        if self.options.strain is not None and self.options.strain < RAMP * self.expected_strain:
            raise ValueError(f"at a strain of {self.options.strain:g} the platen has not reached its speed: --strain {RAMP * self.expected_strain:.2g} or more")

    @property
    def title(self):
        """What the test is called."""
        under = f" under {1e-6 * self.pressure:.4g} MPa" if self.pressure else ""
        return f"{TITLES[self.test]} of {self.rock.name}{under}"

    @property
    def is_dynamic(self):
        """Whether the speed of loading was asked for."""
        return self.options.strain_rate is not None

    @property
    def strain_rate(self):
        """Displacement of the platen over the length of the specimen, per time [1/s]."""
        return self.options.strain_rate or self.expected_strain * self.rock.wave_speed / (PASSES * self.specimen.length)

    @property
    def speed(self):
        """Speed of the platen [m/s]."""
        return self.strain_rate * self.specimen.length

    @property
    def end(self):
        """End of the run [s]."""
        strain = self.options.strain or self.longest * self.expected_strain
        return (strain + 0.5 * RAMP * self.expected_strain) / self.strain_rate

    @property
    def elements_across(self):
        """Elements over the width of the specimen."""
        return self.specimen.width / self.specimen.size

    def displacement(self, times):
        """Displacement of the platen [m] at times [s], in the direction in which it loads."""
        ramp = RAMP * self.expected_strain / self.strain_rate
        begun = np.minimum(times, ramp)
        return self.speed * (0.5 * begun - 0.5 * ramp / np.pi * np.sin(np.pi * begun / ramp) + np.maximum(0.0, times - ramp))

    def platen_rows(self):
        """Columns of the file of the platen's motion."""
        ramp = RAMP * self.expected_strain / self.strain_rate
        step = ramp / 20.0
        times = step * np.arange(math.ceil(self.end / step) + 2)
        speeds = 0.5 * self.speed * (1.0 - np.cos(np.pi * np.minimum(times / ramp, 1.0)))
        return {"time [s]": times, "velocity [m/s]": self.sense * speeds}

    def case(self):
        """The case, which names `specimen.geo`, `platen.csv` and, under pressure, `pressure.csv` in its folder."""
        steel = self.platens == Platens.STEEL
        materials, joints = [with_keys(self.rock.material, name="rock", regions=["rock"])], [self._joint()]
        if steel:
            materials.append(blocks.Material(name="steel", regions=list(STEEL), density=7850.0, youngs_modulus=200e9, poisson_ratio=0.3))
            joints += _steel_joints(PLATEN_FRICTION if self.options.platen_friction is None else self.options.platen_friction)
        return blocks.Case(
            title=self.title,
            mesh=blocks.Mesh(file="specimen.geo"),
            materials=materials,
            joints=joints,
            contact=self.rock.contact_for(self.specimen.size),
            motions=[blocks.Motion(name="platen", type="record", file="platen.csv")],
            boundaries=self._boundaries(),
            initial_stress=self._initial_stress(),
            blasts=[blocks.Blast(name="pressure", surface=self.pressed, table="pressure.csv")] if self.pressure else [],
            time=blocks.Time(end=self.end, history_interval=self.end / ROWS, snapshot_interval=self.end / PICTURES),
        )

    def _joint(self):
        joint = with_keys(self.rock.joint, name="rock", between=("rock", "rock"))
        if not self.is_dynamic and joint.joint_normal_damping in (None, 0.0) and joint.joint_shear_damping in (None, 0.0):
            joint.damping_ratio = max(joint.damping_ratio or 0.0, DAMPING)
            joint.joint_normal_damping = joint.joint_shear_damping = None
        if self.options.scatter_seed is not None and joint.weibull_modulus is not None:
            joint.scatter_seed = self.options.scatter_seed
        return joint

    def _boundaries(self):
        sliding = self.platens == Platens.FRICTIONLESS
        rest, moving = ("frictionless", "frictionless") if sliding else ("fixed", "prescribed")
        motion = {f"motion_{'xyz'[self.specimen.axis]}": "platen"}
        held = [blocks.Boundary(surface=name, kind="fixed" if name == "bottom" and self.specimen.axis == 0 else rest) for name in self.specimen.bottom]
        return [*held, *(blocks.Boundary(surface=name, kind=moving, **motion) for name in self.specimen.top)]

    def _initial_stress(self):
        if not self.pressure:
            return None
        return blocks.InitialStress(normal_stress=tuple(-self.pressure * share for share in self.stressed))


def _steel_joints(friction):
    """Joints in steel, which never break, and between steel and rock, which slide as Coulomb says and hardly stick."""
    steel = blocks.Joint(
        name="steel", between=("steel", "steel"), damping_ratio=DAMPING, cohesion=5e9, friction_coefficient=0.0, tensile_strength=5e9,
        fracture_energy=1e6,
    )
    ends = blocks.Joint(
        name="ends", between=("rock", "steel"), damping_ratio=DAMPING, cohesion=0.0, friction_coefficient=friction, tensile_strength=1e3,
        fracture_energy=1e-3,
    )
    return [steel, ends]


TITLES = {
    "uniaxial": "Uniaxial compression",
    "triaxial": "Triaxial compression",
    "brazilian": "Brazilian test",
    "direct-tension": "Direct tension",
    "direct-shear": "Direct shear",
    "point-load": "Point load test",
}


def _cylinder(options):
    height = options.height or 2.0 * options.diameter
    platen = 2.0 * options.size if options.platens == Platens.STEEL else 0.0
    return specimens.cylinder(options.diameter, height, options.size, options.seed, platen)


def uniaxial(rock, options):
    """A cylinder pressed along its axis, twice as high as wide."""
    return triaxial(rock, options, 0.0, "uniaxial")


def triaxial(rock, options, confinement, test="triaxial"):
    """A cylinder under pressure on all sides [Pa], then pressed along its axis. Confinement and initial stress are in equilibrium when the test begins."""
    stress = rock.strength_under(confinement)
    return Trial(
        test, rock, _cylinder(options), options, -1.0, options.platens or Platens.FRICTIONLESS, stress, (stress - confinement) / rock.youngs_modulus,
        pressure=confinement, pressed="side", stressed=(1.0, 1.0, 1.0), measures_strain=True,
    )


def direct_tension(rock, options):
    """A cylinder pulled along its axis by platens to which it is glued."""
    _refuse_platens("direct-tension", options, (Platens.HELD,))
    stress = rock.joint.tensile_strength
    return Trial(
        "direct-tension", rock, _cylinder(options), options, 1.0, Platens.HELD, stress, stress / rock.youngs_modulus, longest=3.0, measures_strain=True,
    )


def brazilian(rock, options):
    """A disc pressed over its diameter between two jaws; half as thick as wide."""
    _refuse_platens("brazilian", options, (Platens.HELD, Platens.FRICTIONLESS))
    least = np.degrees(2.0 * SHORTEST_ARC * options.size / options.diameter)
    if not least <= options.contact_angle <= WIDEST_ARC:
        raise ValueError(
            f"jaws cannot bear on an arc of {options.contact_angle:g} degrees: with elements of this size it may be {least:.3g} to {WIDEST_ARC:g} degrees"
        )
    disc = specimens.disc(options.diameter, options.height or 0.5 * options.diameter, options.size, options.seed, options.contact_angle)
    stress = rock.joint.tensile_strength
    return Trial(
        "brazilian", rock, disc, options, -1.0, options.platens or Platens.HELD, stress, 6.0 * stress / rock.youngs_modulus, longest=3.0,
    )


def point_load(rock, options):
    """A core pressed along its axis by two points; 0.8 times as high as wide."""
    _refuse_platens("point-load", options, (Platens.HELD,))
    least, most = SMALLEST_TIP * options.size, WIDEST_TIP * options.diameter
    if not least <= options.tip_radius <= most:
        raise ValueError(f"points cannot press over circles of radius {options.tip_radius:g} m: with this specimen it may be {least:.3g} to {most:.3g} m")
    core = specimens.core(options.diameter, options.height or 0.8 * options.diameter, options.size, options.seed, options.tip_radius)
    stress = rock.joint.tensile_strength
    strain = stress * core.area / (rock.youngs_modulus * options.tip_radius * core.length)
    return Trial("point-load", rock, core, options, -1.0, Platens.HELD, stress, strain, longest=12.0)


def direct_shear(rock, options, normal_stress):
    """A prism of two halves: a pressure [Pa] acts on the upper one, which is pushed along x over the lower one, by walls without friction."""
    _refuse_platens("direct-shear", options, (Platens.FRICTIONLESS,))
    box = specimens.shear_box(options.diameter, options.height or options.diameter, options.size, options.seed)
    stress = rock.joint.cohesion + rock.friction * normal_stress
    slip = 2.0 * (rock.joint.shear_fracture_energy or 0.0) / rock.joint.cohesion if rock.joint.cohesion else 0.0
    return Trial(
        "direct-shear", rock, box, options, 1.0, Platens.FRICTIONLESS, stress, stress / rock.shear_modulus + slip / box.length, longest=3.0,
        pressure=normal_stress, pressed="top", stressed=(0.0, 0.0, 1.0), ends_when_broken=False,
    )


def _refuse_platens(test, options, allowed):
    if options.platens is not None and options.platens not in allowed:
        raise ValueError(f"{test} cannot have platens {options.platens!r}; it may have: {', '.join(allowed)}")


def trial_of(test, rock, options, pressure=0.0):
    """A test by its name; `pressure` [Pa] is the confinement of a triaxial test, and the normal stress of direct shear.

    Raises ValueError for a test that there is not, or that does not go with a pressure or with these platens.
    """
    if test in UNDER_PRESSURE:
        if pressure < 0.0:
            raise ValueError(f"{test} needs a pressure of 0 or more, found {pressure:g} Pa")
        return UNDER_PRESSURE[test](rock, options, pressure)
    if test not in FREE:
        raise ValueError(f"no test {test!r}; there are: {', '.join(TITLES)}")
    if pressure:
        raise ValueError(f"{test} has no pressure; triaxial and direct-shear have one")
    return FREE[test](rock, options)


FREE = {"uniaxial": uniaxial, "brazilian": brazilian, "direct-tension": direct_tension, "point-load": point_load}
UNDER_PRESSURE = {"triaxial": triaxial, "direct-shear": direct_shear}
