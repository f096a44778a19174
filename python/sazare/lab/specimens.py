"""Specimens: geometries for Gmsh, with the names of the surfaces on which they are loaded.

All lengths in m. The first lines of each geometry declare `seed`, of which another value makes another mesh of elements of the same size.
"""

from dataclasses import dataclass

import numpy as np

STEEL = ("lower_platen", "upper_platen")
HEAD = """SetFactory("Built-in");
DefineConstant[
  size = {%r, Name "Element size [m]"},
  seed = {%d, Name "Seed of the mesh"}
];
Mesh.RandomSeed = seed;
"""
TAIL = """
Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
"""


@dataclass(frozen=True)
class Specimen:
    """A body to be tested."""

    words: str  # what it is, for people
    geometry: str  # for Gmsh
    size: float  # of its elements [m]
    length: float  # between the platens, or of the plane that is sheared [m]
    area: float  # by which a force is divided for the stress that the test measures [m2]
    width: float  # over which the elements are counted [m]
    axis: int = 2  # along which the platens move
    top: tuple[str, ...] = ("top",)  # surfaces that the moving platen holds
    bottom: tuple[str, ...] = ("bottom",)  # surfaces that the platen at rest holds


def millimetres(*lengths):
    """Lengths [m] for people, such as `50 x 100 mm`."""
    return " x ".join(f"{1e3 * length:.4g}" for length in lengths) + " mm"


def _circle(first, radius, size, centre=1, height=0.0):
    """Four arcs about point `centre` with points and lines from number `first` on; the loop has that number as well.

    A mesh has a polygon in place of the circle: its corners lie so far outside that both have the same area. Elements there are as long as the polygon's
    sides, and a little more, so that Gmsh does not add a side. Sections between the ends of a cylinder have more corners, and are up to 1 % larger with
    8 elements over the diameter.
    """
    sides = 4 * max(2, round(0.5 * np.pi * radius / size))
    radius = float(radius * np.sqrt(2.0 * np.pi / (sides * np.sin(2.0 * np.pi / sides))))
    length = 1.001 * 2.0 * np.pi * radius / sides
    corners = [(radius, 0), (0, radius), (-radius, 0), (0, -radius)]
    points = [f"Point({first + 1 + i}) = {{{x!r}, {y!r}, {height!r}, {length!r}}};" for i, (x, y) in enumerate(corners)]
    arcs = [f"Circle({first + i}) = {{{first + 1 + i}, {centre}, {first + 1 + (i + 1) % 4}}};" for i in range(4)]
    return [*points, *arcs, f"Curve Loop({first}) = {{{first}:{first + 3}}};"]


def cylinder(diameter, height, size, seed=1, platen=0.0):
    """An upright cylinder; with steel platens of thickness `platen` above and below where that is not 0."""
    body = [
        "Point(1) = {0, 0, 0, size};", *_circle(10, 0.5 * diameter, size), "Plane Surface(1) = {10};",
        f"rock[] = Extrude {{0, 0, {height!r}}} {{ Surface{{1}}; }};", 'Physical Volume("rock", 1) = {rock[1]};',
    ]
    if platen:
        body += [
            f"lower[] = Extrude {{0, 0, {-platen!r}}} {{ Surface{{1}}; }};", f"upper[] = Extrude {{0, 0, {platen!r}}} {{ Surface{{rock[0]}}; }};",
            f'Physical Volume("{STEEL[0]}", 2) = {{lower[1]}};', f'Physical Volume("{STEEL[1]}", 3) = {{upper[1]}};',
            'Physical Surface("bottom", 4) = {lower[0]};', 'Physical Surface("top", 5) = {upper[0]};',
            'Physical Surface("side", 6) = {rock[{2:5}], lower[{2:5}], upper[{2:5}]};',
        ]
    else:
        body += ['Physical Surface("bottom", 4) = {1};', 'Physical Surface("top", 5) = {rock[0]};', 'Physical Surface("side", 6) = {rock[{2:5}]};']
    words = f"cylinder of {millimetres(diameter, height)}"
    return Specimen(words, _text(body, size, seed), size, height, 0.25 * np.pi * diameter**2, diameter)


def disc(diameter, thickness, size, seed=1, contact_angle=10.0):
    """A disc with a horizontal axis, loaded along y on two opposite arcs of `contact_angle` [deg]. The area is that of the Brazilian test, pi D t/2."""
    half = np.radians(0.5 * contact_angle)
    angles = [0.0, 0.5 * np.pi - half, 0.5 * np.pi + half, np.pi, 1.5 * np.pi - half, 1.5 * np.pi + half]
    radius = 0.5 * diameter
    body = ["Point(1) = {0, 0, 0, size};"]
    body += [f"Point({10 + i}) = {{{float(radius * np.cos(a))!r}, {float(radius * np.sin(a))!r}, 0, size}};" for i, a in enumerate(angles)]
    body += [f"Circle({10 + i}) = {{{10 + i}, 1, {10 + (i + 1) % 6}}};" for i in range(6)]
    body += [
        "Curve Loop(1) = {10:15};", "Plane Surface(1) = {1};", f"rock[] = Extrude {{0, 0, {thickness!r}}} {{ Surface{{1}}; }};",
        'Physical Volume("rock", 1) = {rock[1]};', 'Physical Surface("top", 2) = {rock[3]};', 'Physical Surface("bottom", 3) = {rock[6]};',
    ]
    words = f"disc of {millimetres(diameter, thickness)}, loaded over {contact_angle:g} degrees"
    return Specimen(words, _text(body, size, seed), size, diameter, 0.5 * np.pi * diameter * thickness, diameter, axis=1)


def core(diameter, height, size, seed=1, tip_radius=0.0025):
    """A core that two points press along its axis, each over a circle of `tip_radius`. The area is the square of the equivalent diameter, 4 D H/pi."""
    tip, radius = min(size, tip_radius), 0.5 * diameter
    body = ["Point(1) = {0, 0, 0, size};", f"Point(2) = {{0, 0, {height!r}, size}};"]
    body += [*_circle(10, tip_radius, tip), *_circle(20, radius, size), *_circle(30, tip_radius, tip, 2, height), *_circle(40, radius, size, 2, height)]
    body += [f"Line({50 + i}) = {{{21 + i}, {41 + i}}};" for i in range(4)]
    for i in range(4):
        body += [f"Curve Loop({60 + i}) = {{{20 + i}, {50 + (i + 1) % 4}, {-40 - i}, {-50 - i}}};", f"Surface({60 + i}) = {{{60 + i}}};"]
    body += [
        "Plane Surface(1) = {10};", "Plane Surface(2) = {20, 10};", "Plane Surface(3) = {30};", "Plane Surface(4) = {40, 30};",
        "Surface Loop(1) = {1:4, 60:63};", "Volume(1) = {1};",
        'Physical Volume("rock", 1) = {1};', 'Physical Surface("bottom", 2) = {1};', 'Physical Surface("top", 3) = {3};',
    ]
    words = f"core of {millimetres(diameter, height)}, pressed over circles of {millimetres(2 * tip_radius)}"
    return Specimen(words, _text(body, size, seed), size, height, 4.0 * diameter * height / np.pi, min(diameter, height))


def shear_box(length, height, size, seed=1):
    """A square prism whose upper half is pushed along x over the lower one. What pushes it and what holds the lower half are walls on the quarter of
    the height next to the plane that is sheared, so that it hardly tips."""
    corners = [(0, 0), (length, 0), (length, length), (0, length)]
    body = [f"Point({10 + i}) = {{{x!r}, {y!r}, 0, size}};" for i, (x, y) in enumerate(corners)]
    body += [f"Line({10 + i}) = {{{10 + i}, {10 + (i + 1) % 4}}};" for i in range(4)]
    body += ["Curve Loop(1) = {10:13};", "Plane Surface(1) = {1};", "below[] = {1};"]
    for layer in ("foot", "lower", "upper", "head"):
        body += [f"{layer}[] = Extrude {{0, 0, {0.25 * height!r}}} {{ Surface{{below[0]}}; }};", f"below[] = {{{layer}[0]}};"]
    body += [
        'Physical Volume("rock", 1) = {foot[1], lower[1], upper[1], head[1]};', 'Physical Surface("bottom", 2) = {1};',
        'Physical Surface("top", 3) = {head[0]};', 'Physical Surface("lower_right", 4) = {lower[3]};', 'Physical Surface("upper_left", 5) = {upper[5]};',
    ]
    return Specimen(
        f"prism of {millimetres(length, length, height)}, sheared at half its height", _text(body, size, seed), size, length, length**2,
        min(length, height), axis=0, top=("upper_left",), bottom=("bottom", "lower_right"),
    )


def _text(body, size, seed):
    return HEAD % (float(size), seed) + "\n".join(body) + TAIL
