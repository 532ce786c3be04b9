"""The pictures of the study. Colours and style are those of the report."""

import os
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
import numpy as np  # noqa: E402
from report.base.figures import (BLACK, BLUE, GREEN, GREY, ORANGE, PINK, RUN_COLOURS, above, above_all, lettered,  # noqa: E402
                     plt)  # figures chooses the backend
from matplotlib.lines import Line2D  # noqa: E402

WIDTH = 9.0  # in
OUTCOME_COLOURS = {"stable": BLUE, "stopped": ORANGE}
LAST, LAST_CYCLES = 5e-5, 1.6e-5  # s, of the record over time and in the phase diagrams
CYCLES_UP_TO = 0.1  # mm; phase diagrams are those of these cells and finer ones
SPECTRUM_TO = 600e3  # Hz
TINY = 1e-17  # a residual of zero on a logarithmic axis
MU, DELTA, BETA, BETA2 = r"$\mu_\mathrm{inter}$", r"$\delta$", r"$\beta$", r"$\beta_2$"
BALANCE = "error of the energy balance / largest energy"


def time_step(sweep, limits):
    """`sweep` {(beta2, share): outcome}, `limits` [Limit]."""
    figure, (upper, lower) = plt.subplots(2, 1, figsize=(WIDTH, 8.2), height_ratios=(1, 2.6))
    tints = dict(zip(sorted({beta2 for beta2, _ in sweep}), RUN_COLOURS))
    for row, (beta2, tint) in enumerate(tints.items()):
        for outcome, mark in (("stable", "o"), ("stopped", "x")):
            shares = [share for (b, share), found in sweep.items() if b == beta2 and found == outcome]
            upper.plot(shares, [row] * len(shares), mark, color=tint, ms=7, mew=2)
    upper.axvline(1.0, color=GREY, linestyle=":")
    upper.set(yticks=range(len(tints)), yticklabels=[f"{BETA2} = {beta2:g}" for beta2 in tints], ylim=(len(tints) - 0.5, -0.5),
              xlabel="time step / predicted critical time step")
    upper.set_title("without damping", loc="left")
    above_all(figure, [Line2D([], [], color=BLACK, ls="", marker=mark, ms=7, mew=2, label=label) for mark, label in (("o", "stable"), ("x", "stopped by the program"))]
              + [Line2D([], [], color=tint, lw=3, label=f"{BETA2} = {beta2:g}") for beta2, tint in tints.items()], columns=6)

    bodies = list(dict.fromkeys(limit.body for limit in limits))
    for k, body in enumerate(bodies):
        own = sorted((limit for limit in limits if limit.body == body), key=lambda limit: (limit.beta, limit.beta2))
        for limit, y in zip(own, k + 0.055 * (np.arange(len(own)) - 0.5 * (len(own) - 1))):
            lower.plot([limit.low, limit.high], [y, y], "-", color=tints[limit.beta2], linewidth=2.4, solid_capstyle="butt")
    lower.axvspan(0.99, 1.01, color=GREEN, alpha=0.12)
    lower.text(1.0, -0.62, "± 1 %", color=GREEN, ha="center")
    lower.set_title("intervals of the bisections", loc="left")
    lettered((upper, lower))
    lower.set(yticks=range(len(bodies)), yticklabels=bodies, xlabel="observed / predicted critical time step",
              xlim=(0.975, 1.025), ylim=(len(bodies) - 0.4, -0.9))
    return figure


def energy_residuals(found):
    """`found` [(group, outcome, residual or None)]."""
    shown = [group for group in dict.fromkeys(group for group, *_ in found) if group != "to be stopped"]
    figure, axes = plt.subplots(figsize=(WIDTH, 5.4))
    for group, outcome, residual in found:
        if residual is not None and group in shown:
            axes.plot(max(residual, TINY), shown.index(group), "o", color=OUTCOME_COLOURS[outcome], alpha=0.6)
    axes.axvline(np.finfo(float).eps, color=GREY, linestyle=":")
    axes.text(np.finfo(float).eps, -0.75, " round-off of one operation", color=GREY)
    greek = {"beta": BETA, "beta2": BETA2, "delta": DELTA, "mu": r"$\mu$"}
    axes.set(xscale="log", yticks=range(len(shown)), yticklabels=[greek.get(group, group) for group in shown], ylim=(len(shown) - 0.5, -1.2), xlim=(1e-17, 1e-12),
             xlabel=BALANCE)
    return figure


def drift(curves):
    """`curves` {case: (steps, residuals)}."""
    figure, axes = plt.subplots(figsize=(WIDTH, 4.0))
    for (name, (step, residual)), tint in zip(curves.items(), RUN_COLOURS):
        axes.plot(step, np.maximum(residual, TINY), color=tint, label=name, linewidth=1.1)
    axes.set(xscale="log", yscale="log", xlabel="time step", ylabel=BALANCE.replace(" / ", " /\n"))
    above(axes, columns=3)
    return figure


def figure_five(nodes):
    """nodes: {(delta, h): Node}. The paper's figure 5, a column for each law."""
    deltas = sorted({delta for delta, _ in nodes})
    figure, axes = plt.subplots(3, len(deltas), figsize=(WIDTH, 9.0), sharey="row")
    tints = dict(zip(sorted({h for _, h in nodes}, reverse=True), (GREY, GREEN, BLUE, ORANGE)))
    for column, delta in enumerate(deltas):
        path, cycle, spectrum = axes[:, column]
        for (_, h), node in ((case, node) for case, node in nodes.items() if case[0] == delta):
            late, last = node.time > node.time[-1] - LAST, node.time > node.time[-1] - LAST_CYCLES
            path.plot(node.time[late] * 1e3, node.displacement[late] * 1e6, color=tints[h], linewidth=1.1)
            if h <= CYCLES_UP_TO:
                cycle.plot(node.displacement[last] * 1e6, node.velocity[last], color=tints[h], linewidth=1.1)
            frequency, amplitude = node.spectrum
            shown = frequency < SPECTRUM_TO
            spectrum.semilogy(frequency[shown] * 1e-3, amplitude[shown] * 1e9, color=tints[h], linewidth=0.9)
        path.set_title(f"plain Coulomb, {DELTA} = 0" if delta == 0 else f"{DELTA} = {delta * 1e9:.0f} ns", loc="left")
        path.set_xlabel("time (ms)")
        cycle.set_xlabel("$u_x$ (µm)")
        spectrum.set(xlabel="frequency (kHz)", ylim=(1e-1, 3e3))
    for row, label in zip(axes, ("$u_x$ (µm)", "$v_x$ (m/s)", "amplitude of $u_x$ (nm)")):
        row[0].set_ylabel(label)
    lettered(axes.flat)
    figure.align_ylabels()
    above_all(figure, [Line2D([], [], color=tint, label=f"h = {h:g} mm") for h, tint in tints.items()], columns=4)
    return figure


def refinement_numbers(numbers):
    """numbers: {(beta, delta, h): {name: value}}."""
    shown = (("mu_inter", 1.0, MU), ("rms v_x (m/s)", 1.0, "rms of $v_x$ (m/s)"),
             ("share of v_x above 400 kHz", 1.0, "share of $v_x$ above 400 kHz"), ("largest pressure (Pa)", 1e-6, "largest pressure (MPa)"))
    figure, axes = plt.subplots(2, 2, figsize=(WIDTH, 6.6))
    for axis, (name, factor, label) in zip(axes.flat, shown):
        for (beta, delta), (tint, mark) in zip(dict.fromkeys((b, d) for b, d, _ in numbers),
                                               ((ORANGE, "o-"), (BLUE, "o-"), (ORANGE, "s--"), (BLUE, "s--"))):
            points = [(h, values[name] * factor) for (b, d, h), values in numbers.items() if (b, d) == (beta, delta)]
            axis.plot(*zip(*points), mark, color=tint, markersize=5, label=f"{DELTA} = {delta * 1e9:g} ns, {BETA} = {beta * 1e9:g} ns")
        axis.set(xscale="log", xlabel="h (mm)", ylabel=label, xticks=(0.05, 0.1, 0.2, 0.4), xticklabels=("0.05", "0.1", "0.2", "0.4"))
        axis.minorticks_off()
        axis.set_ylim(bottom=0)
    lettered(axes.flat)
    above_all(figure, axes[0, 0].get_legend_handles_labels()[0], columns=2)
    return figure


def sensitivity(table, base):
    parameters = list(dict.fromkeys(parameter for parameter, _ in table))
    results = list(next(iter(table.values())))
    figure, axes = plt.subplots(len(results), len(parameters), figsize=(WIDTH, 8.2), sharey="row")
    scales = {"delta": (1e6, f"{DELTA} (µs)"), "beta2": (1, BETA2), "beta": (1e9, f"{BETA} (ns)")}
    labels = {"mu_inter": MU, "main frequency (Hz)": "main frequency (kHz)", "slip share": "share of slip"}
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
                axis.set_ylabel(labels[result])
            if row == len(results) - 1:
                axis.set_xlabel(label)
    for axis in axes[:, 0]:
        axis.set_ylim(bottom=0)  # last, as it fixes the upper end for the whole row
    lettered(axes.flat)
    figure.align_ylabels()
    return figure
