// A column of quadrilaterals, one wide; by `ratio` lower from each to the next one above.
DefineConstant[ width = 0.5, height = 10.0, cells = 40, order = 2, ratio = 1 ];

Point(1) = {0, 0, 0};
Point(2) = {width, 0, 0};
Point(3) = {width, height, 0};
Point(4) = {0, height, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve{1, 3} = 2;
Transfinite Curve{2, -4} = cells + 1 Using Progression ratio;
Transfinite Surface{1};
Recombine Surface{1};

Physical Surface("ground") = {1};
Physical Curve("base") = {1};
Physical Curve("sides") = {2, 4};
Physical Curve("top") = {3};

Mesh.ElementOrder = order;
Mesh.SecondOrderIncomplete = 1;
