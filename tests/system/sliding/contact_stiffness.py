"""Flat/Normal stiffness in the program, with Body/Rayleigh alpha, on a plane grid, a box, and meshes in 2D and 3D, on 1, 2 and 3 ranks: under a uniform pressure p a body at
rest comes down by p / k_n; a run on springs is the same on all ranks, closes its energy and is continued bit for bit; springs that are stiff
are the rigid flat; runs on other springs are none of one localization."""

import csv
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import Folder, prm

MATERIAL = {"Type": "stiffness", "Density": 1770}
PLANE, SOLID = "36.54e9, 9.1e9, 47.26e9, 13.785e9", "36.54e9, 9e9, 9.1e9, 36.54e9, 9.1e9, 47.26e9, 13.785e9, 13.785e9, 12e9"
PRESSURE, STIFFNESS = 5e6, 2e13
STATIC = {"Analysis": "static contact", "Top/Kind": "pressure", "Top/Pressure": PRESSURE, "Flat/Velocity": 0, "Friction/Coefficient": 0,
          "Flat/Normal stiffness": STIFFNESS, "Static contact/Tolerance": 1e-10}
RUN = {"Flat/Velocity": 2, "Flat/Normal stiffness": STIFFNESS, "Top/Pressure": PRESSURE, "Friction/Coefficient": 0.3, "Time/End time": 2e-5,
       "Time/Rayleigh beta": 4.4e-9, "Body/Rayleigh alpha": 2e3, "Observation/Energy interval": 1, "Observation/History interval": 1,
       "Checkpoints/Keep": "true"}


def bodies(folder):
    """Name, first line, and keys of each kind of body, of which the sides are held along their normals."""
    yield "grid", "", {"Body/Stiffness": PLANE, "Body/Density": 1770, "Body/Size": "0.006, 0.004", "Body/Cells": "12, 9", "Sides/Left": "u_x",
                       "Sides/Right": "u_x"}
    yield "box", "set Dimension = 3\n", {"Body/Stiffness": SOLID, "Body/Density": 1770, "Body/Size": "0.003, 0.002, 0.004", "Body/Cells":
                                         "5, 4, 8", "Sides/Left": "u_x", "Sides/Right": "u_x", "Sides/Front": "u_y", "Sides/Back": "u_y"}
    for dim, kind, size, cells in ((2, "simplex", [6, 4], [9, 8]), (3, "cube", [3, 2, 4], [5, 4, 6])):
        name = f"mesh{dim}"
        box = Box(size, cells, lambda x: "body", kind)
        for side, axis, upper in [("Contact", dim - 1, False), ("Top", dim - 1, True), ("Left", 0, False), ("Right", 0, True),
                                  ("Front", 1, False), ("Back", 1, True)][:2 * dim]:
            box.name_side(side, axis, upper)
        box.write(folder(name + ".msh"))
        held = {"Mesh/Held in x": "Left, Right", **({"Mesh/Held in y": "Front, Back"} if dim == 3 else {})}
        yield name, f"set Dimension = {dim}\n", {"Mesh/File": name + ".msh", "Mesh/Scale": 0.001, "Phases/Names": "body",
                                                 "Phases/body/Stiffness": SOLID if dim == 3 else PLANE,
                                                 **{f"Phases/body/{key}": value for key, value in MATERIAL.items()}, **held}


def check_static(folder, name, first, body):
    folder.write("static.prm", first + prm({**STATIC, **body}))
    for ranks in (1, 2, 3):
        folder.run(0, "contact_dynamics", "static.prm", "--output", "static", ranks=ranks)
        with open(folder("static", "static_contact.csv"), encoding="ascii") as file:
            rows = list(csv.DictReader(file))
        normal = "displacement_z [m]" if "displacement_z [m]" in rows[0] else "displacement_y [m]"
        for row in rows:
            assert abs(float(row["pressure [Pa]"]) / PRESSURE - 1) < 1e-7, (name, ranks, row)
            assert abs(float(row[normal]) * STIFFNESS / -PRESSURE - 1) < 1e-7, (name, ranks, row)


def histories(folder, run):
    with h5py.File(folder(run, "dynamics.h5")) as file:
        return {f"{group}/{name}": values[()] for group in ("history", "energy") for name, values in file[group].items()}


def check_run(folder, name, first, body):
    folder.write("run.prm", first + prm({**RUN, **body}))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run1")
    one, summary = histories(folder, "run1"), folder.summary("run1")
    assert summary["energy_balance_residual"] < 1e-11, (name, summary["energy_balance_residual"])
    assert one["energy/contact"].max() > 0 and np.diff(one["energy/impact"]).min() > -1e-12 * one["energy/elastic"].max(), name
    for ranks in (2, 3):
        folder.run(0, "contact_dynamics", "run.prm", "--output", "run", ranks=ranks)
        for key, values in histories(folder, "run").items():
            scale = max(np.abs(one[key]).max(), np.abs(one["energy/elastic"]).max() if key.startswith("energy") else 0)
            assert np.abs(values - one[key]).max() <= 1e-9 * scale, (name, ranks, key, np.abs(values - one[key]).max(), scale)
    # Half of it first, and from there on.
    folder.run(0, "contact_dynamics", "run.prm", "--output", "half", "--set", "Time/End time=1e-5")
    folder.run(0, "contact_dynamics", "run.prm", "--output", "half", "--resume")
    for key, values in histories(folder, "half").items():
        assert np.array_equal(values, one[key]), (name, key)
    folder.run(0, "contact_dynamics", "run.prm", "--output", "stiff", "--set", "Flat/Normal stiffness=1e22")
    folder.write("rigid.prm", first + prm({**{key: value for key, value in RUN.items() if "stiffness" not in key}, **body}))
    folder.run(0, "contact_dynamics", "rigid.prm", "--output", "rigid")
    stiff, rigid = histories(folder, "stiff"), histories(folder, "rigid")
    assert "energy/contact" not in rigid
    for key in ("history/contact_normal_force", "history/contact_tangential_force", "energy/elastic", "energy/friction"):
        assert np.abs(stiff[key] - rigid[key]).max() < 1e-5 * np.abs(rigid[key]).max(), (name, key)
        assert np.abs(one[key] - rigid[key]).max() > 1e-3 * np.abs(rigid[key]).max(), (name, key)


with tempfile.TemporaryDirectory() as path:
    here = Folder(path)
    for what in bodies(here):
        check_static(here, *what)
        check_run(here, *what)
    assert "Normal stiffness" in here.run(2, "contact_dynamics", "run.prm", "--set", "Flat/Normal stiffness=0", "--validate")
