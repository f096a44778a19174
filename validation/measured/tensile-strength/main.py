"""Direct tensile strength over the splitting stress of a Brazilian disc, of the same rock."""

import tempfile
from pathlib import Path

import numpy as np

import sazare.lab as lab

CASE = Path(__file__).resolve().parents[3] / "cases/uniaxial-compression/case.toml"
SEEDS = (1, 2)
ELEMENTS = 6  # over the diameter
FRACTURE_ENERGIES = (50, 12)  # N/m; the case has 50


def strength(test, energy, folder):
    """Mean peak stress [Pa] of several meshes."""
    overrides = {"joints.0.fracture_energy": float(energy)}
    folders = {seed: folder / f"{test}-{energy}-{seed}" for seed in SEEDS}
    tested = [lab.test(test, CASE, out, overrides=overrides, elements=ELEMENTS, seed=seed) for seed, out in folders.items()]
    return np.mean([one.figures["peak_stress"] for one in tested])


def main():
    with tempfile.TemporaryDirectory() as folder:
        for energy in FRACTURE_ENERGIES:
            direct, brazilian = (strength(test, energy, Path(folder)) for test in ("direct-tension", "brazilian"))
            print(f"fracture-energy-{energy},{direct / brazilian}")


if __name__ == "__main__":
    main()
