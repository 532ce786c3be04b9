"""Effective stiffness of random fibres: against the cell size, with the limit by Richardson's extrapolation, and against
the tolerance of three solvers."""

from common import add_repeated, prm, repeated
from fits import fitted_order, least_costs, richardson
from plots import curve, legend, logarithmic, panels

CONDITIONS = ["KUBC", "PBC", "SUBC"]
ENTRIES = {"D11": (0, 0), "D22": (1, 1), "D33": (2, 2)}
CELL = 0.1  # mm, of the coarsest grid: one cell across a fibre
REPETITIONS = 3


def base_settings(refinement):
    """The volume of the example, 14 x 8 mm; fibres stay where they are when cells are refined."""
    return {"Grid/Cells": [140 * refinement, 80 * refinement], "Microstructure/Random fibres/Placement spacing": 1e-4,
            "Homogenization/Write concentration": False, "Homogenization/Reuse": False, "Ensemble/Members": 1}


def run(bench):
    study = bench.study("stiffness")
    refinements = [1, 2, 4] if bench.quick else [1, 2, 4, 8, 16]
    solvers = ["multigrid", "jacobi"] if bench.quick else ["multigrid", "jacobi", "ml"]
    tolerances = [10.0 ** -k for k in (range(1, 7, 2) if bench.quick else range(1, 10))]
    add_grids(study, refinements)
    add_tolerances(study, solvers, tolerances)
    results = study.run()
    grids, limits = grid_rows(results, refinements)
    solves = tolerance_rows(results, solvers, tolerances)
    bench.write("stiffness", grids, "random fibres, 14 x 8 mm, errors relative to the extrapolated stiffness; cpu_s: whole "
                "program, three load cases to 1e-8", repetitions=1)
    bench.write("stiffness-limits", limits, "Richardson's extrapolation from the three finest grids")
    bench.write("stiffness-tolerance", solves, "KUBC, 280 x 160 cells: largest change of D11, D22, D33 against a tolerance of "
                "1e-12; cpu_s: whole program, three load cases", repetitions=REPETITIONS)
    draw(bench, grids, solves)
    conclude(bench, grids, solves)


def add_grids(study, refinements):
    for condition in CONDITIONS:
        for r in refinements:
            study.add(f"{condition}-{r}", "rve_homogenization", prm("examples/homogenization.prm"),
                      {**base_settings(r), "Homogenization/Boundary conditions": condition,
                       "Homogenization/Effective": condition})


def add_tolerances(study, solvers, tolerances):
    settings = {**base_settings(2), "Homogenization/Boundary conditions": "KUBC", "Homogenization/Effective": "KUBC"}
    study.add("reference", "rve_homogenization", prm("examples/homogenization.prm"),
              {**settings, "Homogenization/Tolerance": 1e-12})
    for solver in solvers:
        for t in tolerances:
            add_repeated(study, f"{solver}-{t:g}", REPETITIONS, "rve_homogenization", prm("examples/homogenization.prm"),
                         {**settings, "Homogenization/Solver": solver, "Homogenization/Tolerance": t})


def diagonal(result, condition):
    stiffness = result.summary["stiffness"][condition]
    return {name: stiffness[i][j] for name, (i, j) in ENTRIES.items()}


def grid_rows(results, refinements):
    rows, limits = [], []
    for condition in CONDITIONS:
        found = [diagonal(results[f"{condition}-{r}"], condition) for r in refinements]
        limit = {}
        for name in ENTRIES:
            limit[name], order = richardson([f[name] for f in found])
            limits.append({"condition": condition, "entry": name, "limit_Pa": limit[name], "order": order})
        for r, f in zip(refinements, found):
            errors = {f"{name}_error": f[name] / limit[name] - 1 for name in ENTRIES}
            rows.append({"condition": condition, "h_mm": CELL / r, "cells": 11200 * r * r, **errors,
                         "largest_error": max(abs(e) for e in errors.values()),
                         "cpu_s": results[f"{condition}-{r}"].cpu_seconds,
                         "peak_memory_MB": results[f"{condition}-{r}"].summary["peak_memory_bytes"] / 1e6})
    return rows, limits


def tolerance_rows(results, solvers, tolerances):
    exact, rows = diagonal(results["reference"], "KUBC"), []
    for solver in solvers:
        for t in tolerances:
            result, cost = repeated(results, f"{solver}-{t:g}", REPETITIONS)
            found = diagonal(result, "KUBC")
            rows.append({"solver": solver, "tolerance": t,
                         "iterations": max(result.summary["iterations"]["KUBC"]),
                         "largest_error": max(abs(found[n] / exact[n] - 1) for n in ENTRIES), **cost})
    return rows


def draw(bench, grids, solves):
    figure, (space, cost, solver) = panels(3, width=12.6)
    logarithmic(space, "cell size (mm)", "largest error of D11, D22, D33 (%)", "by cells")
    logarithmic(cost, "CPU seconds (program, three load cases)", "largest error of D11, D22, D33 (%)", "by time")
    for k, condition in enumerate(CONDITIONS):
        own = [row for row in grids if row["condition"] == condition]
        errors = [100 * row["largest_error"] for row in own]
        order = fitted_order([row["h_mm"] for row in own], errors)
        curve(space, k, [row["h_mm"] for row in own], errors, f"{condition}: order {order:.2f}")
        curve(cost, k, [row["cpu_s"] for row in own], errors, condition)
    logarithmic(solver, "CPU seconds (program, three load cases)", "error by the tolerance (%)", "tolerance, KUBC, 280 x 160")
    names = list(dict.fromkeys(row["solver"] for row in solves))
    for k, name in enumerate(names):
        own = [row for row in solves if row["solver"] == name and row["largest_error"] > 1e-13]
        curve(solver, k, [row["cpu_s"] for row in own], [100 * row["largest_error"] for row in own], name)
        for row in own[:: max(1, len(own) // 3)]:
            solver.annotate(f"{row['tolerance']:.0e}", (row["cpu_s"], 100 * row["largest_error"]), xytext=(4, 3),
                            textcoords="offset points", fontsize=8)
    space_error = next(row["largest_error"] for row in grids if row["condition"] == "KUBC" and row["h_mm"] == CELL / 2)
    solver.axhline(100 * space_error, color="black", lw=1, ls="--", label="error by the cells of this grid")
    for axes, columns in ((space, 1), (cost, 3), (solver, 2)):
        legend(axes, columns)
    bench.draw("stiffness", figure)


def conclude(bench, grids, solves):
    found = []
    for condition in CONDITIONS:
        own = [row for row in grids if row["condition"] == condition]
        order = fitted_order([row["h_mm"] for row in own[-3:]], [row["largest_error"] for row in own[-3:]])
        finest = own[-1]
        found += least_costs(
            own, "largest_error", f"diagonal of D, {condition}", lambda best: f"h = {best['h_mm']:g} mm",
            lambda target: f"about h = {finest['h_mm'] * (target / finest['largest_error']) ** (1 / order):.2g} mm (extrapolated)")
    found += least_costs(solves, "largest_error", "solver, same grid", lambda best: f"{best['solver']}, tolerance {best['tolerance']:g}")
    bench.write("stiffness-cheapest", found, "least cost for a target")
