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


def bodies(rows):
    """Rows of table 1: plane strain, thicknesses, plane stress; several starts as a span."""
    thicknesses = sorted({float(r["thickness [mm]"]) for r in of(rows, "free faces", 1, 0.5)}, reverse=True)
    named = [("plane strain", "plane strain", None), *((f"{t:g} mm", "free faces", t) for t in thicknesses), ("plane stress", "plane stress", None)]
    lines = []
    for name, body, thickness in named:
        fine, high, low = (of(rows, body, cells, load, thickness=thickness) if thickness else of(rows, body, cells, load) for cells, load in ((0.5, 0.5), (1, 0.5), (1, 0.4)))
        lines.append([name, *([span(fine), span(fine, "main frequency [kHz]", 2)] if fine else ["-", "-"]), span(high), span(low)])
    return lines


def widest(rows):
    return f"{max(float(r['half width [-]']) for r in rows):.4f}"


def text(folder):
    rows = read(folder, "runs.csv")
    strain, stress = of(rows, "plane strain", 0.5, 0.5), of(rows, "plane stress", 0.5, 0.5)
    free = of(rows, "free faces", 0.5, 0.5)
    largest = max(abs(float(r["mu_inter [-]"]) - mean(strain)) for r in free)
    frequency = max(abs(float(r["main frequency [kHz]"]) / mean(strain, "main frequency [kHz]") - 1) for r in free)
    both = [(mean(of(rows, "free faces", 1, 0.5, 0.5, float(r["thickness [mm]"]))) - float(r["mu_inter [-]"])) for r in free]
    hard = [r for r in of(rows, "free faces", 1, 0.5, 0.55) + of(rows, "plane stress", 1, 0.5, 0.55) if float(r["separated [-]"]) > 0.5]
    thin = [float(r["thickness [mm]"]) for r in hard if r["thickness [mm]"]]
    if len(thin) == len(hard) or any(float(r["thickness [mm]"]) <= max(thin) for r in of(rows, "free faces", 1, 0.5, 0.55) if r not in hard):
        raise RuntimeError("it is not the thin pins and plane stress that come to regime 2; the text of this page says so")
    straight = of(rows, "plane strain", 1, 0.5, 0.55)
    return "\n\n".join([
        "# The pin as a body of finite thickness",
        "**Within a regime, plane strain gives mu_inter and the main frequency at 0.5 MPa. It does not give the border between the regimes.**\n"
        "\n"
        f"* At 0.5 MPa, on cells of 0.5 mm, pins of 0.5 to 8 mm differ from plane strain (mu_inter {mean(strain):.4f}) "
        f"by at most {largest:.4f} in mu_inter and {100 * frequency:.1f} % in the main frequency; plane stress "
        f"has {mean(stress):.4f}.\n"
        "* In plane strain the border lies at a start of 0.56 m/s. Pushed at 0.55 m/s, on cells of 1 mm, plane strain is in regime 1 (mu_inter "
        f"{span(straight)}); plane stress and all pins up to {max(thin):g} mm are separated most of the time (mu_inter {span(hard)}).\n"
        + "\n".join("* " + verdict for verdict in [fibres_page.fibre_verdict(read(folder, "fibres.csv")), *fibres_page.fine_verdict(folder), fibres_page.modes_verdict(folder)]),
        "![mu_inter over the thickness, and the mean contact pressure across it](thickness/thickness.png)",
        "*(a) Cells of 1 mm; lines: start of 0.5 m/s. Blue triangles at 0.186: regime 2, at 39.5 kHz, as in all pins at 0.4 MPa. (b) 0.5 MPa, cells of 0.5 mm: mean over x "
        "and over 1 ms.*",
        "## From plane strain to plane stress",
        "Table 1. Cells of 0.5 mm: push of 0.5 m/s. Cells of 1 mm: smallest to largest of the pushes 0.45, 0.5 and 0.55 m/s. Values near 0.186 at 0.5 MPa are of regime 2. The half width of the mean in time is at most "
        f"{widest([r for r in rows if float(r['P [MPa]']) == 0.5])} at 0.5 MPa and {widest([r for r in rows if float(r['P [MPa]']) == 0.4])} at 0.4 MPa.",
        table(["body", "mu_inter, 0.5 MPa, 0.5 mm", "kHz", "mu_inter, 0.5 MPa, 1 mm", "mu_inter, 0.4 MPa, 1 mm"], bodies(rows), right=True),
        *fibres_page.fibres(folder),
        *fibres_page.modes(folder),
        "## How it was obtained",
        "`./run.sh thickness` makes this page from the files of [prm/thickness](../../prm/thickness). The body is the homogeneous pin of eq. (10), "
        "56 x 16 mm, with free faces, under a rigid platen that also holds its top across the plane. One half is computed, with symmetry about the middle plane. Statistics "
        "are from 1 to 2 ms. Tables: [runs](thickness/runs.csv), [profile](thickness/profile.csv) of the contact pressure, [fibres](thickness/fibres.csv)"
        + (", [fibres of 0.1 mm](thickness/fine.csv) (`./run.sh thickness fine`)" if fibres_page.has_fine(folder) else "") + ", [modes](thickness/modes.csv), [cost](thickness/cost.csv), one layer of bricks "
        "beside the plane grid ([layer](thickness/layer.csv), [means](thickness/layer_means.csv)).",
        "Both phases have Poisson's ratio 0.2, so that three entries of the stiffness across the plane follow from the entries in the plane. The two shear moduli are computed for bars "
        "through the thickness ([moduli](thickness/moduli.csv)).",
        "## Limits",
        "* Differences within the spread over the starts mean nothing.\n"
        f"* Two sizes of cells show no order of convergence. Cells of 1 mm change mu_inter by {min(map(abs, both)):.4f} to {max(map(abs, both)):.4f}. Border and 0.4 MPa: cells of 1 mm only.\n"
        "* Fibres: one seed and one size of cells; for 0.1 mm also one start.\n"
        "* Low-order bricks lock where a cell is much longer than thick: the thinnest pins of table 3 are too stiff.\n"
        "* Not computed: " + ("" if fibres_page.has_fine(folder) else "fibres of 0.1 mm in 3D (`./run.sh thickness fine` runs them), ")
        + "growth in 3D, stress across the plane."]) + "\n"


def write(doc):
    folder = os.path.join(doc, "thickness")
    picture(folder, read(folder, "runs.csv"), read(folder, "profile.csv"))
    write_page(doc, "thickness.md", text(folder))
