// A bar of 10 mm by 10 mm between two supports at half its height.
DefineConstant[ length = 0.3, height = 0.01, along = 60, across = 2 ];
Point(1) = {-length/2, -height/2, 0};
Point(2) = {length/2, -height/2, 0};
Point(3) = {length/2, height/2, 0};
Point(4) = {-length/2, height/2, 0};
Point(5) = {-length/2, 0, 0};
Point(6) = {length/2, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 6};
Line(3) = {6, 5};
Line(4) = {5, 1};
Line(5) = {6, 3};
Line(6) = {3, 4};
Line(7) = {4, 5};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve Loop(2) = {-3, 5, 6, 7};
Plane Surface(2) = {2};
Transfinite Curve{1, 3, 6} = along + 1;
Transfinite Curve{2, 4, 5, 7} = across/2 + 1;
Transfinite Surface{1, 2};
Recombine Surface{1, 2};

Physical Surface("beam") = {1, 2};
Physical Curve("top") = {6};
Physical Point("left support") = {5};
Physical Point("right support") = {6};

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
