"""Cost and memory of boxes of voxels by size: the explicit step and the load cases, on one rank; KUBC and SUBC against PBC, and the
contrast."""

from fits import median
from plots import curve, legend, logarithmic, panels

EDGES = (22, 32, 46, 64, 100, 128, 160, 216, 256, 312)
LARGEST_OF_SIX = 256  # larger volumes are solved for one load case
CONDITIONS = ("PBC", "KUBC", "SUBC")
CONDITION_EDGES, REPETITIONS = (64, 128), 3
STRONG = 1000


def run(bench):
    edges = [n for n in EDGES if n <= (64 if bench.quick else 312)]
    steps = [step(bench, n, phases) for n in edges for phases in (1, 2)]
    statics = [static(bench, n) for n in edges]
    bench.write("voxel-step-cost", steps, "a contact step of a box of cubes, without observers: seconds of the processor, fastest of the repetitions; bytes "
                "beyond a small box", repetitions="41, beyond 4e6 cells 9")
    bench.write("voxel-static-cost", statics, "overlapping spheres, 30 %, contrast 8, PBC to 1e-8: seconds of the processor; memory of the process, bytes a "
                "voxel less what the smallest volume takes")
    conditions = compare_conditions(bench, [n for n in CONDITION_EDGES if n in edges])
    bench.write("voxel-conditions", conditions, "overlapping spheres, 30 %, six load cases to 1e-8: seconds of the processor, medians of turns",
                repetitions=f"{REPETITIONS}, contrast {STRONG} one")
    draw(bench, steps, statics)


def step(bench, n, phases):
    """One process for each box, so that memory is its own."""
    row, = bench.tool("scaling_benchmark", "box", f"{n}:{n}:{n}:{phases}")
    cells = n ** 3
    return {"edge": n, "cells": cells, "phases": phases, "ns_per_cell": 1e9 * row["cpu_s"] / cells, "million_cells_per_s": 1e-6 * cells / row["cpu_s"],
            "bytes_per_cell": row["bytes"] / cells}


smallest_memory = {}


def static(bench, n):
    cases = 6 if n <= LARGEST_OF_SIX else 1
    row, = bench.tool("voxel_benchmark", n, 8, "PBC", cases)
    base = smallest_memory.setdefault("MB", row["memory_MB"])
    return {"edge": n, "voxels": n ** 3, "load_cases": cases, "iterations": row["iterations"], "cpu_s": row["cpu_s"], "set_up_s": row["set_up_s"],
            "us_per_voxel_and_case": 1e6 * row["cpu_s"] / cases / n ** 3, "memory_MB": row["memory_MB"],
            "bytes_per_voxel": 1e6 * (row["memory_MB"] - base) * 1.048576 / n ** 3}


def compare_conditions(bench, edges):
    rows = []
    for n in edges:
        turns = [[bench.tool("voxel_benchmark", n, 8, condition)[0] for condition in CONDITIONS] for _ in range(REPETITIONS)]
        for k, condition in enumerate(CONDITIONS):
            seconds = [turn[k]["cpu_s"] for turn in turns]
            ratios = [turn[k]["cpu_s"] / turn[0]["cpu_s"] for turn in turns]
            strong = bench.tool("voxel_benchmark", n, STRONG, condition)[0] if n == edges[0] or condition == "PBC" else {}
            mean = lambda row: sum(map(int, row["iterations"].split())) / 6 if row else float("nan")
            rows.append({"edge": n, "condition": condition, "cpu_s": median(seconds), "times_PBC": median(ratios), "times_PBC_low": min(ratios),
                         "times_PBC_high": max(ratios), "iterations": mean(turns[0][k]), f"iterations_{STRONG}": mean(strong),
                         f"iterations_{STRONG}_over_8": mean(strong) / mean(turns[0][k]), f"cpu_s_{STRONG}": strong.get("cpu_s", float("nan")),
                         "memory_MB": turns[0][k]["memory_MB"]})
    return rows


def first_of(iterations):
    """Of the first load case; where there is one alone it was read as a number."""
    return f"{float(str(iterations).split()[0]):g}"


def draw(bench, steps, statics):
    figure, (step_time, static_time, memory) = panels(3, width=15)
    for axes, text, title in ((step_time, "time per cell and step (ns)", "explicit step, one rank"),
                              (static_time, "time per voxel and load case (µs)", "PBC to 1e-8, contrast 8, one rank"), (memory, "bytes per voxel", "memory")):
        logarithmic(axes, "voxels", text, title, percent=False)
    for k, name in enumerate(("homogeneous", "two phases")):
        own = [row for row in steps if row["phases"] == k + 1]
        curve(step_time, k, [row["cells"] for row in own], [row["ns_per_cell"] for row in own], name)
        if k == 1:
            curve(memory, 0, [row["cells"] for row in own], [row["bytes_per_cell"] for row in own], "explicit step")
    six, one = ([row for row in statics if row["load_cases"] == cases] for cases in (6, 1))
    for k, (rows, name) in enumerate(((six, "six load cases"), (one, "one load case, with the whole set-up"))):
        if rows:
            curve(static_time, 2 + k, [row["voxels"] for row in rows], [row["us_per_voxel_and_case"] for row in rows], name)
            rows = [row for row in rows if row["bytes_per_voxel"] > 0]  # the smallest is the program
            curve(memory, 2 + k, [row["voxels"] for row in rows], [row["bytes_per_voxel"] for row in rows], name)
    for row in statics:
        static_time.annotate(f"{first_of(row['iterations'])} iterations" if row is statics[0] else first_of(row["iterations"]),
                             (row["voxels"], row["us_per_voxel_and_case"]), xytext=(2, 7), textcoords="offset points", fontsize=8.5)
    for axes in (step_time, static_time, memory):
        axes.set(yscale="linear", ylim=(0, 1.25 * max(max(line.get_ydata()) for line in axes.lines)))
        legend(axes, 2)
    bench.draw("voxel-cost", figure)
