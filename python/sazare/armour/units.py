"""Armour units of a run: where each body was and is, and how it has turned."""

import tomllib
from dataclasses import dataclass

import numpy as np

from sazare.rotations import best_rotations
from sazare.tables import NotARun


@dataclass(frozen=True)
class Units:
    """n bodies. number (n,) of the body in the snapshots; group (n,) its number in the case; start, end (n, 3) centres [m]; turn (n,) rotation since the start
    and largest_turn (n,) the largest one in any snapshot [rad]; size (n,) nominal diameter, the cube root of the volume [m]; broken (n,) share of
    its bonds that are broken."""

    number: np.ndarray
    group: np.ndarray
    start: np.ndarray
    end: np.ndarray
    turn: np.ndarray
    largest_turn: np.ndarray
    size: np.ndarray
    broken: np.ndarray

    def __len__(self):
        return len(self.number)

    @property
    def moved(self):
        """Distances (n,) [m] of the centres from where they were."""
        return np.linalg.norm(self.end - self.start, axis=1)


class Spheres:
    """The spheres of bodies in one snapshot, sorted by body."""

    def __init__(self, mesh, wanted):
        body, group = np.asarray(mesh.cell_data["body"]), np.asarray(mesh.cell_data["group"])
        chosen = np.flatnonzero((body >= 0) & np.isin(group, wanted))
        self.order = chosen[np.argsort(body[chosen], kind="stable")]
        self.points = np.asarray(mesh.points)[self.order]
        self.radii = np.asarray(mesh.cell_data["radius"])[self.order]
        self.group = group[self.order]
        self.broken = np.asarray(mesh.cell_data["broken_fraction"])[self.order]
        self.number, self.first, self.owner = np.unique(body[self.order], return_index=True, return_inverse=True)

    def mean(self, values):
        """Means over the spheres of each body, weighted by their volumes."""
        weights = self.radii**3
        total = np.array([np.bincount(self.owner, weights * column) for column in np.atleast_2d(values.T)]).T
        return total / np.bincount(self.owner, weights)[:, None]


def others_in(mesh):
    """Centres (n, 3) and radii (n,) [m] of the spheres of a snapshot that belong to no body."""
    alone = np.asarray(mesh.cell_data["body"]) < 0
    return np.asarray(mesh.points)[alone], np.asarray(mesh.cell_data["radius"])[alone]


def turns(before, after):
    """Angles [rad] (n,) of the rotation that takes the spheres of each body from one snapshot to another, by least squares. Bodies whose spheres
    stand in a row turn about the row unseen."""
    weights = before.radii**3
    first, second = (spheres.points - spheres.mean(spheres.points)[spheres.owner] for spheres in (before, after))
    matrix = np.zeros((len(before.number), 3, 3))
    np.add.at(matrix, before.owner, weights[:, None, None] * second[:, :, None] * first[:, None, :])
    trace = np.trace(best_rotations(matrix), axis1=1, axis2=2)
    return np.arccos(np.clip(0.5 * (trace - 1.0), -1.0, 1.0))


def groups_of(case):
    """The groups of a resolved case, by number: the entries of its tables that may be of a shape."""
    return next((entries for entries in case.values() if isinstance(entries, list) and any(entry.get("shape") for entry in entries) and "source" in entries[0]), [])


def shapes_of(results, names):
    """Groups of the case that are of a shape, or those that are named: {number of the group: its nominal diameter [m]}. Raises NotARun with what is missing."""
    groups = groups_of(tomllib.loads(results.case_text))
    known = [group["name"] for group in groups if group.get("shape")]
    if not known:
        raise NotARun(f"{results.path}: no group of this run is of a shape: armour units are bodies of [[shapes]]")
    for name in names or []:
        if name not in known:
            raise NotARun(f'{results.path}: there is no group "{name}" of a shape; groups of shapes are {", ".join(known)}')
    sizes = {}
    for number, group in enumerate(groups):
        if not group.get("shape") or (names and group["name"] not in names):
            continue
        volume = results.figures.get(f"shape_volume_{group['shape']}")
        if volume is None:
            raise NotARun(f"{results.path}: the run does not tell the volume of its shapes: run it again with this version of Sazare")
        sizes[number] = float(volume) ** (1.0 / 3.0)
    return sizes


def snapshot_at(results, time):
    """The number of the snapshot nearest to a time [s]; the first where none is given. Raises NotARun where there are fewer than two from there on."""
    snapshots = results.particle_snapshots
    number = 0 if time is None else int(np.argmin(np.abs(snapshots.times - time)))
    if len(snapshots) - number < 2:
        raise NotARun(f"{results.path}: two snapshots at least are needed, from the start of the count on; the run has {len(snapshots)}, the last at {snapshots.times[-1]:g} s")
    return number


def units_of(results, names=None, time=None):
    """The Units of a run since a time [s], or since its first snapshot: bodies of the groups that are named, or of all groups of a shape. With them their
    Spheres before and after, and the time [s] of the snapshot from which they count."""
    sizes = shapes_of(results, names)
    first = snapshot_at(results, time)
    snapshots = results.particle_snapshots
    before = Spheres(snapshots[first].mesh, list(sizes))
    largest = np.zeros(len(before.number))
    for snapshot in snapshots[first + 1 :]:
        after = Spheres(snapshot.mesh, list(sizes))
        angle = turns(before, after)
        largest = np.maximum(largest, angle)
    group = before.group[before.first]
    return Units(
        before.number, group, before.mean(before.points), after.mean(after.points), angle, largest,
        np.array([sizes[int(one)] for one in group]), after.mean(after.broken[:, None])[:, 0],
    ), before, after, float(snapshots.times[first])
