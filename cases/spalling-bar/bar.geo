// A square bar along x [m], struck at x = 0 and free at its other end. Elements are `coarse` where it is struck and become `fine`
// towards the free end, where it spalls.
SetFactory("Built-in");

DefineConstant[
  length = {1.2, Min 0.2, Max 10, Name "Length [m]"}
  width = {0.08, Min 0.01, Max 1, Name "Width and height [m]"}
  fine = {0.016, Min 0.002, Max 0.5, Name "Element size at the free end [m]"}
  coarse = {0.04, Min 0.002, Max 0.5, Name "Element size at the struck end [m]"}
];

Point(1) = {0, -width / 2, -width / 2};
Point(2) = {0, width / 2, -width / 2};
Point(3) = {0, width / 2, width / 2};
Point(4) = {0, -width / 2, width / 2};
For i In {1:4}
  Line(i) = {i, 1 + i % 4};
EndFor
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
out[] = Extrude {length, 0, 0} { Surface{1}; };

Physical Surface("struck", 1) = {1};
Physical Surface("free", 2) = {out[0]};
Physical Surface("sides", 3) = {out[2], out[3], out[4], out[5]};
Physical Volume("bar", 4) = {out[1]};

Field[1] = MathEval;
Field[1].F = Sprintf("%g + (%g) * (x / %g)", coarse, fine - coarse, length);
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
