// A column of 8-node quadrilaterals, one wide: soil on the half-space below it.
DefineConstant[ width = 0.5, soil = 20.0, rock = 2.0, soil_cells = 40, rock_cells = 2 ];

Point(1) = {0, 0, 0};
Point(2) = {width, 0, 0};
Point(3) = {width, rock, 0};
Point(4) = {0, rock, 0};
Point(5) = {width, rock + soil, 0};
Point(6) = {0, rock + soil, 0};
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
Transfinite Curve{1, 3, 6} = 2;
Transfinite Curve{2, 4} = rock_cells + 1;
Transfinite Curve{5, 7} = soil_cells + 1;
Transfinite Surface{1, 2};
Recombine Surface{1, 2};

Physical Surface("rock") = {1};
Physical Surface("soil") = {2};
Physical Curve("base") = {1};
Physical Curve("sides") = {2, 4, 5, 7};

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
