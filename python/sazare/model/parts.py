"""What a picture of a model holds, whatever its method: parts with colours, gauges, arrows, gravity, and notes.

A method fills a `Model` from a case and the first snapshot; how it is drawn, in the plane or in space, is not its matter.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from sazare import style

AXES = "xyz"
BODY, BOUNDARY, LOAD, WALL, INSIDE = "body", "boundary", "load", "wall", "inside"  # the last: surfaces within a body

# Colours of what acts on a body, by the words of the case files.
COLORS = {
    "fixed": "#8c1d1d", "roller": "#d98a1f", "frictionless": "#d98a1f", "prescribed": "#7d3fa0", "viscous": "#2f6f9f", "free_field": "#3f8f8f", "absorbing": "#2f6f9f",
    "load": "#d6302b", "joint": "#1c8a6b", "stemming": "#6b5a4a", "surface": "#c2188f", "support": style.INK, "velocity": "#7d3fa0",
}
JOINT_COLORS = (COLORS["joint"], "#b0269a", "#c28a00", "#5b3fc4", "#4f7a00", "#00a0b8")  # of sets, which are told apart
BODY_COLORS = ("#d9cfb8", "#a9bcc6", "#c7b28f", "#b5c7a3", "#cbb1b8", "#b7afcf", "#dfc27d", "#9fb8ad", "#c9c9c9", "#c4a484")


@dataclass(frozen=True)
class Opened:
    """A case at t = 0: the folder with its first snapshot and, where it was meshed, its mesh; and all keys with their values."""

    results: Any
    case: dict

    @cached_property
    def first(self):
        """The bodies at t = 0 (pyvista.UnstructuredGrid)."""
        return self.results.all_snapshots[0].mesh

    @cached_property
    def groups(self):
        """The groups of the mesh."""
        from sazare.model.groups import MeshGroups

        meshed, mesh = self.results.path / "mesh.msh", self.case["mesh"]
        return MeshGroups(meshed if meshed.exists() else Path(mesh["file"]), mesh["scale"])

    def all(self, table):
        """The entries of a list of the case."""
        return self.case.get(table, [])

    def material_of(self, region):
        """The name of the material of a region; "" where none has it."""
        return next((entry["name"] for entry in self.all("materials") if region in entry["regions"]), "")

    @property
    def gravity(self):
        """Gravitational acceleration (3,) [m/s2]; None where there is none."""
        found = np.array(self.case.get("gravity", {}).get("acceleration", (0.0, 0.0, 0.0)), dtype=float)
        return found if np.any(found) else None


@dataclass(frozen=True)
class Part:
    """What has one colour and one line of the legend: outlines, lines or points, or balls where the points have radii [m]."""

    label: str
    color: str
    role: str = BODY
    faces: Any = ()  # outlines (k, 3) [m], one after another
    lines: Any = ()  # (n, 2, 3) [m]
    points: Any = ()  # (n, 3) [m]
    radii: Any = None  # (n,) [m]
    names: tuple = ()  # Mark: names of its pieces
    crowd: int = 0  # number of elements

    @property
    def corners(self):
        """All its points, with the ends of balls (n, 3) [m]."""
        found = [np.reshape(face, (-1, 3)) for face in self.faces]
        found.append(np.reshape(self.lines, (-1, 3)))
        points = np.reshape(self.points, (-1, 3))
        reach = np.zeros((len(points), 1)) if self.radii is None else np.asarray(self.radii)[:, None]
        return np.concatenate([*found, points - reach, points + reach]).astype(float)


@dataclass(frozen=True)
class Mark:
    """A name at a point [m]."""

    name: str
    point: Any
    color: str = style.INK


@dataclass(frozen=True)
class Arrow:
    """A direction (3,) at a point [m]; `ends` where it leads to the point instead of away from it."""

    point: Any
    direction: Any
    color: str
    ends: bool = False


@dataclass(frozen=True)
class Model:
    """What is drawn: of a plane model (dimension 2) in x and y, of one in space from a corner."""

    dimension: int
    parts: list
    gauges: list = field(default_factory=list)
    arrows: list = field(default_factory=list)
    gravity: Any = None
    notes: list = field(default_factory=list)
    up: int | None = None  # the axis that leads up without gravity, too; None: either of y and z

    def recolored(self, number):
        """The parts with other colours of the body, as if they came after a number of parts."""
        return [replace(part, color=body_color(BODY_COLORS.index(part.color) + number)) if part.color in BODY_COLORS else part for part in self.parts]

    @property
    def crowd(self):
        """Number of all elements."""
        return sum(part.crowd for part in self.parts)

    @property
    def box(self):
        """Lower and upper corner of all but walls (2, 3) [m]; walls go on as far as they like."""
        corners = np.concatenate([part.corners for part in self.parts if part.role != WALL])
        return np.array([corners.min(axis=0), corners.max(axis=0)])


def region_names(opened):
    """The names of the regions of a mesh by their numbers in the snapshots; none where the mesh cannot be read."""
    from sazare.engine import errors_of_commands

    try:
        with errors_of_commands():
            return opened.groups.regions(opened.case["mesh"]["dimension"])
    except (ImportError, KeyError, OSError, TypeError, ValueError):
        return []


def without_settling(case):
    """The settings with which ground does not settle under gravity first. Without gravity: a viscous boundary is refused where there is any."""
    settles = case.get("gravity", {}).get("settle")
    return ["gravity.settle=false", "gravity.acceleration=[0.0, 0.0, 0.0]"] if settles else []


def gauges_at_points(opened):
    """The gauges of a case that gives their points."""
    return [Mark(gauge["name"], np.array(gauge["point"], dtype=float)) for gauge in opened.all("gauges")]


def body_color(number):
    """The colour of the n-th part of a body."""
    return BODY_COLORS[number % len(BODY_COLORS)]


def counted(number, one, many=None):
    """A number of things in words: `1 element`, `620 elements`."""
    return f"{style.count(number)} {one if number == 1 else many or one + 's'}"


def named(region, material):
    """A region with its material, which is not told twice."""
    return region if material in ("", region) else f"{region} ({material})"


def along(vector, unit):
    """A vector in words, such as `150 kPa along x` or `5 m/s along −z`; a slanted one with its components."""
    vector = np.asarray(vector, dtype=float)
    size = np.linalg.norm(vector)
    axis = int(np.argmax(np.abs(vector)))
    if np.isclose(abs(vector[axis]), size, rtol=1e-9):
        return f"{style.quantity(size, unit)} along {'−' if vector[axis] < 0 else ''}{AXES[axis]}"
    factor, prefix = style.prefix_for(size)
    return f"({', '.join(f'{value / factor:.3g}' for value in vector)}) {prefix}{unit}".replace("-", "−")


def motion_words(entry):
    """The motions that an entry names, such as `quake along x, lift along z`; "" where it names none."""
    return ", ".join(f"{entry[f'motion_{axis}']} along {axis}" for axis in AXES if entry.get(f"motion_{axis}"))


def boundary_words(entry):
    """The kind of a boundary with its axes and motions, such as `roller (y held)` or `prescribed (quake along x, y held)`."""
    held = [f"{axis} held" for axis in entry.get("axes", [])]
    inside = ", ".join(([motion_words(entry)] if motion_words(entry) else []) + held)
    return f"{entry['kind']} ({inside})" if inside else entry["kind"]


def moving_words(entry):
    """How a wall moves, such as `, moves with table along x`; "" where it stands."""
    words = [f"moves with {motion_words(entry)}"] if motion_words(entry) else []
    if any(entry.get("velocity", ())):
        words.append(f"moves at {along(entry['velocity'], 'm/s')}")
    if any(entry.get("angular_velocity", ())):
        words.append(f"turns at {along(entry['angular_velocity'], 'rad/s').replace('along', 'about')}")
    return "".join(f", {each}" for each in words)


def grouped(entries, words):
    """Entries by their words, in the order of the first of each."""
    found = {}
    for entry in entries:
        found.setdefault(words(entry), []).append(entry)
    return found


def listed(names):
    """Names in words; of many the first ones and how many more there are."""
    names = list(dict.fromkeys(names))
    return ", ".join(names) if len(names) <= 8 else f"{', '.join(names[:7])} and {len(names) - 7} more"


def middle(pieces):
    """A point (3,) [m] of some outlines, lines or points that is as near to the middle of all as one of them comes."""
    centers = np.array([np.mean(np.reshape(piece, (-1, 3)), axis=0) for piece in pieces])
    return centers[np.argmin(np.linalg.norm(centers - centers.mean(axis=0), axis=1))]


def surface_part(opened, names, below, label, color, role=BOUNDARY, titles=()):
    """A part of named groups of a mesh, of the largest dimension under `below` in which each is. titles: a name for each, drawn beside it."""
    faces, lines, points, marks = [], [], [], []
    for place, name in enumerate(names):
        dimension = opened.groups.dimension(name, below)
        found = [] if dimension is None else opened.groups.corners(name, dimension)
        (points, lines, faces)[dimension or 0].extend(found)
        if titles and found:
            marks.append(Mark(titles[place], middle(found), color))
    return Part(label, color, role, faces, np.reshape(lines, (-1, 2, 3)), np.reshape(points, (-1, 3)), names=tuple(marks))
