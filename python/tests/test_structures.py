"""What remains of structures, from snapshots and gauges whose motion is known."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import pyvista

from sazare import structures
from sazare.snapshots import Snapshots
from sazare.structures import structure_motions, structure_table
from sazare.tables import Table

PAGE = Path(__file__).parents[2] / "docs/reference/run-folder.md"
CASE = """
[gravity]
acceleration = [0.0, -9.81, 0.0]
[[blocks]]
name = "house"
[[boundaries]]
side = "bottom"
motion_x = "wave"
[[gauges]]
name = "base"
point = [0.0, -10.0, 0.0]
[[gauges]]
name = "wall top"
point = [0.0, 4.0, 0.0]
[[gauges]]
name = "wall foot"
point = [0.0, 0.0, 0.0]
[[gauges]]
name = "field"
point = [50.0, 0.0, 0.0]
"""
TIME = np.linspace(0.0, 10.0, 501)
GROUND, SLIP, SINKS, TILT = 0.3, 0.2, 0.05, 4.0  # m, m, m, degrees
PEAK = 1.5  # of what remains, on the way


def share(time):
    """How much of what remains there is: PEAK at 5 s, 1 at 8 s and after."""
    return np.interp(time, [0.0, 5.0, 8.0, 10.0], [0.0, PEAK, 1.0, 1.0])


def ground(time):
    return GROUND * np.sin(2.0 * np.pi * np.asarray(time) / 4.0)


def place(point, time):
    """Where a point of the house is: turned clockwise about its middle, (0, 2), moved and sunk, on ground that moves."""
    angle = np.radians(TILT) * share(time)
    x, y = point[0], point[1] - 2.0
    return np.array([x * np.cos(angle) + y * np.sin(angle) + SLIP * share(time) + ground(time), 2.0 - x * np.sin(angle) + y * np.cos(angle) - SINKS * share(time), 0.0])


def house(time):
    points = np.array([place(point, time) for point in ([-3.0, 0.0], [3.0, 0.0], [3.0, 4.0], [-3.0, 4.0])])
    grid = pyvista.UnstructuredGrid([4, 0, 1, 2, 3], [9], points)
    grid.cell_data["block"] = [0]
    return SimpleNamespace(time=time, elements=grid)


def made(gauges=True):
    table = {"time": TIME}
    ways = {
        "base": np.stack([ground(TIME), 0.0 * TIME, 0.0 * TIME], axis=1), "field": np.stack([ground(TIME), 0.01 * np.sin(TIME), 0.0 * TIME], axis=1),
        "wall top": np.array([place([0.0, 4.0], t) - [0.0, 4.0, 0.0] for t in TIME]), "wall foot": np.array([place([0.0, 0.0], t) for t in TIME]),
    }
    for name, way in ways.items():
        velocity = np.gradient(way, TIME, axis=0)
        for quantity, values in (("displacement", way), ("velocity", velocity), ("acceleration", np.gradient(velocity, TIME, axis=0))):
            table |= {f"{name}.{quantity}_{axis}": values[:, number] for number, axis in enumerate("xyz")}
    names = list(ways) if gauges else []
    return SimpleNamespace(all_snapshots=Snapshots([house(t) for t in np.linspace(0.0, 10.0, 21)]), case_text=CASE, sides={}, path=None,
                           gauge_table=Table(table if gauges else {"time": TIME}), gauges=dict.fromkeys(names))


def rows(table):
    return {name: {key.split(" ")[0]: column[number] for key, column in table.items()} for number, name in enumerate(table["structure"])}


def test_a_body_and_its_gauges_tell_the_same():
    found = rows(structure_table(made()))
    assert set(found) == {"house", "wall", "field"} and found["house"]["against"] == "base"
    for name in ("house", "wall"):
        row = found[name]
        assert row["residual_displacement"] == pytest.approx(SLIP, abs=1e-6) and row["peak_displacement"] == pytest.approx(PEAK * SLIP, rel=1e-3)
        assert row["residual_settlement"] == pytest.approx(SINKS, abs=1e-6) and row["peak_settlement"] == pytest.approx(PEAK * SINKS, rel=1e-3)
        assert row["residual_tilt"] == pytest.approx(TILT, rel=1e-6) and row["peak_tilt"] == pytest.approx(PEAK * TILT, rel=1e-3)
    assert found["wall"]["at_rest"] == 1.0 and found["field"]["at_rest"] == 0.0
    assert np.isnan(found["field"]["residual_tilt"])


def test_another_gauge_may_be_the_reference_and_must_exist():
    motions = {motion.name: motion for motion in structure_motions(made(), "field")}
    assert motions["house"].displacement[-1, 1] == pytest.approx(-SINKS - 0.01 * np.sin(10.0), abs=1e-6)
    assert "field" not in motions and "base" in motions
    with pytest.raises(ValueError, match="no gauge 'sea'.*base, field"):
        structure_table(made(), "sea")


def test_a_motion_from_below_is_told_along_a_level_axis():
    shaken = made()
    shaken.case_text = CASE.replace("motion_x", "motion_y")
    table = structure_table(shaken)
    assert set(table["axis"]) == {"x"} and rows(table)["house"]["residual_displacement"] == pytest.approx(SLIP, abs=1e-6)


def test_without_gauges_motion_is_since_the_beginning():
    found = rows(structure_table(made(gauges=False)))
    assert found["house"]["residual_displacement"] == pytest.approx(SLIP + ground(10.0), abs=1e-6)
    assert found["house"]["against"] == "the beginning"


def test_regions_on_which_the_ground_goes_on_are_no_structures(monkeypatch):
    """A caisson of one cell on a strip of three."""
    points = np.array([[x, y, 0.0] for y in (0.0, 1.0) for x in (0.0, 1.0, 2.0, 3.0)] + [[1.0, 2.0, 0.0], [2.0, 2.0, 0.0]])
    cells = [[4, 0, 1, 5, 4], [4, 1, 2, 6, 5], [4, 2, 3, 7, 6], [4, 5, 6, 9, 8]]
    grid = pyvista.UnstructuredGrid(np.ravel(cells), [9] * 4, points)
    grid.cell_data["region"], grid.point_data["displacement"] = [0, 0, 0, 1], np.zeros((10, 3))
    monkeypatch.setattr(structures, "region_names", lambda opened: ["ground", "caisson"])
    found = structures._regions(None, {}, grid, 1)
    assert list(found) == ["caisson"] and list(found["caisson"]) == [5, 6, 8, 9]


def test_the_columns_stand_in_the_reference():
    page = PAGE.read_text(encoding="utf-8").split("## structures.csv")[1].split("\n## ")[0]
    for column in structure_table(made()):
        name, _, unit = column.partition(" [")
        assert f"| `{name}` | {unit.rstrip(']')} |".replace("|  |", "| |") in page, column
