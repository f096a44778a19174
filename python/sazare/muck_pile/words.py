"""A muck pile in lines for a terminal."""

import numpy as np

from sazare.checked import lines_of, warnings_of
from sazare.muck_pile.breaking import LAST, STILL
from sazare.style import count, quantity

FLIGHT = ("walls", "step", "work", "cost")  # lines of the check that are printed


def before(model, breaking):
    """What flies, and over what, in lines."""
    bodies = model.bodies
    kept = bodies.kinetic_energy.sum() / bodies.energy.sum() if bodies.energy.sum() > 0.0 else 1.0
    x, y = model.direction[:2]
    lines = [
        f"{count(len(bodies))} fragments, {quantity(1e3 * bodies.mass.sum(), 'g')} of rock, as rigid bodies of {count(len(model.balls))} spheres; they keep {kept:.2%} of the kinetic energy",
        f"ground at z = {model.ground:.4g} m ({model.ground_words}); throw towards ({x:.3f}, {y:.3f}) ({model.direction_words}); toe of the bench {model.toe:.4g} m along it",
        f"contacts: {' to '.join(quantity(value, 'N/m') for value in sorted({model.stiffnesses[0], model.stiffnesses[-1]}))}, restitution {model.options.restitution:g}, friction {model.friction:g}, rolling friction {model.options.rolling_friction:g}",
    ]
    if np.any(model.fines):
        lines.append(
            f"{count(model.fines.sum())} of them, below {quantity(model.bodies.sizes[~model.fines].min(), 'm')}, are fines with {model.bodies.mass[model.fines].sum() / model.bodies.mass.sum():.2%} "
            "of the mass: they fly without what they would meet"
        )
    if model.buried > 0.0:
        lines.append(f"{quantity(1e3 * model.buried, 'g')} more are loose but lie under the ground or within the rock that stays: they stay too")
    return lines + warnings(breaking)


def flight(said, end):
    """What a check says of the flight until its end [s], in lines: the rock that stays, step, steps and cost, and warnings. Without that of the restitution, which asks for
    a shorter step than the flight of a pile needs (docs/guide/muck-pile.md)."""
    lines = [line for line in lines_of(said, FLIGHT) if not line.startswith("  walls ") or "open edges" in line]
    return [f"flight to {quantity(end, 's')}:", *lines, *(one for one in warnings_of(said) if "the restitution between" not in one)]


def warnings(breaking):
    """What is not over at the end of a run of blasting."""
    lines = []
    if breaking.broken is not None and breaking.broken > STILL:
        lines.append(
            f"warning: joints still break: {breaking.broken:.1%} of all that are broken broke in the last {LAST:.0%} of the run, {breaking.rate:.2g} per duration; "
            "a longer run has more and smaller fragments"
        )
    if breaking.worked is not None and breaking.worked > STILL:
        lines.append(
            f"warning: the gas still works: {breaking.worked:.1%} of its work came in the last {LAST:.0%} of the run, and it has {quantity(breaking.pressure, 'Pa')}; "
            "a longer run throws farther"
        )
    return lines


def text_of(numbers):
    """The numbers of a pile in lines."""
    model, pile, throw, farthest = numbers.model, numbers.pile, numbers.distribution, numbers.farthest
    lines = ["throw"]
    lines.append("  by mass           " + ", ".join(f"{share:.0%} less than {quantity(throw.size_at(share), 'm')}" for share in (0.5, 0.9, 0.99)))
    lines.append(f"  beyond the toe    {quantity(1e3 * numbers.beyond_toe, 'g')}, {numbers.cast:.1%} of the loose rock")
    lines.append(
        f"  flyrock           {quantity(farthest.throw, 'm')}: fragment {farthest.number} of {quantity(farthest.size, 'm')}, {quantity(1e3 * farthest.mass, 'g')}, "
        f"started at {quantity(farthest.speed, 'm/s')}; {quantity(farthest.range, 'm')} by a flight without drag"
    )
    flying = numbers.flying & ~model.fines
    if np.any(flying):
        lines.append(f"  in the air        {count(flying.sum())} fragments, {quantity(1e3 * model.bodies.mass[flying].sum(), 'g')}: their ends are those of a flight without drag")
    lines.append("pile")
    lines.append(f"  highest           {quantity(pile.height, 'm')}" + ("" if pile.repose is None else f", front at {pile.repose:.0f} degrees"))
    lines.append(
        f"  swell             {pile.swell:.2f} over the rock, {numbers.swell_of_spheres:.2f} over its spheres, which have {numbers.sphere_share:.0%} of its volume; "
        f"bulk {quantity(pile.bulk, 'm³')}"
    )
    if np.any(pile.covered):
        lines.append(f"  not in it         {quantity(1e3 * model.bodies.mass[pile.covered].sum(), 'g')} that lie under rock which stays and overhangs")
    state = "rests" if numbers.rests else "still moves: --end takes a longer time"
    lines.append(f"  at {quantity(numbers.landed.time, 's'):<15}it {state} ({quantity(numbers.rms_speed, 'm/s')} by mass)")
    return lines + _broken(numbers.back_breaks, numbers.at_edge)


def _broken(found, at_edge):
    if not found:
        return []
    behind, left, right = (_reached(found, at_edge, side) for side in ("behind", "left", "right"))
    deepest = max(found, key=lambda one: one.behind)
    where = f" at z = {0.5 * (deepest.lower + deepest.upper):.3g} m, {quantity(sum(one.volume for one in found), 'm³')}" if deepest.behind > 0.0 else ""
    return [
        "rock that came loose outside the design line", f"  behind the holes  {behind}{where}", f"  beside them       {left} left, {right} right of the throw",
    ]


def _reached(found, at_edge, side):
    """The largest distance on a side, in words; where rock came loose up to the side of the model, nobody knows how far it is."""
    most = max(getattr(one, side) for one in found)
    return quantity(most, "m") + (" (the edge of the model)" if getattr(at_edge, side) else "")
