"""Hertz: a cylinder (plane strain) pressed on the rigid flat without friction: width and pressure of the contact on meshes of a half of the
body. Both follow from pressures inside the contact, as its edge falls between two nodes. hertz_sphere.py has the sphere."""

import csv
import math
import tempfile

import numpy as np

from round_bodies import HALF_WIDTH, RADIUS, WIDTH, round_body
from scenes import Folder, prm

YOUNG, POISSON = 210e9, 0.3
MODULUS = YOUNG / (1 - POISSON**2)


def contact(folder, dim, cells, growth):
    """Largest pressure and radius of the contact, relative to Hertz's for the force, less 1."""
    round_body(dim, HALF_WIDTH / cells, growth).write(folder("body.msh"))
    force = math.pi * MODULUS * HALF_WIDTH**2 / (4 * RADIUS) if dim == 2 else 4 * MODULUS * HALF_WIDTH**3 / (3 * RADIUS)
    quarter = force / 2 ** (dim - 1)
    sides = {f"Supports/{name} low/Held": f"u_{name}" for name in "xy"[: dim - 1]}
    folder.write("hertz.prm", f"set Dimension = {dim}\n" + prm({
        "Analysis": "static contact", "Mesh/File": "body.msh", "Mesh/Contact boundary": f"{'yz'[dim - 2]} low", **sides,
        "Phases/Names": "steel", "Phases/steel/Young modulus": YOUNG, "Phases/steel/Poisson ratio": POISSON, "Phases/steel/Density": 7800,
        "Supports/Top/Kind": "pressure", "Supports/Top/Held": "", "Supports/Top/Pressure": quarter / WIDTH ** (dim - 1), "Friction/Coefficient": 0,
        "Flat/Velocity": 0}))
    folder.run(0, "contact_dynamics", "hertz.prm", "--output", "out")
    with open(folder("out", "static_contact.csv"), encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    r2 = np.array([sum(float(row[f"{name} [m]"]) ** 2 for name in "xy"[: dim - 1]) for row in rows])
    pressure = np.array([float(row["pressure [Pa]"]) for row in rows])
    inside = r2 < (0.9 * HALF_WIDTH) ** 2
    # p^2 = p0^2 (1 - r^2 / a^2)
    slope, squared = np.polyfit(r2[inside], pressure[inside] ** 2, 1)
    exact = (2 if dim == 2 else 1.5) * force / (math.pi * HALF_WIDTH ** (dim - 1))
    return math.sqrt(squared) / exact - 1, math.sqrt(-squared / slope) / HALF_WIDTH - 1


def check(dim, sizes, growth, limit):
    with tempfile.TemporaryDirectory() as path:
        errors = np.abs([contact(Folder(path), dim, cells, growth) for cells in sizes])
    order = math.log(errors[0, 1] / errors[-1, 1]) / math.log(sizes[-1] / sizes[0])
    print(f"{dim}D, {sizes} cells across half of the contact: errors of pressure and radius {errors.tolist()}, order of the radius {order:.2f}")
    assert errors[-1].max() < limit, errors
    assert order > 1.5, errors


if __name__ == "__main__":
    check(2, (8, 16, 32), 1.2, 0.001)
