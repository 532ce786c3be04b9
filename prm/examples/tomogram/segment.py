#!/usr/bin/env python3
"""Writes phases.npy, 0 for the matrix and 1 for the grains, from the grey values in tomogram.npy: a median filter against the noise, then a threshold."""

import os

import numpy as np
from scipy import ndimage

THRESHOLDS = [127]  # ascending, between the peaks of the histogram of grey values: one less than phases


def segment(grey):
    """The phases 0, 1, ... of grey values [z][y][x], in ascending order of their grey."""
    return np.searchsorted(THRESHOLDS, ndimage.median_filter(grey, 3), side="right").astype(np.uint8)


if __name__ == "__main__":
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    found = segment(np.load("tomogram.npy"))
    np.save("phases.npy", found)
    for k in range(len(THRESHOLDS) + 1):
        print(f"{k}: {np.mean(found == k):.1%} of the voxels, pieces: {ndimage.label(found == k)[1]}")
