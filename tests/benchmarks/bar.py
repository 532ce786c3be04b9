"""A bar hits the wall: energy lost in the impact and time of contact, both known."""

import model_problem
from plots import legend, logarithmic, panels


def run(bench):
    sizes = [50, 100, 200] if bench.quick else [50, 100, 200, 400, 800]
    rows = model_problem.sweep(bench, "bar", sizes, "bar of 10 m with c = 30 m/s hits a rigid wall at 10 m/s; energy_lost: "
                               "share of the energy before; cpu_s: time loop of 2 s")
    figure, (energy, duration) = panels(2)
    logarithmic(energy, "CPU seconds (time loop)", "energy lost in %", "energy of one impact")
    model_problem.draw_curves(energy, rows, "energy_lost")
    legend(energy)
    logarithmic(duration, "CPU seconds (time loop)", "error of the time of contact in %", "time of contact")
    model_problem.draw_curves(duration, rows, "contact_time_error")
    legend(duration)
    bench.draw("bar", figure)
    bench.write("bar-cheapest", model_problem.conclusions(rows, "energy_lost", "energy of an impact")
                + model_problem.conclusions(rows, "contact_time_error", "time of contact"), "least cost for a target")
