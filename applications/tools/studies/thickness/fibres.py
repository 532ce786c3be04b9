"""Pins of 2 mm with every fibre, in 3D and in plane strain, and their homogenized counterparts."""

import os

import h5py
import numpy as np

from settings import LOADS, STARTS, TOP, loading, prm

PAPER, PLANE = "paper-rve", "plane_fibres-rve"
FIBRE_COLUMNS = ["body", "material", "cells [mm]", "P [MPa]", "start [m/s]"]
# Body: its homogenization, its file and dimension, further settings and cells in the plane and across it.
BODIES = {"plane strain": (PLANE, "21-contact_dynamics-plane_fibres", 2, {}),
          "long bars": ("long_bars-rve", "31-contact_dynamics-short_bars", 3, {"Supports/Front/Held": "u_y"}),
          "short bars": ("short_bars-rve", "31-contact_dynamics-short_bars", 3, {})}
FINE_LAYERS = 2  # cells of 0.1 mm across half the pin
FINE_BODIES = {"plane strain": (PAPER, "21-contact_dynamics-plane_fibres", 2, {}),
               "long bars": ("fine_bars-rve", "31-contact_dynamics-short_bars", 3, {"Supports/Front/Held": "u_y"})}


def add_plane_morphologies(study):
    study.add(PAPER, "rve_homogenization", os.path.join(TOP, "prm", "paper", "10-rve_homogenization.prm"), {
        "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC", "Homogenization/Write concentration": False})
    study.add(PLANE, "rve_homogenization", prm("11-rve_homogenization-plane_fibres"))


def extrude(run, path, layers):
    """Repeats the phases of a run in the plane across it and keeps a file that has them already."""
    with h5py.File(os.path.join(run, "rve.h5")) as file:
        phases = np.repeat(file["phase/id"][:][:, None, :], layers, axis=1)
    if not (os.path.exists(path) and np.array_equal(np.load(path), phases)):
        np.save(path, phases)


def add_runs(study):
    """{name: (body, material, spacing, load, start)}"""
    study.add("long_bars-rve", "rve_homogenization", prm("10-rve_homogenization-long_bars"), {
        "Grid/Cells": (112, 2, 32), "Grid/Size": (56e-3, 1e-3, 16e-3), "Microstructure/File": f"{{{PLANE}}}/long_bars.npy"})
    study.add("short_bars-rve", "rve_homogenization", prm("12-rve_homogenization-short_bars"))
    return _add(study, BODIES, "", 0.5, LOADS, STARTS)


def add_fine_runs(study):
    """The paper's fibres, 0.1 mm wide, as bars through a thin pin, one start; as add_runs."""
    study.add("fine_bars-rve", "rve_homogenization", prm("10-rve_homogenization-long_bars"), {
        "Grid/Cells": (560, FINE_LAYERS, 160), "Grid/Size": (56e-3, FINE_LAYERS * 1e-4, 16e-3), "Microstructure/File": f"{{{PAPER}}}/long_bars.npy"})
    return _add(study, FINE_BODIES, "fine_", 0.1, LOADS, STARTS[1:2])


def _add(study, bodies, prefix, spacing, loads, starts):
    runs = {}
    for body, (rve, file, dimension, settings) in bodies.items():
        for material in ("heterogeneous", "homogeneous"):
            for load in loads:
                for start in starts:
                    name = f"{prefix}{body.replace(' ', '_')}-{material}-{load:g}MPa-{start:g}"
                    study.add(name, "contact_dynamics", prm(file), {
                        **settings, "Body/RVE file": f"{{{rve}}}/rve.h5", "Body/Material": material, **loading(load, start, dimension)})
                    runs[name] = (body, material, spacing, load, start)
    return runs
