"""Single precision against double, in turns: time steps a second and what becomes of mu_inter, shares of the contact, frequency, energies and growth."""

from common import prm, require_ended
from fits import median

REPETITIONS = 3
# The stiffness of eq. (10), in Pa: with it the pin stays in its limit cycle (doc/paper/reading.md).
PIN = {"Body/Stiffness": [36.54e9, 9.1e9, 47.26e9, 13.785e9], "Body/Density": 1770, "Body/Size": [0.056, 0.016], "Body/RVE file": "",
       "Observation/Steady from": "auto", "Observation/Stop at limit cycle": False, "Snapshots/To": "auto", "Snapshots/Interval": 0}
HOMOGENEOUS, HETEROGENEOUS = "pin/20-contact_dynamics-homogeneous.prm", "pin/30-contact_dynamics-heterogeneous.prm"
SCENES = {
    "pin, pushed": (HOMOGENEOUS, {**PIN, "Body/Cells": [140, 40], "Time/End time": 8e-3}),
    "pin from rest, 5 MPa": (HOMOGENEOUS, {**PIN, "Body/Cells": [140, 40], "Time/End time": 8e-3, "Supports/Top/Pressure": 5e6,
                                           "Body/Initial velocity": [0, 0]}),
    "pin, fine": (HOMOGENEOUS, {**PIN, "Body/Cells": [560, 160], "Time/End time": 1e-3}),
    "pin with fibres": (HETEROGENEOUS, {"Body/RVE file": "{rve}/rve.h5", "Body/Cells": [560, 160], "Time/End time": 1e-4, "Observation/Steady from": "auto",
                                        "Observation/Stop at limit cycle": False, "Snapshots/From": 0, "Snapshots/To": "auto", "Snapshots/Interval": 0}),
    "stick-slip on springs": ("examples/tribometer.prm", {}),
    "rough pin": ("examples/rough_pin.prm", {}),
    "slip weakening": ("examples/friction_laws/slip_weakening.prm", {}),
}
KEYS = {"mu_inter": "global_interface_friction_coefficient", "half_width": "global_interface_friction_coefficient_95", "slip": "slip_fraction",
        "stick": "stick_fraction", "separated": "separation_fraction", "frequency_hz": "main_frequency", "energy_residual": "energy_balance_residual"}


def run(bench):
    study = bench.study("precision")
    study.jobs = 1  # times count
    size = {"Grid/Cells": [70, 20], "Microstructure/Random fibres/Fibre width": 8e-4} if bench.quick else {}
    study.add("rve", "rve_homogenization", prm("pin/10-rve_homogenization.prm"), size)
    scenes = {name: SCENES[name] for name in list(SCENES)[:1]} if bench.quick else SCENES
    turns = range(1 if bench.quick else REPETITIONS)
    for turn in turns:
        for name, (file, settings) in scenes.items():
            for precision in ("double", "single"):
                shorter = {"Time/End time": 2e-4} if bench.quick else {}
                study.add(run_name(name, precision, turn), "contact_dynamics", prm(file), {**settings, **shorter, "Time/Precision": precision})
    results = study.run()
    require_ended(results)
    rows = [row_of(name, precision, turns, results) for name in scenes for precision in ("double", "single")]
    bench.write("precision", rows, "plane bodies in double and single precision (Time/Precision): million cell updates a second of the time loop, median; "
                "ratio to double in the same turn, median; half_width: of mu_inter, 95 %; rounding: share of the largest strain", repetitions=len(turns))


def run_name(name, precision, turn):
    return f"{name}-{precision}-{turn + 1}".replace(" ", "_").replace(",", "")


def row_of(name, precision, turns, results):
    def speeds(of):
        return [1e-6 * results[run_name(name, of, turn)].summary["cell_updates_per_second"] for turn in turns]

    summary = results[run_name(name, precision, 0)].summary
    found = speeds(precision)
    return {"scene": name, "precision": precision, "cells": summary["cells"], "steps": summary["steps"], "million_cells_per_s": median(found),
            "ratio": median([a / b for a, b in zip(found, speeds("double"))]), **{key: summary[path] for key, path in KEYS.items()},
            "rounding": summary["single_precision_rounding"] or 0.0}
