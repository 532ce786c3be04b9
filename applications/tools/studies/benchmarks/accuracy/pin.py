"""The paper's pin: mu_inter, main frequency and slip share against cells, time step and beta2, with the scatter over
blocks of time, and the homogeneous pin against heterogeneous ones."""

import os

import h5py
import numpy as np

import pin_diagrams
from common import FROM_REST, prm
from fits import block_rates, half_width, least_costs, main_frequency

END, FROM = 3e-3, 2e-3  # s; high modes grow until about 1 ms and settle until about 1.5 ms
# Blocks of time for the scatter. Two modes at 124 and 120 kHz beat with 4.0 kHz: a block is one beat; shorter ones would
# take the beat for scatter.
BLOCKS = 4
PRESSURE, VELOCITY, WIDTH = FROM_REST["Supports/Top/Pressure"], 2.0, 0.056
SEEDS = (1, 2, 3)
FULL = {"homogeneous": (0.4, 0.2, 0.1, 0.05), "heterogeneous": (0.1,)}
HISTORY = "pin-history"
RAMPS = (1e-5, 2e-5, 5e-5, 1e-4)  # s, of the pressure: other starts of the same motion


def cases(quick):
    """Name -> (material, h in mm, seed, further settings)."""
    found = {f"homogeneous-h{h:g}": ("homogeneous", h, 1, {}) for h in ((0.4, 0.2) if quick else FULL["homogeneous"])}
    for h in (0.4,) if quick else (0.4, 0.2):
        for share in (0.475, 0.2375):
            found[f"homogeneous-h{h:g}-dt{share:g}"] = ("homogeneous", h, 1, {"Time/Safety factor": share})
        for beta2 in (0.6, 1.0):
            found[f"homogeneous-h{h:g}-b{beta2:g}"] = ("homogeneous", h, 1, {"Time/Beta2": beta2})
    if quick:
        return found
    found["homogeneous-h0.1-dt0.475"] = ("homogeneous", 0.1, 1, {"Time/Safety factor": 0.475})
    # What beta2 = 1 adds, as Rayleigh damping: (1 - 1/2) dt of homogeneous-h0.2-b1.
    found["homogeneous-h0.2-beta"] = ("homogeneous", 0.2, 1, {"Time/Rayleigh beta": 1.6294e-8})
    for seed in SEEDS:
        found[f"heterogeneous-h0.1-seed{seed}"] = ("heterogeneous", 0.1, seed, {})
    return found


def starts():
    """Other starts of homogeneous-h0.2: the pressure grows for a while."""
    return {f"homogeneous-h0.2-ramp{1e6 * ramp:g}": ("homogeneous", 0.2, 1, {"Supports/Top/Ramp": "linear", "Supports/Top/Ramp time": ramp})
            for ramp in RAMPS}


def add_case(study, name, material, h, seed, more):
    n = round(0.4 / h)
    file = "20-contact_dynamics-homogeneous" if material == "homogeneous" else "30-contact_dynamics-heterogeneous"
    study.add(name, "contact_dynamics", prm(f"pin/{file}.prm"), FROM_REST | {
        "Body/RVE file": "{rve-%d}/rve.h5" % seed, "Body/Cells": [140 * n, 40 * n], "Time/End time": END,
        "Snapshots/Interval": 0, "Observation/Probe interval": 1000, "Observation/Blocks": 300, **more})


def run(bench):
    study, chosen = bench.study("pin"), cases(bench.quick)
    others = {} if bench.quick else starts()
    for seed in SEEDS[:1] if bench.quick else SEEDS:
        study.add(f"rve-{seed}", "rve_homogenization", prm("pin/10-rve_homogenization.prm"),
                  {"Microstructure/Random fibres/Seed": seed, "Homogenization/Write concentration": False})
    for name, case in (chosen | others).items():
        add_case(study, name, *case)
    results = study.run()
    rows = [row_of(name, case, results[name]) for name, case in chosen.items()]
    limit = continuum(rows)
    for row in rows:
        for quantity in QUANTITIES:
            row[quantity + "_error"] = row[quantity] / limit[quantity]["value"] - 1
    bench.write("pin", rows, f"the paper's pin at 5 MPa, {1e3 * FROM:g} to {1e3 * END:g} ms; _95: half widths from blocks of time; "
                "errors relative to pin-limit.csv; cpu_s: whole program")
    bench.write("pin-limit", [{"quantity": name, **values} for name, values in limit.items()],
                "homogeneous pin with h, dt -> 0: least squares of value + a h^2 + b dt over all runs with beta2 = 1/2")
    bench.write("pin-cheapest", conclusions(rows), "least cost for a target; errors of the homogeneous model's own limit")
    pin_diagrams.errors(bench, rows)
    histories = {name: history(results[name].folder) for name in chosen | others}
    bench.write(HISTORY, [{"name": name, "time_ms": t, "mu_inter": mu} for name, found in histories.items() for t, mu in zip(*found)],
                "mu_inter in blocks of 50 microseconds")
    pin_diagrams.history(bench, histories)
    if not bench.quick:
        bench.write("pin-starts", start_rows(results, ["homogeneous-h0.2", *others]), "the same pin, the pressure growing "
                    "linearly at the start: mu_inter of the last beat, 2.75 to 3 ms, and when it first fell below 0.21")
        bench.write("pin-homogenization", homogenization(rows), "homogeneous pins against the mean of the heterogeneous ones")
        pin_diagrams.homogenization(bench, rows)


QUANTITIES = ("mu_inter", "frequency_Hz", "slip_share")


def row_of(name, case, result):
    material, h, seed, more = case
    summary = result.summary
    row = {"name": name, "material": material, "h_mm": h, "seed": seed, "dt_s": summary["time_step"],
           "share": more.get("Time/Safety factor", 0.95), "beta2": summary["beta2"],
           "rayleigh_beta_s": summary["rayleigh_beta"], "cells": summary["cells"], "cpu_s": result.cpu_seconds}
    with h5py.File(os.path.join(result.folder, "dynamics.h5")) as file:
        samples = {"mu_inter": friction_blocks(file, FROM, END, BLOCKS), "slip_share": slip_blocks(file),
                   "frequency_Hz": frequencies(file, BLOCKS)}
        frequency = frequencies(file, 1)[0]
    for quantity, values in samples.items():
        row[quantity], row[quantity + "_95"] = float(np.mean(values)), half_width(values)
    row["frequency_Hz"] = frequency  # the quarters' scatter is an upper bound of its own
    return row


def friction_blocks(file, begin, end, blocks):
    history = file["history"]
    rates = block_rates(history["time"][...], history["friction_energy"][...], begin, end, blocks)
    return rates / (PRESSURE * WIDTH * VELOCITY)


def slip_blocks(file):
    time, slip = file["contact/blocks/time"][...], file["contact/blocks/slip"][...].mean(axis=1)
    edges = np.concatenate([[0.0], time])
    return block_rates(edges, np.concatenate([[0.0], np.cumsum(slip * np.diff(edges))]), FROM, END, BLOCKS)


def frequencies(file, parts):
    time, motion = file["reference/time"][...], file["reference/displacement"][:, 0]
    edges = np.searchsorted(time, np.linspace(FROM, END, parts + 1))
    return [main_frequency(time[a:b], motion[a:b]) for a, b in zip(edges, edges[1:])]


def history(folder):
    """(ms, mu_inter) in blocks of 50 microseconds from the start."""
    with h5py.File(os.path.join(folder, "dynamics.h5")) as file:
        mu = friction_blocks(file, 5e-6, END, 60)
    edges = np.linspace(5e-6, END, 61)
    return 1e3 * 0.5 * (edges[1:] + edges[:-1]), mu


def kept_history(rows):
    """{name: (ms, mu_inter)} of pin-history.csv."""
    return {name: np.array([[row["time_ms"], row["mu_inter"]] for row in rows if row["name"] == name]).T
            for name in dict.fromkeys(row["name"] for row in rows)}


def start_rows(results, names):
    found = []
    for name in names:
        time, mu = history(results[name].folder)
        with h5py.File(os.path.join(results[name].folder, "dynamics.h5")) as file:
            last = friction_blocks(file, 2.75e-3, END, 1)[0]
        found.append({"name": name, "mu_inter": float(last), "below_ms": float(time[np.argmax((mu < 0.21) & (time > 0.3))])})
    return found


def limit_of(rows, quantity):
    """value, error, a, b, residual of value + a h^2 + b dt (h in mm, dt in ns): two orders of the bulk, one of the moments at
    which nodes land and lift off."""
    terms = np.array([[1, row["h_mm"] ** 2, 1e9 * row["dt_s"]] for row in rows])
    values = np.array([row[quantity] for row in rows])
    best, *_ = np.linalg.lstsq(terms, values, rcond=None)
    rest = values - terms @ best
    freedom = max(1, len(rows) - 3)
    covariance = np.linalg.inv(terms.T @ terms) * (rest @ rest) / freedom
    return {"value": float(best[0]), "standard_error": float(covariance[0, 0] ** 0.5), "per_mm2": float(best[1]), "per_ns": float(best[2]),
            "rms_residual": float((rest @ rest / freedom) ** 0.5), "runs": len(rows)}


def continuum(rows):
    """{quantity: limit_of()} of the homogeneous runs."""
    used = [row for row in rows if row["material"] == "homogeneous" and row["beta2"] == 0.5
            and row["name"] != "homogeneous-h0.2-beta"]
    return {quantity: limit_of(used, quantity) for quantity in QUANTITIES}


def conclusions(rows):
    own = [row for row in rows if row["material"] == "homogeneous"]
    return [found for quantity in QUANTITIES for found in least_costs(
        own, quantity + "_error", quantity,
        lambda best: f"h = {best['h_mm']:g} mm, {best['share']:g} dt_crit = {1e9 * best['dt_s']:.3g} ns, beta2 {best['beta2']:g}")]


def homogenization(rows):
    """Each homogeneous run with beta2 = 1/2 against the mean over morphologies."""
    direct = [row for row in rows if row["material"] == "heterogeneous"]
    cost = float(np.mean([row["cpu_s"] for row in direct]))
    found = []
    for row in [r for r in rows if r["name"] in {f"homogeneous-h{h:g}" for h in FULL["homogeneous"]}]:
        entry = {"h_mm": row["h_mm"], "cpu_s": row["cpu_s"], "direct_cpu_s": cost, "saving": cost / row["cpu_s"]}
        for quantity in QUANTITIES:
            values = [r[quantity] for r in direct]
            entry[quantity + "_difference"] = row[quantity] / np.mean(values) - 1
            entry[quantity + "_of_morphologies"] = np.std(values, ddof=1) / np.mean(values)
        found.append(entry)
    return found
