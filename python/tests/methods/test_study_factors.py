"""Report of studies of factors of safety, from a small folder made here."""

import json

import numpy as np
import pytest

from sazare.comparison import compare
from sazare.methods import study_factors
from sazare.report import write_report
from sazare.results import open_run


@pytest.fixture
def factor_study(tmp_path):
    """Two cases: one of particles in the plane, one in space."""
    (tmp_path / "study.csv").write_text(
        "case [-],family [-],cohesion [Pa],bodies [-],lower [-],upper [-],factor [-],trials [-],displacement [m],elastic [m],seconds [s]\n"
        "0,slope,10000.0,4.0,1.37,1.38,1.375,4.0,0.012,0.008,1.5\n1,dam,12000.0,4.0,1.62,1.64,1.63,4.0,0.013,0.008,1.5\n")
    trials = tmp_path / "trials"
    trials.mkdir()
    for case, factor in enumerate((1.37, 1.62)):
        (trials / f"{case:05}.csv").write_text(
            "trial [-],factor [-],stands [-],displacement [m],seconds [s],end [-]\n"
            f'1,1.0,1,0.008,0.1,"at rest, moved by 0.008 m"\n2,2.0,0,0.5,0.1,"the ground has moved by 0.5 m, more than 0.012 m"\n'
            f'3,{factor},1,0.0119,0.1,"at rest, moved by 0.0119 m"\n4,{factor + 0.01},0,0.0121,0.1,"runs away, moved by 0.0121 m"\n')
        x, y = np.meshgrid(np.arange(4.0), np.arange(3.0))
        rows = [f"{a},{b if case == 0 else 0.0},{0.0 if case == 0 else b},0.0,0.0,0.0,{0.01 * a}" for a, b in zip(x.ravel(), y.ravel())]
        (trials / f"{case:05}_slip.csv").write_text(
            "x [m],y [m],z [m],displacement_x [m],displacement_y [m],displacement_z [m],slip [-]\n" + "\n".join(rows) + "\n")
    manifest = {"method": "study", "status": "done", "case": "slopes",
                "results": {"cases": 2, "cases_done": 2, "smallest_factor": 1.375, "largest_factor": 1.63}}
    (tmp_path / "manifest.json").write_text(json.dumps(manifest))
    return tmp_path


def test_report_has_the_factors_and_their_pictures(factor_study):
    page = write_report(factor_study).read_text()
    assert f"The smallest factor of safety is {1.375:.3g}." in page
    assert "1.63" in page and "12000" in page
    assert sorted(path.stem for path in (factor_study / "report").glob("*.png")) == ["displacements", "slip"]


def test_a_study_has_neither_a_state_nor_a_case_file(factor_study):
    manifest = json.loads((factor_study / "manifest.json").read_text())
    (factor_study / "manifest.json").write_text(json.dumps({**manifest, "state_hash": "0000000000000000", "sazare": "0.1.0"}))
    page = write_report(factor_study).read_text()
    assert "<td>0.1.0 (unknown)</td>" in page
    assert "state hash" not in page and "no case file" not in page
    assert compare(factor_study, factor_study).same_bits is None


def test_trials_that_failed_are_crosses(factor_study):
    axes = study_factors.displacements(open_run(factor_study)).axes[0]
    drawn = [line for line in axes.lines if len(line.get_xdata()) == 2 and line.get_marker() in ("o", "x")]
    assert [line.get_marker() for line in drawn] == ["o", "x", "o", "x"]
    assert drawn[0].get_xdata() == pytest.approx([1.0, 1.37]) and drawn[1].get_xdata() == pytest.approx([1.38, 2.0])


def test_a_body_in_space_is_seen_from_the_front(factor_study):
    labels = [axes.get_ylabel() for axes in study_factors.slip_surfaces(open_run(factor_study)).axes if axes.get_xlabel() == "x [m]"]
    assert labels == ["y [m]", "z [m]"]


def test_ground_that_does_not_stand_by_itself_is_told(factor_study):
    manifest = json.loads((factor_study / "manifest.json").read_text())
    manifest["results"]["smallest_factor"] = 0.93
    (factor_study / "manifest.json").write_text(json.dumps(manifest))
    assert study_factors.verdict(open_run(factor_study))[0] == "bad"


def test_without_data_there_is_no_picture(tmp_path):
    (tmp_path / "manifest.json").write_text('{"method": "study"}')
    results = open_run(tmp_path)
    assert study_factors.displacements(results) is None and study_factors.slip_surfaces(results) is None
    assert study_factors.sheets(results) == []
