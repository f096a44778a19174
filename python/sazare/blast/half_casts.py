"""Half-casts: how much of the walls of holes is left on the rock that stays."""

from dataclasses import dataclass
from fnmatch import fnmatchcase


@dataclass(frozen=True)
class HalfCast:
    """What is left of one hole: the physical group of its wall, and lengths [m]: of the hole, where half of its barrel stays, where all of it does.
    standing: mean share of the wall around the axis that stays, 0 to 1."""

    name: str
    length: float
    half: float
    whole: float
    standing: float


def half_casts_of(results):
    """The HalfCasts of a run, in the order of its case; none where it wrote none."""
    table = results.half_casts
    if not table.rows:
        return []
    # A column of names that are all numbers reads as one of numbers.
    names = [f"{name:g}" if isinstance(name, float) else str(name) for name in table["hole"]]
    columns = (table[name] for name in ("length", "half_cast", "whole", "standing"))
    return [HalfCast(name, *(float(value) for value in row)) for name, *row in zip(names, *columns)]


def contour(casts, patterns):
    """The HalfCasts of contour holes: those whose name fits one of the patterns, such as `rim_*`; all without patterns. Raises ValueError for a pattern that no name fits."""
    for pattern in patterns:
        if not any(fnmatchcase(one.name, pattern) for one in casts):
            known = ", ".join(one.name for one in casts) or "none"
            raise ValueError(f'contour hole "{pattern}": no hole has this name; the holes of the run, by the physical groups of their walls: {known}')
    return [one for one in casts if not patterns or any(fnmatchcase(one.name, pattern) for pattern in patterns)]


def factor(casts):
    """The half-cast factor: length of the half barrels that are left over the length of all holes, 0 to 1; None without holes."""
    length = sum(one.length for one in casts)
    return sum(one.half for one in casts) / length if length > 0.0 else None
