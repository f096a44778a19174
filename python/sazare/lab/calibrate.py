"""Strengths of joints for which tests of a specimen give measured values."""

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from sazare.lab import trials
from sazare.lab.machine import carry_out
from sazare.tables import write_table

TOLERANCE = 0.02  # of every measured value
MOST_TRIALS = 24
WIDEST = 4.0  # factor by which a strength may differ from that of the case
STEP = 0.15  # change of a strength from which its influence is found; the scatter of cracks hides that of smaller ones


@dataclass(frozen=True)
class Targets:
    """Measured values [Pa]."""

    uniaxial: float
    tensile: float
    tensile_test: str = "brazilian"  # or "direct-tension"
    confined: float | None = None  # axial stress at the peak under `confinement`
    confinement: float = 0.0


@dataclass(frozen=True)
class Calibrated:
    """The rock that was found, what its tests give over what was measured, and those tests of further meshes."""

    rock: object
    trials: list  # dicts of the columns of calibration.csv, one per trial
    scatter: list  # the same for other meshes
    converged: bool


class _Search:
    """Trials of joint strengths; remembers each, and the best of them."""

    def __init__(self, rock, targets, options, folder, say, machine):
        self.rock, self.targets, self.options, self.folder = rock, targets, options, folder
        self.say, self.machine, self.done = say, machine, []

    def names(self):
        return ["cohesion", "tensile_strength", *(["friction_coefficient"] if self.targets.confined else [])]

    def rock_at(self, factors):
        """The rock with strengths at given ratios to those of the case."""
        joint = self.rock.joint
        found = self.rock.with_joint(cohesion=float(joint.cohesion * factors[0]), tensile_strength=float(joint.tensile_strength * factors[1]))
        return found.with_friction(float(self.rock.friction * factors[2])) if len(factors) > 2 else found

    def test(self, rock, options, folder):
        """Measured over targets, in the order of `names`."""
        targets = self.targets
        tensile = trials.brazilian if targets.tensile_test == "brazilian" else trials.direct_tension
        wanted = [(trials.uniaxial(rock, options), targets.uniaxial), (tensile(rock, replace(options, platens=None)), targets.tensile)]
        if targets.confined:
            wanted.append((trials.triaxial(rock, options, targets.confinement), targets.confined))
        ratios, row = [], {name: getattr(rock.joint, name) for name in ("cohesion", "tensile_strength")} | {"friction_coefficient": rock.friction}
        for trial, target in wanted:
            tested = self.machine(trial, folder / trial.test)
            ratios.append(tested.figures["peak_stress"] / target)
            row[trial.test.replace("-", "_")] = tested.figures["peak_stress"]
        return np.array(ratios), row

    def __call__(self, factors):
        """Logarithms of the ratios at given factors. Raises _Enough where they are near enough, or after too many trials."""
        number = len(self.done) + 1
        rock = self.rock_at(factors)
        ratios, row = self.test(rock, self.options, self.folder / f"trial-{number}")
        worst = float(np.abs(ratios - 1.0).max())
        self.done.append({"factors": np.array(factors), "worst": worst, "row": {"trial": number, **row}})
        self.say(number, rock, row, ratios)
        if worst <= TOLERANCE or number >= MOST_TRIALS:
            raise _Enough
        return np.log(ratios)


class _Enough(Exception):
    """The search may end."""


def calibrate(rock, targets, options, folder, *, meshes=3, say=lambda *_: None, machine=carry_out):
    """Finds the cohesion and the tensile strength of the joints, and their friction where a confined test is among the targets, for which
    the peaks are those measured, by least squares; then tests `meshes` - 1 other meshes. A strength may become four times or a quarter of that of the case.

    say: called after every trial with its number, the rock, its peaks and their ratios to the targets. machine: carries out a trial in a folder.
    Returns the best trial. Writes calibration.csv and scatter.csv.
    """
    from scipy.optimize import least_squares  # here, since it takes long to load

    folder = Path(folder)
    search = _Search(rock, targets, options, folder, say, machine)
    try:
        start = np.ones(len(search.names()))
        least_squares(search, start, bounds=(1.0 / WIDEST, WIDEST), diff_step=STEP, max_nfev=MOST_TRIALS)
    except _Enough:
        pass
    best = min(search.done, key=lambda trial: trial["worst"])
    _write(folder / "calibration.csv", [trial["row"] for trial in search.done])
    found = search.rock_at(best["factors"])
    scatter = [{"mesh": options.seed, **{name: value for name, value in best["row"].items() if name != "trial"}}]
    scatters = rock.joint.weibull_modulus is not None
    for seed in range(options.seed + 1, options.seed + meshes):
        ratios, row = search.test(found, replace(options, seed=seed, scatter_seed=seed if scatters else None), folder / f"mesh-{seed}")
        scatter.append({"mesh": seed, **row})
        say(f"mesh {seed}", found, row, ratios)
    _write(folder / "scatter.csv", scatter)
    return Calibrated(found, [trial["row"] for trial in search.done], scatter, best["worst"] <= TOLERANCE)


def _write(path, rows):
    units = {"trial": "-", "mesh": "-", "friction_coefficient": "-"}
    write_table(path, {f"{name} [{units.get(name, 'Pa')}]": [row[name] for row in rows] for name in rows[0]})
