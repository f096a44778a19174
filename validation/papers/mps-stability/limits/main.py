"""Limit steps of the column by the program beside this file, against eigenvalues of the formulation that are calculated here from the paper's appendix."""

import csv
import subprocess
from pathlib import Path

import numpy as np
from scipy.sparse.linalg import eigs

PROGRAM = Path(__file__).resolve().parents[4] / "build/release/validation/papers/mps-stability/limits"
DENSITY, S_WAVE, P_WAVE = 1500.0, 100.0, 200.0  # kg/m3, m/s, m/s
COLUMNS = {"05": (1.0, 10, 100), "10": (2.0, 5, 50), "16": (3.2, 3, 31)}  # spacing [m], particles across and along
NEIGHBOURS = [(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1) if (x, y) != (0, 0)]
REACH = 1.5  # of the influence radius over the spacing


def stiffness(spacing, across, along, densities):
    """Dense stiffness of displacements and rotations (3 n, 3 n), the second derivatives of the energy that (A3) to (A14) have, linearised.

    A link has u = v_j - v_i - (turn_i + turn_j)/2 x r0, its energy is k u.u/2 with k = 4 d V w mu/(n0 r0^2); a particle has V lambda div^2/2 with
    div = d/n0 sum w (u . e)/r0, (A11). mu of a link is the mean of both particles' (A3), (A4); densities (along,) [kg/m3] are those of the rows."""
    count = across * along
    volume, shear, lame = spacing**2, densities * S_WAVE**2, densities * (P_WAVE**2 - 2.0 * S_WAVE**2)
    weight = {near: REACH / np.hypot(*near) - 1.0 for near in NEIGHBOURS}  # (A8)
    density_number = sum(weight.values())  # (A9)
    whole = np.zeros((3 * count, 3 * count))
    for x in range(across):
        for y in range(along):
            here = 3 * (x + across * y)
            strain, used = np.zeros(3 * count), [here + axis for axis in range(3)]
            for (right, up), share in weight.items():
                if not (0 <= x + right < across and 0 <= y + up < along):
                    continue
                there = 3 * (x + right + across * (y + up))
                length = spacing * np.hypot(right, up)
                start = spacing * np.array([right, up])
                freedoms = [here, here + 1, here + 2, there, there + 1, there + 2]
                turned = 0.5 * np.array([start[1], -start[0]])[:, None]  # less the rotation: turn x r0 = turn (-r0_y, r0_x)
                motion = np.hstack([-np.eye(2), turned, np.eye(2), turned])
                spring = 8.0 * volume * share * 0.5 * (shear[y] + shear[y + up]) / (density_number * length**2)
                whole[np.ix_(freedoms, freedoms)] += 0.5 * spring * motion.T @ motion  # every link is met twice
                strain[freedoms] += 2.0 / density_number * share / length * (start / length) @ motion
                used += freedoms[3:]
            whole[np.ix_(used, used)] += volume * lame[y] * np.outer(strain[used], strain[used])
    return whole


def limit(spacing, across, along, torque=1.0, upper=1.0):
    """Twice the reciprocal of the largest frequency [s] of the column of figure 1 for S waves: rollers at the sides, the base held.

    torque: that of each link, over the one that keeps the angular momentum. upper: density of the upper half over that of the lower one."""
    densities = DENSITY * np.where(np.arange(along) < along // 2, 1.0, upper)
    masses = np.repeat(densities, 3 * across) * spacing**2 * np.tile([1.0, 1.0, spacing**2 / 6.0], across * along)  # (A14)
    held = np.zeros((along, across, 3), dtype=bool)
    held[:, [0, -1], 1] = True
    held[0, :, :2] = True
    free = ~held.ravel()
    root = np.sqrt(masses[free])
    forces = stiffness(spacing, across, along, densities)
    forces[2::3] *= torque
    scaled = forces[np.ix_(free, free)] / np.outer(root, root)
    largest = np.linalg.eigvalsh(scaled)[-1] if torque == 1.0 else eigs(scaled, k=1, which="LM", return_eigenvectors=False)[0].real
    return 2.0 / np.sqrt(largest)


def main():
    limits = {name: limit(*column) for name, column in COLUMNS.items()}
    limits["torque"] = limit(*COLUMNS["05"], torque=2.0)
    limits["density"] = limit(*COLUMNS["05"], upper=10.0) / limits["05"]
    done = subprocess.run([PROGRAM], capture_output=True, text=True, check=True)
    for row, ours in csv.reader(done.stdout.splitlines()):
        expected = None if row == "paper-torque" else limits.get(row.rsplit("-", 1)[-1])
        print(f"{row},{ours}" if expected is None else f"{row},{ours},{expected:.8g}")


if __name__ == "__main__":
    main()
