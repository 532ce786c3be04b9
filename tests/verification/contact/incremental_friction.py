"""Load steps of static contact with friction.

Spence: a cylinder pressed on the flat with friction. As its loading is self-similar, the share of the contact that sticks and friction by
pressure are those of a flat punch, solved here by boundary elements of the half plane.
Cattaneo and Mindlin: a cylinder and (in incremental_sphere.py) a sphere pressed, then displaced. Their solutions hold where normal and tangential loads are
independent, on a rigid flat for Poisson's ratio 1/2, for which these elements lock. With 0.45 the coupling is left, most of it odd in x:
coefficient (1 for the cylinder, as coupling matters less then) and measures (a second moment, total widths) are chosen to feel it
little, and limits are as wide as what is left. Shear node by node does not converge to the closed form, and no order follows."""

import csv
import math
import tempfile

import numpy as np

from round_bodies import HALF_WIDTH, RADIUS, WIDTH, round_body
from scenes import Folder, prm

YOUNG = 210e9


def modulus(poisson):
    return YOUNG / (1 - poisson**2)


def hertz_force(dim, poisson):
    return (math.pi / 4 * HALF_WIDTH**2 if dim == 2 else 4 / 3 * HALF_WIDTH**3) * modulus(poisson) / RADIUS


def press(folder, dim, size, growth, poisson, friction, steps, displacement=0.0):
    """Rows of the tables of contact nodes and load steps. Half of the sphere and all of the cylinder where the flat is displaced, else
    a half of the cylinder."""
    both = displacement != 0
    round_body(dim, size, growth, both).write(folder("body.msh"))
    area = (2 if both else 1) * WIDTH ** (dim - 1)
    share = 1 if dim == 2 and both else 0.5
    held = {"Supports/x low/Held": "u_x", **({"Supports/x high/Held": "u_x"} if both else {}), **({"Supports/y low/Held": "u_y"} if dim == 3 else {})}
    folder.write("press.prm", f"set Dimension = {dim}\n" + prm({
        "Analysis": "static contact", "Mesh/File": "body.msh", "Mesh/Contact boundary": f"{'yz'[dim - 2]} low", **held,
        "Phases/Names": "steel", "Phases/steel/Young modulus": YOUNG, "Phases/steel/Poisson ratio": poisson,
        "Phases/steel/Density": 7800, "Supports/Top/Kind": "pressure", "Supports/Top/Held": "",
        "Supports/Top/Pressure": share * hertz_force(dim, poisson) / area, "Friction/Coefficient": friction, "Flat/Velocity": 0,
        "Static contact/Tolerance": 1e-5, "Static contact/Load steps": steps, "Static contact/Flat displacement": displacement}))
    folder.run(0, "contact_dynamics", "press.prm", "--output", "out")
    tables = []
    for name in ("static_contact.csv", "load_steps.csv"):
        with open(folder("out", name), encoding="ascii") as file:
            rows = list(csv.DictReader(file))
        tables.append({key.split(" ")[0]: np.array([row[key] if key == "state" else float(row[key]) for row in rows]) for key in rows[0]})
    return tables


def punch(stick, beta, friction, n=60):
    """Cells, pressure and shear of a flat punch of half width 1 under a unit force that sticks within `stick` and slips outside."""
    share = np.linspace(0, 1, n + 1)
    half = np.concatenate([stick * np.sin(math.pi / 2 * share), stick + (1 - stick) * (1 - np.cos(math.pi * share[1:])) / 2])
    ends = np.concatenate([-half[:0:-1], half])
    x, width, m = (ends[1:] + ends[:-1]) / 2, np.diff(ends), len(ends) - 1
    primitive = lambda d: d * np.log(np.abs(d)) - d
    far = (primitive(x[:, None] - ends[:-1]) - primitive(x[:, None] - ends[1:])) / math.pi
    near = beta * (np.tril(np.ones((m, m)), -1) * width + np.diag(width / 2))
    # The displacement along the normal is the same everywhere, that along the surface where it sticks.
    normal, along = np.diff(np.hstack([far, -near]), axis=0), np.diff(np.hstack([near, far]), axis=0)
    inside = np.abs(x) < stick
    slip = np.hstack([-friction * np.diag(np.sign(x)), np.eye(m)])[~inside]
    sums = np.vstack([np.concatenate([width, 0 * x]), np.concatenate([0 * x, width * inside])])
    system = np.vstack([normal, along[inside[1:] & inside[:-1]], slip, sums])
    solution = np.linalg.solve(system, np.concatenate([np.zeros(2 * m - 2), [1, 0]]))
    return x, width, solution[:m], solution[m:]


def spence(beta, friction):
    """The part of the contact that sticks: friction has no singularity at its end. With what punch() gives."""
    low, high = 0.05, 0.99
    while high - low > 1e-5:
        middle = (low + high) / 2
        x, _, p, q = punch(middle, beta, friction)
        last = np.flatnonzero(x < middle)[-1]
        low, high = (middle, high) if q[last] < friction * p[last] else (low, middle)
    return middle, punch(middle, beta, friction)


def check_spence(folder):
    poisson, friction = 0.3, 0.3
    stick, (x, width, _, q) = spence((1 - 2 * poisson) / (2 * (1 - poisson)), friction)
    exact = 2 * np.sum((q * width)[x > 0])
    found = {}
    for cells, steps in ((8, 4), (8, 8), (8, 32), (16, 16)):
        nodes, load = press(folder, 2, HALF_WIDTH / cells, 1.2, poisson, friction, steps)
        carried = load["tangential_force"][-1] / load["normal_force"][-1]
        sticking = load["stick_area"][-1] / load["contact_area"][-1]
        found[cells, steps] = carried / exact - 1, sticking - stick
        # Of the cylinder: those of punches as wide as the contact was on its way.
        a = HALF_WIDTH * np.linspace(0, 1, 2001)[1:]
        by_width = np.interp(nodes["x"][:, None] / a, x, q, right=0) * (nodes["x"][:, None] < a)
        shear = 2 * np.mean(by_width, axis=1) * hertz_force(2, poisson) / HALF_WIDTH
        scale = friction * 2 * hertz_force(2, poisson) / (math.pi * HALF_WIDTH)
        inside = nodes["x"] < 0.9 * HALF_WIDTH
        found[cells, steps] += (math.sqrt(np.mean((nodes["shear_traction"] - shear)[inside & (nodes["x"] > 0)] ** 2)) / scale,)
    print(f"Spence: {stick:.4f} of the contact sticks, friction {exact:.4f} of the force:", found)
    return found


def check_cylinder(folder):
    """Second moment of shear about the middle, and the part of the contact that sticks."""
    poisson, friction, errors = 0.45, 1.0, []
    force = hertz_force(2, poisson)
    way = 0.6 * friction * force * 2 / (math.pi * modulus(poisson)) * math.log(2 * WIDTH / HALF_WIDTH)
    for cells in (8, 16):
        nodes, load = press(folder, 2, HALF_WIDTH / cells, 1.2, poisson, friction, 4, way)
        share = load["tangential_force"][-1] / (friction * load["normal_force"][-1])
        assert 0.3 < share < 0.6, share
        order = np.argsort(nodes["x"])
        x, q = nodes["x"][order] / HALF_WIDTH, nodes["shear_traction"][order]
        moment = np.sum(q * x**2 * np.gradient(x)) / np.sum(q * np.gradient(x))
        errors.append((moment / ((2 - share) / 4) - 1, load["stick_area"][-1] / load["contact_area"][-1] - math.sqrt(1 - share)))
    print("Cattaneo and Mindlin, cylinder: moment of shear, part that sticks:", errors)
    return errors


def check_sphere(folder, cells, growth):
    """Displacement by the tangential force, and the radius within which it sticks."""
    poisson, friction = 0.45, 0.3
    shear_modulus = YOUNG / (2 * (1 + poisson))
    whole = 3 * friction * hertz_force(3, poisson) * (2 - poisson) / (16 * HALF_WIDTH * shear_modulus)
    _, load = press(folder, 3, HALF_WIDTH / cells, growth, poisson, friction, 1, 0.35 * whole)
    share = load["tangential_force"][-1] / (friction * load["normal_force"][-1])
    stick = (1 - share) ** (1 / 3)
    error = 0.35 / (1 - stick**2) - 1, math.sqrt(load["stick_area"][-1] / load["contact_area"][-1]) - stick
    print(f"Cattaneo and Mindlin, sphere, {cells} cells: compliance at {share:.3f} of the friction, radius that sticks:", error)
    return error


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        pressed = check_spence(folder)
        assert abs(pressed[8, 32][0]) < 0.01 and abs(pressed[16, 16][0]) < 0.01
        assert abs(pressed[8, 32][0]) < 0.4 * abs(pressed[8, 4][0])
        assert all(abs(sticking) < 0.5 / cells for (cells, _), (_, sticking, _) in pressed.items())
        assert pressed[8, 32][2] < 0.035 and pressed[16, 16][2] < 0.035
        cylinder = check_cylinder(folder)
        assert all(abs(moment) < 0.03 for moment, _ in cylinder)
        assert abs(cylinder[0][1]) < 1 / 8 and abs(cylinder[1][1]) < 0.5 / 16


if __name__ == "__main__":
    main()
