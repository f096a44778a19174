// Half of a strip footing on a layer of clay: the plane of symmetry is x = 0.
DefineConstant[ half_width = 0.5, width = 4.0, depth = 3.0, fine = 0.04, coarse = 0.5 ];

Point(1) = {0, -depth, 0, coarse};
Point(2) = {width, -depth, 0, coarse};
Point(3) = {width, 0, 0, coarse};
Point(4) = {half_width, 0, 0, fine};
Point(5) = {0, 0, 0, 2 * fine};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};

Physical Surface("clay") = {1};
Physical Curve("bottom") = {1};
Physical Curve("side") = {2};
Physical Curve("footing") = {4};
Physical Curve("symmetry") = {5};

Mesh.ElementOrder = 2;
Mesh.SecondOrderLinear = 1;
