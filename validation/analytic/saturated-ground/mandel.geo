// A quarter of a strip between two plates.
DefineConstant[ half_width = 1.0, half_height = 0.5, cells = 20, order = 2 ];

Point(1) = {0, 0, 0};
Point(2) = {half_width, 0, 0};
Point(3) = {half_width, half_height, 0};
Point(4) = {0, half_height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1} = cells + 1 Using Progression 0.9;
Transfinite Curve{3} = cells + 1 Using Progression 1 / 0.9;
Transfinite Curve{2, 4} = 4;
Transfinite Surface{1};
Recombine Surface{1};

Physical Surface("ground") = {1};
Physical Curve("plane-y") = {1};
Physical Curve("side") = {2};
Physical Curve("plate") = {3};
Physical Curve("plane-x") = {4};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;
