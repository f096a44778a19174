"""The body of a run of method blocks: its extent, its broken joints in every snapshot, and the views that suit it."""

from functools import cached_property

import numpy as np

from sazare import style
from sazare.moments import moments
from sazare.scenes import MARGIN, PlaneView, SolidView

# A body is a slab where its smallest extent is under this part of the next one.
SLAB_RATIO = 0.35

# What flies off, as shares of the body's extent: how far magnified displacements may carry all but a fiftieth of its volume, and from where on an
# element is left out of a picture.
MOST_SPREAD, OUT_OF_FRAME = 0.15, 0.3
MOST_DISTORTION = 0.3  # of the length of an edge, in a picture

# From this `state` of a joint on, it is a crack: broken, or sheared and pressed together.
CRACK, SHEARED = 2, 3


def _edges(mesh):
    """Numbers (n, 6) of the edges of every tetrahedron; edges at one place have one number, though no tetrahedra share points."""
    corners = np.asarray(mesh.cell_connectivity).reshape(-1, 4)
    places = np.asarray(mesh.points)
    grid = np.round(places / (1e-7 * max(np.ptp(places, axis=0).max(), 1e-30))).astype(np.int64)
    _, vertex = np.unique(grid, axis=0, return_inverse=True)
    pairs = np.sort(np.ravel(vertex)[corners][:, [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]], axis=2).astype(np.int64)
    return np.unique(pairs[..., 0] * (pairs.max(initial=0) + 1) + pairs[..., 1], return_inverse=True)[1].reshape(-1, 6)


def colors_of_neighbors(group, edges, colors):
    """A number below `colors` for every group of elements; groups that share edges have different ones wherever there are enough.

    group (n,): of every element, counted from 0. edges (n, 6): numbers of its edges.
    """
    count = int(group.max(initial=-1)) + 1
    pairs = np.unique(np.stack([edges.ravel(), np.repeat(group, edges.shape[1])], axis=1), axis=0)
    meeting = [[] for _ in range(count)]
    for groups in np.split(pairs[:, 1], np.flatnonzero(np.diff(pairs[:, 0])) + 1):
        for one in groups if len(groups) > 1 else ():
            meeting[one].extend(groups[groups != one])
    chosen, used = np.full(count, -1), np.zeros(colors)
    for one in np.argsort(-np.bincount(group, minlength=count), kind="stable"):
        around = chosen[meeting[one]] if meeting[one] else np.empty(0, dtype=int)
        near = np.bincount(around[around >= 0], minlength=colors)
        chosen[one] = np.lexsort((used, near))[0]
        used[chosen[one]] += 1
    return chosen


def _exceeded(values, weights, share):
    """The value [>0] that a share of the weight exceeds, of values (n,) with weights (n,)."""
    order = np.argsort(values)[::-1]
    value = values[order][np.searchsorted(np.cumsum(weights[order]), share * weights.sum())]
    return max(float(value), 1e-30)


def _magnified(first, now, factor):
    """Points (4 n, 3) of elements whose corners (n, 4, 3) have moved from the first places to those of now, with the displacements times a factor: of every
    corner, or of the centre alone where an edge would change by more than a part of its length."""
    corners = first + factor * (now - first)
    before, after = (np.linalg.norm(points - np.roll(points, 1, axis=1), axis=2) for points in (first, corners))
    turned = np.any(np.abs(after - before) > MOST_DISTORTION * before, axis=1)
    corners[turned] = now[turned] + (factor - 1.0) * (now[turned] - first[turned]).mean(axis=1, keepdims=True)
    return corners.reshape(-1, 3)


class Body:
    """The elements of a run from snapshot to snapshot: their first places, their extent, and the views that suit them."""

    def __init__(self, snapshots):
        self.snapshots = snapshots
        self.first = snapshots[0].elements
        self.bounds = tuple(self.first.bounds)
        self.extents = np.ptp(np.array(self.bounds).reshape(3, 2), axis=1)
        thin, middle, _ = np.sort(self.extents)
        self.is_slab = bool(thin < SLAB_RATIO * middle)
        self.thin_axis = int(np.argmin(self.extents))
        self.break_time = self._break_time()

    def _break_time(self):
        """Per joint, the time of the first snapshot in which it is broken, inf for never; None where joints are not alike."""
        times = None
        for snapshot in self.snapshots:
            joints = snapshot.joints
            if joints is None or (times is not None and joints.n_cells != len(times)):
                return None
            if times is None:
                times = np.full(joints.n_cells, np.inf)
            newly = (joints.cell_data["state"] >= CRACK) & np.isinf(times)
            times[newly] = snapshot.time
        return times

    def moments(self, most):
        """Snapshots in the order of time between which equal shares of the joints have broken, the last one included; equal shares of
        the movement where none has."""
        if self.latest_break() is None:
            chosen = moments(self.snapshots, most + 1)[1:] or [0]
            return [self.snapshots[number] for number in chosen]
        broken = np.sort(self.break_time[np.isfinite(self.break_time)])
        reached = [broken[int(share * (len(broken) - 1))] for share in np.linspace(0.0, 1.0, most + 1)[1:-1]]
        chosen = {snapshot.time: snapshot for snapshot in [*map(self.snapshots.at, reached), self.snapshots[-1]]}
        return [chosen[time] for time in sorted(chosen)]

    def first_break(self):
        """The first time at which a snapshot shows a broken joint [s]; None without any."""
        return self._break_at(np.min)

    def latest_break(self):
        """The last time at which a snapshot shows a joint broken that was not before [s]; None without any."""
        return self._break_at(np.max)

    def _break_at(self, which):
        times = [] if self.break_time is None else self.break_time[np.isfinite(self.break_time)]
        return float(which(times)) if len(times) else None

    def broken(self, snapshot):
        """The broken joints of a snapshot with the time each broke [s]; None where the run wrote no joints."""
        joints = snapshot.joints
        if joints is None:
            return None
        chosen = np.flatnonzero(joints.cell_data["state"] >= CRACK)
        mesh = joints.extract_cells(chosen)
        times = np.full(len(chosen), snapshot.time) if self.break_time is None else self.break_time[chosen]
        if mesh.n_cells:
            mesh.cell_data["break_time"] = times
        return mesh

    def fragment_colors(self, fragment, colors):
        """A number below `colors` for every element, the same within a fragment, and different in fragments that touched at the start
        wherever there are numbers enough; and the fragment of each element, counted from 0. fragment: of every element."""
        _, group = np.unique(np.asarray(fragment), return_inverse=True)
        chosen = colors_of_neighbors(group, _edges(self.first), colors)
        return chosen[group], group

    def softening(self, snapshot):
        """The softening joints of a snapshot."""
        joints = snapshot.joints
        return None if joints is None else joints.extract_cells(np.flatnonzero(joints.cell_data["state"] == 1))

    def hull(self):
        """The outer surface at the start."""
        return self.first.clean(tolerance=1e-9).extract_surface()

    @cached_property
    def volumes(self):
        """Volumes of the elements [m3] (n,)."""
        corners = np.asarray(self.first.points)[np.asarray(self.first.cell_connectivity).reshape(-1, 4)]
        edges = corners[:, 1:] - corners[:, :1]
        return np.abs(np.linalg.det(edges)) / 6.0

    def exaggeration(self, snapshot, share=0.04):
        """A round factor that makes displacements of the rock that has not come loose a visible share of the body, and does not fill the frame
        with what flies; at least 1.

        By the displacement that a tenth of the largest fragment's volume exceeds. A fiftieth of the volume of all elements may be carried farther
        than the largest share of the extent, not more.
        """
        displacement = np.linalg.norm(snapshot.elements.cell_data["displacement"], axis=1)
        if len(displacement) != self.first.n_cells or not np.any(displacement):
            return 1.0
        _, fragment = np.unique(snapshot.elements.cell_data["fragment"], return_inverse=True)
        rock = fragment == np.argmax(np.bincount(fragment, weights=self.volumes))
        extent = self.extents.max()
        limits = [share * extent / _exceeded(displacement[rock], self.volumes[rock], 0.1), MOST_SPREAD * extent / _exceeded(displacement, self.volumes, 0.02)]
        return max(style.round_factor(min(limits)), 1.0)

    def displaced(self, snapshot, factor):
        """The elements of a snapshot with their displacement multiplied by a factor, without those that are then out of the frame; and the numbers of
        those that are left (n,). Elements that have turned so far that the factor would distort them keep their shape."""
        mesh = snapshot.elements.copy()
        if mesh.n_points != self.first.n_points:
            return mesh, np.arange(mesh.n_cells)
        mesh.points = _magnified(np.asarray(self.first.points).reshape(-1, 4, 3), np.asarray(mesh.points).reshape(-1, 4, 3), factor)
        near = np.flatnonzero(factor * np.linalg.norm(mesh.cell_data["displacement"], axis=1) <= OUT_OF_FRAME * self.extents.max())
        return mesh.extract_cells(near), near

    def plane_view(self, axis=None, position=None):
        """The view along an axis, the thin one by default, onto the plane at a position, the middle by default."""
        axis = self.thin_axis if axis is None else axis
        box = np.array(self.bounds).reshape(3, 2)
        position = float(box[axis].mean()) if position is None else position
        in_plane = [other for other in (0, 1, 2) if other != axis]
        margin = MARGIN * self.extents[in_plane].max()
        return PlaneView(axis, position, box[in_plane].T + np.array([[-margin], [margin]]))

    def cut_view(self):
        """The plane along an axis that meets most broken joints, through the middle of them."""
        broken = self.broken(self.snapshots[-1])
        if broken is None or broken.n_cells == 0:
            return self.plane_view()
        middle = np.median(broken.cell_centers().points, axis=0)
        views = [self.plane_view(axis, float(middle[axis])) for axis in range(3)]
        return max(views, key=lambda view: view.cut(broken).length)

    def solid_view(self):
        """The view from the corner toward which the body moves; from above."""
        last = self.snapshots[-1].elements.cell_data["displacement"]
        weight = np.linalg.norm(last, axis=1)[:, None]
        drift = (weight * last).sum(axis=0)
        side = np.where(drift < 0.0, -1.0, 1.0)
        if abs(drift[1]) < 1e-9 * (abs(drift).max() or 1.0):
            side[1] = -1.0
        side[2] = 1.0
        return SolidView(self.bounds, side)
