// Disc of rock, 40.8 mm in diameter and 16 mm thick, between the ends of two steel bars along x, which touch it on arcs of 10 degrees. A bar
// is as thick as the disc and as wide as gives it the area of a round one of 22 mm.
SetFactory("Built-in");

DefineConstant[
  size = {0.003, Min 0.001, Max 0.008, Name "Element size of the disc [m]"}
  bar_size = {0.004, Min 0.001, Max 0.016, Name "Element size of the bars [m]"}
];

radius = 0.0204;
thickness = 0.016;
bar = 0.04;
half = 0.01188;
angle = 5 * Pi / 180;
x = radius * Cos(angle);
y = radius * Sin(angle);

Point(1) = {0, 0, 0, size};
Point(2) = {0, radius, 0, size};
Point(3) = {-x, y, 0, size};
Point(4) = {-x, -y, 0, size};
Point(5) = {0, -radius, 0, size};
Point(6) = {x, -y, 0, size};
Point(7) = {x, y, 0, size};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 6};
Circle(5) = {6, 1, 7};
Circle(6) = {7, 1, 2};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};

Point(11) = {-x, half, 0, bar_size};
Point(12) = {-x - bar, half, 0, bar_size};
Point(13) = {-x - bar, -half, 0, bar_size};
Point(14) = {-x, -half, 0, bar_size};
Line(11) = {3, 11};
Line(12) = {11, 12};
Line(13) = {12, 13};
Line(14) = {13, 14};
Line(15) = {14, 4};
Curve Loop(2) = {11, 12, 13, 14, 15, -2};
Plane Surface(2) = {2};

Point(21) = {x, half, 0, bar_size};
Point(22) = {x + bar, half, 0, bar_size};
Point(23) = {x + bar, -half, 0, bar_size};
Point(24) = {x, -half, 0, bar_size};
Line(21) = {7, 21};
Line(22) = {21, 22};
Line(23) = {22, 23};
Line(24) = {23, 24};
Line(25) = {24, 6};
Curve Loop(3) = {21, 22, 23, 24, 25, 5};
Plane Surface(3) = {3};

rock[] = Extrude {0, 0, thickness} { Surface{1}; };
left[] = Extrude {0, 0, thickness} { Surface{2}; };
right[] = Extrude {0, 0, thickness} { Surface{3}; };

Physical Surface("struck", 1) = {left[4]};
Physical Surface("far end", 2) = {right[4]};
Physical Volume("rock", 3) = {rock[1]};
Physical Volume("bars", 4) = {left[1], right[1]};

Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
