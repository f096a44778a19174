"""Many processes on one run give the bits of one process, whatever they do with the work, and however they end. For a build with MPI."""

import os
import signal
import subprocess
import time

import pytest
from conftest import (
    DONE,
    MACHINE_FAILED,
    MPI_ENVIRONMENT,
    PROGRAM,
    USER_ERROR,
    Sazare,
    assert_same_results,
    kill_one,
    manifest,
    rank_rows,
    rows_without_wall_time,
    settling_block,
    wait_for,
)

OFTEN = "output.checkpoint_interval=0.02"
LATER = "time.end=4e-4"
NEEDS_METIS = pytest.mark.skipif(
    subprocess.run([PROGRAM, "run", "none.toml", "--balance", "graph"], capture_output=True, text=True, check=False).stderr.count("METIS") > 0,
    reason="built without METIS",
)
LONG = ("--set", "time.end=1.2e-2")  # seconds: whoever interrupts it comes before its end


def block_run(sazare, folder, *options, threads=1):
    return ("run", sazare.block, "--out", folder, "--threads", threads, "--set", OFTEN, "--set", LATER, *options)


def run_alone(folder, *options):
    done = Sazare()(*block_run(Sazare(), folder, *options))
    assert done.returncode == DONE, done.stderr
    return folder


@pytest.fixture(scope="module")
def alone(tmp_path_factory):
    """The run of one process."""
    return run_alone(tmp_path_factory.mktemp("alone") / "run")


@pytest.fixture(scope="module")
def long_alone(tmp_path_factory):
    """The run of one process to a later end."""
    return run_alone(tmp_path_factory.mktemp("long_alone") / "run", *LONG)


def by_rank_of(folder):
    """The rows of ranks.csv, by rank."""
    rows = rank_rows(folder)
    ranks = int(max(row["rank"] for row in rows)) + 1
    return [[row for row in rows if row["rank"] == rank] for rank in range(ranks)]


def elastic_block(folder):
    """The small block with Young's modulus and Poisson's ratio instead of stiffnesses, beside its mesh."""
    text = Sazare().block.read_text(encoding="utf-8")
    lines = [line for line in text.split("\n") if not line.startswith(("joint_normal_", "joint_shear_"))]
    text = "\n".join(lines).replace("density", "youngs_modulus = 20e9\npoisson_ratio = 0.2\ndensity")
    text = text.replace("cohesion", "damping_ratio = 0.05\ncohesion").replace('"block.msh"', f'"{Sazare().block.parent}/block.msh"')
    case = folder / "elastic.toml"
    case.write_text(text, encoding="utf-8")
    return case


@pytest.mark.parametrize(
    ("ranks", "sharing"),
    [
        (2, []),
        (3, []),
        (4, ["--balance", "by_level", "--balance-interval", 6]),
        (4, ["--balance", "random", "--balance-interval", 6]),
        pytest.param(4, ["--balance", "graph", "--balance-interval", 6], marks=NEEDS_METIS),
    ],
)
@pytest.mark.parametrize("deformable", ["false", "true"])
def test_elastic_elements_give_the_same_bits_whoever_owns_them(sazare, tmp_path, ranks, sharing, deformable):
    case = elastic_block(tmp_path)
    options = ("--threads", 1, "--set", LATER, "--set", f"materials.0.deformable={deformable}")
    alone = sazare("run", case, "--out", tmp_path / "alone", *options)
    assert alone.returncode == DONE, alone.stderr
    assert manifest(tmp_path / "alone")["results"]["broken_joints"] > 0
    many = sazare.on_ranks(ranks, "run", case, "--out", tmp_path / "many", *options, *sharing)
    assert many.returncode == DONE, many.stderr
    assert_same_results(tmp_path / "alone", tmp_path / "many")


def test_strength_by_rate_is_the_same_whoever_owns_a_joint(sazare, tmp_path):
    case = elastic_block(tmp_path)
    options = ("--set", LATER, "--set", "joints.0.rate_law=fib_2010", "--set", "joints.0.rate_energy_exponent=2.0")
    alone = sazare("run", case, "--out", tmp_path / "alone", "--threads", 2, *options)
    assert alone.returncode == DONE, alone.stderr
    assert manifest(tmp_path / "alone")["results"]["dynamic_increase"] > 1.1
    sharing = ("--balance", "random", "--balance-interval", 6)
    many = sazare.on_ranks(4, "run", case, "--out", tmp_path / "many", "--threads", 1, *options, *sharing)
    assert many.returncode == DONE, many.stderr
    assert_same_results(tmp_path / "alone", tmp_path / "many")


@pytest.mark.parametrize(("ranks", "sharing"), [(2, []), (3, ["--balance", "random", "--balance-interval", 6])])
def test_the_equilibrium_before_a_run_is_the_same_on_ranks(sazare, tmp_path, ranks, sharing):
    case = settling_block(tmp_path)
    alone = sazare("run", case, "--out", tmp_path / "alone", "--threads", 1)
    assert alone.returncode == DONE, alone.stderr
    assert manifest(tmp_path / "alone")["results"]["settlement"] > 0
    many = sazare.on_ranks(ranks, "run", case, "--out", tmp_path / "many", "--threads", 1, *sharing)
    assert many.returncode == DONE, many.stderr
    assert_same_results(tmp_path / "alone", tmp_path / "many")


def natural_block(folder):
    """The elastic block, whose joints are rough walls that lie against each other."""
    lines = elastic_block(folder).read_text(encoding="utf-8").split("\n")
    strengths = ("cohesion", "tensile_strength", "fracture_energy")
    lines = [line for line in lines if not line.startswith(strengths)]
    lines.remove(next(line for line in lines if line.startswith("friction_coefficient")))  # that of the joints comes first
    natural = [
        'law = "barton_bandis"', "jrc = 9.0", "jcs = 80e6", "residual_friction_angle = 28.0", "joint_aperture = 4e-4", "joint_length = 0.1",
    ]
    where = lines.index('between = ["rock", "rock"]') + 1
    case = folder / "natural.toml"
    case.write_text("\n".join(lines[:where] + natural + lines[where:]), encoding="utf-8")
    return case


def test_natural_joints_have_the_same_bits_on_ranks_and_after_a_stop(sazare, tmp_path):
    case = natural_block(tmp_path)
    options = ("--threads", 1, "--set", "time.end=1.2e-3", "--set", OFTEN)
    alone = sazare("run", case, "--out", tmp_path / "alone", *options)
    assert alone.returncode == DONE, alone.stderr
    assert manifest(tmp_path / "alone")["results"]["energy_slip"] > 0
    sharing = ("--balance", "random", "--balance-interval", 6)
    begun = sazare.start_on(3, "run", case, "--out", tmp_path / "many", *options, *sharing)
    wait_for(tmp_path / "many/checkpoint/state.h5")
    kill_one(begun)
    begun.communicate(timeout=60)
    many = sazare.on_ranks(2, "run", case, "--out", tmp_path / "many", *options, *sharing, "--resume")
    assert many.returncode == DONE, many.stderr
    assert_same_results(tmp_path / "alone", tmp_path / "many")


@pytest.mark.parametrize("ranks", [2, 3])
def test_true_faces_give_the_same_bits_on_ranks(sazare, tmp_path, ranks):
    faces = ("--set", 'contact.contact_shape="faces"', "--set", "contact.face_contact_stiffness=450e9")
    alone = run_alone(tmp_path / "alone", *faces)
    assert manifest(alone)["results"]["broken_joints"] > 0
    many = sazare.on_ranks(ranks, *block_run(sazare, tmp_path / "many", *faces))
    assert many.returncode == DONE, many.stderr
    assert_same_results(alone, tmp_path / "many")


def test_work_of_moving_ground_is_the_same_where_faces_change_their_rank(sazare, tmp_path):
    case = sazare.block.parents[3] / "cases/uniaxial-compression/case.toml"
    short = ("--threads", 1, "--set", "mesh.parameters.size=0.02", "--set", "time.end=2e-4")
    alone = sazare("run", case, "--out", tmp_path / "alone", *short)
    assert alone.returncode == DONE, alone.stderr
    rows = len((tmp_path / "alone/history.csv").read_text(encoding="utf-8").splitlines()) - 2
    steps = manifest(tmp_path / "alone")["results"]["steps"] // rows
    often = ("--balance", "measured", "--balance-interval", steps)  # work is distributed anew at each row
    many = sazare.on_ranks(3, "run", case, "--out", tmp_path / "many", *short, *often)
    assert many.returncode == DONE, many.stderr
    assert rows_without_wall_time(tmp_path / "alone/history.csv") == rows_without_wall_time(tmp_path / "many/history.csv")


@pytest.mark.parametrize("cracks", ["none", "flow"])
def test_gas_of_a_charge_is_the_same_where_faces_change_their_rank(sazare, tmp_path, cracks):
    case = sazare.block.parents[3] / "cases/cylinder-blast/case.toml"
    short = ("--threads", 1, "--set", "mesh.parameters.size=0.02", "--set", "time.end=4e-5")
    short += ("--set", f"charges.0.gas_in_cracks={cracks}")
    alone = sazare("run", case, "--out", tmp_path / "alone", *short)
    assert alone.returncode == DONE, alone.stderr
    assert manifest(tmp_path / "alone")["results"]["explosive_work"] > 0
    often = ("--balance", "measured", "--balance-interval", 14)
    many = sazare.on_ranks(3, "run", case, "--out", tmp_path / "many", *short, *often)
    assert many.returncode == DONE, many.stderr
    assert_same_results(tmp_path / "alone", tmp_path / "many")


@pytest.mark.parametrize(
    ("ranks", "threads", "options"),
    [
        (2, 1, []),
        (3, 1, ["--balance", "measured", "--balance-interval", 7]),
        (4, 1, ["--balance", "predicted", "--balance-interval", 5]),
        (5, 2, ["--balance", "fixed"]),
        (8, 1, ["--balance", "by_level", "--balance-interval", 9]),
        (3, 2, ["--balance", "random", "--balance-interval", 3]),
        (8, 1, ["--balance", "random", "--balance-interval", 11]),
        pytest.param(5, 1, ["--balance", "graph", "--balance-interval", 8], marks=NEEDS_METIS),
    ],
)
def test_any_number_of_ranks_gives_the_same_bits(sazare, tmp_path, alone, ranks, threads, options):
    done = sazare.on_ranks(ranks, *block_run(sazare, tmp_path / "run", *options, threads=threads))
    assert done.returncode == DONE, done.stderr
    assert manifest(alone)["results"]["broken_joints"] > 0
    assert_same_results(alone, tmp_path / "run")


def test_water_washes_broken_faces_the_same_way_on_ranks(sazare, tmp_path):
    text = sazare.block.read_text(encoding="utf-8").replace('"block.msh"', f'"{sazare.block.parent}/block.msh"')
    case = tmp_path / "wet.toml"
    case.write_text(text + "\n[gravity]\nacceleration = [0.0, 0.0, -9.81]\n\n[water]\nlevel = 0.2\ncurrent = [3.0, 0.0, 0.0]\n", encoding="utf-8")
    options = ("--threads", 1, "--set", "time.end=8e-4")
    alone = sazare("run", case, "--out", tmp_path / "alone", *options)
    assert alone.returncode == DONE, alone.stderr
    assert manifest(tmp_path / "alone")["results"]["broken_joints"] > 0
    many = sazare.on_ranks(4, "run", case, "--out", tmp_path / "many", *options, "--balance", "random", "--balance-interval", 7)
    assert many.returncode == DONE, many.stderr
    assert_same_results(tmp_path / "alone", tmp_path / "many")


def test_under_a_travel_limit_bodies_refine_each_other_across_ranks(sazare, tmp_path):
    travel = ["--set", "time.limiter=travel", "--set", "time.travel_length=2e-6", "--set", "time.base_step=1e-6"]
    one = sazare(*block_run(sazare, tmp_path / "one", *travel))
    assert one.returncode == DONE, one.stderr
    many = sazare.on_ranks(3, *block_run(sazare, tmp_path / "many", "--balance-interval", 10, *travel))
    assert many.returncode == DONE, many.stderr
    assert manifest(tmp_path / "one")["results"]["smallest_step"] < 1e-6
    assert_same_results(tmp_path / "one", tmp_path / "many")


def test_joints_that_slip_far_before_they_break(sazare, tmp_path):
    """Slip is known where a joint is evaluated, and levels must not depend on it."""
    weak = ["--set", "joints.0.cohesion=2e5", "--set", "joints.0.friction_coefficient=0.05"]
    one = sazare(*block_run(sazare, tmp_path / "one", *weak))
    assert one.returncode == DONE, one.stderr
    for ranks, interval in ((2, 3), (3, 5)):
        many = sazare.on_ranks(ranks, *block_run(sazare, tmp_path / f"{ranks}", "--balance-interval", interval, *weak))
        assert many.returncode == DONE, many.stderr
        assert_same_results(tmp_path / "one", tmp_path / f"{ranks}")
    figures = manifest(tmp_path / "one")["results"]
    assert figures["broken_joints"] > 0
    assert figures["energy_slip"] > 0.05 * figures["energy_work"]


def test_what_each_rank_did_is_written(sazare, tmp_path):
    sazare.on_ranks(3, *block_run(sazare, tmp_path / "run", "--balance-interval", 10))
    by_rank = by_rank_of(tmp_path / "run")
    assert len(by_rank) == 3
    for own in by_rank:
        for column in ("time", "processor_time", "exchange_time", "bytes_sent", "messages_sent"):
            values = [row[column] for row in own]
            assert values == sorted(values) and values[-1] > 0
    topics = ("motion", "changes", "search", "rows", "state", "other")
    elements = manifest(tmp_path / "run")["results"]["elements"]
    for rows in zip(*by_rank, strict=True):
        assert sum(row["elements"] for row in rows) == elements
        assert len({row["lock_step"] for row in rows}) == 1 and 1 / 3 <= rows[0]["lock_step"] <= 1
        for row in rows:
            assert row["bytes_sent"] == sum(row[f"{topic}_bytes"] for topic in topics)
            assert row["messages_sent"] == sum(row[f"{topic}_messages"] for topic in topics)
            assert row["elements"] == sum(row[name] for name in row if name.startswith("elements_level_"))
            assert 0 < row["border_elements"] <= row["elements"]
    assert manifest(tmp_path / "run")["machine"]["ranks"] == 3


@pytest.mark.parametrize("policy", ["fixed", "by_level", "random", pytest.param("graph", marks=NEEDS_METIS)])
def test_what_borders_send_is_what_levels_and_owners_foretell(sazare, tmp_path, policy):
    """While nothing breaks and no level changes, every byte and message about elements at borders is foretold."""
    strong = ("tensile_strength=1e9", "cohesion=1e9", "fracture_energy=1e8")
    sets = [word for setting in strong for word in ("--set", f"joints.0.{setting}")]
    done = sazare.on_ranks(5, *block_run(sazare, tmp_path / "run", "--balance", policy, "--balance-interval", 4, *sets))
    assert done.returncode == DONE, done.stderr
    assert manifest(tmp_path / "run")["results"]["broken_joints"] == 0
    by_rank = by_rank_of(tmp_path / "run")
    assert sum(own[-1]["motion_bytes"] for own in by_rank) > 0
    for own in by_rank:
        assert len(own) > 3
        for before, after in zip(own, own[1:], strict=False):
            for of in ("bytes", "messages"):
                assert after[f"motion_{of}"] - before[f"motion_{of}"] == after[f"expected_motion_{of}"] - before[f"expected_motion_{of}"]


@pytest.mark.parametrize("policy", ["fixed", "by_level"])
def test_check_foretells_the_lock_step_of_ranks(sazare, tmp_path, policy):
    strong = ("joints.0.tensile_strength=1e9", "joints.0.cohesion=1e9", "joints.0.fracture_energy=1e8", LATER)
    sets = [word for setting in strong for word in ("--set", setting)]
    told = sazare("check", sazare.block, "--ranks", 4, *sets)
    assert told.returncode == DONE, told.stderr
    assert "4 ranks have fewer than 4000 elements each" in told.stdout and "take one process and threads" in told.stdout
    foretold = float(next(line.split()[1] for line in told.stdout.splitlines() if line.startswith(f"  {policy} ")))
    done = sazare.on_ranks(4, *block_run(sazare, tmp_path / "run", "--balance", policy, "--balance-interval", 10, *sets))
    assert done.returncode == DONE, done.stderr
    assert 0.5 < foretold < 1
    assert by_rank_of(tmp_path / "run")[0][0]["lock_step"] == pytest.approx(foretold, abs=0.0051)


def test_check_of_a_method_in_one_process_refuses_ranks(sazare):
    refused = sazare("check", sazare.block.parents[3] / "cases/column-ricker/case.toml", "--ranks", 4)
    assert refused.returncode == USER_ERROR
    assert "one process" in refused.stderr


def test_a_process_that_dies_ends_the_run_and_leaves_a_checkpoint_for_any_number(sazare, tmp_path, long_alone):
    for ranks_then, ranks_after in ((3, 2), (2, 1)):
        folder = tmp_path / f"run{ranks_then}"
        process = subprocess.Popen(
            sazare.ranks_command(ranks_then, *block_run(sazare, folder, *LONG)),
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=MPI_ENVIRONMENT,
        )
        wait_for(folder / "checkpoint" / "state.h5")
        kill_one(process)
        _, words = process.communicate(timeout=60)
        assert process.returncode != DONE
        assert "signal 9" in words
        assert manifest(folder)["status"] in ("running", "stopped")
        resumed = sazare.on_ranks(ranks_after, *block_run(sazare, folder, "--resume", *LONG))
        assert resumed.returncode == DONE, resumed.stderr
        assert_same_results(long_alone, folder)


def test_a_run_of_one_process_goes_on_as_several(sazare, tmp_path, long_alone):
    folder = tmp_path / "run"
    process = sazare.start(*block_run(sazare, folder, *LONG))
    wait_for(folder / "checkpoint" / "state.h5")
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=60)
    assert process.returncode == MACHINE_FAILED
    resumed = sazare.on_ranks(3, *block_run(sazare, folder, "--resume", *LONG))
    assert resumed.returncode == DONE, resumed.stderr
    assert_same_results(long_alone, folder)


def test_ctrl_c_leaves_a_checkpoint(sazare, tmp_path, long_alone):
    folder = tmp_path / "run"
    process = subprocess.Popen(
        sazare.ranks_command(2, *block_run(sazare, folder, *LONG)),
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=MPI_ENVIRONMENT,
    )
    wait_for(folder / "checkpoint" / "state.h5")
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    if "To resume" in errors:  # the launcher does not wait for the words of a busy machine
        assert "mpirun -n 2 sazare run " in errors and "--threads 1" in errors
    resumed = sazare.on_ranks(2, *block_run(sazare, folder, "--resume", *LONG))
    assert resumed.returncode == DONE, resumed.stderr
    assert_same_results(long_alone, folder)


def test_errors_are_said_once(sazare, tmp_path):
    refused = sazare.on_ranks(3, "run", sazare.block, "--out", tmp_path / "run", "--set", "time.end=-1")
    assert refused.returncode == USER_ERROR
    assert refused.stderr.count("time.end") + refused.stderr.count("end = -1") >= 1
    assert refused.stderr.count("nothing was run") == 1
