"""The rock to be tested: a material of a case of method blocks, with its joints and its contact."""

import copy
import math
from dataclasses import dataclass
from pathlib import Path

from sazare.cases import blocks, case_from_text
from sazare.simulation import source_of


@dataclass(frozen=True)
class Rock:
    """A material with the joints between its blocks; parts of `sazare.cases.blocks`."""

    name: str
    material: object
    joint: object
    contact: object

    @property
    def youngs_modulus(self):
        """Young's modulus [Pa]."""
        return self.material.youngs_modulus

    @property
    def wave_speed(self):
        """Speed of P-waves [m/s]."""
        modulus, ratio = self.material.youngs_modulus, self.material.poisson_ratio
        return math.sqrt(modulus * (1.0 - ratio) / ((1.0 + ratio) * (1.0 - 2.0 * ratio)) / self.material.density)

    @property
    def shear_modulus(self):
        """Shear modulus [Pa]."""
        return self.material.youngs_modulus / (2.0 * (1.0 + self.material.poisson_ratio))

    @property
    def friction(self):
        """Coefficient of friction of the joints."""
        if self.joint.friction_coefficient is not None:
            return self.joint.friction_coefficient
        return math.tan(math.radians(self.joint.friction_angle))

    def strength_under(self, confinement):
        """The axial stress [Pa] at which a joint of the worst direction slips under a confinement [Pa]: Mohr and Coulomb's estimate."""
        slope = math.sqrt(1.0 + self.friction**2) + self.friction
        return 2.0 * self.joint.cohesion * slope + confinement * slope**2

    def with_joint(self, **keys):
        """This rock with other keys of its joint."""
        return Rock(self.name, self.material, with_keys(self.joint, **keys), self.contact)

    def with_friction(self, coefficient):
        """This rock with another coefficient of friction of its joints."""
        return self.with_joint(friction_coefficient=coefficient, friction_angle=None)

    def contact_for(self, size):
        """The friction of the rock's contact, with springs that suit elements of a size [m]: an eighth of E per size, critically damped."""
        modulus = self.youngs_modulus
        mass = 0.12 * self.material.density * size**3
        contact = with_keys(self.contact, contact_stiffness=0.125 * modulus * size)
        contact.contact_damping = 2.0 * math.sqrt(contact.contact_stiffness * mass)
        if contact.contact_shape == "faces":
            contact.face_contact_stiffness = modulus / size
            contact.face_contact_damping = 2.0 * math.sqrt(contact.face_contact_stiffness * mass) / size
        return contact


def with_keys(part, **keys):
    """A copy of a table of a case with other keys."""
    found = copy.copy(part)
    for key, value in keys.items():
        setattr(found, key, value)
    return found


def rock_of(case, material=None, overrides=None, folder=None):
    """The rock that a case of method blocks describes.

    case: the path of a case file, its TOML text, or a case object. material: the name of one of its materials; not needed where only one has
    bonded joints inside. overrides: keys of the case to change, such as {"joints.0.cohesion": 5e6}.

    Raises ValueError where the case is of another method, or does not say which material, or where that has no Young's modulus or no bonded joint.
    Raises UserError with all errors of the case.
    """
    return rock_from(source_of(case, overrides, folder), material)


def rock_from(source, material=None):
    """The rock of a case given as a Source; errors as for `rock_of`."""
    read = case_from_text(source.resolved(), folder=Path(source.path).parent)
    if not isinstance(read, blocks.Case):
        raise ValueError(f"the laboratory tests materials of method blocks, and this case is of method {read.method}")
    materials = {item.name: item for item in read.materials}
    if material is not None and material not in materials:
        raise ValueError(f"no material {material!r} in the case; there are: {', '.join(materials)}")
    found = {name: _joint_inside(read, name) for name in materials}
    bonded = [name for name, joint in found.items() if joint is not None]
    if material is None and len(bonded) != 1:
        raise ValueError(f"which material? --material NAME: {', '.join(bonded or materials)}")
    name = material or bonded[0]
    if found[name] is None:
        raise ValueError(f"material {name!r} has no bonded joint between itself and itself, so there is nothing that could break")
    if materials[name].youngs_modulus is None:
        raise ValueError(
            f"material {name!r} has springs per area of its joints, which make a specimen of smaller elements softer than the case: "
            "give it youngs_modulus and poisson_ratio"
        )
    return Rock(name, materials[name], found[name], read.contact)


def _joint_inside(case, name):
    """The last bonded joint that holds between faces inside a material; None without one."""
    entries = [joint for joint in case.joints if joint.between is not None and list(joint.between) == [name, name]]
    return entries[-1] if entries and entries[-1].bonded is not False else None
