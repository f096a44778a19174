"""Forces of the caller on blocks, and on both sides of a coupled run: exact motions, energies, runs that are resumed, what is refused."""

import math
import shutil
from pathlib import Path

import numpy as np
import pytest

import sazare
from sazare.cases import blocks

ROOT = Path(__file__).resolve().parents[2]
BLOCK = ROOT / "tests/regression/block/case.toml"

ELEMENT = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
1
3 1 "rock"
$EndPhysicalNames
$Entities
0 0 0 1
1 0 0 0 1 1 1 1 1 0
$EndEntities
$Nodes
1 4 1 4
3 1 0 4
1
2
3
4
0 0 0
0.6 0 0
0 0.6 0
0 0 0.6
$EndNodes
$Elements
1 1 1 1
3 1 4 1
1 1 2 3 4
$EndElements
"""
MASS = 2500.0 * 0.6**3 / 6


def lone_element(folder, end, steps, **material):
    """An element of 90 kg that nothing holds, with its centre at 0.15 m on each axis."""
    (folder / "element.msh").write_text(ELEMENT)
    return blocks.Case(
        title="An element alone",
        mesh=blocks.Mesh(file=str(folder / "element.msh")),
        materials=[blocks.Material(name="rock", regions=["rock"], density=2500.0, **material)],
        joints=[
            blocks.Joint(
                name="rock",
                between=["rock", "rock"],
                joint_normal_stiffness=None if material else 1e9,
                joint_shear_stiffness=None if material else 1e9,
                damping_ratio=0.0,
                cohesion=1e6,
                friction_coefficient=0.5,
                tensile_strength=1e6,
                fracture_energy=1e5,
            )
        ],
        contact=blocks.Contact(contact_stiffness=1e9, contact_damping=0.0, friction_coefficient=0.5),
        time=blocks.Time(end=end, base_step=end / steps, limiter="none", history_interval=end / 20, snapshot_interval=end),
    )


@pytest.mark.parametrize("material", [{}, {"youngs_modulus": 1e9, "poisson_ratio": 0.2, "deformable": True}], ids=["rigid", "deformable"])
def test_a_constant_force_moves_an_element_exactly_and_does_not_strain_it(material, tmp_path):
    force = np.array([90.0, -45.0, 180.0])
    with sazare.build(lone_element(tmp_path, 2.0, 200, **material), forces=lambda now: [force]) as simulation:
        start = simulation.positions.copy()
        simulation.run()
        assert np.allclose(simulation.velocities, 2.0 * force / MASS, rtol=1e-12)
        assert np.allclose(simulation.positions - start, 2.0 * force / MASS, rtol=1e-12)
        energies = simulation.results.history
        assert energies["energy_work"][-1] == pytest.approx(energies["energy_kinetic"][-1], rel=1e-12)
        assert energies["energy_work"][-1] == pytest.approx(2.0 * force @ force / MASS, rel=1e-12)
        assert simulation.results.figures.get("peak_strain", 0.0) < 1e-15


def swing_error(folder, steps):
    """How far an element on a spring of one's own is from the exact swing at any step, over its amplitude."""
    rate, worst = 3.0, 0.0
    middle = np.array([0.15, 0.15, 0.15]) - [0.5, 0.0, 0.0]
    with sazare.build(lone_element(folder, 4.0, steps), forces=lambda now: -MASS * rate**2 * (now.positions - middle)) as simulation:
        while not simulation.is_over:
            simulation.advance(4.0 / steps)
            worst = max(worst, abs(simulation.positions[0, 0] - middle[0] - 0.5 * math.cos(rate * simulation.time)) / 0.5)
    return worst


def test_an_element_swings_on_a_spring_given_in_python(tmp_path):
    coarse, fine = swing_error(tmp_path, 200), swing_error(tmp_path, 400)
    assert fine < 5e-4
    assert coarse / fine == pytest.approx(4.0, rel=0.05)


def test_a_moment_turns_an_element(tmp_path):
    """About the axis (1, 1, 1) through its centre the moment of inertia of the corner of a cube is m a^2 / 10."""
    moment = 2.0 * np.ones(3) / math.sqrt(3.0)
    with sazare.build(lone_element(tmp_path, 0.5, 100), tmp_path / "run", forces=lambda now: [[0.0, 0.0, 0.0, *moment]]) as simulation:
        simulation.run()
        assert abs(simulation.velocities).max() < 1e-15
        turned = (2.0 * 0.5) ** 2 / (2 * MASS * 0.6**2 / 10)
        assert simulation.results.history["energy_work"][-1] == pytest.approx(turned, rel=1e-9)
        assert simulation.results.history["energy_kinetic"][-1] == pytest.approx(turned, rel=1e-9)


def pushed_block():
    """A block that a pressure breaks, and forces of the caller draw back."""
    case = sazare.read_case(BLOCK)
    case.time.end = 2e-4
    return case


def draw_back(now):
    return -1e3 * (now.positions - [0.0, 0.0, 0.1]) - 5.0 * now.velocities


def test_forces_on_a_block_that_breaks_balance_have_the_bits_of_threads_and_are_resumed(tmp_path):
    whole = sazare.run(pushed_block(), tmp_path / "whole", progress=False, forces=draw_back, threads=1)
    assert whole.figures["broken_joints"] > 0
    history = whole.history
    assert abs(history["energy_residual"]).max() < 1e-2 * history["energy_work"].max()
    threads = sazare.run(pushed_block(), tmp_path / "threads", progress=False, forces=draw_back, threads=2)
    assert threads.manifest["state_hash"] == whole.manifest["state_hash"]
    sazare.run(pushed_block(), tmp_path / "halved", progress=False, forces=draw_back, stop=lambda now: now.time > 1e-4)
    with pytest.raises(sazare.UserError, match="external forces acted on this run"):
        sazare.run(pushed_block(), tmp_path / "halved", progress=False, resume=True)
    resumed = sazare.run(pushed_block(), tmp_path / "halved", progress=False, resume=True, forces=draw_back)
    assert resumed.manifest["state_hash"] == whole.manifest["state_hash"]
    free = sazare.run(pushed_block(), tmp_path / "free", progress=False)
    assert free.manifest["state_hash"] != whole.manifest["state_hash"]


def test_a_run_without_forces_is_not_resumed_with_them(tmp_path):
    sazare.run(pushed_block(), tmp_path / "run", progress=False, stop=lambda now: now.time > 1e-4)
    with pytest.raises(sazare.UserError, match="began without external forces"):
        sazare.run(pushed_block(), tmp_path / "run", progress=False, resume=True, forces=draw_back)


def ground_and_block(folder, name, gravity, lift=0.0):
    """The case block-on-soft-ground for 0.1 s, its block with or without gravity, and lifted [m]."""
    source, where = ROOT / "cases/block-on-soft-ground", folder / name
    shutil.copytree(source, where)
    for file in ("ground.toml", "block.toml"):
        text = (where / file).read_text().replace("end = 3.5 ", "end = 0.1 ")
        (where / file).write_text(text)
    text = (where / "block.toml").read_text()
    if not gravity:
        text = text.replace("acceleration = [0.0, -9.81, 0.0]", "acceleration = [0.0, 0.0, 0.0]")
    text = text.replace("4.159401076758500", str(4.1594010767585 + lift)).replace("5.359401076758500", str(5.3594010767585 + lift))
    (where / "block.toml").write_text(text.replace("point = [4.0, 4.5, 0.0]", f"point = [4.0, {4.5 + lift}, 0.0]"))
    return where / "case.toml"


def test_a_force_on_the_bodies_of_a_coupled_run_is_like_their_weight(tmp_path):
    def weight(now):
        """Of the elements of the block, which come after the nodes and are alike."""
        forces = np.zeros(now.positions.shape)
        forces[-elements:, 1] = -9.81 * 2500.0 * 1.0 * 1.2 / elements
        return forces

    heavy = sazare.build(ground_and_block(tmp_path, "heavy", True))
    elements = int(heavy.words.split(" and ")[1].split()[0])
    heavy.run()
    pushed = sazare.build(ground_and_block(tmp_path, "pushed", False), forces=weight)
    pushed.run()
    assert abs(heavy.velocities[-elements:]).max() > 0.1
    assert np.allclose(pushed.positions, heavy.positions, atol=1e-9)
    assert np.allclose(pushed.velocities, heavy.velocities, atol=1e-6)


def test_a_force_on_the_nodes_of_a_coupled_run_moves_the_ground(tmp_path):
    def push(now):
        forces = np.zeros(now.positions.shape)
        node = np.argmin(np.linalg.norm(start - [7.0, 2.0, 0.0], axis=1))
        forces[node] = [2e3, -5e3, 0.0]
        return forces

    case = ground_and_block(tmp_path, "coupled", False, lift=2.0)
    ground = sazare.build(tmp_path / "coupled/ground.toml")
    start = ground.positions.copy()
    ground.stop()
    alone = sazare.build(tmp_path / "coupled/ground.toml", forces=push)
    alone.run()
    coupled = sazare.build(case, forces=push)
    coupled.run()
    nodes = len(start)
    assert abs(alone.positions - start).max() > 1e-6
    assert np.array_equal(coupled.positions[:nodes], alone.positions)
    with pytest.raises(sazare.UserError, match="forces without moments"):
        sazare.build(case, forces=lambda now: np.zeros((len(now.positions), 6)))
