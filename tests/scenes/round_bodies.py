"""Bodies of steel with a round lower side on blocks, for contact with the rigid flat: fine cells as wide as the contact and more, then
growing ones."""


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


def round_body(dim, size, growth, both_sides=False):
    """A quarter of the body; with `both_sides` that and its mirror image in x."""
    along = [graded(WIDTH, size, 1.3 * HALF_WIDTH, growth)] * (dim - 1)
    up = graded(WIDTH, size, 0.5 * HALF_WIDTH, growth)
    if both_sides:
        along[0] = np.concatenate([-along[0][:0:-1], along[0]])
    axes = [*along, up]
    box = Box([1.0] * dim, [len(axis) - 1 for axis in axes], lambda middle: "steel")
    for axis in range(dim):
        box.name_side(("x", "y", "z")[axis] + " low", axis, False)
    if both_sides:
        box.name_side("x high", 0, True)
    box.name_side("Top", dim - 1, True)
    places = np.rint(box.points * [len(axis) - 1 for axis in axes]).astype(int)
    points = np.column_stack([axis[places[:, d]] for d, axis in enumerate(axes)])
    bottom = RADIUS - np.sqrt(RADIUS**2 - np.sum(points[:, :-1] ** 2, axis=1))
    points[:, -1] = bottom + (WIDTH - bottom) * points[:, -1] / WIDTH
    box.points = points
    return box
