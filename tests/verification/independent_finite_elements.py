"""Stiffnesses of random phase maps against a dense finite element code written apart, in numpy.

    independent_finite_elements.py <folder with the programs>

Q1 rectangles with 2x2 Gauss points, three phases (one orthotropic), cells that are not square, KUBC, SUBC
and periodic: all entries agree to 1e-8 of the largest.
"""

import json
import os
import subprocess
import sys
import tempfile

import numpy as np

SEED = 20081
NX, NY, HX, HY = 13, 9, 1.0e-3, 0.6e-3
STIFFNESS = [[32e9, 8e9, 32e9, 12e9], [260e9, 60e9, 250e9, 100e9], [5e9, 1e9, 20e9, 3e9]]  # D11 D12 D22 D33


def matrix(d):
    return np.array([[d[0], d[1], 0], [d[1], d[2], 0], [0, 0, d[3]]])


def strain_matrices():
    """B at the four Gauss points; nodes (0,0), (1,0), (0,1), (1,1)."""
    g = 0.5 / np.sqrt(3)
    for x, y in [(0.5 + a * g, 0.5 + b * g) for a in (-1, 1) for b in (-1, 1)]:
        dx = np.array([-(1 - y), 1 - y, -y, y]) / HX
        dy = np.array([-(1 - x), -x, 1 - x, x]) / HY
        B = np.zeros((3, 8))
        B[0, 0::2] = dx
        B[1, 1::2] = dy
        B[2, 0::2] = dy
        B[2, 1::2] = dx
        yield B


def cell_dofs(i, j, number):
    nodes = [number(i, j), number(i + 1, j), number(i, j + 1), number(i + 1, j + 1)]
    return np.array([2 * n + c for n in nodes for c in range(2)])


def assemble(phases, number, n_nodes):
    K = np.zeros((2 * n_nodes, 2 * n_nodes))
    element = [sum(B.T @ matrix(d) @ B for B in strain_matrices()) * HX * HY / 4 for d in STIFFNESS]
    for j in range(NY):
        for i in range(NX):
            dofs = cell_dofs(i, j, number)
            K[np.ix_(dofs, dofs)] += element[phases[j, i]]
    return K


def means(phases, u, number):
    """Volume means of strain and stress."""
    mean_B = sum(strain_matrices()) / 4
    strain, stress = np.zeros(3), np.zeros(3)
    for j in range(NY):
        for i in range(NX):
            e = mean_B @ u[cell_dofs(i, j, number)]
            strain += e / (NX * NY)
            stress += matrix(STIFFNESS[phases[j, i]]) @ e / (NX * NY)
    return strain, stress


def plain(i, j):
    return j * (NX + 1) + i


def affine(k):
    u = np.zeros(2 * (NX + 1) * (NY + 1))
    for j in range(NY + 1):
        for i in range(NX + 1):
            x, y, n = i * HX, j * HY, plain(i, j)
            u[2 * n] = [x, 0, y / 2][k]
            u[2 * n + 1] = [0, y, x / 2][k]
    return u


def kubc(phases):
    n_nodes = (NX + 1) * (NY + 1)
    K = assemble(phases, plain, n_nodes)
    inner = np.array([2 * plain(i, j) + c for j in range(1, NY) for i in range(1, NX) for c in range(2)])
    D = np.zeros((3, 3))
    for k in range(3):
        u = affine(k)
        u[inner] = 0
        u[inner] = np.linalg.solve(K[np.ix_(inner, inner)], -(K @ u)[inner])
        D[:, k] = means(phases, u, plain)[1]
    return D


def subc(phases):
    n_nodes = (NX + 1) * (NY + 1)
    K = assemble(phases, plain, n_nodes)
    S = np.zeros((3, 3))
    for k in range(3):
        sxx, syy, sxy = np.eye(3)[k]
        f = np.zeros(2 * n_nodes)
        for j in range(NY + 1):
            w = HY * (0.5 if j in (0, NY) else 1)
            for i, sign in ((0, -1), (NX, 1)):
                f[2 * plain(i, j)] += sign * w * sxx
                f[2 * plain(i, j) + 1] += sign * w * sxy
        for i in range(NX + 1):
            w = HX * (0.5 if i in (0, NX) else 1)
            for j, sign in ((0, -1), (NY, 1)):
                f[2 * plain(i, j)] += sign * w * sxy
                f[2 * plain(i, j) + 1] += sign * w * syy
        u = np.linalg.lstsq(K, f, rcond=1e-12)[0]
        S[:, k] = means(phases, u, plain)[0]
    return np.linalg.inv(S)


def periodic(phases):
    def wrapped(i, j):
        return (j % NY) * NX + i % NX

    K = assemble(phases, wrapped, NX * NY)
    mean_B = sum(strain_matrices()) / 4
    D = np.zeros((3, 3))
    for k in range(3):
        E = np.eye(3)[k]
        f = np.zeros(2 * NX * NY)
        for j in range(NY):
            for i in range(NX):
                f[cell_dofs(i, j, wrapped)] -= mean_B.T @ matrix(STIFFNESS[phases[j, i]]) @ E * HX * HY
        u = np.zeros_like(f)
        u[2:] = np.linalg.solve(K[2:, 2:], f[2:])
        for j in range(NY):
            for i in range(NX):
                e = E + mean_B @ u[cell_dofs(i, j, wrapped)]
                D[:, k] += matrix(STIFFNESS[phases[j, i]]) @ e / (NX * NY)
    return D


def program(programs, phases, solver):
    with tempfile.TemporaryDirectory() as folder:
        np.savetxt(os.path.join(folder, "map.txt"), phases[::-1], fmt="%d")  # an image: top row first
        text = f"subsection Grid\n set Cells = {NX}, {NY}\n set Spacing = {HX}, {HY}\nend\n"
        text += "subsection Phases\n set Names = a, b, c\n"
        for name, d in zip("abc", STIFFNESS):
            text += f" subsection {name}\n  set Type = stiffness\n  set Stiffness = " + \
                ", ".join(map(str, d)) + "\n end\n"
        text += "end\nsubsection Microstructure\n set Type = image\n set File = map.txt\n set Oblong pixels = true\nend\n"
        text += "subsection Homogenization\n set Boundary conditions = KUBC, SUBC, PBC\n"
        text += f" set Tolerance = 1e-11\n set Solver = {solver}\nend\n"
        with open(os.path.join(folder, "case.prm"), "w", encoding="utf-8") as file:
            file.write(text)
        subprocess.run([os.path.join(programs, "rve_homogenization"), "case.prm", "--output", "out", "--quiet"],
                       cwd=folder, check=True)
        with open(os.path.join(folder, "out", "summary.json"), encoding="utf-8") as file:
            return json.load(file)["stiffness"]


def main():
    print("seed", SEED)
    phases = np.random.default_rng(SEED).choice(3, size=(NY, NX), p=[0.5, 0.3, 0.2])
    expected = {"KUBC": kubc(phases), "SUBC": subc(phases), "PBC": periodic(phases)}
    for solver in ("multigrid", "jacobi", "ml"):
        found = program(sys.argv[1], phases, solver)
        for name, D in expected.items():
            error = np.abs(np.array(found[name]) - D).max() / np.abs(D).max()
            print(f"{solver:10s} {name}  {error:.1e}")
            assert error < 1e-8, f"{solver} {name}: {found[name]} instead of {D}"


if __name__ == "__main__":
    main()
