"""Carries out the cases of the tree in seconds each, for state_hashes.py: how each is shortened, and what it leaves."""

import csv
import hashlib
import json
import re
import resource
import shutil
import subprocess
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

HERE = Path(__file__).resolve().parent


@dataclass(frozen=True)
class Run:
    """How a case is carried out: the settings that shorten it, whether each of its two sides is a program of its own, and, for a
    study, the values that are left of its parameters."""

    settings: tuple = ()
    two_programs: bool = False
    study_values: dict = field(default_factory=dict)

    def all_settings(self):
        """What shortens the case, those of a study included."""
        return [*self.settings, *(f"{name}={values}" for name, values in self.study_values.items())]


def until(end, *more):
    """Settings of a case that ends at this time in seconds."""
    return (f"time.end={end}", *more)


def sides_until(end, *more):
    """Settings of a case with two sides that end at this time in seconds."""
    return (f"continuum.time.end={end}", f"bodies.time.end={end}", *more)


# By the name of the case: its folder, or the folder and the file where there is more than one case in it.
RUNS = {
    "armour-slope": Run(until(0.1, "spheres.2.rain=false", "time.snapshot_interval=0.1")),
    "base-friction": Run(),
    # The holes are fired sooner after each other.
    "bench-blast": Run(until(3e-4, "charges.1.delay=1e-4", "charges.2.delay=2e-4", "time.snapshot_interval=1e-4")),
    "contour-blast": Run(until(6.4e-4, "charges.0.delay=1e-4", "charges.1.delay=1e-4", "charges.2.delay=1e-4", "time.snapshot_interval=1.6e-4")),
    "crater-test": Run(until(2e-4, "time.snapshot_interval=1e-4")),
    "block": Run(),  # tests/regression/block
    "block-on-slope": Run(),
    # The block begins 2.8 m further down the slope, and so trips at its foot within the first second.
    "block-on-soft-ground": Run(sides_until(1, "bodies.blocks.0.lower=[5.684678751731762, 2.7594010767585, 0]",
                                            "bodies.blocks.0.upper=[6.684678751731762, 3.9594010767585, 0]",
                                            "bodies.gauges.0.point=[6.4, 3.1, 0]")),
    "bonded-beam": Run(),
    "borehole-under-stress": Run(until(4.8e-4, "time.snapshot_interval=8e-5")),
    "caisson-pushover": Run(),
    "caisson-quay-wall": Run(until(1)),
    "cantilever-fem": Run(),
    "column-collapse-mps": Run(),
    "column-nonlinear": Run(until(6.2)),
    "liquefaction-column": Run(until(2, "time.snapshot_interval=1")),
    "column-ricker": Run(),
    "direct-shear": Run(),
    "direct-shear/true-faces": Run(),
    "brazilian-disc": Run(until(2e-4, "mesh.parameters.size=0.0083")),
    "dynamic-brazilian": Run(until(2e-5, "mesh.parameters.size=0.006", "mesh.parameters.bar_size=0.008")),
    "kalthoff-winkler": Run(until(2e-5, "mesh.parameters.size=0.005")),
    "cylinder-blast": Run(until(4e-5, "mesh.parameters.size=0.018")),
    "uniaxial-compression": Run(until(2e-4, "mesh.parameters.size=0.012")),
    "free-face-blast": Run(),
    "free-face-blast-full": Run(until(1e-4)),
    "irregular-beam": Run(),
    "mortar-beam": Run(),
    # The ball begins close above the bed, and goes into it by most of its radius.
    "penetration-25k": Run(until(2e-3, "time.snapshot_interval=1e-3", "spheres.1.centre=[0, 0, -0.045]")),
    "rock-fall-on-slab": Run(),
    "rotating-drum": Run(until(0.8)),
    "seawall-in-water": Run(sides_until(1.5)),
    "seawall-shaking-table": Run(sides_until(1.5)),  # it is shaken from 1 s on
    "quay-wall-dry": Run(until(1)),
    "seawall-two-programs": Run(sides_until(0.5), two_programs=True),
    "shaking-table": Run(),
    "slope-factor-of-safety": Run(study_values={"friction angle": [20.0]}),
    "slope-free-field": Run(until(2)),
    "slope-hits-wall": Run(sides_until(1)),  # the ground arrives at 0.86 s
    "slope-el-centro": Run(until(6, "particles.spacing=1")),
    "soil-column-el-centro": Run(until(12.4)),
    "sphere-on-beam": Run(),
    # 24 cases of the 320, with enough dampings for the regression.
    "stability-study": Run(study_values={"spacing": [2.0, 3.2], "velocity": [100.0, 800.0], "damping": [0.001, 0.1, 1.0]}),
    "spalling-bar": Run(),
    "stones-through-water": Run(),
    "strip-footing": Run(),
    "tetrapod-armour": Run(until(1.75)),  # it is shaken from 1.5 s on
    "tetrapod-drop": Run(),
    "toppling-columns": Run(),
    # The holes are fired sooner after each other.
    **dict.fromkeys(("tunnel-vcut/with-slit", "tunnel-vcut/without-slit"),
                    Run(until(2e-4, *(f"blasts.{hole}.delay={hole // 2 * 5e-5}" for hole in range(2, 6))))),
    "two-mass-oscillator": Run(),
}


class Refused(Exception):
    """What was asked for cannot be done; the text says why."""


@dataclass
class Outcome:
    """What a case has left: its settings, a hash for each state or table, energies likewise, or why it failed."""

    settings: list
    hashes: dict = field(default_factory=dict)
    energies: dict = field(default_factory=dict)
    failure: str = ""
    seconds: float = 0.0


def case_path(name, cases):
    """The file or, of a study, the folder of a case; the small block lies among the tests beside the folder of cases."""
    if name == "block":
        beside = cases.parent / "tests" / "regression"
        return (beside if (beside / name).is_dir() else HERE) / name / "case.toml"
    if RUNS[name].study_values:
        return cases / name
    folder = cases / name
    return folder / "case.toml" if "/" not in name else folder.with_suffix(".toml")


# How the reports of sanitizers begin.
REPORT = re.compile(r"^.*(?:runtime error:|ERROR: \w+Sanitizer|WARNING: \w+Sanitizer)", re.MULTILINE)


def last_words(text):
    """The error in what a program has printed, or else its last line; what a sanitizer reports, in full."""
    if report := REPORT.search(text):
        return text[report.start():]
    lines = [line for line in text.splitlines() if line.strip()]
    return next((line for line in lines if "error" in line), lines[-1] if lines else "it said nothing")


def carry_out(commands, folder):
    """Runs commands beside each other; returns why one of them failed, or nothing. Where one fails the others are stopped."""
    logs = [folder / f"program-{number}.log" for number in range(len(commands))]
    programs = []
    try:
        for command, log in zip(commands, logs):
            with log.open("w", encoding="utf-8") as stream:
                programs.append(subprocess.Popen([str(word) for word in command], stdout=stream, stderr=subprocess.STDOUT))
        while any(program.poll() is None for program in programs) and not any(program.poll() for program in programs):
            time.sleep(0.02)
        failed = [(program.poll(), log) for program, log in zip(programs, logs) if program.poll()]
    finally:
        for program in programs:
            if program.poll() is None:
                program.terminate()
            program.wait()
    for code, log in failed[:1]:
        end = f"ended with {code}" if code > 0 else f"was terminated by signal {-code}"
        return f"the program {end}: {last_words(log.read_text(errors='replace'))}"
    return ""


def short_study(case, folder, values):
    """A copy of a study whose parameters have the given values only; returns its file."""
    study = shutil.copytree(case, folder / "short") / "study.toml"
    text = study.read_text(encoding="utf-8")
    for name, few in values.items():
        text, count = re.subn(rf'(name = "{name}"[^[]*(?:keys = \[[^]]*\]\s*)values = )\[[^]]*\]', rf"\g<1>{few}", text)
        if count != 1:
            raise Refused(f"{case / 'study.toml'} has no parameter {name} with a list of values, which this script would shorten")
    study.write_text(text, encoding="utf-8")
    return study


def commands_of(program, name, case, folder, threads):
    """The commands that carry a case out in a folder."""
    run = RUNS[name]
    out, common = folder / "run", ["--threads", threads, "--quiet"]
    if run.study_values:
        return [[program, "study", short_study(case, folder, run.study_values), "--out", out, *common]]
    common += [word for setting in run.settings for word in ("--set", setting)]
    if run.two_programs:
        out.mkdir()
        common += ["--exchange", folder / "exchange", "--time-out", 60]
        return [[program, "run", case, "--side", side, "--out", out / side, *common] for side in ("continuum", "bodies")]
    return [[program, "run", case, "--out", out, *common]]


def table_hash(table):
    """A hash of the rows of a table, without those columns that say how long something took."""
    with table.open(encoding="utf-8", newline="") as stream:
        titles, *rows = csv.reader(stream)
    kept = [column for column, title in enumerate(titles) if not title.startswith("seconds")]
    text = "\n".join(",".join(row[column] for column in kept) for row in rows)
    return hashlib.sha256(text.encode()).hexdigest()[:16]


def read_results(folder, outcome, study):
    """Puts the hashes and energies of a run's folder into an outcome: of tables for a study, else of every manifest in it."""
    if study:
        outcome.hashes |= {name: table_hash(folder / name) for name in ("study.csv", "regression.csv") if (folder / name).exists()}
    else:
        for file in sorted(folder.rglob("manifest.json")):
            manifest = json.loads(file.read_text(encoding="utf-8"))
            part = file.parent.relative_to(folder).as_posix().removeprefix(".")
            outcome.hashes[part] = manifest["state_hash"]
            outcome.energies[part] = {key: value for key, value in manifest["results"].items() if key.startswith("energy_")}
    if not outcome.hashes:
        outcome.failure = "the program has left no results"


def words_of_refusal(program, folder):
    """What a program says of the resolved cases that it has written into a folder, where it refuses to read one again; else nothing."""
    for file in sorted(folder.rglob("case.toml")):
        checked = subprocess.run([str(program), "check", str(file)], capture_output=True, text=True, check=False)
        if checked.returncode:
            return f"the resolved case {file.relative_to(folder)} is refused: {last_words(checked.stdout + checked.stderr)}"
    return ""


def processor_seconds():
    """Processor time of all programs that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def outcome_of(program, name, cases, threads):
    """Carries a case out in a temporary folder."""
    run, case = RUNS[name], case_path(name, cases)
    outcome, before = Outcome(run.all_settings()), processor_seconds()
    with tempfile.TemporaryDirectory(prefix="state-hashes-") as temporary:
        folder = Path(temporary)
        try:
            outcome.failure = carry_out(commands_of(program, name, case, folder, threads), folder)
        except Refused as refusal:
            outcome.failure = str(refusal)
        if not outcome.failure:
            read_results(folder / "run", outcome, bool(run.study_values))
        if not outcome.failure:
            outcome.failure = words_of_refusal(program, folder / "run")
    outcome.seconds = round(processor_seconds() - before, 1)
    return outcome
