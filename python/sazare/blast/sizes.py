"""Sizes of the fragments of a blast, by mass, without the rock that stays in place."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

SHARES = (0.2, 0.5, 0.8)


@dataclass(frozen=True)
class Distribution:
    """Sizes [m] (n,) of some fragments, ascending, with their masses [kg] (n,) and their numbers of elements (n,)."""

    sizes: np.ndarray
    masses: np.ndarray
    elements: np.ndarray

    @staticmethod
    def of(sizes, masses, elements):
        """The distribution of fragments in any order."""
        order = np.argsort(sizes, kind="stable")
        return Distribution(*(np.asarray(column, dtype=float)[order] for column in (sizes, masses, elements)))

    @cached_property
    def shares(self):
        """Share of the mass in fragments up to each size (n,), 0 to 1."""
        return np.cumsum(self.masses) / self.masses.sum()

    def passing(self, size):
        """Share of the mass that passes a size [m], 0 to 1: on straight lines between the fragments' sizes; 0 below the smallest."""
        last_of_each = np.append(np.diff(self.sizes) > 0.0, True)
        return np.interp(size, self.sizes[last_of_each], self.shares[last_of_each], left=0.0)

    def size_at(self, share):
        """The size [m] that a share of the mass passes: P50 for 0.5; below the smallest fragment its size; nan without fragments."""
        return float(np.interp(share, self.shares, self.sizes)) if len(self.sizes) else float("nan")

    def oversize(self, size):
        """Share of the mass in fragments larger than a size [m], 0 to 1; 0 without fragments."""
        return float(self.masses[self.sizes > size].sum() / self.masses.sum()) if len(self.sizes) else 0.0

    @cached_property
    def mesh_limit(self):
        """The size [m] up to which more than half of the mass that passes is in fragments of a single element: below it the mesh gives the sizes and not
        the rock. 0 where there is none, inf where it is so throughout."""
        if not len(self.sizes):
            return 0.0
        single = np.cumsum(np.where(self.elements == 1, self.masses, 0.0))
        unseen = np.flatnonzero(single > 0.5 * np.cumsum(self.masses))
        if not len(unseen):
            return 0.0
        return float(self.sizes[unseen[-1]]) if unseen[-1] + 1 < len(self.sizes) else float("inf")


def _columns(results):
    """Those of the fragments that do not stay."""
    table = results.fragments
    loose = table["stays"] == 0 if "stays" in table else np.ones(table.rows, dtype=bool)
    return {name: table[name][loose] for name in ("fragment", "elements", "mass", "size")}


def by_sphere(results):
    """The Distribution of a run's detached fragments by the diameter of the sphere of equal volume; empty where the run wrote no fragments."""
    if not results.fragments.rows:
        return Distribution.of([], [], [])
    table = _columns(results)
    return Distribution.of(table["size"], table["mass"], table["elements"])


def by_sieve(results):
    """The Distribution of a run's detached fragments by their sieve size; None where no snapshot shows the run's fragments."""
    if not results.fragments.rows or not len(results.snapshots):
        return None
    table = _columns(results)
    sizes = sieve_sizes(results.snapshots[-1].elements, table["fragment"])
    return None if sizes is None else Distribution.of(sizes, table["mass"], table["elements"])


def sieve_sizes(mesh, fragments):
    """Sieve sizes [m] (n,) of fragments by their numbers (n,) in a snapshot's elements; None where the snapshot does not know one of them."""
    from sazare.blast.boxes import sieve_size  # here, since convex hulls take long to load

    number = np.asarray(mesh.cell_data["fragment"])
    order = np.argsort(number, kind="stable")
    begin, end = (np.searchsorted(number[order], fragments, side) for side in ("left", "right"))
    if np.any(begin == end):
        return None
    corners = np.asarray(mesh.points)[np.asarray(mesh.cell_connectivity).reshape(-1, 4)]
    return np.array([sieve_size(corners[order[one:other]].reshape(-1, 3)) for one, other in zip(begin, end)])
