"""Ten morphologies of the same statistics and homogeneous pins of the same stiffness: the runs from which rules for the
regularization time of the homogeneous model are judged."""

import dataclasses
import os

import numpy as np

from mixture import write_coarse

SEEDS = tuple(range(1, 11))
DELTA = 1.5e-6
SWEEP = (0.5e-6, 1e-6, 1.25e-6, 1.5e-6, 1.75e-6, 2e-6, 2.5e-6, 3e-6)
FINE_SWEEP = (1.25e-6, 1.5e-6, 1.75e-6, 2e-6, 2.5e-6)
FINE, COARSE, COARSER = (560, 160), (280, 80), (140, 40)
END = 2e-3
EARLY, LATE = (2.5e-4, 1e-3), (1e-3, 2e-3)


@dataclasses.dataclass(frozen=True)
class Load:
    """Pressure (Pa), and the velocity along x with which the pin starts (m/s)."""
    key: str
    pressure: float
    push: float

    @property
    def label(self):
        return f"{self.pressure / 1e6:g} MPa, " + (f"pushed at {self.push:g} m/s" if self.push else "from rest")

    @property
    def settings(self):
        start = {"Body/Initial velocity": f"{self.push!r}, 0"} if self.push else {}
        return {"Supports/Top/Pressure": self.pressure, **start}


# The paper's two pressures in the reading of doc/paper, which leads to its regimes 1 and 2; and another reading.
LOADS = (Load("P0.5-pushed", 0.5e6, 0.5), Load("P0.4-pushed", 0.4e6, 0.5), Load("P5", 5e6, 0.))


def other_load(load):
    """The load from which delta* is carried over to `load`."""
    return LOADS[1] if load == LOADS[0] else LOADS[0]


def add_morphologies(study, prm, seeds=SEEDS):
    for seed in seeds:
        study.add(f"rve-{seed}", "rve_homogenization", prm, {"Microstructure/Random fibres/Seed": seed})


def add_coarse(study, prm, results, times, seeds=SEEDS):
    """The morphologies of finished runs on cells twice (`times` = 1) or four times (2) as large."""
    for seed in seeds:
        made = write_coarse(os.path.join(results[f"rve-{seed}"].folder, "rve.h5"), study.path(f"coarse-map-{seed}-{times}"), times)
        study.add(f"coarse-rve-{seed}-{times}", "rve_homogenization", made)
    for load in LOADS:
        for seed in seeds:
            study.add(het_name(seed, load, times), "contact_dynamics", prm, {
                "Body/RVE file": f"{{coarse-rve-{seed}-{times}}}/rve.h5", **load.settings, "Time/End time": END,
                "Friction/Regularization time": DELTA})


def het_name(seed, load, times=0):
    """`times`: how often the cells of the morphology were mixed, four into one."""
    return f"het-{seed}-{load.key}" + (f"-coarse{times}" if times else "")


def own_name(seed, load):
    return f"own-{seed}-{load.key}"


def mean_stiffness(results, prefix="rve", seeds=SEEDS):
    """Mean and standard deviation over the morphologies of D11, D12, D22, D33 (Pa)."""
    all_of_them = np.array([entries(results[f"{prefix}-{seed}"]) for seed in seeds])
    return all_of_them.mean(axis=0), all_of_them.std(axis=0, ddof=1)


def entries(result):
    d = result.summary["stiffness"]["effective"]
    return [d[0][0], d[0][1], d[1][1], d[2][2]]


def homogeneous_settings(stiffness, load, delta, cells):
    return {"Body/Stiffness": [float(f"{d:.6g}") for d in stiffness], "Body/Cells": list(cells),
            **load.settings, "Friction/Regularization time": delta, "Time/End time": END}


def add_homogeneous(study, prm, results, seeds=SEEDS):
    """The mean stiffness over delta; and each morphology's own stiffness at its delta, which shows how far results part
    that differ by the scatter of the stiffness alone."""
    mean, _ = mean_stiffness(results, seeds=seeds)
    for load in LOADS:
        for delta in SWEEP:
            for cells in (COARSE, COARSER):
                study.add(hom_name(load, delta, cells), "contact_dynamics", prm, homogeneous_settings(mean, load, delta, cells))
        for seed in seeds:
            study.add(own_name(seed, load), "contact_dynamics", prm,
                      homogeneous_settings(entries(results[f"rve-{seed}"]), load, DELTA, COARSE))


def fine_runs():
    """{load: (seeds, deltas)} of what is run on the morphologies' own grid: all of the paper's reading, some of the other."""
    return {load: (SEEDS, FINE_SWEEP) if load.push else (SEEDS[:3], (DELTA,)) for load in LOADS}


def add_fine(study, homogeneous, heterogeneous, results):
    """Morphologies on their own grid, and the homogeneous pin there."""
    mean, _ = mean_stiffness(results)
    for load, (seeds, deltas) in fine_runs().items():
        for seed in seeds:
            study.add(het_name(seed, load), "contact_dynamics", heterogeneous,
                      {"Body/RVE file": f"{{rve-{seed}}}/rve.h5", **load.settings, "Time/End time": END,
                       "Friction/Regularization time": DELTA})
        for delta in deltas:
            study.add(hom_name(load, delta, FINE), "contact_dynamics", homogeneous, homogeneous_settings(mean, load, delta, FINE))


def hom_name(load, delta, cells=COARSE):
    return f"hom-{load.key}-d{delta * 1e9:g}" + ("" if cells == COARSE else f"-{cells[0]}")
