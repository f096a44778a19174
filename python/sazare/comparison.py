"""Comparison of two runs."""

from dataclasses import dataclass

import numpy as np

from sazare.results import Results, open_run


@dataclass(frozen=True)
class Comparison:
    """Comparison of two runs.

    figures: name -> (first, second) of the headline figures that both have;
    ppv: gauge -> (first, second) peak particle velocity [m/s] of the gauges that both have;
    history: column -> largest difference relative to the largest magnitude of the first, at times that both have [-];
    same_bits: whether both final states are bit-identical; None where a state hash is missing.
    unfinished: a sentence for each run that has not reached its end, so that final states must differ.
    """

    figures: dict
    ppv: dict
    history: dict
    same_bits: bool | None
    unfinished: tuple = ()

    @property
    def largest_difference(self):
        """The largest of `history`; 0 where there is none."""
        return max(self.history.values(), default=0.0)

    def __str__(self):
        rows = [(name, f"{first:.6g}", f"{second:.6g}") for name, (first, second) in self.figures.items()]
        peaks = [(f"peak velocity, {gauge}", f"{first:.4g} m/s", f"{second:.4g} m/s", _ratio(first, second)) for gauge, (first, second) in self.ppv.items()]
        width = max((len(row[0]) for row in [*rows, *peaks]), default=0)
        lines = [f"{name:<{width}}  {first:>14}  {second:>14}" for name, first, second in rows]
        lines += [f"{name:<{width}}  {first:>14}  {second:>14}  ratio {ratio}" for name, first, second, ratio in peaks]
        bits = {True: "bit-identical final states", False: "final states differ", None: "no state hash to compare"}[self.same_bits]
        return "\n".join([*lines, *self.unfinished, f"histories differ by at most {self.largest_difference:.2e} of their largest magnitude; {bits}"])


# Columns that tell of the machine, not of the simulated body.
OF_THE_MACHINE = {"wall_seconds"}


def compare(first, second):
    """Compares two runs, given as Results or folders. Raises NotARun where one is none."""
    first, second = (run if isinstance(run, Results) else open_run(run) for run in (first, second))
    common = [name for name in first.figures if name in second.figures and name not in OF_THE_MACHINE]
    peaks = [run.figures.get("ppv", {}) for run in (first, second)]
    hashes = [run.state_hash for run in (first, second)]
    return Comparison(
        {name: (first.figures[name], second.figures[name]) for name in common if _are_numbers(first, second, name)},
        {gauge: (peaks[0][gauge], peaks[1][gauge]) for gauge in peaks[0] if gauge in peaks[1]},
        _history_differences(first.history, second.history),
        hashes[0] == hashes[1] if all(hashes) else None,
        tuple(sentence for word, run in (("first", first), ("second", second)) if (sentence := _unfinished(word, run))),
    )


def _unfinished(word, run):
    """What is to be said of a run that has not reached its end."""
    status = run.manifest.get("status")
    if status == "done":
        return ""
    reached = f"{run.history['time'][-1]:.6g} s" if run.history.rows else "its beginning"
    return f"the {word} run is not complete (status {status}, it has rows to {reached}): compare it again when it is done"


def _ratio(first, second):
    return f"{first / second:.3f}" if second else "-"


def _are_numbers(first, second, name):
    return all(isinstance(run.figures[name], int | float) for run in (first, second))


def _history_differences(first, second):
    if not first.rows or not second.rows:
        return {}
    end = min(first["time"][-1], second["time"][-1])
    times = first["time"][first["time"] <= end]
    found = {}
    for name in first:
        if name == "time" or name not in second or name in OF_THE_MACHINE or first[name].dtype != float or second[name].dtype != float:
            continue
        here = np.interp(times, first["time"], first[name])
        there = np.interp(times, second["time"], second[name])
        size = np.abs(here).max(initial=0.0)
        difference = np.abs(here - there).max(initial=0.0)
        found[name] = float(difference / size) if size else float(difference)
    return found
