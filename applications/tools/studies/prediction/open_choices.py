"""What the paper's text leaves open, one choice changed at a time from 5 MPa, a pin that starts from rest."""

import os

import h5py
import numpy as np

from measures import measure
from regime_map import CELLS, start_settings

END = 2e-3
EARLY, LATE = (2.5e-4, 1e-3), (1e-3, 2e-3)
PRESSURE, PRINTED = 5e6, 0.5e6  # ten times the printed pressure of regime 1, and that one
PUSHED = {"Body/Initial velocity": "0.5, 0"}
STRONGER = {"Time/Beta2": 1, "Time/Time step": 5e-9}  # the largest beta2 that the paper allows, at its time step

# name: (what is changed, settings)
CHOICES = {
    "reading": ("platen, 5 MPa, from rest, at once", {}),
    "printed": ("printed pressure, 0.5 MPa", {"Supports/Top/Pressure": PRINTED}),
    "four": ("4 MPa, ten times that of regime 2", {"Supports/Top/Pressure": 4e6}),
    "printed-pushed": ("0.5 MPa, pushed at 0.5 m/s", {"Supports/Top/Pressure": PRINTED, **PUSHED}),
    "lower-pushed": ("0.4 MPa, pushed at 0.5 m/s", {"Supports/Top/Pressure": 0.4e6, **PUSHED}),
    "literal": ("pressure on each node of the top, u_x = 0 there", {"Supports/Top/Kind": "pressure", "Supports/Top/Held": "u_x"}),
    "literal-printed": ("the same at the printed pressure",
                        {"Supports/Top/Kind": "pressure", "Supports/Top/Held": "u_x", "Supports/Top/Pressure": PRINTED}),
    "free": ("pressure on each node, u_x free", {"Supports/Top/Kind": "pressure"}),
    "held": ("top held from 0.3 ms on", {"Supports/Top/Hold from": 3e-4, **start_settings("ramped", PRESSURE)}),
    "ramped": ("pressure ramped in 0.2 ms", start_settings("ramped", PRESSURE)),
    "pressed": ("pressed, then dragged", start_settings("pressed, then dragged", PRESSURE)),
    "struck": ("struck along x at the start", start_settings("struck", PRESSURE)),
    "beta2": ("beta2 = 1 at dt = 5 ns", STRONGER),
    "undamped": ("beta = 0", {"Time/Rayleigh beta": 0}),
    "coulomb": ("delta = 0, plain Coulomb", {"Friction/Regularization time": 0}),
    "rate": ("slip-rate law, L* = 3 micrometres", {"Friction/Law": "slip rate", "Friction/Length": 3e-6,
                                                   "Friction/Reference velocity": 1e-3}),
}


def add_runs(study, prm, confirm=False):
    """All choices on cells of 0.4 mm; the pressures, with `confirm`, also on cells of 0.1 mm."""
    for name, (_, settings) in CHOICES.items():
        study.add(name, "contact_dynamics", prm, {"Body/Cells": list(CELLS), "Supports/Top/Pressure": PRESSURE, "Time/End time": END,
                                                  **settings})
    if confirm:
        for name in ("printed", "four"):
            study.add(name + "-fine", "contact_dynamics", prm,
                      {"Body/Cells": [560, 160], "Time/End time": END, **CHOICES[name][1]})


def collect(results):
    """{name: (early, late)}"""
    return {name: (measure(results[name].folder, *EARLY), measure(results[name].folder, *LATE)) for name in results
            if name.split("-fine")[0] in CHOICES and results[name].status == 0}


FIBRES = "Microstructure/Random fibres/"
# name: (what is changed, settings); each over PLACEMENT_SEEDS
PLACEMENTS = {
    "taken": ("independent, 10 % nominal, cut by the border (taken)", {}),
    "actual": ("no overlap, 10 % actual, cut by the border",
               {FIBRES + "Fraction rule": "actual", FIBRES + "Allow overlap": False}),
    "inside": ("independent, 10 % nominal, all fibres inside", {FIBRES + "Cut by border": False}),
    "wide": ("the same as taken with fibres of 0.2 mm", {FIBRES + "Fibre width": 2e-4}),
}
PLACEMENT_SEEDS = (1, 2, 3, 4)
PAPER_STIFFNESS = np.array([36.54e9, 9.1e9, 47.26e9, 13.785e9])  # eq. (10)


def add_placements(study, prm):
    for name, (_, settings) in PLACEMENTS.items():
        for seed in PLACEMENT_SEEDS:
            study.add(f"placement-{name}-{seed}", "rve_homogenization", prm, {FIBRES + "Seed": seed, **settings})


def placements(results):
    """{name: (covered area, covered contact line, relative differences of D11, D12, D22, D33 from eq. (10))}, means over
    the seeds."""
    found = {}
    for name in PLACEMENTS:
        done = [results[f"placement-{name}-{s}"] for s in PLACEMENT_SEEDS if results[f"placement-{name}-{s}"].status == 0]
        fibre = [_fibre_cells(r.folder) for r in done]
        d = np.array([r.summary["stiffness"]["effective"] for r in done])
        values = np.stack([d[:, 0, 0], d[:, 0, 1], d[:, 1, 1], d[:, 2, 2]], axis=-1).mean(axis=0)
        found[name] = (np.mean([f.mean() for f in fibre]), np.mean([f[0].mean() for f in fibre]), values / PAPER_STIFFNESS - 1)
    return found


def _fibre_cells(folder):
    with h5py.File(os.path.join(folder, "rve.h5"), "r") as file:
        return file["phase/id"][:] == 1
