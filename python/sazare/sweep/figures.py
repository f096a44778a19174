"""Figures of a run by name, as a row of a sweep."""

import math

import numpy as np

from sazare.results import open_run


def figures_of(folder):
    """The numbers of a run's manifest by name; `ppv NAME` of each gauge [m/s]; `broken_area` [m2] where its last snapshot shows joints."""
    results = open_run(folder)
    found = {name: float(value) for name, value in results.figures.items() if isinstance(value, int | float) and not isinstance(value, bool)}
    found |= {f"ppv {name}": float(value) for name, value in results.figures.get("ppv", {}).items()}
    area = broken_area(results)
    return found if area is None else found | {"broken_area": area}


def broken_area(results):
    """Area of the joints that are cracks in the last snapshot [m2], one side of each; None where it shows no joints."""
    snapshots = results.snapshots
    if not len(snapshots) or getattr(snapshots[-1], "joints", None) is None:
        return None
    joints = snapshots[0].joints if snapshots[0].joints.n_cells == snapshots[-1].joints.n_cells else snapshots[-1].joints
    corners = np.asarray(joints.points)[np.asarray(joints.cell_connectivity).reshape(-1, 3)]
    areas = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    area = float(areas[np.asarray(snapshots[-1].joints.cell_data["state"]) >= 2].sum())
    return area if math.isfinite(area) else None
