"""Pictures of runs of method mps, from small folders made here."""

import json

import numpy as np
import pytest

from sazare import shaking
from sazare.methods import mps
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


def test_main_axis_is_that_of_the_strongest_motion(ground_run):
    results = open_run(ground_run)
    assert shaking.main_axis(results) == 1
    assert shaking.gauge_history(results, "surface", "acceleration")[:, 1].max() == pytest.approx(
        2.0 * shaking.gauge_history(results, "base", "acceleration")[:, 1].max())


def test_spectral_ratio_is_that_of_the_gauges(ground_run):
    figure = shaking.spectra(open_run(ground_run))
    ratio = figure.axes[1].lines[0].get_ydata()
    assert ratio == pytest.approx(np.full(len(ratio), 2.0), rel=1e-6)


def test_report_of_a_run_has_its_pictures_and_says_what_is_missing(ground_run):
    page = write_report(ground_run).read_text()
    assert "0.50 of the predicted stability limit" in page
    assert sorted(path.stem for path in (ground_run / "report").glob("*.png")) == ["accelerations", "energies", "spectra"]
    assert "The run wrote no snapshots." in page


def test_without_data_there_is_no_picture(tmp_path):
    (tmp_path / "manifest.json").write_text("{}")
    results = open_run(tmp_path)
    for draw in (shaking.accelerations, shaking.spectra, mps.displaced, mps.failure, mps.energies):
        assert draw(results) is None
