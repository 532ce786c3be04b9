"""Flat/Tangential stiffness in the program, on a plane grid, a box, and meshes in 2D and 3D, on 1, 2 and 3 ranks. A layer that the flat drags through
springs carries the traction of springs and layer in series until it slides; runs are the same on all ranks, close their energy and are continued bit
for bit; springs that are stiff are none; a solid that is dragged along y moves as one along x; coefficients that depend on the pressure
know the force of each node, on springs and over a profile."""

import csv
import tempfile

import h5py
import numpy as np

from four_bodies import bodies, check_ranks_and_restart, histories
from scenes import Folder, prm

PRESSURE, STIFFNESS, FRICTION = 5e6, 2e12, 0.3
STATIC = {"Analysis": "static contact", "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": PRESSURE, "Supports/Top/Held": "u_x", "Flat/Velocity": 0,
          "Friction/Coefficient": FRICTION, "Flat/Tangential stiffness": STIFFNESS, "Static contact/Tolerance": 1e-9}
RUN = {"Flat/Expression": "2*cos(2*pi*t/8e-6)", "Flat/Tangential stiffness": 2e13, "Supports/Top/Pressure": PRESSURE, "Friction/Coefficient": FRICTION,
       "Time/End time": 2e-5, "Time/Rayleigh beta": 4.4e-9, "Observation/Energy interval": 1, "Observation/History interval": 1,
       "Checkpoints/Keep": "true"}


def check_layer(folder):
    """Of a periodic plane layer, exact: T = d / (1/k_t + H/G), at most mu p, and back along the springs alone."""
    layer = {"Body/Stiffness": "36.54e9, 0, 47.26e9, 13.785e9", "Body/Density": 1770, "Body/Size": "0.003, 0.004", "Body/Cells": "6, 8",
             "Sides/Periodic": "true"}
    series = 1 / (1 / STIFFNESS + 0.004 / 13.785e9)
    for share, steps in ((0.4, 1), (0.9, 4), (1.7, 4)):
        moved = share * FRICTION * PRESSURE / series
        folder.write("layer.prm", prm({**STATIC, **layer, "Static contact/Flat displacement": moved, "Static contact/Load steps": steps}))
        folder.run(0, "contact_dynamics", "layer.prm", "--output", "layer")
        with open(folder("layer", "static_contact.csv"), encoding="ascii") as file:
            rows = list(csv.DictReader(file))
        for row in rows:
            found, due = float(row["shear_traction [Pa]"]), min(share, 1) * FRICTION * PRESSURE
            assert abs(found / due - 1) < 1e-7, (share, found, due)
            assert row["state"] == ("stick" if share < 1 else "slip"), (share, row)


def check_static(folder, name, first, body):
    """Ranks agree; through springs the flat drags less than without, and more nodes stick."""
    found = {}
    for key, settings in {"springs": [], "stiff": ["--set", "Flat/Tangential stiffness=1e22"], "rigid": ["--set", "Flat/Tangential stiffness=auto"]}.items():
        # The sides do not hold what the flat drags.
        keys = {**STATIC, **body, "Static contact/Flat displacement": 3e-7, "Static contact/Load steps": 3}
        keys = {path: value for path, value in keys.items() if path not in ("Supports/Left/Held", "Supports/Right/Held")}
        folder.write("static.prm", first + prm(keys))
        for ranks in (1, 2, 3) if key == "springs" else (1,):
            folder.run(0, "contact_dynamics", "static.prm", "--output", "static", *settings, ranks=ranks)
            with open(folder("static", "static_contact.csv"), encoding="ascii") as file:
                rows = list(csv.DictReader(file))
            shear = np.array([float(row["shear_traction [Pa]"]) for row in rows])
            pressure = np.array([float(row["pressure [Pa]"]) for row in rows])
            assert np.all(np.abs(shear) <= FRICTION * pressure * (1 + 1e-6) + 1), (name, ranks)
            reference = found.setdefault(key, (shear, sum(row["state"] == "stick" for row in rows)))[0]
            assert np.abs(shear - reference).max() < 1e-5 * np.abs(reference).max(), (name, ranks)
    assert np.abs(found["stiff"][0] - found["rigid"][0]).max() < 1e-5 * np.abs(found["rigid"][0]).max(), name
    assert np.abs(found["springs"][0]).mean() < 0.98 * np.abs(found["rigid"][0]).mean() and found["springs"][1] > found["rigid"][1] - 1, (name, found)


def check_run(folder, name, first, body):
    folder.write("run.prm", first + prm({**RUN, **body}))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run1")
    one, summary = check_ranks_and_restart(folder, name), folder.summary("run1")
    assert summary["energy_balance_residual"] < 1e-12 and summary["tangential_stiffness"] == 2e13, (name, summary["energy_balance_residual"])
    assert one["energy/contact"].max() > 0, name
    folder.run(0, "contact_dynamics", "run.prm", "--output", "stiff", "--set", "Flat/Tangential stiffness=1e22")
    folder.run(0, "contact_dynamics", "run.prm", "--output", "rigid", "--set", "Flat/Tangential stiffness=auto")
    stiff, rigid = histories(folder, "stiff"), histories(folder, "rigid")
    for key in ("history/contact_normal_force", "history/contact_tangential_force", "energy/elastic", "energy/friction"):
        assert np.abs(stiff[key] - rigid[key]).max() < 1e-4 * np.abs(rigid[key]).max(), (name, key)
        assert np.abs(one[key] - rigid[key]).max() > 1e-3 * np.abs(rigid[key]).max(), (name, key)


def check_turned(folder):
    """A square column, whose stiffness is the same along x and y."""
    column = {"Body/Stiffness": "3.6e9, 1.2e9, 1.2e9, 3.6e9, 1.2e9, 3.6e9, 1.2e9, 1.2e9, 1.2e9", "Body/Density": 1180, "Body/Size": "4e-3, 4e-3, 3e-3",
              "Body/Cells": "6, 6, 5"}
    found = {}
    for along, velocity in {"x": "2, 0", "y": "0, 2", "askew": "1.4142135623730951, 1.4142135623730951"}.items():
        keys = {key: value for key, value in RUN.items() if key not in ("Flat/Expression", "Checkpoints/Keep")}
        folder.write("turned.prm", "set Dimension = 3\n" + prm({**keys, **column, "Flat/Velocity": velocity, "Flat/Ramp": "linear", "Flat/Ramp time": 1e-5}))
        folder.run(0, "contact_dynamics", "turned.prm", "--output", along)
        found[along] = histories(folder, along)
    for key in ("history/contact_normal_force", "energy/elastic", "energy/friction", "energy/contact"):
        size = np.abs(found["x"][key]).max()
        assert np.abs(found["x"][key] - found["y"][key]).max() < 1e-9 * size, key
        assert 0 < np.abs(found["x"][key] - found["askew"][key]).max() < 0.1 * size, key


def check_turn(folder):
    """A thin layer, slow enough to be in equilibrium, with T in closed form: it slides, and sticks on its springs again when the flat turns faster
    than the limit of friction falls; under a pressure that rises it slides on when the flat is faster than that, and never sticks."""
    layer = {"Sides/Periodic": "true", "Supports/Top/Kind": "pressure", "Supports/Top/Held": "u_x", "Flat/Tangential stiffness": 1e12,
             "Friction/Law": "coulomb", "Friction/Coefficient": 0.25, "Observation/History interval": 1, "Body/Rayleigh alpha": 1e6, "Body/Density": 1770}
    plane = {"Body/Stiffness": "36.54e9, 0, 47.26e9, 13.785e9", "Body/Size": "1e-3, 5e-4", "Body/Cells": "2, 1", **layer}
    solid = {"Body/Stiffness": "36.54e9, 0, 0, 36.54e9, 0, 47.26e9, 13.785e9, 13.785e9, 13.785e9", "Body/Size": "1e-3, 1e-3, 5e-4", "Body/Cells": "2, 2, 1",
             **layer, "Sides/Periodic in y": "true"}
    series = 1 / (1e-12 + 5e-4 / 13.785e9)
    turns = {"Supports/Top/Expression": "5e6*if(t<5e-5,t/5e-5,if(t<2e-4,1,1-0.4*(t-2e-4)/1e-4))",
             "Flat/Expression": "if(t<5e-5,0,if(t<2.2e-4,0.05,-0.01))", "Time/End time": 3e-4}
    rises = {"Supports/Top/Expression": "2.5e6*if(t<5e-5,t/5e-5,if(t<1.5e-4,1,1+0.8*(t-1.5e-4)/1e-4))",
             "Flat/Expression": f"if(t<5e-5,0,if(t<1.4e-4,0.05,{1.5 * 0.25 * 2e10 / series}))", "Time/End time": 2.5e-4}
    for first, body in (("", plane), ("set Dimension = 3\n", solid)):
        for law in ("coulomb", "constant time"):
            settings = {**body, **turns, "Friction/Law": law, **({"Friction/Regularization time": 1e-6} if law != "coulomb" else {})}
            folder.write("turn.prm", first + prm(settings))
            folder.run(0, "contact_dynamics", "turn.prm", "--output", "turn")
            one, size = histories(folder, "turn"), 1e-3 * (1e-3 if first else 1)
            time, traction = one["history/time"], one["history/contact_tangential_force"] / size
            at = np.searchsorted(time, 2.95e-4)
            due = 0.25 * 5e6 * (1 - 0.4 * 0.2) - 0.01 * series * (time[at] - 2.2e-4)
            assert abs(traction[at] - due) < 0.02 * 1.25e6 and one["history/slipping_nodes"][at] == 0, (first, law, traction[at], due)
        folder.write("rise.prm", first + prm({**body, **rises}))
        folder.run(0, "contact_dynamics", "rise.prm", "--output", "rise")
        one = histories(folder, "rise")
        late = one["history/time"] > 1.8e-4
        assert one["history/sticking_nodes"][late].max() == 0, first
        assert np.allclose(one["history/contact_tangential_force"][late], 0.25 * one["history/contact_normal_force"][late], rtol=1e-9), first
    # Nothing touches, so nothing rubs; and a flat that moves while the pressure begins blows nothing up.
    folder.write("nothing.prm", prm({"Body/Size": "0.056, 0.016", "Body/Cells": "56, 16", "Flat/Tangential stiffness": 1e13, "Time/End time": 2e-5,
                                     "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 5e-4}))
    folder.run(0, "contact_dynamics", "nothing.prm", "--output", "begins")
    folder.run(0, "contact_dynamics", "nothing.prm", "--output", "nothing", "--set", "Supports/Top/Pressure=0", "--set", "Supports/Top/Ramp=step",
               "--set", "Supports/Top/Ramp time=0")
    assert np.all(histories(folder, "nothing")["energy/friction"] == 0)


def check_pressure(folder, name, first, body):
    """Friction of 1 MPa whatever the pressure: its coefficient is that over the force of the node in this step."""
    dim = 3 if "3" in first else 2
    folder.write("pressure.prm", first + prm({
        **{key: value for key, value in RUN.items() if key not in ("Friction/Coefficient", "Flat/Expression")}, **body, "Flat/Velocity": 20,
        "Flat/Normal stiffness": 2e13, "Flat/Gap": 1e-6, "Flat/Profile": "1e-6*sin(2*pi*x/3e-3)", "Friction/Law": "coulomb",
        "Friction/Coefficient law": "expression", "Friction/Coefficient expression": "1e6/max(p, 1e3)", "Contact map/Interval": 1e-6}))
    power = ["--set", "Flat/Normal exponent=2", "--set", "Flat/Normal stiffness at=5e6"] if name in ("grid", "mesh3") else []
    folder.run(0, "contact_dynamics", "pressure.prm", "--output", "pressure", *power)
    with h5py.File(folder("pressure", "dynamics.h5")) as file:
        traction, pressure, state = (file["contact_map/" + key][()] for key in ("traction", "pressure", "state"))
    slides = (state == 2) & (pressure > 2e6)
    size = np.hypot(traction[..., 0], traction[..., 1])[slides] if dim == 3 else np.abs(traction.reshape(state.shape)[slides])
    assert slides.sum() > 20, (name, slides.sum())
    assert np.abs(size / 1e6 - 1).max() < 1e-5, (name, size.min(), size.max())  # the map has floats


with tempfile.TemporaryDirectory() as path:
    here = Folder(path)
    check_layer(here)
    for what in bodies(here):
        check_static(here, *what)
        check_run(here, *what)
        check_pressure(here, *what)
    check_turned(here)
    check_turn(here)
    assert "knows no Flat/Tangential stiffness" in here.run(2, "contact_dynamics", "run.prm", "--set", "Friction/Law=slip rate", "--validate")
