"""Localized stresses from macroscopic grids that are coarser than the morphology's, against the direct solution: in static
contact, and in the first 0.2 ms of sliding."""

import os

import h5py
import numpy as np

from common import FROM_REST, prm
from fits import fitted_order
from plots import COLOURS, curve, legend, logarithmic, panels

CELLS = (560, 160)
REGIONS = ["all", "interior", "surface"]
END, FIRST, INTERVAL = 2e-4, 1e-4, 1e-6  # s, of the run and its snapshots
LAST = END - 0.5 * INTERVAL  # s; or it hangs on round-off in the time step whether the last step has one more
PROBES = 100000  # steps between samples of the probes, which this study does not read


def run(bench):
    ratios = [1, 2, 4] if bench.quick else [1, 2, 4, 5, 8, 10, 20]
    kinds = ["static"] if bench.quick else ["static", "sliding"]
    study = bench.study("localization")
    study.add("rve", "rve_homogenization", prm("pin/10-rve_homogenization.prm"))
    for kind in kinds:
        add = {"static": add_static, "sliding": add_sliding}[kind]
        add(study, f"{kind}-direct", "heterogeneous", 1)
        for ratio in ratios:
            add(study, f"{kind}-{ratio}", "homogeneous", ratio)
            study.add(f"{kind}-localized-{ratio}", "stress_localization", prm("pin/40-stress_localization.prm"), {
                "Input/RVE file": "{rve}/rve.h5", "Input/Homogeneous run": "{%s-%d}/dynamics.h5" % (kind, ratio),
                "Input/Direct run": "{%s-direct}/dynamics.h5" % kind, "Window/From": 0, "Window/To": "auto",
                "Probes/Of the run": ""})
    results = study.run()
    rows = [row_of(results, kind, ratio) for kind in kinds for ratio in ratios]
    bench.write("localization", rows, "relative L2 error of the mean von Mises stress and of sigma_yy, localized against direct; "
                "560 x 160 cells of morphology; cpu_s: homogeneous run and localization; direct_cpu_s: heterogeneous run")
    draw(bench, rows, kinds)


def add_static(study, name, material, ratio):
    study.add(name, "contact_dynamics", prm("examples/fibres/40-contact_dynamics-static_contact.prm"), {
        "Body/Material": material, "Body/RVE file": "{rve}/rve.h5", "Body/Cells": [n // ratio for n in CELLS],
        "Friction/Coefficient from": "constant"})


def add_sliding(study, name, material, ratio):
    file = "20-contact_dynamics-homogeneous" if material == "homogeneous" else "30-contact_dynamics-heterogeneous"
    study.add(name, "contact_dynamics", prm(f"pin/{file}.prm"), FROM_REST | {
        "Body/RVE file": "{rve}/rve.h5", "Body/Cells": [n // ratio for n in CELLS], "Time/End time": END,
        "Snapshots/From": FIRST, "Snapshots/To": LAST, "Snapshots/Interval": INTERVAL, "Observation/Probe interval": PROBES})


def row_of(results, kind, ratio):
    localized = results[f"{kind}-localized-{ratio}"]
    errors = localized.summary["field_errors"]
    row = {"kind": kind, "ratio": ratio, "h_mm": 0.1 * ratio}
    for region in REGIONS:
        row[f"von_mises_{region}"] = errors["mean_von_mises"][region]
        row[f"sigma_yy_{region}"] = errors["mean_sigma_yy"][region]
    row["von_mises_by_grid"] = difference(results, kind, ratio)
    row["cpu_s"] = results[f"{kind}-{ratio}"].cpu_seconds + localized.cpu_seconds
    row["macroscopic_cpu_s"] = results[f"{kind}-{ratio}"].cpu_seconds
    row["direct_cpu_s"] = results[f"{kind}-direct"].cpu_seconds
    return row


def difference(results, kind, ratio):
    """Relative L2 distance of the localized field from that of the equally fine macroscopic grid, 1.6 mm inside."""
    def field(which):
        with h5py.File(os.path.join(results[f"{kind}-localized-{which}"].folder, "localization.h5")) as file:
            return file["mean_von_mises"][16:-16, 16:-16]
    return float(np.linalg.norm(field(ratio) - field(1)) / np.linalg.norm(field(1)))


def draw(bench, rows, kinds):
    figure, axes = panels(len(kinds) + 1, width=4.2 * (len(kinds) + 1))
    for panel, kind in zip(axes, kinds):
        own = [row for row in rows if row["kind"] == kind]
        logarithmic(panel, "macroscopic cell size over that of the morphology", "error of the mean von Mises stress (%)",
                    "static contact" if kind == "static" else "sliding, 0.1 to 0.2 ms")
        for k, region in enumerate(REGIONS):
            curve(panel, k, [row["ratio"] for row in own], [100 * row[f"von_mises_{region}"] for row in own], region)
        coarse = [row for row in own if row["ratio"] > 1]
        grid = [100 * row["von_mises_by_grid"] for row in coarse]
        order = fitted_order([row["ratio"] for row in coarse], grid)
        curve(panel, 6, [row["ratio"] for row in coarse], grid, f"part of the grid, interior: order {order:.2f}", ls="--")
        legend(panel, 2)
    draw_cost(axes[-1], rows, kinds)
    bench.draw("localization", figure)


def draw_cost(axes, rows, kinds):
    logarithmic(axes, "CPU seconds (macroscopic run and localization)", "error of the mean von Mises stress (%)", "by time")
    for k, kind in enumerate(kinds):
        own = [row for row in rows if row["kind"] == kind]
        errors = [100 * row["von_mises_interior"] for row in own]
        curve(axes, k, [row["cpu_s"] for row in own], errors, f"{kind}, interior")
        direct = own[0]["direct_cpu_s"]
        axes.axvline(direct, color=COLOURS[k], lw=1, ls="--", label=f"direct solution, {kind}")
    legend(axes, 2)
