// The same body with every fibre, on the lattice of cell.geo.
//   gmsh -2 pin_with_fibres.geo      writes pin_with_fibres.msh
Include "outline.geo";
n = 100;
fibres() = {};
For i In {0:5}
  For j In {0:1}
    Disk(n) = {(i + 0.25) * a, (j + 0.25) * b, 0, r};
    Disk(n + 1) = {(i + 0.75) * a, (j + 0.75) * b, 0, r};
    fibres() += {n, n + 1};
    n += 2;
  EndFor
EndFor
// Of fibres that the chamfers cut, the part within the body.
inside() = BooleanIntersection{ Surface{fibres()}; Delete; }{ Surface{1}; };
BooleanFragments{ Surface{1}; Delete; }{ Surface{inside()}; Delete; }
matrix() = Surface{:};
Physical Surface("fibre") = {inside()};
matrix() -= {inside()};
Physical Surface("matrix") = {matrix()};
Call Boundaries;
Mesh.MeshSizeMin = 0.085;
Mesh.MeshSizeMax = 0.085;
Mesh.RecombineAll = 1;            // quadrilaterals
Mesh.RecombinationAlgorithm = 2;
Mesh.MshFileVersion = 4.1;
