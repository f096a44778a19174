// A beam of 9-node quadrilaterals.
DefineConstant[ length = 10.0, height = 1.0, along = 20, across = 2 ];

Point(1) = {0, 0, 0};
Point(2) = {length, 0, 0};
Point(3) = {length, height, 0};
Point(4) = {0, height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 3} = along + 1;
Transfinite Curve{2, 4} = across + 1;
Transfinite Surface{1};
Recombine Surface{1};

Physical Surface("beam") = {1};
Physical Curve("foot") = {4};
Physical Curve("tip") = {2};

Mesh.ElementOrder = 2;
