"""Pictures of tests: stress over strain with cracks, and envelopes with the circles of their peaks."""

import numpy as np

from sazare import style
from sazare.lab.trials import TITLES

COLOURS = ("#b5472f", "#2f6f8f", "#7a9a3f", "#8a5a34", "#8069c0", "#d1b13c")


@style.styled
def curve(tested):
    """Stress over strain, of the platens and in the middle of the specimen, with the number of broken joints."""
    trial, columns = tested.trial, tested.curve
    figure = style.figure(7.6, 4.6)
    axes = figure.subplots()
    if trial.test == "direct-shear":
        across, label = 1e3 * columns["displacement"], "displacement of the upper half [mm]"
    else:
        across, label = 1e3 * columns["platen_strain"], "strain [1e-3]"
    stress = 1e-6 * columns["stress"]
    cracks = axes.twinx()
    cracks.fill_between(across, columns["broken_joints"], color=style.STONE_EDGE, alpha=0.45, linewidth=0.0, step="post")
    cracks.set_ylabel("broken joints")
    cracks.set_ylim(bottom=0)
    cracks.grid(False)
    cracks.spines["right"].set_visible(True)
    axes.set_zorder(cracks.get_zorder() + 1)
    axes.patch.set_visible(False)
    axes.plot(across, stress, color=style.ACCENT, linewidth=2.0, label="of the platens")
    peak = int(np.argmax(columns["stress"]))
    if trial.measures_strain:
        # After the peak the middle is no continuum, so that its mean strains mean nothing.
        for name, words, colour in (
            ("axial_strain", "axial, middle of the specimen", style.SECOND), ("lateral_strain", "lateral", "#7a9a3f"), ("volumetric_strain", "volumetric", "#8069c0"),
        ):
            axes.plot(1e3 * columns[name][: peak + 1], stress[: peak + 1], color=colour, linewidth=1.5, label=words)
        axes.legend(loc="best")
    axes.plot(across[peak], stress[peak], "o", color=style.INK, markersize=5)
    axes.annotate(f"{stress[peak]:.4g} MPa", (across[peak], stress[peak]), xytext=(-6, 5), textcoords="offset points", ha="right")
    axes.set_ylim(bottom=min(0.0, stress.min()), top=1.12 * stress.max())
    axes.set_xlabel(label)
    axes.set_ylabel(f"{STRESSES[trial.test]} [MPa]")
    axes.set_title(trial.title)
    return figure


STRESSES = {
    "uniaxial": "axial stress",
    "triaxial": "axial stress",
    "brazilian": "splitting stress 2 P/(pi D t)",
    "direct-tension": "tensile stress",
    "direct-shear": "shear stress",
    "point-load": "point load index P/De^2",
}


@style.styled
def curves(series):
    """Stress over strain of the platens of several tests of one kind."""
    figure = style.figure(6.6, 4.2)
    axes = figure.subplots()
    for tested, colour in zip(series, _colours(series)):
        axes.plot(1e3 * tested.curve["platen_strain"], 1e-6 * tested.curve["stress"], color=colour, linewidth=1.6, label=f"{1e-6 * tested.trial.pressure:.4g} MPa")
    first = series[0].trial
    axes.set_xlabel("displacement of the platen over the length of the specimen [1e-3]")
    axes.set_ylabel(f"{STRESSES[first.test]} [MPa]")
    axes.set_title(f"{TITLES[first.test]} of {first.rock.name}")
    axes.legend(title="normal stress" if first.test == "direct-shear" else "confinement")
    axes.set_ylim(bottom=0)
    return figure


@style.styled
def envelope(series, straight, curved=None):
    """Circles of the peaks with the straight envelope, beside axial stresses over confinements with both envelopes."""
    confinements = np.array([tested.trial.pressure for tested in series])
    peaks = np.array([tested.figures["peak_stress"] for tested in series])
    figure = style.figure(10.4, 4.2)
    circles, axes = figure.subplots(1, 2)
    angle = np.linspace(0.0, np.pi, 121)
    for low, high, colour in zip(confinements, peaks, _colours(series)):
        circles.plot(1e-6 * (0.5 * (low + high) + 0.5 * (high - low) * np.cos(angle)), 1e-6 * 0.5 * (high - low) * np.sin(angle), color=colour)
    normal = np.linspace(0.0, 0.5 * (confinements.max() + peaks.max()), 2)
    shear = straight.cohesion + np.tan(np.radians(straight.friction_angle)) * normal
    circles.plot(1e-6 * normal, 1e-6 * shear, color=style.INK, linestyle="--")
    circles.set_aspect("equal")
    circles.set_ylim(bottom=0)
    circles.set_xlabel("normal stress [MPa]")
    circles.set_ylabel("shear stress [MPa]")
    circles.set_title(f"c = {1e-6 * straight.cohesion:.3g} MPa, friction angle {straight.friction_angle:.3g} degrees")
    across = np.linspace(0.0, 1.05 * confinements.max(), 101)
    axes.plot(1e-6 * across, 1e-6 * straight.strength(across), color=style.INK, linestyle="--", label="Mohr-Coulomb")
    if curved is not None:
        axes.plot(1e-6 * across, 1e-6 * curved.strength(across), color=style.SECOND, label=f"Hoek-Brown, m = {curved.m:.3g}")
    axes.plot(1e-6 * confinements, 1e-6 * peaks, "o", color=style.ACCENT, label="tests")
    axes.set_xlabel("confinement [MPa]")
    axes.set_ylabel("axial stress at the peak [MPa]")
    axes.set_ylim(bottom=0)
    axes.legend()
    return figure


@style.styled
def shear_envelope(series, peak, residual):
    """Peak and residual shear stress over normal stress, with the straight lines through them."""
    figure = style.figure(5.6, 4.2)
    axes = figure.subplots()
    normal = np.array([tested.trial.pressure for tested in series])
    across = np.linspace(0.0, 1.05 * normal.max(), 2)
    for name, line, colour in (("peak_stress", peak, style.ACCENT), ("residual_stress", residual, style.SECOND)):
        axes.plot(1e-6 * normal, [1e-6 * tested.figures[name] for tested in series], "o", color=colour)
        words = f"{name.split('_')[0]}: c = {1e-6 * line.cohesion:.3g} MPa, friction angle {line.friction_angle:.3g} degrees"
        axes.plot(1e-6 * across, 1e-6 * (line.cohesion + np.tan(np.radians(line.friction_angle)) * across), color=colour, linestyle="--", label=words)
    axes.set_xlabel("normal stress [MPa]")
    axes.set_ylabel("shear stress [MPa]")
    axes.set_ylim(bottom=0)
    axes.legend()
    return figure


def _colours(series):
    return [COLOURS[number % len(COLOURS)] for number in range(len(series))]
