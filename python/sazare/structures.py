"""What an earthquake leaves of structures: residual displacement, settlement and tilt, and their largest values, against the base or a gauge.

    import sazare
    from sazare.structures import structure_table
    table = structure_table(sazare.open("runs/quay-wall"), reference="far surface")

A structure is a region of a finite element mesh that ends within the ground, a block of squares, a clump of spheres, two gauges on one body whose
names differ in their last word alone (`wall top`, `wall foot`), or else a single gauge, which has no tilt. Of a body it is the rigid motion that fits best
at each snapshot, and of gauges every row of their table counts.
"""

import tomllib
from dataclasses import dataclass

import numpy as np

from sazare.ground_motion.gauges import GaugeMotion, base_of, gauge_motions, input_axes, residual, up_axis
from sazare.model.parts import Opened, region_names
from sazare.shaking import main_axis
from sazare.snapshots import elements_once

NEAR = 1e-6  # of the extent of a mesh: as close to its end counts as there
MOST = 40  # structures; of more bodies than that each is no structure
UPPER, LOWER = ("top", "crest", "head"), ("foot", "toe", "bottom", "base", "sole", "below")


@dataclass(frozen=True, eq=False)
class StructureMotion:
    """Motion of a structure against a reference: its name, what tells it, time [s] (n,), displacement [m] (n, 3) of its middle, and the tilt
    [degrees] (n,) of what was vertical, positive towards the positive axis of the input motion; nan where there is none."""

    name: str
    source: str
    time: np.ndarray
    displacement: np.ndarray
    tilt: np.ndarray
    at_rest: bool = True


@dataclass(frozen=True, eq=False)
class _Against:
    """What motions are relative to: a gauge, or None for the places at the beginning; in words; the axis of the input motion, and that upwards."""

    gauge: GaugeMotion | None
    name: str
    axis: int
    up: int


def _lean(vertical, axis, up):
    """The angle [degrees] between the vertical axis and a direction (n, 3), positive towards an axis."""
    sideways = np.delete(vertical, up, axis=1)
    return np.degrees(np.arctan2(np.linalg.norm(sideways, axis=1), vertical[:, up])) * np.where(vertical[:, axis] < 0.0, -1.0, 1.0)


def _turned(before, after):
    """The rotation (3, 3) that takes places (n, 3) about their middle to others best, by least squares [Kabsch1976]."""
    left, _, right = np.linalg.svd((before - before.mean(axis=0)).T @ (after - after.mean(axis=0)))
    mirrored = np.sign(np.linalg.det(right.T @ left.T))
    return right.T @ np.diag([1.0, 1.0, mirrored or 1.0]) @ left.T


def _sides(results):
    return list(results.sides.values()) if results.sides else [results]


def _against(results, reference):
    """The _Against of a run. Raises ValueError where there is no gauge of the name of the reference."""
    known = [(side, gauge_motions(side)) for side in _sides(results)]
    names = [motion.name for _, motions in known for motion in motions]
    if reference is not None and reference not in names:
        raise ValueError(f"no gauge {reference!r} with accelerations; there are: {', '.join(names) or 'none'}")
    for side, motions in known:
        chosen = [motion for motion in motions if reference in (None, motion.name)]
        if chosen:
            gauge = base_of(side, chosen)
            up = up_axis(side, motions)
            return _Against(gauge, gauge.name, _level_axis(side, motions, up), up)
    first = known[0][0]
    return _Against(None, "the beginning", next(iter(input_axes(first)), 0), _up_of(first))


def _level_axis(results, motions, up):
    """The axis of the input motion; where that is vertical, or there is none, the level axis along which the gauges go farthest."""
    axis = main_axis(results)
    if axis != up:
        return axis
    ways = np.max([np.abs(motion.displacement).max(axis=0) for motion in motions], axis=0)
    ways[up] = -1.0
    return int(np.argmax(ways))


def _moved(reference, time):
    """Displacement of the reference at some times [m] (n, 3); none without a reference."""
    if reference is None:
        return np.zeros((len(time), 3))
    return np.stack([np.interp(time, reference.time, reference.displacement[:, axis]) for axis in range(3)], axis=1)


def _case(results):
    try:
        return tomllib.loads(results.case_text)
    except tomllib.TOMLDecodeError:
        return {}


def _bodies(results, grid, up):
    """Points of a snapshot by the name of the structure that they belong to."""
    case = _case(results)
    if "region" in grid.cell_data and "displacement" in grid.point_data:
        return _regions(results, case, grid, up)
    for key, table in (("block", "blocks"), ("body", "bodies")):
        if key in grid.cell_data:
            return _numbered(grid, np.asarray(grid.cell_data[key]), key, [entry.get("name") for entry in case.get(table, []) if isinstance(entry, dict)])
    return {}


def _regions(results, case, grid, up):
    """Regions of a mesh that reach neither its sides nor its bottom, on which the ground goes on; all where there is one only."""
    names = region_names(Opened(results, case))
    cells, points = np.asarray(grid.cell_data["region"]), np.asarray(grid.points) - np.asarray(grid.point_data["displacement"])
    of_cells, offsets = np.asarray(grid.cell_connectivity), np.asarray(grid.offset)
    low, high = points.min(axis=0), points.max(axis=0)
    slack = NEAR * (high - low).max()
    sides = [axis for axis in range(3) if axis != up and high[axis] - low[axis] > slack]
    found = {}
    for number, name in enumerate(names):
        own = np.unique(np.concatenate([of_cells[offsets[cell]:offsets[cell + 1]] for cell in np.flatnonzero(cells == number)] or [np.empty(0, dtype=int)]))
        if not len(own):
            continue
        first, last = points[own].min(axis=0), points[own].max(axis=0)
        ends = first[up] <= low[up] + slack or any(first[axis] <= low[axis] + slack or last[axis] >= high[axis] - slack for axis in sides)
        if not ends or len(names) == 1:
            found[name] = own
    return found


def _numbered(grid, numbers, word, names):
    """Points by the number of their body, which has a name where the case gives one to each."""
    chosen = [number for number in np.unique(numbers) if number >= 0]
    if not 0 < len(chosen) <= MOST:
        return {}
    of_cells, offsets = np.asarray(grid.cell_connectivity), np.asarray(grid.offset)

    def points(number):
        return np.unique(np.concatenate([of_cells[offsets[cell]:offsets[cell + 1]] for cell in np.flatnonzero(numbers == number)]))

    named = len(names) > int(max(chosen)) and all(names)
    return {names[number] if named else f"{word} {number}": points(number) for number in chosen}


def _by_bodies(results, against):
    """The StructureMotion of each body, at the snapshots."""
    snapshots = results.all_snapshots
    if len(snapshots) < 2:
        return []
    first = elements_once(snapshots[0])
    up = against.up
    bodies = _bodies(results, first, up)
    if not bodies:
        return []
    moved = np.asarray(first.point_data["displacement"]) if "displacement" in first.point_data else 0.0
    before = np.asarray(first.points) - moved
    paths = {name: ([], []) for name in bodies}
    for snapshot in snapshots:
        places = np.asarray(elements_once(snapshot).points)
        if len(places) != len(before):
            return []
        for name, own in bodies.items():
            paths[name][0].append(places[own].mean(axis=0) - before[own].mean(axis=0))
            paths[name][1].append(_turned(before[own], places[own])[:, up] if len(own) > 1 else np.full(3, np.nan))
    time = np.array([snapshot.time for snapshot in snapshots])
    ground = _moved(against.gauge, time)
    return [StructureMotion(name, "body", time, np.array(way) - ground, _lean(np.array(turns), against.axis, up)) for name, (way, turns) in paths.items()]


def _halves(motions):
    """Pairs of gauges on one body, by its name: the upper and the lower one."""
    found = {}
    for motion in motions:
        name, _, end = motion.name.rpartition(" ")
        if name and end in UPPER + LOWER and motion.point is not None:
            found.setdefault(name, {})["upper" if end in UPPER else "lower"] = motion
    return {name: (pair["upper"], pair["lower"]) for name, pair in found.items() if len(pair) == 2}


def _by_gauges(motions, against):
    """The StructureMotion of each pair of gauges on one body, and of each other gauge."""
    reference, axis, up = against.gauge, against.axis, against.up
    pairs = _halves(motions)
    paired = {motion.name for pair in pairs.values() for motion in pair}
    found = []
    for name, (upper, lower) in pairs.items():
        middle = GaugeMotion(name, None, upper.time, *(0.5 * (getattr(upper, each) + getattr(lower, each)) for each in ("displacement", "velocity", "acceleration")))
        line = (upper.point - lower.point) + upper.displacement - lower.displacement
        start = (upper.point - lower.point)[None]
        found.append(StructureMotion(name, "two gauges", upper.time, middle.displacement - reference.displacement,
                                     _lean(line, axis, up) - _lean(start, axis, up), residual(middle, reference) is not None))
    for motion in motions:
        is_reference = motion.name == reference.name and np.array_equal(motion.displacement, reference.displacement)
        if not is_reference and motion.name not in paired:
            found.append(StructureMotion(motion.name, "gauge", motion.time, motion.displacement - reference.displacement,
                                         np.full(len(motion.time), np.nan), residual(motion, reference) is not None))
    return found


def structure_motions(results, reference=None):
    """The StructureMotion of each structure of a run; of a coupled run, those of both sides.

    reference: the name of a gauge that motions are relative to; the lowest gauge where it is None, and the place at the beginning where a run
    has no gauges. Raises ValueError where there is no such gauge.
    """
    return _motions(results, _against(results, reference))


def _motions(results, against):
    found = []
    for side in _sides(results):
        own = gauge_motions(side)
        found += _by_bodies(side, against)
        if against.gauge is not None and own and np.array_equal(own[0].time, against.gauge.time):
            found += _by_gauges(own, against)
    return found


def _up_of(results):
    """The vertical axis of a run without gauges: against gravity, or z where its bodies have an extent along it."""
    pull = _case(results).get("gravity", {}).get("acceleration")
    if pull and any(pull):
        return int(np.argmax(np.abs(np.array(pull, dtype=float))))
    snapshots = results.all_snapshots
    return 2 if len(snapshots) and np.ptp(np.asarray(elements_once(snapshots[0]).points)[:, 2]) > 0.0 else 1


def _row(motion, against):
    level, down, tilt = motion.displacement[:, against.axis], -motion.displacement[:, against.up], motion.tilt
    far = int(np.argmax(np.abs(level)))
    leans = tilt[int(np.nanargmax(np.abs(tilt)))] if np.isfinite(tilt).any() else np.nan
    return {
        "structure": motion.name, "from": motion.source, "against": against.name, "axis": "xyz"[against.axis],
        "residual_displacement [m]": level[-1], "peak_displacement [m]": level[far],
        "residual_settlement [m]": down[-1], "peak_settlement [m]": down[int(np.argmax(np.abs(down)))],
        "residual_tilt [deg]": tilt[-1], "peak_tilt [deg]": leans, "at_rest [-]": float(motion.at_rest),
    }


def structure_table(results, reference=None):
    """What remains of every structure and its largest values, as columns for `write_table`; {} for a run without structures and gauges.

    Displacement is along the axis of the input motion, settlement downwards, both with their sign, tilt positive towards that axis. `at_rest` is
    0 for a gauge that still moves against the reference at the end. Raises ValueError as `structure_motions`.
    """
    against = _against(results, reference)
    rows = [_row(motion, against) for motion in _motions(results, against)]
    return {name: [row[name] for row in rows] for name in rows[0]} if rows else {}
