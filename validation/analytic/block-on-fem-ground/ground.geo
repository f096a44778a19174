// A box of hexahedra of 20 nodes, its top at z = 0.
Point(1) = {-0.3, -0.3, -0.3};
line[] = Extrude{0.6, 0, 0}{ Point{1}; Layers{3}; Recombine; };
face[] = Extrude{0, 0.6, 0}{ Curve{line[1]}; Layers{3}; Recombine; };
body[] = Extrude{0, 0, 0.3}{ Surface{face[1]}; Layers{2}; Recombine; };

Physical Volume("ground") = {body[1]};
Physical Surface("bottom") = {face[1]};
Physical Surface("top") = {body[0]};

Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 1;
