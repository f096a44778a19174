// A block of concrete at the right of the ground, held behind and below.
Point(1) = {6, 0, 0}; Point(2) = {6.5, 0, 0}; Point(3) = {6.5, 4, 0}; Point(4) = {6, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 3;
Transfinite Curve {2, 4} = 17;
Transfinite Surface {1};
Recombine Surface {1};
Physical Surface("wall") = {1};
Physical Curve("foot") = {1};
Physical Curve("back") = {2};
Physical Curve("face") = {4};
