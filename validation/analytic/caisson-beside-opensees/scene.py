"""What both programs are given: the motion of the table, the mesh, and the columns that are compared."""

import subprocess
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
POINTS = {"crest": (11.0, 16.0), "heel": (12.0, 7.0), "below": (11.0, 4.0), "away": (5.0, 4.0)}  # m
PRESSURES = ("heel", "below", "away")
COLUMNS = ["time [s]", "crest.x on the table [m]", "crest.y [m]", *(f"{name}.pressure [Pa]" for name in PRESSURES)]
SAND, TIGHT = 5e-4, 1e-9  # hydraulic conductivity [m/s]: water flows, or does not in the time of a run
RUNS = {  # OpenSees' element; order; squares on 1 m; hydraulic conductivity
    "9_4_QuadUP": ("9_4_QuadUP", 2, 1, SAND),
    "quadUP": ("quadUP", 1, 1, SAND),
    "quadUP-fine": ("quadUP", 1, 2, SAND),
    "SSPquadUP": ("SSPquadUP", 1, 1, SAND),
    "SSPquadUP-fine": ("SSPquadUP", 1, 2, SAND),
    "9_4_QuadUP-tight": ("9_4_QuadUP", 2, 1, TIGHT),
    "quadUP-tight": ("quadUP", 1, 1, TIGHT),
    "SSPquadUP-tight": ("SSPquadUP", 1, 1, TIGHT),
}


def shake(step=0.02, end=14.0):
    """Ten periods of 1 Hz that swell to 1.5 m/s2 and die away; time [s] and acceleration [m/s2]."""
    time = np.arange(round(end / step) + 1) * step
    return time, 1.5 * np.sin(np.pi * np.clip(time / 10.0, 0.0, 1.0)) ** 2 * np.sin(2.0 * np.pi * time)


def write_shake(path):
    rows = zip(*(values.tolist() for values in shake()))
    path.write_text("time [s],acceleration [m/s2]\n" + "".join(f"{t!r},{a!r}\n" for t, a in rows))


def mesh(order, cells):
    """Points (n, 2), elements (m, 4 or 9) and the names of their regions."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "box.msh"
        subprocess.run(["gmsh", "-2", "-format", "msh2", "-setnumber", "order", str(order), "-setnumber", "cells", str(cells), "-o", out,
                        HERE / "box.geo"], check=True, stdout=subprocess.DEVNULL)
        lines = out.read_text().splitlines()

    def part(name):
        begin = lines.index(f"${name}") + 2
        return lines[begin : lines.index(f"$End{name}")]

    names = {tag: name.strip('"') for dimension, tag, name in (line.split(maxsplit=2) for line in part("PhysicalNames")) if dimension == "2"}
    points = np.array([line.split()[1:3] for line in part("Nodes")], float)
    kind = {1: "3", 2: "10"}[order]  # Gmsh's quadrilaterals of 4 and 9 nodes
    elements = [line.split() for line in part("Elements")]
    elements = [words for words in elements if words[1] == kind]
    return points, np.array([words[5:] for words in elements], int) - 1, [names[words[3]] for words in elements]
