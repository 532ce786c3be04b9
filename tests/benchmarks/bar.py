"""A bar hits the wall: energy lost in the impact and time of contact, both known."""

import model_problem


def run(bench):
    sizes = [50, 100, 200] if bench.quick else [50, 100, 200, 400, 800]
    rows = model_problem.sweep(bench, "bar", sizes, "bar of 10 m with c = 30 m/s hits a rigid wall at 10 m/s; energy_lost: "
                               "share of the energy before; cpu_s: time loop of 2 s")
    model_problem.draw(bench, "bar", rows, [
        ("energy_lost", "energy lost in %", "energy of one impact"),
        ("contact_time_error", "error of the time of contact in %", "time of contact")])
    bench.write("bar-cheapest", model_problem.conclusions(rows, "energy_lost", "energy of an impact")
                + model_problem.conclusions(rows, "contact_time_error", "time of contact"), "least cost for a target")
