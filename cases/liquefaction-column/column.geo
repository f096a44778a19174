// Sand on rock: 8-node quadrilaterals in a column one wide.
DefineConstant[ width = 0.5, sand = 10.0, rock = 1.0, cells = 20 ];

Point(1) = {0, -rock, 0};
Point(2) = {width, -rock, 0};
Point(3) = {width, 0, 0};
Point(4) = {0, 0, 0};
Point(5) = {width, sand, 0};
Point(6) = {0, sand, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {3, 5};
Line(6) = {5, 6};
Line(7) = {6, 4};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {-3, 5, 6, 7};
Plane Surface(1) = {1};
Plane Surface(2) = {2};
Transfinite Curve{1, 2, 3, 4, 6} = 2;
Transfinite Curve{5, 7} = cells + 1;
Transfinite Surface{1, 2};
Recombine Surface{1, 2};

Physical Surface("rock") = {1};
Physical Surface("sand") = {2};
Physical Curve("base") = {1};
Physical Curve("left") = {4, 7};
Physical Curve("right") = {2, 5};

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
