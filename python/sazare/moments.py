"""Which snapshots the panels of one picture show: those between which equal shares of what happens lie.

Most runs are quiet for long, before or after what they are about. Panels at equal times would show the quiet.
"""

import numpy as np

from sazare.snapshots import elements_once

MOST_READ = 48  # snapshots; of longer series every n-th one is looked at


MOST_WAY = 0.1  # of the body's size, up to which the way of a point counts: what flies off is no more than gone


def movement(first):
    """A function of two meshes that tells the mean way of their points from one to the other [m], which counts up to a share of the size of
    the first mesh of a series; 0 where they are not the same points."""
    places = np.asarray(first.points)
    size = float(np.ptp(places, axis=0).max()) if len(places) else 0.0
    most = MOST_WAY * size if size > 0.0 else np.inf

    def moved(before, after):
        before, after = np.asarray(before.points), np.asarray(after.points)
        if before.shape != after.shape or not len(before):
            return 0.0
        return float(np.minimum(np.linalg.norm(after - before, axis=1), most).mean())

    return moved


def growth(field):
    """A function of two meshes that tells by how much the sum of a field of their cells has grown."""

    def grown(before, after):
        sums = [float(np.sum(mesh.cell_data[field])) if field in mesh.cell_data else 0.0 for mesh in (before, after)]
        return abs(sums[1] - sums[0])

    return grown


def moments(snapshots, most, change=None):
    """Numbers of some snapshots in the order of time, `most` at most: the first, the last, and between them those by which equal
    shares of the change have taken place.

    change: a function of two meshes, one snapshot after the other, that returns how much has happened between them; the movement where
    it is None.
    """
    return moments_of([snapshots], most, change)


def moments_of(series, most, change=None):
    """`moments` for several series of the same times, such as the two sides of a run: what happens in each counts alike."""
    last = min(map(len, series)) - 1
    if last < 1:
        return [0] * (last + 1)
    read = sorted({int(number) for number in np.linspace(0, last, min(MOST_READ, last + 1)).round()})
    shares = np.zeros(len(read))
    for snapshots in series:
        steps = np.nan_to_num(_steps([snapshots[number] for number in read], change))
        shares += steps / steps.sum() if steps.sum() > 0.0 else 0.0
    return [read[place] for place in equal_shares(shares, most)]


def _steps(snapshots, change):
    """How much has happened up to each snapshot since the one before it (n,), the first being 0."""
    steps = [0.0]
    before = elements_once(snapshots[0])
    change = change or movement(before)
    for snapshot in snapshots[1:]:
        after = elements_once(snapshot)
        steps.append(change(before, after))
        before = after
    return np.array(steps)


def equal_shares(steps, most):
    """Places in a list of what happens from one to the next, its first number being 0: first, last, and equal shares of the sum between.

    Equal numbers of places where nothing happens at all.
    """
    done = np.cumsum(np.nan_to_num(np.asarray(steps, dtype=float)))
    shares = np.linspace(0.0, 1.0, most)[1:-1]
    if done[-1] <= 0.0:
        between = np.round(shares * (len(done) - 1)).astype(int)
    else:
        # A share that round-off leaves short by a trifle is reached.
        between = np.searchsorted(done, shares * done[-1] * (1.0 - 1e-12))
    return sorted({0, *(int(place) for place in between), len(done) - 1})
