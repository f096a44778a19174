"""The column in pyStrata: writes pystrata-spectra.csv and pystrata-strains.csv beside this file, which main.py compares with.

    pip install pystrata
    python validation/analytic/column-beside-pystrata/strata.py

Equivalent-linear by layers of 0.5 m, with the hyperbola of Hardin and Drnevich and its damping by Masing's rules.
"""

import csv

import numpy as np
from ground import DENSITY, GRAVITY, HEIGHT, HERE, PERIODS, REFERENCE, ROCK_DENSITY, ROCK_VELOCITY, RUNS, S_VELOCITY, DAMPING, outcrop, rayleigh_ratio
from pystrata.motion import TimeSeriesMotion
from pystrata.propagation import EquivalentLinearCalculator, LinearElasticCalculator
from pystrata.site import Layer, Location, NonlinearProperty, Profile, SoilType

LAYERS = 40
STEP = 2e-3  # s; so fine that no peak is missed
REST = 100.0  # s without motion behind the record: a Fourier series repeats it, and slow oscillators take that long to come to rest
STRAINS = np.geomspace(1e-8, 0.1, 500)


def hyperbola():
    """G/G0 and damping ratio of the hyperbola [-] at STRAINS, by Masing's rules; its series where the closed form rounds off."""
    x = STRAINS / REFERENCE
    closed = 4.0 / np.pi * (1.0 + 1.0 / x) * (1.0 - np.log1p(x) / x) - 2.0 / np.pi
    return 1.0 / (1.0 + x), np.where(x > 1e-3, closed, 2.0 * x / (3.0 * np.pi))


def column(soil):
    """LAYERS of soil on rock without damping."""
    rock = SoilType("rock", ROCK_DENSITY * GRAVITY / 1000.0, None, 0.0)
    return Profile([Layer(soil, HEIGHT / LAYERS, S_VELOCITY) for _ in range(LAYERS)] + [Layer(rock, 0.0, ROCK_VELOCITY)])


def motion(scale):
    return TimeSeriesMotion("", "", STEP, np.r_[scale * outcrop(STEP), np.zeros(round(REST / STEP))] / GRAVITY)


def soil_of(run, damping):
    """Soil of a run: degrading, or linear with a damping ratio (one, or one for each frequency)."""
    weight = DENSITY * GRAVITY / 1000.0
    if damping is not None:
        return SoilType("soil", weight, None, damping)
    reduction, ratio = hyperbola()
    return SoilType("soil", weight, NonlinearProperty("", STRAINS, reduction, "mod_reduc"), NonlinearProperty("", STRAINS, ratio, "damping"))


def computed(run, damping=None):
    """Peak acceleration [m/s2], spectrum [m/s2] and peak strains from above [-] at the surface of a run."""
    shaken, ground = motion(run.scale), column(soil_of(run, damping))
    solver = EquivalentLinearCalculator(tolerance=1e-3, max_iterations=50) if damping is None else LinearElasticCalculator()
    base = ground.location("outcrop", index=-1)
    solver(shaken, ground, base)
    transfer = solver.calc_accel_tf(base, ground.location("outcrop", index=0))
    transfer = np.where(np.isfinite(transfer), transfer, 1.0)
    peak = GRAVITY * shaken.calc_peak(transfer)
    spectrum = GRAVITY * shaken.calc_osc_accels(1.0 / PERIODS, 0.05, transfer)
    middles = [Location(number, layer, "within", 0.5 * layer.thickness) for number, layer in enumerate(ground[:-1])]
    return np.r_[peak, spectrum], np.array([shaken.calc_peak(solver.calc_strain_tf(base, middle)) for middle in middles])


def main():
    frequency = motion(1.0).freqs
    found = {name: computed(run, rayleigh_ratio(frequency) if run.rayleigh else None) for name, run in RUNS.items()}
    found["hysteretic"] = computed(RUNS["damped"], DAMPING)
    depths = HEIGHT / LAYERS * (np.arange(LAYERS) + 0.5)
    for part, what, first in ((0, "spectra", ("period [s]", np.r_[0.0, PERIODS])), (1, "strains", ("depth [m]", depths))):
        unit = "m/s2" if part == 0 else "-"
        with (HERE / f"pystrata-{what}.csv").open("w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file, lineterminator="\n")
            rows.writerow([first[0], *(f"{name} [{unit}]" for name in found)])
            rows.writerows([f"{value:.6g}" for value in row] for row in zip(first[1], *(values[part] for values in found.values())))


if __name__ == "__main__":
    main()
