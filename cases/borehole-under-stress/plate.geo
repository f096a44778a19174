// A plate of rock with a borehole in its middle: 0.8 x 0.8 x 0.04 m, the hole 60 mm across and along z.
SetFactory("OpenCASCADE");

DefineConstant[
  size = {0.02, Min 0.005, Max 0.05, Name "Element size [m]"}
];

half = 0.4;
radius = 0.03;
depth = 0.04;
e = 1e-4;

Rectangle(1) = {-half, -half, 0, 2 * half, 2 * half};
Disk(2) = {0, 0, 0, radius};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Extrude {0, 0, depth} { Surface{3}; }

hole() = Surface In BoundingBox{-radius - e, -radius - e, -e, radius + e, radius + e, depth + e};
below() = Surface In BoundingBox{-half - e, -half - e, -e, half + e, half + e, e};
above() = Surface In BoundingBox{-half - e, -half - e, depth - e, half + e, half + e, depth + e};
rim() = Surface In BoundingBox{-half - e, -half - e, -e, half + e, half + e, depth + e};
rim() -= {hole(), below(), above()};

Physical Volume("rock") = Volume{:};
Physical Surface("hole") = hole();
Physical Surface("plane") = {below(), above()};
Physical Surface("rim") = rim();

// Finer at the hole.
Field[1] = MathEval;
Field[1].F = Sprintf("%g * (0.5 + 0.5 * Min(1, (Sqrt(x*x + y*y) - %g) / 0.1))", size, radius);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
