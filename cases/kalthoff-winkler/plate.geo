// Half of a steel plate with two notches, 100 mm square, struck below its notch on its left edge. The line y = 0 is the plate's middle; the
// notch is 50 mm long and 0.3 mm wide at its mouth, 25 mm from the middle.
SetFactory("Built-in");

DefineConstant[
  size = {0.0025, Min 0.0005, Max 0.005, Name "Element size [m]"}
  thickness = {0.005, Min 0.0005, Max 0.009, Name "Thickness of the slice [m]"}
];

side = 0.1;
notch = 0.05;
height = 0.025;
gap = 0.00015;

Point(1) = {0, 0, 0, size};
Point(2) = {side, 0, 0, size};
Point(3) = {side, side, 0, size};
Point(4) = {0, side, 0, size};
Point(5) = {0, height + gap, 0, size};
Point(6) = {notch, height, 0, size};
Point(7) = {0, height - gap, 0, size};
For i In {1:6}
  Line(i) = {i, i + 1};
EndFor
Line(7) = {7, 1};
Curve Loop(1) = {1:7};
Plane Surface(1) = {1};

plate[] = Extrude {0, 0, thickness} { Surface{1}; };

Physical Surface("middle", 1) = {plate[2]};
Physical Surface("struck", 2) = {plate[8]};
Physical Surface("back", 3) = {1};
Physical Surface("front", 4) = {plate[0]};
Physical Volume("plate", 5) = {plate[1]};

// An advancing front would lay rows of equal triangles along the edges, and cracks would follow their directions.
Mesh.Algorithm = 5;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
