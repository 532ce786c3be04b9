#!/usr/bin/env python3
"""Writes polycrystal.npy, 28 x 28 x 28 voxels with the number of their grain, and polycrystal.csv with Bunge's angles of the grains; needs numpy.

The grains are the Voronoi cells of 60 random points in a box that is periodic; all orientations are equally likely.
"""

import os

import numpy as np

N, GRAINS = 28, 60
HERE = os.path.dirname(os.path.abspath(__file__))
random = np.random.default_rng(1)
seeds = N * random.random((GRAINS, 3))
places = np.indices((N, N, N)).reshape(3, -1).T + 0.5
away = np.abs(places[:, None] - seeds)
away = np.minimum(away, N - away)  # to the nearest image
grains = np.argmin((away**2).sum(axis=2), axis=1).reshape(N, N, N).astype(np.uint8)
angles = np.degrees(np.stack([2 * np.pi * random.random(GRAINS), np.arccos(1 - 2 * random.random(GRAINS)), 2 * np.pi * random.random(GRAINS)], axis=1))

np.save(os.path.join(HERE, "polycrystal.npy"), grains)
with open(os.path.join(HERE, "polycrystal.csv"), "w") as file:
    file.write("grain,phi1 [degrees],Phi [degrees],phi2 [degrees]\n")
    file.writelines("%d,%.2f,%.2f,%.2f\n" % (grain, *of_grain) for grain, of_grain in enumerate(angles))
