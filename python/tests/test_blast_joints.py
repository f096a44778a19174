"""Sets of joints in blast models: how discs are scattered, their laws, and what of them a mesh can follow."""

import re
import subprocess
import tomllib

import numpy as np
import pytest

import sazare
from sazare import blast_model
from sazare.__main__ import main
from sazare.blast_model import clearance, fit, mesh_quality, scatter
from sazare.blast_model.geometry import prism
from sazare.blast_model.joint_laws import joint_entries
from sazare.blast_model.orientations import fisher_estimated, line_direction, mean_crossing, sample_normals
from sazare.blast_model.rock import GRANITE
from sazare.blast_model.sizes import SizeLaw
from sazare.engine import engine
from sazare.model.groups import MeshGroups

PATTERN = """hole,collar_x,collar_y,collar_z,toe_x,toe_y,toe_z,diameter [mm],explosive,stemming,delay [ms]
1,0,0,0,0,0,-2.2,170,ANFO,1,0
2,0,1.5,0,0,1.5,-2.2,170,ANFO,1,1
"""
SETS = """set,dip [deg],dip_direction [deg],fisher,size_law,diameter [m],deviation [m],exponent,diameter_min [m],diameter_max [m],p32 [m2/m3],seed
"""
STEEP = "steep,75,120,30,constant,1.2,,,,,0.3,4\n"
SMALL = {"burden": 1.0, "height": 2.0, "margin": 1.2, "size": 0.5}


@pytest.fixture
def written(tmp_path):
    """Writes a text into a file, and returns its path."""

    def write(text, name="sets.csv"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


@pytest.fixture
def layout(written):
    return blast_model.layout_of(blast_model.read_pattern(written(PATTERN, "pattern.csv")), blast_model.Options(**SMALL))


@pytest.fixture
def wide(written):
    """A bench of 30 x 33 x 22 m, in axes turned against those of the pattern."""
    options = blast_model.Options(burden=10.0, height=8.0, margin=14.0, azimuth=35.0, face_angle=70.0)
    return blast_model.layout_of(blast_model.read_pattern(written(PATTERN, "pattern.csv")), options)


@pytest.mark.parametrize("fisher", [0.0, 0.5, 3.0, 40.0, 500.0])
def test_normals_follow_the_distribution_of_fisher(fisher):
    random, count = np.random.default_rng(7), 200_000
    mean = np.array([0.48, -0.64, 0.6])
    normals = sample_normals(mean, fisher, random.random(count), random.random(count))
    assert np.linalg.norm(normals, axis=1) == pytest.approx(1.0)
    # Mean coth k - 1/k, and variance 1 - mean^2 - 2 mean/k, of the cosine of the angle from the mean.
    length = 1.0 / np.tanh(fisher) - 1.0 / fisher if fisher else 0.0
    spread = np.sqrt(1.0 - length**2 - 2.0 * length / fisher) if fisher else np.sqrt(1.0 / 3.0)
    cosines = normals @ mean
    assert abs(cosines.mean() - length) < 4.0 * spread / np.sqrt(count)
    assert cosines.std() == pytest.approx(spread, rel=0.01)
    # Across the mean no direction is preferred.
    sideways = normals.mean(axis=0) - cosines.mean() * mean
    assert np.linalg.norm(sideways) < 4.0 * np.sqrt((1.0 - (cosines**2).mean()) / count)
    if fisher > 5.0:
        assert fisher_estimated(normals) == pytest.approx(fisher, rel=0.02)
        flipped = normals * random.choice([-1.0, 1.0], count)[:, None]
        assert fisher_estimated(flipped) == pytest.approx(fisher, rel=0.02)


def test_p10_follows_from_p32_by_the_mean_cosine():
    assert mean_crossing(np.array([0.0, 0.0, 1.0]), 1e4, line_direction(0.0, 90.0)) == pytest.approx(1.0, abs=2e-4)
    assert mean_crossing(np.array([0.0, 0.0, 1.0]), 1e5, line_direction(77.0, 30.0)) == pytest.approx(0.5, abs=2e-3)
    # Directions without preference meet a line half as often as planes square to it.
    assert mean_crossing(np.array([0.6, 0.0, 0.8]), 0.0, line_direction(10.0, 20.0)) == pytest.approx(0.5, abs=1e-3)
    random = np.random.default_rng(2)
    mean, line = np.array([0.6, 0.0, 0.8]), line_direction(250.0, 5.0)
    normals = sample_normals(mean, 6.0, random.random(400_000), random.random(400_000))
    assert mean_crossing(mean, 6.0, line) == pytest.approx(np.abs(normals @ line).mean(), abs=2e-3)


LAWS = [
    SizeLaw("constant", 2.0), SizeLaw("exponential", 2.0), SizeLaw("exponential", 2.0, diameter_min=1.0, diameter_max=5.0), SizeLaw("lognormal", 2.0, 0.8),
    SizeLaw("lognormal", 2.0, 3.0, diameter_min=0.5, diameter_max=6.0), SizeLaw("power", exponent=3.2, diameter_min=0.5, diameter_max=8.0),
    SizeLaw("power", exponent=1.0, diameter_min=0.5, diameter_max=8.0), SizeLaw("power", exponent=3.0, diameter_min=1.0, diameter_max=3.0),
]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: f"{law.name}-{law.diameter_min:g}")
def test_diameters_have_the_mean_and_the_area_of_their_law(law):
    shares = (np.arange(400_000) + 0.5) / 400_000
    diameters = law.sample(shares)
    assert diameters.mean() == pytest.approx(law.mean, rel=1e-4)
    assert 0.25 * np.pi * (diameters**2).mean() == pytest.approx(law.mean_area, rel=1e-4)
    assert diameters.min() >= law.diameter_min and diameters.max() <= law.largest
    assert np.all(np.diff(diameters) >= 0.0)


def test_means_of_laws_are_those_of_their_formulas():
    assert SizeLaw("exponential", 2.0, diameter_max=200.0).mean == pytest.approx(2.0)
    assert SizeLaw("exponential", 2.0, diameter_max=200.0).mean_area == pytest.approx(0.25 * np.pi * 8.0)
    wide = SizeLaw("lognormal", 2.0, 0.8, diameter_max=1e4)
    assert (wide.mean, wide.mean_area) == pytest.approx((2.0, 0.25 * np.pi * (2.0**2 + 0.8**2)))
    # Of d^-3 between 1 and 3 the mean is (1 - 1/3)/((1 - 1/9)/2).
    assert SizeLaw("power", exponent=3.0, diameter_min=1.0, diameter_max=3.0).mean == pytest.approx(1.5)


def p32_of(joint_set, layout):
    discs = scatter.scattered("sets.csv", joint_set, layout)
    return sum(scatter.area_inside(disc.placed(layout.frame).polygon(), layout) for disc in discs) / (layout.volume + layout.volume_of_holes)


@pytest.mark.parametrize("law", [SizeLaw("constant", 6.0), SizeLaw("power", exponent=2.5, diameter_min=3.0, diameter_max=40.0)], ids=["constant", "power"])
def test_area_per_volume_is_that_wanted_whatever_the_size_of_discs(law, wide):
    normal = np.array([0.0, 0.6, 0.8])
    found = [p32_of(blast_model.JointSet("a", scatter=blast_model.Scatter(normal, 12.0, law, 0.05, seed)), wide) for seed in range(300)]
    # Discs as large as the model reach in from far outside: without them the mean would be far too small.
    error = np.std(found, ddof=1) / np.sqrt(len(found))
    assert error < 0.03 * 0.05
    assert abs(np.mean(found) - 0.05) < 4.0 * error


def test_same_seed_same_discs(wide, written):
    joint_set = blast_model.read_joint_sets(written(SETS + "a,60,30,20,exponential,4,,,1.5,,0.05,3\n"))[0]
    other = blast_model.read_joint_sets(written(SETS + "a,60,30,20,exponential,4,,,1.5,,0.05,4\n"))[0]
    once, again, differs = (scatter.scattered("sets.csv", item, wide) for item in (joint_set, joint_set, other))
    assert len(once) > 20
    assert [disc.centre.tobytes() + disc.normal.tobytes() for disc in once] == [disc.centre.tobytes() + disc.normal.tobytes() for disc in again]
    assert len(once) != len(differs) or not np.array_equal(once[0].centre, differs[0].centre)
    named = blast_model.JointSet("b", scatter=joint_set.scatter)
    assert not np.array_equal(scatter.scattered("sets.csv", named, wide)[0].centre, once[0].centre)


def test_mean_direction_is_that_of_the_pattern_and_not_of_the_model(wide, written):
    joint_set = blast_model.read_joint_sets(written(SETS + "a,60,30,400,constant,4,,,,,0.1,3\n"))[0]
    mean = np.mean([disc.normal for disc in scatter.scattered("sets.csv", joint_set, wide)], axis=0)
    dip = np.radians(60.0)
    expected = [np.sin(dip) * np.sin(np.radians(30.0)), np.sin(dip) * np.cos(np.radians(30.0)), np.cos(dip)]
    assert mean / np.linalg.norm(mean) == pytest.approx(expected, abs=0.02)


def test_area_inside_is_that_of_what_lies_in_the_rock(wide):
    low, high, bench = wide.lower, wide.upper, wide.bench

    def square(corners):
        return scatter.area_inside(np.array(corners, dtype=float), wide)

    level = [(low[0] - 1, low[1] - 1), (high[0] + 1, low[1] - 1), (high[0] + 1, high[1] + 1), (low[0] - 1, high[1] + 1)]
    width = high[1] - low[1]
    assert square([(x, y, -1.0) for x, y in level]) == pytest.approx(width * (bench.crest + (bench.toe - bench.crest) / bench.height - low[0]))
    assert square([(x, y, -bench.height - 1.0) for x, y in level]) == pytest.approx(width * (high[0] - low[0]))
    assert square([(x, y, 0.5) for x, y in level]) == 0.0
    upright = [(low[0] - 1, 0, low[2] - 1), (high[0] + 1, 0, low[2] - 1), (high[0] + 1, 0, 1), (low[0] - 1, 0, 1)]
    assert square(upright) * width == pytest.approx(wide.volume + wide.volume_of_holes)


def test_area_inside_a_block(written):
    pattern = blast_model.read_pattern(written(PATTERN, "pattern.csv"))
    block = blast_model.layout_of(pattern, blast_model.Options(block=True, margin=2.0, size=0.5))
    low, high = block.lower, block.upper
    tilted = np.array([[low[0] - 9, low[1] - 9, -1.0], [high[0] + 9, low[1] - 9, -1.0], [high[0] + 9, high[1] + 9, -1.0], [low[0] - 9, high[1] + 9, -1.0]])
    tilted[:, 2] += 0.1 * tilted[:, 0]
    assert scatter.area_inside(tilted, block) == pytest.approx((high[0] - low[0]) * (high[1] - low[1]) * np.hypot(1.0, 0.1))


def test_short_run_with_sets_keeps_its_energy(jointed, tmp_path):
    results = sazare.run(jointed / "case.toml", tmp_path / "run", overrides={"time.end": 3e-4, "time.history_interval": 1e-5, "time.snapshot_interval": 3e-4}, threads=1, progress=False)
    assert results.figures["explosive_released"] > 0.0
    assert abs(results.figures["energy_residual"]) < 0.02 * results.figures["explosive_work"]


def test_gaps_are_the_least_distances():
    random = np.random.default_rng(5)
    share = np.linspace(0.0, 1.0, 201)
    for _ in range(30):
        p, d, q, e = random.uniform(-1.0, 1.0, (4, 3))
        gap, _ = clearance.segment_gaps(p, d, q, e)
        first, second = p + share[:, None] * d, q + share[:, None] * e
        least = np.linalg.norm(first[:, None] - second[None], axis=2).min()
        assert least - 0.02 < gap <= least + 1e-12
    square = clearance.Polygons.of([np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.0]])], [np.array([0, 0, 1.0])])
    points = np.array([[[0.5, 0.5, 0.3], [0.2, 0.9, -0.1], [1.2, 0.5, 0.1]]])
    assert clearance.corner_gaps(points, square).tolist() == [[0.3, 0.1, np.inf]]
    upright = clearance.Polygons.of([np.array([[0.25, 0.5, -1], [0.75, 0.5, -1], [0.75, 0.5, 1], [0.25, 0.5, 1.0]])], [np.array([0, 1.0, 0])])
    for ring, normal in ((square, upright), (upright, square)):
        meets, ends = clearance.crossings(ring, normal)
        assert meets.tolist() == [True]
        assert sorted(ends[0].tolist()) == [pytest.approx([0.25, 0.5, 0.0]), pytest.approx([0.75, 0.5, 0.0])]
    away = clearance.Polygons(upright.corners + [0.0, 2.0, 0.0], upright.normals)
    assert clearance.crossings(square, away)[0].tolist() == [False]


def field_of(layout, discs):
    return blast_model.joint_field(layout, [disc.returned(layout.frame) for disc in discs])


def test_discs_nearly_the_same_are_one(layout):
    disc = blast_model.Disc(np.array([-0.4, 0.7, -1.3]), np.array([0.0, 0.6, 0.8]), 0.7)
    beside = blast_model.Disc(disc.centre + 0.01 * disc.normal, np.array([0.01, 0.6, 0.8]) / np.linalg.norm([0.01, 0.6, 0.8]), 0.6)
    alone = field_of(layout, [disc])
    assert (alone.rows[0].discs, alone.rows[0].moved, alone.rows[0].left_out) == (1, 0, 0)
    both = field_of(layout, [disc, beside])
    assert both.rows[0].moved + both.rows[0].left_out == 1
    sides = np.linalg.norm(np.diff([found.centre for found in both.discs], axis=0), axis=1)
    assert all(sides > fit.CLEAR * 0.25)


def test_disc_smaller_than_the_elements_is_left_out(layout):
    discs = [blast_model.Disc(np.array([-0.9, 0.7, -2.0]), np.array([0.0, 0.0, 1.0]), radius) for radius in (0.03, 0.4)]
    found = field_of(layout, discs)
    assert [disc.radius for disc in found.discs] == [0.4]
    assert any("smaller than half an element" in note for note in found.notes)


def test_given_discs_come_before_drawn_ones(layout):
    known = blast_model.Disc(np.array([-0.4, 0.7, -1.3]), np.array([0.0, 0.6, 0.8]), 0.5, line=2)
    drawn = blast_model.Disc(known.centre + 0.01 * known.normal, known.normal, 0.7)
    found = field_of(layout, [drawn, known])
    assert np.array_equal(found.discs[0].centre.round(9), known.centre.round(9)) and found.discs[0].line == 2


@pytest.fixture(scope="module")
def jointed(tmp_path_factory):
    """A model with two sets and given discs of a third, its folder, and what was printed of it."""
    folder = tmp_path_factory.mktemp("jointed")
    (folder / "pattern.csv").write_text(PATTERN)
    (folder / "sets.csv").write_text(
        "set,dip [deg],dip_direction [deg],fisher,size_law,diameter [m],p32 [m2/m3],seed,bonded,cohesion [MPa],friction_angle [deg],tensile_strength [MPa]\n"
        "steep,75,120,30,constant,1.2,0.5,4,,1.5,35,0.3\nflat,10,20,50,constant,1.0,0.3,4,no,,,\nfault,,,,,,,,,2,30,0.1\n"
    )
    (folder / "joints.csv").write_text("x,y,z,dip,dip_direction,radius,set\n-0.6,0.7,-1.4,50,300,0.8,fault\n")
    words = ["--burden", "1", "--height", "2", "--margin", "1.2", "--size", "0.5", "--joints", str(folder / "joints.csv"), "--joint-sets", str(folder / "sets.csv")]
    assert main(["blast-model", str(folder / "pattern.csv"), *words, "--out", str(folder / "model")]) == 0
    return folder / "model"


@pytest.fixture(scope="module")
def meshed(jointed):
    """The mesh of the jointed model."""
    mesh = jointed / "model.msh"
    subprocess.run(["gmsh", "-3", "-format", "msh41", "-v", "1", jointed / "model.geo", "-o", mesh], check=True, timeout=300)
    return mesh


def test_every_set_is_a_group_with_a_law_of_its_own(jointed):
    case = tomllib.loads((jointed / "case.toml").read_text())
    laws = {joint["name"]: joint for joint in case["joints"]}
    assert list(laws) == ["rock", "joints_fault", "joints_steep", "joints_flat"]
    assert (laws["joints_steep"]["cohesion"], laws["joints_steep"]["friction_angle"], laws["joints_steep"]["tensile_strength"]) == (1.5e6, 35.0, 3e5)
    assert "friction_coefficient" not in laws["joints_steep"]
    assert laws["joints_fault"]["shear_fracture_energy"] == pytest.approx(0.1 * GRANITE.joint.shear_fracture_energy)
    assert laws["rock"]["shear_fracture_energy"] > 10.0 * GRANITE.joint.shear_fracture_energy
    assert laws["joints_flat"] == {"name": "joints_flat", "surface": "joints_flat", "bonded": False}
    said = sazare.check(jointed / "case.toml")
    assert "warning:" not in said
    assert "joints_flat: on surface joints_flat" in said


def test_groups_have_the_discs_of_their_sets(jointed, meshed, layout):
    sets = blast_model.read_joint_sets(jointed.parent / "sets.csv")
    given = blast_model.read_discs(jointed.parent / "joints.csv")
    field = blast_model.joint_field(layout, given, sets)
    groups = MeshGroups(meshed)
    assert len(field.discs) > 15
    for name in ("fault", "steep", "flat"):
        placed = [disc.placed(layout.frame) for disc in field.discs if disc.set == name]
        faces = np.array(groups.corners(f"joints_{name}", 2))
        area = 0.5 * np.linalg.norm(np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0]), axis=1)
        # Each face lies in the plane and within the corners of a disc of its set, and each disc has what of it is in the rock and not in a hole.
        apart = np.array([np.abs((faces - disc.centre) @ disc.normal).max(axis=1) + (np.linalg.norm(faces - disc.centre, axis=2).max(axis=1) > 1.11 * disc.radius) for disc in placed])
        assert apart.min(axis=0).max() < 1e-5
        inside = [scatter.area_inside(disc.polygon(), layout) for disc in placed]
        for disc, sections, wanted in zip(placed, apart < 1e-5, inside):
            found = area[sections].sum()
            through = sum(crossed(disc, hole) for hole in layout.holes)
            assert found == pytest.approx(wanted, rel=1e-4) if not through else 0.5 * wanted < found < 1.0001 * wanted


def crossed(disc, hole):
    """Whether the plane of a disc meets a hole."""
    ring, way = prism(hole, 8)
    corners = np.concatenate([ring, ring + way])
    heights = (corners - disc.centre) @ disc.normal
    return heights.min() < 0.0 < heights.max()


def test_edges_are_no_shorter_than_a_fifth_of_the_wanted_size(meshed, layout):
    points, blocks = engine().mesh_file(meshed)
    nodes = np.concatenate([nodes for dimension, _, kind, _, nodes in blocks if dimension == 3 and kind == 4])
    quality = mesh_quality.quality_of(points[nodes], layout)
    assert quality.share >= 0.19
    assert quality.worst > 0.02


def test_quality_of_known_tetrahedra(layout):
    regular = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1.0]]) * 0.1 + [-0.9, 0.7, -2.5]
    assert mesh_quality.quality_of(regular[None], layout).worst == pytest.approx(1.0)
    flat = regular.copy()
    flat[:, 2] = -2.5 + 1e-6 * (flat[:, 2] + 2.5)
    found = mesh_quality.quality_of(np.array([regular, flat]), layout)
    assert found.worst < 1e-4 and found.flat == 1 and found.elements == 2
    assert found.shortest == pytest.approx(0.2)
    assert found.share == pytest.approx(0.2 / fit.size_at(found.where, layout))
    assert "warning:" in "\n".join(mesh_quality.Quality(1, 0.01, 0.1, found.where, 0.5, 0).words())


def test_law_of_a_set_takes_the_rest_from_the_rock():
    disc = blast_model.Disc(np.zeros(3), np.array([0.0, 0.0, 1.0]), 1.0, set="a")
    sets = [blast_model.JointSet("a", law={"cohesion": 20e6, "friction_angle": 30.0})]
    entries, notes = joint_entries(GRANITE, [disc], sets, 0.5)
    law = entries[1]
    assert (law.cohesion, law.friction_angle, law.friction_coefficient, law.tensile_strength) == (20e6, 30.0, None, 0.1 * GRANITE.joint.tensile_strength)
    # 20 MPa in elements of 0.5 m need (20 MPa)^2 0.4 m/(2 20 GPa) = 4000 N/m.
    assert law.shear_fracture_energy >= 4000.0
    assert any(note.startswith("shear fracture energy") and "of joints_a" in note for note in notes)


def test_energies_of_a_set_are_a_tenth_of_those_of_the_rock_as_given():
    # In elements of 1 m the rock needs 512 N/m instead of 50; a set with a tenth of its strength needs 5.12 N/m, and has 5 of a tenth.
    disc = blast_model.Disc(np.zeros(3), np.array([0.0, 0.0, 1.0]), 1.0, set="a")
    entries, notes = joint_entries(GRANITE, [disc], [], 1.0)
    assert entries[0].fracture_energy >= 0.5 * GRANITE.joint.tensile_strength**2 * 0.8 / GRANITE.youngs_modulus > GRANITE.joint.fracture_energy
    assert 5.12 <= entries[1].fracture_energy <= 5.3 and entries[1].shear_fracture_energy >= 125.0
    assert any(note.startswith("fracture energy 5.2 N/m, not the 5 N/m of joints_a") for note in notes)
    (_, law), none = joint_entries(GRANITE, [disc], [], 0.2)
    assert (law.fracture_energy, law.shear_fracture_energy, none) == (5.0, 50.0, [])


def test_command_tells_what_was_wanted_and_reached(written, tmp_path, capsys):
    pattern, sets = written(PATTERN, "pattern.csv"), written(SETS + STEEP)
    line = ["blast-model", str(pattern), "--burden", "1", "--height", "2", "--margin", "1.2", "--size", "0.5", "--joint-sets", str(sets)]
    assert main(line) == 0
    said = capsys.readouterr().out
    row = next(text.split() for text in said.splitlines() if text.split()[:1] == ["steep"])
    assert (row[5], row[8]) == ("0.3", "30")
    assert "worst quality" in said and "shortest edge" in said
    page = (tmp_path / "pattern-model/model.md").read_text()
    assert "P32 wanted" in page and "--joint-sets" in page
    once = (tmp_path / "pattern-model/model.geo").read_bytes()
    assert main([*line, "--overwrite"]) == 0
    assert (tmp_path / "pattern-model/model.geo").read_bytes() == once


@pytest.mark.parametrize(
    ("row", "message"),
    [
        ("a,75,120,-3,constant,1,,,,,0.3,1", r"sets.csv:2: error: the Fisher constant is -3\n      help: it is 0"),
        ("a,95,120,3,constant,1,,,,,0.3,1", r"dip is 95 deg\n      help: it is 0 to 90 deg"),
        ("a,75,,3,constant,1,,,,,0.3,1", r"dip_direction is empty"),
        ("a,75,120,3,normal,1,,,,,0.3,1", r"no law of size 'normal' is known\n      help: laws are constant, exponential, lognormal, power"),
        ("a,75,120,3,lognormal,1,,,,,0.3,1", r"the law of size lognormal needs deviation\n      help: it has diameter and deviation"),
        ("a,75,120,3,power,,,2.5,1,,0.3,1", r"the law of size power needs diameter_max"),
        ("a,75,120,3,constant,1,0.2,,,,0.3,1", r"the law of size constant has no deviation"),
        ("a,75,120,3,power,,,2.5,3,1,0.3,1", r"the diameters are from 3 to 1 m"),
        ("a,75,120,3,exponential,1,,,30,,0.3,1", r"nearly all discs of this law are smaller than diameter_min"),
        ("a,75,120,3,constant,0,,,,,0.3,1", r"diameter is 0"),
        ("a,75,120,3,constant,1,,,,,,1", r"there is neither p32 nor p10"),
        ("a,75,120,3,constant,1,,,,,-1,1", r"p32 is -1 m2/m3"),
        ("a,75,120,3,constant,1,,,,,0.3,1.5", r"the seed is 1.5"),
        ("a,75,120,1e300,constant,1,,,,,0.3,1", r"fisher is 1e\+300\n      help: it is at most 1e\+06"),
        ("a,75,120,3,constant,1e300,,,,,0.3,1", r"diameter is 1e\+300 m\n      help: it is at most 100000 m"),
        ("a,75,120,3,power,,,1e300,1,2,0.3,1", r"exponent is 1e\+300\n      help: it is at most 20"),
        ("a,75,120,3,constant,1,,,,,1e300,1", r"p32 is 1e\+300 m2/m3\n      help: it is at most 1000"),
        ("a,75,1e300,3,constant,1,,,,,0.3,1", r"dip_direction is 1e\+300 deg\n      help: it is at most 360"),
        ("a b,75,120,3,constant,1,,,,,0.3,1", r"a set cannot be called 'a b'"),
        ("a,75,120,3,constant,1,,,,,0.3,1\nA,75,120,3,constant,1,,,,,0.3,1", r"sets.csv:3: error: the set A stands in line 2 already"),
    ],
)
def test_wrong_sets_are_told_with_their_line(row, message, written):
    with pytest.raises(ValueError, match=message):
        blast_model.read_joint_sets(written(f"{SETS}{row}\n"))


@pytest.mark.parametrize(
    ("columns", "values", "message"),
    [
        ("bonded,cohesion", "no,1e6", "joints that are not bonded have no cohesion"),
        ("bonded", "perhaps", "bonded is 'perhaps', which is neither true nor false"),
        ("friction_angle,friction_coefficient", "30,0.6", "there are both friction_coefficient and friction_angle"),
        ("tensile_strength [MPa]", "0", "tensile_strength is 0"),
        ("friction_angle,residual_friction_coefficient", "30,0.6", "the residual friction 0.6 is above that at the peak, 0.57735"),
        ("friction_angle", "-10", "friction_angle is -10 deg"),
        ("friction_angle", "95", "friction_angle is 95 deg\n      help: it is 0 to 89 deg"),
        ("friction_coefficient", "-0.1", "friction_coefficient is -0.1"),
        ("cohesion [MPa]", "1e300", "cohesion is 1e\\+306 Pa"),
        ("fracture_energy", "1e300", "fracture_energy is 1e\\+300 N/m"),
        ("p10 [1/m],line_trend,line_plunge", "2,0,90", "there are both p32 and p10"),
    ],
)
def test_wrong_laws_are_told(columns, values, message, written):
    with pytest.raises(ValueError, match=f"sets.csv:2: error: {message}"):
        blast_model.read_joint_sets(written(f"{SETS.strip()},{columns}\n{STEEP.strip()},{values}\n"))


def test_p10_along_a_line_in_the_joints_is_refused(written):
    head = "set,dip,dip_direction,fisher,size_law,diameter,p10 [1/m],line_trend [deg],line_plunge [deg]\n"
    read = blast_model.read_joint_sets(written(f"{head}a,0,0,1e5,constant,1,2,0,90\n"))
    assert read[0].scatter.p32 == pytest.approx(2.0, rel=1e-4)
    with pytest.raises(ValueError, match="lies nearly in the joints of this set"):
        blast_model.read_joint_sets(written(f"{head}a,0,0,1e5,constant,1,2,0,0\n"))
    with pytest.raises(ValueError, match="p10 needs line_trend and line_plunge"):
        blast_model.read_joint_sets(written(f"{head}a,0,0,1e5,constant,1,2,0,\n"))


def test_more_discs_than_a_mesh_can_follow_are_refused(layout, written):
    for p32 in ("40", "999"):
        item = blast_model.read_joint_sets(written(SETS + STEEP.replace("0.3,4", f"{p32},4")))[0]
        with pytest.raises(ValueError, match=re.escape("sets.csv:2: error: the set steep has about") + r".*more than the 300.*\n.*smaller p32"):
            scatter.scattered("sets.csv", item, layout)


def test_set_without_joints_is_refused(written, capsys):
    pattern, sets = written(PATTERN, "pattern.csv"), written("set,cohesion [MPa]\nfault,1\n")
    assert main(["blast-model", str(pattern), "--burden", "1", "--joint-sets", str(sets)]) == 2
    assert "sets.csv:2: error: the set fault has no joints" in capsys.readouterr().err


def test_failed_check_says_what_remains(written, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("sazare.blast_model.command.checked", lambda case, layout: (_ for _ in ()).throw(engine().UserError("gmsh could not mesh it")))
    before = set(tmp_path.parent.iterdir())
    assert main(["blast-model", str(written(PATTERN, "pattern.csv")), "--burden", "1", "--height", "2", "--out", str(tmp_path / "model")]) == 2
    said = capsys.readouterr().err
    assert "gmsh could not mesh it" in said
    assert "keeps what was written" in said and str(tmp_path / "model") in said
    assert (tmp_path / "model/model.geo").exists() and set(tmp_path.parent.iterdir()) == before
