"""The model of a case of method rectangles at t = 0: blocks, walls, rollers, base friction."""

import numpy as np

from sazare.methods.rectangles import CIRCLE, POLYGON, RECTANGLE
from sazare.model.parts import COLORS, WALL, Arrow, Model, Part, along, body_color, counted, gauges_at_points, grouped, listed, moving_words

MOST_BLOCKS = 6  # with a colour of their own


def model(opened):
    """What is drawn of the case."""
    return Model(2, [*_blocks(opened), *_supports(opened)], gauges_at_points(opened), _velocities(opened), opened.gravity, _notes(opened))


def _blocks(opened):
    """The elements by block or, where there are many blocks, by material."""
    grid = opened.first
    corners = np.split(np.asarray(grid.points), np.asarray(grid.offset)[1:-1])
    block, kind = np.asarray(grid.cell_data["block"]), np.asarray(grid.cell_data["kind"])
    entries = opened.all("blocks")
    numbers = {id(entry): number for number, entry in enumerate(entries)}
    many = len(entries) > MOST_BLOCKS
    for place, (name, members) in enumerate(grouped(entries, lambda entry: entry["material" if many else "name"]).items()):
        own = np.isin(block, [numbers[id(entry)] for entry in members])
        outlined = np.flatnonzero(own & np.isin(kind, (RECTANGLE, POLYGON)))
        round_ones = [corners[i] for i in np.flatnonzero(own & (kind == CIRCLE))]
        words = f"{name}: {counted(len(members), 'block')}" if many else f"{name} ({members[0]['material']})"
        label = f"{words}, {counted(int(own.sum()), 'element')}" if many else f"{words}: {counted(int(own.sum()), 'element')}"
        yield Part(
            label, body_color(place), faces=[corners[i] for i in outlined], points=np.reshape([each.mean(axis=0) for each in round_ones], (-1, 3)),
            radii=np.array([0.5 * np.linalg.norm(each[1] - each[0]) for each in round_ones]), crowd=int(own.sum()),
        )


def _supports(opened):
    """Walls and rollers: those that stand, and those that move alike."""
    for kind, entries in (("wall", opened.all("walls")), ("roller", opened.all("rollers"))):
        for words, alike in grouped(entries, moving_words).items():
            label = f"{kind} {listed(entry['name'] for entry in alike)}{words}"
            color = COLORS["velocity" if words else "support"]
            if kind == "wall":
                yield Part(label, color, WALL, lines=np.array([[entry["from"], entry["to"]] for entry in alike], dtype=float))
            else:
                yield Part(label, color, WALL, points=np.array([entry["center"] for entry in alike], dtype=float),
                           radii=np.array([entry["radius"] for entry in alike], dtype=float))


def _velocities(opened):
    """An arrow at each support that moves with a constant velocity."""
    walls = [(np.mean([entry["from"], entry["to"]], axis=0), entry.get("velocity", ())) for entry in opened.all("walls")]
    rollers = [(np.array(entry["center"]), entry.get("velocity", ())) for entry in opened.all("rollers")]
    return [Arrow(point, np.array(velocity), COLORS["velocity"]) for point, velocity in walls + rollers if any(velocity)]


def _notes(opened):
    plate = opened.case.get("base_friction", {})
    if not plate.get("friction_coefficient"):
        return []
    moves = f", pulled with {along(plate['velocity'], 'm/s')}" if any(plate["velocity"]) else ""
    return [f"lies on a plate with friction {plate['friction_coefficient']:g}{moves}"]
