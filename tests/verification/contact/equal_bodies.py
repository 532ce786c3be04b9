"""Cattaneo and Mindlin for two bodies of the same material, whose normal and tangential loads are independent: a cylinder of steel on a block of steel, pressed, then
displaced along it. With Q of mu P the part c = a sqrt(1 - Q/(mu P)) of the contact sticks, and the shear is

    q(x) = mu p_0/a (sqrt(a^2 - x^2) - sqrt(c^2 - x^2)),

each root where it is real. On nodes that match, and on a block with cells of another size."""

import csv
import math
import tempfile

import numpy as np

from round_bodies import HALF_WIDTH, RADIUS, WIDTH, box_on, graded, round_body
from scenes import Folder, prm

YOUNG, POISSON, MU = 210e9, 0.3, 0.5
MODULUS = YOUNG / (2 * (1 - POISSON**2))
FORCE = math.pi * MODULUS * HALF_WIDTH**2 / (4 * RADIUS)


def block(size):
    along = graded(WIDTH, size, 1.3 * HALF_WIDTH, 1.2)
    box, points = box_on([np.concatenate([-along[:0:-1], along]), -graded(WIDTH, size, 0.5 * HALF_WIDTH, 1.2)[::-1]], "steel")
    for name, axis, upper in [("x low", 0, False), ("x high", 0, True), ("y low", 1, False), ("Contact", 1, True)]:
        box.name_side(name, axis, upper)
    box.points = points
    return box


def errors(folder, cells, below):
    """Of the shear: root mean square within 0.95 a by mu p_0, of the part that sticks, and the share of mu P."""
    size = HALF_WIDTH / cells
    round_body(2, size, 1.2, True).write(folder("body.msh"))
    block(size / below).write(folder("block.msh"))
    lame, shear = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
    # About half of what makes all of it slide, as by half planes of this width.
    way = 0.6 * MU * FORCE * 2 / (math.pi * MODULUS) * math.log(2 * WIDTH / HALF_WIDTH)
    folder.write("press.prm", prm({
        "Analysis": "static contact", "Mesh/File": "body.msh", "Mesh/Contact boundary": "y low", "Supports/x low/Held": "u_x", "Supports/x high/Held": "u_x",
        "Phases/Names": "steel", "Phases/steel/Young modulus": YOUNG, "Phases/steel/Poisson ratio": POISSON, "Phases/steel/Density": 7800,
        "Supports/Top/Kind": "platen", "Supports/Top/Pressure": FORCE / (2 * WIDTH), "Friction/Coefficient": MU, "Flat/Velocity": 0,
        "Counter body/Mesh/File": "block.msh", "Counter body/Stiffness": f"{lame + 2 * shear}, {lame}, {lame + 2 * shear}, {shear}", "Counter body/Density": 7800,
        "Counter body/Supports/Bottom/Kind": "free", "Counter body/Supports/y low/Kind": "held",
        **{f"Counter body/Supports/{side}/Held": "u_x" for side in ("x low", "x high")},
        "Static contact/Tolerance": 1e-6, "Static contact/Load steps": 4, "Static contact/Flat displacement": way}))
    folder.run(0, "contact_dynamics", "press.prm", "--output", "out")
    with open(folder("out", "static_contact.csv"), encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    x, p, q = (np.array([float(row[key]) for row in rows]) for key in ("x [m]", "pressure [Pa]", "shear_traction [Pa]"))
    sticks = np.array([row["state"] == "stick" for row in rows])
    summary = folder.summary("out")
    share = summary["tangential_force"] / (MU * summary["normal_force"])
    inside = np.abs(x) < 0.9 * HALF_WIDTH
    slope, squared = np.polyfit(x[inside] ** 2, p[inside] ** 2, 1)
    peak, a = math.sqrt(squared), math.sqrt(-squared / slope)
    c = a * math.sqrt(1 - share)
    root = lambda radius: np.sqrt(np.maximum(0, radius**2 - x**2))
    exact = MU * peak / a * (root(a) - root(c))
    near = np.abs(x) < 0.95 * a
    return math.sqrt(np.mean((q - exact)[near] ** 2)) / (MU * peak), np.abs(x[sticks]).max() / c - 1, share


def main():
    with tempfile.TemporaryDirectory() as path:
        for below in (1.0, 0.73):
            found = [errors(Folder(path), cells, below) for cells in (8, 16, 32)]
            print(f"{below} times as many cells below: error of the shear, of the part that sticks, share of the friction", found)
            order = math.log2(found[0][0] / found[-1][0]) / 2
            # The shear has kinks at the end of what sticks, between nodes.
            assert found[-1][0] < 0.01 and order > 0.6 and abs(found[-1][1]) < 0.01, (below, found, order)


if __name__ == "__main__":
    main()
