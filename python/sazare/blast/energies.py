"""Where the energy of a blast has gone, in words."""

from dataclasses import dataclass


@dataclass(frozen=True)
class EnergyPart:
    """A part of the energy balance: its key in the manifest, its name, its value [J], its share of the work (None without work), and what it means."""

    key: str
    name: str
    value: float
    share: float | None
    meaning: str


MEANINGS = {
    "energy_kinetic": ("in motion", "Kinetic energy of the rock: throw of fragments, and waves that are still under way at the end of the run."),
    "energy_elastic": ("stored elastically", "Strain energy in joints, deformable elements, contacts and boundaries. Below zero where the run began under stress and has released some of it."),
    "energy_joint_dashpot": (
        "joint dashpots",
        "Turned into heat by the dashpots of joints that have not broken, and by the bulk damping of deformable elements, as waves deform them. In rock this stands for what no joint of the mesh "
        "can show: crushing around the holes, cracks smaller than an element, and the damping of waves in intact rock. A large part says that the "
        "result depends on the damping of the case; look how much it changes when the dashpots are halved.",
    ),
    "energy_slip": ("slip of joints", "Friction of joints that slide before they break."),
    "energy_fracture": ("fracture", "Made into new surfaces: the fracture energy of the joints that have softened or broken."),
    "energy_release": ("released at failure", "Elastic energy that joints still held when their faces opened, which the model lets go as heat and not as waves."),
    "energy_contact_dashpot": ("contact dashpots", "Turned into heat where broken faces collide."),
    "energy_friction": ("contact friction", "Turned into heat where broken faces slide over each other."),
    "energy_boundary_dashpot": (
        "radiated through boundaries", "Carried out of the model by waves through its absorbing boundaries, and taken up by dashpots of fixed ones: seismic energy. "
        "The columns NAME.absorbed of history.csv have it by boundary.",
    ),
}


def parts_of(figures):
    """The EnergyParts that a run's figures (dict) tell, the largest first; those that are zero are left out."""
    work = figures.get("energy_work")
    found = [
        EnergyPart(key, name, figures[key], figures[key] / work if work else None, meaning)
        for key, (name, meaning) in MEANINGS.items() if figures.get(key)
    ]
    return sorted(found, key=lambda part: -abs(part.value))


def absorbed_by_boundary(results):
    """Energy [J] that each boundary has absorbed by the end of a run, by name, the most first."""
    history = results.history
    ending = ".absorbed"
    last = {name.removesuffix(ending): float(history[name][-1]) for name in history if name.endswith(ending) and history.rows}
    return dict(sorted(last.items(), key=lambda item: -item[1]))
