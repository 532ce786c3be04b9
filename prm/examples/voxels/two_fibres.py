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
    from matplotlib.patches import Patch

    figure, axes = plt.subplots(1, 3, figsize=(7, 2.5), gridspec_kw={"width_ratios": (NX, NX, NY)})
    figure.subplots_adjust(left=0.08, right=0.99, bottom=0.14, top=0.84, wspace=0.32)
    sections = (("z = 6", "x", "y", voxels[6]), ("y = 5", "x", "z", voxels[:, 5]), ("x = 14", "y", "z", voxels[:, :, 14]))
    for axis, (title, across, up, plane) in zip(axes, sections):
        ny, nx = plane.shape
        axis.imshow(plane, origin="lower", cmap="cividis", interpolation="nearest", extent=(0, nx, 0, ny), vmin=0, vmax=1)
        axis.set(xlabel=f"{across} (voxels)", ylabel=f"{up} (voxels)", xticks=range(0, nx + 1, 4), yticks=range(0, ny + 1, 4))
        axis.set_title(title, loc="left", fontsize=11)
    colours = plt.get_cmap("cividis")
    figure.legend(handles=[Patch(color=colours(0.0), label="0, matrix"), Patch(color=colours(1.0), label="1, fibre")], loc="upper left",
                  ncols=2, frameon=False)
    figure.savefig(sys.argv[1], dpi=110)
