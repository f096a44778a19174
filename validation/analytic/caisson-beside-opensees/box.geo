// A caisson on a layer of sand in a rigid box, of squares with 1/cells m.
DefineConstant[ cells = 1, order = 2 ];

Point(1) = {0, 0, 0};
Point(2) = {11, 0, 0};
Point(3) = {19, 0, 0};
Point(4) = {30, 0, 0};
Point(5) = {0, 8, 0};
Point(6) = {11, 8, 0};
Point(7) = {19, 8, 0};
Point(8) = {30, 8, 0};
Point(9) = {11, 16, 0};
Point(10) = {19, 16, 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {5, 6};
Line(5) = {6, 7};
Line(6) = {7, 8};
Line(7) = {9, 10};
Line(11) = {1, 5};
Line(12) = {2, 6};
Line(13) = {3, 7};
Line(14) = {4, 8};
Line(15) = {6, 9};
Line(16) = {7, 10};

Curve Loop(1) = {1, 12, -4, -11};
Curve Loop(2) = {2, 13, -5, -12};
Curve Loop(3) = {3, 14, -6, -13};
Curve Loop(4) = {5, 16, -7, -15};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Plane Surface(3) = {3};
Plane Surface(4) = {4};

Transfinite Curve{1, 3, 4, 6} = 11 * cells + 1;
Transfinite Curve{2, 5, 7, 11, 12, 13, 14, 15, 16} = 8 * cells + 1;
Transfinite Surface{1, 2, 3, 4};
Recombine Surface{1, 2, 3, 4};

Physical Surface("sand") = {1, 2, 3};
Physical Surface("caisson") = {4};
Physical Curve("bed") = {4, 6};
Physical Curve("base") = {1, 2, 3};
Physical Curve("sides") = {11, 14};

Mesh.ElementOrder = order;
