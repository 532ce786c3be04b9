#!/usr/bin/env python3
"""Writes phases.png, one grey value for each phase, from micrograph.png: a median filter against the noise, then a threshold; if need be also against
uneven light, and against the rims that smoothed edges leave between three phases."""

import os

import numpy as np
from PIL import Image, ImageFilter
from scipy import ndimage

THRESHOLDS = [127]    # ascending, between the peaks of the histogram of grey values: one less than phases
UNEVEN_LIGHT = False  # True: the picture is darker at one side


def evened(grey):
    """Divided by the plane that fits the grey values of the most frequent phase."""
    x, y = np.meshgrid(np.linspace(-1, 1, grey.shape[1]), np.linspace(-1, 1, grey.shape[0]))
    terms = np.stack([np.ones(grey.size), x.ravel(), y.ravel()], axis=1)
    values = grey.ravel().astype(float)
    peak = np.argmax(np.convolve(np.bincount(grey.ravel(), minlength=256), np.ones(9), mode="same"))
    light = np.full(grey.size, float(peak))
    for _ in range(10):
        near = np.abs(values / light - 1) < 0.25
        plane = np.linalg.lstsq(terms[near], values[near], rcond=None)[0]
        light = terms @ plane
    return np.clip(values * plane[0] / light, 0, 255).reshape(grey.shape).astype(np.uint8)


def segment(grey):
    """The phases 0, 1, ... of grey values [rows][columns], in ascending order of their grey."""
    filtered = np.asarray(Image.fromarray(grey).filter(ImageFilter.MedianFilter(5)))
    phases = np.searchsorted(THRESHOLDS, evened(filtered) if UNEVEN_LIGHT else filtered).astype(np.uint8)
    if len(THRESHOLDS) > 1:  # the rim between dark and bright is grey, as a third phase is; it is thin
        phases = np.asarray(Image.fromarray(phases).filter(ImageFilter.ModeFilter(9)))
    return phases


if __name__ == "__main__":
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    found = segment(np.asarray(Image.open("micrograph.png").convert("L")))
    shades = np.array([255 * k // len(THRESHOLDS) for k in range(len(THRESHOLDS) + 1)], dtype=np.uint8)
    Image.fromarray(shades[found]).save("phases.png")
    print("Image values:", ", ".join(map(str, shades)))
    for k, shade in enumerate(shades):
        print(f"{shade}: {np.mean(found == k):.1%} of the pixels, pieces: {ndimage.label(found == k)[1]}")
