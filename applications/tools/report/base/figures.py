"""Figures over time, frequency and contact position. Every function takes runs and returns a figure,
or raises Missing. Colours are those of Okabe and Ito, distinct for the colour-blind. Colours and settings
are also those of all pictures in doc/."""

import re

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patheffects import Normal, Stroke

from report.base.data import Missing, thinned

BLUE, ORANGE, GREEN, PINK, SKY, YELLOW, BLACK, GREY, VIOLET, BROWN = (
    "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#000000", "#6b7280", "#7b3294", "#8c510a")
RUN_COLOURS = [BLUE, ORANGE, GREEN, PINK, YELLOW, SKY]
SLIP, STICK, SEPARATED = "#0072B2", "#E69F00", "#e9ecef"
DASHES = ["-", (0, (3, 1.5)), (0, (1, 1)), (0, (5, 1.5, 1, 1.5))]
FRAME = "#D55E00"  # of what another panel shows enlarged
WIDTH = 6.4  # in

plt.rcParams.update({
    "font.size": 11.5, "font.family": "DejaVu Sans", "axes.titlesize": 11.5,
    "axes.labelsize": 11.5, "legend.fontsize": 10, "xtick.labelsize": 10.5, "ytick.labelsize": 10.5,
    "axes.grid": True, "grid.color": "#e3e7eb", "grid.linewidth": 0.8, "axes.axisbelow": True,
    "axes.spines.top": False, "axes.spines.right": False, "legend.frameon": False,
    "lines.linewidth": 1.3, "figure.constrained_layout.use": True, "figure.dpi": 110})


def panels(rows=1, height=3.2, **options):
    figure, axes = plt.subplots(rows, 1, figsize=(WIDTH, height), squeeze=False, **options)
    return figure, axes[:, 0]


def lettered(axes):
    """Panel letters before the titles of axes, for captions to refer to."""
    for letter, axis in zip("abcdefghijkl", axes):
        axis.set_title(f"({letter}) {axis.get_title(loc='left')}".rstrip(), loc="left")


def colour(runs, run):
    return RUN_COLOURS[runs.index(run) % len(RUN_COLOURS)]


def style(runs, run):
    """Colour, width and dashes: the first run wide, later ones dashed above it, so that equal curves are all seen."""
    k = runs.index(run)
    return {"color": colour(runs, run), "lw": 2.6 if k == 0 and len(runs) > 1 else 1.5, "ls": DASHES[k % len(DASHES)]}


def scaled(*arrays, units):
    """Common factor and unit that bring arrays to readable numbers; units: (factor, name) ascending."""
    top = max((np.nanmax(np.abs(array)) for array in arrays if np.size(array)), default=0.0)
    chosen = units[0]
    for factor, name in units:
        if top >= factor:
            chosen = (factor, name)
    return chosen


LENGTHS = [(1e-9, "nm"), (1e-6, "µm"), (1e-3, "mm")]
STRESSES = [(1.0, "Pa"), (1e3, "kPa"), (1e6, "MPa"), (1e9, "GPa")]


def zoom_window(run, end):
    """s; the last six periods, or the last 15 % of the time."""
    frequency = run.number("main_frequency")
    start = end - 6.0 / frequency if frequency else 0.85 * end
    return max(0.0, start) if start < end else 0.85 * end


def legend_columns(entries, most, width=WIDTH):
    """How many columns of a legend `width` (in) has room for, by its longest entry; a formula counts as its letters."""
    longest = max((len(re.sub(r"\$|\\math\w+|[{}_\\]", "", entry.get_label())) for entry in entries), default=1)
    return int(np.clip(width / (0.55 + 0.082 * longest), 1, most))


def above(axes, entries=None, columns=3, title=None):
    """Legend outside, above the axes, so that it never covers data; with a title, that of the run."""
    entries = entries or axes.get_legend_handles_labels()[0]
    if entries:
        axes.legend(handles=entries, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncol=legend_columns(entries, columns), borderaxespad=0.2,
                    handlelength=1.6, columnspacing=1.3, title=title, title_fontsize=11.5, alignment="left")


def above_all(figure, entries, columns=3, title=None):
    """Legend of `entries` above all panels of a figure; one above an axes would widen its column."""
    columns = legend_columns(entries, columns, figure.get_figwidth())
    lines = -(-len(entries) // columns) + (1 if title else 0)
    height = (lines * 0.24 + 0.1) / figure.get_figheight()
    figure.legend(handles=entries, loc="upper left", ncol=columns, handlelength=1.6, columnspacing=1.3, title=title, title_fontsize=11.5,
                  alignment="left")
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - height))


def apparent_friction(runs, paper_value=None):
    figure, (whole, zoom) = panels(2, 5.2)
    series = [(run, run.get("/history/time"), run.get("/history/apparent_friction")) for run in runs]
    series = [(run, time, friction) for run, time, friction in series
              if time is not None and friction is not None and len(time)]
    if not series:
        raise Missing("/history/apparent_friction is in none of the dynamics files")
    end = min(time[-1] for _, time, _ in series)  # of the shortest run
    for run, time, friction in series:
        c, mean = colour(runs, run), run.number("mean_apparent_friction_coefficient")
        x, y = thinned(time, friction)
        whole.plot(1e3 * x, y, color=c, lw=1.6 if run is series[0][0] and len(series) > 1 else 0.6, alpha=0.75,
                   label=run.label + (f", mean {mean:.3f}" if mean is not None else ""))
        if mean is not None:
            looks = {"color": c, "lw": 1.6, "ls": (3 * runs.index(run), (2.5, 3.5)), "zorder": 4}  # dashes of two runs in turn
            whole.plot([1e3 * run.steady_from(), 1e3 * time[-1]], [mean, mean], path_effects=[Stroke(linewidth=3, foreground="white"), Normal()],
                       **looks)
            zoom.axhline(mean, **looks)
        begin, stop = np.searchsorted(time, [zoom_window(run, end), np.nextafter(end, np.inf)])
        x, y = thinned(time[begin:stop], friction[begin:stop])
        zoom.plot(1e3 * x, y, color=c, lw=1.3, label=run.label)  # dashes are means
    if any(run.number("mean_apparent_friction_coefficient") is not None for run, *_ in series):
        whole.plot([], [], color=GREY, lw=1.6, ls=(0, (2.5, 3.5)), label="mean over the steady part")
    for axes in (whole, zoom):
        if paper_value is not None:
            axes.axhline(paper_value, color=BLACK, lw=1.2, ls="--", label="mean in the paper")
        axes.set_ylabel(r"$\mu_\mathrm{app}$")
        axes.margins(x=0)
    zoom.set_xlabel("time (ms)")
    differ = any(time[-1] > 1.001 * end for _, time, _ in series)
    zoom.set_title(f"last periods{' of the shortest run' if differ else ''}", loc="left", color=GREY)
    above(whole, columns=2)
    for line in whole.get_legend().get_lines():
        line.set(alpha=1, linewidth=max(line.get_linewidth(), 1.4))
    return figure


def rescaled(x, y, fx, fy):
    return x * fx, y * fy


def phase_diagram(runs):
    series = [(run, run.get("/phase_diagram/displacement"), run.get("/phase_diagram/velocity"))
              for run in runs]
    series = [entry for entry in series if entry[1] is not None and entry[2] is not None
              and len(entry[1]) > 2]
    if not series:
        raise Missing("/phase_diagram is in none of the dynamics files (no periodic motion found)")
    figure, (axes,) = panels(1, 4.4)
    factor, unit = scaled(*[u for _, u, _ in series], units=LENGTHS)
    for run, u, v in series:
        probe = run.reference_probe()
        if probe and len(series) == 1:
            _orbit(axes, run, probe, factor)
        axes.plot(np.append(u, u[0]) / factor, np.append(v, v[0]), **style(runs, run), label=run.label)
    axes.set(xlabel=f"tangential displacement ({unit})", ylabel="tangential velocity (m/s)")
    above(axes)
    return figure


def _orbit(axes, run, probe, factor):
    time, u, v = (run.get(f"/probes/{probe}/{name}") for name in ("time", "displacement", "velocity"))
    if time is None or u is None or v is None or u.ndim != 2 or len(u) != len(v):
        return
    steady = np.flatnonzero(time >= run.steady_from())
    step = max(1, len(steady) // 40000)
    axes.plot(u[steady[::step], 0] / factor, v[steady[::step], 0], color="#b9c2cb", lw=0.4,
              label="all periods")


def spectrum(runs, paper_frequency=None):
    series = [(run, run.get("/spectrum/frequency"), run.get("/spectrum/amplitude")) for run in runs]
    series = [entry for entry in series if entry[1] is not None and entry[2] is not None
              and len(entry[1]) > 2]
    if not series:
        raise Missing("/spectrum is in none of the dynamics files")
    figure, (axes,) = panels(1, 3.6)
    factor, unit = scaled(*[a for *_, a in series], units=LENGTHS)
    main, top = 4e4, 0.0
    for run, f, a in series:
        shown = (f > 1e3) & (a > 0)
        top = max(top, np.max(a[shown], initial=0.0))
        main = run.number("main_frequency") or main
        looks = {"lw": 2.2, "alpha": 0.6} if run is series[0][0] and len(series) > 1 else {"lw": 1.0}
        axes.semilogy(*rescaled(*thinned(f[shown], a[shown], 6000), 1e-3, 1 / factor),
                      color=colour(runs, run), label=run.label, **looks)
    if paper_frequency:
        axes.axvline(1e-3 * paper_frequency, color=BLACK, lw=1.1, ls="--",
                     label=f"paper: {1e-3 * paper_frequency:.1f} kHz")
    axes.set_xlim(0, 1e-3 * min(13 * main, max(f[-1] for _, f, _ in series)))
    if top > 0:
        axes.set_ylim(1e-5 * top / factor, 3 * top / factor)
    axes.set(xlabel="frequency (kHz)", ylabel=f"amplitude ({unit})")
    above(axes)
    return figure


def shown_components(n):
    """Numbers and names of n stress components, 3 of a plane body or 6, that along the normal of the flat first."""
    names = ("xx", "yy", "xy") if n == 3 else ("xx", "yy", "zz", "yz", "xz", "xy")
    order = (1, 0, 2) if n == 3 else (2, 0, 1, 3, 4, 5)
    return [(component, names[component]) for component in order]


def localized_stress(run, probe):
    """The stress components over the last periods: localized, and direct where there is one."""
    time, stress = run.need(f"/probes/{probe}/time", f"/probes/{probe}/stress")
    if stress.ndim != 2 or stress.shape[1] not in (3, 6) or len(stress) != len(time):
        raise Missing(f"/probes/{probe}/stress of {run.name} has an unexpected shape")
    direct = run.get(f"/probes/{probe}/direct_stress")
    direct = direct if direct is not None and direct.shape == stress.shape else None
    shown = time >= max(time[0], zoom_window(run, time[-1]))
    factor, unit = scaled(stress[shown], units=STRESSES)
    components = shown_components(stress.shape[1])
    figure, axes = panels(len(components), 2.0 * len(components), sharex=True)
    for axis, (component, name) in zip(axes, components):
        if direct is not None:
            axis.plot(1e3 * time[shown], direct[shown, component] / factor, color=BLACK, lw=2.6,
                      alpha=0.35, label="direct (heterogeneous run)")
        axis.plot(1e3 * time[shown], stress[shown, component] / factor, color=ORANGE, lw=1.3,
                  label="localized (homogeneous run)")
        axis.set_ylabel(rf"$\sigma_\mathrm{{{name}}}$ ({unit})")
        axis.margins(x=0)
    axes[-1].set_xlabel("time (ms)")
    figure.align_ylabels()
    above(axes[0], columns=2)
    return figure
