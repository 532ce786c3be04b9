"""A map of many pins: CPU seconds of a point, and the part of them that is not the time loop: start, files, evaluation."""

import json
import os
import shutil
import time

from common import cpu_seconds, prm

REPETITIONS = 3
SETTINGS = {"Sweep/Complex modes": "false", "Body/Cells": "140, 40"}


def run(bench):
    """20 points in turns, in double and single precision, and 1000 points once."""
    maps = [(4, 5, precision) for _ in range(REPETITIONS) for precision in ("double", "single")] + ([] if bench.quick else [(25, 40, "single")])
    rows = []
    for pressures, frictions, precision in maps:
        folder = os.path.join(bench.runs, "many_pins")
        shutil.rmtree(folder, ignore_errors=True)
        settings = {**SETTINGS, "Time/Precision": precision, "Sweep/pressure/Number": pressures, "Sweep/friction/Number": frictions}
        began = time.monotonic()
        cpu = cpu_seconds([os.path.join(bench.programs, "contact_dynamics"), prm("examples/regime_map.prm"), "--quiet", "--ignore-unused",
                           "--output", folder, *(f"--set={key}={value}" for key, value in settings.items())])
        rows.append({"points": pressures * frictions, "precision": precision, **row_of(folder, cpu, time.monotonic() - began)})
    bench.write("many-pins", rows, "regime_map.prm on 140 x 40 cells without complex modes, at most 4 ms a point, as many processes as cores; "
                "elsewhere: share of the CPU seconds outside the time loops", repetitions=REPETITIONS)


def row_of(folder, cpu, wall):
    points = [os.path.join(folder, "points", name) for name in os.listdir(os.path.join(folder, "points"))]
    loops = 0.0
    for point in points:
        with open(os.path.join(point, "summary.json"), encoding="utf-8") as file:
            loops += json.load(file)["seconds"]["Time loop"]
    return {"wall_s": wall, "cpu_s_per_point": cpu / len(points), "elsewhere": 1 - loops / cpu}
