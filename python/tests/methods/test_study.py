"""Pictures of studies of limit steps, from a small folder made here."""

import json

import numpy as np
import pytest

from sazare.methods import study
from sazare.report import write_report
from sazare.results import open_run


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
    for draw in (study.damping_curves, study.radius_curves, study.scaled, study.families_compared, study.coefficients, study.fit_quality):
        assert draw(results) is None
