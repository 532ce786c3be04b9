#!/usr/bin/env python3
"""Writes spheres.msh: a periodic cube of 1 mm with a sphere in its middle and one at its corners. Tetrahedra; needs python3-gmsh."""

import itertools

import gmsh
from gmsh_groups import inclusions, make_periodic, start, write

RADIUS = 0.3  # mm
SIZE = [1.0, 1.0, 1.0]

start("spheres")
cube = gmsh.model.occ.addBox(0, 0, 0, *SIZE)
balls = [gmsh.model.occ.addSphere(*centre, RADIUS) for centre in [(0.5, 0.5, 0.5), *itertools.product((0, 1), repeat=3)]]
inclusions(3, cube, balls, ("matrix", "particle"))
make_periodic(3, SIZE)
write("spheres", 3, 0.12, quadrilaterals=False)
gmsh.finalize()
