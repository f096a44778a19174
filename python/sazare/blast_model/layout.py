"""The rock around a pattern: a bench with a free face, or a block with one free surface, in axes of its own.

Axes of the model: z points out of the surface in which the holes begin, x to the free face of a bench, and the collar of the first hole is the origin.
"""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sazare.blast_model.pattern import Hole, Pattern
from sazare.intervals import rounded_up

GROWTH = 0.5  # of the size of elements per distance from a wall
FEWEST_AROUND = 8  # faces around a hole
FILLING = 7.5  # elements per cube of their size
MOST_ELEMENTS, MANY_ELEMENTS = 5e6, 1e6  # refused beyond, and told beyond
LEANING = 0.02  # of the horizontal part of a hole's direction, from which it is inclined


@dataclass(frozen=True)
class Options:
    """What may be told besides the pattern; lengths in m. None: what suits the pattern."""

    burden: float | None = None  # from the collars of the front row to the crest of a bench; None without rows: a block without a bench
    height: float | None = None  # of the bench
    face_angle: float = 90.0  # of the free face from the horizontal [deg]
    azimuth: float | None = None  # to which the free face looks, from y towards x [deg]
    margin: float | None = None  # of rock around the holes
    size: float | None = None  # of elements far away
    around: int = FEWEST_AROUND  # faces around a hole
    block: bool = False  # no bench


@dataclass(frozen=True)
class Frame:
    """Axes of the model in those of the pattern."""

    origin: np.ndarray  # (3,) [m]
    axes: np.ndarray  # (3, 3): its rows are x, y, z of the model

    def place(self, point):
        """A point of the pattern in axes of the model [m]; places that should be 0 are."""
        found = self.axes @ (np.asarray(point) - self.origin)
        return np.where(np.abs(found) < 1e-9, 0.0, found)

    def back(self, point):
        """A point of the model in axes of the pattern [m]."""
        return self.origin + self.axes.T @ np.asarray(point)


@dataclass(frozen=True)
class Bench:
    """Outline of a bench in its axes [m]."""

    crest: float  # x of the upper edge of the free face
    toe: float  # x of its lower edge
    height: float  # of the face

    def distance(self, point):
        """Distance of a point from the plane of the face, positive in the rock [m]."""
        run = self.toe - self.crest
        return ((self.crest - point[0]) * self.height - run * point[2]) / math.hypot(run, self.height)


@dataclass(frozen=True)
class Layout:
    """A pattern with the rock around it."""

    pattern: Pattern
    options: Options
    frame: Frame
    bench: Bench | None
    rows: list[list[int]]  # holes by place in the pattern, from the free face back
    margin: float  # m
    far: float  # size of elements far away [m]

    @cached_property
    def holes(self):
        """Holes in axes of the model."""
        place = self.frame.place
        return [Hole(hole.name, place(hole.collar), place(hole.toe), hole.diameter, hole.line) for hole in self.pattern.holes]

    def near(self, hole):
        """Size of elements at the wall of a hole: a side of the polygon that stands for the circle [m]."""
        return 2.0 * polygon_radius(hole.diameter, self.options.around) * math.sin(math.pi / self.options.around)

    @property
    def lower(self):
        """Least x, y, z of the rock [m]."""
        low = np.min([np.minimum(hole.collar, hole.toe) for hole in self.holes], axis=0) - self.margin
        if self.bench:
            low[2] = min(low[2], -self.bench.height - self.margin)
        return low

    @property
    def upper(self):
        """Greatest x, y, z of the rock [m]."""
        high = np.max([np.maximum(hole.collar, hole.toe) for hole in self.holes], axis=0) + self.margin
        high[2] = 0.0
        if self.bench:
            high[0] = self.bench.toe + self.margin
        return high

    @property
    def profile(self):
        """Corners (x, z) of the section of the rock across its length, clockwise seen along y [m]."""
        (x0, _, z0), (x1, _, z1) = self.lower, self.upper
        if self.bench is None:
            return [(x0, z0), (x1, z0), (x1, z1), (x0, z1)]
        floor = -self.bench.height
        return [(x0, z0), (x1, z0), (x1, floor), (self.bench.toe, floor), (self.bench.crest, z1), (x0, z1)]

    @property
    def convex_parts(self):
        """The rock, with its holes, as convex bodies side by side, each by the planes (k, 4) around it: n, d with n . x <= d in the body."""
        low, high = self.lower, self.upper
        box = np.concatenate([np.column_stack([np.eye(3), high]), np.column_stack([-np.eye(3), -low])])
        if self.bench is None:
            return [box]
        floor, run = -self.bench.height, self.bench.toe - self.bench.crest
        slope = np.array([self.bench.height, 0.0, run, self.bench.crest * self.bench.height])
        return [np.concatenate([box, [[0.0, 0.0, 1.0, floor]]]), np.concatenate([box, [[0.0, 0.0, -1.0, -floor], slope]])]

    @property
    def volume(self):
        """Volume of the rock without the holes [m3]; as exact as the mesh, whose holes are prisms of the section of their circles."""
        x, z = np.array(self.profile).T
        section = 0.5 * abs(x @ np.roll(z, -1) - z @ np.roll(x, -1))
        return float(section * (self.upper[1] - self.lower[1]) - self.volume_of_holes)

    @property
    def volume_of_holes(self):
        """Volume of the holes [m3]."""
        return float(sum(0.25 * np.pi * hole.diameter**2 * (hole.toe[2] / hole.direction[2]) for hole in self.holes))

    @property
    def burdens(self):
        """Distances of each hole, at its collar and at the floor or its toe, from the face, or for later rows from the row before: (least, largest) [m]."""
        if self.bench is None:
            return [None] * len(self.holes)
        found = [None] * len(self.holes)
        for number, row in enumerate(self.rows):
            for place in row:
                hole = self.holes[place]
                depth = min(1.0, self.bench.height / -hole.toe[2])
                ends = [hole.collar, hole.collar + depth * (hole.toe - hole.collar)]
                if number == 0:
                    distances = [self.bench.distance(end) for end in ends]
                else:
                    before = np.mean([self.holes[other].collar[0] for other in self.rows[number - 1]])
                    distances = [before - hole.collar[0]]
                found[place] = (float(min(distances)), float(max(distances)))
        return found

    @property
    def spacings(self):
        """Mean distance of each hole from its neighbours in the row of a bench [m]; None for one without."""
        found = [None] * len(self.holes)
        if self.bench is None:
            return found
        for row in self.rows:
            along = [self.holes[place].collar[1] for place in row]
            for i, place in enumerate(row):
                beside = [abs(along[j] - along[i]) for j in (i - 1, i + 1) if 0 <= j < len(row)]
                found[place] = float(np.mean(beside)) if beside else None
        return found

    @property
    def rock_broken(self):
        """Burden x spacing x height of the bench, of all holes [m3]; None where there is no bench or no spacing."""
        if self.bench is None or None in self.spacings:
            return None
        return float(sum(np.mean(burden) * spacing for burden, spacing in zip(self.burdens, self.spacings)) * self.bench.height)


def polygon_radius(diameter, corners):
    """Radius of the corners of a regular polygon with the area of a circle [m]."""
    return 0.5 * diameter * math.sqrt(2.0 * math.pi / (corners * math.sin(2.0 * math.pi / corners)))


def layout_of(pattern, options):
    """The rock around a pattern. Raises ValueError where holes and rock do not go together."""
    frame = _block_frame(pattern) if options.block else _bench_frame(pattern, options)
    _check_collars(pattern, frame, options.block)
    collars = np.array([frame.place(hole.collar) for hole in pattern.holes])
    rows = _rows(collars)
    bench = None if options.block else _bench(pattern, options, frame, collars, rows)
    layout = Layout(pattern, options, frame, bench, rows, *_lengths(pattern, options, bench, collars))
    _check_inside(layout)
    _check_size(layout)
    return layout


def _block_frame(pattern):
    """z is the axis of the pattern that is nearest to the direction against which the holes run."""
    mean = -np.mean([hole.direction for hole in pattern.holes], axis=0)
    axis = int(np.argmax(np.abs(mean)))
    outward = np.zeros(3)
    outward[axis] = math.copysign(1.0, mean[axis])
    x = np.array([1.0, 0.0, 0.0]) if axis == 2 else np.cross([0.0, 0.0, 1.0], outward)
    return Frame(pattern.holes[0].collar, np.array([x, np.cross(outward, x), outward]))


def _bench_frame(pattern, options):
    angle = math.radians(azimuth_of(pattern) if options.azimuth is None else options.azimuth)
    x = np.array([math.sin(angle), math.cos(angle), 0.0]).round(15)
    return Frame(pattern.holes[0].collar, np.array([x, [-x[1], x[0], 0.0], [0.0, 0.0, 1.0]]))


def azimuth_of(pattern):
    """Where the free face looks if nobody says so [deg], from y towards x: where inclined holes lean; else across the rows, to the side that fires first; else
    to the right of the way from the first hole to the last; x where there is one hole."""
    lean = np.mean([hole.direction[:2] for hole in pattern.holes], axis=0)
    collars = np.array([hole.collar[:2] for hole in pattern.holes])
    along = collars[-1] - collars[0]
    if len(collars) > 2:
        centred = collars - collars.mean(axis=0)
        direction = np.linalg.svd(centred)[2][0]
        along = direction if direction @ along >= 0.0 else -direction
    across = np.array([along[1], -along[0]])
    if np.linalg.norm(lean) > LEANING:
        across = lean
    elif not across.any():
        return 90.0
    else:
        first = min(deck.delay for deck in pattern.decks)
        early = np.mean([deck.hole.collar[:2] for deck in pattern.decks if deck.delay == first], axis=0) - collars.mean(axis=0)
        if early @ across < -1e-6 * np.linalg.norm(across):
            across = -across
    return round(math.degrees(math.atan2(across[0], across[1])), 6) % 360.0


def _check_collars(pattern, frame, block):
    for hole in pattern.holes:
        height, down = frame.place(hole.collar)[2], -(frame.axes @ hole.direction)[2]
        if abs(height) > hole.diameter:
            where = "the free surface of the model, a plane" if block else "the top of the bench, which is level"
            raise ValueError(
                f"{pattern.path}:{hole.line}: error: the collar of hole {hole.name} is {abs(height):.4g} m {'above' if height > 0.0 else 'below'} that of hole "
                f"{pattern.holes[0].name}\n"
                f"      help: all holes begin in {where}: move the collars along their holes to one level, and give top and bottom from there"
            )
        if down < 0.2:
            raise ValueError(
                f"{pattern.path}:{hole.line}: error: hole {hole.name} does not go into the rock: its direction is {math.degrees(math.asin(down)):.3g} degrees below the "
                "surface in which it begins\n"
                "      help: toes lie in the rock, at least 12 degrees from the surface; --block is for holes that are not those of a bench"
            )


def _rows(collars):
    """Holes by rows, from the greatest x on: a row ends where the next hole is further back than half of the way to its nearest neighbour."""
    count = len(collars)
    if count == 1:
        return [[0]]
    apart = np.linalg.norm(collars[:, None] - collars[None], axis=2) + np.diag(np.full(count, np.inf))
    gap = 0.5 * apart.min()
    order = sorted(range(count), key=lambda place: -collars[place][0])
    rows = [[order[0]]]
    for before, place in zip(order, order[1:]):
        if collars[before][0] - collars[place][0] > gap:
            rows.append([])
        rows[-1].append(place)
    return [sorted(row, key=lambda place: collars[place][1]) for row in rows]


def _bench(pattern, options, frame, collars, rows):
    burden = options.burden
    if burden is None and len(rows) > 1:
        middle = [np.mean(collars[row, 0]) for row in rows]
        burden = (middle[0] - middle[-1]) / (len(rows) - 1)
    if burden is None:
        raise ValueError(
            f"{pattern.path}: error: nothing says how far the free face is from these holes, which stand in one row\n"
            "      help: --burden M is the distance from the collars of the front row to the crest of the bench; --block makes a block without a bench"
        )
    depths = [-frame.place(hole.toe)[2] for hole in pattern.holes]
    height = options.height or min(depths)
    crest = max(collars[:, 0]) + burden
    return Bench(float(crest), float(crest + height * math.tan(math.radians(90.0 - options.face_angle))), float(height))


def _lengths(pattern, options, bench, collars):
    """Margin, and size of elements far away [m]."""
    if bench:
        reach = bench.crest - max(collars[:, 0])
    else:
        reach = 0.5 * max(hole.length for hole in pattern.holes)
    margin = options.margin or 2.0 * reach
    far = options.size or 0.25 * (reach if bench else margin)
    widest = max(hole.diameter for hole in pattern.holes)
    if margin < 2.0 * widest:
        raise ValueError(f"{pattern.path}: error: {margin:g} m of rock around holes {widest:g} m wide are too few\n      help: --margin {20.0 * widest:.3g} is 20 diameters")
    return float(margin), float(far)


def estimated_elements(layout, far=None):
    """About how many elements a mesh of the rock without joints has, whose size far from the holes is `far` [m]: that of the layout.

    FILLING elements per cube of their size, which grows by GROWTH with the distance from the walls of holes; of five meshes of 6000 to 74 000 elements it was wrong
    by 30 % at most. Finer zones that overlap count twice.
    """
    far = layout.far if far is None else far
    count = layout.volume / far**3
    for hole in layout.holes:
        near = min(layout.near(hole), far)
        reach = np.linspace(0.0, (far - near) / GROWTH, 2001)
        around = 2.0 * np.pi * (0.5 * hole.diameter + reach) * hole.length
        count += float(np.sum(around * ((near + GROWTH * reach) ** -3 - far**-3)) * (reach[1] - reach[0]))
    return FILLING * count


def _check_size(layout):
    """Raises ValueError where elements are too large for the rock, or too many."""
    path, far = layout.pattern.path, layout.far
    extent = layout.upper - layout.lower
    parts = [("the rock", 3.0, float(extent.min())), ("the rock around the holes", 2.0, layout.margin)]
    if layout.bench:
        parts += [("the bench", 3.0, layout.bench.height), ("the burden", 2.0, layout.bench.crest - max(hole.collar[0] for hole in layout.holes))]
    name, over, length = min(parts, key=lambda part: part[2] / part[1])
    if far > length / over * (1.0 + 1e-9):
        raise ValueError(f"{path}: error: elements of {far:.3g} m are too large: {name} is {length:.3g} m\n      help: --size {_rounded_down(length / over)} or less")
    count = estimated_elements(layout)
    if count > MOST_ELEMENTS:
        raise ValueError(f"{path}: error: elements of {far:.3g} m would be about {count:.2g}, more than the {MOST_ELEMENTS:.0e} that a run can have\n      help: {_enough(layout, length / over)}")


def _enough(layout, largest):
    """What to do against too many elements."""
    if estimated_elements(layout, largest) > MOST_ELEMENTS:
        return "most of them are around the holes: fewer holes, or a smaller --around"
    low, high = math.log(layout.far), math.log(largest)
    for _ in range(40):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if estimated_elements(layout, math.exp(middle)) > MOST_ELEMENTS else (low, middle)
    return f"--size {rounded_up(math.exp(high), 2):g} has fewer"


def _rounded_down(length):
    unit = 10.0 ** (math.floor(math.log10(length)) - 1)
    return f"{unit * math.floor(length / unit + 1e-9):.2g}"


def _check_inside(layout):
    if layout.bench is None:
        return
    for hole in layout.holes:
        floor = min(1.0, layout.bench.height / -hole.toe[2])
        for end, name in ((hole.collar, "collar"), (hole.collar + floor * (hole.toe - hole.collar), "toe" if floor == 1.0 else "floor")):
            burden = layout.bench.distance(end)
            if burden < 2.0 * hole.diameter:
                where = f"{-burden:.3g} m in front of" if burden < 0.0 else f"{burden:.3g} m from"
                raise ValueError(
                    f"{layout.pattern.path}:{hole.line}: error: hole {hole.name} is outside of the bench: at its {name} it is {where} the free face\n"
                    "      help: check collar and toe, --burden, --face-angle and --azimuth, the direction to which the face looks"
                )
