"""The box in OpenSees: writes opensees-RUN.csv beside this file, which main.py compares with.

    pip install openseespy          # on Linux with libblas3 and liblapack3
    python validation/analytic/caisson-beside-opensees/opensees.py

The caisson is of the same elements as the sand, its pressures held at 0: so they are elements of an ordinary solid. Where it stands on the sand
both have nodes of their own, which move together, so that the sole is impervious.
"""

import sys
import tomllib

import numpy as np
import openseespy.opensees as ops
from scene import COLUMNS, HERE, POINTS, PRESSURES, RUNS, mesh, shake

WATER_WEIGHT = 1000.0 * 9.81  # N/m3
SERIES = 10  # of the table: displacement, velocity and acceleration


class Table:
    """Motion of the table: its acceleration is straight between the samples."""

    def __init__(self):
        self.time, self.acceleration = shake()
        step, a = np.diff(self.time), self.acceleration
        self.velocity = np.concatenate([[0.0], np.cumsum(step * (a[:-1] + a[1:]) / 2)])
        self.place = np.concatenate([[0.0], np.cumsum(step * self.velocity[:-1] + step**2 * (2 * a[:-1] + a[1:]) / 6)])

    def at(self, time):
        """Displacement, velocity and acceleration at times (n,)."""
        i = np.clip(np.searchsorted(self.time, time + 1e-9, side="right") - 1, 0, len(self.time) - 2)
        past, slope = time - self.time[i], np.diff(self.acceleration)[i] / np.diff(self.time)[i]
        a = self.acceleration[i]
        return (self.place[i] + past * self.velocity[i] + past**2 / 2 * a + past**3 / 6 * slope, self.velocity[i] + past * a + past**2 / 2 * slope,
                a + past * slope)


class Box:
    """Sand and caisson of caisson.toml."""

    def __init__(self, case, element, order, cells):
        self.case, self.element = case, element
        self.points, self.elements, self.regions = mesh(order, cells)
        self.corners = set(self.elements[:, :4].ravel().tolist())
        self.own = {}  # numbers that the caisson has for corners on the sand
        ops.wipe()
        self._nodes()
        self._elements(1.0 / cells)
        self._supports()

    def _nodes(self):
        """Corners have a pressure besides; the caisson has its own corners."""
        for of_corners, freedoms in ((True, 3), (False, 2)):
            ops.model("basic", "-ndm", 2, "-ndf", freedoms)
            for node, place in enumerate(self.points.tolist()):
                if (node in self.corners) == of_corners:
                    ops.node(node + 1, *place)
        ops.model("basic", "-ndm", 2, "-ndf", 3)
        of = {name: {node for corners, region in zip(self.elements[:, :4].tolist(), self.regions) if region == name for node in corners}
              for name in ("sand", "caisson")}
        for node in sorted(of["caisson"] & of["sand"]):
            self.own[node] = len(self.points) + len(self.own) + 1
            ops.node(self.own[node], *self.points[node].tolist())
            ops.equalDOF(node + 1, self.own[node], 1, 2)
        for node in of["caisson"]:
            ops.fix(self.own.get(node, node + 1), 0, 0, 1)

    def _elements(self, size):
        damping = self.case["damping"]
        f1, f2 = damping["f1"], damping["f2"]
        for kind, material in enumerate(self.case["materials"], 1):
            density = material.get("saturated_density", material["density"])
            ops.nDMaterial("ElasticIsotropic", kind, material["youngs_modulus"], material["poisson_ratio"], density)
            mine = []
            for number, (nodes, region) in enumerate(zip(self.elements.tolist(), self.regions), 1):
                if region in material["regions"]:
                    own = self.own if material["name"] == "caisson" else {}
                    self._element(number, [own.get(node, node + 1) for node in nodes], kind, material, size)
                    mine.append(number)
            ratio = material["damping_ratio"]
            ops.region(kind, "-ele", *mine, "-rayleigh", 4 * np.pi * f1 * f2 / (f1 + f2) * ratio, 0.0, ratio / (np.pi * (f1 + f2)), 0.0)

    def _element(self, number, nodes, kind, material, size):
        """An element; the caisson's has some water, since each must, at pressures that are held at 0."""
        porosity = material.get("porosity", 0.4)
        mobility = material.get("hydraulic_conductivity", 1e-4) / WATER_WEIGHT
        bulk = 2.2e9
        if self.element == "SSPquadUP":
            shear = material["youngs_modulus"] / (2 * (1 + material["poisson_ratio"]))
            stabilized = size**2 / (24 * shear)  # m2/Pa: on the gradient of the pressure it is what Sazare's term is
            ops.element("SSPquadUP", number, *nodes, kind, 1.0, bulk, 1000.0, mobility, mobility, porosity / (1 - porosity), stabilized, 0.0, 0.0)
        else:
            ops.element(self.element, number, *nodes, 1.0, kind, bulk / porosity, 1000.0, mobility, mobility)

    def _supports(self):
        """Box, table and the drained bed."""
        x, y = self.points.T
        sand = np.isin(np.arange(len(x)), [n for nodes, region in zip(self.elements, self.regions) if region == "sand" for n in nodes])
        floor, sides = np.isclose(y, 0.0), sand & (np.isclose(x, 0.0) | np.isclose(x, 30.0))
        step = self.case["time"]["step"]
        for part, values in enumerate(Table().at(np.arange(round(self.case["time"]["end"] / step) + 2) * step)):
            ops.timeSeries("Path", SERIES + part, "-dt", step, "-values", *values.tolist())
        ops.pattern("MultipleSupport", 1)
        ops.groundMotion(1, "Plain", "-disp", SERIES, "-vel", SERIES + 1, "-accel", SERIES + 2)
        bed = np.isclose(y, 8.0) & ((x < 11.0 + 1e-9) | (x > 19.0 - 1e-9))
        for node in range(len(x)):
            held = (0, int(floor[node])) + ((int(bed[node]),) if node in self.corners else ())
            if any(held):
                ops.fix(node + 1, *held)
        for node in np.flatnonzero(floor | sides).tolist():
            ops.imposedMotion(node + 1, 1, 1)

    def node(self, name):
        return int(np.argmin(np.hypot(*(self.points - POINTS[name]).T))) + 1

    def run(self, end=None):
        """Rows of COLUMNS, one for each row of a history."""
        time = self.case["time"]
        step, every = time["step"], round(time["history_interval"] / time["step"])
        ops.constraints("Transformation")
        ops.numberer("RCM")
        ops.system("UmfPack")  # BandGeneral loses three digits more to rounding
        ops.algorithm("Linear", "-factorOnce")  # all is linear
        ops.integrator("Newmark", 0.5, 0.25)
        ops.analysis("Transient")
        rows, crest, table = [], self.node("crest"), Table()
        for number in range(round((end or time["end"]) / step) + 1):
            if number > 0 and ops.analyze(1, step) != 0:
                raise RuntimeError(f"OpenSees' step at {ops.getTime():g} s fails")
            if number % every == 0:
                moved = ops.nodeDisp(crest, 1) - float(table.at(number * step)[0])
                rows.append([number * step, moved, ops.nodeDisp(crest, 2), *(ops.nodeVel(self.node(name), 3) for name in PRESSURES)])
        return np.array(rows)


def run(name, end=None):
    """What OpenSees finds in one of RUNS, to its end or to another time."""
    element, order, cells, conductivity = RUNS[name]
    case = tomllib.loads((HERE / "caisson.toml").read_text())
    case["materials"][0]["hydraulic_conductivity"] = conductivity
    return Box(case, element, order, cells).run(end)


def main():
    for name in sys.argv[1:] or RUNS:
        rows = run(name)
        text = "\n".join(",".join(f"{value:.10g}" for value in row) for row in rows.tolist())
        (HERE / f"opensees-{name}.csv").write_text(f"{','.join(COLUMNS)}\n{text}\n")
        print(f"{name}: the crest moves by up to {np.abs(rows[:, 1]).max():.4g} m, pressures up to {np.abs(rows[:, 3:]).max():.4g} Pa")


if __name__ == "__main__":
    main()
