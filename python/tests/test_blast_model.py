"""Blast models: tables of patterns, layouts, geometries, cases, and a short run of a small bench."""

import json
import subprocess
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest

import sazare
from sazare import blast_model
from sazare.__main__ import main
from sazare.blast_model import joints, pattern, words
from sazare.blast_model.geometry import prism
from sazare.blast_model.layout import azimuth_of, estimated_elements
from sazare.blast_model.rock import GRANITE, softening_in
from sazare.cases import blocks, read_case
from sazare.engine import engine
from sazare.intervals import fits, round_end, round_interval, rounded_up
from sazare.model.groups import MeshGroups

ROOT = Path(__file__).parents[2]
HEAD = "hole,collar_x [m],collar_y [m],collar_z [m],toe_x [m],toe_y [m],toe_z [m],diameter [mm],explosive,stemming [m],delay [ms]"
BENCH = f"""{HEAD}
1,0,0,0,0,0,-2.2,170,ANFO,1,0
2,0,1.5,0,0,1.5,-2.2,170,ANFO,1,1
"""
LEANING = f"""{HEAD}
a,1000,500,30,1000.9,500,25,400,ANFO,2,17
b,1000,503,30,1000.9,503,25,400,TNT,2,0
c,997,501.5,30,997.9,501.5,25,400,PETN 1.26,2,25
"""
CUT = f"""{HEAD}
1,0.9,0,0,0.15,1.5,0,100,PETN 1.26,0.5,0
2,-0.9,0,0,-0.15,1.5,0,100,PETN 1.26,0.5,0
3,0.9,0,0.6,0.15,1.5,0.7,100,PETN 1.26,0.5,1
"""
COARSE = {"burden": 1.0, "height": 2.0, "margin": 1.2, "size": 0.5}


@pytest.fixture
def written(tmp_path):
    """Writes a text as pattern.csv, and returns its path."""

    def write(text, name="pattern.csv"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write


def meshed(layout, folder, discs=()):
    """The groups of the mesh that Gmsh makes of a layout."""
    case = blast_model.write_model(blast_model.BlastModel(layout, GRANITE, joints=blast_model.JointField(list(discs))), folder)
    mesh = folder / "model.msh"
    subprocess.run(["gmsh", "-3", "-format", "msh41", "-v", "1", case.parent / "model.geo", "-o", mesh], check=True, timeout=300)
    return MeshGroups(mesh)


def areas(faces):
    """Vectors with the direction and the area of triangles [m2]."""
    faces = np.array(faces)
    return 0.5 * np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])


def volume(groups):
    a, b, c, d = np.swapaxes(np.array(groups.corners("rock", 3)), 0, 1)
    return float(np.abs(np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a)).sum() / 6.0)


GEOMETRIES = {
    "bench": (BENCH, COARSE, {"free_face", "floor"}),
    "inclined": (LEANING, {"height": 4.0, "face_angle": 80.0, "margin": 3.0, "size": 1.0}, {"free_face", "floor"}),
    "tunnel": (CUT, {"block": True, "size": 0.5}, set()),
}


@pytest.mark.parametrize("name", GEOMETRIES)
def test_mesh_has_the_volume_the_groups_and_the_walls_of_the_design(name, written, tmp_path):
    text, options, faces = GEOMETRIES[name]
    layout = blast_model.layout_of(blast_model.read_pattern(written(text)), blast_model.Options(**options))
    groups = meshed(layout, tmp_path / "model")
    surfaces = set(groups.regions(2))
    assert surfaces == {"top", "base", "sides", *faces, *(hole.surface for hole in layout.holes)}
    # The holes are prisms, so the mesh is exact but for the round-off of the file.
    assert volume(groups) == pytest.approx(layout.volume, rel=1e-9)
    for hole in layout.holes:
        wall = np.array(groups.corners(hole.surface, 2))
        ring, _ = prism(hole, 8)
        side = np.linalg.norm(ring[1] - ring[0])
        lateral, toe = 8.0 * side * hole.length, 0.25 * np.pi * hole.diameter**2
        assert np.linalg.norm(areas(wall), axis=1).sum() == pytest.approx(lateral + toe, rel=1e-6)
        # Every edge of the wall belongs to two faces, but for those around its mouth, which lie in the surface.
        points, corners = np.unique(np.round(wall, 7).reshape(-1, 3), axis=0, return_inverse=True)
        edges = corners.reshape(-1, 3)[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
        pairs, times = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
        assert set(times) == {1, 2}
        assert np.abs(points[pairs[times == 1]][..., 2]).max() < 1e-6
        assert np.count_nonzero(times == 1) >= 8
    if faces:
        slope = np.hypot(layout.bench.height, layout.bench.toe - layout.bench.crest)
        assert np.linalg.norm(areas(groups.corners("free_face", 2)), axis=1).sum() == pytest.approx(slope * (layout.upper - layout.lower)[1])


def test_discs_become_faces_inside_the_rock(written, tmp_path):
    layout = blast_model.layout_of(blast_model.read_pattern(written(BENCH)), blast_model.Options(**COARSE))
    discs = blast_model.read_discs(written("x,y,z,dip,dip_direction,radius\n0.5,0.7,-1.2,20,100,0.4\n-0.7,0.7,-1.5,70,250,0.4\n", "joints.csv"))
    groups = meshed(layout, tmp_path / "model", discs)
    assert volume(groups) == pytest.approx(layout.volume, rel=1e-9)
    found = areas(groups.corners("joints", 2))
    assert np.linalg.norm(found, axis=1).sum() == pytest.approx(2 * np.pi * 0.4**2, rel=1e-6)
    normals = found / np.linalg.norm(found, axis=1)[:, None]
    for disc in discs:
        along = np.abs(normals @ disc.normal) > 1.0 - 1e-6
        assert np.linalg.norm(found[along], axis=1).sum() == pytest.approx(np.pi * 0.4**2, rel=1e-6)
    assert "between joints" not in sazare.check(tmp_path / "model/case.toml")


def test_dip_and_dip_direction_give_the_normal():
    assert joints.upward_normal(0.0, 77.0) == pytest.approx([0, 0, 1])
    # A plane that dips by 30 degrees to the east falls by tan(30) per metre to the east.
    normal = joints.upward_normal(30.0, 90.0)
    assert -normal[0] / normal[2] == pytest.approx(-np.tan(np.radians(30)))
    assert joints.upward_normal(90.0, 0.0) == pytest.approx([0, 1, 0])


def test_case_is_read_back_and_passes_the_check_without_a_warning(written, tmp_path):
    layout = blast_model.layout_of(blast_model.read_pattern(written(BENCH)), blast_model.Options(**COARSE))
    model = blast_model.BlastModel(layout, GRANITE)
    path = blast_model.write_model(model, tmp_path / "model")
    assert read_case(path) == model.case()
    said = sazare.check(path)
    assert "warning:" not in said
    for hole in ("hole_1", "hole_2"):
        around = next(line for line in said.splitlines() if f"{hole}: 0." in line)
        assert float(around.split(":")[1].split()[0]) == pytest.approx(0.17, rel=2e-3)
        assert int(around.split("about")[1].split()[0]) >= 8
    with pytest.raises(ValueError, match="--overwrite"):
        blast_model.write_model(model, tmp_path / "model")


def test_short_run_releases_the_energy_of_the_pattern(written, tmp_path):
    early = BENCH.replace("ANFO,1,1", "ANFO,1,0.35")
    layout = blast_model.layout_of(blast_model.read_pattern(written(early)), blast_model.Options(**COARSE, around=5))
    path = blast_model.write_model(blast_model.BlastModel(layout, GRANITE), tmp_path / "model")
    results = sazare.run(path, tmp_path / "run", overrides={"time.end": 6.5e-4, "time.history_interval": 2.5e-6, "time.snapshot_interval": 6.5e-4}, threads=1, progress=False)
    # ANFO of the table: 931 kg/m3 with 2.484e9 J/m3, in two charges of 1.2 m.
    energy = 2 * 2.484e9 * 0.25 * np.pi * 0.17**2 * 1.2
    assert sum(words.energy_of(deck) for deck in layout.pattern.decks) == pytest.approx(energy, rel=1e-9)
    assert results.figures["explosive_released"] == pytest.approx(energy, rel=1e-9)
    assert 0.0 < results.figures["explosive_work"] < energy
    # The first column of 1.2 m takes 0.29 ms at 4160 m/s, and the second fires at 0.35 ms.
    history = results.history
    row = np.searchsorted(history["time"], 0.32e-3)
    assert (history["1.released"][row], history["2.released"][row]) == pytest.approx((0.5 * energy, 0.0), rel=1e-6)


def test_burden_spacing_and_powder_factor(written):
    layout = blast_model.layout_of(blast_model.read_pattern(written(BENCH)), blast_model.Options(**COARSE))
    assert layout.burdens == [pytest.approx((1.0, 1.0))] * 2
    assert layout.spacings == [pytest.approx(1.5)] * 2
    assert layout.rock_broken == pytest.approx(2 * 1.0 * 1.5 * 2.0)
    mass = 2 * 931 * 0.25 * np.pi * 0.17**2 * 1.2
    assert f"powder factor {mass / 6.0:.3g} kg/m3" in "\n".join(words.summary(layout))


def test_burden_of_an_inclined_face_is_square_to_it(written):
    layout = blast_model.layout_of(blast_model.read_pattern(written(LEANING)), blast_model.Options(burden=3.0, height=4.0, face_angle=70.0))
    assert layout.rows == [[0, 1], [2]]
    low, high = layout.burdens[0]
    assert low == pytest.approx(3.0 * np.sin(np.radians(70)))
    # At the floor the hole has come 4 x 0.9/5 m nearer to the face, which has run 4/tan(70) m ahead.
    assert high == pytest.approx((3.0 - 0.72 + 4.0 / np.tan(np.radians(70))) * np.sin(np.radians(70)))
    assert layout.burdens[2] == pytest.approx((3.0, 3.0))
    assert layout.rock_broken is None
    assert words.azimuth(layout) == pytest.approx(90.0)


def test_face_looks_where_holes_lean_or_fire_first(written):
    def rows(delays):
        holes = [(0, 0), (0, 2), (0, 4), (-3, 0), (-3, 2), (-3, 4)]
        lines = [f"{i},{x},{y},0,{x},{y},-5,100,ANFO,1,{delay}" for i, ((x, y), delay) in enumerate(zip(holes, delays))]
        return blast_model.read_pattern(written("\n".join([HEAD, *lines])))

    assert azimuth_of(rows([0, 0, 0, 25, 25, 25])) == pytest.approx(90.0)
    assert azimuth_of(rows([25, 25, 25, 0, 0, 0])) == pytest.approx(270.0)
    north = LEANING.replace("1000.9,500,", "1000,500.9,").replace("1000.9,503", "1000,503.9").replace("997.9,501.5", "997,502.4")
    assert azimuth_of(blast_model.read_pattern(written(north))) == pytest.approx(0.0)


def test_axes_of_the_model_keep_lengths_and_handedness(written):
    for text, block in ((LEANING, False), (CUT, True)):
        read = blast_model.read_pattern(written(text))
        layout = blast_model.layout_of(read, blast_model.Options(block=block, azimuth=None if block else 37.0))
        assert layout.frame.axes @ layout.frame.axes.T == pytest.approx(np.eye(3))
        assert np.linalg.det(layout.frame.axes) == pytest.approx(1.0)
        assert [hole.length for hole in layout.holes] == pytest.approx([hole.length for hole in read.holes])
        assert all(hole.toe[2] < -1.0 for hole in layout.holes)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"size": 100.0}, r"elements of 100 m are too large: the rock around the holes is 2 m\n      help: --size 1 or less"),
        ({"burden": 30.0, "margin": 40.0, "size": 1.2}, r"the bench is 3 m\n      help: --size 1 or less"),
        ({"size": 1e-4}, r"elements of 0.0001 m would be about .*, more than the 5e\+06 that a run can have\n      help: --size 0.0\d+ has fewer"),
    ],
)
def test_sizes_that_no_mesh_can_have_are_refused(options, message, written):
    with pytest.raises(ValueError, match=message):
        blast_model.layout_of(blast_model.read_pattern(written(f"{HEAD}\n1,0,0,0,0,0,-3.5,250,ANFO,1.5,0\n")), blast_model.Options(**{"burden": 2.0, "height": 3.0, "margin": 2.0, **options}))


@pytest.mark.parametrize("size", [0.5, 1.0])
def test_elements_are_estimated_before_the_mesh(size, written, tmp_path):
    layout = blast_model.layout_of(blast_model.read_pattern(written(f"{HEAD}\n1,0,0,0,0,0,-3.5,250,ANFO,1.5,0\n")), blast_model.Options(burden=2.0, height=3.0, margin=2.0, size=size))
    meshed(layout, tmp_path / "out")
    found = sum(len(nodes) for dimension, _, kind, _, nodes in engine().mesh_file(str(tmp_path / "out/model.msh"))[1] if dimension == 3 and kind == 4)
    assert estimated_elements(layout) == pytest.approx(found, rel=0.35)


@pytest.mark.parametrize("least", [3e-5, 9.49e-3, 0.0123, 1.0, 4.5e-4, 9.99e-3, 0.0282, 2.001e-3])
def test_intervals_fit_round_times(least):
    end, pictures = round_end(least, 20)
    rows = round_interval(end / 1000)
    assert least * (1.0 - 1e-12) <= end <= 1.05 * least
    assert 0.4 * end / 1000 < rows <= end / 1000 * (1.0 + 1e-9) and 20 <= round(end / pictures) <= 51
    one_digit = rounded_up(end, 1)
    for longer, shorter in ((end, rows), (pictures, rows), (end, pictures), (one_digit, rows), (one_digit, pictures)):
        assert fits(shorter, longer)
    assert {f"{value:.0e}"[0] for value in (rows, pictures)} <= {"1", "2", "5"}


def test_fracture_energies_suit_the_elements():
    rock, notes = softening_in(GRANITE, 0.5)
    assert rock.joint.fracture_energy >= 0.5 * 8e6**2 * 0.4 / 50e9
    assert len(notes) == 2
    assert softening_in(GRANITE, 0.01) == (GRANITE, [])


@pytest.mark.parametrize("around, told", [(7, True), (8, False)])
def test_holes_with_few_faces_around_are_told(written, around, told):
    layout = blast_model.layout_of(blast_model.read_pattern(written(BENCH)), blast_model.Options(**COARSE, around=around))
    words = [line for line in blast_model.BlastModel(layout, GRANITE).assumptions if "faces around are coarse" in line]
    assert len(words) == told


def test_distance_of_axes_is_the_least_of_all_points():
    random = np.random.default_rng(3)
    share = np.linspace(0.0, 1.0, 301)[:, None]
    for _ in range(50):
        ends = random.uniform(-1.0, 1.0, (4, 3))
        first, second = ends[0] + share * (ends[1] - ends[0]), ends[2] + share * (ends[3] - ends[2])
        least = np.linalg.norm(first[:, None] - second[None], axis=2).min()
        found = pattern.distance(blast_model.Hole("a", ends[0], ends[1], 0.1), blast_model.Hole("b", ends[2], ends[3], 0.1))
        assert least - 0.012 < found <= least + 1e-12


def test_columns_have_the_units_of_the_keys():
    schema = json.loads(engine().schema_json())
    of_blocks = next(method for method in schema["oneOf"] if "charges" in method["properties"])
    keys = of_blocks["properties"]["charges"]["items"]["properties"]
    assert {key.name for key in fields(blocks.Charge)} == set(keys)
    assert "share" not in pattern.UNITS
    for name in pattern.KEYS:
        unit = pattern.UNITS[name]
        assert (f"[{unit}]" in keys[name]["description"]) if unit not in ("", "-") else "[" not in keys[name]["description"], name


def test_units_of_the_first_line_count(written):
    read = blast_model.read_pattern(written(BENCH.replace("collar_x [m]", "collar_x [ft]").replace("1,0,0,0,0,0,", "1,10,0,0,3.048,0,")))
    assert read.holes[0].collar[0] == pytest.approx(3.048)
    assert (read.holes[0].diameter, read.decks[1].delay) == pytest.approx((0.17, 1e-3))


def test_gas_of_a_hole_may_leave_through_its_collar(written):
    read = blast_model.read_pattern(written(f"{HEAD},vents,stemming_density [g/cm3]\n{GOOD},yes,1.7\n"))
    assert read.decks[0].keys["vents"] is True
    assert read.decks[0].keys["stemming_density"] == pytest.approx(1700.0)
    with pytest.raises(ValueError, match="pattern.csv:2: error: vents is 'perhaps', which is neither true nor false"):
        blast_model.read_pattern(written(f"{HEAD},vents\n{GOOD},perhaps\n"))


def test_energy_of_a_custom_explosive(written):
    columns = f"{HEAD},density,detonation_velocity,gas_exponent,explosive_energy [MJ/kg]"
    rows = [GOOD.replace("ANFO", "custom") + ",800,3000,3,", GOOD.replace("1,0,0,0,0,0", "2,0,3,0,0,3").replace("ANFO", "custom") + ",800,3000,3,2.5"]
    decks = blast_model.read_pattern(written("\n".join([columns, *rows]))).decks
    mass = 800 * 0.25 * np.pi * 0.1**2 * 4.0
    assert [deck.mass for deck in decks] == pytest.approx([mass, mass])
    # D^2/(2 (n^2 - 1)) of a steady detonation, or what is given.
    assert [words.energy_of(deck) for deck in decks] == pytest.approx([mass * 3000.0**2 / 16.0, mass * 2.5e6])


def test_delays_out_of_order_are_told(written):
    notes = blast_model.read_pattern(written(LEANING)).notes
    assert len(notes) == 1
    assert "pattern.csv:3: the delays are not in the order of the rows; the holes fire in this order: b (0 ms), a (17 ms), c (25 ms)" in notes[0]


GOOD = "1,0,0,0,0,0,-5,100,ANFO,1,0"


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([], r"pattern.csv:1: error: the table has no rows"),
        (["1,0,0,0,0,0,-5,100,ANFO,1"], r"pattern.csv:2: error: 10 values where the first line names 11 columns"),
        ([GOOD, "2,0,three,0,0,3,-5,100,ANFO,1,0"], r"pattern.csv:3: error: collar_y is 'three', which is no number"),
        (["1,0,0,0,0,0,nan,100,ANFO,1,0"], r"toe_z is 'nan', which is no number"),
        (["1,0,0,0,0,0,-5,,ANFO,1,0"], r"diameter is empty"),
        (["1,0,0,0,0,0,-5,100,anfo,1,0"], r"no explosive 'anfo' is known; did you mean ANFO\?\n.*ANFO, C-4, .*, TNT, custom"),
        (["1,0,0,0,0,0,-5,100,custom,1,0"], r"a custom explosive needs density"),
        (["1,0,0,0,0,0,-5,100,ANFO,6,0"], r"begins 6 m below the collar and ends at 5 m"),
        (["1,0,0,0,0,0,-5,100,ANFO,-1,0"], r"begins 1 m above the collar"),
        (["1,0,0,0,0,0,-5,0,ANFO,1,0"], r"the diameter of hole 1 is 0 m"),
        (["1,0,0,0,0,0,-5,89000,ANFO,1,0"], r"hole 1 would be 89 m wide"),
        (["1,0,0,0,0,0,-5000,100,ANFO,1,0"], r"hole 1 would be 5000 m long\n.*collar_x \[mm\] or \[ft\]"),
        (["1,0,0,0,0,0,0,100,ANFO,1,0"], r"hole 1 has no length"),
        (["1,0,0,0,0,0,-5,100,ANFO,1,-3"], r"the delay of hole 1 is -0.003 s"),
        ([GOOD, "2,0,0.1,0,0,0.1,-5,100,ANFO,1,0"], r"pattern.csv:3: error: hole 2 nearly touches hole 1 of line 2: their axes come within 0.1 m"),
        ([GOOD, "2,1,0,0,-1,0,-5,100,ANFO,1,0"], r"hole 2 touches hole 1"),
        ([GOOD, GOOD], r"this charge of hole 1 overlaps that of line 2"),
        ([GOOD, "1,0,3,0,0,3,-5,100,ANFO,1,0"], r"hole 1 has another collar, toe or diameter in line 2"),
        (['"a,1",0,0,0,0,0,-5,100,ANFO,1,0'], r"pattern.csv:2: error: a hole cannot be called 'a,1': ',' cannot stand in the name of a column"),
        ([GOOD, "a\"b,0,3,0,0,3,-5,100,ANFO,1,0"], r"pattern.csv:3: error: a hole cannot be called"),
        (["a-1,0,0,0,0,0,-5,100,ANFO,1,0", "a/1,0,3,0,0,3,-5,100,ANFO,1,0"], r"would both be the group hole_a_1"),
    ],
)
def test_wrong_rows_are_told_with_their_line(rows, message, written):
    with pytest.raises(ValueError, match=message):
        blast_model.read_pattern(written("\n".join([HEAD, *rows]) + "\n"))


@pytest.mark.parametrize(
    ("columns", "values", "message"),
    [
        ("charge_diameter [mm]", "120", "a charge 0.12 m wide does not fit into hole 1"),
        ("primer", "0.5", "the primer of hole 1 at 0.5 m is outside its charge from 1 to 5 m"),
        ("bottom", "5.5", "reaches to 5.5 m, and the hole is 5 m long"),
        ("top", "1", "there is both a stemming and a top"),
        ("depth", "1", "there is no column 'depth' in such a table"),
        ("primer [kg]", "1", r"primer cannot have the unit \[kg\]\n      help: its unit is \[m\] or \[mm\]"),
        ("diameter", "0.1", "the column diameter stands there twice"),
        ("density,detonation_velocity", "800,3000", "a custom explosive needs gas_exponent greater than 0\n.*3 is usual"),
        ("density,detonation_velocity,jwl_a [GPa]", "800,3000,50", "a custom explosive needs explosive_energy greater than 0"),
    ],
)
def test_wrong_columns_are_told(columns, values, message, written):
    with pytest.raises(ValueError, match=message):
        good = GOOD.replace("ANFO", "custom") if "density" in columns else GOOD
        blast_model.read_pattern(written(f"{HEAD},{columns}\n{good},{values}\n"))


@pytest.mark.parametrize(("text", "message"), [("", "the file is empty"), ("hole,explosive\n1,ANFO\n", "there is no column collar_x"), (HEAD.replace(",", ";"), "separated by commas")])
def test_what_is_no_table_is_told(text, message, written):
    with pytest.raises(ValueError, match=message):
        blast_model.read_pattern(written(text))


@pytest.mark.parametrize(
    ("text", "words_", "message"),
    [
        (BENCH, [], "nothing says how far the free face is"),
        (BENCH, ["--burden", "0.3"], "pattern.csv:2: error: hole 1 is outside of the bench: at its collar it is 0.3 m from the free face"),
        (BENCH.replace("0,1.5,-2.2", "1.6,1.5,-2.2"), ["--burden", "1", "--azimuth", "90"], "hole 2 is outside of the bench: at its toe it is 0.6 m in front of the free face"),
        (BENCH.replace("2,0,1.5,0,0,1.5,-2.2", "2,0,1.5,-1,0,1.5,-2.2"), ["--burden", "1"], "the collar of hole 2 is 1 m below that of hole 1"),
        (BENCH.replace("2,0,1.5,0,0,1.5,-2.2", "2,0,1.5,0,0,1.5,2.2"), ["--burden", "1"], "hole 2 does not go into the rock"),
        (BENCH, ["--block", "--burden", "1"], "--block has no bench"),
        (BENCH, ["--burden", "1", "--material", "rock"], "--material is one of a case"),
        (BENCH, ["--burden", "1", "--rock", str(ROOT / "cases/column-ricker/case.toml")], "of method mps"),
        (BENCH, ["--burden", "1", "--margin", "0.1"], "are too few"),
        (BENCH, ["--burden", "1", "--k0", "0.5"], "--k0 is of the stress that goes with weight: add --gravity"),
        (BENCH, ["--burden", "1", "--gravity", "--horizontal-stress", "2", "5"], "the larger one comes first"),
        (BENCH, ["--burden", "1", "--gravity", "--horizontal-stress", "5", "2", "--k0", "1"], "keep one of them"),
        (BENCH, ["--burden", "1", "--gravity", "--depth", "30"], "a bench has none"),
        (BENCH, ["--burden", "1", "--gravity", "--stress-azimuth", "30"], "--horizontal-stress LARGER SMALLER"),
    ],
)
def test_command_refuses_what_does_not_go_together(text, words_, message, written, tmp_path, capsys):
    assert main(["blast-model", str(written(text)), "--out", str(tmp_path / "model"), *words_]) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "model").exists()


def test_wrong_discs_are_told(written, tmp_path, capsys):
    path = written("x,y,z,dip,dip_direction,radius\n0,0,-1,120,0,1\n0,0,-1,20,0,-1\n", "joints.csv")
    with pytest.raises(ValueError, match=r"(?s)joints.csv:2: error: the dip is 120.*joints.csv:3: error: the radius is -1"):
        blast_model.read_discs(path)
    path = written("x,y,z,dip,dip_direction,radius\n0,90,-1,12,0,1\n", "joints.csv")
    assert main(["blast-model", str(written(BENCH)), "--burden", "1", "--out", str(tmp_path / "model"), "--joints", str(path)]) == 2
    assert "joints.csv:2: error: this joint does not reach into the rock" in capsys.readouterr().err


def test_command_prints_the_table_and_writes_the_folder(written, tmp_path, capsys):
    path = written(BENCH)
    line = ["blast-model", str(path), "--burden", "1", "--height", "2", "--margin", "1.2", "--size", "0.5", "--rock", str(ROOT / "cases/uniaxial-compression/case.toml")]
    assert main(line) == 0
    said = capsys.readouterr().out
    folder = tmp_path / "pattern-model"
    assert {file.name for file in folder.iterdir()} == {"model.geo", "case.toml", "model.md"}
    for part in ("powder factor", "burden [m]", "cost", "elements", "rock of ", "run ends at"):
        assert part in said
    assert "warning:" not in said
    assert "rock: rock of" in (folder / "model.md").read_text().lower()
    assert main(line) == 2
    assert "--overwrite replaces them" in capsys.readouterr().err
    (folder / "notes.txt").write_text("mine")
    assert main([*line, "--overwrite"]) == 0
    assert (folder / "notes.txt").read_text() == "mine"


def stress_of(case, point, density=2600.0):
    """Stress [Pa] (3, 3), tension positive, that a case has at a point [m], as docs/theory/blocks.md says."""
    stress, up = case.initial_stress, -np.array(case.gravity.acceleration) / 9.81
    depth = stress.datum - up @ point
    if stress.k0 is not None:
        vertical = -density * 9.81 * depth
        return vertical * (np.outer(up, up) + stress.k0 * (np.eye(3) - np.outer(up, up)))
    xx, yy, zz = np.array(stress.normal_stress) + depth * np.array(stress.normal_stress_per_depth)
    xy, yz, zx = stress.shear_stress
    return np.array([[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]])


@pytest.mark.parametrize("name", ["inclined", "tunnel"])
def test_stress_of_the_ground_is_that_of_the_weight_and_of_the_given_directions(name, written):
    text, options, _ = GEOMETRIES[name]
    layout = blast_model.layout_of(blast_model.read_pattern(written(text)), blast_model.Options(**options))
    point = layout.frame.origin + np.array([0.7, 1.1, -3.0])  # 3 m below the first collar
    vertical = 2600.0 * 9.81 * 203.0
    for ground, horizontal in (
        (blast_model.Ground(200.0, 0.8), 0.8 * vertical * np.diag([1.0, 1.0, 0.0])),
        # 12 MPa to the north-east, 5 MPa to the north-west.
        (blast_model.Ground(200.0, None, (12e6, 5e6), 45.0), np.array([[8.5e6, 3.5e6, 0], [3.5e6, 8.5e6, 0], [0, 0, 0.0]])),
    ):
        case = blast_model.BlastModel(layout, GRANITE, ground=ground).case()
        axes = layout.frame.axes
        assert axes.T @ np.array(case.gravity.acceleration) == pytest.approx([0.0, 0.0, -9.81])
        found = axes.T @ stress_of(case, layout.frame.place(point)) @ axes
        assert found == pytest.approx(-horizontal - np.diag([0.0, 0.0, vertical]), abs=1.0)


def test_ground_without_k0_cannot_widen(written):
    layout = blast_model.layout_of(blast_model.read_pattern(written(BENCH)), blast_model.Options(**COARSE))
    case = blast_model.BlastModel(layout, GRANITE, ground=blast_model.Ground()).case()
    assert case.initial_stress.k0 == pytest.approx(0.25 / 0.75)


@pytest.mark.parametrize(
    ("text", "extra"),
    [
        (BENCH, ["--burden", "1", "--height", "2", "--margin", "1.2", "--k0", "1.5"]),
        (BENCH, ["--burden", "1", "--height", "2", "--margin", "1.2", "--horizontal-stress", "2", "1", "--stress-azimuth", "20"]),
        (CUT, ["--block", "--depth", "300", "--horizontal-stress", "12", "8"]),
    ],
)
def test_stress_inside_is_balanced_and_what_is_cut_is_told(text, extra, written, tmp_path, capsys):
    assert main(["blast-model", str(written(text)), "--size", "0.5", "--gravity", *extra, "--out", str(tmp_path / "model")]) == 0
    said = capsys.readouterr().out
    assert "stress at the deepest toe" in said and "lose their stress then" in said
    # Inside, stress and weight leave nothing; what is left is that of the free faces.
    assert said.count("warning:") == 1 and "stress and weight leave a force of (0, 0, 0) N" in said
    page = (tmp_path / "model/model.md").read_text()
    assert "--gravity" in page and all(word in page for word in extra)


@pytest.mark.parametrize("name", GEOMETRIES)
def test_gauges_are_spread_away_from_the_charges(name, written):
    text, options, _ = GEOMETRIES[name]
    layout = blast_model.layout_of(blast_model.read_pattern(written(text)), blast_model.Options(**options))
    model = blast_model.BlastModel(layout, GRANITE)
    points = {gauge.name: np.array(gauge.point) for gauge in model.case().gauges}
    line = [point for gauge, point in points.items() if gauge.endswith("at depth")]
    assert len(points) == len({tuple(point) for point in points.values()}) >= 9

    def away(point):
        ends = [(hole.collar + hole.direction * deck.top, hole.collar + hole.direction * deck.bottom) for hole, deck in zip(layout.holes, layout.pattern.decks)]
        return min(pattern.distance(blast_model.Hole("g", point, point + [0, 0, 1e-9], 0.1), blast_model.Hole("h", *pair, 0.1)) for pair in ends)

    distances = [away(point) for point in line]
    assert len(line) == 6 and np.all(np.diff(distances) > 0.0)
    assert distances[-1] / distances[0] > 2.0
    assert distances[0] > 2.0 * max(hole.diameter for hole in layout.holes)
    for point in points.values():
        assert np.all(point > layout.lower) and np.all(point < layout.upper)
