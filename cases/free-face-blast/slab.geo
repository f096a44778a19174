// Concrete specimen of the free-face blast: 1.8 x 1.2 x depth [m], a hexagonal hole of 5 cm diameter at (1.4, 0.6) through
// the whole depth, 0.4 m from the free face on the right. Elements of size `fine` near the hole grow to `coarse` far away.
// gmsh -3 -format msh41 -setnumber depth 3 slab.geo
SetFactory("Built-in");

DefineConstant[
  depth = {0.2, Min 0.05, Max 10, Name "Depth [m]"}
  fine = {0.05, Min 0.005, Max 0.5, Name "Element size at the hole [m]"}
  coarse = {0.25, Min 0.01, Max 1, Name "Element size far away [m]"}
  growth = {0.3, Min 0, Max 1, Name "Growth of the size per distance from the hole"}
];

length = 1.8;
height = 1.2;
hole_x = 1.4;
hole_y = 0.6;
hole_radius = 0.025;

Point(1) = {0, 0, 0};
Point(2) = {length, 0, 0};
Point(3) = {length, height, 0};
Point(4) = {0, height, 0};
For i In {0:5}
  angle = Pi / 6 + i * Pi / 3;
  Point(11 + i) = {hole_x + hole_radius * Cos(angle), hole_y + hole_radius * Sin(angle), 0};
EndFor

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
For i In {0:5}
  Line(11 + i) = {11 + i, 11 + (i + 1) % 6};
EndFor
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {11, 12, 13, 14, 15, 16};
Plane Surface(1) = {1, 2};

// out[0] is the face at z = depth, out[1] the volume, then one side face per line in the order of the loops.
out[] = Extrude {0, 0, depth} { Surface{1}; };

Physical Surface("left", 1) = {out[5]};
Physical Surface("right", 2) = {out[3]};
Physical Surface("bottom", 3) = {out[2]};
Physical Surface("top", 4) = {out[4]};
Physical Surface("hole", 5) = {out[6], out[7], out[8], out[9], out[10], out[11]};
Physical Surface("front", 6) = {1};
Physical Surface("back", 7) = {out[0]};
Physical Volume("concrete", 8) = {out[1]};

Field[1] = MathEval;
Field[1].F = Sprintf("%g + %g * (Sqrt((x - %g)^2 + (y - %g)^2) - %g)", fine, growth, hole_x, hole_y, hole_radius);
Field[2] = MathEval;
Field[2].F = Sprintf("%g", coarse);
Field[3] = Min;
Field[3].FieldsList = {1, 2};
Background Field = 3;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;
Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
