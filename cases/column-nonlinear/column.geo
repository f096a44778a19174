// A column of 8-node quadrilaterals, one wide: three layers of soil on rock.
DefineConstant[ width = 1.0, size = 1.0 ];

heights[] = {0, 4, 14, 24, 34};
For n In {0:4}
  Point(2*n + 1) = {0, heights[n], 0};
  Point(2*n + 2) = {width, heights[n], 0};
  Line(100 + n) = {2*n + 1, 2*n + 2};
EndFor
sides[] = {};
For n In {0:3}
  Line(200 + n) = {2*n + 2, 2*n + 4};
  Line(300 + n) = {2*n + 1, 2*n + 3};
  Curve Loop(n + 1) = {100 + n, 200 + n, -(101 + n), -(300 + n)};
  Plane Surface(n + 1) = {n + 1};
  Transfinite Curve{200 + n, 300 + n} = Round((heights[n + 1] - heights[n])/size) + 1;
  sides[] += {200 + n, 300 + n};
EndFor
Transfinite Curve{100:104} = 2;
Transfinite Surface{1:4};
Recombine Surface{1:4};

Physical Surface("rock") = {1};
Physical Surface("dense sand") = {2};
Physical Surface("sand") = {3};
Physical Surface("clay") = {4};
Physical Curve("base") = {100};
Physical Curve("sides") = {sides[]};

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
