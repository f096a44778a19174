"""Small cases of every method and format, each a dict of its files: name to bytes."""

import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

MOVING_PARTICLES = """[case]
title = "fuzz"
method = "mps"
[particles]
spacing = 1.0
periodic = ["x"]
[[regions]]
name = "s"
lower = [0.0, 0.0, 0.0]
upper = [4.0, 4.0, 0.0]
[[materials]]
name = "m"
regions = ["s"]
density = 2000.0
s_wave_velocity = 300.0
poisson_ratio = 0.3
[[motions]]
name = "x"
type = "record"
file = "{record}"
[[boundaries]]
side = "bottom"
kind = "prescribed"
motion_x = "x"
[[gauges]]
name = "b"
point = [0.5, 0.5, 0.0]
[time]
end = 0.05
history_interval = 0.01
"""

RECTANGLES = """[case]
title = "fuzz"
method = "rectangles"
[[blocks]]
name = "b"
material = "m"
{block}
[[materials]]
name = "m"
density = 2500.0
youngs_modulus = 1e8
poisson_ratio = 0.2
damping_ratio = 0.2
[contact]
face_normal_stiffness = 1e8
face_shear_stiffness = 4e7
damping_ratio = 0.5
friction_angle = 20.0
[[walls]]
name = "w"
from = [-2.0, 0.0, 0.0]
to = [2.0, 0.0, 0.0]
[gravity]
acceleration = [0.0, -9.81, 0.0]
[time]
end = 0.02
history_interval = 0.001
"""

SPHERES = """[case]
title = "fuzz"
method = "spheres"
[[materials]]
name = "m"
density = 2000.0
youngs_modulus = 1e7
poisson_ratio = 0.2
[contact]
restitution = 0.5
friction_coefficient = 0.5
[[shapes]]
name = "body"
source = "file"
file = "body.txt"
[[shapes]]
name = "cube"
source = "mesh"
file = "box.stl"
scale = 0.1
count = 9
[[spheres]]
name = "balls"
material = "m"
source = "file"
file = "balls.txt"
[[spheres]]
name = "bodies"
material = "m"
source = "file"
file = "places.csv"
shape = "body"
[[spheres]]
name = "cube"
material = "m"
source = "one"
centre = [0.5, 0.5, 0.8]
shape = "cube"
[[walls]]
name = "w"
material = "m"
shape = "mesh"
file = "floor.msh"
group = "7"
[gravity]
acceleration = [0.0, 0.0, -9.81]
[time]
end = 0.01
history_interval = 0.005
snapshot_interval = 0.01
"""

ELEMENTS = """[case]
title = "fuzz"
method = "fem"
[mesh]
file = "{mesh}"
dimension = 2
[[materials]]
name = "a"
regions = ["body"]
density = 2000.0
youngs_modulus = 1e8
poisson_ratio = 0.3
[[boundaries]]
group = "base"
kind = "fixed"
[gravity]
acceleration = [0.0, -9.81, 0.0]
[time]
end = 0.05
step = 0.01
history_interval = 0.01
"""

# Two triangles of a square: a floor in the surface group 7, which has no name, and a body with its base.
MESH = """$MeshFormat
4.1 0 8
$EndMeshFormat
{names}$Entities
0 1 1 0
1 0 0 0 1 0 0 1 1 0
1 0 0 0 1 1 0 1 7 0
$EndEntities
$Nodes
1 4 1 4
2 1 0 4
1
2
3
4
0 0 0
1 0 0
1 1 0
0 1 0
$EndNodes
$Elements
2 3 1 3
1 1 1 1
1 1 2
2 1 2 2
2 1 2 3
3 1 3 4
$EndElements
"""

NAMES = '$PhysicalNames\n2\n1 1 "base"\n2 7 "body"\n$EndPhysicalNames\n'

GEOMETRY = """SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
Physical Surface("body") = {1};
Physical Curve("base") = {1};
Mesh.MeshSizeMax = 0.5;
"""


def _box():
    """The surface of a unit box as text STL."""
    facets = []
    for axis in range(3):
        for side in (0, 1):
            def corner(u, v, axis=axis, side=side):
                at = [0, 0, 0]
                at[axis], at[(axis + 1) % 3], at[(axis + 2) % 3] = side, u, v
                return "vertex " + " ".join(map(str, at))

            for turn in (((0, 0), (1, 0), (1, 1)), ((0, 0), (1, 1), (0, 1))):
                corners = [corner(*at) for at in (turn if side else turn[::-1])]
                facets.append("facet normal 0 0 0\nouter loop\n" + "\n".join(corners) + "\nendloop\nendfacet\n")
    return "solid b\n" + "".join(facets) + "endsolid b\n"


def _record(values):
    return "\n".join(f"{0.01 * i:.2f},{value}" for i, value in enumerate(values))


COUNTS = [0, 30, 56, 78, 93, 100, 97, 86]
PEER = "PEER\nEVENT\nACCELERATION TIME HISTORY IN UNITS OF G\nNPTS= 8, DT= .0100 SEC\n" + " ".join(f"{0.001 * value:.7E}" for value in COUNTS)
KNET = (
    "Origin Time       2011/03/11 14:46:00\nSampling Freq(Hz) 100Hz\nDuration Time(s)  0.08\nDir.              E-W\n"
    "Scale Factor      3920(gal)/6182761\nMax. Acc. (gal)   0.063\nMemo.\n" + " ".join(map(str, COUNTS)) + "\n"
)
IMAGE = 'shape = "image"\nfile = "i.pgm"\nelement_size = 0.1\nlower = [0.0, 0.0, 0.0]'
PACKING = 'elements = "polygons"\nnuclei = "n.csv"\nlower = [0.0, 0.0, 0.0]\nupper = [1.0, 1.0, 0.0]'
BLOCK = ROOT / "tests/regression/block"


def _bytes(files):
    return {name: value.encode() if isinstance(value, str) else value for name, value in files.items()}


CORPUS = {
    name: _bytes(files)
    for name, files in {
        "record-csv": {"case.toml": MOVING_PARTICLES.format(record="r.csv"), "r.csv": "time [s],acceleration [gal]\n" + _record(COUNTS) + "\n"},
        "record-peer": {"case.toml": MOVING_PARTICLES.format(record="r.AT2"), "r.AT2": PEER},
        "record-knet": {"case.toml": MOVING_PARTICLES.format(record="r.EW"), "r.EW": KNET},
        "image-text": {"case.toml": RECTANGLES.format(block=IMAGE), "i.pgm": "P2\n# image\n4 3\n255\n0 255 255 255\n0 0 255 255\n0 0 0 255\n"},
        "image-binary": {"case.toml": RECTANGLES.format(block=IMAGE), "i.pgm": b"P5\n4 3\n255\n\0\xff\xff\xff\0\0\xff\xff\0\0\0\xff"},
        "nuclei": {"case.toml": RECTANGLES.format(block=PACKING), "n.csv": "x [m],y [m]\n0.2,0.3\n0.7,0.2\n0.5,0.8\n"},
        "spheres": {
            "case.toml": SPHERES, "body.txt": "# body\n0.03 0 0 0\n0.03 0.05 0 0\n0.03 0 0.05 0\n", "box.stl": _box(), "floor.msh": MESH.format(names=""),
            "balls.txt": "radius x y z\n0.03 0.1 0.1 0.2\n0.03 0.2 0.1 0.2\n", "places.csv": "x,y,z,rx,ry,rz\n0.3,0.3,0.6,0,0,0\n0.7,0.7,0.6,0.1,0.2,0.3\n",
        },
        "elements": {"case.toml": ELEMENTS.format(mesh="m.msh"), "m.msh": MESH.format(names=NAMES)},
        "geometry": {"case.toml": ELEMENTS.format(mesh="g.geo"), "g.geo": GEOMETRY},
        "blocks": {
            "case.toml": BLOCK.joinpath("case.toml").read_text().replace("peak_pressure = 5e7", 'table = "p.csv"').replace("rise_time", "#").replace("decay_ratio", "#"),
            "block.msh": BLOCK.joinpath("block.msh").read_bytes(), "p.csv": "time [s],pressure [Pa]\n0,0\n2e-5,5e7\n1e-4,0\n",
        },
    }.items()
}


def checkpoint_of():
    """A run of particles that was stopped at its beginning, to be resumed."""
    files = CORPUS["record-csv"]
    with tempfile.TemporaryDirectory(prefix="sazare-fuzz-") as place:
        for name, data in files.items():
            Path(place, name).write_bytes(data)
        run = Path(place, "run")
        code = "import sazare; s = sazare.build('case.toml', 'run'); s.advance(0.01); s.stop()"
        python = ROOT / "build/venv/bin/python"
        subprocess.run([python, "-c", code], cwd=place, check=True, env={"PYTHONPATH": str(ROOT / "python")})
        found = {f"run/{path.relative_to(run)}": path.read_bytes() for path in run.rglob("*") if path.is_file()}
        return {"checkpoint": {**files, **found}}
