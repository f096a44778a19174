"""Pictures of runs of method fem, from meshes and tables made here."""

import json
import subprocess
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import pyvista
from PIL import Image

import sazare
from sazare import plot
from sazare.methods import fem
from sazare.movie import write_movie
from sazare.tables import Table
from sazare.view3d import packed_view, read_frames


def snapshot(time, points, kind, cell):
    """One cell whose points move along x by their height times 0.01."""
    points = np.asarray(points, dtype=float)
    grid = pyvista.UnstructuredGrid(np.r_[len(cell), cell], [kind], points)
    moved = np.zeros_like(points)
    moved[:, 0] = 0.01 * time * points.max(axis=1)
    grid.point_data["displacement"] = moved
    grid.cell_data["plastic_shear_strain"] = [0.1 * time]
    return SimpleNamespace(time=time, elements=grid)


SQUARE = ([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], 9, [0, 1, 2, 3])
SIX_NODES = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0.5, 0, 0], [0.5, 0.5, 0], [0, 0.5, 0]], 22, [0, 1, 2, 3, 4, 5])
TETRAHEDRON = ([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], 10, [0, 1, 2, 3])


@pytest.mark.parametrize("shape", [SQUARE, SIX_NODES, TETRAHEDRON])
def test_meshes_are_drawn(shape):
    results = SimpleNamespace(case_text="", element_snapshots=[snapshot(time, *shape) for time in (0.0, 1.0)])
    figure = fem.displaced(results)
    assert "1 s, displacements × " in figure.axes[0].get_title(loc="left")
    assert fem.yielding(results) is not None


def test_displacements_have_a_prefix_that_suits_them():
    figure = fem.displaced(SimpleNamespace(case_text="", element_snapshots=[snapshot(time, *SQUARE) for time in (0.0, 1.0)]))
    assert figure.axes[-1].get_ylabel() == "displacement [mm]"
    assert figure.axes[0].collections[0].get_array().max() == pytest.approx(7.5)  # three corners move by 10 mm


def test_ground_on_a_moving_base_is_seen_from_there():
    shots = [snapshot(time, *SQUARE) for time in (0.0, 1.0)]
    for shot in shots:
        shot.elements.point_data["displacement"][:, 0] = [2.0 * shot.time] * 2 + [2.004 * shot.time] * 2
        shot.elements.points = np.array(SQUARE[0], dtype=float) + shot.elements.point_data["displacement"]
    case = '[[motions]]\nname = "m"\n[[boundaries]]\ngroup = "bottom"\nmotion_x = "m"\n'
    figure = fem.displaced(SimpleNamespace(case_text=case, element_snapshots=shots))
    assert figure.axes[-1].get_ylabel() == "displacement relative to the base [mm]"
    assert figure.axes[0].collections[0].get_array().max() == pytest.approx(2.0), "two of the corners moved by 4 mm against the base"
    still = fem.displaced(SimpleNamespace(case_text="", element_snapshots=shots))
    assert still.axes[-1].get_ylabel() == "displacement [m]" and still.axes[0].collections[0].get_array().max() == pytest.approx(2.002)


def test_gauges_of_a_static_analysis_have_curves_that_differ():
    time = np.linspace(0.0, 1.0, 5)
    names = [f"g{number}" for number in range(12)]
    table = Table({"time": time} | {f"{name}.displacement_{axis}": (number + 1.0) * time for number, name in enumerate(names) for axis in "xyz"})
    figure = fem.displacements(SimpleNamespace(case_text="", gauges=dict.fromkeys(names), gauge_table=table))
    lines = figure.axes[0].get_lines()
    assert [line.get_label() for line in lines] == names and len({(line.get_color(), str(line.get_linestyle())) for line in lines}) == 12


def test_joints_beyond_those_that_slip_most_are_told_of():
    time = np.linspace(0.0, 1.0, 5)
    names = [f"j{number}" for number in range(8)]
    history = Table({"time": time} | {f"{name}.{key}": number * time for number, name in enumerate(names) for key in ("slip_max", "sliding_fraction", "open_fraction")})
    figure = fem.joints(SimpleNamespace(history=history))
    assert [line.get_label() for line in figure.axes[1].get_lines()] == names[:1:-1]
    assert figure.get_supxlabel() == "2 more, j0, j1: see history.csv"


def test_the_outline_of_a_quadratic_cell_goes_round():
    grid = snapshot(1.0, *SIX_NODES).elements
    (cell,) = fem.outlines(grid)
    assert list(cell) == [0, 3, 1, 4, 2, 5]


def row_of_cells(ends):
    """Squares and rectangles 1 m high between the given places along x."""
    points = [[x, y, 0.0] for x in ends for y in (0.0, 1.0)]
    cells = [[4, 2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1] for i in range(len(ends) - 1)]
    grid = pyvista.UnstructuredGrid(np.ravel(cells), [9] * len(cells), np.array(points))
    grid.point_data["displacement"] = np.zeros((len(points), 3))
    grid.cell_data["plastic_shear_strain"] = np.full(len(cells), 0.1)
    return SimpleNamespace(time=1.0, elements=grid)


def test_cells_that_stand_for_ground_without_end_are_not_drawn():
    figure = fem.yielding(SimpleNamespace(case_text="", element_snapshots=[row_of_cells([-400.0, 0.0, 1.0, 2.0, 3.0, 7.0, 900.0])]))
    assert figure.axes[0].get_xlim() == (0.0, 7.0)
    whole = fem.yielding(SimpleNamespace(case_text="", element_snapshots=[row_of_cells([0.0, 1.0, 2.0, 3.0])]))
    low, high = whole.axes[0].get_xlim()
    assert low <= 0.0 and high >= 3.0


def test_forces_that_are_never_there_are_left_out():
    time = np.linspace(0.0, 1.0, 5)
    history = Table({"time": time, "foot of it.force_x": 2.0 * time, "side.force_y": 0.0 * time})
    figure = plot.boundary_forces(SimpleNamespace(history=history))
    (line,) = figure.axes[0].get_lines()
    assert line.get_label() == "foot of it along x"


@pytest.mark.parametrize("residual, tone", [(0.5, "good"), (-5.0, "fair"), (11.0, "bad")])
def test_the_verdict_reads_the_energy_balance_of_the_whole_run(residual, tone):
    # The work is taken back in the end, and so is the residual.
    table = Table({"time": np.arange(3.0), "energy_work": np.array([0.0, -100.0, 1.0]), "energy_kinetic": np.zeros(3),
                   "energy_elastic": np.zeros(3), "energy_residual": np.array([0.0, residual, 0.0])})
    found, sentence = fem.verdict(SimpleNamespace(history=table, figures={}))
    assert found == tone and f"{abs(residual) / 100.0:.1e} of the energy in play" in sentence


def test_nothing_is_drawn_without_data():
    empty = SimpleNamespace(history=Table({}), element_snapshots=[], gauge_table=Table({}), gauges={})
    for draw in (fem.displaced, fem.yielding, plot.boundary_forces, fem.joints, fem.displacements):
        assert draw(empty) is None


def test_the_view_and_the_movie_show_the_deformed_mesh(tmp_path):
    """A cantilever under a load: fields of points are means of cells, and the magnification is told."""
    root = Path(__file__).resolve().parents[3]
    command = [root / "build/release/apps/sazare/sazare", "run", root / "cases/cantilever-fem/case.toml", "--out", tmp_path / "run", "--quiet"]
    subprocess.run([*command, "--set", "time.end=0.03"], check=True, timeout=120)
    results = sazare.open(tmp_path / "run")
    frames = read_frames(results)
    field = frames.fields[0]
    grid = results.element_snapshots[-1].elements
    size = np.linalg.norm(grid.point_data["displacement"], axis=1)
    assert (field.name, field.unit) == ("displacement", "m")
    assert field.values[-1][0] == pytest.approx(size[grid.get_cell(frames.shapes.cells[0]).point_ids].mean())
    assert {"von Mises stress", "speed"} <= {each.name for each in frames.fields}
    places = frames.start + frames.moved[-1]
    assert np.allclose(places, np.asarray(grid.points)[frames.shapes.points])
    view = json.loads(packed_view(results))
    assert view["kind"] == "triangles" and view["enlargement"] == frames.enlargements[-1]
    with Image.open(write_movie(results, tmp_path / "beam.gif", "von Mises stress")) as film:
        assert film.n_frames == len(results.element_snapshots) and min(film.size) >= 80


def test_the_view_looks_at_what_pictures_show():
    grid = row_of_cells([-400.0, 0.0, 1.0, 2.0, 3.0, 7.0, 900.0]).elements
    assert fem.METHOD.extent(grid)[:, 0] == pytest.approx([0.0, 7.0])


def test_a_body_that_moves_as_a_whole_is_not_judged_by_round_off():
    table = Table({"time": np.arange(2.0), "energy_work": np.array([0.0, 1e-9]), "energy_residual": np.array([0.0, 1e-9])})
    assert fem.verdict(SimpleNamespace(history=table, figures={}))[0] == "bad"
    tone, words = fem.verdict(SimpleNamespace(history=table, figures={"energy_round_off": 1e-8}))
    assert tone == "good" and "round-off" in words
    assert fem.verdict(SimpleNamespace(history=table, figures={"energy_round_off": 1e-10}))[0] == "bad"


def test_the_von_mises_stress_follows_from_the_components_of_the_stress(tmp_path):
    root = Path(__file__).resolve().parents[3]
    command = [root / "build/release/apps/sazare/sazare", "run", root / "cases/cantilever-fem/case.toml", "--out", tmp_path / "run", "--quiet"]
    subprocess.run([*command, "--set", "time.end=0.03"], check=True, timeout=120)
    cells = sazare.open(tmp_path / "run").element_snapshots[-1].elements.cell_data
    (x, y, z), (xy, yz, zx) = np.asarray(cells["normal_stress"]).T, np.asarray(cells["shear_stress"]).T
    expected = np.sqrt(0.5 * ((x - y) ** 2 + (y - z) ** 2 + (z - x) ** 2) + 3.0 * (xy**2 + yz**2 + zx**2))
    assert np.asarray(cells["von_mises_stress"]) == pytest.approx(expected, rel=1e-12)


def test_the_range_of_the_pore_pressure_is_drawn_with_its_suction():
    columns = {"time": [0.0, 1.0], "excess_pore_pressure_max": [0.0, 2e4], "excess_pore_pressure_min": [0.0, -1.2e5], "pore_pressure_min": [0.0, -9e4]}
    history = Table({name: np.array(values) for name, values in columns.items()})
    lines = fem.pore_pressure_range(SimpleNamespace(history=history)).axes[0].lines
    assert [line.get_ydata()[-1] for line in lines] == pytest.approx([20.0, -120.0, -90.0])
    still = Table({name: np.zeros(2) if name != "time" else np.arange(2.0) for name in columns})
    assert fem.pore_pressure_range(SimpleNamespace(history=still)) is None


def test_members_are_drawn_with_their_moments():
    columns = {"time": [0.0, 1.0]}
    for name, moment in (("wall", 2e5), ("rod", 0.0)):
        columns |= {f"{name}.axial_force_min": [0.0, -1e5], f"{name}.axial_force_max": [0.0, 5e4], f"{name}.moment_max": [0.0, moment]}
    figure = fem.members(SimpleNamespace(history=Table({name: np.array(values) for name, values in columns.items()})))
    left, right = figure.axes
    assert [line.get_ydata()[-1] for line in left.lines] == pytest.approx([50.0, -100.0] * 2)
    assert [line.get_ydata()[-1] for line in right.lines] == pytest.approx([200.0])
    assert right.lines[0].get_color() == left.lines[0].get_color()


def test_members_that_yield_are_drawn_with_what_they_bear_of_their_limits():
    columns = {"time": [0.0, 1.0, 2.0]}
    for name, moment in (("wall", 2e5), ("rod", 0.0), ("strut", 0.0)):
        columns |= {f"{name}.axial_force_min": [0.0, 0.0, 0.0], f"{name}.axial_force_max": [0.0, 5e4, 5e4], f"{name}.moment_max": [0.0, moment, moment]}
    history = Table({name: np.array(values) for name, values in columns.items()})
    assert fem.plastic_members(SimpleNamespace(history=history)) is None
    columns |= {"wall.moment_ratio": [0.0, 0.8, 0.7], "wall.plastic_rotation": [0.0, 0.0, 0.0]}
    columns |= {"rod.force_ratio": [0.0, 1.0, 1.0], "rod.plastic_elongation": [0.0, 0.0, 3e-3]}
    results = SimpleNamespace(history=Table({name: np.array(values) for name, values in columns.items()}))
    forces, moments, limits = fem.members(results).axes
    assert [line.get_ydata()[-1] for line in limits.lines] == pytest.approx([0.7, 1.0, 1.0])  # the last is the limit
    assert limits.lines[0].get_color() == moments.lines[0].get_color()
    (axes,) = fem.plastic_members(results).axes
    assert [line.get_label() for line in axes.lines] == ["rod"]
    assert axes.lines[0].get_ydata()[-1] == pytest.approx(3.0)
    assert axes.get_ylabel() == "plastic elongation [mm]"
