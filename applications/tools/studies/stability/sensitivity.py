"""mu_inter, main frequency and slip share of the pin against delta, beta2 and beta, one at a time."""

import numpy as np
import stress

END, STEADY = 3e-3, 2e-3  # s; the limit cycle of the paper's parameters is reached before
BASE = {"Body/Cells": [140, 40], "Time/End time": END, "Observation/Steady from": STEADY, "Time/Time step": 2.5e-8,
        "Observation/Energy interval": 0}
KEYS = {"delta": "Friction/Regularization time", "beta2": "Time/Beta2", "beta": "Time/Rayleigh beta"}
VALUES = {"delta": (0.0, 1e-7, 2.5e-7, 5e-7, 7.5e-7, 1e-6, 1.5e-6, 2e-6, 3e-6, 4e-6),
          "beta2": (0.5, 0.55, 0.6, 0.75, 0.9, 1.0),
          "beta": (0.0, 1.1e-9, 2.2e-9, 4.4e-9, 8.8e-9, 1.76e-8, 4.4e-8)}
PAPER = {"delta": 1.5e-6, "beta2": 0.5, "beta": 4.4e-9}
# The same start to a ten thousandth: limit cycles do not notice, chaotic motion shows its scatter.
STARTS = (0.0, 1e-4, -1e-4)  # m/s
RESULTS = {"mu_inter": "global_interface_friction_coefficient", "main frequency (Hz)": "main_frequency", "slip share": "slip_fraction"}


def run(study):
    """{(parameter, value): {result: (mean, half of the range over the starts)}}."""
    names = {}
    for parameter, values in VALUES.items():
        for number, value in enumerate(values):
            for member, start in enumerate(STARTS):
                names[parameter, value, member] = f"sensitivity/{parameter}-{number}-{member}"
                study.add(names[parameter, value, member], "contact_dynamics", stress.PIN,
                          {**BASE, KEYS[parameter]: value, "Body/Initial velocity": [0, start]})
    results = study.run()
    table = {}
    for parameter, values in VALUES.items():
        for value in values:
            summaries = [results[names[parameter, value, member]].summary for member in range(len(STARTS))]
            table[parameter, value] = {}
            for name, key in RESULTS.items():
                found = np.array([summary[key] for summary in summaries], dtype=float)
                table[parameter, value][name] = (found.mean(), 0.5 * np.ptp(found))
    return table
