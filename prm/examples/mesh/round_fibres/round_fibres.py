#!/usr/bin/env python3
"""Writes round_fibres.msh: a pin of 8 x 4 mm with round fibres, seen along them. Quadrilaterals; needs python3-gmsh."""

import os
import sys

import gmsh

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), ".."))
from gmsh_groups import group, inclusions, scattered, side, start, write  # noqa: E402

SIZE = [8.0, 4.0]  # mm
RADIUS = 0.2

start("round_fibres")
pin = gmsh.model.occ.addRectangle(0, 0, 0, *SIZE)
centres = scattered(48, SIZE, RADIUS, 0.08, seed=1, margin=RADIUS + 0.08)
fibres = [gmsh.model.occ.addDisk(*centre, 0, RADIUS, RADIUS) for centre in centres]
inclusions(2, pin, fibres)
for axis, upper, name in ((1, False, "Contact"), (1, True, "Top"), (0, False, "Left"), (0, True, "Right")):
    group(1, side(2, SIZE, axis, upper), name)
write("round_fibres", 2, 0.1)
gmsh.finalize()
