"""A deformable counter body below a plane grid: bars that meet exchange their velocities by their impedances; a stiffer and heavier counter body becomes the
rigid flat, on springs between them as well; runs with laws of friction are the same on 1, 2 and 3 ranks, close their energy and are continued bit for
bit; what a counter body does not go with is refused, and what the sentences advise works."""

import tempfile

import h5py
import numpy as np

from four_bodies import check_ranks_and_restart, histories, refuses
from scenes import Folder, prm

UNCOUPLED, DENSITY, LENGTH, SPEED = "40e9, 0, 40e9, 13e9", 1600.0, 8e-3, 0.5
SOLID = {"Body/Stiffness": "36.54e9, 9.1e9, 47.26e9, 13.785e9", "Body/Density": 1770, "Body/Size": "6e-3, 4e-3", "Body/Cells": "12, 8"}
STEEL = {"Counter body/Stiffness": "2.8e11, 1.2e11, 2.8e11, 0.8e11", "Counter body/Density": 7800, "Counter body/Size": "6e-3, 3e-3", "Counter body/Cells": "12, 5"}


def check_bars(folder):
    """Bars of equal travel time part after 2 L / c, with (Z2 - Z1) / (Z1 + Z2) and -2 Z1 / (Z1 + Z2) of the velocity of the upper one: F = Z1 Z2 v / (Z1 +
    Z2) acts as long."""
    time = 2 * LENGTH / np.sqrt(40e9 / DENSITY)
    for ratio in (1.0, 3.0, 0.4):  # of impedances
        scaled = ", ".join(str(ratio * float(number)) for number in UNCOUPLED.split(","))
        folder.write("bars.prm", prm({"Body/Stiffness": UNCOUPLED, "Body/Density": DENSITY, "Body/Size": f"1e-3, {LENGTH}", "Body/Cells": "2, 200",
                                      "Counter body/Stiffness": scaled, "Counter body/Density": ratio * DENSITY, "Counter body/Size": f"1e-3, {LENGTH}",
                                      "Counter body/Cells": "2, 200", "Counter body/Supports/Bottom/Kind": "free", "Body/Initial velocity": f"0, {-SPEED}",
                                      "Supports/Top/Kind": "free", "Flat/Gap": 1e-8, "Flat/Velocity": 0, "Friction/Coefficient": 0, "Time/Rayleigh beta": 0,
                                      "Time/End time": 2 * time, "Snapshots/Interval": 0.05 * time, "Observation/History interval": 1, "Observation/Energy interval": 1}))
        folder.run(0, "contact_dynamics", "bars.prm", "--output", "bars", "--quiet")
        velocity = []
        for name in ("dynamics.h5", "counter_body.h5"):
            with h5py.File(folder("bars", name)) as file:
                u, t = file["snapshots/displacement"][()], file["snapshots/time"][()]
            late = t > 1.2 * time
            velocity.append(np.polyfit(t[late], u[late][:, 1:-1, 1, 1].mean(axis=1), 1)[0] / SPEED)
        expected = (ratio - 1) / (ratio + 1), -2 / (ratio + 1)
        assert np.abs(np.subtract(velocity, expected)).max() < 0.01, (ratio, velocity, expected)
        run = histories(folder, "bars")
        pressed = run["history/time"][run["history/contact_normal_force"] > 0]
        assert abs((pressed[-1] - pressed[0]) / time - 1) < 0.03, (ratio, (pressed[-1] - pressed[0]) / time)
        force = np.sqrt(40e9 * DENSITY) * ratio / (1 + ratio) * SPEED * 1e-3
        middle = np.abs(run["history/time"] - 0.5 * time) < 0.3 * time
        assert abs(run["history/contact_normal_force"][middle].mean() / force - 1) < 0.01, ratio
        assert folder.summary("bars")["energy_balance_residual"] < 1e-12


def check_rigid(folder):
    """The difference to the rigid flat falls with one over the stiffness."""
    common = {**SOLID, "Flat/Velocity": 1, "Friction/Coefficient": 0.3, "Supports/Top/Pressure": 3e6, "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 1e-5, "Friction/Regularization time": 1e-7, "Time/Time step": 2e-8, "Time/End time": 2e-5,
              "Observation/History interval": 1}
    for more in ({}, {"Flat/Normal stiffness": 1e14}):
        found = []
        for stiffness in (0, 1e3, 1e4, 1e5):
            counter = {"Counter body/Stiffness": ", ".join(str(stiffness * number) for number in (40e9, 9e9, 40e9, 13e9)), "Counter body/Density": stiffness * 1800,
                       "Counter body/Size": "6e-3, 2e-3", "Counter body/Cells": "12, 4"} if stiffness else {}
            folder.write("rigid.prm", prm({**common, **more, **counter}))
            folder.run(0, "contact_dynamics", "rigid.prm", "--output", "rigid", "--quiet")
            found.append(histories(folder, "rigid")["history/contact_tangential_force"])
        errors = [np.abs(values - found[0]).max() / np.abs(found[0]).max() for values in found[1:]]
        assert errors[0] < 0.05 and all(5 < coarse / fine < 15 for coarse, fine in zip(errors, errors[1:])), (more, errors)


def check_runs(folder):
    laws = [{"Friction/Law": "coulomb"}, {"Friction/Coefficient law": "static and kinetic", "Friction/Law": "coulomb"},
            {"Friction/Law": "constant time", "Friction/Regularization time": 1e-6, "Flat/Normal stiffness": 1e14, "Time/Beta2": 0.7}]
    for law in laws:
        supports = {"Counter body/Supports/Left/Kind": "absorbing", "Counter body/Supports/Right/Kind": "platen", "Counter body/Supports/Right/Platen mass": 1e-3,
                    "Counter body/Supports/Bottom/Kind": "springs", "Counter body/Supports/Bottom/Spring stiffness": "1e13, 2e13",
                    "Counter body/Supports/Bottom/Motion": "1e-7*sin(1e6*t); -1e-3*t", "Counter body/Rayleigh alpha": 1e4, "Counter body/Rayleigh beta": 1e-9}
        folder.write("run.prm", prm({**SOLID, **STEEL, **supports, **law, "Flat/Velocity": 2, "Friction/Coefficient": 0.3, "Supports/Top/Pressure": 5e6,
                                     "Body/Acceleration": "1e4, -2e4", "Time/End time": 2e-5, "Observation/Energy interval": 1, "Observation/History interval": 1,
                                     "Checkpoints/Keep": "true", "Snapshots/Interval": 5e-6}))
        folder.run(0, "contact_dynamics", "run.prm", "--output", "run1")
        check_ranks_and_restart(folder, law)
        summary = folder.summary("run1")
        assert summary["energy_balance_residual"] < 1e-12, (law, summary["energy_balance_residual"])
        assert "Counter body: 12 x 5 cells" in folder.read("run1", "log.txt").decode()
        with h5py.File(folder("run1", "dynamics.h5")) as file:
            assert file["run"].attrs["counter_body"].decode().startswith("0.006 x 0.003 m"), file["run"].attrs["counter_body"]


def check_sentences(folder):
    folder.write("run.prm", prm(STEEL))
    assert refuses(folder, "the homogenization of friction knows no counter body", "Analysis=friction homogenization", "Friction homogenization/Heterogeneous run=run")
    folder.write("run.prm", prm({**SOLID, **STEEL}))
    refused = lambda words, *settings: refuses(folder, words, *settings)
    assert refused("Flat/Profile; leave one of the two out", "Flat/Profile=1e-7*sin(x)")
    assert refused("goes from 0 to 0.005 m along x, but the body comes above 0 to 0.006 m; make it longer", "Counter body/Size=5e-3, 3e-3")
    assert "nodes do not match" in folder.run(0, "contact_dynamics", "run.prm", "--validate", "--set", "Counter body/Cells=10, 5")
    assert refused("Counter body/Supports/Left/Kind: Sides/Periodic is true", "Sides/Periodic=true", "Counter body/Supports/Left/Kind=absorbing")
    assert refused("u_y is held, but not all components", "Counter body/Supports/Bottom/Kind=free", "Counter body/Supports/Bottom/Held=u_y")
    assert refused("Time/Time step: 9e-08 s is above the critical", "Time/Time step=9e-8")
    folder.write("none.prm", prm({**SOLID, "Counter body/Density": 1000}))
    assert "Counter body/Density has no effect, as Counter body/Size is empty" in folder.run(2, "contact_dynamics", "none.prm", "--validate")


with tempfile.TemporaryDirectory() as place:
    here = Folder(place)
    check_bars(here)
    check_rigid(here)
    check_runs(here)
    check_sentences(here)
