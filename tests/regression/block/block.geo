// A block with a charge on its lower face, of a few dozen tetrahedra.
SetFactory("Built-in");
length = 0.4; width = 0.3; height = 0.3;
Mesh.MeshSizeMin = 0.14; Mesh.MeshSizeMax = 0.14;
Point(1) = {0, 0, 0};      Point(2) = {length, 0, 0};
Point(3) = {length, width, 0}; Point(4) = {0, width, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
block[] = Extrude {0, 0, height} { Surface{1}; };
Physical Volume("rock") = {block[1]};
Physical Surface("hole") = {1};
Physical Surface("far") = {block[0]};
