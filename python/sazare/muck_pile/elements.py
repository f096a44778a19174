"""The elements of a run of blasting at its end: where they are, how they move, and which of them have come loose."""

import tomllib
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sazare.cases import blocks
from sazare.snapshots import elements_once
from sazare.tables import NotARun

FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # of a tetrahedron, seen from outside in their order, where its volume is positive


@dataclass(frozen=True)
class Elements:
    """n tetrahedra at the end of a run. corners, start: (n, 4, 3) [m] at the end and in the first snapshot. nodes: (n, 4) points of the mesh, the same for
    elements that met. density (n,) [kg/m3]; velocity (n, 3) [m/s]; spin (n, 3) [rad/s]; fragment (n,) its number; stays (n,) whether that stays in place."""

    corners: np.ndarray
    start: np.ndarray
    nodes: np.ndarray
    density: np.ndarray
    velocity: np.ndarray
    spin: np.ndarray
    fragment: np.ndarray
    stays: np.ndarray

    @cached_property
    def volumes(self):
        """Volumes (n,) [m3]."""
        return np.abs(np.linalg.det(self.corners[:, 1:] - self.corners[:, :1])) / 6.0

    @cached_property
    def centres(self):
        """Centres of mass (n, 3) [m]."""
        return self.corners.mean(axis=1)

    @cached_property
    def masses(self):
        """Masses (n,) [kg]."""
        return self.density * self.volumes

    @cached_property
    def outer_faces(self):
        """Which faces (n, 4) of FACES belong to one element of a fragment alone: those of its surface."""
        return outer_faces(self.nodes, self.fragment)


def outer_faces(nodes, fragment=None):
    """Which faces (n, 4) of elements with these nodes (n, 4) belong to one of them alone, or to one of those of its fragment (n,)."""
    faces = np.sort(nodes[:, FACES].reshape(-1, 3), axis=1)
    keys = faces if fragment is None else np.column_stack([faces, np.repeat(fragment, 4)])
    _, inverse, count = np.unique(keys, axis=0, return_inverse=True, return_counts=True)
    return (count[np.ravel(inverse)] == 1).reshape(-1, 4)


def elements_of(results):
    """The Elements of a run that has ended.

    Raises ValueError where the run is of another method, has not ended, has no snapshots or no loose fragments, and NotARun where its files do not fit
    together.
    """
    _require_blast(results)
    snapshots = results.snapshots
    last = snapshots[-1]
    mesh = elements_once(last)
    order = np.argsort(np.asarray(mesh.cell_data["element"]), kind="stable")
    corners, start = _corners(mesh, order), _corners_like(snapshots[0], mesh, order)
    if "angular_velocity" not in mesh.cell_data:
        raise NotARun(f"{last.elements_file}: it does not say how elements turn (angular_velocity), as runs of this version do")
    fragment = np.asarray(mesh.cell_data["fragment"])[order]
    return Elements(
        corners, start, _nodes(start), _densities(results)[np.asarray(mesh.cell_data["material"])[order]], np.asarray(mesh.cell_data["velocity"])[order],
        np.asarray(mesh.cell_data["angular_velocity"])[order], fragment, _stays(results, fragment),
    )


def _require_blast(results):
    method, status = results.manifest.get("method"), results.manifest.get("status")
    if method != blocks.Case.method:
        raise ValueError(f"{results.path}: a run of method {method}; a muck pile is made of a run of blasting, of method {blocks.Case.method}")
    if status != "done":
        raise ValueError(f"{results.path}: this run has not ended ({status}): wait for it, or resume it: sazare run CASE --out {results.path} --resume")
    if not len(results.snapshots):
        raise ValueError(f"{results.path}: no snapshots, so nobody knows where the fragments are: run the case again with [time] snapshot_interval")
    table = results.fragments
    if not table.rows or "stays" not in table:
        raise NotARun(f"{results.path}: fragments.csv is missing, or has no column stays")
    if np.all(table["stays"] == 1):
        raise ValueError(f"{results.path}: no fragment has come loose, so there is no pile")


def _corners(mesh, order):
    return np.asarray(mesh.points, dtype=float)[np.asarray(mesh.cell_connectivity).reshape(-1, 4)[order]]


def _corners_like(snapshot, mesh, order):
    """Corners (n, 4, 3) of a snapshot in the order of another one."""
    other = elements_once(snapshot)
    numbers, wanted = np.asarray(other.cell_data["element"]), np.asarray(mesh.cell_data["element"])[order]
    its_order = np.argsort(numbers, kind="stable")
    if not np.array_equal(numbers[its_order], wanted):
        raise NotARun(f"{snapshot.elements_file}: its elements are not those of the last snapshot")
    return _corners(other, its_order)


def _nodes(corners):
    """Numbers (n, 4) of the points (n, 4, 3): the same for points that are one but for rounding."""
    points = corners.reshape(-1, 3)
    unit = 1e-7 * max(float(np.ptp(points, axis=0).max()), 1e-300)
    _, number = np.unique(np.round((points - points.min(axis=0)) / unit), axis=0, return_inverse=True)
    return np.ravel(number).reshape(-1, 4)


def _densities(results):
    try:
        return np.array([float(material["density"]) for material in tomllib.loads(results.case_text)["materials"]])
    except (tomllib.TOMLDecodeError, KeyError, TypeError, ValueError) as error:
        raise NotARun(f"{results.path / 'case.toml'}: it does not say the densities of its materials: {error}") from error


def _stays(results, fragment):
    """Whether the fragment of each element (n,) stays."""
    table = results.fragments
    numbers = table["fragment"].astype(int)
    order = np.argsort(numbers)
    place = np.searchsorted(numbers[order], fragment)
    if np.any(place == len(numbers)) or np.any(numbers[order][np.minimum(place, len(numbers) - 1)] != fragment):
        raise NotARun(f"{results.path / 'fragments.csv'}: it does not have all fragments of the last snapshot")
    return table["stays"][order][place] == 1
