#!/usr/bin/env python3
"""Writes fibre_cell.msh: a periodic cell of round fibres with the volume fraction of round_fibres.msh. Needs python3-gmsh."""

import math

import gmsh
from gmsh_groups import inclusions, make_periodic, scattered, start, write

RADIUS = 0.2  # mm
FRACTION = 48 * math.pi * RADIUS**2 / (8.0 * 4.0)
N = 24
LENGTH = math.sqrt(N * math.pi * RADIUS**2 / FRACTION)
SIZE = [LENGTH, LENGTH]

start("fibre_cell")
cell = gmsh.model.occ.addRectangle(0, 0, 0, *SIZE)
centres = scattered(N, SIZE, RADIUS, 0.08, seed=2, margin=RADIUS + 0.08)
inclusions(2, cell, [gmsh.model.occ.addDisk(*centre, 0, RADIUS, RADIUS) for centre in centres])
make_periodic(2, SIZE)
write("fibre_cell", 2, 0.1)
gmsh.finalize()
