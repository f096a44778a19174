// A slope of 30 degrees, 4 m wide, between a bench above and level ground below.
Point(1) = {0, 0, 0};
Point(2) = {14, 0, 0};
Point(3) = {14, 2, 0};
Point(4) = {7, 2, 0};
Point(5) = {3, 4.3094010767585, 0};
Point(6) = {0, 4.3094010767585, 0};
For i In {1:6}
  Line(i) = {i, i % 6 + 1};
EndFor
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};

Physical Surface("ground") = {1};
Physical Curve("base") = {1};
Physical Curve("sides") = {2, 6};
Physical Curve("top") = {3, 4, 5};

Mesh.MeshSizeMax = 0.5;
Mesh.MeshSizeMin = 0.5;
Mesh.ElementOrder = 2;
