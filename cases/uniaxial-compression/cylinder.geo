// Cylinder of rock, 50 mm in diameter and 100 mm high, upright, between the faces "bottom" and "top".
SetFactory("Built-in");

DefineConstant[
  size = {0.008, Min 0.002, Max 0.025, Name "Element size [m]"}
];

radius = 0.025;
height = 0.1;

Point(1) = {0, 0, 0, size};
Point(2) = {radius, 0, 0, size};
Point(3) = {0, radius, 0, size};
Point(4) = {-radius, 0, 0, size};
Point(5) = {0, -radius, 0, size};
Circle(1) = {2, 1, 3};
Circle(2) = {3, 1, 4};
Circle(3) = {4, 1, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

// solid[0] is the upper face, solid[1] the volume, then one side face per arc.
solid[] = Extrude {0, 0, height} { Surface{1}; };

Physical Surface("bottom", 1) = {1};
Physical Surface("top", 2) = {solid[0]};
Physical Volume("rock", 3) = {solid[1]};

Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
