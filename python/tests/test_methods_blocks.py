"""The body of a run of method blocks, from runs made here."""

import numpy as np

import sazare
from sazare.methods.blocks_body import Body


def test_a_slab_is_known_by_its_thin_axis(slab, solid):
    body = Body(sazare.open(slab).snapshots)
    assert body.is_slab and body.thin_axis == 2
    assert body.plane_view().in_plane == (0, 1)
    assert not Body(sazare.open(solid).snapshots).is_slab


def test_joints_carry_the_time_of_the_first_snapshot_that_shows_them_broken(slab):
    run = sazare.open(slab)
    body = Body(run.snapshots)
    last = run.snapshots[-1]
    broken = body.broken(last)
    assert broken.n_cells == np.sum(last.joints.cell_data["state"] >= 2)
    assert set(np.round(broken.cell_data["break_time"] / 1e-4).astype(int)) <= {1, 2, 3, 4, 5}
    early = run.snapshots[1].joints.cell_data["state"] == 2
    assert np.all(body.break_time[early] == run.snapshots[1].time)


def test_displacements_are_enlarged_by_a_round_factor(slab):
    run = sazare.open(slab)
    body = Body(run.snapshots)
    factor = body.exaggeration(run.snapshots[-1])
    assert factor / 10.0 ** np.floor(np.log10(factor)) in (1.0, 2.0, 5.0) and factor > 1.0
    assert body.exaggeration(run.snapshots[0]) == 1.0


def test_crack_panels_follow_the_breaking_and_not_the_run(slab):
    from sazare.methods import blocks_maps

    run = sazare.open(slab)
    body = Body(run.snapshots)
    chosen = blocks_maps.spread_over_breaking(body, (0.2, 0.5, 0.8))
    counts = [np.sum(snapshot.joints.cell_data["state"] >= 2) for snapshot in chosen]
    assert chosen[-1].time == run.snapshots[-1].time
    assert counts[0] >= 0.2 * counts[-1] and sorted(counts) == counts
    assert body.latest_break() <= run.snapshots[-1].time
