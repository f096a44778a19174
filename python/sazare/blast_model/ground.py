"""Weight and stress of the ground around a blast, as a case of blocks has them."""

import math
from dataclasses import dataclass

import numpy as np

from sazare.cases import blocks

GRAVITY = 9.81  # m/s2
UP = np.array([0.0, 0.0, 1.0])  # of the pattern


@dataclass(frozen=True)
class Ground:
    """Stress at the beginning: that of the weight, and horizontal ones by their ratio to it or by two values; compression positive here."""

    depth: float = 0.0  # of the collar of the first hole below the surface of the ground [m]
    k0: float | None = None  # horizontal over vertical stress; None: nu/(1 - nu), that of ground that cannot widen
    horizontal: tuple[float, float] | None = None  # instead: the larger and the smaller horizontal stress [Pa], at all depths
    azimuth: float = 0.0  # direction of the larger one, from y (north) towards x (east) [deg]

    def ratio(self, rock):
        """Ratio of horizontal to vertical stress of a rock."""
        ratio = rock.material.poisson_ratio
        return self.k0 if self.k0 is not None else ratio / (1.0 - ratio)

    def gravity(self, frame):
        """The table [gravity] in axes of a model."""
        return blocks.Gravity(acceleration=_clean(-GRAVITY * (frame.axes @ UP)))

    def initial_stress(self, frame, rock):
        """The table [initial_stress] in axes of a model: by k0 below the surface of the ground, or by its components at the collars and how they grow."""
        if self.horizontal is None:
            return blocks.InitialStress(k0=round(self.ratio(rock), 9), datum=float(self.depth))
        weight = rock.material.density * GRAVITY
        stress, growth = self.tensor(frame, weight * self.depth), frame.axes @ np.diag(-weight * UP) @ frame.axes.T
        return blocks.InitialStress(
            normal_stress=_clean(np.diag(stress)), shear_stress=_clean([stress[0, 1], stress[1, 2], stress[2, 0]]), normal_stress_per_depth=_clean(np.diag(growth)), datum=0.0,
        )

    def tensor(self, frame, vertical):
        """Stress [Pa] at a vertical compression, in axes of the model (3, 3), tension positive, of given horizontal stresses."""
        way = math.radians(self.azimuth)
        along, across = np.array([math.sin(way), math.cos(way), 0.0]), np.array([math.cos(way), -math.sin(way), 0.0])
        larger, smaller = self.horizontal
        return frame.axes @ -(larger * np.outer(along, along) + smaller * np.outer(across, across) + vertical * np.outer(UP, UP)) @ frame.axes.T

    def at(self, depth, rock):
        """Vertical, larger and smaller horizontal compression [Pa] so far below the collars [m]."""
        vertical = rock.material.density * GRAVITY * (self.depth + depth)
        return vertical, *(self.horizontal or (self.ratio(rock) * vertical,) * 2)

    def words(self, layout, rock):
        """What was assumed, in sentences without a point at the end."""
        deepest = max(float(-(layout.frame.axes @ UP) @ end) for hole in layout.holes for end in (hole.collar, hole.toe))
        text = [f"{1e-6 * value:.3g}" for value in self.at(deepest, rock)]
        which = f"given ones, the larger to {self.azimuth:g} degrees" if self.horizontal else f"{self.ratio(rock):.3g} of the vertical" + ("" if self.k0 is not None else ", nu/(1 - nu) (--k0)")
        yield f"stress at the deepest toe {text[0]} MPa upright, {text[1]} and {text[2]} MPa level ({which}), compression, with {self.depth:g} m of ground above the collars"
        worst = max(self.at(deepest, rock)) / (rock.material.density * rock.wave_speed)
        yield f"free faces and holes are cut at the beginning, and lose their stress then: waves of up to {worst:.2g} m/s run from there (stress over density and speed of waves)"


def _clean(values):
    """Three numbers without round-off of what should be 0."""
    values = np.asarray(values, dtype=float)
    return tuple(float(value) for value in np.where(np.abs(values) < 1e-9 * max(1e-300, np.abs(values).max()), 0.0, values))
