// Section of a quay wall: x landwards from the caisson's seaward foot, y up from the still sea.
DefineConstant[ size = 3.0, wide = 1400.0 ];
width = 12; crest = 4; foot = -14; mound = -18; sand = -32; base = -36;
near_sea = -40; near_land = 66;

// Columns from sea to land: far sea, sea, toe, caisson, rubble, backfill, far land; the far ones of wide elements.
below[] = {near_sea - wide, near_sea, -6, 0, width, 26, near_land, near_land + wide};
under[] = {near_sea - wide, near_sea, -10, 0, width, 30, near_land, near_land + wide};
at_sea_level = 26 - 8 * (0 - foot) / (crest - foot);
// Points 10 k + column at the levels k = 1 (base), 2 (top of the stiff ground), 3 (foot of the mound), 4 (foot of the wall), 5 (sea), 6 (crest).
For i In {0:7}
  Point(10 + i) = {under[i], base, 0};
  Point(20 + i) = {under[i], sand, 0};
  Point(30 + i) = {under[i], mound, 0};
  Point(40 + i) = {below[i], foot, 0};
EndFor
For i In {3:7}
  x5 = below[i]; x6 = below[i];
  If (i == 5)
    x5 = at_sea_level; x6 = 18;
  EndIf
  Point(50 + i) = {x5, 0, 0};
  Point(60 + i) = {x6, crest, 0};
EndFor

// Lines along x: 100 k + column; upwards: 1000 + 10 k + column, from level k.
For k In {1:6}
  For i In {(k > 4 ? 3 : 0):6}
    Line(100 * k + i) = {10 * k + i, 10 * k + i + 1};
  EndFor
EndFor
For k In {1:5}
  For i In {(k > 3 ? 3 : 0):7}
    Line(1000 + 10 * k + i) = {10 * k + i, 10 * k + 10 + i};
  EndFor
EndFor

rows[] = {0, Round(4 / size), Round(14 / size), 2, Round(14 / size), 2};
columns[] = {8, Round(34 / size), Round(6 / size), Round(15 / size), Round(15 / size), Round(36 / size), 8};
For k In {1:5}
  For i In {(k > 3 ? 3 : 0):6}
    Curve Loop(10 * k + i) = {100 * k + i, 1000 + 10 * k + i + 1, -(100 * (k + 1) + i), -(1000 + 10 * k + i)};
    Plane Surface(10 * k + i) = {10 * k + i};
  EndFor
EndFor
For k In {1:6}
  For i In {(k > 4 ? 3 : 0):6}
    If (i == 0)
      Transfinite Curve{100 * k + i} = columns[i] + 1 Using Progression 1 / 2.2;
    ElseIf (i == 6)
      Transfinite Curve{100 * k + i} = columns[i] + 1 Using Progression 2.2;
    Else
      Transfinite Curve{100 * k + i} = columns[i] + 1;
    EndIf
  EndFor
EndFor
For k In {1:5}
  For i In {(k > 3 ? 3 : 0):7}
    Transfinite Curve{1000 + 10 * k + i} = rows[k] + 1;
  EndFor
EndFor
Transfinite Surface{:};
Recombine Surface{:};

Physical Surface("stiff ground") = {10:16};
Physical Surface("sand") = {20:26, 30, 31, 35, 36};
Physical Surface("mound") = {32:34};
Physical Surface("caisson") = {43, 53};
Physical Surface("rubble") = {44, 54};
Physical Surface("backfill") = {45, 46, 55, 56};
Physical Curve("base") = {100:106};
Physical Curve("sides") = {1010, 1020, 1030, 1017, 1027, 1037, 1047, 1057};
Physical Curve("bed") = {400:402};
Physical Curve("seaward") = {1043, 1053};

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
