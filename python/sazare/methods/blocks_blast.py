"""What a report of method blocks says of a blast: sizes, vibration, damage and energy, as pictures and tables."""

from functools import lru_cache, partial

from sazare.blast import curves
from sazare.blast.damage import LEVELS
from sazare.blast.energies import absorbed_by_boundary, parts_of
from sazare.blast.half_casts import factor
from sazare.blast.numbers import BlastNumbers
from sazare.blast.settings import read_settings
from sazare.blast.sizes import SHARES
from sazare.methods import Section, Sheet, common
from sazare.style import quantity


@lru_cache(maxsize=1)  # pictures and tables of one report share them
def numbers_of(results):
    """The BlastNumbers of a run with what `sazare blast` was last given for it."""
    return BlastNumbers(results, read_settings(results))


def sections(results):
    """Pictures of a blast that the run has data for, beside those of its body."""
    numbers = numbers_of(results)
    found = [_size_section(numbers)]
    if numbers.holes:
        found += [_damage_section(numbers), *([_attenuation_section(numbers)] if numbers.shaken else [])]
    if numbers.holes and any(one.frequency for one in numbers.shaken):
        found.append(_limit_section(numbers))
    if absorbed_by_boundary(results):
        found.append(
            Section(
                "radiated", "Energy through boundaries",
                "What the dashpots of each boundary have absorbed: of absorbing boundaries, the energy of waves that left.",
                partial(curves.absorbed_energy, results), "", wide=False,
            )
        )
    return found


def _size_section(numbers):
    return Section(
        "fragment_curve", "Fragment size distribution",
        "Mass passing, without the rock that stays in place: P50 is the size that half of the detached mass passes. Fits cover the sizes that "
        "the mesh can see; in the shaded range more than half of the mass that passes is in fragments of a single element.",
        lambda: curves.size_distribution(numbers.sphere, numbers.sieve, numbers.settings.oversize),
        "No fragment has come loose." if numbers.results.fragments.rows else "The run wrote no fragments.",
    )


def _damage_section(numbers):
    return Section(
        "damage", "Damage around the holes",
        "Broken share of the joint area over the distance from the axis of each hole, every joint with its nearest hole: in rings (thin), "
        "and as the curve that fits best of those that never rise with the distance (thick), from which the radii of damage are read. At the "
        "right the broken area by direction about the axis.",
        lambda: curves.damage_curves(numbers.damages), "No joint has broken, or the run wrote none.",
    )


def _attenuation_section(numbers):
    return Section(
        "attenuation", "Peak particle velocity over distance",
        "Largest magnitude of the velocity at any base step; the line is fitted to logarithms. Gauges in broken rock tell of throw as well as of vibration.",
        lambda: curves.attenuation_curve(numbers.shaken), common.NO_GAUGES,
    )


def _limit_section(numbers):
    return Section(
        "vibration_limits", "Vibration and guidelines",
        "The strongest component of each gauge over its frequency. Limits are for foundations of buildings (DIN 4150-3, table 1) and the "
        "ground beside houses (USBM RI 8507, appendix B); dotted, above the frequencies that they name. They say nothing about gauges in "
        "rock near the holes.",
        lambda: curves.limit_curves(numbers.shaken), common.NO_GAUGES,
    )


def sheets(results):
    """Tables of a blast."""
    numbers = numbers_of(results)
    found = [_energy_sheet(results), _size_sheet(numbers), _vibration_sheet(numbers), _damage_sheet(numbers), _half_cast_sheet(numbers)]
    return [sheet for sheet in found if sheet.rows]


def _energy_sheet(results):
    rows = [
        (part.name, quantity(part.value, "J"), "" if part.share is None else f"{part.share:.1%}", part.meaning) for part in parts_of(results.figures)
    ]
    absorbed = absorbed_by_boundary(results)
    words = "Through boundaries: " + ", ".join(f"{name} {quantity(joules, 'J')}" for name, joules in absorbed.items()) + "." if absorbed else ""
    return Sheet("energy_words", "Where the energy has gone", ("part", "energy", "of the work", "what it means"), rows, words, wide=True)


def _size_sheet(numbers):
    sphere, sieve = numbers.sphere, numbers.sieve
    if not len(sphere.sizes):
        return Sheet("sizes", "Sizes of fragments", (), [])
    rows = [
        (f"P{100 * share:.0f}", quantity(sphere.size_at(share), "m"), "" if sieve is None else quantity(sieve.size_at(share), "m")) for share in SHARES
    ]
    oversize = numbers.settings.oversize
    if oversize is not None:
        rows.append((f"above {quantity(oversize, 'm')}", f"{sphere.oversize(oversize):.1%}", "" if sieve is None else f"{sieve.oversize(oversize):.1%}"))
    return Sheet(
        "sizes", "Sizes of fragments", ("by mass", "equivalent sphere", "sieve"), rows,
        "Without the rock that stays: fragments on fixed, absorbing or prescribed boundaries, and the largest one where it has moved less than "
        "half as far as the others. Sieve: the side of the smallest square opening that the fragment's smallest box passes.",
    )


def _vibration_sheet(numbers):
    rows = [
        (
            one.name, quantity(one.ppv, "m/s") + (" and rising" if one.rises else ""), "" if one.frequency is None else quantity(one.frequency, "Hz"),
            "" if one.distance is None else quantity(one.distance, "m"),
            "" if one.charge is None else f"{one.scaled_distance(0.5):.3g}", "" if one.charge is None else f"{one.scaled_distance(1.0 / 3.0):.3g}",
        )
        for one in numbers.shaken
    ]
    titles = ("gauge", "peak", "frequency", "distance", "R/√W [m/kg^½]", "R/W^⅓ [m/kg^⅓]")
    if not any(row[4] for row in rows):
        titles, rows = titles[:4], [row[:4] for row in rows]
    return Sheet(
        "peak_velocities", "Peak particle velocity", titles, rows,
        "Frequency: of the half cycle with the peak of the strongest component, where the run is long enough to hold it and its rows show it. "
        "“And rising”: as fast as ever at the end; a longer run has a higher peak.",
    )


def _damage_sheet(numbers):
    rows = [(one.name, *(quantity(one.radius(level), "m") for level in LEVELS)) for one in numbers.damages]
    return Sheet(
        "damage_radii", "Radii of damage", ("hole", *(f"{100 * level:.0f} % broken" for level in LEVELS)), rows,
        "The distance from the axis up to which that share of the joint area is broken, by the curve of the picture that never rises with the distance.",
    )


def _half_cast_sheet(numbers):
    casts = numbers.half_casts
    rows = [(one.name, quantity(one.length, "m"), quantity(one.half, "m"), quantity(one.whole, "m"), f"{one.standing:.0%}") for one in casts]
    whose = "contour holes" if numbers.settings.contour else "all holes"
    return Sheet(
        "half_casts", "Half-casts", ("hole", "length", "half barrel left", "not broken out", "wall left"), rows,
        f"Half-cast factor of {whose}: {factor(casts):.0%}, the share of their length where half of the wall, less one face of the mesh, is on rock "
        "that stays. Where all of it is, the hole has not broken out: no half-cast shows there until the rock before it is taken away." if casts else "",
    )


def sizes_note(figures):
    """What the summary says beside P50."""
    if figures.get("p20") is None or figures.get("p80") is None:
        return ""
    return f"P20 {quantity(figures['p20'], 'm')}, P80 {quantity(figures['p80'], 'm')}"


def dashpot_note(figures):
    """What the summary says of the energy that the dashpots of joints have dissipated."""
    parts = {part.key: part for part in parts_of(figures)}
    part = parts.get("energy_joint_dashpot")
    share = "" if part is None or part.share is None else f"{part.share:.0%} of the work: "
    return f"{share}damping of waves in rock that has not broken, in place of crushing and fine cracks"
