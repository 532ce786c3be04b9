"""Hertz for two bodies: a cylinder and a sphere of steel pressed on a block of aluminium, without friction: radius and pressure of the contact, with the modulus
1/E* = (1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2, on meshes of a half or a quarter of both. Both follow from pressures inside the contact, as in hertz.py."""

import math
import tempfile

import numpy as np

from round_bodies import HALF_WIDTH, RADIUS, WIDTH, box_on, errors_of_hertz, graded, round_body
from scenes import Folder, prm

STEEL, ALUMINIUM = (210e9, 0.3, 7800), (70e9, 0.33, 2700)
MODULUS = 1 / sum((1 - nu**2) / young for young, nu, _ in (STEEL, ALUMINIUM))


def block(dim, size, growth):
    """A block below the round body, with nodes where that has them if its cells are as large."""
    axes = [graded(WIDTH, size, 1.3 * HALF_WIDTH, growth)] * (dim - 1) + [-graded(WIDTH, size, 0.5 * HALF_WIDTH, growth)[::-1]]
    box, points = box_on(axes, "block")
    for name, axis, upper in [("x low", 0, False), ("y low", 1, False), ("z low", 2, False), ("Contact", dim - 1, True)]:
        if axis < dim:
            box.name_side(name, axis, upper)
    box.points = points
    return box


def stiffness(dim):
    young, nu, _ = ALUMINIUM
    lame, shear = young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))
    a, b = lame + 2 * shear, lame
    return ", ".join(map(str, [a, b, a, shear] if dim == 2 else [a, b, b, a, b, a, shear, shear, shear]))


def contact(folder, dim, cells, growth, below):
    """Largest pressure and radius of the contact, relative to Hertz's for the force, less 1; cells of the block are smaller by a factor @p below."""
    round_body(dim, HALF_WIDTH / cells, growth).write(folder("body.msh"))
    block(dim, HALF_WIDTH / cells / below, growth).write(folder("block.msh"))
    force = math.pi * MODULUS * HALF_WIDTH**2 / (4 * RADIUS) if dim == 2 else 4 * MODULUS * HALF_WIDTH**3 / (3 * RADIUS)
    quarter = force / 2 ** (dim - 1)
    normal = "yz"[dim - 2]
    sides = {f"{body}Supports/{name} low/Held": f"u_{name}" for name in "xy"[: dim - 1] for body in ("", "Counter body/")}
    folder.write("hertz.prm", f"set Dimension = {dim}\n" + prm({
        "Analysis": "static contact", "Mesh/File": "body.msh", "Mesh/Contact boundary": f"{normal} low", **sides,
        "Phases/Names": "steel", "Phases/steel/Young modulus": STEEL[0], "Phases/steel/Poisson ratio": STEEL[1], "Phases/steel/Density": STEEL[2],
        "Counter body/Mesh/File": "block.msh", "Counter body/Stiffness": stiffness(dim), "Counter body/Density": ALUMINIUM[2], "Counter body/Supports/Bottom/Kind": "free",
        f"Counter body/Supports/{normal} low/Kind": "held",
        "Supports/Top/Kind": "pressure", "Supports/Top/Held": "", "Supports/Top/Pressure": quarter / WIDTH ** (dim - 1), "Friction/Coefficient": 0,
        "Flat/Velocity": 0}))
    folder.run(0, "contact_dynamics", "hertz.prm", "--output", "out")
    return errors_of_hertz(folder, dim, force)


def check(dim, sizes, growth, limit, least_order, below=1.0):
    with tempfile.TemporaryDirectory() as path:
        errors = np.abs([contact(Folder(path), dim, cells, growth, below) for cells in sizes])
    order = math.log(errors[0, 1] / errors[-1, 1]) / math.log(sizes[-1] / sizes[0])
    print(f"{dim}D, {sizes} cells across half of the contact, {below} times as many below: errors of pressure and radius {errors.tolist()}, order of the radius {order:.2f}")
    assert errors[-1].max() < limit and order > least_order, (errors, order)


if __name__ == "__main__":
    check(2, (8, 16, 32), 1.2, 0.002, 1.5)
    check(2, (8, 16, 32), 1.2, 0.002, 0.5, below=0.73)
    check(2, (8, 16, 32), 1.2, 0.002, 0.5, below=1.4)
    check(3, (3, 5), 1.6, 0.01, 1.0)
    check(3, (3, 5), 1.6, 0.02, 1.0, below=0.8)
