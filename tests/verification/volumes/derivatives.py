"""Derivatives of the effective stiffness with respect to the constants of phases, their uncertainty, and loss factors.

Derivatives of every condition, on plane grids with each solver, voxels and meshes of degree 1 and 2, with isotropic, nearly incompressible,
turned orthotropic and full phases, equal central differences of two runs whose constants all change a little along a random direction. Of
a laminate, the loss factor is that of the complex stiffness up to the square of the loss factors, and deviations of one constant are those
of runs with it. One, two and three ranks agree.
"""

import csv
import tempfile

import numpy as np

from macroscopic_loads import close, run

from mesh_files import Box
from scenes import Folder

SEED = 45
VOXELS = np.random.default_rng(SEED).choice(3, size=(3, 4, 5))
CONDITIONS = "KUBC, SUBC, PBC, MUBC"
COMMON = {"Homogenization/Boundary conditions": CONDITIONS, "Homogenization/Tolerance": 1e-12, "Phases/Names": "soft, wood, crystal",
          "Homogenization/Effective symmetry": "full", "Homogenization/Derivatives": "true"}


def constants(dim, ratio):
    """{phase: (type, {constant: value}, other keys)} and how keys take the values."""
    n, rng = 3 * dim - 3, np.random.default_rng(SEED)
    full = np.diag([30e9] * dim + [9e9] * (n - dim)) + 2e9 * rng.uniform(-1, 1, (n, n))
    full = (full + full.T) / 2
    entries = {f"D{i + 1}{j + 1}": full[i, j] for i in range(n) for j in range(i, n)}
    wood = {"E1": 60e9, "E2": 15e9, "E3": 25e9, "nu12": 0.25, "nu13": 0.2, "nu23": 0.15, "G12": 8e9, "G13": 6e9, "G23": 5e9}
    return {"soft": ("isotropic", {"E": 10e9, "nu": ratio}, {}),
            "wood": ("orthotropic", wood, {"Angle": 0.4} if dim == 2 else {"Euler angles": "20, 30, 50"}), "crystal": ("stiffness", entries, {})}


def keys(kind, values):
    numbers = list(values.values())
    if kind == "isotropic":
        return {"Young modulus": numbers[0], "Poisson ratio": numbers[1]}
    lists = {"Stiffness": numbers} if kind == "stiffness" else dict(zip(("Young moduli", "Poisson ratios", "Shear moduli"),
                                                                       (numbers[:3], numbers[3:6], numbers[6:])))
    return {key: ", ".join(map(repr, map(float, value))) for key, value in lists.items()}


def settings_of(phases, volume):
    settings = {**volume, **COMMON}
    for name, (kind, values, more) in phases.items():
        settings |= {f"Phases/{name}/{key}": value for key, value in {"Type": kind, **keys(kind, values), **more}.items()}
    return settings


def moved(phases, step):
    """All constants changed along a random direction by @p step of their values."""
    rng = np.random.default_rng(SEED + 1)
    return {name: (kind, {c: v * (1 + step * rng.uniform(0.3, 1)) for c, v in values.items()}, more)
            for name, (kind, values, more) in phases.items()}


def table(folder, name):
    with open(folder(name, "derivatives.csv"), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def check_differences(folder, what, dim, volume, ratio=0.3, ranks=(1,)):
    phases, n, step = constants(dim, ratio), 3 * dim - 3, 2e-5
    upper, lower = [run(folder, f"{what}{sign}", settings_of(moved(phases, sign * step), volume))["stiffness"] for sign in (1, -1)]
    direction = moved(phases, 1.0)
    for of_ranks in ranks:
        run(folder, what, settings_of(phases, volume), of_ranks)
        for condition in CONDITIONS.split(", "):
            change = np.zeros((n, n))
            for row in table(folder, f"{what}{of_ranks}"):
                if row["of"] == condition:
                    there, here = (of[row["phase"]][1][row["constant"]] for of in (direction, phases))
                    assert abs(float(row["value"]) - here) <= 1e-9 * abs(here), row
                    change[np.triu_indices(n)] += [(there - here) * float(row[f"dD{i + 1}{j + 1} [Pa/unit]"])
                                                   for i in range(n) for j in range(i, n)]
            expected = np.triu(np.subtract(upper[condition], lower[condition])) / (2 * step)
            close(change, expected, 1e-6, f"{what}, {condition}, {of_ranks} ranks: derivatives and differences")


def check_kinds(folder):
    folder.write("cells.txt", "\n".join(" ".join(map(str, row)) for row in np.vstack(VOXELS)) + "\n")
    plane = {"Grid/Cells": "5, 12", "Grid/Size": "5e-3, 9e-3", "Microstructure/Type": "image", "Microstructure/File": "cells.txt",
             "Microstructure/Oblong pixels": "true"}
    for solver, ranks in (("multigrid", (1, 2)), ("divided", (1, 3)), ("ml", (1, 2))):
        check_differences(folder, solver, 2, {**plane, "Homogenization/Solver": solver}, 0.49, ranks)
    np.save(folder("cells.npy"), VOXELS.astype(np.uint8))
    voxels = {"Dimension": 3, "Grid/Cells": "5, 4, 3", "Grid/Spacing": "1e-3, 1.3e-3, 0.8e-3", "Microstructure/Type": "voxels",
              "Microstructure/File": "cells.npy"}
    check_differences(folder, "voxels", 3, voxels, ranks=(1, 2, 3))
    check_differences(folder, "incompressible", 3, voxels, 0.49)
    np.save(folder("angles.npy"), np.random.default_rng(SEED).uniform((0, 0, 0), (360, 180, 360), (3, 4, 5, 3)))
    check_differences(folder, "grains", 3, {**voxels, "Microstructure/Orientation file": "angles.npy"}, ranks=(1, 2))
    for dim, kind, degree in ((2, "cube", 1), (2, "simplex", 2), (3, "cube", 1), (3, "simplex", 2)):
        size, name = (5, 4, 3)[:dim] if degree == 1 else (3, 2, 2)[:dim], f"{kind}{dim}"
        Box([float(m) for m in size], size, lambda x: ("soft", "wood", "crystal")[VOXELS[tuple(np.resize(np.floor(x).astype(int), 3) % 3)]],
            kind).write(folder(name + ".msh"))
        check_differences(folder, name, dim, {"Dimension": dim, "Mesh/File": name + ".msh", "Mesh/Scale": 1e-3, "Mesh/Degree": degree},
                          ranks=(1, 2) if degree == 1 else (1,))


LAYERS = {"Grid/Cells": "10, 2", "Grid/Size": "1e-3, 2e-4", "Microstructure/Type": "image", "Microstructure/File": "layers.txt",
          "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC", "Homogenization/Tolerance": 1e-12,
          "Phases/Names": "matrix, fibre", "Phases/matrix/Young modulus": 30e9, "Phases/fibre/Young modulus": 240e9}


def check_laminate(folder):
    """A tenth of layers across x, whose D11 is 1 / mean of 1 / C11."""
    folder.write("layers.txt", "1 0 0 0 0 0 0 0 0 0\n" * 2)
    loss = {"fibre": 0.002, "matrix": 0.02}
    found = run(folder, "loss", {**LAYERS, **{f"Phases/{name}/Loss factor": eta for name, eta in loss.items()}})["varied"]["D11"]
    per_modulus = 0.8 / (1.2 * 0.6)  # C11 / E
    complex_D = 1 / sum(f / (per_modulus * E * (1 + 1j * eta)) for f, E, eta in ((0.1, 240e9, 0.002), (0.9, 30e9, 0.02)))
    factor = found["imaginary"] / found["value"]
    close(factor, 0.01975342, 1e-6, "loss factor of a laminate")
    close(factor, complex_D.imag / complex_D.real, loss["matrix"]**2, "that of the complex stiffness")
    assert "derivatives" not in found and "standard_deviation" not in found

    deviation = 0.03
    found = run(folder, "uncertain", {**LAYERS, "Phases/matrix/Relative deviation": f"{deviation}, 0"})["varied"]
    step = 1e-4
    ends = [run(folder, f"moved{sign}", {**LAYERS, "Phases/matrix/Young modulus": 30e9 * (1 + sign * step)}) for sign in (1, -1)]
    for name in ("E_x", "E_y", "nu_xy", "G_xy"):
        slope = np.subtract(*(end["engineering_constants"][name] for end in ends)) / (2 * step)
        close(found[name]["standard_deviation"], deviation * abs(slope), 1e-6, f"standard deviation of {name}")
        assert found[name]["largest_contribution"] == "matrix E", found[name]


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_laminate(folder)
        check_kinds(folder)


if __name__ == "__main__":
    main()
