"""Static solves against cells: time, iterations and memory, and a model of work and bandwidth."""

import numpy as np

from common import prm
from fits import median
from plots import curve, legend, logarithmic, panels

SIDES = [32, 100, 178, 316, 562, 1000, 3162]
CALIBRATION = (316, 1000)  # cells a side that give work and traffic; the others are predicted
CONDITIONS = "KUBC"
REPETITIONS = 3


def run(bench):
    study = bench.study("static_scaling")
    study.jobs = 1  # times count
    sides = SIDES[:5] if bench.quick else SIDES
    for n in sides:
        for k in range(repetitions(n)):
            add(study, f"cells-{n}.{k + 1}", n)
    results = study.run()
    rows = [row_of(results, n) for n in sides]
    for row in rows[1:]:  # the smallest grid is the start of the program
        row["seconds"] = row["program_cpu_s"] - rows[0]["program_cpu_s"]
    rows[0]["seconds"] = 0.0
    predict(rows)
    bench.write("static-scaling", rows, "KUBC of random fibres, n x n cells, three load cases to 1e-8; seconds: CPU, fastest "
                "run, less what the smallest grid takes", repetitions=f"{REPETITIONS}, one at 1e7 cells")
    draw(bench, rows)


def repetitions(n):
    return 1 if n > 2000 else REPETITIONS


def add(study, name, n):
    study.add(name, "rve_homogenization", prm("examples/homogenization.prm"), {
        "Grid/Cells": [n, n], "Grid/Size": [1e-4 * n, 1e-4 * n], "Homogenization/Boundary conditions": CONDITIONS,
        "Microstructure/Random fibres/Cut by border": True, "Homogenization/Effective": "KUBC",
        "Homogenization/Write concentration": False, "Homogenization/Reuse": False, "Ensemble/Members": 1})


def row_of(results, n):
    runs = [results[f"cells-{n}.{k + 1}"] for k in range(repetitions(n))]
    cpu = [run.cpu_seconds for run in runs]
    return {"n": n, "cells": n * n, "iterations": sum(runs[0].summary["iterations"]["KUBC"]),
            "program_cpu_s": min(cpu), "program_cpu_s_median": median(cpu), "program_cpu_s_high": max(cpu),
            "peak_memory_bytes": runs[0].summary["peak_memory_bytes"]}


def predict(rows):
    """Seconds = iterations x cells x time: in cache that of the smaller calibration grid, beyond it that of the larger one;
    memory = what the smallest run takes + bytes a cell of the larger calibration grid."""
    known = {row["n"]: row for row in rows if row["n"] in CALIBRATION}
    small, large = known[CALIBRATION[0]], known.get(CALIBRATION[1], rows[-1])
    rows[0]["predicted_seconds"] = 0.0
    rate = {id(row): row["seconds"] / row["iterations"] / row["cells"] for row in (small, large)}
    base = rows[0]["peak_memory_bytes"]
    a_cell = (large["peak_memory_bytes"] - base) / large["cells"]
    for row in rows:
        row["predicted_memory_bytes"] = base + a_cell * row["cells"]
    for row in rows[1:]:
        weight = np.clip(np.log(row["cells"] / small["cells"]) / np.log(large["cells"] / small["cells"]), 0, 1)
        time = rate[id(small)] ** (1 - weight) * rate[id(large)] ** weight
        row["predicted_seconds"] = float(time * row["iterations"] * row["cells"])


def draw(bench, rows):
    figure, (time, memory) = panels(2)
    cells = [row["cells"] for row in rows]
    logarithmic(time, "cells", "CPU seconds of three load cases", "KUBC to 1e-8, one rank", percent=False)
    curve(time, 0, cells[1:], [row["seconds"] for row in rows[1:]], "measured", ls="")
    curve(time, 0, cells[1:], [row["predicted_seconds"] for row in rows[1:]], "predicted", marker="")
    for row in rows[1:]:
        time.annotate(f"{row['iterations']:.0f} iterations", (row["cells"], row["seconds"]), xytext=(6, -10),
                      textcoords="offset points", fontsize=8.5)
    logarithmic(memory, "cells", "peak memory (MB)", "whole program", percent=False)
    curve(memory, 0, cells, [row["peak_memory_bytes"] / 1e6 for row in rows], "measured", ls="")
    curve(memory, 0, cells, [row["predicted_memory_bytes"] / 1e6 for row in rows], "predicted", marker="")
    for axes in (time, memory):
        legend(axes, 2)
    bench.draw("static-scaling", figure)
