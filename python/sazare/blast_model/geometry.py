"""The geometry of a blast for Gmsh: rock with prisms for holes, groups by name, elements that grow with the distance from the holes."""

import math

import numpy as np

from sazare.blast_model.layout import GROWTH, polygon_radius

HEAD = """// Made by sazare blast-model from {pattern}. Lengths in m.
// x points {ahead}, z out of the rock where the holes begin, and the origin is the collar of hole {first}.
SetFactory("OpenCASCADE");

DefineConstant[
  far = {{{far!r}, Name "Element size far from the holes [m]"}}
  growth = {{{growth!r}, Name "Growth of the size per distance from a hole"}}
];
e = {near!r};  // what lies within a box grown by this much is what the box is of
"""
FIELDS = """
// Elements are as small at a hole as a side of its polygon.
Field[{last}] = MathEval;
Field[{last}].F = Sprintf("%g", far);
Field[{least}] = Min;
Field[{least}].FieldsList = {{{fields}}};
Background Field = {least};
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Mesh.OptimizeThreshold = 0.4;
"""


def geometry(layout, discs=()):
    """The text of a .geo file of a layout, with joints (`joints.Disc`) in it."""
    near = min(layout.near(hole) for hole in layout.holes)
    head = HEAD.format(
        pattern=layout.pattern.path.name, ahead="to the free face" if layout.bench else "along the surface", first=layout.holes[0].name, far=float(layout.far),
        growth=GROWTH, near=float(1e-3 * near),
    )
    parts = [*_rock(layout), *(line for hole in layout.holes for line in _bore(hole, layout.options.around))]
    parts += ["", "rock() = BooleanDifference{ Volume{1}; Delete; }{ Volume{bores()}; Delete; };"]
    parts += [*_joints(discs), *_groups(layout, discs), *_fields(layout)]
    return head + "\n".join(parts)


def _rock(layout):
    """The rock as volume 1: its section, drawn along y."""
    y0, y1 = layout.lower[1], layout.upper[1]
    corners = layout.profile
    count = len(corners)
    return [
        *(f"Point({i + 1}) = {_list((x, y0, z))};" for i, (x, z) in enumerate(corners)),
        *(f"Line({i + 1}) = {{{i + 1}, {(i + 1) % count + 1}}};" for i in range(count)),
        f"Curve Loop(1) = {{1:{count}}};", "Plane Surface(1) = {1};", f"Extrude {_list((0.0, y1 - y0, 0.0))} {{ Surface{{1}}; }}", "bores[] = {};",
    ]


def _bore(hole, around):
    """A prism from the toe of a hole to beyond the surface; its section has the area of the circle."""
    ring, way = prism(hole, around)
    lines = ["", f"// {hole.surface}", "p = newp;"]
    lines += [f"Point(p + {i}) = {_list(corner)};" for i, corner in enumerate(ring)]
    lines += ["l = newl;", *(f"Line(l + {i}) = {{p + {i}, p + {(i + 1) % around}}};" for i in range(around))]
    lines += [
        "c = newll;", f"Curve Loop(c) = {{l:l + {around - 1}}};", "s = news;", "Plane Surface(s) = {c};",
        f"bore[] = Extrude {_list(way)} {{ Surface{{s}}; }};", "bores[] += {bore[1]};",
    ]
    return lines


def prism(hole, around):
    """Corners of the section at the toe (around, 3), and the vector to beyond the surface z = 0 along the hole [m]."""
    back = -hole.direction
    radius = polygon_radius(hole.diameter, around)
    first = np.cross(back, [0.0, 1.0, 0.0] if abs(back[1]) < 0.9 else [1.0, 0.0, 0.0])
    first /= np.linalg.norm(first)
    second = np.cross(back, first)
    angles = 2.0 * np.pi * (np.arange(around) + 0.5) / around
    ring = hole.toe + radius * (np.cos(angles)[:, None] * first + np.sin(angles)[:, None] * second)
    beyond = radius * math.sqrt(1.0 - back[2] ** 2) / back[2] + hole.diameter
    return ring, back * (-hole.toe[2] / back[2] + beyond)


def _joints(discs):
    """Discs, cut to the rock, become surfaces inside it."""
    if not discs:
        return []
    lines = ["", "// Joints: polygons of the area of their discs, what of them lies in the rock.", "discs[] = {};"]
    for disc in discs:
        corners = disc.polygon()
        lines += ["p = newp;", *(f"Point(p + {i}) = {_list(corner)};" for i, corner in enumerate(corners))]
        lines += ["l = newl;", *(f"Line(l + {i}) = {{p + {i}, p + {(i + 1) % len(corners)}}};" for i in range(len(corners)))]
        lines += ["c = newll;", f"Curve Loop(c) = {{l:l + {len(corners) - 1}}};", "s = news;", "Plane Surface(s) = {c};", "discs[] += {s};"]
    return [
        *lines, "inside() = BooleanIntersection{ Surface{discs()}; Delete; }{ Volume{rock()}; };",
        "BooleanFragments{ Volume{rock()}; Delete; }{ Surface{inside()}; Delete; }",
    ]


def _groups(layout, discs):
    """Groups by where their surfaces lie: what lies in a box and is of no group yet."""
    lines = ["", 'Physical Volume("rock") = Volume{:};']
    if discs:
        lines += ["rest() = Abs(CombinedBoundary{ Volume{:}; });", "joints() = Surface{:};", "joints() -= rest();", *_joint_groups(discs)]
    else:
        lines += ["rest() = Surface{:};"]
    for name, low, high in [*_hole_boxes(layout), *_face_boxes(layout)]:
        corners = ", ".join(f"{float(value)!r} {sign} e" for side, sign in ((low, "-"), (high, "+")) for value in side)
        lines += [f"box() = Surface In BoundingBox{{{corners}}};", "others() = rest();", "others() -= box();", "rest() -= others();"]
        lines += [f'Physical Surface("{name}") = rest();', f"{name}() = rest();", "rest() = others();"]
    return [*lines, 'Physical Surface("sides") = rest();']


def _joint_groups(discs):
    """A group for each set of joints: a piece is of the disc in whose plane its centre lies, and whose box holds it."""
    surfaces = list(dict.fromkeys(disc.surface for disc in discs))
    if len(surfaces) == 1:
        return [f'Physical Surface("{surfaces[0]}") = joints();']
    planes = [(*disc.normal, disc.normal @ disc.centre) for disc in discs]
    boxes = [(*disc.polygon().min(axis=0), *disc.polygon().max(axis=0)) for disc in discs]
    lines = ["", "// Which set a piece is of: that of the disc in whose plane its centre lies, and in whose box."]
    lines += [f"plane_{name}() = {_list(column)};" for name, column in zip("xyzd", np.transpose(planes))]
    lines += [f"box_{i}() = {_list(column)};" for i, column in enumerate(np.transpose(boxes))]
    lines += [f"set_of() = {{{', '.join(str(surfaces.index(disc.surface)) for disc in discs)}}};", *(f"set_{i}() = {{}};" for i in range(len(surfaces)))]
    inside = " && ".join([f"b({i}) > box_{i}(d) - e" for i in range(3)] + [f"b({i}) < box_{i}(d) + e" for i in range(3, 6)])
    return [
        *lines, "For i In {0 : #joints() - 1}", "  c() = CenterOfMass Surface{joints(i)};", "  b() = BoundingBox Surface{joints(i)};", "  least = e;", "  found = -1;",
        f"  For d In {{0 : {len(discs) - 1}}}", "    off = Fabs(plane_x(d) * c(0) + plane_y(d) * c(1) + plane_z(d) * c(2) - plane_d(d));",
        f"    If (off < least && {inside})", "      least = off;", "      found = set_of(d);", "    EndIf", "  EndFor",
        *(line for i in range(len(surfaces)) for line in (f"  If (found == {i})", f"    set_{i}() += joints(i);", "  EndIf")), "EndFor",
        *(f'Physical Surface("{name}") = set_{i}();' for i, name in enumerate(surfaces)), "",
    ]


def _hole_boxes(layout):
    """Names of walls and the boxes in which they lie, the smaller ones before the larger ones that may hold them."""
    boxes = []
    for hole in layout.holes:
        ring, way = prism(hole, layout.options.around)
        corners = np.concatenate([ring, ring + way])
        boxes.append((hole.surface, corners.min(axis=0), corners.max(axis=0)))
    return sorted(boxes, key=lambda box: np.prod(box[2] - box[1]))


def _face_boxes(layout):
    """The same of the outer faces that are no sides."""
    (x0, y0, z0), (x1, y1, z1) = layout.lower, layout.upper
    boxes = [("top", (x0, y0, z1), (x1, y1, z1)), ("base", (x0, y0, z0), (x1, y1, z0))]
    if layout.bench:
        crest, toe, floor = layout.bench.crest, layout.bench.toe, -layout.bench.height
        boxes += [("floor", (x0, y0, floor), (x1, y1, floor)), ("free_face", (crest, y0, floor), (toe, y1, z1))]
    return boxes


def _fields(layout):
    """Sizes of elements, by the distance from the walls of the holes."""
    lines, fields = [], []
    for number, hole in enumerate(layout.holes):
        near, field = layout.near(hole), 2 * number + 1
        lines += [
            "", f"Field[{field}] = Distance;", f"Field[{field}].CurvesList = {{Boundary{{ Surface{{{hole.surface}()}}; }}}};",
            f"Field[{field}].NumPointsPerCurve = {max(2, math.ceil(hole.length / near))};",
            f"Field[{field + 1}] = MathEval;", f'Field[{field + 1}].F = Sprintf("%g + %g * F{field}", {float(near)!r}, growth);',
        ]
        fields.append(field + 1)
    last = 2 * len(layout.holes) + 1
    return [*lines, FIELDS.format(last=last, least=last + 1, fields=", ".join(map(str, [*fields, last])))]


def _list(values):
    return "{" + ", ".join(repr(float(value)) for value in values) + "}"
