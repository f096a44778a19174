"""How good the elements of a mesh are: its shortest edge over the wanted size, and its flattest element."""

import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from sazare.blast_model.fit import size_at
from sazare.engine import engine
from sazare.simulation import check, source_of

WANTED = 0.2  # least length of an edge over the size of elements there
FLAT = 0.05  # quality below which elements are counted
PAIRS = np.triu_indices(4, 1)


@dataclass(frozen=True)
class Quality:
    """Of the elements of a mesh."""

    elements: int
    shortest: float  # edge [m]
    share: float  # least length of an edge over the wanted size there
    where: np.ndarray  # (3,), the middle of that edge [m]
    worst: float  # least of 2 sqrt(6) inscribed radius / longest edge: 1 of a regular tetrahedron, 0 of a flat one
    flat: int  # elements below FLAT

    def words(self):
        """Lines about it."""
        place = ", ".join(f"{value:.3g}" for value in self.where)
        lines = [
            f"  elements    worst quality {self.worst:.2g} (1: regular, 0: flat), {self.flat} below {FLAT:g}",
            f"              shortest edge {self.shortest:.3g} m; over the size that is wanted there the least is {self.share:.2g}, at ({place}) m",
        ]
        if self.share < WANTED:
            lines.append(f"  warning: an edge is shorter than {WANTED:g} of the size that is wanted there: where holes or surfaces come close to each other, or a joint crosses a hole under a small angle; the steps there are small")
        return lines


def quality_of(corners, layout):
    """The quality of tetrahedra with corners (n, 4, 3) [m]."""
    one, other = corners[:, PAIRS[0]], corners[:, PAIRS[1]]
    lengths = np.linalg.norm(other - one, axis=2)
    middles = 0.5 * (one + other)
    shares = lengths / size_at(middles, layout)
    least = np.unravel_index(shares.argmin(), shares.shape)
    quality = _quality(corners, lengths)
    return Quality(len(corners), float(lengths.min()), float(shares[least]), middles[least], float(quality.min()), int(np.count_nonzero(quality < FLAT)))


def _quality(corners, lengths):
    a, b, c, d = np.swapaxes(corners, 0, 1)
    volumes = np.abs(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)) / 6.0
    surface = sum(0.5 * np.linalg.norm(np.cross(q - p, r - p), axis=1) for p, q, r in ((a, b, c), (a, b, d), (a, c, d), (b, c, d)))
    return 2.0 * np.sqrt(6.0) * 3.0 * volumes / surface / lengths.max(axis=1)


def checked(case, layout):
    """What `sazare check` says of a case, and the quality of its elements; the case is meshed once, in a folder for a while.

    Raises UserError with all errors of the case.
    """
    with tempfile.TemporaryDirectory(prefix="sazare-") as folder:
        run = Path(folder) / "run"
        live = engine().LiveSimulation(source_of(case).for_engine(), run, "fresh", 0, warns=False)
        live.begin()
        live.finish()
        points, blocks = engine().mesh_file(run / "mesh.msh")
        said = check(case, overrides={"mesh.file": str(run / "mesh.msh")})
    nodes = np.concatenate([nodes for dimension, _, kind, _, nodes in blocks if dimension == 3 and kind == 4])
    return said, quality_of(points[nodes], layout)
