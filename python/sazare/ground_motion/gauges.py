"""Motion at the gauges of a run, as records and as a table of figures."""

import tomllib
import warnings
from dataclasses import dataclass

import numpy as np

from sazare.ground_motion.intensity import FIGURES, figures
from sazare.ground_motion.record import GAL, Record

AXES = "xyz"
STILL = 0.01  # of the largest relative velocity, below which a gauge has come to rest against the base
END = 0.02  # of the run, over which it must
SMALL = 0.01  # of the largest acceleration of all gauges, below which motion along an axis does not count


@dataclass(frozen=True, eq=False)
class GaugeMotion:
    """Motion at a gauge: its name, its initial position [m] (3,) or None where the case does not tell, time [s] (n,), and
    displacement [m], velocity [m/s] and acceleration [m/s2] (n, 3)."""

    name: str
    point: np.ndarray | None
    time: np.ndarray
    displacement: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray

    def record(self, axis):
        """The acceleration along an axis (0 to 2) as a Record."""
        return Record((self.time[-1] - self.time[0]) / (len(self.time) - 1), self.acceleration[:, axis], self.name)


def gauge_motions(results):
    """The GaugeMotion of each gauge with accelerations in its table, in the order of the case; none for fewer than 16 rows or unequal steps."""
    table, points = results.gauge_table, _points(results)
    time = table["time"] if table.rows else np.empty(0)
    if len(time) < 16 or not np.allclose(np.diff(time), time[1] - time[0], rtol=1e-3):
        return []
    names = [column.removesuffix(".acceleration_x") for column in table if column.endswith(".acceleration_x")]

    def columns(name, quantity):
        return np.stack([table[f"{name}.{quantity}_{axis}"] for axis in AXES], axis=1)

    return [GaugeMotion(name, points.get(name), time, *(columns(name, quantity) for quantity in ("displacement", "velocity", "acceleration"))) for name in names]


def case_of(results):
    """The case of a run as a dict; {} where it cannot be read."""
    try:
        return tomllib.loads(results.case_text)
    except tomllib.TOMLDecodeError:
        return {}


def _points(results):
    """Initial positions [m] by the name of the gauge, as far as the case tells them."""
    found = {}
    gauges = case_of(results).get("gauges")
    for gauge in gauges if isinstance(gauges, list) else []:
        point = gauge.get("point") if isinstance(gauge, dict) else None
        if isinstance(point, list) and len(point) == 3 and all(isinstance(value, int | float) for value in point):
            found[gauge.get("name")] = np.array(point, dtype=float)
    return found


def up_axis(results, motions):
    """The axis that points upwards, 1 or 2: against gravity, or z where the gauges differ in it, or y."""
    return _upwards(results, [motion.point for motion in motions if motion.point is not None])


def _upwards(results, points):
    """The axis that points upwards, by gravity or by the points of the gauges."""
    gravity = case_of(results).get("gravity")
    pull = gravity.get("acceleration") if isinstance(gravity, dict) else None
    if isinstance(pull, list) and len(pull) == 3 and any(pull):
        return int(np.argmax(np.abs(np.array(pull, dtype=float))))
    return 2 if points and np.ptp([point[2] for point in points]) > 0.0 else 1


def from_below(results, names):
    """Names of gauges from the lowest to the highest; in the order of the case where it does not tell where each of them is."""
    points = _points(results)
    if any(name not in points for name in names):
        return list(names)
    axis = _upwards(results, [points[name] for name in names])
    return sorted(names, key=lambda name: points[name][axis])


def input_axes(results):
    """The axes (0 to 2) along which the case moves something: supports and sides that follow one of its motions, and waves that come in."""
    entries = [entry for table in case_of(results).values() if isinstance(table, list) for entry in table if isinstance(entry, dict)]
    return [axis for axis, letter in enumerate(AXES) if any(entry.get(f"motion_{letter}") for entry in entries)]


def base_of(results, motions):
    """The lowest gauge; the first one where positions are not known."""
    if any(motion.point is None for motion in motions):
        return motions[0]
    axis = up_axis(results, motions)
    return min(motions, key=lambda motion: motion.point[axis])


def stacks(results, motions):
    """Gauges above each other, from below: lists of at least two, the one with most gauges first.

    Two gauges stand above each other where they are apart sideways by at most a hundredth of the height over which the gauges spread.
    """
    placed = [motion for motion in motions if motion.point is not None]
    axis = up_axis(results, placed)
    sideways = [number for number in range(3) if number != axis]
    near = 0.01 * np.ptp([motion.point[axis] for motion in placed]) if placed else 0.0
    found = []
    for motion in sorted(placed, key=lambda motion: motion.point[axis]):
        home = next((stack for stack in found if np.abs(stack[0].point - motion.point)[sideways].max() <= near), None)
        if home is None:
            found.append([motion])
        elif motion.point[axis] > home[-1].point[axis]:
            home.append(motion)
    return sorted((stack for stack in found if len(stack) > 1), key=len, reverse=True)


def moving_axes(motions):
    """The axes (0 to 2) along which a gauge is accelerated."""
    peaks = np.max([np.abs(motion.acceleration).max(axis=0) for motion in motions], axis=0)
    return [axis for axis in range(3) if peaks[axis] > SMALL * peaks.max()]


def residual(motion, base):
    """Displacement relative to the base at the end [m] (3,); None where the gauge still moves against the base, or never did.

    A gauge has come to rest where over the last fiftieth of the run its velocity relative to the base is below 1 % of its peak.
    """
    relative = np.linalg.norm(motion.velocity - base.velocity, axis=1)
    last = relative[-max(2, round(END * len(relative))) :]
    if relative.max() == 0.0 or last.max() > STILL * relative.max():
        return None
    return motion.displacement[-1] - base.displacement[-1]


def tilt(motion, base):
    """The angle [rad] by which the straight line from the base to a gauge has turned; None where it is not known or there is no residual."""
    moved = residual(motion, base)
    if moved is None or motion.point is None or base.point is None or np.array_equal(motion.point, base.point):
        return None
    before = motion.point - base.point
    after = before + moved
    return float(np.arctan2(np.linalg.norm(np.cross(before, after)), before @ after))


def _row(motion, base, axis):
    nan = float("nan")
    point = [nan] * 3 if motion.point is None else motion.point
    moved, turned = residual(motion, base), tilt(motion, base)
    found = figures(motion.record(axis))
    found["peak_velocity"] = float(np.abs(motion.velocity[:, axis]).max())
    found["peak_displacement"] = float(np.abs(motion.displacement[:, axis]).max())
    return {
        "gauge": motion.name, "axis": AXES[axis], **{f"{name} [m]": value for name, value in zip(AXES, point)},
        "peak_acceleration [m/s2]": found["peak_acceleration"], "peak_acceleration_gal [gal]": found["peak_acceleration"] / GAL,
        **{f"{name} [{FIGURES[name][0]}]": value for name, value in found.items()},
        "peak_relative_displacement [m]": float(np.abs(motion.displacement[:, axis] - base.displacement[:, axis]).max()),
        "residual_displacement [m]": nan if moved is None else moved[axis],
        "residual_tilt [rad]": nan if turned is None else turned,
    }


def gauge_table(results):
    """The figures of every gauge along every axis that moves, as columns for `write_table`; {} where no gauge has accelerations.

    Displacements relative to the base are those against the lowest gauge; peaks of velocity and displacement are those of the run.
    """
    motions = gauge_motions(results)
    if not motions:
        return {}
    base, axes = base_of(results, motions), moving_axes(motions)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # a run is as long as it is
        rows = [_row(motion, base, axis) for motion in motions for axis in axes]
    return {name: [row[name] for row in rows] for name in rows[0]} if rows else {}
