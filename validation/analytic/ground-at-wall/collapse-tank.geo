// A floor 0.3 m thick and 6 m long, and at its right end a wall 2 m high.
Point(1) = {-2, -0.3, 0}; Point(2) = {3.3, -0.3, 0}; Point(3) = {3.3, 2, 0}; Point(4) = {3, 2, 0}; Point(5) = {3, 0, 0}; Point(6) = {-2, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
Mesh.MeshSizeMin = 0.15;
Mesh.MeshSizeMax = 0.15;
Physical Surface("tank") = {1};
Physical Curve("bottom") = {1};
Physical Curve("inside") = {4, 5};
