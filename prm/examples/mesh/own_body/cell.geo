// The volume element: a periodic cell of 1 x 1.732 mm with two fibres, which no side cuts.
//   gmsh -2 cell.geo      writes cell.msh
SetFactory("OpenCASCADE");
a = 1; b = Sqrt(3); r = 0.16;  // mm

Rectangle(1) = {0, 0, 0, a, b};
Disk(2) = {a / 4, b / 4, 0, r};
Disk(3) = {3 * a / 4, 3 * b / 4, 0, r};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2, 3}; Delete; }  // parts share their points

// The groups of the cells are the phases; the fibres have kept their numbers.
matrix() = Surface{:};
Physical Surface("fibre") = {2, 3};
matrix() -= {2, 3};
Physical Surface("matrix") = {matrix()};

// Opposite sides get opposite points, for PBC.
e = 1e-3;
left() = Curve In BoundingBox{-e, -e, -e, e, b + e, e};
right() = Curve In BoundingBox{a - e, -e, -e, a + e, b + e, e};
bottom() = Curve In BoundingBox{-e, -e, -e, a + e, e, e};
top() = Curve In BoundingBox{-e, b - e, -e, a + e, b + e, e};
Periodic Curve{right()} = {left()} Translate{a, 0, 0};
Periodic Curve{top()} = {bottom()} Translate{0, b, 0};

Mesh.MeshSizeMin = 0.07;
Mesh.MeshSizeMax = 0.07;
Mesh.RecombineAll = 1;            // quadrilaterals
Mesh.RecombinationAlgorithm = 2;
Mesh.MshFileVersion = 4.1;
