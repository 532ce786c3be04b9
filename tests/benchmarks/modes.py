"""Exact mode of a rectangle: the frequency seen in five periods, and what the modal analysis says at the same cells."""

import model_problem
from common import prm

# Lowest mode with a horizontal wave, sides u_x = 0, top u_x = 0, bottom u_y = 0 (doc/theory.md, section 10).
LENGTH, HEIGHT, C_T = 0.024, 0.016, 2560.0


def run(bench):
    sizes = [8, 16, 32] if bench.quick else [8, 16, 32, 64, 128]
    rows = model_problem.sweep(bench, "mode", sizes, "frequency of the slowest shear mode of a 24 x 16 mm rectangle from "
                               "five periods; cpu_s: time loop alone")
    modal_analysis(bench, sizes[:4])
    damped = [choice for choice in model_problem.CURVES if choice[1] > 0.5]
    model_problem.draw(bench, "mode", rows, [
        ("frequency_error", "error of the frequency in %", "frequency"),
        ("amplitude_lost", "amplitude lost in a period in %", r"amplitude (nothing is lost with $\beta_2$ = 0.5)", damped)])
    undamped = [row for row in rows if row["beta2"] == 0.5]
    bench.write("mode-cheapest", model_problem.conclusions(undamped, "frequency_error", "frequency"), "least cost for a "
                "target, without loss of amplitude")


def modal_analysis(bench, sizes):
    """mode-modal.csv: the program's modal analysis of the same body."""
    study = bench.study("modes")
    modulus = 1900 * C_T ** 2
    stiffness = [modulus * 8 / 3, modulus * 2 / 3, modulus * 8 / 3, modulus]  # nu = 0.2
    for n in sizes:
        study.add(f"modal-{n}", "contact_dynamics", prm("examples/modal.prm"), {
            "Body/Stiffness": stiffness, "Body/Density": 1900, "Body/Size": [LENGTH, HEIGHT],
            "Body/Cells": [3 * n // 2, n], "Sides/Left": "u_x", "Sides/Right": "u_x", "Top/Kind": "pressure",
            "Top/Lateral held": True, "Modal/Bottom": "held in y", "Modal/Number of modes": 4})
    exact = C_T / 2 * ((1 / LENGTH) ** 2 + (1 / (2 * HEIGHT)) ** 2) ** 0.5
    results, rows = study.run(), []
    for n in sizes:
        found = results[f"modal-{n}"].summary["frequencies"]["held"]
        nearest = min(found, key=lambda f: abs(f - exact))
        rows.append({"n": n, "frequency_error": nearest / exact - 1, "cpu_s": results[f"modal-{n}"].cpu_seconds})
    bench.write("mode-modal", rows, "the same mode by modal analysis; cpu_s: whole program")
