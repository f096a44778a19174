"""A drill pattern: holes and the charges in them, read from a table with a row for each charge."""

import difflib
import re
from dataclasses import dataclass, field, fields
from pathlib import Path

import numpy as np

from sazare.blast_model.sheet import Problems, read_sheet, truth
from sazare.cases import blocks
from sazare.engine import engine

AXES = ("collar_x", "collar_y", "collar_z", "toe_x", "toe_y", "toe_z")
NEEDED = ("hole", *AXES, "diameter", "explosive")
OF_THE_HOLE = ("name", "surface", "collar", "toe", "diameter", "share")  # keys of a charge that the hole decides, which the model has as a whole
UNITS_OF_KEYS = {
    "charge_diameter": "m", "top": "m", "bottom": "m", "primer": "m", "vents": "", "stemming_density": "kg/m3", "stemming_resistance": "Pa", "explosive": "",
    "gas_in_cracks": "", "crack_aperture": "m",
    "density": "kg/m3", "detonation_velocity": "m/s", "explosive_energy": "J/kg", "jwl_a": "Pa", "jwl_b": "Pa", "delay": "s", "delay_scatter": "s", "cut_distance": "m",
}
KEYS = [key.name for key in fields(blocks.Charge) if key.name not in OF_THE_HOLE]
UNITS = {"hole": "", **dict.fromkeys((*AXES, "diameter", "stemming"), "m"), **{key: UNITS_OF_KEYS.get(key, "-") for key in KEYS}}
GAS_IN_CRACKS = ("none", "share", "flow")
JWL = [key for key in KEYS if key.startswith("jwl_")]
SIGNS = " -_./#+()"  # in names of holes, beside letters and digits
WIDEST, LONGEST = 0.6, 100.0  # diameter and length [m] of the largest blast holes; beyond them a unit is wrong
CLEAR = 1.5  # least distance of the axes of two holes, over the sum of their radii


@dataclass(frozen=True)
class Hole:
    """A drill hole from its collar to its toe; lengths in m."""

    name: str
    collar: np.ndarray  # (3,)
    toe: np.ndarray  # (3,)
    diameter: float
    line: int = 0  # of the table, in which it is described

    @property
    def surface(self):
        """Name of the group of its wall."""
        return "hole_" + re.sub(r"\W+", "_", self.name, flags=re.ASCII)

    @property
    def length(self):
        """Length [m]."""
        return float(np.linalg.norm(self.toe - self.collar))

    @property
    def direction(self):
        """Unit vector from the collar to the toe."""
        return (self.toe - self.collar) / self.length


@dataclass(frozen=True)
class Deck:
    """A charge in a hole, by the keys that a case has for it."""

    hole: Hole
    keys: dict
    line: int

    @property
    def top(self):
        """Depth at which the explosive begins [m]."""
        return self.keys.get("top", 0.0)

    @property
    def bottom(self):
        """Depth at which it ends [m]."""
        return self.keys.get("bottom", self.hole.length)

    @property
    def primer(self):
        """Depth of the primer [m]."""
        return self.keys.get("primer", self.bottom)

    @property
    def delay(self):
        """Time at which the primer fires [s]."""
        return self.keys.get("delay", 0.0)

    @property
    def volume(self):
        """Volume of the explosive [m3]."""
        return 0.25 * np.pi * self.keys.get("charge_diameter", self.hole.diameter) ** 2 * (self.bottom - self.top)

    @property
    def density(self):
        """Density of the explosive [kg/m3]."""
        return self.keys["density"] if self.keys["explosive"] == "custom" else engine().explosives()[self.keys["explosive"]][0]

    @property
    def velocity(self):
        """Velocity of the detonation [m/s]."""
        return self.keys.get("detonation_velocity") or engine().explosives()[self.keys["explosive"]][1]

    @property
    def mass(self):
        """Mass of the explosive [kg]."""
        return self.density * self.volume


@dataclass(frozen=True)
class Pattern:
    """Holes and charges, both in the order of the table."""

    path: Path
    holes: list[Hole]
    decks: list[Deck]
    notes: list[str] = field(default_factory=list)  # what is told though it is no error

    def decks_of(self, hole):
        """The charges of a hole."""
        return [deck for deck in self.decks if deck.hole is hole]

    @property
    def firing_order(self):
        """Charges in the order in which they fire."""
        return sorted(self.decks, key=lambda deck: deck.delay)


def read_pattern(path):
    """A pattern from a CSV file. Raises ValueError with all that is wrong, by line; OSError where the file cannot be read."""
    path, problems = Path(path), Problems(path)
    rows = read_sheet(path, UNITS, NEEDED, problems)
    problems.tell()
    holes, decks = {}, []
    for row in rows:
        hole = _hole(row, holes, problems)
        if hole is not None:
            decks.append(_deck(row, hole, problems))
    problems.tell()
    pattern = Pattern(path, list(holes.values()), decks)
    _check_names(pattern, problems)
    _check_distances(pattern, problems)
    _check_decks(pattern, problems)
    problems.tell()
    _note_order(pattern)
    return pattern


def _hole(row, holes, problems):
    """The hole of a row: that of an earlier row of this name, or a new one; None for one that is wrong."""
    cells = row.cells
    collar, toe = np.array([cells[name] for name in AXES[:3]]), np.array([cells[name] for name in AXES[3:]])
    hole = Hole(cells["hole"], collar, toe, cells["diameter"], row.line)
    before = len(problems.found)
    odd = next((sign for sign in hole.name if not (sign.isalnum() or sign in SIGNS)), None)
    if odd is not None:
        problems.error(row.line, f"a hole cannot be called {hole.name!r}: {odd!r} cannot stand in the name of a column", f"use letters, digits and {' '.join(SIGNS.strip())}")
    if hole.diameter <= 0.0:
        problems.error(row.line, f"the diameter of hole {hole.name} is {hole.diameter:g} m", "a diameter is greater than 0")
    elif hole.diameter > WIDEST:
        problems.error(
            row.line, f"hole {hole.name} would be {hole.diameter:g} m wide",
            "lengths without a unit are in metres: write diameter [mm] or [in] in the first line, if that is meant",
        )
    if hole.length == 0.0:
        problems.error(row.line, f"hole {hole.name} has no length: its toe is at its collar", "collar and toe are the two ends of its axis")
    elif hole.length > LONGEST:
        problems.error(
            row.line, f"hole {hole.name} would be {hole.length:.6g} m long",
            "lengths without a unit are in metres: write collar_x [mm] or [ft], and the like, in the first line, if that is meant",
        )
    elif hole.length < 2.0 * hole.diameter:
        problems.error(row.line, f"hole {hole.name} is {hole.length:.4g} m long and {hole.diameter:.4g} m wide", "are both lengths in metres?")
    if len(problems.found) > before:
        return None
    known = holes.setdefault(hole.name, hole)
    if known is not hole and not (np.array_equal(known.collar, collar) and np.array_equal(known.toe, toe) and known.diameter == hole.diameter):
        problems.error(
            row.line, f"hole {hole.name} has another collar, toe or diameter in line {known.line}",
            "rows of one hole are its decks and repeat its collar, toe and diameter; give another hole another name",
        )
    return known


def _deck(row, hole, problems):
    keys = {name: value for name, value in row.cells.items() if name in KEYS}
    if "stemming" in row.cells and "top" in keys:
        problems.error(row.line, "there is both a stemming and a top", "they are the same depth, at which the explosive begins: keep one of them")
    if "stemming" in row.cells:
        keys["top"] = row.cells["stemming"]
    if "scatter_seed" in keys:
        keys["scatter_seed"] = int(keys["scatter_seed"])
    if "vents" in keys:
        keys["vents"] = truth(row, "vents", problems, "true lets the gas push the stemming out and leave through the collar")
    keys.setdefault("gas_in_cracks", "flow")
    if keys["gas_in_cracks"] not in GAS_IN_CRACKS:
        problems.error(row.line, f"gas_in_cracks is {keys['gas_in_cracks']!r}", f"it is one of {', '.join(GAS_IN_CRACKS)}")
    known = [*engine().explosives(), "custom"]
    if keys["explosive"] not in known:
        near = difflib.get_close_matches(keys["explosive"].lower(), [name.lower() for name in known], 1)
        meant = next((f"; did you mean {name}?" for name in known if near and name.lower() == near[0]), "")
        problems.error(
            row.line, f"no explosive {keys['explosive']!r} is known{meant}",
            f"explosives are {', '.join(known)}; custom has its own density, detonation_velocity and gas_exponent",
        )
    elif keys["explosive"] == "custom":
        gas = ("explosive_energy", *JWL) if any(name in keys for name in JWL) else ("gas_exponent",)
        for name in ("density", "detonation_velocity", *gas):
            if not keys.get(name, 0.0) > 0.0:
                usual = "; 3 is usual for the dense gas of commercial explosives" if name == "gas_exponent" else ""
                problems.error(row.line, f"a custom explosive needs {name} greater than 0", f"fill in the column {name}{usual}")
    return Deck(hole, keys, row.line)


def _check_names(pattern, problems):
    """Walls have names that the geometry can hold, each its own."""
    groups = {}
    for hole in pattern.holes:
        other = groups.setdefault(hole.surface, hole)
        if other is not hole:
            problems.error(
                hole.line, f"the holes {other.name!r} and {hole.name!r} would both be the group {hole.surface}",
                "use letters and digits that tell them apart",
            )


def _check_distances(pattern, problems):
    for place, hole in enumerate(pattern.holes):
        for other in pattern.holes[:place]:
            apart, radii = distance(hole, other), 0.5 * (hole.diameter + other.diameter)
            if apart < CLEAR * radii:
                how = "touches" if apart < radii else "nearly touches"
                problems.error(
                    hole.line, f"hole {hole.name} {how} hole {other.name} of line {other.line}: their axes come within {apart:.3g} m",
                    f"the axes of these holes are {CLEAR * radii:.3g} m apart or more; check collars and toes",
                )


def distance(hole, other):
    """Least distance of the axes of two holes [m]. Ericson, Real-time collision detection (2005), section 5.1.9."""
    first, second, between = hole.toe - hole.collar, other.toe - other.collar, hole.collar - other.collar
    a, e, b = first @ first, second @ second, first @ second
    c, f = first @ between, second @ between
    determinant = a * e - b * b
    s = np.clip((b * f - c * e) / determinant, 0.0, 1.0) if determinant > 1e-12 * a * e else 0.0
    t = (b * s + f) / e
    if not 0.0 <= t <= 1.0:
        t = np.clip(t, 0.0, 1.0)
        s = np.clip((b * t - c) / a, 0.0, 1.0)
    return float(np.linalg.norm(between + s * first - t * second))


def _check_decks(pattern, problems):
    for deck in pattern.decks:
        name, length = deck.hole.name, deck.hole.length
        if deck.top < 0.0:
            problems.error(deck.line, f"the charge of hole {name} begins {-deck.top:g} m above the collar", "depths count from the collar")
        elif deck.top >= deck.bottom:
            problems.error(
                deck.line, f"the charge of hole {name} begins {deck.top:.6g} m below the collar and ends at {deck.bottom:.6g} m",
                "the stemming is shorter than the hole, and top less than bottom"
            )
        elif deck.bottom > length * (1.0 + 1e-9):
            problems.error(
                deck.line, f"the charge of hole {name} reaches to {deck.bottom:.6g} m, and the hole is {length:.6g} m long",
                "leave bottom empty for a charge that reaches the toe"
            )
        elif not deck.top <= deck.primer <= deck.bottom:
            problems.error(
                deck.line, f"the primer of hole {name} at {deck.primer:.6g} m is outside its charge from {deck.top:.6g} to {deck.bottom:.6g} m",
                "leave primer empty for one at the bottom of the charge",
            )
        if not 0.0 < deck.keys.get("charge_diameter", deck.hole.diameter) <= deck.hole.diameter:
            problems.error(
                deck.line, f"a charge {deck.keys['charge_diameter']:g} m wide does not fit into hole {name}, which is {deck.hole.diameter:g} m wide",
                "leave charge_diameter empty for a charge that fills its hole",
            )
        if deck.delay < 0.0:
            problems.error(deck.line, f"the delay of hole {name} is {deck.delay:g} s", "delays count from 0, the first of the blast")
        for other in pattern.decks_of(deck.hole):
            if other.line < deck.line and max(deck.top, other.top) < min(deck.bottom, other.bottom):
                problems.error(
                    deck.line, f"this charge of hole {name} overlaps that of line {other.line}", "decks of a hole stand one above the other: give each a top and a bottom"
                )


def _note_order(pattern):
    delays = [deck.delay for deck in pattern.decks]
    for before, deck in zip(pattern.decks, pattern.decks[1:]):
        if deck.delay < before.delay:
            order = ", ".join(f"{deck.hole.name} ({1e3 * deck.delay:g} ms)" for deck in pattern.firing_order)
            pattern.notes.append(f"{pattern.path}:{deck.line}: the delays are not in the order of the rows; the holes fire in this order: {order}")
            return
    if len(set(delays)) == 1 and len(delays) > 1:
        pattern.notes.append(f"all charges fire at {1e3 * delays[0]:g} ms")
