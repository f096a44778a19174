"""Elasticity of cylinders that the laboratory measures, loaded to a part of their strength, against that of the material."""

import tempfile
from pathlib import Path

import numpy as np

import sazare.lab as lab

CASE = Path(__file__).resolve().parents[3] / "cases/uniaxial-compression/case.toml"
SEEDS = (1, 2, 3)
CONFINEMENT = 20e6  # Pa
LOADED = 0.5  # of the strain at which failure is expected


def measured(test, folder, seed=1, pressure=0.0):
    """A cylinder that is loaded and does not fail."""
    rock = lab.rock_of(CASE)
    whole = lab.trial_of(test, rock, lab.Options(elements=6, seed=seed), pressure)
    part = lab.trial_of(test, rock, lab.Options(elements=6, seed=seed, strain=LOADED * whole.expected_strain), pressure)
    return lab.carry_out(part, folder, progress=False)


def main():
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        pressed = [measured("uniaxial", folder / f"pressed-{seed}", seed).figures for seed in SEEDS]
        confined = measured("triaxial", folder / "confined", pressure=CONFINEMENT)
        pulled = measured("direct-tension", folder / "pulled").figures
    print(f"modulus-pressed,{np.mean([figures['youngs_modulus'] for figures in pressed])}")
    print(f"poisson-pressed,{np.mean([figures['poisson_ratio'] for figures in pressed])}")
    print(f"modulus-confined,{confined.figures['youngs_modulus']}")
    print(f"modulus-pulled,{pulled['youngs_modulus']}")
    print(f"poisson-pulled,{pulled['poisson_ratio']}")
    print(f"confinement,{confined.curve['stress'][0] / CONFINEMENT}")


if __name__ == "__main__":
    main()
