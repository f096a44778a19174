"""The rock of a blast: that of a case, or a granite, with fracture energies that its elements can follow."""

import math

from sazare.cases import blocks
from sazare.lab.rock import Rock, with_keys

REACH = 0.8  # largest distance of the centres of two elements, over their size

GRANITE = Rock(
    "rock",
    blocks.Material(name="rock", regions=["rock"], density=2600.0, youngs_modulus=50e9, poisson_ratio=0.25),
    blocks.Joint(
        name="rock", between=("rock", "rock"), law="mixed_mode", damping_ratio=0.2, cohesion=25e6, friction_coefficient=1.0, residual_friction_coefficient=0.6,
        tensile_strength=8e6, fracture_energy=50.0, shear_fracture_energy=500.0,
    ),
    blocks.Contact(friction_coefficient=0.6),
)  # that of the case uniaxial-compression


def softening_in(rock, size):
    """The rock with fracture energies that are at least what its strengths need in elements of a size [m], and notes about what was raised."""
    joint, notes = energies_raised(rock, rock.joint, size, "of the rock")
    return Rock(rock.name, rock.material, joint, rock.contact), notes


def energies_raised(rock, joint, size, whose):
    """A joint of a rock with fracture energies that are at least what its strengths need in elements of a size [m], and notes about what was raised.

    A joint must take more energy than its two elements hold at its strength: s^2 H/(2 K), with the strength s, the distance H of their centres and the stiffness
    K, which is at least E across a face and the shear modulus along it.
    """
    reach = REACH * size
    needed = {"fracture_energy": 0.5 * joint.tensile_strength**2 * reach / rock.youngs_modulus}
    if joint.shear_fracture_energy is not None:
        needed["shear_fracture_energy"] = 0.5 * joint.cohesion**2 * reach / rock.shear_modulus
    raised = {key: _rounded_up(value) for key, value in needed.items() if value > getattr(joint, key)}
    notes = [
        f"{key.replace('_', ' ')} {value:g} N/m, not the {getattr(joint, key):g} N/m {whose}: "
        f"elements of {size:.3g} m would break without softening below that (smaller ones: --size)"
        for key, value in raised.items()
    ]
    return with_keys(joint, **raised), notes


def _rounded_up(value):
    """A number with two digits that is not less."""
    unit = 10.0 ** (math.floor(math.log10(value)) - 1)
    return round(math.ceil(value / unit) * unit, 6)
