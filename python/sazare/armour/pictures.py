"""Pictures of damage to armour. Each function returns a matplotlib Figure, or None without data."""

import numpy as np

from sazare import style
from sazare.armour.damage import DISPLACED, SHIFTED


def pictures_of(damage):
    """The pictures that there is data for: (name, matplotlib Figure)."""
    drawn = {"displacements": displacements(damage), "profile": profile(damage)}
    return [(name, figure) for name, figure in drawn.items() if figure is not None]


@style.styled
def displacements(damage):
    """Share of the units that moved farther than a distance, and how far each turned."""
    figure = style.figure(9.0, 3.6)
    left, right = figure.subplots(1, 2)
    ratio = np.sort(damage.ratio)
    left.plot(ratio, 100.0 * np.arange(len(ratio), 0, -1) / len(ratio), color=style.INK)
    for limit, word in ((SHIFTED, "shifted"), (DISPLACED, "displaced")):
        left.axvline(limit, color=style.ACCENT, linewidth=0.9)
        left.text(limit, 98.0, f" {word}", color=style.ACCENT, rotation=90, va="top", ha="left", fontsize="small")
    left.set_xlabel("displacement over D_n")
    left.set_ylabel("units that moved farther [%]")
    left.set_xlim(0.0, max(1.5 * DISPLACED, float(ratio[-1]) * 1.05))
    left.set_ylim(0.0, 100.0)
    right.scatter(damage.ratio, np.degrees(damage.units.turn), s=6, color=style.INK, linewidths=0)
    right.set_xlabel("displacement over D_n")
    right.set_ylabel("rotation [degrees]")
    right.set_xlim(left=0.0)
    right.set_ylim(bottom=0.0)
    return figure


@style.styled
def profile(damage):
    """The cross-section of the layer before and after, means along the shore."""
    if damage.profile is None:
        return None
    figure = style.figure(9.0, 3.6)
    axes = figure.subplots()
    across, (before, after) = damage.profile.across, damage.profile.heights
    axes.plot(across, before, color=style.INK, linewidth=1.0, label="before")
    axes.plot(across, after, color=style.ACCENT, linewidth=1.0, label="after")
    axes.fill_between(across, before, after, where=after < before, color=style.ACCENT, alpha=0.3, linewidth=0, label="eroded")
    axes.set_xlabel("across the shore [m]")
    axes.set_ylabel("surface of the layer [m]")
    axes.set_aspect("equal", adjustable="datalim")
    axes.legend()
    return figure
