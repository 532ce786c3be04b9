#!/usr/bin/env python3
"""Writes chamfered_pin.msh: a pin of 20 x 10 mm whose lower edges are cut off at 10 degrees. Triangles; needs python3-gmsh."""

import math

import gmsh
from gmsh_groups import group, in_box, start, write

WIDTH, HEIGHT, CHAMFER = 20.0, 10.0, 3.0  # mm; CHAMFER along x
RISE = CHAMFER * math.tan(math.radians(10))

start("chamfered_pin")
outline = [(0, RISE), (CHAMFER, 0), (WIDTH - CHAMFER, 0), (WIDTH, RISE), (WIDTH, HEIGHT), (0, HEIGHT)]
points = [gmsh.model.occ.addPoint(x, y, 0) for x, y in outline]
edges = [gmsh.model.occ.addLine(a, b) for a, b in zip(points, points[1:] + points[:1])]
gmsh.model.occ.addPlaneSurface([gmsh.model.occ.addCurveLoop(edges)])
gmsh.model.occ.synchronize()
group(2, [tag for _, tag in gmsh.model.getEntities(2)], "steel")
group(1, in_box(1, (0, 0, 0), (WIDTH, RISE, 0)), "Contact")  # the chamfers, too: their gap is their height
group(1, in_box(1, (0, HEIGHT, 0), (WIDTH, HEIGHT, 0)), "Top")
write("chamfered_pin", 2, 0.4, quadrilaterals=False)
gmsh.finalize()
