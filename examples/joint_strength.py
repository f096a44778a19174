"""The tensile strength of joints from a test: that for which a beam in three-point bending breaks at the measured load.

    python examples/joint_strength.py 2700

The load is that on the platen [N]; the beam is the case `mortar-beam` with coarser squares.
"""

import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

import sazare

CASE = Path(__file__).resolve().parents[1] / "cases/mortar-beam/case.toml"
COARSE = {"blocks.0.element_size": 0.0133333333333333, "gauges.0.point": [0.0867, 0.0067, 0.0], "time.history_interval": 1e-4, "time.end": 0.04}


def breaking_load(tensile_strength, folder):
    """The largest load [N] that the platen brings onto a beam whose joints have this strength [Pa]."""
    overrides = {**COARSE, "materials.0.tensile_strength": float(tensile_strength)}
    beam = sazare.run(CASE, folder, overrides=overrides, overwrite=True, progress=False)
    if not beam.figures["broken_springs"]:
        raise RuntimeError(f"a beam of {tensile_strength:.3g} Pa does not break before the case ends: make time.end longer")
    return float(np.abs(beam.history["platen.force_y"]).max())


def calibrate(measured, low=1e6, high=10e6, tolerance=1e-2):
    """The strength [Pa] at which the beam breaks at the measured load [N], to a share of it, and the loads on the way."""
    tried = {}
    with tempfile.TemporaryDirectory() as folder:

        def too_strong(strength):
            tried[strength] = breaking_load(strength, Path(folder) / "beam")
            return tried[strength] - measured

        return brentq(too_strong, low, high, xtol=tolerance * low), tried


def main(measured):
    """Prints every trial and the answer."""
    strength, tried = calibrate(measured)
    for each, load in tried.items():
        print(f"{each / 1e6:6.3f} MPa  breaks at {load:7.1f} N")
    print(f"{measured:.0f} N were measured: the joints have {strength / 1e6:.2f} MPa")


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 2700.0)
