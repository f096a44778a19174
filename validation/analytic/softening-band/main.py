"""Shear of softening ground at several spacings: stress against slip and dissipated energy, beside the curve of the band that theory gives."""

import math
import sys
import tempfile
from pathlib import Path

import numpy as np

import sazare

HERE = Path(__file__).resolve().parent
SPACINGS = (0.5, 0.25, 0.125)  # m
HEIGHT, MODULUS = 20.0, 2000.0 * 100.0**2  # m, Pa; of strip.toml
PEAK, RESIDUAL, SOFTENING = 20e3, 4e3, 0.1  # Pa, Pa, m
SLIP = 0.15  # m, to which energies are compared
DIAGONAL = 0.5 * (1.5 / math.sqrt(2.0) - 1.0)  # stiffness of diagonal links, those along the axes have 0.5
MEAN_REACH = 0.75 * (0.5 + 4.0 * DIAGONAL) / (0.5 + 2.0 * DIAGONAL)  # of bands of all directions over that along an axis


def curve():
    """Slip [m] of a band along an axis of the lattice, and its shear stress [Pa], in closed form."""
    left = np.linspace(1.0, 0.08, 2000)
    early = left >= 0.5
    t = np.minimum(left, 0.5)
    core = np.sqrt(1.0 - 2.0 * t) / t
    late = ((1.0 - t) * np.arccos(np.clip(-t / (1.0 - t), -1.0, 1.0)) - np.sqrt(1.0 - 2.0 * t) + core + t * core**3 / 3.0) / np.pi
    slip = np.where(early, 1.0 - left, late) * SOFTENING / math.sqrt(MEAN_REACH)
    return slip, RESIDUAL + left * (PEAK - RESIDUAL)


def strip(spacing, softening, folder):
    """Slip [m], shear stress [Pa] and dissipated energy per area [J/m2] in the snapshots of a strip."""
    case = sazare.read_case(HERE / "strip.toml")
    case.particles.spacing = spacing
    for region in case.regions:
        region.upper[0] = 2.0 * spacing
        region.lower[1] += 0.25 - 0.5 * spacing
        region.upper[1] -= 0.25 - 0.5 * spacing
    for material in case.materials[1:]:
        material.softening_displacement = softening
    run = sazare.run(case, folder, progress=False)
    rows = []
    for snapshot in run.particle_snapshots:
        grid = snapshot.elements
        start = np.asarray(grid.points)[:, 1] - np.asarray(grid["displacement"])[:, 1]
        ends = np.minimum(start, HEIGHT - start)
        elastic = (ends > 0.75) & (ends < 2.25)
        stress = np.asarray(grid["shear_stress"])[elastic, 0].mean()
        moved = np.asarray(grid["displacement"])[start > HEIGHT - 1e-6, 0].mean()
        plastic = np.interp(snapshot.time, run.history["time"], run.history["energy_plastic"])
        rows.append((moved - stress * HEIGHT / MODULUS, stress, plastic / (2.0 * spacing)))
    residual = abs(run.history["energy_residual"][-1]) / run.history["energy_work_boundary"][-1]
    return *np.array(rows).T, residual


def energy(slip, stress, dissipated):
    """Dissipated up to SLIP [J/m2]."""
    return float(np.interp(SLIP, slip, dissipated))


def main():
    exact_slip, exact_stress = curve()
    shown = np.linspace(0.02, SLIP, 14)
    expected = np.interp(shown, exact_slip, exact_stress)
    found, residuals = {}, []
    with tempfile.TemporaryDirectory() as place:
        for spacing in SPACINGS:
            *found[spacing], residual = strip(spacing, SOFTENING, Path(place) / f"{spacing}")
            residuals.append(residual)
            if "--draw" in sys.argv:
                np.savetxt(f"{sys.argv[-1]}/{spacing}.csv", np.stack(found[spacing], axis=1))
        # As if the softening strain of the coarsest were given to all: u is as the spacing.
        local = [strip(spacing, SOFTENING * spacing / SPACINGS[0], Path(place) / f"local-{spacing}")[:3] for spacing in SPACINGS]
    for spacing in SPACINGS:
        slip, stress, _ = found[spacing]
        off = np.abs(np.interp(shown, slip, stress) - expected).max() / (PEAK - RESIDUAL)
        print(f"curve-{spacing},{off:.6g}")
    energies = [energy(*found[spacing]) for spacing in SPACINGS]
    print(f"energy,{energies[-1]:.6g},{np.trapezoid(np.interp(s := np.linspace(0.0, SLIP, 500), exact_slip, exact_stress), s):.6g}")
    for spacing, one in zip(SPACINGS[:-1], energies):
        print(f"energy-{spacing},{one / energies[-1]:.6g}")
    without = [np.trapezoid(np.interp(s, *one[:2]) - RESIDUAL, s) for one in local]
    with_length = [np.trapezoid(np.interp(s, *found[spacing][:2]) - RESIDUAL, s) for spacing in SPACINGS]
    print(f"above-residual,{max(with_length) / min(with_length):.6g}")
    print(f"without,{max(without) / min(without):.6g}")
    print(f"balance,{max(residuals):.6g}")


if __name__ == "__main__":
    main()
