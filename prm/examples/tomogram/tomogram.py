#!/usr/bin/env python3
"""Writes tomogram.npy: grey grains in a darker matrix, with the blur and noise of a scan, and a rim of dark air around the sample.

64 x 36 x 44 voxels of 0.05 mm, 8 bits a voxel, as [z][y][x]; the outermost 4 voxels of each side are air. Grains are spheres of 0.5 to 0.8 mm
that do not overlap, more of them towards large z; faces of the sample cut some. Stands in for a scan of one's own.
"""

import os

import numpy as np
from scipy.ndimage import gaussian_filter

SHAPE, RIM = (44, 36, 64), 4  # voxels along z, y, x
FRACTION, SMALLEST, LARGEST = 0.25, 10, 16  # of the sample; diameters in voxels


def draw(seed=3):
    """Grey values [z][y][x]."""
    random = np.random.default_rng(seed)
    at = np.stack(np.indices(SHAPE), axis=-1) + 0.5
    sample = np.zeros(SHAPE, bool)
    sample[RIM:-RIM, RIM:-RIM, RIM:-RIM] = True
    grain, placed = np.zeros(SHAPE, bool), []
    while grain[sample].mean() < FRACTION:
        centre = random.random(3) ** (0.7, 1, 1) * SHAPE
        radius = random.uniform(SMALLEST, LARGEST) / 2
        if all(np.linalg.norm(centre - c) > radius + r + 1.5 for c, r in placed):
            placed.append((centre, radius))
            grain |= np.linalg.norm(at - centre, axis=-1) < radius
    grey = gaussian_filter(np.where(sample, np.where(grain, 170.0, 85.0), 20.0), 0.7) + random.normal(0, 18, SHAPE)
    return np.clip(np.round(grey), 0, 255).astype("uint8")


if __name__ == "__main__":
    np.save(os.path.join(os.path.dirname(os.path.abspath(__file__)), "tomogram.npy"), draw())
