"""Snapshots of a run: VTKHDF files in the run's own `snapshots/`, in the order of time.

A folder may come from anyone. So no other format is read, and no name leads out of the folder.
"""

import json
import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from sazare.tables import NotARun, is_there

HDF5_SIGNATURE = b"\x89HDF\r\n\x1a\n"
MOST_EXPANSION = 100  # of what a file holds; runs write numbers as they are
FILE_NAME = re.compile(r"\w[\w.-]*\.vtkhdf")


@dataclass(frozen=True)
class Snapshot:
    """One moment of a run: time [s], and the files of its elements and joints, read when asked for."""

    time: float
    elements_file: Path
    joints_file: Path | None

    @cached_property
    def elements(self):
        """Tetrahedra (pyvista.UnstructuredGrid), each with its own four points, where they are at this time."""
        return read_mesh(self.elements_file)

    @property
    def mesh(self):
        """The bodies, for any method (pyvista.UnstructuredGrid): the same as `elements`."""
        return self.elements

    @cached_property
    def joints(self):
        """Triangles (pyvista.UnstructuredGrid) of the faces between elements; None where the run wrote none."""
        return read_mesh(self.joints_file) if self.joints_file else None


class Snapshots(Sequence):
    """The snapshots of a run in the order of time."""

    def __init__(self, snapshots):
        self._snapshots = list(snapshots)

    def __getitem__(self, index):
        return self._snapshots[index]

    def __len__(self):
        return len(self._snapshots)

    @property
    def times(self):
        """Times of the snapshots [s] (n,)."""
        return np.array([snapshot.time for snapshot in self._snapshots])

    def at(self, time):
        """The snapshot nearest to a time [s]. Raises NotARun where the run has none."""
        if not self._snapshots:
            raise NotARun("the run has no snapshots")
        return self._snapshots[int(np.argmin(np.abs(self.times - time)))]


def elements_once(snapshot):
    """The bodies of a snapshot, which does not keep them in memory unless it has them already."""
    kept = vars(snapshot).get("elements")
    return read_mesh(snapshot.elements_file) if kept is None else kept


def read_mesh(path):
    """The unstructured grid of a VTKHDF file. Raises NotARun where the file is anything else."""
    import pyvista

    try:
        with path.open("rb") as file:
            if file.read(len(HDF5_SIGNATURE)) != HDF5_SIGNATURE:
                raise NotARun(f"{path}: not a readable VTKHDF file: it does not begin as HDF5 files do")
        _check_content(path)
        mesh = pyvista.HDFReader(path).read()
    except (OSError, ValueError, RuntimeError, KeyError) as error:
        raise NotARun(f"{path}: not a readable VTKHDF file: {error}") from error
    if not isinstance(mesh, pyvista.UnstructuredGrid):
        raise NotARun(f"{path}: not a snapshot: it holds {type(mesh).__name__}, and a run writes UnstructuredGrid")
    return mesh


def _check_content(path):
    """Raises NotARun where an HDF5 file leads to other files, or announces more numbers than it can hold: VTK would take memory for them."""
    import h5py

    total = 0

    def look(name, item):
        nonlocal total
        if isinstance(item, h5py.Dataset):
            if item.external or item.is_virtual:
                raise NotARun(f"{path}: not a snapshot: {name} has its numbers in another file")
            total += item.size * item.dtype.itemsize
        elif any(not isinstance(item.get(key, getlink=True), h5py.HardLink) for key in item):
            raise NotARun(f"{path}: not a snapshot: {name} holds links")

    with h5py.File(path, "r") as file:
        look("/", file)
        file.visititems(look)
    size = path.stat().st_size
    if total > MOST_EXPANSION * size:
        raise NotARun(f"{path}: not a snapshot: it announces {total / 1e9:.3g} GB of numbers, and the file has {size / 1e9:.3g} GB")


def kinds_in(folder):
    """What there are lists of snapshots of in a folder, such as elements and joints; sorted."""
    return [path.name.removesuffix(".vtkhdf.series") for path in sorted(folder.glob("*.vtkhdf.series"))]


def read_snapshots(folder, kind):
    """The snapshots of one kind whose files are there, by their list or, where that is missing, by their names.

    Raises NotARun where the list is damaged or names what is no VTKHDF file of the folder.
    """
    if not folder.is_dir():
        return Snapshots([])
    series = folder / f"{kind}.vtkhdf.series"
    files = _listed(series) if is_there(series) else _found(folder, kind)
    return Snapshots(_snapshot(folder, name, time) for name, time in files if is_there(folder / name))


def _listed(series):
    """Names and times [s] of a list of snapshots."""
    try:
        files = [(entry["name"], float(entry["time"])) for entry in json.loads(series.read_text(encoding="utf-8"))["files"]]
    except (ValueError, KeyError, TypeError) as error:
        raise NotARun(f"{series}: not a list of snapshots: {error}") from error
    for name, time in files:
        if not isinstance(name, str) or not FILE_NAME.fullmatch(name):
            raise NotARun(f"{series}: {name!r} is not a snapshot: only .vtkhdf files beside the list are read")
        if not math.isfinite(time):
            raise NotARun(f"{series}: {name} has no time: {time}")
    return files


def _found(folder, kind):
    """Names and times [s] of the numbered files of a kind."""
    numbered = re.compile(re.escape(kind) + r"_\d+\.vtkhdf")
    names = sorted(path.name for path in folder.iterdir() if numbered.fullmatch(path.name))
    return [(name, _time_in(_inside(folder, name))) for name in names]


def _time_in(path):
    return float(np.ravel(read_mesh(path).field_data["time"])[0])


def _snapshot(folder, name, time):
    joints = name.replace("elements_", "joints_", 1) if name.startswith("elements_") else None
    has_joints = joints is not None and is_there(folder / joints)
    return Snapshot(time, _inside(folder, name), _inside(folder, joints) if has_joints else None)


def _inside(folder, name):
    """The path of a file in a folder. Raises NotARun where it is a link to another place."""
    path = folder / name
    if path.resolve().parent != folder.resolve():
        raise NotARun(f"{path}: a link out of the run's folder; only files of the run itself are read")
    return path
