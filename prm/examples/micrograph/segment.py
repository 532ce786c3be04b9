#!/usr/bin/env python3
"""Writes phases.png, one grey value for each phase, from micrograph.png: a median filter against the noise, then a threshold; if need be also against
uneven light, and against the rims that smoothed edges leave between three phases."""

import os
import sys

import numpy as np
from PIL import Image, ImageFilter
from scipy import ndimage

THRESHOLDS = [127]    # ascending, between the peaks of the histogram of grey values: one less than phases
UNEVEN_LIGHT = False  # True: the picture is darker at one side
THIN_RIMS = True      # of three phases or more; False where bright and dark lie apart, as grains and pores in a grey matrix: small pores stay


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
    if THIN_RIMS and len(THRESHOLDS) > 1:  # the rim between dark and bright is grey, as a third phase is; it is thin
        phases = np.asarray(Image.fromarray(phases).filter(ImageFilter.ModeFilter(9)))
    return phases


def grey_of(name):
    """The grey values 0 to 255 of a picture, those of 16 bits divided by 256."""
    picture = Image.open(name)
    if picture.mode.startswith("I"):
        return (np.asarray(picture) >> 8).astype(np.uint8)
    return np.asarray(picture.convert("L"))


if __name__ == "__main__":
    os.chdir(os.path.dirname(os.path.abspath(__file__)))
    if not isinstance(THRESHOLDS, list) or sorted(set(THRESHOLDS)) != THRESHOLDS or not THRESHOLDS:
        sys.exit(f"THRESHOLDS is {THRESHOLDS}; write grey values in brackets, ascending, such as [100, 160]")
    if not os.path.exists("micrograph.png"):
        sys.exit("there is no micrograph.png beside this script; copy the grey picture there")
    found = segment(grey_of("micrograph.png"))
    shades = np.array([255 * k // len(THRESHOLDS) for k in range(len(THRESHOLDS) + 1)], dtype=np.uint8)
    Image.fromarray(shades[found]).save("phases.png")
    print("Image values:", ", ".join(map(str, shades)))
    for k, shade in enumerate(shades):
        print(f"{shade}: {np.mean(found == k):.1%} of the pixels, pieces: {ndimage.label(found == k)[1]}")
        if not np.any(found == k):
            print(f"Nothing has the grey of phase {k + 1}: change THRESHOLDS")
