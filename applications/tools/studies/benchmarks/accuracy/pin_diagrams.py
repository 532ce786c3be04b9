"""Diagrams of the pin study."""

import numpy as np

from plots import BLACK, COLOURS, GREY, MARKERS, curve, legend, logarithmic, panels, shared_legend

TITLES = {"mu_inter": r"$\mu_\mathrm{inter}$", "frequency_Hz": "main frequency", "slip_share": "slip share"}


def curves(rows):
    """(label, rows) of the homogeneous pin: by cells, and by time step at two cell sizes, and by beta2."""
    plain = [row for row in rows if row["name"] == f"homogeneous-h{row['h_mm']:g}"]
    found = [(r"h = 0.4 to 0.05 mm, $\beta_2$ = 0.5", plain)]
    for h in (0.4, 0.2, 0.1):
        own = [row for row in rows if row["h_mm"] == h and row["name"] == f"homogeneous-h{h:g}-dt{row['share']:g}"]
        if own:
            found.append((rf"h = {h:g} mm, smaller $\Delta t$", [r for r in plain if r["h_mm"] == h] + own))
    for beta2 in (0.6, 1.0):
        own = [row for row in rows if row["beta2"] == beta2]
        found.append((rf"h = 0.4, 0.2 mm, $\beta_2$ = {beta2:g}", own))
    return [(label, own) for label, own in found if own]


def errors(bench, rows):
    """Errors of the three quantities over CPU seconds, with the scatter of blocks of time."""
    figure, axes = panels(3, width=12.6)
    for panel, (quantity, title) in zip(axes, TITLES.items()):
        logarithmic(panel, "CPU seconds (program, 3 ms)", "error (%)", title)
        smallest = min(100 * abs(row[quantity + "_error"]) for row in rows if row["material"] == "homogeneous")
        floor = max(3e-3, 0.5 * smallest)
        for k, (label, own) in enumerate(curves(rows)):
            error = np.array([100 * abs(row[quantity + "_error"]) for row in own])
            scatter = np.array([100 * row[quantity + "_95"] / row[quantity] for row in own])
            curve(panel, k, [row["cpu_s"] for row in own], np.maximum(error, floor), label,
                  (np.maximum(error - scatter, floor), error + scatter))
    shared_legend(figure, axes[0], 3)
    bench.draw("pin", figure)


def history(bench, found):
    """mu_inter in blocks of 50 microseconds from the start."""
    names = {"homogeneous-h0.4": "homogeneous, h = 0.4 mm", "homogeneous-h0.2": "0.2 mm", "homogeneous-h0.1": "0.1 mm",
             "homogeneous-h0.05": "0.05 mm", "homogeneous-h0.2-b1": r"0.2 mm, $\beta_2$ = 1",
             "homogeneous-h0.2-beta": r"0.2 mm, $\beta_2$ = 0.5, $\beta$ + $\Delta t$/2",
             "homogeneous-h0.2-ramp100": r"0.2 mm, pressure grows in 100 $\mu$s",
             "heterogeneous-h0.1-seed1": "heterogeneous, 0.1 mm"}
    figure, (axes,) = panels(1, width=9, height=5)
    for k, (name, label) in enumerate(names.items()):
        if name in found:
            time, mu = found[name]
            axes.plot(time, mu, color=COLOURS[k % len(COLOURS)], lw=1.4, label=label,
                      ls="--" if name.endswith("beta") or k >= len(COLOURS) else "-")
    axes.axvspan(2, 3, color=GREY, alpha=0.12, lw=0, label="evaluated")
    axes.set(xlabel="time (ms)", ylabel=r"$\mu_\mathrm{inter}$ in blocks of 50 $\mu$s")
    axes.margins(x=0)
    axes.set_ylim(bottom=0.17)
    legend(axes, 3)
    bench.draw("pin-history", figure)


def homogenization(bench, rows):
    """The three quantities over CPU seconds, homogeneous and heterogeneous."""
    figure, axes = panels(3, width=12.6)
    plain = [row for row in rows if row["name"] == f"homogeneous-h{row['h_mm']:g}"]
    direct = [row for row in rows if row["material"] == "heterogeneous"]
    for panel, (quantity, title) in zip(axes, TITLES.items()):
        scale, unit = (1e-3, " (kHz)") if quantity == "frequency_Hz" else (1.0, "")
        panel.set(xscale="log", xlabel="CPU seconds (program, 3 ms)", ylabel=title + unit)
        panel.margins(x=0.25)
        draw_values(panel, plain, quantity, scale, 0, "homogeneous, h in mm as written", "{h_mm:g}", below=True)
        draw_values(panel, direct, quantity, scale, 1, "heterogeneous, h = 0.1 mm", "seed {seed:g}")
        values = [scale * row[quantity] for row in direct]
        mean, spread = np.mean(values), np.std(values, ddof=1)
        panel.axhspan(mean - spread, mean + spread, color=COLOURS[1], alpha=0.15, lw=0,
                      label="their mean and standard deviation")
        panel.axhline(mean, color=COLOURS[1], lw=0.8)
    shared_legend(figure, axes[0], 3)
    bench.draw("pin-homogenization", figure)


def draw_values(panel, rows, quantity, scale, index, label, note, below=False):
    """Each point with a note, beside it or below its error bar."""
    panel.errorbar([row["cpu_s"] for row in rows], [scale * row[quantity] for row in rows],
                   yerr=[scale * row[quantity + "_95"] for row in rows], color=COLOURS[index], marker=MARKERS[index],
                   ls="", capsize=2.5, label=label)
    place = {"xytext": (0, -4), "ha": "center", "va": "top"} if below else {"xytext": (7, 4)}
    for row in rows:
        y = row[quantity] - (row[quantity + "_95"] if below else 0)
        panel.annotate(note.format(**row), (row["cpu_s"], scale * y), textcoords="offset points", fontsize=9, color=BLACK, **place)
