// A strip of ground, its top at y = 0: quadrilaterals of 8 nodes.
Point(1) = {-0.6, -0.3, 0};
line[] = Extrude{1.2, 0, 0}{ Point{1}; Layers{7}; Recombine; };
face[] = Extrude{0, 0.3, 0}{ Curve{line[1]}; Layers{2}; Recombine; };

Physical Surface("ground") = {face[1]};
Physical Curve("bottom") = {line[1]};
Physical Curve("top") = {face[0]};

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
