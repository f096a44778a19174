// A wall of concrete, 2.5 m high and 0.4 m thick, clamped at its foot at x = 0.45 m.
size = 0.1;
Point(1) = {0.45, 0, 0, size};
Point(2) = {0.85, 0, 0, size};
Point(3) = {0.85, 2.5, 0, size};
Point(4) = {0.45, 2.5, 0, size};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 5;
Transfinite Curve {2, 4} = 26;
Transfinite Surface {1};
Recombine Surface {1};
Mesh.ElementOrder = 2;
Physical Surface("wall") = {1};
Physical Curve("foot") = {1};
Physical Curve("surface") = {2, 3, 4};
