// A cylinder of rock along z, 144 mm across and 150 mm long, with a hole of 12 mm through its axis.
SetFactory("OpenCASCADE");

DefineConstant[
  size = {0.009, Min 0.004, Max 0.02, Name "Element size away from the hole [m]"}
  at_hole = {0.0037, Min 0.001, Max 0.01, Name "Element size at the wall of the hole [m]"}
];

radius = 0.072;
bore = 0.006;
length = 0.150;
e = 1e-4;

Cylinder(1) = {0, 0, 0, 0, 0, length, radius};
Cylinder(2) = {0, 0, 0, 0, 0, length, bore};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

hole() = Surface In BoundingBox{-bore - e, -bore - e, -e, bore + e, bore + e, length + e};
below() = Surface In BoundingBox{-radius - e, -radius - e, -e, radius + e, radius + e, e};
above() = Surface In BoundingBox{-radius - e, -radius - e, length - e, radius + e, radius + e, length + e};
mantle() = Surface In BoundingBox{-radius - e, -radius - e, -e, radius + e, radius + e, length + e};
mantle() -= {hole(), below(), above()};

Physical Volume("rock") = Volume{:};
Physical Surface("hole") = hole();
Physical Surface("mantle") = mantle();

Field[1] = MathEval;
Field[1].F = Sprintf("%g + (%g - %g) * Min(1, (Sqrt(x*x + y*y) - %g) / 0.03)", at_hole, size, at_hole, bore);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
