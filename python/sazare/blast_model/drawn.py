"""From a drawing to the tables of a model: holes joined with a table of charges, the bench by its crest and toe, discs of joints."""

import csv
import math
import re
from io import StringIO
from pathlib import Path

import numpy as np

from sazare.blast_model.drawing import Drawing
from sazare.blast_model.pattern import AXES, UNITS
from sazare.blast_model.sheet import Problems, read_sheet

ANY = "*"  # the name of the hole in a table of charges that stands for all that it does not name
OF_CHARGES = {name: unit for name, unit in UNITS.items() if name not in AXES}
STRAIGHT = 0.1  # of the burden, by which a crest may leave its line without a word


def tables_of(path, unit, layers, charges, folder):
    """Writes the tables of a drawing into a folder: (path of the pattern, path of the joints or None, options of a bench, notes).

    layers: by what is on them, `holes` and, where they are wanted, `names`, `crest`, `toe` and a list `joints`. Raises ValueError with what is wrong.
    """
    drawing = Drawing(path, unit)
    holes = drawing.holes(layers["holes"], layers.get("names"))
    texts = {f"{drawing.path.stem}.csv": pattern_text(holes, charges)}
    if layers.get("joints"):
        names = layers["joints"]
        texts[f"{drawing.path.stem}-joints.csv"] = joints_text({_set_of(name) if len(names) > 1 else "": drawing.joints(name) for name in names})
    options, notes = {}, []
    if layers.get("crest"):
        try:
            options, notes = bench_options(holes, drawing.outline(layers["crest"]), drawing.outline(layers["toe"]) if layers.get("toe") else None)
        except BeyondCrest as error:
            raise ValueError(f"{path}: error: {error}") from error
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (folder / name).write_text(text, encoding="utf-8")
    paths = [folder / name for name in texts]
    return paths[0], paths[1] if len(paths) > 1 else None, options, [*drawing.notes, *(f"{path}: {note}" for note in notes)]


class BeyondCrest(ValueError):
    """Holes and edges of a bench do not go together."""


def _set_of(layer):
    return re.sub(r"\W+", "_", layer, flags=re.ASCII).strip("_") or "joints"


def pattern_text(holes, path):
    """The text of a pattern: the holes of a drawing with the charges of a table, a line each.

    path: a table as that of a pattern without coordinates; rows of the hole * are of all holes that it does not name. Raises ValueError with all that is wrong.
    """
    path = Path(path)
    problems = Problems(path)
    rows = read_sheet(path, OF_CHARGES, ("hole", "diameter", "explosive"), problems)
    problems.tell()
    names = [hole.name for hole in holes]
    for row in rows:
        if row.cells["hole"] not in (ANY, *names):
            problems.error(row.line, f"the drawing has no hole {row.cells['hole']!r}", f"its holes are {', '.join(names[:20])}{', ...' if len(names) > 20 else ''}; * is all that have no row")
    columns = [name for name in OF_CHARGES if name != "hole" and any(name in row.cells for row in rows)]
    lines = [["hole", *(f"{name} [m]" for name in AXES), *(_head(name) for name in columns)]]
    for hole in holes:
        mine = [row for row in rows if row.cells["hole"] == hole.name] or [row for row in rows if row.cells["hole"] == ANY]
        if not mine:
            problems.error(rows[0].line, f"no row is of hole {hole.name}", "give it one, or a row of the hole * for all that have none")
        for row in mine:
            lines.append([hole.name, *(_number(value) for value in (*hole.collar, *hole.toe)), *(_number(row.cells.get(name, "")) for name in columns)])
    problems.tell()
    return _text(lines)


def joints_text(discs_by_set):
    """The text of a table of discs, from lists of centre, normal and radius by the name of their set."""
    lines = [["x [m]", "y [m]", "z [m]", "dip [deg]", "dip_direction [deg]", "radius [m]", "set"]]
    for name, discs in discs_by_set.items():
        for centre, normal, radius in discs:
            up = normal if normal[2] >= 0.0 else -normal
            dip, way = math.degrees(math.acos(min(1.0, up[2]))), math.degrees(math.atan2(up[0], up[1])) % 360.0
            lines.append([*(_number(value) for value in (*centre, dip, way, radius)), name])
    return _text(lines)


def bench_options(holes, crest, toe=None):
    """Burden, azimuth and, with the lower edge of the face, height and face angle of a bench, from the corners (n, 3) of its edges; and notes.

    The crest becomes the line that fits it best in plan.
    """
    collars = np.array([hole.collar for hole in holes])
    middle = crest[:, :2].mean(axis=0)
    along = np.linalg.svd(crest[:, :2] - middle)[2][0]
    out = np.array([along[1], -along[0]])
    if out @ (middle - collars[:, :2].mean(axis=0)) < 0.0:
        out = -out
    burden = float(np.min((middle - collars[:, :2]) @ out))
    found = {"burden": burden, "azimuth": math.degrees(math.atan2(out[0], out[1])) % 360.0}
    off = float(np.abs((crest[:, :2] - middle) @ out).max())
    notes = [f"the crest of the drawing bends by {off:.2g} m; the model has the straight one that fits best"] if off > STRAIGHT * abs(burden) else []
    if burden <= 0.0:
        raise BeyondCrest(f"holes stand {-burden:.3g} m beyond the crest of the drawing\n      help: the crest is the upper edge of the free face, in front of all holes; is it on another layer?")
    if toe is not None:
        found["height"] = float(collars[:, 2].mean() - toe[:, 2].mean())
        if found["height"] <= 0.0:
            raise BeyondCrest(f"the toe of the drawing is {-found['height']:.3g} m above the collars\n      help: the toe is the lower edge of the free face; is it on another layer?")
        run = float((toe[:, :2].mean(axis=0) - middle) @ out)
        found["face_angle"] = min(90.0, math.degrees(math.atan2(found["height"], run)))
    return found, notes


def _head(name):
    return f"{name} [{OF_CHARGES[name]}]" if OF_CHARGES[name] not in ("", "-") else name


def _number(value):
    return value if isinstance(value, str) else f"{float(value):.10g}"


def _text(lines):
    file = StringIO()
    csv.writer(file, lineterminator="\n").writerows(lines)
    return file.getvalue()
