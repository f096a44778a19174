"""The body of a run of method blocks, from runs made here."""

import shutil
import subprocess
from pathlib import Path

import h5py
import numpy as np
import pytest

import sazare
from sazare.methods import blocks_maps
from sazare.methods.blocks_body import SHEARED, Body, colors_of_neighbors
from sazare.report import sections_of

ROOT = Path(__file__).resolve().parents[3]
PROGRAM = ROOT / "build/release/apps/sazare/sazare"


def test_a_slab_is_known_by_its_thin_axis(slab, solid):
    body = Body(sazare.open(slab).snapshots)
    assert body.is_slab and body.thin_axis == 2
    assert body.plane_view().in_plane == (0, 1)
    assert not Body(sazare.open(solid).snapshots).is_slab


def test_stresses_of_elements_are_consistent_and_drawn(slab, solid):
    for folder in (slab, solid):
        body = Body(sazare.open(folder).snapshots)
        elements = body.snapshots[-1].elements.cell_data
        normal, largest, smallest = (np.asarray(elements[name]) for name in ("normal_stress", "largest_principal_stress", "smallest_principal_stress"))
        assert np.any(normal)
        assert np.all(largest >= normal.max(axis=1) - 1e-6 * np.abs(normal).max()) and np.all(smallest <= normal.min(axis=1) + 1e-6 * np.abs(normal).max())
        assert blocks_maps.has_stress(body)
        figure = blocks_maps.principal_stresses(body)
        assert [axes.get_title(loc="left").split(",")[0] for axes in figure.axes[:2]] == ["largest principal stress", "smallest principal stress"]
        assert "tension positive" in figure.axes[2].get_ylabel()


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
    run = sazare.open(slab)
    body = Body(run.snapshots)
    chosen = body.moments(4)
    counts = [np.sum(snapshot.joints.cell_data["state"] >= 2) for snapshot in chosen]
    assert chosen[-1].time == run.snapshots[-1].time
    assert counts[0] >= 0.2 * counts[-1] and sorted(counts) == counts
    assert body.latest_break() <= run.snapshots[-1].time


def test_panels_of_a_body_without_breaks_follow_its_movement(slab, monkeypatch):
    body = Body(sazare.open(slab).snapshots)
    monkeypatch.setattr(body, "break_time", None)
    times = [snapshot.time for snapshot in body.moments(3)]
    assert times == sorted(times) and times[-1] == body.snapshots[-1].time and len(times) == 3


def test_fragments_that_share_an_edge_have_different_colors():
    # Six groups of two elements in a ring, each sharing edges with the next; the first and the last meet too.
    group = np.repeat(np.arange(6), 2)
    edges = np.stack([np.arange(12) // 2, (np.arange(12) // 2 + 1) % 6, *(100 + 12 * n + np.arange(12) for n in range(4))], axis=1)
    colors = colors_of_neighbors(group, edges, 3)
    assert set(colors) <= {0, 1, 2}
    assert all(colors[n] != colors[(n + 1) % 6] for n in range(6))


def test_fragments_of_a_body_differ_from_all_they_touch(slab):
    run = sazare.open(slab)
    body = Body(run.snapshots)
    corners = np.asarray(body.first.points).reshape(-1, 4, 3)
    fragment = (5.0 * corners.mean(axis=1)[:, 0]).astype(int)  # slices along x
    color, group = body.fragment_colors(fragment, 4)
    assert all(len(set(color[group == one])) == 1 for one in np.unique(group))
    by_slice = [color[fragment == one][0] for one in np.unique(fragment)]
    assert all(one != other for one, other in zip(by_slice, by_slice[1:]))


def sheared_slab(slab, tmp_path):
    """The slab's run, in which every second crack is made one that is sheared and pressed together."""
    copy = shutil.copytree(slab, tmp_path / "run")
    for path in (copy / "snapshots").glob("joints_*.vtkhdf"):
        with h5py.File(path, "r+") as file:
            state, mode = file["VTKHDF/CellData/state"], file["VTKHDF/CellData/mode"]
            cracks = np.flatnonzero(state[:] == 2)[::2]
            states, modes = state[:], mode[:]
            states[cracks], modes[cracks] = SHEARED, 2
            state[:], mode[:] = states, modes
    return copy


def test_sheared_joints_have_colors_and_counts_of_their_own(slab, tmp_path):
    results = sazare.open(sheared_slab(slab, tmp_path))
    body = Body(results.snapshots)
    labels = [axes.get_ylabel() for axes in blocks_maps.crack_pattern(body).axes]
    assert "sheared, faces pressed together: time of failure [µs]" in labels and "open: time of failure [µs]" in labels
    states = results.snapshots[-1].joints.cell_data["state"]
    words = [text.get_text() for text in blocks_maps.crack_modes(body).legends[0].get_texts()]
    assert words == [f"opening, faces apart: {np.sum(states == 2)} joints", f"shear, faces pressed together: {np.sum(states == SHEARED)} joints"]


def test_cracks_by_mode_are_drawn_where_joints_have_failed_in_shear(slab, tmp_path):
    assert "modes" not in [section.name for section in sections_of(sazare.open(slab))]
    assert "modes" in [section.name for section in sections_of(sazare.open(sheared_slab(slab, tmp_path)))]


@pytest.fixture(scope="module", params=["case", "true-faces"])
def sheared_run(request, tmp_path_factory):
    """The direct shear test of a lift joint, with contacts of spheres and of true faces."""
    folder = tmp_path_factory.mktemp("shear") / "run"
    subprocess.run([PROGRAM, "run", ROOT / f"cases/direct-shear/{request.param}.toml", "--out", folder, "--quiet"], check=True, timeout=300)
    return sazare.open(folder)


def test_a_lift_joint_fails_in_shear_with_its_shear_fracture_energy(sheared_run):
    figures, area = sheared_run.figures, 0.3 * 0.06
    joint = sheared_run.snapshots[-1].joints
    own = np.asarray(joint.cell_data["kind"]) == 1
    assert joint.extract_cells(np.flatnonzero(own)).area == pytest.approx(area, rel=1e-9)
    assert figures["broken_in_shear"] == figures["broken_joints"] == own.sum()
    assert np.all(np.asarray(joint.cell_data["state"])[own] >= 2) and figures["fragments"] == 2
    assert figures["energy_fracture"] + figures["energy_release"] == pytest.approx(400.0 * area, rel=0.01)


def test_the_mean_shear_stress_of_a_lift_joint_stays_below_its_strength(sheared_run):
    history, mass, area = sheared_run.history, 2400.0 * 0.3 * 0.1 * 0.06, 0.3 * 0.06
    time = history["time"]
    push = np.interp(time, [0.0, 1.2e-3, 3.7e-3], [0.0, 0.0, 75e6]) * 0.02 * 0.06
    speed = np.sqrt(2.0 * np.maximum(history["energy_kinetic"], 0.0) / mass)
    stress = (push - mass * np.gradient(speed, time)) / area
    sliding = history["broken_joints"] == sheared_run.figures["broken_joints"]
    assert 0.7 * 4e6 < np.convolve(stress, np.full(9, 1 / 9), "valid").max() < 4e6
    assert stress[sliding].mean() == pytest.approx(0.7 * 2e6, rel=0.2)
