"""Changes the files of small cases at random and looks whether the program answers each with a message: make fuzz.

    python tests/fuzz/fuzz.py [--mutants N] [--seed S] [--only NAME] [--program PATH --watched]

The corpus (corpus.py) has small cases, each with the files that it names. A mutant is one of them with some bytes, numbers, words or lines changed, by the seed
and its number alone. Each is checked; one in RUN_EVERY is run, and stopped after RUN_TIME seconds. Besides, one in MESSAGE_EVERY is a message of a coupling (messages.py).
A finding is an end by a signal, an internal error, more seconds of the processor, ten times as many by the clock, or more memory than a program that is
tried (class Tried) may take; its files are kept in build/fuzz/NAME-NUMBER. One that sanitizers watch (--watched) may take ten times as long, and all addresses.
"""

import argparse
import contextlib
import os
import random
import re
import resource
import select
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import threading
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import messages
from corpus import CORPUS, checkpoint_of

ROOT = Path(__file__).resolve().parents[2]
FINDINGS = ROOT / "build/fuzz"
RUN_EVERY, RUN_TIME = 10, 2  # s
MESSAGE_EVERY = 50
INTERRUPTED = 130
OUT_OF_MEMORY = ("Sanitizer: out-of-memory", "Sanitizer: allocation-size-too-big")  # where an allocation without a sanitizer throws
NUMBERS = [
    "0", "-0", "-1", "1", "2", "7", "1e9", "1e18", "1e300", "-1e300", "1e-300", "nan", "inf", "-inf", "0x10", "1_000", "1,5", "2147483648",
    "9223372036854775807", "18446744073709551616", "99999999999999999999999999", "", "x", '"', "[", "]", "{", "}", "\n", "\t", ";", ",", "\r", "#",
]


def change(data, chance):
    """The bytes with one change."""
    kind = chance.randrange(9)
    spots = list(re.finditer(rb"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?|[A-Za-z_]+", data)) if kind in (0, 1, 2) else []
    if spots and kind in (0, 1):
        spot = chance.choice(spots)
        return data[: spot.start()] + chance.choice(NUMBERS).encode() + data[spot.end():]
    if spots:
        one, other = chance.choice(spots), chance.choice(spots)
        return data[: one.start()] + other.group() + data[one.end():]
    if kind == 3 and data:  # a bit
        at = chance.randrange(len(data))
        return data[:at] + bytes([data[at] ^ 1 << chance.randrange(8)]) + data[at + 1:]
    if kind == 4:  # cut short
        return data[: chance.randrange(len(data) + 1)]
    if kind == 5:  # a part again
        begin = chance.randrange(len(data) + 1)
        return data[:begin] + data[begin: begin + chance.randrange(1, 200)] * chance.randrange(1, 4) + data[begin:]
    lines = data.split(b"\n")
    at = chance.randrange(len(lines))
    if kind == 6:
        del lines[at]
    elif kind == 7:
        lines.insert(at, chance.choice(lines))
    elif len(data) >= 8:  # a number as it lies in memory
        at = chance.randrange(len(data) - 7)
        value = chance.choice([struct.pack("<q", chance.choice([-1, 0, 1, 2**31, 2**62])), struct.pack("<d", chance.choice([0.0, -1.0, 1e300, float("nan")]))])
        return data[:at] + value + data[at + 8:]
    return b"\n".join(lines)


def mutant(files, seed, number):
    """The files of a case, one of them changed one to four times: (name, bytes)."""
    chance = random.Random(f"{seed}-{number}")
    name = chance.choice(sorted(files))
    data = files[name]
    for _ in range(chance.choice((1, 1, 1, 2, 4))):
        data = change(data, chance)
    return name, data


@dataclass
class Tried:
    """The program that is tried, and what it may take."""

    command: Path = ROOT / "build/release/apps/sazare/sazare"
    time: int = 20  # s
    memory: int = 6_000_000_000  # B of addresses
    watched: bool = False
    server: Path = ROOT / "build/fuzz/fork_server.so"

    def make_server(self):
        """Compiles what lets the program be started once."""
        self.server.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(["cc", "-O1", "-shared", "-fPIC", "-o", self.server, Path(__file__).with_name("fork_server.c"), "-ldl"], check=True)

    def watch(self):
        """Sanitizers watch the program. What they keep account of takes time, and addresses without a limit."""
        self.watched = True
        self.time *= 10
        os.environ["LSAN_OPTIONS"] = f"suppressions={ROOT}/scripts/sanitize.leaks:print_suppressions=0:{os.environ.get('LSAN_OPTIONS', '')}"
        os.environ["ASAN_OPTIONS"] = f"max_allocation_size_mb=6000:detect_leaks=1:{os.environ.get('ASAN_OPTIONS', '')}"


TRIED = Tried()


def limited():
    """Sets the limits of a program that is tried."""
    if not TRIED.watched:
        resource.setrlimit(resource.RLIMIT_AS, (TRIED.memory, TRIED.memory))
    resource.setrlimit(resource.RLIMIT_CPU, (TRIED.time, TRIED.time + 1))  # others may be at work on the machine
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class ForkServer:
    """The program, started once and loaded with fork_server.c, which carries out the program again and again."""

    def __init__(self):
        limits = {"SAZARE_TRIED_SECONDS": str(TRIED.time), "SAZARE_TRIED_CORE": "0"}
        if not TRIED.watched:
            limits["SAZARE_TRIED_MEMORY"] = str(TRIED.memory)
        preload = " ".join(filter(None, [str(TRIED.server), os.environ.get("LD_PRELOAD")]))
        environment = {**os.environ, **limits, "LD_PRELOAD": preload}
        self.process = subprocess.Popen([TRIED.command], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0, env=environment)

    def begin(self, folder, arguments):
        """Starts the program in a folder."""
        self.process.stdin.write("\t".join([str(folder), *arguments]).encode() + b"\n")
        return int(self.process.stdout.readline())

    def ended_within(self, seconds):
        """Whether the program ends within so many seconds."""
        return bool(select.select([self.process.stdout], [], [], seconds)[0])

    def exit_code(self):
        """That of the program, which has ended or is killed: below 0 the signal by which it ended."""
        return os.waitstatus_to_exitcode(int(self.process.stdout.readline()))


THREAD = threading.local()  # each has a fork server


def send(sign, program):
    """Sends a signal to a program, which may have ended in this moment."""
    with contextlib.suppress(ProcessLookupError):
        os.kill(program, sign)


def ended(arguments, folder, stop_after=None):
    """A program that has ended, as subprocess.run gives it; it is asked to stop after so many seconds. Raises TimeoutExpired."""
    if not hasattr(THREAD, "server"):
        THREAD.server = ForkServer()
    server, longest = THREAD.server, 10 * TRIED.time
    program = server.begin(folder, arguments)
    in_time = server.ended_within(stop_after or longest)
    asked = not in_time and stop_after is not None
    if asked:
        send(signal.SIGTERM, program)
        in_time = server.ended_within(longest)
    if not in_time:
        send(signal.SIGKILL, program)
    code = server.exit_code()
    if not in_time:
        raise subprocess.TimeoutExpired(arguments, longest)
    out, err = (Path(folder, name).read_bytes() for name in ("stdout", "stderr"))
    if asked and code == -signal.SIGTERM:  # on a busy machine it may not listen yet
        return subprocess.CompletedProcess(arguments, INTERRUPTED, out, err or b"asked to stop")
    return subprocess.CompletedProcess(arguments, code, out, err)


def verdict(done):
    """What is wrong with how a program has ended; None where its answer is a good one."""
    words = done.stderr.decode(errors="replace")
    if any(name in words for name in OUT_OF_MEMORY):
        return None  # the program itself would have said so
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return f"more than {TRIED.time} s of the processor"
    if done.returncode < 0:
        return f"signal {-done.returncode}"
    if done.returncode not in (0, 2, 3, 4, INTERRUPTED) or "report it" in words:
        return f"exit code {done.returncode}: {words[:2000] if TRIED.watched else words[-300:]}"
    if done.returncode and not words.strip():
        return f"exit code {done.returncode} without a word"
    return None


def fault_of(folder, way):
    """What is wrong with the answer to a case that is checked, run or resumed; None where it is a good one."""
    arguments = {"check": ["check", "case.toml"], "run": ["run", "case.toml", "--out", "run"], "resume": ["run", "case.toml", "--out", "run", "--resume"]}[way]
    try:
        return verdict(ended([*arguments, *(["--quiet"] if way != "check" else []), "--threads", "1"], folder, None if way == "check" else RUN_TIME))
    except subprocess.TimeoutExpired:
        return f"more than {10 * TRIED.time} s by the clock"


def attempt(name, files, seed, number):
    """Tries one mutant; returns what is wrong, or None."""
    changed, data = mutant({key: value for key, value in files.items() if key != "run/checkpoint/state.h5" or number % 2}, seed, number)
    with tempfile.TemporaryDirectory(prefix="sazare-fuzz-") as place:
        for key, value in {**files, changed: data}.items():
            path = Path(place) / key
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(value)
        way = "resume" if "run/checkpoint/state.h5" in files else "run" if number % RUN_EVERY == 0 else "check"
        fault = fault_of(place, way)
        if fault:
            shutil.copytree(place, FINDINGS / f"{name}-{number}", dirs_exist_ok=True)
            fault = f"{name}-{number} ({changed}, {way}): {fault}"
        return fault


def attempt_message(seed, number):
    """Tries one changed message; returns what is wrong, or None."""
    chance = random.Random(f"{seed}-message-{number}")
    fault = messages.attempt(TRIED.command, number, lambda data: change(data, chance), verdict, limited)
    return fault and f"message-{number}: {fault}"


def main():
    """Tries all mutants; returns the exit code: 1 where there is a finding."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mutants", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", help="one case of the corpus, or messages")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--program", type=Path, default=TRIED.command, help="the program that is tried")
    parser.add_argument("--watched", action="store_true", help="sanitizers watch the program")
    chosen = parser.parse_args()
    TRIED.command = chosen.program.resolve()
    if chosen.watched:
        TRIED.watch()
    TRIED.make_server()
    corpus = {name: files for name, files in {**CORPUS, **checkpoint_of()}.items() if chosen.only in (None, name)}
    with tempfile.TemporaryDirectory(prefix="sazare-fuzz-") as place:  # seeds that are refused would hide all that comes later
        for name, files in corpus.items():
            for key, value in files.items():
                (Path(place) / name / key).parent.mkdir(parents=True, exist_ok=True)
                (Path(place) / name / key).write_bytes(value)
            done = subprocess.run([TRIED.command, "check", "case.toml"], cwd=Path(place) / name, capture_output=True, text=True)
            if done.returncode:
                print(f"the seed {name} is refused:\n{done.stderr}")
                return 1
    names = sorted(corpus)
    tried, findings = 0, 0
    with ThreadPoolExecutor(chosen.jobs) as pool:
        work = []
        for n in range(chosen.mutants):
            if names:
                work.append(pool.submit(attempt, names[n % len(names)], corpus[names[n % len(names)]], chosen.seed, n))
            if n % MESSAGE_EVERY == 0 and chosen.only in (None, "messages"):
                work.append(pool.submit(attempt_message, chosen.seed, n // MESSAGE_EVERY))
        try:
            for one in work:
                fault = one.result()
                tried, findings = tried + 1, findings + bool(fault)
                if fault:
                    print(fault, flush=True)
                if tried % 1000 == 0:
                    print(f"{tried} of {len(work)} tried", file=sys.stderr, flush=True)
        except KeyboardInterrupt:
            pool.shutdown(cancel_futures=True)
        except BaseException:
            pool.shutdown(cancel_futures=True)
            raise
    print(f"{tried} mutants of {len(names)} cases and the messages of a coupling, seed {chosen.seed}: {findings} findings")
    return 1 if findings else 0


if __name__ == "__main__":
    sys.exit(main())
