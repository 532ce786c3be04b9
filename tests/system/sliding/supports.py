"""Springs, dashpots, masses and far ends at the top, in the program, on a plane grid, a box, and meshes in 2D and 3D, on 1, 2 and 3 ranks: modes are
those of the column on springs and under a platen on springs, its static contact carries what the springs leave, and runs on springs, under a platen on springs and under a top
that absorbs are the same on all ranks, close their energy and are continued bit for bit. Modes of static sliding need no support of their own."""

import csv
import tempfile

import h5py
import numpy as np
from scipy.linalg import eigh
from scipy.optimize import brentq

from four_bodies import bodies, check_ranks_and_restart
from scenes import Folder, prm

HEIGHT, DENSITY, D, PRESSURE = 4e-3, 1770.0, 47.26e9, 5e6
STIFFNESS, MASS = 3e12, 2.0
MODAL = {"Analysis": "modal", "Modal/Bottom": "free", "Modal/Number of modes": 4}
STATIC = {"Analysis": "static contact", "Supports/Top/Pressure": PRESSURE, "Flat/Velocity": 0, "Friction/Coefficient": 0,
          "Static contact/Tolerance": 1e-10}
RUN = {"Flat/Velocity": 2, "Supports/Top/Pressure": PRESSURE, "Friction/Coefficient": 0.3, "Time/End time": 2e-5, "Time/Rayleigh beta": 4.4e-9,
       "Observation/Energy interval": 1, "Observation/History interval": 1, "Checkpoints/Keep": "true"}
TOPS = {"springs": {"Supports/Top/Kind": "springs", "Supports/Top/Spring stiffness": "1e12, 3e12", "Supports/Top/Dashpot": "2e6, 1e6", "Supports/Top/Mass": MASS, "Supports/Top/Motion":
                    "1e-7*sin(1e6*t); 1e-3*t"},
        "platen": {"Supports/Top/Kind": "platen", "Supports/Top/Dashpot": "2e6", "Supports/Top/Platen mass": 1e-3,
                   "Supports/Top/Motion": "1e-2*t"},
        "absorbing": {"Supports/Top/Kind": "absorbing"}}


def tops(first):
    """Springs of each node, with a mass, and a platen of this mass on springs."""
    area = 3e-3 * 2e-3 if "3" in first else 6e-3
    return {"springs": {"Supports/Top/Kind": "springs", "Supports/Top/Mass": MASS}, "platen": {"Supports/Top/Kind": "platen", "Supports/Top/Platen mass": MASS * area}}


def freed(body):
    """Without what holds its sides, whose corners a platen moves."""
    return {key: value for key, value in body.items() if "Held" not in key}


def along_normal(first, value):
    return f"0, 0, {value}" if "3" in first else f"0, {value}"


def chain_frequency(cells):
    """Lowest (Hz) of the column in so many cells on springs, with lumped masses."""
    h = HEIGHT / cells
    K, mass = np.zeros((cells + 1, cells + 1)), np.full(cells + 1, DENSITY * h)
    for k in range(cells):
        K[k:k + 2, k:k + 2] += D / h * np.array([[1, -1], [-1, 1]])
    mass[[0, -1]] /= 2
    K[-1, -1] += STIFFNESS
    mass[-1] += MASS
    return np.sqrt(eigh(K, np.diag(mass), eigvals_only=True)[0]) / (2 * np.pi)


def exact_frequency():
    Z, c = np.sqrt(DENSITY * D), np.sqrt(D / DENSITY)
    balance = lambda w: w * Z * np.tan(w * HEIGHT / c) - STIFFNESS + MASS * w * w
    return brentq(balance, 1.0, np.pi / 2 * c / HEIGHT * (1 - 1e-12)) / (2 * np.pi)


def check_modes(folder, top, name, first, body):
    folder.write("modal.prm", first + prm({**MODAL, **tops(first)[top], **body, "Supports/Top/Spring stiffness": along_normal(first, STIFFNESS)}))
    seen = []
    for ranks in (1, 2, 3):
        folder.run(0, "contact_dynamics", "modal.prm", "--output", "modal", ranks=ranks)
        seen.append(np.array(folder.summary("modal")["frequencies"]["free"]))
        assert np.allclose(seen[-1], seen[0], rtol=1e-7), (name, ranks, seen)
    of_column = lambda frequency: np.min(np.abs(seen[0] / frequency - 1))
    cells = {"grid": 9, "box": 8}.get(name)
    if cells:
        assert of_column(chain_frequency(cells)) < 1e-8, (name, seen[0], chain_frequency(cells))
    assert of_column(exact_frequency()) < 0.01, (name, seen[0], exact_frequency())


def check_complex(folder, top, name, first, body):
    """Without friction they vibrate as the modes do whose bottom is held along the normal."""
    body = freed(body) if top == "platen" else body
    springs = {**tops(first)[top], "Supports/Top/Spring stiffness": "1e12, 2e12, 3e12" if "3" in first else "1e12, 3e12"}
    folder.write("modal.prm", first + prm({**MODAL, **springs, **body, "Modal/Bottom": "held in z" if "3" in first else "held in y"}))
    folder.run(0, "contact_dynamics", "modal.prm", "--output", "still")
    still = np.array(folder.summary("still")["frequencies"]["held"])[:3]
    folder.write("complex.prm", first + prm({**springs, **body, "Analysis": "complex modes", "Supports/Top/Pressure": PRESSURE, "Friction/Coefficient": 0, "Time/Rayleigh beta": 0,
                                             "Complex modes/Highest frequency": 1.05 * still[-1], "Complex modes/Fastest decay": 1}))
    folder.run(0, "contact_dynamics", "complex.prm", "--output", "complex")
    with open(folder("complex", "complex_modes.csv"), encoding="ascii") as file:
        found = np.array([float(row["frequency [Hz]"]) for row in csv.DictReader(file)])
    for frequency in still:
        assert np.min(np.abs(found / frequency - 1)) < 1e-6, (name, still, found)


def check_static(folder, top, name, first, body):
    more = {} if top == "platen" else {"Supports/Top/Mass": MASS}
    folder.write("static.prm", first + prm({**STATIC, **body, **more, "Supports/Top/Kind": top, "Supports/Top/Spring stiffness": along_normal(first, STIFFNESS)}))
    carried = PRESSURE / (1 + STIFFNESS * HEIGHT / D)
    for ranks in (1, 2, 3):
        folder.run(0, "contact_dynamics", "static.prm", "--output", "static", ranks=ranks)
        with open(folder("static", "static_contact.csv"), encoding="ascii") as file:
            pressures = np.array([float(row["pressure [Pa]"]) for row in csv.DictReader(file)])
        assert np.allclose(pressures, carried, rtol=1e-7), (name, ranks, pressures, carried)
        of_phases = folder.summary("static")["phase_pressures_eq_19"].values()
        assert np.allclose(list(of_phases), carried, rtol=1e-7), (name, ranks, of_phases, carried)


def check_carried(folder, name, first, body):
    """A platen on springs whose far end has moved, and which the friction of the flat carries along, is in equilibrium: the springs and the pressure
    hold what the flat does; on 1, 2, 3 ranks. The flat slides, or it is at rest and then displaced."""
    normal = 2 if "3" in first else 1
    springs, far = np.array([2e12, 1e12, 3e12] if normal == 2 else [2e12, 3e12]), np.array([1e-7, -4e-7, -2e-7] if normal == 2 else [1e-7, -2e-7])
    area = 3e-3 * 2e-3 if normal == 2 else 6e-3
    moved = {"Flat/Velocity": 0, "Static contact/Flat displacement": "3e-7, 1e-7" if normal == 2 else "3e-7", "Static contact/Load steps": 2}
    for flat in ({"Flat/Velocity": "0.3, 0.4" if normal == 2 else "-0.5"}, moved):
        keys = {"Supports/Top/Kind": "platen", "Supports/Top/Spring stiffness": ", ".join(map(str, springs)), "Friction/Coefficient": 0.3,
                "Supports/Top/Motion": "; ".join(map(str, far)), **flat}
        folder.write("carried.prm", first + prm({**STATIC, **freed(body), **keys}))
        seen = []
        for ranks in (1, 2, 3):
            folder.run(0, "contact_dynamics", "carried.prm", "--output", "carried", ranks=ranks)
            with h5py.File(folder("carried", "dynamics.h5")) as file:
                u = file["snapshots/displacement"][-1].reshape(-1, normal + 1)
                contact = file["static_contact"]
                areas = contact["area"][()] if "area" in contact else area / 12 * np.array([0.5, *[1] * 11, 0.5])
                of_flat = np.array([areas @ contact[key][()] for key in ["shear_traction", "shear_traction_y", "pressure"] if normal == 2 or key[-1] != "y"])
                heights = file["mesh/points"][:, normal] if "mesh" in file else np.repeat(np.linspace(0, HEIGHT, 10 if normal == 1 else 9), 13 if normal == 1 else 30)
            top = u[np.abs(heights - HEIGHT) < 1e-9]
            assert np.ptp(top, axis=0).max() < 1e-16, (name, flat, np.ptp(top, axis=0))
            held = area * (springs * (far - top[0]) - PRESSURE * (np.arange(normal + 1) == normal))
            assert np.abs(of_flat + held).max() < 1e-7 * area * PRESSURE, (name, flat, ranks, of_flat, held)
            seen.append(top[0])
            assert np.abs(seen[-1] - seen[0]).max() < 1e-7 * np.abs(seen[0]).max(), (name, flat, ranks, seen)


def check_run(folder, name, kind, first, body):
    top = dict(TOPS[kind])
    if kind == "platen":
        body = freed(body)
        top["Supports/Top/Spring stiffness"] = "1e12, " + along_normal(first, 3e12).partition(", ")[2]
    folder.write("run.prm", first + prm({**RUN, **top, **body}))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run1")
    one, summary = check_ranks_and_restart(folder, (name, kind)), folder.summary("run1")
    assert summary["energy_balance_residual"] < 1e-12, (name, kind, summary["energy_balance_residual"])
    scale = np.abs(one["energy/elastic"]).max()
    assert summary["supports"]["Top"]["absorbing"] == (kind == "absorbing") and "Top: " in folder.read("run1", "log.txt").decode(), (name, kind)
    assert one["energy/dashpots"].max() > 1e-3 * scale and np.diff(one["energy/dashpots"]).min() > -1e-12 * scale, (name, kind)


def check_sentences(folder):
    warned = lambda words, value: words in "".join(folder.run(0, "contact_dynamics", "run.prm", "--validate", "--set", "Supports/Top/Kind=springs", "--set",
                                                              f"Supports/Top/Spring stiffness={value}"))
    refused = lambda words, *settings: words in folder.run(2, "contact_dynamics", "run.prm", "--validate",
                                                           *[arg for text in settings for arg in ("--set", text)])
    folder.write("run.prm", prm({**RUN, "Body/Stiffness": "36.54e9, 9.1e9, 47.26e9, 13.785e9", "Body/Density": 1770, "Body/Size": "0.006, 0.004",
                                 "Body/Cells": "12, 9"}))
    assert warned("stretches the springs by 50 m", "1e5") and warned("a million times as stiff", "2e19") and not warned("Spring stiffness", "1e9")
    assert refused("Supports/Top/Kind: it is springs, but", "Supports/Top/Kind=springs")
    assert refused("Dimension is 2", "Supports/Top/Kind=springs", "Supports/Top/Spring stiffness=1e12, 1e12, 1e12")
    assert refused("more than 2 expressions", "Supports/Top/Kind=springs", "Supports/Top/Spring stiffness=1e12", "Supports/Top/Motion=t; t; t")
    assert refused("Supports/Top/Motion", "Supports/Top/Kind=springs", "Supports/Top/Spring stiffness=1e12", "Supports/Top/Motion=t +")
    assert refused("at t = 0", "Supports/Top/Kind=springs", "Supports/Top/Spring stiffness=1e12", "Supports/Top/Motion=1/t")
    assert refused("Spring stiffness", "Supports/Top/Kind=held", "Supports/Top/Spring stiffness=1e12")
    assert refused("Hold from", "Supports/Top/Spring stiffness=1e12", "Supports/Top/Hold from=1e-5")
    assert refused("give a Spring stiffness there", "Supports/Top/Dashpot=1e6")
    assert refused("Mass", "Supports/Top/Kind=platen", "Supports/Top/Mass=1")
    assert refused("moves the corner", "Supports/Top/Spring stiffness=1e12", "Supports/Left/Held=u_x")


with tempfile.TemporaryDirectory() as path:
    here = Folder(path)
    for what in bodies(here):
        for top in ("springs", "platen"):
            check_modes(here, top, *what)
            check_static(here, top, *what)
            check_complex(here, top, *what)
        check_carried(here, *what)
        for top in TOPS:
            check_run(here, what[0], top, *what[1:])
    check_sentences(here)
