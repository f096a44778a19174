"""A column of soil that degrades, with finite elements, with particles, in pyStrata and by finite differences: spectra and peaks of the surface."""

import csv
import subprocess
import sys
import tempfile
import warnings
from pathlib import Path

import numpy as np
from ground import DAMPING, DENSITY, HEIGHT, HERE, PERIODS, REFERENCE, ROCK_DENSITY, ROCK_VELOCITY, RUNS, S_VELOCITY, outcrop, samples

import sazare
from sazare import ground_motion

sys.path.append(str(HERE.parents[1] / "common"))
from degrading_column import Ground, differences  # noqa: E402

PROGRAM = HERE.parents[2] / "build/release/apps/sazare/sazare"
CASES = {"": "elements.toml", "particles-": "particles.toml"}
END = 16.0  # s of the runs
SHORT = 0.1  # s, up to which periods count as short ones
CUT = 25.0  # Hz, up to which the record tells anything
STEP = 2.5e-4  # s of the differences


def theirs():
    """Peak acceleration and spectrum of pyStrata [m/s2] by run."""
    with (HERE / "pystrata-spectra.csv").open(encoding="utf-8") as file:
        names, *rows = csv.reader(file)
    columns = np.array(rows, dtype=float).T
    return {name.split(" ")[0]: column for name, column in zip(names[1:], columns[1:], strict=True)}


def spectrum(step, acceleration, cut=None):
    """Peak of the acceleration, above `cut` [Hz] filtered, and pseudo accelerations at PERIODS [m/s2]."""
    record = ground_motion.from_samples(step, acceleration)
    filtered = record if cut is None else ground_motion.butterworth(record, high=cut)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)  # the run is as long as it is
        found = ground_motion.response_spectrum(record, PERIODS)
    return np.r_[np.abs(filtered.acceleration).max(), found.pseudo_acceleration]


def ours(folder, case, name):
    """As `spectrum` of the surface of a run, its largest shear strain [-], and its plastic work [J/m]."""
    run, record, out = RUNS[name], folder / "record.csv", folder / f"{case}-{name}"
    step, values = samples()
    sazare.write_table(record, {"time [s]": step * np.arange(len(values)), "acceleration [m/s2]": values})
    settings = {
        "motions.0.file": f'"{record}"', "motions.0.amplitude": 0.5 * run.scale, "materials.0.damping_ratio": DAMPING if run.rayleigh else 0.0,
    }
    words = (word for key, value in settings.items() for word in ("--set", f"{key}={value}"))
    done = subprocess.run([PROGRAM, "run", HERE / case, "--out", out, "--overwrite", "--quiet", *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    results = sazare.open(out)
    table = results.gauge_table
    snapshot = (results.element_snapshots if case == CASES[""] else results.particle_snapshots)[-1].elements
    strain = float(np.max(snapshot.cell_data["shear_strain_max"]))
    acceleration = np.asarray(table["surface.acceleration_x"])
    return spectrum(table["time"][1] - table["time"][0], acceleration, CUT if name == "strong" else None), strain, results.figures["energy_plastic"]


def by_differences(name):
    """As `spectrum` of the surface by central differences, and the largest shear strain [-]."""
    scale, times = RUNS[name].scale, STEP * np.arange(round(END / STEP) + 1)
    coming = np.zeros(len(times))
    shaken = 0.5 * scale * outcrop(STEP)
    coming[1:len(shaken)] = np.cumsum(0.5 * STEP * (shaken[1:] + shaken[:-1]))
    coming[len(shaken):] = coming[len(shaken) - 1]
    ground = Ground(HEIGHT, DENSITY, DENSITY * S_VELOCITY**2, REFERENCE, ROCK_DENSITY, ROCK_VELOCITY)
    found = differences(ground, lambda time: np.interp(time, times, coming), cells=200, step=STEP, end=END)
    return spectrum(STEP, np.diff(found.velocity) / STEP, CUT), float(found.peak.max())


def print_beside(name, found, other, shortest=0.0):
    """Peak acceleration over that of the other program, and the largest difference of the spectra from the shortest period [s] on."""
    ratio = found / other
    print(f"{name}-pga,{ratio[0]}")
    print(f"{name}-spectrum,{np.abs(ratio[1:] - 1.0)[PERIODS >= shortest].max()}")


def print_strong(mark, motion, strain, exact, largest, other):
    """The strong motion beside the differences, and at short periods beside pyStrata."""
    print_beside(f"{mark}strong-differences", motion, exact, SHORT)
    print(f"{mark}strong-strain,{strain / largest}")
    print(f"{mark}strong-short,{np.exp(np.log(motion / other)[1:][PERIODS <= SHORT].mean())}")


def main():
    pystrata = theirs()
    exact, largest = by_differences("strong")
    with tempfile.TemporaryDirectory() as folder:
        for mark, case in CASES.items():
            for name in ("weak", "damped", "strong"):
                motion, strain, dissipated = ours(Path(folder), case, name)
                if name == "strong":
                    print_strong(mark, motion, strain, exact, largest, pystrata[name])
                    continue
                print_beside(f"{mark}{name}", motion, pystrata[name])
                if name == "weak":
                    print(f"{mark}weak-strain,{strain}")
                    print(f"{mark}weak-dissipated,{dissipated}")


if __name__ == "__main__":
    main()
