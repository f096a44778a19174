"""Peak shear strain and shear stress over depth, from the motion of gauges that stand above each other."""

from dataclasses import dataclass

import numpy as np

from sazare.ground_motion.gauges import AXES, case_of, gauge_motions, moving_axes, stacks, up_axis
from sazare.snapshots import elements_once


@dataclass(frozen=True, eq=False)
class ShearHistory:
    """Shear between each gauge of a stack and the next one above it: heights of their middles [m] (k,), time [s] (n,), engineering shear
    strain [-] (n, k), and shear stress [Pa] (n, k), or None where the density or the ground above the gauges is not known."""

    height: np.ndarray
    time: np.ndarray
    strain: np.ndarray
    stress: np.ndarray | None = None


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


def shear_history(stack, axis, heights, density=None, above=0.0):
    """The ShearHistory of gauges above each other (from below, as `stacks` gives them) along an axis (0 to 2) across the vertical one.

    The strain is what the displacement of two gauges differs by, over their distance, hence its mean between them. The stress is what
    moves the ground above, of level layers without a load on their surface:

        s(z) = -(integral of density times acceleration, from z to the surface)

    with accelerations that are linear between gauges. Both have the sign of the strain: positive where the upper one goes forward.

    heights: of the gauges [m] (k + 1,), from below; density: between each gauge and the next one above it [kg/m3] (k,), or one number; above: mass of the ground above the highest gauge per
    area [kg/m2], which is taken to move as that gauge does.
    """
    heights = np.asarray(heights, dtype=float)
    apart = np.diff(heights)
    moved = np.stack([motion.displacement[:, axis] for motion in stack], axis=1)
    strain = np.diff(moved, axis=1) / apart
    middle, time = 0.5 * (heights[1:] + heights[:-1]), stack[0].time
    if density is None:
        return ShearHistory(middle, time, strain)
    pushed = np.stack([motion.acceleration[:, axis] for motion in stack], axis=1)
    density = np.broadcast_to(np.asarray(density, dtype=float), apart.shape)
    lower, upper = pushed[:, :-1], pushed[:, 1:]
    whole = density * apart * 0.5 * (lower + upper)
    half = density * 0.5 * apart * (0.25 * lower + 0.75 * upper)  # from the middle upwards
    above_each = np.cumsum(whole[:, ::-1], axis=1)[:, ::-1] - whole + above * pushed[:, -1:]
    return ShearHistory(middle, time, strain, -(half + above_each))


def ground_of(results, points, up):
    """Densities [kg/m3] between gauges at places above each other, and the mass above the highest one per area [kg/m2]; (None, 0.0) where the run does
    not tell.

    They are those of the particles of method mps at the beginning that are next to the gauges, by their material in the case.
    """
    snapshots = results.particle_snapshots
    if not len(snapshots) or results.manifest.get("method") != "mps":
        return None, 0.0
    grid = elements_once(snapshots[0])
    if not {"material", "displacement", "spacing"} <= set(grid.cell_data.keys()):
        return None, 0.0
    start = np.asarray(grid.points) - np.asarray(grid.cell_data["displacement"])
    spacing = float(np.median(grid.cell_data["spacing"]))
    sideways = [number for number in range(3) if number != up]
    near = np.linalg.norm((start - points[0])[:, sideways], axis=1)
    column = near < near.min() + 0.25 * spacing
    materials = case_of(results).get("materials", [])
    numbers = np.asarray(grid.cell_data["material"])[column]
    if not column.any() or len(materials) <= int(numbers.max()):
        return None, 0.0
    densities = np.array([material["density"] for material in materials], dtype=float)[numbers]
    height, first = np.unique(np.round(start[column, up] / spacing, 3), return_index=True)
    height, densities = height * spacing, densities[first]
    gauges, top = points[:, up], height[-1] + 0.5 * spacing
    between = [_mean_density(height, densities, spacing, low, high) for low, high in zip(gauges, gauges[1:])]
    return np.array(between), (top - gauges[-1]) * _mean_density(height, densities, spacing, gauges[-1], top)


def _mean_density(height, density, spacing, low, high):
    """Mean over a range of heights [m], of rows that are `spacing` thick; the nearest row where none lies in it."""
    part = np.clip(np.minimum(height + 0.5 * spacing, high) - np.maximum(height - 0.5 * spacing, low), 0.0, None)
    return float(part @ density / part.sum()) if part.sum() > 0.0 else float(density[np.argmin(np.abs(height - 0.5 * (low + high)))])


def shear_history_of(results, stack, axis, up):
    """The ShearHistory of a stack of a run; None where two of its gauges are at one particle or node. up: the vertical axis (1 or 2)."""
    points = places(results, stack)
    if not np.all(np.diff(points[:, up]) > 0.0):
        return None
    return shear_history(stack, axis, points[:, up], *ground_of(results, points, up))


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
    strain = np.abs(history.strain).max(axis=0)
    stress = np.full(len(strain), np.nan) if history.stress is None else np.abs(history.stress).max(axis=0)
    for k, height in enumerate(history.height):
        yield {
            "below": stack[k].name, "above": stack[k + 1].name, "axis": AXES[axis], "height [m]": height,
            "peak_shear_strain [-]": strain[k], "peak_shear_stress [Pa]": stress[k],
        }
