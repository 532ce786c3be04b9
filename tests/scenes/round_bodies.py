"""Bodies of steel with a round lower side on blocks, for contact with the rigid flat: fine cells as wide as the contact and more, then
growing ones."""

import csv
import math

import numpy as np

from mesh_files import Box

RADIUS, WIDTH = 1.0, 0.5  # m: of the round side, of the body in x (and y) and z
HALF_WIDTH = 0.01  # m: of the contact that is aimed at


def graded(length, size, fine, growth):
    """Points from 0 to about `length`: cells of `size` as far as `fine`, then each `growth` times as long as the one before."""
    points = [0.0]
    while points[-1] < length:
        points.append(points[-1] + size)
        size *= growth if points[-1] > fine else 1
    return length / points[-1] * np.array(points)


def box_on(axes, group):
    """A box with points where these axes have them."""
    box = Box([1.0] * len(axes), [len(axis) - 1 for axis in axes], lambda middle: group)
    places = np.rint(box.points * [len(axis) - 1 for axis in axes]).astype(int)
    return box, np.column_stack([axis[places[:, d]] for d, axis in enumerate(axes)])


def pressures_inside(folder, dim):
    """Squares of the distance from the middle, and the pressures, of the nodes of the static contact in out to 0.9 of the half width."""
    with open(folder("out", "static_contact.csv"), encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    r2 = np.array([sum(float(row[f"{name} [m]"]) ** 2 for name in "xy"[: dim - 1]) for row in rows])
    pressure = np.array([float(row["pressure [Pa]"]) for row in rows])
    inside = r2 < (0.9 * HALF_WIDTH) ** 2
    return r2[inside], pressure[inside]


def errors_of_hertz(folder, dim, force):
    """Largest pressure and radius of the static contact in out, relative to Hertz's for the force on the whole body, less 1."""
    r2, pressure = pressures_inside(folder, dim)
    # p^2 = p0^2 (1 - r^2 / a^2)
    slope, squared = np.polyfit(r2, pressure ** 2, 1)
    exact = (2 if dim == 2 else 1.5) * force / (math.pi * HALF_WIDTH ** (dim - 1))
    return math.sqrt(squared) / exact - 1, math.sqrt(-squared / slope) / HALF_WIDTH - 1


def round_body(dim, size, growth, both_sides=False):
    """A quarter of the body; with `both_sides` that and its mirror image in x."""
    along = [graded(WIDTH, size, 1.3 * HALF_WIDTH, growth)] * (dim - 1)
    up = graded(WIDTH, size, 0.5 * HALF_WIDTH, growth)
    if both_sides:
        along[0] = np.concatenate([-along[0][:0:-1], along[0]])
    axes = [*along, up]
    box, points = box_on(axes, "steel")
    for axis in range(dim):
        box.name_side(("x", "y", "z")[axis] + " low", axis, False)
    if both_sides:
        box.name_side("x high", 0, True)
    box.name_side("Top", dim - 1, True)
    bottom = RADIUS - np.sqrt(RADIUS**2 - np.sum(points[:, :-1] ** 2, axis=1))
    points[:, -1] = bottom + (WIDTH - bottom) * points[:, -1] / WIDTH
    box.points = points
    return box
