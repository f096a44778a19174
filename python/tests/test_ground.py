"""Pictures of runs of method mps and of studies, from small folders made here."""

import json

import numpy as np
import pytest

from sazare import ground, study
from sazare.report import write_report
from sazare.results import open_run


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


@pytest.fixture
def limit_study(tmp_path):
    """Limits that are exactly (14) to (16) with the paper's coefficients for S waves."""
    lines = ["case [-],family [-],spacing [m],velocity [m/s],damping [-],particles [-],predicted [s],stable [s],unstable [s],limit [s]"]
    fits = ["family [-],damping [-],a1 [-],a2 [-]"]
    first, second = study.PAPER["S"]
    for damping in (0.001, 0.01, 0.048, 0.1, 0.22):
        a1, a2 = (10.0 ** np.polyval(row, np.log10(damping)) for row in (first, second))
        fits.append(f"S,{damping},{a1},{a2}")
        for spacing in (0.5, 2.0):
            for velocity in (100.0, 400.0):
                limit = a1 * (0.5 * spacing / velocity) ** a2
                lines.append(f"{len(lines)},S,{spacing},{velocity},{damping},100,{limit},{limit},{limit},{limit}")
    (tmp_path / "study.csv").write_text("\n".join(lines) + "\n")
    (tmp_path / "regression_lines.csv").write_text("\n".join(fits) + "\n")
    (tmp_path / "regression.csv").write_text(
        "family [-],b11 [-],b12 [-],b13 [-],b21 [-],b22 [-],b23 [-],log_error [-]\nS," + ",".join(map(str, (*first, *second))) + ",0\n")
    manifest = {"method": "study", "status": "done", "case": "limits", "results": {"cases": 20, "cases_done": 20, "largest_log_difference": 0.0}}
    (tmp_path / "manifest.json").write_text(json.dumps(manifest))
    return tmp_path


def test_main_axis_is_that_of_the_strongest_motion(ground_run):
    results = open_run(ground_run)
    assert ground.main_axis(results) == 1
    assert ground.gauge_history(results, "surface", "acceleration")[:, 1].max() == pytest.approx(
        2.0 * ground.gauge_history(results, "base", "acceleration")[:, 1].max())


def test_spectral_ratio_is_that_of_the_gauges(ground_run):
    figure = ground.spectra(open_run(ground_run))
    ratio = figure.axes[1].lines[0].get_ydata()
    assert ratio == pytest.approx(np.full(len(ratio), 2.0), rel=1e-6)


def test_report_of_a_run_has_its_pictures_and_says_what_is_missing(ground_run):
    page = write_report(ground_run).read_text()
    assert "0.50 of the predicted limit" in page
    assert sorted(path.stem for path in (ground_run / "report").glob("*.png")) == ["accelerations", "energies", "spectra"]
    assert "The run wrote no snapshots." in page


def test_fit_of_a_study_is_as_good_as_it_is(limit_study):
    figure = study.fit_quality(open_run(limit_study))
    assert [axes.get_legend().get_texts()[0].get_text() for axes in figure.axes] == ["S: rms 0.000", "S: rms 0.000", "S: at most 0.00 %"]


def test_report_of_a_study_has_the_figures_of_the_paper(limit_study):
    page = write_report(limit_study).read_text()
    assert "Prediction and bisection differ by at most 0.00 %" in page
    names = sorted(path.stem for path in (limit_study / "report").glob("*.png"))
    assert names == ["coefficients", "damping", "quality", "radius", "scaled"]  # one family: nothing to compare


def test_without_data_there_is_no_picture(tmp_path):
    (tmp_path / "manifest.json").write_text("{}")
    results = open_run(tmp_path)
    for draw in (ground.accelerations, ground.spectra, ground.displaced, ground.energies, study.damping_curves, study.radius_curves,
                 study.scaled, study.families_compared, study.coefficients, study.fit_quality):
        assert draw(results) is None
