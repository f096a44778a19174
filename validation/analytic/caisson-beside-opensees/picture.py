"""Draws the histories of both programs beside each other: python picture.py OUT.png"""

import sys
import tempfile
from pathlib import Path

import matplotlib.pyplot as plt
from main import ours, theirs
from scene import RUNS

BLUE, RED, GREY = "#0072b2", "#d55e00", "#555555"
LINEAR = (("quadUP", RED, "--"), ("SSPquadUP", GREY, ":"))


def both(axis, time, own, other, label=False):
    """Ours as a line, and every other row of theirs as points."""
    axis.plot(time, own, color=BLUE, label="Sazare, 9 nodes" if label else None)
    axis.plot(time[::2], other[::2], "o", ms=3, mfc="none", color=RED, label="OpenSees, 9_4_QuadUP" if label else None)


def of_linear(axis, runs, kind=""):
    """Pressure at the heel in a few periods, of all elements."""
    time = runs[f"9_4_QuadUP{kind}"][:, 0]
    some = (time >= 4.4) & (time <= 6.0)
    axis.plot(time[some], 1e-3 * runs[f"9_4_QuadUP{kind}"][some, 3], color=BLUE, lw=0.8, label="9 nodes, both")
    axis.plot(time[some], 1e-3 * runs[f"quadUP{kind}"][some, 3], color=BLUE, lw=2, label="Sazare, 4 nodes")
    for name, color, dashes in LINEAR:
        axis.plot(time[some], 1e-3 * theirs(f"{name}{kind}")[some, 3], color=color, ls=dashes, lw=2, label=f"OpenSees, {name}")


def draw(out):
    with tempfile.TemporaryDirectory() as folder:
        runs = {name: ours(Path(folder), *RUNS[name][1:]) for name in ("9_4_QuadUP", "quadUP", "9_4_QuadUP-tight", "quadUP-tight")}
    own, other = runs["9_4_QuadUP"], theirs("9_4_QuadUP")
    time = own[:, 0]
    figure, axes = plt.subplots(2, 2, figsize=(12, 7), constrained_layout=True)
    both(axes[0, 0], time, 1e3 * own[:, 2], 1e3 * other[:, 2], label=True)
    axes[0, 0].set(ylabel="crest of the caisson, vertical [mm]", title="9-node quadrilaterals")
    for column in (3, 5):
        both(axes[0, 1], time, 1e-3 * own[:, column], 1e-3 * other[:, column], label=column == 3)
    axes[0, 1].set(ylabel="excess pore pressure [kPa]", title="9-node quadrilaterals: under the heel, and far from it (lower)")
    of_linear(axes[1, 0], runs)
    axes[1, 0].set(ylabel="excess pore pressure under the heel [kPa]", title="Squares of 1 m, k = 5e-4 m/s")
    of_linear(axes[1, 1], runs, "-tight")
    axes[1, 1].set(title="Squares of 1 m, k = 1e-9 m/s")
    for axis in axes.flat:
        axis.set_xlabel("time [s]")
        axis.legend(loc="upper right", fontsize=8, framealpha=0.9)
        axis.grid(alpha=0.3)
    figure.savefig(out, dpi=100)


if __name__ == "__main__":
    draw(sys.argv[1])
