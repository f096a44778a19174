"""The model of a case of method mps at t = 0: regions of particles and the sides with conditions."""

import numpy as np

from sazare.model.parts import AXES, BOUNDARY, COLORS, Model, Part, body_color, boundary_words, counted, gauges_at_points, named, without_settling

FREE = 0
SUPPORT = {"fixed": 1, "roller": 1, "prescribed": 2, "viscous": 3, "free_field": 4}  # `support` of the snapshots
SIDES = {"left": (0, -1), "right": (0, 1), "front": (1, -1), "back": (1, 1), "bottom": (None, -1), "top": (None, 1)}  # None: vertical
SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) / 2


preparation = without_settling


def model(opened):
    """What is drawn of the case."""
    dimension = opened.case["particles"]["dimension"]
    grid = opened.first
    places = np.asarray(grid.points) - np.asarray(grid.cell_data["displacement"])
    spacing = opened.case["particles"]["spacing"]
    region = np.asarray(grid.cell_data["region"])
    outlines = _squares(places, spacing) if dimension == 2 else _outsides(places, spacing)
    parts = []
    for number, entry in enumerate(opened.all("regions")):
        count = int(np.sum(region == number))
        if count:
            label = f"{named(entry['name'], opened.material_of(entry['name']))}: {counted(count, 'particle')}"
            parts.append(Part(label, body_color(number), faces=_faces(outlines, region == number), crowd=count))
    parts += _boundaries(opened, places, region, outlines, dimension)
    periodic = opened.case["particles"]["periodic"]
    notes = [f"periodic along {', '.join(periodic)}"] if periodic else []
    return Model(dimension, parts, gauges_at_points(opened), [], opened.gravity, notes)


def _squares(places, spacing):
    """The cell of every particle in the plane: outlines (n, 4, 3), and the particle of each."""
    return places[:, None, :] + spacing * SQUARE, np.arange(len(places))


def _outsides(places, spacing):
    """The sides of the cells of particles that have no neighbour there: outlines (n, 4, 3), and the particle of each."""
    cells = np.round((places - places.min(axis=0)) / spacing).astype(int) + 1
    filled = np.zeros(cells.max(axis=0) + 2, dtype=bool)
    filled[tuple(cells.T)] = True
    faces, owners = [], []
    for axis in range(3):
        square = np.roll(SQUARE, axis + 1, axis=1)
        for side in (-1, 1):
            step = side * np.eye(3, dtype=int)[axis]
            bare = np.flatnonzero(~filled[tuple((cells + step).T)])
            faces.append(places[bare, None, :] + spacing * (square + 0.5 * step))
            owners.append(bare)
    return np.concatenate(faces), np.concatenate(owners)


def _faces(outlines, chosen):
    """The outlines of the chosen particles."""
    faces, owners = outlines
    return faces[chosen[owners]]


def _boundaries(opened, places, region, outlines, dimension):
    """A part for each condition, on the particles of its side; of one that is no plane, on all particles that are held in this manner."""
    support = np.asarray(opened.first.cell_data["support"])
    for entry in opened.all("boundaries"):
        held = _on_side(opened, entry, places, region, dimension) & (support == SUPPORT[entry["kind"]])
        of_region = f" of {entry['region']}" if entry.get("region") else ""
        label = f"{boundary_words(entry)}: {entry['side']}{of_region}, {counted(int(held.sum()), 'particle')}"
        yield Part(label, COLORS[entry["kind"]], BOUNDARY, faces=_faces(outlines, held))


def _on_side(opened, entry, places, region, dimension):
    """Which particles may belong to a boundary: those of the outermost plane, where it is one."""
    inside = np.ones(len(places), dtype=bool)
    if entry.get("region"):
        inside = region == [each["name"] for each in opened.all("regions")].index(entry["region"])
    if entry["side"] == "all" or entry.get("extent") == "surface":
        return inside
    axis, sign = SIDES[entry["side"]]
    height = sign * places[:, dimension - 1 if axis is None else axis]
    return inside & (height > height[inside].max() - 0.5 * opened.case["particles"]["spacing"])
