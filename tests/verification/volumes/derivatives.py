"""Derivatives of the effective stiffness with respect to the constants of phases, their uncertainty, and loss factors.

Derivatives of every condition, on plane grids with each solver, voxels and meshes of degree 1 and 2, with isotropic, nearly incompressible,
turned orthotropic and full phases, equal central differences of two runs whose constants all change a little along a random direction. Of
a laminate, the loss factor is that of the complex stiffness up to the square of the loss factors, and deviations of one constant are those
of runs with it. Complex stiffnesses are those of complex matrices, whatever the loss factors. One, two and three ranks agree.
"""

import csv
import tempfile

import numpy as np

import independent_finite_elements as plane
from macroscopic_loads import close, run

from mesh_files import Box
from scenes import Folder, prm

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


def plane_volume(folder):
    """Keys of the grid of all voxels in a plane, whose picture is written."""
    folder.write("cells.txt", "\n".join(" ".join(map(str, row)) for row in np.vstack(VOXELS)) + "\n")
    return {"Grid/Cells": "5, 12", "Grid/Size": "5e-3, 9e-3", "Microstructure/Type": "image", "Microstructure/File": "cells.txt",
            "Microstructure/Oblong pixels": "true"}


def voxel_volume(folder):
    """Keys of the voxels, whose file is written."""
    np.save(folder("cells.npy"), VOXELS.astype(np.uint8))
    return {"Dimension": 3, "Grid/Cells": "5, 4, 3", "Grid/Spacing": "1e-3, 1.3e-3, 0.8e-3", "Microstructure/Type": "voxels",
            "Microstructure/File": "cells.npy"}


def box_of_voxels(size, kind):
    """Box of unit cells with the phases of the voxels."""
    return Box([float(m) for m in size], size, lambda x: ("soft", "wood", "crystal")[VOXELS[tuple(np.resize(np.floor(x).astype(int), 3) % 3)]], kind)


def check_kinds(folder):
    plane = plane_volume(folder)
    for solver, ranks in (("multigrid", (1, 2)), ("divided", (1, 3)), ("ml", (1, 2))):
        check_differences(folder, solver, 2, {**plane, "Homogenization/Solver": solver}, 0.49, ranks)
    voxels = voxel_volume(folder)
    check_differences(folder, "voxels", 3, voxels, ranks=(1, 2, 3))
    check_differences(folder, "incompressible", 3, voxels, 0.49)
    np.save(folder("angles.npy"), np.random.default_rng(SEED).uniform((0, 0, 0), (360, 180, 360), (3, 4, 5, 3)))
    check_differences(folder, "grains", 3, {**voxels, "Microstructure/Orientation file": "angles.npy"}, ranks=(1, 2))
    for dim, kind, degree in ((2, "cube", 1), (2, "simplex", 2), (3, "cube", 1), (3, "simplex", 2)):
        size, name = (5, 4, 3)[:dim] if degree == 1 else (3, 2, 2)[:dim], f"{kind}{dim}"
        box_of_voxels(size, kind).write(folder(name + ".msh"))
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

    for fibre, matrix, tolerance in ((0.002, 0.02, 1e-9), (0.05, 1.0, 1e-6)):
        keys_of_loss = {"Phases/fibre/Loss factor": fibre, "Phases/matrix/Loss factor": matrix}
        complex_D = 1 / sum(f / (per_modulus * E * (1 + 1j * eta)) for f, E, eta in ((0.1, 240e9, fibre), (0.9, 30e9, matrix)))
        found = run(folder, "complex", {**LAYERS, **keys_of_loss, "Homogenization/Loss": "complex"})["varied"]["D11"]
        close(found["real"] + 1j * found["imaginary"], complex_D, tolerance, f"complex stiffness of a laminate, loss factor {matrix}")
    first = run(folder, "first", {**LAYERS, **keys_of_loss})
    assert any("set Homogenization/Loss = complex" in warning for warning in first["warnings"]), first["warnings"]

    deviation = 0.03
    found = run(folder, "uncertain", {**LAYERS, "Phases/matrix/Relative deviation": f"{deviation}, 0"})["varied"]
    step = 1e-4
    ends = [run(folder, f"moved{sign}", {**LAYERS, "Phases/matrix/Young modulus": 30e9 * (1 + sign * step)}) for sign in (1, -1)]
    for name in ("E_x", "E_y", "nu_xy", "G_xy"):
        slope = np.subtract(*(end["engineering_constants"][name] for end in ends)) / (2 * step)
        close(found[name]["standard_deviation"], deviation * abs(slope), 1e-6, f"standard deviation of {name}")
        assert found[name]["largest_contribution"] == "matrix E", found[name]
    for deviations, ratio, words in (("0.03, 0.01", 0, "constant nu, which is 0"), ("0.03, 0.01, 0", 0.2, "has 3 numbers")):
        folder.write("refused.prm", prm({**LAYERS, "Phases/matrix/Poisson ratio": ratio, "Phases/matrix/Relative deviation": deviations}))
        said = folder.run(2, "rve_homogenization", "refused.prm", "--validate")
        assert words in said, said


def complex_effective(phases, C, condition):
    """Of a map of isotropic phases with complex stiffnesses, by dense matrices."""
    K = np.zeros((plane.DOFS.max() + 1,) * 2, complex)
    cells = [sum(B.T @ D @ B for B in plane.GAUSS) * plane.HX * plane.HY / 4 for D in C]
    for dofs, phase in zip(plane.DOFS, phases):
        K[np.ix_(dofs, dofs)] += cells[phase]
    x, y = plane.I * plane.HX, plane.J * plane.HY
    affine = np.zeros((len(K), 3))
    affine[0::2], affine[1::2] = np.stack([x, 0 * x, y / 2], axis=1), np.stack([0 * x, y, x / 2], axis=1)
    T = plane.columns(~np.repeat(plane.BORDER, 2))
    if condition == "PBC":
        T = plane.columns(np.repeat((plane.I < plane.NX) & (plane.J < plane.NY), 2))
        T = T[(2 * plane.NODES[plane.J % plane.NY, plane.I % plane.NX][:, None] + np.arange(2)).ravel()]
        T = T[:, 2:]
    u = affine - T @ np.linalg.solve(T.T @ K @ T, T.T @ K @ affine)
    return u.T @ K @ u / (plane.NX * plane.HX * plane.NY * plane.HY)


def check_complex(folder):
    """A random map against complex matrices; phases with one loss factor have it together, in every kind of volume."""
    phases = np.random.default_rng(SEED).choice(3, size=(plane.NY, plane.NX))
    E, nu, eta = np.array([30e9, 240e9, 2e9]), np.array([0.3, 0.2, 0.4]), np.array([0.1, 0.01, 0.2])
    lame, shear = E * nu / (1 + nu) / (1 - 2 * nu), E / 2 / (1 + nu)
    C = [(1 + 1j * e) * np.array([[m + 2 * g, m, 0], [m, m + 2 * g, 0], [0, 0, g]]) for m, g, e in zip(lame, shear, eta)]
    folder.write("random.txt", "\n".join(" ".join(map(str, row)) for row in phases[::-1]) + "\n")
    settings = {"Grid/Cells": f"{plane.NX}, {plane.NY}", "Grid/Size": f"{plane.NX * plane.HX}, {plane.NY * plane.HY}", "Microstructure/Type": "image",
                "Microstructure/File": "random.txt", "Microstructure/Oblong pixels": "true", "Phases/Names": "a, b, c", "Homogenization/Loss": "complex",
                "Homogenization/Tolerance": 1e-12, "Homogenization/Effective symmetry": "full"}
    for name, e, n, loss in zip("abc", E, nu, eta):
        settings |= {f"Phases/{name}/Young modulus": e, f"Phases/{name}/Poisson ratio": n, f"Phases/{name}/Loss factor": loss}
    entries = [(i, j) for i in range(3) for j in range(i, 3)]
    for solver, ranks in (("multigrid", 1), ("multigrid", 2), ("divided", 3), ("ml", 2)):
        for condition in ("KUBC", "PBC"):
            found = run(folder, "lossy", {**settings, "Homogenization/Solver": solver, "Homogenization/Boundary conditions": condition,
                                          "Homogenization/Effective": condition}, ranks)["varied"]
            numbers = [found[f"D{i + 1}{j + 1}"]["real"] + 1j * found[f"D{i + 1}{j + 1}"]["imaginary"] for i, j in entries]
            expected = complex_effective(phases.ravel(), C, condition)
            close(numbers, [expected[place] for place in entries], 5e-6, f"complex stiffness, {solver}, {condition}, {ranks} ranks: numpy")
    strong = {**settings, "Phases/c/Loss factor": 0.8, "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC"}
    lossy = run(folder, "strong", strong)
    exact = complex_effective(phases.ravel(), [*C[:2], C[2] * (1 + 0.8j) / (1 + 0.2j)], "PBC")[0, 0]
    error = abs((lossy["varied"]["D11"]["real"] + 1j * lossy["varied"]["D11"]["imaginary"]) / exact - 1)
    print(f"loss factor 0.8: error {error:.1e}, {lossy['warnings'][-1]}")
    told = [float(warning.split("off by ")[1].split(" %")[0]) for warning in lossy["warnings"] if "complex stiffness may be off" in warning]
    assert error < 5e-3 and error < told[0] / 100
    S = np.linalg.inv(expected)
    close(found["G_xy"]["real"] + 1j * found["G_xy"]["imaginary"], 1 / S[2, 2], 5e-6, "complex shear modulus")
    np.save(folder("cells.npy"), VOXELS.astype(np.uint8))
    Box([5.0, 4.0, 3.0], [5, 4, 3], lambda x: "abc"[VOXELS[tuple(np.floor(x[::-1]).astype(int))]], "simplex").write(folder("loss.msh"))
    volumes = {"voxels": {"Dimension": 3, "Grid/Cells": "5, 4, 3", "Grid/Spacing": "1e-3, 1e-3, 1e-3", "Microstructure/Type": "voxels",
                          "Microstructure/File": "cells.npy"}, "mesh": {"Dimension": 3, "Mesh/File": "loss.msh", "Mesh/Scale": 1e-3}}
    for name, volume in volumes.items():
        alike = {key: (0.6 if "Loss factor" in key else value) for key, value in settings.items() if key.split("/")[0] in ("Phases", "Homogenization")}
        found = run(folder, name + "alike", {**alike, **volume, "Homogenization/Boundary conditions": CONDITIONS}, 2)["varied"]
        close([found[key]["imaginary"] / found[key]["real"] for key in ("D11", "D12", "D66", "E_x", "G_yz")], [0.6] * 5, 1e-9, f"{name}: one loss factor")
    random = {**COMMON, **{key: value for key, value in settings.items() if key.startswith("Phases")}, "Homogenization/Loss": "complex"}
    random |= {"Grid/Cells": "20, 20", "Grid/Size": "2e-3, 2e-3", "Microstructure/Type": "random fibres", "Microstructure/Random fibres/Fibre width": 1e-4,
               "Microstructure/Random fibres/Minimum height": 4e-4, "Microstructure/Random fibres/Maximum height": 8e-4, "Ensemble/Members": 3,
               "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC", "Phases/Names": "a, b, c"}
    for solver in ("multigrid", "divided"):
        numbers = [run(folder, f"members{solver}", {**random, "Homogenization/Solver": solver}, ranks)["varied"]["E_y"]["imaginary"] for ranks in (1, 2)]
        close(numbers[1], numbers[0], 1e-9, f"three members, {solver}, 1 and 2 ranks")


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_laminate(folder)
        check_complex(folder)
        check_kinds(folder)


if __name__ == "__main__":
    main()
