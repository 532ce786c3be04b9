"""Hertz: a cylinder (plane strain) and a sphere pressed on the rigid flat without friction: width and pressure of the contact on two meshes.

A quarter of the body on blocks whose lower side is round: fine cells as wide as the contact and more, then growing ones."""

import csv
import math
import os
import sys
import tempfile

import numpy as np

sys.path.append(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "regression"))
from mesh_files import Box  # noqa: E402
from scenes import Folder, prm  # noqa: E402

YOUNG, POISSON = 210e9, 0.3
MODULUS = YOUNG / (1 - POISSON**2)
RADIUS, WIDTH = 1.0, 0.5  # m: of the round side, of the body in x (and y) and z
HALF_WIDTH = 0.01  # m: of the contact that is aimed at


def graded(length, size, fine, growth):
    """Points from 0 to about `length`: cells of `size` as far as `fine`, then each `growth` times as long as the one before."""
    points = [0.0]
    while points[-1] < length:
        points.append(points[-1] + size)
        size *= growth if points[-1] > fine else 1
    return length / points[-1] * np.array(points)


def round_body(dim, size, growth):
    along = graded(WIDTH, size, 1.3 * HALF_WIDTH, growth)
    up = graded(WIDTH, size, 0.5 * HALF_WIDTH, growth)
    box = Box([1.0] * dim, [len(along) - 1] * (dim - 1) + [len(up) - 1], lambda middle: "steel")
    for axis in range(dim):
        box.name_side(("x", "y", "z")[axis] + " low", axis, False)
    box.name_side("Top", dim - 1, True)
    places = np.rint(box.points * np.array([len(along) - 1] * (dim - 1) + [len(up) - 1])).astype(int)
    points = np.column_stack([along[places[:, d]] for d in range(dim - 1)] + [up[places[:, -1]]])
    bottom = RADIUS - np.sqrt(RADIUS**2 - np.sum(points[:, :-1] ** 2, axis=1))
    points[:, -1] = bottom + (WIDTH - bottom) * points[:, -1] / WIDTH
    box.points = points
    return box


def contact(folder, dim, cells, growth):
    """Largest pressure and radius of the contact, relative to Hertz's for the force, less 1."""
    round_body(dim, HALF_WIDTH / cells, growth).write(folder("body.msh"))
    force = math.pi * MODULUS * HALF_WIDTH**2 / (4 * RADIUS) if dim == 2 else 4 * MODULUS * HALF_WIDTH**3 / (3 * RADIUS)
    quarter = force / 2 ** (dim - 1)
    sides = {f"Mesh/Held in {name}": f"{name} low" for name in "xy"[: dim - 1]}
    folder.write("hertz.prm", f"set Dimension = {dim}\n" + prm({
        "Analysis": "static contact", "Mesh/File": "body.msh", "Mesh/Contact boundary": f"{'yz'[dim - 2]} low", **sides,
        "Phases/Names": "steel", "Phases/steel/Young modulus": YOUNG, "Phases/steel/Poisson ratio": POISSON, "Phases/steel/Density": 7800,
        "Top/Kind": "pressure", "Top/Lateral held": "false", "Top/Pressure": quarter / WIDTH ** (dim - 1), "Friction/Coefficient": 0,
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


with tempfile.TemporaryDirectory() as path:
    scenes = Folder(path)
    for dim, sizes, growth in ((2, (8, 16), 1.2), (3, (3, 6), 1.5)):
        errors = [contact(scenes, dim, cells, growth) for cells in sizes]
        print(f"{dim}D: pressure and radius less Hertz's:", errors)
        assert max(map(abs, errors[1])) < 0.005, errors
        assert abs(errors[1][1]) < 0.4 * abs(errors[0][1]), errors
