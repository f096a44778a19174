"""Limit equilibrium of slopes and Newmark's sliding block: the estimates that engineers put beside a dynamic analysis.

Ground is homogeneous, of cohesion c [Pa], friction angle [degrees] and density [kg/m3]; heights and lengths in m. The slope rises from
its toe at (0, 0) to its crest at (height/tan, height); before the toe and behind the crest the surface is level.
"""

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, minimize

GRAVITY = 9.81  # m/s2
SLICES = 60


@dataclass(frozen=True)
class Slope:
    height: float  # m
    angle: float  # degrees
    cohesion: float  # Pa
    friction_angle: float  # degrees
    density: float  # kg/m3
    firm_base: float = np.inf  # depth of firm ground below the toe [m]

    def surface(self, x):
        """Height of the surface at x [m]."""
        return np.clip(np.asarray(x) * np.tan(np.radians(self.angle)), 0.0, self.height)


def bishop(slope, center, radius, seismic=0.0):
    """Safety factor of a circle by Bishop's simplified method; the horizontal force is `seismic` times the weight, out of the slope.

    None where the circle cuts no body that can slide. Bishop, Geotechnique 5 (1955) 7-17.
    """
    xc, yc = center
    if yc <= slope.height or yc - radius < -slope.firm_base:
        return None
    x = np.linspace(xc - radius, xc + radius, 2001)[1:-1]
    bottom = yc - np.sqrt(radius**2 - (x - xc) ** 2)
    inside = np.flatnonzero(slope.surface(x) > bottom)
    if inside.size < 3 or inside[0] == 0 or inside[-1] == x.size - 1 or np.any(np.diff(inside) > 1):
        return None
    edges = np.linspace(x[inside[0]], x[inside[-1]], SLICES + 1)
    width = np.diff(edges)
    middle = 0.5 * (edges[1:] + edges[:-1])
    bottom = yc - np.sqrt(radius**2 - (middle - xc) ** 2)
    tall = np.maximum(slope.surface(middle) - bottom, 0.0)
    weight = slope.density * GRAVITY * tall * width
    alpha = np.arcsin((middle - xc) / radius)
    tangent = np.tan(np.radians(slope.friction_angle))
    driving = np.sum(weight * np.sin(alpha) + seismic * weight * (yc - bottom - 0.5 * tall) / radius)
    if driving <= 0.0:
        return None
    factor = 1.0
    for _ in range(200):
        m = np.cos(alpha) + np.sin(alpha) * tangent / factor
        if np.any(m < 0.1):
            return None
        new = np.sum((slope.cohesion * width + weight * tangent) / m) / driving
        if abs(new - factor) < 1e-10 * new:
            return new
        factor = new
    return factor


def safety_factor(slope, seismic=0.0):
    """The smallest safety factor of all circles, and the circle: (factor, center, radius)."""
    run = slope.height / np.tan(np.radians(slope.angle))

    def value(parameters):
        found = bishop(slope, parameters[:2], parameters[2], seismic)
        return 1e3 if found is None else found

    starts = [
        (fx * run, fy * slope.height, min(np.hypot((fx - tx) * run, fy * slope.height) * (1 + deep), fy * slope.height + slope.firm_base))
        for fx in (-0.2, 0.2, 0.5, 0.8)
        for fy in (1.3, 1.8, 2.6)
        for tx in (0.0, -0.3)
        for deep in (0.0, 0.05, 0.15)
    ]
    best = sorted(starts, key=value)[:5]
    found = min((minimize(value, start, method="Nelder-Mead", options={"maxiter": 600, "xatol": 1e-4, "fatol": 1e-7}) for start in best),
                key=lambda result: result.fun)
    return found.fun, tuple(found.x[:2]), found.x[2]


def yield_coefficient(slope):
    """Horizontal acceleration over gravity at which the slope begins to slide [-]."""
    return brentq(lambda seismic: safety_factor(slope, seismic)[0] - 1.0, 0.0, 1.5, xtol=1e-3)


def sliding_block(acceleration, step, yield_acceleration):
    """Displacement [m] of a block on ground that moves with an acceleration (n,) [m/s2], sampled every `step` [s].

    The block slides one way only, while it is faster than the ground, held back by `yield_acceleration` [m/s2]. Exact for an
    acceleration that is constant between samples. Newmark, Geotechnique 15 (1965) 139-160.
    """
    speed = distance = 0.0
    for value in np.asarray(acceleration, dtype=float):
        change = value - yield_acceleration
        if speed == 0.0 and change <= 0.0:
            continue
        after = speed + change * step
        moving = step if after >= 0.0 else speed / -change
        distance += speed * moving + 0.5 * change * moving**2
        speed = max(after, 0.0)
    return distance
