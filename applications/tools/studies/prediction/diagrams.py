"""Pictures of the prediction study; each function writes one PNG. Colours and settings are those of the report."""

import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))

import numpy as np  # noqa: E402
from matplotlib.colors import BoundaryNorm, ListedColormap  # noqa: E402
from report.base.figures import BLACK, BLUE, GREEN, GREY, ORANGE, RUN_COLOURS, above, above_all, lettered, plt  # noqa: E402

import growth  # noqa: E402
import regime_map  # noqa: E402
from pages import save_picture  # noqa: E402

WIDTH = 9.0  # in
MU = r"$\mu_\mathrm{inter}$"
DELTA = r"$\delta$"
PAPER_REGIMES = {1: (0.30, 0.21), 2: (0.80, 0.17)}  # separation of M, mu_inter (section 2.4, fig. 7)
PAPER_LABELS = {1: (0.5, 0.31), 2: (0.8, 0.27)}  # where their names stand, off the points
# Main frequencies of the runs lie in three groups: first mode, 120 to 150 kHz, 170 kHz and above.
BANDS = {"below 80 kHz": (0, 80, BLUE, "o"), "80 to 160 kHz": (80, 160, GREEN, "^"), "above 160 kHz": (160, np.inf, ORANGE, "s")}
BAND_EDGES = (0, 80, 160, 400)  # kHz


def save(figure, folder, name):
    return save_picture(figure, folder, name, colours=96, dpi=100)


def growth_over_delta(folder, paper, morphologies):
    """Growth rates of the modes of eq. (10) over delta, `paper` [deltas][modes] in 1/s, with the `morphologies` {seed: modes} at theirs;
    grey: modes that do not grow there."""
    figure, axes = plt.subplots(figsize=(7.6, 4.4))
    ns = np.array(growth.DELTAS) * 1e9
    growing = [k for k, s in enumerate(paper[growth.AT]) if s.real > 0]
    for k, branch in enumerate(paper.T):
        colour = RUN_COLOURS[growing.index(k) % len(RUN_COLOURS)] if k in growing else GREY
        label = f"{branch[growth.AT].imag / (2e3 * np.pi):.1f} kHz" if k in growing else None
        axes.plot(ns, branch.real, "-o", ms=3.5, color=colour, label=label, zorder=3 if k in growing else 2, lw=1.5 if k in growing else 0.8)
    for k in range(len(growing)):
        values = [line[k].real for line in morphologies.values()]
        axes.plot(np.full(len(values), ns[growth.AT]) + 30, values, "_", ms=10, color=RUN_COLOURS[k % len(RUN_COLOURS)], zorder=3)
    axes.axhline(0, color=BLACK, lw=0.8)
    axes.set(xlabel=f"{DELTA} (ns)", ylabel="growth rate (1/s)")
    axes.set_yscale("symlog", linthresh=100)
    above(axes, columns=6)
    return save(figure, folder, "growth.png")


def _field(found, start, pressures, deltas, value):
    """Late values [deltas][pressures] of the runs with one start."""
    field = np.full((len(deltas), len(pressures)), np.nan)
    for (p, d, s), (_, late) in found.items():
        if s == start:
            field[deltas.index(d), pressures.index(p)] = value(late)
    return field


def regime_maps(folder, found, starts, name):
    """Rows: mu_inter, separation of M, main frequency; columns: starts; each over P/V and delta, in steps of colour."""
    pressures = sorted({p for p, _, _ in found})
    deltas = sorted({d for _, d, _ in found})
    bands = ListedColormap([colour for _, _, colour, _ in BANDS.values()])
    rows = [(MU, lambda m: m.mu, np.arange(0.11, 0.2501, 0.02), "viridis", "both"),
            ("share of separation of M", lambda m: abs(m.middle[2]), np.arange(0, 0.901, 0.15), "viridis", "neither"),
            ("main frequency (kHz)", lambda m: np.nan if m.slides else m.frequency / 1e3, np.array(BAND_EDGES), bands, "neither")]
    figure, grid = plt.subplots(len(rows), len(starts), figsize=(WIDTH, 7.4), sharex=True, sharey=True)
    for line, (title, value, steps, colours, extend) in zip(grid, rows):
        fields = [_field(found, start, pressures, deltas, value) for start in starts]
        colours = plt.get_cmap(colours)
        norm = BoundaryNorm(steps, colours.N, extend=extend)
        for axes, field in zip(line, fields):
            picture = axes.pcolormesh(np.arange(len(pressures) + 1), np.arange(len(deltas) + 1), field, cmap=colours, norm=norm, edgecolor="white",
                                      linewidth=0.4)
            axes.grid(False)
            axes.set_facecolor("#d5d9de")
        line[0].set_ylabel(f"{DELTA} (ns)")
        figure.colorbar(picture, ax=list(line), label=title, aspect=14, pad=0.01, ticks=steps)
    for axes, start in zip(grid[0], starts):
        axes.set_title(start, loc="left")
    for axes in grid[-1]:
        axes.set_xticks(np.arange(len(pressures)) + 0.5, [f"{p / regime_map.VELOCITY / 1e6:g}" for p in pressures],
                        **({} if len(starts) < 3 else {"rotation": 90, "fontsize": 9.5}))
    grid[0][0].set_yticks(np.arange(len(deltas)) + 0.5, [f"{d * 1e9:g}" for d in deltas])
    figure.supxlabel("P/V (MPa s/m)", fontsize=11.5)
    lettered(grid[0])
    return save(figure, folder, name)


def search(folder, found):
    """All runs in the plane of the paper's two regimes: separation of M and mu_inter, by main frequency."""
    figure, grid = plt.subplots(1, 2, figsize=(WIDTH, 4.2), sharey=True)
    for axes, which, window in zip(grid, (0, 1), (regime_map.EARLY, regime_map.LATE)):
        runs = [pair[which] for pair in found.values() if not pair[which].slides]
        for label, (low, high, colour, mark) in BANDS.items():
            own = [m for m in runs if low <= m.frequency / 1e3 < high]
            axes.plot([m.middle[2] for m in own], [m.mu for m in own], mark, ms=4, color=colour, alpha=0.7, mew=0, label=label)
        for number, (x, y) in PAPER_REGIMES.items():
            axes.plot(x, y, "*", ms=15, mfc="white", mec=BLACK)
            axes.annotate(f"paper, regime {number}", (x, y), xytext=PAPER_LABELS[number], ha="center",
                          arrowprops={"arrowstyle": "-", "color": GREY, "shrinkB": 6})
        axes.set(xlim=(-0.03, 1), xlabel="share of time in which M is separated")
        axes.set_title(f"{window[0] * 1e3:g} to {window[1] * 1e3:g} ms", loc="left")
    grid[0].set_ylabel(MU)
    lettered(grid)
    above_all(figure, grid[0].get_legend_handles_labels()[0])
    return save(figure, folder, "regime2_search.png")


def mu_over_delta(folder, sweeps, morphologies):
    """mu_inter of the homogeneous pin over delta with the heterogeneous pins beside it; `sweeps` and `morphologies`
    {(load, window): ...}, the latter lists of Measures. A row for each load."""
    loads = list(dict.fromkeys(load for load, _ in sweeps))
    figure, grid = plt.subplots(len(loads), len(sweeps) // len(loads), figsize=(WIDTH, 2.6 * len(loads) + 0.5), sharex=True, sharey=True, squeeze=False)
    for axes, key in zip(grid.flat, sweeps):
        sweep, runs = sweeps[key], morphologies[key]
        axes.errorbar(sweep.deltas * 1e9, [m.mu for m in sweep.measures], yerr=[m.mu_error for m in sweep.measures], fmt="-o", ms=4,
                      color=BLUE, label="homogeneous", capsize=2)
        axes.errorbar(np.full(len(runs), 1500.) + 25 * (np.arange(len(runs)) - 0.5 * (len(runs) - 1)), [m.mu for m in runs],
                      yerr=[m.mu_error for m in runs], fmt="_", ms=6, color=ORANGE, lw=0.9, label=f"morphologies, {DELTA} = 1500 ns")
        axes.set_title(f"{key[0].label}, {key[1]}", loc="left")
    for axes in grid[-1]:
        axes.set_xlabel(f"{DELTA} (ns)")
    for axes in grid[:, 0]:
        axes.set_ylabel(MU)
    lettered(grid.flat)
    above_all(figure, grid[0][0].get_legend_handles_labels()[0])
    return save(figure, folder, "mu_over_delta.png")


def rule_errors(folder, rows, key):
    """Error of mu_inter of each rule, a point a morphology; `rows` {rule: array}."""
    figure, axes = plt.subplots(figsize=(7.6, 0.4 * len(rows) + 1.3))
    for k, values in enumerate(rows.values()):
        y = k + 0.3 * (np.arange(len(values)) / max(1, len(values) - 1) - 0.5)
        axes.plot(values, y, "o", ms=4.5, color=BLUE, alpha=0.75, mew=0, label="morphologies" if k == 0 else None)
        axes.plot(np.mean(values), k, "|", ms=16, mew=2.2, color=ORANGE, label="mean" if k == 0 else None)
    axes.axvline(0, color=BLACK, lw=0.8)
    axes.set_yticks(range(len(rows)), list(rows))
    axes.invert_yaxis()
    axes.set(xlabel=f"error of {MU}, homogeneous minus heterogeneous")
    above(axes)
    return save(figure, folder, f"rules_{key[0].key}_{key[1]}.png")


def cycle_life(folder, lines, times):
    """mu_inter over time for each D22, and at the end over D22; `lines` of cycle_life.over_d22, `times` the middles of its windows."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(WIDTH, 4.6), width_ratios=(1.5, 1), sharey=True)
    for (d22, line), colour in zip(lines.items(), plt.cm.viridis(np.linspace(0, 0.92, len(lines)))):
        left.plot(times * 1e3, [m.mu for m in line], "o-", ms=3, color=colour, label=f"{d22 / 1e9:g} GPa")
        right.plot(d22 / 1e9, line[-1].mu, "o", ms=6, color=colour)
    right.axvline(47.26, color=GREY, lw=0.9, ls="--")
    right.annotate("eq. (10)", (47.26, 0), (-4, 6), xycoords=("data", "axes fraction"), textcoords="offset points", ha="right", color=GREY)
    left.set(xlabel="time (ms)", ylabel=f"{MU}, means over 1 ms")
    left.set_title("over time", loc="left")
    right.set(xlabel="$D_{22}$ (GPa)")
    right.set_title("9 to 10 ms", loc="left")
    lettered((left, right))
    above_all(figure, left.get_legend_handles_labels()[0], columns=6)
    return save(figure, folder, "cycle_life.png")
