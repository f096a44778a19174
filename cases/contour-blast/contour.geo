// A slice across the side wall of a tunnel, normal to its axis z, with three contour holes at x = 0: the rock behind the wall, and the
// burden in front of it up to the core, which has been taken away. The sides lie between two holes; y points up.
SetFactory("OpenCASCADE");

DefineConstant[
  size = {0.16, Min 0.04, Max 0.3, Name "Element size far from the holes [m]"}
  at_hole = {0.0188, Min 0.006, Max 0.03, Name "Element size at the holes [m]"}
  growth = {0.3, Min 0.1, Max 1, Name "Growth of the element size per distance from a hole"}
];

burden = 0.6;      // [m]
spacing = 0.5;     // [m]
bore = 0.024;      // radius of a hole [m]
behind = 2.0;      // rock behind the wall [m]
thickness = 0.24;  // of the slice [m]
e = 1e-4;

high = 1.5 * spacing;
Box(1) = {-behind, -high, 0, behind + burden, 2 * high, thickness};
For i In {1:3}
  Cylinder(1 + i) = {0, (i - 2) * spacing, 0, 0, 0, thickness, bore};
EndFor
BooleanDifference(20) = { Volume{1}; Delete; }{ Volume{2:4}; Delete; };

For i In {1:3}
  y = (i - 2) * spacing;
  Physical Surface(Sprintf("hole_%g", i)) = Surface In BoundingBox{-bore - e, y - bore - e, -e, bore + e, y + bore + e, thickness + e};
EndFor
Physical Volume("rock") = {20};
Physical Surface("core") = Surface In BoundingBox{burden - e, -high - e, -e, burden + e, high + e, thickness + e};
Physical Surface("far") = Surface In BoundingBox{-behind - e, -high - e, -e, -behind + e, high + e, thickness + e};
Physical Surface("sides") = {Surface In BoundingBox{-behind - e, -high - e, -e, burden + e, -high + e, thickness + e},
                             Surface In BoundingBox{-behind - e, high - e, -e, burden + e, high + e, thickness + e}};
Physical Surface("cuts") = {Surface In BoundingBox{-behind - e, -high - e, -e, burden + e, high + e, e},
                            Surface In BoundingBox{-behind - e, -high - e, thickness - e, burden + e, high + e, thickness + e}};

For i In {1:3}
  Field[i] = MathEval;
  Field[i].F = Sprintf("Min(%g, %g + %g * Max(0, Sqrt(x^2 + (y - (%g))^2) - %g))", size, at_hole, growth, (i - 2) * spacing, bore);
EndFor
Field[4] = Min;
Field[4].FieldsList = {1, 2, 3};
Background Field = 4;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
