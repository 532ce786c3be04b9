"""Hertz: a cylinder (plane strain) pressed on the rigid flat without friction: width and pressure of the contact on meshes of a half of the
body. Both follow from pressures inside the contact, as its edge falls between two nodes. hertz_sphere.py has the sphere."""

import math
import tempfile

import numpy as np

from round_bodies import HALF_WIDTH, RADIUS, WIDTH, errors_of_hertz, round_body
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
    return errors_of_hertz(folder, dim, force)


def check(dim, sizes, growth, limit):
    with tempfile.TemporaryDirectory() as path:
        errors = np.abs([contact(Folder(path), dim, cells, growth) for cells in sizes])
    order = math.log(errors[0, 1] / errors[-1, 1]) / math.log(sizes[-1] / sizes[0])
    print(f"{dim}D, {sizes} cells across half of the contact: errors of pressure and radius {errors.tolist()}, order of the radius {order:.2f}")
    assert errors[-1].max() < limit, errors
    assert order > 1.5, errors


if __name__ == "__main__":
    check(2, (8, 16, 32), 1.2, 0.001)
