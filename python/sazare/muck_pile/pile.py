"""The muck pile: its profile along the throw, its bulk volume and swell, and the slope of its front."""

from dataclasses import dataclass
from functools import cached_property
from math import atan, degrees

import numpy as np

from sazare.muck_pile.heights import axes_of, heights_of_balls, heights_of_triangles

FINE = 0.25  # size of the cells over the median size of fragments by mass
MOST_CELLS = 4e6  # under spheres: larger cells are taken where there would be more
FRONT = (0.2, 0.8)  # of the highest mean height: between them the slope of the front is fitted


@dataclass(frozen=True)
class Slice:
    """A part of the pile along the throw: where its middle is [m], the highest and the mean height [m] of the pile over what it lies on, the latter over the
    width that it covers, that of its top over the ground [m], and its bulk volume [m3]."""

    along: float
    highest: float
    mean: float
    top: float
    volume: float


class Pile:
    """The pile of bodies that have Landed, over the ground and the rock that stays. size: median size [m] by mass.

    covered (m,): which bodies lie under rock that stays and overhangs, or in it. They belong to no pile that can be seen from above: bulk and solid volume
    are without them, and without what is still `flying` (m,).
    """

    def __init__(self, model, landed, flying, size):
        self.width, self.ground = size, model.ground
        balls = landed.balls
        cell = max(FINE * size, float(np.sqrt(np.pi * np.sum(balls.radii**2) / MOST_CELLS)))
        self.rock = heights_of_triangles(model.standing.triangles, model.direction, cell)
        places = np.floor(balls.centres @ axes_of(model.direction) / cell).astype(int)
        under = balls.centres[:, 2] < self.rock.at(places, -np.inf)
        volumes = balls.radii**3
        count = len(model.bodies)
        self.covered = np.bincount(balls.body, under * volumes, count) > 0.5 * np.bincount(balls.body, volumes, count)
        self.seen = ~self.covered & ~model.fines & ~flying
        self.solid = float(model.bodies.volume[self.seen].sum())
        top = self.seen[balls.body]
        self.heights = heights_of_balls(balls.centres[top], balls.radii[top], model.direction, cell)
        base = np.maximum(self.rock.at(self.heights.cells, model.ground), model.ground)
        self.thickness = np.maximum(self.heights.tops - base, 0.0)

    @property
    def bulk(self):
        """Volume [m3] of the vertical columns from the highest sphere down to the ground or the rock that stays."""
        return float(self.thickness.sum() * self.heights.size**2)

    @property
    def swell(self):
        """Bulk volume over the solid volume of the fragments; nan where no pile is seen."""
        return self.bulk / self.solid if self.solid > 0.0 else float("nan")

    @cached_property
    def slices(self):
        """The pile in slices as long as the median fragment (list of Slice), those that it covers."""
        size = self.heights.size
        number = np.floor((self.heights.cells[:, 0] + 0.5) * size / self.width).astype(int)
        found = []
        for one in np.unique(number):
            own = (number == one) & (self.thickness > 0.0)
            if not np.any(own):
                continue
            thick = self.thickness[own]
            top = float(self.heights.tops[own].max()) - self.ground
            found.append(Slice((one + 0.5) * self.width, float(thick.max()), float(thick.mean()), top, float(thick.sum() * size**2)))
        return found

    @property
    def height(self):
        """The highest thickness [m]."""
        return float(self.thickness.max(initial=0.0))

    @cached_property
    def repose(self):
        """Slope [deg] of the front of the pile, from its highest slice on along the throw: a line through the mean heights between FRONT of the highest; None
        where fewer than three slices are there."""
        if len(self.slices) < 3:
            return None
        means = np.array([one.mean for one in self.slices])
        places = np.array([one.along for one in self.slices])
        crest = int(np.argmax(means))
        front = slice(crest, None)
        within = (means[front] >= FRONT[0] * means[crest]) & (means[front] <= FRONT[1] * means[crest])
        ended = np.flatnonzero(means[front] < FRONT[0] * means[crest])
        if len(ended):
            within[ended[0] :] = False
        if np.sum(within) < 3:
            return None
        fall = -np.polyfit(places[front][within], means[front][within], 1)[0]
        return degrees(atan(fall)) if fall > 0.0 else None
