"""Flat/Profile in the program. Under a wavy flat a body carries Westergaard's pressure; a bump touches the nodes that geometry says, in 2D and 3D; runs on a
plane grid, a box, and meshes in 2D and 3D are the same on 1, 2 and 3 ranks, close their energy and are continued bit for bit; a box and a mesh of its
bricks move alike; a table and a picture are the formula that they were made of; what cannot be is refused with what helps."""

import csv
import tempfile

import h5py
import numpy as np
from PIL import Image

from four_bodies import bodies, bricks, check_alike, check_ranks_and_restart, histories
from scenes import Folder, prm

RUN = {"Flat/Velocity": 2, "Flat/Gap": 2.5e-6, "Supports/Top/Pressure": 5e6, "Friction/Coefficient": 0.3, "Time/End time": 2e-5,
       "Time/Rayleigh beta": 4.4e-9, "Body/Initial velocity": "0, -0.3", "Observation/Energy interval": 1, "Observation/History interval": 1,
       "Checkpoints/Keep": "true"}
WAVES = {2: "2e-6*sin(2*pi*x/3e-3)+5e-7*cos(2*pi*x/1.1e-3)", 3: "2e-6*sin(2*pi*x/3e-3)*cos(2*pi*y/4e-3)+5e-7*cos(2*pi*y/1.1e-3)"}
YOUNG, NU = 70e9, 0.3
LAME = YOUNG * NU / ((1 + NU) * (1 - 2 * NU))
SHEAR = YOUNG / (2 * (1 + NU))


def westergaard(folder, cells, share, springs=()):
    """Errors of the largest pressure and of the width of the contact, over exact, of a wave of 1 mm under @share of the pressure that closes it."""
    length, height = 1e-3, 2e-7
    closing = np.pi * YOUNG / (1 - NU**2) * height / length
    folder.write("wavy.prm", prm({
        "Analysis": "static contact", "Body/Stiffness": f"{LAME + 2 * SHEAR}, {LAME}, {LAME + 2 * SHEAR}, {SHEAR}", "Body/Density": 2700,
        "Body/Size": f"{length}, {1.5 * length}", "Body/Cells": f"{cells}, {3 * cells // 2}", "Sides/Periodic": "true", "Supports/Top/Held": "u_x",
        "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": share * closing, "Flat/Velocity": 0, "Friction/Coefficient": 0,
        "Flat/Profile": f"{height}*cos(2*pi*(x/{length}-0.5))", "Static contact/Tolerance": 1e-9}))
    folder.run(0, "contact_dynamics", "wavy.prm", "--output", "wavy", *[arg for text in springs for arg in ("--set", "Flat/" + text)])
    with open(folder("wavy", "static_contact.csv"), encoding="ascii") as file:
        rows = list(csv.DictReader(file))[:-1]  # the last is the first
    x, p = (np.array([float(row[key]) for row in rows]) for key in ("x [m]", "pressure [Pa]"))
    assert abs(p.mean() / (share * closing) - 1) < 1e-7
    edge = np.sin(np.pi * (x - 0.5 * length) / length)
    exact = 2 * closing * np.cos(np.pi * (x - 0.5 * length) / length) * np.sqrt(np.maximum(0, share - edge**2))
    width = 2 * np.arcsin(np.sqrt(share)) / np.pi
    return p.max() / exact.max() - 1, np.abs(p - exact).mean() / p.mean(), (p > 0).mean() - width


def check_westergaard(folder):
    for share in (0.2, 0.6):
        coarse, fine = (westergaard(folder, cells, share) for cells in (48, 192))
        assert abs(fine[0]) < 2e-3 and fine[1] < 0.01 and abs(fine[2]) <= 2 / 192, (share, fine)
        assert fine[1] < 0.4 * coarse[1], (share, coarse, fine)
    # Soft springs spread the contact, those that are as good as rigid do not.
    for springs in (["Normal stiffness=1e19"], ["Normal stiffness=1e19", "Normal exponent=2", "Normal stiffness at=1e7"]):
        stiff, soft = (westergaard(folder, 96, 0.2, [text.replace("1e19", k) for text in springs]) for k in ("1e19", "1e15"))
        rigid = westergaard(folder, 96, 0.2)
        assert np.abs(np.subtract(stiff, rigid)).max() < 1e-3 and soft[0] < rigid[0] - 0.01, (springs, stiff, rigid, soft)


def check_displaced(folder):
    """A flat that carries the body along carries it on the same crests; under a platen it carries the whole load wherever its waves are."""
    body = {"Body/Stiffness": "36.54e9, 9.1e9, 47.26e9, 13.785e9", "Body/Density": 1770, "Body/Size": "4e-3, 2e-3", "Body/Cells": "40, 20"}
    static = {"Analysis": "static contact", "Flat/Velocity": 0, "Flat/Profile": "1e-6*sin(2*pi*x/2e-3)", "Static contact/Tolerance": 1e-10}
    carried = {"Supports/Top/Kind": "springs", "Supports/Top/Spring stiffness": "1e5, 0", "Supports/Top/Pressure": 1e6, "Friction/Coefficient": 1}
    pressures = []
    for moved in (0, 1e-4, 3e-4):
        folder.write("carried.prm", prm({**body, **static, **carried, "Static contact/Flat displacement": moved}))
        folder.run(0, "contact_dynamics", "carried.prm", "--output", "carried")
        with open(folder("carried", "static_contact.csv"), encoding="ascii") as file:
            pressures.append(np.array([float(row["pressure [Pa]"]) for row in csv.DictReader(file)]))
    assert np.abs(pressures[1] - pressures[0]).max() < 1e-3 * pressures[0].max() and np.abs(pressures[2] - pressures[0]).max() < 1e-3 * pressures[0].max()
    folder.write("platen.prm", prm({**body, **static, "Supports/Top/Pressure": 2e6, "Friction/Coefficient": 0.3, "Static contact/Flat displacement": 7e-4,
                                    "Static contact/Load steps": 3}))
    folder.run(0, "contact_dynamics", "platen.prm", "--output", "platen")
    with open(folder("platen", "load_steps.csv"), encoding="ascii") as file:
        for row in csv.DictReader(file):
            assert abs(float(row["normal_force [N/m]"]) / (8000 * float(row["share_of_load [-]"])) - 1) < 1e-6, row


def check_bump(folder, name, first, body):
    """A body that is held at its top hovers over the flat, and the top of a bump comes along below it."""
    dim = 3 if "3" in first else 2
    across = "+(y-1e-3)^2" if dim == 3 else ""
    folder.write("bump.prm", first + prm({
        **{key: value for key, value in RUN.items() if "Pressure" not in key}, **{"Body/Initial velocity": "0, 0", "Flat/Gap": 1e-6, "Time/End time": 4e-5}, **body, "Supports/Top/Kind": "held",
        "Flat/Velocity": 100, "Flat/Profile": f"1.03e-6*exp(-((x+1e-3)^2{across})/4e-6)", "Contact map/Interval": 5e-6, "Contact map/Fields": "state, gap"}))
    folder.run(0, "contact_dynamics", "bump.prm", "--output", "bump", ranks=2)
    with h5py.File(folder("bump", "dynamics.h5")) as file:
        states, gaps, times = (file["contact_map/" + key][()] for key in ("state", "gap", "time"))
        places = file["contact/position"][()] if "position" in file["contact"] else file["contact/x"][()][:, None]
    touched = 0
    assert (states == 0).any() and np.abs(gaps[states > 0]).max() < 5e-8  # a node that touches ends the step on the flat
    for state, gap, time in zip(states, gaps, times):
        distance2 = (places[:, 0] + 1e-3 - 100 * time) ** 2 + ((places[:, 1] - 1e-3) ** 2 if dim == 3 else 0)
        clear, inside = distance2 > 4e-6 * np.log(1.032), distance2 < 4e-6 * np.log(1.025)
        height = 1.03e-6 * np.exp(-distance2 / 4e-6)
        assert np.abs(gap.ravel() - (1e-6 - height))[clear].max() < 2e-8, (name, time)
        assert not np.any((state.ravel() > 0) & clear), (name, time)
        touched += np.sum(inside & (state.ravel() > 0)) / max(1, np.sum(inside))
    assert touched > 2, (name, touched)


def check_run(folder, name, first, body):
    folder.write("run.prm", first + prm({**RUN, "Flat/Profile": WAVES[3 if "3" in first else 2], **body}))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run1")
    one, summary = check_ranks_and_restart(folder, name), folder.summary("run1")
    assert summary["energy_balance_residual"] < 1e-12, (name, summary["energy_balance_residual"])
    assert summary["flat_profile"].startswith("2e-6*sin"), summary["flat_profile"]
    assert np.ptp(one["history/contact_normal_force"]) > 0, name


def check_files(folder, first, body):
    """Ridges of 1 um every 2 mm along x and, in 3D, of 2 um every 1 mm along y, as formula, table and picture, whose pixels count in their middle."""
    in_3d = "3" in first
    ridges = lambda x0, y0: f"1e-6*(1-abs(2*((x-{x0})/2e-3-floor((x-{x0})/2e-3))-1))" + (
        f"+2e-6*(1-abs(2*((y-{y0})/1e-3-floor((y-{y0})/1e-3))-1))" if in_3d else "")
    heights = {(i, j): i % 2 + 2 * (j % 2) for i in range(3) for j in range(3 if in_3d else 1)}
    folder.write("heights.csv", ("x [m],y [m],height [m]\n" if in_3d else "x [m],height [m]\n")
                 + "".join(f"{i}e-3,{5 * j}e-4,{h}e-6\n" if in_3d else f"{i}e-3,{h}e-6\n" for (i, j), h in reversed(heights.items())))
    grey = np.array([[heights[i, j] * 85 for i in range(2)] for j in range(2)] if in_3d else [[0, 255], [170, 17]], np.uint8)
    Image.fromarray(grey[::-1].copy()).save(folder("heights.png"))
    kinds = {"formula": {"Flat/Profile": ridges(0, 0)}, "table": {"Flat/Profile file": "heights.csv", "Flat/Profile repeats": "true"},
             "moved": {"Flat/Profile": ridges(5e-4, 2.5e-4)},
             "picture": {"Flat/Profile file": "heights.png", "Flat/Profile repeats": "true", "Flat/Profile size": "2e-3, 1e-3" if in_3d else "2e-3",
                         "Flat/Profile height": 3e-6 if in_3d else 1e-6}}
    found = {}
    for kind, keys in kinds.items():
        folder.write("heights.prm", first + prm({**RUN, "Flat/Velocity": 30, "Flat/Gap": 3.1e-6, **keys, **body}))
        folder.run(0, "contact_dynamics", "heights.prm", "--output", kind)
        found[kind] = histories(folder, kind)
    for key in ("history/contact_normal_force", "energy/elastic", "energy/friction"):
        size = np.abs(found["formula"][key]).max()
        for a, b in (("formula", "table"), ("moved", "picture")):
            assert np.abs(found[a][key] - found[b][key]).max() < 1e-7 * size, (first, key, a, np.abs(found[a][key] - found[b][key]).max() / size)
        assert np.abs(found["formula"][key] - found["moved"][key]).max() > 1e-3 * size


def check_resume(folder, body):
    """A run goes on over the table that it began with, alone."""
    folder.write("bump.csv", "x [m],height [m]\n0,0\n1e-3,1e-6\n2e-3,0\n")
    folder.write("resumed.prm", prm({**RUN, **body, "Flat/Profile file": "bump.csv"}))
    folder.run(0, "contact_dynamics", "resumed.prm", "--output", "resumed", "--set", "Time/End time=1e-5")
    folder.write("bump.csv", "x [m],height [m]\n0,0\n1e-3,1.5e-6\n2e-3,0\n")
    assert "Content of Flat/Profile file" in folder.run(2, "contact_dynamics", "resumed.prm", "--output", "resumed", "--resume")


def check_sentences(folder, body):
    folder.write("run.prm", prm({**RUN, **body}))
    folder.write("step.csv", "x [m],height [m]\n0,0\n1e-3,1e-6\n")
    folder.write("twice.csv", "x [m],height [m]\n0,0\n0,1e-6\n")
    options = lambda settings: [arg for text in settings for arg in ("--set", text)]
    refused = lambda words, *settings: words in folder.run(2, "contact_dynamics", "run.prm", "--validate", *options(settings))
    warned = lambda words, *settings: words in folder.run(0, "contact_dynamics", "run.prm", "--validate", *options(settings))
    assert refused("set Flat/Gap to 3e-06 or more", "Flat/Profile=3e-6")
    assert refused("has the slope 0.5", "Flat/Profile=0.5*(x-1)")
    assert refused("is not finite at x = -0.0002 m", "Flat/Profile=if(x<-2e-5,1/0,0)", "Time/End time=1e-4")
    assert refused("is not an expression in x", "Flat/Profile=1e-6*sin(y)")
    assert refused("there is a Profile file as well", "Flat/Profile=1e-6", "Flat/Profile file=" + folder("step.csv"))
    assert refused("copies have a step between them", "Flat/Profile repeats=true", "Flat/Profile file=" + folder("step.csv"))
    assert refused("there is a row with this x before", "Flat/Profile file=" + folder("twice.csv"))
    assert refused("is neither a table, whose name ends in .csv, nor a picture", "Flat/Profile file=" + folder("run.prm"))
    assert refused("Flat/Profile size has no effect", "Flat/Profile size=1e-3")
    assert refused("of a periodic body it has to be periodic as well", "Flat/Profile=1e-6*sin(2*pi*x/5e-3)", "Sides/Periodic=true", "Supports/Left/Held=",
                   "Supports/Right/Held=")
    assert refused("is not finite", "Flat/Profile=if(x>7e-3,1/0,0)", "Flat/Velocity=0", "Body/Initial velocity=60, 0")
    assert warned("has slopes up to 0.06", "Flat/Profile=1e-5*sin(1e3*2*pi*x)", "Flat/Gap=1e-5")
    assert warned("finer than the distance of the contact nodes, 0.0005 m", "Flat/Profile=1e-6*sin(2*pi*x/6e-4)")
    assert warned("Flat: height = 1e-6*x m", "Flat/Profile=1e-6*x")


with tempfile.TemporaryDirectory() as path:
    here = Folder(path)
    check_westergaard(here)
    check_displaced(here)
    for what in bodies(here):
        check_bump(here, *what)
        check_run(here, *what)
        if what[0] in ("grid", "box"):
            check_files(here, *what[1:])
        if what[0] == "box":
            moving, held = {**RUN, "Flat/Velocity": "2, 1.5", "Flat/Profile": WAVES[3]}, {key: value for key, value in what[2].items() if "Held" in key}
            check_alike(here, {**moving, **what[2]}, {**moving, **held, **bricks(here)})
        if what[0] == "grid":
            check_resume(here, what[2])
            check_sentences(here, what[2])
