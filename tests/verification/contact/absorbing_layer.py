"""Complex modes of a layer between a flat without friction and a top that absorbs, against its dispersion relation: waves of every angle meet
the dashpots rho c_P and rho c_S of the top, so that decay and frequency tell how much of each they send back. Of second order, on grids and meshes (modes of
still larger decay, of waves that come along the normal, belong to the cells: they decay the faster the finer these are).

With P waves A cos(p y) and S waves B sin(q y), times exp(i k x + s t), p^2 = -s^2/c_P^2 - k^2 and q^2 = -s^2/c_S^2 - k^2, the flat is free of shear and
holds u_y; sigma_yy + rho c_P s u_y = 0 and sigma_xy + rho c_S s u_x = 0 at the top are two equations for A and B."""

import csv
import tempfile

import numpy as np

from mesh_files import Box
from scenes import Folder, prm

HEIGHT, LENGTH, DENSITY, YOUNG, POISSON = 4e-3, 20e-3, 1770.0, 36e9, 0.25
LAME, SHEAR = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
P, S = np.sqrt((LAME + 2 * SHEAR) / DENSITY), np.sqrt(SHEAR / DENSITY)
HIGHEST, FASTEST = 5.9e5, 1.2e6  # Hz, 1/s
ROWS = (5, 10, 20)


def determinant(s, k):
    p, q = np.sqrt(-(s / P) ** 2 - k * k + 0j), np.sqrt(-(s / S) ** 2 - k * k + 0j)
    cp, sp, cq, sq = np.cos(p * HEIGHT), np.sin(p * HEIGHT), np.cos(q * HEIGHT), np.sin(q * HEIGHT)
    normal = [-(LAME + 2 * SHEAR) * p * p * cp - LAME * k * k * cp - DENSITY * P * s * p * sp,
              -2 * SHEAR * 1j * k * q * cq - DENSITY * P * s * 1j * k * sq]
    shear = [-2 * SHEAR * 1j * k * p * sp + DENSITY * S * s * 1j * k * cp, SHEAR * (k * k - q * q) * sq + DENSITY * S * s * q * cq]
    return normal[0] * shear[1] - normal[1] * shear[0]


def root(s, k):
    """By the secant method; None if it does not settle."""
    before, value = s * (1 + 1e-4), determinant(s * (1 + 1e-4), k)
    for _ in range(60):
        now = determinant(s, k)
        if now == value:
            break
        before, value, s = s, now, s - now * (s - before) / (now - value)
        if abs(s - before) < 1e-13 * abs(s):
            return s
    return None


def modes(folder, rows, mesh):
    columns = round(rows * LENGTH / HEIGHT)
    plane = {"Body/Stiffness": f"{LAME + 2 * SHEAR:.17g}, {LAME:.17g}, {LAME + 2 * SHEAR:.17g}, {SHEAR:.17g}", "Body/Density": DENSITY,
             "Body/Size": f"{LENGTH}, {HEIGHT}", "Body/Cells": f"{columns}, {rows}", "Sides/Periodic": "true"}
    if mesh:
        box = Box([LENGTH * 1e3, HEIGHT * 1e3], [columns, rows], lambda x: "body", "cube")
        box.name_side("Contact", 1, False).name_side("Top", 1, True).name_side("left", 0, False).name_side("right", 0, True).write(folder("layer.msh"))
        plane = {"Mesh/File": "layer.msh", "Mesh/Scale": 0.001, "Mesh/Periodic in x": "left, right", "Phases/Names": "body",
                 "Phases/body/Young modulus": YOUNG, "Phases/body/Poisson ratio": POISSON, "Phases/body/Density": DENSITY}
    folder.write("layer.prm", prm({**plane, "Analysis": "complex modes", "Supports/Top/Kind": "absorbing", "Supports/Top/Pressure": 1e6,
                                   "Friction/Coefficient": 0, "Friction/Regularization time": 0, "Time/Rayleigh beta": 0,
                                   "Complex modes/Highest frequency": HIGHEST, "Complex modes/Fastest decay": FASTEST}))
    folder.run(0, "contact_dynamics", "layer.prm", "--output", f"{rows}{mesh}", "--quiet")
    rows_of = csv.DictReader(folder.read(f"{rows}{mesh}", "complex_modes.csv").decode().splitlines())
    return np.array([float(row["growth_rate [1/s]"]) + 2j * np.pi * float(row["frequency [Hz]"]) for row in rows_of])


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        found = [modes(folder, rows, False) for rows in ROWS]
        roots = []
        for s in found[-1]:
            near = [(n, root(s * start, 2 * np.pi * n / LENGTH)) for n in range(8) for start in (1, 0.99, 1.01, 1 + 0.01j, 1 - 0.01j)]
            n, exact = min(((n, r) for n, r in near if r is not None), key=lambda item: abs(item[1] - s))
            roots.append((n, exact))
            errors = [np.abs(of_grid / exact - 1).min() for of_grid in (*found[:-1], s)]
            order = np.log2(errors[-2] / errors[-1])
            print(f"n = {n}: {exact.imag / 2e3 / np.pi:8.3f} kHz, decay {-exact.real:10.1f} 1/s, errors " + ", ".join(f"{e:.1e}" for e in errors) + f", order {order:.2f}")
            assert errors[-1] < 1e-2 and 1.8 < order < 2.2, (n, exact, errors)
        assert len(roots) == 8 and {n for n, _ in roots} == {1, 2}, roots  # two of each, along x and against it
        on_mesh = modes(folder, ROWS[0], True)
        assert len(on_mesh) == len(found[0]) and np.abs(np.sort_complex(on_mesh) / np.sort_complex(found[0]) - 1).max() < 1e-7, (on_mesh, found[0])


if __name__ == "__main__":
    main()
