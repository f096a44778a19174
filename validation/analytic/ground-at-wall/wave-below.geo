// The lower half of the column.
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 10, 0}; Point(4) = {0, 10, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 5;
Transfinite Curve {2, 4} = 41;
Transfinite Surface {1};
Recombine Surface {1};
Physical Surface("ground") = {1};
Physical Curve("base") = {1};
Physical Curve("sides") = {2, 4};
Physical Curve("top") = {3};
