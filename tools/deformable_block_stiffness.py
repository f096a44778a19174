"""How stiff deformable tetrahedra are that stiff joints hold together: what sazare/laws/deformable_block.hpp rests on.

    python tools/deformable_block_stiffness.py [--quick]

The cells are those of fit_block_elasticity.py. Every element finds its place, its turn and its strain by equilibrium; each face has springs
at its three corners, k_n = K_n/H and k_s = K_s/H, and each element has the compliance of the material less what its halves of its joints
yield under a uniform stress. Printed are E over the one asked for and nu, in the mean and by direction, and the smallest share of the
compliance that is left to an element, for several K_n and K_s. Needs numpy, scipy and gmsh.
"""

import argparse

import numpy as np
from fit_block_elasticity import DELAUNAY, HXT, STRAINS, Cell, cubes_of_six, irregular_cell, moduli
from scipy import sparse

AXES = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]


def isotropic(poisson):
    """Stiffness for E = 1, per strain xx, yy, zz, yz, zx, xy of a tensor; energy is half of its square."""
    shear = 1 / (2 * (1 + poisson))
    matrix = np.diag([2 * shear] * 3 + [4 * shear] * 3)
    matrix[:3, :3] += poisson / ((1 + poisson) * (1 - 2 * poisson))
    return matrix


def sides(cell):
    """Both sides of all faces: element, and its centre beside the face."""
    return ((cell.first, cell.centre[cell.first], -1), (cell.second, cell.second_centre, 1))


def element_stiffness(cell, volume, poisson, normal_modulus, shear_modulus):
    """Of every element, and the smallest share of the compliance that one keeps."""
    normal = cell.normal
    traction = np.zeros((len(normal), 3, 6))  # per stress, off-diagonal components twice
    for column, (i, j) in enumerate(AXES):
        traction[:, i, column] += normal[:, j] / (1 if i == j else 2)
        if i != j:
            traction[:, j, column] += normal[:, i] / 2
    across = np.einsum("fi,fj->fij", normal, normal)
    softness = across / normal_modulus + (np.eye(3) - across) / shear_modulus
    joints = np.zeros((len(volume), 6, 6))
    for element, centre, _ in sides(cell):
        distance = np.abs(((cell.corners[:, 0] - centre) * normal).sum(axis=1))
        share = cell.area * distance / volume[element]
        np.add.at(joints, element, np.einsum("f,fiq,fij,fjr->fqr", share, traction, softness, traction))
    whole = np.linalg.inv(isotropic(poisson))
    root = np.linalg.inv(np.linalg.cholesky(whole))
    least = 1 - np.linalg.eigvalsh(root @ joints @ root.T).max()
    return np.linalg.inv(whole - joints), least


def stiffness(cell, volume, poisson, normal_modulus, shear_modulus):
    """The 6 x 6 stiffness of a cell."""
    faces, elements = len(cell.area), len(volume)
    tangent = np.cross(cell.normal, np.eye(3)[np.abs(cell.normal).argmin(axis=1)])
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    directions = ((cell.normal, normal_modulus), (tangent, shear_modulus), (np.cross(cell.normal, tangent), shear_modulus))
    size = np.cbrt(cell.volume / elements)  # turns and strains times this are as large as displacements
    rows, columns, values, strained = [], [], [], np.zeros((9 * faces, 6))
    for corner in range(3):
        for n, (direction, modulus) in enumerate(directions):
            weight = np.sqrt(cell.area / 3 * modulus / cell.distance)
            row = np.arange(faces) * 9 + 3 * corner + n
            for element, centre, sign in sides(cell):
                arm = cell.corners[:, corner] - centre
                moves = [*direction.T, *(np.cross(arm, direction) / size).T]
                moves += [(direction[:, i] * arm[:, j] + (direction[:, j] * arm[:, i] if i != j else 0)) / size for i, j in AXES]
                for freedom, move in enumerate(moves):
                    rows.append(row)
                    columns.append(12 * element + freedom)
                    values.append(sign * weight * move)
            for strain, (i, j) in enumerate(STRAINS):
                strained[row, strain] = weight * (direction[:, i] * cell.between[:, j] + direction[:, j] * cell.between[:, i]) / 2
    openings = sparse.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
                                 shape=(9 * faces, 12 * elements))
    own, least = element_stiffness(cell, volume, poisson, normal_modulus, shear_modulus)
    blocks = np.zeros((elements, 12, 12))
    blocks[:, 6:, 6:] = own * (volume / size**2)[:, None, None]
    matrix = openings.T @ openings + sparse.bsr_matrix((blocks, np.arange(elements), np.arange(elements + 1))).tocsr()
    moved = relaxed(matrix, -(openings.T @ strained))
    return (strained.T @ strained + strained.T @ (openings @ moved)) / cell.volume, least


def relaxed(matrix, force):
    """Motions in equilibrium, by conjugate gradients with the inverse of every element's own block."""
    blocks = sparse.bsr_matrix(matrix, blocksize=(12, 12))
    rows = np.repeat(np.arange(len(blocks.indptr) - 1), np.diff(blocks.indptr))
    inverse = sparse.block_diag(np.linalg.inv(blocks.data[rows == blocks.indices]), format="csr")
    solutions = [sparse.linalg.cg(matrix, column, M=inverse, maxiter=20000, **tolerance(column)) for column in force.T]
    if any(failed for _, failed in solutions):
        raise RuntimeError("no equilibrium was found")
    return np.array([moved for moved, _ in solutions]).T


def tolerance(column):
    """A residual that no digit printed depends on, by the name that this scipy has for it."""
    names = sparse.linalg.cg.__code__.co_varnames
    return {"rtol" if "rtol" in names else "tol": 1e-8 if np.any(column) else 1.0}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="one coarse mesh")
    quick = parser.parse_args().quick
    meshes = {"Delaunay": lambda: irregular_cell(0.16, DELAUNAY)}
    if not quick:
        meshes |= {"HXT": lambda: irregular_cell(0.16, HXT), "cubes of six": lambda: cubes_of_six(3)}
    for name, make in meshes.items():
        nodes, elements = make()
        cell = Cell(nodes, elements)
        corners = nodes[elements]
        volume = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
        print(f"{name}: {len(elements)} elements\n  nu    K_n    K_s    E (by direction)           nu (by direction)          least share")
        for poisson in (0.0, 0.25, 0.4, 0.45):
            shear = 1 / (2 * (1 + poisson))
            confined = (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson))
            for normal_factor, shear_factor in ((4, 6), (8, 12), (16, 24)):
                matrix, least = stiffness(cell, volume, poisson, normal_factor * confined, shear_factor * shear)
                young, found, low, high, least_nu, most_nu = moduli(matrix)
                print(f"  {poisson:4.2f}  {normal_factor:2} M  {shear_factor:3} G  {young:.4f} ({low:.4f} to {high:.4f})"
                      f"  {found:.4f} ({least_nu:.4f} to {most_nu:.4f})  {least:.3f}", flush=True)


if __name__ == "__main__":
    main()
