#!/usr/bin/env python3
"""Writes cylinder.msh: a pin of 6 mm diameter and 8 mm height on its round face. Hexahedra; needs python3-gmsh."""

import gmsh
from gmsh_groups import group, in_box, start, write

RADIUS, HEIGHT, LAYERS = 3.0, 8.0, 12  # mm

start("cylinder")
# Quadrilaterals on the round face, which is extruded in layers.
face = gmsh.model.occ.addDisk(0, 0, 0, RADIUS, RADIUS)
gmsh.model.occ.extrude([(2, face)], 0, 0, HEIGHT, [LAYERS], recombine=True)
gmsh.model.occ.synchronize()
group(3, [tag for _, tag in gmsh.model.getEntities(3)], "steel")
for name, z in (("Contact", 0.0), ("Top", HEIGHT)):
    group(2, in_box(2, (-RADIUS, -RADIUS, z), (RADIUS, RADIUS, z)), name)
write("cylinder", 3, 0.55)
gmsh.finalize()
