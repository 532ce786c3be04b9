"""Result folders like those of the programs, written without them, as input of reports."""

import json
import os
import shutil

import h5py
import numpy as np

from scenes import Folder, prm

NX, NY, H = 140, 40, 4e-4
FREQUENCY = 41321.0


def write(folder, name, summary, datasets, attributes=None):
    Folder(folder).write("summary.json", json.dumps(summary))
    with h5py.File(os.path.join(folder, name), "w") as file:
        grid = file.create_group("grid")
        grid.attrs["cells"], grid.attrs["spacing"], grid.attrs["origin"] = [NX, NY], [H, H], [0.0, 0.0]
        for path, data in datasets.items():
            file[path] = data
        for path, (key, value) in (attributes or {}).items():
            file[path].attrs[key] = value


def add_to_summary(folder, **more):
    Folder(folder).write("summary.json", json.dumps({**Folder(folder).summary(), **more}))


def morphology():
    random = np.random.default_rng(4)
    ids = np.zeros((NY, NX), dtype=np.int32)
    while ids.mean() < 0.1:
        x, y, n = random.integers(NX), random.integers(-5, NY), random.integers(3, 9)
        ids[max(y, 0):max(y + n, 0), x] = 1
    return ids


def plane_strain(e, nu=0.2):
    f = e / ((1 + nu) * (1 - 2 * nu))
    return f * np.array([[1 - nu, nu, 0], [nu, 1 - nu, 0], [0, 0, (1 - 2 * nu) / 2]])


def write_rve(folder, ids):
    effective = 1e9 * np.array([[36.9, 9.2, 0], [9.2, 48.0, 0], [0, 0, 13.8]])
    random = np.random.default_rng(1)
    concentration = np.eye(3) + 0.1 * random.standard_normal((NY, NX, 3, 3)) - 0.5 * ids[..., None, None] * np.eye(3)
    write(folder, "rve.h5",
          {"program": "rve_homogenization", "version": "0.2.0", "dim": 2, "cells": [NX, NY], "dofs": 11562,
           "ranks": 1, "seconds": {"total": 12.3}, "peak_memory_bytes": 2.1e8,
           "phases": [{"name": "matrix", "volume_fraction": 0.9}, {"name": "fibre", "volume_fraction": 0.1}],
           "hill_mandel_residual": 3e-12, "symmetry_residual": 1e-13},
          {"/phase/id": ids, "/phase/name": np.array([b"matrix", b"fibre"]),
           "/phase/stiffness": np.array([plane_strain(30e9), plane_strain(240e9)]),
           "/stiffness/KUBC": effective, "/stiffness/SUBC": 0.98 * effective,
           "/stiffness/effective": 0.99 * effective, "/concentration/KUBC": concentration})


def write_dynamics(folder, ids, heterogeneous):
    random = np.random.default_rng(2 + heterogeneous)
    time = np.arange(20001) * 5e-8
    w = 2 * np.pi * FREQUENCY
    grown = 1 / (1 + np.exp(-(time - 2e-4) / 3e-5))
    wave = np.sin(w * time) + 0.25 * np.sin(2 * w * time) + 0.12 * np.cos(3 * w * time)
    rate = np.cos(w * time) + 0.5 * np.cos(2 * w * time) - 0.36 * np.sin(3 * w * time)
    u, v = 3e-6 * grown * wave, 3e-6 * w * grown * rate
    friction = 0.22 - 0.03 * heterogeneous * grown + 0.6 * grown * wave
    energy = np.concatenate([[0], np.cumsum(56e3 * 0.22 * (1 + 0.3 * grown[1:] * wave[1:]) * 5e-8)])
    x = np.arange(NX + 1) * H
    separated = 0.3 + 0.2 * np.cos(6 * np.pi * x / x[-1])
    stick = np.full_like(x, 0.05)
    blocks = np.arange(1, 81) * 1.25e-5
    moving = np.clip(separated + 0.3 * np.sin(2 * np.pi * blocks[:, None] / 9e-5 + 90 * x), 0, 0.95)
    frequency = np.linspace(0, 1e7, 20001)
    line = lambda f, a: a / (1 + ((frequency - f) / 700) ** 2)
    amplitude = line(FREQUENCY, 3e-6) + line(2 * FREQUENCY, 8e-7) + line(3 * FREQUENCY, 4e-7)
    nodes = np.zeros((2, NY + 1, NX + 1, 2))
    nodes[:, :, :, 1] = -1e-7 * np.arange(NY + 1)[None, :, None] / NY
    nodes[:, :, :, 0] = 1e-6 * np.sin(np.pi * np.arange(NX + 1) / NX) * (1 - np.arange(NY + 1) / NY)[:, None]
    data = {
        "/history/time": time, "/history/apparent_friction": friction, "/history/friction_energy": energy,
        "/energy/time": time, "/energy/friction": energy, "/energy/external_work": 1.25 * energy,
        "/energy/kinetic": 0.4 * grown * (1 + wave**2), "/energy/elastic": 0.5 * grown * (1 + rate**2),
        "/energy/damping": 0.1 * energy, "/energy/scheme": 0.06 * energy, "/energy/impact": 0.02 * energy,
        "/energy/residual": 1e-11 * random.standard_normal(len(time)),
        "/probes/M/time": time, "/probes/M/displacement": np.stack([u, 1e-7 * wave], axis=1),
        "/probes/M/velocity": np.stack([v, 0 * v], axis=1),
        # The normal motion is 50 degrees ahead; friction swings with the velocity.
        "/reference/time": time, "/reference/displacement": np.stack([u, 1e-6 * grown * np.sin(w * time + np.radians(50))], axis=1),
        "/reference/velocity": np.stack([v, 0 * v], axis=1), "/reference/traction": np.stack([1e6 + 1e5 * np.cos(w * time), 0 * v], axis=1),
        "/contact/x": x, "/contact/separated": separated, "/contact/stick": stick,
        "/contact/slip": 1 - separated - stick, "/contact/blocks/time": blocks,
        "/contact/blocks/separated": moving, "/contact/blocks/stick": 0.05 * np.ones_like(moving),
        "/contact/blocks/slip": 0.95 - moving, "/spectrum/frequency": frequency,
        "/spectrum/amplitude": amplitude * (1 + 0.3 * random.random(len(frequency))) + 1e-11,
        "/phase_diagram/displacement": 3e-6 * wave[-484:] * (1 - 0.1 * heterogeneous),
        "/phase_diagram/velocity": 3e-6 * w * rate[-484:] * (1 - 0.1 * heterogeneous),
        "/snapshots/time": np.array([5e-4, 1e-3]), "/snapshots/displacement": nodes}
    if heterogeneous:
        data["/material/phase_id"] = ids
        data["/material/name"] = np.array([b"matrix", b"fibre"])
        data["/material/stiffness"] = np.array([plane_strain(30e9), plane_strain(240e9)])
    write(folder, "dynamics.h5",
          {"program": "contact_dynamics", "version": "0.2.0", "dim": 2, "cells": [NX, NY], "analysis": "transient",
           "steps": 20000, "time_step": 5e-8, "critical_time_step": 7e-8, "simulated_time": 1e-3,
           "seconds": {"total": 31.0}, "peak_memory_bytes": 9.1e7,
           "global_interface_friction_coefficient": 0.219 - 0.005 * heterogeneous,
           "mean_apparent_friction_coefficient": 0.221 - 0.006 * heterogeneous, "main_frequency": FREQUENCY,
           "reference_node": {"slip": 0.72, "stick": 0.0, "separation": 0.28}, "friction_energy": energy[-1],
           "regime": "slip-separation, regime 1 (mostly slipping)", "energy_balance_residual": 2e-12,
           "steady_from": 3e-4}, data, {"/probes/M": ("position", [0.028, 0.0])})


def write_localization(folder, ids):
    random = np.random.default_rng(9)
    time = np.arange(5001) * 2e-7
    data, positions = {}, {}
    for name, scale, place in [("A", 2e6, [0.0281, 0.0001]), ("B", 4e5, [0.02, 0.008])]:
        wave = np.sin(2 * np.pi * FREQUENCY * time)
        direct = scale * np.stack([0.2 * wave, -1 + wave + 0.2 * wave**2, 0.3 * wave], axis=1)
        data[f"/probes/{name}/time"], data[f"/probes/{name}/direct_stress"] = time, direct
        data[f"/probes/{name}/stress"] = 1.02 * direct + 0.02 * scale * random.standard_normal(direct.shape)
        positions[f"/probes/{name}"] = ("position", place)
    y = (np.arange(NY) + 0.5)[:, None] / NY
    field = 4e5 * (1 + 3 * ids) * (1.3 - y) * (1 + 0.1 * random.random((NY, NX)))
    data["/mean_von_mises"], data["/direct/mean_von_mises"] = field, field * (1 + 0.03 * random.standard_normal((NY, NX)))
    write(folder, "localization.h5",
          {"program": "stress_localization", "version": "0.2.0", "cells": [NX, NY], "seconds": {"total": 2.2},
           "peak_memory_bytes": 1.1e8, "probes": [{"name": "A", "phase": "fibre"}, {"name": "B", "phase": "matrix"}],
           "phases": ["matrix", "surface"], "field_errors": FIELD_ERRORS, "concentration": "KUBC", "window": [7e-4, 1e-3], "snapshots": 2},
          data, positions)
    Folder(folder).write("parameters.prm", prm({"Input/Homogeneous run": "homogeneous/dynamics.h5", "Input/Direct run": "heterogeneous/dynamics.h5",
                                                "Comparison/Surface depth": 4e-4, "Comparison/Edge distance": 0.0016}))


# A phase that is called as a region is.
FIELD_ERRORS = {"mean_von_mises": {"all": 0.25, "interior": 0.031, "surface": 0.48, "surface_inner": 0.11, "matrix": 0.058, "matrix_interior": 0.033,
                                   "phase_surface": 0.55, "phase_surface_interior": None}}


def write_analyses(root):
    """Modes, static contact, homogenized friction law: folders of runs without a history."""
    x = np.linspace(0, 1, NX + 1)
    shape = np.zeros((3, NY + 1, NX + 1, 2))
    for k in range(3):
        shape[k, ..., 0] = np.cos((k + 1) * np.pi * x)
    modes = {"/modes/free/shape": shape, "/modes/free/frequency": np.array([39500.0, 41589.0, 6e4])}
    modal = {"program": "contact_dynamics", "analysis": "modal", "frequencies": [39500.0, 41589.0, 6e4]}
    static = {"program": "contact_dynamics", "analysis": "static contact",
              "phase_contact_pressures": {"matrix": 0.33e6, "fibre": 2.1e6},
              "phase_pressures_eq_19": {"matrix": 0.3e6, "fibre": 2.4e6}}
    tractions = {"/static_contact/x": 0.056 * x, "/static_contact/pressure": 5e5 * (1 + x),
                 "/static_contact/shear_traction": 1e5 * (1 + x)}
    law = {"program": "contact_dynamics", "analysis": "friction homogenization", "mu_homo": 0.13482, "delta": 2.538e-6,
           "estimates": [{"pressures": "static contact", "duration_of": "homogeneous", "mu_homo": 0.13482,
                          "mean_contact_duration": 5.1e-5, "delta": 2.538e-6, "delta_calibrated": None}]}
    write(os.path.join(root, "modal"), "modal.h5", modal, modes)
    write(os.path.join(root, "static"), "dynamics.h5", static, tractions)
    Folder(root).write("law/summary.json", json.dumps(law))
    return [os.path.join(root, name) for name in ("modal", "static", "law")]


def write_foreign_body(source, target):
    """The same chain for a body of another size, which is not the paper's."""
    shutil.copytree(source, target)
    for folder, _, names in os.walk(target):
        for name in names:
            if name.endswith(".h5"):
                with h5py.File(os.path.join(folder, name), "r+") as file:
                    file["grid"].attrs["spacing"] = [2 * H, 2 * H]


def write_chain(root):
    ids = morphology()
    write_rve(os.path.join(root, "rve"), ids)
    write_dynamics(os.path.join(root, "homogeneous"), ids, 0)
    write_dynamics(os.path.join(root, "heterogeneous"), ids, 1)
    write_localization(os.path.join(root, "localization"), ids)
