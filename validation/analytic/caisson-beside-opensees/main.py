"""A caisson on saturated sand in a shaken box, with Sazare's elements and with those of OpenSees."""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scene import HERE, PRESSURES, RUNS, write_shake

import sazare

PROGRAM = HERE.parents[2] / "build/release/apps/sazare/sazare"


def ours(folder, order, cells, conductivity):
    """Rows as OpenSees' have them."""
    for file in ("box.geo", "caisson.toml"):
        (folder / file).write_text((HERE / file).read_text())
    write_shake(folder / "shake.csv")
    out = folder / f"run-{order}-{cells}-{conductivity}"
    if not out.exists():
        settings = [f"mesh.parameters={{order = {order}, cells = {cells}}}", f"materials.0.hydraulic_conductivity={conductivity}"]
        command = [PROGRAM, "run", folder / "caisson.toml", "--out", out, "--quiet", *(word for each in settings for word in ("--set", each))]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(done.stderr)
    table = sazare.open(out).gauge_table
    columns = ["time", "crest.displacement_x", "crest.displacement_y", *(f"{name}.excess_pore_pressure" for name in PRESSURES)]
    rows = np.array([table[name] for name in columns]).T
    rows[:, 1] -= table["table.displacement_x"]
    return rows


def theirs(name):
    return np.loadtxt(HERE / f"opensees-{name}.csv", delimiter=",", skiprows=1)


def apart(one, other):
    """Largest differences over the largest value: of the displacements of the crest, of the pressures."""
    return np.array([np.abs(one - other)[:, columns].max() / np.abs(other)[:, columns].max() for columns in (slice(1, 3), slice(3, None))])


def main():
    with tempfile.TemporaryDirectory() as folder:
        found = {name: ours(Path(folder), *given) for name, (_, *given) in RUNS.items()}
    other = {name: theirs(name) for name in RUNS}
    differ = {name: apart(found[name], other[name]) for name in RUNS}
    whats = ("displacement", "pressure")
    for name in ("9_4_QuadUP", "9_4_QuadUP-tight"):
        for what, value in zip(whats, differ[name]):
            print(f"{what}-{name},{value}")
    mesh = apart(found["quadUP"], found["9_4_QuadUP"])
    for what, value, bound in zip(whats, differ["quadUP"], mesh):
        print(f"{what}-quadUP,{value},{bound}")
    for name in ("quadUP", "SSPquadUP"):
        for what, order in zip(whats, np.log2(differ[name] / differ[f"{name}-fine"])):
            print(f"{what}-order-{name},{order}")
    tight = apart(found["quadUP-tight"], other["9_4_QuadUP-tight"])[1]
    print(f"pressure-tight,{tight},{mesh[1]}")


if __name__ == "__main__":
    main()
