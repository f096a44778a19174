"""Damage of armour: displacements, rotations and profiles of known motions; counts; bad input."""

import json
import math
import subprocess
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import sazare
from sazare.armour import Damage, Options
from sazare.armour.profile import Profile
from sazare.armour.units import turns

PROGRAM = Path(__file__).resolve().parents[2] / "build/release/apps/sazare/sazare"
CASE = """
[case]
title = "Units in free flight"
method = "spheres"
[domain]
periodic = ["y"]
lower = [0.0, 0.0, 0.0]
upper = [0.0, 4.0, 0.0]
[[materials]]
name = "concrete"
density = 2300.0
youngs_modulus = 2e7
poisson_ratio = 0.2
[contact]
restitution = 0.5
friction_coefficient = 0.5
[[shapes]]
name = "tetrapod"
source = "tetrapod"
height = 0.2
leg_spheres = 2
[[spheres]]
name = "rests"
material = "concrete"
source = "one"
shape = "tetrapod"
centre = [0.0, 1.0, 0.0]
[[spheres]]
name = "turns"
material = "concrete"
source = "one"
shape = "tetrapod"
centre = [1.0, 1.0, 0.0]
angular_velocity = [0.0, 0.0, 0.5]
[[spheres]]
name = "flies"
material = "concrete"
source = "one"
shape = "tetrapod"
centre = [2.0, 1.0, 0.0]
velocity = [0.3, 0.0, -0.4]
[[spheres]]
name = "grain"
material = "concrete"
source = "one"
radius = 0.05
centre = [3.0, 1.0, 0.0]
[time]
end = 1.0
history_interval = 0.1
snapshot_interval = 0.5
"""


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("armour")
    (folder / "case.toml").write_text(CASE)
    return sazare.run(folder / "case.toml", folder / "run", progress=False)


def test_units_move_and_turn_as_they_were_told(run):
    damage = Damage(run, Options(along="y"))
    units = damage.units
    assert len(units) == 3, "a single sphere is no unit"
    assert np.allclose(units.end - units.start, [[0.0] * 3, [0.0] * 3, [0.3, 0.0, -0.4]], atol=2e-6), "the mean of the balls is not quite the centre of mass"
    assert units.turn[[0, 2]] == pytest.approx(0.0, abs=1e-6)
    assert units.turn[1] == pytest.approx(0.5, abs=1e-6), "0.5 rad/s for 1 s about a principal axis of equal moments"
    volume = run.figures["shape_volume_tetrapod"]
    assert units.size == pytest.approx(volume ** (1 / 3))
    assert (damage.displaced, damage.shifted, damage.rocked, damage.broken) == (1, 0, 1, 0)
    assert damage.settlement == pytest.approx(0.4 / 3)
    assert damage.per_width == pytest.approx(volume ** (1 / 3) / 4.0), "one unit on the periodic width of 4 m"


def test_movement_counts_from_the_time_asked_for(run):
    damage = Damage(run, Options(groups=("flies",), start=0.5, along="y"))
    assert damage.units.moved == pytest.approx([0.25], abs=2e-6)


def test_rotations_are_found_whatever_the_axis_and_the_shift():
    random = np.random.default_rng(4)
    points, owner = random.normal(size=(10, 3)), np.repeat([0, 1], 5)

    def spheres(places):
        shown = SimpleNamespace(points=places, radii=np.linspace(1.0, 2.0, 10), owner=owner, number=np.array([0, 1]))
        shown.mean = lambda values: np.array([np.average(values[owner == n], axis=0, weights=shown.radii[owner == n] ** 3) for n in (0, 1)])
        return shown

    axis, angle = np.array([1.0, 2.0, -2.0]) / 3.0, 2.8
    cross = np.cross(np.eye(3), axis)
    matrix = np.eye(3) + math.sin(angle) * cross.T + (1.0 - math.cos(angle)) * cross @ cross
    moved = points @ matrix.T + [5.0, -2.0, 1.0]
    moved[5:] = points[5:] + 1.0
    assert turns(spheres(points), spheres(moved)) == pytest.approx([angle, 0.0], abs=1e-7)


def test_the_eroded_area_is_that_of_what_became_lower():
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(0.0, 4.0, 0.05), np.arange(0.0, 1.0, 0.05)))
    flat = np.column_stack([x, y, np.zeros(len(x))])
    pit = flat.copy()
    pit[(x > 0.999) & (x < 1.999), 2] = -0.3
    pit[(x > 2.499) & (x < 2.999), 2] = 0.4
    before, after = (SimpleNamespace(points=points, radii=np.full(len(x), 0.04)) for points in (flat, pit))
    profile = Profile(before, after, np.array([0.0, 0.0, 1.0]), np.array([0.0, 1.0, 0.0]), 0.2)
    assert profile.eroded == pytest.approx(0.3 * 1.0, rel=0.1)


def test_the_command_writes_tables_and_tells_what_is_missing(run, tmp_path):
    done = subprocess.run([PROGRAM, "armour", run.path, "--along", "y"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "displaced      1, 33.3 %" in done.stdout
    assert {path.name for path in (run.path / "armour").iterdir()} == {"damage.json", "displacements.png", "profile.csv", "profile.png", "units.csv"}
    assert json.loads((run.path / "armour" / "damage.json").read_text())["displaced"] == 1
    outside = tmp_path / "kept.txt"
    outside.write_text("kept")
    (run.path / "armour" / "profile.png").unlink()
    (run.path / "armour" / "profile.png").symlink_to(outside)
    linked = subprocess.run([PROGRAM, "armour", run.path, "--along", "y"], capture_output=True, text=True, check=False)
    assert linked.returncode == 2 and "a link" in linked.stderr and outside.read_text() == "kept"
    (run.path / "armour" / "profile.png").unlink()
    for arguments, words in (
        (["--group", "grain"], 'there is no group "grain" of a shape'),
        (["--from", "1"], "two snapshots at least are needed"),
        (["--width", "-1"], "must be a finite number above 0"),
    ):
        refused = subprocess.run([PROGRAM, "armour", run.path, *arguments], capture_output=True, text=True, check=False)
        assert refused.returncode == 2 and words in refused.stderr, refused.stderr
        assert "Traceback" not in refused.stderr
