"""A wave in a column of soil that degrades with strain, by finite elements, by particles and by finite differences of its own."""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare
from sazare.ground_motion.column import Column, Layer

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parents[1] / "common"))
import degrading_column  # noqa: E402
from degrading_column import Ground  # noqa: E402

PROGRAM = HERE.parents[2] / "build/release/apps/sazare/sazare"
HEIGHT, DENSITY, MODULUS, REFERENCE = 20.0, 1800.0, 40.5e6, 1e-3  # m, kg/m3, Pa, -
ROCK_DENSITY, ROCK_MODULUS, ROCK_HEIGHT = 2200.0, 0.891e9, 2.0  # kg/m3, Pa, m
ROCK_OF_PARTICLES = 1.9375  # m, from the centres of the lowest particles
WIDTH, WIDTH_OF_PARTICLES = 0.5, 0.25  # m
ROCK_VELOCITY = np.sqrt(ROCK_MODULUS / ROCK_DENSITY)  # m/s
AMPLITUDE, FREQUENCY, CYCLES = 0.6, 1.2, 4  # m/s2, Hz, -


def wave(time, amplitude=AMPLITUDE, frequency=FREQUENCY, cycles=CYCLES):
    """Velocity [m/s] of a sine in acceleration."""
    omega = 2.0 * np.pi * frequency
    return amplitude / omega * (1.0 - np.cos(omega * np.clip(time, 0.0, cycles / frequency)))


def differences(rock_height=ROCK_HEIGHT):
    """The strong motion by central differences, of a foot of the soil that lies so much [m] above the boundary."""
    ground = Ground(HEIGHT, DENSITY, MODULUS, REFERENCE, ROCK_DENSITY, ROCK_VELOCITY)
    return degrading_column.differences(ground, lambda time: wave(time - rock_height / ROCK_VELOCITY), cells=200, step=2.5e-4, end=5.0)


def run(folder, case="case.toml", **settings):
    command = [PROGRAM, "run", HERE / case, "--out", folder, "--overwrite", "--quiet"]
    command += [word for key, value in settings.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return sazare.open(folder)


def peak_strains(results):
    """By element of the soil, from below (cells,)."""
    mesh = results.element_snapshots[-1].mesh
    places, strains = mesh.cell_centers().points[:, 1], np.asarray(mesh.cell_data["shear_strain_max"])
    order = np.argsort(places)
    return strains[order][places[order] > ROCK_HEIGHT]


def largest_error(table, exact, behind):
    """Of the displacement of the surface over the foot, over its peak [-]."""
    return np.max(np.abs(np.interp(np.asarray(table["time"]), exact.time, exact.behind) - behind)) / np.max(np.abs(exact.behind))


def strong(folder):
    results = run(folder)
    table = results.gauge_table
    behind = np.asarray(table["top.displacement_x"]) - np.asarray(table["foot.displacement_x"])
    exact = differences()
    print(f"surface,{largest_error(table, exact, behind)}")
    found = peak_strains(results)
    wanted = exact.peak.reshape(len(found), -1).mean(axis=1)
    print(f"peak-strain,{found.max() / wanted.max()}")
    print(f"profile,{np.max(np.abs(found - wanted)) / wanted.max()}")
    figures = results.figures
    print(f"dissipated,{figures['energy_plastic'] / WIDTH / exact.dissipated}")
    print(f"energy-balance,{abs(figures['energy_residual']) / figures['energy_work']}")
    print(f"degraded,{wanted.max() / REFERENCE}")
    return behind


def behind_foot(table):
    """Of particles, between which the foot of the soil lies."""
    foot = 0.5 * (np.asarray(table["above foot.displacement_x"]) + np.asarray(table["below foot.displacement_x"]))
    return np.asarray(table["top.displacement_x"]) - foot


def strong_particles(folder, behind_elements):
    results = run(folder, "particles.toml")
    table = results.gauge_table
    behind = behind_foot(table)
    exact = differences(ROCK_OF_PARTICLES)
    print(f"particles-surface,{largest_error(table, exact, behind)}")
    print(f"particles-elements,{abs(np.max(np.abs(behind)) / np.max(np.abs(behind_elements)) - 1)}")
    grid = results.particle_snapshots[-1].elements
    strain = np.asarray(grid.cell_data["shear_strain_max"])
    print(f"particles-peak-strain,{strain.max() / exact.peak.max()}")
    figures = results.figures
    print(f"particles-dissipated,{figures['energy_plastic'] / WIDTH_OF_PARTICLES / exact.dissipated}")
    print(f"particles-energy-balance,{abs(figures['energy_residual']) / figures['energy_work_viscous']}")
    flow = np.asarray(results.history["energy_plastic"])
    print(f"particles-gain,{max(0.0, -np.diff(flow).min()) / flow[-1]}")


def weak(folder):
    """The transfer function of the elastic column, from the incoming wave to the surface."""
    amplitude, frequency, cycles, end, step = 1e-5, 6.0, 1, 8.0, 2e-3
    results = run(folder, "case.toml", motions__0__amplitude=amplitude, motions__0__frequency=frequency, motions__0__cycles=cycles, time__end=end,
                  time__step=step, time__history_interval=step, time__snapshot_interval=end, solver__tolerance=1e-5)  # the motion dies out
    print(f"transfer,{error_of_transfer(results, amplitude, frequency, cycles, step)}")
    print(f"weak-dissipated,{results.figures['energy_plastic']}")
    results = run(folder, "particles.toml", motions__0__amplitude=amplitude, motions__0__frequency=frequency, motions__0__cycles=cycles,
                  time__end=end, time__history_interval=step, time__snapshot_interval=end)
    print(f"particles-transfer,{error_of_transfer(results, amplitude, frequency, cycles, step)}")
    print(f"particles-weak-dissipated,{results.figures['energy_plastic']}")


def error_of_transfer(results, amplitude, frequency, cycles, step):
    """From the incoming wave to the surface, 0.5 to 8 Hz, against the exact elastic column."""
    surface = np.asarray(results.gauge_table["top.velocity_x"])
    incoming = wave(step * np.arange(len(surface)), amplitude, frequency, cycles)
    at = np.fft.rfftfreq(len(surface), step)
    ratio = np.abs(np.fft.rfft(surface) / np.fft.rfft(incoming))
    speed = np.sqrt(MODULUS / DENSITY)
    exact = 2.0 * np.abs(Column([Layer(HEIGHT, DENSITY, speed), Layer(np.inf, ROCK_DENSITY, ROCK_VELOCITY)]).transfer(at))
    band = (at >= 0.5) & (at <= 8.0)
    return np.max(np.abs(ratio - exact)[band]) / np.max(exact[band])


def main():
    with tempfile.TemporaryDirectory() as folder:
        behind = strong(Path(folder) / "strong")
        strong_particles(Path(folder) / "particles", behind)
        weak(Path(folder) / "weak")


if __name__ == "__main__":
    main()
