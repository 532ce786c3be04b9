"""Studies of the program model_problems, problems whose answers are known: a mode of a rectangle, a bar that hits a wall, growth of
steady sliding. Each is a sweep over cells, time step and beta2, and its diagram."""

from common import prm
from fits import fitted_order, least_costs
from plots import curve, legend, logarithmic, panels

# Share of the critical time step and beta2: one curve each.
CURVES = [(0.95, 0.5), (0.475, 0.5), (0.2375, 0.5), (0.95, 0.6), (0.95, 1.0)]

# A panel of a diagram: error, label of its axis, title and, unless all, its curves.
SHOWN = {
    "bar": [("energy_lost", "energy lost (%)", "energy of one impact"),
            ("contact_time_error", "error of the time of contact (%)", "time of contact")],
    "growth": [("growth_error", "error of the growth rate (%)", "growth rate"), ("frequency_error", "error of the frequency (%)", "frequency")],
    "mode": [("frequency_error", "error of the frequency (%)", "frequency"),
             ("amplitude_lost", "amplitude lost in a period (%)", r"amplitude ($\beta_2$ = 0.5 loses none)", CURVES[3:])]}

# Lowest mode with a horizontal wave, sides u_x = 0, top u_x = 0, bottom u_y = 0 (doc/theory.md, section 10).
LENGTH, HEIGHT, C_T = 0.024, 0.016, 2560.0


def sweep(bench, problem, sizes, note):
    """Rows of all sizes and curves, written to PROBLEM.csv. The fewest cells run first."""
    repetitions = 3
    rows = bench.tool("model_problems", problem, repetitions, *(f"{n}:{share}:{beta2}" for n in sizes for share, beta2 in CURVES))
    bench.write(problem, rows, note, repetitions=repetitions)
    return rows


def label(share, beta2):
    return rf"$\Delta t$ = {share:g} $\Delta t_\mathrm{{crit}}$, $\beta_2$ = {beta2:g}"


def draw_curves(axes, rows, error, curves=None):
    """% error over CPU seconds; a curve that falls all the way has its order in h in its label."""
    for k, (share, beta2) in enumerate(curves or CURVES):
        own = [row for row in rows if (row["share"], row["beta2"]) == (share, beta2)]
        errors = [100 * abs(row[error]) for row in own]
        text = label(share, beta2)
        if all(b < a for a, b in zip(errors, errors[1:])):
            text += f": order {fitted_order([1 / row['n'] for row in own[-3:]], errors[-3:]):.2f}"
        curve(axes, k if not curves else CURVES.index((share, beta2)), [row["cpu_s"] for row in own], errors, text)


def draw(bench, name, rows):
    """NAME.svg of SHOWN."""
    figure, all_axes = panels(len(SHOWN[name]))
    for axes, (error, text, title, *curves) in zip(all_axes, SHOWN[name]):
        logarithmic(axes, "CPU seconds (time loop)", text, title)
        draw_curves(axes, rows, error, *curves)
        legend(axes)
    bench.draw(name, figure)


def conclusions(rows, error, quantity):
    return least_costs(rows, error, quantity, lambda best: f"{best['n']:.0f} cells over the height, {best['share']:g} dt_crit, "
                                                           f"beta2 {best['beta2']:g}")


def bar(bench):
    """Energy lost in the impact and time of contact."""
    rows = sweep(bench, "bar", [50, 100, 200] if bench.quick else [50, 100, 200, 400, 800], "bar of 10 m with c = 30 m/s hits a rigid "
                 "wall at 10 m/s; energy_lost: share of the energy before; cpu_s: time loop of 2 s")
    draw(bench, "bar", rows)
    bench.write("bar-cheapest", conclusions(rows, "energy_lost", "energy of an impact")
                + conclusions(rows, "contact_time_error", "time of contact"), "least cost for a target")


def sliding_growth(bench):
    """Growth of a perturbation of steady sliding with the regularized law, against the dispersion relation."""
    rows = sweep(bench, "growth", [20, 40] if bench.quick else [5, 7, 10, 14, 20, 28, 40, 56, 80], "growth rate (1/s) and frequency of the "
                 "fastest wave, k H = 1, mu = 0.25, delta = 1.5 us, beta = 4.4 ns; cpu_s: time loop of 0.4 ms")
    draw(bench, "growth", rows)
    bench.write("growth-cheapest", conclusions(rows, "growth_error", "growth rate")
                + conclusions(rows, "frequency_error", "frequency of the growth"), "least cost for a target")


def oblique_growth(bench):
    """The same in three dimensions, of a wave at 45 degrees to the sliding."""
    sizes = [4, 6, 8] if bench.quick else [4, 6, 8, 10, 14, 20, 28]
    repetitions = 1
    choices = [f"{n}:{share}:{beta2}" for n in sizes for share, beta2 in CURVES if n < 28 or (share, beta2) == CURVES[0]]
    rows = bench.tool("model_problems", "oblique_growth", repetitions, *choices)
    bench.write("oblique-growth", rows, "growth rate (1/s) and frequency of a wave at 45 degrees, k H = 0.987, mu = 0.4, delta = 1.5 us, beta = 4.4 ns, in a "
                "box of 9 n x 4.5 n x n cubes; cpu_s: time loop of 0.4 ms", repetitions=repetitions)
    draw(bench, "oblique-growth", rows, [
        ("growth_error", "error of the growth rate (%)", "growth rate"),
        ("frequency_error", "error of the frequency (%)", "frequency")])
    bench.write("oblique-growth-cheapest", conclusions(rows, "growth_error", "growth rate in 3D")
                + conclusions(rows, "frequency_error", "frequency of the growth in 3D"), "least cost for a target")


def modes(bench):
    """The frequency of a mode seen in five periods, and what the modal analysis says at the same cells."""
    sizes = [8, 16, 32] if bench.quick else [8, 16, 32, 64, 128]
    rows = sweep(bench, "mode", sizes, "frequency of the slowest shear mode of a 24 x 16 mm rectangle from five periods; cpu_s: time loop "
                 "alone")
    modal_analysis(bench, sizes[:4])
    draw(bench, "mode", rows)
    undamped = [row for row in rows if row["beta2"] == 0.5]
    bench.write("mode-cheapest", conclusions(undamped, "frequency_error", "frequency"), "least cost for a target, without loss of amplitude")


def modal_analysis(bench, sizes):
    """mode-modal.csv: the program's modal analysis of the same body."""
    study = bench.study("modes")
    modulus = 1900 * C_T ** 2
    stiffness = [modulus * 8 / 3, modulus * 2 / 3, modulus * 8 / 3, modulus]  # nu = 0.2
    for n in sizes:
        study.add(f"modal-{n}", "contact_dynamics", prm("examples/modal.prm"), {
            "Body/Stiffness": stiffness, "Body/Density": 1900, "Body/Size": [LENGTH, HEIGHT],
            "Body/Cells": [3 * n // 2, n], "Supports/Left/Held": "u_x", "Supports/Right/Held": "u_x", "Supports/Top/Kind": "pressure",
            "Supports/Top/Held": "u_x", "Modal/Bottom": "held in y", "Modal/Number of modes": 4})
    exact = C_T / 2 * ((1 / LENGTH) ** 2 + (1 / (2 * HEIGHT)) ** 2) ** 0.5
    results, rows = study.run(), []
    for n in sizes:
        found = results[f"modal-{n}"].summary["frequencies"]["held"]
        nearest = min(found, key=lambda f: abs(f - exact))
        rows.append({"n": n, "frequency_error": nearest / exact - 1, "cpu_s": results[f"modal-{n}"].cpu_seconds})
    bench.write("mode-modal", rows, "the same mode by modal analysis; cpu_s: whole program")
