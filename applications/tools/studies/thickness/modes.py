"""Modes of the whole pin with the bottom held in z, and of its half, which has those symmetric about the middle plane alone."""

import csv
import math
import os

from settings import TOP, prm

MODE_COLUMNS = ["thickness [mm]", "first out of plane [kHz]", "clamped and guided beam [kHz]", "shear along x [kHz]",
                "out of plane below it", "modes computed"]
CELLS = {0.5: (112, 2, 32), 1: (56, 4, 16), 2: (56, 4, 16), 4: (56, 4, 16), 8: (56, 8, 16)}
HEIGHT, DENSITY = 16e-3, 1770  # m, kg/m^3
# Of the stiffness in 40-contact_dynamics-modes.prm along z with sigma_yy = 0 and, in a wide pin, eps_xx = 0.
MODULUS = 47.26e9 - 11.272e9**2 / 55.08e9  # Pa


def add_modes(study):
    for thickness, (nx, ny, nz) in CELLS.items():
        for half, name in ((1, "full"), (2, "half")):
            study.add(f"modes-{name}-{thickness:g}mm", "contact_dynamics", prm("40-contact_dynamics-modes"), {
                "Body/Size": (56e-3, thickness * 1e-3 / half, HEIGHT), "Body/Cells": (nx, ny // half, nz),
                **({"Supports/Front/Held": "u_y", "Modal/Number of modes": 3} if half == 2 else {})})
    study.add("modes-plane", "contact_dynamics", os.path.join(TOP, "prm", "paper", "20-contact_dynamics-modes.prm"), {
        "Modal/Bottom": "held in y", "Modal/Number of modes": 2, "Body/Cells": (112, 32)})


def listed(folder):
    """(frequency in kHz, effective masses along the axes) of each mode."""
    with open(os.path.join(folder, "modes.csv"), encoding="utf-8") as file:
        return [(float(r["frequency [Hz]"]) / 1e3, [float(v) for k, v in r.items() if k.startswith("effective_mass")]) for r in csv.DictReader(file)]


def beam(thickness):
    """First frequency (kHz) of a thin beam along z, clamped at its top, whose lower end moves across and does not turn."""
    return 2.36502**2 / (2 * math.pi) * thickness * 1e-3 / HEIGHT**2 * math.sqrt(MODULUS / 12 / DENSITY) / 1e3


def mode_rows(results):
    """Out of plane are the modes of the whole pin that its half has not."""
    rows = []
    for thickness in CELLS:
        full, half = (listed(results[f"modes-{name}-{thickness:g}mm"].folder) for name in ("full", "half"))
        symmetric = [f for f, _ in half]
        shear = max(half, key=lambda mode: mode[1][0])[0]
        across = [f for f, _ in full if f < shear * (1 - 1e-5) and min(abs(f / s - 1) for s in symmetric) > 1e-5]
        rows.append([thickness, min(across, default=None), beam(thickness), shear, len(across), len(full)])
    return rows + [["plane strain", None, None, max(listed(results["modes-plane"].folder), key=lambda mode: mode[1][0])[0], None, None]]
