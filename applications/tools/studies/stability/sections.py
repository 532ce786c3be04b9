"""The parts of the study: each runs its cases and gives its section of the page, numbers inserted."""

import limit
import long_runs
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
    known = [f"{x:.4f}" for x in values if x is not None]
    return "-" if not known else min(known) if min(known) == max(known) else f"{min(known)} to {max(known)}"


def summary(folder):
    """The beginning of the page, with numbers from the tables in `folder`."""
    def column(name, key, wanted=lambda row: True):
        return [float(row[key]) for row in redraw.rows_of(folder, name) if wanted(row) and row[key]]

    few_rows = lambda row: row["body"] == limit.FEW_ROWS
    ratios = column("time_step.csv", "observed / predicted [-]", lambda row: not few_rows(row))
    outcomes = [row["outcome"] for row in redraw.rows_of(folder, "stress.csv")]
    error = max(column("million_steps.csv", "1e6 steps"))
    finest = {beta: column("refinement.csv", "mu_inter", lambda row, beta=beta: float(row["beta [ns]"]) == beta and float(row["delta [ns]"]) > 0)[-2:]
              for beta in (4.4, 0.0)}
    damped, bare = (abs(b / a - 1) for a, b in finest.values())
    return SUMMARY.format(low=min(ratios), high=max(ratios), tall=max(column("time_step.csv", "observed / predicted [-]", few_rows)), runs=len(outcomes),
                          stable=outcomes.count("stable"), stopped=outcomes.count("stopped"), error=error, damped=damped, bare=bare)


SUMMARY = """
# Stability under stress

`./run.sh stability` writes this page on runs of `contact_dynamics`.

A run is stable if all its data are finite, its energy balance closes to round-off and the body never holds more energy than was put in. If a run \
cannot be stable, the program has to stop it with exit status 3 and name step, time, place and likely cause.

* The observed limit of the time step is {low:.4f} to {high:.4f} times the predicted one, {tall:.4f} times on a grid of four tall rows.
* Of {runs} runs with one setting far beyond the paper's, {stable} are stable and {stopped} are stopped, as they should be.
* After a million steps without damping the energy balance is off by at most {error:.1e} of the largest energy.
* With the paper's beta = 4.4 ns results converge on finer cells: mu_inter changes by {damped:.1%} between the two finest grids. With beta = 0 it \
changes by {bare:.0%}.

![refinement](refinement.png)

Results on finer cells with and without delta and beta; dashed: without beta.
"""


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
                     span(x.observed for x in own), span(x.observed_over_held for x in own)])
    stable = [v for v in sweep.values() if v.outcome == "stable"]
    page.text("limit", f"""
## Time step: predicted and observed limit

The program predicts the critical time step from the largest frequency of the free grid ([theory](../theory.md), section 2). The observed limit comes \
from a bisection to {(limit.HIGH - limit.LOW) / 2 ** limit.ROUNDS:.2%} with runs of {limit.STEPS} steps. Observed / predicted has to be above 1 (safe) \
and below 1.01 (sharp). The last column compares with the exact largest frequency of the body as platen and flat hold it (`held_body.py`).

{table(["body", "beta2", "beta (ns)", "observed / predicted", "observed / exact, as held"], rows)}

On cells of 1:10 (four rows) the limit is higher, because the platen holds a large part of the stiffest mode.

![time step](time_step.png)

(a) Time steps from 0.5 to 1.1 of the critical one, homogeneous pin without damping. Below the limit the energy balance closes to \
{max(v.residual for v in stable):.1e}; above it every run is stopped, after {min(v.step for v in sweep.values() if v.step)} to \
{max(v.step for v in sweep.values() if v.step)} steps. (b) The last interval of each bisection; within a body beta grows downwards. Data: \
[time_step.csv](time_step.csv), [time_step_sweep.csv](time_step_sweep.csv).
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
        if group == "to be stopped":
            continue
        numbers = [value for value, _ in values if not isinstance(value, str)]
        told = [f"{number(min(numbers))} to {number(max(numbers))}"] if numbers else []
        told += [f"`{value}`" if set(" *") & set(value) else value for value, _ in values if isinstance(value, str)]
        others = [f"{number(value)}: {verdicts[group, value].outcome}" for value, _ in values if verdicts[group, value].outcome != "stable"]
        rows.append([group, ", ".join(told) + ("" if unit == "-" else " " + unit) + "".join("; " + other for other in others)])
    causes = [[value, v.step, v.cause] for (group, value), v in verdicts.items() if group == "to be stopped"]
    page.text("stress", f"""
## One setting at a time, far beyond the paper's

{len(verdicts)} runs of the pin on 70 x 20 cells for 0.5 ms change one setting each.

{table(["stable", "values"], rows)}

The program stops these runs:

{table(["stopped", "in step", "likely cause, as printed"], causes)}

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

28 x 8 cells move without damping (beta = 0, beta2 = 0.5), so that a loss or gain by the scheme would show. The table has the error of the energy \
balance over the largest energy; [million_steps.csv](million_steps.csv) adds 1e3, 1e4 and 1e5 steps.

{table(["case", "error after 1e6 steps"], [[row[0], number(row[4], 2)] for row in rows])}

The error is round-off. It is largest where the flat carries the body away ({bounce}: {travelled:.2g} m), because strains are then differences of large \
displacements.

![million steps](million_steps.png)

Data over time: [million_steps_drift.csv](million_steps_drift.csv).
""")
    return [verdict for verdict, _ in found.values()], []


def change(numbers, key, name):
    """Relative change of a result from the second finest to the finest cells."""
    beta, delta = key
    sizes = sorted(h for b, d, h in numbers if (b, d) == key)
    finest, before = (numbers[beta, delta, h][name] for h in sizes[:2])
    return abs(finest / before - 1)


def cases_of(numbers):
    """[(beta, delta)]"""
    return list(dict.fromkeys((beta, delta) for beta, delta, _ in numbers))


def case_row(numbers, case, names):
    """beta, delta, the sizes of the cells, and the results `names`, each from coarse to fine cells."""
    sizes = [h for *of, h in numbers if tuple(of) == case]
    return [f"{case[0] * 1e9:g}", f"{case[1] * 1e9:g}", ", ".join(f"{h:g}" for h in sizes)] \
        + [", ".join(f"{numbers[(*case, h)][name]:.3g}" for h in sizes) for name in names]


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
    late = refinement.run(study, refinement.LONG_MM, refinement.LONG_END, refinement.LONG_STEADY, "refinement-long")
    late_names = list(sensitivity.RESULTS)
    late_rows = [[f"{beta * 1e9:g}", f"{delta * 1e9:g}", f"{h:g}"] + [result.summary[sensitivity.RESULTS[name]] for name in late_names]
                 for (beta, delta, h), result in late.items()]
    late_numbers = {case: {name: result.summary[sensitivity.RESULTS[name]] for name in late_names} for case, result in late.items()}
    write_csv(page.folder, "refinement_long.csv", ["beta [ns]", "delta [ns]", "h [mm]"] + late_names, late_rows)
    short = [case_row(numbers, case, ("mu_inter",)) + case_row(late_numbers, case, ("mu_inter",))[-1:]
             + [number(numbers[(*case, 0.1)]["main frequency (Hz)"])] + [f"{change(numbers, case, name):.1%}" for name in ("mu_inter", "slip share")] for case in cases_of(numbers)]
    waves, growth = refinement.growth_rates()
    rates = table(["beta (ns)", "delta (ns)"] + [f"{wave * 1e3:.3g} mm" for wave in waves],
                  [[f"{beta * 1e9:g}", f"{delta * 1e9:g}"] + [cell if cell is None else f"{cell:.0f}" for cell in row]
                   for beta, delta, *row in growth])
    page.text("refinement", REFINEMENT.format(
        numbers=table(["beta (ns)", "delta (ns)", "cells (mm)", "mu_inter", f"from {refinement.LONG_STEADY * 1e3:g} to {refinement.LONG_END * 1e3:g} ms",
                       "main frequency (Hz)", "change of mu_inter", "change of the slip share"], short), rates=rates,
        late_steady=refinement.LONG_STEADY * 1e3, late_end=refinement.LONG_END * 1e3, steady=refinement.STEADY * 1e3, end=refinement.END * 1e3,
        last=plots.LAST * 1e3, cycles=plots.LAST_CYCLES * 1e3, finer=plots.CYCLES_UP_TO))
    return [], []


REFINEMENT = """
## What regularization buys: refinement with and without delta

The homogeneous pin (5 MPa, 2 m/s, mu = 0.25, time step auto) on ever finer cells, from {steady:g} to {end:g} ms. From {late_steady:g} to \
{late_end:g} ms (cells of 0.4, 0.2 and 0.1 mm) the limit cycle is reached with the paper's beta. The main frequency is from cells of 0.1 mm; the last two \
columns compare the two finest grids.

{numbers}

![figure 5](figure_5.png)

The paper's figure 5 for the middle contact node, beta = 4.4 ns: u_x over the last {last:g} ms (a, b), phase diagrams of the last {cycles:g} ms on cells of \
{finer:g} mm and less (c, d), spectrum of u_x (e, f).

The growth rates (1/s) of steady sliding by wavelength explain the results. They come from the exact dispersion relation of a layer as tall and stiff \
as the pin; dash: no growth.

{rates}

* Without delta and beta, short waves grow as fast as long ones and waves of the grid at a rate proportional to 1/h \
([theory](../theory.md#3-contact-and-friction-libcontactcontact_kernelcc)), so that refinement has no limit.
* With delta = 1500 ns only long waves grow. delta also decides which motion follows.
* beta makes the runs converge: it stops the growth of waves shorter than some millimetres. Without beta, nodes that land excite fast motion that \
nothing damps, and results change with the cells even with delta.

[Run time against error](../performance/work_precision.md) extrapolates the limit cycle to h, dt -> 0. \
Data: [refinement.csv](refinement.csv), [refinement_long.csv](refinement_long.csv), [figure_5.csv](figure_5.csv), \
[figure_5_spectrum.csv](figure_5_spectrum.csv).
"""


def sensitivity_part(study, page):
    found = sensitivity.run(study)
    picture(page, "sensitivity.png", plots.sensitivity(found, sensitivity.PAPER))
    names = list(sensitivity.RESULTS)
    headings = ["parameter", "value"] + [x for name in names for x in (name, "+-")]
    write_csv(page.folder, "sensitivity.csv", headings, [[p, value] + [x for name in names for x in row[name]] for (p, value), row in found.items()])
    spans = [["paper's values"] + [float(found["delta", sensitivity.PAPER["delta"]][name][0]) for name in names]]
    for parameter in sensitivity.VALUES:
        own = [row for (p, _), row in found.items() if p == parameter]
        spans.append([f"{parameter} = {min(sensitivity.VALUES[parameter]):g} to {max(sensitivity.VALUES[parameter]):g}"]
                     + [f"{min(row[name][0] for row in own):.3g} to {max(row[name][0] for row in own):.3g}" for name in names])
    near = []
    for parameter in sensitivity.VALUES:
        tone = found[parameter, sensitivity.PAPER[parameter]]["main frequency (Hz)"][0]
        alike = {value: row["mu_inter"][0] for (p, value), row in found.items() if p == parameter and abs(row["main frequency (Hz)"][0] / tone - 1) < 0.05}
        near.append(f"{parameter} = {number(min(alike))} to {number(max(alike))} (mu_inter {min(alike.values()):.3f} to {max(alike.values()):.3f})")
    page.text("sensitivity", f"""
## Sensitivity to delta, beta2 and beta

The homogeneous pin (5 MPa from rest, 140 x 40 cells of 0.4 mm, time step 25 ns), from {sensitivity.STEADY * 1e3:g} to {sensitivity.END * 1e3:g} ms. \
One parameter changes at a time; the others keep the paper's values, delta = 1500 ns, beta = 4.4 ns and beta2 = 0.5.

{table(["parameter (delta and beta in s)"] + names, spans)}

The main frequency stays within 5 % for {"; ".join(near)}.

![sensitivity](sensitivity.png)

Dotted: the paper's value. Data, with the scatter of three starts that differ by 0.1 mm/s: [sensitivity.csv](sensitivity.csv).
""")
    return [], []
