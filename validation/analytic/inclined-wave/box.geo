// Level ground in space: 20-node hexahedra.
DefineConstant[ width = 16.0, size = 2.0, layers = 5 ];
Point(1) = {0, 0, 0}; Point(2) = {width, 0, 0}; Point(3) = {width, width, 0}; Point(4) = {0, width, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Transfinite Curve{1:4} = Round(width / size) + 1;
Transfinite Surface{1};
Recombine Surface{1};
rock[] = Extrude {0, 0, 5} { Surface{1}; Layers{layers}; Recombine; };
soil[] = Extrude {0, 0, 5} { Surface{rock[0]}; Layers{layers}; Recombine; };

Physical Volume("rock") = {rock[1]};
Physical Volume("soil") = {soil[1]};
Physical Surface("base") = {1};
Physical Surface("sides") = {rock[2], rock[3], rock[4], rock[5], soil[2], soil[3], soil[4], soil[5]};
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
