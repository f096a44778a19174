"""Carries out scenes with the program and keeps what was measured, so that rows can share runs."""

import csv
import json
import os
import resource
import shutil
import subprocess
import time
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

from table import NotChosen, NotRun

ROOT = Path(__file__).resolve().parent.parent
REPEAT_WITHIN = 60.0  # seconds; a scene that has taken longer is not repeated
BUSY_BELOW = 0.85  # processor time over wall time; a run that had a processor to itself comes near 1
OWN_PARTS = ("setup", "output", "checkpoints", "other")  # of timing.csv; the other parts are the engine's


@dataclass(frozen=True)
class Options:
    """How to measure."""

    build: Path
    out: Path
    repeats: int = 3
    time_limit: float = 3600.0  # of one run [s]
    long: bool = False
    largest: int = 1_000_000  # elements of the largest block


@dataclass(frozen=True)
class Measurement:
    """What a scene has cost: the least of its runs."""

    folder: Path
    wall_seconds: float  # the program's own clock, from reading the mesh to the last file
    processor_seconds: float  # of all threads
    peak_bytes: int  # largest resident memory
    state_hash: str
    figures: dict  # `results` of the manifest
    parts: dict  # timing.csv, seconds by part

    @property
    def engine_seconds(self):
        """Wall-clock time of the steps alone."""
        return sum(seconds for part, seconds in self.parts.items() if part not in OWN_PARTS)

    @property
    def evaluations_per_second(self):
        """Pair evaluations per second of the steps alone."""
        return self.figures["pair_evaluations"] / self.engine_seconds

    @property
    def bytes_per_element(self):
        """Largest resident memory over the number of elements."""
        return self.peak_bytes / self.figures["elements"]

    @property
    def setup_per_element(self):
        """Time to read the mesh and to build the model from it, over the number of elements [s]."""
        return self.parts["setup"] / self.figures["elements"]

    @property
    def output_share(self):
        """Share of the wall-clock time in histories, energy balance, snapshots and checkpoints."""
        return (self.parts["output"] + self.parts["checkpoints"]) / self.wall_seconds


class Bench:
    """Runs each scene once for all rows that ask for it; a scene that failed fails for all of them."""

    def __init__(self, options):
        self.options = options
        self.busy = []
        self._found = {}

    @cached_property
    def cores(self):
        """Processors that this process may use."""
        return len(os.sched_getaffinity(0))

    def run(self, scene):
        """The Measurement of a scene. Raises NotRun."""
        if scene not in self._found:
            try:
                self._found[scene] = self._measure(scene)
            except NotRun as reason:
                self._found[scene] = reason
        if isinstance(self._found[scene], NotRun):
            raise self._found[scene]
        return self._found[scene]

    def run_in_turns(self, *scenes):
        """The Measurements of scenes that differ little: run after run in turns, so that a machine which is slower for a
        while is so for all of them. Raises NotRun."""
        settings = [self._settings(scene) for scene in scenes]
        runs, began = [[] for _ in scenes], time.monotonic()
        while not runs[-1] or (len(runs[-1]) < self.options.repeats and time.monotonic() - began < REPEAT_WITHIN):
            for scene, with_these, of_scene in zip(scenes, settings, runs):
                of_scene.append(self._run_once(scene, with_these))
                print(f"    {scene.name}: run {len(of_scene)}, {of_scene[-1].wall_seconds:.2f} s, "
                      f"processors {of_scene[-1].processor_seconds:.2f} s, {of_scene[-1].peak_bytes / 1e6:.0f} MB", flush=True)
        return [self._least(scene, of_scene) for scene, of_scene in zip(scenes, runs)]

    def _measure(self, scene):
        return self.run_in_turns(scene)[0]

    def _settings(self, scene):
        """All that a scene sets. Raises NotRun where it cannot be run here."""
        if scene.long and not self.options.long:
            raise NotChosen("takes long; --long runs it")
        if scene.threads * scene.ranks > self.cores:
            raise NotRun(f"needs {scene.threads * scene.ranks} processors, this machine has {self.cores}")
        if scene.ranks > 1 and shutil.which("mpirun") is None:
            raise NotRun("there is no mpirun")
        return scene.settings + self._mesh_settings(scene)

    def _least(self, scene, runs):
        if len({run.state_hash for run in runs}) > 1:
            raise NotRun("repeated runs end in different states")
        best = min(runs, key=lambda run: run.wall_seconds)
        if best.processor_seconds < BUSY_BELOW * best.wall_seconds:
            self.busy.append(scene.name)
        return replace(best, processor_seconds=min(run.processor_seconds for run in runs))

    def _run_once(self, scene, settings):
        folder = self.options.out / "runs" / scene.name
        command = [self.options.build / "apps/sazare/sazare", "run", ROOT / scene.case, "--out", folder, "--overwrite",
                   "--quiet", "--threads", str(scene.threads)]
        command += [word for setting in settings for word in ("--set", setting)]
        if scene.ranks > 1:
            command = ["mpirun", "-n", str(scene.ranks), *command]
        before = _processor_seconds_of_children()
        peak = self._carry_out(command)
        spent = _processor_seconds_of_children() - before
        manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
        with (folder / "timing.csv").open(newline="", encoding="utf-8") as file:
            parts = {line[0]: float(line[1]) for line in list(csv.reader(file))[1:]}
        return Measurement(folder, manifest["results"]["wall_seconds"], spent, peak, manifest["state_hash"],
                           manifest["results"], parts)

    def _mesh_settings(self, scene):
        """The setting that names the scene's mesh, which is made where it is not there, or older than its geometry."""
        if not scene.mesh:
            return ()
        geometry, name, value = scene.mesh
        mesh = self.options.out / "meshes" / f"{Path(geometry).stem}-{name}-{value:g}.msh"
        if not mesh.exists() or mesh.stat().st_mtime < (ROOT / geometry).stat().st_mtime:
            if not shutil.which("gmsh"):
                raise NotRun("gmsh is not installed")
            mesh.parent.mkdir(parents=True, exist_ok=True)
            print(f"    {mesh.name}: gmsh makes it", flush=True)
            unfinished = mesh.with_suffix(".part.msh")
            self._carry_out(["gmsh", "-3", "-v", "1", "-format", "msh41", "-setnumber", name, str(value), ROOT / geometry,
                             "-o", unfinished])
            unfinished.rename(mesh)
        return (f"mesh.file={mesh}",)

    def _carry_out(self, command):
        """Runs a program; its largest resident memory [bytes]."""
        program = Path(command[0])
        if program.is_absolute() and not program.exists():
            raise NotRun(f"{program} is not built")
        # Threads are set by option alone, whatever the shell has set.
        environment = {name: value for name, value in os.environ.items() if not name.startswith(("OMP_", "GOMP_"))}
        environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        log = self.options.out / "log"
        with log.open("w+", encoding="utf-8") as output:
            process = subprocess.Popen([str(word) for word in command], cwd=ROOT, env=environment, stdout=output,
                                       stderr=subprocess.STDOUT)
            peak = _wait(process, self.options.time_limit)
            output.seek(0)
            text = output.read()
        if process.returncode != 0:
            raise NotRun(f"{program.name} ended with {process.returncode}: {text.strip()[-300:]}")
        return peak


def _wait(process, time_limit):
    """Waits for the end and returns the largest resident memory [bytes]. It is looked up while the process lives: what
    the system tells of an ended process includes the memory of the Python process that started it."""
    ends, peak = time.monotonic() + time_limit, 0
    while process.poll() is None:
        if time.monotonic() > ends:
            process.kill()
            process.wait()
            raise NotRun(f"no end after {time_limit:.0f} s")
        peak = max(peak, _high_water(process.pid))
        time.sleep(0.02)
    return peak


def _high_water(process_id):
    try:
        lines = Path(f"/proc/{process_id}/status").read_text(encoding="utf-8").splitlines()
    except OSError:  # it has just ended
        return 0
    return next((1024 * int(line.split()[1]) for line in lines if line.startswith("VmHWM:")), 0)


def _processor_seconds_of_children():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime
