"""The pictures once more, from the tables that the study keeps beside them: nothing is run."""

import csv
import os

import numpy as np

import cycle_life
import delta_rules
import diagrams
import growth
import regime_map
import rules
import seeds
from measures import Measures


def rows_of(folder, name):
    with open(os.path.join(folder, name), encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def measures_of(row):
    """What tables.measure_row wrote, to its five digits."""
    value = lambda name: float(row[name])
    return Measures(value("mu_inter [-]"), value("standard error [-]"), value("mu_app [-]"), value("main frequency [Hz]"), value("amplitude [m]"),
                    tuple(value(f"{state} [-]") for state in ("slip", "stick", "separated")),
                    tuple(value(f"M {state} [-]") for state in ("slip", "stick", "separated")),
                    tuple(value(f"M velocity {end} [m/s]") for end in ("min", "max")), value("M lift [m]"))


def regimes(folder, prediction):
    """Pictures of the page on regimes, in `folder`; growth of the morphologies stands in the folder of the other page."""
    found = {}
    for row in rows_of(folder, "regime_map.csv"):
        found.setdefault((float(row["P [Pa]"]), float(row["delta [s]"]), row["start"]), []).append(measures_of(row))
    at_rest = tuple(start for start in regime_map.STARTS if start not in regime_map.PUSHES)
    diagrams.regime_maps(folder, found, at_rest, "regime_map_rest.png")
    diagrams.regime_maps(folder, found, tuple(regime_map.PUSHES), "regime_map_pushed.png")
    diagrams.search(folder, found)
    eigenvalue = lambda row: complex(float(row["growth [1/s]"]), 2 * np.pi * float(row["frequency [Hz]"]))
    branches = [eigenvalue(row) for row in rows_of(folder, "growth.csv") if row["stiffness"] == "eq. (10)"]
    morphologies = {}
    for row in rows_of(prediction, "growth.csv"):
        if row["mode"] != "fastest":
            morphologies.setdefault(row["seed"], []).append(eigenvalue(row))
    diagrams.growth_over_delta(folder, np.array(branches).reshape(len(growth.DELTAS), -1), morphologies)
    lines = {}
    for row in rows_of(folder, "cycle_life.csv"):
        case = next(c for c in cycle_life.CASES if c.cells[0] == int(row["cells along x [-]"])
                    and all(f"{value:.6g}" == row[f"{entry} [Pa]"] for entry, value in c.stiffness.items()))
        lines.setdefault(case, []).append(measures_of(row))
    diagrams.cycle_life(folder, cycle_life.over_d22(lines), cycle_life.windows() + 0.5 * cycle_life.WINDOW)


def prediction(folder):
    """Pictures of the page on prediction."""
    keys = {(load.label, window): (load, window) for load in seeds.LOADS for window in rules.WINDOWS}
    key_of = lambda row: keys[row["load"], row["window"]]
    deltas, sweeps, runs, stars = {}, {}, {}, {}
    for row in rows_of(folder, "homogeneous.csv"):
        deltas.setdefault(key_of(row), []).append(float(row["delta [s]"]))
        sweeps.setdefault(key_of(row), []).append(measures_of(row))
    sweeps = {key: delta_rules.Sweep(np.array(deltas[key]), measures) for key, measures in sweeps.items()}
    for row in rows_of(folder, "morphologies.csv"):
        runs.setdefault(key_of(row), {})[row["seed"]] = measures_of(row)
    for row in rows_of(folder, "rules.csv"):
        stars.setdefault(key_of(row), {}).setdefault(row["rule"], {})[row["seed"]] = float(row["delta* [s]"])
    diagrams.mu_over_delta(folder, sweeps, {key: list(found.values()) for key, found in runs.items()})
    for key, tried in stars.items():
        diagrams.rule_errors(folder, {rule: delta_rules.errors(sweeps[key], found, runs[key])["mu"] for rule, found in tried.items()}, key)
