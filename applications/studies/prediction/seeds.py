"""Ten morphologies of the same statistics and homogeneous pins of the same stiffness: the runs from which rules for the
regularization time of the homogeneous model are judged."""

import os

import numpy as np

from measures import measure
from mixture import write_coarse

SEEDS = tuple(range(1, 11))
DELTA = 1.5e-6
PRESSURES = (5e6, 4e6)  # ten times the printed ones; the fine grid runs the first only
SWEEP = (0.5e-6, 1e-6, 1.25e-6, 1.5e-6, 1.75e-6, 2e-6, 2.5e-6, 3e-6)
CHECKED = (1e-6, 1.5e-6, 2e-6)  # of the sweep, repeated on the grid of the morphologies
FINE, COARSE = (560, 160), (280, 80)
END = 2e-3
EARLY, LATE = (2.5e-4, 1e-3), (1e-3, 2e-3)


def add_morphologies(study, prm, seeds=SEEDS):
    for seed in seeds:
        study.add(f"rve-{seed}", "rve_homogenization", prm, {"Microstructure/Random fibres/Seed": seed})


def add_heterogeneous(study, prm, seeds=SEEDS):
    for seed in seeds:
        study.add(f"het-{seed}", "contact_dynamics", prm,
                  {"Body/RVE file": f"{{rve-{seed}}}/rve.h5", "Top/Pressure": PRESSURES[0], "Time/End time": END,
                   "Friction/Regularization time": DELTA})


def add_coarse(study, prm, results, seeds=SEEDS):
    """The morphologies of finished runs on cells twice as large; also with a ramped start, for growth rates."""
    for seed in seeds:
        made = write_coarse(os.path.join(results[f"rve-{seed}"].folder, "rve.h5"), study.path(f"coarse-map-{seed}"))
        study.add(f"coarse-rve-{seed}", "rve_homogenization", made)
        for pressure in PRESSURES:
            study.add(f"coarse-{seed}-P{pressure / 1e6:g}", "contact_dynamics", prm,
                      {"Body/RVE file": f"{{coarse-rve-{seed}}}/rve.h5", "Top/Pressure": pressure, "Time/End time": END,
                       "Friction/Regularization time": DELTA})


def mean_stiffness(results, prefix="rve", seeds=SEEDS):
    """Mean and standard deviation over the morphologies of D11, D12, D22, D33 (Pa)."""
    all_of_them = np.array([entries(results[f"{prefix}-{seed}"]) for seed in seeds])
    return all_of_them.mean(axis=0), all_of_them.std(axis=0, ddof=1)


def entries(result):
    d = result.summary["stiffness"]["effective"]
    return [d[0][0], d[0][1], d[1][1], d[2][2]]


def homogeneous_settings(stiffness, pressure, delta, cells):
    return {"Body/Stiffness": [float(f"{d:.6g}") for d in stiffness], "Body/Cells": list(cells), "Top/Pressure": pressure,
            "Friction/Regularization time": delta, "Time/End time": END}


def add_homogeneous(study, prm, results, seeds=SEEDS):
    """The mean stiffness over delta; and each morphology's own stiffness at its delta, which shows how far results part
    that differ by the scatter of the stiffness alone."""
    mean, _ = mean_stiffness(results, seeds=seeds)
    for pressure in PRESSURES:
        for delta in SWEEP:
            study.add(hom_name(pressure, delta), "contact_dynamics", prm, homogeneous_settings(mean, pressure, delta, COARSE))
        for seed in seeds:
            study.add(f"own-{seed}-P{pressure / 1e6:g}", "contact_dynamics", prm,
                      homogeneous_settings(entries(results[f"rve-{seed}"]), pressure, DELTA, COARSE))
    for delta in CHECKED:
        study.add(hom_name(PRESSURES[0], delta, fine=True), "contact_dynamics", prm,
                  homogeneous_settings(mean, PRESSURES[0], delta, FINE))


def hom_name(pressure, delta, fine=False):
    return f"hom-P{pressure / 1e6:g}-d{delta * 1e9:g}" + ("-fine" if fine else "")


def collect(results, names):
    """{name: (early, late)} of finished runs."""
    return {name: (measure(results[name].folder, *EARLY), measure(results[name].folder, *LATE)) for name in names
            if name in results and results[name].status == 0}
