// A quarter of a thick plate with a hole, in the plane x, y: radius 1 m in a plate of radius 12 m.
SetFactory("OpenCASCADE");
size = 0.12;  // m, of the elements at the hole
Disk(1) = {0, 0, 0, 12};
Disk(2) = {0, 0, 0, 1};
Rectangle(3) = {0, 0, 0, 13, 13};
BooleanDifference(4) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
BooleanIntersection(5) = { Surface{4}; Delete; }{ Surface{3}; Delete; };
Extrude {0, 0, 0.25} { Surface{5}; }
e = 1e-3;
hole() = Surface In BoundingBox{-e, -e, -e, 1 + e, 1 + e, 0.25 + e};
left() = Surface In BoundingBox{-e, -e, -e, e, 12 + e, 0.25 + e};
below() = Surface In BoundingBox{-e, -e, -e, 12 + e, e, 0.25 + e};
front() = Surface In BoundingBox{-e, -e, -e, 12 + e, 12 + e, e};
back() = Surface In BoundingBox{-e, -e, 0.25 - e, 12 + e, 12 + e, 0.25 + e};
all() = Surface In BoundingBox{-e, -e, -e, 12 + e, 12 + e, 0.25 + e};
rim() = all();
rim() -= {hole(), left(), below(), front(), back()};
Physical Volume("rock") = Volume{:};
Physical Surface("left") = left();
Physical Surface("below") = below();
Physical Surface("sides") = {front(), back()};
Physical Surface("rim") = rim();
Field[1] = MathEval;
Field[1].F = Sprintf("%g * Sqrt(x*x + y*y) ^ 1.2", size);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeMax = 2.5;
