"""Peak shear strain and shear stress over depth, from the motion of gauges that stand above each other."""

from dataclasses import dataclass

import numpy as np

from sazare.ground_motion.gauges import AXES, case_of, gauge_motions, moving_axes, stacks, up_axis
from sazare.s_waves import LEVELS, s_velocities, travel_times
from sazare.snapshots import elements_once

MOST_APART = 0.8  # two gauges, in radians of the wave that passes both; stress is then off by some 5 %


@dataclass(frozen=True, eq=False)
class ShearHistory:
    """Shear between each gauge of a stack and the next one above it: heights of their middles [m] (k,), time [s] (n,), engineering shear
    strain [-] (n, k), and shear stress [Pa] (n, k), or None where the density or the ground above the gauges is not known. `resolved` (k,) says where
    two gauges are near enough to each other for the waves that pass."""

    height: np.ndarray
    time: np.ndarray
    strain: np.ndarray
    stress: np.ndarray | None = None
    resolved: np.ndarray | None = None

    def peaks(self):
        """The largest strains [-] and stresses [Pa] (k,), nan where gauges here or, of stresses, above are too far apart, or the density is not known."""
        resolved = np.ones(len(self.height), dtype=bool) if self.resolved is None else self.resolved
        strain = np.where(resolved, np.abs(self.strain).max(axis=0), np.nan)
        if self.stress is None:
            return strain, np.full(len(strain), np.nan)
        above = np.logical_and.accumulate(resolved[::-1])[::-1]
        return strain, np.where(above, np.abs(self.stress).max(axis=0), np.nan)


def places(results, stack):
    """Where the particles or nodes that stand for gauges are at the beginning [m] (k, 3): those nearest to the points of the case, in the first
    snapshot. The points themselves where there is none."""
    points = np.array([motion.point for motion in stack])
    for snapshots, data in ((results.particle_snapshots, "cell_data"), (results.element_snapshots, "point_data")):
        if not len(snapshots):
            continue
        grid = elements_once(snapshots[0])
        if "displacement" not in getattr(grid, data):
            continue
        start = np.asarray(grid.points) - np.asarray(getattr(grid, data)["displacement"])
        return np.array([start[_nearest(start, point)] for point in points])
    return points


def _nearest(start, point):
    """The first of those as near as the nearest one, as the engine chooses."""
    distance = np.linalg.norm(start - point, axis=1)
    return int(np.flatnonzero(distance <= distance.min() * (1.0 + 1e-9) + 1e-9)[0])


def shear_history(stack, axis, heights, density=None, above=0.0, travel=None):
    """The ShearHistory of gauges above each other (from below, as `stacks` gives them) along an axis (0 to 2) across the vertical one.

    The strain is what the displacement of two gauges differs by, over their distance, hence its mean between them. The stress is what
    moves the ground above, of level layers without a load on their surface:

        s(z) = -(integral of density times acceleration, from z to the surface)

    with accelerations that are linear between gauges. Both have the sign of the strain: positive where the upper one goes forward.

    heights: of the gauges [m] (k + 1,), from below; density: between each gauge and the next one above it [kg/m3] (k,), or one number; above: mass of the ground above the highest gauge per
    area [kg/m2], which is taken to move as that gauge does; travel: of S waves between each gauge and the next one above it [s] (k,), by which `resolved` is known: their travel time times the
    central frequency of the motion, the root of the mean squares of accelerations over velocities, is at most MOST_APART.
    """
    heights = np.asarray(heights, dtype=float)
    apart = np.diff(heights)
    moved = np.stack([motion.displacement[:, axis] for motion in stack], axis=1)
    strain = np.diff(moved, axis=1) / apart
    middle, time = 0.5 * (heights[1:] + heights[:-1]), stack[0].time
    pushed = np.stack([motion.acceleration[:, axis] for motion in stack], axis=1)
    resolved = None
    if travel is not None:
        moving = np.stack([motion.velocity[:, axis] for motion in stack], axis=1)
        resolved = np.asarray(travel) * np.linalg.norm(pushed) <= MOST_APART * np.linalg.norm(moving)
    if density is None:
        return ShearHistory(middle, time, strain, None, resolved)
    density = np.broadcast_to(np.asarray(density, dtype=float), apart.shape)
    lower, upper = pushed[:, :-1], pushed[:, 1:]
    whole = density * apart * 0.5 * (lower + upper)
    half = density * 0.5 * apart * (0.25 * lower + 0.75 * upper)  # from the middle upwards
    above_each = np.cumsum(whole[:, ::-1], axis=1)[:, ::-1] - whole + above * pushed[:, -1:]
    return ShearHistory(middle, time, strain, -(half + above_each), resolved)


def ground_of(results, points, up):
    """Densities [kg/m3] between gauges at places above each other, and the mass above the highest one per area [kg/m2]; (None, 0.0) where the run does
    not tell.

    They are those of the particles that are next to the gauges at the beginning, by their material in the case, or of the finite elements in which the
    gauges stand.
    """
    sideways = [number for number in range(3) if number != up]
    rows = _rows_of_particles(results, points, up, sideways) or _rows_of_elements(results, points, up, sideways)
    if rows is None:
        return None, 0.0
    gauges, top = points[:, up], rows.high.max()
    between = [rows.mean_density(low, high) for low, high in zip(gauges, gauges[1:])]
    return np.array(between), (top - gauges[-1]) * rows.mean_density(gauges[-1], top)


@dataclass(frozen=True, eq=False)
class _Rows:
    """Ground beside gauges: lower and upper ends [m] and densities [kg/m3] of its parts."""

    low: np.ndarray
    high: np.ndarray
    density: np.ndarray

    def mean_density(self, low, high):
        """Mean over a range of heights [m]; that of the nearest part where none lies in it."""
        part = np.clip(np.minimum(self.high, high) - np.maximum(self.low, low), 0.0, None)
        nearest = np.argmin(np.abs(0.5 * (self.low + self.high) - 0.5 * (low + high)))
        return float(part @ self.density / part.sum()) if part.sum() > 0.0 else float(self.density[nearest])


def _rows_of_particles(results, points, up, sideways):
    snapshots = results.particle_snapshots
    if not len(snapshots):
        return None
    grid = elements_once(snapshots[0])
    if not {"material", "displacement", "spacing"} <= set(grid.cell_data.keys()):
        return None
    start = np.asarray(grid.points) - np.asarray(grid.cell_data["displacement"])
    spacing = float(np.median(grid.cell_data["spacing"]))
    near = np.linalg.norm((start - points[0])[:, sideways], axis=1)
    column = near < near.min() + 0.25 * spacing
    materials = case_of(results).get("materials", [])
    numbers = np.asarray(grid.cell_data["material"])[column]
    if not column.any() or len(materials) <= int(numbers.max()):
        return None
    densities = np.array([material["density"] for material in materials], dtype=float)[numbers]
    height, first = np.unique(np.round(start[column, up] / spacing, 3), return_index=True)
    return _Rows((height - 0.5) * spacing, (height + 0.5) * spacing, densities[first])


def _rows_of_elements(results, points, up, sideways):
    snapshots = results.element_snapshots
    if not len(snapshots):
        return None
    grid = elements_once(snapshots[0])
    if "density" not in grid.cell_data or "displacement" not in grid.point_data:
        return None
    start = np.asarray(grid.points) - np.asarray(grid.point_data["displacement"])
    corners, begin = start[grid.cell_connectivity], grid.offset[:-1]
    low, high = np.minimum.reduceat(corners, begin), np.maximum.reduceat(corners, begin)
    slack = 1e-6 * float(np.ptp(start, axis=0).max())
    beside = np.all((low[:, sideways] <= points[0][sideways] + slack) & (high[:, sideways] >= points[0][sideways] - slack), axis=1)
    column = beside & (high[:, up] > low[:, up]) & np.isfinite(grid.cell_data["density"])
    return _Rows(low[column, up], high[column, up], np.asarray(grid.cell_data["density"])[column]) if column.any() else None


def shear_history_of(results, stack, axis, up):
    """The ShearHistory of a stack of a run; None where two of its gauges are at one particle or node. up: the vertical axis (1 or 2)."""
    points = places(results, stack)
    if not np.all(np.diff(points[:, up]) > 0.0):
        return None
    return shear_history(stack, axis, points[:, up], *ground_of(results, points, up), travel_of(results, points))


def travel_of(results, points):
    """Travel times of S waves of small strains from each place [m] (k + 1, 3) to the next one [s] (k,); None where the run does not tell."""
    snapshots = results.all_snapshots
    if not len(snapshots):
        return None
    grid = elements_once(snapshots[0])
    speeds = s_velocities(results, grid)
    if speeds is None:
        return None
    return np.array([travel_times(grid, speeds, np.linspace(low, high, LEVELS))[-1] for low, high in zip(points, points[1:])])


def profile_table(results):
    """The peaks between neighbouring gauges above each other, along every horizontal axis that moves, as columns for `write_table`; {} without."""
    motions = gauge_motions(results)
    found = stacks(results, motions) if motions else []
    if not found:
        return {}
    up = up_axis(results, motions)
    rows = [row for stack in found for axis in moving_axes(motions) if axis != up for row in _rows(results, stack, axis, up)]
    return {name: [row[name] for row in rows] for name in rows[0]} if rows else {}


def _rows(results, stack, axis, up):
    history = shear_history_of(results, stack, axis, up)
    if history is None:
        return
    strain, stress = history.peaks()
    for k, height in enumerate(history.height):
        yield {
            "below": stack[k].name, "above": stack[k + 1].name, "axis": AXES[axis], "height [m]": height,
            "peak_shear_strain [-]": strain[k], "peak_shear_stress [Pa]": stress[k],
        }
