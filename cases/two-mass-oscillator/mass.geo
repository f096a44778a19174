// One quadrilateral.
Point(1) = {0, 0, 0};
Point(2) = {0.1, 0, 0};
Point(3) = {0.1, 0.1, 0};
Point(4) = {0, 0.1, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 2, 3, 4} = 2;
Transfinite Surface{1};
Recombine Surface{1};

Physical Surface("block") = {1};
Physical Curve("bottom") = {1};
Physical Curve("sides") = {2, 4};
Physical Curve("top") = {3};
