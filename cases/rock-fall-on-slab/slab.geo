// A slab 1 m by 1 m, 0.1 m thick, its top at z = 0: bricks of eight nodes.
Point(1) = {-0.5, -0.5, -0.1};
line[] = Extrude{1, 0, 0}{ Point{1}; Layers{12}; Recombine; };
face[] = Extrude{0, 1, 0}{ Curve{line[1]}; Layers{12}; Recombine; };
body[] = Extrude{0, 0, 0.1}{ Surface{face[1]}; Layers{2}; Recombine; };

Physical Volume("slab") = {body[1]};
Physical Surface("top") = {body[0]};
Physical Surface("left support") = {body[5]};
Physical Surface("right support") = {body[3]};
