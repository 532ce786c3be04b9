"""A solid of two phases pressed on a flat at rest, whose friction holds it back: Coulomb's law at every node, from the files alone, and a search that
takes no longer on finer grids.

    resting_flat.py <folder with the programs>
"""

import csv
import tempfile

import numpy as np

from scenes import Folder, prm

MU = 0.3
PHASES = prm({"Phases/Names": "matrix, fibre", "Phases/matrix/Young modulus": 3e9, "Phases/matrix/Poisson ratio": 0.35, "Phases/matrix/Density": 1200,
              "Phases/fibre/Young modulus": 24e9, "Phases/fibre/Poisson ratio": 0.2, "Phases/fibre/Density": 2000})
# 196 iterations were needed on 16 cells a side, 372 on 24, when friction turned without Newton's method.
MOST_ITERATIONS = 30


def spheres(n):
    """Twelve overlapping spheres [z][y][x] in a cube of n cells a side, the same for every n."""
    generator = np.random.default_rng(1)
    middles = (np.indices((n, n, n)).reshape(3, -1).T + 0.5) / n
    inside = np.zeros(n**3, bool)
    for _ in range(12):
        inside |= ((middles - generator.random(3)) ** 2).sum(1) < 0.16**2
    return inside.reshape(n, n, n).astype(np.uint8)


def check(folder, n, ranks):
    name = f"{n}-{ranks}"
    np.save(folder("map.npy"), spheres(n))
    folder.write("rve.prm", "set Dimension = 3\n" + PHASES + prm({
        "Grid/Cells": f"{n}, {n}, {n}", "Grid/Size": "0.016, 0.016, 0.016", "Microstructure/Type": "voxels", "Microstructure/File": "map.npy",
        "Homogenization/Boundary conditions": "KUBC", "Homogenization/Effective": "KUBC"}))
    folder.run(0, "rve_homogenization", "rve.prm", "--output", f"rve{n}")
    folder.write("static.prm", "set Dimension = 3\n" + prm({
        "Analysis": "static contact", "Body/RVE file": f"rve{n}/rve.h5", "Body/Material": "heterogeneous", "Flat/Velocity": 0, "Top/Kind": "platen",
        "Top/Pressure": 1e6, "Friction/Coefficient from": "constant", "Friction/Coefficient": MU}))
    folder.run(0, "contact_dynamics", "static.prm", "--output", name, ranks=ranks)
    iterations = folder.summary(name)["iterations"]
    assert iterations <= MOST_ITERATIONS, (name, iterations)
    with open(folder(name, "static_contact.csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    pressure = np.array([float(row["pressure [Pa]"]) for row in rows])
    shear = np.array([[float(row[f"shear_traction{axis} [Pa]"]) for axis in ("", "_y")] for row in rows])
    slip = np.array([[float(row[f"displacement_{axis} [m]"]) for axis in "xy"] for row in rows])
    state = np.array([row["state"] for row in rows])
    size, sliding, stuck = np.linalg.norm(shear, axis=1), state == "slip", state == "stick"
    assert len(rows) == (n + 1) ** 2 and stuck.sum() > 0.2 * len(rows) and sliding.sum() > 0.2 * len(rows), (stuck.sum(), sliding.sum())
    assert (pressure >= 0).all() and abs(pressure[stuck].max()) > 0
    assert (size <= MU * pressure + 1e-5 * 1e6).all(), (size - MU * pressure).max()
    assert np.abs(slip[stuck]).max() == 0
    # What slips has all friction, against its displacement.
    law = -MU * pressure[sliding, None] * slip[sliding] / np.linalg.norm(slip[sliding], axis=1)[:, None]
    error = np.linalg.norm(law - shear[sliding], axis=1).sum() / (MU * pressure[sliding]).sum()
    assert error <= 1e-6, error
    print(f"{name} ranks: {iterations} iterations, {stuck.sum()} nodes stick, {sliding.sum()} slip, friction off by {error:.1e}")
    return pressure, shear


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check(folder, 8, 1)
        check(folder, 16, 1)
        one, two = check(folder, 12, 1), check(folder, 12, 3)
        for a, b in zip(one, two):
            assert np.abs(a - b).max() <= 1e-4 * np.abs(a).max(), np.abs(a - b).max()


if __name__ == "__main__":
    main()
