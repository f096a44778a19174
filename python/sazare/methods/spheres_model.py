"""The model of a case of method spheres at t = 0: groups, walls, periodic sides."""

import numpy as np

from sazare import style
from sazare.model.parts import COLORS, WALL, Arrow, Mark, Model, Part, along, body_color, counted, grouped, listed, moving_words
from sazare.model.water import CORNERS, current_notes, plane_in_box, water_parts

BOX_SIDES = ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5))  # places in CORNERS
MARGIN = 0.12  # of the extent of the body, by which planes go beyond it
NEAR = 10.0  # extents of the body; to a plane that is nearer its picture is widened
HELD_COLOR = "#8c1d1d"


def preparation(case):
    """The settings with which no group falls before the run begins."""
    return [f"spheres.{number}.rain=false" for number, entry in enumerate(case["spheres"]) if entry.get("rain")]


def model(opened):
    """What is drawn of the case."""
    grid = opened.first
    centers, radii, group = np.asarray(grid.points), np.asarray(grid.cell_data["radius"]), np.asarray(grid.cell_data["group"])
    parts, gauges, arrows, notes = [], [], [], []
    recorded = {entry["group"]: entry["name"] for entry in opened.all("gauges")}
    for number, entry in enumerate(opened.all("spheres")):
        own = group == number
        parts.append(Part(_label(entry, own, grid), _color(entry, number), points=centers[own], radii=radii[own], crowd=int(own.sum())))
        middle = np.average(centers[own], axis=0, weights=radii[own] ** 3)
        if entry["name"] in recorded:
            gauges.append(Mark(recorded[entry["name"]], middle))
        if any(entry.get("velocity", ())):
            arrows.append(Arrow(middle, np.array(entry["velocity"]), COLORS["velocity"]))
            notes.append(f"{entry['name']}: initial velocity {along(entry['velocity'], 'm/s')}")
        if entry.get("rain"):
            notes.append(f"{entry['name']}: shown where it begins to rain")
    notes += current_notes(opened)
    bounds = np.array([(centers - radii[:, None]).min(axis=0), (centers + radii[:, None]).max(axis=0)])
    return Model(3, [*parts, *_walls(opened, bounds), *water_parts(opened, _room(opened, bounds))], gauges, arrows, opened.gravity, [*_periodic(opened), *notes])


def _color(entry, number):
    return HELD_COLOR if entry.get("held") else body_color(number)


def _label(entry, own, grid):
    """The group, its material, and how many there are of it."""
    count = counted(int(own.sum()), "sphere")
    if entry.get("shape"):
        bodies = len(np.unique(np.asarray(grid.cell_data["body"])[own]))
        count = f"{style.count(bodies)} × {entry['shape']}, {count} together"
    moves = any(entry.get("velocity", ())) or any(entry.get("angular_velocity", ()))
    held = (", moves at a constant velocity" if moves else ", held") if entry.get("held") else ""
    return f"{entry['name']} ({entry['material']}): {count}{held}"


def _periodic(opened):
    domain = opened.case.get("domain", {})
    lengths = [f"{axis} ({domain['lower'][i]:.3g} to {domain['upper'][i]:.3g} m)" for i, axis in enumerate("xyz") if axis in domain.get("periodic", ())]
    return [f"periodic along {', '.join(lengths)}"] if lengths else []


def _walls(opened, bounds):
    """The walls that stand, and those that move alike."""
    room = _room(opened, bounds)
    for words, alike in grouped(opened.all("walls"), moving_words).items():
        faces = []
        for entry in alike:
            faces += _faces(entry, room)
        label = f"wall {listed(entry['name'] for entry in alike)}{words}"
        yield Part(label, COLORS["velocity" if words else "support"], WALL, faces=faces)


def _room(opened, bounds):
    """The box in which planes are drawn: that of the spheres, of boxes and of the nearest points of planes that are not far, and a margin."""
    middle, extent = bounds.mean(axis=0), np.ptp(bounds, axis=0).max()
    found = [*bounds]
    for entry in opened.all("walls"):
        if entry["shape"] == "box":
            found += [np.array(entry["lower"]), np.array(entry["upper"])]
        if entry["shape"] == "plane":
            normal = np.array(entry["normal"]) / np.linalg.norm(entry["normal"])
            way = ((middle - entry["point"]) @ normal) * normal
            found += [middle - way] if np.linalg.norm(way) < NEAR * extent else []
    low, high = np.min(found, axis=0), np.max(found, axis=0)
    return np.array([low, high]) + MARGIN * (high - low).max() * np.array([[-1.0], [1.0]])


def _faces(entry, room):
    """The outlines of a wall [m]."""
    if entry["shape"] == "plane":
        outline = plane_in_box(np.array(entry["point"], dtype=float), np.array(entry["normal"], dtype=float), room)
        return [outline] if len(outline) > 2 else []
    if entry["shape"] == "box":
        low, high = np.array(entry["lower"]), np.array(entry["upper"])
        corners = low + CORNERS * (high - low)
        return [corners[list(side)] for side in BOX_SIDES]
    return _triangles(entry)


def _triangles(entry):
    """The triangles of the file of a wall [m]."""
    from pathlib import Path

    path = Path(entry["file"])
    if path.suffix.lower() == ".msh":
        from sazare.model.groups import MeshGroups

        return MeshGroups(path, entry["scale"]).corners(entry.get("group") or None, 2)
    import pyvista

    surface = pyvista.STLReader(path).read().triangulate()
    return list(entry["scale"] * np.asarray(surface.points)[np.asarray(surface.faces).reshape(-1, 4)[:, 1:]])
