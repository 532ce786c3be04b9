"""Flat/Normal stiffness in the program, with Body/Rayleigh alpha, on a plane grid, a box, and meshes in 2D and 3D, on 1, 2 and 3 ranks: under a uniform pressure p a body at
rest comes down by p / k_n; a run on springs is the same on all ranks, closes its energy and is continued bit for bit; springs that are stiff
are the rigid flat; runs on other springs are none of one localization."""

import csv
import tempfile

import numpy as np

from four_bodies import bodies, histories
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
