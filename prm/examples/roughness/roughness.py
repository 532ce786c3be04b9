#!/usr/bin/env python3
"""Writes profile.csv: a random profile of 10 mm as from a stylus, which repeats itself. Its waves of the lengths 10 mm / n,
n = 2 to 12, have amplitudes in proportion to 1/n and random phases; the root mean square height is 0.3 um."""

import csv
import os

import numpy as np

LENGTH, SPACING, RMS = 10e-3, 5e-5, 3e-7  # m

x = np.arange(round(LENGTH / SPACING) + 1) * SPACING
n = np.arange(2, 13)
phase = np.random.default_rng(7).uniform(0, 2 * np.pi, n.size)
height = (np.cos(2 * np.pi * n[:, None] * x / LENGTH + phase[:, None]) / n[:, None]).sum(axis=0)
height *= RMS / np.sqrt(np.mean(height[:-1]**2))

path = os.path.join(os.path.dirname(os.path.abspath(__file__)), "profile.csv")
with open(path, "w", newline="", encoding="utf-8") as file:
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(["x [m]", "height [m]"])
    writer.writerows([f"{a:.6g}", f"{h:.4g}"] for a, h in zip(x, height))
