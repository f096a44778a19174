// A cube of 0.2 m, 5 mm above the slab, a little off its middle.
SetFactory("OpenCASCADE");
Box(1) = {-0.08, -0.11, 0.005, 0.2, 0.2, 0.2};
Physical Volume("rock") = {1};
Mesh.MeshSizeMin = 0.1;
Mesh.MeshSizeMax = 0.1;
