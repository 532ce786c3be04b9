#!/usr/bin/env python3
"""Writes micrograph.png: grey grains in a darker matrix, with the blur, uneven light and noise of a microscope.

400 x 200 pixels of 0.02 mm, 8 bits a pixel. Grains are discs of 0.3 to 0.9 mm that do not overlap; the picture's edges
cut some of them. Stands in for a micrograph of one's own.
"""

import os

import numpy as np
from PIL import Image
from scipy.ndimage import gaussian_filter

COLUMNS, ROWS, PIXEL = 400, 200, 0.02  # mm
FRACTION, SMALLEST, LARGEST = 0.3, 0.3, 0.9  # diameters in mm


def draw(seed=1):
    """Grey values [ROWS][COLUMNS], the top row first."""
    random = np.random.default_rng(seed)
    x, y = np.meshgrid(PIXEL * (np.arange(COLUMNS) + 0.5), PIXEL * (np.arange(ROWS) + 0.5))
    grain, placed = np.zeros((ROWS, COLUMNS), bool), []
    while grain.mean() < FRACTION:
        centre = random.uniform((0, 0), (PIXEL * COLUMNS, PIXEL * ROWS))
        radius = random.uniform(SMALLEST, LARGEST) / 2
        if all(np.hypot(*(centre - c)) > radius + r + 0.06 for c, r in placed):
            placed.append((centre, radius))
            grain |= np.hypot(x - centre[0], y - centre[1]) < radius
    light = 1 + 0.1 * (x / x.max() - 0.5)
    grey = gaussian_filter(np.where(grain, 170.0, 85.0), 1) * light + random.normal(0, 18, grain.shape)
    return np.clip(np.round(grey), 0, 255).astype("uint8")


if __name__ == "__main__":
    Image.fromarray(draw()).save(os.path.join(os.path.dirname(os.path.abspath(__file__)), "micrograph.png"))
