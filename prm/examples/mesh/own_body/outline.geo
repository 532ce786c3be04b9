// What both bodies share: a pin of 6 x 3.464 mm whose lower edges are cut off, and the names of its boundaries.
SetFactory("OpenCASCADE");
a = 1; b = Sqrt(3); r = 0.16;      // mm, those of cell.geo
width = 6 * a; height = 2 * b;
chamfer = 1; rise = 0.25;        // mm along x and y

Point(1) = {0, rise, 0};
Point(2) = {chamfer, 0, 0};
Point(3) = {width - chamfer, 0, 0};
Point(4) = {width, rise, 0};
Point(5) = {width, height, 0};
Point(6) = {0, height, 0};
For k In {1:6}
  Line(k) = {k, k % 6 + 1};
EndFor
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};

Macro Boundaries  // by place, as numbers change when fibres are cut out; the gap of a chamfer is its height
  e = 1e-3;
  contact() = Curve In BoundingBox{-e, -e, -e, width + e, rise + e, e};
  back() = Curve In BoundingBox{-e, height - e, -e, width + e, height + e, e};
  Physical Curve("Contact") = {contact()};
  Physical Curve("Top") = {back()};
Return
