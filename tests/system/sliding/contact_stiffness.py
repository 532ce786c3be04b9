"""Flat/Normal stiffness in the program, with Body/Rayleigh alpha, on a plane grid, a box, and meshes in 2D and 3D, on 1, 2 and 3 ranks: under a uniform pressure p a body at
rest comes down by p / k_n; a run on springs is the same on all ranks, closes its energy and is continued bit for bit; springs that are stiff
are the rigid flat; runs on other springs are none of one localization."""

import csv
import tempfile

import numpy as np

from four_bodies import bodies, check_ranks_and_restart, histories
from scenes import Folder, prm

PRESSURE, STIFFNESS = 5e6, 2e13
STATIC = {"Analysis": "static contact", "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": PRESSURE, "Flat/Velocity": 0, "Friction/Coefficient": 0,
          "Flat/Normal stiffness": STIFFNESS, "Static contact/Tolerance": 1e-10}
RUN = {"Flat/Velocity": 2, "Flat/Normal stiffness": STIFFNESS, "Supports/Top/Pressure": PRESSURE, "Friction/Coefficient": 0.3, "Time/End time": 2e-5,
       "Time/Rayleigh beta": 4.4e-9, "Body/Rayleigh alpha": 2e3, "Observation/Energy interval": 1, "Observation/History interval": 1,
       "Checkpoints/Keep": "true"}


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
        # p = p_0 (g/g_0)^n with dp/dg = k at p_0: g = n p_0/k (p/p_0)^(1/n).
        for top in ("pressure", "platen"):
            folder.run(0, "contact_dynamics", "static.prm", "--output", "static", "--set", "Flat/Normal exponent=2.5", "--set",
                       "Flat/Normal stiffness at=2e6", "--set", f"Supports/Top/Kind={top}", ranks=ranks)
            with open(folder("static", "static_contact.csv"), encoding="ascii") as file:
                rows = list(csv.DictReader(file))
            depth = 2.5 * 2e6 / STIFFNESS * (PRESSURE / 2e6) ** (1 / 2.5)
            for row in rows:
                assert abs(float(row["pressure [Pa]"]) / PRESSURE - 1) < 1e-7, (name, top, ranks, row)
                assert abs(float(row[normal]) / -depth - 1) < 1e-7, (name, top, ranks, row)


def check_run(folder, name, first, body):
    folder.write("run.prm", first + prm({**RUN, **body}))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run1")
    one, summary = histories(folder, "run1"), folder.summary("run1")
    assert summary["energy_balance_residual"] < 1e-12, (name, summary["energy_balance_residual"])
    assert one["energy/contact"].max() > 0 and np.diff(one["energy/impact"]).min() > -1e-12 * one["energy/elastic"].max(), name
    check_ranks_and_restart(folder, name)
    folder.run(0, "contact_dynamics", "run.prm", "--output", "stiff", "--set", "Flat/Normal stiffness=1e22")
    folder.write("rigid.prm", first + prm({**{key: value for key, value in RUN.items() if "stiffness" not in key}, **body}))
    folder.run(0, "contact_dynamics", "rigid.prm", "--output", "rigid")
    stiff, rigid = histories(folder, "stiff"), histories(folder, "rigid")
    assert "energy/contact" not in rigid
    for key in ("history/contact_normal_force", "history/contact_tangential_force", "energy/elastic", "energy/friction"):
        assert np.abs(stiff[key] - rigid[key]).max() < 1e-5 * np.abs(rigid[key]).max(), (name, key)
        assert np.abs(one[key] - rigid[key]).max() > 1e-3 * np.abs(rigid[key]).max(), (name, key)


def check_power(folder, name, first, body):
    """Springs of a power close the balance, are the same on all ranks and go on bit for bit."""
    folder.write("run.prm", first + prm({**RUN, "Flat/Normal exponent": 2.5, "Flat/Normal stiffness at": 2e6, **body}))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run1")
    one, summary = check_ranks_and_restart(folder, (name, "power")), folder.summary("run1")
    assert summary["energy_balance_residual"] < 1e-12 and one["energy/contact"].max() > 0, (name, summary["energy_balance_residual"])
    assert np.diff(one["energy/impact"]).min() > -1e-12 * one["energy/elastic"].max(), name


def check_modes(folder):
    """Complex modes on springs of a power are those on linear ones of their stiffness under the pressure."""
    layer = {"Analysis": "complex modes", "Body/Stiffness": "36.54e9, 9.1e9, 47.26e9, 13.785e9", "Body/Density": 1770, "Body/Size": "0.006, 0.004",
             "Body/Cells": "12, 8", "Sides/Periodic": "true", "Supports/Top/Kind": "pressure", "Supports/Top/Held": "u_x",
             "Supports/Top/Pressure": PRESSURE, "Flat/Velocity": 2, "Friction/Coefficient": 0.3, "Time/Rayleigh beta": 0}
    found = []
    for keys in ({"Flat/Normal stiffness": STIFFNESS * (PRESSURE / 2e6) ** (1 - 1 / 2.5)},
                 {"Flat/Normal stiffness": STIFFNESS, "Flat/Normal exponent": 2.5, "Flat/Normal stiffness at": 2e6}):
        folder.write("modes.prm", prm({**layer, **keys}))
        folder.run(0, "contact_dynamics", "modes.prm", "--output", "modes")
        with open(folder("modes", "complex_modes.csv"), encoding="ascii") as file:
            found.append(np.array([[float(row["frequency [Hz]"]), float(row["growth_rate [1/s]"])] for row in csv.DictReader(file)]))
    assert found[0].shape == found[1].shape and np.abs(found[0] - found[1]).max() < 1e-6 * found[0].max(), found


with tempfile.TemporaryDirectory() as path:
    here = Folder(path)
    for what in bodies(here):
        check_static(here, *what)
        check_run(here, *what)
        check_power(here, *what)
    check_modes(here)
    assert "Normal stiffness" in here.run(2, "contact_dynamics", "run.prm", "--set", "Flat/Normal stiffness=0", "--validate")
