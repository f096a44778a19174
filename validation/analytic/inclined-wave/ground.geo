// Level ground, or a slope in its middle third: 8-node quadrilaterals.
DefineConstant[ width = 40.0, hill = 0.0, size = 1.0 ];
middle = 10; rock = 5; soil = 5;

x[] = {0, width / 2 - middle, width / 2 + middle, width};
rise[] = {0, 0, hill, hill};
For i In {0:3}
  Point(10 + i) = {x[i], 0, 0};
  Point(20 + i) = {x[i], rock, 0};
  Point(30 + i) = {x[i], rock + soil + rise[i], 0};
EndFor
For i In {0:2}
  For k In {1:3}
    Line(100 * k + i) = {10 * k + i, 10 * k + i + 1};
    Transfinite Curve{100 * k + i} = Round((x[i + 1] - x[i]) / size) + 1;
  EndFor
EndFor
For i In {0:3}
  For k In {1:2}
    Line(1000 + 10 * k + i) = {10 * k + i, 10 * k + 10 + i};
    Transfinite Curve{1000 + 10 * k + i} = Round(10 / size) + 1;
  EndFor
EndFor
For i In {0:2}
  For k In {1:2}
    Curve Loop(10 * k + i) = {100 * k + i, 1000 + 10 * k + i + 1, -(100 * (k + 1) + i), -(1000 + 10 * k + i)};
    Plane Surface(10 * k + i) = {10 * k + i};
  EndFor
EndFor
Transfinite Surface{:};
Recombine Surface{:};

Physical Surface("rock") = {10:12};
Physical Surface("soil") = {20:22};
Physical Curve("base") = {100:102};
Physical Curve("left") = {1010, 1020};
Physical Curve("right") = {1013, 1023};
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
