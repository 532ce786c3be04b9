"""Hertz: a cylinder (plane strain) pressed on the rigid flat without friction: width and pressure of the contact on meshes of a half of the
body. Both follow from pressures inside the contact, as its edge falls between two nodes. hertz_sphere.py has the sphere.

On springs k of the flat, first order in e = E'/(k a): the slopes of the surface give PV int p1(s) / (x - s) ds = pi e/2 p0'(x) for p = p0 + p1, and with
the force that stays p1 = -e p_max/pi (1 - x atanh x)/sqrt(1 - x^2), x over the half width a: p^2 falls by 2 e/pi (1 - x atanh x) p_max^2."""

import math
import tempfile

import numpy as np

from round_bodies import HALF_WIDTH, RADIUS, WIDTH, errors_of_hertz, pressures_inside, round_body
from scenes import Folder, prm

YOUNG, POISSON = 210e9, 0.3
MODULUS = YOUNG / (1 - POISSON**2)


def contact(folder, dim, cells, growth, **flat):
    """Largest pressure and radius of the contact, relative to Hertz's for the force, less 1; with further keys of the flat."""
    round_body(dim, HALF_WIDTH / cells, growth).write(folder("body.msh"))
    force = math.pi * MODULUS * HALF_WIDTH**2 / (4 * RADIUS) if dim == 2 else 4 * MODULUS * HALF_WIDTH**3 / (3 * RADIUS)
    quarter = force / 2 ** (dim - 1)
    sides = {f"Supports/{name} low/Held": f"u_{name}" for name in "xy"[: dim - 1]}
    folder.write("hertz.prm", f"set Dimension = {dim}\n" + prm({
        "Analysis": "static contact", "Mesh/File": "body.msh", "Mesh/Contact boundary": f"{'yz'[dim - 2]} low", **sides,
        "Phases/Names": "steel", "Phases/steel/Young modulus": YOUNG, "Phases/steel/Poisson ratio": POISSON, "Phases/steel/Density": 7800,
        "Supports/Top/Kind": "pressure", "Supports/Top/Held": "", "Supports/Top/Pressure": quarter / WIDTH ** (dim - 1), "Friction/Coefficient": 0,
        "Flat/Velocity": 0, **{f"Flat/{key}": value for key, value in flat.items()}}))
    folder.run(0, "contact_dynamics", "hertz.prm", "--output", "out")
    return errors_of_hertz(folder, dim, force)


def check(dim, sizes, growth, limit):
    with tempfile.TemporaryDirectory() as path:
        errors = np.abs([contact(Folder(path), dim, cells, growth) for cells in sizes])
    order = math.log(errors[0, 1] / errors[-1, 1]) / math.log(sizes[-1] / sizes[0])
    print(f"{dim}D, {sizes} cells across half of the contact: errors of pressure and radius {errors.tolist()}, order of the radius {order:.2f}")
    assert errors[-1].max() < limit, errors
    assert order > 1.5, errors


def check_springs(cells, sizes):
    """The difference to the rigid flat falls with e, but for the next order, and is that of theory but for the cell in which the contact ends."""
    with tempfile.TemporaryDirectory() as path:
        folder, lower = Folder(path), []
        rigid = contact(folder, 2, cells, 1.2)
        of_rigid = pressures_inside(folder, 2)[1]
        for e in sizes:
            pressure = contact(folder, 2, cells, 1.2, **{"Normal stiffness": MODULUS / (e * HALF_WIDTH)})[0]
            fallen = of_rigid[0] ** 2 - pressures_inside(folder, 2)[1][0] ** 2
            fallen /= (MODULUS * HALF_WIDTH / (2 * RADIUS)) ** 2 * 2 * e / math.pi
            lower.append((rigid[0] - pressure) / e)
            print(f"springs, e = {e:g}: pressure {pressure:+.3%} from Hertz, {lower[-1]:.5f} e below the rigid flat, {fallen:.4f} of the first order in the middle")
            assert abs(fallen - 1) < 1 / cells, (e, fallen)
    assert np.all(np.abs(np.divide(lower[:-1], lower[-1]) - 1) < 1.5 * np.array(sizes[:-1])) and abs(pressure) < 0.001, (lower, pressure)


if __name__ == "__main__":
    check_springs(8, (0.02, 0.002, 0.0002))
    check(2, (8, 16, 32), 1.2, 0.001)
