"""What the paper's text leaves open, one choice changed at a time from the reading that the project takes."""

from measures import measure
from regime_map import CELLS, start_settings

END = 2e-3
EARLY, LATE = (2.5e-4, 1e-3), (1e-3, 2e-3)
PRESSURE, PRINTED = 5e6, 0.5e6  # ten times the printed pressure of regime 1, and that one
STRONGER = {"Time/Beta2": 1, "Time/Time step": 5e-9}  # the largest beta2 that the paper allows, at its time step

# name: (what is changed, settings)
CHOICES = {
    "reading": ("the reading taken: platen, 5 MPa, at once", {}),
    "printed": ("printed pressure, 0.5 MPa", {"Top/Pressure": PRINTED}),
    "four": ("4 MPa, ten times that of regime 2", {"Top/Pressure": 4e6}),
    "literal": ("pressure on each node of the top, u_x = 0 there", {"Top/Kind": "pressure", "Top/Lateral held": True}),
    "literal-printed": ("the same at the printed pressure",
                        {"Top/Kind": "pressure", "Top/Lateral held": True, "Top/Pressure": PRINTED}),
    "free": ("pressure on each node, u_x free", {"Top/Kind": "pressure"}),
    "held": ("top held from 0.3 ms on", {"Top/Hold from": 3e-4, **start_settings("ramped", PRESSURE)}),
    "ramped": ("pressure ramped in 0.2 ms", start_settings("ramped", PRESSURE)),
    "pressed": ("pressed, then dragged", start_settings("pressed, then dragged", PRESSURE)),
    "struck": ("struck along x at the start", start_settings("struck", PRESSURE)),
    "beta2": ("beta2 = 1 at dt = 5 ns", STRONGER),
    "undamped": ("beta = 0", {"Time/Rayleigh beta": 0}),
    "coulomb": ("delta = 0, plain Coulomb", {"Friction/Regularization time": 0}),
    "rate": ("slip-rate law, L* = 3 micrometres", {"Friction/Law": "slip rate", "Friction/Length": 3e-6,
                                                   "Friction/Reference velocity": 1e-3}),
}


def add_runs(study, prm, confirm=True):
    """All choices on cells of 0.4 mm; the pressures, with `confirm`, also on cells of 0.1 mm."""
    for name, (_, settings) in CHOICES.items():
        study.add(name, "contact_dynamics", prm, {"Body/Cells": list(CELLS), "Top/Pressure": PRESSURE, "Time/End time": END,
                                                  **settings})
    if confirm:
        for name in ("printed", "four"):
            study.add(name + "-fine", "contact_dynamics", prm,
                      {"Body/Cells": [560, 160], "Time/End time": END, **CHOICES[name][1]})


def collect(results):
    """{name: (early, late)}"""
    return {name: (measure(result.folder, *EARLY), measure(result.folder, *LATE)) for name, result in results.items()
            if result.status == 0}
