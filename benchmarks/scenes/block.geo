// A cube of side `side` [m] with elements of size `size` [m]: the same stone at any number of elements.
SetFactory("Built-in");

DefineConstant[
  side = {0.29, Min 0.1, Max 20, Name "Side [m]"}
  size = {0.05, Min 0.001, Max 1, Name "Element size [m]"}
];

Point(1) = {0, 0, 0, size};
Point(2) = {side, 0, 0, size};
Point(3) = {side, side, 0, size};
Point(4) = {0, side, 0, size};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
out[] = Extrude {0, 0, side} { Surface{1}; };

Physical Surface("loaded", 1) = {1};
Physical Volume("stone", 2) = {out[1]};
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
