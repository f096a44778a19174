"""A family of runs: its combinations, where they lie, what is done and what remains."""

import json
import multiprocessing
from concurrent.futures import ProcessPoolExecutor, as_completed
from dataclasses import dataclass
from itertools import product
from pathlib import Path

from sazare.folders import Occupied, own, require_folder
from sazare.sweep.figures import figures_of
from sazare.tables import NotARun

MARK = "sweep.json"  # says which family a folder is of
MOST = 10_000  # runs


@dataclass(frozen=True)
class Parameter:
    """A key of a case, such as `charges.0.delay`, or several that have the same value, joined by `&`; and its values as they would stand in the case."""

    key: str
    values: tuple[str, ...]

    @property
    def keys(self):
        """Each of the keys."""
        return [key.strip() for key in self.key.split("&")]


def parameter_of(text):
    """A Parameter from `KEY=VALUE,VALUE,...`; commas within brackets and quotes part no values. Raises ValueError where it is none."""
    key, sign, values = text.partition("=")
    found = _parted(values)
    if not sign or not key.strip() or not all(found):
        raise ValueError(f"'{text}' names no values of a key: write KEY=VALUE,VALUE,..., such as charges.0.delay=0,0.001,0.002")
    if len(set(found)) < len(found):
        raise ValueError(f"'{text}' has a value twice")
    return Parameter(key.strip(), tuple(found))


def _parted(text):
    parts, depth, quote = [""], 0, ""
    for sign in text:
        if quote:
            quote = "" if sign == quote else quote
        elif sign in "\"'":
            quote = sign
        elif sign == "," and depth == 0:
            parts.append("")
            continue
        depth += (sign in "[{") - (sign in "]}") if not quote else 0
        parts[-1] += sign
    return [part.strip() for part in parts]


class Sweep:
    """Runs of a case with every combination of the values of its parameters, the last parameter fastest, each in a folder of its own: 001, 002, ...

    settings: keys that all of them change, each as `table.key=value`. Raises ValueError for parameters that are none, and Occupied where the folder has something else.
    """

    def __init__(self, case, parameters, out, settings=()):
        self.case, self.parameters, self.out, self.settings = Path(case), tuple(parameters), require_folder(out), tuple(settings)
        keys = [key for one in self.parameters for key in one.keys]
        if not keys or len(set(keys)) < len(keys):
            raise ValueError("a sweep varies one key or more, each once: --over KEY=VALUE,VALUE,...")
        self.combinations = list(product(*(one.values for one in self.parameters)))
        if len(self.combinations) > MOST:
            raise ValueError(f"these are {len(self.combinations)} runs, and {MOST} at most are carried out")
        self._claim()

    def _claim(self):
        mark = {"case": str(self.case), "parameters": {one.key: list(one.values) for one in self.parameters}, "settings": list(self.settings)}
        if self.out.is_dir() and any(self.out.iterdir()):
            try:
                found = json.loads((self.out / MARK).read_text(encoding="utf-8"))
            except (OSError, ValueError):
                raise Occupied(f"{self.out}: there are files in it that are no sweep, so nothing is written there: --out DIR takes another folder") from None
            if found != mark:
                raise Occupied(f"{self.out}: there is a sweep over other values, or of another case, in it: --out DIR takes another folder, or delete this one")
        self.out.mkdir(parents=True, exist_ok=True)
        own(self.out / MARK).write_text(json.dumps(mark) + "\n", encoding="utf-8")

    def folder(self, number):
        """The folder of a run by its number, from 0 on."""
        return self.out / f"{number + 1:03d}"

    def overrides(self, number):
        """What a run changes in the case, each as `table.key=value`."""
        return [*self.settings, *(f"{key}={value}" for one, value in zip(self.parameters, self.combinations[number]) for key in one.keys)]

    def status(self, number):
        """What the manifest of a run says of it; "" where it has not begun."""
        try:
            return str(json.loads((self.folder(number) / "manifest.json").read_text(encoding="utf-8"))["status"])
        except (OSError, ValueError, KeyError):
            return ""

    def run(self, jobs=1, threads=1, say=print):
        """Carries out what is not done yet: runs that have stopped go on from their checkpoints. jobs: how many at once, with as many threads each.

        A run that fails does not stop the others. Returns the messages of those that failed by their number."""
        rest = [number for number in range(len(self.combinations)) if self.status(number) != "done"]
        failed = {}
        with ProcessPoolExecutor(max_workers=jobs, mp_context=multiprocessing.get_context("spawn")) as workers:
            tasks = {workers.submit(_carry_out, self.case, self.folder(number), self.overrides(number), threads): number for number in rest}
            for count, task in enumerate(as_completed(tasks), len(self.combinations) - len(rest) + 1):
                number, error = tasks[task], task.exception()
                if error is not None:
                    failed[number] = str(error)
                say(f"{count} of {len(self.combinations)}: {self.folder(number).name} {'failed' if error else 'done'}, {', '.join(self.overrides(number)[len(self.settings):])}")
        return failed

    def table(self):
        """Columns by name: `run`, one for each parameter, `status`, and the figures of all runs; nan where a run has not got one."""
        rows = [figures_of(self.folder(number)) if self.status(number) else {} for number in range(len(self.combinations))]
        names = list(dict.fromkeys(name for row in rows for name in row))
        columns = {"run": [self.folder(number).name for number in range(len(rows))]}
        columns |= {one.key: [values[place] for values in self.combinations] for place, one in enumerate(self.parameters)}
        columns["status"] = [self.status(number) or "not begun" for number in range(len(rows))]
        return columns | {name: [row.get(name, float("nan")) for row in rows] for name in names}


def _carry_out(case, folder, overrides, threads):
    """One run, in a process of its own; whether it had a checkpoint to go on from."""
    from sazare.simulation import Simulation, source_of

    resume = (folder / "checkpoint").is_dir()
    simulation = Simulation(source_of(case).with_settings(overrides), folder.absolute(), threads, overwrite=not resume, resume=resume, progress=False, warns=False)
    try:
        simulation.run()
    finally:
        simulation.stop()


def read_sweep(folder):
    """The Sweep that was carried out in a folder. Raises NotARun where there is none."""
    try:
        mark = json.loads((Path(folder) / MARK).read_text(encoding="utf-8"))
        parameters = [Parameter(key, tuple(values)) for key, values in mark["parameters"].items()]
        return Sweep(mark["case"], parameters, folder, tuple(mark["settings"]))
    except (OSError, ValueError, KeyError, TypeError, AttributeError) as error:
        raise NotARun(f"{folder}: no sweep: {error}") from error
