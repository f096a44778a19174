"""Report of studies of factors of safety, from a small folder made here."""

import json
import re

import numpy as np
import pytest

from sazare import key_units
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


@pytest.fixture
def unbracketed(factor_study):
    """The two cases, one that fails with every factor and one that stands with every one."""
    with (factor_study / "study.csv").open("a") as file:
        file.write("2,mud,1000.0,4.0,0,0.5,nan,1.0,0,0.008,1.5\n3,rock,1e6,4.0,4,inf,-nan,2.0,0.0081,0.008,1.5\n")
    heads = "trial [-],factor [-],stands [-],displacement [m],seconds [s],end [-]\n"
    (factor_study / "trials/00002.csv").write_text(f'{heads}1,0.5,0,0.001,0.1,"no equilibrium"\n')
    (factor_study / "trials/00003.csv").write_text(f'{heads}1,0.5,1,0.008,0.1,"at rest"\n2,4.0,1,0.0081,0.1,"at rest"\n')
    slip = (factor_study / "trials/00000_slip.csv").read_text()
    (factor_study / "trials/00002_slip.csv").write_text(slip)
    (factor_study / "trials/00003_slip.csv").write_text(slip.splitlines()[0] + "\n")
    return factor_study


def rows_of(page):
    """The cells of the table of factors, a list for each case."""
    table = page[page.index("<h2>Factors of safety") :]
    return [re.findall("<td>(.*?)</td>", row) for row in re.findall("<tr>(.*?)</tr>", table[: table.index("</table>")], re.DOTALL)][1:]


def test_report_has_the_factors_and_their_pictures(factor_study):
    page = write_report(factor_study).read_text()
    assert f"The smallest factor of safety is {1.375:.3g} (case 0, slope, cohesion = 10 kPa)." in page
    assert [row[2:4] for row in rows_of(page)] == [["10 kPa", "1.375"], ["12 kPa", "1.630"]]
    assert sorted(path.stem for path in (factor_study / "report").glob("*.png")) == ["displacements", "slip"]


def test_a_study_has_neither_a_state_nor_a_case_file(factor_study):
    manifest = json.loads((factor_study / "manifest.json").read_text())
    (factor_study / "manifest.json").write_text(json.dumps({**manifest, "state_hash": "0000000000000000", "sazare": "0.1.0"}))
    page = write_report(factor_study).read_text()
    assert "<td>0.1.0 (unknown)</td>" in page
    assert "state hash" not in page and "no case file" not in page
    assert compare(factor_study, factor_study).same_bits is None


def curves_and_failed(axes):
    """Abscissas of the curves of trials that stood, and of those that failed, with their heights over that of the axes."""
    trials = [line for line in axes.lines if line.get_marker() == "o" and len(line.get_xdata())]
    curves = [list(line.get_xdata()) for line in trials if line.get_linestyle() == "-"]
    failed = [(list(line.get_xdata()), set(line.get_ydata())) for line in trials if line.get_fillstyle() == "none"]
    return curves, failed


def test_trials_that_failed_are_open_circles_at_the_upper_edge(factor_study):
    figure = study_factors.displacements(open_run(factor_study))
    axes = figure.axes[0]
    curves, failed = curves_and_failed(axes)
    assert curves == [[1.0, 1.37], [1.0, 1.62]] and [factors for factors, _ in failed] == [pytest.approx([1.38, 2.0]), pytest.approx([1.63, 2.0])]
    heights = [height for _, row in failed for height in row]
    assert len(set(heights)) == 2 and all(0.9 < height < 1.0 for height in heights)
    highest = axes.transAxes.inverted().transform(axes.transData.transform((1.0, 0.0119)))[1]
    assert highest < min(heights), "the curves end below the circles"
    assert [text.get_text() for text in figure.legends[0].get_texts()][-1] == "fails"


def test_parameters_have_their_units(factor_study):
    legend = [text.get_text() for text in study_factors.displacements(open_run(factor_study)).legends[0].get_texts()]
    assert legend[:2] == [f"case 0, slope, cohesion = 10 kPa: F = {1.375:.3g}", "case 1, dam, cohesion = 12 kPa: F = 1.63"]
    titles = [axes.get_title(loc="left") for axes in study_factors.slip_surfaces(open_run(factor_study)).axes if axes.get_xlabel() == "x [m]"]
    assert titles == legend[:2]


@pytest.mark.parametrize(("head", "words"), [
    ("cohesion [-]", "cohesion = 10 kPa"), ("materials.0.cohesion [-]", "materials.0.cohesion = 10 kPa"), ("youngs modulus", "youngs modulus = 10 kPa"),
    ("friction angle [-]", "friction angle = 10000 deg"), ("poisson_ratio [-]", "poisson_ratio = 10000"), ("depth [m]", "depth = 10000 m"),
    ("how strong [-]", "how strong = 10000"), ("0 [-]", "0 = 10000"),
])
def test_units_that_a_study_does_not_give_are_those_of_the_keys(factor_study, head, words):
    table = factor_study / "study.csv"
    table.write_text(table.read_text().replace("cohesion [Pa]", head))
    legend = study_factors.displacements(open_run(factor_study)).legends[0].get_texts()
    assert legend[0].get_text() == f"case 0, slope, {words}: F = {1.375:.3g}"


def test_without_the_engine_keys_have_no_units(monkeypatch):
    def missing():
        raise ImportError("not built")

    assert key_units.unit_of_key("cohesion") == "Pa"
    monkeypatch.setattr(key_units, "engine", missing)
    key_units._units.cache_clear()
    try:
        assert key_units.unit_of_key("cohesion") == ""
    finally:
        key_units._units.cache_clear()


def test_numbers_of_a_study_may_be_infinite_or_none(unbracketed):
    table = open_run(unbracketed).study
    assert table["upper"].tolist() == [1.38, 1.64, 0.5, np.inf]
    assert np.isnan(table["factor"]).tolist() == [False, False, True, True]


def test_factors_beyond_the_bounds_are_told_in_words(unbracketed):
    page = write_report(unbracketed).read_text()
    rows = rows_of(page)
    assert [row[3:7] for row in rows[2:]] == [["below 0.5", "-", "0.5000", "-"], ["above 4", "4.000", "-", "8.1 mm"]]
    told = "The bounds of the search do not bracket the factors of 2 of 4 cases "
    assert f"{told}(case 2, mud, cohesion = 1 kPa: below 0.5; case 3, rock, cohesion = 1 MPa: above 4)." in page
    assert "nan" not in page.split("base64")[0] and not any("nan" in cell or "inf" in cell for row in rows for cell in row)


def test_factors_beyond_the_bounds_have_no_curve(unbracketed):
    results = open_run(unbracketed)
    figure = study_factors.displacements(results)
    assert curves_and_failed(figure.axes[0])[0] == [[1.0, 1.37], [1.0, 1.62]]
    assert not any(word in text.get_text() for text in figure.legends[0].get_texts() for word in ("mud", "rock"))
    titles = [axes.get_title(loc="left") for axes in study_factors.slip_surfaces(results).axes if axes.get_xlabel() == "x [m]"]
    assert titles[2:] == ["case 2, mud, cohesion = 1 kPa: F below 0.5"], "it failed, and shows where; the rock never did"


@pytest.mark.parametrize(("kept", "tone", "sentence"), [
    ([0, 1, 2, 3], "bad", "is below 0.5 (case 2, mud, cohesion = 1 kPa): this ground does not stand with the strength of its case."),
    ([0, 1, 3], "good", f"is {1.375:.3g} (case 0, slope, cohesion = 10 kPa)."), ([3], "good", "is above 4 (case 3, rock, cohesion = 1 MPa)."),
])
def test_the_smallest_factor_may_lie_beyond_the_bounds(unbracketed, kept, tone, sentence):
    head, *rows = (unbracketed / "study.csv").read_text().splitlines()
    (unbracketed / "study.csv").write_text("\n".join([head, *(rows[i] for i in kept)]) + "\n")
    found, words = study_factors.verdict(open_run(unbracketed))
    assert found == tone and words.startswith(f"The smallest factor of safety {sentence}")


def test_a_study_without_a_bracketed_factor_has_no_curves(unbracketed):
    head, *rows = (unbracketed / "study.csv").read_text().splitlines()
    (unbracketed / "study.csv").write_text("\n".join([head, *rows[2:]]) + "\n")
    page = write_report(unbracketed).read_text()
    assert sorted(path.stem for path in (unbracketed / "report").glob("*.png")) == ["slip"]
    assert "Displacement against the factor: The bounds of the search do not bracket the factors of 2 of 2 cases" in page


def test_of_many_cases_beyond_the_bounds_the_first_are_named(unbracketed):
    with (unbracketed / "study.csv").open("a") as file:
        file.writelines(f"{number},rock,{number}e6,4.0,4,inf,-nan,2.0,0.0081,0.008,1.5\n" for number in range(4, 10))
    words = study_factors.verdict(open_run(unbracketed))[1]
    assert "8 of 10 cases (case 2, mud" in words and "; case 7, rock, cohesion = 7 MPa: above 4; and 2 more, see the table)." in words


def test_a_body_in_space_is_seen_from_the_front(factor_study):
    labels = [axes.get_ylabel() for axes in study_factors.slip_surfaces(open_run(factor_study)).axes if axes.get_xlabel() == "x [m]"]
    assert labels == ["y [m]", "z [m]"]


def test_ground_that_does_not_stand_by_itself_is_told(factor_study):
    table = factor_study / "study.csv"
    table.write_text(table.read_text().replace("1.37,1.38,1.375", "0.926,0.935,0.93"))
    assert study_factors.verdict(open_run(factor_study))[0] == "bad"


def test_without_data_there_is_no_picture(tmp_path):
    (tmp_path / "manifest.json").write_text('{"method": "study"}')
    results = open_run(tmp_path)
    assert study_factors.displacements(results) is None and study_factors.slip_surfaces(results) is None
    assert study_factors.sheets(results) == []
