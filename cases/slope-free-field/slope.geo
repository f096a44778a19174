// Section of a natural slope: x from the toe into the hill, y up from the base. Layers follow the surface.
DefineConstant[ size = 2.5, flat = 50.0 ];
toe = 22; crest = 40; run = 36;

// Columns of points from the valley to the hill, at the levels of the base, rock, stiff soil and surface.
x[] = {-flat, 0, run, run + flat};
level0[] = {0, 0, 0, 0};
level1[] = {8, 8, 14, 14};
level2[] = {14, 14, 24, 24};
level3[] = {toe, toe, crest, crest};
For i In {0:3}
  Point(10 + i) = {x[i], level0[i], 0};
  Point(20 + i) = {x[i], level1[i], 0};
  Point(30 + i) = {x[i], level2[i], 0};
  Point(40 + i) = {x[i], level3[i], 0};
EndFor

// Lines along x: 100 k + column; upwards: 1000 + 10 k + column, from level k.
For k In {1:4}
  For i In {0:2}
    Line(100 * k + i) = {10 * k + i, 10 * k + i + 1};
  EndFor
EndFor
For k In {1:3}
  For i In {0:3}
    Line(1000 + 10 * k + i) = {10 * k + i, 10 * k + 10 + i};
  EndFor
EndFor
rows[] = {0, Round(10 / size), Round(9 / size), Round(13 / size)};
columns[] = {Round(flat / size), Round(run / size), Round(flat / size)};
For k In {1:3}
  For i In {0:2}
    Curve Loop(10 * k + i) = {100 * k + i, 1000 + 10 * k + i + 1, -(100 * (k + 1) + i), -(1000 + 10 * k + i)};
    Plane Surface(10 * k + i) = {10 * k + i};
  EndFor
  For i In {0:3}
    Transfinite Curve{1000 + 10 * k + i} = rows[k] + 1;
  EndFor
EndFor
For k In {1:4}
  For i In {0:2}
    Transfinite Curve{100 * k + i} = columns[i] + 1;
  EndFor
EndFor
Transfinite Surface{:};
Recombine Surface{:};

Physical Surface("rock") = {10:12};
Physical Surface("stiff soil") = {20:22};
Physical Surface("soil") = {30:32};
Physical Curve("base") = {100:102};
Physical Curve("valley side") = {1010, 1020, 1030};
Physical Curve("hill side") = {1013, 1023, 1033};

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
