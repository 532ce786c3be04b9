"""Pictures of the prediction study; each function writes one PNG."""

import matplotlib.pyplot as plt
import numpy as np

import growth
import regime_map
from pages import save_picture

BLUE, ORANGE, GREEN, PINK, SKY, YELLOW, GREY = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#6b7280")
COLOURS = [BLUE, ORANGE, GREEN, PINK, SKY, YELLOW]
plt.rcParams.update({"font.size": 9, "axes.grid": True, "grid.color": "#e3e7eb", "axes.axisbelow": True,
                     "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
                     "figure.constrained_layout.use": True, "lines.linewidth": 1.3})
PAPER_REGIMES = {1: (0.30, 0.21), 2: (0.80, 0.17)}  # separation of M, mu_inter (section 2.4, fig. 7)
PAPER_LABELS = {1: (0.5, 0.31), 2: (0.8, 0.27)}  # where their names stand, off the points


def save(figure, folder, name):
    return save_picture(figure, folder, name, colours=96, dpi=90)


def growth_over_delta(folder, found):
    """Growth rates of the modes of eq. (10) over delta, with the morphologies at theirs; grey: modes that do not grow there."""
    figure, axes = plt.subplots(figsize=(6.4, 3.6))
    ns = np.array(growth.DELTAS) * 1e9
    growing = [k for k, s in enumerate(found.paper[growth.AT]) if s.real > 0]
    for k, branch in enumerate(found.paper.T):
        colour = COLOURS[growing.index(k) % len(COLOURS)] if k in growing else GREY
        label = f"{branch[growth.AT].imag / (2e3 * np.pi):.1f} kHz" if k in growing else None
        axes.plot(ns, branch.real, "-o", ms=3, color=colour, label=label, zorder=3 if k in growing else 2, lw=1.3 if k in growing else 0.7)
    for k in range(len(growing)):
        values = [line[k].real for line in found.morphologies.values()]
        axes.plot(np.full(len(values), ns[growth.AT]) + 25, values, "_", ms=9, color=COLOURS[k % len(COLOURS)], zorder=3)
    axes.axhline(0, color="black", lw=0.8)
    axes.set(xlabel="δ (ns)", ylabel="growth rate (1/s)", yscale="symlog")
    axes.set_yscale("symlog", linthresh=100)
    axes.legend(title="frequency at 1500 ns", ncol=2, fontsize=8, loc="lower left", bbox_to_anchor=(0.02, 0.12))
    return save(figure, folder, "growth.png")


def regime_maps(folder, found, starts, name):
    """Rows: mu_inter, separation of M, main frequency; columns: starts; each over P/V and delta."""
    pressures = sorted({p for p, _, _ in found})
    deltas = sorted({d for _, d, _ in found})
    rows = [("μ_inter", lambda m: m.mu, "viridis", 0.12, 0.25), ("separation of M", lambda m: m.middle[2], "magma", 0, 0.8),
            ("frequency (kHz)", lambda m: m.frequency / 1e3, "turbo", 30, 260)]
    figure, grid = plt.subplots(len(rows), len(starts), figsize=(1.4 + 3.3 * len(starts), 7.6), sharex=True, sharey=True)
    for row, (line, (title, value, colours, low, high)) in enumerate(zip(grid, rows)):
        for axes, start in zip(line, starts):
            field = np.full((len(deltas), len(pressures)), np.nan)
            for (p, d, s), (_, late) in found.items():
                if s == start:
                    field[deltas.index(d), pressures.index(p)] = np.nan if title[0] == "f" and late.slides else value(late)
            picture = axes.pcolormesh(np.arange(len(pressures) + 1), np.arange(len(deltas) + 1), field, cmap=colours, vmin=low,
                                      vmax=high)
            axes.grid(False)
            axes.set_facecolor("#d5d9de")
            for (i, j), v in np.ndenumerate(field):
                if np.isfinite(v):
                    dark = (v - low) / (high - low) < 0.55 if colours != "turbo" else not 0.25 < (v - low) / (high - low) < 0.8
                    axes.text(j + 0.5, i + 0.5, f"{v:.0f}" if high > 1 else f"{abs(v):.2f}".lstrip("0"), ha="center", va="center",
                              fontsize=6.5, color="white" if dark else "black")
            if row == 0:
                axes.set_title(start, fontsize=9)
            axes.set_xticks(np.arange(len(pressures)) + 0.5, [f"{p / regime_map.VELOCITY / 1e6:g}" for p in pressures],
                            fontsize=7)
            axes.set_yticks(np.arange(len(deltas)) + 0.5, [f"{d * 1e9:g}" for d in deltas], fontsize=7)
        line[0].set_ylabel("δ (ns)")
        shown = np.concatenate([np.ravel(axes.collections[0].get_array().compressed()) for axes in line])
        visible = 0.01 * (high - low)  # less is not seen, such as round-off below 0
        extend = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}[int(shown.min() < low - visible), int(shown.max() > high + visible)]
        figure.colorbar(picture, ax=line, label=title, aspect=18, extend=extend)
    for axes in grid[-1]:
        axes.set_xlabel("P/V [MPa s/m]")
    return save(figure, folder, name)


def search(folder, found):
    """All runs in the plane of the paper's two regimes: separation of M and mu_inter, coloured by frequency."""
    figure, grid = plt.subplots(1, 2, figsize=(8.4, 3.6), sharey=True)
    for axes, which, title in zip(grid, (0, 1), (regime_map.EARLY, regime_map.LATE)):
        runs = [pair[which] for pair in found.values() if not pair[which].slides]
        points = axes.scatter([m.middle[2] for m in runs], [m.mu for m in runs], c=[m.frequency / 1e3 for m in runs], s=14,
                              cmap="turbo", vmin=30, vmax=260)
        for number, (x, y) in PAPER_REGIMES.items():
            axes.plot(x, y, "*", ms=14, mfc="none", mec="black")
            axes.annotate(f"paper, regime {number}", (x, y), xytext=PAPER_LABELS[number], ha="center",
                          arrowprops={"arrowstyle": "-", "color": GREY, "shrinkB": 6})
        axes.set(xlim=(-0.03, 1), title=f"{title[0] * 1e3:g} to {title[1] * 1e3:g} ms", xlabel="share of time in which M is separated")
    grid[0].set_ylabel("μ_inter")
    figure.colorbar(points, ax=grid, label="main frequency (kHz)")
    return save(figure, folder, "regime2_search.png")


def mu_over_delta(folder, sweeps, morphologies):
    """mu_inter of the homogeneous pin over delta with the heterogeneous pins beside it; `sweeps` and `morphologies`
    {(load, window): ...}, the latter lists of Measures."""
    keys = list(sweeps)
    figure, grid = plt.subplots(1, len(keys), figsize=(2.6 * len(keys), 3.3), sharey=True, squeeze=False)
    for axes, key in zip(grid[0], keys):
        sweep, runs = sweeps[key], morphologies[key]
        axes.errorbar(sweep.deltas * 1e9, [m.mu for m in sweep.measures], yerr=[m.mu_error for m in sweep.measures], fmt="-o", ms=3,
                      color=BLUE, label="homogeneous", capsize=2)
        axes.errorbar(np.full(len(runs), 1500.) + 20 * (np.arange(len(runs)) - len(runs) / 2), [m.mu for m in runs],
                      yerr=[m.mu_error for m in runs], fmt="_", ms=5, color=ORANGE, lw=0.8, label="morphologies, δ = 1500 ns")
        axes.set(title=f"{key[0].label},\n{key[1]}", xlabel="δ (ns)")
    grid[0][0].set_ylabel("μ_inter")
    grid[0][0].legend(fontsize=7, loc="lower right")
    return save(figure, folder, "mu_over_delta.png")


def rule_errors(folder, rows, key):
    """Error of mu_inter of each rule, a point a morphology; `rows` {rule: array}."""
    figure, axes = plt.subplots(figsize=(6.4, 0.45 * len(rows) + 1.2))
    for k, (name, values) in enumerate(rows.items()):
        y = k + 0.3 * (np.arange(len(values)) / max(1, len(values) - 1) - 0.5)
        axes.plot(values, y, "o", ms=4, color=BLUE, alpha=0.75)
        axes.plot(np.mean(values), k, "|", ms=20, mew=2, color=ORANGE)
    axes.axvline(0, color="black", lw=0.8)
    axes.set_yticks(range(len(rows)), list(rows))
    axes.invert_yaxis()
    axes.set(xlabel="error of μ_inter, homogeneous minus heterogeneous",
             title=f"{key[0].label}, {key[1]} (bar: mean)")
    return save(figure, folder, f"rules_{key[0].key}_{key[1]}.png")


def cycle_life(folder, lines, times):
    """mu_inter over time for each D22, and at the end over D22; `lines` of cycle_life.over_d22, `times` the middles of its windows."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.4), width_ratios=(1.5, 1), sharey=True)
    for (d22, line), colour in zip(lines.items(), plt.cm.viridis(np.linspace(0, 0.92, len(lines)))):
        left.plot(times * 1e3, [m.mu for m in line], "o-", ms=2.5, color=colour, label=f"{d22 / 1e9:g}")
        right.plot(d22 / 1e9, line[-1].mu, "o", ms=5, color=colour)
    right.axvline(47.26, color=GREY, lw=0.9, ls="--")
    right.annotate("eq. (10)", (47.26, 0), (-3, 6), xycoords=("data", "axes fraction"), textcoords="offset points", ha="right", color=GREY)
    left.set(xlabel="time (ms)", ylabel="μ_inter, means over 1 ms")
    left.legend(title="D22 [GPa]", ncol=2, fontsize=8)
    right.set(xlabel="D22 [GPa]", title="9 to 10 ms")
    return save(figure, folder, "cycle_life.png")
