#!/usr/bin/env python3
"""Writes phases.png, one grey value for each phase, from micrograph.png: a median filter against the noise, then a threshold; if need be also against
uneven light, and against the rims that smoothed edges leave between three phases. check.png is micrograph.png with the borders of the phases in red:
look at it."""

import os
import sys

import numpy as np
from PIL import Image, ImageFilter
from scipy import ndimage

THRESHOLDS = [127]    # ascending, between the peaks of the histogram of grey values: one less than phases
UNEVEN_LIGHT = 0      # pixels, where parts of the picture are darker: width of a window of some grains, of which one phase fills most; 0: even light
THIN_RIMS = True      # of three phases or more; False where bright and dark lie apart, as grains and pores in a grey matrix: small pores stay


def evened(grey):
    """Divided by the light: the median of a wide window around each pixel, which is the grey of the phase that fills most of it."""
    step = max(1, UNEVEN_LIGHT // 24)  # on coarser pixels, for speed
    coarse = np.asarray(Image.fromarray(grey).reduce(step), dtype=float)
    half = UNEVEN_LIGHT // step // 2
    wide = np.pad(coarse, half, mode="reflect", reflect_type="odd")  # light that falls goes on falling
    inside = tuple(slice(half, half + n) for n in coarse.shape)
    light = ndimage.gaussian_filter(ndimage.median_filter(wide, 2 * half + 1)[inside], half / 3, mode="nearest")
    light = np.asarray(Image.fromarray(light.astype(np.float32)).resize(grey.shape[::-1], Image.BICUBIC))
    return np.clip(grey * (np.median(light) / np.maximum(light, 1)), 0, 255).astype(np.uint8)


def segment(grey):
    """The phases 0, 1, ... of grey values [rows][columns], in ascending order of their grey."""
    filtered = np.asarray(Image.fromarray(grey).filter(ImageFilter.MedianFilter(5)))
    phases = np.searchsorted(THRESHOLDS, evened(filtered) if UNEVEN_LIGHT else filtered).astype(np.uint8)
    if THIN_RIMS and len(THRESHOLDS) > 1:  # the rim between dark and bright is grey, as a third phase is; it is thin
        phases = np.asarray(Image.fromarray(phases).filter(ImageFilter.ModeFilter(9)))
    return phases


def checked(grey, phases):
    """The grey picture with the borders of the phases in red, to be looked at."""
    picture = np.stack([grey] * 3, axis=-1)
    across, up = phases[:, 1:] != phases[:, :-1], phases[1:] != phases[:-1]
    border = np.pad(across, ((0, 0), (0, 1))) | np.pad(up, ((0, 1), (0, 0)))
    picture[border] = (255, 0, 0)
    return picture


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
    grey = grey_of("micrograph.png")
    if isinstance(UNEVEN_LIGHT, bool) or not (UNEVEN_LIGHT == 0 or 8 <= UNEVEN_LIGHT <= min(grey.shape)):
        sys.exit(f"UNEVEN_LIGHT is {UNEVEN_LIGHT}; write the width of a window in pixels, 8 to {min(grey.shape)}, or 0 for even light")
    found = segment(grey)
    Image.fromarray(checked(grey, found)).save("check.png")
    shades = np.array([255 * k // len(THRESHOLDS) for k in range(len(THRESHOLDS) + 1)], dtype=np.uint8)
    Image.fromarray(shades[found]).save("phases.png")
    print("Image values:", ", ".join(map(str, shades)))
    for k, shade in enumerate(shades):
        print(f"{shade}: {np.mean(found == k):.1%} of the pixels, pieces: {ndimage.label(found == k)[1]}")
        if not np.any(found == k):
            print(f"Nothing has the grey of phase {k + 1}: change THRESHOLDS")
