"""Runs that start from the end of another one (Time/Continue from): the motion of one long run, on grids, boxes and meshes, on one rank and
on two, with springs, damping, laws of friction with a memory, after a ramp; and what is refused."""

import os
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import TOP, Folder, prm
from start import BODIES, PHASE

STEP, STEPS = 2e-8, 400
LONG = {"Time/Time step": STEP, "Flat/Velocity": 2, "Friction/Coefficient": 0.3,
        "Observation/History interval": 1, "Observation/Energy interval": 1, "Time/Rayleigh beta": 2e-9, "Supports/Top/Pressure": 5e6}
LAGS = {"Friction/Law": "constant time", "Friction/Regularization time": 1e-6}
KINDS = {"platen": {**LAGS, "Supports/Top/Kind": "platen", "Supports/Top/Platen mass": 2e-3},
         "springs": {**LAGS, "Supports/Top/Kind": "platen", "Supports/Top/Spring stiffness": 1e13, "Supports/Top/Dashpot": 1e6},
         "pressure": {**LAGS, "Supports/Top/Kind": "pressure", "Body/Acceleration": "10, 20", "Flat/Normal stiffness": 1e14},
         "memory": {"Friction/Law": "coulomb", "Friction/Coefficient law": "linear slip weakening", "Friction/Kinetic coefficient": 0.2,
                    "Friction/Critical slip": 1e-6, "Friction/Healing": "sticking"},
         "stretched": {"Friction/Law": "coulomb", "Flat/Tangential stiffness": 1e14}}


def history(folder, name):
    with h5py.File(folder(name + "/dynamics.h5")) as file:
        names = ("contact_normal_force", "contact_tangential_force", "sticking_nodes", "top_displacement")
        return {key: file["history/" + key][()] for key in names}, {key: file["energy/" + key][()] for key in ("elastic", "kinetic")}


def check(folder, body, kind, ranks):
    dim, keys = BODIES[body]
    keys = {**LONG, **keys, **KINDS[kind], "Dimension": dim}
    if dim == 3 and "Body/Acceleration" in KINDS[kind]:
        keys["Body/Acceleration"] = "10, 5, 20"
    if "Mesh/File" in keys:
        Box([6e-3, 4e-3] if dim == 2 else [4e-3, 2e-3, 3e-3], [6, 4] if dim == 2 else [4, 2, 3], lambda x: "matrix", "simplex").name_side(
            "Contact", dim - 1, False).name_side("Top", dim - 1, True).write(folder(keys["Mesh/File"]))
        keys |= {"Phases/Names": "matrix", **{f"Phases/matrix/{key}": value for key, value in PHASE.items()}, "Mesh/Scale": 1}
    run = lambda name, steps, more: (folder.write(name + ".prm", prm({**keys, "Time/End time": STEP * steps, **more})),  # noqa: E731
                                     folder.run(0, "contact_dynamics", name + ".prm", "--output", name, ranks=ranks))[1]
    run("first", STEPS, {"Checkpoints/Write end": "true"})
    said = run("second", STEPS, {"Time/Continue from": "first"})
    assert "Starts from the end of" in said, said
    run("whole", 2 * STEPS, {})
    (whole, energy), (second, of_second) = history(folder, "whole"), history(folder, "second")
    worst = 0.0
    for name, values in whole.items():
        n = len(second[name])
        worst = max(worst, np.abs(values[-n:] - second[name]).max() / np.abs(values).max()) if np.abs(values).max() > 0 else worst
    for name, values in energy.items():
        n = len(of_second[name])
        worst = max(worst, np.abs(values[-n:] - of_second[name]).max() / np.abs(values).max())
    balance = folder.summary("second")["energy_balance_residual"]
    print(f"{body}, {kind}, {ranks} ranks: the second half differs by {worst:.1e}, energy balance {balance:.1e}")
    assert worst < 1e-6 and balance < 1e-9, (worst, balance)


def check_refusals(folder):
    keys = {**LONG, **LAGS, **BODIES["grid"][1], "Time/End time": 1e-6}
    first = {**keys, "Checkpoints/Write end": "true"}
    folder.write("first.prm", prm(first))
    folder.run(0, "contact_dynamics", "first.prm", "--output", "first")
    for change, sentence in (({"Time/Continue from": "nowhere"}, "Checkpoints/Write end = true"),
                             ({"Body/Cells": "12, 8", "Time/Time step": 1e-8}, "runs of the same body"),
                             ({"Flat/Expression": "2*t"}, "depends on time"),
                             ({"Body/Initial velocity": "1, 0"}, "Body/Initial velocity has no effect")):
        folder.write("second.prm", prm({**keys, "Time/Continue from": "first", **change}))
        said = folder.run(2, "contact_dynamics", "second.prm", "--output", "second")
        assert sentence in said, (sentence, said)
    folder.write("second.prm", prm({**keys, "Time/Continue from": "first"}))
    said = folder.run(2, "contact_dynamics", "second.prm", "--output", "second", ranks=2)
    assert "1 ranks" in said, said


def check_ramps(folder):
    """After a ramp, which is over, the load stays."""
    keys = {**LONG, **LAGS, **BODIES["grid"][1], "Supports/Top/Ramp": "linear", "Supports/Top/Ramp time": 4e-6, "Flat/Ramp": "smooth", "Flat/Ramp time": 4e-6}
    for name, steps, more in (("first", 300, {"Checkpoints/Write end": "true"}), ("second", 100, {"Time/Continue from": "first"}), ("whole", 400, {})):
        folder.write(name + ".prm", prm({**keys, "Time/End time": STEP * steps, **more}))
        folder.run(0, "contact_dynamics", name + ".prm", "--output", name)
    whole, second = history(folder, "whole")[0]["top_displacement"], history(folder, "second")[0]["top_displacement"]
    assert np.abs(whole[-len(second):] - second).max() < 1e-6 * np.abs(whole).max()
    # Another load is reached over the ramp, from the one of before.
    folder.write("third.prm", prm({**keys, "Time/End time": STEP * 300, "Time/Continue from": "first", "Supports/Top/Pressure": 8e6}))
    folder.run(0, "contact_dynamics", "third.prm", "--output", "third")
    with h5py.File(folder("third/dynamics.h5")) as file:
        pressure = file["history/top_normal_force"][()] / 6e-3
    due = 5e6 + 3e6 * np.minimum(1, STEP * np.arange(len(pressure)) / 4e-6)
    assert np.abs(pressure - due).max() < 1e-6 * 8e6, np.abs(pressure - due).max()


def check_branches(folder):
    """A pin on a spring sticks and slips up to the velocity at which a rigid block with a dashpot slides on; on the way down it slides."""
    speeds, limit = (0.10, 0.125, 0.14, 0.165, 0.18), 0.149
    said = folder.run(0, "contact_dynamics", os.path.join(TOP, "prm", "examples", "branches.prm"), "--output", "branches", "--ignore-unused", "--set",
                      "Sweep/velocity/Values=" + ", ".join(map(str, speeds)), "--set", "Sweep/velocity/Number=0", "--set", "Sweep/velocity/From=0", "--set",
                      "Sweep/velocity/To=0", cwd=folder.path)
    with h5py.File(folder("branches/map.h5")) as file:
        sticks = file["numbers/stick_fraction"][()].reshape(2, -1)
    print("shares of stick, up and down", sticks)
    assert "10 of 10 points are done" in said and np.all((sticks[0] > 0.1) == (np.array(speeds) < limit)) and np.all(sticks[1] == 0), sticks


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        for kind in KINDS:
            check(folder, "grid", kind, 1)
        for body in ("box", "triangles", "tetrahedra"):
            for kind in ("springs", "stretched"):
                check(folder, body, kind, 1)
        for body in ("grid", "box", "tetrahedra"):
            check(folder, body, "platen", 2)
        check_ramps(folder)
        check_refusals(folder)
        check_branches(folder)


if __name__ == "__main__":
    main()
