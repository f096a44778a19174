"""Where bodies are at the end of their flight, by their spheres in the snapshots."""

from dataclasses import dataclass

import numpy as np

from sazare.muck_pile.balls import Balls
from sazare.muck_pile.flight import flight_times
from sazare.rotations import best_rotations
from sazare.snapshots import elements_once
from sazare.tables import NotARun

RESTING = 0.1  # m/s: root of the mean square of the speed, by mass, below which a pile rests


@dataclass(frozen=True)
class Landed:
    """Bodies at a time [s]: centres (m, 3) [m], velocities (m, 3) [m/s], their balls."""

    time: float
    centres: np.ndarray
    velocities: np.ndarray
    balls: Balls

    def rms_speed(self, masses):
        """Root of the mean square of the speed by mass [m/s]."""
        return float(np.sqrt(masses @ np.sum(self.velocities**2, axis=1) / masses.sum()))


def landed_of(model, snapshot):
    """The Landed bodies of a Model in a snapshot of their run. Raises NotARun where its spheres are not those of the model."""
    mesh = elements_once(snapshot)
    places = np.concatenate(model.classes)
    body, radii = np.asarray(_data(mesh, "body"), dtype=int), _data(mesh, "radius")
    if len(body) != len(model.balls) or body.min() < 0 or body.max() >= len(places):
        raise NotARun(f"{snapshot.elements_file}: its spheres are not those of this muck pile")
    body = places[body]
    order = np.argsort(body, kind="stable")  # within a body spheres stand as in the file
    mine = np.argsort(model.balls.body, kind="stable")
    if not np.array_equal(body[order], model.balls.body[mine]) or not np.allclose(radii[order], model.balls.radii[mine], rtol=1e-6):
        raise NotARun(f"{snapshot.elements_file}: its spheres are not those of this muck pile")
    moved = Balls(model.balls.body[mine], np.asarray(mesh.points, dtype=float)[order], radii[order])
    first, spin, velocity = model.balls.centres[mine], _data(mesh, "angular_velocity")[order], _data(mesh, "velocity")[order]
    centres, velocities = _free_flight(model, float(snapshot.time))
    begin = np.searchsorted(moved.body, np.arange(len(model.bodies) + 1))
    for number in places:
        one, end = begin[number : number + 2]
        centres[number] = _carried(model.bodies.centre[number], first[one:end], moved.centres[one:end])
        velocities[number] = velocity[one] + np.cross(spin[one], centres[number] - moved.centres[one])
    return Landed(float(snapshot.time), centres, velocities, moved)


def _free_flight(model, time):
    """Where bodies are that meet nothing, and their velocities (m, 3): after a time [s], or on the ground."""
    bodies, down = model.bodies, np.array([0.0, 0.0, -model.gravity])
    flight = flight_times(model.heights, bodies.velocity, model.gravity)
    flown = np.minimum(time, flight)[:, None]
    velocities = np.where((flight > time)[:, None], bodies.velocity + down * flown, 0.0)
    return bodies.centre + bodies.velocity * flown + 0.5 * down * flown**2, velocities


def _data(mesh, name):
    return np.asarray(mesh.point_data[name] if name in mesh.point_data else mesh.cell_data[name], dtype=float)


def _carried(point, before, after):
    """Where a point (3,) is that moves with the spheres of a body, by their centres (n, 3) before and after; with
    fewer than three spheres, by the mean of these."""
    middle, offset = after.mean(axis=0), point - before.mean(axis=0)
    if len(before) < 3:
        return middle + offset
    return middle + best_rotations((after - middle).T @ (before - before.mean(axis=0))) @ offset


def ends_of(model, landed, flying):
    """Where the bodies come down (m, 3) [m]: those that fly (m,) go on in closed form, without what they would meet."""
    height = landed.centres[:, 2] - model.ground
    time = flight_times(height, landed.velocities, model.gravity)
    ends = np.where(flying[:, None], landed.centres + landed.velocities * time[:, None], landed.centres)
    ends[flying, 2] = model.ground
    return ends
