"""The case of a blast, and the folder in which it is written with its geometry."""

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from sazare.blast_model import words
from sazare.blast_model.geometry import geometry
from sazare.blast_model.ground import Ground
from sazare.blast_model.joint_field import JointField
from sazare.blast_model.joint_laws import joint_entries
from sazare.blast_model.layout import Layout
from sazare.blast_model.rock import softening_in
from sazare.cases import blocks
from sazare.folders import require_room
from sazare.intervals import round_end, round_interval
from sazare.lab.rock import Rock, with_keys

ROWS, PICTURES = 1000, 20  # of the history, and snapshots; up to 2.5 times as many, since intervals are round
LINE, NEAREST, FURTHEST = 6, 5.0, 0.9  # gauges at depth; where they begin, in diameters of the hole, if there is room, and end, in shares of the margin
FILES = ("model.geo", "case.toml", "model.md")


@dataclass(frozen=True)
class BlastModel:
    """A blast that can be written as a case."""

    layout: Layout
    rock_given: Rock
    rock_words: str = "a granite, since no --rock CASE was given"
    joints: JointField = field(default_factory=JointField)
    sets: list = field(default_factory=list)  # of joints (`joint_sets.JointSet`), whose laws the discs have
    ground: Ground | None = None  # None: no weight and no stress

    @cached_property
    def _softened(self):
        return softening_in(self.rock_given, self.layout.far)

    @property
    def rock(self):
        """The rock with the fracture energies of the case."""
        return self._softened[0]

    @cached_property
    def _laws(self):
        return joint_entries(self.rock_given, self.joints.discs, self.sets, self.layout.far)

    @property
    def joint_laws(self):
        """Entries of [[joints]]: the rock, and each set of existing joints."""
        return self._laws[0]

    @property
    def end(self):
        """End of the run [s]: the last charge has detonated, and an S-wave has passed the model along its diagonal."""
        last = max(deck.delay + 3.0 * deck.keys.get("delay_scatter", 0.0) + (deck.bottom - deck.top) / deck.velocity for deck in self.layout.pattern.decks)
        diagonal = np.linalg.norm(self.layout.upper - self.layout.lower)
        end = last + diagonal / math.sqrt(self.rock.shear_modulus / self.rock.material.density)
        return round_end(end, PICTURES)[0]

    @property
    def assumptions(self):
        """What was assumed, in sentences without a point at the end."""
        return [f"rock: {self.rock_words}", *self._softened[1], *self._laws[1], *self.joints.notes, *words.assumptions(self)]

    def geometry(self):
        """The text of the .geo file."""
        return geometry(self.layout, [disc.placed(self.layout.frame) for disc in self.joints.discs])

    def case(self):
        """The case, which names `model.geo` in its folder."""
        end = self.end
        near = min(self.layout.near(hole) for hole in self.layout.holes)
        return blocks.Case(
            title=f"Blast of {self.layout.pattern.path.stem}",
            mesh=blocks.Mesh(file="model.geo"),
            materials=[with_keys(self.rock.material, name="rock", regions=["rock"])],
            joints=self.joint_laws,
            contact=self.rock.contact_for(near),
            charges=self._charges(),
            gravity=self.ground and self.ground.gravity(self.layout.frame),
            initial_stress=self.ground and self.ground.initial_stress(self.layout.frame, self.rock),
            boundaries=[blocks.Boundary(surface=name, kind="absorbing") for name in ("sides", "base")],
            gauges=self._gauges(),
            time=blocks.Time(end=end, history_interval=round_interval(end / ROWS), snapshot_interval=round_end(end, PICTURES)[1]),
        )

    def _charges(self):
        charges, placed = [], {hole.name: hole for hole in self.layout.holes}
        for deck in self.layout.pattern.decks:
            hole, decks = placed[deck.hole.name], self.layout.pattern.decks_of(deck.hole)
            name = hole.name if len(decks) == 1 else f"{hole.name} deck {decks.index(deck) + 1}"
            charges.append(
                blocks.Charge(name=name, surface=hole.surface, collar=_triple(hole.collar), toe=_triple(hole.toe), diameter=hole.diameter, **deck.keys)
            )
        return charges

    def line_at_depth(self):
        """Distances [m] and places (3,) of gauges away from the middle of the charges of one hole, each further by the same factor: a spread for the attenuation."""
        layout, sense = self.layout, -1.0 if self.layout.bench else 1.0
        edge = max(sense * hole.collar[0] for hole in layout.holes)
        row = [place for place, hole in enumerate(layout.holes) if sense * hole.collar[0] > edge - hole.diameter]
        middle = np.mean([hole.collar[1] for hole in layout.holes])
        place = min(row, key=lambda number: abs(layout.holes[number].collar[1] - middle))
        hole, decks = layout.holes[place], layout.pattern.decks_of(layout.pattern.holes[place])
        start = hole.collar + hole.direction * 0.5 * (min(deck.top for deck in decks) + max(deck.bottom for deck in decks))
        furthest = FURTHEST * layout.margin
        nearest = min(max(NEAREST * hole.diameter, furthest / 8.0), 0.4 * furthest)
        distances = [float(f"{nearest * (furthest / nearest) ** (i / (LINE - 1)):.2g}") for i in range(LINE)]
        return [(away, start + [sense * away, 0.0, 0.0]) for away in distances]

    def _gauges(self):
        """Points just below the surface, behind the holes or, without a bench, beside them; a line at the depth of the charges; the middle of a free face."""
        layout, inset = self.layout, 0.25 * self.layout.far
        collars = np.array([hole.collar for hole in layout.holes])
        middle = float(collars[:, 1].mean())
        start, sense, where = (collars[:, 0].min(), -1.0, "behind") if layout.bench else (collars[:, 0].max(), 1.0, "beside")
        gauges = []
        for share in (0.25, 0.5, 0.75):
            away = float(f"{share * layout.margin:.2g}")
            gauges.append(blocks.Gauge(name=f"{away:g} m {where}", point=_triple((start + sense * away, middle, -inset))))
        gauges += [blocks.Gauge(name=f"{away:g} m {where} at depth", point=_triple(point)) for away, point in self.line_at_depth()]
        if layout.bench:
            face = 0.5 * (layout.bench.crest + layout.bench.toe)
            gauges.append(blocks.Gauge(name="free face", point=_triple((face - inset, middle, -0.5 * layout.bench.height))))
        return gauges


def _triple(values):
    return tuple(round(float(value), 9) for value in values)


def write_model(model, folder, overwrite=False, command=""):
    """Writes geometry, case and model.md into a folder, and returns the path of the case.

    command: the line by which a user makes the folder again, for model.md. Raises Occupied as `require_room`.
    """
    folder = require_room(folder, FILES, overwrite)
    texts = (model.geometry(), model.case().to_toml(), words.page(model, command))
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in zip(FILES, texts):
        (folder / name).write_text(text, encoding="utf-8")
    return folder / "case.toml"
