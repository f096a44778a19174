"""Entries of [[joints]]: the rock, and each set of existing joints with a law of its own."""

from sazare.blast_model.rock import energies_raised, softening_in
from sazare.lab.rock import with_keys

WEAKER = 0.1  # strength of existing joints over that of the rock
WEAKENED = ("cohesion", "tensile_strength", "fracture_energy", "shear_fracture_energy")


def joint_entries(rock, discs, sets, size):
    """Entries of [[joints]] and notes about what was raised in those of sets. rock: as given; size: of the largest elements [m].

    The rock has fracture energies that its elements can follow. A set has the keys of its table, and for the rest a tenth of the strengths and fracture energies of the rock as given
    and its other keys; its energies are raised only as far as its own strengths need.
    """
    laws = {item.surface: item.law for item in sets}
    entries, notes = [with_keys(softening_in(rock, size)[0].joint, name="rock", between=("rock", "rock"))], []
    for surface in dict.fromkeys(disc.surface for disc in discs):
        entry, raised = _entry(rock, surface, laws.get(surface, {}), size)
        entries.append(entry)
        notes += raised
    return entries, notes


def _entry(rock, surface, law, size):
    if law.get("bonded") is False:
        return type(rock.joint)(name=surface, surface=surface, bonded=False), []
    weaker = {key: WEAKER * value for key in WEAKENED if (value := getattr(rock.joint, key)) is not None}
    keys = {**weaker, **{key: value for key, value in law.items() if key != "bonded"}}
    if "friction_angle" in law or "friction_coefficient" in law:
        keys = {"friction_angle": None, "friction_coefficient": None, "residual_friction_coefficient": None, **keys}
    if "shear_fracture_energy" in law:
        keys["law"] = "mixed_mode"
    entry = with_keys(rock.joint, name=surface, between=None, surface=surface, **keys)
    return energies_raised(rock, entry, size, f"of {surface}")


def law_in_words(entry):
    """The law of an entry as an engineer writes it."""
    if entry.bonded is False:
        return "no strength, friction of [contact]"
    friction = f"{entry.friction_angle:g} degrees" if entry.friction_angle is not None else f"{entry.friction_coefficient:g}"
    return f"cohesion {1e-6 * entry.cohesion:.3g} MPa, friction {friction}, tension {1e-6 * entry.tensile_strength:.3g} MPa, {entry.fracture_energy:g} N/m"
