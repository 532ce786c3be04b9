"""Runs of a million steps: the energy of an undamped body must not drift."""

import os

import h5py
import numpy as np
import stress
from judge import Verdict

STEPS = 1000000
SMALL = {"Body/Cells": [28, 8], "Time/Rayleigh beta": 0, "Observation/Energy interval": 1000,
         "Observation/History interval": 1000}  # without damping sparse samples are exact

CASES = {
    "free vibration": {"Supports/Top/Kind": "held", "Flat/Gap": 1, "Body/Initial velocity": [0.1, 0.2]},
    "sliding, slip and separation": {"Time/Rayleigh beta": 0},
    "sliding, Coulomb": {"Friction/Regularization time": 0},
    "sliding, stick and slip": {"Flat/Velocity": 0.2, "Friction/Coefficient": 0.5},
    "bouncing under gravity": {**stress.FREE, "Body/Acceleration": [0, -2e4], "Flat/Gap": 1e-6},
}


def run(study, steps=STEPS):
    """{case: (Verdict, folder)}."""
    study.add("long/reference", "contact_dynamics", stress.PIN, {**SMALL, "Time/End time": 1e-6})
    step = study.run()["long/reference"].summary["time_step"]
    names = {}
    for number, (case, settings) in enumerate(CASES.items()):
        names[case] = f"long/{number}-{steps}"
        study.add(names[case], "contact_dynamics", stress.PIN, {**SMALL, **settings, "Time/Time step": step, "Time/End time": steps * step})
    results = study.run()
    return {case: (Verdict(results[name]), study.path(name)) for case, name in names.items()}


def travel(folder):
    """How far the middle contact node went along the flat (m)."""
    with h5py.File(os.path.join(folder, "dynamics.h5")) as file:
        return float(np.max(np.abs(file["reference/displacement"][:, 0])))


def drift(folder):
    """(step [k], residual of the balance over the largest energy so far that anything held [k])."""
    with h5py.File(os.path.join(folder, "dynamics.h5")) as file:
        energy = {name: file["energy"][name][()] for name in ("time", "residual", "kinetic", "elastic", "friction", "external_work")}
    scale = max(np.max(energy[name]) for name in ("kinetic", "elastic", "friction"))
    with np.errstate(divide="ignore"):
        return np.arange(energy["time"].size) * SMALL["Observation/Energy interval"], np.abs(energy["residual"]) / scale
