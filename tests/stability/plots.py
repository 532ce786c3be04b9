"""The pictures of the study. Colours and style are those of the report."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "applications", "tools", "report"))
import matplotlib.pyplot as plt  # noqa: E402  (figures chooses the backend)
import numpy as np  # noqa: E402
from figures import BLUE, GREEN, GREY, ORANGE, PINK, RUN_COLOURS, above  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

OUTCOME_COLOURS = {"stable": BLUE, "stopped": ORANGE}
LAST = 5e-5  # s, of the record in the phase diagrams
TINY = 1e-17  # a residual of zero on a logarithmic axis


def time_step(sweep, limits):
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(7.2, 9.0), height_ratios=(1, 2))
    tints = dict(zip(sorted({beta2 for beta2, _ in sweep}), RUN_COLOURS))
    for (beta2, tint), size in zip(tints.items(), (10, 7.5, 5, 2.5)):  # equal values show as rings
        stable = [(share, v.growth) for (b, share), v in sweep.items() if b == beta2 and v.outcome == "stable"]
        stopped = [share for (b, share), v in sweep.items() if b == beta2 and v.outcome == "stopped"]
        upper.plot(*zip(*stable), "o-", color=tint, label=f"beta2 = {beta2:g}", markersize=size, linewidth=1)
        upper.plot(stopped, [1e6] * len(stopped), "^", color=tint, markersize=size)
    upper.axvline(1.0, color=GREY, linestyle=":")
    upper.axhline(1e6, color=GREY, linewidth=0.8)
    upper.text(0.5, 4e5, "stopped here (triangles)", color=GREY, va="top")
    upper.set(yscale="log", ylim=(0.3, 4e6), xlabel="time step / predicted critical time step",
              ylabel="largest energy / energy put in")
    above(upper, columns=4)

    bodies = list(dict.fromkeys(limit.body for limit in limits))
    for k, body in enumerate(bodies):
        own = sorted((limit for limit in limits if limit.body == body), key=lambda limit: (limit.beta, limit.beta2))
        for limit, y in zip(own, k + 0.055 * (np.arange(len(own)) - 0.5 * (len(own) - 1))):
            lower.plot([limit.low, limit.high], [y, y], "-", color=tints[limit.beta2], linewidth=2.4, solid_capstyle="butt")
    lower.axvspan(0.99, 1.01, color=GREEN, alpha=0.12)
    lower.text(1.0, -0.62, "1 %", color=GREEN, ha="center")
    lower.set(yticks=range(len(bodies)), yticklabels=bodies, xlabel="observed / predicted critical time step",
              xlim=(0.975, 1.025), ylim=(len(bodies) - 0.4, -0.9))
    return figure


def energy_residuals(verdicts):
    groups = list(dict.fromkeys(group for group, _ in verdicts))
    figure, axes = plt.subplots(figsize=(7.2, 5.2))
    for group, value in verdicts:
        verdict = verdicts[group, value]
        if verdict.residual is not None:
            axes.plot(max(verdict.residual, TINY), groups.index(group), "o", color=OUTCOME_COLOURS[verdict.outcome], alpha=0.6)
    axes.axvline(np.finfo(float).eps, color=GREY, linestyle=":")
    axes.text(np.finfo(float).eps, -0.75, " round-off of one operation", color=GREY)
    shown = [group for group in groups if group != "to be stopped"]
    axes.set(xscale="log", yticks=range(len(shown)), yticklabels=shown, ylim=(len(shown) - 0.5, -1.2), xlim=(1e-17, 1e-11),
             xlabel="error of the energy balance / largest energy")
    return figure


def drift(curves):
    figure, axes = plt.subplots(figsize=(7.2, 3.8))
    for (name, (step, residual)), tint in zip(curves.items(), RUN_COLOURS):
        axes.plot(step[1:], np.maximum(residual[1:], TINY), color=tint, label=name, linewidth=0.9)
    axes.set(xscale="log", yscale="log", xlabel="time step", ylabel="error of the energy balance\n/ largest energy")
    above(axes, columns=2)
    return figure


def figure_five(nodes):
    """nodes: {(delta, h): Node}. The paper's figure 5, a column for each law."""
    deltas = sorted({delta for delta, _ in nodes})
    figure, axes = plt.subplots(3, len(deltas), figsize=(9.0, 9.0), sharey="row")
    tints = dict(zip(sorted({h for _, h in nodes}, reverse=True), (GREY, GREEN, BLUE, ORANGE)))
    for column, delta in enumerate(deltas):
        path, cycle, spectrum = axes[:, column]
        for (_, h), node in ((case, node) for case, node in nodes.items() if case[0] == delta):
            late = node.time > node.time[-1] - LAST
            path.plot(node.time[late] * 1e3, node.displacement[late] * 1e6, color=tints[h], linewidth=0.9)
            cycle.plot(node.displacement[late] * 1e6, node.velocity[late], color=tints[h], linewidth=0.6)
            frequency, amplitude = node.spectrum
            shown = frequency < 600e3
            spectrum.semilogy(frequency[shown] * 1e-3, amplitude[shown] * 1e9, color=tints[h], linewidth=0.8)
        path.set_title("plain Coulomb, delta = 0" if delta == 0 else f"delta = {delta * 1e9:.0f} ns")
        path.set_xlabel("t (ms)")
        cycle.set_xlabel("u_x (µm)")
        spectrum.set(xlabel="frequency (kHz)", ylim=(1e-1, 3e3))
    for row, label in zip(axes, ("u_x of the middle node (µm)", "v_x (m/s)", "amplitude of u_x (nm)")):
        row[0].set_ylabel(label)
    figure.legend(handles=[Line2D([], [], color=tint, label=f"h = {h:g} mm") for h, tint in tints.items()],
                  loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=4)
    return figure


def refinement_numbers(numbers):
    """numbers: {(beta, delta, h): {name: value}}."""
    shown = (("mu_inter", 1.0, "mu_inter"), ("rms v_x (m/s)", 1.0, "rms v_x (m/s)"),
             ("share of v_x above 400 kHz", 1.0, "share of v_x above 400 kHz"), ("largest pressure (Pa)", 1e-6, "largest pressure (MPa)"))
    figure, axes = plt.subplots(2, 2, figsize=(8.6, 6.4))
    for axis, (name, factor, label) in zip(axes.flat, shown):
        for (beta, delta), (tint, mark) in zip(dict.fromkeys((b, d) for b, d, _ in numbers),
                                               ((ORANGE, "o-"), (BLUE, "o-"), (ORANGE, "s--"), (BLUE, "s--"))):
            points = [(h, values[name] * factor) for (b, d, h), values in numbers.items() if (b, d) == (beta, delta)]
            axis.plot(*zip(*points), mark, color=tint, markersize=5, label=f"delta = {delta * 1e9:g} ns, beta = {beta * 1e9:g} ns")
        axis.set(xscale="log", xlabel="h (mm)", ylabel=label, xticks=(0.05, 0.1, 0.2, 0.4), xticklabels=("0.05", "0.1", "0.2", "0.4"))
        axis.minorticks_off()
        axis.set_ylim(bottom=0)
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2)
    return figure


def sensitivity(table, base):
    parameters = list(dict.fromkeys(parameter for parameter, _ in table))
    results = list(next(iter(table.values())))
    figure, axes = plt.subplots(len(results), len(parameters), figsize=(9.6, 8.2), sharey="row")
    scales = {"delta": (1e6, "delta (µs)"), "beta2": (1, "beta2"), "beta": (1e9, "beta (ns)")}
    for column, parameter in enumerate(parameters):
        factor, label = scales[parameter]
        values = [value for name, value in table if name == parameter]
        for row, result in enumerate(results):
            mean, half = np.array([table[parameter, value][result] for value in values]).T
            unit = 1e-3 if "Hz" in result else 1.0
            axis = axes[row, column]
            axis.errorbar(np.array(values) * factor, mean * unit, half * unit, fmt="o-", color=BLUE, capsize=3, markersize=4)
            axis.axvline(base[parameter] * factor, color=PINK, linestyle=":")
            if column == 0:
                axis.set_ylabel(result.replace("Hz", "kHz"))
            if row == len(results) - 1:
                axis.set_xlabel(label)
    for axis in axes[:, 0]:
        axis.set_ylim(bottom=0)  # last, as it fixes the upper end for the whole row
    return figure
