"""What the page says of pins with fibres and of modes, from the tables in doc/paper/thickness alone."""

import csv
import os

from pages import table

MU, HALF = "mu_inter [-]", "half width [-]"


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
    """A line a body: with fibres and homogenized."""
    lines = []
    for body in dict.fromkeys(r["body"] for r in rows):
        pair = [chosen(rows, body, material, cells, load) for material in ("heterogeneous", "homogeneous")]
        lines.append([body, f"{load:g}", f"{cells:g}", *(interval(values(some, MU), 3) for some in pair), interval(differences(rows, body, cells, load), 3)])
    return lines


def fibre_verdict(rows):
    every = [d for load in (0.5, 0.4) for body in dict.fromkeys(r["body"] for r in rows) for d in differences(rows, body, 0.5, load)]
    return (f"Fibres of 0.5 mm change mu_inter by {min(every):.3f} to {max(every):.3f} against the homogenized pin "
            "(table 2), because the same start may lead to another regime.")


def has_fine(folder):
    """Whether `./run.sh thickness fine` has been run."""
    return os.path.exists(os.path.join(folder, "fine.csv"))


def fibres(folder):
    rows = read(folder, "fibres.csv")
    lines, thin = fibre_table(rows, 0.5, 0.5) + fibre_table(rows, 0.5, 0.4), ""
    if has_fine(folder):
        fine = read(folder, "fine.csv")
        lines += fibre_table(fine, 0.1, 0.5) + fibre_table(fine, 0.1, 0.4)
        thin = ("\n"
                "* Fibres of 0.1 mm: the paper's, seed 1, in plane strain and as bars through a pin of 0.4 mm with free faces; push of 0.5 m/s only")
    return [
        "## Pins with every fibre",
        "* Fibres of 0.5 mm: 1.5 to 3.5 mm tall, nominally 10 %, in pins of 2 mm; pushes of 0.45, 0.5 and 0.55 m/s (smallest to largest; "
        "differences start by start)\n"
        "* Long bars go through the thickness and repeat the cells of the plane. Short bars, 0.5 x 0.5 mm, lie along z in the whole pin, without a plane of symmetry.\n"
        f"* Homogenized pins have the stiffness under PBC, because KUBC would hold faces that are free in the pin.{thin}",
        "Table 2. Fibres are one cell wide. The half width of mu_inter is at most "
        f"{max(values(rows, HALF)):.4f}.",
        table(["body", "P [MPa]", "fibres [mm]", "mu_inter, fibres", "homogenized", "difference"], lines, right=True)]


def fine_verdict(folder):
    """Bars of 0.1 mm in a thin pin beside plane strain."""
    if not has_fine(folder):
        return []
    rows = read(folder, "fine.csv")
    plane, thin = (chosen(rows, body, "heterogeneous", 0.1, 0.5)[0] for body in ("plane strain", "long bars"))
    return [f"With the paper's fibres of 0.1 mm mu_inter is {float(thin[MU]):.4f} for bars through a pin of 0.4 mm, {float(plane[MU]):.4f} "
            "in plane strain."]


def modes_verdict(folder):
    thick = read(folder, "modes.csv")[:-1]
    first = [float(r["first out of plane [kHz]"]) for r in thick]
    return (f"Below the shear mode along x there are modes out of the plane, from {min(first):.1f} kHz on (table 3); "
            "runs of half a pin leave these out.")


def modes(folder):
    lines = []
    for r in read(folder, "modes.csv"):
        thickness, across, beam, shear, below, computed = r.values()
        below = below and (f"at least {below}" if below == computed else below)
        lines.append([f"{float(thickness):g} mm" if across else thickness, *[f"{float(v):.2f}" if v else "-" for v in (across, beam, shear)], below or "-"])
    return [
        "## Modes in 3D",
        "Table 3. The whole homogeneous pin, bottom held in z. *Out of plane*: modes that half a pin with a plane of symmetry does not have. *Thin beam*: along z, without shear, "
        "clamped by the platen, its lower end does not turn.",
        table(["body", "first out of plane [kHz]", "thin beam [kHz]", "shear along x [kHz]", "out of plane below it"], lines, right=True)]
