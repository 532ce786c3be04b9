"""Springs, dashpots, masses, pressures and absorption at the sides, in the program, on a plane grid, a box, and meshes in 2D and 3D, under every
kind of top. Runs are the same on 1, 2 and 3 ranks, close their energy and are continued bit for bit; a box and a mesh of its bricks move alike. A
body between pressures and springs has the uniform stress that they ask for. A wave leaves through a side that absorbs, on time."""

import csv
import tempfile

import h5py
import numpy as np

from four_bodies import PLANE, bodies, bricks, check_alike, check_ranks_and_restart, histories, refuses
from scenes import Folder, prm

PRESSURE = 5e6
RUN = {"Flat/Velocity": 2, "Friction/Coefficient": 0.3, "Time/End time": 2e-5, "Time/Rayleigh beta": 4.4e-9, "Body/Rayleigh alpha": 1e4,
       "Body/Initial velocity": "0.1, -0.2", "Observation/Energy interval": 1, "Observation/History interval": 1, "Checkpoints/Keep": "true"}
SIDES = {"Supports/Left/Kind": "springs", "Supports/Left/Spring stiffness": "1e12, 2e12", "Supports/Left/Dashpot": "1e6, 2e6",
         "Supports/Left/Mass": 1.5, "Supports/Left/Motion": "1e-7*sin(1e6*t); 1e-3*t", "Supports/Left/Pressure": 1e6,
         "Supports/Right/Kind": "absorbing", "Supports/Right/Pressure": 2e6}
IN_3D = {"Supports/Front/Kind": "pressure", "Supports/Front/Pressure": 3e6, "Supports/Front/Ramp": "smooth", "Supports/Front/Ramp time": 1e-5,
         "Supports/Back/Kind": "absorbing", "Supports/Back/Held": "u_z"}
TOPS = {"pressure": {"Supports/Top/Kind": "pressure", "Supports/Top/Pressure": PRESSURE},
        "platen": {"Supports/Top/Kind": "platen", "Supports/Top/Pressure": PRESSURE, "Supports/Top/Platen mass": 1e-3},
        "springs": {"Supports/Top/Kind": "springs", "Supports/Top/Spring stiffness": "1e12", "Supports/Top/Mass": 2.0},
        "held": {"Supports/Top/Kind": "held"}}


def without_sides(body):
    return {key: value for key, value in body.items() if "Held" not in key}


def check_run(folder, name, first, body, top):
    in_3d = {key: value for key, value in IN_3D.items() if top != "platen" or "Held" not in key} if "3" in first else {}
    folder.write("run.prm", first + prm({**RUN, **SIDES, **in_3d, **TOPS[top], **without_sides(body)}))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run1")
    one, summary = check_ranks_and_restart(folder, (name, top)), folder.summary("run1")
    assert summary["energy_balance_residual"] < 1e-12, (name, top, summary["energy_balance_residual"])
    assert summary["supports"]["Right"]["absorbing"] and summary["supports"]["Left"]["mass"] == 1.5, summary["supports"]
    scale = np.abs(one["energy/elastic"]).max()
    assert one["energy/dashpots"].max() > 1e-3 * scale and np.diff(one["energy/dashpots"]).min() > -1e-12 * scale, (name, top)


def check_static(folder, name, first, body):
    """The flat carries the pressure of the top everywhere; the springs at the left yield by that of the right."""
    sides = {"Supports/Left/Kind": "springs", "Supports/Left/Spring stiffness": "1e13", "Supports/Right/Kind": "pressure", "Supports/Right/Pressure": 2e6}
    if "3" in first:
        sides |= {"Supports/Front/Kind": "springs", "Supports/Front/Spring stiffness": "0, 1e13", "Supports/Back/Kind": "pressure", "Supports/Back/Pressure": 3e6}
    folder.write("static.prm", first + prm({"Analysis": "static contact", "Flat/Velocity": 0, "Friction/Coefficient": 0, "Static contact/Tolerance": 1e-11,
                                            **TOPS["pressure"], **sides, **without_sides(body)}))
    for ranks in (1, 2):
        folder.run(0, "contact_dynamics", "static.prm", "--output", "static", ranks=ranks)
        with open(folder("static", "static_contact.csv"), encoding="ascii") as file:
            pressures = np.array([float(row["pressure [Pa]"]) for row in csv.DictReader(file)])
        assert np.allclose(pressures, PRESSURE, rtol=1e-8), (name, ranks, pressures)
        with h5py.File(folder("static", "dynamics.h5")) as file:
            u = file["snapshots/displacement"][-1].reshape(-1, 3 if "3" in first else 2)
        assert abs(u[:, 0].max() / -2e-7 - 1) < 1e-7 and ("3" not in first or abs(u[:, 1].max() / -3e-7 - 1) < 1e-7), (name, ranks, u.max(axis=0))


def check_absorption(folder, name, first, body):
    """A pulse of 15 mm along x through a body that does not widen: it leaves as it came, and what the pressure did is lost in the dashpots."""
    uncoupled = {"Phases/body/Stiffness" if "mesh" in name else "Body/Stiffness":
                 "36.54e9, 0, 0, 36.54e9, 0, 47.26e9, 13.785e9, 13.785e9, 12e9" if "3" in first else "36.54e9, 0, 47.26e9, 13.785e9"}
    speed, period = np.sqrt(36.54e9 / 1770), 3.3e-6
    pulse = {"Supports/Left/Kind": "pressure", "Supports/Left/Expression": f"if(t<{period}, 1e6*(1-cos(2*pi*t/{period}))/2, 0)",
             "Supports/Right/Kind": "absorbing", "Supports/Top/Kind": "free", "Flat/Gap": 1e-3, "Flat/Velocity": 0, "Time/End time": 1.2e-5,
             "Time/Rayleigh beta": 0, "Observation/Energy interval": 1}
    folder.write("pulse.prm", first + prm({**without_sides(body), **uncoupled, **pulse}))
    folder.run(0, "contact_dynamics", "pulse.prm", "--output", "pulse")
    energy = histories(folder, "pulse")
    done, left = energy["energy/external_work"][-1], (energy["energy/elastic"] + energy["energy/kinetic"])[-1]
    height = 4e-3 if "3" not in first else 4e-3 * 2e-3
    assert abs(done / (height * 1e12 * 3 / 8 * period / (1770 * speed)) - 1) < 0.01, (name, done)
    assert left < 1e-3 * done and abs(energy["energy/dashpots"][-1] / done - 1) < 2e-3, (name, left / done)
    arrived = energy["energy/time"][np.argmax(energy["energy/dashpots"] > 0.5 * done)]
    assert abs(arrived - 6e-3 * (0.5 if "3" in first else 1) / speed - 0.5 * period) < 0.05 * period, (name, arrived)


def check_corners(folder):
    """Friction is along the slip where sides give a contact node another inertia along each axis; corners of absorbing sides of a composite turned
    by 45 degrees, whose impedance couples the components, do not swing."""
    solid = {"Body/Density": 1180, "Body/Stiffness": "3.6e9, 1.2e9, 1.2e9, 3.6e9, 1.2e9, 3.6e9, 1.2e9, 1.2e9, 1.2e9", "Body/Size": "6e-3, 6e-3, 4.5e-3",
             "Body/Cells": "8, 8, 6", "Body/Rayleigh alpha": 1e5, "Time/Rayleigh beta": 1e-6, "Time/End time": 4e-4, "Flat/Velocity": "0.02, 0.014",
             "Friction/Law": "coulomb", "Friction/Coefficient": 0.4, "Contact map/Interval": 1e-5, "Supports/Top/Kind": "springs",
             "Supports/Top/Pressure": 2e6, "Supports/Top/Spring stiffness": "1e13, 1e13, 1e11", "Supports/Top/Dashpot": "1e6, 1e6, 1e6"}
    for kind in ({"Kind": "absorbing"}, {"Kind": "springs", "Dashpot": "1e8, 0, 0"}):
        sides = {f"Supports/{side}/{key}": value for side in ("Left", "Right") for key, value in kind.items()}
        folder.write("corner.prm", "set Dimension = 3\n" + prm({**solid, **sides}))
        folder.run(0, "contact_dynamics", "corner.prm", "--output", "corner")
        with h5py.File(folder("corner", "dynamics.h5")) as file:
            traction, slip = (file["contact_map/" + name][-1].reshape(-1, 2) for name in ("traction", "slip_velocity"))
            slides = (file["contact_map/state"][-1].ravel() == 2) & (np.hypot(*slip.T) > 1e-3)
        across = traction[:, 0] * slip[:, 1] - traction[:, 1] * slip[:, 0]
        angle = np.abs(across / (np.hypot(*traction.T) * np.hypot(*slip.T) + 1e-300))[slides]
        assert slides.sum() > 40 and angle.max() < 1e-4, (kind, slides.sum(), angle.max())
    folder.write("turned.prm", prm({"Body/Stiffness": "4.4e10, 3.4e10, 3.25e10, 4.4e10, 3.25e10, 3.6e10", "Body/Density": 1600, "Body/Size": "6e-3, 3e-3",
                                    "Body/Cells": "12, 6", "Friction/Law": "coulomb", "Friction/Coefficient": 0.3, "Time/Rayleigh beta": 0,
                                    "Time/End time": 1e-4, "Supports/Top/Pressure": 1e6, "Observation/Energy interval": 1,
                                    **{f"Supports/{side}/Kind": "absorbing" for side in ("Top", "Left", "Right")}}))
    folder.run(0, "contact_dynamics", "turned.prm", "--output", "turned")
    assert folder.summary("turned")["energy_balance_residual"] < 1e-12


def check_sentences(folder):
    refused = lambda words, *settings: refuses(folder, words, *settings)
    folder.write("run.prm", prm({"Body/Stiffness": PLANE, "Body/Density": 1770, "Body/Size": "0.006, 0.004", "Body/Cells": "12, 9"}))
    assert refused("Supports/Left/Kind: it is springs, but", "Supports/Left/Kind=springs")
    assert refused("Supports/Left/Pressure: it is 0, but", "Supports/Left/Kind=pressure")
    assert refused("Supports/Left/Held has no effect", "Supports/Left/Kind=held", "Supports/Left/Held=u_x")
    assert refused("Supports/Left/Dashpot has no effect", "Supports/Left/Dashpot=1e6")
    assert refused("neither Spring stiffness nor Dashpot", "Supports/Left/Kind=springs", "Supports/Left/Mass=1", "Supports/Left/Motion=t")
    assert refused("Supports/Front/Held has no effect, as the body is plane", "Supports/Front/Held=u_x")
    assert refused("Left and Right have to be free", "Sides/Periodic=true", "Supports/Right/Kind=absorbing")
    assert refused("Held: u_x is held, so that Spring stiffness", "Supports/Right/Kind=springs", "Supports/Right/Spring stiffness=1e12",
                   "Supports/Right/Held=u_x")
    assert refused("Pressure: it has no effect, as u_x is held", "Supports/Right/Kind=pressure", "Supports/Right/Pressure=1", "Supports/Right/Held=u_x")
    assert refused("Traction: a top that absorbs is held along the flat", "Analysis=static contact", "Supports/Top/Kind=absorbing",
                   "Supports/Top/Traction=1e6", "Time/End time=0.0005", "Time/Rayleigh beta=0")
    assert refused("Mass: the top is held from", "Supports/Top/Hold from=1e-5", "Supports/Left/Kind=springs", "Supports/Left/Mass=1")
    assert refused("Supports/Right/Motion", "Supports/Right/Kind=springs", "Supports/Right/Spring stiffness=1e12", "Supports/Right/Motion=1/t")
    assert refused("is called 'Supports/Top/Kind' now", "Top/Kind=held") and refused("is called 'Supports/Left/Held' now", "Sides/Left=u_x")
    assert refused("'Supports/<group>/Held = u_x' now", "Mesh/Held in x=Left")
    warned = lambda words, *settings: words in folder.run(0, "contact_dynamics", "run.prm", "--validate",
                                                          *[arg for text in settings for arg in ("--set", text)])
    assert warned("Supports/Left/Spring stiffness", "Supports/Left/Kind=springs", "Supports/Left/Spring stiffness=2e19")
    assert warned("Supports/Left/Dashpot", "Supports/Left/Kind=springs", "Supports/Left/Dashpot=1e14")
    stopped = folder.run(3, "contact_dynamics", "run.prm", "--set", "Supports/Left/Kind=pressure", "--set", "Supports/Left/Expression=if(t<1e-6,1,1/0)")
    assert "Supports/Left/Expression is infinite" in stopped, stopped


with tempfile.TemporaryDirectory() as path:
    here = Folder(path)
    for what in bodies(here):
        for kind in TOPS:
            check_run(here, *what, kind)
        check_static(here, *what)
        check_absorption(here, *what)
        if what[0] == "box":
            check_alike(here, *({**RUN, **SIDES, **IN_3D, **TOPS["springs"], **keys} for keys in (without_sides(what[2]), bricks(here))))
    check_corners(here)
    check_sentences(here)
