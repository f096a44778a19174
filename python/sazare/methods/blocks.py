"""Method blocks: bonded tetrahedra that break apart under blasting."""

from functools import partial

from sazare import plot, style
from sazare.methods import Figure, Method, Section, blocks_curves, common

ENERGIES = {
    "energy_kinetic": ("kinetic", style.KINETIC),
    "energy_elastic": ("elastic", style.ELASTIC),
    "energy_joint_dashpot": ("joint dashpots", style.DASHPOT),
    "energy_slip": ("slip in joints", style.SLIP),
    "energy_fracture": ("fracture", style.RUPTURE),
    "energy_release": ("lost at release", style.RELEASE),
    "energy_contact_dashpot": ("contact dashpots", style.CONTACT_DASHPOT),
    "energy_friction": ("friction in contacts", style.FRICTION),
    "energy_boundary": ("left through the boundary", style.OUTSIDE),
}


def sections(results):
    """The pictures of the body, where there are snapshots, then the curves."""
    if len(results.snapshots):
        return [*_body_sections(results.snapshots), *_curve_sections(results)]
    nothing = Section("cracks", "Crack pattern, shape, levels, fragments", "", lambda: None, common.NO_SNAPSHOTS)
    return [nothing, *_curve_sections(results)]


def _body_sections(snapshots):
    # VTK takes a second to load, and a summary does without.
    from sazare.methods import blocks_maps
    from sazare.methods.blocks_body import Body

    body = Body(snapshots)
    return [
        Section(
            "cracks", "Crack pattern",
            "Faces between elements that have broken, coloured by the time of the snapshot in which each was first seen broken.",
            partial(blocks_maps.crack_pattern, body), "The run wrote no joints beside its elements.",
        ),
        Section(
            "shape", "Displaced shape",
            "Speed of the elements. Displacements are enlarged where the title says so; the fastest hundredth shares one colour.",
            partial(blocks_maps.displaced_shape, body), "",
        ),
        Section(
            "levels", "Time levels", "An element of level k takes steps of the base step over 2 to the power of k.",
            partial(blocks_maps.time_levels, body), "",
        ),
        Section(
            "fragments", "Fragments", "Elements that still hang together share a colour; the largest fragment is pale.",
            partial(blocks_maps.fragment_map, body), "", wide=not body.is_slab,
        ),
    ]


def _curve_sections(results):
    ranks = [_rank_section(results)] if results.ranks.rows > 0 else []
    return [
        common.energy_section(results, ENERGIES),
        Section(
            "fragment_curve", "Fragment sizes", "Share of the volume in fragments up to a size; half of it lies below X50.",
            partial(plot.fragment_curve, results), "The run wrote no fragments.", wide=False,
        ),
        Section(
            "broken_joints", "Broken joints", "Broken joints and fragments against time.",
            partial(blocks_curves.broken_joints, results), common.NO_HISTORY, wide=False,
        ),
        Section(
            "gauges", "Gauges", "Velocity at the gauges; the dot is the peak particle velocity.",
            partial(plot.gauges, results), common.NO_GAUGES,
        ),
        Section(
            "smallest_step", "Smallest step", "The smallest time step of any element.",
            partial(blocks_curves.smallest_step, results), "The run wrote no steps.", wide=False,
        ),
        common.timing_section(results, "the step"),
        *ranks,
    ]


def _rank_section(results):
    """The picture of a run of several processes."""
    return Section(
        "ranks", "Ranks",
        "Processor time of each rank in evaluations and kicks, cumulated; how far the busiest rank of an interval is above the "
        "mean; and with which element each rank's range begins.",
        partial(blocks_curves.ranks, results), "",
    )


METHOD = Method(
    sections=sections,
    verdict=common.strict_balance_verdict,
    headlines=(
        Figure("broken_joints", "joints broken", note=common.share_note("broken_joints", "joints")),
        Figure("fragments", "fragments", note=common.count_note("elements", "elements")),
        Figure("x50", "X50", "m", common.quantity_note("x80", "X80 ", "m")),
        Figure("throw_max", "largest throw", "m"),
        Figure("peak_speed", "peak speed", "m/s"),
        Figure("energy_work", "work of the loads", "J"),
    ),
    snapshots="elements",
    fields={
        "velocity": ("speed", "m/s"),
        "displacement": ("displacement", "m"),
        "damage": ("share of joints broken", ""),
        "level": ("time level", ""),
    },
)
