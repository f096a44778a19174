"""Writes the folder of a run that never was, in the layout of the program: a block of tetrahedra with a charge inside."""

import json
from itertools import permutations
from pathlib import Path

import h5py
import numpy as np

TRIANGLE, TETRAHEDRON = 5, 10

ENERGIES = {
    "energy_kinetic": 0.30,
    "energy_elastic": 0.12,
    "energy_joint_dashpot": 0.10,
    "energy_slip": 0.05,
    "energy_fracture": 0.15,
    "energy_release": 0.03,
    "energy_contact_dashpot": 0.08,
    "energy_friction": 0.07,
    "energy_boundary_dashpot": 0.10,
}

CASE = """[case]
title = "{title}"
method = "blocks"

[mesh]
file = "block.msh"
"""


def block_mesh(size, cells):
    """Points (n, 3) and tetrahedra (m, 4) of a block, six tetrahedra to a cell."""
    axes = [np.linspace(0.0, length, count + 1) for length, count in zip(size, cells)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)
    shape = np.array(cells) + 1
    corners = np.stack(np.meshgrid(*[np.arange(c) for c in cells], indexing="ij"), axis=-1).reshape(-1, 3)
    elements = []
    for order in permutations(range(3)):
        path = [np.zeros(3, int)]
        for axis in order:
            path.append(path[-1] + np.eye(3, dtype=int)[axis])
        tetrahedra = np.stack([np.ravel_multi_index((corners + step).T, shape) for step in path], axis=1)
        turned = np.linalg.det(np.diff(path, axis=0)) < 0.0
        elements.append(tetrahedra[:, [0, 2, 1, 3]] if turned else tetrahedra)
    return points, np.concatenate(elements)


def interior_faces(elements):
    """Faces shared by two elements: vertices (k, 3), the two elements (k, 2)."""
    corners = np.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])
    faces = np.sort(elements[:, corners].reshape(-1, 3), axis=1)
    owners = np.repeat(np.arange(len(elements)), 4)
    order = np.lexsort(faces.T)
    faces, owners = faces[order], owners[order]
    twin = np.all(faces[1:] == faces[:-1], axis=1)
    return faces[:-1][twin], np.stack([owners[:-1][twin], owners[1:][twin]], axis=1)


def write_grid(path, points, cells, cell_type, time, cell_data):
    """One VTKHDF file of an unstructured grid in which every cell has as many points."""
    count, corners = cells.shape
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = np.array([1, 0])
        root.attrs.create("Type", np.bytes_("UnstructuredGrid"))
        root["NumberOfPoints"] = np.array([len(points)])
        root["NumberOfCells"] = np.array([count])
        root["NumberOfConnectivityIds"] = np.array([cells.size])
        root["Points"] = points
        root["Connectivity"] = cells.ravel().astype(np.int64)
        root["Offsets"] = np.arange(0, cells.size + 1, corners, dtype=np.int64)
        root["Types"] = np.full(count, cell_type, dtype=np.uint8)
        for name, values in cell_data.items():
            root[f"CellData/{name}"] = values
        root["FieldData/time"] = np.array([time])


def write_table(path, columns):
    """A CSV file of named columns of equal length."""
    rows = zip(*columns.values())
    path.write_text("\n".join([",".join(columns), *(",".join(str(value) for value in row) for row in rows)]) + "\n")


class SyntheticRun:
    """A pressure front runs out from the charge; joints behind it break, and what is near flies toward +x."""

    def __init__(self, points, elements, charge, end=5e-4, snapshots=6):
        self.points, self.elements, self.end = points, elements, end
        self.times = np.linspace(0.0, end, snapshots)
        self.faces, self.owners = interior_faces(elements)
        self.centers = points[elements].mean(axis=1)
        self.reach = np.ptp(points, axis=0).max()
        offset = self.centers - np.asarray(charge)
        self.radius = np.linalg.norm(offset, axis=1)
        self.direction = offset / np.maximum(self.radius, 1e-9)[:, None]
        face_offset = points[self.faces].mean(axis=1) - np.asarray(charge)
        angle = np.arctan2(face_offset[:, 1], face_offset[:, 0])
        crushed = np.linalg.norm(face_offset, axis=1) < 0.12 * self.reach
        radial = np.cos(7.0 * angle) > 0.8
        self.break_time = np.where(crushed | radial, np.linalg.norm(face_offset, axis=1) / (0.7 * self.reach) * end, np.inf)

    def state(self, time):
        """0, 1 or 2 for every joint."""
        return (self.break_time < time * 1.15).astype(np.int32) + (self.break_time < time)

    def speed(self, time):
        """Speed of every element."""
        front = time / self.end * self.reach
        return np.where(self.radius < front, 8.0 * np.exp(-3.0 * self.radius / self.reach), 0.0) * (time > 0.0)

    def write_snapshot(self, folder, number, time):
        """Both files of one snapshot."""
        velocity = self.speed(time)[:, None] * self.direction
        displacement = velocity * time
        points = (self.points[self.elements] + displacement[:, None, :]).reshape(-1, 3)
        cells = np.arange(len(points)).reshape(-1, 4)
        broken = np.zeros(len(self.elements))
        np.add.at(broken, self.owners.ravel(), np.repeat(self.state(time) == 2, 2) / 4.0)
        speed = np.linalg.norm(velocity, axis=1)
        level = np.clip(6 - (self.radius / self.reach * 8.0).astype(np.int32), 0, 6)
        write_grid(
            folder / f"elements_{number:05d}.vtkhdf", points, cells, TETRAHEDRON, time,
            {
                "element": np.arange(len(cells)), "region": np.zeros(len(cells), np.int32),
                "displacement": displacement, "velocity": velocity, "speed": speed, "level": level,
                "step": 1e-6 / 2.0**level, "fragment": (broken > 0.5).astype(np.int32), "broken_fraction": broken,
                "material": np.zeros(len(cells), np.int32), **stress_of(1e6 * speed),
            },
        )
        count = len(self.faces)
        write_grid(
            folder / f"joints_{number:05d}.vtkhdf", self.points[self.faces].reshape(-1, 3),
            np.arange(3 * count).reshape(-1, 3), TRIANGLE, time,
            {
                "state": self.state(time), "opening": 1e-4 * (self.state(time) == 2), "slip": np.zeros(count),
                "mode": (self.state(time) == 2).astype(np.int32), "kind": np.zeros(count, np.int32),
            },
        )

    def write_snapshots(self, run):
        """All snapshots and their two lists."""
        folder = run / "snapshots"
        folder.mkdir(parents=True)
        for number, time in enumerate(self.times):
            self.write_snapshot(folder, number, time)
        for kind in ("elements", "joints"):
            files = [{"name": f"{kind}_{number:05d}.vtkhdf", "time": time} for number, time in enumerate(self.times)]
            (folder / f"{kind}.vtkhdf.series").write_text(json.dumps({"file-series-version": "1.0", "files": files}))

    def write_history(self, run):
        """history.csv, whose energies close but for a residual of 3e-5 of the work."""
        time = np.linspace(0.0, self.end, 101)
        work = 5.0e4 * (1.0 - np.exp(-time / (0.2 * self.end)))
        columns = {
            "time [s]": time,
            "broken_joints [-]": [int(np.sum(self.break_time < t)) for t in time],
            "fragments [-]": 1 + (40 * time / self.end).astype(int),
            "energy_work [J]": work,
        }
        columns |= {f"{name} [J]": share * work * (1.0 - 3e-5) for name, share in ENERGIES.items()}
        columns |= {
            "energy_residual [J]": 3e-5 * work,
            "smallest_step [s]": 1e-6 / 2.0 ** (1 + np.arange(101) % 4),
            "pair_evaluations [-]": np.arange(101) * 40000,
            "wall_seconds [s]": np.linspace(0.0, 3.1, 101),
        }
        write_table(run / "history.csv", columns)

    def write_gauges(self, run):
        """gauges.csv of two gauges."""
        time = np.linspace(0.0, self.end, 101)
        columns = {"time [s]": time}
        for name, peak in (("G1", 4.0), ("G2", 1.5)):
            pulse = peak * np.sin(8.0 * np.pi * time / self.end) * np.exp(-4.0 * time / self.end)
            columns |= {f"{name}.velocity_{axis} [m/s]": pulse * part for axis, part in zip("xyz", (0.8, 0.6, 0.0))}
        write_table(run / "gauges.csv", columns)

    def write_fragments(self, run, count=40):
        """fragments.csv, largest first."""
        volume = np.sort(np.random.default_rng(7).lognormal(-7.0, 1.3, count))[::-1]
        columns = {"fragment [-]": np.arange(count), "elements [-]": np.arange(count)[::-1] + 1, "volume [m3]": volume}
        columns |= {"mass [kg]": 2390.0 * volume, "size [m]": np.cbrt(6.0 * volume / np.pi)}
        for name in ("center_x [m]", "center_y [m]", "center_z [m]"):
            columns[name] = np.linspace(0.0, 1.0, count)
        for name in ("velocity_x [m/s]", "velocity_y [m/s]", "velocity_z [m/s]"):
            columns[name] = np.linspace(0.0, 9.0, count)
        columns["throw [m]"] = np.linspace(0.0, 2e-3, count)
        write_table(run / "fragments.csv", columns)

    def manifest(self, title):
        """manifest.json as the program writes it at the end."""
        broken = int(np.sum(self.break_time < self.end))
        results = {
            "broken_joints": broken, "joints": len(self.faces), "fragments": 41, "elements": len(self.elements),
            "pair_evaluations": 4000000, "wall_seconds": 3.1, "steps": 123456, "smallest_step": 6.25e-8,
            "energy_work": 49663.0, **{name: share * 49663.0 for name, share in ENERGIES.items()},
            "energy_residual": 1.49, "p20": 0.06, "p50": 0.12, "p80": 0.21, "detached_fragments": 39, "detached_volume": 0.0123, "largest_fragment_volume": 0.01, "throw_max": 2.16e-3,
            "peak_speed": 9.3, "ppv": {"G1": 3.1, "G2": 1.2},
        }
        return {
            "sazare": "0.1.0", "commit": "0123456789ab", "case": title, "method": "blocks", "status": "done",
            "started": "2025-01-02T03:04:05Z", "finished": "2025-01-02T03:04:08Z",
            "machine": {"cpu": "A processor", "cores": 2, "threads": 2, "ranks": 1},
            "state_hash": "0123456789abcdef", "results": results,
        }

    def write(self, run, title="A synthetic blast"):
        """The whole folder."""
        run = Path(run)
        self.write_snapshots(run)
        self.write_history(run)
        self.write_gauges(run)
        self.write_fragments(run)
        parts = {"joints": 1.9, "contacts": 0.4, "bodies": 0.5, "neighbors": 0.2, "output": 0.1}
        write_table(
            run / "timing.csv",
            {"part": list(parts), "seconds [s]": list(parts.values()), "share [-]": [s / 3.1 for s in parts.values()]},
        )
        (run / "case.toml").write_text(CASE.format(title=title))
        (run / "manifest.json").write_text(json.dumps(self.manifest(title), indent=2))
        return run


def stress_of(radial):
    """Stress of elements that are pressed along x by these pressures [Pa] (n,), and pulled along y by half of them."""
    normal = np.stack([-radial, 0.5 * radial, np.zeros_like(radial)], axis=1)
    return {
        "normal_stress": normal, "shear_stress": np.zeros_like(normal), "von_mises_stress": np.sqrt(1.75) * radial,
        "largest_principal_stress": normal.max(axis=1), "smallest_principal_stress": normal.min(axis=1),
    }


def slab_run(run, **settings):
    """A thin slab, one cell deep along z."""
    return SyntheticRun(*block_mesh((1.2, 1.0, 0.15), (12, 10, 1)), charge=(0.9, 0.5, 0.075), **settings).write(run)


def solid_run(run, **settings):
    """A body as deep as it is wide."""
    return SyntheticRun(*block_mesh((3.0, 2.5, 2.0), (9, 8, 7)), charge=(2.0, 1.2, 1.0), **settings).write(run)
