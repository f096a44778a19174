"""Directions of joints in a set: Fisher's distribution of their normals. R. A. Fisher, Dispersion on a sphere, Proc. R. Soc. A 217 (1953)."""

import math

import numpy as np

UNIFORM = 1e-6  # a Fisher constant below which directions have no preference
NODES = 4000  # of the quadrature over the distribution


def sample_normals(mean, fisher, shares, turns):
    """Unit vectors (n, 3) about a mean direction (3,).

    fisher: the constant k of the density exp(k cos a) of the angle a from the mean per solid angle; 0 for directions without preference.
    shares, turns: (n,) numbers in 0..1, evenly distributed.
    """
    cosine = _cosines(fisher, shares)
    sine, angle = np.sqrt(np.maximum(0.0, 1.0 - cosine**2)), 2.0 * np.pi * turns
    first, second = across(mean)
    return cosine[:, None] * mean + (sine * np.cos(angle))[:, None] * first + (sine * np.sin(angle))[:, None] * second


def _cosines(fisher, shares):
    if fisher < UNIFORM:
        return 1.0 - 2.0 * shares
    return np.clip(1.0 + np.log1p(-shares * -math.expm1(-2.0 * fisher)) / fisher, -1.0, 1.0)


def across(normal):
    """Two unit vectors that are square to a unit vector and to each other."""
    first = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    first /= np.linalg.norm(first)
    return first, np.cross(normal, first)


def fisher_estimated(normals):
    """Fisher's estimate (n - 1)/(n - R) of the constant from unit vectors (n, 3) with the resultant R; None for fewer than two and for equal ones.

    Normals are those of planes, without a sign: each is turned to the side of the axis to which most of them are near.
    """
    normals = np.asarray(normals).reshape(-1, 3)
    if len(normals) < 2:
        return None
    axis = np.linalg.eigh(normals.T @ normals)[1][:, -1]
    resultant = float(np.linalg.norm((normals * np.where(normals @ axis < 0.0, -1.0, 1.0)[:, None]).sum(axis=0)))
    rest = len(normals) - resultant
    return (len(normals) - 1) / rest if rest > 1e-9 * len(normals) else None


def mean_crossing(mean, fisher, line):
    """Mean of |n . l| over the normals n of a set and the direction l of a line: how many joints the line meets per length, over their area per volume."""
    along = abs(float(mean @ line))
    away = math.sqrt(max(0.0, 1.0 - along**2))
    cosine = _cosines(fisher, (np.arange(NODES) + 0.5) / NODES)
    a, b = along * cosine, away * np.sqrt(np.maximum(0.0, 1.0 - cosine**2))
    # Over a turn of the normal about the mean, |a + b cos t| has the mean |a| where it keeps its sign, and this one where it does not.
    turn = np.arccos(np.clip(-a / np.maximum(b, 1e-300), -1.0, 1.0))
    mixed = (a * (2.0 * turn - np.pi) + 2.0 * b * np.sin(turn)) / np.pi
    return float(np.where(np.abs(a) >= b, np.abs(a), mixed).mean())


def line_direction(trend, plunge):
    """Unit vector of a line [deg] with x to the east, y to the north, z up: trend from north by east, plunge below the horizontal."""
    way, dip = math.radians(trend), math.radians(plunge)
    return np.array([math.cos(dip) * math.sin(way), math.cos(dip) * math.cos(way), -math.sin(dip)])
