"""Motion at the gauges of a run: records, profiles, what remains, and the table beside the report."""

import json
import tomllib
from pathlib import Path

import numpy as np
import pytest

import sazare
import sazare.ground_motion as ground_motion
from sazare import shaking
from sazare.ground_motion.gauges import AXES, base_of, gauge_motions, gauge_table, residual, stacks, tilt, up_axis
from sazare.report import write_report
from sazare.tables import read_table, write_table

PAGE = Path(__file__).resolve().parents[2] / "docs/reference/run-folder.md"
GAUGES = {"crest": (0.0, 10.0, 0.0), "base": (0.0, 0.0, 0.0), "aside": (30.0, 5.0, 0.0)}
SLIP = 0.5  # m, of the crest


def smooth(time, begin, end):
    """From 0 to 1 between two times, with its first and second derivative."""
    s = np.clip((time - begin) / (end - begin), 0.0, 1.0)
    length = end - begin
    return 10 * s**3 - 15 * s**4 + 6 * s**5, (30 * s**2 - 60 * s**3 + 30 * s**4) / length, (60 * s - 180 * s**2 + 120 * s**3) / length**2


@pytest.fixture
def shaken(tmp_path):
    """A run of three gauges: the ground shakes along x, and the crest slips against it for good. A function of the case and its gauges."""

    def made(case=None, gauges=GAUGES):
        time = np.linspace(0.0, 8.0, 1601)
        shape, speed, change = smooth(time, 3.0, 4.0)
        window = np.where(time < 4.0, np.sin(np.pi * time / 4.0) ** 4, 0.0)
        ground = 0.02 * window * np.sin(4.0 * np.pi * time)
        columns = {"time [s]": time}
        for name in gauges:
            own = SLIP if name == "crest" else 0.0
            moves = {"displacement": ground + own * shape, "velocity": np.gradient(ground, time) + own * speed,
                     "acceleration": np.gradient(np.gradient(ground, time), time) + own * change}
            for quantity, unit in (("displacement", "m"), ("velocity", "m/s"), ("acceleration", "m/s2")):
                columns |= {f"{name}.{quantity}_{axis} [{unit}]": moves[quantity] if axis == "x" else 0.0 * time for axis in AXES}
        write_table(tmp_path / "gauges.csv", columns)
        points = "".join(f'[[gauges]]\nname = "{name}"\npoint = {list(point)}\n' for name, point in gauges.items())
        (tmp_path / "case.toml").write_text(f'[case]\nmethod = "mps"\n{points}' if case is None else case)
        (tmp_path / "manifest.json").write_text(json.dumps({"method": "mps", "status": "done", "results": {}}))
        return sazare.open(tmp_path)

    return made


def test_the_lowest_gauge_is_the_base_and_those_above_it_are_a_stack(shaken):
    results = shaken()
    motions = gauge_motions(results)
    assert up_axis(results, motions) == 1 and base_of(results, motions).name == "base"
    assert [[motion.name for motion in stack] for stack in stacks(results, motions)] == [["base", "crest"]]


def test_without_positions_the_first_gauge_is_the_base_and_nothing_is_stacked(shaken):
    results = shaken(case='[case]\nmethod = "mps"\n')
    motions = gauge_motions(results)
    assert base_of(results, motions).name == "crest" and stacks(results, motions) == []
    assert shaking.profiles(results) is None
    assert shaking.response_spectra(results) is not None


@pytest.mark.parametrize("case", ["gauges = 3", "[[gauges]]\nname = 1\npoint = [1]", "[gravity]\nacceleration = 1", "not toml ["])
def test_a_case_of_other_kinds_of_values_does_no_harm(shaken, case):
    assert len(gauge_table(shaken(case=case))["gauge"]) == 3


def test_upwards_is_against_gravity_or_along_z_in_space(shaken):
    results = shaken(case="[gravity]\nacceleration = [0.0, 0.0, -9.81]\n")
    assert up_axis(results, gauge_motions(results)) == 2
    results = shaken(gauges={"base": (0.0, 0.0, 0.0), "crest": (0.0, 0.0, 7.0)})
    assert up_axis(results, gauge_motions(results)) == 2


def test_what_remains_is_the_slip_and_turns_the_line_from_the_base(shaken):
    results = shaken()
    crest, base, aside = gauge_motions(results)
    assert residual(crest, base) == pytest.approx([SLIP, 0.0, 0.0], abs=1e-9)
    assert tilt(crest, base) == pytest.approx(np.arctan(SLIP / 10.0))
    assert residual(aside, base) is None and tilt(base, base) is None, "these two never moved against each other"
    moving = ground_motion.gauges.GaugeMotion("m", None, crest.time, crest.displacement, crest.velocity + np.sin(crest.time)[:, None], crest.acceleration)
    assert residual(moving, base) is None


def test_the_table_has_the_figures_of_every_gauge_and_its_columns_are_documented(shaken):
    results = shaken()
    table = gauge_table(results)
    assert list(table["gauge"]) == ["crest", "base", "aside"] and set(table["axis"]) == {"x"}, "along y and z nothing moves"
    crest = gauge_motions(results)[0]
    figures = ground_motion.figures(crest.record(0))
    assert table["arias_intensity [m/s]"][0] == pytest.approx(figures["arias_intensity"])
    assert table["peak_acceleration_gal [gal]"][0] == pytest.approx(100.0 * np.abs(crest.acceleration[:, 0]).max())
    assert table["peak_relative_displacement [m]"][0] == pytest.approx(SLIP) and table["residual_displacement [m]"][0] == pytest.approx(SLIP)
    page = PAGE.read_text(encoding="utf-8").split("## ground_motion.csv")[1].split("\n## ")[0]
    for column in table:
        name, _, unit = column.partition(" [")
        assert f"| `{name}` | {unit.rstrip(']') if unit else ''} |".replace("|  |", "| |") in page, column


def test_the_report_writes_the_table_and_the_pictures_of_the_motion(shaken):
    results = shaken()
    page = write_report(results.path).read_text()
    assert {"response_spectra", "husid", "profiles", "relative"} <= {path.stem for path in (results.path / "report").glob("*.png")}
    assert "in m/s² and gal" in page
    table = read_table(results.path / "ground_motion.csv")
    assert list(table["gauge"]) == ["crest", "base", "aside"] and table.unit("peak_acceleration_gal") == "gal"


def test_a_link_in_the_place_of_the_table_is_not_followed(shaken, tmp_path):
    results = shaken()
    (results.path / "ground_motion.csv").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(sazare.NotARun, match="a link"):
        write_report(results.path)
    assert not (tmp_path / "elsewhere").exists()


def test_ratios_and_peaks_in_the_pictures_are_those_of_the_gauges(shaken):
    results = shaken(gauges={"base": (0.0, 0.0, 0.0), "top": (0.0, 10.0, 0.0)})
    ratio = shaking.response_spectra(results).axes[1].lines[0].get_ydata()
    assert ratio == pytest.approx(np.ones(len(ratio)), rel=1e-9)
    results = shaken()
    panels = shaking.profiles(results).axes
    crest = gauge_motions(results)[0]
    assert panels[2].lines[0].get_xdata()[1] == pytest.approx(np.abs(crest.displacement[:, 0]).max())
    assert list(panels[0].lines[0].get_ydata()) == [0.0, 10.0]
    legend = [text.get_text() for text in shaking.relative_displacements(results).axes[0].get_legend().get_texts()]
    assert legend == ["crest: 500 mm remain, turned by 50 mrad", "aside: not at rest at the end"]


def column_of(count):
    """Gauges above each other, in a case from the surface down."""
    return {f"g{number}": (0.0, float(number), 0.0) for number in reversed(range(count))}


def looks_of(axes):
    return [(line.get_label(), line.get_color(), line.get_linestyle(), str(line._dash_pattern)) for line in axes.get_lines()]


def test_twelve_gauges_have_spectra_that_can_be_told_apart(shaken, monkeypatch):
    monkeypatch.setattr(shaking, "usual_periods", lambda *_: np.array([0.2, 0.5, 1.0]))
    figure = shaking.response_spectra(shaken(gauges=column_of(12)))
    looks = looks_of(figure.axes[0])
    assert [label for label, *_ in looks] == [f"g{number}" for number in range(12)], "from below"
    assert len({look[1:] for look in looks}) == 12
    assert [look[1:] for look in looks_of(figure.axes[1])] == [look[1:] for look in looks[1:]], "the ratios look as the spectra"
    assert figure.get_supxlabel() == ""


def test_of_many_gauges_the_lowest_and_the_highest_are_drawn_and_the_others_named(shaken):
    results = shaken(gauges=column_of(24))
    for draw, most, source in ((shaking.husid_curves, 18, "ground_motion.csv for"), (shaking.relative_displacements, 18, "gauges.csv"), (shaking.accelerations, 12, "gauges.csv")):
        figure = draw(results)
        lines = [line for axes in figure.axes for line in axes.get_lines() if len(line.get_xdata()) > 1]
        names = [line.get_label().split(":")[0] for line in lines] if draw is not shaking.accelerations else [axes.get_title(loc="left").split(":")[0] for axes in figure.axes][::-1]
        first = "g1" if draw is shaking.relative_displacements else "g0"
        assert (names[0], names[-1], len(names)) == (first, "g23", most)
        left_out = {f"g{number}" for number in range(24)} - set(names) - ({"g0"} if first == "g1" else set())
        assert figure.get_supxlabel().startswith(f"{len(left_out)} more, ") and f": see {source}" in figure.get_supxlabel()
        assert set(figure.get_supxlabel().split(": see")[0].replace(" and", ",").split(", ")[1:9]) <= left_out


def test_the_words_below_response_spectra_lead_to_spectra(shaken, monkeypatch):
    monkeypatch.setattr(shaking.curve_styles, "spread", lambda names, most=2: [names[0], names[-1]])
    monkeypatch.setattr(shaking, "usual_periods", lambda *_: np.array([0.2, 0.5, 1.0]))
    results = shaken(gauges=column_of(3))
    words = shaking.response_spectra(results).get_supxlabel()
    assert words == "1 more, g1: see gauges.csv, from which sazare.ground_motion.response_spectrum in Python finds their spectra"
    assert ground_motion.response_spectrum(gauge_motions(results)[1].record(0), [0.5]).pseudo_acceleration[0] > 0.0


def test_fourier_spectra_are_those_of_the_lowest_and_the_highest_gauge(shaken):
    figure = shaking.spectra(shaken(gauges=column_of(3)))
    assert [line.get_label() for line in figure.axes[0].get_lines()] == ["g0", "g2"]
    assert figure.axes[1].get_ylabel() == "spectral ratio g2 / g0 [-]"


def test_few_rows_or_unequal_steps_give_no_motion(shaken, tmp_path):
    results = shaken()
    lines = (tmp_path / "gauges.csv").read_text().splitlines()
    for kept in (lines[:10], lines[:20] + lines[40:60]):
        (tmp_path / "gauges.csv").write_text("\n".join(kept) + "\n")
        results = sazare.open(tmp_path)
        assert gauge_motions(results) == [] and gauge_table(results) == {}
        for draw in (shaking.response_spectra, shaking.husid_curves, shaking.profiles, shaking.relative_displacements):
            assert draw(results) is None


def test_the_resolved_case_of_a_run_tells_where_its_gauges_are(tmp_path):
    case = Path(__file__).resolve().parents[2] / "cases/column-ricker/case.toml"
    results = sazare.run(case, tmp_path / "run", progress=False, overrides={"time.end": 0.1, "time.snapshot_interval": 0.1})
    motions = gauge_motions(results)
    given = {gauge["name"]: gauge["point"] for gauge in tomllib.loads(case.read_text())["gauges"]}
    assert {motion.name: list(motion.point) for motion in motions} == given
    assert base_of(results, motions).name == "GL -100 m" and len(stacks(results, motions)[0]) == 5
