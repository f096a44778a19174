// Disc of rock, 50 mm in diameter and 25 mm thick, with its axis along z. The faces "top" and "bottom" are arcs of 10 degrees, on which jaws press along y.
SetFactory("Built-in");

DefineConstant[
  size = {0.005, Min 0.002, Max 0.0125, Name "Element size [m]"}
];

radius = 0.025;
thickness = 0.025;
half = 5 * Pi / 180;
x = radius * Sin(half);
y = radius * Cos(half);

Point(1) = {0, 0, 0, size};
Point(2) = {radius, 0, 0, size};
Point(3) = {x, y, 0, size};
Point(4) = {-x, y, 0, size};
Point(5) = {-radius, 0, 0, size};
Point(6) = {-x, -y, 0, size};
Point(7) = {x, -y, 0, size};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 6};
Circle(5) = {6, 1, 7};
Circle(6) = {7, 1, 2};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};

// solid[0] is the face at z = thickness, solid[1] the volume, then one side face per arc.
solid[] = Extrude {0, 0, thickness} { Surface{1}; };

Physical Surface("top", 1) = {solid[3]};
Physical Surface("bottom", 2) = {solid[6]};
Physical Volume("rock", 3) = {solid[1]};

Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
