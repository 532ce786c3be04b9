"""The parts of the study: each runs its cases and gives its section of the page, numbers inserted."""

import limit
import long_runs
import numpy as np
import plots
import redraw
import refinement
import sensitivity
import stress
from pages import number, save_picture, table, write_csv


def picture(page, name, figure):
    save_picture(figure, page.folder, name, colours=64, dpi=100)


def span(values):
    """Smallest and largest, as text; a dash without any."""
    known = [x for x in values if x is not None]
    return f"{min(known):.4f} to {max(known):.4f}" if known else "-"


def limit_part(study, page):
    sweep, limits = limit.sweep(study), limit.bisect(study)
    picture(page, "time_step.png", plots.time_step({case: verdict.outcome for case, verdict in sweep.items()}, limits))
    headings = ["body", "beta2 [-]", "beta [s]", "predicted [s]", "largest stable [s]", "smallest unstable [s]", "observed / predicted [-]",
                "observed / exact, as held [-]"]
    write_csv(page.folder, "time_step.csv", headings, [[x.body, x.beta2, x.beta, x.predicted, x.low * x.predicted, x.high * x.predicted, x.observed,
                                          x.observed_over_held] for x in limits])
    write_csv(page.folder, "time_step_sweep.csv", ["beta2 [-]", "time step / critical [-]", "outcome", "largest energy / put in [-]",
                                     "energy balance error [-]", "step of the stop [-]"],
             [[b, share, v.outcome, v.growth, v.residual, v.step] for (b, share), v in sweep.items()])
    rows = []
    for body in dict.fromkeys(x.body for x in limits):
        own = [x for x in limits if x.body == body]
        rows.append([body, ", ".join(f"{b:g}" for b in dict.fromkeys(x.beta2 for x in own)),
                     ", ".join(f"{x * 1e9:g}" for x in dict.fromkeys(x.beta for x in own)),
                     f"{min(x.predicted for x in own) * 1e9:.4g} to {max(x.predicted for x in own) * 1e9:.4g}",
                     span(x.observed for x in own), span(x.observed_over_held for x in own)])
    tall = [x.observed - 1 for x in limits if x.body == limit.FEW_ROWS]
    others = [abs(x.observed - 1) for x in limits if x.body != limit.FEW_ROWS]
    held = [x.observed_over_held for x in limits if x.observed_over_held is not None]
    stable = [v for v in sweep.values() if v.outcome == "stable"]
    page.text("limit", f"""
## Time step: predicted and observed limit

The program predicts the critical time step from the largest frequency of the free grid ([theory](../theory.md), section 2). Observed is the
middle of the last interval ({(limit.HIGH - limit.LOW) / 2 ** limit.ROUNDS:.2%} wide) of a bisection: the pin slides on the flat for {limit.STEPS}
steps with the check of the time step switched off, and either ends or is stopped. The prediction has to be safe (above 1) and sharp (below 1.01).
As held: the exact largest frequency of the homogeneous body with u_y = 0 at the contact, u_x = 0 and one u_y under the platen, from a sparse eigenproblem
of its own (`held_body.py`).

{table(["body", "beta2", "beta (ns)", "predicted (ns)", "observed / predicted", "observed / exact, as held"], rows)}

All but one body agree within {max(others):.2%} with the prediction, and all within {max(abs(x - 1) for x in held):.2%} with the exact frequency of the body as it is held. The exception is a
grid of four rows, each ten times as tall as wide (1:10): the platen holds a good part of its stiffest mode, so that the limit lies {max(tall):.1%} higher than on the
free grid; with the top free it is where it is predicted. The program leaves this out, on the safe side; it falls with the
square of the number of rows.

![time step](time_step.png)

(a) The homogeneous pin without damping, time steps from 0.5 to 1.1 of the critical one. Below the limit the body never holds more than what was
put in (largest ratio {max(v.growth for v in stable):.6f}) and the balance closes to {max(v.residual for v in stable):.1e}; all runs above it are stopped, after
{min(v.step for v in sweep.values() if v.step)} to {max(v.step for v in sweep.values() if v.step)} steps. (b) The last intervals of the bisections, in the colours of
beta2; within a body beta grows downwards, and beta2 for each beta.
Data: [time_step.csv](time_step.csv), [time_step_sweep.csv](time_step_sweep.csv).
""")
    return [v for v in sweep.values()], ([f"{x.body}: observed / predicted {x.observed:.4f}" for x in limits
                                          if not 0.999 <= x.observed <= 1.01 and x.body != limit.FEW_ROWS]
                                         + [f"{x.body}: observed / exact {x.observed_over_held:.4f}" for x in limits
                                          if x.observed_over_held is not None and not abs(x.observed_over_held - 1) < 0.01])


def stress_part(study, page):
    verdicts = stress.run(study)
    picture(page, "energy.png", plots.energy_residuals([(group, v.outcome, v.residual) for (group, _), v in verdicts.items()]))
    write_csv(page.folder, "stress.csv", ["group", "value", "unit", "outcome", "energy balance error [-]", "largest energy / put in [-]", "whole contact opened [-]",
                            "mu_inter [-]", "slip share [-]", "stick share [-]", "separated share [-]", "message"],
             [[group, value, unit, v.outcome, v.residual, v.growth, v.openings, v.summary.get("global_interface_friction_coefficient"),
               v.summary.get("slip_fraction"), v.summary.get("stick_fraction"), v.summary.get("separation_fraction"), v.message]
              for group, unit, values in stress.groups() for value, _ in values for v in [verdicts[group, value]]])
    rows = []
    for group, unit, values in stress.groups():
        own = [verdicts[group, value] for value, _ in values]
        outcomes = [v.outcome.split(":")[0] for v in own]
        told = ", ".join(f"`{value}`" if isinstance(value, str) and " " in value else number(value) for value, _ in values)
        rows.append([group, told + ("" if unit == "-" else " " + unit),
                     ", ".join(f"{outcomes.count(o)} {o}" for o in dict.fromkeys(outcomes)),
                     number(max((v.residual for v in own if v.residual is not None), default=None), 1),
                     number(max((v.growth for v in own if v.outcome == "stable" and v.growth is not None), default=None), 4)])
    openings = [f"`{value}`: {verdicts['pressure', value].openings} times" for value in stress.OPENING]
    causes = [[value, v.step, v.cause] for (group, value), v in verdicts.items() if group == "to be stopped"]
    page.text("stress", f"""
## One setting at a time, far beyond the paper's

The pin on 70 x 20 cells, {len(verdicts)} runs of 0.5 ms, an energy balance in every step. Every data set of every `dynamics.h5` is finite. `put in` is the initial energy and the work of top
and flat, less what friction and impacts took; no stable run ever holds more.

{table(["group", "values", "outcome", "worst error of the balance", "largest energy / put in"], rows)}

The whole contact opens and closes under an alternating pressure: {"; ".join(openings)}. What cannot go on is stopped:

{table(["case", "in step", "likely cause, as printed"], causes)}

![energy](energy.png)

Error of the energy balance over the largest energy, one dot a run. Data: [stress.csv](stress.csv).
""")
    wrong = [f"{group} {value}: {v.outcome}" for (group, value), v in verdicts.items()
             if (v.outcome == "stopped") != (group == "to be stopped")]
    wrong += [f"pressure {value}: the contact opened {verdicts['pressure', value].openings} times" for value in stress.OPENING
              if not verdicts["pressure", value].openings > 1]
    return list(verdicts.values()), wrong


def long_part(study, page):
    found = long_runs.run(study)
    curves = {case: long_runs.drift(folder) for case, (_, folder) in found.items()}
    shown = redraw.keep_drift(page.folder, curves)
    picture(page, "million_steps.png", plots.drift(shown))
    bounce = max(curves, key=lambda case: curves[case][1].max())
    travelled = long_runs.travel(found[bounce][1])
    headings = ["case", "error of the balance after 1e3", "1e4", "1e5", "1e6 steps", "slip share", "separated share"]
    rows = []
    for case, (verdict, _) in found.items():
        residual = curves[case][1]
        rows.append([case] + [float(residual[min(k, residual.size - 1)]) for k in (1, 10, 100, 1000)]
                    + [verdict.summary["slip_fraction"], verdict.summary["separation_fraction"]])
    write_csv(page.folder, "million_steps.csv", headings, rows)
    page.text("long", f"""
## A million steps

28 x 8 cells without any damping (beta = 0, beta2 = 0.5): whatever the scheme would lose or gain shows. Error of the energy balance over the largest energy:

{table(headings, [[cell if isinstance(cell, str) else number(cell, 2) for cell in row] for row in rows])}

It is the round-off of a million sums and reaches {max(curve[1].max() for curve in curves.values()):.1e} at most. It is largest where the flat carries the body away ({bounce}: {travelled:.2g} m):
strains are differences of ever larger displacements, so that digits go.

![million steps](million_steps.png)

Data: [million_steps.csv](million_steps.csv), over time [million_steps_drift.csv](million_steps_drift.csv).
""")
    return [verdict for verdict, _ in found.values()], []


def change(numbers, key, name):
    """Relative change of a result from the second finest to the finest cells."""
    beta, delta = key
    sizes = sorted(h for b, d, h in numbers if (b, d) == key)
    finest, before = (numbers[beta, delta, h][name] for h in sizes[:2])
    return abs(finest / before - 1)


def refinement_part(study, page):
    nodes = {case: refinement.Node(result) for case, result in refinement.run(
        study, refinement.CELLS_MM, refinement.END, refinement.STEADY).items()}
    numbers = {case: node.numbers() for case, node in nodes.items()}
    figure_five = redraw.keep_figure_five(page.folder, {(d, h): node for (b, d, h), node in nodes.items() if b > 0})
    picture(page, "figure_5.png", plots.figure_five(figure_five))
    picture(page, "refinement.png", plots.refinement_numbers(numbers))
    names = list(next(iter(numbers.values())))
    rows = [[f"{beta * 1e9:g}", f"{delta * 1e9:g}", f"{h:g}"] + list(values.values()) for (beta, delta, h), values in numbers.items()]
    write_csv(page.folder, "refinement.csv", ["beta [ns]", "delta [ns]", "h [mm]"] + names, rows)
    changes = [[f"beta = {b * 1e9:g} ns, delta = {d * 1e9:g} ns"] + [f"{change(numbers, (b, d), name):.1%}" for name in names]
               for b, d in dict.fromkeys((b, d) for b, d, _ in numbers)]
    late = refinement.run(study, refinement.LONG_MM, refinement.LONG_END, refinement.LONG_STEADY, "refinement-long")
    late_names = list(sensitivity.RESULTS)
    late_rows = [[f"{beta * 1e9:g}", f"{delta * 1e9:g}", f"{h:g}"] + [result.summary[sensitivity.RESULTS[name]] for name in late_names]
                 for (beta, delta, h), result in late.items()]
    write_csv(page.folder, "refinement_long.csv", ["beta [ns]", "delta [ns]", "h [mm]"] + late_names, late_rows)
    waves, growth = refinement.growth_rates()
    rates = table(["beta (ns)", "delta (ns)"] + [f"{wave * 1e3:.3g} mm" for wave in waves],
                  [[f"{beta * 1e9:g}", f"{delta * 1e9:g}"] + [cell if cell is None else f"{cell:.0f}" for cell in row]
                   for beta, delta, *row in growth])
    bare = [numbers[0.0, 1.5e-6, h] for h in refinement.CELLS_MM[0.0]]
    page.text("refinement", REFINEMENT.format(
        numbers=table(["beta (ns)", "delta (ns)", "h (mm)"] + names, rows), changes=table([""] + names, changes), rates=rates,
        late=table(["beta (ns)", "delta (ns)", "h (mm)"] + late_names, late_rows),
        late_steady=refinement.LONG_STEADY * 1e3, late_end=refinement.LONG_END * 1e3, steady=refinement.STEADY * 1e3, end=refinement.END * 1e3, last=plots.LAST * 1e3, cycles=plots.LAST_CYCLES * 1e3, finer=plots.CYCLES_UP_TO,
        mu=", ".join(f"{row['mu_inter']:.3f}" for row in bare),
        fast=", ".join(f"{row['share of v_x above 400 kHz']:.2f}" for row in bare)))
    return [], []


REFINEMENT = """
## What regularization buys: refinement with and without delta

The homogeneous pin (5 MPa, 2 m/s, mu = 0.25, time step auto) on cells of 0.4 to 0.05 mm, {end:g} ms, evaluated from {steady:g} ms on.

{numbers}

Change from the second finest to the finest cells:

{changes}

![figure 5](figure_5.png)

The form of the paper's figure 5, beta = 4.4 ns, of the middle contact node: u_x over the last {last:g} ms (a, b), phase diagrams of the last {cycles:g} ms on cells of
{finer:g} mm and less (c, d), and spectrum of u_x (e, f).

![refinement](refinement.png)

Growth rates (1/s) of steady sliding by wavelength, from the exact dispersion relation of a layer as tall and stiff as the pin; a dash where nothing grows:

{rates}

How to read this:

* With plain Coulomb friction and no damping, short waves grow as fast as long ones: a finer grid always adds waves that
  grow. One of 3.3 cells, which only the grid has, grows at a rate proportional to 1/h ([theory](../theory.md#3-contact-and-friction-libcontactcontact_kernelcc)).
  Refinement has no limit.
* delta = 1500 ns lets only long waves grow, with and without damping, so that steady sliding has a limit. It also decides which motion follows (main frequencies in the table above).
* The motion past the first separation needs damping as well: with beta = 0 and delta = 1500 ns mu_inter is {mu} and the share of fast motion {fast} on ever finer cells, though the linear
  growth of short waves is gone. What is left to excite them are the landings, and nothing takes them away again.
* With the paper's beta = 4.4 ns both laws settle on these cells, plain Coulomb as well: damping stops the growth of waves shorter than some millimetres. So beta is what makes the runs converge, delta chooses
  the motion; the paper's figure 5 has both.

The first {end:g} ms, as in the paper's figure 5, are a transient. The same from {late_steady:g} to {late_end:g} ms, when the limit cycle is reached with the paper's beta:

{late}

Finer cells and time steps in the limit cycle, extrapolated: [work and precision](../performance/work_precision.md).

Data: [refinement.csv](refinement.csv), [refinement_long.csv](refinement_long.csv), [figure_5.csv](figure_5.csv), [figure_5_spectrum.csv](figure_5_spectrum.csv).
"""


def sensitivity_part(study, page):
    found = sensitivity.run(study)
    picture(page, "sensitivity.png", plots.sensitivity(found, sensitivity.PAPER))
    names = list(sensitivity.RESULTS)
    headings = ["parameter", "value"] + [x for name in names for x in (name, "+-")]
    write_csv(page.folder, "sensitivity.csv", headings, [[p, value] + [x for name in names for x in row[name]] for (p, value), row in found.items()])
    rows = [[parameter, number(value)] + [f"{row[name][0]:.4g} +- {row[name][1]:.1g}" for name in names]
            for (parameter, value), row in found.items()]
    spans = []
    for parameter in sensitivity.VALUES:
        for name in names:
            means = np.array([row[name][0] for (p, _), row in found.items() if p == parameter])
            at_paper = found[parameter, sensitivity.PAPER[parameter]][name][0]
            spans.append([parameter, name, float(at_paper), float(means.min()), float(means.max()), f"{np.ptp(means) / at_paper:.0%}"])
    near = []
    for parameter in sensitivity.VALUES:
        tone = found[parameter, sensitivity.PAPER[parameter]]["main frequency (Hz)"][0]
        alike = {value: row["mu_inter"][0] for (p, value), row in found.items() if p == parameter and abs(row["main frequency (Hz)"][0] / tone - 1) < 0.05}
        near.append(f"{parameter} = {number(min(alike))} to {number(max(alike))}, mu_inter {min(alike.values()):.3f} to {max(alike.values()):.3f}")
    page.text("sensitivity", f"""
## Sensitivity to delta, beta2 and beta

The homogeneous pin at 5 MPa from rest on 140 x 40 cells (0.4 mm), time step 25 ns for all, {sensitivity.END * 1e3:g} ms, evaluated from {sensitivity.STEADY * 1e3:g} ms on; one parameter at a time, the others at the paper's delta = 1500 ns, beta = 4.4 ns and
beta2 = 0.5. +- is half the range over three starts that differ by 0.1 mm/s: it says how much of a difference is chance.

{table(["parameter", "result", "at the paper's value", "smallest", "largest", "range / value"], spans)}

The large ranges are jumps from one motion to another. Among the values that keep the main frequency within 5 %: {"; ".join(near)}.

![sensitivity](sensitivity.png)

Dotted: the paper's value. All numbers (delta and beta in s):

{table(["parameter", "value"] + names, rows)}

Data: [sensitivity.csv](sensitivity.csv).
""")
    return [], []
