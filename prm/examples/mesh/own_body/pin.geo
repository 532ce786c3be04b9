// The body of one material.
//   gmsh -2 pin.geo      writes pin.msh
Include "outline.geo";
Call Boundaries;
Physical Surface("pin") = {1};
Mesh.MeshSizeMin = 0.2;
Mesh.MeshSizeMax = 0.2;
Mesh.RecombineAll = 1;            // quadrilaterals
Mesh.RecombinationAlgorithm = 2;
Mesh.MshFileVersion = 4.1;
