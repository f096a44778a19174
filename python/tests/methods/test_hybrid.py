"""Pictures of runs of method hybrid, from meshes and tables made here."""

from types import SimpleNamespace

import numpy as np
import pytest
import pyvista
from matplotlib.colors import to_rgb
from PIL import Image

from sazare import movie, report, style
from sazare.methods import hybrid
from sazare.results import Table, open_run


def mesh(kind=9, cell=(0, 1, 2, 3)):
    """One square of a continuum."""
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
    grid = pyvista.UnstructuredGrid(np.r_[len(cell), cell], [kind], points)
    grid.cell_data["region"] = [2]
    return grid


def cloud():
    """Two spheres beside it."""
    points = np.array([[-0.5, 0.2, 0.0], [-0.2, 0.6, 0.1]])
    grid = pyvista.UnstructuredGrid(np.array([1, 0, 1, 1]), [1, 1], points)
    grid.cell_data["radius"] = [0.1, 0.2]
    grid.cell_data["velocity"] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]
    return grid


def run(kind=9, cell=(0, 1, 2, 3)):
    sides = {"continuum": SimpleNamespace(all_snapshots=[SimpleNamespace(time=t, elements=mesh(kind, cell)) for t in (0.0, 1.0)]),
             "bodies": SimpleNamespace(all_snapshots=[SimpleNamespace(time=t, elements=cloud()) for t in (0.0, 1.0)])}
    return SimpleNamespace(sides=sides)


def history():
    time = np.linspace(0.0, 1.0, 5)
    names = [f"surface.{what}_{axis}" for what in ("force", "displacement") for axis in "xyz"]
    columns = {name: time * (1.0 if name.endswith("y") else 0.1) for name in names}
    return Table({"time": time, **columns, "energy_work_on_nodes": time, "energy_work_on_bodies": -0.9 * time, "energy_coupling_error": 0.1 * time})


def test_both_sides_are_drawn_within_one_frame():
    figure = hybrid.together(run())
    assert figure.axes[1].get_title(loc="left") == "1 s"
    assert figure.axes[0].get_xlim() == (-0.6, 1.0)


def test_every_snapshot_of_both_sides_is_a_frame_of_the_movie():
    frames = list(hybrid.moving(run()))
    assert [time for time, _ in frames] == [0.0, 1.0]
    assert [figure.axes[0].get_title(loc="left") for _, figure in frames] == ["0 s", "1 s"]
    assert {figure.axes[0].get_xlim() for _, figure in frames} == {(-0.6, 1.0)}


def test_a_coupled_run_is_written_as_a_movie(tmp_path):
    results = SimpleNamespace(**vars(run()), manifest={"method": "hybrid"}, case_text="", path=tmp_path)
    with Image.open(movie.write_movie(results, tmp_path / "both.gif")) as written:
        assert written.n_frames == 2
    with pytest.raises(ValueError, match="leave out --field"):
        movie.write_movie(results, tmp_path / "both.gif", field="speed")


def test_a_continuum_in_space_is_drawn_from_a_corner():
    figure = hybrid.together(run(10, (0, 1, 2, 3)))
    assert [len(axes.images) for axes in figure.axes[:2]] == [1, 1]
    assert np.asarray(figure.axes[0].images[0].get_array()).std() > 10


def test_the_ground_has_other_colors_than_bodies_at_any_speed():
    speeds = style.SPEED(np.linspace(0.0, 1.0, 50))[:, :3]
    for color in style.GROUND:
        assert np.linalg.norm(speeds - to_rgb(color), axis=1).min() > 0.12


def test_small_displacements_have_a_suitable_prefix():
    table = history()
    small = {name: 5e-5 * table[name] if "displacement" in name else table[name] for name in table}
    figure = hybrid.surface(SimpleNamespace(history=Table({**small, "time": 1e-3 * table["time"]})))
    assert [axes.get_ylabel() for axes in figure.axes] == ["force along y [N]", "displacement along y [µm]"]
    assert figure.axes[1].get_xlabel() == "time [ms]"
    assert figure.axes[1].lines[0].get_ydata().max() == pytest.approx(50.0)


def test_the_surface_is_drawn_along_the_axis_on_which_it_is_largest():
    figure = hybrid.surface(SimpleNamespace(history=history()))
    assert [axes.get_ylabel() for axes in figure.axes] == ["force along y [N]", "displacement along y [m]"]
    assert len(hybrid.exchange(SimpleNamespace(history=history())).axes[0].get_lines()) == 3


def test_nothing_is_drawn_without_data():
    empty = SimpleNamespace(history=Table({}), sides={})
    for draw in (hybrid.together, hybrid.surface, hybrid.exchange):
        assert draw(empty) is None


@pytest.mark.parametrize(
    "made, residual, tone, words",
    [(1.0, 0.1, "good", "created by the coupling is 5.0e-03"), (-5.0, 0.0, "fair", "created by the coupling is 2.5e-02"),
     (332.0, 0.0, "bad", 'use scheme = "automatic"'), (0.1, 30.0, "bad", "residual of the two sides is 1.5e-01")],
)
def test_the_verdict_reads_the_energy_made_at_the_surface_and_both_balances(made, residual, tone, words):
    table = Table({"time": np.arange(2.0), "energy_work_on_nodes": np.array([0.0, 150.0]), "energy_work_on_bodies": np.array([0.0, -200.0]),
                   "energy_coupling_error": np.array([0.0, made]), "energy_residual_continuum": np.array([0.0, residual]),
                   "energy_residual_bodies": np.zeros(2)})
    found, sentence = hybrid.verdict(SimpleNamespace(history=table, figures={}, case_text='scheme = "impulse"'))
    assert found == tone and words in sentence


@pytest.mark.parametrize(
    "scheme, advice", [("lagged", 'use scheme = "automatic", or a shorter'), ("automatic", 'use scheme = "iterative", or a shorter'), ("iterative", "use a shorter")]
)
def test_the_verdict_advises_what_the_run_has_not_done(scheme, advice):
    table = Table({"time": np.arange(2.0), "energy_work_on_nodes": np.array([0.0, 1.0]), "energy_work_on_bodies": np.zeros(2),
                   "energy_coupling_error": np.array([0.0, 1.0]), "energy_residual_continuum": np.zeros(2), "energy_residual_bodies": np.zeros(2)})
    assert advice in hybrid.verdict(SimpleNamespace(history=table, figures={}, case_text=f'scheme = "{scheme}"'))[1]


def test_the_verdict_of_a_run_in_which_nothing_touches():
    names = ("energy_work_on_nodes", "energy_work_on_bodies", "energy_coupling_error", "energy_residual_continuum", "energy_residual_bodies")
    table = Table({"time": np.arange(2.0), **{name: np.zeros(2) for name in names}})
    assert hybrid.verdict(SimpleNamespace(history=table, figures={})) == ("good", "The run is complete. Nothing went over the surface.")


def test_the_sides_of_a_run_are_runs(tmp_path):
    for name in ("", "continuum", "bodies"):
        (tmp_path / name).mkdir(exist_ok=True)
        method = {"": "hybrid", "continuum": "fem", "bodies": "spheres"}[name]
        (tmp_path / name / "manifest.json").write_text(f'{{"method": "{method}", "status": "done", "results": {{}}}}')
    results = open_run(tmp_path)
    assert [side.manifest["method"] for side in results.sides.values()] == ["fem", "spheres"]
    names = [section.name for section in report.sections_of(results)]
    assert names[0] == "together" and "continuum_displaced" in names and "bodies_spheres" in names
    assert len(set(names)) == len(names)


def test_a_side_that_says_it_is_coupled_itself_is_left_out(tmp_path):
    (tmp_path / "manifest.json").write_text('{"method": "hybrid", "status": "done", "results": {}}')
    (tmp_path / "continuum").symlink_to(tmp_path, target_is_directory=True)
    names = [section.name for section in report.sections_of(open_run(tmp_path))]
    assert names == ["together", "surface", "exchange", "timing"]
