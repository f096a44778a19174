"""OpenSees drives the caisson of the sea wall: OpenSeesPy has caisson, bed and backfill, Sazare the armour.

    pip install openseespy          # on Linux with libblas3 and liblapack3
    python examples/caisson_of_opensees.py

The case is that of `elastic_caisson.py` with a lumped mass, as OpenSees' element `quad` has it. It is run with Sazare's own finite elements too, and
the two are compared: shaken without armour, and with it. With armour they agree to rounding until tetrapods tumble over one another, which makes any
rounding large.

OpenSeesPy is free for research, education and internal use; to pass it on commercially takes a licence of its makers. So Sazare does not bring it.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import openseespy.opensees as ops
from elastic_caisson import Record, command, compare, front_of, mesh_of, rayleigh, simple_case

TABLE, ARMOUR = 1, 2  # load patterns
SERIES = 10  # of the table: displacement, velocity and acceleration


class Caisson:
    """Bed, caisson and backfill of a case of method fem in plane strain: quadrilaterals of four nodes, Newmark's step."""

    def __init__(self, case, points, quads, regions, record):
        self.step, self.front = case["time"]["step"], front_of(points)
        ops.wipe()
        ops.model("basic", "-ndm", 2, "-ndf", 2)
        for number, place in enumerate(points.tolist(), 1):
            ops.node(number, *place)
        self._elements(case, quads, regions)
        self.mass = self._masses(case, points, quads, regions)[self.front]
        self._supports(points, record, round(case["time"]["end"] / self.step) + 2)
        self._settle()
        self.settled = self._of_surface(ops.nodeDisp)
        self.nodes = points[self.front] + self.settled
        self.force = np.zeros_like(self.nodes)

    def _elements(self, case, quads, regions):
        """The elements with their weight, and the damping of each material."""
        gravity = case["gravity"]["acceleration"][1]
        for number, of in enumerate(case["materials"], 1):
            ops.nDMaterial("ElasticIsotropic", number, of["youngs_modulus"], of["poisson_ratio"], of["density"])
        for number, (corners, region) in enumerate(zip(quads.tolist(), regions), 1):
            kind = next(kind for kind, of in enumerate(case["materials"], 1) if region in of["regions"])
            weight = gravity * case["materials"][kind - 1]["density"]
            ops.element("quad", number, *(corner + 1 for corner in corners), 1.0, "PlaneStrain", kind, 0.0, 0.0, 0.0, weight)
        for kind, of in enumerate(case["materials"], 1):
            mass, stiffness = rayleigh(case, of["damping_ratio"])
            own = [number for number, region in enumerate(regions, 1) if region in of["regions"]]
            ops.region(kind, "-ele", *own, "-rayleigh", mass, 0.0, stiffness, 0.0)

    def _masses(self, case, points, quads, regions):
        """Lumped masses of the nodes (n,) [kg/m]: a quarter of each rectangle around them, as in OpenSees."""
        density = {region: of["density"] for of in case["materials"] for region in of["regions"]}
        masses = np.zeros(len(points))
        for corners, region in zip(quads, regions):
            masses[corners] += density[region] * np.prod(np.ptp(points[corners], axis=0)) / 4
        return masses

    def _supports(self, points, record, steps):
        """Table and end wall, which move along x as the record says; the table is held along y."""
        x, y = points.T
        table, wall = np.isclose(y, y.min()), np.isclose(x, x.max())
        for part, values in enumerate(zip(*(record.at(number * self.step) for number in range(steps)))):
            ops.timeSeries("Path", SERIES + part, "-dt", self.step, "-values", *map(float, values))
        ops.pattern("MultipleSupport", TABLE)
        ops.groundMotion(1, "Plain", "-disp", SERIES, "-vel", SERIES + 1, "-accel", SERIES + 2)
        for number in np.flatnonzero(table | wall):
            ops.imposedMotion(int(number) + 1, 1, 1)
        for number in np.flatnonzero(table):
            ops.fix(int(number) + 1, 0, 1)

    def _analysis(self, kind, integrator, *numbers):
        ops.wipeAnalysis()
        ops.constraints("Transformation")
        ops.numberer("RCM")
        ops.system("BandGeneral")
        ops.algorithm("Linear")
        ops.integrator(integrator, *numbers)
        ops.analysis(kind)

    def _settle(self):
        """Equilibrium under the weight."""
        self._analysis("Static", "LoadControl", 0.0)
        if ops.analyze(1) != 0:
            raise RuntimeError("OpenSees finds no equilibrium under the weight")
        ops.timeSeries("Constant", SERIES + 3)

    def _of_surface(self, response):
        """Rows of the surface's nodes."""
        return np.array([response(int(number) + 1) for number in self.front])

    def moved(self):
        """Displacement since the beginning [m] and velocity [m/s] of the surface (n, 2)."""
        return self._of_surface(ops.nodeDisp) - self.settled, self._of_surface(ops.nodeVel)

    def advance(self, force):
        """A step with forces on the surface's nodes (n, 2) [N/m] that act all through it: where they change, so does the acceleration at its beginning."""
        accelerations = self._of_surface(ops.nodeAccel) + (force - self.force) / self.mass[:, None]
        ops.remove("loadPattern", ARMOUR)
        ops.pattern("Plain", ARMOUR, SERIES + 3)
        for number, acceleration, load in zip(self.front.tolist(), accelerations.tolist(), force.tolist()):
            ops.load(number + 1, *load)
            for axis in (0, 1):
                ops.setNodeAccel(number + 1, axis + 1, acceleration[axis], "-commit")
        self._analysis("Transient", "Newmark", 0.5, 0.25)  # anew: an integrator keeps accelerations of its own, and would not see these
        if ops.analyze(1, self.step) != 0:
            raise RuntimeError(f"OpenSees' step at {ops.getTime():g} s fails")
        self.force = force.copy()


def alone(end=2.0, step=1e-3):
    """Shakes the caisson without armour, with Sazare's elements and with OpenSees'; returns of both the level displacement of its crest from where the
    table is [m], one for each row of the history."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        case = simple_case(folder, end, step, "lumped")
        subprocess.run([command(), "run", folder / "caisson.toml", "--out", folder / "ours", "--quiet"], check=True)
        header, *rows = (line.split(",") for line in (folder / "ours/gauges.csv").read_text().splitlines())
        ours = dict(zip(header, np.array(rows, float).T))
        record = Record(folder / "shake.csv")
        caisson, theirs = Caisson(case, *mesh_of(folder), record), [0.0]
        for number in range(1, round(end / step) + 1):
            caisson.advance(np.zeros_like(caisson.nodes))
            theirs.append(caisson.moved()[0][0, 0] - record.at(number * step)[0])
    own = ours["crest.displacement_x [m]"] - ours["table.displacement_x [m]"]
    theirs = np.array(theirs)[:: round((len(theirs) - 1) / (len(own) - 1))]
    print(f"the crest moves by up to {np.abs(own).max():.6g} m on the table with Sazare's elements; those of OpenSees differ by up to {np.abs(own - theirs).max():.2g} m")
    return own, theirs


def main(end=2.0, step=1e-3, out=None):
    """Compares both as `elastic_caisson.compare` does."""
    return compare(Caisson, "OpenSees", end, step, out, mass="lumped")


if __name__ == "__main__":
    sys.exit(alone() is None or main() is None)
