// A slope of 1 to 2 on firm ground, with its toe at the origin. The nodes of triangles with six are half their size apart.
DefineConstant[ height = 10.0, run = 20.0, behind = 12.0, distance = 0.5 ];
size = 2 * distance;

Point(1) = {0, 0, 0, size};
Point(2) = {run + behind, 0, 0, size};
Point(3) = {run + behind, height, 0, size};
Point(4) = {run, height, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Physical Surface("ground") = {1};
Physical Curve("bottom") = {1};
Physical Curve("back") = {2};

Mesh.ElementOrder = 2;
Mesh.SecondOrderLinear = 1;
