// A box whose elements grow from the size `fine` at x = 0 to 'ratio' times that at its other end.
SetFactory("OpenCASCADE");

DefineConstant[
  length = {1, Min 0.1, Max 10, Name "Length along x [m]"}
  width = {1, Min 0.1, Max 10, Name "Width along y and z [m]"}
  fine = {0.04, Min 0.005, Max 1, Name "Element size at x = 0 [m]"}
  ratio = {8, Min 1, Max 20, Name "Size at the other end over that at x = 0"}
];

Box(1) = {0, -width / 2, -width / 2, length, width, width};
Physical Volume("body", 1) = {1};
Physical Surface("sides", 2) = {3, 4, 5, 6};
Physical Surface("ends", 3) = {1, 2};

Field[1] = MathEval;
Field[1].F = Sprintf("%g * %g^(x / %g)", fine, ratio, length);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeMax = 10;
