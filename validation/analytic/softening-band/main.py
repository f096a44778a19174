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
SINE_PEAK, SINE_RESIDUAL = math.sin(math.radians(40.0)), 0.5  # of the angles of friction of sand.toml
GRAVITY, ABOVE_MIDDLE = 10.0, 7.0 * 20.0 * 10.0  # m/s2, Pa; of sand.toml: what lies between its middle and the cap
PRESSURES = (50e3, 100e3)  # Pa
SLIP = 0.15  # m, to which energies are compared
DIAGONAL = 0.5 * (1.5 / math.sqrt(2.0) - 1.0)  # stiffness of diagonal links, those along the axes have 0.5
MEAN_REACH = 0.75 * (0.5 + 4.0 * DIAGONAL) / (0.5 + 2.0 * DIAGONAL)  # of bands of all directions over that along an axis


def curve():
    """Slip [m] of a band along an axis of the lattice, and what is left of the drop of its strength [-], in closed form."""
    left = np.linspace(1.0, 0.08, 2000)
    early = left >= 0.5
    t = np.minimum(left, 0.5)
    core = np.sqrt(1.0 - 2.0 * t) / t
    late = ((1.0 - t) * np.arccos(np.clip(-t / (1.0 - t), -1.0, 1.0)) - np.sqrt(1.0 - 2.0 * t) + core + t * core**3 / 3.0) / np.pi
    slip = np.where(early, 1.0 - left, late) * SOFTENING / math.sqrt(MEAN_REACH)
    return slip, left


def clay(softening):
    """The strip that loses cohesion over a softening displacement [m]."""
    case = sazare.read_case(HERE / "strip.toml")
    for material in case.materials[1:]:
        material.softening_displacement = softening
    return case


def sand(pressure):
    """The strip that loses friction under a cap of 3 m that presses with this much [Pa]."""
    case = sazare.read_case(HERE / "sand.toml")
    cap = case.materials[0]
    cap.density = pressure / (3.0 * GRAVITY)
    cap.s_wave_velocity = math.sqrt(MODULUS / cap.density)
    return case


def strip(case, spacing, folder):
    """Slip [m], shear stress [Pa] and dissipated energy per area [J/m2] in the snapshots of a strip."""
    case.particles.spacing = spacing
    for region in case.regions:
        region.upper[0] = 2.0 * spacing
        region.lower[1] += 0.25 - 0.5 * spacing
        region.upper[1] -= 0.25 - 0.5 * spacing
    run = sazare.run(case, folder, progress=False)
    rows = []
    for snapshot in run.particle_snapshots:
        grid = snapshot.elements
        start = np.asarray(grid.points)[:, 1] - np.asarray(grid["displacement"])[:, 1]
        ends = np.minimum(start, HEIGHT - start)
        elastic = (ends > 0.75) & (ends < 2.25)
        stress = abs(np.asarray(grid["shear_stress"])[elastic, 0].mean())
        along = np.asarray(grid["displacement"])[:, 0]
        moved = abs(along[start.argmax()] - along[start.argmin()])
        plastic = np.interp(snapshot.time, run.history["time"], run.history["energy_plastic"])
        rows.append((moved - stress * HEIGHT / MODULUS, stress, plastic / (2.0 * spacing)))
    residual = abs(run.history["energy_residual"][-1]) / run.history["energy_work_boundary"][-1]
    return *np.array(rows).T, residual


def energy(slip, stress, dissipated):
    """Dissipated up to SLIP [J/m2]."""
    return float(np.interp(SLIP, slip, dissipated))


def main():
    exact_slip, left = curve()
    exact_stress = RESIDUAL + left * (PEAK - RESIDUAL)
    shown = np.linspace(0.02, SLIP, 14)
    expected = np.interp(shown, exact_slip, exact_stress)
    of_sand = {}
    found, residuals = {}, []
    with tempfile.TemporaryDirectory() as place:
        for spacing in SPACINGS:
            *found[spacing], residual = strip(clay(SOFTENING), spacing, Path(place) / f"{spacing}")
            residuals.append(residual)
            if "--draw" in sys.argv:
                np.savetxt(f"{sys.argv[-1]}/{spacing}.csv", np.stack(found[spacing], axis=1))
        # As if the softening strain of the coarsest were given to all: u is as the spacing.
        local = [strip(clay(SOFTENING * spacing / SPACINGS[0]), spacing, Path(place) / f"local-{spacing}")[:3] for spacing in SPACINGS]
        for pressure in PRESSURES:
            for spacing in SPACINGS[:2]:
                *of_sand[pressure, spacing], residual = strip(sand(pressure), spacing, Path(place) / f"sand-{pressure}-{spacing}")
                residuals.append(residual)
                if "--draw" in sys.argv:
                    np.savetxt(f"{sys.argv[-1]}/sand-{pressure}-{spacing}.csv", np.stack(of_sand[pressure, spacing], axis=1))
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
    late = np.linspace(0.12, 0.18, 7)
    for (pressure, spacing), (slip, stress, _) in of_sand.items():
        normal = pressure + ABOVE_MIDDLE
        kept = (np.interp(late, slip, stress) / normal - SINE_RESIDUAL) / (SINE_PEAK - SINE_RESIDUAL)
        print(f"sand-{pressure / 1e3:.0f}-{spacing},{np.abs(kept - np.interp(late, exact_slip, left)).max():.6g}")
    print(f"balance,{max(residuals):.6g}")


if __name__ == "__main__":
    main()
