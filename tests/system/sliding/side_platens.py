"""Rigid platens at the sides, in the program, on a plane grid, a box, and meshes in 2D and 3D. Runs under every kind of top are the same on 1, 2 and 3
ranks, close their energy and are continued bit for bit; nodes of a platen move as one, and a box and a mesh of its bricks alike. Between platens, one of
them on springs, a body yields by what these carry. Without friction complex modes are the modes whose bottom is held."""

import csv
import tempfile

import h5py
import numpy as np

from four_bodies import PLANE, bodies, bricks, check_alike, check_ranks_and_restart, refuses
from scenes import Folder, prm

PRESSURE = 5e6
RUN = {"Flat/Velocity": 2, "Friction/Coefficient": 0.3, "Time/End time": 2e-5, "Time/Rayleigh beta": 4.4e-9, "Body/Rayleigh alpha": 1e4,
       "Time/Beta2": 0.6, "Body/Initial velocity": "0.1, -0.2", "Body/Acceleration": "1e4, -2e4", "Observation/Energy interval": 1,
       "Observation/History interval": 1, "Checkpoints/Keep": "true"}
SIDES = {"Supports/Left/Kind": "platen", "Supports/Left/Platen mass": 2e-3, "Supports/Left/Spring stiffness": "1e12, 2e12",
         "Supports/Left/Dashpot": "1e6, 2e6", "Supports/Left/Motion": "1e-7*sin(1e6*t); 1e-3*t", "Supports/Left/Pressure": 1e6,
         "Supports/Right/Kind": "platen", "Supports/Right/Pressure": 2e6}
IN_3D = {"Supports/Front/Kind": "platen", "Supports/Front/Pressure": 3e6, "Supports/Front/Ramp": "smooth", "Supports/Front/Ramp time": 1e-5,
         "Supports/Back/Kind": "springs", "Supports/Back/Spring stiffness": "1e12, 1e12, 1e12", "Supports/Back/Dashpot": "1e6, 1e6, 0",
         "Supports/Back/Mass": 1}
TOPS = {"pressure": {"Supports/Top/Kind": "pressure", "Supports/Top/Pressure": PRESSURE},
        "platen": {"Supports/Top/Kind": "platen", "Supports/Top/Pressure": PRESSURE, "Supports/Top/Platen mass": 1e-3},
        "springs": {"Supports/Top/Kind": "springs", "Supports/Top/Spring stiffness": "1e12", "Supports/Top/Mass": 2.0}}


def freed(body):
    return {key: value for key, value in body.items() if "Held" not in key}


def sides(first):
    return {**SIDES, **(IN_3D if "3" in first else {})}


def inner_nodes(name, first, folder, run, shape):
    """Displacements of the nodes at the left between contact and top, at the last time."""
    dim = 3 if "3" in first else 2
    with h5py.File(folder(run, "dynamics.h5")) as file:
        u = file["snapshots/displacement"][-1].reshape(-1, dim)
        if "mesh" in file:
            x = file["mesh/points"][()]
        else:
            axes = [np.linspace(0, size, n + 1) for size, n in shape]
            grids = np.meshgrid(*axes[::-1], indexing="ij")[::-1]
            x = np.stack([grid.ravel() for grid in grids], axis=1)
    assert len(x) == len(u), (name, len(x), len(u))
    at_left = (np.abs(x[:, 0] - x[:, 0].min()) < 1e-9) & (x[:, -1] > 1e-9) & (x[:, -1] < x[:, -1].max() - 1e-9)
    return u[at_left]


SHAPES = {"grid": [(6e-3, 12), (4e-3, 9)], "box": [(3e-3, 5), (2e-3, 4), (4e-3, 8)], "mesh2": None, "mesh3": None}


def check_run(folder, name, first, body, top):
    folder.write("run.prm", first + prm({**RUN, **sides(first), **TOPS[top], **freed(body), "Snapshots/Interval": 1e-5}))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run1")
    one, summary = check_ranks_and_restart(folder, (name, top)), folder.summary("run1")
    assert summary["energy_balance_residual"] < 1e-12, (name, top, summary["energy_balance_residual"])
    scale = np.abs(one["energy/elastic"]).max()
    assert np.abs(one["energy/supports"]).max() > 1e-3 * scale and one["energy/dashpots"].max() > 1e-4 * scale, (name, top)
    assert np.diff(one["energy/dashpots"]).min() > -1e-12 * scale, (name, top)
    u = inner_nodes(name, first, folder, "run1", SHAPES[name])
    assert len(u) > 5 and np.ptp(u[:, :2], axis=0).max() < 1e-18 and np.abs(u[0, :2]).min() > 1e-10, (name, top, u)


def check_static(folder, name, first, body):
    """On a flat without friction the springs at the left carry what presses at the right, whatever goes on between them."""
    between = {"Supports/Left/Kind": "platen", "Supports/Left/Spring stiffness": "1e13", "Supports/Right/Kind": "platen", "Supports/Right/Pressure": 2e6}
    if "3" in first:
        between |= {"Supports/Front/Kind": "platen", "Supports/Front/Spring stiffness": "1, 1e13", "Supports/Back/Kind": "pressure", "Supports/Back/Pressure": 3e6}
    for top in ("pressure", "platen"):
        sliding = {**TOPS[top], "Supports/Top/Spring stiffness": "1" if "3" not in first else "1, 1"} if top == "platen" else TOPS[top]
        sliding.pop("Supports/Top/Platen mass", None)
        folder.write("static.prm", first + prm({"Analysis": "static contact", "Flat/Velocity": 0, "Friction/Coefficient": 0, "Static contact/Tolerance": 1e-11,
                                                **sliding, **between, **freed(body)}))
        seen = []
        for ranks in (1, 2, 3):
            folder.run(0, "contact_dynamics", "static.prm", "--output", "static", ranks=ranks)
            u = inner_nodes(name, first, folder, "static", SHAPES[name])
            assert np.ptp(u[:, 0]) < 1e-18 and abs(u[0, 0] / -2e-7 - 1) < 1e-6, (name, top, ranks, u[0], np.ptp(u[:, 0]))
            with open(folder("static", "static_contact.csv"), encoding="ascii") as file:
                seen.append(np.array([float(row["pressure [Pa]"]) for row in csv.DictReader(file)]))
            assert np.abs(seen[-1] - seen[0]).max() < 1e-6 * PRESSURE, (name, top, ranks)


def check_modes(folder, name, first, body):
    """Platens at both sides that nothing holds but the body between them, and on springs."""
    for left in ({}, {"Supports/Left/Spring stiffness": "2e12, 1e12", "Supports/Right/Spring stiffness": "0, 1e11"}):
        supports = {"Supports/Left/Kind": "platen", "Supports/Right/Kind": "platen", "Supports/Left/Platen mass": 1e-3, **left,
                    "Supports/Top/Kind": "springs", "Supports/Top/Spring stiffness": "0, 1e12" if "3" not in first else "0, 1e12, 1e12"}
        modal = first + prm({"Analysis": "modal", "Modal/Bottom": "held in z" if "3" in first else "held in y", "Modal/Number of modes": 4, "Modal/Tolerance": 1e-11, **supports, **freed(body)})
        folder.write("modal.prm", modal)
        seen = []
        for ranks in (1, 2, 3):
            folder.run(0, "contact_dynamics", "modal.prm", "--output", "modal", ranks=ranks)
            seen.append(np.array(folder.summary("modal")["frequencies"]["held"]))
            assert np.allclose(seen[-1], seen[0], rtol=1e-7), (name, ranks, seen)
        assert folder.summary("modal")["rigid_motions"]["held"] == (0 if left else 1), (name, left)
        if not left:
            continue
        folder.write("complex.prm", first + prm({**supports, **freed(body), "Analysis": "complex modes", "Supports/Top/Pressure": PRESSURE, "Friction/Coefficient": 0,
                                                 "Time/Rayleigh beta": 0, "Complex modes/Highest frequency": 1.05 * seen[0][2], "Complex modes/Fastest decay": 1}))
        folder.run(0, "contact_dynamics", "complex.prm", "--output", "complex")
        with open(folder("complex", "complex_modes.csv"), encoding="ascii") as file:
            found = np.array([float(row["frequency [Hz]"]) for row in csv.DictReader(file)])
        assert folder.summary("complex")["separated_nodes"] == 0, name
        for frequency in seen[0][:3]:
            assert np.min(np.abs(found / frequency - 1)) < 1e-6, (name, seen[0], found)


def check_alone(folder):
    """Under a platen at one side that nothing pushes, the flat of a body that yields along x carries all but what the platen does; a body may turn about
    the one row of nodes that a platen moves; springs of a platen are in the critical step, as the largest frequency of their matrices is."""
    solid = {"Body/Stiffness": "40e9, 9e9, 47e9, 13e9", "Body/Density": 1800, "Body/Size": "4e-3, 2e-3"}
    folder.write("alone.prm", prm({**solid, "Analysis": "static contact", "Body/Cells": "4, 4", "Flat/Velocity": 0, "Friction/Coefficient": 0, "Static contact/Tolerance": 1e-11,
                                   "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 1e6, "Supports/Top/Held": "u_x"}))
    for side, expected in (("Left", 3383.24), ("Right", 3383.24)):  # N/m, of a dense code
        folder.run(0, "contact_dynamics", "alone.prm", "--output", "alone", "--set", f"Supports/{side}/Kind=platen")
        assert abs(folder.summary("alone")["normal_force"] / expected - 1) < 2e-6, (side, folder.summary("alone")["normal_force"])
    folder.write("turns.prm", prm({**solid, "Analysis": "modal", "Body/Cells": "6, 2", "Supports/Top/Kind": "free", "Modal/Number of modes": 4, "Supports/Left/Kind": "platen"}))
    folder.run(0, "contact_dynamics", "turns.prm", "--output", "turns")
    assert folder.summary("turns")["rigid_motions"] == {"free": 2, "held": 1}, folder.summary("turns")["rigid_motions"]
    folder.write("stiff.prm", prm({**solid, "Body/Size": "3e-3, 2e-3", "Body/Cells": "4, 2", "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 1e6, "Time/Rayleigh beta": 0,
                                   "Time/End time": 1e-4, "Supports/Left/Kind": "platen"}))
    for stiffness in (1e14, 1e16):
        folder.run(0, "contact_dynamics", "stiff.prm", "--output", "stiff", "--set", f"Supports/Left/Spring stiffness={stiffness}")


def check_sentences(folder):
    refused = lambda words, *settings: refuses(folder, words, *settings)
    folder.write("run.prm", prm({"Body/Stiffness": PLANE, "Body/Density": 1770, "Body/Size": "0.006, 0.004", "Body/Cells": "12, 9",
                                 "Supports/Left/Kind": "platen"}))
    assert refused("Supports/Left/Held has no effect", "Supports/Left/Held=u_x")
    assert refused("Supports/Left/Dashpot: along y the platen moves on springs only", "Supports/Left/Dashpot=0, 1e6")
    assert refused("all nodes of the side belong to the contact", "Body/Cells=12, 1", "Body/Size=0.006, 0.0004")
    assert refused("Supports/Right/Platen mass has no effect", "Supports/Right/Platen mass=1")
    assert refused("Static solver", "Analysis=static contact", "Performance/Static solver=jacobi", "Flat/Velocity=0")
    folder.write("mesh.prm", prm({"Mesh/File": "mesh2.msh", "Mesh/Scale": 0.001, "Phases/Names": "body", "Phases/body/Type": "stiffness",
                                  "Phases/body/Density": 1770, "Phases/body/Stiffness": PLANE, "Supports/Contact/Kind": "platen"}))
    assert "belong to the contact" in folder.run(2, "contact_dynamics", "mesh.prm", "--validate")
    assert "Supports/Left/Kind: the group is one of Mesh/Periodic" in folder.run(
        2, "contact_dynamics", "mesh.prm", "--validate", "--set", "Mesh/Periodic in x=Left, Right", "--set", "Supports/Left/Kind=platen")
    free = ["Analysis=static contact", "Flat/Velocity=0", "Friction/Coefficient=0", "Supports/Top/Kind=pressure", "Supports/Top/Pressure=1e6"]
    assert refused("Supports/Left/Kind = platen: nothing holds the body along x; set Supports/Top/Held", *free)
    assert refused("Supports/Left/Pressure or Traction: nothing holds the body along x", *free, "Supports/Left/Kind=pressure", "Supports/Left/Pressure=1")
    for mended in ("Supports/Top/Held=u_x", "Supports/Right/Held=u_x", "Supports/Top/Kind=platen", "Friction/Coefficient=0.1"):
        folder.run(0, "contact_dynamics", "run.prm", "--validate", *[arg for text in [*free, mended] for arg in ("--set", text)])


with tempfile.TemporaryDirectory() as path:
    here = Folder(path)
    for what in bodies(here):
        for kind in TOPS:
            check_run(here, *what, kind)
        check_static(here, *what)
        check_modes(here, *what)
        if what[0] == "box":
            check_alike(here, *({**RUN, **SIDES, **IN_3D, **TOPS["springs"], **keys} for keys in (freed(what[2]), bricks(here))))
    check_alone(here)
    check_sentences(here)
