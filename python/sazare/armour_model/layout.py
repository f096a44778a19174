"""Where the units of a layer stand on a slope: the grid, the places and how many there is room for."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from sazare.armour_model.solids import Solid
from sazare.armour_model.units import Kind

STONE = 0.1  # mass of a stone of the underlayer over that of a unit
SPREAD = 0.15  # by which the radii of these stones differ from their mean, over it
EPS = 1e-9


@dataclass(frozen=True)
class Slope:
    """A straight slope: level of its toe and of its crest [m], cotangent of its angle, and its width along the shore [m], along which it repeats.

    The toe is the line x = 0, z = toe; x goes landward, y along the shore, z up.
    """

    toe: float
    crest: float
    cot: float
    width: float

    def __post_init__(self):
        if not self.crest > self.toe:
            raise ValueError(f"the crest at {self.crest:g} m is not above the toe at {self.toe:g} m")

    @property
    def length(self):
        """From toe to crest [m]."""
        return (self.crest - self.toe) * math.hypot(1.0, self.cot)

    @property
    def up(self):
        """Up the slope (3,)."""
        return np.array([self.cot, 0.0, 1.0]) / math.hypot(1.0, self.cot)

    @property
    def normal(self):
        """Out of the slope (3,)."""
        return np.array([-1.0, 0.0, self.cot]) / math.hypot(1.0, self.cot)

    def place(self, along, shore, out):
        """Points (n, 3) [m] a way along the slope from the toe, along the shore, and out of it, each (n,)."""
        return np.array([0.0, 0.0, self.toe]) + np.outer(along, self.up) + np.outer(shore, (0.0, 1.0, 0.0)) + np.outer(out, self.normal)


@dataclass(frozen=True)
class Rules:
    """How units are placed. number: of units, None for as many as there is room for; layers: None for those of the kind; packing: N D_n^2 / A, None for that of
    the kind; grid: distances along the shore and up the slope [m] instead of it; orientation: "random" or "rule"; seed: of what is random; underlayer: whether
    fixed stones are under the units."""

    number: int | None = None
    layers: int | None = None
    packing: float | None = None
    grid: tuple[float, float] | None = None
    orientation: str = "random"
    seed: int = 1
    underlayer: bool = True


@dataclass(frozen=True)
class Layout:
    """Units of a kind on a slope. solid: of one unit, in its true size. Raises ValueError where they do not fit."""

    slope: Slope
    kind: Kind
    solid: Solid
    rules: Rules

    def __post_init__(self):
        if self.columns < 2:
            raise ValueError(f"a width of {self.slope.width:g} m has room for one unit of D_n = {self.size:.4g} m only: --width {2.0 * self.wanted[0]:.3g} or more has room for two beside each other")
        if self.rows_with_room < 1:
            raise ValueError(f"no unit fits: the slope is {self.slope.length:.4g} m long, and one row of units with D_n = {self.size:.4g} m takes {self.distances[1]:.3g} m: raise --crest, or take smaller units")
        if self.rules.number is not None and self.rules.number > self.room:
            need = math.ceil(self.rules.number / (self.columns * self.layers)) * self.distances[1] * self.slope.up[2] + self.slope.toe
            raise ValueError(
                f"{self.rules.number} units do not fit: the slope has room for {self.room}, in {self.layers} layers of {self.rows_with_room} rows of {self.columns}; "
                f"for {self.rules.number} the crest would be at {need:.4g} m"
            )

    @cached_property
    def volume(self):
        """Of a unit [m3]."""
        return self.solid.volume

    @property
    def size(self):
        """The nominal diameter D_n [m]."""
        return self.volume ** (1.0 / 3.0)

    @property
    def layers(self):
        """Number of layers."""
        return self.rules.layers or self.kind.layers

    @property
    def packing(self):
        """N D_n^2 / A of the design."""
        return self.layers * self.size**2 / (self.distances[0] * self.distances[1])

    @property
    def thickness(self):
        """Of all layers, n k D_n [m]."""
        return self.layers * self.kind.layer_coefficient * self.size

    @property
    def porosity(self):
        """n = 1 - N V / (A t) of the design."""
        return 1.0 - self.packing / (self.layers * self.kind.layer_coefficient)

    @cached_property
    def wanted(self):
        """Distances along the shore and up the slope [m], before a whole number of columns is made of it."""
        if self.rules.grid:
            return self.rules.grid
        packing = self.rules.packing or self.kind.packing_density(self.layers)
        area = self.layers * self.size**2 / packing  # of a unit of one layer
        shore = math.sqrt(2.0 * area / math.sqrt(3.0))  # rows that are shifted by half a distance: all six neighbours are as near
        return shore, area / shore

    @property
    def columns(self):
        """Units of a row."""
        ratio = self.slope.width / self.wanted[0]
        return math.floor(ratio + EPS) if self.rules.grid else round(ratio)

    @property
    def distances(self):
        """Along the shore and up the slope [m], so that the width is a whole number of the first; without a grid their product is that which was wanted."""
        shore = self.slope.width / max(self.columns, 1)
        return shore, self.wanted[1] if self.rules.grid else self.wanted[0] * self.wanted[1] / shore

    @property
    def rows_with_room(self):
        """Rows that fit onto the slope."""
        return math.floor(self.slope.length / self.distances[1] + EPS)

    @property
    def room(self):
        """Units that fit onto the slope."""
        return self.rows_with_room * self.columns * self.layers

    @property
    def number(self):
        """Of units."""
        return self.rules.number or self.room

    @property
    def area(self):
        """Of the slope that the units cover [m2]."""
        return self.number * self.distances[0] * self.distances[1] / self.layers

    @property
    def stone(self):
        """Mean diameter of the stones under the units [m]: spheres of a tenth of their volume; 0 without."""
        return (6.0 / math.pi * STONE * self.volume) ** (1.0 / 3.0) if self.rules.underlayer else 0.0

    @cached_property
    def order(self):
        """Layer, row and column of the units (n, 3): layer by layer, from the toe up; the row that is not full is the last one of each layer."""
        row, layer, column = np.unravel_index(np.arange(self.number), (self.rows_with_room, self.layers, self.columns))
        rows = np.column_stack([layer, row, column])
        return rows[np.lexsort(rows.T[::-1])]

    @cached_property
    def places(self):
        """Centres of the units (n, 3) [m] as they are designed. They are lowered from there, or lifted, until they touch."""
        layer, row, column = self.order.T
        shore, up = self.distances
        out = self.stone + (layer + 0.5) * self.kind.layer_coefficient * self.size
        return self.slope.place((row + 0.5) * up, (column + 0.25 + 0.5 * ((row + layer) % 2)) * shore, out)

    @cached_property
    def turns(self):
        """Rotation vectors of the units (n, 3) [rad]. By rule a unit stands on the slope with its own z out of it, in every other layer upside down, and is
        turned by half a turn in every other row."""
        if self.rules.orientation == "random":
            return Rotation.random(self.number, random_state=np.random.default_rng(self.rules.seed)).as_rotvec()
        layer, row, _ = self.order.T
        frame = Rotation.from_matrix(np.array([self.slope.up, np.cross(self.slope.normal, self.slope.up), self.slope.normal]).T)
        upside = Rotation.from_rotvec(np.outer((layer % 2) * np.pi, (1.0, 0.0, 0.0)))
        return (frame * Rotation.from_rotvec(np.outer((row % 2) * np.pi, (0.0, 0.0, 1.0))) * upside).as_rotvec()

    @cached_property
    def underlayer(self):
        """Radii and centres (n, 4) [m] of the stones under the units, which lie on the slope, as far as a D_n beyond the units; none without an underlayer."""
        if not self.rules.underlayer:
            return np.zeros((0, 4))
        pitch = (1.0 + SPREAD) * self.stone
        columns = math.floor(self.slope.width / pitch + EPS)
        end = min(math.ceil(self.number / (self.columns * self.layers)) * self.distances[1] + self.size, self.slope.length)
        rows = math.ceil(end / (pitch * math.sqrt(3.0) / 2.0))
        row, column = (part.ravel() for part in np.mgrid[0:rows, 0:columns])
        radii = self.stone / 2.0 * np.random.default_rng(self.rules.seed).uniform(1.0 - SPREAD, 1.0 + SPREAD, len(row))
        shore = self.slope.width / columns
        along = (row * math.sqrt(3.0) / 2.0 + 0.5) * pitch
        return np.column_stack([radii, self.slope.place(along, (column + 0.25 + 0.5 * (row % 2)) * shore, radii)])

    @cached_property
    def toe(self):
        """Radii and centres (n, 4) [m] of a row of stones of D_n on the ground before the lowest units."""
        count = math.floor(self.slope.width / self.size + EPS)
        foot = self.places[:, 0].min() - self.solid.mean_half_width - self.size / 2.0
        shore = (np.arange(count) + 0.5) * self.slope.width / count
        radius = np.full(count, self.size / 2.0)
        return np.column_stack([radius, np.full(count, foot), shore, self.slope.toe + radius])
