"""Stiffness of the cells of boxes of voxels whose orientations differ within a phase."""

import numpy as np

PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


def rotations(angles):
    """Axes of a material as columns, [n][3][3], of Bunge's Euler angles [n][3] in degrees."""
    (c1, c, c2), (s1, s, s2) = np.cos(np.radians(angles)).T, np.sin(np.radians(angles)).T
    return np.stack([c1 * c2 - s1 * s2 * c, -c1 * s2 - s1 * c2 * c, s1 * s,
                     s1 * c2 + c1 * s2 * c, -s1 * s2 + c1 * c2 * c, -c1 * s,
                     s2 * s, c2 * s, c], axis=-1).reshape(-1, 3, 3)


def turned(stiffness, rotation):
    """Stiffnesses [n][6][6] turned by rotations [n][3][3]."""
    T = np.empty((len(rotation), 6, 6))
    for row, (i, j) in enumerate(PAIRS):
        for column, (k, m) in enumerate(PAIRS):
            T[:, row, column] = rotation[:, i, k] * rotation[:, j, m] + (k != m) * rotation[:, i, m] * rotation[:, j, k]
    return T @ stiffness @ T.transpose(0, 2, 1)


def materials_of(run, ids_name, stiffness_name):
    """What each cell is made of, flat, and the stiffnesses of these materials: the phases, or these in all their orientations."""
    ids, stiffness = run.need(ids_name, stiffness_name)
    if run.get("/orientation/id") is None:
        return ids.ravel(), stiffness
    ids, phases, angles = run.need("/orientation/id", "/orientation/phase", "/orientation/euler_angles")
    return ids.ravel(), turned(stiffness[phases], rotations(angles))
