"""Static solves on meshes against unknowns: iterations of conjugate gradients with ML, time and memory, on one and two ranks."""

import os

from common import require_ended
from plots import curve, legend, logarithmic, panels

from mesh_files import Box

# Cells a side: 1e5, 3e5 and 1e6 unknowns.
SIDES = {2: [223, 387, 707], 3: [31, 46, 68]}
INCLUSIONS = 4  # along each axis
RADIUS = 0.3  # of the distance of two inclusions
RANKS = (1, 2)
CONDITIONS = ("KUBC", "SUBC", "PBC")
SETTINGS = {"Phases/Names": "matrix, inclusion", "Phases/matrix/Young modulus": "1e9", "Phases/matrix/Poisson ratio": 0.3,
            "Phases/inclusion/Young modulus": "8e9", "Phases/inclusion/Poisson ratio": 0.3, "Homogenization/Boundary conditions": ", ".join(CONDITIONS),
            "Homogenization/Effective": "PBC", "Homogenization/Reuse": False, "Homogenization/Write concentration": False,
            "Homogenization/Tolerance": 1e-8, "Mesh/Scale": 0.001}


def run(bench):
    study = bench.study("mesh_statics")
    study.jobs = 1  # times count
    folder = study.path("inputs")
    os.makedirs(folder, exist_ok=True)
    job = os.path.join(folder, "box.prm")
    with open(job, "w", encoding="utf-8") as file:
        file.write("set Output folder = output\n")
    cases = [(dim, n) for dim, sides in SIDES.items() for n in (sides[:1] if bench.quick else sides)]
    for dim, n in cases:
        path = os.path.join(folder, f"box-{dim}-{n}.msh")
        if not os.path.exists(path):
            Box([1.0] * dim, [n] * dim, phase_at).write(path)
        for ranks in RANKS:
            study.add(f"{dim}d-{n}-ranks-{ranks}", "rve_homogenization", job, {**SETTINGS, "Dimension": dim, "Mesh/File": path}, ranks)
    results = study.run()
    require_ended(results)
    rows = [row_of(results[f"{dim}d-{n}-ranks-{ranks}"], dim, n, ranks) for dim, n in cases for ranks in RANKS]
    bench.write("mesh-statics", rows, f"{INCLUSIONS} round inclusions an axis, contrast 8, on quadrilaterals and hexahedra to 1e-8; seconds: those of "
                "the program's clock, of all load cases of a condition with its matrix and hierarchy; CPU seconds of all ranks; memory of rank 0", ranks="1 and 2")
    draw(bench, rows)


def phase_at(middle):
    offset = [(INCLUSIONS * x) % 1 - 0.5 for x in middle]
    return "inclusion" if sum(x * x for x in offset) < RADIUS**2 else "matrix"


def row_of(result, dim, n, ranks):
    row = {"dim": dim, "cells": n**dim, "unknowns": result.summary["dofs"], "ranks": ranks}
    for condition in CONDITIONS:
        row[f"least_iterations_{condition}"] = min(result.summary["iterations"][condition])
        row[f"most_iterations_{condition}"] = max(result.summary["iterations"][condition])
        row[f"seconds_{condition}"] = result.summary["seconds"][f"Load cases/{condition}"]
    return {**row, "cpu_s": result.cpu_seconds, "peak_memory_bytes": result.summary["peak_memory_bytes"]}


def draw(bench, rows):
    figure, (iterations, time) = panels(2)
    iterations.set_xscale("log")
    iterations.set(xlabel="unknowns", ylabel="iterations of a load case, most", title="conjugate gradients with ML, contrast 8")
    logarithmic(time, "unknowns", "seconds of the processor", "the program with all load cases", percent=False)
    own = {(dim, ranks): [row for row in rows if row["dim"] == dim and row["ranks"] == ranks] for dim in SIDES for ranks in RANKS}
    for k, (dim, condition) in enumerate((dim, condition) for dim in SIDES for condition in CONDITIONS):
        alone = own[dim, 1]
        curve(iterations, k, [row["unknowns"] for row in alone], [row[f"most_iterations_{condition}"] for row in alone], f"{dim}D, {condition}")
    for k, ((dim, ranks), some) in enumerate(own.items()):
        curve(time, k, [row["unknowns"] for row in some], [row["cpu_s"] for row in some], f"{dim}D, {ranks} rank{'s' if ranks > 1 else ''}")
    iterations.set_ylim(0, None)
    time.xaxis.set_minor_formatter("")
    legend(iterations)
    legend(time)
    bench.draw("mesh-statics", figure)
