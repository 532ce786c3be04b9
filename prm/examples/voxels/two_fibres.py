#!/usr/bin/env python3
"""Writes two_fibres.npy: 20 x 16 x 12 voxels [z][y][x] with a fibre of 1 along x and one along z in a matrix of 0; needs numpy.

two_fibres.py PICTURE.png draws the three sections through the middle as well; needs matplotlib.
"""

import os
import sys

import numpy as np

NX, NY, NZ, RADIUS = 20, 16, 12, 2.6  # voxels
z, y, x = np.indices((NZ, NY, NX)) + 0.5
along_x = np.hypot(y - 5, z - 6) < RADIUS
along_z = np.hypot(y - 11, x - 14) < RADIUS
voxels = (along_x | along_z).astype(np.uint8)
np.save(os.path.join(os.path.dirname(os.path.abspath(__file__)), "two_fibres.npy"), voxels)

if len(sys.argv) > 1:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 3, figsize=(8, 2.6), constrained_layout=True)
    for axis, plane, names in zip(axes, (voxels[NZ // 2], voxels[:, 5], voxels[:, :, 14]), ("xy", "xz", "yz")):
        axis.imshow(plane, origin="lower", cmap="cividis", interpolation="nearest")
        axis.set(xlabel=names[0] + " (voxels)", ylabel=names[1] + " (voxels)")
    figure.savefig(sys.argv[1], dpi=80)
