"""Round fibres on meshes that follow their circles, with linear and with curved quadratic cells, and as staircases on grids: error against
size and time."""

import math
import os

from common import add_repeated, repeated
from fits import fitted_order, least_costs, richardson
from plots import curve, legend, logarithmic, panels

from mesh_files import hexagonal_cell, on_circles

FRACTION = 0.4
ENTRIES = {"D11": (0, 0), "D12": (0, 1), "D33": (2, 2)}
SIZE = (1.0, math.sqrt(3.0))  # mm
REPETITIONS = 3
PHASES = {"Phases/Names": "resin, glass", "Phases/resin/Young modulus": "3.5e9", "Phases/resin/Poisson ratio": 0.35,
          "Phases/glass/Young modulus": "70e9", "Phases/glass/Poisson ratio": 0.22, "Homogenization/Boundary conditions": "PBC",
          "Homogenization/Effective": "PBC", "Homogenization/Reuse": False, "Homogenization/Tolerance": 1e-9}


def run(bench):
    study = bench.study("fitted")
    os.makedirs(study.path("inputs"), exist_ok=True)
    with open(study.path(os.path.join("inputs", "cell.prm")), "w", encoding="utf-8") as file:
        file.write("set Output folder = output\n")
    meshes = [2, 4, 8] if bench.quick else [2, 4, 8, 16, 32]
    curved = meshes[:-1]
    grids = [24, 48, 96] if bench.quick else [24, 48, 96, 192, 384, 768]
    for n in meshes:
        hexagonal_cell(n, FRACTION).write(study.path(os.path.join("inputs", f"mesh-{n}.msh")))
        add_repeated(study, f"mesh-{n}", REPETITIONS, "rve_homogenization", study.path(os.path.join("inputs", "cell.prm")),
                     {**PHASES, "Mesh/File": study.path(os.path.join("inputs", f"mesh-{n}.msh")), "Mesh/Scale": 0.001})
    for n in curved:
        on_circles(hexagonal_cell(n, FRACTION)).write(study.path(os.path.join("inputs", f"curved-{n}.msh")))
        add_repeated(study, f"curved-{n}", REPETITIONS, "rve_homogenization", study.path(os.path.join("inputs", "cell.prm")),
                     {**PHASES, "Mesh/File": study.path(os.path.join("inputs", f"curved-{n}.msh")), "Mesh/Scale": 0.001, "Mesh/Degree": 2})
    for n in grids:
        rows = write_staircase(study.path(os.path.join("inputs", f"grid-{n}.txt")), n)
        add_repeated(study, f"grid-{n}", REPETITIONS, "rve_homogenization", study.path(os.path.join("inputs", "cell.prm")),
                     {**PHASES, "Grid/Cells": [n, rows], "Grid/Size": [1e-3 * length for length in SIZE], "Microstructure/Type": "image", "Microstructure/Oblong pixels": True,
                      "Microstructure/File": study.path(os.path.join("inputs", f"grid-{n}.txt"))})
    results = study.run()
    rows = compare(results, meshes, curved, grids)
    bench.write("fitted", rows, f"glass fibres in resin, hexagonal lattice, fraction {FRACTION}, PBC: largest error of D11, D12, D33 "
                "against the extrapolation of the curved meshes; cpu_s: whole program, three load cases", repetitions=REPETITIONS)
    bench.write("fitted-cheapest", [best for kind in ("mesh", "curved", "grid") for best in least_costs(
        [row for row in rows if row["kind"] == kind], "largest_error", kind, lambda best: f"{best['cells']:.0f} cells")],
        "least cost for a target")
    draw(bench, rows)


def write_staircase(path, n):
    """The phase at the centre of each of n cells along x and about sqrt(3) n along y, both even; the number along y."""
    rows = 2 * round(n * SIZE[1] / 2)
    radius2 = FRACTION * SIZE[0] * SIZE[1] / (2 * math.pi)
    near = lambda x, y: min((x - a) ** 2 + (y - b) ** 2 for a, b in [(0, 0), (1, 0), (0, SIZE[1]), SIZE, (0.5, SIZE[1] / 2)])
    with open(path, "w", encoding="ascii") as file:
        for j in reversed(range(rows)):
            line = (near((i + 0.5) / n, (j + 0.5) / rows * SIZE[1]) < radius2 for i in range(n))
            file.write(" ".join("1" if glass else "0" for glass in line) + "\n")
    return rows


def compare(results, meshes, curved, grids):
    first = lambda name: repeated(results, name, REPETITIONS)
    entries = lambda result: {name: result.summary["stiffness"]["PBC"][i][j] for name, (i, j) in ENTRIES.items()}
    found = [entries(first(f"curved-{n}")[0]) for n in curved]
    limit = {name: richardson([f[name] for f in found])[0] for name in ENTRIES}
    rows = []
    for kind, sizes in (("mesh", meshes), ("curved", curved), ("grid", grids)):
        for n in sizes:
            result, cost = first(f"{kind}-{n}")
            errors = {f"{name}_error": value / limit[name] - 1 for name, value in entries(result).items()}
            rows.append({"kind": kind, "cells": result.summary["cells"], "fraction": result.summary["phases"][1]["volume_fraction"],
                         **errors, "largest_error": max(abs(error) for error in errors.values()), **cost})
    return rows


def draw(bench, rows):
    figure, (space, cost) = panels(2)
    logarithmic(space, "number of cells", "largest error of D11, D12, D33 (%)", "by cells")
    logarithmic(cost, "CPU seconds (program, three load cases)", "largest error of D11, D12, D33 (%)", "by time")
    for k, (kind, name) in enumerate((("mesh", "mesh along the circles, ml"), ("grid", "staircase, multigrid"), ("curved", "curved quadratic cells, ml"))):
        own = [row for row in rows if row["kind"] == kind]
        errors = [100 * row["largest_error"] for row in own]
        order = fitted_order([row["cells"] ** -0.5 for row in own], errors)
        curve(space, k, [row["cells"] for row in own], errors, f"{name}: order {order:.2f} in h")
        curve(cost, k, [row["cpu_s"] for row in own], errors, name)
    for axes in (space, cost):
        legend(axes, 1)
    bench.draw("fitted", figure)
