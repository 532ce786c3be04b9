"""Growth of a perturbation of steady sliding with the regularized law, against the dispersion relation."""

import model_problem


def run(bench):
    sizes = [20, 40] if bench.quick else [5, 7, 10, 14, 20, 28, 40, 56, 80]
    rows = model_problem.sweep(bench, "growth", sizes, "growth rate (1/s) and frequency of the fastest wave, k H = 1, mu = 0.25, "
                               "delta = 1.5 us, beta = 4.4 ns; cpu_s: time loop of 0.4 ms")
    model_problem.draw(bench, "growth", rows, [
        ("growth_error", "error of the growth rate in %", "growth rate"),
        ("frequency_error", "error of the frequency in %", "frequency")])
    bench.write("growth-cheapest", model_problem.conclusions(rows, "growth_error", "growth rate")
                + model_problem.conclusions(rows, "frequency_error", "frequency of the growth"), "least cost for a target")
