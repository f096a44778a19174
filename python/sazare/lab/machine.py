"""The testing machine: carries out trials, and writes what was measured."""

import json
from dataclasses import dataclass
from pathlib import Path

from sazare.lab.figures import figures_of
from sazare.lab.folders import claim
from sazare.lab.measure import Watch, write_curve
from sazare.lab.trials import ROWS, Trial
from sazare.results import Results, open_run
from sazare.simulation import build
from sazare.tables import write_table

CASE, CURVE, FIGURES, RUN = "case.toml", "curve.csv", "figures.json", "run"


@dataclass(frozen=True)
class Tested:
    """A specimen that has been tested."""

    trial: Trial
    folder: Path
    curve: dict  # columns of curve.csv by name
    figures: dict  # by name, SI units; those of `sazare.lab.figures`, and the energy residual over the work

    @property
    def results(self) -> Results:
        """The run of the test."""
        return open_run(self.folder / RUN)


def carry_out(trial, folder, *, threads=0, overwrite=False, progress=True):
    """Tests a specimen, with all files in `folder`: the case and what it names, the run, curve.csv and figures.json.

    Raises Occupied where the folder holds something else, or this test and `overwrite` is false. After Ctrl-C curve.csv holds what was measured until then.
    """
    folder = Path(folder)
    claim(folder, trial.test, [trial.pressure], overwrite)
    (folder / "specimen.geo").write_text(trial.specimen.geometry, encoding="utf-8")
    write_table(folder / "platen.csv", trial.platen_rows())
    if trial.pressure:
        write_table(folder / "pressure.csv", {"time [s]": [0.0, 1.01 * trial.end], "pressure [Pa]": [trial.pressure, trial.pressure]})
    (folder / CASE).write_text(trial.case().to_toml(), encoding="utf-8")
    with build(folder / CASE, folder / RUN, threads=threads, overwrite=overwrite, progress=progress) as simulation:
        watch = Watch(trial, simulation)
        simulation.every(simulation.end / ROWS, watch)
        try:
            simulation.run()
        finally:
            simulation.stop()
            history = simulation.results.history
            curve = write_curve(folder / CURVE, trial, history, watch.strains)
    figures = figures_of(trial, curve)
    if history["energy_work"][-1] > 0.0:
        figures["energy_residual"] = float(history["energy_residual"][-1] / history["energy_work"][-1])
    (folder / FIGURES).write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")
    return Tested(trial, folder, curve, figures)
