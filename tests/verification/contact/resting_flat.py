"""A solid of two phases pressed on a flat at rest, whose friction holds it back: Coulomb's law at every node, from the files alone, and a search that
takes no longer on finer grids; a body whose nodes all slip rests by its friction alone.

    resting_flat.py <folder with the programs>
"""

import csv
import tempfile

import numpy as np

from scenes import Folder, prm

PRESSURE, SIDE = 1e6, 0.016  # Pa, m
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


def check(folder, voxels, ranks, mu, **more):
    """Tractions (Pa) of the nodes by rows of the flat, and the share of those that stick. The body has SIDE along x; a picture is plane."""
    cells, dim = voxels.shape[::-1], voxels.ndim
    name, rve = f"{dim}d-{cells[0]}-{ranks}-{mu}", f"rve{dim}d-{cells[0]}"
    kind, file = ("voxels", "map.npy") if dim == 3 else ("image", "map.txt")
    if dim == 3:
        np.save(folder(file), voxels)
    else:
        np.savetxt(folder(file), voxels, fmt="%d")
    folder.write("rve.prm", f"set Dimension = {dim}\n" + PHASES + prm({
        "Grid/Cells": ", ".join(map(str, cells)), "Grid/Spacing": SIDE / cells[0], "Microstructure/Type": kind, "Microstructure/File": file,
        "Homogenization/Boundary conditions": "KUBC", "Homogenization/Effective": "KUBC"}))
    folder.run(0, "rve_homogenization", "rve.prm", "--output", rve)
    folder.write("static.prm", f"set Dimension = {dim}\n" + prm({
        "Analysis": "static contact", "Body/RVE file": f"{rve}/rve.h5", "Body/Material": "heterogeneous", "Flat/Velocity": 0,
        "Supports/Top/Pressure": PRESSURE, "Friction/Coefficient from": "constant", "Friction/Coefficient": mu, **more}))
    folder.run(0, "contact_dynamics", "static.prm", "--output", name, ranks=ranks)
    iterations = folder.summary(name)["iterations"]
    assert iterations <= MOST_ITERATIONS, (name, iterations)
    with open(folder(name, "static_contact.csv"), newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    pressure = np.array([float(row["pressure [Pa]"]) for row in rows])
    shear = np.array([[float(row[f"shear_traction{axis} [Pa]"]) for axis in ("", "_y")[:dim - 1]] for row in rows])
    slip = np.array([[float(row[f"displacement_{axis} [m]"]) for axis in "xy"[:dim - 1]] for row in rows])
    state = np.array([row["state"] for row in rows])
    size, sliding, stuck = np.linalg.norm(shear, axis=1), state == "slip", state == "stick"
    assert len(rows) == np.prod(np.add(cells[:-1], 1)) and (pressure >= 0).all() and sliding.sum() > 0.2 * len(rows), sliding.sum()
    assert (size <= mu * pressure + 1e-5 * PRESSURE).all(), (size - mu * pressure).max()
    assert (slip[stuck] == 0).all()
    # What slips has all friction, against its displacement.
    law = -mu * pressure[sliding, None] * slip[sliding] / np.linalg.norm(slip[sliding], axis=1)[:, None]
    error = np.linalg.norm(law - shear[sliding], axis=1).sum() / (mu * pressure[sliding]).sum()
    assert error <= max(1e-6, 1e-8 / mu), error  # the tolerance is a share of the normal force
    print(f"{name} ranks: {iterations} iterations, {stuck.sum()} nodes stick, {sliding.sum()} slip, friction off by {error:.1e}")
    return pressure, shear, stuck.sum() / len(rows)


def check_rest(folder, n, ranks):
    """Without a platen, on a flat so slippery that nothing sticks: forces and the moment about the normal are in balance."""
    pressure, shear, sticks = check(folder, spheres(n), ranks, 0.01, **{"Supports/Top/Kind": "pressure"})
    assert sticks == 0, sticks
    trapezoid = np.full(n + 1, SIDE / n)
    trapezoid[[0, -1]] /= 2
    force = shear.reshape(n + 1, n + 1, 2) * np.outer(trapezoid, trapezoid)[..., None]  # [y][x]
    y, x = np.meshgrid(*2 * [np.linspace(0, SIDE, n + 1)], indexing="ij")
    carried = 0.01 * PRESSURE * SIDE**2
    assert np.abs(force.sum((0, 1))).max() <= 1e-5 * carried, force.sum((0, 1)) / carried
    assert abs((x * force[..., 1] - y * force[..., 0]).sum()) <= 1e-5 * carried * SIDE
    assert np.linalg.norm(force, axis=2).sum() > 0.9 * carried
    return pressure, shear


def check_line(shear, sticks, nodes_of_line, mu):
    """Of a body that friction along x holds: one line of nodes sticks, and the forces are in balance."""
    force = shear.reshape(nodes_of_line, -1)
    force[:, [0, -1]] /= 2
    assert 0 < sticks <= 1 / force.shape[1] and abs(force.sum()) <= 1e-5 * np.abs(force).sum(), (mu, sticks, force.sum())


def check_free(folder):
    """Nothing but friction along x holds a strip and a plane body: of the nodes that all would slip, those of one line stick."""
    voxels = (np.random.default_rng(3).random((8, 1, 12)) < 0.3).astype(np.uint8)
    for mu in (0.003, 0.03):
        _, shear, sticks = check(folder, voxels, 1, mu, **{"Supports/Top/Kind": "pressure", "Supports/Front/Held": "u_y", "Supports/Back/Held": "u_y"})
        check_line(shear[:, 0], sticks, 2, mu)
        _, shear, sticks = check(folder, voxels[:, 0], 1, mu, **{"Supports/Top/Kind": "pressure"})
        check_line(shear, sticks, 1, mu)


def main():
    platen = {"Supports/Top/Kind": "platen"}
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        for n in (8, 16):
            assert check(folder, spheres(n), 1, 0.3, **platen)[2] > 0.2
        one, three = (check(folder, spheres(12), ranks, 0.3, **platen)[:2] for ranks in (1, 3))
        for pair in ((one, three), (check_rest(folder, 10, 1), check_rest(folder, 10, 3))):
            for a, b in zip(*pair):
                assert np.abs(a - b).max() <= 1e-4 * np.abs(a).max(), np.abs(a - b).max()
        check_free(folder)


if __name__ == "__main__":
    main()
