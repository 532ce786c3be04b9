#!/usr/bin/env python3
"""Writes phases.npy, 0 for the matrix and 1 for the grains, from the grey values in tomogram.npy: a median filter against the noise, then a threshold.
check.png is the slice in the middle with the borders of the phases in red: look at it."""

import os

import numpy as np
from PIL import Image
from scipy import ndimage

THRESHOLDS = [127]  # ascending, between the peaks of the histogram of grey values: one less than phases


def segment(grey):
    """The phases 0, 1, ... of grey values [z][y][x], in ascending order of their grey."""
    return np.searchsorted(THRESHOLDS, ndimage.median_filter(grey, 3), side="right").astype(np.uint8)


def checked(grey, phases):
    """A slice with the borders of its phases in red."""
    picture = np.stack([grey] * 3, axis=-1)
    across, up = phases[:, 1:] != phases[:, :-1], phases[1:] != phases[:-1]
    picture[np.pad(across, ((0, 0), (0, 1))) | np.pad(up, ((0, 1), (0, 0)))] = (255, 0, 0)
    return picture


if __name__ == "__main__":
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    scan = np.load("tomogram.npy")
    found, middle = segment(scan), len(scan) // 2
    Image.fromarray(checked(scan[middle], found[middle])).resize((4 * scan.shape[2], 4 * scan.shape[1]), Image.NEAREST).save("check.png")
    np.save("phases.npy", found)
    for k in range(len(THRESHOLDS) + 1):
        print(f"{k}: {np.mean(found == k):.1%} of the voxels, pieces: {ndimage.label(found == k)[1]}")
