"""All joints of a model: given discs and those of sets, fitted to the mesh, with a table of what was wanted and what there is."""

from dataclasses import dataclass, field

import numpy as np

from sazare.blast_model.fit import CLEAR, fitted, size_at
from sazare.blast_model.orientations import fisher_estimated
from sazare.blast_model.scatter import area_inside, scattered

COLUMNS = ("set", "discs", "moved", "left out", "diameter [m]", "P32 wanted", "drawn", "reached [m2/m3]", "Fisher wanted", "estimated")


@dataclass(frozen=True)
class SetRow:
    """A set in numbers; of discs that reach into the rock, whose holes count as rock."""

    name: str
    discs: int  # in the model
    moved: int
    left_out: int
    diameter: float | None  # mean of those in the model [m]
    p32_wanted: float | None  # m2/m3
    p32_drawn: float  # of all discs, before any was left out
    p32: float
    fisher_wanted: float | None
    fisher: float | None  # estimated from the discs of the model


@dataclass(frozen=True)
class JointField:
    """Discs of a model, in axes of its pattern, and what there is to tell of them."""

    discs: list = field(default_factory=list)
    rows: list[SetRow] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    @property
    def table(self):
        """Rows of words, the first of which names the columns."""
        return [list(COLUMNS), *(_words(row) for row in self.rows)]


def joint_field(layout, given=(), sets=(), path="joint sets", path_of_discs="joints"):
    """The joints of a model: `given` discs and those of the sets that have a scatter, each moved a little or left out where the mesh could not follow it.

    Raises ValueError, at its line of the table `path`, where a set has more discs than a mesh can have.
    """
    drawn = [*given, *(disc for item in sets if item.scatter for disc in scattered(path, item, layout))]
    placed = [disc.placed(layout.frame) for disc in drawn]
    result = fitted(placed, layout)
    scatters = {item.name: item.scatter for item in sets}
    names = dict.fromkeys([*scatters, *(disc.set for disc in drawn)])
    rows = [_row(name, scatters.get(name), placed, result, layout) for name in names]
    return JointField([disc.returned(layout.frame) for disc in result.discs], rows, [*_notes(drawn, placed, result, layout, path_of_discs)])


def _row(name, scatter, placed, result, layout):
    mine = [number for number, disc in enumerate(placed) if disc.set == name]
    kept = [disc for disc in result.discs if disc.set == name]
    rock = sum(area_inside(disc.polygon(), layout) for disc in kept), sum(area_inside(placed[number].polygon(), layout) for number in mine)
    solid = layout.volume + layout.volume_of_holes
    return SetRow(
        name or "joints", len(kept), sum(number in result.moved for number in mine), len(mine) - len(kept),
        float(np.mean([2.0 * disc.radius for disc in kept])) if kept else None, scatter.p32 if scatter else None, rock[1] / solid, rock[0] / solid,
        scatter.fisher if scatter else None, fisher_estimated([disc.normal for disc in kept]) if scatter else None,
    )


def _words(row):
    def number(value, digits=3):
        return "-" if value is None else f"{value:.{digits}g}"

    return [
        row.name, str(row.discs), str(row.moved), str(row.left_out), number(row.diameter), number(row.p32_wanted), number(row.p32_drawn), number(row.p32),
        number(row.fisher_wanted), number(row.fisher, 2),
    ]


def _notes(drawn, placed, result, layout, path):
    if result.moved:
        most = max(result.moved, key=lambda number: result.moved[number])
        share = result.moved[most] / float(size_at(placed[most].centre, layout))
        yield f"{len(result.moved)} discs were moved by up to {result.moved[most]:.2g} m, {share:.2g} of an element there, so that no edges are nearer than {CLEAR:g} of an element"
    if result.too_near:
        yield f"{len(result.too_near)} discs were left out: nowhere near their place are they clear of larger discs, the surface and the holes (smaller elements: --size)"
    if result.too_small:
        yield f"{len(result.too_small)} discs were left out because they are smaller than half an element or so (smaller elements: --size; or a diameter_min)"
    for number, disc in enumerate(drawn):
        if disc.line and number in result.moved:
            yield f"{path}:{disc.line}: this disc was moved by {result.moved[number]:.2g} m"
        elif disc.line and number in {*result.too_near, *result.too_small}:
            yield f"{path}:{disc.line}: this disc was left out"
