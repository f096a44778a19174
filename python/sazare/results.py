"""Reading the folder of a run: manifest, tables, gauges and snapshots."""

import json
import sys
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from sazare.snapshots import Snapshots, kinds_in, read_snapshots
from sazare.tables import NotARun, Table, is_there, read_table


@dataclass(frozen=True)
class Gauge:
    """The velocity history at one point: time [s] (n,), velocity [m/s] (n, 3); the largest speed between its rows [m/s], where the run has
    told it; and in ground whose pore water takes part the excess pore pressure [Pa] (n,), else None."""

    name: str
    time: np.ndarray
    velocity: np.ndarray
    peak: float = 0.0
    excess_pore_pressure: np.ndarray | None = None

    @property
    def speed(self):
        """Magnitude of the velocity [m/s] (n,)."""
        return np.linalg.norm(self.velocity, axis=1)

    @property
    def ppv(self):
        """Peak particle velocity [m/s]: the largest magnitude of the history, or that of the run, which may look more often; 0 without samples."""
        return float(self.speed.max(initial=self.peak))


class Results:
    """The folder of a run. What the run did not write reads as empty: a Table without rows, no gauges, no snapshots."""

    def __init__(self, path):
        self.path = Path(path)
        _check_is_run(self.path)

    def __repr__(self):
        return f"Results({str(self.path)!r}: {self.title})"

    @cached_property
    def manifest(self):
        """manifest.json as a dict; empty while a run has not written one."""
        path = self.path / "manifest.json"
        if not is_there(path):
            return {}
        try:
            found = json.loads(path.read_text(encoding="utf-8"))
        except (ValueError, RecursionError) as error:
            raise NotARun(f"{path}: not valid JSON: {error}") from error
        _check_manifest(path, found)
        return found

    @property
    def title(self):
        """Title of the case; the folder's name where there is no manifest."""
        return self.manifest.get("case") or self.path.resolve().name

    @property
    def figures(self):
        """The headline figures by name: manifest["results"]."""
        return self.manifest.get("results", {})

    @property
    def state_hash(self):
        """The hash of the final state; "" where there is none: a study, which has no state, and a run before its end write zeros."""
        written = self.manifest.get("state_hash", "")
        return written if written.strip("0") else ""

    @cached_property
    def case_text(self):
        """The resolved case, as text; "" where there is none."""
        path = self.path / "case.toml"
        try:
            return path.read_text(encoding="utf-8") if is_there(path) else ""
        except UnicodeDecodeError as error:
            raise NotARun(f"{path}: not the text of a case: {error}") from error

    def _table(self, name):
        path = self.path / name
        return read_table(path) if is_there(path) else Table({}, name=str(path))

    @cached_property
    def history(self):
        """history.csv: time, broken_joints, fragments, energy_*, smallest_step, pair_evaluations, wall_seconds."""
        return self._table("history.csv")

    @cached_property
    def fragments(self):
        """fragments.csv, largest first: fragment, elements, volume, mass, size, center_*, velocity_*, throw; of some methods also stays."""
        return self._table("fragments.csv")

    @cached_property
    def timing(self):
        """timing.csv: part, seconds, share."""
        return self._table("timing.csv")

    @cached_property
    def ranks(self):
        """ranks.csv of a run of several processes, one row per rank and interval: time, rank, processor_time [s], exchange_time [s],
        bytes_sent [B] and messages_sent so far, lock_step, elements and more. Empty for a run of one process."""
        return self._table("ranks.csv")

    @cached_property
    def gauge_table(self):
        """gauges.csv: time, and for every gauge its velocity; method mps also writes displacement and acceleration, spheres the position."""
        return self._table("gauges.csv")

    @cached_property
    def gauge_peaks(self):
        """gauge_peaks.csv, where a run has looked at its gauges at every step: gauge, point_*, ppv, time, peak_*."""
        return self._table("gauge_peaks.csv")

    @cached_property
    def holes(self):
        """holes.csv, where a run has charges, or blasts in holes: hole, delay, first_*, last_*, diameter, mass."""
        return self._table("holes.csv")

    @cached_property
    def half_casts(self):
        """half_casts.csv, where a run has charges, or blasts in holes: hole, first_*, last_*, length, half_cast, whole, standing."""
        return self._table("half_casts.csv")

    @cached_property
    def wall_table(self):
        """walls.csv of method spheres: time, and for every wall force [N] and moment [N m]."""
        return self._table("walls.csv")

    @cached_property
    def study(self):
        """study.csv: a row for each case of a study, with its parameters; of time steps predicted, stable, unstable, limit; of factors of
        safety lower, upper, factor, displacement, elastic. The factor is nan where the bounds of the search do not bracket it: lower is
        then 0 where the ground failed with every factor, and upper inf where it stood with every one."""
        return self._table("study.csv")

    def trials(self, case):
        """The trials of a case (its number) of a study of factors of safety: trial, factor, stands, displacement, seconds, end."""
        return self._table(f"trials/{case:05}.csv")

    def slip_surface(self, case):
        """The ground of a case (its number) at the end of the last trial that failed: x, y, z, displacement_*, slip."""
        return self._table(f"trials/{case:05}_slip.csv")

    @cached_property
    def regression(self):
        """regression.csv: coefficients of equations (15) and (16) by family."""
        return self._table("regression.csv")

    @cached_property
    def regression_lines(self):
        """regression_lines.csv: a1 and a2 of equation (14) by family and damping."""
        return self._table("regression_lines.csv")

    @cached_property
    def gauges(self):
        """gauges.csv as a dict of Gauge by name."""
        table = self.gauge_table
        ending = ".velocity_x"
        names = [column.removesuffix(ending) for column in table if column.endswith(ending)]
        peaks = self.figures.get("ppv") or {}

        def gauge(name):
            velocity = np.stack([table[f"{name}.velocity_{axis}"] for axis in "xyz"], axis=1)
            pressure = f"{name}.excess_pore_pressure"
            return Gauge(name, table["time"], velocity, peaks.get(name) or 0.0, table[pressure] if pressure in table else None)

        return {name: gauge(name) for name in names}

    @cached_property
    def snapshots(self):
        """The snapshots whose files are there, by their list or, where that is missing, by their names."""
        return self._snapshots("elements")

    @cached_property
    def particle_snapshots(self):
        """The snapshots of a run of method mps or spheres: points with velocity and more."""
        return self._snapshots("particles")

    @cached_property
    def wall_snapshots(self):
        """The walls of triangles of a run of method spheres, each triangle with its own points; once where no wall of them moves."""
        return self._snapshots("walls")

    @cached_property
    def square_snapshots(self):
        """The snapshots of a run of method rectangles: a polygon for each element and support."""
        return self._snapshots("rectangles")

    @cached_property
    def all_snapshots(self):
        """The snapshots of the bodies of the run, for any method."""
        from sazare.methods import method_of

        own = method_of(self).snapshots
        kinds = ([own] if own else []) + [kind for kind in kinds_in(self.path / "snapshots") if kind not in (own, "joints", "walls")]
        return next((found for found in map(self._snapshots, kinds) if len(found)), Snapshots([]))

    @cached_property
    def element_snapshots(self):
        """The snapshots of a run of method fem: the mesh with displacements of its points, stress and equivalent plastic shear strain of its
        elements.
        """
        return self._snapshots("finite_elements")

    @cached_property
    def sides(self):
        """The two solver sides of a run of method hybrid, each as a run of its own: "continuum" and "bodies". Empty for other runs."""
        folders = {name: self.path / name for name in ("continuum", "bodies")}
        return {name: Results(path) for name, path in folders.items() if (path / "manifest.json").exists()}

    def _snapshots(self, kind):
        return read_snapshots(self.path / "snapshots", kind)


def _check_manifest(path, manifest):
    """Raises NotARun where a manifest has other kinds of values than a run writes."""
    if not isinstance(manifest, dict):
        raise NotARun(f"{path}: not a manifest: a JSON object was expected, found {type(manifest).__name__}")
    kinds = {
        "case": str, "method": str, "status": str, "sazare": str, "commit": str, "started": str, "finished": str, "state_hash": str,
        "machine": dict, "results": dict,
    }
    for key, kind in kinds.items():
        if key in manifest and not isinstance(manifest[key], kind):
            raise NotARun(f"{path}: \"{key}\" must be {'an object' if kind is dict else 'a string'}, found {json.dumps(manifest[key])[:80]}")
    for name, value in manifest.get("results", {}).items():
        is_by_gauge = name == "ppv" and isinstance(value, dict)
        if not all(map(_is_figure, value.values() if is_by_gauge else [value])):
            raise NotARun(f"{path}: the figure \"{name}\" is not a number: {json.dumps(value)[:80]}")


def _is_figure(value):
    """Whether a value of a manifest is a number that a computation can take; a run writes null where it is not finite."""
    return value is None or (isinstance(value, int | float) and not isinstance(value, bool) and abs(value) <= sys.float_info.max)


def _check_is_run(path):
    if not path.exists():
        raise NotARun(f"{path}: no such folder; a run makes one: sazare run CASE --out {path}")
    if not path.is_dir():
        raise NotARun(f"{path}: not a folder; give the folder of a run, the one that holds manifest.json")
    if not any((path / name).exists() for name in ("manifest.json", "history.csv", "snapshots")):
        raise NotARun(
            f"{path}: not the folder of a run: neither manifest.json, history.csv nor snapshots/ is in it; "
            f"a run makes one: sazare run CASE --out {path}"
        )


def open_run(path):
    """Opens the folder of a run. Raises NotARun, saying why, where it is not one."""
    return Results(path)
