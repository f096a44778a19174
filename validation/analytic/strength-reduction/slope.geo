// A slope with its toe at the origin, on ground of a depth; with none on a firm base at the level of its toe.
DefineConstant[ height = 10.0, run = 10.0, behind = 12.0, before = 10.0, depth = 5.0, size = 1.0 ];

Point(2) = {run + behind, -depth, 0, size};
Point(3) = {run + behind, height, 0, size};
Point(4) = {run, height, 0, size};
Point(5) = {0, 0, 0, size};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
If (depth > 0)
  Point(1) = {-before, -depth, 0, size};
  Point(6) = {-before, 0, 0, size};
  Line(1) = {1, 2};
  Line(5) = {5, 6};
  Line(6) = {6, 1};
  Curve Loop(1) = {1, 2, 3, 4, 5, 6};
  Physical Curve("sides") = {2, 6};
Else
  Line(1) = {5, 2};
  Curve Loop(1) = {1, 2, 3, 4};
  Physical Curve("sides") = {2};
EndIf
Plane Surface(1) = {1};

Physical Surface("ground") = {1};
Physical Curve("bottom") = {1};

Mesh.ElementOrder = 2;
Mesh.SecondOrderLinear = 1;
