"""Modes of steady sliding of the paper's pin that grow: on three grids, over the friction coefficient and the stiffness of the contact, and
in transient runs. Writes a page.

    complex_modes.py <folder with the programs> <folder for runs> <folder of the page>

Runs that are there are not repeated."""

import csv
import itertools
import json
import os
import re
import subprocess
import sys

from mode_participation import BLACK, COLOURS, above_all, lettered
from mode_participation import picture as picture_of_runs
from pages import plt, save_picture, table, write_page

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", ".."))
EXAMPLE = os.path.join(TOP, "prm", "examples", "complex_modes.prm")
GRIDS = {"0.8": "70, 20", "0.4": "140, 40", "0.2": "280, 80"}  # mm: cells
COEFFICIENTS = [round(0.02 * k, 2) for k in range(16)]
STIFFNESSES = [f"{10 ** (16 - 0.125 * k):.3e}" for k in range(29)]  # Pa/m
SWEEP = {"Body/Cells": GRIDS["0.8"], "Complex modes/Fastest decay": 6000, "Complex modes/Sweep": "friction coefficient",
         "Complex modes/Sweep values": ", ".join(map(str, COEFFICIENTS))}
SOFTER = {**SWEEP, "Flat/Normal stiffness": 1e16, "Complex modes/Sweep": "normal stiffness", "Complex modes/Sweep values": ", ".join(STIFFNESSES)}


def run(programs, folder, name, settings):
    """The folder of a finished run."""
    output = os.path.join(folder, name)
    if not os.path.exists(os.path.join(output, "summary.json")):
        subprocess.run([os.path.join(programs, "contact_dynamics"), EXAMPLE, "--output", output, "--quiet",
                        *(f"--set={key}={value}" for key, value in settings.items())], check=True)
    return output


def summary(folder):
    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        return json.load(file)


def rows_of(grids):
    """A row a mode, the fastest growing of the finest grid first; modes of other grids within 1 %, each once."""
    finest, *coarser = [list(entry["complex_modes"]) for entry in reversed(grids)]
    rows = []
    for mode in finest:
        row = [(mode["frequency"], mode["growth_rate"])]
        for others in coarser:
            others.sort(key=lambda other: abs(other["frequency"] / mode["frequency"] - 1))
            near = bool(others) and abs(others[0]["frequency"] / mode["frequency"] - 1) < 0.01
            row.append((lambda other: (other["frequency"], other["growth_rate"]))(others.pop(0)) if near else None)
        rows.append(row[::-1])
    return rows


def curves(folder, swept="friction_coefficient [-]"):
    """{curve: [(what was swept, kHz, 1/s)]}"""
    result = {}
    with open(os.path.join(folder, "complex_modes_sweep.csv"), encoding="ascii") as file:
        for row in csv.DictReader(file):
            result.setdefault(int(float(row["curve [-]"])), []).append(
                (float(row[swept]), 1e-3 * float(row["frequency [Hz]"]), float(row["growth_rate [1/s]"])))
    return result


def picture(found, folder, name="sweep.png", label="friction coefficient", scale="linear"):
    figure, axes = plt.subplots(2, 1, figsize=(6.4, 7.2), sharex=True)
    styles = itertools.product(("-", (0, (3, 1.5))), COLOURS)
    for points in sorted(found.values(), key=lambda curve: curve[-1][1]):
        values, frequency, growth = zip(*points)
        grows = max(growth) > 0
        dashes, colour = next(styles) if grows else ("-", "0.75")
        style = {"color": colour, "ls": dashes, "lw": 1.6 if grows else 0.8, "marker": "." if len(values) > 1 else "_", "ms": 3,
                 "zorder": 3 if grows else 2}
        axes[0].plot(values, frequency, **style, label=f"{frequency[-1]:.1f} kHz" if grows else None)
        axes[1].plot(values, [1e-3 * g for g in growth], **style)
    axes[0].set(ylabel="frequency (kHz)")
    axes[1].set(xlabel=label, ylabel="growth rate (1/ms)", xscale=scale)
    axes[1].axhline(0, color=BLACK, lw=0.8)
    lettered(axes)
    above_all(figure, axes[0].get_legend_handles_labels()[0], 4)
    return save_picture(figure, folder, name, 128, dpi=110)


def page(programs, runs, folder):
    grids = [summary(run(programs, runs, f"h{h}", {"Body/Cells": cells})) for h, cells in GRIDS.items()]
    swept = run(programs, runs, "sweep", SWEEP)
    found = curves(swept)
    name = picture(found, folder)
    softer = run(programs, runs, "softer", SOFTER)
    of_stiffness = curves(softer, "normal_stiffness [Pa/m]")
    _, fastest, at_stiffness = max((growth, 1e-3 * growth, k) for curve in of_stiffness.values() for k, _, growth in curve)
    name_of_softer = picture(of_stiffness, folder, "stiffness.png", "stiffness of the contact (Pa/m)", "log")
    # Enough modes that decay for what the start leaves.
    decaying = run(programs, runs, "decaying", {"Body/Cells": GRIDS["0.8"], "Complex modes/Fastest decay": 3000})
    picked, facts = picture_of_runs(programs, runs, decaying, GRIDS["0.8"], folder)
    rows = [[cell for pair in row for cell in ((f"{1e-3 * pair[0]:.3f}", f"{pair[1]:.0f}") if pair else ("-", "-"))] for row in rows_of(grids)]
    headings = [f"{what}, {h} mm" for h in GRIDS for what in ("kHz", "1/s")]
    separated = ", ".join(f"{entry['separated_nodes']} on {h} mm" for h, entry in zip(GRIDS, grids))
    missing = sum(entry["missing_modes"] for entry in grids)
    missing += sum(case["missing_modes"] for one in (swept, softer) for case in summary(one)["sweep"])
    text = [
        "# Modes of steady sliding that grow", "",
        "This page shows which vibrations of the paper's pin grow in steady sliding, what changes their growth, and which of them a transient",
        "run shows. For other bodies start from [complex_modes.prm](../../prm/examples/complex_modes.prm) and the",
        "[guide to squeal](../guide/squeal.md).", "",
        "The modes come from `Analysis = complex modes` of `contact_dynamics` ([theory](../theory.md), section 11), up to 200 kHz, with the",
        "stiffness of the paper's eq. (10), mu = 0.25, delta = 1500 ns, beta = 4.4 ns and a platen.",
        "`applications/tools/studies/complex_modes.py` writes this page.", "",
        "## On three grids", "",
        "Frequencies (kHz) and growth rates (1/s) of the growing modes, by size of the cells:", "",
        table(headings, rows), "",
        f"The argument principle finds {missing or 'no'} missing modes in the runs of this page. Contact nodes that are separated in the static",
        f"state are free: {separated}. Growth rates need not converge smoothly if this number changes with the grid.", "",
        "## Over the friction coefficient", "",
        f"![Frequency and growth rate of modes over the friction coefficient]({name})", "",
        "Cells of 0.8 mm, modes that grow or decay by at most 6000 1/s. Coloured: growth at some coefficient (legend: last frequency); grey: at",
        "none. A curve ends where its mode decays faster, or meets another mode and changes its shape by more than half.", "",
        "## Over the stiffness of the contact", "",
        f"![Frequency and growth rate of modes over the stiffness of the contact]({name_of_softer})", "",
        "The same pin with springs between pin and flat (`Flat/Normal stiffness`), which stand for the asperities of rough surfaces. 5 MPa",
        "compress them by 5 nm at 1e15 Pa/m and by 0.5 micrometres at 1e13 Pa/m.",
        f"The largest growth rate is {fastest:.1f} 1/ms, at {at_stiffness:.2g} Pa/m.", ""]
    text += participation_text(picked, facts)
    paragraphs = re.sub(r"(?<=[^\n|])\n(?=[^\n|#!])", " ", "\n".join(text))
    write_page(folder, "README.md", paragraphs.rstrip() + "\n")


def participation_text(name, facts):
    change, growth, *_ = facts["smooth"]
    ends = {start: " and ".join(f"{1e6 * size:.1f} µm at {1e-3 * f:.1f} kHz" for f, size in largest)
            for start, (_, _, largest, _) in facts.items()}
    shares = {start: f"{100 * share:.0f} %" for start, (*_, share) in facts.items()}
    return [
        "## Which of them a run picks", "",
        f"![Amplitudes of modes in the snapshots of two runs]({name})", "",
        "Amplitudes of modes in two transient runs on cells of 0.8 mm: modes that grow (coloured) and modes that decay by at most 3000 1/s",
        "(grey), fitted to the snapshots by least squares in windows of 0.1 ms (`mesoslip.participation`). Below: share of the squared motion",
        "that the fit explains. Dotted: the first node sticks or separates after the smooth start.", "",
        f"* **Smooth start.** All nodes slide until {1e3 * change:.2f} ms. Until then each mode grows or decays at its own rate, the fastest at",
        f"{growth:.0f} 1/s, and the fastest mode prevails, whatever its first amplitude. Once nodes separate, modes are coupled.",
        f"In the last millisecond the fit finds {ends['smooth']}; all modes together explain {shares['smooth']}.", "",
        "* **Pressure at once.** The pin is thrown off the flat, mostly in the mode of 41.7 kHz. The run ends with",
        f"{ends['at-once']} ({shares['at-once']}).", ""]


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    page(*sys.argv[1:])
