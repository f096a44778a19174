"""The direction in which a crack leaves the notch of a plate that is struck beside it."""

import argparse
import tempfile
from pathlib import Path

import numpy as np

import sazare

CASE = Path(__file__).resolve().parents[3] / "cases/kalthoff-winkler/case.toml"
TIP = np.array([0.05, 0.025])  # m


def crack_angle(joints):
    """Angle [deg] from the line of the notch to the middle of the cracks above it, seen from its tip, each face by its area."""
    state = np.asarray(joints["state"])
    corners = np.asarray(joints.points).reshape(-1, 3, 3)[np.isin(state, (2, 3))]
    area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    place = corners.mean(axis=1)[:, :2] - TIP
    ahead = (place[:, 1] > 0.0) & (place[:, 0] > -0.02)
    x, y = np.average(place[ahead], axis=0, weights=area[ahead])
    return float(np.degrees(np.arctan2(y, x)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        done = sazare.run(CASE, Path(place) / "run", progress=False)
        print(f"angle,{crack_angle(done.snapshots[-1].joints):.6g}")


if __name__ == "__main__":
    main()
