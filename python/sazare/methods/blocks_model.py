"""The model of a case of method blocks at t = 0: materials, blasts, charges, boundaries, joints along surfaces, constraints."""

from dataclasses import replace

import numpy as np

from sazare import style
from sazare.model.parts import (
    BOUNDARY, COLORS, INSIDE, JOINT_COLORS, LOAD, Arrow, Model, Part, along, body_color, boundary_words, counted, gauges_at_points, grouped, listed, named, surface_part,
)
from sazare.model.water import current_notes, water_parts
from sazare.outside import outer_faces


def model(opened):
    """What is drawn of the case."""
    return Model(
        3, [*_regions(opened), *_joints(opened), *_boundaries(opened), *_blasts(opened), *_charges(opened), *water_parts(opened, _room(opened))],
        gauges_at_points(opened), _velocities(opened), opened.gravity, [*_constraints(opened), *current_notes(opened)],
    )


def _room(opened):
    """The box of the body and a margin around it [m]."""
    box = np.array(opened.first.bounds).reshape(3, 2).T
    return box + 0.12 * np.ptp(box, axis=0).max() * np.array([[-1.0], [1.0]])


def _region_names(opened):
    """The name of the region of every element."""
    names = opened.groups.region_of_elements(3)
    return np.array([names[int(number)] for number in np.asarray(opened.first.cell_data["element"])])


def _regions(opened):
    """The outside of the body by region."""
    faces, cells = outer_faces(opened.first.clean(tolerance=1e-9))
    names = _region_names(opened)
    parts = []
    for place, name in enumerate(dict.fromkeys(names)):
        count = int(np.sum(names == name))
        label = f"{named(name, opened.material_of(name))}: {counted(count, 'element')}"
        parts.append(Part(label, body_color(place), faces=faces[names[cells] == name], crowd=count))
    return parts


def _joints(opened):
    """Joints that lie along a surface of the mesh: a part for each, or where they are more than there are colours, for those that are bonded and those that are not."""
    along_surfaces = [entry for entry in opened.all("joints") if entry.get("surface")]
    few = len(along_surfaces) <= len(JOINT_COLORS)
    for place, entries in enumerate(grouped(along_surfaces, lambda entry: entry["name"] if few else entry["bonded"]).values()):
        label = f"joint{'' if entries[0]['bonded'] else ', not bonded'}: {listed(entry['name'] for entry in entries)}"
        yield surface_part(opened, [entry["surface"] for entry in entries], 3, label, JOINT_COLORS[place], INSIDE)


def _boundaries(opened):
    for words, entries in grouped(opened.all("boundaries"), boundary_words).items():
        names = [entry["surface"] for entry in entries]
        yield surface_part(opened, names, 3, f"{words}: {listed(names)}", COLORS[entries[0]["kind"]], BOUNDARY, names)


def _blasts(opened):
    entries = opened.all("blasts")
    if not entries:
        return
    surfaces = [entry["surface"] for entry in entries]
    titles = [_blast_title(entry) for entry in entries]
    label = f"blast pressure{_peak(entries)}: {listed(entry.get('name', entry['surface']) for entry in entries)}"
    yield surface_part(opened, surfaces, 3, label, COLORS["load"], LOAD, titles)


def _charges(opened):
    """Walls of holes where explosives are, by explosive, and what of the walls has none; decks of one hole share its wall."""
    every = opened.all("charges")
    for explosive, entries in grouped(every, lambda entry: entry["explosive"]).items():
        titles = {}
        for entry in entries:
            titles.setdefault(entry["surface"], []).append(_blast_title(entry))
        label = f"charge of {explosive}: {listed(entry.get('name', entry['surface']) for entry in entries)}"
        part = surface_part(opened, list(titles), 3, label, COLORS["load"], LOAD, ["; ".join(of) for of in titles.values()])
        yield replace(part, faces=[face for surface in titles for face in _walls(opened, surface, [entry for entry in entries if entry["surface"] == surface])])
    rest = [face for surface, decks in grouped(every, lambda entry: entry["surface"]).items() for face in _walls(opened, surface, decks, charged=False)]
    if rest:
        yield Part("hole without explosive: stemming or empty", COLORS["stemming"], LOAD, rest)


def _walls(opened, surface, decks, charged=True):
    """Faces of the wall of a hole whose middle is at the depth of one of its charges, or at that of none."""
    faces = opened.groups.corners(surface, 2)
    collar, toe = (np.array(decks[0][end], dtype=float) for end in ("collar", "toe"))
    length = float(np.linalg.norm(toe - collar))
    depths = (np.array([np.mean(face, axis=0) for face in faces]).reshape(-1, 3) - collar) @ (toe - collar) / length
    within = np.zeros(len(faces), dtype=bool)
    for deck in decks:
        within |= (depths >= deck.get("top", 0.0)) & (depths <= _bottom(deck, length))
    return [face for face, inside in zip(faces, within) if inside == charged]


def _bottom(deck, length):
    """Where a charge ends: with the toe, if not told; the face that closes the hole belongs to it."""
    bottom = deck.get("bottom")
    return length * (1.0 + 1e-6) if bottom is None or bottom >= length * (1.0 - 1e-6) else bottom


def _blast_title(entry):
    """The name of a hole with its delay."""
    return f"{entry.get('name', entry['surface'])}, {style.quantity(entry['delay'], 's')}" if entry["delay"] else entry.get("name", entry["surface"])


def _peak(entries):
    """The largest pressure, where it is a number of the case."""
    peaks = {entry["peak_pressure"] for entry in entries if "peak_pressure" in entry}
    if not peaks:
        return ""
    return f", peak {style.quantity(max(peaks), 'Pa')}" if len(peaks) == 1 else f", peaks up to {style.quantity(max(peaks), 'Pa')}"


def _velocities(opened):
    """An arrow in the middle of what moves at the beginning."""
    centers, names = np.asarray(opened.first.cell_centers().points), _region_names(opened)
    return [
        Arrow(centers[np.isin(names, entry["regions"])].mean(axis=0), np.array(entry["velocity"]), COLORS["velocity"])
        for entry in opened.all("initial_velocities") if any(entry["velocity"])
    ]


def _constraints(opened):
    """Constraints and initial velocities in words."""
    words = []
    for entry in opened.all("constraints"):
        held = [f"no translation along {', '.join(entry['translation'])}"] if entry["translation"] else []
        held += [f"no rotation about {', '.join(entry['rotation'])}"] if entry["rotation"] else []
        words.append(f"{listed(entry['regions'])}: {'; '.join(held)}")
    return words + [f"{listed(entry['regions'])}: initial velocity {along(entry['velocity'], 'm/s')}" for entry in opened.all("initial_velocities")]
