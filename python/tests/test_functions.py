"""Functions of one's own in a run: histories with the bits of a table, forces on bodies, an end; their errors; runs that are resumed."""

import math
import subprocess
from pathlib import Path

import numpy as np
import pytest
from scipy.special import ellipj

import sazare
from sazare.cases import fem, mps, rectangles, spheres

ROOT = Path(__file__).resolve().parents[2]
COMMAND = ROOT / "build/release/apps/sazare/sazare"
BLOCK = ROOT / "tests/regression/block/case.toml"


def shaken(method):
    """A short case of a method that moves as its motion "shake", a velocity, says."""
    if method == "mps":
        case = sazare.read_case(ROOT / "cases/column-ricker/case.toml")
        case.particles.spacing, case.boundaries[0].motion_x = 2.0, "shake"
        case.time = mps.Time(end=0.3, history_interval=0.01, snapshot_interval=0.1)
        kind = mps.Motion
    elif method == "rectangles":
        case = sazare.read_case(ROOT / "cases/shaking-table/case.toml")
        case.walls[0].motion_x = "shake"
        case.time = rectangles.Time(end=0.1, history_interval=0.01, snapshot_interval=0.1)
        kind = rectangles.Motion
    elif method == "spheres":
        kind = spheres.Motion
        case = spheres.Case(
            title="A ball on a shaken floor",
            materials=[spheres.Material(name="glass", density=2500.0, youngs_modulus=1e7, poisson_ratio=0.2)],
            contact=spheres.Contact(restitution=0.5, friction_coefficient=0.5),
            spheres=[spheres.Sphere(name="ball", material="glass", centre=(0.0, 0.0, 0.01), radius=0.01)],
            walls=[spheres.Wall(name="floor", material="glass", shape="plane", point=(0.0, 0.0, 0.0), normal=(0.0, 0.0, 1.0), motion_x="shake")],
            gravity=spheres.Gravity(acceleration=(0.0, 0.0, -9.81)),
            time=spheres.Time(end=0.02, history_interval=0.001, snapshot_interval=0.01),
        )
    else:
        case = sazare.read_case(ROOT / "cases/cantilever-fem/case.toml")
        case.boundaries = [fem.Boundary(group="foot", kind="prescribed", axes=["x"], motion_y="shake")]
        case.time = fem.Time(end=0.02, step=5e-4, history_interval=1e-3, snapshot_interval=0.01)
        kind = fem.Motion
    case.motions = [kind(name="shake", type="function", quantity="velocity")]
    return case, kind


def shake(time):
    """A velocity [m/s] at a time [s]."""
    return 0.3 * math.sin(40.0 * time) + 0.1 * time


def as_table(folder, step, end, function, quantity, unit):
    """The history of a function as a table in a file, with a row at every step."""
    times = step * np.arange(round(end / step) + 3)
    return sazare.write_table(folder / "history.csv", {"time [s]": times, f"{quantity} [{unit}]": [function(time) for time in times]})


@pytest.mark.parametrize("method", ["mps", "rectangles", "spheres", "fem"])
def test_a_motion_has_the_bits_of_its_table(method, tmp_path):
    case, kind = shaken(method)
    with sazare.build(case, tmp_path / "function", functions={"shake": shake}) as simulation:
        step = simulation.end / simulation.steps
        while not simulation.is_over:
            simulation.advance(simulation.end / 7.3)
    table = as_table(tmp_path, step, simulation.end, shake, "velocity", "m/s")
    case.motions = [kind(name="shake", type="record", file=str(table))]
    tabled = sazare.run(case, tmp_path / "table", progress=False)
    compared = sazare.compare(simulation.results, tabled)
    assert compared.same_bits and compared.largest_difference == 0.0
    assert np.abs(simulation.velocities).max() > 0.01, "it was shaken"


def pulse(time):
    """A pressure [Pa] at a time [s]."""
    return 5e7 * math.sin(5e4 * time) ** 2 if time < 6e-5 else 0.0


def blast(**keys):
    case = sazare.read_case(BLOCK)
    case.time.end = 1.6e-4
    case.blasts = [type(case.blasts[0])(surface="hole", delay=1.3e-5, **keys)]
    return case


def test_a_pressure_has_the_bits_of_its_table(tmp_path):
    ours = sazare.run(blast(function=True), tmp_path / "function", progress=False, functions={"hole": pulse})
    with sazare.build(blast(function=True), functions={"hole": pulse}) as simulation:
        table = as_table(tmp_path, simulation.end / simulation.steps, simulation.end, pulse, "pressure", "Pa")
    tabled = sazare.run(blast(table=str(table)), tmp_path / "table", progress=False)
    compared = sazare.compare(ours, tabled)
    assert compared.same_bits and compared.largest_difference == 0.0
    assert ours.figures["broken_joints"] > 0


def test_a_run_that_is_resumed_with_its_functions_has_the_bits_of_a_whole_one(tmp_path):
    case, _ = shaken("mps")
    functions = {"shake": shake}

    def push(now):
        return -1e3 * now.velocities

    whole = sazare.run(case, tmp_path / "whole", progress=False, functions=functions, forces=push)
    halved = sazare.run(case, tmp_path / "halved", progress=False, functions=functions, forces=push, stop=lambda now: now.time > 0.14)
    assert halved.manifest["status"] == "stopped"
    with pytest.raises(sazare.UserError, match="external forces acted on this run"):
        sazare.run(case, tmp_path / "halved", progress=False, resume=True, functions=functions)
    resumed = sazare.run(case, tmp_path / "halved", progress=False, resume=True, functions=functions, forces=push)
    assert sazare.compare(whole, resumed).same_bits
    assert whole.figures["energy_work_applied"] < 0.0
    assert abs(whole.figures["energy_residual"]) < 1e-6 * abs(whole.figures["energy_work_boundary"])


def test_an_error_in_a_function_comes_out_as_it_is(tmp_path):
    def breaks(time):
        if time > 0.1:
            raise KeyError("no more data")
        return 0.0

    case, _ = shaken("mps")
    with pytest.raises(KeyError, match="no more data") as error:
        sazare.run(case, tmp_path / "run", progress=False, functions={"shake": breaks})
    assert error.traceback[-1].name == "breaks"
    assert sazare.open(tmp_path / "run").manifest["status"] == "stopped", "with a checkpoint"
    with pytest.raises(ValueError, match=r'the function "shake" gives nan at 0.0 s'):
        sazare.build(case, functions={"shake": lambda time: math.nan})


def test_functions_must_be_those_that_the_case_asks_for(tmp_path):
    case, _ = shaken("mps")
    with pytest.raises(sazare.UserError, match='the case leaves "shake" to its caller: give functions='):
        sazare.build(case)
    with pytest.raises(sazare.UserError, match='asks for no function "wave"; it asks for: "shake"'):
        sazare.build(case, functions={"shake": shake, "wave": shake})
    text = tmp_path / "case.toml"
    text.write_text(case.to_toml())
    refused = subprocess.run([COMMAND, "run", text, "--out", tmp_path / "run"], capture_output=True, text=True, check=False)
    assert refused.returncode == 2
    assert 'the motion "shake" is a function, which a case file cannot contain' in refused.stderr
    assert "shake: velocity as a function of time, given in Python" in sazare.check(case)


def test_a_function_may_end_the_run():
    case, _ = shaken("mps")
    with sazare.build(case, functions={"shake": shake}) as simulation:
        assert simulation.run(stop=lambda now: abs(now.velocities[:, 0]).max() > 0.1) < simulation.end
        assert 0.1 < abs(simulation.velocities[:, 0]).max() < 0.12, "the first step at which it holds"


def single_block(end, steps):
    """A square of 100 kg that nothing holds."""
    return rectangles.Case(
        title="A block alone",
        blocks=[rectangles.Block(name="block", material="steel", lower=(0.0, 0.0, 0.0), upper=(0.1, 0.1, 0.0))],
        materials=[rectangles.Material(name="steel", density=1e4, face_normal_stiffness=1e6, face_shear_stiffness=1e6)],
        contact=rectangles.Contact(face_normal_stiffness=1e6, face_shear_stiffness=1e6, friction_angle=30.0),
        time=rectangles.Time(end=end, step=end / steps, history_interval=end / 20, snapshot_interval=end),
    )


def swing_error(steps, linear=4e3, cubic=1e6, away=0.1, end=2.0):
    """How far a block on a spring of one's own is from the exact swing [m] at any step, in m."""
    start = None

    def spring(now):
        nonlocal start
        start = now.positions[0, 0] if start is None else start
        out = now.positions[0, 0] - start + away
        return [[-linear * out - cubic * out**3, 0.0, 0.0]]

    mass, worst = 100.0, 0.0
    rate = math.sqrt((linear + cubic * away**2) / mass)
    with sazare.build(single_block(end, steps), forces=spring) as simulation:
        while not simulation.is_over:
            simulation.advance(end / steps)
            exact = away * ellipj(rate * simulation.time, cubic * away**2 / (2 * (linear + cubic * away**2)))[1]
            worst = max(worst, abs(simulation.positions[0, 0] - start + away - exact))
    return worst


def test_a_block_swings_on_a_hardening_spring_as_it_must():
    """Duffing's equation, x = A cn(w t): error of second order in the step."""
    coarse, fine = swing_error(500), swing_error(1000)
    assert fine < 2e-3 * 0.1
    assert coarse / fine == pytest.approx(4.0, rel=0.1)


def test_a_constant_force_on_finite_elements_is_a_load():
    case = sazare.read_case(ROOT / "cases/cantilever-fem/case.toml")
    case.time = fem.Time(end=0.05, step=5e-4, history_interval=1e-3, snapshot_interval=0.05)
    loaded = sazare.build(case)
    loaded.run()
    case.loads = []
    shares = 1e5 * np.array([1.0, 4.0, 2.0, 4.0, 1.0]) / 12.0  # of two faces with quadratic shape functions, over a height of 1 m

    def at_the_tip(now):
        forces = np.zeros(now.positions.shape)
        if now.step == 0:
            found = np.flatnonzero(now.positions[:, 0] > 10.0 - 1e-9)
            tip.extend(found[np.argsort(now.positions[found, 1])])
        forces[tip[:5], 1] = -shares
        return forces

    tip = []
    pushed = sazare.build(case, forces=at_the_tip)
    pushed.run()
    assert np.allclose(pushed.positions, loaded.positions, atol=1e-6 * abs(loaded.velocities).max())


def test_forces_that_are_none_are_refused_in_words():
    with pytest.raises(TypeError, match="must be a function of the simulation; found dict"):
        sazare.build(single_block(1.0, 100), forces={"block": lambda now: np.zeros((1, 3))})
    with pytest.raises(ValueError, match="must return real numbers, a row for each body; found str"):
        sazare.build(single_block(1.0, 100), forces=lambda now: "hello")
    simulation = sazare.build(single_block(1.0, 100), forces=lambda now: np.zeros((1, 3)) if now.step < 3 else now.run())
    with pytest.raises(RuntimeError, match="cannot advance the same simulation"):
        simulation.run()


def test_forces_of_a_wrong_shape_are_refused():
    with pytest.raises(ValueError, match=r"forces must be of shape \(1, 3\), .* or \(1, 6\) with moments"):
        sazare.build(single_block(1.0, 100), forces=lambda now: np.zeros(3))
    with pytest.raises(ValueError, match="not all finite"):
        sazare.build(single_block(1.0, 100), forces=lambda now: [[math.inf, 0.0, 0.0]])
    with pytest.raises(sazare.UserError, match="method rectangles accepts external forces without moments"):
        sazare.build(single_block(1.0, 100), forces=lambda now: np.zeros((1, 6)))


SPHERE = """
[case]
title = "A ball"
method = "spheres"
[[materials]]
name = "stone"
density = 2500.0
youngs_modulus = 1e7
poisson_ratio = 0.2
[contact]
restitution = 0.5
friction_coefficient = 0.5
[[spheres]]
name = "ball"
material = "stone"
source = "one"
radius = 0.1
centre = [0.0, 0.0, 0.0]
velocity = [1.0, 0.0, 0.0]
[time]
end = {end}
step = {step}
history_interval = {step}
snapshot_interval = {end}
"""


def sphere_on_spring(tmp_path, end, steps):
    """A ball on a spring of 1000 N/m and its largest distance from the exact swing [m], over what the swing is wide."""
    mass = 2500.0 * 4 / 3 * math.pi * 1e-3
    rate = math.sqrt(1000.0 / mass)
    path = tmp_path / f"ball{steps}.toml"
    path.write_text(SPHERE.format(end=end, step=end / steps))
    worst = 0.0
    with sazare.build(path, forces=lambda now: -1000.0 * now.positions) as simulation:
        while not simulation.is_over:
            simulation.advance(end / steps)
            worst = max(worst, abs(simulation.positions[0, 0] - math.sin(rate * simulation.time) / rate))
    return worst * rate


def test_a_ball_swings_on_a_spring_given_in_python(tmp_path):
    coarse, fine = (sphere_on_spring(tmp_path, 1.0, steps) for steps in (500, 1000))
    assert fine < 1e-4
    assert coarse / fine == pytest.approx(4.0, rel=0.05)


def test_the_work_of_forces_on_spheres_balances_and_a_resumed_run_goes_on(tmp_path):
    path = tmp_path / "ball.toml"
    path.write_text(SPHERE.format(end=1.0, step=1e-3))

    def spring(now):
        return -1000.0 * now.positions

    whole = sazare.run(path, tmp_path / "whole", progress=False, forces=spring)
    history = whole.history
    assert history["energy_work_applied"][0] == 0
    kinetic = history["energy_translation"]
    rate = math.sqrt(1000.0 / (2500.0 * 4 / 3 * math.pi * 1e-3))
    second_order = (rate * 1e-3) ** 2 / 2  # of the energy, by which the trapezoidal rule may be off
    assert np.allclose(kinetic - kinetic[0], history["energy_work_applied"], atol=second_order * kinetic.max())
    assert abs(history["energy_residual"]).max() < second_order * kinetic.max()
    sazare.run(path, tmp_path / "halved", progress=False, forces=spring, stop=lambda now: now.time > 0.4)
    resumed = sazare.run(path, tmp_path / "halved", progress=False, resume=True, forces=spring)
    assert resumed.manifest["state_hash"] == whole.manifest["state_hash"]
