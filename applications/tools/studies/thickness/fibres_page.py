"""What the page says of pins with fibres and of modes, from the tables in doc/paper/thickness alone."""

import csv
import os

from pages import table

MU, HALF, MAIN = "mu_inter [-]", "half width [-]", "main frequency [kHz]"
STATES = ("slip [-]", "stick [-]", "separated [-]")


def read(folder, name):
    """Rows of a table as dictionaries."""
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def interval(values, digits):
    low, high = f"{min(values):.{digits}f}", f"{max(values):.{digits}f}"
    return low if low == high else f"{low} to {high}"


def chosen(rows, body, material, cells, load):
    found = [r for r in rows if (r["body"], r["material"], float(r["cells [mm]"]), float(r["P [MPa]"])) == (body, material, cells, load)]
    return sorted(found, key=lambda r: float(r["start [m/s]"]))


def values(rows, column, factor=1):
    return [factor * float(r[column]) for r in rows]


def differences(rows, body, cells, load):
    """Of mu_inter, heterogeneous minus homogeneous, start by start."""
    return [a - b for a, b in zip(*(values(chosen(rows, body, m, cells, load), MU) for m in ("heterogeneous", "homogeneous")))]


def fibre_table(rows, cells, load):
    lines = []
    for body in dict.fromkeys(r["body"] for r in rows):
        for material in ("heterogeneous", "homogeneous"):
            some = chosen(rows, body, material, cells, load)
            if some:
                lines.append([f"{load:g}", f"{cells:g}", f"{body}, {material}", interval(values(some, MU), 3), f"{max(values(some, HALF)):.4f}",
                              interval(differences(rows, body, cells, load), 3) if material == "heterogeneous" else "-",
                              interval(values(some, MAIN), 2), *[interval(values(some, c, 100), 0) for c in STATES]])
    return lines


def fibre_verdict(rows):
    said = []
    for load in (0.5, 0.4):
        said.append(f"at {load:g} MPa " + ", ".join(
            f"{interval(differences(rows, body, 0.5, load), 3)} ({name})"
            for body, name in (("plane strain", "plane strain"), ("long bars", "long bars in 2 mm"), ("short bars", "short bars in 2 mm"))))
    separated = {m: ", ".join(str(sum(v > 0.5 for v in values(chosen(rows, body, m, 0.5, 0.5), STATES[2]))) for body in dict.fromkeys(r["body"] for r in rows))
                 for m in ("heterogeneous", "homogeneous")}
    return ("**Fibres** 0.5 mm wide change mu_inter, heterogeneous minus homogeneous over three starts, " + "; ".join(said) + ". At 0.5 MPa a start may fall to "
            f"another regime with fibres than without: of three starts, in that order of bodies, {separated['heterogeneous']} are separated most of the time with "
            f"fibres, {separated['homogeneous']} without. One seed and one size of cells.")


def fibres(folder):
    rows = read(folder, "fibres.csv")
    return [
        "## Pins with every fibre",
        "Pins of 2 mm on cells of 0.5 mm. The fibres are 0.5 mm wide, five times the paper's 0.1 mm, which would take cells of 0.1 mm; they are 1.5 to "
        "3.5 mm tall, nominally 10 %, one seed. Long bars go through the thickness, the plane's cells repeated; short bars are 0.5 x 0.5 mm and lie along "
        "z in the whole pin, without a plane of symmetry. Homogenized by PBC, as KUBC would hold faces that are free in the pin. Pushed at "
        "0.45, 0.5 and 0.55 m/s (smallest to largest, largest half width; differences start by start).",
        table(["P [MPa]", "cells [mm]", "body", "mu_inter", "half width", "minus homogeneous", "kHz", "slip [%]", "stick [%]", "separated [%]"],
              fibre_table(rows, 0.5, 0.5) + fibre_table(rows, 0.5, 0.4), right=True)]


def fine(folder):
    """The paper's fibres in a thin pin, where `./run.sh thickness fine` has been run."""
    if not os.path.exists(os.path.join(folder, "fine.csv")):
        return []
    rows = read(folder, "fine.csv")
    return [
        "## Fibres of 0.1 mm",
        "The paper's fibres, seed 1, on the paper's cells of 0.1 mm: in plane strain, and as bars through a pin of 0.4 mm with free faces, of which one half is "
        f"computed. Homogenized by PBC, pushed at 0.5 m/s; {sum(values(rows, 'cpu [s]')) / 60:.0f} min on one core with AVX2.",
        table(["P [MPa]", "cells [mm]", "body", "mu_inter", "half width", "minus homogeneous", "kHz", "slip [%]", "stick [%]", "separated [%]"],
              fibre_table(rows, 0.1, 0.5) + fibre_table(rows, 0.1, 0.4), right=True)]


def fine_verdict(folder):
    """Bars of 0.1 mm in a thin pin beside plane strain, load by load."""
    if not os.path.exists(os.path.join(folder, "fine.csv")):
        return []
    rows, said = read(folder, "fine.csv"), []
    for load in dict.fromkeys(float(r["P [MPa]"]) for r in rows):
        plane, thin = (chosen(rows, body, "heterogeneous", 0.1, load)[0] for body in ("plane strain", "long bars"))
        homogeneous = chosen(rows, "long bars", "homogeneous", 0.1, load)[0]
        said.append(f"at {load:g} MPa mu_inter {float(thin[MU]):.4f} and {float(thin[MAIN]):.2f} kHz, in plane strain {float(plane[MU]):.4f} and "
                    f"{float(plane[MAIN]):.2f} kHz, the thin homogenized pin {float(homogeneous[MU]):.4f} and {float(homogeneous[MAIN]):.2f} kHz")
    return ["**The paper's fibres** of 0.1 mm as bars through a pin of 0.4 mm: " + "; ".join(said) + ". One seed and one start."]


def modes_verdict(folder):
    rows = read(folder, "modes.csv")
    thick, plane = rows[:-1], rows[-1]
    shear = [float(r["shear along x [kHz]"]) for r in thick]
    first = [float(r["first out of plane [kHz]"]) for r in thick]
    return (f"**Modes**: the mode of shear along x stays at {interval(shear, 2)} kHz (plane strain {float(plane['shear along x [kHz]']):.2f}), but below it lie modes "
            f"out of the plane, the first at {min(first):.1f} kHz ({float(thick[0]['thickness [mm]']):g} mm) to {max(first):.1f} kHz, which all runs of half a pin leave out.")


def modes(folder):
    lines = []
    for r in read(folder, "modes.csv"):
        thickness, across, beam, shear, below, computed = r.values()
        below = below and (f"at least {below}" if below == computed else below)
        lines.append([f"{float(thickness):g} mm" if across else thickness, *[f"{float(v):.2f}" if v else "-" for v in (across, beam, shear)], below or "-"])
    return [
        "## Modes in 3D",
        "The whole homogeneous pin, bottom held in z. Out of plane are the modes that its half with a plane of symmetry has not. Beside them the first "
        "frequency of a thin beam along z without shear, clamped by the platen, whose lower end does not turn; low-order bricks lock where a cell is "
        "much longer than it is thick, so that the thinnest pins come out too stiff.",
        table(["body", "first out of plane [kHz]", "thin beam [kHz]", "shear along x [kHz]", "out of plane below it"], lines, right=True)]
