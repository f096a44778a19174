"""Pictures of cases before they run: what the legend and the names tell, for every method; what is refused; what is left behind."""

import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pytest

import sazare
from sazare import style
from sazare.methods.mps_model import _outsides
from sazare.methods.spheres_model import plane_in_box
from sazare.model import sheet, space
from sazare.model.groups import MeshGroups
from sazare.model.labels import place_names
from sazare.methods import blocks_model
from sazare.model.parts import BOUNDARY, Mark, Model, Part, along

ROOT = Path(__file__).resolve().parents[2]
COMMAND = ROOT / "build/release/apps/sazare/sazare"
CASES = ROOT / "cases"
BLOCK = ROOT / "tests/regression/block/case.toml"
GROUND_IN_SPACE = """
[case]
title = "A layer in space"
method = "mps"
[particles]
spacing = 1.0
dimension = 3
periodic = ["x"]
[[regions]]
name = "rock"
lower = [0.0, 0.0, 0.0]
upper = [6.0, 4.0, 2.0]
[[regions]]
name = "soil"
lower = [0.0, 0.0, 2.0]
upper = [6.0, 4.0, 5.0]
[[materials]]
name = "stiff"
regions = ["rock"]
density = 2000.0
s_wave_velocity = 400.0
poisson_ratio = 0.3
[[materials]]
name = "soft"
regions = ["soil"]
density = 1800.0
s_wave_velocity = 200.0
poisson_ratio = 0.3
[[motions]]
name = "quake"
type = "function"
quantity = "acceleration"
[[boundaries]]
side = "bottom"
kind = "prescribed"
motion_x = "quake"
[[boundaries]]
side = "front"
kind = "roller"
[gravity]
acceleration = [0.0, 0.0, -9.81]
settle = true
[[gauges]]
name = "top"
point = [3.0, 2.0, 4.5]
[time]
end = 1.0
"""


def legend(figure):
    """The lines of the legend."""
    return [text.get_text().replace("\n", " ") for text in figure.legends[0].get_texts()]


def words(figure):
    """What is written in the axes."""
    return [text.get_text() for axes in figure.axes for text in axes.texts]


def labels(figure):
    """The names of the axes of the first picture."""
    return [figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()]


def test_blocks_show_materials_blasts_and_gauges():
    figure = sazare.draw_model(BLOCK)
    elements = len(MeshGroups(BLOCK.with_name("block.msh")).region_of_elements(3))
    assert legend(figure) == [f"rock: {elements} elements", "blast pressure, peak 50 MPa: hole", "gauges"]
    assert {"hole", "G1", "G2", "x [cm]", "y [cm]", "z [cm]"} <= set(words(figure))
    assert [axes.get_title(loc="left") for axes in figure.axes[:2]] == ["from outside", "through the body"]
    assert figure.get_suptitle().splitlines() == ["Small block (t = 0)", "no gravity"]


def test_a_slab_is_seen_along_its_thin_axis_with_its_constraints():
    figure = sazare.draw_model(CASES / "free-face-blast/case.toml")
    assert figure.axes[0].get_title(loc="left") == "seen along z"
    assert "concrete: no translation along z" in figure.get_suptitle()
    assert words(figure).count("free face") == 2


def test_finite_elements_show_water_by_its_level_also_where_they_settle():
    figure = sazare.draw_model(CASES.parent / "validation/analytic/water-on-faces/case.toml")
    assert legend(figure)[2:] == [
        "joint: sole", "fixed: base", "water sea: level 3.3 m", "water land: level 1.3 m", "water uplift: level 3.3 m to 1.3 m",
    ]
    assert "gravity 9.81 m/s² along −y" in figure.get_suptitle()


def test_finite_elements_in_the_plane_show_regions_supports_joints_and_loads():
    figure = sazare.draw_model(CASES / "caisson-pushover/case.toml")
    assert legend(figure) == [
        "ground: 500 elements", "caisson: 120 elements", "joint: foot", "fixed: base", "viscous: sides", "load waves: 150 kPa along x, growing over 6 s", "gauges",
    ]
    assert labels(figure) == ["x [m]", "y [m]"]
    assert {"base", "sides", "caisson", "ground", "g"} <= set(words(figure))
    assert "gravity 9.81 m/s² along −y" in figure.get_suptitle()
    drawn = {artist.get_label(): artist for artist in figure.axes[0].collections}
    foot = np.concatenate(drawn["joint: foot"].get_segments())
    assert np.ptp(foot[:, 0]) == pytest.approx(10.0)
    np.testing.assert_allclose(foot[:, 1], 0.0, atol=1e-9)
    sides = np.concatenate(drawn["viscous: sides"].get_segments())
    assert set(sides[:, 0].round(9)) == {-20.0, 30.0}


def test_finite_elements_show_ties_drains_and_members():
    pile = {"name": "pile", "kind": "bar", "group": "right", "youngs_modulus": 2e11, "area": 1e-2}
    anchor = {"name": "anchor", "kind": "spring", "from": [0.0, 1.0, 0.0], "to": [0.5, 4.0, 0.0], "stiffness": 1e6}
    figure = sazare.draw_model(CASES / "liquefaction-column/case.toml", overrides={"drains": [{"group": "left"}], "members": [pile, anchor]})
    assert {"tied: left to right", "drain: left", "bar: pile", "spring: anchor"} <= set(legend(figure))
    drawn = {artist.get_label(): artist for artist in figure.axes[0].collections}
    assert set(np.concatenate(drawn["tied: left to right"].get_segments())[:, 0].round(9)) == {0.0, 0.5}
    assert set(np.concatenate(drawn["drain: left"].get_segments())[:, 0].round(9)) == {0.0}


def test_finite_elements_show_free_field_sides_and_a_tie_rod():
    figure = sazare.draw_model(CASES / "quay-wall-dry/case.toml")
    assert {"free_field: sea side, land side", "beam: wall", "bar: tie_rod"} <= set(legend(figure))
    rod = next(artist for artist in figure.axes[0].collections if artist.get_label() == "bar: tie_rod")
    np.testing.assert_allclose(np.concatenate(rod.get_segments()), [[0.0, -1.5], [12.0, -1.5]])


def test_finite_elements_in_space_show_supports():
    figure = sazare.draw_model(CASES / "rock-fall-on-slab/slab.toml")
    assert legend(figure) == ["slab (concrete): 288 elements", "fixed: left support", "roller (z held): right support", "gauge"]
    assert {"left support", "right support", "middle"} <= set(words(figure))


def test_particles_in_the_plane_show_the_sides_with_conditions():
    figure = sazare.draw_model(CASES / "slope-el-centro/case.toml", overrides={"particles.spacing": 2.0})
    assert "viscous (el-centro along x): bottom, 50 particles" in legend(figure)
    assert "periodic along x" in figure.get_suptitle()


def test_particles_in_space_show_regions_and_supports_before_they_settle():
    figure = sazare.draw_model(GROUND_IN_SPACE)
    assert legend(figure) == [
        "rock (stiff): 48 particles", "soil (soft): 72 particles", "prescribed (quake along x): bottom, 24 particles", "roller: front, 24 particles", "gauge",
    ]
    assert {"x [m]", "y [m]", "z [m]", "top"} <= set(words(figure))


def test_rectangles_show_blocks_walls_and_rollers():
    figure = sazare.draw_model(CASES / "mortar-beam/case.toml")
    assert legend(figure) == ["beam (mortar): 144 elements", "roller left, right", "roller platen, moves at 10 mm/s along −y", "gauge"]
    assert labels(figure) == ["x [cm]", "y [cm]"]


def test_many_rectangles_are_coloured_by_material():
    figure = sazare.draw_model(CASES / "toppling-columns/case.toml")
    assert legend(figure)[:2] == ["rock: 8 blocks, 8 elements", "wall base"]
    low, high = figure.axes[0].get_xlim()
    assert -4.0 < low < high < 10.0  # the base goes on far beyond


def test_spheres_show_groups_walls_and_periodic_sides():
    figure = sazare.draw_model(CASES / "rotating-drum/case.toml")
    assert legend(figure) == ["grains (grain): 2 880 spheres".replace(" 880", "\u202f880"), "wall drum, turns at 3 rad/s about y", "gauge"]
    assert "periodic along y (0 to 0.03 m)" in figure.get_suptitle()
    assert "x [cm]" in words(figure)


def test_water_around_spheres_shows_its_surface_and_its_current():
    figure = sazare.draw_model(CASES / "stones-through-water/case.toml")
    assert "water: level 0 m" in legend(figure)
    assert "current 600 mm/s along x" in figure.get_suptitle()


def test_bodies_of_spheres_are_counted():
    assert legend(sazare.draw_model(CASES / "tetrapod-drop/case.toml")) == ["armour (concrete): 18 × tetrapod, 234 spheres together", "wall floor", "gauge"]


def test_both_sides_of_a_coupled_case_are_in_one_picture():
    figure = sazare.draw_model(CASES / "sphere-on-beam/case.toml")
    found = legend(figure)
    assert found[0].startswith("beam (steel): ")
    assert found[1:] == [
        "roller (x held, y held): left support", "roller (y held): right support", "ball (steel): 1 sphere", "coupling surface: top", "gauges",
    ]
    assert {"middle", "ball"} <= set(words(figure))
    assert "ball: initial velocity 1 m/s along −y" in figure.get_suptitle()


def test_a_coupled_case_in_space():
    figure = sazare.draw_model(CASES / "rock-fall-on-slab/case.toml")
    assert {"slab (concrete): 288 elements", "rock: 100 elements", "coupling surface: top", "fixed: left support"} <= set(legend(figure))
    assert "gravity acts on the bodies only" in figure.get_suptitle()


@pytest.mark.parametrize("ending", ["png", "pdf", "svg", "jpg"])
def test_the_picture_is_written_and_nothing_else(tmp_path, monkeypatch, ending):
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    monkeypatch.chdir(tmp_path)
    picture = tmp_path / f"model.{ending}"
    sazare.draw_model(CASES / "mortar-beam/case.toml", picture)
    assert picture.stat().st_size > 1000
    assert sorted(path.name for path in tmp_path.rglob("*")) == [picture.name, "temporary"]


def test_names_with_dollar_signs_stand_as_they_are(tmp_path):
    names = {"case.title": r"A beam for 5 $ or $\frac{$", "gauges.0.name": r"$\sigma_{$", "blocks.0.name": "$x^$"}
    figure = sazare.draw_model(CASES / "mortar-beam/case.toml", tmp_path / "model.png", overrides=names)
    assert figure.get_suptitle().splitlines()[0] == r"A beam for 5 $ or $\frac{$ (t = 0)"
    assert legend(figure)[0] == "$x^$ (mortar): 144 elements"
    assert r"$\sigma_{$" in words(figure)


def test_a_picture_that_cannot_be_written_is_refused_with_what_to_do(tmp_path):
    case = CASES / "mortar-beam/case.toml"
    with pytest.raises(ValueError, match=r"it ends in \.bmp: let it end in \.png, \.pdf, \.svg or \.jpg, as in model\.png"):
        sazare.draw_model(case, tmp_path / "model.bmp")
    with pytest.raises(ValueError, match=r"it has no ending: let it end in"):
        sazare.draw_model(case, tmp_path / "model")
    with pytest.raises(ValueError, match=r"the folder .*/absent does not exist: make it first"):
        sazare.draw_model(case, tmp_path / "absent" / "model.png")
    (tmp_path / "folder.png").mkdir()
    with pytest.raises(ValueError, match="this is a folder: give the name of a file"):
        sazare.draw_model(case, tmp_path / "folder.png")
    assert [path.name for path in tmp_path.iterdir()] == ["folder.png"]


def test_errors_of_the_case_have_the_words_of_check(tmp_path):
    wrong = tmp_path / "case.toml"
    wrong.write_text((CASES / "mortar-beam/case.toml").read_text().replace("density", "densty"))
    with pytest.raises(sazare.UserError) as checked:
        sazare.check(wrong)
    with pytest.raises(sazare.UserError) as drawn:
        sazare.draw_model(wrong, tmp_path / "model.png")
    assert str(drawn.value) == str(checked.value)
    assert [path.name for path in tmp_path.iterdir()] == ["case.toml"]


def test_the_command_checks_and_draws(tmp_path):
    case = CASES / "mortar-beam/case.toml"

    def check(*options):
        return subprocess.run([COMMAND, "check", case, *options], capture_output=True, text=True, check=False, cwd=tmp_path)

    done = check("--picture", "model.png", "--set", "blocks.0.element_size=0.02")
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-2:] == [f"The case is valid. To run it: sazare run {case}", "picture: model.png"]
    assert (tmp_path / "model.png").exists()
    refused = check("--picture", "model.bmp")
    assert (refused.returncode, refused.stdout) == (2, "")
    assert "model.bmp must end in .png, .pdf, .svg or .jpg" in refused.stderr
    wrong = check("--picture", "other.png", "--set", "time.end=-1.0")
    assert (wrong.returncode, wrong.stderr) == (2, check("--set", "time.end=-1.0").stderr)
    assert [path.name for path in tmp_path.iterdir()] == ["model.png"]


def test_the_command_warns_once(tmp_path):
    words = [COMMAND, "check", CASES / "brazilian-disc/case.toml", "--set", "mesh.parameters.size=0.0125", "--set", "initial_stress.shear_stress=[40e6, 0, 0]"]
    done = subprocess.run([*words, "--picture", tmp_path / "disc.png"], capture_output=True, text=True, check=True)
    assert (done.stdout + done.stderr).count("warning: the initial stress is beyond the strength") == 1


def test_a_mesh_in_text_and_in_binary_has_the_same_groups(tmp_path):
    geometry = CASES / "caisson-pushover/caisson.geo"
    found = []
    for name, options in (("text", ["-bin", "0"]), ("binary", ["-bin", "1"])):
        mesh = tmp_path / f"{name}.msh"
        subprocess.run(["gmsh", "-2", geometry, "-format", "msh41", *options, "-o", mesh, "-v", "0", "-nt", "1"], check=True)
        found.append(MeshGroups(mesh, 2.0))
    text, binary = found
    assert text.regions(2) == binary.regions(2) == ["ground", "caisson"]
    assert text.region_of_elements(2) == binary.region_of_elements(2)
    for name, dimension in (("base", 1), ("sea", 1), ("ground", 2)):
        assert text.dimension(name, 3) == dimension
        np.testing.assert_allclose(text.corners(name, dimension), binary.corners(name, dimension), atol=1e-9)
    base = np.array(text.corners("base", 1))
    np.testing.assert_allclose(base[:, :, 1], -20.0, atol=1e-9)  # 10 m deep, times the scale
    assert np.linalg.norm(base[:, 1] - base[:, 0], axis=1).sum() == pytest.approx(100.0)
    assert text.dimension("absent", 3) is None


def test_a_plane_is_cut_by_a_box():
    cube = np.array([[0.0, 0.0, 0.0], [1.0, 1.0, 1.0]])
    level = plane_in_box(np.array([5.0, 5.0, 0.25]), np.array([0.0, 0.0, 2.0]), cube)
    np.testing.assert_allclose(sorted(level.tolist()), [[0, 0, 0.25], [0, 1, 0.25], [1, 0, 0.25], [1, 1, 0.25]])
    hexagon = plane_in_box(np.full(3, 0.5), np.ones(3), cube)
    sides = np.linalg.norm(hexagon - np.roll(hexagon, 1, axis=0), axis=1)
    np.testing.assert_allclose(sides, np.full(6, np.sqrt(0.5)))
    assert len(plane_in_box(np.array([0.0, 0.0, 3.0]), np.array([0.0, 0.0, 1.0]), cube)) == 0


def test_the_outside_of_particles_in_space():
    places = 0.5 * np.array([[x, y, z] for x in (0, 1, 2) for y in (0, 1, 2) for z in (0, 1, 2)], dtype=float) + 7.0
    faces, owners = _outsides(places, 0.5)
    assert len(faces) == 6 * 9
    np.testing.assert_allclose(np.abs(faces - 7.5).max(axis=(1, 2)), 0.75)
    assert 13 not in owners  # the one in the middle


class Wall:
    """A case whose hole `h` has a wall of triangles every 0.1 m down to 4 m, and with surfaces of joints."""

    def __init__(self, **tables):
        self.tables, self.groups = tables, self

    def all(self, table):
        return self.tables.get(table, [])

    def dimension(self, name, below):
        return 2

    def corners(self, name, dimension):
        return [np.array([[0.1, 0.0, -z], [0.0, 0.1, -z], [-0.1, 0.0, -z]]) for z in np.arange(0.05, 4.0, 0.1)]


def test_charge_and_stemming_of_a_hole_are_told_apart():
    hole = {"surface": "h", "explosive": "ANFO", "delay": 0.0, "collar": [0.0, 0.0, 0.0], "toe": [0.0, 0.0, -4.0]}
    charge, rest = blocks_model._charges(Wall(charges=[{**hole, "top": 1.0, "bottom": 2.0}, {**hole, "top": 3.0}]))
    depths = [[-face[0, 2] for face in part.faces] for part in (charge, rest)]
    assert depths[0] == pytest.approx([*np.arange(1.05, 2.0, 0.1), *np.arange(3.05, 4.0, 0.1)])
    assert depths[1] == pytest.approx([*np.arange(0.05, 1.0, 0.1), *np.arange(2.05, 3.0, 0.1)])
    assert charge.color != rest.color and "stemming" in rest.label
    assert len(list(blocks_model._charges(Wall(charges=[{**hole, "top": 0.0}])))) == 1


def test_sets_of_joints_have_colours_of_their_own():
    sets = [{"name": name, "surface": name, "bonded": name != "C"} for name in "ABC"]
    parts = list(blocks_model._joints(Wall(joints=[{"name": "rock", "bonded": True}, *sets])))
    assert [part.label for part in parts] == ["joint: A", "joint: B", "joint, not bonded: C"]
    assert len({part.color for part in parts}) == 3
    many = [{"name": f"s{number}", "surface": "s", "bonded": number % 2 == 0} for number in range(20)]
    parts = list(blocks_model._joints(Wall(joints=many)))
    assert len(parts) == 2 and len({part.color for part in parts}) == 2


def test_names_keep_off_what_is_drawn():
    figure = style.figure(4.0, 4.0)
    axes = figure.subplots()
    axes.set(xlim=(0, 1), ylim=(0, 1))
    drawn = np.column_stack([np.full(200, 0.56), np.linspace(0.0, 1.0, 200)])  # where the name would stand best
    place_names(axes, [Mark("a long name", None)], np.array([[0.5, 0.5]]), drawn)
    box = next(text for text in axes.texts if text.get_text()).get_window_extent(figure.canvas.get_renderer())
    assert not any(box.contains(*point) for point in axes.transData.transform(drawn))


def test_names_cover_neither_each_other_nor_points():
    figure = style.figure(4.0, 4.0)
    axes = figure.subplots()
    axes.set(xlim=(0, 1), ylim=(0, 1))
    places = np.array([[0.5, 0.5], [0.5, 0.5], [0.52, 0.5], [0.5, 0.52], [0.97, 0.5]])
    place_names(axes, [Mark(f"a long name {number}", None) for number in range(len(places))], places)
    renderer = figure.canvas.get_renderer()
    boxes = [text.get_window_extent(renderer) for text in axes.texts if text.get_text()]
    assert len(boxes) == len(places)
    for number, box in enumerate(boxes):
        assert not any(box.overlaps(other) for other in boxes[:number])
        assert not any(box.contains(*point) for point in axes.transData.transform(places))
        assert box.x1 <= axes.get_window_extent(renderer).x1


@pytest.mark.parametrize(("extent", "unit"), [(120.0, "m"), (1.0, "m"), (0.5, "cm"), (0.02, "mm")])
def test_lengths_have_the_unit_that_suits(extent, unit):
    factor, name = sheet.length_unit(extent)
    assert name == unit
    assert factor == {"m": 1.0, "cm": 1e-2, "mm": 1e-3}[unit]


def test_a_body_in_space_is_seen_where_it_is_free():
    corners = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=float)
    sides = {(axis, end): np.insert(corners, axis, end, axis=1) for axis in range(3) for end in (0, 1)}
    body = Part("body", "#000000", faces=list(sides.values()))

    def toward(free, gravity=None):
        held = Part("held", "#000000", BOUNDARY, faces=[side for place, side in sides.items() if place != free])
        return space._corner_view(np.array([[0.0] * 3, [1.0] * 3]), Model(3, [body, held], gravity=gravity)).toward

    assert toward((2, 0))[2] < -0.5
    assert toward((0, 0))[0] < 0.0
    down = np.array([0.0, 0.0, -9.81])
    assert toward((2, 0), down)[2] > 0.0  # never from below
    np.testing.assert_allclose(toward(None, down), np.array([0.55, -1.0, 0.55]) / np.sqrt(0.55**2 * 2 + 1.0))


def test_vectors_in_words():
    assert along([0.0, -9.81, 0.0], "m/s²") == "9.81 m/s² along −y"
    assert along([3e3, 0.0, 4e3], "Pa") == "(3, 0, 4) kPa"


def test_the_box_of_a_model_leaves_walls_out():
    body = Part("body", "#000000", points=np.array([[1.0, 2.0, 3.0]]), radii=np.array([0.5]))
    support = Part("support", "#000000", BOUNDARY, lines=np.array([[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]]))
    wall = Part("wall", "#000000", "wall", faces=[np.full((4, 3), 99.0)])
    np.testing.assert_allclose(Model(3, [body, support, wall]).box, [[0.0, 0.0, 0.0], [1.5, 2.5, 3.5]])


RAIN = """
[case]
title = "Rain"
method = "spheres"
[[materials]]
name = "grain"
density = 2500.0
youngs_modulus = 1e7
poisson_ratio = 0.3
[contact]
friction_coefficient = 0.3
restitution = 0.5
[[spheres]]
name = "grains"
material = "grain"
source = "lattice"
radius = 0.01
lower = [0.0, 0.0, 0.5]
upper = [0.1, 0.1, 0.6]
rain = true
[[walls]]
name = "floor"
material = "grain"
point = [0.0, 0.0, 0.0]
normal = [0.0, 0.0, 1.0]
[gravity]
acceleration = [0.0, 0.0, -9.81]
[time]
end = 0.1
"""


def test_spheres_are_shown_before_they_rain():
    figure = sazare.draw_model(RAIN)
    assert "grains: shown where it begins to rain" in figure.get_suptitle()
    assert "60" in words(figure)  # cm above the floor
    assert legend(figure) == ["grains (grain): 125 spheres", "wall floor"]
