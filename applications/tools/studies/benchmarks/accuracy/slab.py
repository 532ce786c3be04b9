"""mu_inter of a pin in three dimensions against cell size, time step and beta2: the pin of prm/pin with the stiffness of eq. (10), 8 mm thick with
free sides, in regime 1, which it keeps."""

import os

from common import require_ended
from fits import least_costs
from pin import limit_of
from plots import curve, legend, logarithmic, panels

SIZE = (56, 8, 16)  # mm
CELLS_OVER_HEIGHT = (10, 20, 30)
CURVES = ((0.95, 0.5), (0.475, 0.5), (0.95, 1.0))
FINEST = {(0.95, 0.5): 30, (0.475, 0.5): 30, (0.95, 1.0): 20}
END, STEADY = 3e-3, 1e-3
SETTINGS = {"Body/Stiffness": "36.54e9, 9.1e9, 9.1e9, 36.54e9, 9.1e9, 47.26e9, 13.785e9, 13.785e9, 13.72e9", "Body/Density": 1770,
            "Body/Size": [1e-3 * length for length in SIZE], "Body/Initial velocity": [0.5, 0, 0], "Time/End time": END, "Time/Rayleigh beta": 4.4e-9,
            "Flat/Velocity": [2, 0], "Supports/Top/Kind": "platen", "Supports/Top/Pressure": 0.5e6, "Friction/Coefficient": 0.25, "Friction/Regularization time": 1.5e-6,
            "Observation/Steady from": STEADY, "Observation/Blocks": 300}


def run(bench):
    study = bench.study("slab")
    study.jobs = 1  # times count
    os.makedirs(study.path("inputs"), exist_ok=True)
    prm = study.path(os.path.join("inputs", "slab.prm"))
    with open(prm, "w", encoding="utf-8") as file:
        file.write("set Dimension = 3\nset Analysis = transient\n")
    cases = [(n, share, beta2) for share, beta2 in CURVES for n in CELLS_OVER_HEIGHT if n <= (20 if bench.quick else FINEST[share, beta2])]
    for n, share, beta2 in cases:
        cells = [round(length * n / SIZE[2]) for length in SIZE]
        study.add(f"{n}-{share:g}-{beta2:g}", "contact_dynamics", prm, {**SETTINGS, "Body/Cells": cells, "Time/Safety factor": share, "Time/Beta2": beta2})
    results = study.run()
    require_ended(results)
    rows = [row_of(results[f"{n}-{share:g}-{beta2:g}"], n, share, beta2) for n, share, beta2 in cases]
    limit = limit_of([row for row in rows if row["beta2"] == 0.5], "mu_inter")
    for row in rows:
        row["mu_inter_error"] = row["mu_inter"] / limit["value"] - 1
    bench.write("slab", rows, f"pin of 56 x 8 x 16 mm in regime 1 (0.5 MPa, 2 m/s, push 0.5 m/s), {1e3 * STEADY:g} to {1e3 * END:g} ms: errors against the limit of "
                f"value + a h^2 + b dt through the runs with beta2 = 1/2; cpu_s: whole program")
    bench.write("slab-limit", [limit], "mu_inter as value + a h^2 + b dt, h in mm, dt in ns")
    uncertain = limit["standard_error"] / limit["value"]
    choices = least_costs(rows, "mu_inter_error", "mu_inter in 3D", lambda best: f"h = {best['h_mm']:g} mm, {best['share']:g} dt_crit, beta2 {best['beta2']:g}")
    bench.write("slab-cheapest", [choice for choice in choices if choice["target"] > uncertain], "least cost for a target that the limit is known well enough for")
    draw(bench, rows, 100 * uncertain)


def row_of(result, n, share, beta2):
    summary = result.summary
    mu = summary["global_interface_friction_coefficient"]
    return {"h_mm": SIZE[2] / n, "share": share, "beta2": beta2, "cells": summary["cells"], "dt_s": summary["time_step"], "steps": summary["steps"], "mu_inter": mu,
            "mu_inter_95": summary["global_interface_friction_coefficient_95"], "frequency_Hz": summary["main_frequency"],
            "slip_fraction": summary["slip_fraction"], "stick_fraction": summary["stick_fraction"], "separation_fraction": summary["separation_fraction"],
            "cpu_s": result.cpu_seconds}


def draw(bench, rows, uncertain):
    figure, (space, cost) = panels(2)
    logarithmic(space, "cell size (mm)", r"error of $\mu_\mathrm{inter}$ (%)", "by cells")
    logarithmic(cost, "CPU seconds (program, 3 ms)", r"error of $\mu_\mathrm{inter}$ (%)", "by time")
    for k, (share, beta2) in enumerate(CURVES):
        own = [row for row in rows if (row["share"], row["beta2"]) == (share, beta2)]
        errors = [100 * abs(row["mu_inter_error"]) for row in own]
        text = rf"$\Delta t$ = {share:g} $\Delta t_\mathrm{{crit}}$, $\beta_2$ = {beta2:g}"
        curve(space, k, [row["h_mm"] for row in own], errors, text)
        curve(cost, k, [row["cpu_s"] for row in own], errors, text)
    for axes in (space, cost):
        axes.axhline(uncertain, color="black", lw=1, ls="--", label="standard error of the limit")
        legend(axes, 1)
    bench.draw("slab", figure)
