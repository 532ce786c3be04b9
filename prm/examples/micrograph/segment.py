#!/usr/bin/env python3
"""Writes phases.png, black and white, from micrograph.png: a median filter against the noise, then a threshold."""

import os

from PIL import Image, ImageFilter

THRESHOLD = 127  # between the two peaks of the histogram of grey values

if __name__ == "__main__":
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    grey = Image.open("micrograph.png").convert("L").filter(ImageFilter.MedianFilter(5))
    grey.point(lambda g: 255 if g > THRESHOLD else 0).save("phases.png")
