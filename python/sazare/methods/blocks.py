"""Method blocks: bonded tetrahedra that break apart under blasting."""

from functools import partial

from sazare import plot, style
from sazare.methods import Figure, Method, Section, blocks_blast, blocks_charges, blocks_curves, common

ENERGIES = {
    "energy_kinetic": ("kinetic", style.KINETIC),
    "energy_elastic": ("elastic", style.ELASTIC),
    "energy_joint_dashpot": ("joint dashpots", style.DASHPOT),
    "energy_slip": ("joint slip", style.SLIP),
    "energy_fracture": ("fracture", style.RUPTURE),
    "energy_release": ("released at failure", style.RELEASE),
    "energy_contact_dashpot": ("contact dashpots", style.CONTACT_DASHPOT),
    "energy_friction": ("contact friction", style.FRICTION),
    "energy_boundary_dashpot": ("absorbed at boundaries", style.OUTSIDE),
}


def sections(results):
    """The pictures of the body, where there are snapshots, then the curves."""
    if len(results.snapshots):
        return [*_body_sections(results), *blocks_blast.sections(results), *_curve_sections(results)]
    nothing = Section("cracks", "Crack pattern, deformed shape, time levels, fragments", "", lambda: None, common.NO_SNAPSHOTS)
    return [nothing, *blocks_blast.sections(results), *_curve_sections(results)]


def _body_sections(results):
    # VTK takes a second to load, and a summary does without.
    from sazare.methods import blocks_maps, blocks_views
    from sazare.methods.blocks_body import Body

    body = Body(results.snapshots)
    return [
        Section(
            "cracks", "Crack pattern",
            "Broken joints when a quarter, a half and three quarters of them have broken and at the end, coloured by the time of the "
            "first snapshot that shows them broken; joints that are sheared and whose faces are still pressed together in blue.",
            partial(blocks_maps.crack_pattern, body), "The run wrote no joints.",
        ),
        *([_mode_section(body)] if blocks_maps.has_shear_cracks(body) else []),
        Section(
            "shape", "Deformed shape",
            "Speed of the elements when half of the joints that break have broken, and at the end. Displacements are magnified where the "
            "title says so, so that those of the rock that has not come loose can be seen; elements that fly out of the frame then are left out.",
            partial(blocks_maps.displaced_shape, body), "",
        ),
        *([_stress_section(body)] if blocks_maps.has_stress(body) else []),
        Section(
            "levels", "Time levels", "An element at level k is advanced in steps of the base step / 2^k.",
            partial(blocks_maps.time_levels, body), "",
        ),
        Section(
            "fragments", "Fragments", "Elements that are still connected share a colour, and neighbouring fragments have different ones; the largest fragment is pale.",
            partial(blocks_maps.fragment_map, body), "", wide=not body.is_slab,
        ),
        *([_size_section(body, results)] if blocks_views.has_loose_fragments(results) else []),
        *([] if body.is_slab else [_slice_section(body)]),
    ]


def _stress_section(body):
    from sazare.methods import blocks_maps

    return Section(
        "stress", "Principal stresses",
        "The largest and the smallest principal stress of the elements when half of the joints that break have broken, or at the end where none does. "
        "They are means over the elements, from the forces of their joints; elements that have lost their joints carry none.",
        partial(blocks_maps.principal_stresses, body), "",
    )


def _size_section(body, results):
    """The picture of a run from whose rock something has come loose."""
    from sazare.methods import blocks_views

    return Section(
        "fragment_sizes", "Fragments by size",
        "The fragments that have come loose by the end, where they were at the beginning, coloured by the smallest square opening that they pass.",
        partial(blocks_views.fragments_by_size, body, results), "No snapshot shows the fragments of the end.", wide=not body.is_slab,
    )


def _slice_section(body):
    """The picture of cracks inside a solid."""
    from sazare.methods import blocks_views

    return Section(
        "slices", "Cracks in slices", "Cracks at the end in four parallel planes, coloured by the time of the first snapshot that shows them broken.",
        partial(blocks_views.crack_slices, body), "No joint has broken.",
    )


def _mode_section(body):
    """The picture of a run in which joints have failed in shear."""
    from sazare.methods import blocks_maps

    return Section(
        "modes", "Cracks by mode",
        "Joints that have failed by the end, with their number in the whole body. Red or blue: opening or shear has dissipated more of "
        "the joint's fracture energy. Dark or pale: the faces are apart, or they are pressed together and slide with friction.",
        partial(blocks_maps.crack_modes, body), "No joint has failed.",
    )


def _curve_sections(results):
    ranks = [_rank_section(results)] if results.ranks.rows > 0 else []
    return [
        common.energy_section(results, ENERGIES),
        *([_charge_section(results)] if blocks_charges.names(results) else []),
        Section(
            "broken_joints", "Broken joints", "Number of broken joints and of fragments over time.",
            partial(blocks_curves.broken_joints, results), common.NO_HISTORY, wide=False,
        ),
        Section(
            "gauges", "Gauges", "Velocity at the gauges; dots mark the peak particle velocity.",
            partial(plot.gauges, results), common.NO_GAUGES,
        ),
        *([common.boundary_force_section(results)] if plot.force_columns(results.history) else []),
        Section(
            "smallest_step", "Smallest step", "Smallest time step of any element.",
            partial(blocks_curves.smallest_step, results), "The run wrote no time steps.", wide=False,
        ),
        common.timing_section(results, "the step"),
        *ranks,
    ]


def _charge_section(results):
    """The picture of a run with charges."""
    return Section(
        "charges", "Charges",
        "Pressure of the gas in the hole of each charge, and the energy of all charges: what the detonation has released, and what of it "
        "the gas has given to the walls. The rest is left in the gas.",
        partial(blocks_charges.charges, results), "No charge fired in the time of the run.",
    )


def _rank_section(results):
    """The picture of a run of several processes."""
    return Section(
        "ranks", "Ranks",
        "Processor time of each rank so far, and load imbalance of each interval; lock step, the mean over the ranks of the work at a tick "
        "over the largest of it (1: no rank waits for another one's work); and the number of elements of each rank.",
        partial(blocks_curves.ranks, results), "",
    )


METHOD = Method(
    sections=sections,
    verdict=common.strict_balance_verdict,
    headlines=(
        Figure("broken_joints", "broken joints", note=common.share_note("broken_joints", "joints")),
        Figure("fragments", "fragments", note=common.count_note("elements", "elements")),
        Figure("detached_volume", "detached rock", "m³", common.count_note("detached_fragments", "fragments")),
        Figure("p50", "P50", "m", blocks_blast.sizes_note),
        Figure("throw_max", "maximum throw", "m"),
        Figure("peak_speed", "peak speed", "m/s", common.said("of any element")),
        Figure("energy_work", "external work", "J"),
        Figure("energy_joint_dashpot", "joint dashpots", "J", blocks_blast.dashpot_note),
    ),
    sheets=blocks_blast.sheets,
    snapshots="elements",
    fields={
        "velocity": ("speed", "m/s"),
        "displacement": ("displacement", "m"),
        "broken_fraction": ("share of broken joints", ""),
        "largest_principal_stress": ("largest principal stress", "Pa"),
        "smallest_principal_stress": ("smallest principal stress", "Pa"),
        "level": ("time level", ""),
    },
)
