"""Muck piles: fragments of a run of blasting fly and land as rigid bodies, in a run of method spheres.

    import sazare
    from sazare.muck_pile import Options, muck_pile

    numbers = muck_pile(sazare.open("runs/bench"), options=Options(ground=-5.0))
    numbers.cast, numbers.pile.swell, numbers.farthest.throw
"""

from sazare.muck_pile.model import Model, Options, model_of
from sazare.muck_pile.numbers import PileNumbers
from sazare.muck_pile.throw import muck_pile

__all__ = ["Model", "Options", "PileNumbers", "model_of", "muck_pile"]
