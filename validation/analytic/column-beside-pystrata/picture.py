"""Spectra of the surface in all programs: writes spectra.png beside this file."""

import tempfile
from pathlib import Path

import matplotlib
from ground import HERE, PERIODS

matplotlib.use("Agg")
from main import CASES, by_differences, ours, theirs  # noqa: E402

from sazare import style  # noqa: E402

WORDS = {"weak": "weak, no damping", "damped": "weak, Rayleigh damping", "strong": "strong"}


def main():
    pystrata = theirs()
    figure = style.figure(11.0, 3.8)
    with tempfile.TemporaryDirectory() as folder:
        for axes, (name, words) in zip(figure.subplots(1, 3), WORDS.items()):
            axes.loglog(PERIODS, pystrata[name][1:], color=style.INK, linewidth=2.4, label="pyStrata")
            if name == "damped":
                axes.loglog(PERIODS, pystrata["hysteretic"][1:], color=style.INK, linewidth=1.2, linestyle=":", label="pyStrata, 2 % throughout")
            if name == "strong":
                axes.loglog(PERIODS, by_differences(name)[0][1:], color="#3f8f8f", linewidth=2.4, label="finite differences")
            for case, label, colour in zip(CASES.values(), ("finite elements", "particles"), (style.ACCENT, style.SECOND)):
                axes.loglog(PERIODS, ours(Path(folder), case, name)[0][1:], color=colour, linewidth=1.0, label=label)
            axes.set(xlabel="period [s]", title=words, xticks=[0.05, 0.1, 0.2, 0.5, 1, 2, 4], xticklabels=["0.05", "0.1", "0.2", "0.5", "1", "2", "4"])
            axes.tick_params(axis="x", which="minor", labelbottom=False)
            axes.legend()
    figure.axes[0].set_ylabel("pseudo acceleration, 5 % [m/s²]")
    style.save(figure, HERE / "spectra.png")


if __name__ == "__main__":
    main()
