"""The way of a wave through the ground: its field over a section at some times, and traces against height with the travel time of S waves."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from sazare import style
from sazare.base_motion import motion_enters
from sazare.ground_motion.gauges import AXES, gauge_motions, stacks, up_axis
from sazare.outside import outside_of
from sazare.s_waves import LEVELS, VERTEX, cells_at_rest, centres, s_velocities, travel_times
from sazare.shaking import main_axis
from sazare.snapshots import elements_once

ONSET = 0.05  # of the peak acceleration, from which on a wave counts as arrived
MOST_PANELS = 6
FEWEST = 3  # snapshots while the wave goes up, with which its front can be followed
WINDOW = (1.0, 6.0)  # travel times before the arrival, and after it, that traces are shown for
FLAT = 0.2  # height over width, up to which panels stand one above the other
SLENDER = 5.0  # height over width, above which profiles take the place of sections
COLORS = "RdBu_r"


@dataclass(frozen=True)
class Passage:
    """An S wave on its way up: arrival at the lower end [s], travel time [s] to heights [m] from there up (n,), and both ends' names."""

    arrival: float
    heights: np.ndarray
    times: np.ndarray
    names: tuple[str, str]

    @property
    def travel(self):
        """From the lower end to the upper one [s]."""
        return float(self.times[-1])


def passage(results):
    """The Passage of the first wave, from the lowest to the highest gauge of those above each other, else through the middle of the body.

    None where no motion enters, or case and snapshots do not tell the velocities. It has arrived once the acceleration is ONSET of its peak.
    """
    snapshots = results.all_snapshots
    if len(snapshots) < 2 or not motion_enters(results):
        return None
    grid = elements_once(snapshots[0])
    speeds = s_velocities(results, grid)
    if speeds is None:
        return None
    motions = gauge_motions(results)
    found = stacks(results, motions) if motions else []
    up = up_axis(results, motions) if motions else (2 if np.ptp(np.asarray(grid.points)[:, 2]) > 0.0 else 1)
    if found:
        low, high = found[0][0], found[0][-1]
        shaking = np.abs(low.acceleration[:, main_axis(results)])
        arrival = float(low.time[np.argmax(shaking >= ONSET * shaking.max())])
        ends, names = (low.point, high.point), (low.name, high.name)
    else:
        peaks = np.array([_peak(elements_once(snapshot)) for snapshot in snapshots])
        arrival = snapshots[int(np.argmax(peaks >= ONSET * peaks.max()))].time
        middles = centres(grid)
        foot, head = middles.mean(axis=0), middles.mean(axis=0)
        foot[up], head[up] = middles[:, up].min(), middles[:, up].max()
        ends, names = (foot, head), ("the base", "the surface")
    line = np.linspace(*ends, LEVELS)
    return Passage(arrival, line[:, up], travel_times(grid, speeds, line), names)


def _peak(grid):
    """The largest acceleration of a snapshot [m/s2], without the wildest hundredth."""
    values = grid.point_data["acceleration"] if "acceleration" in grid.point_data else grid.cell_data["acceleration"]
    return float(np.percentile(np.linalg.norm(values, axis=1), 99.0))


def _chosen(snapshots, way):
    """Numbers of the snapshots that are shown, and what is said of them where they do not show the wave on its way."""
    times = snapshots.times if hasattr(snapshots, "times") else np.array([snapshot.time for snapshot in snapshots])
    going = np.flatnonzero((times >= way.arrival - 1e-9) & (times <= way.arrival + 1.25 * way.travel))
    if len(going) >= FEWEST:
        return [int(number) for number in np.unique(going[np.linspace(0, len(going) - 1, MOST_PANELS).round().astype(int)])], ""
    peaks = np.array([_peak(elements_once(snapshot)) for snapshot in snapshots])
    chosen = sorted(int(number) for number in np.argsort(-peaks)[:4] if peaks[number] > 0.0)
    interval = style.quantity(float(np.median(np.diff(times))), "s")
    better = style.quantity(style.round_factor(way.travel / MOST_PANELS), "s")
    return chosen, (f"The snapshots are {interval} apart, and an S wave takes {style.quantity(way.travel, 's')} from {way.names[0]} to {way.names[1]}: they do not hold its\n"
                    f"front on the way. Shown are those of the largest accelerations; snapshot_interval = {better}, and a history_interval that is no longer, would follow it.")


@dataclass(frozen=True)
class _Face:
    """A section through the body: places [m] (n, 2), triangles (m, 3) between them or None, and the accelerations of the places [m/s2] (n,)."""

    places: np.ndarray
    triangles: Any
    values: np.ndarray


def _face(grid, axis, up):
    """A vertical section along x: the plane itself, or through the middle of a body in space."""
    if int(np.asarray(grid.celltypes)[0]) == VERTEX:
        places, values = centres(grid), np.asarray(grid.cell_data["acceleration"])[:, axis]
        if up == 2:
            away = np.abs(places[:, 1] - 0.5 * (places[:, 1].min() + places[:, 1].max()))
            near = away < away.min() + 0.75 * float(np.median(grid.cell_data["spacing"]))
            places, values = places[near], values[near]
        return _Face(places[:, [0, up]], None, values)
    rest = cells_at_rest(grid)
    if up == 2:
        cut = rest.slice(normal="y").triangulate()
        triangles = np.asarray(cut.faces).reshape(-1, 4)[:, 1:]
        places, shaking = np.asarray(cut.points), np.asarray(cut.point_data["acceleration"])
    else:
        triangles, places, shaking = outside_of(rest).corners, np.asarray(rest.points), np.asarray(rest.point_data["acceleration"])
    used, corners = np.unique(triangles, return_inverse=True)
    return _Face(places[used][:, [0, up]], corners.reshape(-1, 3), shaking[used, axis])


@style.styled
def fronts(results):
    """Acceleration [m/s2] along the axis of the input motion over a section, or of a column against height, at times while the first wave goes up."""
    way = passage(results)
    if way is None:
        return None
    snapshots, axis = results.all_snapshots, main_axis(results)
    chosen, words = _chosen(snapshots, way)
    if not chosen:
        return None
    grids = [elements_once(snapshots[number]) for number in chosen]
    up = 2 if np.ptp(centres(grids[0])[:, 2]) > 0.0 else 1
    faces = [_face(grid, axis, up) for grid in grids]
    extent = np.ptp(faces[0].places, axis=0)
    draw = _profiles if extent[1] > SLENDER * extent[0] else _fields
    return draw(faces, [snapshots[number].time for number in chosen], (AXES[axis], AXES[up]), words)


def _profiles(faces, times, names, words):
    """Accelerations of a column against height, a line for each time."""
    figure = style.figure(6.4, 4.8)
    axes = figure.subplots()
    factor, prefix = style.prefix_of(*(face.values for face in faces))
    for number, (face, time) in enumerate(zip(faces, times)):
        heights, row = np.unique(np.round(face.places[:, 1], 9), return_inverse=True)
        mean = np.bincount(row.ravel(), weights=face.values) / np.bincount(row.ravel())
        axes.plot(mean / factor, heights, color=style.SPEED(0.15 + 0.8 * number / max(1, len(faces) - 1)), linewidth=1.4, label=style.quantity(time, "s", 4))
    axes.set(xlabel=f"acceleration along {names[0]} [{prefix}m/s²]", ylabel=f"{names[1]} [m]")
    axes.margins(y=0)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))
    _tell(figure, words)
    return figure


def _fields(faces, times, names, words):
    """Accelerations over a section, a panel for each time, with one scale of colours."""
    low, high = faces[0].places.min(axis=0), faces[0].places.max(axis=0)
    width, height = high - low
    columns = 2 if height > FLAT * width and len(faces) > 1 else 1
    rows = -(-len(faces) // columns)
    each = min(8.0 / columns * height / width, 4.5)
    figure = style.figure(9.0, 0.7 + rows * (each + 0.55))
    panels = np.ravel(figure.subplots(rows, columns, squeeze=False, sharex=True, sharey=True))
    top, clipped = style.clipped_top(np.abs(np.concatenate([face.values for face in faces])))
    factor, prefix = style.prefix_for(top)
    for axes, face, time in zip(panels, faces, times):
        drawn = _draw(axes, face, factor, top, (8.0 / columns, each))
        axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), title=style.quantity(time, "s", 4), xlabel="x [m]", ylabel=f"{names[1]} [m]")
        axes.set_aspect("equal")
        axes.grid(False)
        axes.label_outer()
    for axes in panels[len(faces):]:
        axes.set_axis_off()
    style.colorbar(figure, drawn, list(panels), f"acceleration along {names[0]} [{prefix}m/s²]", clipped, extend="both" if clipped else "neither")
    _tell(figure, words)
    return figure


def _tell(figure, words):
    if words:
        figure.suptitle(words, fontsize=9.0, x=0.01, ha="left")


def _draw(axes, face, factor, top, room):
    scale = {"cmap": COLORS, "vmin": -top / factor, "vmax": top / factor}
    if face.triangles is not None:
        return axes.tripcolor(*face.places.T, face.values / factor, triangles=face.triangles, shading="gouraud", **scale)
    area = 72.0**2 * room[0] * room[1] / len(face.places)
    return axes.scatter(*face.places.T, c=face.values / factor, s=float(np.clip(1.2 * area, 1.5, 200.0)), marker="s", linewidths=0, **scale)


@style.styled
def section(results):
    """Acceleration at gauges above each other against time, each trace at its height, and when an S wave would pass: up, and down again."""
    motions = gauge_motions(results)
    found = stacks(results, motions) if motions else []
    way = passage(results) if found else None
    if way is None:
        return None
    stack, axis, up = found[0], main_axis(results), up_axis(results, motions)
    time = stack[0].time
    begin, end = way.arrival - WINDOW[0] * way.travel, way.arrival + WINDOW[1] * way.travel
    shown = (time >= begin) & (time <= end)
    if shown.sum() < 2:
        return None
    heights = [motion.point[up] for motion in stack]
    traces = [motion.acceleration[shown, axis] for motion in stack]
    top = max(float(np.abs(trace).max()) for trace in traces) or 1.0
    gap = 0.9 * (heights[-1] - heights[0]) / (len(heights) - 1)
    figure = style.figure(9.0, 4.6)
    axes = figure.subplots()
    for trace, height in zip(traces, heights):
        axes.plot(time[shown], height + gap * trace / top, color=style.SECOND, linewidth=1.1)
        axes.axhline(height, color=style.GRID, linewidth=0.6)
    axes.plot(way.arrival + way.times, way.heights, color=style.ACCENT, linewidth=1.5, label="S wave up, at the velocities of small strains")
    axes.plot(way.arrival + 2.0 * way.travel - way.times, way.heights, color=style.ACCENT, linewidth=1.2, linestyle="--", label="and down again")
    axes.set(xlim=(max(begin, time[0]), min(end, time[-1])), xlabel="time [s]", ylabel=f"{AXES[up]} [m]")
    axes.set_title(f"acceleration along {AXES[axis]}; the largest one shown is {style.quantity(top, 'm/s²')}")
    beside = axes.secondary_yaxis("right")
    beside.set_yticks(heights, [motion.name for motion in stack])
    axes.set_yticks(heights)
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, -0.12), ncols=2)
    return figure
