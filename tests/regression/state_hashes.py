"""Runs every case with one program, or with two, and compares the hashes of the states in which the runs end.

    python tests/regression/state_hashes.py BEFORE [AFTER] [--case NAME ...] [--threads N]

BEFORE and AFTER are programs, each the path of a `sazare`. A change that should leave results as they are has left them so where
every line says 'same'; where one says 'DIFFERENT', or a run fails, the script ends with 1. Given one program, it prints the hashes
of that program. The table RUNS in short_runs.py shortens each case so that it takes seconds and still does what it is made for.

A run with two sides leaves three hashes, that of the whole and one for each side; of a study the rows of its tables are compared.
With --figures, figures of energy that both programs leave must be exactly equal as well. The times are those of the processor.

Hashes can be kept, and compared later without the program that made them:

    python tests/regression/state_hashes.py BEFORE --save hashes.json
    python tests/regression/state_hashes.py AFTER --against hashes.json

If keys of cases have been given other names in between, each program needs its own cases: --cases-before and --cases-after name
the folders. If a key of the table itself has another name, let the script that belongs to the earlier program save its hashes, and
compare them with the later script.
"""

import argparse
import json
import platform
import re
import shutil
import subprocess
import sys
from dataclasses import asdict, dataclass
from pathlib import Path

from short_runs import RUNS, Outcome, Refused, case_path, outcome_of

CASES = Path(__file__).resolve().parents[2] / "cases"
SAME, DIFFERENT, REFUSED, INTERRUPTED = 0, 1, 2, 130

# What a processor can do that decides how programs compiled for it, and the library of mathematical functions, round.
INSTRUCTIONS = ("sse4_1", "avx", "avx2", "fma", "avx512f", "avx512dq", "avx512bw", "avx512vl", "asimd", "sve", "sve2")


@dataclass
class Origin:
    """Where hashes come from: the program and its compiler, the processor, and the program that makes meshes."""

    program: str
    compiler: str
    processor: str
    instructions: list
    gmsh: str


def words_of(*command):
    """What a short command prints, or nothing where there is no such command."""
    try:
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    except OSError:
        return ""
    return (done.stdout + done.stderr).strip()


def match_in(pattern, text):
    """The first group of a pattern in a text, or 'unknown'."""
    found = re.search(pattern, text, re.MULTILINE)
    return found[1].strip() if found else "unknown"


def origin_of(program):
    """The origin of hashes that a program makes here."""
    info = Path("/proc/cpuinfo")
    processor = info.read_text(encoding="utf-8", errors="replace") if info.exists() else ""
    flags = match_in(r"^(?:flags|Features)\s*:(.*)$", processor).split()
    return Origin(
        program=words_of(program, "--version") or "unknown",
        compiler=match_in(r"^compiler\s+(.*)$", words_of(program, "info")),
        processor=match_in(r"^model name\s*:(.*)$", processor) if processor else platform.processor() or "unknown",
        instructions=[platform.machine(), *(name for name in INSTRUCTIONS if name in flags)],
        gmsh=words_of("gmsh", "--version") or "none",
    )


class Computed:
    """A side of the comparison that a program computes."""

    def __init__(self, program, cases, threads):
        if not (found := shutil.which(program)):
            raise Refused(f"{program} is no program that can be run")
        self.name, self.program, self.cases, self.threads = program, Path(found).resolve(), cases, threads
        if not cases.is_dir():
            raise Refused(f"{cases} is no folder")
        self.origin = origin_of(self.program)

    def lacks(self, name):
        """Why there is no such case on this side, or nothing."""
        return "" if case_path(name, self.cases).exists() else f"{self.cases} has no such case"

    def outcome(self, name):
        return outcome_of(self.program, name, self.cases, self.threads)


class Saved:
    """A side of the comparison that was computed earlier."""

    def __init__(self, file):
        try:
            content = json.loads(file.read_text(encoding="utf-8"))
            self.origin = Origin(**content["origin"])
            self.outcomes = {name: Outcome(**outcome) for name, outcome in content["cases"].items()}
        except (OSError, ValueError, KeyError, TypeError) as error:
            raise Refused(f"{file} holds no hashes that this script has saved: {error}") from error
        self.name = str(file)

    def lacks(self, name):
        """Why there is no such case on this side, or nothing."""
        return "" if name in self.outcomes else f"{self.name} has no such case"

    def outcome(self, name):
        return self.outcomes[name]


def refuse_other_instructions(saved, side):
    """Hashes of processors with other instruction sets say nothing about each other."""
    then, now = saved.origin, side.origin
    if then.instructions == now.instructions:
        return
    raise Refused(
        f"the hashes of {saved.name} cannot be compared with those of this machine.\n"
        f"They come from a processor with {', '.join(then.instructions)} ({then.processor});\n"
        f"this one has {', '.join(now.instructions)} ({now.processor}).\n"
        "Programs that are compiled for other instructions round differently. Run the earlier program on this machine, or compare "
        "on a machine like the earlier one."
    )


def energies_that_differ(before, after):
    """Lines for figures of energy that are not exactly equal, among those that both sides have."""
    return [f"    {key}: {before[key]!r} before, {after[key]!r} after"
            for key in before if key in after and before[key] != after[key]]


def compare(name, before, after, figures):
    """Prints a case of two sides; returns the number of hashes that were compared and the names of what is different."""
    parts, different = sorted(before.hashes.keys() | after.hashes.keys()) or [""], []
    seconds = f"  {before.seconds:6.1f} {after.seconds:6.1f} s"
    for part in parts:
        full = f"{name}/{part}".rstrip("/")
        one, two = (side.hashes.get(part, "FAILED" if side.failure else "none") for side in (before, after))
        same = one == two and not before.failure and not after.failure
        lines = energies_that_differ(before.energies.get(part, {}), after.energies.get(part, {})) if figures else []
        verdict = "same" if same and not lines else "DIFFERENT" if same or not (before.failure or after.failure) else "FAILED"
        print(f"{full:34} {one:16}  {two:16}  {verdict:9}{seconds}".rstrip(), *lines, sep="\n", flush=True)
        seconds = ""
        if verdict != "same":
            different.append(full)
    for word, side in (("before", before), ("after", after)):
        if side.failure:
            print(f"    {word}: {side.failure}")
    return len(parts), different


def show(name, outcome):
    """Prints a case of one side; returns the number of its hashes and its name where it failed."""
    seconds = f"  {outcome.seconds:6.1f} s"
    for part in sorted(outcome.hashes):
        print(f"{f'{name}/{part}'.rstrip('/'):34} {outcome.hashes[part]:16}{seconds}", flush=True)
        seconds = ""
    if outcome.failure:
        print(f"{name:34} {'FAILED':16}{seconds}\n    {outcome.failure}", flush=True)
    return len(outcome.hashes), [name] if outcome.failure else []


def chosen_cases(names, sides):
    """The cases to run, and for each that is left out the reason."""
    known = [name for name in RUNS if not names or name in names or name.partition("/")[0] in names]
    for name in names:
        if not any(name in (case, case.partition("/")[0]) for case in known):
            raise Refused(f"there is no case {name}; the cases are: {', '.join(RUNS)}")
    left_out = {}
    for name in known:
        if reasons := [reason for side in sides if (reason := side.lacks(name))]:
            left_out[name] = reasons[0]
    folders = {name.partition("/")[0] for name in RUNS}
    for side in sides if not names else []:
        if isinstance(side, Computed):
            new = {file.parent.name for file in side.cases.glob("*/*.toml")} - folders
            left_out |= dict.fromkeys(sorted(new), "the table of this script does not say how to run it")
    return [name for name in known if name not in left_out], left_out


def notes_on(before, after, names):
    """What else may be behind a difference from saved hashes."""
    then, now = before.origin, after.origin
    if then.processor != now.processor:
        yield f"The processors are two models with the same instruction sets: {then.processor} before, {now.processor} after."
    if then.compiler != now.compiler:
        yield f"The compilers differ: {then.compiler} before, {now.compiler} after."
    if then.gmsh != now.gmsh:
        yield f"Meshes that are made during a run are made by another Gmsh: {then.gmsh} before, {now.gmsh} after."
    for name in names:
        if isinstance(before, Saved) and before.outcome(name).settings != RUNS[name].all_settings():
            yield f"{name} was shortened by other settings when its hashes were saved."


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", metavar="BEFORE", help="a program")
    parser.add_argument("after", metavar="AFTER", nargs="?", help="the program that is compared with it")
    parser.add_argument("--case", metavar="NAME", nargs="+", action="extend", default=[], help="run these cases only")
    parser.add_argument("--threads", metavar="N", type=int, default=1, help="threads of each run (default: 1)")
    parser.add_argument("--cases-before", metavar="DIR", type=Path, help="cases of the program BEFORE (default: those of this tree)")
    parser.add_argument("--cases-after", metavar="DIR", type=Path, help="cases of the program AFTER (default: those of this tree)")
    parser.add_argument("--figures", action="store_true", help="compare the energies of the manifests as well")
    parser.add_argument("--save", metavar="FILE", type=Path, help="write the hashes of the one program that is given to a file")
    parser.add_argument("--against", metavar="FILE", type=Path, help="compare the one program that is given with saved hashes")
    given = parser.parse_args()
    if given.after and (given.save or given.against):
        parser.error("--save and --against go with one program")
    if given.figures and not (given.after or given.against):
        parser.error("--figures needs a second program, or --against")
    if given.against and given.cases_before:
        parser.error("saved hashes need no cases: use --cases-after for the program that is compared with them")
    if given.cases_after and not (given.after or given.against):
        parser.error("--cases-after needs a second program, or --against")
    if given.save and not given.save.resolve().parent.is_dir():
        parser.error(f"there is no folder for {given.save}")
    return given


def main():
    given = arguments()
    cases_before, cases_after = ((cases or CASES).resolve() for cases in (given.cases_before, given.cases_after))
    if given.against:
        sides = [Saved(given.against), Computed(given.before, cases_after, given.threads)]
        refuse_other_instructions(*sides)
    else:
        sides = [Computed(given.before, cases_before, given.threads)]
        if given.after:
            sides.append(Computed(given.after, cases_after, given.threads))
    names, left_out = chosen_cases(given.case, sides)
    for title, side in zip(("before: ", "after:  ") if len(sides) > 1 else ("",), sides):
        print(f"{title}{side.name}: {side.origin.program}, {side.origin.compiler}, on {side.origin.processor}")
    print()

    total, bad, outcomes = 0, [], {}
    for name in names:
        found = [side.outcome(name) for side in sides]
        outcomes[name] = found[-1]
        count, different = compare(name, *found, given.figures) if len(found) > 1 else show(name, *found)
        total += count
        bad += different
    print()
    for name, reason in left_out.items():
        print(f"Left out: {name}: {reason}.")
    if len(sides) > 1:
        for note in notes_on(*sides, names):
            print(note)
        print(f"{len(bad)} of {total} hashes are not the same: {', '.join(bad)}." if bad else f"{total} of {total} hashes are the same.")
    else:
        print(f"{len(bad)} of {len(names)} cases have failed: {', '.join(bad)}." if bad else f"{total} hashes of {len(names)} cases.")
    if given.save:
        content = {"origin": asdict(sides[-1].origin), "cases": {name: asdict(outcome) for name, outcome in outcomes.items()}}
        given.save.write_text(json.dumps(content, indent=2) + "\n", encoding="utf-8")
    return DIFFERENT if bad else SAME


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Refused as refusal:
        print(f"state_hashes: {refusal}", file=sys.stderr)
        sys.exit(REFUSED)
    except KeyboardInterrupt:
        sys.exit(INTERRUPTED)
