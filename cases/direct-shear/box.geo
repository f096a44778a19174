// Specimen of a direct shear test: two halves of concrete, 0.3 x 0.1 x 0.06 m each, one above the other, that meet in a lift joint at
// y = 0.1 m. The face "push" is the lowest part of the upper half's left side, close to the joint, as in a shear box.
SetFactory("Built-in");

DefineConstant[
  size = {0.03, Min 0.005, Max 0.1, Name "Element size [m]"}
];

length = 0.3;
half = 0.1;
push = 0.02;
depth = 0.06;

Point(1) = {0, 0, 0, size};
Point(2) = {length, 0, 0, size};
Point(3) = {length, half, 0, size};
Point(4) = {0, half, 0, size};
Point(5) = {length, 2 * half, 0, size};
Point(6) = {0, 2 * half, 0, size};
Point(7) = {0, half + push, 0, size};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {3, 5};
Line(6) = {5, 6};
Line(7) = {6, 7};
Line(8) = {7, 4};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 6, 7, 8, -3};
Plane Surface(1) = {1};
Plane Surface(2) = {2};

// lower[0] and upper[0] are the faces at z = depth, [1] the volumes, then one side face per line in the order of the loops.
lower[] = Extrude {0, 0, depth} { Surface{1}; };
upper[] = Extrude {0, 0, depth} { Surface{2}; };

Physical Surface("bottom", 1) = {lower[2]};
Physical Surface("joint", 2) = {lower[4]};
Physical Surface("top", 3) = {upper[3]};
Physical Surface("push", 4) = {upper[5]};
Physical Volume("lower", 5) = {lower[1]};
Physical Volume("upper", 6) = {upper[1]};

Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
