"""Spence: a body pressed without a tangential load on a strip of the flat, with friction. The middle sticks, the rest slips, by Poisson's ratio and
friction alone (Spence 1973). For a strip of fixed width the loading is proportional, so that one step is enough. Exact are the integral equations of
the elastic half-plane (Johnson, Contact Mechanics, eq. 2.25); they are solved here, and checked themselves with Goodman's approximation, in which shear
does not change the pressure and K(c / a) / K'(c / a) = mu / beta, beta = (1 - 2 nu) / (2 (1 - nu)) (Johnson, eq. 5.34)."""

import csv
import math
import tempfile

import numpy as np

from mesh_files import Box
from scenes import Folder, prm

YOUNG, POISSON = 1e9, 0.3
BETA = (1 - 2 * POISSON) / (2 * (1 - POISSON))
HALF_WIDTH = 1.0  # mm: of the strip


def elliptic(k):
    """Complete integral of the first kind, by the arithmetic-geometric mean."""
    a, b = 1.0, math.sqrt(1 - k * k)
    while abs(a - b) > 1e-15 * a:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return math.pi / (2 * a)


def goodman(friction):
    """c / a, by bisection."""
    low, high = 1e-9, 1 - 1e-9
    for _ in range(60):
        k = (low + high) / 2
        low, high = (k, high) if elliptic(k) / elliptic(math.sqrt(1 - k * k)) < friction / BETA else (low, k)
    return low


def edge_of_stick(x, left):
    """What friction leaves of mu p, as a share, goes like the root of the distance from the edge: from the last points within."""
    near = left < max(0.3, np.sort(left)[2])
    slope, value = np.polyfit(x[near], left[near] ** 2, 1)
    return -value / slope


def half_plane(friction, coupled=True, n=400):
    """c / a, and the friction on a half of the strip over the force on it: tractions constant on n elements from 0 to 1, finer towards the end,
    even (pressure) and odd (shear) in x; displacements in units of 2 (1 - nu^2) / E."""
    ends = np.sin(0.5 * np.pi * np.linspace(0, 1, n + 1))
    x, length = (ends[1:] + ends[:-1]) / 2, np.diff(ends)

    def logarithm(distance):  # its integral
        return distance * np.log(np.abs(distance)) - distance

    near = logarithm(ends[1:] - x[:, None]) - logarithm(ends[:-1] - x[:, None])
    image = logarithm(ends[1:] + x[:, None]) - logarithm(ends[:-1] + x[:, None])
    from_middle = BETA * (np.tril(np.ones((n, n)), -1) * length + np.diag(length / 2))
    normal = np.hstack([-(near + image) / np.pi, from_middle * coupled])
    along = np.hstack([-from_middle, -(near - image) / np.pi])
    equations, known = np.vstack([normal - normal[0], np.hstack([-friction * np.eye(n), np.eye(n)])]), np.zeros(2 * n)
    equations[0], known[0] = np.r_[length, np.zeros(n)], 1.0

    def tractions(n_sticking):
        sticking = equations.copy()
        sticking[n : n + n_sticking] = along[:n_sticking]
        return np.split(np.linalg.solve(sticking, known), 2)

    low, high = 1, n
    while high - low > 1:
        middle = (low + high) // 2
        pressure, shear = tractions(middle)
        low, high = (middle, high) if shear[middle - 1] <= friction * pressure[middle - 1] else (low, middle)
    pressure, shear = tractions(low)
    return edge_of_stick(x[:low], 1 - shear[:low] / (friction * pressure[:low])), shear @ length


def graded(size, fine, extent):
    """Points from 0 to more than `extent`: cells of `size` as far as `fine`, then growing ones."""
    points = list(np.linspace(0, fine, round(fine / size) + 1))
    while points[-1] < extent:
        size *= 1.1
        points.append(points[-1] + size)
    return np.array(points)


def body(size, extent):
    """The half x > 0 of the body, whose strip is the group Contact."""
    x, y = (graded(size, fine * HALF_WIDTH, extent) for fine in (1.5, 0.5))
    box = Box([len(x) - 1, len(y) - 1], [len(x) - 1, len(y) - 1], lambda middle: "rubber")
    box.name_side("Middle", 0, False).name_side("Contact", 1, False).name_side("Top", 1, True)
    places = np.rint(box.points).astype(int)
    box.points = np.column_stack([x[places[:, 0]], y[places[:, 1]]])
    box.faces = [(corners, name) for corners, name in box.faces if name != "Contact" or box.points[corners, 0].max() < HALF_WIDTH + size / 2]
    return box, x[-1]


def meshed(folder, friction, cells, extent):
    """The same of a body whose half is `extent` wide and high, with so many cells on the half strip."""
    box, width = body(HALF_WIDTH / cells, extent)
    box.write(folder("body.msh"))
    folder.write("spence.prm", "set Dimension = 2\n" + prm({
        "Analysis": "static contact", "Mesh/File": "body.msh", "Mesh/Scale": 0.001, "Supports/Middle/Held": "u_x", "Phases/Names": "rubber",
        "Phases/rubber/Density": 1000, "Phases/rubber/Young modulus": YOUNG, "Phases/rubber/Poisson ratio": POISSON, "Supports/Top/Kind": "pressure",
        "Supports/Top/Held": "", "Supports/Top/Pressure": 1e6 / width, "Friction/Coefficient": friction, "Flat/Velocity": 0}))
    folder.run(0, "contact_dynamics", "spence.prm", "--output", "out")
    with open(folder("out", "static_contact.csv"), encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    x, pressure, shear = (np.array([float(row[name]) for row in rows]) for name in ("x [m]", "pressure [Pa]", "shear_traction [Pa]"))
    sticks = np.array([row["state"] == "stick" for row in rows])
    assert np.array_equal(sticks, x <= x[sticks].max()), "not the middle alone sticks"
    area = np.gradient(x)
    area[[0, -1]] /= 2
    return edge_of_stick(x[sticks] / x[-1], 1 - shear[sticks] / (friction * pressure[sticks])), shear @ area / (pressure @ area)


with tempfile.TemporaryDirectory() as path:
    for mu in (0.2, 0.4):
        assert abs(half_plane(mu, coupled=False)[0] / goodman(mu) - 1) < 0.002, "the integral equations are not solved"
        exact = half_plane(mu)
        errors = [[found / right - 1 for found, right in zip(meshed(Folder(path), mu, 20, extent), exact)] for extent in (100, 400)]
        print(f"mu = {mu}: c / a = {exact[0]:.4f}, friction over force {exact[1]:.4f}; relative errors of a body 100 and 400 times as wide:", *errors)
        assert max(map(abs, errors[1])) < 0.01 and abs(errors[1][1]) < 0.004, errors
        # What is left is that the body is no half-plane.
        assert abs(errors[1][1]) < 0.4 * abs(errors[0][1]), errors
