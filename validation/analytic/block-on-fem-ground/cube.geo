// A cube of 0.2 m, 1 mm above the ground, off its middle.
SetFactory("OpenCASCADE");
Box(1) = {-0.07, -0.11, 0.001, 0.2, 0.2, 0.2};
Physical Volume("cube") = {1};
Mesh.MeshSizeMin = 0.2;
Mesh.MeshSizeMax = 0.2;
