"""Figures of a test: strength, elasticity, stresses at which cracks begin and at which the specimen dilates."""

import numpy as np

LOWER, UPPER = 0.2, 0.5  # shares of the peak between which elasticity is measured
FIRST_CRACKS = 0.01  # share of the cracks at the peak with which cracking has begun (Potyondy and Cundall, 2004)
RESIDUAL = 0.25  # of the displacement, at its end
STILL_RISING = 0.99  # share of the largest stress above which the last one means that the specimen has not failed


def figures_of(trial, curve):
    """Figures by name [SI units], from the columns of curve.csv.

    peak_stress: the largest stress; deviatoric_stress: less the confinement. failed: whether the stress fell from there. peak_strain: that of the
    platens. youngs_modulus, poisson_ratio: slopes between 20 and 50 % of the peak in the middle of the specimen, by least squares.
    crack_initiation_stress: the stress with 1 % of the cracks that there are at the peak. crack_damage_stress: the stress at the smallest volume.
    residual_stress, residual_scatter: mean and standard deviation over the last quarter of the displacement. imbalance: the largest difference of the forces of the two platens before the peak, over
    the peak.
    """
    stress = curve["stress"]
    peak = int(np.argmax(stress))
    found = {
        "peak_stress": float(stress[peak]),
        "failed": bool(stress[-1] < STILL_RISING * stress[peak]),
        "peak_strain": float(curve["platen_strain"][peak]),
        "peak_load": float(stress[peak] * trial.specimen.area),
        "imbalance": float(np.abs(stress - curve["opposite_stress"])[: peak + 1].max() / stress[peak]) if stress[peak] > 0.0 else np.nan,
        "cracks_at_peak": int(curve["broken_joints"][peak]),
        "cracks": int(curve["broken_joints"][-1]),
    }
    if trial.pressure and trial.test == "triaxial":
        found["deviatoric_stress"] = found["peak_stress"] - trial.pressure
    if trial.measures_strain:
        found |= _elasticity(trial, curve, peak)
    if trial.test == "uniaxial" or trial.test == "triaxial":
        found |= _damage(curve, peak)
    if trial.test == "direct-shear":
        last = curve["displacement"] >= (1.0 - RESIDUAL) * curve["displacement"][-1]
        found["residual_stress"] = float(stress[last].mean())
        found["residual_scatter"] = float(stress[last].std())
    if trial.test == "point-load":
        # ISRM (1985): to the strength of a core of 50 mm.
        found["point_load_index_50"] = found["peak_stress"] * (np.sqrt(trial.specimen.area) / 0.05) ** 0.45
    return found


def _elasticity(trial, curve, peak):
    added = curve["stress"][: peak + 1] - trial.pressure
    chosen = (added >= LOWER * added[peak]) & (added <= UPPER * added[peak])
    axial, lateral = (curve[name][: peak + 1][chosen] for name in ("axial_strain", "lateral_strain"))
    if chosen.sum() < 3 or not np.isfinite(axial).all() or np.ptp(axial) == 0.0:
        return {}
    modulus = np.polyfit(axial, added[chosen], 1)[0]
    ratio = -trial.sense * np.polyfit(axial, lateral, 1)[0]
    return {"youngs_modulus": float(modulus), "poisson_ratio": float(ratio)}


def _damage(curve, peak):
    cracks = curve["broken_joints"][: peak + 1]
    found = {}
    if cracks[peak] > 0:
        begun = int(np.argmax(cracks >= max(1.0, FIRST_CRACKS * cracks[peak])))
        found["crack_initiation_stress"] = float(curve["stress"][begun])
    smallest = int(np.argmin(curve["volumetric_strain"][: peak + 1]))
    found["crack_damage_stress"] = float(curve["stress"][smallest])
    return found
