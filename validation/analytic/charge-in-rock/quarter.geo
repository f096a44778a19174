// A quarter of a cylinder of rock along z around a hole of 40 mm: 0.4 m in radius and 0.5 m long.
SetFactory("OpenCASCADE");

radius = 0.4;
bore = 0.02;
length = 0.5;
e = 1e-4;

Cylinder(1) = {0, 0, 0, 0, 0, length, radius, Pi / 2};
Cylinder(2) = {0, 0, 0, 0, 0, length, bore, Pi / 2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };

hole() = Surface In BoundingBox{-e, -e, -e, bore + e, bore + e, length + e};
left() = Surface In BoundingBox{-e, -e, -e, e, radius + e, length + e};
below() = Surface In BoundingBox{-e, -e, -e, radius + e, e, length + e};
ends() = Surface In BoundingBox{-e, -e, -e, radius + e, radius + e, e};
ends() += Surface In BoundingBox{-e, -e, length - e, radius + e, radius + e, length + e};
mantle() = Surface In BoundingBox{-e, -e, -e, radius + e, radius + e, length + e};
mantle() -= {hole(), left(), below(), ends()};

Physical Volume("rock") = Volume{:};
Physical Surface("hole") = hole();
Physical Surface("left") = left();
Physical Surface("below") = below();
Physical Surface("ends") = ends();
Physical Surface("mantle") = mantle();

Field[1] = MathEval;
Field[1].F = Sprintf("0.008 + 0.027 * (Sqrt(x*x + y*y) - %g) / (%g - %g)", bore, radius, bore);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
