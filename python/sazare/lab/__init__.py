"""Laboratory tests of a rock of method blocks: specimens are meshed, loaded until they fail, and measured as in a laboratory.

    import sazare.lab as lab
    tested = lab.test("uniaxial", "cases/uniaxial-compression/case.toml", "runs/ucs")
    tested.figures["peak_stress"], tested.figures["youngs_modulus"], tested.curve["axial_strain"]

    peaks = {p: lab.test("triaxial", CASE, f"runs/triaxial-{p:g}", pressure=p).figures["peak_stress"] for p in (0, 10e6, 20e6)}
    lab.mohr_coulomb(list(peaks), list(peaks.values()))
"""

from sazare.lab.calibrate import Calibrated, Targets, calibrate
from sazare.lab.envelope import HoekBrown, MohrCoulomb, coulomb, hoek_brown, mohr_coulomb
from sazare.lab.machine import Tested, carry_out
from sazare.lab.rock import Rock, rock_of
from sazare.lab.trials import Options, Trial, trial_of

__all__ = [
    "Calibrated", "HoekBrown", "MohrCoulomb", "Options", "Rock", "Targets", "Tested", "Trial", "calibrate", "carry_out", "coulomb", "hoek_brown",
    "mohr_coulomb", "rock_of", "test", "trial_of",
]


def test(
    kind, case, out, *, pressure=0.0, material=None, overrides=None, threads=0, overwrite=False, progress=False, **options
):
    """Tests a specimen of a rock, and returns it as Tested.

    kind: uniaxial, triaxial, brazilian, direct-tension, direct-shear or point-load.
    case, material, overrides: where the rock is described, as for `rock_of`.
    out: the folder of the test.
    pressure: confinement of a triaxial test, normal stress of direct shear [Pa].
    options: fields of Options, such as diameter=0.05 [m], elements=10, platens="steel", strain_rate=10.0 [1/s].

    Raises ValueError for a test that cannot be made, UserError, PhysicsError or MachineError as `sazare.run`, Occupied where `out`
    holds something and `overwrite` is false.
    """
    trial = trial_of(kind, rock_of(case, material, overrides), Options(**options), pressure)
    return carry_out(trial, out, threads=threads, overwrite=overwrite, progress=progress)


test.__test__ = False  # it is none of pytest's
