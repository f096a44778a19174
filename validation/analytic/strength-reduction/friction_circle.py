"""Taylor's stability numbers by his friction circle, computed anew: c/(gamma H) at which a slope of cohesive ground just stands.

On a circle through the toe act the weight, the cohesion (c times the chord, along it, at R arc/chord from the centre) and a reaction that touches
the circle of radius K R sin(phi) about the same centre; K = (k^2 - 1)/(k^2 cos y), k = pi/(2 y), follows from a pressure on the arc of half the
central angle y that is a half wave of a sine. Taylor, Journal of the Boston Society of Civil Engineers 24 (1937) 197-246. Circles that
pass below the toe are not searched: with phi = 0 the number holds for slopes of 53 degrees and more.
"""

import numpy as np
from scipy.optimize import brentq, minimize


def cohesion_of_circle(back, half, angle, friction):
    """c/(gamma H) of the circle from the toe (0, 0) to the crest at x = `back` (H = 1), with half the central angle `half`; 0 where it cuts nothing."""
    chord = np.hypot(back, 1.0)
    along = np.array([back, 1.0]) / chord
    radius = chord / (2.0 * np.sin(half))
    center = 0.5 * np.array([back, 1.0]) + radius * np.cos(half) * np.array([-along[1], along[0]])
    x = (np.arange(2000) + 0.5) / 2000.0 * back
    reach = radius**2 - (x - center[0]) ** 2
    if np.any(reach < 0.0) or center[1] < 1.0:
        return 0.0
    tall = np.minimum(x * np.tan(angle), 1.0) - (center[1] - np.sqrt(reach))
    if np.any(tall < -1e-9):
        return 0.0
    weight = tall.mean() * back
    arm = (tall * x).mean() * back / weight - center[0]
    # The cohesion acts on a line along the chord; the weight meets it in `meeting`.
    on_line = center + radius * half / np.sin(half) * np.array([along[1], -along[0]])
    meeting = on_line + (center[0] + arm - on_line[0]) / along[0] * along
    to_center = center - meeting
    wave = np.pi / (2.0 * half)
    touched = (wave**2 - 1.0) / (wave**2 * np.cos(half)) * radius * np.sin(friction)
    turn = np.arcsin(min(touched / np.hypot(*to_center), 1.0))
    needed = []
    for sign in (-1.0, 1.0):
        c, s = np.cos(turn), sign * np.sin(turn)
        reaction = np.array([c * to_center[0] - s * to_center[1], s * to_center[0] + c * to_center[1]])
        needed.append(np.linalg.solve(np.column_stack([along, reaction]), [0.0, weight])[0] / chord)
    return min(needed)  # friction helps


def stability_number(angle, friction):
    """The largest c/(gamma H) of all circles through the toe; angles in degrees."""
    slope, phi = np.radians(angle), np.radians(friction)
    value = lambda p: -cohesion_of_circle(1.0 / np.tan(slope) + np.exp(p[0]), p[1], slope, phi)
    starts = sorted(((np.log(back), half) for back in (0.1, 0.3, 0.6, 1.0) for half in np.radians((8, 15, 25, 35, 50))), key=value)
    found = min((minimize(value, start, method="Nelder-Mead", options={"xatol": 1e-5, "fatol": 1e-9}) for start in starts[:4]), key=lambda one: one.fun)
    return -found.fun


def safety_factor(cohesion, friction, angle):
    """The factor of c/(gamma H) and tan(friction) with which the slope just stands."""
    reduced = lambda factor: np.degrees(np.arctan(np.tan(np.radians(friction)) / factor))
    return brentq(lambda factor: cohesion / factor - stability_number(angle, reduced(factor)), 0.3, 4.0, xtol=1e-4)
