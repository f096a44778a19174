"""The report, the pictures and the summary."""

import json
import re
import shutil
import sys
import warnings
from dataclasses import replace

import numpy as np
import pytest
import pyvista
from matplotlib.image import imread

import sazare
from sazare import plot, report, style
from sazare.__main__ import main
from sazare.methods import blocks_curves
from sazare.methods.common import energy_balance
from sazare.report import write_report
from sazare.scenes import MARGIN, PlaneView
from sazare.style import count, quantity
from sazare.summary import terminal_text, verdict

PICTURES = {
    "cracks", "shape", "stress", "levels", "fragments", "energy", "broken_joints", "fragment_curve", "gauges", "smallest_step", "timing",
}


@pytest.fixture(scope="module")
def reported(slab, tmp_path_factory):
    """A copy of the slab's run with its report, and the page."""
    copy = shutil.copytree(slab, tmp_path_factory.mktemp("report") / "run")
    return copy, write_report(copy).read_text()


def has_color(image, color, tolerance=0.16):
    """Whether some pixels of an image are near a colour."""
    return np.sum(np.linalg.norm(image[..., :3] - np.array(color), axis=-1) < tolerance) > 50


def test_the_report_holds_every_picture(reported):
    folder, page = reported
    assert {path.stem for path in (folder / "report").iterdir()} == PICTURES
    assert page.count("data:image/png;base64,") == len(PICTURES)
    assert not re.search(r'(src|href)="(?!data:)', page), "the page must hold all it shows"


def test_the_pictures_show_something(reported):
    folder, _ = reported
    cracks = imread(folder / "report" / "cracks.png")
    assert has_color(cracks, (0.233, 0.06, 0.17)) and has_color(cracks, (0.94, 0.54, 0.11)), "early and late cracks"
    assert has_color(imread(folder / "report" / "levels.png"), (0.03, 0.11, 0.35)), "the finest level"
    for path in (folder / "report").iterdir():
        assert imread(path)[..., :3].std() > 0.02, path.name


def test_the_page_has_title_verdict_figures_and_case(reported):
    _, page = reported
    for words in (
        "<h1>A synthetic blast</h1>", 'class="verdict good"', "The energy residual is 3.0e-05 of the work.",
        "2.16 mm", "P20 60 mm, P80 210 mm", "state hash", "0123456789abcdef", "method = &#34;blocks&#34;", "Largest fragments", "<td>G2</td>",
    ):
        assert words in page


def test_a_solid_is_shown_from_a_corner_and_in_a_cut(solid, tmp_path):
    copy = shutil.copytree(solid, tmp_path / "run")
    write_report(copy)
    assert {path.stem for path in (copy / "report").iterdir()} == PICTURES | {"slices"}


def test_a_run_with_nothing_but_its_manifest_is_reported(tmp_path):
    (tmp_path / "manifest.json").write_text(json.dumps({"case": "Bare", "status": "failed", "results": {}}))
    page = write_report(tmp_path).read_text()
    for words in (
        "ended early with status “failed”", "The run wrote no snapshots.", "The case has no gauges.", "The run wrote no fragments.",
        "The run wrote no energies.", "The run wrote no timing.", "The run has no case file.", 'class="verdict bad"',
    ):
        assert words in page


def test_a_run_without_joints_or_breaks_is_reported(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run")
    for path in (copy / "snapshots").glob("joints*"):
        path.unlink()
    assert "The run wrote no joints." in write_report(copy).read_text()


def test_a_run_cut_off_at_its_first_snapshot_is_reported(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run")
    for path in (copy / "snapshots").glob("*_0000[1-5].vtkhdf"):
        path.unlink()
    (copy / "manifest.json").unlink()
    assert "The run has not written its manifest" in write_report(copy).read_text()


@pytest.mark.parametrize("name", ["report", "report.html"])
def test_nothing_is_written_through_a_link(tmp_path, name):
    run, outside = tmp_path / "run", tmp_path / "outside"
    run.mkdir()
    outside.mkdir()
    (run / "manifest.json").write_text("{}")
    (outside / "kept.png").write_text("a picture of someone's own")
    (run / name).symlink_to(outside if name == "report" else outside / "kept.png")
    with pytest.raises(sazare.NotARun, match="a link; results are written into their own folder"):
        write_report(run)
    assert (outside / "kept.png").read_text() == "a picture of someone's own"


@pytest.mark.parametrize("command, name", [(["movie"], "movie.gif"), (["plot", "energy", "--out"], "energy.png")])
def test_movies_and_pictures_are_not_written_through_a_link(slab, tmp_path, command, name, capsys):
    copy = shutil.copytree(slab, tmp_path / "run")
    (tmp_path / "kept").write_text("someone's own")
    (copy / name).symlink_to(tmp_path / "kept")
    words = [command[0], str(copy), *command[1:], *([str(copy)] if "--out" in command else [])]
    assert main(words) == 2
    assert f"{name}: a link" in capsys.readouterr().err
    assert (tmp_path / "kept").read_text() == "someone's own"


def test_old_pictures_do_not_stay(reported):
    folder, _ = reported
    (folder / "report" / "old.png").write_bytes(b"")
    write_report(folder)
    assert not (folder / "report" / "old.png").exists()


def test_the_size_distribution_passes_through_p50(slab):
    run = sazare.open(slab)
    sizes, share = plot.passing(run.fragments["size"], run.fragments["volume"])
    curve = plot.fragment_curve(run).axes[0].lines[0]
    x, y = curve.get_xdata(), curve.get_ydata()
    half = np.interp(0.5, share, sizes)
    assert np.interp(half, x, y) == pytest.approx(50.0, abs=0.1)
    assert x[0] == sizes[0] and y[-1] == pytest.approx(100.0)


def test_steps_are_told_in_words_at_their_axis(slab):
    axes = blocks_curves.smallest_step(sazare.open(slab)).axes[0]
    assert [label.get_text() for label in axes.get_yticklabels()] == ["62.5 ns", "125 ns", "250 ns", "500 ns"]


def test_passing_shares_are_of_the_volume():
    sizes, share = plot.passing(np.array([3.0, 1.0, 2.0]), np.array([6.0, 1.0, 3.0]))
    assert sizes.tolist() == [1.0, 2.0, 3.0]
    assert share == pytest.approx([0.1, 0.4, 1.0])


@pytest.mark.parametrize(
    "value, unit, words",
    [(2.16e-3, "m", "2.16 mm"), (49663.0, "J", "49.7 kJ"), (0.0, "m", "0 m"), (None, "m", "not known"), (1000.0, "m/s", "1 km/s")],
)
def test_quantities_in_words(value, unit, words):
    assert quantity(value, unit) == words


def test_counts_in_words():
    assert count(1234567) == "1\u202f234\u202f567"


@pytest.mark.parametrize("residual, tone", [(1.0, "good"), (-500.0, "fair"), (5000.0, "bad")])
def test_the_verdict_follows_the_energy_balance(tmp_path, residual, tone):
    manifest = {"status": "done", "results": {"energy_work": 1e5, "energy_residual": residual}}
    (tmp_path / "manifest.json").write_text(json.dumps(manifest))
    run = sazare.open(tmp_path)
    assert energy_balance(run.figures) == pytest.approx(abs(residual) / 1e5)
    assert verdict(run)[0] == tone


def test_figures_that_are_not_numbers_are_left_out(tmp_path):
    manifest = {"case": "Odd", "status": "running", "results": {"energy_work": None, "energy_residual": None, "broken_joints": 3}}
    (tmp_path / "manifest.json").write_text(json.dumps(manifest))
    text = terminal_text(sazare.open(tmp_path))
    assert text.splitlines()[0] == "Odd: The run is still running or was interrupted. The results below are partial."
    assert text.splitlines()[1:] == ["  broken joints  3"]


def test_the_summary_names_the_headline_figures(slab):
    text = terminal_text(sazare.open(slab))
    for words in ("broken joints", "fragments", "energy balance", "3.0e-05", "wall-clock time"):
        assert words in text


def test_the_command_says_where_the_report_is(slab, tmp_path, capsys):
    copy = shutil.copytree(slab, tmp_path / "run")
    assert main(["report", str(copy)]) == 0
    assert main(["summary", str(copy)]) == 0
    printed = capsys.readouterr().out
    assert printed.count(str(copy / "report.html")) == 2


def test_the_command_refuses_what_is_no_run(tmp_path, capsys):
    assert main(["report", str(tmp_path)]) == 2
    assert "not the folder of a run" in capsys.readouterr().err


def test_plot_writes_the_pictures_that_are_named(slab, tmp_path, capsys):
    assert main(["plot", str(slab), "energy", "gauges", "--out", str(tmp_path / "pictures")]) == 0
    assert {path.name for path in (tmp_path / "pictures").iterdir()} == {"energy.png", "gauges.png"}
    assert main(["plot", str(slab)]) == 0
    listed = {line.split()[0] for line in capsys.readouterr().out.splitlines()[2:]}
    assert listed == PICTURES


def test_plot_keeps_long_names_apart_from_their_words(slab, capsys, monkeypatch):
    section = report.sections_of(report.open_run(slab))[0]
    monkeypatch.setattr(report, "sections_of", lambda _: [replace(section, name="a" * 16), replace(section, name="b")])
    lines = list(report.write_pictures(slab, [], "."))
    assert lines[0].startswith("a" * 16 + "  ") and lines[1].startswith("b" + 17 * " ")


def test_labels_of_narrow_panels_keep_apart():
    figure = style.figure(6.0, 3.0)
    narrow, wide = figure.subplots(1, 2, width_ratios=(1, 20))
    for axes in (narrow, wide):
        axes.set_xlim(-0.6, 0.6)
    style.thin_out_labels(figure)
    figure.draw_without_rendering()
    for axes in (narrow, wide):
        labels = [label for label in axes.get_xticklabels() if label.get_text() and -0.6 <= label.get_position()[0] <= 0.6]
        boxes = [label.get_window_extent() for label in labels]
        assert 0.0 in [label.get_position()[0] for label in labels]
        assert all(after.x0 > before.x1 for before, after in zip(boxes, boxes[1:]))
    assert len(wide.get_xticks()) > 4


def test_plot_says_which_pictures_there_are(slab, tmp_path, capsys):
    assert main(["plot", str(slab), "energie", "--out", str(tmp_path)]) == 2
    assert "no picture energie; there are: cracks" in capsys.readouterr().err


def test_a_movie_has_a_frame_for_every_snapshot_and_moves(slab, tmp_path, capsys):
    from PIL import Image, ImageChops

    target = tmp_path / "slab.gif"
    assert main(["movie", str(slab), "--out", str(target), "--field", "displacement", "--interval", "0.2"]) == 0
    with Image.open(target) as movie:
        assert movie.n_frames == len(sazare.open(slab).snapshots)
        assert movie.info["duration"] == 200
        first = movie.convert("RGB")
        movie.seek(movie.n_frames - 1)
        assert ImageChops.difference(first, movie.convert("RGB")).getbbox() is not None
    assert main(["movie", str(slab), "--field", "heat"]) == 2
    assert "there are: speed, displacement" in capsys.readouterr().err


def test_the_balance_counts_what_was_stored_or_in_motion_and_is_set_free():
    figures = {"energy_work": -10.0, "energy_residual": 2.0, "energy_elastic": -80.0, "energy_kinetic": 70.0}
    assert energy_balance(figures) == pytest.approx(2.0 / 90.0)
    assert energy_balance({**figures, "energy_work": 0.0, "energy_kinetic": -120.0}) == pytest.approx(2.0 / 200.0)
    assert energy_balance({"energy_work": 0.0, "energy_residual": 0.0}) is None


def test_a_view_holds_what_has_moved_out_of_the_body_up_to_a_quarter_of_its_size():
    view = PlaneView(2, 0.5, np.array([[0.0, 0.0], [4.0, 2.0]]))
    near = pyvista.Box((1.0, 4.4, -0.2, 1.0, 0.0, 1.0))
    margin = 4.0 * MARGIN
    np.testing.assert_allclose(view.holding(near).window, [[0.0, -0.2 - margin], [4.4 + margin, 2.0]])
    splinter = pyvista.Box((90.0, 91.0, 0.0, 1.0, 0.0, 1.0))
    np.testing.assert_allclose(view.holding(near, splinter).window, [[0.0, -0.2 - margin], [5.0, 2.0]])


def test_a_cut_through_nodes_covers_the_whole_section():
    """Tetrahedra of a Delaunay mesh of two layers, whose nodes lie in the plane between them to round-off, each with nodes of its own."""
    random = np.random.default_rng(1)
    points = np.array([[x, y, z] for x in range(7) for y in range(7) for z in range(3)], dtype=float)
    inside = (points[:, :2] % 6 != 0).all(axis=1)
    points[inside, :2] += random.uniform(-0.3, 0.3, (inside.sum(), 2))
    mesh = pyvista.PolyData(points).delaunay_3d().explode(0.0)
    mesh.points = mesh.points.astype(float)
    mesh.points[:, 2] *= 1 + 2.3e-16 * random.integers(-1, 2, mesh.n_points)
    cut = PlaneView(2, 1.0, np.array([[0.0, 0.0], [6.0, 6.0]])).cut(mesh)
    assert cut.compute_cell_sizes()["Area"].sum() == pytest.approx(36.0, rel=1e-3)


@pytest.mark.parametrize("wrong", [["--interval", "-1"], ["--interval", "nan"], ["--interval", "1e9"], ["--enlarge", "inf"], ["--enlarge", "-2"]])
def test_a_movie_of_senseless_times_or_factors_is_refused(tmp_path, capsys, wrong):
    with pytest.raises(SystemExit) as ended:
        main(["movie", str(tmp_path), *wrong])
    assert ended.value.code == 2
    assert f"found {wrong[1]}" in capsys.readouterr().err


def test_names_with_dollar_signs_are_drawn_as_they_are(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run")
    table = copy / "gauges.csv"
    table.write_text(table.read_text().replace("G1.", "$\\frac{$ G1.").replace("G2.", "US$ 5 and $x^."))
    assert main(["plot", str(copy), "gauges", "--out", str(tmp_path)]) == 0
    assert imread(tmp_path / "gauges.png")[..., :3].std() > 0.02


@pytest.mark.parametrize("figure", ['"many"', "null", '{"a": 1}'])
def test_figures_of_other_kinds_end_in_a_message(slab, tmp_path, figure, capsys):
    copy = shutil.copytree(slab, tmp_path / "run")
    manifest = (copy / "manifest.json").read_text()
    steps = re.search(r'"steps": *\d+', manifest)
    (copy / "manifest.json").write_text(manifest.replace(steps[0], f'"steps": {figure}'))
    code = main(["report", str(copy)])
    assert code in (0, 2)
    assert code == 0 or "error:" in capsys.readouterr().err


def test_gauges_without_a_curve_are_told_of(tmp_path):
    (tmp_path / "manifest.json").write_text("{}")
    names = [f"G{number}" for number in range(1, 10)]
    heads = [f"{name}.velocity_{axis} [m/s]" for name in names for axis in "xyz"]
    rows = [",".join([str(time), *["0.5"] * len(heads)]) for time in range(3)]
    (tmp_path / "gauges.csv").write_text("\n".join([",".join(["time [s]", *heads]), *rows, ""]))
    figure = plot.gauges(sazare.open(tmp_path))
    assert [axes.get_title(loc="left").split(":")[0] for axes in figure.axes] == ["G1", "G3", "G4", "G6", "G7", "G9"]
    assert figure.get_supxlabel() == "3 more, G2, G5, G8: see gauges.csv"


def test_pictures_without_data_have_no_section_of_their_own(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run")
    (copy / "gauges.csv").unlink()
    page = write_report(copy).read_text()
    assert '<section id="gauges"' not in page and "<h2>Gauges</h2>" not in page
    assert "<li>Gauges: The case has no gauges.</li>" in page


def test_japanese_words_are_drawn_with_a_font_that_has_them(slab, tmp_path):
    copy = shutil.copytree(slab, tmp_path / "run")
    table = copy / "gauges.csv"
    table.write_text(table.read_text().replace("G1.", "落石の重心."), encoding="utf-8")
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # Matplotlib warns of a glyph that no font has
        assert main(["plot", str(copy), "gauges", "--out", str(tmp_path)]) == 0
    drawn = imread(tmp_path / "gauges.png")
    boxes = style.FONTS[:1]
    with pytest.MonkeyPatch.context() as patch, warnings.catch_warnings():
        warnings.simplefilter("ignore")
        patch.setitem(style.SETTINGS, "font.family", boxes)
        main(["plot", str(copy), "gauges", "--out", str(tmp_path / "boxes")])
    assert not np.array_equal(drawn, imread(tmp_path / "boxes" / "gauges.png"))


def test_the_font_is_found_without_changing_the_settings_of_others():
    import matplotlib

    assert "IPAexGothic" in style.FONTS
    assert "IPAexGothic" not in matplotlib.rcParams["font.family"]
    assert "matplotlib_fontja" not in sys.modules


def test_scales_of_many_values_end_at_a_percentile_and_say_so():
    values = np.r_[np.linspace(0.0, 1.0, 999), 1000.0]
    top, clipped = style.clipped_top(values)
    assert clipped and top == pytest.approx(0.99, abs=0.01)
    assert style.clipped_top(values[-5:]) == (1000.0, False)
    assert style.clipped_top(np.zeros(500)) == (1.0, False)


def test_scales_of_stresses_are_for_the_bulk_of_them():
    bulk = np.linspace(-30.0, 100.0, 960)
    low, high = style.bulk(np.r_[bulk, np.full(30, 4000.0), np.full(10, -900.0), np.nan])
    room = style.FAR_OUT * np.ptp(np.percentile(bulk, (25, 75)))
    assert -30.0 < low < -20.0 and 100.0 < high < 100.0 + 1.1 * room, "nothing far out, though it is more than two in a hundred"
    assert style.bulk(np.linspace(0.0, 1.0, 1001)) == (0.0, pytest.approx(0.98))
    assert style.bulk([1.0, 2.0, 500.0]) == (0.0, 500.0), "of few values all"
    assert style.bulk(np.zeros(500)) == style.bulk([]) == (0.0, 1.0)
    assert style.bulk(np.r_[np.zeros(990), np.full(10, 7.0)]) == (0.0, 7.0)


@pytest.mark.parametrize(("values", "extend", "words"), [
    ([0.0, 2e3], "neither", "[kPa]"), ([0.0, 5e6], "max", "[kPa],\nlargest 5 MPa"), ([-7e3, 2e3], "min", "[kPa],\nleast -7 kPa"),
    ([-7e3, 5e6], "both", "[kPa],\nleast -7 kPa,\nlargest 5 MPa"),
])
def test_a_bar_is_open_where_values_lie_beyond_it(values, extend, words):
    figure = style.figure(4.0, 3.0)
    axes = figure.subplots()
    drawn = axes.scatter([0, 1], [0, 1], c=np.array(values) / 1e3, vmin=0.0, vmax=2.0)
    style.open_colorbar(figure, drawn, axes, np.array(values), 1e3, "k", "Pa")
    assert drawn.colorbar.extend == extend and figure.axes[-1].get_ylabel() == words


def test_the_prefix_of_arrays_is_that_of_their_largest_magnitude():
    assert style.prefix_of(np.array([0.0, -5e-5])) == (1e-6, "µ")
    assert style.prefix_of(np.array([]), np.array([2e3, np.nan])) == (1e3, "k")
    assert style.prefix_of(np.zeros(3)) == (1.0, "")
