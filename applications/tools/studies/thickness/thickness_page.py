"""The page doc/paper/thickness.md and its picture, from the tables in doc/paper/thickness alone."""

import os
import sys

from matplotlib.lines import Line2D

import fibres_page
from fibres_page import read
from pages import save_picture, table, write_page

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
from report.base.figures import BLUE, GREEN, GREY, ORANGE, WIDTH, above, plt  # noqa: E402


def of(rows, body, cells, load, start=None, thickness=None):
    return [r for r in rows if r["body"] == body and float(r["cells [mm]"]) == cells and float(r["P [MPa]"]) == load
            and (start is None or float(r["start [m/s]"]) == start) and (thickness is None or float(r["thickness [mm]"]) == thickness)]


def mean(rows, column="mu_inter [-]"):
    values = [float(r[column]) for r in rows]
    return sum(values) / len(values)


def span(rows, column="mu_inter [-]", digits=3):
    values = [float(r[column]) for r in rows]
    low, high = f"{min(values):.{digits}f}", f"{max(values):.{digits}f}"
    return low if low == high else f"{low} to {high}"


MARKS = {0.45: "o", 0.5: "s", 0.55: "^"}  # of the starts


def picture(folder, rows, profiles):
    figure, (left, right) = plt.subplots(2, 1, figsize=(WIDTH, 6.8))
    for load, colour in ((0.5, BLUE), (0.4, ORANGE)):
        free = of(rows, "free faces", 1, load)
        for start, mark in MARKS.items():
            shown = [r for r in free if float(r["start [m/s]"]) == start]
            left.semilogx([float(r["thickness [mm]"]) for r in shown], [float(r["mu_inter [-]"]) for r in shown], mark, ms=5, color=colour, base=2)
        for body, dash in (("plane strain", "-"), ("plane stress", "--")):
            left.axhline(mean(of(rows, body, 1, load, 0.5)), color=colour, ls=dash, lw=1.2)
    left.set(xlabel="thickness (mm)", ylabel=r"$\mu_\mathrm{inter}$")
    ticks = sorted({float(r["thickness [mm]"]) for r in of(rows, "free faces", 1, 0.5)})
    left.set_xticks(ticks, [f"{t:g}" for t in ticks])
    lines = [Line2D([], [], color=GREY, ls=dash, lw=1.2, label=body) for body, dash in (("plane strain", "-"), ("plane stress", "--"))]
    loads = [Line2D([], [], color=colour, lw=4, label=f"{load:g} MPa") for load, colour in ((0.5, BLUE), (0.4, ORANGE))]
    starts = [Line2D([], [], color=GREY, ls="", marker=mark, ms=5, label=f"start {start:g} m/s") for start, mark in MARKS.items()]
    above(left, [*loads, *lines, *starts], 4)
    for thickness, colour in zip(sorted({float(r["thickness [mm]"]) for r in profiles}), (BLUE, ORANGE, GREEN)):
        line = [r for r in profiles if float(r["thickness [mm]"]) == thickness]
        (_, at, value) = line[0].keys()
        right.plot([float(r[at]) for r in line], [float(r[value]) for r in line], "-o", ms=4, color=colour, label=f"{thickness:g} mm thick")
    right.axhline(1, color=GREY, lw=0.8)
    right.set(xlabel="distance from the middle plane / half thickness", ylabel="mean pressure / P")
    above(right)
    for letter, axis in zip("ab", (left, right)):
        axis.text(0.99, 0.96 if letter == "b" else 0.5, f"({letter})", transform=axis.transAxes, ha="right", va="top")
    return save_picture(figure, folder, "thickness.png", colours=96)


def bodies(rows, cells, load):
    """Rows of a table: bounds and thicknesses; several starts as a span."""
    named = [("plane strain", of(rows, "plane strain", cells, load))]
    free = of(rows, "free faces", cells, load)
    named += [(f"{t:g} mm", [r for r in free if float(r["thickness [mm]"]) == t]) for t in sorted({float(r["thickness [mm]"]) for r in free}, reverse=True)]
    named.append(("plane stress", of(rows, "plane stress", cells, load)))
    return [[f"{load:g}", name, span(r), f"{max(float(q['half width [-]']) for q in r):.4f}", span(r, "main frequency [kHz]", 2),
             *[span([{c: 100 * float(q[c])} for q in r], c, 0) for c in ("slip [-]", "stick [-]", "separated [-]")]] for name, r in named]


def text(folder):
    rows, layer, means, profiles = (read(folder, name) for name in ("runs.csv", "layer.csv", "layer_means.csv", "profile.csv"))
    until = [float(r["time [ms]"]) for r in layer if float(r["relative difference [-]"]) < 1e-9]
    heading = ["P [MPa]", "body", "mu_inter", "half width", "kHz", "slip [%]", "stick [%]", "separated [%]"]
    strain, stress = of(rows, "plane strain", 0.5, 0.5), of(rows, "plane stress", 0.5, 0.5)
    free = of(rows, "free faces", 0.5, 0.5)
    largest = max(abs(float(r["mu_inter [-]"]) - mean(strain)) for r in free)
    frequency = max(abs(float(r["main frequency [kHz]"]) / mean(strain, "main frequency [kHz]") - 1) for r in free)
    low = of(rows, "free faces", 1, 0.4)
    both = [(mean(of(rows, "free faces", 1, 0.5, 0.5, float(r["thickness [mm]"]))) - float(r["mu_inter [-]"])) for r in free]
    hard = [r for r in of(rows, "free faces", 1, 0.5, 0.55) + of(rows, "plane stress", 1, 0.5, 0.55) if float(r["separated [-]"]) > 0.5]
    names = ", ".join(f"{float(r['thickness [mm]']):g} mm" if r["thickness [mm]"] else r["body"] for r in hard)
    straight = of(rows, "plane strain", 1, 0.5, 0.55)
    edges = {}
    for r in profiles:
        edges.setdefault(f"{float(r['thickness [mm]']):g} mm", []).append(float(r["mean pressure over P [-]"]))
    cost = read(folder, "cost.csv")[0]
    moduli = [[r["entry"], f"{float(r['PBC [GPa]']):.3f}", f"{float(r['closed form [GPa]']):.3f}" if r["closed form [GPa]"] else "-"]
              for r in read(folder, "moduli.csv")]
    return "\n\n".join([
        "# The pin as a body of finite thickness",
        f"**Verdict.** At 0.5 MPa, on cells of 0.5 mm, mu_inter of pins of 0.5 to 8 mm differs from plane strain ({mean(strain):.4f}) by at most "
        f"{largest:.4f} and the main frequency by at most {100 * frequency:.1f} %; plane stress has {mean(stress):.4f}. Cells of 1 mm move mu_inter "
        f"of the same pins by {min(map(abs, both)):.4f} to {max(map(abs, both)):.4f}. At 0.4 MPa all thicknesses and starts together have mu_inter "
        f"{span(low)}, plane strain {span(of(rows, 'plane strain', 1, 0.4))}, on cells of 1 mm alone. "
        f"**Which regime a start falls to is another matter**: of 0.5 MPa pushed at 0.55 m/s, close to the border of the regimes in plane strain "
        f"(0.56 m/s), these are separated most of the time (mu_inter {span(hard)}): {names}; plane strain is in regime 1 ({span(straight)}). So plane strain "
        "holds for the numbers within a regime at 0.5 MPa, and not for the border between them, seen on cells of 1 mm alone.",
        fibres_page.fibre_verdict(read(folder, "fibres.csv")),
        *fibres_page.fine_verdict(folder),
        fibres_page.modes_verdict(folder),
        f"Written by `./run.sh thickness` from the files of [prm/thickness](../../prm/thickness): {cost['runs']} runs, {cost['processor time [s]']} s of "
        "processor time on one core with AVX-512, beside other work. Tables: [runs](thickness/runs.csv), [layer](thickness/layer.csv), "
        "[profile](thickness/profile.csv), [fibres](thickness/fibres.csv), [modes](thickness/modes.csv).",
        "The body is the homogeneous pin of eq. (10), 56 x 16 mm, with free faces, under a rigid platen that also holds its top across the plane; "
        "half of it is computed, its middle plane being one of symmetry, so that bending out of the plane is left out. P as named, pushed as in "
        "[paper](README.md), statistics from 1 to 2 ms.",
        "## One layer held across the plane",
        f"One layer of bricks of 0.5 mm between faces with u_y = 0 against the plane grid, both with steps of 75 ns. Node M moves alike to 1e-9 of its largest "
        f"displacement until {max(until) if until else 0:.1f} ms; at the end the two are {float(layer[-1]['relative difference [-]']):.1e} apart. mu_inter is "
        f"{float(means[0]['mu_inter [-]']):.5f} and {float(means[1]['mu_inter [-]']):.5f}, the main frequency {float(means[0]['main frequency [kHz]']):.3f} "
        f"and {float(means[1]['main frequency [kHz]']):.3f} kHz.",
        "## From plane strain to plane stress",
        "![mu_inter over the thickness, and the mean contact pressure across it](thickness/thickness.png)",
        "*(a) Cells of 1 mm; lines: start of 0.5 m/s. Blue triangles at 0.186 are runs that a start of 0.55 m/s brings into the other limit "
        "cycle, at 39.5 kHz, in which the pin under 0.4 MPa is as well. (b) 0.5 MPa, cells of 0.5 mm: mean over x and over 1 ms.*",
        "Cells of 0.5 mm, pushed at 0.5 m/s; the half width is that of the mean in time:", table(heading, bodies(rows, 0.5, 0.5), right=True),
        "Cells of 1 mm, pushed at 0.45, 0.5 and 0.55 m/s (smallest to largest of three runs, largest half width):",
        table(heading, bodies(rows, 1, 0.5) + bodies(rows, 1, 0.4), right=True),
        "The spread over the starts is the scatter within which a difference means nothing. Two sizes of cells show no order of convergence.",
        "Mean contact pressure over P, middle and free face: " + "; ".join(f"{k}: {v[0]:.3f} and {v[-1]:.3f}" for k, v in edges.items()) + ".",
        "## Stiffness across the plane",
        "Bars through the thickness, seed 1 of the paper's morphologies, one layer under PBC. Both phases have Poisson's ratio 0.2, so that three entries "
        "are known from those in the plane; the pin has them from eq. (10) with 10 % of fibres, and the two shear moduli as computed:",
        table(["entry", "PBC [GPa]", "closed form [GPa]"], moduli, right=True),
        *fibres_page.fibres(folder),
        *fibres_page.fine(folder),
        *fibres_page.modes(folder),
        "## Not done",
        ("Short bars of 0.1 mm" if fibres_page.fine(folder) else "Fibres of 0.1 mm in 3D (`./run.sh thickness fine` runs them)")
        + ", further seeds, growth in 3D, stress across the plane, runs of homogeneous pins with bending out of the plane."]) + "\n"


def write(doc):
    folder = os.path.join(doc, "thickness")
    picture(folder, read(folder, "runs.csv"), read(folder, "profile.csv"))
    write_page(doc, "thickness.md", text(folder))
