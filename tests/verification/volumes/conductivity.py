"""Conductivity of volumes, of heat or of a current.

Laminates have the closed form on grids, voxels and meshes under PBC and MUBC. Every condition agrees with a finite element code written apart,
in numpy, on a random map of three phases, one of them turned and anisotropic, in 2D and 3D. A checkerboard tends to the geometric mean, and a cubic array of spheres to the series of Rayleigh, McPhedran and McKenzie. Bounds hold. One, two and three
ranks agree, and an ensemble has the mean.
"""

import csv
import tempfile

import h5py
import numpy as np

from macroscopic_loads import close, run

from mesh_files import Box
from scenes import Folder, prm

SEED = 457
BASE = {"Phases/Names": "a, b, c", "Homogenization/Tolerance": 1e-12, "Homogenization/Effective symmetry": "full",
        "Homogenization/Boundary conditions": "KUBC, SUBC, PBC, MUBC", "Homogenization/Effective": "PBC",
        **{f"Phases/{name}/Young modulus": 1e9 for name in "abc"}}
ANGLE = 0.6
K = {"a": [1.0], "b": [20.0], "c": [5.0, 0.3, 2.0]}


def phases(dim):
    """Keys, and tensors [3][dim][dim]."""
    settings = {f"Phases/{name}/Conductivity": ", ".join(map(str, values)) for name, values in K.items()}
    settings |= {"Phases/c/Type": "orthotropic", "Phases/c/Young moduli": "1e9, 1e9, 1e9", "Phases/c/Poisson ratios": "0.2, 0.2, 0.2",
                 "Phases/c/Shear moduli": "4e8, 4e8, 4e8", "Phases/c/Angle": ANGLE}
    R = np.array([[np.cos(ANGLE), -np.sin(ANGLE), 0], [np.sin(ANGLE), np.cos(ANGLE), 0], [0, 0, 1]])
    return settings, np.array([np.eye(dim), 20 * np.eye(dim), (R @ np.diag(K["c"]) @ R.T)[:dim, :dim]])


def settings_of(volume, dim):
    keys = {key: value for key, value in {**BASE, **phases(dim)[0], **volume}.items()}
    keys.pop("Phases/c/Young modulus")
    return keys


def write(folder, name, settings):
    plain = "".join(f"set {key} = {value}\n" for key, value in settings.items() if "/" not in key)
    folder.write(name + ".prm", plain + prm({key: value for key, value in settings.items() if "/" in key}))


def effective(cells, h, tensors):
    """{condition: k} of cells [..][y][x] with edges h, x first, by dense matrices."""
    dim, shape = cells.ndim, cells.shape[::-1]
    nodes = np.arange(np.prod([n + 1 for n in shape])).reshape([n + 1 for n in shape[::-1]])
    corners = np.array(np.meshgrid(*[[0, 1]] * dim, indexing="ij")).reshape(dim, -1)[::-1].T  # x fastest
    gauss = 0.5 + (corners - 0.5) / np.sqrt(3)
    B = []
    for point in gauss:
        factors = np.where(corners == 1, point, 1 - point)
        B.append(np.array([np.where(corners[:, d] == 1, 1, -1) / h[d] * np.prod(np.delete(factors, d, axis=1), axis=1) for d in range(dim)]))
    weight, n = np.prod(h) / len(gauss), nodes.size
    KK, F, unit = np.zeros((n, n)), np.zeros((n, dim)), np.zeros((n, dim))
    of_cells = []
    for place in np.ndindex(cells.shape):
        C = tensors[cells[place]]
        own = np.array([nodes[tuple(np.array(place) + c[::-1])] for c in corners])
        of_cells.append((own, C))
        KK[np.ix_(own, own)] += sum(weight * b.T @ C @ b for b in B)
        F[own] += sum(weight * b.T @ C for b in B)
        unit[own] += sum(weight * b.T for b in B)
    where = np.array(np.unravel_index(np.arange(n), nodes.shape))[::-1].T  # x first
    side = [(where[:, d] == 0) | (where[:, d] == shape[d]) for d in range(dim)]
    volume, found = np.prod(h) * cells.size, {}

    def solve(T, f):
        return T @ np.linalg.lstsq(T.T @ KK @ T, T.T @ f, rcond=1e-13)[0]

    def columns(kept):
        return np.eye(n)[:, kept]

    affine = where * np.array(h)
    periodic = np.zeros((n, n))
    periodic[np.arange(n), nodes[tuple((where % shape).T[::-1])]] = 1
    periodic = periodic[:, periodic.any(axis=0)]
    for condition, T in (("KUBC", columns(~np.any(side, axis=0))), ("PBC", periodic)):
        u = affine + solve(T, -KK @ affine)
        found[condition] = u.T @ KK @ u / volume
    u = solve(np.eye(n), unit)
    found["SUBC"] = np.linalg.inv(u.T @ KK @ u / volume)
    mixed = []
    for d in range(dim):
        u = affine[:, d] + solve(columns(~side[d]), -KK @ affine[:, d])
        mixed.append(u @ KK @ u / volume)
    found["MUBC"] = np.diag(mixed)
    return found


def check_random(folder):
    rng = np.random.default_rng(SEED)
    flat, deep = rng.choice(3, size=(6, 7)), rng.choice(3, size=(3, 4, 5))
    folder.write("cells.txt", "\n".join(" ".join(map(str, row)) for row in flat[::-1]) + "\n")
    np.save(folder("cells.npy"), deep.astype(np.uint8))
    Box([7.0, 6.0], [7, 6], lambda x: "abc"[flat[int(x[1]), int(x[0])]]).write(folder("flat.msh"))
    Box([5.0, 4.0, 3.0], [5, 4, 3], lambda x: "abc"[deep[int(x[2]), int(x[1]), int(x[0])]]).write(folder("deep.msh"))
    plane = {"Grid/Cells": "7, 6", "Grid/Size": "7e-3, 7.8e-3", "Microstructure/Type": "image", "Microstructure/File": "cells.txt",
             "Microstructure/Oblong pixels": "true"}
    volumes = {"grid": (flat, (1e-3, 1.3e-3), plane), "divided": (flat, (1e-3, 1.3e-3), {**plane, "Homogenization/Solver": "divided"}),
               "quads": (flat, (1e-3, 1e-3), {"Mesh/File": "flat.msh", "Mesh/Scale": 1e-3}),
               "voxels": (deep, (1e-3, 1.3e-3, 0.8e-3), {"Dimension": 3, "Grid/Cells": "5, 4, 3", "Grid/Spacing": "1e-3, 1.3e-3, 0.8e-3",
                                                         "Microstructure/Type": "voxels", "Microstructure/File": "cells.npy"}),
               "bricks": (deep, (1e-3,) * 3, {"Dimension": 3, "Mesh/File": "deep.msh", "Mesh/Scale": 1e-3})}
    for name, (cells, h, volume) in volumes.items():
        expected = effective(cells, h, phases(cells.ndim)[1])
        for ranks in (1, 2) if name != "voxels" else (1, 2, 3):
            write(folder, name, settings_of(volume, cells.ndim))
            folder.run(0, "rve_homogenization", name + ".prm", "--output", f"{name}{ranks}", "--quiet", ranks=ranks)
            found = folder.summary(f"{name}{ranks}")
            for condition, k in expected.items():
                close(found["conductivity"][condition], k, 1e-9, f"{name}, {condition}, {ranks} ranks: numpy")
                assert found["conductivity_residual"][condition] < 1e-9
        close(found["conductivity"]["effective"], expected["PBC"], 1e-9, f"{name}: effective")
        with h5py.File(folder(f"{name}1", "rve.h5")) as file:
            gradient, flux = (file[f"conduction/{of}"][()].reshape(cells.size, cells.ndim, cells.ndim) for of in ("gradient/PBC", "flux/SUBC"))
            close(gradient.mean(axis=0), np.eye(cells.ndim), 1e-9, f"{name}: mean gradient")
            close(flux.mean(axis=0), np.eye(cells.ndim), 1e-9, f"{name}: mean flux")
            close(file["conductivity/PBC"][()], expected["PBC"], 1e-9, f"{name}: rve.h5")
            if name != "quads" and name != "bricks":
                tensors = phases(cells.ndim)[1][(cells if cells.ndim == 3 else cells).ravel()]
                close(np.einsum("nij,njk->ik", tensors, gradient) / cells.size, expected["PBC"], 1e-8, f"{name}: mean of k times gradients")


def check_laminates(folder):
    two = {"Phases/Names": "a, b", "Phases/a/Young modulus": 1e9, "Phases/b/Young modulus": 1e9, "Phases/a/Conductivity": 2, "Phases/b/Conductivity": 30,
           "Homogenization/Tolerance": 1e-12, "Homogenization/Boundary conditions": "PBC, MUBC", "Homogenization/Effective": "PBC"}
    for dim, kind in ((2, "cube"), (2, "simplex"), (3, "cube"), (3, "simplex")):
        for axis in range(dim):
            size, name = [5 if d == axis else 2 for d in range(dim)], f"{kind}{dim}{axis}"
            Box([float(n) for n in size], size, lambda x: "ab"[int(x[axis] < 2)], kind).write(folder(name + ".msh"))
            write(folder, name, {**two, "Dimension": dim, "Mesh/File": name + ".msh", "Mesh/Scale": 1e-3})
            folder.run(0, "rve_homogenization", name + ".prm", "--output", name, "--quiet")
            expected = np.diag([1 / (0.6 / 2 + 0.4 / 30) if d == axis else 0.6 * 2 + 0.4 * 30 for d in range(dim)])
            summary = folder.summary(name)
            for condition in ("PBC", "MUBC"):
                close(summary["conductivity"][condition], expected, 1e-10, f"laminate, {name}, {condition}")
            lower, upper = summary["conductivity_bounds"]["wiener"]
            close([lower, upper], [expected.min(initial=99, where=np.eye(dim) > 0), expected.max()], 1e-12, "Wiener's bounds")


def check_contrast(folder):
    """A laminate of 1e-2 and 1e-11, at the tolerance by default: the current across the bad conductor is as accurate as the other."""
    np.save(folder("layers.npy"), np.tile((np.arange(10) < 4).astype(np.uint8), (3, 3, 1)))
    settings = {"Dimension": 3, "Phases/Names": "a, b", "Phases/a/Young modulus": 1e9, "Phases/b/Young modulus": 1e9, "Phases/a/Conductivity": 1e-11,
                "Phases/b/Conductivity": 0.1, "Homogenization/Boundary conditions": "PBC, MUBC", "Homogenization/Effective": "PBC", "Grid/Cells": "10, 3, 3",
                "Grid/Spacing": "1e-3, 1e-3, 1e-3", "Microstructure/Type": "voxels", "Microstructure/File": "layers.npy"}
    write(folder, "contrast", settings)
    folder.run(0, "rve_homogenization", "contrast.prm", "--output", "contrast", "--quiet")
    for condition in ("PBC", "MUBC"):
        k = folder.summary("contrast")["conductivity"][condition]
        close(k[0][0], 1 / (0.6 / 1e-11 + 0.4 / 0.1), 1e-5, f"across a laminate of contrast 1e10, {condition}")
        close(k[1][1], 0.4 * 0.1 + 0.6e-11, 1e-9, "along it")
    write(folder, "beyond", {**settings, "Phases/b/Conductivity": 1})
    assert "round-off decides" in folder.run(2, "rve_homogenization", "beyond.prm", "--output", "beyond")


def check_checkerboard(folder):
    """sqrt(k1 k2), from above."""
    errors = []
    for n in (8, 16, 32):
        board = (np.add.outer(np.arange(2 * n) // n, np.arange(2 * n) // n) % 2)
        folder.write("board.txt", "\n".join(" ".join(map(str, row)) for row in board) + "\n")
        settings = {"Phases/Names": "a, b", "Phases/a/Young modulus": 1e9, "Phases/b/Young modulus": 1e9, "Phases/a/Conductivity": 1,
                    "Phases/b/Conductivity": 4, "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC",
                    "Homogenization/Tolerance": 1e-10, "Grid/Cells": f"{2 * n}, {2 * n}", "Grid/Size": "1e-3, 1e-3", "Microstructure/Type": "image",
                    "Microstructure/File": "board.txt"}
        found = run(folder, "board", settings)
        k, bounds = np.array(found["conductivity"]["PBC"]), found["conductivity_bounds"]["hashin_shtrikman"]
        assert abs(k[0, 0] - k[1, 1]) < 1e-8 and bounds[0] < 2 < bounds[1], (k, bounds)
        close(bounds, [1 + 0.5 / (1 / 3 + 0.25), 4 + 0.5 / (-1 / 3 + 1 / 16)], 1e-12, "bounds of Hashin and Shtrikman in the plane")
        errors.append(k[0, 0] / 2 - 1)
    print("checkerboard: errors", errors, "ratios", np.divide(errors[:-1], errors[1:]))
    # Where four squares meet, T goes with r^s, s = 4 / pi arctan sqrt(k1 / k2), and the energy converges with h^(2 s).
    orders, expected = np.log2(np.divide(errors[:-1], errors[1:])), 8 / np.pi * np.arctan(0.5)
    print("orders", orders, "expected", expected)
    assert errors[2] > 0 and np.abs(orders - expected).max() < 0.02


def check_spheres(folder):
    """A simple cubic array on ever more voxels."""
    share, values = 0.3, []
    for n in (16, 24, 32):
        x = np.stack(np.meshgrid(*[(np.arange(n) + 0.5) / n - 0.5] * 3, indexing="ij"))
        radius = (3 * share / (4 * np.pi)) ** (1 / 3)
        np.save(folder("sphere.npy"), ((x**2).sum(axis=0) < radius**2).astype(np.uint8))
        settings = {"Dimension": 3, "Phases/Names": "a, b", "Phases/a/Young modulus": 1e9, "Phases/b/Young modulus": 1e9, "Phases/a/Conductivity": 1,
                    "Phases/b/Conductivity": 10, "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC",
                    "Homogenization/Tolerance": 1e-6, "Homogenization/Write concentration": "false", "Grid/Cells": f"{n}, {n}, {n}",
                    "Grid/Spacing": ", ".join([str(1e-3 / n)] * 3), "Microstructure/Type": "voxels", "Microstructure/File": "sphere.npy"}
        write(folder, "sphere", settings)
        folder.run(0, "rve_homogenization", "sphere.prm", "--output", "sphere", "--quiet")
        summary = folder.summary("sphere")
        f = summary["phases"][1]["volume_fraction"]
        values.append(summary["conductivity"]["PBC"][0][0] / spheres(f, 10.0) - 1)
    print("spheres: distance from the series", values)
    assert 0 < values[2] < 0.025 and 1.8 < values[0] / values[2] < 2.5  # staircases: first order in the voxels


def spheres(f, ratio):
    """Lord Rayleigh (1892) with the coefficient of McPhedran and McKenzie (1978); what is left out is of the order f^(14/3)."""
    return 1 + 3 * f / ((ratio + 2) / (ratio - 1) - f - 1.305 * (ratio - 1) / (ratio + 4 / 3) * f ** (10 / 3))


def check_ensemble(folder):
    settings = {"Phases/Names": "matrix, fibre", "Phases/matrix/Young modulus": 3e9, "Phases/fibre/Young modulus": 60e9, "Phases/matrix/Conductivity": 1,
                "Phases/fibre/Conductivity": 50, "Grid/Cells": "40, 20", "Grid/Size": "4e-3, 2e-3", "Microstructure/Type": "random fibres",
                "Microstructure/Random fibres/Seed": 5, "Microstructure/Random fibres/Fibre width": 1e-4, "Microstructure/Random fibres/Minimum height": 4e-4,
                "Microstructure/Random fibres/Maximum height": 8e-4, "Microstructure/Random fibres/Area fraction": 0.1,
                "Homogenization/Boundary conditions": "KUBC, SUBC"}
    single = [np.array(run(folder, f"seed{s}", {**settings, "Microstructure/Random fibres/Seed": s})["conductivity"]["effective"]) for s in (5, 6, 7)]
    for ranks in (1, 2):
        found = run(folder, "three", {**settings, "Ensemble/Members": 3}, ranks)["conductivity"]
        close(found["effective"], np.mean(single, axis=0), 1e-10, f"mean of three seeds, {ranks} ranks")
        low, high = (np.linalg.eigvalsh(np.subtract(found["KUBC"], found["SUBC"]))[k] for k in (0, -1))
        assert low > 0 and high < 50, (low, high)
    with open(folder("three1", "conductivity.csv"), encoding="utf-8") as file:
        rows = {row["of"]: row for row in csv.DictReader(file)}
    assert abs(float(rows["effective"]["k_xx"]) / found["effective"][0][0] - 1) < 1e-9
    write(folder, "missing", {**settings, "Phases/matrix/Conductivity": ""})
    assert "give it for all phases or for none" in folder.run(2, "rve_homogenization", "missing.prm", "--output", "missing")


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_random(folder)
        check_laminates(folder)
        check_contrast(folder)
        check_checkerboard(folder)
        check_ensemble(folder)
        check_spheres(folder)


if __name__ == "__main__":
    main()
