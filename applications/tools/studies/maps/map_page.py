"""The page of the maps of the paper's pin."""

import contextlib

import mesoslip
import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch
from pages import save_picture, table, write_csv, write_page
from report.base.figures import BLACK, above_all, plt
from report.runs.sweep_map import REGIMES, edges, plain_ticks

MU = "global_interface_friction_coefficient"
NUMBERS = {MU: "mu_inter", MU + "_95": "half width", "main_frequency": "main frequency (kHz)", "slip_fraction": "slip", "stick_fraction": "stick",
           "separation_fraction": "separation"}
REACHED = "limit_cycle_reached"
PAGE = """# Maps of the paper's pin

{summary}

![Regimes](pin_regimes.png)

*(a) Homogenized. (b), (c) With all fibres, two morphologies. The paper has 0.5 and 0.4 MPa with a friction coefficient of 0.25 \
([how the paper was read](../paper/reading.md)).*

## What homogenization gets right

The table compares two pins over the map. If homogenized pin and pin with fibres (first row) differ no more than two morphologies with fibres (last \
row), the homogenized pin is as good as a pin with another morphology of the same material.

{comparison}

![Friction](pin_friction.png)

*Global interface friction coefficient over the friction coefficient of the nodes. Lines: homogenized; points: with fibres; bars: 95 % half widths of \
the runs.*

## How it was obtained

`./run.sh maps` makes {maps} [maps](../maps.md) over pressure and friction coefficient, {runs} runs of `contact_dynamics`: {n} points, {seeds} \
morphologies, each pin with all fibres (560 x 160 cells) and homogenized (140 x 40 cells, effective stiffness of its own morphology). The pin is the \
paper's, 56 x 16 mm with 10 % of stiff fibres. It starts with 0.5 m/s along x on a flat that moves at 2 m/s. Results are from the second half of \
{end:g} ms; the regime is that of the middle contact node. [pin.csv](pin.csv) has all points.

## Limits

Only {reached} of the {runs} runs reached a limit cycle within {end:g} ms. Another vibration that grows slowly may still follow, as at high pressure.
"""


def axes_of(axis):
    axis.set(xscale="log", xlabel="pressure (MPa)")
    plain_ticks(axis.xaxis)
    axis.grid(False)


def regimes(found):
    """Maps side by side: {title: SweepMap}."""
    names = [name for name in REGIMES if any((one["regime"] == name).any() for one in found.values())]
    figure, panels = plt.subplots(1, len(found), figsize=(3.2 * len(found), 3.6), sharey=True)
    for letter, axis, (title, one) in zip("abcd", panels, found.items()):
        regime = one["regime"]
        shown = np.select([regime.T == name for name in names], range(len(names)), np.nan)
        axis.pcolormesh(edges(one.axes["pressure"] / 1e6, True), edges(one.axes["friction"], False), np.ma.masked_invalid(shown),
                        cmap=ListedColormap([REGIMES[name] for name in names]), vmin=-0.5, vmax=len(names) - 0.5)
        axis.set_title(f"({letter}) {title}", loc="left")
        axes_of(axis)
    panels[0].set_ylabel("friction coefficient")
    above_all(figure, [Patch(color=REGIMES[name], label=name) for name in names], 2)
    return figure


def friction(pairs):
    """mu_inter over the coefficient at each pressure: lines of the homogenized pin, points of those with fibres."""
    homogenized = pairs[0][0]
    figure, axis = plt.subplots(figsize=(6.4, 4.2))
    colours = plt.cm.viridis(np.linspace(0, 0.9, len(homogenized.axes["pressure"])))
    for k, (pressure, colour) in enumerate(zip(homogenized.axes["pressure"], colours)):
        axis.plot(homogenized.axes["friction"], np.mean([h[MU][k] for h, _ in pairs], axis=0), color=colour, label=f"{pressure / 1e6:.2g} MPa")
        for shift, (_, fibres) in zip((-0.003, 0.003), pairs):
            axis.errorbar(fibres.axes["friction"] + shift, fibres[MU][k], np.nan_to_num(fibres[MU + "_95"][k]), color=colour, fmt="o", ms=4, lw=1)
    axis.plot(homogenized.axes["friction"], homogenized.axes["friction"], color=BLACK, lw=0.8, ls=":", label="sliding everywhere")
    axis.set(xlabel="friction coefficient of the nodes", ylabel="global interface friction coefficient")
    axis.legend(ncol=2)
    return figure


def compared(pairs):
    """Rows: how far the homogenized pin is from that with fibres, and the latter from one another."""
    (h1, f1), (h2, f2) = pairs
    rows = []
    for what, couples in (("homogenized against fibres", pairs), ("two homogenized morphologies", [(h1, h2)]), ("two morphologies with fibres", [(f1, f2)])):
        off = np.array([one[MU] / other[MU] - 1 for one, other in couples])
        frequency = np.array([one["main_frequency"] / other["main_frequency"] - 1 for one, other in couples])
        separation = np.array([one["separation_fraction"] - other["separation_fraction"] for one, other in couples])
        same = np.mean([one["regime"] == other["regime"] for one, other in couples])
        rows.append([what, f"{100 * same:.0f} %", f"{100 * np.nanmedian(np.abs(off)):.1f} %", f"{100 * np.nanmax(np.abs(off)):.0f} %",
                     f"{100 * np.nanmedian(np.abs(frequency)):.1f} %", f"{100 * np.mean(np.abs(separation)):.0f} %"])
    return rows


def write(folder, folders, seeds, end):
    with contextlib.ExitStack() as stack:
        write_of(folder, {name: stack.enter_context(mesoslip.open(path)).map for name, path in folders.items() if not name.startswith("rve")}, seeds, end)


def write_of(folder, maps, seeds, end):
    pairs = [(maps[f"homogenized-{seed}"], maps[f"fibres-{seed}"]) for seed in seeds]
    save_picture(regimes({"homogenized": pairs[0][0], **{f"fibres, morphology {seed}": fibres for seed, (_, fibres) in zip(seeds, pairs)}}), folder,
                 "pin_regimes.png")
    save_picture(friction(pairs), folder, "pin_friction.png")
    rows = compared(pairs)
    n = pairs[0][0].status.size
    comparison = table(["", "same regime", "mu_inter, median", "mu_inter, largest", "main frequency, median", "share of separation, mean"], rows)
    reached = int(sum(np.nansum(one[REACHED]) for one in maps.values()))
    summary = (f"**The homogenized pin has the regime of the pin with fibres at {rows[0][1]} of the points; two morphologies "
               f"with fibres agree at {rows[2][1]}.** The median difference of mu_inter is {rows[0][2]} between the homogenized "
               f"pin and the pin with fibres, {rows[2][2]} between two morphologies with fibres.")
    columns = ["body", "pressure [Pa]", "friction [-]", "regime", *(f"{name} [{'Hz' if name == 'main_frequency' else '-'}]" for name in NUMBERS)]
    write_csv(folder, "pin.csv", columns, [[name, float(p), float(mu), one["regime"][i, j], *(float(one[key][i, j]) for key in NUMBERS)]
                                           for name, one in maps.items() for i, p in enumerate(one.axes["pressure"]) for j, mu in enumerate(one.axes["friction"])])
    write_page(folder, "pin.md", PAGE.format(summary=summary, n=n, seeds=len(seeds), end=1e3 * end, comparison=comparison, runs=len(maps) * n, maps=len(maps), reached=reached))
