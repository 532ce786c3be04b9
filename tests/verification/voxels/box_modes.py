"""Modes of a box of voxels whose sides hold their normal displacement, against waves in closed form.

The bottom holds u_z, the top u_x and u_y: products of sines and cosines satisfy the equations, pressure waves with displacements along the
wave vector k, shear waves across it. The frequencies converge with order 2; on three ranks they are the same.
"""

import itertools
import tempfile

import numpy as np

from scenes import Folder, prm

E, NU, RHO, SIZE, N_MODES = 30e9, 0.2, 1800., (24e-3, 20e-3, 14e-3), 8
G, M = E / (2 * (1 + NU)), E * (1 - NU) / ((1 + NU) * (1 - 2 * NU))
BOX = "set Dimension = 3\n" + prm({
    "Analysis": "modal", "Body/Size": "{:g}, {:g}, {:g}".format(*SIZE), "Body/Density": RHO,
    "Body/Stiffness": ", ".join(repr(x) for x in (M, M - 2 * G, M - 2 * G, M, M - 2 * G, M, G, G, G)),
    "Supports/Top/Kind": "pressure", "Supports/Top/Held": "u_x, u_y", "Supports/Left/Held": "u_x", "Supports/Right/Held": "u_x", "Supports/Front/Held": "u_y", "Supports/Back/Held": "u_y",
    "Modal/Bottom": "held in z", "Modal/Number of modes": N_MODES, "Modal/Tolerance": 1e-9})


def exact():
    """The lowest frequencies (Hz). A wave number that is 0 leaves no displacement along its axis."""
    found = []
    for m, n, p in itertools.product(range(6), range(6), range(4)):
        k = np.linalg.norm([m * np.pi / SIZE[0], n * np.pi / SIZE[1], (p + 0.5) * np.pi / SIZE[2]])
        found += [k * (M / RHO) ** 0.5] + [k * (G / RHO) ** 0.5] * ((m > 0) + (n > 0))
    return np.sort(found)[:N_MODES] / (2 * np.pi)


def main():
    with tempfile.TemporaryDirectory() as path:
        folder, due, errors = Folder(path, {"box": BOX}), exact(), []
        for n in (1, 2, 4):
            cells = f"--set=Body/Cells={6 * n}, {5 * n}, {4 * n}"
            folder.run(0, "contact_dynamics", "box.prm", cells, "--output", f"box{n}")
            found = np.array(folder.summary(f"box{n}")["frequencies"]["held"])
            errors.append(found / due - 1)
        folder.run(0, "contact_dynamics", "box.prm", cells, "--output", "divided", ranks=3)
        assert np.abs(np.array(folder.summary("divided")["frequencies"]["held"]) / found - 1).max() < 1e-8
        orders = np.log2(np.array(errors[:-1]) / errors[1:])
        print("exact (kHz):", due / 1e3, "\nerrors:", *errors, "\norders:", *orders, sep="\n")
        assert np.abs(errors[-1]).max() < 0.02 and np.abs(orders[-1] - 2).max() < 0.15, (errors, orders)


if __name__ == "__main__":
    main()
