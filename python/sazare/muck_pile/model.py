"""The case of method spheres in which the fragments of a run of blasting fly and land."""

import math
import tomllib
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sazare.blast.holes import holes_of
from sazare.cases import spheres
from sazare.intervals import fits, round_end, round_interval
from sazare.muck_pile import balls as ball
from sazare.muck_pile.bodies import Bodies, bodies_of, write_bodies
from sazare.muck_pile.elements import Elements, elements_of
from sazare.muck_pile.flight import flight_times, landing_speeds
from sazare.muck_pile.surface import Standing, ground_height

GRAVITY = 9.81  # m/s2, where the case has none
OVERLAP = 0.2  # of the radius: in contacts at the greatest speed
SHEAR = 2.0 / 7.0  # shear stiffness over normal stiffness: a solid sphere then slips and rebounds in the same time
STRAIGHT = 0.1  # extent of a row of holes across over that along it
ALONG = 0.7  # least cosine between the normal of the row and the momentum: 45 degrees
SETTLING = 5.0  # times the time of a fall from the highest loose rock to the ground, after the last has landed
FOLLOWED = 0.99  # of the mass: the fastest fines fly longer and press deeper
STEP = 0.15  # of the stability limit: piles load it more than twelve equal neighbours do
FINES = 0.01  # of the mass: the smallest fragments, which fly without what they would meet
CLASS = 4.0  # ratio of the masses in a class of fragments, each with its own stiffness: 1.6 in size
MARGIN = 1.0  # of a median sphere's diameter: nearer spheres are watched as candidates for contact
PICTURES = 50  # snapshots; up to twice as many where their interval is round
ROWS = 5  # of the history to a snapshot
ROCK = "rock.stl"


@dataclass(frozen=True)
class Options:
    """What the pile may be told. None: what suits the run. ground: height of the ground [m]. direction: of the throw, horizontal (2,). toe: how far along the
    throw the bench ends [m]. end: how long fragments are followed [s]. friction: coefficient; that of the contacts of the case. smallest: size [m] from which on fragments meet
    others. most: spheres of a fragment."""

    ground: float | None = None
    direction: tuple[float, float] | None = None
    toe: float | None = None
    end: float | None = None
    restitution: float = 0.2
    friction: float | None = None
    rolling_friction: float = 0.3
    smallest: float | None = None
    most: int = 40

    def __post_init__(self):
        if self.direction is not None and not math.hypot(*self.direction) > 0.0:
            raise ValueError("the direction of the throw has no length: --direction takes x and y, such as --direction 1 0")
        if not 0.0 < self.restitution <= 1.0:
            raise ValueError(f"the restitution must be greater than 0 and at most 1, found {self.restitution:g}")


@dataclass(frozen=True)
class Model:
    """What flies and what stands. loose (n,): which Elements are of bodies; owner: the body of each of these. fines (m,): which bodies fly without what they
    would meet, and have no balls. density [kg/m3]: that of the material of all. buried: mass [kg] of loose fragments that are taken as rock that stays, since
    they lie under the ground or within that rock. ground, toe [m]; direction (3,); gravity [m/s2]; smallest [m]: size of the least that is not among the fines."""

    elements: Elements
    loose: np.ndarray
    owner: np.ndarray
    bodies: Bodies
    fines: np.ndarray
    balls: ball.Balls
    standing: Standing
    density: float
    buried: float
    direction: np.ndarray
    direction_words: str
    ground: float
    ground_words: str
    toe: float
    gravity: float
    friction: float
    end: float
    options: Options

    @property
    def heights(self):
        """Heights [m] (m,) of the bodies above the ground."""
        return self.bodies.centre[:, 2] - self.ground

    @cached_property
    def classes(self):
        """Places of the bodies that are not fines, by classes of mass, the lightest first (list of arrays)."""
        places = np.flatnonzero(~self.fines)
        masses = self.bodies.mass[places]
        number = np.floor(np.log(masses / masses.min()) / math.log(CLASS) + 1e-9).astype(int)
        return [places[number == one] for one in np.unique(number)]

    @cached_property
    def stiffnesses(self):
        """Of each class [N/m]: fragments that land on their largest sphere press it in by OVERLAP of its radius at most, v sqrt(m/k) for linear springs; those
        of FOLLOWED of the mass of the class. Of two classes the lighter fragment is the one that gives way."""
        radii = np.zeros(len(self.bodies))
        np.maximum.at(radii, self.balls.body, self.balls.radii)
        speeds = landing_speeds(self.heights, self.bodies.velocity, self.gravity)
        needed = self.bodies.mass * (speeds / (OVERLAP * np.where(self.fines, np.inf, radii))) ** 2
        return np.maximum.accumulate([_followed(needed[one], self.bodies.mass[one]) for one in self.classes])

    def case(self, title):
        """The case, which names `bodies-N.csv` and `spheres-N.csv` of each class and, where rock stays, `rock.stl` in its folder."""
        names = [f"fragments {number}" for number in range(1, len(self.classes) + 1)]
        walls = [spheres.Wall(name="ground", material="ground", point=(0.0, 0.0, self.ground), normal=(0.0, 0.0, 1.0))]
        if self.standing:
            walls.append(spheres.Wall(name="rock that stays", material="ground", shape="mesh", file=ROCK))
        rolling, softest = self.options.rolling_friction, float(self.stiffnesses[0])
        return spheres.Case(
            title=title,
            materials=[spheres.Material(name=name, density=self.density) for name in [*names, "ground"]],
            contact=spheres.Contact(
                model="linear", restitution=self.options.restitution, friction_coefficient=self.friction, rolling_friction=rolling, twisting_friction=rolling,
                contact_stiffness=softest, contact_shear_stiffness=SHEAR * softest, margin=self._margin(),
            ),
            pairs=list(self._pairs(names)),
            spheres=[
                spheres.Sphere(name=name, material=name, source="bodies", bodies_file=f"bodies-{number}.csv", file=f"spheres-{number}.csv")
                for number, name in enumerate(names, start=1)
            ],
            walls=walls,
            gravity=spheres.Gravity(acceleration=(0.0, 0.0, -self.gravity)),
            gauges=[spheres.Gauge(name=name, group=name) for name in names],
            time=spheres.Time(end=self.end, stability_fraction=STEP, history_interval=self._interval / ROWS, snapshot_interval=self._interval),
        )

    @property
    def _interval(self):
        """Time between snapshots [s]: a round one, if the end is a whole number of these."""
        interval = round_interval(self.end / PICTURES)
        return interval if fits(interval, self.end) else self.end / PICTURES

    def _pairs(self, names):
        """Stiffness of every pair of classes but the lightest with all: that of the lighter one."""
        for number, stiffness in enumerate(self.stiffnesses.tolist()):
            for other in [*names[number:], "ground"] if number else []:
                yield spheres.Pair(between=(names[number], other), contact_stiffness=stiffness, contact_shear_stiffness=SHEAR * stiffness)

    def _margin(self):
        return float(np.clip(MARGIN * np.median(self.balls.radii) / self.balls.radii.min(), 0.1, 10.0))

    def write(self, folder, title):
        """Writes the case and what it names into a folder."""
        for number, places in enumerate(self.classes, start=1):
            write_bodies(folder / f"bodies-{number}.csv", self.bodies.of(places), self.density)
            ball.write_balls(folder / f"spheres-{number}.csv", self.balls.of(np.isin(self.balls.body, places)), self.bodies.numbers)
        if self.standing:
            self.standing.write_stl(folder / ROCK)
        (folder / "case.toml").write_text(self.case(title).to_toml(), encoding="utf-8")


def model_of(results, options=None):
    """The Model of a run of blasting that has ended (`sazare.open`). Raises as `elements_of`, and ValueError where gravity of the case is not along -z."""
    options = options or Options()
    case = tomllib.loads(results.case_text) if results.case_text else {}
    gravity = _gravity(case, results)
    elements = elements_of(results)
    direction, direction_words = _direction(results, elements, options)
    ground, words = (options.ground, "as told") if options.ground is not None else ground_height(elements, elements.stays, direction)
    stays = elements.stays | _under(elements, ground)
    if np.all(stays):
        raise ValueError(f"all that is loose lies under the ground at z = {ground:g} m: --ground Z takes a lower one")
    stays, standing, bodies, owner, fines, balls = _fit(elements, stays, ground, options)
    loose, masses = ~stays, elements.masses
    return Model(
        elements, loose, owner, bodies, fines, balls, standing, float(masses[loose].sum() / elements.volumes[loose].sum()),
        float(masses[stays & ~elements.stays].sum()), direction, direction_words, ground, words,
        _toe(elements, loose, direction, ground) if options.toe is None else options.toe,
        gravity, options.friction if options.friction is not None else _friction(case),
        _end(elements, bodies, loose, ground, gravity) if options.end is None else options.end, options,
    )


def _gravity(case, results):
    acceleration = case.get("gravity", {}).get("acceleration", [0.0, 0.0, 0.0])
    x, y, z = (float(value) for value in acceleration)
    if x == y == z == 0.0:
        return GRAVITY
    if abs(x) + abs(y) > 1e-9 * abs(z) or z > 0.0:
        raise ValueError(f"{results.path}: gravity of this case is ({x:g}, {y:g}, {z:g}) m/s2: the pile needs one along -z, or none, and then takes {GRAVITY} m/s2")
    return -z


def _friction(case):
    value = case.get("contact", {}).get("friction_coefficient")
    return 0.6 if value is None else float(value)


def _direction(results, elements, options):
    """The direction of the throw (3,), and how it was found, in words: across a straight row of holes, to the side to which the loose rock goes, or the
    direction of its horizontal momentum."""
    if options.direction is not None:
        wanted = np.array([*options.direction, 0.0])
        return wanted / np.linalg.norm(wanted), "as told"
    loose = ~elements.stays
    momentum = elements.masses[loose] @ elements.velocity[loose]
    momentum[2] = 0.0
    size = float(np.linalg.norm(momentum))
    ahead = momentum / size if size > 0.0 else np.array([1.0, 0.0, 0.0])
    across = _across_row(holes_of(results))
    if across is not None and abs(across @ ahead) > ALONG:
        return across * np.sign(across @ ahead) + 0.0, "across the row of holes"
    return ahead, "momentum of the loose rock" if size > 0.0 else "the loose rock has no horizontal momentum"


def _across_row(holes):
    """The horizontal normal (3,) of a row of two holes or more; None where they stand in no row."""
    if len(holes) < 2:
        return None
    places = np.array([0.5 * (hole.first + hole.last)[:2] for hole in holes])
    _, extent, axes = np.linalg.svd(places - places.mean(axis=0))
    return np.array([-axes[0, 1], axes[0, 0], 0.0]) if extent[0] > 0.0 and extent[1] < STRAIGHT * extent[0] else None


def _under(elements, ground):
    """Which elements belong to loose fragments whose centre of mass lies under the ground."""
    bodies, owner = bodies_of(elements, ~elements.stays)
    under = np.zeros(len(elements.stays), dtype=bool)
    under[~elements.stays] = (bodies.centre[:, 2] <= ground)[owner]
    return under


def _fit(elements, stays, ground, options):
    """What stays (n,), its surface, the bodies, the body of each loose element, which bodies are fines, and the balls of the others. Fragments whose spheres
    all lie within the rock that stays, or under the ground, belong to it; those that are pressed so much that no sphere has room are fines."""
    while True:
        standing = Standing(elements, stays, ground)
        bodies, owner = bodies_of(elements, ~stays)
        fines = _fines(bodies, options.smallest)
        met = ~stays
        met[met] = ~fines[owner]
        balls, full = ball.balls_in(elements, met, owner[~fines[owner]], options.most)
        free = (balls.centres[:, 2] > ground) & ~standing.holds(balls.centres)
        homeless = np.setdiff1d(np.flatnonzero(~fines), balls.body[free])
        if not len(homeless):
            break
        stays = stays.copy()
        stays[np.flatnonzero(~stays)[np.isin(owner, homeless)]] = True
        if np.all(stays):
            raise ValueError("all that is loose lies within the rock that stays, so there is no pile")
    balls, full = balls.of(free), full[free]
    room = np.minimum(standing.distance(balls.centres), balls.centres[:, 2] - ground)
    fitted = ball.fitted(balls, full, room)
    fines = np.ones(len(bodies), dtype=bool)
    fines[fitted.body] = False
    return stays, standing, bodies, owner, fines, fitted


def _fines(bodies, smallest):
    """Which bodies (m,) are fines: those below a size [m], or where it is None the smallest that together have FINES of the mass at most."""
    if smallest is not None:
        fines = bodies.sizes < smallest
        if np.all(fines):
            raise ValueError(f"no fragment is as large as {smallest:g} m: the largest has {bodies.sizes.max():.3g} m")
        return fines
    order = np.argsort(bodies.volume, kind="stable")
    fines = np.zeros(len(bodies), dtype=bool)
    fines[order] = np.cumsum(bodies.mass[order]) <= FINES * bodies.mass.sum()
    return fines


def _toe(elements, loose, direction, ground):
    """The farthest that loose rock above the ground stood along the throw before the blast [m]."""
    start = elements.start[loose]
    above = start.mean(axis=1)[:, 2] > ground
    return float((start[above if np.any(above) else slice(None)] @ direction).max())


def _end(elements, bodies, loose, ground, gravity):
    """When FOLLOWED of the mass have landed without what they meet, and SETTLING after that [s]; rounded up."""
    highest = float(elements.corners[loose][:, :, 2].max()) - ground
    flight = _followed(flight_times(bodies.centre[:, 2] - ground, bodies.velocity, gravity), bodies.mass)
    return round_end(flight + SETTLING * math.sqrt(2.0 * max(highest, 0.0) / gravity), PICTURES)[0]


def _followed(values, masses):
    """The least value that FOLLOWED of the mass does not exceed."""
    order = np.argsort(values)
    share = np.cumsum(masses[order]) / masses.sum()
    return float(values[order][np.searchsorted(share, FOLLOWED)])
