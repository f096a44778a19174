"""Drill patterns in drawings: holes, names, units, crest and toe, joints, and what is wrong with them."""

import sys

import numpy as np
import pytest

from sazare import blast_model
from sazare.__main__ import main
from sazare.blast_model.drawing import Drawing
from sazare.blast_model.drawn import bench_options, joints_text, pattern_text

ezdxf = pytest.importorskip("ezdxf", reason="reading drawings takes ezdxf, which is optional")
TextEntityAlignment = pytest.importorskip("ezdxf.enums").TextEntityAlignment
CHARGES = """hole,diameter [mm],explosive,stemming [m],delay [ms]
*,170,ANFO,1,0
B2,170,ANFO,1.2,25
"""
HOLES = {"B1": ((100.0, 50.0, 30.0), (100.5, 50.0, 27.8)), "B2": ((100.0, 51.5, 30.0), (100.5, 51.5, 27.8))}


@pytest.fixture
def drawn(tmp_path):
    """Writes a drawing of two holes, with names, crest, toe and joints, in a unit of so many metres."""

    def write(metre=1.0, units=6, names=True, name="plan.dxf"):
        drawing = ezdxf.new(units=units)
        space = drawing.modelspace()

        def at(point):
            return tuple(np.array(point) / metre)

        for number, (label, (collar, toe)) in enumerate(HOLES.items()):
            if number:
                space.add_polyline3d([at(toe), at(np.add(collar, toe) / 2.0), at(collar)], dxfattribs={"layer": "DRILL"})
            else:
                space.add_line(at(collar), at(toe), dxfattribs={"layer": "DRILL"})
            if names:
                text = space.add_text(label, dxfattribs={"layer": "DRILL"})
                text.set_placement(at((collar[0] + 0.2, collar[1] + 0.1, 0.0)), align=TextEntityAlignment.MIDDLE_CENTER if number else TextEntityAlignment.LEFT)
        space.add_polyline3d([at((102.0, 40.0, 30.0)), at((102.0, 60.0, 30.0))], dxfattribs={"layer": "CREST"})
        space.add_lwpolyline([at((102.5, 40.0)), at((102.5, 60.0))], dxfattribs={"layer": "TOE", "elevation": 28.0 / metre})
        # A face that dips by 60 degrees to the east, and an upright circle that looks to the north.
        fall = np.tan(np.radians(60.0))
        space.add_3dface([at((99.0, 50.0, 29.0)), at((99.0, 51.0, 29.0)), at((99.2, 51.0, 29.0 - 0.2 * fall)), at((99.2, 50.0, 29.0 - 0.2 * fall))], dxfattribs={"layer": "JOINTS"})
        circle = space.add_circle((0, 0, 0), 0.4 / metre, dxfattribs={"layer": "JOINTS", "extrusion": (0, 1, 0)})
        circle.dxf.center = circle.ocs().from_wcs(at((99.3, 50.5, 27.8)))
        path = tmp_path / name
        drawing.saveas(path)
        return path

    return write


@pytest.fixture
def charges(tmp_path):
    path = tmp_path / "charges.csv"
    path.write_text(CHARGES)
    return path


@pytest.mark.parametrize(("metre", "units"), [(1.0, 6), (1e-3, 4), (0.3048, 2), (0.0254, 1)])
def test_holes_come_out_in_metres_with_their_names(metre, units, drawn):
    holes = Drawing(drawn(metre, units)).holes("drill")
    assert [hole.name for hole in holes] == ["B1", "B2"]
    for hole, (collar, toe) in zip(holes, HOLES.values()):
        assert (hole.collar.tolist(), hole.toe.tolist()) == (pytest.approx(collar), pytest.approx(toe))


def test_holes_without_text_are_numbered(drawn):
    drawing = Drawing(drawn(names=False))
    assert [hole.name for hole in drawing.holes("DRILL")] == ["1", "2"]
    assert any("numbered" in note for note in drawing.notes)


def test_unit_can_be_given(drawn):
    hole = Drawing(drawn(1e-3, 0), "mm").holes("DRILL")[0]
    assert hole.collar.tolist() == pytest.approx(HOLES["B1"][0])
    unitless = Drawing(drawn(1.0, 0))
    assert unitless.holes("DRILL")[0].collar.tolist() == pytest.approx(HOLES["B1"][0])
    assert "names no unit; coordinates are taken for metres" in unitless.notes[0]


@pytest.mark.parametrize(("metre", "units", "meant"), [(1e-3, 0, "mm"), (1.0, 4, "m"), (1e-3, 6, "mm")])
def test_wrong_unit_is_refused_with_the_likely_one(metre, units, meant, drawn):
    with pytest.raises(ValueError, match=rf"the unit is wrong; coordinates look like (cm or )?{meant}"):
        Drawing(drawn(metre, units)).holes("DRILL")


@pytest.mark.parametrize(("metre", "units", "given", "message"), [
    (1.0, 4, None, "the holes are too short: half of them have 0.00[0-9]* m or less, with coordinates in mm (as its header says)"),
    (1e-3, 6, None, "the holes are too long: half of them have [0-9]* m or more, with coordinates in m (as its header says)"),
    (1e-3, 0, None, "in m (since its header names no such unit)"),
    (1.0, 6, "mm", "the holes are too short: half of them have 0.00[0-9]* m or less, with coordinates in mm (as --dxf-unit says)"),
])
def test_wrong_unit_says_in_which_way_it_is_wrong(metre, units, given, message, drawn):
    with pytest.raises(ValueError, match=message.replace("(", r"\(").replace(")", r"\)")):
        Drawing(drawn(metre, units), given).holes("DRILL")


@pytest.mark.parametrize("value", [float("inf"), float("nan"), 1e300])
@pytest.mark.parametrize(("kind", "layer"), [("LINE", "DRILL"), ("TEXT", "DRILL"), ("POLYLINE", "CREST"), ("LWPOLYLINE", "TOE"), ("CIRCLE", "JOINTS"), ("3DFACE", "JOINTS")])
def test_coordinates_that_are_no_place_are_told_at_their_entity(kind, layer, value, drawn, recwarn):
    path = drawn()
    drawing = ezdxf.readfile(path)
    item = next(item for item in drawing.modelspace() if item.dxftype() == kind and item.dxf.layer == layer)
    if kind == "POLYLINE":
        item.vertices[0].dxf.location = (value, 0.0, 0.0)
    elif kind == "LWPOLYLINE":
        item.set_points([(value, 0.0), (1.0, 0.0)], format="xy")
    else:
        setattr(item.dxf, {"LINE": "start", "TEXT": "insert", "CIRCLE": "center", "3DFACE": "vtx0"}[kind], (value, 0.0, 0.0))
    drawing.saveas(path)
    read = {"DRILL": "holes", "CREST": "outline", "TOE": "outline", "JOINTS": "joints"}[layer]
    with pytest.raises(ValueError, match=rf"the {kind} {item.dxf.handle} of the layer '{layer}' has a coordinate {value:g}".replace("+", r"\+")):
        getattr(Drawing(path), read)(layer)
    assert not [one for one in recwarn if issubclass(one.category, RuntimeWarning)]


def test_pattern_joins_holes_and_charges(drawn, charges, tmp_path):
    table = tmp_path / "pattern.csv"
    table.write_text(pattern_text(Drawing(drawn()).holes("DRILL"), charges))
    pattern = blast_model.read_pattern(table)
    assert [(deck.hole.name, deck.top, deck.delay) for deck in pattern.decks] == [("B1", 1.0, 0.0), ("B2", 1.2, 0.025)]
    assert pattern.holes[1].diameter == pytest.approx(0.17)
    assert pattern.holes[1].toe == pytest.approx(HOLES["B2"][1])


def test_bench_follows_from_crest_and_toe(drawn):
    drawing = Drawing(drawn())
    options, notes = bench_options(drawing.holes("DRILL"), drawing.outline("CREST"), drawing.outline("TOE"))
    assert options == {"burden": pytest.approx(2.0), "azimuth": pytest.approx(90.0), "height": pytest.approx(2.0), "face_angle": pytest.approx(np.degrees(np.arctan2(2.0, 0.5)))}
    assert notes == []
    bent = np.array([[102.0, 40.0, 30.0], [102.6, 50.0, 30.0], [102.0, 60.0, 30.0]])
    assert "bends by 0.4 m" in bench_options(drawing.holes("DRILL"), bent)[1][0]


def test_faces_and_circles_become_discs(drawn, tmp_path):
    table = tmp_path / "joints.csv"
    table.write_text(joints_text({"a": Drawing(drawn()).joints("JOINTS")}))
    face, circle = blast_model.read_discs(table)
    assert face.area == pytest.approx(1.0 * 0.2 / np.cos(np.radians(60.0)))
    assert face.normal == pytest.approx([np.sin(np.radians(60.0)), 0.0, np.cos(np.radians(60.0))])
    assert face.centre == pytest.approx([99.1, 50.5, 29.0 - 0.1 * np.tan(np.radians(60.0))])
    assert (circle.centre.tolist(), circle.radius, circle.set) == (pytest.approx([99.3, 50.5, 27.8]), pytest.approx(0.4), "a")
    assert abs(circle.normal) == pytest.approx([0.0, 1.0, 0.0], abs=1e-12)


def test_command_makes_a_model_of_a_drawing(drawn, charges, tmp_path, capsys):
    line = ["blast-model", str(drawn(1e-3, 4)), "--layer-holes", "DRILL", "--charges", str(charges), "--layer-crest", "CREST", "--layer-toe", "TOE", "--layer-joints", "JOINTS"]
    assert main([*line, "--margin", "1.5", "--size", "0.5"]) == 0
    said = capsys.readouterr().out
    folder = tmp_path / "plan-model"
    assert {file.name for file in folder.iterdir()} == {"plan.csv", "plan-joints.csv", "case.toml", "model.geo", "model.md"}
    assert "bench 2 m high, free face 75.96 degrees steep, looking to 90 degrees" in said
    assert "warning:" not in said
    # The table is the pattern from then on.
    assert main(["blast-model", str(folder / "plan.csv"), "--burden", "2", "--height", "2", "--margin", "1.5", "--size", "0.5", "--out", str(tmp_path / "again")]) == 0
    assert "--layer-joints JOINTS" in (folder / "model.md").read_text()
    assert main([*line, "--margin", "1.5", "--size", "0.5", "--burden", "1.8", "--out", str(tmp_path / "nearer")]) == 0
    rows = [text.split() for text in capsys.readouterr().out.splitlines() if text.split()[:1] == ["B1"]]
    assert rows[-1][1] == "1.75"  # 1.8 m sin 75.96 degrees
    assert main([*line, "--margin", "1.5"]) == 2
    assert "--overwrite" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--layer-holes", "HOLES"], "nothing is drawn on a layer 'HOLES'\n      help: layers with something on them are CREST (1), DRILL (4), JOINTS (2), TOE (1)"),
        (["--layer-holes", "JOINTS"], "the layer 'JOINTS' has no lines"),
        (["--layer-holes", "DRILL", "--layer-names", "TOE"], "the layer 'TOE' has no text"),
        (["--layer-holes", "DRILL", "--layer-joints", "TOE"], "the layer 'TOE' has no circles or 3-D faces"),
        (["--layer-holes", "DRILL", "--layer-toe", "TOE"], "--layer-crest NAME"),
        (["--layer-holes", "DRILL", "--layer-crest", "JOINTS"], "the layer 'JOINTS' has no lines"),
        (["--layer-holes", "DRILL", "--dxf-unit", "mm"], "the unit is wrong; coordinates look like m: --dxf-unit m"),
        ([], "--layer-holes NAME says on which layer the holes are"),
    ],
)
def test_wrong_layers_are_told(words, message, drawn, charges, tmp_path, capsys):
    assert main(["blast-model", str(drawn()), "--charges", str(charges), "--burden", "2", "--out", str(tmp_path / "model"), *words]) == 2
    assert message in capsys.readouterr().err
    assert not (tmp_path / "model").exists()


def test_wrong_charges_are_told_with_their_line(drawn, charges):
    holes = Drawing(drawn()).holes("DRILL")
    charges.write_text(CHARGES + "B7,170,ANFO,1,0\n")
    with pytest.raises(ValueError, match=r"charges.csv:4: error: the drawing has no hole 'B7'\n      help: its holes are B1, B2"):
        pattern_text(holes, charges)
    charges.write_text(CHARGES.replace("*,170,ANFO,1,0\n", ""))
    with pytest.raises(ValueError, match=r"no row is of hole B1"):
        pattern_text(holes, charges)


def test_bent_hole_and_shared_text_are_told(tmp_path):
    drawing = ezdxf.new(units=6)
    space = drawing.modelspace()
    space.add_polyline3d([(0, 0, 0), (0.5, 0, -3), (0, 0, -6)], dxfattribs={"layer": "bent"})
    for x in (0, 2):
        space.add_line((x, 0, 0), (x, 0, -6), dxfattribs={"layer": "two"})
    space.add_text("1", dxfattribs={"layer": "two", "insert": (1, 0)})
    drawing.saveas(tmp_path / "a.dxf")
    with pytest.raises(ValueError, match="bends by 0.5 m"):
        Drawing(tmp_path / "a.dxf").holes("bent")
    with pytest.raises(ValueError, match="the text '1' is the nearest to two holes, 1 and 2 of the file"):
        Drawing(tmp_path / "a.dxf").holes("two")


def test_what_is_no_drawing_is_told(tmp_path, charges, monkeypatch, capsys):
    path = tmp_path / "plan.dxf"
    path.write_text("no drawing")
    with pytest.raises(ValueError, match="this is no drawing in the format DXF"):
        Drawing(path)
    with pytest.raises(OSError, match="cannot be read"):
        Drawing(tmp_path / "missing.dxf")
    assert main(["blast-model", str(charges), "--layer-holes", "DRILL"]) == 2
    assert "--layer-holes is of drawings" in capsys.readouterr().err
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    with pytest.raises(ValueError, match="pip install ezdxf"):
        Drawing(path)
