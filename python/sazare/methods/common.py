"""Sections, figures and verdicts that several methods have alike."""

from functools import partial

import numpy as np

from sazare import plot, shaking, structures, wave_fronts
from sazare.ground_motion.gauges import gauge_table
from sazare.ground_motion.profiles import profile_table
from sazare.methods import Section, Sheet
from sazare.style import count, quantity, round_factor

# Residuals up to the first count as good, above the second as bad; as shares of the work.
GOOD_BALANCE, BAD_BALANCE = 1e-4, 1e-2
USELESS_BALANCE = 0.1  # of a method whose time step alone does not govern the balance

NO_SNAPSHOTS = "The run wrote no snapshots."
NO_GAUGES = "The case has no gauges."
NO_HISTORY = "The run wrote no history."
NO_ACCELERATIONS = "The case has no gauges, or fewer than 16 rows of their accelerations."


def energy_section(results, terms, work="the external work"):
    """The energy balance. terms: column of the history -> (name, colour), from the bottom of the stack up."""
    return Section(
        "energy", "Energy balance",
        f"Stored and dissipated energy by cause, stacked, and {work}; below, the residual as a share of the work.",
        partial(plot.energy, results, terms), "The run wrote no energies.",
    )


def timing_section(results, whole="the run"):
    """Computing time by part."""
    return Section(
        "timing", "Timing by part", f"Computing time by part of {whole}.", partial(plot.timing, results), "The run wrote no timing.",
        wide=False,
    )


def boundary_force_section(results):
    return Section(
        "forces", "Boundary forces", "Force of each boundary on the body; the components that vary most.",
        partial(plot.boundary_forces, results), "The case has no boundaries.", wide=False,
    )


def shaking_sections(results):
    """Acceleration at the gauges over time, and its spectra."""
    return [
        Section(
            "accelerations", "Accelerations", "Acceleration at the gauges along the axis of the input motion, the highest one on top; dots mark the peaks.",
            partial(shaking.accelerations, results), NO_GAUGES,
        ),
        Section(
            "spectra", "Spectra", "Fourier amplitude spectra at the lowest and the highest gauge, and their ratio.",
            partial(shaking.spectra, results), "There are fewer than two gauges.",
        ),
        Section(
            "response_spectra", "Response spectra",
            "Pseudo acceleration of oscillators with 5 % damping at the gauges, in m/s² and gal, and its ratio to that at the lowest gauge.",
            partial(shaking.response_spectra, results), NO_ACCELERATIONS,
        ),
        Section(
            "husid", "Arias intensity", "Growth of the Arias intensity at the gauges along the axis of the input motion.",
            partial(shaking.husid_curves, results), NO_ACCELERATIONS,
        ),
        Section(
            "profiles", "Peaks over height", "Largest acceleration, velocity and displacement of gauges that stand above each other; below, the largest shear strain between "
            "neighbouring ones, and the shear stress that the motion of the ground above needs, where its density is known.",
            partial(shaking.profiles, results), "No two gauges with accelerations stand above each other, or the case does not tell where they are.",
        ),
        Section(
            "relative", "Motion relative to the base", "Displacement of the gauges less that of the lowest one; the legend gives what remains at the end.",
            partial(shaking.relative_displacements, results), "There are fewer than two gauges with accelerations.",
        ),
    ]


def wave_sections(results):
    """The way of the first wave through the ground."""
    return [
        Section(
            "wave_fronts", "Wave fronts",
            "Acceleration along the axis of the input motion over a section, of a column over its height, while the first wave goes up; where the snapshots are too far apart "
            "for that, when it is largest.",
            partial(wave_fronts.fronts, results), "No motion enters from below, or there are fewer than two snapshots.", places=True,
        ),
        Section(
            "wave_section", "Time against height",
            "Acceleration at gauges above each other, each trace at its height; the lines are an S wave that leaves the lowest gauge when the motion has begun there "
            "(5 % of its peak acceleration), and comes down from the highest one again.",
            partial(wave_fronts.section, results), "No two gauges with accelerations stand above each other where a motion enters.",
        ),
    ]


def shaking_tables(results):
    """Figures of the motion at the gauges, beside the report."""
    return {"ground_motion.csv": gauge_table(results), "profiles.csv": profile_table(results), **structure_tables(results)}


def structure_tables(results):
    """What remains of structures, beside the report."""
    return {"structures.csv": structures.structure_table(results)}


def structure_sheets(results):
    """What remains of structures at the end, and their largest values."""
    table = structures.structure_table(results)
    if not table:
        return []
    titles = ("structure", "displacement at the end", "largest", "settlement at the end", "largest", "tilt at the end", "largest")
    units = {"displacement [m]": "m", "settlement [m]": "m", "tilt [deg]": "°"}
    columns = [[_with_unit(value, unit) for value in table[f"{when}_{what}"]] for what, unit in units.items() for when in ("residual", "peak")]
    names = [name if still else f"{name} (still moves)" for name, still in zip(table["structure"], table["at_rest [-]"])]
    words = (f"Against {table['against'][0]}, along {table['axis'][0]}; settlement is downwards, tilt positive towards {table['axis'][0]}. "
             "Of bodies the rigid motion that fits best, at the snapshots; of gauges every row.")
    return [Sheet("structures", "Structures", titles, list(zip(names, *columns, strict=True)), words, wide=True)]


def _with_unit(value, unit):
    if not np.isfinite(value):
        return "–"
    return f"{value:.3g}{unit}" if unit == "°" else quantity(value, unit)


def enlargement(displacement, extent, largest, shown):
    """A round factor with which the largest displacement (n, 3) [m] is a share `shown` of the extent [m] of the body at most.

    1 where it is a share `largest` itself.
    """
    size = np.linalg.norm(displacement, axis=1).max(initial=0.0)
    return 1.0 if size <= 0.0 or size > largest * extent else round_factor(shown * extent / size)


def set_free(figures):
    """Energy that was stored or in motion at the beginning and is not any more [J]."""
    return sum(max(0.0, -(figures.get(name) or 0.0)) for name in ("energy_elastic", "energy_kinetic"))


def energy_balance(figures):
    """The energy residual as a share of the work and of the energy set free; None where it cannot be computed."""
    work, residual = figures.get("energy_work"), figures.get("energy_residual")
    if work is None or residual is None:
        return None
    whole = abs(work) + set_free(figures)
    return abs(residual) / whole if whole else None


def balance_verdict(results, reference="work"):
    """The verdict of a run by its energy balance: fair where that is not good. reference: what the residual is a share of, in words."""
    balance = energy_balance(results.figures)
    if balance is None:
        return missing_balance_verdict(results.figures)
    return "good" if balance <= BAD_BALANCE else "fair", balance_words(balance, reference)


def missing_balance_verdict(figures):
    """The verdict of a run without an energy balance: bad where its energies are no numbers, which the manifest writes as null."""
    if any(name in figures and figures[name] is None for name in ("energy_work", "energy_residual")):
        return "bad", "The run is complete, but its energies are not finite numbers. Look at the sizes and speeds of the case."
    return "fair", "The run is complete. Its energy balance is not available."


def strict_balance_verdict(results, good=GOOD_BALANCE, bad=BAD_BALANCE, reference="work"):
    """The verdict by the energy balance for a method whose time step governs it: good, fair or bad, and what to do about it."""
    balance = energy_balance(results.figures)
    if balance is None:
        return missing_balance_verdict(results.figures)
    words = balance_words(balance, f"{reference} and of the energy set free" if set_free(results.figures) > 0 else reference)
    if balance <= good:
        return "good", words
    if balance <= bad:
        return "fair", f"{words} It should be below {good:.0e}: consider a smaller stability_fraction."
    return "bad", f"{words} This is too large for reliable results: use a smaller stability_fraction."


def largest_share(table, residuals, references):
    """The largest sum of the residuals (columns of a history) over the largest of the references; None where it cannot be computed.

    A residual that comes and goes counts as one that stays, and work that is taken back is work.
    """
    known = [name for name in references if name in table]
    if not known or not table.rows or any(name not in table for name in residuals):
        return None
    scale = max(np.abs(table[name]).max() for name in known)
    return float(np.abs(sum(table[name] for name in residuals)).max() / scale) if scale > 0.0 else None


def is_round_off(results):
    """Whether all energies of a run stay below what round-off may make up, as where a body moves as a whole."""
    noise = results.figures.get("energy_round_off")
    names = [name for name in results.history if name.startswith("energy_")]
    return bool(noise) and bool(names) and all(np.abs(results.history[name]).max(initial=0.0) <= noise for name in names)


def graded(share, words, advice):
    """The verdict of a run whose energy is off by a share: good up to a hundredth, bad above a tenth."""
    if share is None:
        return "fair", "The run is complete. Its energy balance is not available."
    if share <= BAD_BALANCE:
        return "good", words
    if share <= USELESS_BALANCE:
        return "fair", f"{words} It should be below {BAD_BALANCE:.0e}: {advice}."
    return "bad", f"{words} This is too large for reliable results: {advice}."


def balance_words(balance, reference="work"):
    """An energy balance as a sentence."""
    return f"The run is complete. The energy residual is {balance:.1e} of the {reference}."


def share_note(part, whole):
    """The note of a figure that is part of another one, such as `of 120, 25%`."""

    def note(figures):
        if not figures.get(whole) or figures.get(part) is None:
            return ""
        return f"of {count(figures[whole])}, {figures[part] / figures[whole]:.0%}"

    return note


def said(words):
    """The note of a figure whose note is always these words."""
    return lambda _: words


def count_note(key, words):
    """The note of a figure beside which a count stands, such as `120 elements`."""
    return lambda figures: f"{count(figures[key])} {words}" if figures.get(key) is not None else ""


def quantity_note(key, before, unit):
    """The note of a figure beside which another quantity stands, such as `P80 210 mm`."""
    return lambda figures: f"{before}{quantity(figures[key], unit)}" if figures.get(key) is not None else ""
