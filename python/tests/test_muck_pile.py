"""Muck piles: fragments of a run of blasting as rigid bodies, their flight, and the numbers of the pile."""

import csv
import json
import tomllib
from pathlib import Path

import numpy as np
import pytest
from synthetic_run import TETRAHEDRON, block_mesh, write_grid, write_table

import sazare
from sazare.__main__ import main
from sazare.checked import warnings_of
from sazare.muck_pile import Options, model_of, muck_pile
from sazare.muck_pile.back_break import at_edge_of, back_breaks
from sazare.muck_pile.balls import Balls, union_volumes
from sazare.muck_pile.bodies import bodies_of
from sazare.muck_pile.breaking import breaking_of
from sazare.muck_pile.crater import crater
from sazare.muck_pile.elements import Elements, elements_of
from sazare.muck_pile.flight import flight_times, ranges
from sazare.muck_pile.heights import heights_of_balls, heights_of_triangles
from sazare.muck_pile.landed import Landed
from sazare.muck_pile.support import carried_shares
from sazare.muck_pile.words import flight

ROOT = Path(__file__).resolve().parents[2]
DENSITY, GRAVITY = 2600.0, 9.81
CASE = """[case]
title = "Blown block"
method = "blocks"

[[materials]]
name = "rock"
density = 2600.0

[contact]
friction_coefficient = 0.5

[gravity]
acceleration = [{}]
"""


class Blown:
    """A run that never was: a block of cells, each a fragment of six tetrahedra, which have moved as rigid bodies."""

    def __init__(self, size, cells, stays=(), seed=None):
        self.points, self.elements = block_mesh(size, cells)
        self.start = self.points[self.elements]
        middle = self.start.mean(axis=1)
        place = np.floor(middle / (np.array(size) / cells)).astype(int)
        self.fragment = np.ravel_multi_index(place.T, cells)
        self.count = int(np.prod(cells))
        self.stays = np.isin(np.arange(self.count), stays)
        self.shift, self.velocity, self.spin = (np.zeros((self.count, 3)) for _ in range(3))
        random = np.random.default_rng(seed)
        if seed is not None:
            self.velocity, self.spin = random.normal(0.0, 5.0, (self.count, 3)), random.normal(0.0, 30.0, (self.count, 3))
        self.gravity, self.status, self.snapshots, self.broken = "0.0, 0.0, 0.0", "done", True, lambda time: np.minimum(100.0, 1000.0 * time)

    def centres(self, corners):
        """Centres of the fragments, whose elements have equal volumes."""
        total = np.zeros((self.count, 3))
        np.add.at(total, self.fragment, corners.mean(axis=1))
        return total / np.bincount(self.fragment)[:, None]

    def at_the_end(self):
        """Corners at the end."""
        return self.start + self.shift[self.fragment][:, None]

    def write(self, run):
        """The folder of the run."""
        (run / "snapshots").mkdir(parents=True)
        last = self.at_the_end()
        arm = last.mean(axis=1) - self.centres(last)[self.fragment]
        velocity = self.velocity[self.fragment] + np.cross(self.spin[self.fragment], arm)
        for number, (time, corners) in enumerate([(0.0, self.start), (1.0, last)] if self.snapshots else []):
            data = {"element": np.arange(len(corners)), "fragment": self.fragment, "material": np.zeros(len(corners), np.int32), "velocity": velocity}
            data["angular_velocity"] = self.spin[self.fragment]
            cells = np.arange(4 * len(corners)).reshape(-1, 4)
            write_grid(run / "snapshots" / f"elements_{number:05d}.vtkhdf", corners.reshape(-1, 3), cells, TETRAHEDRON, time, data)
        volume = np.bincount(self.fragment) * abs(np.linalg.det(self.start[0, 1:] - self.start[0, :1])) / 6.0
        write_table(run / "fragments.csv", {
            "fragment [-]": np.arange(self.count), "elements [-]": np.bincount(self.fragment), "volume [m3]": volume, "mass [kg]": DENSITY * volume,
            "size [m]": np.cbrt(6.0 * volume / np.pi), "stays [-]": self.stays.astype(int),
        })
        time = np.linspace(0.0, 1.0, 101)
        write_table(run / "history.csv", {"time [s]": time, "broken_joints [-]": self.broken(time)})
        (run / "case.toml").write_text(CASE.format(self.gravity))
        (run / "manifest.json").write_text(json.dumps({"case": "Blown block", "method": "blocks", "status": self.status, "results": {}}))
        return run


def tetrahedron_inertia(corners, density):
    """About the origin, by a rule with the corners and the middle that is exact for polynomials of second degree."""
    volume = abs(np.linalg.det(corners[1:] - corners[0])) / 6.0
    points, weights = np.vstack([corners, corners.mean(axis=0)]), np.array([0.05, 0.05, 0.05, 0.05, 0.8])
    moments = density * volume * np.einsum("k,ki,kj->ij", weights, points, points)
    return np.trace(moments) * np.eye(3) - moments


def test_rigid_bodies_keep_mass_momentum_angular_momentum_and_energy(tmp_path):
    blown = Blown((0.9, 0.8, 1.2), (3, 2, 4), seed=3)
    run = sazare.open(blown.write(tmp_path / "run"))
    elements, bodies = elements_of(run), model_of(run, Options(ground=-9.0)).bodies
    assert bodies.mass.sum() == pytest.approx(DENSITY * 0.9 * 0.8 * 1.2, rel=1e-12)
    # A box of 0.3 m x 0.4 m x 0.3 m, turned by nothing at the end.
    mass = DENSITY * 0.3 * 0.4 * 0.3
    expected = mass / 12.0 * np.diag([0.4**2 + 0.3**2, 0.3**2 + 0.3**2, 0.3**2 + 0.4**2])
    np.testing.assert_allclose(bodies.inertia, np.broadcast_to(expected, (24, 3, 3)), atol=1e-12 * mass)
    np.testing.assert_allclose(bodies.velocity, blown.velocity, rtol=1e-10)
    np.testing.assert_allclose(bodies.spin, blown.spin, rtol=1e-6, atol=1e-6)
    energy = 0.5 * mass * np.sum(blown.velocity**2) + 0.5 * np.einsum("mi,ij,mj->", blown.spin, expected, blown.spin)
    assert bodies.kinetic_energy.sum() == pytest.approx(energy, rel=1e-7)
    assert bodies.energy.sum() == pytest.approx(energy, rel=1e-7)
    assert elements.masses.sum() == pytest.approx(bodies.mass.sum(), rel=1e-12)


def test_elements_that_move_against_each_other_keep_momentum_and_lose_energy(tmp_path):
    run = sazare.open(Blown((0.9, 0.8, 1.2), (3, 2, 4), seed=3).write(tmp_path / "run"))
    elements = elements_of(run)
    random = np.random.default_rng(5)
    elements.velocity[:] += random.normal(0.0, 3.0, elements.velocity.shape)
    elements.spin[:] += random.normal(0.0, 50.0, elements.spin.shape)
    bodies, _ = bodies_of(elements, np.ones(len(elements.fragment), dtype=bool))
    momentum = elements.masses @ elements.velocity
    np.testing.assert_allclose(bodies.mass @ bodies.velocity, momentum, rtol=1e-12)
    own = [tetrahedron_inertia(corners - corners.mean(axis=0), DENSITY) @ spin for corners, spin in zip(elements.corners, elements.spin)]
    angular = np.sum(elements.masses[:, None] * np.cross(elements.centres, elements.velocity) + own, axis=0)
    kept = np.sum(bodies.mass[:, None] * np.cross(bodies.centre, bodies.velocity) + bodies.angular_momentum, axis=0)
    np.testing.assert_allclose(kept, angular, rtol=1e-11)
    assert np.all(bodies.kinetic_energy < bodies.energy)


def crowded(balls, places):
    """Largest overlap of balls of different bodies over the smaller radius."""
    apart = np.linalg.norm(places[:, None] - places, axis=2)
    overlap = balls.radii[:, None] + balls.radii - apart
    other = balls.body[:, None] != balls.body
    return float((np.where(other, overlap, -1.0) / np.minimum(balls.radii[:, None], balls.radii)).max())


def test_spheres_touch_neither_other_bodies_nor_walls(tmp_path):
    blown = Blown((1.0, 1.0, 1.0), (4, 4, 4), stays=range(0, 32), seed=1)
    blown.shift[40] = (-0.02, 0.0, 0.0)  # pressed into the rock that stays and its neighbours
    model = model_of(sazare.open(blown.write(tmp_path / "run")))
    assert crowded(model.balls, model.balls.centres) <= 0.0
    assert np.all(model.balls.centres[:, 2] - model.balls.radii > model.ground)
    assert np.all(model.standing.distance(model.balls.centres) > model.balls.radii)
    assert not np.any(model.standing.holds(model.balls.centres))
    shares = union_volumes(model.balls, len(model.bodies)) / model.bodies.volume
    assert np.all(shares[~model.fines] < 1.0) and np.median(shares) > 0.4


def test_the_volume_of_a_union_is_that_of_spheres_which_overlap():
    balls = Balls(np.array([0, 0, 1, 1]), np.array([[0.0, 0, 0], [1.0, 0, 0], [9.0, 0, 0], [9.0, 0, 0]]), np.array([1.0, 1.0, 0.5, 2.0]))
    lens = np.pi * (2.0 - 1.0) ** 2 * (1.0 + 4.0) / 12.0  # of two unit spheres a distance of 1 apart
    np.testing.assert_allclose(union_volumes(balls, 2), [8.0 / 3.0 * np.pi - lens, 32.0 / 3.0 * np.pi], rtol=0.03)


def test_fragments_fly_as_thrown_until_they_land(tmp_path):
    blown = Blown((0.4, 0.4, 0.4), (2, 2, 2))
    blown.velocity[:] = (6.0, 1.0, 4.0)
    blown.spin[:] = (0.0, 3.0, 0.0)
    blown.shift[:] = 0.5 * blown.centres(blown.start)  # apart, so that they turn freely
    run = sazare.open(blown.write(tmp_path / "run"))
    numbers = muck_pile(run, options=Options(ground=-2.0, end=0.5), threads=1)
    centre, time = numbers.model.bodies.centre, numbers.landed.time
    flown = centre + blown.velocity * time + np.array([0.0, 0.0, -0.5 * GRAVITY * time**2])
    np.testing.assert_allclose(numbers.landed.centres, flown, atol=1e-3 * 3.0)
    np.testing.assert_allclose(numbers.landed.velocities, blown.velocity + np.array([0.0, 0.0, -GRAVITY * time]), atol=1e-3 * 6.0)
    assert np.all(numbers.flying)
    # In the air they fly on in closed form to where the height of their centre is that of the ground.
    height = centre[:, 2] + 2.0
    landing = (4.0 + np.sqrt(16.0 + 2.0 * GRAVITY * height)) / GRAVITY
    np.testing.assert_allclose(np.linalg.norm((numbers.ends - centre)[:, :2], axis=1), np.hypot(6.0, 1.0) * landing, rtol=1e-3)
    moved = blown.shift[:, :2] + np.outer(landing, [6.0, 1.0])  # the throw counts from before the blast
    np.testing.assert_allclose(numbers.throws, np.linalg.norm(moved, axis=1), rtol=1e-3)
    assert numbers.farthest.range == pytest.approx(np.hypot(6.0, 1.0) * landing[numbers.farthest.number], rel=1e-9)
    assert numbers.cast == 1.0


def test_what_is_slow_at_the_top_of_its_flight_is_in_the_air(tmp_path):
    # Half of the fragments are thrown up and are at the top of their flight at the end; the others lie on rock that stays.
    blown = Blown((0.4, 0.4, 0.8), (2, 2, 4))
    middle = blown.centres(blown.start)
    blown.stays[:] = middle[:, 2] < 0.2
    up = middle[:, 2] > 0.6
    blown.velocity[up] = (0.3, 0.0, 0.8 * GRAVITY)
    blown.shift[up] = (0.0, 0.0, 0.3)
    numbers = muck_pile(sazare.open(blown.write(tmp_path / "run")), options=Options(ground=0.0, end=0.8, direction=(1.0, 0.0)), threads=1)
    thrown = numbers.model.bodies.centre[:, 2] > 0.8
    assert thrown.sum() == 4 and len(thrown) == 12
    assert np.linalg.norm(numbers.landed.velocities[thrown], axis=1).max() < 0.5 and numbers.landed.centres[thrown, 2].min() > 4.0
    np.testing.assert_array_equal(numbers.flying, thrown)
    assert 0.2 < numbers.pile.height < 0.6  # two layers of 0.2 m, without what flies
    assert numbers.ends[thrown, 2] == pytest.approx(0.0)


def test_what_collides_in_the_air_is_held_up_by_nothing(tmp_path):
    # Eight fragments touch each other 5 m above the ground: each is pushed, but all together fall.
    blown = Blown((0.4, 0.4, 0.4), (2, 2, 2))
    blown.velocity[:] = -3.0 * (blown.centres(blown.start) - 0.2)
    blown.shift[:] = 0.1 * (blown.centres(blown.start) - 0.2)
    numbers = muck_pile(sazare.open(blown.write(tmp_path / "run")), options=Options(ground=-5.0, end=0.2, direction=(1.0, 0.0)), threads=1)
    assert np.all(numbers.flying)


def test_the_share_of_a_weight_that_is_carried():
    def at(time, up):
        return Landed(time, np.zeros((len(up), 3)), np.column_stack([np.zeros((len(up), 2)), up]), None)

    before, after = at(1.0, [3.0, 0.0, -2.0, -1.0]), at(1.1, [3.0 - 0.1 * GRAVITY, 0.0, 1.0, -1.0 - 0.05 * GRAVITY])
    np.testing.assert_allclose(carried_shares(before, after, GRAVITY), [0.0, 1.0, 1.0 + 3.0 / (0.1 * GRAVITY), 0.5], atol=1e-12)
    np.testing.assert_array_equal(carried_shares(before, before, GRAVITY), np.zeros(4))


def test_flight_in_closed_form():
    velocity = np.array([[3.0, 4.0, 0.0], [10.0, 0.0, 10.0], [1.0, 0.0, 0.0]])
    np.testing.assert_allclose(flight_times(np.array([19.62, 0.0, -1.0]), velocity, 9.81), [2.0, 0.0, 0.0])
    np.testing.assert_allclose(ranges(np.array([19.62, 1e-9, -1.0]), velocity, 9.81), [10.0, 200.0 / 9.81, 0.0], rtol=1e-6)


def test_a_column_of_fragments_becomes_a_pile_at_rest(tmp_path):
    blown = Blown((0.4, 0.4, 1.2), (2, 2, 6))
    run = sazare.open(blown.write(tmp_path / "run"))
    numbers = muck_pile(run, options=Options(end=6.0), threads=1)
    assert numbers.rests and not np.any(numbers.flying)
    assert numbers.pile.height < 0.9
    assert 1.2 < numbers.swell_of_spheres < 2.2  # random packings of equal spheres have 1.56 to 1.7
    assert numbers.pile.swell == pytest.approx(numbers.swell_of_spheres * numbers.sphere_share)
    assert sum(one.volume for one in numbers.pile.slices) == pytest.approx(numbers.pile.bulk)
    # What falls loses energy, and rises nowhere.
    assert numbers.ends[:, 2].mean() < 0.5 * numbers.starts[:, 2].mean()


def test_what_lies_under_an_overhang_is_no_pile_that_is_seen(tmp_path):
    # A roof over the loose cell in the middle; the one in front is free.
    blown = Blown((3.0, 1.0, 2.0), (3, 1, 2))
    number = np.arange(6).reshape(3, 1, 2)
    blown.stays[:] = True
    blown.stays[[number[1, 0, 0], number[2, 0, 0], number[2, 0, 1]]] = False
    run = sazare.open(blown.write(tmp_path / "run"))
    pile = muck_pile(run, options=Options(ground=-0.01, direction=(1.0, 0.0), end=0.01), threads=1).pile
    assert list(pile.covered) == [True, False, False]
    assert pile.solid == pytest.approx(2.0)


def test_heights_of_a_ball_and_of_triangles():
    along = np.array([0.6, 0.8, 0.0])
    ball = heights_of_balls(np.array([[3.0, 4.0, 2.0]]), np.array([1.0]), along, 0.02)
    assert np.sum(ball.tops - 1.0) * 0.02**2 == pytest.approx(5.0 / 3.0 * np.pi, rel=5e-3)  # over its lowest point: a half ball on a cylinder
    middles = (ball.cells + 0.5) * 0.02
    np.testing.assert_allclose(middles.mean(axis=0), [5.0, 0.0], atol=0.02)
    slope = heights_of_triangles(np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [0.0, 1.0, 0.0]]]), np.array([1.0, 0.0, 0.0]), 0.01)
    np.testing.assert_allclose(slope.tops, (slope.cells[:, 0] + 0.5) * 0.01, atol=1e-12)
    assert len(slope.tops) * 1e-4 == pytest.approx(0.5, rel=0.02)
    assert list(slope.at(np.array([[50, 10], [200, 200]]), -7.0)) == pytest.approx([0.505, -7.0])


def test_back_break_is_told_by_depth(tmp_path):
    # Cells of 1 m; the throw is along x. Holes at x = 2 between y = 1 and y = 3: rock behind is loose at the top only, and beside at the lower one.
    blown = Blown((4.0, 4.0, 2.0), (4, 4, 2))
    number = np.arange(32).reshape(4, 4, 2)
    blown.stays[:] = True
    blown.stays[number[2:, 1:3].ravel()] = False
    blown.stays[[number[1, 1, 1], number[3, 3, 0]]] = False
    blown.velocity[~blown.stays] = (3.0, 1.0, 0.0)
    run = blown.write(tmp_path / "run")
    columns = {"hole": ["a", "b"], "delay [s]": [0.0, 0.0]} | {f"first_{axis} [m]": values for axis, values in zip("xyz", ([2.0, 2.0], [1.0, 3.0], [2.0, 2.0]))}
    columns |= {f"last_{axis} [m]": values for axis, values in zip("xyz", ([2.0, 2.0], [1.0, 3.0], [0.0, 0.0]))}
    write_table(run / "holes.csv", columns | {"diameter [m]": [0.1, 0.1]})
    results = sazare.open(run)
    model = model_of(results, Options(ground=-1.0))
    assert list(model.direction) == pytest.approx([1.0, 0.0, 0.0])  # across the row, though the rock goes obliquely
    found = back_breaks(results, model)
    assert [one.behind for one in found[:5]] == pytest.approx([1.0 if one.volume else 0.0 for one in found[:5]])
    assert max(one.behind for one in found) == pytest.approx(1.0) and all(one.behind == 0.0 for one in found[5:])
    assert sum(one.volume for one in found) == pytest.approx(1.0)
    assert all(one.left == 0.0 for one in found[:5]) and max(one.left for one in found[5:]) == pytest.approx(1.0)
    assert all(one.right == 0.0 for one in found)
    at_edge = at_edge_of(results, model)
    assert (at_edge.behind, at_edge.left, at_edge.right) == (False, True, False)


@pytest.mark.parametrize("direction", [(1.0, 0.0), (1.0, 0.022), (1.0, -0.3), (1.0, 0.7)])
def test_rock_loose_up_to_a_side_of_the_model_is_told_for_any_direction(tmp_path, direction):
    # Cells of 1 m, one hole in the middle. Loose up to the back (x = 0) and the right side (y = 0), not to the left one.
    blown = Blown((5.0, 5.0, 1.0), (5, 5, 1))
    number = np.arange(25).reshape(5, 5)
    blown.stays[:] = True
    blown.stays[[*number[2:, 2], number[0, 2], number[4, 0], number[3, 3]]] = False
    blown.velocity[~blown.stays] = (3.0, 0.0, 0.0)
    run = blown.write(tmp_path / "run")
    ends = {f"{end}_{axis} [m]": [value] for end, height in (("first", 1.0), ("last", 0.0)) for axis, value in zip("xyz", (2.5, 2.5, height))}
    write_table(run / "holes.csv", {"hole": ["a"], "delay [s]": [0.0], **ends, "diameter [m]": [0.1]})
    results = sazare.open(run)
    at_edge = at_edge_of(results, model_of(results, Options(ground=-1.0, direction=direction)))
    assert (at_edge.behind, at_edge.left, at_edge.right) == (True, False, True)


def test_breaking_is_over_where_no_joint_breaks_any_more(tmp_path):
    blown = Blown((1.0, 1.0, 1.0), (1, 1, 2))
    over = breaking_of(sazare.open(blown.write(tmp_path / "over")))
    assert over.is_over and over.broken == 0.0 and over.worked is None
    blown.broken = lambda time: 100.0 * time
    evenly = breaking_of(sazare.open(blown.write(tmp_path / "evenly")))
    assert not evenly.is_over and evenly.rate == pytest.approx(1.0)


def test_the_ground_is_the_floor_in_front(tmp_path):
    # A bench of two cells' height behind a floor of one: the farthest rock that stays along x is the floor.
    blown = Blown((3.0, 1.0, 2.0), (3, 1, 2))
    number = np.arange(6).reshape(3, 1, 2)
    blown.stays[:] = True
    blown.stays[number[1, 0, 1]] = False
    blown.stays[number[2, 0, 1]] = False
    blown.velocity[~blown.stays] = (3.0, 0.0, 0.0)
    blown.shift[~blown.stays] = (0.01, 0.0, 0.01)
    model = model_of(sazare.open(blown.write(tmp_path / "run")))
    assert model.ground == pytest.approx(1.0) and model.toe == pytest.approx(3.0) and list(model.direction) == pytest.approx([1.0, 0.0, 0.0])
    assert model.friction == 0.5 and model.gravity == 9.81


@pytest.mark.parametrize(
    ("change", "options", "words"),
    [
        ({"snapshots": False}, [], "no snapshots"),
        ({"stays": np.ones(2, dtype=bool)}, [], "no fragment has come loose"),
        ({"status": "stopped"}, [], "has not ended (stopped)"),
        ({"gravity": "9.81, 0.0, 0.0"}, [], "needs one along -z"),
        ({}, ["--ground", "5"], "lies under the ground at z = 5 m"),
        ({}, ["--direction", "0", "0"], "has no length"),
        ({}, ["--smallest", "3"], "no fragment is as large as 3 m"),
    ],
)
def test_what_has_no_pile_is_refused(tmp_path, capsys, change, options, words):
    blown = Blown((1.0, 1.0, 1.0), (1, 1, 2))
    for name, value in change.items():
        setattr(blown, name, value)
    run = blown.write(tmp_path / "run")
    assert main(["muck-pile", str(run), *options]) == 2
    assert words in capsys.readouterr().err
    assert not (run / "muck-pile").exists()


def test_runs_of_other_methods_are_refused(tmp_path, capsys):
    (tmp_path / "manifest.json").write_text(json.dumps({"method": "spheres", "status": "done"}))
    assert main(["muck-pile", str(tmp_path)]) == 2
    assert "of method spheres" in capsys.readouterr().err


def test_the_command_writes_tables_and_pictures_and_replaces_only_what_it_wrote(tmp_path, capsys):
    blown = Blown((0.4, 0.4, 0.4), (2, 2, 2))
    blown.velocity[:] = (2.0, 0.0, 1.0)
    run = blown.write(tmp_path / "run")
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "mine.txt").write_text("x")
    assert main(["muck-pile", str(run), "--out", str(tmp_path / "full")]) == 2
    assert "no muck pile" in capsys.readouterr().err
    arguments = ["muck-pile", str(run), "--end", "0.2", "--threads", "1", "--quiet"]
    assert main(arguments) == 0
    told = capsys.readouterr().out
    folder = run / "muck-pile"
    for word in ("beyond the toe", "flyrock", "swell", "tables and pictures"):
        assert word in told
    assert {path.name for path in folder.iterdir()} >= {"throw.csv", "pile.csv", "numbers.json", "throw.png", "profile.png", "plan.png", "case.toml", "run"}
    with (folder / "throw.csv").open(newline="") as file:
        assert len(list(csv.DictReader(file))) == 8
    assert json.loads((folder / "numbers.json").read_text())["fragments"] == 8
    assert tomllib.loads((folder / "case.toml").read_text())["case"]["method"] == "spheres"
    assert main(arguments) == 2
    assert "--overwrite replaces it" in capsys.readouterr().err
    (folder / "throw.csv").unlink()
    (folder / "throw.csv").symlink_to(tmp_path / "elsewhere.csv")
    assert main([*arguments, "--overwrite"]) == 0
    assert not (tmp_path / "elsewhere.csv").exists() and not (folder / "throw.csv").is_symlink()
    linked = blown.write(tmp_path / "linked")
    (linked / "muck-pile").symlink_to(tmp_path / "full")
    assert main(["muck-pile", str(linked), "--end", "0.2"]) == 2
    assert "a link" in capsys.readouterr().err


def test_the_cost_is_told_before_the_flight_without_advice_that_cannot_be_followed(tmp_path, capsys):
    blown = Blown((0.4, 0.4, 0.4), (2, 2, 2), stays=(0,))
    blown.velocity[:] = (20.0, 0.0, 0.0)
    told = []
    muck_pile(sazare.open(blown.write(tmp_path / "run")), options=Options(end=0.01), threads=1, say=told.append)
    assert told[1][0] == "flight to 10 ms:"
    assert [line.split()[0] for line in told[1][1:] if line[2] != " "] == ["step", "work", "cost"]
    assert all("restitution" not in line for line in told[1]) and "restitution" not in capsys.readouterr().err


def test_warnings_of_a_check_are_told_apart():
    said = "  step  1 s\n\na.toml:3:1: warning: one\n    3 | x\n      help: do\nb.toml:4:1: warning: the restitution between a\n      help: no\n\nwarning: two\nend\n"
    assert warnings_of(said) == ["a.toml:3:1: warning: one\n    3 | x\n      help: do", "b.toml:4:1: warning: the restitution between a\n      help: no", "warning: two"]
    assert flight(said, 2.0) == ["flight to 2 s:", "  step  1 s", "a.toml:3:1: warning: one\n    3 | x\n      help: do", "warning: two"]


def test_runs_write_how_their_elements_turn(tmp_path):
    """With it the kinetic energy of all elements is that of the history."""
    run = sazare.run(ROOT / "tests/regression/block/case.toml", tmp_path / "run", progress=False)
    elements = elements_of(run)
    moments = np.array([tetrahedron_inertia(corners - corners.mean(axis=0), density) for corners, density in zip(elements.corners, elements.density)])
    turning = np.einsum("ni,nij,nj->", elements.spin, moments, elements.spin)
    assert turning > 0.01 * run.history["energy_kinetic"][-1]
    moving = elements.masses @ np.sum(elements.velocity**2, axis=1)
    assert 0.5 * (moving + turning) == pytest.approx(run.history["energy_kinetic"][-1], rel=1e-9)


def cratered(thrown, speed=5.0, turn=np.eye(3)):
    """The Elements of a block of 2 x 2 x 1 m of which those within `thrown`, a function of their centres (n, 3), are one loose fragment that moves along z."""
    points, tetrahedra = block_mesh((2.0, 2.0, 1.0), (4, 4, 2))
    corners = points[tetrahedra]
    loose = thrown(corners.mean(axis=1))
    count = len(tetrahedra)
    velocity = np.where(loose[:, None], [0.0, 0.0, speed], 0.0) @ turn.T
    return Elements(
        corners @ turn.T, corners @ turn.T, tetrahedra, np.full(count, 2500.0), velocity, np.zeros((count, 3)), np.where(loose, 7, 3), ~loose,
    )


def upper_corner(centres):
    return (centres[:, 0] < 1.0) & (centres[:, 1] < 0.5) & (centres[:, 2] > 0.5)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_the_crater_is_what_flies_out_wherever_the_surface_looks(axis):
    turn = np.roll(np.eye(3), axis, axis=0)
    found = crater(cratered(upper_corner, turn=turn), turn @ [0.0, 0.0, 1.0])
    assert found.volume == pytest.approx(0.25) and found.mass == pytest.approx(625.0) and found.broken == pytest.approx(0.25)
    assert found.radius == pytest.approx(np.sqrt(0.5 / np.pi)) and found.depth == pytest.approx(0.5)
    assert found.fragments == 1 and found.speed == pytest.approx(5.0)


def test_what_does_not_rise_above_its_size_is_broken_and_not_thrown():
    # The sphere of 0.25 m3 is 0.782 m across, which 3.92 m/s reach.
    assert crater(cratered(upper_corner, speed=3.95), np.array([0.0, 0.0, 1.0])).volume == pytest.approx(0.25)
    slow = crater(cratered(upper_corner, speed=3.89), np.array([0.0, 0.0, 1.0]))
    assert (slow.volume, slow.radius, slow.depth, slow.speed) == (0.0, 0.0, 0.0, 0.0) and slow.broken == pytest.approx(0.25)


def test_what_moves_into_the_rock_is_not_thrown():
    assert crater(cratered(upper_corner, speed=-9.0), np.array([0.0, 0.0, 1.0])).volume == 0.0
