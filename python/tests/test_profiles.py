"""Peak shear strain and stress between gauges above each other, against a standing wave in a column, and the table beside the report."""

import json
from pathlib import Path

import numpy as np
import pytest

import sazare
from sazare import shaking
from sazare.ground_motion import profile_table, shear_history
from sazare.ground_motion.gauges import AXES, GaugeMotion
from sazare.tables import write_table

PAGE = Path(__file__).resolve().parents[2] / "docs/reference/run-folder.md"
HEIGHT, DENSITY, VELOCITY, FREQUENCY, SIZE = 30.0, 1800.0, 200.0, 4.0, 1e-3  # m, kg/m3, m/s, Hz, m
WAVE = 2.0 * np.pi * FREQUENCY / VELOCITY
MODULUS = DENSITY * VELOCITY**2


def gauges(heights):
    """Gauges in a standing wave below a free surface at HEIGHT."""
    time = np.linspace(0.0, 0.5, 401)
    rate = 2.0 * np.pi * FREQUENCY
    zero = np.zeros((len(time), 3))
    for number, height in enumerate(heights):
        motion = np.array(zero)
        motion[:, 0] = SIZE * np.cos(WAVE * (HEIGHT - height)) * np.sin(rate * time)
        speed = np.gradient(motion, time, axis=0)
        yield GaugeMotion(f"g{number}", np.array([0.0, height, 0.0]), time, motion, speed, -(rate**2) * motion)


def exact(height):
    """Peak strain [-] of the wave at a height [m]; times the modulus it is the stress."""
    return SIZE * WAVE * np.abs(np.sin(WAVE * (HEIGHT - height)))


def test_strain_and_stress_of_a_standing_wave():
    """Between gauges a tenth of a radian apart both are exact but for its square over 24 and over 12."""
    heights = np.linspace(0.0, HEIGHT, 39)
    apart = WAVE * (heights[1] - heights[0])
    history = shear_history(list(gauges(heights)), 0, heights, DENSITY)
    assert history.height == pytest.approx(0.5 * (heights[1:] + heights[:-1]))
    largest = SIZE * WAVE
    assert np.abs(history.strain).max(axis=0) == pytest.approx(exact(history.height), abs=apart**2 / 20.0 * largest)
    assert np.abs(history.stress).max(axis=0) == pytest.approx(MODULUS * exact(history.height), abs=apart**2 / 10.0 * MODULUS * largest)
    strong = exact(history.height) > 0.5 * largest
    assert history.stress[50][strong] / (MODULUS * history.strain[50][strong]) == pytest.approx(1.0, abs=0.01), "with one sign"


def test_ground_above_the_highest_gauge_moves_with_it():
    heights = np.linspace(0.0, HEIGHT - 1.0, 30)
    whole = shear_history(list(gauges(heights)), 0, heights, DENSITY, above=DENSITY * 1.0)
    without = shear_history(list(gauges(heights)), 0, heights, DENSITY)
    assert np.abs(whole.stress).max(axis=0) == pytest.approx(MODULUS * exact(whole.height), abs=0.01 * MODULUS * SIZE * WAVE)
    top = DENSITY * 1.0 * (2.0 * np.pi * FREQUENCY) ** 2 * SIZE * np.cos(WAVE)
    assert np.abs(whole.stress - without.stress).max() == pytest.approx(top, rel=1e-3)


def test_a_density_for_each_interval_counts_where_it_stands():
    heights = [0.0, 10.0, 30.0]
    light = shear_history(list(gauges(heights)), 0, heights, [1000.0, 2000.0])
    heavy = shear_history(list(gauges(heights)), 0, heights, [3000.0, 2000.0])
    assert light.stress[:, 1] == pytest.approx(heavy.stress[:, 1])
    assert np.abs(light.stress[:, 0] - heavy.stress[:, 0]).max() > 0.0
    assert shear_history(list(gauges(heights)), 0, heights).stress is None


@pytest.fixture
def column(tmp_path):
    """A run whose gauges stand in the wave, without snapshots."""
    motions = list(gauges(np.linspace(0.0, HEIGHT, 7)))
    columns = {"time [s]": motions[0].time}
    for motion in motions:
        for quantity, unit in (("displacement", "m"), ("velocity", "m/s"), ("acceleration", "m/s2")):
            columns |= {f"{motion.name}.{quantity}_{axis} [{unit}]": getattr(motion, quantity)[:, number] for number, axis in enumerate(AXES)}
    write_table(tmp_path / "gauges.csv", columns)
    points = "".join(f'[[gauges]]\nname = "{motion.name}"\npoint = {motion.point.tolist()}\n' for motion in motions)
    (tmp_path / "case.toml").write_text(f'[case]\nmethod = "fem"\n{points}')
    (tmp_path / "manifest.json").write_text(json.dumps({"method": "fem", "status": "done", "results": {}}))
    return sazare.open(tmp_path)


def test_the_table_and_the_picture_have_the_strain_and_its_columns_are_documented(column):
    table = profile_table(column)
    assert table["below"] == [f"g{number}" for number in range(6)] and table["above"] == [f"g{number}" for number in range(1, 7)]
    assert set(table["axis"]) == {"x"} and np.all(np.isnan(table["peak_shear_stress [Pa]"])), "its density is not known"
    moved = SIZE * np.diff(np.cos(WAVE * (HEIGHT - np.linspace(0.0, HEIGHT, 7)))) / 5.0
    assert table["peak_shear_strain [-]"] == pytest.approx(np.abs(moved))
    panels = shaking.profiles(column).axes
    assert panels[3].lines[0].get_xdata() == pytest.approx(100.0 * np.abs(moved))
    page = PAGE.read_text(encoding="utf-8").split("## profiles.csv")[1].split("\n## ")[0]
    for name in table:
        title, _, unit = name.partition(" [")
        assert f"| `{title}` | {unit.rstrip(']')} |".replace("|  |", "| |") in page, name


def test_the_stress_of_a_run_of_mps_is_that_of_the_ground_above(tmp_path):
    """Beside the stress that its particles have: a column on a base that is shaken, at a spacing that resolves the wave."""
    case = Path(__file__).resolve().parents[2] / "validation/analytic/particle-stress/wave.toml"
    overrides = {"time.end": 0.3, "time.history_interval": 1e-3, "time.snapshot_interval": 0.3, "particles.spacing": 0.5}
    opened = sazare.read_case(case)
    opened.gauges = [sazare.cases.mps.Gauge(name=f"g{height}", point=[0.0, float(height), 0.0]) for height in range(0, 81, 2)]
    for region in opened.regions:
        region.upper[0] = 1.0
    for key, value in overrides.items():
        table, name = key.split(".")
        setattr(getattr(opened, table), name, value)
    results = sazare.run(opened, tmp_path / "run", progress=False)
    motions = sazare.ground_motion.gauges.gauge_motions(results)
    stack = sazare.ground_motion.gauges.stacks(results, motions)[0]
    history = sazare.ground_motion.shear_history_of(results, stack, 0, 1)
    grid = results.particle_snapshots[-1].elements
    height, stress = np.asarray(grid.points)[:, 1], np.asarray(grid["shear_stress"])[:, 0]
    own = np.interp(history.height, *_mean_by_row(height, stress))
    assert np.abs(own).max() > 1e3
    assert history.stress[-1] == pytest.approx(own, abs=0.04 * np.abs(own).max())
    strain = np.interp(history.height, *_mean_by_row(height, np.asarray(grid["shear_strain"])[:, 0]))
    assert history.strain[-1] == pytest.approx(strain, abs=0.04 * np.abs(strain).max())


def test_the_stress_of_a_run_of_fem_is_that_of_its_elements(tmp_path):
    """In a column of soil on rock of another density, which a record shakes."""
    case = Path(__file__).resolve().parents[2] / "validation/analytic/column-beside-pystrata/elements.toml"
    opened = sazare.read_case(case)
    opened.gauges = [sazare.cases.fem.Gauge(name=f"g{height}", point=[0.0, float(height), 0.0]) for height in range(23)]
    opened.time.end = opened.time.snapshot_interval = 2.0
    results = sazare.run(opened, tmp_path / "run", progress=False)
    motions = sazare.ground_motion.gauges.gauge_motions(results)
    stack = sazare.ground_motion.gauges.stacks(results, motions)[0]
    history = sazare.ground_motion.shear_history_of(results, stack, 0, 1)
    grid = results.element_snapshots[-1].elements
    height = np.asarray(grid.cell_centers().points)[:, 1]
    assert set(np.asarray(grid["density"])) == {1800.0, 2200.0}
    own = np.interp(history.height, *_mean_by_row(height, np.asarray(grid["shear_stress"])[:, 0]))
    assert history.stress[-1] == pytest.approx(own, abs=0.04 * np.abs(own).max())


def _mean_by_row(height, values):
    rows, number = np.unique(np.round(height, 2), return_inverse=True)
    return rows, np.bincount(number, values) / np.bincount(number)
