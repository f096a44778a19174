"""The model of a case of method hybrid at t = 0: both sides in one picture, and the coupling surface."""

import tomllib
from pathlib import Path

from sazare.methods import model_of
from sazare.model.parts import COLORS, Model, Opened, surface_part
from sazare.simulation import source_of


def model(opened):
    """What is drawn of the case: as the continuum is, in the plane or in space."""
    continuum, bodies = (_side(opened, name) for name in ("continuum", "bodies"))
    under, above = (model_of(side.case).model(side) for side in (continuum, bodies))
    group = opened.case["surface"]["group"]
    surface = surface_part(continuum, [group], under.dimension, f"coupling surface: {group}", COLORS["surface"])
    return Model(
        under.dimension, [*under.parts, *above.recolored(len(under.parts)), surface], under.gauges + above.gauges, under.arrows + above.arrows,
        above.gravity if under.gravity is None else under.gravity, under.notes + above.notes + _gravity_notes(under, above),
    )


def _side(opened, name):
    """One side, with its own case."""
    return Opened(opened.results.sides[name], tomllib.loads(source_of(Path(opened.case["sides"][name])).resolved()))


def _gravity_notes(under, above):
    """Which side has no gravity, where the other one has."""
    if (under.gravity is None) == (above.gravity is None):
        return []
    return [f"gravity acts on the {'bodies' if under.gravity is None else 'continuum'} only"]
