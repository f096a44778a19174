// Anchored sheet pile quay wall. x runs landwards from the wall, y up from the top of the quay; lengths in m.
SetFactory("Built-in");

lines[] = {0, -1.5, -3, -8, -13, -16, -24};  // top, tie rod, foot of the anchor wall, ground before the wall, foot of the wall, stiff ground, base
rows[] = {1, 1, 4, 4, 2, 3};                 // elements between them
columns[] = {-40, 0, 12, 52};                // sea side, wall, anchor wall, land side
cells[] = {18, 10, 18};

// Points by column and line; before the wall there is none above the ground.
For i In {0 : 3}
  For j In {0 : 6}
    Point(100 * i + j + 1) = {columns[i], lines[j], 0};
  EndFor
EndFor
For i In {0 : 3}
  For j In {0 : 5}
    If (i > 0 || j > 2)
      Line(1000 + 100 * i + j) = {100 * i + j + 1, 100 * i + j + 2};
      Transfinite Curve(1000 + 100 * i + j) = rows[j] + 1;
    EndIf
  EndFor
EndFor
For i In {0 : 2}
  For j In {0 : 6}
    If (i > 0 || j > 2)
      Line(2000 + 100 * i + j) = {100 * i + j + 1, 100 * (i + 1) + j + 1};
      If (i == 0)
        Transfinite Curve(2000 + j) = cells[0] + 1 Using Progression 0.93;
      EndIf
      If (i == 1)
        Transfinite Curve(2100 + j) = cells[1] + 1;
      EndIf
      If (i == 2)
        Transfinite Curve(2200 + j) = cells[2] + 1 Using Progression 1.07;
      EndIf
    EndIf
  EndFor
EndFor
sand[] = {};
stiff[] = {};
For i In {0 : 2}
  For j In {0 : 5}
    If (i > 0 || j > 2)
      Curve Loop(100 * i + j + 1) = {1000 + 100 * i + j, 2000 + 100 * i + j + 1, -(1000 + 100 * (i + 1) + j), -(2000 + 100 * i + j)};
      Plane Surface(100 * i + j + 1) = {100 * i + j + 1};
      Transfinite Surface(100 * i + j + 1);
      Recombine Surface(100 * i + j + 1);
      If (j < 5)
        sand[] += 100 * i + j + 1;
      Else
        stiff[] += 100 * i + j + 1;
      EndIf
    EndIf
  EndFor
EndFor

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;

Physical Surface("sand") = {sand[]};
Physical Surface("stiff ground") = {stiff[]};
Physical Curve("base") = {2006, 2106, 2206};
Physical Curve("sea side") = {1003, 1004, 1005};
Physical Curve("land side") = {1300, 1301, 1302, 1303, 1304, 1305};
Physical Curve("wall") = {1100, 1101, 1102, 1103};
Physical Curve("anchor wall") = {1200, 1201};
