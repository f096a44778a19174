"""Direct tensile strength over the splitting stress of a Brazilian disc, of the same rock."""

import tempfile
from pathlib import Path

import numpy as np

import sazare.lab as lab

CASE = Path(__file__).resolve().parents[3] / "cases/uniaxial-compression/case.toml"
SEEDS = (1, 2)
ELEMENTS = 8  # over the diameter


def strength(test, folder):
    """Mean peak stress [Pa] of several meshes."""
    return np.mean([lab.test(test, CASE, folder / f"{test}-{seed}", elements=ELEMENTS, seed=seed).figures["peak_stress"] for seed in SEEDS])


def main():
    with tempfile.TemporaryDirectory() as folder:
        direct, brazilian = (strength(test, Path(folder)) for test in ("direct-tension", "brazilian"))
    print(f"igneous,{direct / brazilian}")


if __name__ == "__main__":
    main()
