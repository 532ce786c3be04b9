"""Pictures of the maps of the paper's pin."""

import numpy as np
from matplotlib.colors import ListedColormap, LogNorm
from matplotlib.patches import Patch
from report.base.figures import BLACK, BLUE, ORANGE, above_all, plt
from report.runs.sweep_map import REGIMES, draw_border, edges, plain_ticks

MU = "global_interface_friction_coefficient"
# Axis: factor and label.
AXES = {"pressure": (1e-6, "pressure (MPa)"), "velocity": (1, "velocity (m/s)"), "slow": (1, "velocity (m/s)"), "friction": (1, "friction coefficient"),
        "delta": (1e6, "regularization time (µs)"), "beta": (1e9, "Rayleigh damping (ns)"), "stiffness": (1e-9, "spring stiffness (GPa/m)")}
PAPER = [(0.4, 0.25), (0.5, 0.25)]  # MPa, friction coefficient


def scale(axis, letter, name):
    """Label and scale of the x or y axis."""
    getattr(axis, f"set_{letter}label")(AXES[name][1])
    if name != "friction":
        getattr(axis, f"set_{letter}scale")("log")
        plain_ticks(getattr(axis, letter + "axis"))


def places(one, swapped=False):
    """Names, values in the units of AXES, and borders of the two axes of a map."""
    names = list(one.axes)[::-1] if swapped else list(one.axes)
    values = [AXES[name][0] * np.asarray(one.axes[name]) for name in names]
    return names, values, [edges(v, name != "friction") for name, v in zip(names, values)]


def draw_regimes(axis, one, names, swapped=False):
    """Regimes in colours, and the border of growth of the complex modes where the map has it."""
    keys, values, borders = places(one, swapped)
    turned = (lambda array: np.asarray(array)) if swapped else (lambda array: np.asarray(array).T)
    regime = turned(one["regime"])
    shown = np.select([regime == name for name in names], range(len(names)), np.nan)
    axis.pcolormesh(*borders, np.ma.masked_invalid(shown), cmap=ListedColormap([REGIMES[name] for name in names]), vmin=-0.5, vmax=len(names) - 0.5)
    if one.border is not None:
        draw_border(axis, np.stack([AXES[name][0] * np.asarray(one.border[name]) for name in keys], axis=1), *values)
    for letter, name in zip("xy", keys):
        scale(axis, letter, name)
    axis.grid(False)


def names_of(maps):
    return [name for name in REGIMES if any((one["regime"] == name).any() for one in maps)]


def legend(figure, names):
    above_all(figure, [Patch(color=REGIMES[name], label=name) for name in names], 2)


def regimes(maps):
    """Four maps of the homogenized pin."""
    shown = [maps[name] for name in ("pressure-friction", "pressure-velocity", "delta-friction", "beta-friction")]
    names = names_of(shown)
    figure, panels = plt.subplots(2, 2, figsize=(8.4, 7.4))
    for letter, axis, one in zip("abcd", panels.ravel(), shown):
        draw_regimes(axis, one, names)
        axis.set_title(f"({letter})", loc="left")
    panels[0, 0].plot(*zip(*PAPER), "o", ms=6, mfc="white", mec=BLACK)
    panels[0, 1].plot([pressure for pressure, _ in PAPER], [2, 2], "o", ms=6, mfc="white", mec=BLACK)
    legend(figure, names)
    return figure


def spring(one, own):
    """Regimes and main frequency over that of pin and holder on their spring."""
    names = names_of([one])
    figure, panels = plt.subplots(1, 2, figsize=(9.2, 4.2))
    draw_regimes(panels[0], one, names)
    keys, _, borders = places(one)
    ratio = np.asarray(one["main_frequency"]) / own[None, :]
    drawn = panels[1].pcolormesh(*borders, np.ma.masked_invalid(ratio.T), cmap="viridis", norm=LogNorm())
    figure.colorbar(drawn, label="main frequency / frequency on the spring")
    for letter, name in zip("xy", keys):
        scale(panels[1], letter, name)
    panels[1].grid(False)
    for letter, axis in zip("ab", panels):
        axis.set_title(f"({letter})", loc="left")
    legend(figure, names)
    return figure


def disc(flat, one):
    """Regimes on the rigid flat and on the disc."""
    names = names_of([flat, one])
    figure, panels = plt.subplots(1, 2, figsize=(8.4, 4.4), sharey=True)
    for axis, shown, title in zip(panels, (flat, one), ("(a) rigid flat", "(b) steel disc")):
        draw_regimes(axis, shown, names)
        axis.set_title(title, loc="left")
    panels[1].set_ylabel("")
    legend(figure, names)
    return figure


def homogenization(maps, seeds):
    """mu_inter of homogenized pins and of pins with fibres."""
    figure, axis = plt.subplots(figsize=(5.2, 4.6))
    scatter([(maps[f"homogenized-{seed}"], maps[f"fibres-{seed}"]) for seed in seeds], axis)
    return figure


def scatter(pairs, axis):
    """mu_inter with fibres over the homogenized one, with the range over the morphologies."""
    homogenized, fibres = (np.array([pair[k][MU] for pair in pairs]) for k in (0, 1))
    regime = np.array([f["regime"] for _, f in pairs])
    alike = (regime == regime[0]).all(axis=0)
    for picked, colour, label in ((alike, BLUE, "one regime"), (~alike, ORANGE, "several regimes")):
        x, y = homogenized[:, picked], fibres[:, picked]
        axis.errorbar(x.mean(0), y.mean(0), [y.mean(0) - y.min(0), y.max(0) - y.mean(0)], [x.mean(0) - x.min(0), x.max(0) - x.mean(0)], fmt="o", ms=4,
                      lw=1, color=colour, label=label)
    top = 1.05 * max(homogenized.max(), fibres.max())
    axis.plot([0, top], [0, top], color=BLACK, lw=0.8, ls=":")
    axis.set(xlabel="mu_inter, homogenized", ylabel="mu_inter, with fibres")
    axis.legend()
