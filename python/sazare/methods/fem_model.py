"""The model of a case of method fem at t = 0: regions, boundaries, loads, water, joints."""

import numpy as np

from sazare import style
from sazare.methods.fem import outlines
from sazare.model.parts import (
    BOUNDARY, COLORS, LOAD, Arrow, Model, Part, along, body_color, boundary_words, counted, gauges_at_points, grouped, listed, named, surface_part, without_settling,
)
from sazare.outside import outer_faces

MOST_ARROWS = 12  # of a load
WAVE_ARROWS = 5
WATER, DRAIN, TIED = "#2b6cb0", "#00a0b8", "#4f7a00"


def preparation(case):
    """Ground does not settle first, so there is no gravity, and water, which requires gravity, is left out."""
    settings = without_settling(case)
    return [*settings, "water_pressures=[]"] if settings and case.get("water_pressures") else settings


def model(opened):
    """What is drawn of the case."""
    dimension = opened.case["mesh"]["dimension"]
    parts = [*_regions(opened, dimension), *_members(opened), *_joints(opened, dimension), *_boundaries(opened, dimension), *_ties(opened, dimension)]
    loads = [(entry, surface_part(opened, [entry["group"]], dimension, _load_label(entry), COLORS["load"], LOAD)) for entry in opened.all("loads")]
    waters = [part for entry in opened.all("water_pressures") for part in _water(opened, entry, dimension)]
    waters += [surface_part(opened, [entry["group"]], dimension, f"drain: {entry['group']}", DRAIN, LOAD) for entry in opened.all("drains")]
    center = np.asarray(opened.first.points).mean(axis=0)
    arrows = [arrow for entry, part in loads for arrow in _load_arrows(entry, part, center)] + _wave_arrows(opened, dimension)
    return Model(dimension, [*parts, *(part for _, part in loads), *waters], gauges_at_points(opened), arrows, opened.gravity, up=dimension - 1)


def _regions(opened, dimension):
    """The elements by region: all of a plane mesh, of one in space those outside."""
    grid = opened.first
    names = np.array(opened.groups.regions(dimension))[np.asarray(grid.cell_data["region"])]
    if dimension == 2:
        faces, cells = [np.asarray(grid.points)[outline] for outline in outlines(grid)], np.arange(grid.n_cells)
    else:
        faces, cells = outer_faces(grid)
    for place, name in enumerate(dict.fromkeys(names)):
        chosen, count = np.flatnonzero(names[cells] == name), int(np.sum(names == name))
        label = f"{named(name, opened.material_of(name))}: {counted(count, 'element')}"
        yield Part(label, body_color(place), faces=[faces[i] for i in chosen], crowd=count)


def _joints(opened, dimension):
    for entry in opened.all("joints"):
        yield from _joint(opened, entry, dimension, f"joint: {entry['name']}", COLORS["joint"])


def _water(opened, entry, dimension):
    """The faces under a water, or the joint that it is in."""
    level = style.quantity(entry["level"], "m")
    if entry.get("far_level") is not None:
        level += f" to {style.quantity(entry['far_level'], 'm')}"
    label = f"water {entry['name']}: level {level}"
    if entry.get("group"):
        yield surface_part(opened, [entry["group"]], dimension, label, WATER, LOAD)
        return
    for joint in opened.all("joints"):
        if joint["name"] == entry["joint"]:
            yield from _joint(opened, joint, dimension, label, WATER)


def _joint(opened, entry, dimension, label, color):
    if entry.get("group"):
        yield surface_part(opened, [entry["group"]], dimension, label, color)
    elif dimension == 2:
        yield Part(label, color, BOUNDARY, lines=opened.groups.shared_edges(*entry["between"]))
    else:
        yield Part(label, color, BOUNDARY, points=opened.groups.shared_points(*entry["between"], 3))


def _boundaries(opened, dimension):
    wave = opened.case.get("incident_wave")
    enters = f", {wave['kind']} wave of {wave['motion']} enters at {wave['angle']:g} deg" if wave else ""
    for words, entries in grouped(opened.all("boundaries"), lambda entry: boundary_words(entry) + enters * (entry["kind"] == "viscous")).items():
        names = [entry["group"] for entry in entries]
        yield surface_part(opened, names, dimension, f"{words}: {listed(names)}", COLORS[entries[0]["kind"]], BOUNDARY, names)


def _ties(opened, dimension):
    for entry in opened.all("ties"):
        names = [entry["group"], entry["opposite"]]
        yield surface_part(opened, names, dimension, f"tied: {names[0]} to {names[1]}", TIED, BOUNDARY, names)


def _members(opened):
    for entry in opened.all("members"):
        label = f"{entry['kind']}: {entry['name']}"
        if entry.get("group"):
            yield surface_part(opened, [entry["group"]], 2, label, style.INK)
        else:
            yield Part(label, style.INK, BOUNDARY, lines=np.array([[entry["from"], entry["to"]]], dtype=float))


def _wave_arrows(opened, dimension):
    """Where an incident wave enters through the base, and how it travels."""
    wave = opened.case.get("incident_wave")
    bases = [entry["group"] for entry in opened.all("boundaries") if entry["kind"] == "viscous"]
    if not wave or not bases:
        return []
    part = surface_part(opened, bases, dimension, "", COLORS["viscous"])
    pieces = _middles(part)
    angle, azimuth = np.radians(wave["angle"]), np.radians(wave.get("azimuth", 0.0))
    travels = np.zeros(3)
    travels[:2] = np.sin(angle) * np.cos(azimuth), np.sin(angle) * np.sin(azimuth)
    travels[dimension - 1] = np.cos(angle)
    return [Arrow(place, travels, COLORS["viscous"], True) for place in _some(pieces, WAVE_ARROWS)]


def _load_label(entry):
    ramp = f", growing over {style.quantity(entry['ramp'], 's')}" if entry["ramp"] else ""
    return f"load {entry['name']}: {along(entry['traction'], 'Pa')}{ramp}"


def _load_arrows(entry, part, center):
    """Some arrows of a load: that push the body end on it, that pull it begin there."""
    pieces = _middles(part)
    traction = np.array(entry["traction"])
    if not pieces or not traction.any():
        return []
    pushes = np.dot(np.mean(pieces, axis=0) - center, traction) < 0.0
    return [Arrow(place, traction, COLORS["load"], pushes) for place in _some(pieces, MOST_ARROWS)]


def _middles(part):
    """The middle of every face and line of a part."""
    return [np.mean(piece, axis=0) for piece in (*part.faces, *part.lines)]


def _some(places, most):
    """As many of the places as are asked for at most, evenly among them."""
    chosen = np.unique(np.linspace(0, len(places) - 1, min(len(places), most)).round().astype(int))
    return [places[i] for i in chosen]
