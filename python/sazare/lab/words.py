"""Results of tests in words."""

import math

from sazare.lab.envelope import HoekBrown
from sazare.lab.trials import FEWEST_ACROSS, PASSES

UNCALM = 0.05  # difference of the forces of the platens, over the peak, above which a test is not quasi-static
ROLLING = 0.95  # of friction times normal stress, below which a residual stress is not that of friction
LEAKING = 0.01  # of the energy residual over the work

MEGA = ("MPa", 1e6)
GIGA = ("GPa", 1e9)
FIGURES = (
    ("peak_stress", "peak stress", MEGA),
    ("deviatoric_stress", "less the confinement", MEGA),
    ("peak_load", "largest load", ("kN", 1e3)),
    ("point_load_index_50", "index of a 50 mm core", MEGA),
    ("residual_stress", "residual stress", MEGA),
    ("residual_scatter", "  it scatters by", MEGA),
    ("peak_strain", "strain of the platens there", ("1e-3", 1e-3)),
    ("youngs_modulus", "Young's modulus", GIGA),
    ("poisson_ratio", "Poisson's ratio", ("", 1.0)),
    ("crack_initiation_stress", "cracks begin at", MEGA),
    ("crack_damage_stress", "smallest volume at", MEGA),
)


def before(trial):
    """Lines about a test that is about to begin."""
    loading = "at a strain rate of" if trial.is_dynamic else f"in {PASSES:g} passes of a P-wave until failure, a strain rate of"
    return [
        f"{trial.title}: {trial.specimen.words}, elements of {1e3 * trial.specimen.size:.3g} mm, platens {trial.platens}",
        f"  loaded {loading} {trial.strain_rate:.3g} per s ({trial.speed:.3g} m/s)",
    ]


def after(tested):
    """Lines about a test that has ended."""
    figures, trial = tested.figures, tested.trial
    lines = [f"  {words:<28}{figures[name] / unit[1]:.4g} {unit[0]}".rstrip() for name, words, unit in FIGURES if name in figures]
    if trial.measures_strain and "youngs_modulus" in figures:
        lines.append(f"  {'of the case':<28}{trial.rock.youngs_modulus / 1e9:.4g} GPa, {trial.rock.material.poisson_ratio:.4g}")
    kinds = tested.results.figures
    shear = int(kinds.get("broken_in_shear", 0))
    lines.append(f"  {'cracks at the end':<28}{figures['cracks'] - shear} by opening, {shear} by shear; {figures['cracks_at_peak']} at the peak")
    lines += [f"  warning: {words}" for words in doubts(tested)]
    return lines


def envelopes(lines):
    """A line about each envelope, or why there is none."""
    for name, line in lines.items():
        if isinstance(line, str):
            yield f"{name}: none: {line}"
        elif isinstance(line, HoekBrown):
            yield f"{name}: strength {1e-6 * line.uniaxial_strength:.4g} MPa, m {line.m:.3g}"
        else:
            yield f"{name}: cohesion {1e-6 * line.cohesion:.4g} MPa, friction angle {line.friction_angle:.3g} degrees"


def doubts(tested):
    """Why the figures of a test may not be those of the rock."""
    figures, trial = tested.figures, tested.trial
    if trial.elements_across < FEWEST_ACROSS:
        enough = math.ceil(trial.options.elements * FEWEST_ACROSS / trial.elements_across - 1e-9)
        yield (
            f"{trial.elements_across:.2g} elements over the width of the specimen, so strength follows the mesh; from {FEWEST_ACROSS} on it "
            f"does less: --elements {enough}"
        )
    if not figures["failed"]:
        yield f"the stress still grew when the test ended, so the specimen did not fail: --strain {1.5 * tested.curve['platen_strain'][-1]:.2g} goes on for longer"
    if figures["imbalance"] > UNCALM:
        differ = f"before the peak the forces of the two platens differ by up to {100.0 * figures['imbalance']:.2g} % of it, so "
        yield differ + ("inertia has a part in it, as at this rate it may" if trial.is_dynamic else f"the test is not quasi-static: {_half_as_fast(trial)}")
    if figures.get("residual_scatter", 0.0) > UNCALM * abs(figures.get("residual_stress", 0.0)):
        yield f"the residual stress scatters, since the specimen that has broken swings and its pieces catch on each other: {_half_as_fast(trial)}"
    yield from _rolling(figures, trial)
    if abs(figures.get("energy_residual", 0.0)) > LEAKING:
        yield f"the energy balance is off by {100.0 * abs(figures['energy_residual']):.2g} % of the work: see the report of the run"


def _rolling(figures, trial):
    """Why the residual stress is less than contacts with friction would carry."""
    friction = trial.rock.contact.friction_coefficient
    if "residual_stress" in figures and friction and trial.pressure and figures["residual_stress"] < ROLLING * friction * trial.pressure:
        spheres = trial.rock.contact.contact_shape != "faces"
        why = 'broken pieces turn on the spheres of their contacts, which contact_shape = "faces" has not' if spheres else "broken pieces turn between the halves"
        yield f"the residual stress is {figures['residual_stress'] / trial.pressure:.2g} of the normal stress, less than the friction of contacts, {friction:g}: {why}"


def _half_as_fast(trial):
    return f"--strain-rate {0.5 * trial.strain_rate:.2g} is half as fast"


def scatter(calibrated):
    """Lines about peaks of several meshes: mean and half of the range."""
    rows = calibrated.scatter
    if len(rows) < 2:
        return
    yield f"with {len(rows)} meshes of elements of this size:"
    for name in list(rows[0])[4:]:
        peaks = [row[name] for row in rows]
        yield f"  {name.replace('_', ' '):<28}{1e-6 * sum(peaks) / len(peaks):.4g} MPa, from {1e-6 * min(peaks):.4g} to {1e-6 * max(peaks):.4g}"
