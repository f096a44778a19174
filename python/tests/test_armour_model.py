"""Models of armour layers: units as solids, places on a slope, the case, what is surveyed of a layer; bad input."""

import math
import shlex
import subprocess
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import sazare
from sazare.__main__ import main
from sazare.armour import Damage
from sazare.armour.layer import Layer, Plane, plane_of
from sazare.armour_model import KINDS, ArmourModel, Layout, Material, Rules, Slope, read_stl, unit_solid, write_model, write_stl
from sazare.armour_model.solids import Convex, Solid, union
from sazare.armour_model.units import BASE, TOP, dolos
from sazare.tables import NotARun

PROGRAM = Path(__file__).resolve().parents[2] / "build/release/apps/sazare/sazare"
SLOPE = Slope(toe=-1.0, crest=2.0, cot=1.5, width=6.0)
SHAPED = [kind for kind in KINDS.values() if kind.make]


def box(lower, upper):
    return Convex([(x, y, z) for x in (lower[0], upper[0]) for y in (lower[1], upper[1]) for z in (lower[2], upper[2])])


def layout_of(name="cube", size=0.5, slope=SLOPE, **rules):
    return Layout(slope, KINDS[name], unit_solid(KINDS[name], size=size), Rules(**rules))


def test_a_union_has_the_volume_of_its_parts_without_what_they_share():
    crossed = union([box((-2, -0.5, -0.5), (2, 0.5, 0.5)), box((-0.4, -3, -0.3), (0.6, 3, 0.7))])
    assert crossed.open_edges == 0
    assert crossed.volume == pytest.approx(4.0 + 6.0 - 1.0 * 1.0 * 0.8, rel=1e-12)
    flush = union([box((0, 0, 0), (2, 1, 1)), box((1, 0, 0), (2, 3, 1))])  # three faces are shared
    assert flush.open_edges == 0
    assert flush.volume == pytest.approx(2.0 + 3.0 - 1.0, rel=1e-12)
    assert union([box((0, 0, 0), (1, 1, 1)), box((0.2, 0.2, 0.2), (0.4, 0.4, 0.4))]).volume == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize("kind", SHAPED, ids=lambda kind: kind.name)
def test_units_are_closed_and_a_height_high(kind):
    solid = unit_solid(kind, height=2.5)
    assert solid.open_edges == 0
    assert np.ptp(solid.points[:, 2]) == pytest.approx(2.5, rel=1e-12)
    assert unit_solid(kind, size=1.7).volume == pytest.approx(1.7**3, rel=1e-12)


def test_volumes_of_units_are_those_of_formulas_and_publications():
    volume = {kind.name: kind.make().volume for kind in SHAPED}
    assert volume["cube"] == pytest.approx(1.0, rel=1e-12)
    assert volume["antifer"] == pytest.approx((BASE**2 + BASE * TOP + TOP**2) / 3.0, rel=1e-12), "a truncated pyramid"
    for name, apart in (("tetrapod", 0.005), ("dolos", 0.03), ("anvils", 0.005)):
        assert volume[name] == pytest.approx(KINDS[name].volume, rel=apart), name
    for waist in (0.32, 0.36, 0.40, 0.43):  # 0.675 r^1.285, Burcharth and Liu (1992)
        assert dolos(waist).volume == pytest.approx(0.675 * waist**1.285, rel=0.06)


def test_a_file_of_triangles_holds_the_solid(tmp_path):
    solid = unit_solid(KINDS["dolos"], size=1.0)
    write_stl(solid, tmp_path / "unit.stl")
    assert read_stl(tmp_path / "unit.stl").volume == pytest.approx(1.0, rel=1e-7)
    header = bytes(80) + len(solid.triangles).to_bytes(4, "little")
    body = b"".join(bytes(12) + corners.astype("<f4").tobytes() + bytes(2) for corners in solid.corners)
    (tmp_path / "binary.stl").write_bytes(header + body)
    assert read_stl(tmp_path / "binary.stl").volume == pytest.approx(1.0, rel=1e-5)


def test_the_mean_half_width_is_that_of_cauchy():
    assert unit_solid(KINDS["cube"], size=2.0).mean_half_width == pytest.approx(1.5, rel=1e-4), "1.5 sides is the mean width of a cube"


@pytest.mark.parametrize("name", ["tetrapod", "anvils"])
def test_a_layer_has_the_packing_density_that_was_asked_for(name):
    layout = layout_of(name, packing=0.9)
    assert layout.packing == pytest.approx(0.9, rel=1e-12)
    assert layout.number * layout.size**2 / layout.area == pytest.approx(0.9, rel=1e-12)
    assert layout.porosity == pytest.approx(1.0 - layout.number * layout.volume / (layout.area * layout.thickness), rel=1e-12)
    assert layout_of(name).porosity == pytest.approx(KINDS[name].porosity, abs=1e-12), "that of the unit, where none is asked for"
    shore, up = layout.distances
    assert layout.columns * shore == pytest.approx(SLOPE.width)
    assert layout.rows_with_room * up <= SLOPE.length < (layout.rows_with_room + 1) * up


def test_units_stand_on_the_grid():
    layout = layout_of(grid=(0.7, 0.6), number=30, layers=2)
    assert layout.columns == 8 and layout.distances[0] == pytest.approx(0.75)
    from_toe = layout.places - [0.0, 0.0, SLOPE.toe]
    out = from_toe @ SLOPE.normal - layout.stone
    assert np.allclose(np.unique(np.round(out, 9)), [0.55 * 0.5, 1.65 * 0.5]), "k = 1.10 of cubes"
    assert np.allclose(np.unique(np.round(from_toe @ SLOPE.up, 9)), [0.3, 0.9])
    assert (layout.order[:, 0] == 0).sum() == 16 and (layout.order[:, 0] == 1).sum() == 14, "the last row of the last layer is not full"
    first, second = (layout.places[(layout.order[:, 0] == layer) & (layout.order[:, 1] == 0)][0, 1] for layer in (0, 1))
    assert second - first == pytest.approx(0.375), "units of the second layer stand over the gaps"


def test_orientations_are_random_by_a_seed_or_follow_the_rule():
    assert np.array_equal(layout_of(seed=3).turns, layout_of(seed=3).turns)
    assert not np.allclose(layout_of(seed=3).turns, layout_of(seed=4).turns)
    layout = layout_of(orientation="rule")
    upright = Rotation.from_rotvec(layout.turns).apply([0.0, 0.0, 1.0])
    sign = np.where(layout.order[:, 0] == 0, 1.0, -1.0)
    assert np.allclose(upright, sign[:, None] * SLOPE.normal, atol=1e-12)
    along = Rotation.from_rotvec(layout.turns).apply([1.0, 0.0, 0.0])
    assert np.allclose(along, np.where(layout.order[:, 1] % 2 == 0, 1.0, -1.0)[:, None] * SLOPE.up, atol=1e-12)


def test_stones_lie_on_the_slope_and_do_not_overlap():
    layout = layout_of(seed=2)
    radii, places = layout.underlayer[:, 0], layout.underlayer[:, 1:]
    assert np.allclose((places - [0.0, 0.0, SLOPE.toe]) @ SLOPE.normal, radii)
    apart = places[:, None] - places
    apart[..., 1] -= SLOPE.width * np.round(apart[..., 1] / SLOPE.width)
    gap = np.linalg.norm(apart, axis=2) - radii[:, None] - radii
    assert gap[~np.eye(len(radii), dtype=bool)].min() > -1e-9
    assert 4.0 / 3.0 * math.pi * (layout.stone / 2.0) ** 3 == pytest.approx(0.1 * layout.volume)


@pytest.mark.parametrize(
    ("slope", "rules", "words"),
    [
        (SLOPE, {"number": 500}, "500 units do not fit: the slope has room for"),
        (Slope(0.0, 0.2, 1.5, 6.0), {}, "no unit fits: the slope is 0.3606 m long"),
        (Slope(0.0, 3.0, 1.5, 0.5), {}, "has room for one unit"),
    ],
)
def test_units_that_do_not_fit_are_refused(slope, rules, words):
    with pytest.raises(ValueError, match=words):
        layout_of(slope=slope, **rules)


def test_a_crest_below_the_toe_is_refused():
    with pytest.raises(ValueError, match="not above the toe"):
        Slope(1.0, 0.5, 1.5, 2.0)


@pytest.mark.parametrize("kind", SHAPED, ids=lambda kind: kind.name)
@pytest.mark.parametrize(("strength", "modulus"), [(None, None), (3e6, None), (3e6, 3e8)])
def test_the_engine_takes_the_case(kind, strength, modulus, tmp_path):
    layout = Layout(Slope(0.0, 1.2, 1.5, 2.5), kind, unit_solid(kind, size=0.5), Rules())
    case = write_model(ArmourModel(layout, Material(tensile_strength=strength, youngs_modulus=modulus, count=12)), tmp_path / "model")
    said = sazare.check(case)
    assert f'"{kind.name}": its spheres fill' in said
    assert ("bonded by unit" if strength else "rigid") in said


def test_units_come_to_rest_on_the_slope(tmp_path):
    layout = layout_of("tetrapod", size=0.05, slope=Slope(0.0, 0.11, 1.5, 0.25))
    case = write_model(ArmourModel(layout, Material(count=12)), tmp_path / "model")
    run = sazare.run(case, tmp_path / "run", progress=False, threads=1)
    assert run.figures[f"shape_volume_{layout.kind.name}"] == pytest.approx(0.05**3, rel=1e-6), "the mass of the solid, not of its spheres"
    damage = Damage(run)
    assert len(damage.units) == layout.number
    assert damage.ratio.max() < 0.01, "they are at rest from the beginning"
    before, after = damage.layers
    assert after.porosity == pytest.approx(before.porosity, abs=0.005)
    assert 0.6 < before.packing < 1.4 and 0.25 < before.porosity < 0.65


@pytest.mark.parametrize(("strength", "breaks"), [(4e6, False), (5e3, True)])
def test_bonded_units_break_where_they_are_too_weak_for_their_weight(strength, breaks, tmp_path):
    layout = layout_of("cube", size=1.0, slope=Slope(0.0, 1.2, 1.5, 3.4), layers=1)
    case = write_model(ArmourModel(layout, Material(tensile_strength=strength, youngs_modulus=3e8, count=12)), tmp_path / "model")
    run = sazare.run(case, tmp_path / "run", progress=False, threads=1)
    assert (Damage(run).broken > 0) == breaks


def slab(height, step=0.05, radius=0.1):
    """Spheres whose upper surface is nearly flat at a height over the plane z = 0; one body for each column."""
    x, y = (axis.ravel() for axis in np.meshgrid(np.arange(0.0, 4.0, step), np.arange(0.0, 2.0, step)))
    points = np.column_stack([x, y, np.full(len(x), height - radius)])
    owner = np.arange(len(x))
    return SimpleNamespace(points=points, radii=np.full(len(x), radius), owner=owner, mean=lambda values: values)


def test_the_layer_is_surveyed_as_high_as_it_is():
    plane, size = Plane(np.zeros(3), np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])), 0.4
    units = slab(0.5)
    volumes = np.full(len(units.points), 0.002 * size**3)
    bare = Layer(units, volumes, (np.zeros((0, 3)), np.zeros(0)), plane, 2.0, size, (1.0, 3.0))
    assert bare.thickness == pytest.approx(0.5, abs=0.005)
    inside = np.sum((units.points[:, 0] > 1.0) & (units.points[:, 0] < 3.0))
    assert bare.packing == pytest.approx(inside * 0.002 * size**2 / 4.0)
    assert bare.porosity == pytest.approx(1.0 - inside * 0.002 * size**3 / (4.0 * bare.thickness))
    ground = slab(0.2)
    raised = Layer(units, volumes, (ground.points, ground.radii), plane, 2.0, size, (1.0, 3.0))
    assert raised.thickness == pytest.approx(0.3, abs=0.005), "the ground is surveyed too"
    one = SimpleNamespace(points=np.array([[2.0, 0.02, 0.3]]), radii=np.array([0.3]), owner=np.array([0]), mean=lambda values: values)
    at_the_end = Layer(one, np.array([1.0]), (np.zeros((0, 3)), np.zeros(0)), plane, 2.0, size, (1.0, 3.0))
    assert at_the_end.top[:, -1].max() > 0.5, "it reaches through the end of the width"


def test_the_plane_of_the_slope_is_found_by_its_name():
    case = {"walls": [{"name": "slope", "normal": [-1.0, 0.0, 1.5], "point": [0.0, 0.0, 1.0]}, {"name": "floor", "normal": [0.0, 0.0, 1.0], "point": [0.0] * 3}, {"name": "box"}]}
    plane = plane_of(case, np.array([0.0, 0.0, 1.0]))
    assert np.allclose(plane.up, SLOPE.up) and np.allclose(plane.frame[2], SLOPE.normal) and np.allclose(np.abs(plane.frame[1]), [0.0, 1.0, 0.0])
    assert plane_of({"walls": []}, np.array([0.0, 0.0, 1.0])) is None
    for name, words in (("floor", "is level"), ("box", "is no plane"), ("hill", "is no wall")):
        with pytest.raises(NotARun, match=f'"{name}" {words}; planes are slope, floor'):
            plane_of(case, np.array([0.0, 0.0, 1.0]), name)


def ask(*arguments, cwd):
    return subprocess.run([PROGRAM, "armour-model", *map(str, arguments)], cwd=cwd, capture_output=True, text=True, check=False)


def test_the_command_writes_a_case_and_its_own_line_writes_it_again(tmp_path):
    rock = union([Convex(np.random.default_rng(5).normal(size=(30, 3)))])
    write_stl(rock, tmp_path / "stone.stl")
    done = ask("rock", "--stl", "stone.stl", "--mass", "20", "--density", "2650", "--crest", "0.5", "--width", "1.2", "--grid", "0.24", "0.2", "--spheres", "15", "--out", "model", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert "D_n 0.1962 m" in done.stdout and "20 kg" in done.stdout
    assert {path.name for path in (tmp_path / "model").iterdir()} == {"case.toml", "model.md", "unit.stl", "places.csv", "underlayer.csv", "toe.csv"}
    line = next(line for line in (tmp_path / "model/model.md").read_text().splitlines() if line.startswith("Made by"))
    again = ask(*shlex.split(line.split("`")[1])[2:], "--out", "again", cwd=tmp_path)
    assert again.returncode == 0, again.stderr
    for name in ("case.toml", "unit.stl", "places.csv", "underlayer.csv"):
        assert (tmp_path / "again" / name).read_bytes() == (tmp_path / "model" / name).read_bytes()
    there = ask(*shlex.split(line.split("`")[1])[2:], "--out", "again", cwd=tmp_path)
    assert there.returncode == 2 and "--overwrite" in there.stderr


def test_what_cannot_be_made_is_refused(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    whole = unit_solid(KINDS["cube"], size=1.0)
    write_stl(Solid(whole.points, whole.triangles[1:]), tmp_path / "open.stl")
    write_stl(Solid(whole.points, whole.triangles[:, ::-1]), tmp_path / "inside.stl")
    (tmp_path / "words.stl").write_text("solid of words\nvertex one two three\n")
    slope = ("--mass", "20", "--crest", "0.5", "--width", "1.2")
    for arguments, words in (
        (("tetrapot", *slope), "there is no unit 'tetrapot'; the units are: tetrapod, four conical legs; dolos"),
        (("rock", *slope), "--stl FILE"),
        (("cube", *slope, "--stl", "open.stl"), "takes no --stl"),
        (("rock", *slope, "--stl", "none.stl"), "no such file"),
        (("rock", *slope, "--stl", "open.stl"), "the surface is not closed: 3 edges"),
        (("rock", *slope, "--stl", "inside.stl"), "the surface is inside out"),
        (("rock", *slope, "--stl", "words.stl"), "no file of triangles"),
        (("cube", *slope, "--units", "1000"), "1000 units do not fit: the slope has room for"),
        (("cube", *slope, "--packing", "1", "--grid", "0.3", "0.3"), "keep one of them"),
        (("cube", *slope, "--density", "2.4"), "did you mean 2400?"),
        (("cube", "--crest", "0.5", "--width", "1.2"), "one of the arguments --mass --dn --height is required"),
    ):
        try:
            code = main(["armour-model", *arguments])
        except SystemExit as end:
            code = end.code
        said = capsys.readouterr().err
        assert code == 2 and words in said, (arguments, said)
    assert not (tmp_path / "cube-model").exists()
