"""Rows of method spheres: sphere-steps per second, beside other codes with the same grains."""

import math
import os
import re
import shutil
import subprocess
from pathlib import Path

from table import Limit, NotChosen, NotRun, Peer, Row

HERE = Path(__file__).resolve().parent / "spheres"
ACROSS = 46  # 97 336 spheres
MANY = {79: "493 039", 126: "2 000 376"}  # spheres across: how many there are
STEPS = 1000
YADE_STEPS = 200
LEVELS_ACROSS, LEVELS_STEPS = 30, 300
BONDS_ACROSS, BONDS, BOND_STEPS = 48, 324864, 200
SCENE = "97 336 spheres that settle, Hertz-Mindlin with history"
_found = {}


def ours(bench, threads, across=ACROSS):
    """(spheres, sphere-steps per second, contacts per sphere, bytes per sphere and more, see spheres/main.cpp). Raises NotRun."""
    key = (threads, across)
    if key not in _found:
        folder = bench.options.out / "spheres"
        folder.mkdir(parents=True, exist_ok=True)
        program = (bench.options.build / "benchmarks" / "spheres").resolve()
        best = None
        for _ in range(bench.options.repeats if across <= ACROSS else 1):
            done = subprocess.run([program, str(threads), str(across), "start.txt" if across == ACROSS else "-"], cwd=folder, capture_output=True,
                                  text=True, check=False, env=os.environ | {"GOMP_SPINCOUNT": "10000"})
            if done.returncode != 0:
                raise NotRun(f"exit code {done.returncode}: {done.stderr.strip()}")
            values = tuple(float(word) for word in done.stdout.split(","))
            best = values if best is None or values[1] > best[1] else best
        _found[key] = best
    return _found[key]


def write_start(bench):
    """The grains for the other codes; the folder."""
    ours(bench, 1)
    folder = bench.options.out / "spheres"
    rows = [line.split() for line in (folder / "start.txt").read_text(encoding="utf-8").splitlines()]
    length = 1.0005e-3 * ACROSS
    (folder / "length.txt").write_text(f"{length!r}\n", encoding="utf-8")
    with (folder / "start.lammps").open("w", encoding="utf-8") as file:
        file.write(f"grains\n\n{len(rows)} atoms\n1 atom types\n0 {length!r} xlo xhi\n0 {length!r} ylo yhi\n-0.001 {2 * length!r} zlo zhi\n\nAtoms\n\n")
        file.writelines(f"{i + 1} 1 {2 * float(r[0])!r} 2500 {r[1]} {r[2]} {r[3]}\n" for i, r in enumerate(rows))
        file.write("\nVelocities\n\n")
        file.writelines(f"{i + 1} {r[4]} {r[5]} {r[6]} 0 0 0\n" for i, r in enumerate(rows))
    return folder


def peer_rate(bench, name, command, pattern, steps):
    """Sphere-steps per second of another code on one core. Raises NotRun where it is not installed."""
    if shutil.which(command[0]) is None:
        raise NotRun(f"{name} is not installed")
    if name not in _found:
        folder = write_start(bench)
        best = math.inf
        for _ in range(1 if name == "yade" else bench.options.repeats):
            done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False, stdin=subprocess.DEVNULL,
                                  timeout=bench.options.time_limit, env=os.environ | {"OMP_NUM_THREADS": "1"})
            seconds = re.findall(pattern, done.stdout)
            if not seconds:
                raise NotRun(f"{name} ended with {done.returncode}: {(done.stdout + done.stderr).strip()[-200:]}")
            best = min(best, float(seconds[-1]))
        _found[name] = steps * ours(bench, 1)[0] / best
    return _found[name]


LOOP_TIME = r"Loop time of (\S+)"
PEERS = {
    "lammps": (["lmp", "-in", str(HERE / "settling.lammps"), "-log", "none"], LOOP_TIME, STEPS, 3),
    "liggghts": (["liggghts", "-in", str(HERE / "settling.liggghts"), "-log", "none"], LOOP_TIME, STEPS, 5),
    "yade": (["yade", "-j1", "-n", "-x", str(HERE / "settling_yade.py")], r"seconds (\S+)", YADE_STEPS, 25),
}


def peer_row(name):
    """Our rate beside that of another code, on one core."""
    command, pattern, steps, goal = PEERS[name]

    def measure(bench):
        theirs = peer_rate(bench, name, command, pattern, steps)
        return ours(bench, 1)[1], theirs

    return Row(f"spheres/{name}-settling", f"sphere-steps per second, {SCENE}, 1 thread", "1/s", measure, peer=Peer(name),
               limit=Limit("ratio", low=goal), more_is_better=True)


def bonded(bench, *more):
    """Bond-steps per second of one thread. Raises NotRun."""
    program = (bench.options.build / "benchmarks" / "bonds").resolve()
    best = 0.0
    for _ in range(bench.options.repeats):
        done = subprocess.run([program, "1", str(BONDS_ACROSS), *more], capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise NotRun(f"exit code {done.returncode}: {done.stderr.strip()}")
        best = max(best, float(done.stdout.split(",")[1]))
    return best


def bonded_peer(bench):
    """Our rate of bonds beside that of LAMMPS with its BPM package."""
    program = os.environ.get("LAMMPS_BPM", "lmp")
    if shutil.which(program) is None:
        raise NotRun("lammps is not installed")
    best = math.inf
    for _ in range(bench.options.repeats):
        done = subprocess.run([program, "-in", str(HERE.parent / "bonds" / "cube.lammps"), "-log", "none"], capture_output=True, text=True,
                              check=False, stdin=subprocess.DEVNULL, timeout=bench.options.time_limit, env=os.environ | {"OMP_NUM_THREADS": "1"})
        seconds = re.findall(LOOP_TIME, done.stdout)
        if len(seconds) < 2:
            raise NotRun(f"this lammps cannot run bonds (LAMMPS_BPM names one with its BPM package): {(done.stdout + done.stderr).strip()[-120:]}")
        best = min(best, float(seconds[-1]))
    return bonded(bench), BOND_STEPS * BONDS / best


def many(bench, across):
    """What `ours` says of many spheres. Raises NotChosen without --long."""
    if not bench.options.long:
        raise NotChosen("--long: two million spheres take some ten minutes")
    return ours(bench, 1, across)


def many_rows(across):
    """Rate and memory of many spheres."""
    scene = SCENE.replace("97 336", MANY[across])
    return [
        Row(f"spheres/ourselves-{across}-across", f"sphere-steps per second, {scene}, 1 thread", "1/s", lambda bench: many(bench, across)[1],
            more_is_better=True),
        Row(f"spheres/ourselves-{across}-across-memory", f"bytes per sphere with its contacts, {scene}", "B", lambda bench: many(bench, across)[3],
            limit=Limit("ours", high=400)),
    ]


def leveled(bench, every):
    """Processor seconds of a bed with time levels and with its finest step for all; one in `every` grains is an eighth as wide. Raises NotRun."""
    program = (bench.options.build / "benchmarks" / "sphere-levels").resolve()
    done = subprocess.run([program, str(every), str(LEVELS_ACROSS), str(LEVELS_STEPS)], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise NotRun(f"exit code {done.returncode}: {done.stderr.strip()}")
    values = [float(word) for word in done.stdout.split(",")]
    return values[2], values[3]


def level_row(every, low):
    """Time levels beside one step for all."""
    return Row(f"spheres/ourselves-levels-one-in-{every}",
               f"processor seconds, bed of 27 000 grains of 4 mm, one in {every} of 0.5 mm, {LEVELS_STEPS} base steps", "s",
               lambda bench: leveled(bench, every), peer=Peer("ourselves, finest step for all"), limit=Limit("ratio", low=low))


def growth(bench):
    """Slope of cost over spheres, both logarithmic, from a hundred thousand to two million."""
    few, most = ours(bench, 1), many(bench, max(MANY))
    return 1 + math.log(few[1] / most[1]) / math.log(most[0] / few[0])


def speed_up(bench):
    """Rate of two threads over that of one."""
    if (os.cpu_count() or 1) < 2:
        raise NotRun("this machine has one core")
    return ours(bench, 2)[1] / ours(bench, 1)[1]


def rows():
    """All rows of method spheres."""
    return [
        *(peer_row(name) for name in PEERS),
        Row("spheres/ourselves-settling-two-threads", f"rate with 2 threads over that with 1, {SCENE}", "-", speed_up, limit=Limit("ours", low=1.8),
            more_is_better=True),
        level_row(100, 4),
        level_row(20, 4),
        Row("bonds/lammps-cube", "bond-steps per second, 48^3 spheres bonded to their neighbours, 1 thread", "1/s", bonded_peer, peer=Peer("lammps bpm/rotational"),
            limit=Limit("ratio", low=5), more_is_better=True),
        Row("bonds/ourselves-cube", "bond-steps per second, the same", "1/s", bonded, limit=Limit("ours", low=25e6), more_is_better=True),
        Row("bonds/ourselves-cube-that-may-break", "bond-steps per second, the same with a strength that every step looks at", "1/s",
            lambda bench: bonded(bench, "breaks"), more_is_better=True),
        Row("spheres/ourselves-memory", f"bytes per sphere with its contacts, {SCENE}", "B", lambda bench: ours(bench, 1)[3],
            limit=Limit("ours", high=400)),
        *(row for across in MANY for row in many_rows(across)),
        Row("spheres/ourselves-exponent", "slope of cost over spheres, 97 336 to 2 000 376", "-", growth, limit=Limit("ours", high=1.15)),
    ]
