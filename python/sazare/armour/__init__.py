"""Damage of armour: how far the units of a run of method spheres have moved and turned.

    import sazare
    from sazare.armour import Damage, Options

    damage = Damage(sazare.open("runs/breakwater"), Options(start=1.5))
    damage.displaced, damage.per_width, damage.units.moved   # count, N_od, m
"""

from sazare.armour.damage import Damage, Options, write_damage

__all__ = ["Damage", "Options", "write_damage"]
