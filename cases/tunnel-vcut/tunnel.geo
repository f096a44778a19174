// Rock behind a tunnel face (z = 0, the tunnel is at z < 0), 6 m wide (x), 5 m high (y), 4 m deep (z), with a V-cut: three pairs
// of inclined holes that form a wedge. Each hole has an open collar and a charged part, whose wall is the surface hole_1 ... hole_6
// (odd at x < 0, even at x > 0; pairs from the middle one: 1-2 at y = 0, 3-4 below, 5-6 above).
// A horizontal slot above the cut is meshed in any case: slit = 1 leaves it open, slit = 0 fills it with rock, so that both have
// the same elements elsewhere.
SetFactory("OpenCASCADE");

DefineConstant[
  slit = {1, Choices{0, 1}, Name "Open slot above the cut"}
  fine = {0.1, Min 0.02, Max 0.5, Name "Element size at the charges [m]"}
  coarse = {0.4, Min 0.05, Max 1, Name "Element size far away [m]"}
  growth = {0.3, Min 0, Max 1, Name "Growth of the size per distance from the charges"}
];

width = 6;
height = 5;
depth = 4;
hole_radius = 0.025;
collar_x = 0.9;      // holes begin here at the face ...
toe_x = 0.15;        // ... and end here
toe_z = 1.5;
collar_length = 0.5; // not charged
pair_y[] = {0, -0.6, 0.6};
slot_y = 1.2;
slot_width = 0.1;
slot_length = 3;
slot_depth = 1.6;

Box(1) = {-width / 2, -height / 2, 0, width, height, depth};

// Hexagonal prisms from the toe outward: first the charged part, then the collar to beyond the face.
axis_length = Sqrt((collar_x - toe_x)^2 + toe_z^2);
charge_length = axis_length - collar_length;
ux = (collar_x - toe_x) / axis_length;  // from the toe to the collar, for the side x > 0
uz = -toe_z / axis_length;
tools[] = {};
For pair In {0:2}
  For side In {0:1}
    sign = 2 * side - 1;
    first = newp;
    For i In {0:5}
      c = hole_radius * Cos(Pi / 6 + i * Pi / 3);  // in the plane of the axis and x
      s = hole_radius * Sin(Pi / 6 + i * Pi / 3);  // along y
      Point(first + i) = {sign * (toe_x - c * uz), pair_y[pair] + s, toe_z + c * ux};
    EndFor
    edge = newl;
    For i In {0:5}
      Line(edge + i) = {first + i, first + (i + 1) % 6};
    EndFor
    loop = newll;
    Curve Loop(loop) = {edge, edge + 1, edge + 2, edge + 3, edge + 4, edge + 5};
    toe = news;
    Plane Surface(toe) = {loop};
    charge[] = Extrude {sign * ux * charge_length, 0, uz * charge_length} { Surface{toe}; };
    collar[] = Extrude {sign * ux * (collar_length + 0.2), 0, uz * (collar_length + 0.2)} { Surface{charge[0]}; };
    tools[] += {charge[1], collar[1]};
  EndFor
EndFor
slot = newv;
Box(slot) = {-slot_length / 2, slot_y - slot_width / 2, 0, slot_length, slot_width, slot_depth};

pierced[] = BooleanDifference{ Volume{1}; Delete; }{ Volume{tools[]}; Delete; };
parts[] = BooleanFragments{ Volume{pierced[]}; Delete; }{ Volume{slot}; Delete; };

// Groups are found by where they lie.
e = 1e-4;
slot_volume[] = Volume In BoundingBox {
  -slot_length / 2 - e, slot_y - slot_width / 2 - e, -e, slot_length / 2 + e, slot_y + slot_width / 2 + e, slot_depth + e};
rock_volume[] = Volume{:};
rock_volume[] -= slot_volume[];
If (slit)
  Physical Volume("rock") = {rock_volume[]};
Else
  Physical Volume("rock") = {rock_volume[], slot_volume[]};
EndIf

hole_curves[] = {};
For pair In {0:2}
  For side In {0:1}
    sign = 2 * side - 1;
    inner_x = sign * toe_x;
    outer_x = sign * (toe_x + ux * charge_length);
    wall[] = Surface In BoundingBox {
      (inner_x < outer_x ? inner_x : outer_x) - hole_radius - e, pair_y[pair] - hole_radius - e,
      toe_z + uz * charge_length - hole_radius - e,
      (inner_x > outer_x ? inner_x : outer_x) + hole_radius + e, pair_y[pair] + hole_radius + e, toe_z + hole_radius + e};
    number = 2 * pair + side + 1;
    Physical Surface(Sprintf("hole_%g", number)) = {wall[]};
    hole_curves[] += Boundary{ Surface{wall[]}; };
  EndFor
EndFor

x = width / 2;
y = height / 2;
left[] = Surface In BoundingBox {-x - e, -y - e, -e, -x + e, y + e, depth + e};
right[] = Surface In BoundingBox {x - e, -y - e, -e, x + e, y + e, depth + e};
bottom[] = Surface In BoundingBox {-x - e, -y - e, -e, x + e, -y + e, depth + e};
top[] = Surface In BoundingBox {-x - e, y - e, -e, x + e, y + e, depth + e};
back[] = Surface In BoundingBox {-x - e, -y - e, depth - e, x + e, y + e, depth + e};
face[] = Surface In BoundingBox {-x - e, -y - e, -e, x + e, y + e, e};
Physical Surface("left") = {left[]};
Physical Surface("right") = {right[]};
Physical Surface("bottom") = {bottom[]};
Physical Surface("top") = {top[]};
Physical Surface("back") = {back[]};
If (slit)
  slot_mouth[] = Surface In BoundingBox {
    -slot_length / 2 - e, slot_y - slot_width / 2 - e, -e, slot_length / 2 + e, slot_y + slot_width / 2 + e, e};
  face[] -= slot_mouth[];
EndIf
Physical Surface("face") = {face[]};

// Small at the charges, growing with the distance.
Field[1] = Distance;
Field[1].CurvesList = {hole_curves[]};
Field[1].NumPointsPerCurve = 60;
Field[2] = MathEval;
Field[2].F = Sprintf("%g + %g * F1", fine, growth);
Field[3] = MathEval;
Field[3].F = Sprintf("%g", coarse);
Field[4] = Min;
Field[4].FieldsList = {2, 3};
Background Field = 4;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
