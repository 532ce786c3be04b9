"""Static solves of the pin's composite: time and memory of whole programs, iterations against cells and contrast, odd sizes
included, and the same by Trilinos (deal.II mesh, ML) in the same run."""

import os

from common import add_repeated, cpu_seconds, prm, repeated, require_ended
from fits import median, spread
from plots import curve, legend, panels, wrapped

CELL = 1e-4  # m
PIN = (560, 160)
SIZES = [(140, 40), (280, 80), PIN, (1120, 320), (2240, 640), (4480, 1280)]
ODD = [(139, 41), (557, 163), (1119, 321)]
CONTRASTS = [1, 10, 100, 10000]
ALL = ["KUBC", "SUBC", "PBC"]
MATRIX = 30e9  # Pa
REPETITIONS = 5


def run(bench):
    study = bench.study("statics")
    study.jobs = 1  # times count
    cases = chosen_cases(bench.quick)
    for name, case in cases.items():
        add_repeated(study, name, case["repetitions"], "rve_homogenization", prm("pin/10-rve_homogenization.prm"), case["settings"])
    results = study.run()
    require_ended(results)
    # Linking of the libraries that deal.II brings, and MPI.
    start = median([cpu_seconds([os.path.join(bench.programs, "rve_homogenization"), "--version"]) for _ in range(REPETITIONS)])
    rows = [{**row_of(results, name, case), "start_cpu_s": start} for name, case in cases.items()]
    bench.write("statics", rows, "load cases of the pin's fibres; each: iterations of the load cases; solve_s: load cases alone; "
                "program_s: by its own clock; cpu_s: the whole process, of which start_cpu_s are linking and MPI", repetitions=f"{REPETITIONS}; 1 beyond 1e6 cells and for ML at contrast 1e4")
    draw(bench, rows)


def chosen_cases(quick):
    cases = {"pin": case(PIN, 8, ["KUBC", "SUBC"]), "pin, Trilinos ML": case(PIN, 8, ["KUBC", "SUBC"], solver="ml"),
             "pin, three kinds": case(PIN, 8, ALL), "periodic square": case((256, 256), 8, ["PBC"], 1e-6),
             "periodic square, contrast 1e4": case((256, 256), 1e4, ["PBC"], 1e-6)}
    for size in SIZES[:3] if quick else SIZES:
        cases[f"cells-{size[0]}"] = case(size, 8, ALL)
    for size in ODD[:2] if quick else ODD:
        cases[f"odd-{size[0]}"] = case(size, 8, ALL)
    for contrast in CONTRASTS:
        cases[f"contrast-{contrast}"] = case(PIN, contrast, ALL)
        cases[f"odd-contrast-{contrast}"] = case(ODD[1], contrast, ALL)
    if not quick:
        cases["contrast-10000, Trilinos ML"] = case(PIN, 1e4, ["KUBC", "SUBC"], solver="ml")
    return cases


def case(size, contrast, conditions, tolerance=1e-8, solver="multigrid"):
    settings = {"Grid/Cells": list(size), "Grid/Size": [CELL * n for n in size], "Phases/fibre/Young modulus": MATRIX * contrast,
                "Homogenization/Boundary conditions": ", ".join(conditions), "Homogenization/Effective": conditions[0],
                "Homogenization/Tolerance": tolerance, "Homogenization/Solver": solver, "Homogenization/Reuse": False}
    return {"size": size, "contrast": contrast, "conditions": conditions, "tolerance": tolerance, "solver": solver, "settings": settings,
            "repetitions": REPETITIONS if size[0] * size[1] < 1e6 and (solver == "multigrid" or contrast < 100) else 1}


def row_of(results, name, case):
    first, cpu = repeated(results, name, case["repetitions"])
    runs = [results[f"{name}.{k + 1}"] for k in range(case["repetitions"])]
    iterations = {condition: first.summary["iterations"][condition] for condition in case["conditions"]}
    return {"case": name, "solver": case["solver"], "nx": case["size"][0], "ny": case["size"][1], "contrast": case["contrast"],
            "tolerance": case["tolerance"], "load_cases": 3 * len(iterations),
            **{condition: " ".join(str(n) for n in iterations.get(condition, [])) for condition in ALL},
            **spread("solve_s", [run.summary["seconds"]["Load cases"] for run in runs]),
            "program_s": median([run.summary["seconds"]["total"] for run in runs]), **cpu, "peak_memory_MB": 1e-6 * first.summary["peak_memory_bytes"]}


def mean_iterations(row, condition):
    numbers = [int(n) for n in row[condition].split()]
    return sum(numbers) / len(numbers)


def draw(bench, rows):
    figure, (cells, contrast) = panels(2)
    for axes, kind, x in ((cells, "cells-", lambda row: row["nx"] * row["ny"]), (contrast, "contrast-", lambda row: row["contrast"])):
        axes.set(xscale="log", xlabel=kind[:-1], ylabel=wrapped("iterations of a load case to $10^{-8}$, mean of three"))
        axes.grid(True)
        for k, condition in enumerate(ALL):
            for prefix, style in (("", {}), ("odd-", {"ls": "", "mfc": "none"})):
                wanted = prefix + kind if kind == "contrast-" or not prefix else prefix
                own = [row for row in rows if row["case"].startswith(wanted) and row["solver"] == "multigrid"
                       and (kind == "contrast-" or "contrast" not in row["case"])]
                curve(axes, k, [x(row) for row in own], [mean_iterations(row, condition) for row in own],
                      condition + (", odd size" if prefix else ""), **style)
        axes.margins(y=0.1)
        axes.set_ylim(bottom=0)
        legend(axes, 2)
    cells.set_title("contrast 8", loc="left")
    contrast.set_title(f"{PIN[0]} x {PIN[1]} cells", loc="left")
    bench.draw("statics", figure)
