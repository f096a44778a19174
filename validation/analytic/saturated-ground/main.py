"""Saturated ground under loads: consolidation in one and two dimensions, and a wave in a column, against exact solutions."""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare

HERE = Path(__file__).resolve().parent
PROGRAM = HERE.parents[2] / "build/release/apps/sazare/sazare"
WATER_WEIGHT, POROSITY = 1000.0 * 9.81, 0.4  # N/m3, -


def run(case, folder, **settings):
    command = [PROGRAM, "run", case, "--out", folder, "--overwrite", "--quiet"]
    command += [word for key, value in settings.items() for word in ("--set", f"{key.replace('__', '.')}={value}")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(done.stderr)
    return sazare.open(folder)


def moduli(youngs_modulus, poisson_ratio, water):
    """Shear modulus, bulk modulus of the skeleton, and the modulus that water in the pores adds to it [Pa]."""
    shear = youngs_modulus / (2.0 * (1.0 + poisson_ratio))
    return shear, youngs_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio)), water / POROSITY


def terzaghi(folder, order):
    """A layer of 10 m that drains to its top. Errors over the load and over the last settlement."""
    height, load, conductivity = 10.0, 1e5, 1e-6
    shear, bulk, water = moduli(5e7, 0.25, 2.2e9)
    constrained = bulk + 4.0 * shear / 3.0
    consolidation = conductivity / WATER_WEIGHT * constrained * water / (constrained + water)
    end = 0.5 * height**2 / consolidation
    results = run(HERE / "column.toml", folder, mesh__parameters=f"{{order = {order}}}", materials__0__hydraulic_conductivity=conductivity,
                  loads__0__ramp=0.0, time__analysis='"static"', time__end=end, time__step=end / 1000,
                  time__history_interval=end / 100, time__snapshot_interval=end)
    table = results.gauge_table
    factor = consolidation * np.asarray(table["time"]) / height**2
    n = np.pi / 2.0 * (2.0 * np.arange(400)[:, None] + 1.0)
    first = water / (constrained + water)  # share of the load that the water takes at once
    decay = np.exp(-(n**2) * factor)

    def pressure(depth):
        return first * np.sum(2.0 / n * np.sin(n * depth / height) * decay, axis=0)

    settled = load * height / constrained * (1.0 - first * np.sum(2.0 / n**2 * decay, axis=0))
    later = factor >= 0.05  # the pressure falls by a jump at the beginning
    errors = [np.max(np.abs(np.asarray(table[f"{name}.excess_pore_pressure"]) / load - pressure(depth))[later])
              for name, depth in (("base", height), ("middle", height / 2.0))]
    sunk = np.abs(-np.asarray(table["top.displacement_y"]) - settled)[later]
    return max(errors), np.max(sunk) / settled[-1]


def roots_of_mandel(ratio, count=60):
    """Roots of tan(x) = ratio x with a ratio above 1: one in every (n pi, n pi + pi/2)."""
    low = np.arange(count) * np.pi + 1e-9
    high = np.arange(count) * np.pi + np.pi / 2.0 - 1e-12
    for _ in range(100):
        middle = 0.5 * (low + high)
        beyond = np.tan(middle) > ratio * middle
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return 0.5 * (low + high)


def mandel(folder, order):
    """Errors of the pressure over its first value, in the middle and near the side, and the peak of the pressure in the middle.

    Mandel, Geotechnique 3 (1953) 287-299; Cheng and Detournay, Int. J. Numer. Anal. Methods Geomech. 12 (1988) 561-572.
    """
    width, height, force, conductivity = 1.0, 0.5, 1e5, 1e-8  # m, m, N/m on half a plate, m/s
    poisson = 0.2
    shear, bulk, water = moduli(1e7, poisson, 5e7)
    undrained = bulk + water
    poisson_undrained = (3.0 * undrained - 2.0 * shear) / (2.0 * (3.0 * undrained + shear))
    skempton = water / undrained
    consolidation = conductivity / WATER_WEIGHT * water * (bulk + 4.0 * shear / 3.0) / (undrained + 4.0 * shear / 3.0)
    end, steps = 0.5 * width**2 / consolidation, 1000
    at = roots_of_mandel((1.0 - poisson) / (poisson_undrained - poisson))[:, None]
    weight = np.sin(at) * np.cos(at) / (at - np.sin(at) * np.cos(at))

    def decay(time):
        return np.exp(-(at**2) * consolidation * time / width**2)

    def pressure(place, time):
        shape = np.sin(at) / (at - np.sin(at) * np.cos(at)) * (np.cos(at * place / width) - np.cos(at))
        return 2.0 * force * skempton * (1.0 + poisson_undrained) / (3.0 * width) * np.sum(shape * decay(time), axis=0)

    time = np.linspace(0.0, end, steps + 1)
    plate = height * (-force * (1.0 - poisson) / (2.0 * shear * width)
                      + force * (1.0 - poisson_undrained) / (shear * width) * np.sum(weight * decay(time), axis=0))
    plate[0] = 0.0
    record = Path(folder) / "plate.csv"
    record.write_text("time [s],displacement [m]\n" + "".join(f"{t!r},{u!r}\n" for t, u in zip(time.tolist(), plate.tolist())))
    results = run(HERE / "mandel.toml", Path(folder) / "run", motions__0__file=f'"{record}"', mesh__parameters=f"{{order = {order}}}",
                  time__end=end, time__step=end / steps, time__history_interval=end / steps, time__snapshot_interval=end)
    table = results.gauge_table
    now = np.asarray(table["time"])
    first = force * skempton * (1.0 + poisson_undrained) / (3.0 * width)
    later = consolidation * now / width**2 >= 0.01
    errors = []
    for name, place in (("middle", 0.0), ("outer", None)):
        found = np.asarray(table[f"{name}.excess_pore_pressure"])
        where = place if place is not None else gauge_place(results, name)
        errors.append(np.max(np.abs(found - pressure(where, now))[later]) / first)
    middle = np.asarray(table["middle.excess_pore_pressure"])
    return max(errors), np.max(middle[later]) / first, np.max(pressure(0.0, now)[later]) / first


def gauge_place(results, name):
    """x [m] of the node of a gauge."""
    points = np.asarray(results.element_snapshots[0].mesh.points)
    wanted = np.array([0.7, 0.25, 0.0])
    return points[np.argmin(np.linalg.norm(points - wanted, axis=1)), 0]


def biot(time, height=10.0, load=1e5, ramp=0.05, conductivity=1e-4):
    """Settlement of the top [m] and pressure at the base [Pa] of a column, by Biot's equations with all inertia.

    The equations for u and for the flow w are solved for every complex frequency s, and brought back by the discrete Fourier
    transform of values on a line Re s > 0. Biot, J. Acoust. Soc. Am. 28 (1956) 168-178; Schanz and Cheng, Acta Mech. 145 (2000) 1-18.
    """
    shear, bulk, water = moduli(5e7, 0.25, 2.2e9)
    constrained, density, water_density = bulk + 4.0 * shear / 3.0, 2000.0, 1000.0
    count, period = 2**15, 8.0 * time[-1]
    line = 12.0 / period
    s = line + 2j * np.pi * np.arange(count // 2 + 1) / period
    stiffness = np.array([[constrained + water, water], [water, water]])
    inverse = np.linalg.inv(stiffness)
    mass = np.empty((len(s), 2, 2), complex)
    mass[:, 0, 0] = s**2 * density
    mass[:, 0, 1] = mass[:, 1, 0] = s**2 * water_density
    mass[:, 1, 1] = s**2 * water_density / POROSITY + s * WATER_WEIGHT / conductivity
    squares, modes = np.linalg.eig(inverse @ mass)
    rates = np.sqrt(squares)
    # u, w = sum of c modes sinh(rate z); at the top no pressure: u' + w' = 0, and the skeleton carries the load: M u' = -load.
    # With c = factor / cosh(rate height) nothing overflows.
    system = np.stack([modes[:, 0, :] * rates, (modes[:, 0, :] + modes[:, 1, :]) * rates], axis=1)
    pulse = load * (1.0 - np.exp(-s * ramp)) / (s**2 * ramp)
    right = np.stack([-pulse / constrained, np.zeros_like(pulse)], axis=1)
    factors = np.linalg.solve(system, right[:, :, None])[:, :, 0]
    top = np.sum(factors * modes[:, 0, :] * np.tanh(rates * height), axis=1)
    fall = 2.0 * np.exp(-rates * height) / (1.0 + np.exp(-2.0 * rates * height))  # 1 / cosh
    base = -water * np.sum(factors * (modes[:, 0, :] + modes[:, 1, :]) * rates * fall, axis=1)
    at = np.arange(count) * period / count
    return [np.interp(time, at, np.exp(line * at) * np.fft.irfft(values) * count / period) for values in (-top, base)]


def wave(folder, order):
    """Largest errors of the settlement and of the pressure at the base, over their largest values."""
    cells, ratio = (200, 0.985) if order == 1 else (60, 0.95)
    results = run(HERE / "column.toml", folder, mesh__parameters=f"{{order = {order}, cells = {cells}, ratio = {ratio}}}")
    table = results.gauge_table
    settled, pressure = biot(np.asarray(table["time"]))
    found = -np.asarray(table["top.displacement_y"]), np.asarray(table["base.excess_pore_pressure"])
    figures = results.figures
    return (np.max(np.abs(found[0] - settled)) / np.max(settled), np.max(np.abs(found[1] - pressure)) / np.max(pressure),
            abs(figures["energy_residual"]) / figures["energy_work"])


def main():
    with tempfile.TemporaryDirectory() as folder:
        for name, order in (("linear", 1), ("quadratic", 2)):
            pressure, settled = terzaghi(Path(folder) / "terzaghi", order)
            print(f"terzaghi-pressure-{name},{pressure}")
            print(f"terzaghi-settlement-{name},{settled}")
            error, peak, exact = mandel(folder, order)
            print(f"mandel-pressure-{name},{error}")
            print(f"mandel-cryer-{name},{peak},{exact}")
            settled, pressure, residual = wave(Path(folder) / "wave", order)
            print(f"wave-settlement-{name},{settled}")
            print(f"wave-pressure-{name},{pressure}")
            print(f"energy-{name},{residual}")


if __name__ == "__main__":
    main()
