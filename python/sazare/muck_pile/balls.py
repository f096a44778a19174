"""Spheres of rigid fragments: inside them, shrunk where bodies overlap, and grown where there is room."""

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from sazare.muck_pile.elements import FACES
from sazare.muck_pile.surface import distances, surface_of
from sazare.tables import write_table

GROWTH = 1.2  # of spheres in bodies of several elements, at most; one of a single element grows to the volume of that
GROWTH_PASSES = 6
SHOWN = 0.5  # of the radius of a sphere that must show beside larger ones
SMALLEST = 0.3  # over the radius of the inscribed sphere: a sphere that others press below is left out
PART = 0.25  # of the radius of the largest sphere of a body, that others have at least
TOUCHING = 0.99  # of the distance of two spheres, or from a wall, that they may fill: none touches at the start
SAMPLES = 48  # points in each sphere by which the volume of a union is measured


@dataclass(frozen=True)
class Balls:
    """n spheres of bodies. body (n,): which of them; centres (n, 3), radii (n,) [m]."""

    body: np.ndarray
    centres: np.ndarray
    radii: np.ndarray

    def __len__(self):
        return len(self.body)

    def of(self, chosen):
        """Those of them for which `chosen` (n,) is true, or whose numbers it has."""
        return Balls(self.body[chosen], self.centres[chosen], self.radii[chosen])


def inscribed(corners, alone):
    """Centres (n, 3) and radii (n,) of spheres in tetrahedra (n, 4, 3): the inscribed ones, and where `alone` (n,) those about the centre of mass, so that
    a body of one sphere turns about that sphere's middle."""
    sides = corners[:, FACES]
    areas = 0.5 * np.linalg.norm(np.cross(sides[:, :, 1] - sides[:, :, 0], sides[:, :, 2] - sides[:, :, 0]), axis=2)
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6.0
    middle = np.einsum("nk,nki->ni", areas, corners) / areas.sum(axis=1)[:, None]
    centres = np.where(alone[:, None], corners.mean(axis=1), middle)
    return centres, np.where(alone, 0.75 * volumes / areas.max(axis=1), 3.0 * volumes / areas.sum(axis=1))


def balls_in(elements, chosen, owner, most):
    """The Balls of bodies, and how far each may grow [m] (n,). chosen (n,): which Elements are of bodies, owner: the body of each of these; most: spheres of
    one body.

    A body of one element has one sphere. In one of several there are spheres that reach to its surface, about the middle of each element, about the points of
    the mesh within it and about its centre of mass; the largest of those are taken that show enough beside the ones before: what is deep inside is so held by
    few large spheres.
    """
    corners, volumes, outer = elements.corners[chosen], elements.volumes[chosen], elements.outer_faces[chosen]
    masses, nodes = elements.masses[chosen], elements.nodes[chosen]
    alone = np.bincount(owner)[owner] == 1
    centres, radii = inscribed(corners[alone], np.ones(np.sum(alone), dtype=bool))
    found = [(owner[alone], centres, radii, np.cbrt(0.75 / np.pi * volumes[alone]))]
    for group in _groups(owner[~alone], np.flatnonzero(~alone)):
        centres, least = inscribed(corners[group], np.zeros(len(group), dtype=bool))
        more = np.vstack([_inner_points(corners[group], nodes[group], outer[group]), _centre_within(corners[group], masses[group])])
        radii = distances(surface_of(corners[group][:, FACES][outer[group]]), np.vstack([centres, more]))
        radii[: len(group)] = np.maximum(radii[: len(group)], least)
        taken = _showing(np.vstack([centres, more]), radii, most)
        found.append((np.full(len(taken), owner[group[0]]), np.vstack([centres, more])[taken], radii[taken], GROWTH * radii[taken]))
    body, centres, radii, full = (np.concatenate(parts) for parts in zip(*found))
    order = np.argsort(body, kind="stable")
    return Balls(body[order], centres[order], radii[order]), full[order]


def _inner_points(corners, nodes, outer):
    """Points (k, 3) of the mesh within a body: those on none of its outer faces."""
    on_surface = np.unique(nodes[:, FACES][outer])
    known, first = np.unique(nodes, return_index=True)
    return corners.reshape(-1, 3)[first[~np.isin(known, on_surface)]]


def _centre_within(corners, masses):
    """The centre of mass (1, 3) of a body, or (0, 3) where none of its elements holds it."""
    centre = masses @ corners.mean(axis=1) / masses.sum()
    shares = np.linalg.solve((corners[:, 1:] - corners[:, :1]).transpose(0, 2, 1), (centre - corners[:, 0])[:, :, None])[:, :, 0]
    within = np.any((shares.min(axis=1) > -1e-9) & (shares.sum(axis=1) < 1.0 + 1e-9))
    return centre[None] if within else np.zeros((0, 3))


def _groups(keys, values):
    """The values of each key, in ascending keys; none without keys."""
    order = np.argsort(keys, kind="stable")
    return np.split(values[order], np.flatnonzero(np.diff(keys[order])) + 1) if len(keys) else []


def _showing(centres, radii, most):
    """Numbers of at most so many spheres of one body, the largest first, each of which shows by half of its radius or more beside those before."""
    left = np.argsort(-radii, kind="stable")
    left = left[radii[left] >= PART * radii[left[0]]]
    taken = []
    while len(left) and len(taken) < most:
        one, left = left[0], left[1:]
        taken.append(one)
        left = left[np.linalg.norm(centres[left] - centres[one], axis=1) > radii[one] - SHOWN * radii[left]]
    return np.array(taken)


def near_pairs(balls, reach):
    """Pairs of balls of different bodies, first (k,) and second (k,), whose centres are nearer than their reaches [m] (n,) together; and how near (k,)."""
    order = np.argsort(-reach, kind="stable")
    found, begin = [], 0
    while begin < len(order):  # balls of a class are at least half as large as its first; each is paired with those of its class and smaller ones
        largest = reach[order[begin]]
        end = begin + int(np.searchsorted(-reach[order[begin:]], -0.5 * largest, side="right"))
        own, others = order[begin:end], order[begin:]
        lists = cKDTree(balls.centres[others]).query_ball_point(balls.centres[own], 2.0 * largest)
        first = np.repeat(own, [len(one) for one in lists])
        second = others[np.concatenate([np.asarray(one, dtype=int) for one in lists])]
        distance = np.linalg.norm(balls.centres[first] - balls.centres[second], axis=1)
        rank = np.empty(len(order), dtype=int)
        rank[order] = np.arange(len(order))
        wanted = (rank[first] < rank[second]) & (balls.body[first] != balls.body[second]) & (distance < reach[first] + reach[second])
        found.append((first[wanted], second[wanted], distance[wanted]))
        begin = end
    return tuple(np.concatenate(parts) for parts in zip(*found))


def fitted(balls, full, room):
    """Balls that touch no ball of another body: shrunk where they overlap, then grown up to `full` (n,) [m], and as far as `room` (n,) [m], the distance from
    walls, in all directions alike. Those pressed much smaller than they were are left out: bodies may lose all of theirs."""
    inner = balls.radii
    limit = np.minimum(np.maximum(full, inner), TOUCHING * room)
    radii = np.minimum(inner, limit)
    first, second, distance = near_pairs(balls, np.maximum(limit, radii))
    both = np.concatenate([first, second])
    crowded = np.ones(len(radii))
    np.minimum.at(crowded, both, np.tile(distance / (radii[first] + radii[second]), 2))
    radii = radii * TOUCHING * crowded
    kept = _best(balls.body, radii / inner, radii)
    alive = kept[first] & kept[second]
    first, second, distance = first[alive], second[alive], distance[alive]
    both = np.concatenate([first, second])
    for _ in range(GROWTH_PASSES):
        gap = np.full(len(radii), np.inf)
        np.minimum.at(gap, both, np.tile(TOUCHING * distance - radii[first] - radii[second], 2))
        radii = np.minimum(np.maximum(limit, radii), radii + 0.5 * np.maximum(gap, 0.0))
    return Balls(balls.body, balls.centres, radii).of(kept)


def _best(body, shares, radii):
    """Which balls (n,) to keep: those not pressed too small, by their own measure and by that of the largest of their body."""
    largest = np.zeros(body.max() + 1)
    np.maximum.at(largest, body, radii)
    return (shares >= SMALLEST) & (radii >= PART * largest[body])


def union_volumes(balls, count):
    """Volumes (count,) [m3] of the unions of each body's balls, by points that fill each ball evenly: exact for single balls, else to a percent or so."""
    ball = _even_points(SAMPLES)
    volumes = 4.0 / 3.0 * np.pi * balls.radii**3
    result = np.zeros(count)
    for group in _groups(balls.body, np.arange(len(balls))):
        centres, radii = balls.centres[group], balls.radii[group]
        for number in range(len(group)):
            near = np.flatnonzero(np.linalg.norm(centres - centres[number], axis=1) < radii + radii[number])
            points = centres[number] + radii[number] * ball
            within = np.sum(np.linalg.norm(points[:, None] - centres[near], axis=2) < radii[near], axis=1)
            result[balls.body[group[0]]] += volumes[group[number]] * np.mean(1.0 / np.maximum(within, 1))
    return result


def _even_points(count):
    """Points (count, 3) that fill a ball of radius 1 evenly: a spiral on shells of equal volume."""
    steps = np.arange(count) + 0.5
    height = 1.0 - 2.0 * steps / count
    turn = np.pi * (1.0 + np.sqrt(5.0)) * steps
    across = np.sqrt(1.0 - height**2)
    shuffled = np.random.default_rng(1).permutation(steps)
    return np.cbrt(shuffled / count)[:, None] * np.column_stack([across * np.cos(turn), across * np.sin(turn), height])


def write_balls(path, balls, numbers):
    """Writes the table of spheres; numbers (m,): those by which the table of bodies names them."""
    write_table(path, {"body": numbers[balls.body], "radius": balls.radii} | {name: balls.centres[:, axis] for axis, name in enumerate("xyz")})
