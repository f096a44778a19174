"""Rows of method hybrid: what a coupled run costs beside its two sides alone, and its two programs beside one."""

import json
import resource
import subprocess
from pathlib import Path

from table import Limit, NotRun, Row

ROOT = Path(__file__).resolve().parent.parent
CASE = ROOT / "cases/seawall-shaking-table"
END = 1.5  # s
SCENE = "sea wall until 1.5 s, one thread a side"
_found = {}


def _settings(*sides):
    return [word for side in sides for key in ("end", "snapshot_interval") for word in ("--set", f"{side}time.{key}={END}")]


def _run(bench, name, file, settings, *more):
    """The command of a run, and its folder."""
    program = bench.options.build.resolve() / "apps/sazare/sazare"
    if not program.exists():
        raise NotRun(f"{program} is not built")
    folder = bench.options.out / "runs" / f"coupled-{name}"
    return [program, "run", CASE / file, "--out", folder, "--overwrite", "--quiet", "--threads", "1", *settings, *more], folder


def _processor_seconds(commands):
    """Processor time of programs that run beside one another, until all have ended [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    programs = [subprocess.Popen([str(word) for word in command], cwd=ROOT, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
                for command in commands]
    for program in programs:
        words = program.communicate()[1]
        if program.returncode != 0:
            raise NotRun(f"exit code {program.returncode}: {words.strip()[-300:]}")
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measured(bench):
    """Processor time [s] of the coupled run and of each side alone, shares of the coupled run's time by side, and what the exchange of files
    takes of the run in two programs: of the processor time of each side, in memory (/dev/shm). The least of the repeats. Raises NotRun."""
    if _found:
        return _found
    both, folder = _run(bench, "both", "case.toml", _settings("continuum.", "bodies."))
    caisson, _ = _run(bench, "caisson", "caisson.toml", _settings(""))
    armour, _ = _run(bench, "armour", "armour.toml", _settings(""))
    sides = [_run(bench, f"side-{side}", "case.toml", _settings("continuum.", "bodies."), "--side", side, "--exchange", "/dev/shm/sazare-bench")
             for side in ("continuum", "bodies")]
    if not Path("/dev/shm").is_dir():
        raise NotRun("there is no folder in memory, /dev/shm")
    times = {name: min(_processor_seconds([command]) for _ in range(bench.options.repeats))
             for name, command in (("both", both), ("caisson", caisson), ("armour", armour))}
    parts = dict(line.split(",")[:2] for line in (folder / "timing.csv").read_text(encoding="utf-8").splitlines()[1:])
    apart, exchange = min(_apart(sides) for _ in range(bench.options.repeats))
    total = sum(map(float, parts.values()))
    _found.update(times, apart=apart, exchange=exchange, elements=float(parts["finite elements"]) / total, bodies=float(parts["bodies"]) / total)
    return _found


def _apart(sides):
    """Processor time of the two programs, and of their exchange [s]."""
    seconds = _processor_seconds([command for command, _ in sides])
    results = [json.loads((folder / "manifest.json").read_text(encoding="utf-8"))["results"] for _, folder in sides]
    return seconds, sum(result["exchange_processor_seconds"] for result in results)


def rows():
    """All rows of method hybrid."""
    return [
        Row("hybrid/seawall", f"{SCENE}: processor time", "s", lambda bench: measured(bench)["both"]),
        Row("hybrid/seawall-elements", f"{SCENE}: share of the finite elements", "-", lambda bench: measured(bench)["elements"]),
        Row("hybrid/seawall-bodies", f"{SCENE}: share of the bodies", "-", lambda bench: measured(bench)["bodies"]),
        Row("hybrid/seawall-caisson-alone", f"{SCENE}: processor time of the caisson alone", "s", lambda bench: measured(bench)["caisson"]),
        Row("hybrid/seawall-armour-alone", f"{SCENE}: processor time of the armour alone", "s", lambda bench: measured(bench)["armour"]),
        Row("hybrid/seawall-overhead", f"{SCENE}: processor time beyond that of both alone, over it", "-",
            lambda bench: measured(bench)["both"] / (measured(bench)["caisson"] + measured(bench)["armour"]) - 1),
        Row("hybrid/seawall-exchange", f"{SCENE}: share of writing and reading files in the processor time of two programs, files in memory", "-",
            lambda bench: measured(bench)["exchange"] / measured(bench)["apart"], limit=Limit("ours", high=0.01)),
    ]
