"""What the page on the thickness of the pin reads from its runs."""

import os

import h5py
import numpy as np

RUN_COLUMNS = ["body", "thickness [mm]", "cells [mm]", "P [MPa]", "start [m/s]", "mu_inter [-]", "half width [-]", "main frequency [kHz]",
               "slip [-]", "stick [-]", "separated [-]", "cpu [s]"]


def row(result):
    s = result.summary
    return [s["global_interface_friction_coefficient"], s["global_interface_friction_coefficient_95"], 1e-3 * s["main_frequency"],
            s["slip_fraction"], s["stick_fraction"], s["separation_fraction"], result.cpu_seconds]


def difference(plane, layer, every=1e-4):
    """Largest difference of the displacement (x, z) of node M up to a time, over the largest displacement: rows (ms, ratio)."""
    with h5py.File(os.path.join(plane, "dynamics.h5")) as a, h5py.File(os.path.join(layer, "dynamics.h5")) as b:
        time, u, v = a["reference/time"][:], a["reference/displacement"][:], b["reference/displacement"][:][:, [0, 2]]
    error = np.maximum.accumulate(abs(u - v).max(axis=1)) / abs(u).max()
    return [[1e3 * t, error[np.searchsorted(time, t) - 1]] for t in np.arange(every, time[-1] + every / 2, every)]


def profile(folder, pressure):
    """Mean contact pressure over x by distance from the middle plane, relative to what is half the thickness and to P."""
    with h5py.File(os.path.join(folder, "dynamics.h5")) as file:
        y, p, area = file["contact/position"][:, 1], file["contact/pressure"][:], file["contact/area"][:]
    return [[at / y.max(), np.average(p[y == at], weights=area[y == at]) / pressure] for at in np.unique(y)]


def moduli(summary):
    """Entries across the plane of the stiffness of bars whose phases have Poisson's ratio 0.2, and exactly: under a unit strain along
    the bars all lateral stresses vanish with lateral strains of -0.2, in plane strain sigma_yy = 0.2 (sigma_xx + sigma_zz)."""
    d = np.array(summary["stiffness"]["PBC"]) / 1e9
    share = summary["phases"][1]["volume_fraction"]
    xy, yz = 0.2 * (d[0, 0] + d[0, 2]), 0.2 * (d[0, 2] + d[2, 2])
    return [["xx, yy", d[0, 1], xy], ["yy, zz", d[1, 2], yz], ["yy, yy", d[1, 1], 30 + 210 * share + 0.2 * (xy + yz)],
            ["yz, yz", d[3, 3], None], ["xy, xy", d[5, 5], None]]
