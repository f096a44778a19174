"""Spheres that several processes share move as those of one process, to the last bit, whoever works for which of them. For a build with MPI."""

import signal
import time

import pytest
from conftest import DONE, PHYSICS_FAILED, ROOT, assert_same_results, kill_one, manifest, rank_rows, wait_for

SETTLED_BED = ROOT / "cases/penetration-25k/case.toml"
DRUM = ROOT / "cases/rotating-drum/case.toml"

# Large and small spheres between two plates that shear them, in a box that is periodic along x and y.
SHEARED = """
[case]
title = "Grains of two sizes that are sheared"
method = "spheres"

[domain]
periodic = ["x", "y"]
lower = [0.0, 0.0, 0.0]
upper = [0.1, 0.06, 0.0]

[[materials]]
name = "grain"
density = 2500.0
youngs_modulus = 1.0e7
poisson_ratio = 0.3

[[materials]]
name = "sand"
density = 2500.0
youngs_modulus = 1.0e7
poisson_ratio = 0.3

[contact]
restitution = 0.6
friction_coefficient = 0.5
rolling_friction = 0.05
twisting_friction = 0.05

[[spheres]]
name = "large"
material = "grain"
source = "lattice"
radius = 0.004
lower = [0.0, 0.0, 0.0]
upper = [0.1, 0.06, 0.017]
noise = 0.3

[[spheres]]
name = "small"
material = "sand"
source = "lattice"
radius = 0.0015
lower = [0.0, 0.0, 0.0172]
upper = [0.1, 0.06, 0.06]
noise = 0.3

[[walls]]
name = "lower"
material = "grain"
shape = "plane"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]

[[walls]]
name = "upper"
material = "grain"
shape = "plane"
point = [0.0, 0.0, 0.0615]
normal = [0.0, 0.0, -1.0]
motion_x = "shear"

[[motions]]
name = "shear"
type = "sine"
quantity = "velocity"
amplitude = 0.5
frequency = 50.0

[[gauges]]
name = "small"
group = "small"

[gravity]
acceleration = [0.0, 0.0, -9.81]

[time]
end = 0.02
levels = "uniform"
history_interval = 0.002
snapshot_interval = 0.01
"""


# A block of bonded spheres that breaks on a floor.
BREAKING = """
[case]
title = "A block of bonded spheres breaks"
method = "spheres"

[[materials]]
name = "mortar"
density = 2300.0
youngs_modulus = 1.0e9
poisson_ratio = 0.2

[contact]
restitution = 0.5
friction_coefficient = 0.6

[[spheres]]
name = "block"
material = "mortar"
source = "lattice"
radius = 0.01
lower = [0.0, 0.0, 0.001]
upper = [0.3, 0.3, 0.301]
velocity = [0.5, 0.0, -8.0]

[[bonds]]
name = "block"
between = ["block", "block"]
youngs_modulus = 1.0e9
poisson_ratio = 0.2
damping_ratio = 0.05
tensile_strength = 0.5e6
cohesion = 1.0e6
fracture_energy = 5.0

[[walls]]
name = "floor"
material = "mortar"
shape = "plane"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]

[[gauges]]
name = "block"
group = "block"

[time]
end = 2e-3
history_interval = 2e-4
snapshot_interval = 1e-3
"""


class Scene:
    """A case and how it is to be cut short."""

    def __init__(self, case, *settings):
        self.case = case
        self.options = [word for setting in settings for word in ("--set", setting)]

    def run(self, sazare, folder, *options, ranks=0, done=DONE):
        arguments = ("run", self.case, "--out", folder, *self.options, *options)
        ended = sazare.on_ranks(ranks, *arguments) if ranks else sazare(*arguments)
        assert ended.returncode == done, ended.stderr
        return folder


def tetrapods(folder):
    """The case of bonded tetrapods that fall and break, with more of them."""
    case = ROOT / "cases/tetrapod-drop/case.toml"
    lines = (case.parent / "places.csv").read_text(encoding="utf-8").splitlines()
    places = [line.split(",", 1) for line in lines if not line.startswith("#")]
    more = [f"{float(x) + 40 * row},{others}\n" for row in range(6) for x, others in places]
    (folder / "places.csv").write_text("".join(more), encoding="utf-8")
    (folder / "case.toml").write_text(case.read_text(encoding="utf-8"), encoding="utf-8")
    return folder / "case.toml"


@pytest.fixture(scope="module")
def scenes(tmp_path_factory):
    """Scenes by name."""
    texts = {"sheared": SHEARED, "still": SHEARED.replace("noise = 0.3\n", ""), "breaking": BREAKING}
    texts["floating"] = SHEARED + "\n[water]\nlevel = 0.03\ninertia_coefficient = 1.5\ndrag_coefficient = 1.0\n"
    cases = {name: tmp_path_factory.mktemp(name) / "case.toml" for name in texts}
    for name, case in cases.items():
        case.write_text(texts[name], encoding="utf-8")
    sheared = cases["sheared"]
    return {
        "bed": Scene(SETTLED_BED, "time.end=4e-4", "time.history_interval=2e-4", "time.snapshot_interval=4e-4", "spheres.1.centre=[0, 0, -0.045]"),
        "drum": Scene(DRUM, "time.end=0.08", "time.snapshot_interval=0.04"),
        "sheared": Scene(sheared),
        "partial slip": Scene(sheared, 'contact.model="mindlin_deresiewicz"', "time.end=0.01"),
        "levels": Scene(sheared, 'time.levels="per_sphere"', "materials.1.youngs_modulus=1e9", "time.end=4e-3", "time.snapshot_interval=2e-3"),
        "long": Scene(sheared, "time.end=0.1", "time.snapshot_interval=0.05"),
        "long levels": Scene(sheared, 'time.levels="per_sphere"', "materials.1.youngs_modulus=1e9", "time.snapshot_interval=1e-2"),
        "breaking": Scene(cases["breaking"]),
        "falling": Scene(
            cases["still"], "spheres.0.rain=true", "spheres.1.rain=true", "spheres.1.upper=[0.1, 0.06, 0.026]", "time.end=4e-3",
            "time.snapshot_interval=2e-3",
        ),
        "clumps": Scene(ROOT / "cases/tetrapod-armour/case.toml", "time.end=0.05", "time.snapshot_interval=0.05"),
        "water": Scene(ROOT / "cases/stones-through-water/case.toml", "time.end=0.2", "time.snapshot_interval=0.2"),
        "floating": Scene(cases["floating"], "time.end=0.01"),
        "bodies": Scene(
            tetrapods(tmp_path_factory.mktemp("bodies")), "time.end=0.03", "time.snapshot_interval=0.03", "spheres.0.velocity=[0, 0, -4]"
        ),
    }


@pytest.fixture(scope="module")
def alone(scenes, tmp_path_factory):
    """Runs of one process by the name of their scene."""
    folders = {}

    def run(sazare, name):
        if name not in folders:
            folders[name] = scenes[name].run(sazare, tmp_path_factory.mktemp("alone") / "run", "--threads", 2)
        return folders[name]

    return run


@pytest.mark.parametrize(
    ("scene", "ranks", "options"),
    [
        ("bed", 2, []),
        ("bed", 5, ["--balance", "fixed", "--threads", 2]),
        ("drum", 3, ["--balance", "random"]),
        ("sheared", 2, []),
        ("sheared", 3, ["--balance", "random", "--threads", 2]),
        ("sheared", 8, []),
        ("partial slip", 3, ["--balance", "random"]),
        ("levels", 2, ["--threads", 2]),
        ("levels", 3, ["--balance", "random"]),
        ("breaking", 3, ["--balance", "random"]),
        ("falling", 3, ["--balance", "random"]),
        ("bodies", 3, ["--balance", "random"]),
        ("clumps", 3, ["--balance", "random"]),
        ("water", 3, ["--balance", "random"]),
        ("floating", 3, ["--balance", "random"]),
    ],
)
def test_ranks_give_the_bits_of_one_process(sazare, scenes, alone, tmp_path, scene, ranks, options):
    one = alone(sazare, scene)
    many = scenes[scene].run(sazare, tmp_path / "many", *options, ranks=ranks)
    assert_same_results(one, many)


def test_ranks_send_what_the_lists_of_ghosts_foretell(sazare, scenes, tmp_path):
    rows = rank_rows(scenes["bed"].run(sazare, tmp_path / "run", ranks=3))
    assert sum(row["spheres"] for row in rows) == manifest(tmp_path / "run")["results"]["particles"]
    for row in rows:
        assert row["motion_bytes"] == row["expected_motion_bytes"] > 0
        assert row["motion_messages"] == row["expected_motion_messages"] > 0
        assert row["motion_bytes"] < row["bytes_sent"]


@pytest.mark.parametrize(
    ("scene_name", "first", "then"), [("long", 3, 0), ("long", 0, 3), ("breaking", 2, 3), ("long levels", 2, 3)]
)
def test_a_run_goes_on_with_other_ranks(sazare, scenes, alone, tmp_path, scene_name, first, then):
    """A process of several is killed, 0 stands for one alone, which is asked to stop."""
    scene, folder = scenes[scene_name], tmp_path / "run"
    often = ("--set", "output.checkpoint_interval=0.05", "--balance", "random")
    begun = sazare.start_on(first, "run", scene.case, "--out", folder, *scene.options, *often)
    wait_for(folder / "checkpoint" / "state.h5")
    time.sleep(0.2)  # and some steps more
    if first > 0:
        kill_one(begun)
    else:
        begun.send_signal(signal.SIGTERM)
    _, words = begun.communicate(timeout=60)
    assert begun.returncode != DONE, "the run came to its end before it was stopped"
    assert first == 0 or "signal 9" in words
    scene.run(sazare, folder, *often, "--resume", ranks=then)
    assert_same_results(alone(sazare, scene_name), folder)


def test_scenes_show_what_they_are_for(sazare, alone):
    figures = {name: manifest(alone(sazare, name))["results"] for name in ("bed", "sheared", "levels", "breaking", "bodies")}
    assert figures["bed"]["contacts"] > 10000
    assert figures["sheared"]["searches"] > 5
    assert figures["levels"]["levels"] > 1
    assert figures["breaking"]["broken_bonds"] > 1000
    assert figures["bodies"]["broken_bodies"] > 10


def test_all_ranks_stop_where_the_step_is_too_long(sazare, scenes, tmp_path):
    scene = scenes["sheared"]
    strict = ("--set", "time.strict=true", "--set", "time.stability_fraction=0.5", "--set", "contact.restitution=1.0")
    failed = sazare.on_ranks(3, "run", scene.case, "--out", tmp_path / "run", *scene.options, *strict)
    assert failed.returncode == PHYSICS_FAILED, failed.stderr
    assert failed.stderr.count("load the step") == 1


def test_check_tells_how_ranks_would_share_spheres(sazare, scenes):
    told = sazare("check", scenes["sheared"].case, "--ranks", 3)
    assert told.returncode == DONE, told.stderr
    assert "sent in a step" in told.stdout
