"""Sets of joints, read from a table with a row for each: how their discs are scattered, and the law that their faces obey."""

import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from sazare.blast_model.joints import surface_of, upward_normal, wrong_name
from sazare.blast_model.orientations import line_direction, mean_crossing
from sazare.blast_model.sheet import Problems, read_sheet, truth
from sazare.blast_model.sizes import PARAMETERS, SizeLaw

LAW_UNITS = {
    "bonded": "", "cohesion": "Pa", "friction_coefficient": "-", "friction_angle": "deg", "residual_friction_coefficient": "-", "tensile_strength": "Pa",
    "fracture_energy": "N/m", "shear_fracture_energy": "N/m",
}  # keys of [[joints]] that a set may have
SIZE_UNITS = {"diameter": "m", "deviation": "m", "exponent": "-", "diameter_min": "m", "diameter_max": "m"}
UNITS = {
    "set": "", "dip": "deg", "dip_direction": "deg", "fisher": "-", "p32": "m2/m3", "p10": "1/m", "line_trend": "deg", "line_plunge": "deg", "size_law": "",
    **SIZE_UNITS, "seed": "-", **LAW_UNITS,
}
SCATTER = [name for name in UNITS if name != "set" and name not in LAW_UNITS]  # columns that say how discs are scattered
LARGEST_SEED = 2**53
STEEPEST = 89.0  # angle of friction [deg]: its coefficient is 57
LIMITS = {
    "dip": (0.0, 90.0), "line_plunge": (-90.0, 90.0), "friction_angle": (0.0, STEEPEST), "friction_coefficient": (0.0, 60.0), "residual_friction_coefficient": (0.0, 60.0),
    "exponent": (-20.0, 20.0), "fisher": (-1e6, 1e6), **{name: (-1e5, 1e5) for name in ("diameter", "deviation", "diameter_min", "diameter_max")},
}  # what is below 0 is told by its own words


@dataclass(frozen=True)
class Scatter:
    """How the discs of a set are scattered: centres without preference, directions by Fisher, diameters by a law."""

    normal: np.ndarray  # (3,), the mean of the normals, upwards, in axes of the pattern
    fisher: float
    sizes: SizeLaw
    p32: float  # area of joints per volume [m2/m3]
    seed: int = 1


@dataclass(frozen=True)
class JointSet:
    """A set of joints. Without a scatter its discs are those that a table of discs names."""

    name: str
    line: int = 0  # of the table
    scatter: Scatter | None = None
    law: dict = field(default_factory=dict)  # keys of [[joints]] that are given

    @property
    def surface(self):
        """Name of the group of its faces."""
        return surface_of(self.name)


def read_joint_sets(path):
    """Sets of joints from a CSV file. Raises ValueError with all that is wrong, by line; OSError where it cannot be read."""
    path = Path(path)
    problems = Problems(path)
    rows = read_sheet(path, UNITS, ("set",), problems, LIMITS)
    problems.tell()
    sets, lines = [], {}
    for row in rows:
        name = row.cells["set"]
        if wrong_name(name):
            problems.error(row.line, f"a set cannot be called {name!r}", "its name becomes a group of the mesh: use letters, digits and _")
        if lines.setdefault(name.lower(), row.line) != row.line:
            problems.error(row.line, f"the set {name} stands in line {lines[name.lower()]} already", "a row is a set: give another one another name")
        sets.append(JointSet(name, row.line, _scatter(row, problems), _law(row, problems)))
    problems.tell()
    return sets


def _scatter(row, problems):
    """The scatter of a row; None where it has none, or a wrong one."""
    cells, before = row.cells, len(problems.found)
    if not any(name in cells for name in SCATTER):
        return None
    for name in ("dip", "dip_direction", "fisher", "size_law"):
        if name not in cells:
            problems.error(row.line, f"{name} is empty", "discs of a set are scattered by dip, dip_direction, fisher, size_law and p32; leave all of them empty for a set of given discs")
    if cells.get("fisher", 0.0) < 0.0:
        problems.error(row.line, f"the Fisher constant is {cells['fisher']:g}", "it is 0 for directions without preference, and the greater the nearer they are to the mean; 10 to 100 are usual")
    seed = cells.get("seed", 1.0)
    if seed != int(seed) or not 0 <= seed <= LARGEST_SEED:
        problems.error(row.line, f"the seed is {seed:g}", "a seed is a whole number of 0 or more")
    sizes = _sizes(row, problems)
    if len(problems.found) > before:
        return None
    normal = upward_normal(cells["dip"], cells["dip_direction"])
    p32 = _p32(row, normal, problems)
    return Scatter(normal, cells["fisher"], sizes, p32, int(seed)) if len(problems.found) == before else None


def _sizes(row, problems):
    """The law of size of a row; None where it is wrong."""
    cells, before = row.cells, len(problems.found)
    law = cells.get("size_law")
    if law is None:
        return None
    if law not in PARAMETERS:
        problems.error(row.line, f"no law of size {law!r} is known", f"laws are {', '.join(PARAMETERS)}")
        return None
    for name in PARAMETERS[law]:
        if name not in cells:
            problems.error(row.line, f"the law of size {law} needs {name}", f"it has {' and '.join(PARAMETERS[law])}; diameters are those of discs, and power is a density of d^-exponent")
        elif not cells[name] > 0.0:
            problems.error(row.line, f"{name} is {cells[name]:g}", f"{name} of a law of size is greater than 0")
    bounds = ("diameter_min", "diameter_max") if law != "constant" else ()
    for name in SIZE_UNITS:
        if name in cells and name not in (*PARAMETERS[law], *bounds):
            problems.error(row.line, f"the law of size {law} has no {name}", f"it has {', '.join(dict.fromkeys([*PARAMETERS[law], *bounds]))}: leave the cell empty")
    low, high = cells.get("diameter_min", 0.0), cells.get("diameter_max")
    if low < 0.0 or (high is not None and not high > low):
        problems.error(row.line, f"the diameters are from {low:g} to {high:g} m" if high is not None else f"diameter_min is {low:g} m", "diameter_max is greater than diameter_min, which is 0 or more")
    if len(problems.found) > before:
        return None
    sizes = SizeLaw(law, **{name: cells[name] for name in SIZE_UNITS if name in cells})
    if not low < sizes.largest:
        problems.error(row.line, f"nearly all discs of this law are smaller than diameter_min, {low:g} m", f"99.9 % are below {sizes.largest:.3g} m: make diameter_min smaller")
        return None
    return sizes


def _p32(row, normal, problems):
    cells = row.cells
    given = [name for name in ("p32", "p10") if name in cells]
    if len(given) != 1:
        problems.error(row.line, "there is neither p32 nor p10" if not given else "there are both p32 and p10", "one of them says how many joints there are: p32 is their area per volume, p10 their number along a line")
        return None
    name = given[0]
    if not cells[name] > 0.0:
        problems.error(row.line, f"{name} is {cells[name]:g} {UNITS[name]}", "it is greater than 0; leave out the row of a set without joints")
        return None
    line = [key for key in ("line_trend", "line_plunge") if key in cells]
    if name == "p32":
        if line:
            problems.error(row.line, f"{line[0]} is that of the line of p10, and there is p32", "leave it empty")
        return cells["p32"]
    if len(line) < 2:
        problems.error(row.line, "p10 needs line_trend and line_plunge", "how many joints a line meets follows from its direction: trend from north by east, plunge below the horizontal")
        return None
    share = mean_crossing(normal, cells["fisher"], line_direction(cells["line_trend"], cells["line_plunge"]))
    if share < 0.05:
        problems.error(row.line, f"the line of p10 lies nearly in the joints of this set, of which it meets only {share:.2g} per metre and m2/m3", "give p32, or p10 along another line")
        return None
    return cells["p10"] / share


def _law(row, problems):
    """The keys of [[joints]] that a row has."""
    law = {name: row.cells[name] for name in LAW_UNITS if name in row.cells}
    if "bonded" in law:
        law["bonded"] = truth(row, "bonded", problems, "no is for joints without any strength but the friction of contacts")
    others = [name for name in law if name != "bonded"]
    if law.get("bonded") is False and others:
        problems.error(row.line, f"joints that are not bonded have no {others[0]}", "leave it empty; their friction is that of [contact], as of all open faces")
    if "friction_coefficient" in law and "friction_angle" in law:
        problems.error(row.line, "there are both friction_coefficient and friction_angle", "they are the same: keep one of them")
    peak = law.get("friction_coefficient", math.tan(math.radians(law.get("friction_angle", 90.0))))
    if law.get("residual_friction_coefficient", 0.0) > peak * (1.0 + 1e-9):
        problems.error(row.line, f"the residual friction {law['residual_friction_coefficient']:g} is above that at the peak, {peak:.6g}", "joints do not gain friction when they fail")
    for name in others:
        if law[name] < 0.0 or (law[name] == 0.0 and name in ("tensile_strength", "fracture_energy", "shear_fracture_energy")):
            problems.error(row.line, f"{name} is {law[name]:g}", "it is greater than 0; bonded = no is for joints without strength")
    return law


def refuse_unused(path, sets, discs):
    """Raises ValueError where a set has neither a scatter nor one of the given discs."""
    names = {disc.set for disc in discs}
    problems = Problems(path)
    for item in sets:
        if item.scatter is None and item.name not in names:
            problems.error(item.line, f"the set {item.name} has no joints", "give it dip, dip_direction, fisher, size_law and p32, or discs whose column set names it (--joints)")
    problems.tell()
