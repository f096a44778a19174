"""The numbers of a blast as lines for a terminal."""

from sazare.blast.damage import LEVELS
from sazare.blast.energies import absorbed_by_boundary, parts_of
from sazare.blast.half_casts import factor
from sazare.blast.sizes import SHARES
from sazare.style import quantity


def text_of(numbers):
    """What there is of sizes, vibration, damage and energy of BlastNumbers, in lines."""
    parts = [_ending(numbers.results), _sizes(numbers), _vibration(numbers), _damage(numbers), _half_casts(numbers), _energy(numbers.results)]
    return "\n".join(line for lines in parts for line in lines)


def _ending(results):
    status = results.manifest.get("status", "done")
    return [] if status == "done" else [f"the run has not come to its end (status {status}): this is what it had until then"]


def _sizes(numbers):
    sphere, sieve, oversize = numbers.sphere, numbers.sieve, numbers.settings.oversize
    if not len(sphere.sizes):
        return ["sizes: no fragment has come loose" if numbers.results.fragments.rows else "sizes: the run wrote no fragments"]
    ways = [("equivalent sphere", sphere), *([("sieve size", sieve)] if sieve is not None else [])]
    lines = [f"sizes of {len(sphere.sizes)} detached fragments, by mass"]
    for name, distribution in ways:
        words = ", ".join(f"P{100 * share:.0f} {quantity(distribution.size_at(share), 'm')}" for share in SHARES)
        more = "" if oversize is None else f", {distribution.oversize(oversize):.1%} above {quantity(oversize, 'm')}"
        lines.append(f"  {name:<18}{words}{more}")
    limit = numbers.sizes.mesh_limit
    if limit == float("inf"):
        lines.append("  single elements make up most of the mass: a finer mesh is needed for sizes")
    elif limit > 0.0:
        lines.append(f"  limit of the mesh {quantity(limit, 'm')}: below it sizes are those of elements")
    for fit in numbers.fits:
        parameters = ", ".join(f"{name} {value:.3g}" for name, value in fit.parameters.items())
        lines.append(f"  {fit.name:<18}{parameters}; r2 {fit.r2:.4f}, off by {100 * fit.worst:.1f} % at most")
    if not numbers.fits:
        lines.append("  no fit: too few sizes above the limit of the mesh")
    return lines


def _vibration(numbers):
    if not numbers.shaken:
        return ["vibration: the run has no gauges"]
    lines = ["vibration"]
    width = max(18, *(len(one.name) + 2 for one in numbers.shaken))
    for one in numbers.shaken:
        words = [quantity(one.ppv, "m/s") + (", rising at the end" if one.rises else "")]
        words += [f"{quantity(one.frequency, 'Hz')}"] if one.frequency is not None else []
        words += [f"{quantity(one.distance, 'm')} from the nearest charge"] if one.distance is not None else []
        words += [f"R/W^(1/2) {one.scaled_distance(0.5):.3g}"] if one.charge is not None else []
        lines.append(f"  {one.name:<{width}}{', '.join(words)}")
    for over, law in numbers.laws.items():
        if law is not None:
            lines.append(f"  ppv = {law.factor:.3g} m/s ({over})^{law.exponent:.2f}; r2 {law.r2:.3f}, {law.points} gauges")
    return lines


def _damage(numbers):
    if not numbers.damages:
        return []
    titles = ", ".join(f"{100 * level:.0f} %" for level in LEVELS)
    lines = [f"damage: distance from the axis of the hole up to which {titles} of the joint area are broken"]
    return lines + [f"  {one.name:<18}{', '.join(quantity(one.radius(level), 'm') for level in LEVELS)}" for one in numbers.damages]


def _half_casts(numbers):
    casts = numbers.half_casts
    if not casts:
        return []
    whole, length = sum(one.whole for one in casts), sum(one.length for one in casts)
    lines = [f"half-casts: {factor(casts):.0%} of {quantity(length, 'm')} of {'contour ' if numbers.settings.contour else ''}holes have a half barrel on the rock that stays"]
    if whole > 0.0:
        lines.append(f"  of it {quantity(whole, 'm')} have not broken out")
    return lines + [f"  {one.name:<18}{quantity(one.half, 'm')} of {quantity(one.length, 'm')}" for one in casts]


def _energy(results):
    parts = parts_of(results.figures)
    lines = ["energy"] if parts else []
    for part in parts:
        share = "" if part.share is None else f"{part.share:6.1%}  "
        lines.append(f"  {part.name:<28}{share}{quantity(part.value, 'J'):<9}  {part.meaning.split('. ')[0].rstrip('.')}.")
    absorbed = [f"{name} {quantity(joules, 'J')}" for name, joules in absorbed_by_boundary(results).items()]
    return lines + ([f"  through boundaries: {', '.join(absorbed)}"] if absorbed else [])
