"""Volumes of voxels against a finite element code written apart, in scipy, and against the plane grid.

Q1 bricks with 2x2x2 Gauss points, nx, ny and nz all different and cells that are no cubes, so that every mix-up of axes shows.
KUBC, SUBC and PBC on one, two and three ranks: all 36 entries agree to 1e-10 of the largest and the concentration tensors of all cells
to 1e-8; the stiffness orders KUBC >= PBC >= SUBC.
One layer of voxels has the plane entries of the grid in 2D (PBC, to 1e-10; under KUBC both faces of the layer are held, so all its
nodes are), a laminate the exact stiffness (1e-9). What is no array of voxels is refused before anything is computed.
"""

import os
import tempfile

import h5py
import numpy as np

from brick_elements import PAIRS, effective
from scenes import Folder, prm

SEED = 4711
CONDITIONS = ("KUBC", "SUBC", "PBC")
MODULI = ((30e9, 0.3), (240e9, 0.2))  # Pa, -


def isotropic(young, poisson):
    lame, shear = young * poisson / (1 + poisson) / (1 - 2 * poisson), young / 2 / (1 + poisson)
    D = np.diag([2 * shear] * 3 + [shear] * 3)
    D[:3, :3] += lame
    return D


STIFFNESS = np.array([isotropic(*m) for m in MODULI])


def settings_of(phases, h, conditions=CONDITIONS):
    settings = {"Phases/Names": "soft, stiff", "Homogenization/Boundary conditions": ", ".join(conditions),
                "Homogenization/Effective": conditions[-1], "Homogenization/Tolerance": 1e-12,
                "Grid/Cells": ", ".join(map(str, phases.shape[::-1])),
                "Grid/Size": ", ".join(str(m * e) for m, e in zip(phases.shape[::-1], h))}
    for name, (young, poisson) in zip(("soft", "stiff"), MODULI):
        settings |= {f"Phases/{name}/Young modulus": young, f"Phases/{name}/Poisson ratio": poisson}
    return settings


def run(folder, phases, h, conditions=CONDITIONS, ranks=1, **more):
    """Summary of a run on voxels."""
    np.save(folder("voxels.npy"), phases)
    folder.write("rve.prm", prm({"Dimension": 3, "Microstructure/Type": "voxels", "Microstructure/File": "voxels.npy",
                                 **settings_of(phases, h, conditions), **more}))
    folder.run(0, "rve_homogenization", "rve.prm", "--output", f"rve{ranks}", "--quiet", ranks=ranks)
    return {name: np.array(D) for name, D in folder.summary(f"rve{ranks}")["stiffness"].items() if D is not None}


def close(found, expected, tolerance, what):
    error = np.abs(found - expected).max() / np.abs(expected).max()
    print(f"{what:40s} {error:.1e}")
    assert error < tolerance, f"{what}: {found} instead of {expected}"


def check_random(folder):
    h = (1e-3, 0.7e-3, 1.4e-3)
    phases = (np.random.default_rng(SEED).random((6, 5, 4)) < 0.4).astype(np.uint8)
    expected = {condition: effective(phases, STIFFNESS, h, condition) for condition in CONDITIONS}
    for ranks in (1, 2, 3):
        found = run(folder, phases, h, ranks=ranks)
        for condition in CONDITIONS:
            D, tensors = expected[condition]
            close(found[condition], D, 1e-10, f"{condition}, {ranks} ranks")
            with h5py.File(folder(f"rve{ranks}", "rve.h5")) as file:
                name = "/stress_concentration/" if condition == "SUBC" else "/concentration/"
                close(file[name + condition][...], tensors, 1e-8, f"tensors of {condition}, {ranks} ranks")
    D = {name: 0.5 * (found[name] + found[name].T) for name in CONDITIONS}
    for upper, lower in (("KUBC", "PBC"), ("PBC", "SUBC")):
        smallest = np.linalg.eigvalsh(D[upper] - D[lower]).min()
        assert smallest > -1e-9 * np.abs(D[upper]).max(), f"{upper} - {lower} has the eigenvalue {smallest}"
    with h5py.File(folder("rve1", "rve.h5")) as file:
        assert file.attrs["dim"] == 3 and (file["phase/id"][...] == phases).all(), "phase/id is not the array"


def check_plane(folder):
    """One layer: strains in the plane have the plane stiffness."""
    h = (1e-3, 0.7e-3, 1.4e-3)
    phases = (np.random.default_rng(SEED).random((1, 7, 9)) < 0.4).astype(np.int32)
    found = run(folder, phases, h, ("PBC",))["PBC"]
    np.savetxt(folder("map.txt"), phases[0][::-1], fmt="%d")
    folder.write("plane.prm", prm({**settings_of(phases[0], h, ("PBC",)), "Microstructure/Type": "image", "Microstructure/File": "map.txt",
                                   "Microstructure/Oblong pixels": "true"}))
    folder.run(0, "rve_homogenization", "plane.prm", "--output", "plane", "--quiet")
    plane = np.array(folder.summary("plane")["stiffness"]["PBC"])
    close(found[np.ix_([0, 1, 5], [0, 1, 5])], plane, 1e-10, "one layer against the plane, PBC")


def check_laminate(folder):
    """Layers across each axis: the stress across them and the strains along them are uniform."""
    for axis in range(3):
        phases = np.zeros((3, 4, 5), np.uint8)
        np.moveaxis(phases, 2 - axis, 0)[1] = 1
        f = 1 / phases.shape[2 - axis]
        across = [row for row, pair in enumerate(PAIRS) if axis in pair]
        along = [row for row in range(6) if row not in across]
        share = (1 - f, f)
        mean = lambda values: sum(s * v for s, v in zip(share, values))  # noqa: E731
        inverse = [np.linalg.inv(D[np.ix_(across, across)]) for D in STIFFNESS]
        A = np.linalg.inv(mean(inverse))
        coupling = [i @ D[np.ix_(across, along)] for i, D in zip(inverse, STIFFNESS)]
        expected = np.zeros((6, 6))
        expected[np.ix_(across, across)] = A
        expected[np.ix_(across, along)] = A @ mean(coupling)
        expected[np.ix_(along, across)] = (A @ mean(coupling)).T
        expected[np.ix_(along, along)] = mean([D[np.ix_(along, along)] - D[np.ix_(along, across)] @ c for D, c in zip(STIFFNESS, coupling)]) \
            + mean(coupling).T @ A @ mean(coupling)
        close(run(folder, phases, (1e-3, 2e-3, 1.5e-3), ("PBC",))["PBC"], expected, 1e-9, "laminate across " + "xyz"[axis])


def check_refusals(folder):
    good = np.zeros((4, 3, 2), np.uint8)
    good[1:] = 1
    h = (1e-3, 1e-3, 1e-3)
    for array, more, words in (
            (good.astype(float), {}, ["<f8", "whole numbers"]),
            (good[0], {}, ["three axes"]),
            (good.transpose(), {}, ["Grid/Cells", "[z][y][x]", "set Grid/Cells = 4, 3, 2"]),
            (2 * good, {"Microstructure/Image values": "0, 1"}, ["value 2", "[1][0][0]"]),
            (np.arange(24).reshape(4, 3, 2), {}, ["24 different values"]),
            (good, {"Grid/Cells": "2, 3"}, ["Grid/Cells", "Dimension is 3"]),
            (good, {"Grid/Size": "0.1, 0.1"}, ["Grid/Size", "Dimension is 3"]),
            (good, {"Dimension": 2, "Grid/Cells": "2, 3", "Grid/Size": "0.1, 0.1"}, ["Type", "Dimension = 3"]),
            (good, {"Homogenization/Solver": "jacobi"}, ["Solver", "multigrid"])):
        np.save(folder("bad.npy"), array)
        folder.write("bad.prm", prm({"Dimension": 3, **settings_of(good, h), "Microstructure/Type": "voxels",
                                     "Microstructure/File": "bad.npy", **more}))
        said = folder.run(2, "rve_homogenization", "bad.prm", "--output", "bad", "--quiet")
        assert all(word in said for word in words) and not os.path.exists(folder("bad", "rve.h5")), f"{words} not in: {said}"
    np.save(folder("bad.npy"), good)
    with open(folder("bad.npy"), "r+b") as file:
        file.truncate(os.path.getsize(folder("bad.npy")) - 1)
    folder.write("bad.prm", prm({"Dimension": 3, **settings_of(good, h), "Microstructure/Type": "voxels", "Microstructure/File": "bad.npy"}))
    assert "header states" in folder.run(2, "rve_homogenization", "bad.prm", "--output", "bad", "--quiet")


def main():
    print("seed", SEED)
    with tempfile.TemporaryDirectory() as path:
        for check in (check_refusals, check_laminate, check_plane, check_random):
            check(Folder(path))


main()
