"""Fits what springs between rigid tetrahedra stand for: the constants of sazare/laws/block_elasticity.hpp.

    python tools/fit_block_elasticity.py [--quick]

A cell of tetrahedra that repeats in three directions is strained in the six possible ways. Every element is rigid and finds its place and
its turn by equilibrium; each face between two of them has springs at its three corners,

    k_n = K_n/H,  k_s = K_s/H      H  distance of the two centres, normal to the face

The stresses are the stiffness of the cell: 21 numbers, which depend on the mesh and on the ratio K_s/K_n. Their isotropic part gives Young's
modulus E, in units of K_n, and Poisson's ratio nu. Printed are both for every mesh and ratio, how they differ with direction, the
constants a, b, c that fit the irregular meshes best,

    K_s/K_n = (1 - 2 nu)/(1 + b nu + c nu^2)      K_n = E/((1 - 2 nu)(1 + a (1 - 2 nu)))

and how far each mesh is from them. Needs numpy, scipy and gmsh; takes some ten minutes, with --quick one.
"""

import argparse
import itertools
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from scipy import sparse
from scipy.optimize import least_squares

RATIOS = (1.0, 0.8, 0.6, 0.4, 0.25, 0.15, 0.1, 0.06, 0.03)
STRAINS = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
DELAUNAY, HXT = 1, 10  # algorithms of gmsh
GRADED = ('Field[1] = MathEval; Field[1].F = "0.05 * 8^(0.5 * (1 - Cos(2 * 3.14159265 * x)))"; Background Field = 1;'
          "Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0; Mesh.MeshSizeMax = 1;")


def irregular_cell(size, algorithm=DELAUNAY, seed=1, sizes=""):
    """A unit cube of irregular tetrahedra whose opposite sides are alike: nodes, and corners of the elements."""
    sides = "".join(f"Periodic Surface{{{to}}} = {{{of}}} Translate{{{shift}}};"
                    for of, to, shift in ((1, 2, "1, 0, 0"), (3, 4, "0, 1, 0"), (5, 6, "0, 0, 1")))
    text = (f'SetFactory("OpenCASCADE"); Box(1) = {{0, 0, 0, 1, 1, 1}}; {sides} Mesh.Algorithm3D = {algorithm};'
            f"Mesh.RandomSeed = {seed}; Mesh.MeshSizeMin = {'0.001' if sizes else size}; Mesh.MeshSizeMax = {size}; {sizes}\n")
    with tempfile.TemporaryDirectory() as folder:
        geometry, mesh = Path(folder) / "cell.geo", Path(folder) / "cell.msh"
        geometry.write_text(text, encoding="utf-8")
        subprocess.run(["gmsh", "-3", "-v", "1", "-nt", "1", "-format", "msh2", geometry, "-o", mesh], check=True)
        return read_mesh(mesh.read_text(encoding="utf-8").split("\n"))


def read_mesh(lines):
    """Nodes and tetrahedra of a mesh in format 2.2 of gmsh."""
    def rows(section):
        begin = lines.index(section)
        return [line.split() for line in lines[begin + 2:begin + 2 + int(lines[begin + 1])]]

    nodes = rows("$Nodes")
    number = {row[0]: place for place, row in enumerate(nodes)}
    elements = [[number[node] for node in row[-4:]] for row in rows("$Elements") if row[1] == "4"]
    return np.array([[float(value) for value in row[1:]] for row in nodes]), np.array(elements)


def lattice(n):
    """Nodes of a cube of n x n x n, and the number of a node by its place."""
    nodes = np.array(list(itertools.product(range(n + 1), repeat=3)), float) / n
    return nodes, lambda place: (place[0] * (n + 1) + place[1]) * (n + 1) + place[2]


def cubes_of_six(n):
    """Every cube is cut along its diagonals into six equal tetrahedra."""
    nodes, number = lattice(n)
    elements = []
    for cube in itertools.product(range(n), repeat=3):
        for axes in itertools.permutations(range(3)):
            corners = [list(cube)]
            for axis in axes:
                corners.append([corners[-1][k] + (k == axis) for k in range(3)])
            elements.append([number(corner) for corner in corners])
    return nodes, np.array(elements)


def cubes_of_five(n):
    """Every cube is a regular tetrahedron and four corners round it; n is even."""
    nodes, number = lattice(n)
    blocks = ("000 110 101 011", "100 000 110 101", "010 000 110 011", "001 000 101 011", "111 110 101 011")
    elements = []
    for cube in itertools.product(range(n), repeat=3):
        mirrored = sum(cube) % 2
        for block in blocks:
            corners = [[int(c) for c in corner] for corner in block.split()]
            elements.append([number([cube[0] + (1 - c[0] if mirrored else c[0]), cube[1] + c[1], cube[2] + c[2]])
                             for c in corners])
    return nodes, np.array(elements)


class Cell:
    """The faces of a cell that repeats: two elements each, corners, normal, area, and H."""

    def __init__(self, nodes, elements):
        corners = nodes[elements]
        self.centre = corners.mean(axis=1)
        edges = corners[:, 1:] - corners[:, :1]
        self.volume = np.abs(np.linalg.det(edges)).sum() / 6
        sides = [(element, elements[element][list(face)]) for face in itertools.combinations(range(4), 3)
                 for element in range(len(elements))]
        pairs = {}
        for element, side in sides:
            middle = np.round(nodes[side].mean(axis=0) * 1e6).astype(int) % 1000000
            pairs.setdefault(tuple(middle), []).append((element, side))
        self.first = np.array([pair[0][0] for pair in pairs.values()])
        self.second = np.array([pair[1][0] for pair in pairs.values()])
        self.corners = nodes[np.array([pair[0][1] for pair in pairs.values()])]
        opposite = nodes[np.array([pair[1][1] for pair in pairs.values()])]
        shift = np.round(self.corners.mean(axis=1) - opposite.mean(axis=1))
        self.between = self.centre[self.second] + shift - self.centre[self.first]
        across = np.cross(self.corners[:, 1] - self.corners[:, 0], self.corners[:, 2] - self.corners[:, 0])
        self.area = np.linalg.norm(across, axis=1) / 2
        self.normal = across / (2 * self.area[:, None])
        self.normal *= np.sign((self.normal * self.between).sum(axis=1))[:, None]
        self.distance = (self.normal * self.between).sum(axis=1)
        self.second_centre = self.centre[self.second] + shift


def stiffness(cell, ratio):
    """The 6 x 6 stiffness of a cell for K_n = 1 and K_s = ratio."""
    faces, elements = len(cell.area), len(cell.centre)
    other = np.eye(3)[np.abs(cell.normal).argmin(axis=1)]
    tangent = np.cross(cell.normal, other)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    directions = ((cell.normal, 1.0), (tangent, ratio), (np.cross(cell.normal, tangent), ratio))
    size = np.cbrt(cell.volume / elements)  # turns times this are as large as displacements
    rows, columns, values = [], [], []
    strained = np.zeros((9 * faces, 6))
    for corner in range(3):
        arms = ((cell.first, cell.corners[:, corner] - cell.centre[cell.first], -1),
                (cell.second, cell.corners[:, corner] - cell.second_centre, 1))
        for n, (direction, modulus) in enumerate(directions):
            weight = np.sqrt(cell.area / 3 * modulus / cell.distance)
            row = np.arange(faces) * 9 + 3 * corner + n
            for element, arm, sign in arms:
                turn = np.cross(arm, direction) / size
                for axis in range(3):
                    rows += [row, row]
                    columns += [6 * element + axis, 6 * element + 3 + axis]
                    values += [sign * weight * direction[:, axis], sign * weight * turn[:, axis]]
            for strain, (i, j) in enumerate(STRAINS):
                strained[row, strain] = weight * (direction[:, i] * cell.between[:, j] + direction[:, j] * cell.between[:, i]) / 2
    openings = sparse.csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))),
                                 shape=(9 * faces, 6 * elements))
    moved = relaxed(openings, strained)
    return (strained.T @ strained + strained.T @ (openings @ moved)) / cell.volume


def relaxed(openings, strained):
    """Motions of the elements in equilibrium, by conjugate gradients with the inverse of every element's own stiffness."""
    matrix = sparse.bsr_matrix(openings.T @ openings, blocksize=(6, 6))
    rows = np.repeat(np.arange(len(matrix.indptr) - 1), np.diff(matrix.indptr))
    inverse = np.linalg.inv(matrix.data[rows == matrix.indices])

    def precondition(residual):
        return np.einsum("nij,njm->nim", inverse, residual.reshape(len(inverse), 6, -1)).reshape(residual.shape)

    residual = -(openings.T @ strained)
    small = 1e-7 * np.linalg.norm(abs(openings).T @ abs(strained), axis=0).max()
    moved = np.zeros_like(residual)
    direction = step = precondition(residual)
    product = (residual * step).sum(axis=0)
    for _ in range(5000):
        active = np.linalg.norm(residual, axis=0) > small
        if not active.any():
            return moved
        pull = matrix @ direction
        length = np.divide(product, (direction * pull).sum(axis=0), where=active, out=np.zeros_like(product))
        moved += length * direction
        residual -= length * pull
        step = precondition(residual)
        before, product = product, (residual * step).sum(axis=0)
        direction = step + np.divide(product, before, where=active, out=np.zeros_like(product)) * direction
    raise RuntimeError("no equilibrium was found")


def moduli(matrix):
    """E and nu of the isotropic part, and of all directions the smallest and largest E and nu."""
    bulk = matrix[:3, :3].sum() / 9
    shear = (np.trace(matrix[:3, :3]) * 1.5 - matrix[:3, :3].sum() / 2 + 3 * np.trace(matrix[3:, 3:])) / 15
    young, poisson = 9 * bulk * shear / (3 * bulk + shear), (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear)
    compliance = np.linalg.inv(matrix)
    axes = np.random.default_rng(1).normal(size=(2000, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    stress = np.array([axes[:, i] * axes[:, j] for i, j in STRAINS]).T
    strain = stress @ compliance
    along = (stress * strain).sum(axis=1)
    across = (strain[:, :3].sum(axis=1) - along) / 2
    return young, poisson, 1 / along.max(), 1 / along.min(), (-across / along).min(), (-across / along).max()


def ratio_of(poisson, b, c):
    """K_s/K_n as it is fitted."""
    return (1 - 2 * poisson) / (1 + b * poisson + c * poisson**2)


def modulus_of(poisson, a):
    """E/K_n as it is fitted."""
    return (1 - 2 * poisson) * (1 + a * (1 - 2 * poisson))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="coarse meshes, to see how it works")
    quick = parser.parse_args().quick
    size = 0.16 if quick else 0.09
    irregular = {f"Delaunay, {seed}": lambda seed=seed: irregular_cell(size * (1 + 0.04 * seed), DELAUNAY, seed) for seed in (1, 2)}
    irregular["HXT"] = lambda: irregular_cell(size, HXT)
    if not quick:
        irregular["Delaunay, sizes 1 to 8"] = lambda: irregular_cell(1, DELAUNAY, 1, GRADED)
    regular = {"cubes of five": lambda: cubes_of_five(4), "cubes of six": lambda: cubes_of_six(4)}
    found = []
    for name, make in {**irregular, **regular}.items():
        nodes, elements = make()
        cell = Cell(nodes, elements)
        print(f"{name}: {len(elements)} elements, H from {cell.distance.min():.3g} to {cell.distance.max():.3g}")
        print("  K_s/K_n   E/K_n     nu    E by direction      nu by direction")
        for ratio in RATIOS:
            young, poisson, low, high, least, most = moduli(stiffness(cell, ratio))
            found.append((name, ratio, young, poisson))
            print(f"  {ratio:7.3g}  {young:6.4f}  {poisson:6.4f}  {low / young:.3f} to {high / young:.3f}  {least:.3f} to {most:.3f}",
                  flush=True)
    fitted = np.array([row[1:] for row in found if row[0] in irregular])
    b, c = least_squares(lambda x: ratio_of(fitted[:, 2], *x) / fitted[:, 0] - 1, (3.0, 2.5)).x
    a = least_squares(lambda x: modulus_of(fitted[:, 2], *x) / fitted[:, 1] - 1, 0.05).x[0]
    print(f"a = {a:.4f}  b = {b:.3f}  c = {c:.3f}\nmeshes with springs by this fit, against E and nu that were asked for:")
    for name in dict.fromkeys(row[0] for row in found):
        rows = np.array([row[1:] for row in found if row[0] == name])
        asked = np.array([np.interp(-ratio, -ratio_of(np.linspace(0, 0.499, 5000), b, c), np.linspace(0, 0.499, 5000))
                          for ratio in rows[:, 0]])
        error = rows[:, 1] / modulus_of(asked, a) - 1
        print(f"  {name:24} E {100 * error.min():+5.2f} to {100 * error.max():+5.2f} %,"
              f" nu {(rows[:, 2] - asked).min():+.4f} to {(rows[:, 2] - asked).max():+.4f}")


if __name__ == "__main__":
    main()
