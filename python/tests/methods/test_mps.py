"""Pictures of runs of method mps, from small folders made here."""

import json

import numpy as np
import pytest

from sazare import plot, shaking
from sazare.methods import mps
from sazare.report import write_report
from sazare.results import open_run
from sazare.summary import terminal_text
from synthetic_run import write_grid


@pytest.fixture
def ground_run(tmp_path):
    """Two gauges: the second one moves twice as much, along y."""
    time = np.linspace(0.0, 2.0, 401)
    columns, values = ["time [s]"], [time]
    for name, size in (("base", 1.0), ("surface", 2.0)):
        for quantity, unit in (("displacement", "m"), ("velocity", "m/s"), ("acceleration", "m/s2")):
            for axis in "xyz":
                columns.append(f"{name}.{quantity}_{axis} [{unit}]")
                values.append(size * np.sin(20.0 * time) * np.exp(-time) if axis == "y" else np.zeros_like(time))
    rows = "\n".join(",".join(f"{value:.9g}" for value in row) for row in zip(*values))
    (tmp_path / "gauges.csv").write_text(",".join(columns) + "\n" + rows + "\n")
    (tmp_path / "history.csv").write_text("time [s],energy_kinetic [J],energy_elastic [J]\n0,0,0\n1,2,1\n2,1,2\n")
    manifest = {"method": "mps", "status": "done", "case": "ground", "results": {"step": 1e-3, "predicted_limit": 2e-3, "particles": 10}}
    (tmp_path / "manifest.json").write_text(json.dumps(manifest))
    return tmp_path


def test_main_axis_is_that_of_the_strongest_motion(ground_run):
    results = open_run(ground_run)
    assert shaking.main_axis(results) == 1
    assert shaking.gauge_history(results, "surface", "acceleration")[:, 1].max() == pytest.approx(
        2.0 * shaking.gauge_history(results, "base", "acceleration")[:, 1].max())


def test_main_axis_is_that_of_the_input_whatever_else_moves(ground_run):
    (ground_run / "case.toml").write_text('[[boundaries]]\nside = "bottom"\nmotion_x = "wave"\nmotion_y = ""\n')
    assert shaking.main_axis(open_run(ground_run)) == 0
    (ground_run / "case.toml").write_text('[[boundaries]]\nside = "bottom"\nmotion_x = "wave"\nmotion_y = "wave"\n')
    assert shaking.main_axis(open_run(ground_run)) == 1


def test_spectral_ratio_is_that_of_the_gauges(ground_run):
    figure = shaking.spectra(open_run(ground_run))
    ratio = figure.axes[1].lines[0].get_ydata()
    assert ratio == pytest.approx(np.full(len(ratio), 2.0), rel=1e-6)


def test_report_of_a_run_has_its_pictures_and_says_what_is_missing(ground_run):
    page = write_report(ground_run).read_text()
    assert "0.50 of the predicted stability limit" in page
    assert sorted(path.stem for path in (ground_run / "report").glob("*.png")) == [
        "accelerations", "energies", "husid", "relative", "response_spectra", "spectra",
    ]
    assert "No two gauges with accelerations stand above each other" in page
    assert "The run wrote no snapshots." in page


def test_without_data_there_is_no_picture(tmp_path):
    (tmp_path / "manifest.json").write_text("{}")
    results = open_run(tmp_path)
    assert mps.measured(results) == []
    for draw in (shaking.accelerations, shaking.spectra, mps.displaced, mps.failure, mps.stresses, mps.supports):
        assert draw(results) is None


SPACING = 0.1


def heap(shape=(40, 10)):
    """Particles of a heap in the plane (n, 3), its lower left corner at the origin."""
    x, y = np.meshgrid(*(SPACING * (np.arange(count) + 0.5) for count in shape), indexing="ij")
    return np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)


@pytest.fixture
def slide(tmp_path):
    """A heap of 4 m by 1 m on a held layer, whose right half slides by 2 m and one of whose particles flies off by 50 m."""
    start = heap()
    moved = np.zeros_like(start)
    moved[start[:, 0] > 2.0, 0] = 2.0
    moved[-1] = (50.0, 20.0, 0.0)
    folder = tmp_path / "snapshots"
    folder.mkdir()
    for number, share in enumerate((0.0, 0.5, 1.0)):
        way = share * moved
        write_grid(folder / f"particles_{number:05d}.vtkhdf", start + way, np.arange(len(start))[:, None], 1, float(number), {
            "displacement": way, "velocity": way, "acceleration": way, "spacing": np.full(len(start), SPACING),
            "support": (start[:, 1] < SPACING).astype(np.int32), "plastic_shear_strain": np.linalg.norm(way, axis=1), "broken_fraction": np.zeros(len(start)),
        })
    (tmp_path / "history.csv").write_text(
        "time [s],energy_kinetic [J],energy_elastic [J],energy_work_gravity [J],energy_work_viscous [J],energy_plastic [J],energy_residual [J]\n"
        "0,0,0,0,0,0,0\n1,2,1,5,-1,1,0.04\n2,1,2,10,-2,5,0.08\n")
    manifest = {"method": "mps", "status": "done", "case": "slide", "results": {"peak_displacement": 54.0, "final_displacement": 54.0}}
    (tmp_path / "manifest.json").write_text(json.dumps(manifest))
    return open_run(tmp_path)


def test_the_run_out_is_that_of_the_front_and_not_of_a_single_particle():
    start = heap()
    end = start.copy()
    end[:, 0] += 1.5
    end[-1, 0] += 40.0
    far, words, height, before = mps.run_out(start, end, SPACING)
    assert words == "+x" and far == pytest.approx(1.5, abs=2 * SPACING)
    assert height == before == pytest.approx(1.0, abs=2 * SPACING)
    assert mps.run_out(start, start, SPACING) is None


def test_of_two_slopes_the_front_that_came_farther_counts():
    left, right = heap(), heap() + [10.0, 0.0, 0.0]
    start = np.concatenate([left, right])
    end = np.concatenate([left + [1.0, 0.0, 0.0], right - [2.0, 0.0, 0.0]])
    far, words, _, _ = mps.run_out(start, end, SPACING)
    assert words == "−x" and far == pytest.approx(2.0, abs=2 * SPACING)


def test_the_summary_tells_of_the_mass_and_of_the_largest_single_displacement(slide):
    text = terminal_text(slide)
    assert "final displacement     2 m  (99 % of the particles moved less; largest 53.9 m)" in text
    assert "run-out" in text and "height of the deposit" in text


def test_a_stray_particle_sets_neither_the_frame_nor_the_colors(slide):
    figure = mps.displaced(slide)
    assert all(axes.get_xlim()[1] < 8.0 for axes in figure.axes[:2])
    bar = figure.axes[-1]
    assert "clipped at the\n99th percentile" in bar.get_ylabel()
    assert figure.axes[0].collections[0].get_clim() == (0.0, pytest.approx(2.0))
    assert "clipped" in mps.failure(slide).axes[-2].get_ylabel()


def test_ground_on_a_moving_base_is_seen_from_there(slide):
    def moved(case):
        (slide.path / "case.toml").write_text(case)
        return open_run(slide.path)

    start = heap()
    ground, slip = np.array([5.0, 0.0, 0.0]), np.where((start[:, :1] > 2.0) & (start[:, 1:2] > 0.5), [[1.5, 0.0, 0.0]], 0.0)
    for number, share in enumerate((0.0, 0.5, 1.0)):
        way = share * (ground + slip)
        write_grid(slide.path / "snapshots" / f"particles_{number:05d}.vtkhdf", start + way, np.arange(len(start))[:, None], 1, float(number), {
            "displacement": way, "velocity": way, "spacing": np.full(len(start), SPACING), "plastic_shear_strain": np.zeros(len(start)), "broken_fraction": np.zeros(len(start)),
        })
    shaken = moved('[[boundaries]]\nside = "bottom"\nmotion_x = "quake"\n')
    figure = mps.displaced(shaken)
    values = np.asarray(figure.axes[-2].collections[0].get_array())
    assert figure.axes[-1].get_ylabel().startswith("displacement relative to the base [m]")
    assert values == pytest.approx(np.linalg.norm(slip, axis=1), abs=1e-6), "in m; what did not slide has the colour of 0"
    assert figure.axes[0].get_xlim()[1] < 6.5, "where the ground was, and how far it slid"
    final, out = mps.measured(shaken)[:2]
    assert final.value == "1.5 m" and "relative to the base" in final.note
    assert out.name == "run-out" and float(out.value.split()[0]) == pytest.approx(1.5, abs=2 * SPACING)
    assert mps.displaced(moved("")).axes[-1].get_ylabel().startswith("displacement [m]")


def test_a_row_beside_stiff_ground_does_not_set_the_colors_of_stress(slide):
    start = heap()
    stress = np.where(np.isclose(start[:, 1], 0.25), 4e6, 1e5 * (1.0 - start[:, 1]))
    write_grid(slide.path / "snapshots" / "particles_00002.vtkhdf", start, np.arange(len(start))[:, None], 1, 2.0, {
        "displacement": np.zeros_like(start), "spacing": np.full(len(start), SPACING), "equivalent_shear_strain": np.full(len(start), 1e-3),
        "von_mises_stress": stress, "pressure": 1e5 * (start[:, 1] - 0.4) * np.where(np.isclose(start[:, 1], 0.05), 50.0, 1.0),
    })
    for number in (0, 1):
        (slide.path / "snapshots" / f"particles_{number:05d}.vtkhdf").unlink()
    figure = mps.stresses(open_run(slide.path))
    _, mises, pressure = (axes.collections[0] for axes in figure.axes[:3])
    assert mises.get_clim()[0] == 0.0 and 90.0 < mises.get_clim()[1] < 300.0 and mises.colorbar.extend == "max"
    assert "largest 4 MPa" in figure.axes[4].get_ylabel()
    assert -200.0 < pressure.get_clim()[0] < -20.0 and pressure.colorbar.extend == "min"


def test_supports_are_marked_as_large_as_particles(slide):
    axes = mps.supports(slide).axes[0]
    assert [text.get_text() for text in axes.get_legend().get_texts()] == ["free: 360", "held: 40"]
    assert min(marks.get_sizes()[0] for marks in axes.collections) > 9.0


def test_the_energies_have_their_work_and_residual(slide):
    upper, lower = plot.energy(slide, mps.ENERGIES, mps.WORKS).axes
    work = next(line for line in upper.lines if line.get_label() == "external work")
    assert work.get_ydata().tolist() == [0.0, 4.0, 8.0]
    assert lower.lines[0].get_ydata()[1:] == pytest.approx([0.01, 0.01])


def test_stress_and_strain_are_those_of_the_snapshot_that_is_sheared_most(slide):
    assert mps.stresses(slide) is None, "its snapshots have no stress"
    start = heap()
    for number, sheared in enumerate((0.0, 2e-3, 1e-3)):
        field = np.full(len(start), sheared)
        write_grid(slide.path / "snapshots" / f"particles_{number:05d}.vtkhdf", start, np.arange(len(start))[:, None], 1, float(number), {
            "displacement": np.zeros_like(start), "spacing": np.full(len(start), SPACING), "equivalent_shear_strain": field,
            "von_mises_stress": 5e7 * field, "pressure": 1e3 * (1.0 - start[:, 1]),
        })
    figure = mps.stresses(open_run(slide.path))
    assert figure.get_suptitle() == "1 s"
    strain, stress, pressure = (np.asarray(axes.collections[0].get_array()) for axes in figure.axes[:3])
    assert strain == pytest.approx(np.full(len(start), 2e-3))
    assert stress == pytest.approx(np.full(len(start), 100.0)), "in kPa"
    assert pressure == pytest.approx(1e3 * (1.0 - start[:, 1]))
    bars = [axes.get_ylabel() for axes in figure.axes[3:]]
    assert bars[0].startswith("[-]") and bars[1].startswith("[kPa]") and bars[2].startswith("[Pa]")
