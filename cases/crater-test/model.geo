// Made by sazare blast-model from pattern.csv. Lengths in m.
// x points along the surface, z out of the rock where the holes begin, and the origin is the collar of hole 1.
SetFactory("OpenCASCADE");

DefineConstant[
  far = {0.25, Name "Element size far from the holes [m]"}
  growth = {0.5, Name "Growth of the size per distance from a hole"}
];
e = 3.5894847025840044e-05;  // what lies within a box grown by this much is what the box is of
Point(1) = {-1.5, -1.5, -3.0};
Point(2) = {1.5, -1.5, -3.0};
Point(3) = {1.5, -1.5, 0.0};
Point(4) = {-1.5, -1.5, 0.0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Extrude {0.0, 3.0, 0.0} { Surface{1}; }
bores[] = {};

// hole_1
p = newp;
Point(p + 0) = {-0.0433289132545453, -0.017947423512920023, -1.5};
Point(p + 1) = {-0.017947423512920026, -0.0433289132545453, -1.5};
Point(p + 2) = {0.017947423512920023, -0.0433289132545453, -1.5};
Point(p + 3) = {0.0433289132545453, -0.01794742351292003, -1.5};
Point(p + 4) = {0.043328913254545305, 0.01794742351292002, -1.5};
Point(p + 5) = {0.01794742351292005, 0.043328913254545284, -1.5};
Point(p + 6) = {-0.017947423512920033, 0.04332891325454529, -1.5};
Point(p + 7) = {-0.043328913254545284, 0.017947423512920054, -1.5};
l = newl;
Line(l + 0) = {p + 0, p + 1};
Line(l + 1) = {p + 1, p + 2};
Line(l + 2) = {p + 2, p + 3};
Line(l + 3) = {p + 3, p + 4};
Line(l + 4) = {p + 4, p + 5};
Line(l + 5) = {p + 5, p + 6};
Line(l + 6) = {p + 6, p + 7};
Line(l + 7) = {p + 7, p + 0};
c = newll;
Curve Loop(c) = {l:l + 7};
s = news;
Plane Surface(s) = {c};
bore[] = Extrude {-0.0, -0.0, 1.589} { Surface{s}; };
bores[] += {bore[1]};

rock() = BooleanDifference{ Volume{1}; Delete; }{ Volume{bores()}; Delete; };

Physical Volume("rock") = Volume{:};
rest() = Surface{:};
box() = Surface In BoundingBox{-0.0433289132545453 - e, -0.0433289132545453 - e, -1.5 - e, 0.043328913254545305 + e, 0.04332891325454529 + e, 0.08899999999999997 + e};
others() = rest();
others() -= box();
rest() -= others();
Physical Surface("hole_1") = rest();
hole_1() = rest();
rest() = others();
box() = Surface In BoundingBox{-1.5 - e, -1.5 - e, 0.0 - e, 1.5 + e, 1.5 + e, 0.0 + e};
others() = rest();
others() -= box();
rest() -= others();
Physical Surface("top") = rest();
top() = rest();
rest() = others();
box() = Surface In BoundingBox{-1.5 - e, -1.5 - e, -3.0 - e, 1.5 + e, 1.5 + e, -3.0 + e};
others() = rest();
others() -= box();
rest() -= others();
Physical Surface("base") = rest();
base() = rest();
rest() = others();
Physical Surface("sides") = rest();

Field[1] = Distance;
Field[1].CurvesList = {Boundary{ Surface{hole_1()}; }};
Field[1].NumPointsPerCurve = 42;
Field[2] = MathEval;
Field[2].F = Sprintf("%g + %g * F1", 0.035894847025840046, growth);

// Elements are as small at a hole as a side of its polygon.
Field[3] = MathEval;
Field[3].F = Sprintf("%g", far);
Field[4] = Min;
Field[4].FieldsList = {2, 3};
Background Field = 4;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeFromCurvature = 0;
Mesh.Algorithm = 6;
Mesh.Algorithm3D = 1;
Mesh.Optimize = 1;
Mesh.OptimizeThreshold = 0.4;
