"""Stiffnesses and modes of random phase maps against a dense finite element code written apart, in numpy.

Q1 rectangles with 2x2 Gauss points, three phases (one orthotropic), cells that are not square, lumped masses. KUBC, SUBC,
periodic fluctuations and MUBC with every solver: all entries of the stiffness agree to 1e-8 of the largest. Every kind of top, bottom free
and held: frequencies agree to 1e-8, effective masses to 1e-6. Once with a phase whose Poisson's ratio is 0.4999, the change of area of
which is its mean in each cell.
"""

import csv
import tempfile

import numpy as np

from scenes import Folder, prm

SEED = 20081
NX, NY, HX, HY = 13, 9, 1.0e-3, 0.6e-3
ORDINARY = [[32e9, 8e9, 32e9, 12e9], [260e9, 60e9, 250e9, 100e9], [5e9, 1e9, 20e9, 3e9]]
LAMBDA, MU = 4999e6, 1e6  # nu = 0.4999
WITH_RUBBER = [*ORDINARY[:2], [LAMBDA + 2 * MU, LAMBDA, LAMBDA + 2 * MU, MU]]
DENSITY = np.array([1770.0, 2500.0, 1100.0])
PLATEN_MASS = 0.05  # kg/m; the body has about 0.12
N_MODES = 6
I, J = (a.ravel() for a in np.meshgrid(np.arange(NX + 1), np.arange(NY + 1)))  # columns and rows of the nodes
NODES = np.arange(len(I)).reshape(NY + 1, NX + 1)
# Of each cell: the degrees of freedom of the nodes (0,0), (1,0), (0,1), (1,1).
CORNERS = np.stack([NODES[:-1, :-1], NODES[:-1, 1:], NODES[1:, :-1], NODES[1:, 1:]], axis=-1).reshape(-1, 4)
DOFS = (2 * CORNERS[:, :, None] + np.arange(2)).reshape(-1, 8)
BORDER = (I == 0) | (I == NX) | (J == 0) | (J == NY)


def strain_matrix(x, y):
    """B at a point of the unit cell."""
    B = np.zeros((3, 8))
    B[0, 0::2] = B[2, 1::2] = np.array([y - 1, 1 - y, -y, y]) / HX
    B[1, 1::2] = B[2, 0::2] = np.array([x - 1, -x, 1 - x, x]) / HY
    return B


GAUSS = [strain_matrix(x, y) for x in (0.5 - 0.5 / 3**0.5, 0.5 + 0.5 / 3**0.5) for y in (0.5 - 0.5 / 3**0.5, 0.5 + 0.5 / 3**0.5)]
MEAN = sum(GAUSS) / 4
DILATATION = np.array([[0.5, 0.5, 0], [0.5, 0.5, 0], [0, 0, 0]])  # half of exx + eyy in both
B_BAR = [B + DILATATION @ (MEAN - B) for B in GAUSS]


def matrices(constants):
    """D of each phase."""
    return np.array([[[a, b, 0], [b, c, 0], [0, 0, d]] for a, b, c, d in constants])


def assemble(phases, constants):
    """Stiffness matrix and lumped masses of all nodes."""
    K, mass = np.zeros((DOFS.max() + 1,) * 2), np.zeros(DOFS.max() + 1)
    cells = [sum(B.T @ D @ B for B in (B_BAR if D[0, 1] == LAMBDA else GAUSS)) * HX * HY / 4 for D in matrices(constants)]
    for dofs, phase in zip(DOFS, phases):
        K[np.ix_(dofs, dofs)] += cells[phase]
        mass[dofs] += DENSITY[phase] * HX * HY / 4
    return K, mass


def columns(kept):
    """Matrix from the degrees of freedom that are kept to all of them."""
    return np.eye(len(kept))[:, kept]


def effective(phases, constants, condition):
    """The stiffness under KUBC, SUBC, PBC or MUBC: displacements are `given` plus T times the unknowns."""
    K, _ = assemble(phases, constants)
    x, y = I * HX, J * HY
    given = np.zeros((len(K), 3))
    given[0::2], given[1::2] = np.stack([x, 0 * x, y / 2], axis=1), np.stack([0 * x, y, x / 2], axis=1)
    loads = np.zeros((len(K), 3))
    T = columns(~np.repeat(BORDER, 2))
    if condition == "PBC":
        T = columns(np.repeat((I < NX) & (J < NY), 2))
        T = T[(2 * NODES[J % NY, I % NX][:, None] + np.arange(2)).ravel()]
    if condition == "SUBC":
        T = np.eye(len(K))
        tx = ((I == NX) * 1.0 - (I == 0)) * HY * np.where((J == 0) | (J == NY), 0.5, 1)  # normals times lengths of the border
        ty = ((J == NY) * 1.0 - (J == 0)) * HX * np.where((I == 0) | (I == NX), 0.5, 1)
        loads[0::2], loads[1::2] = np.stack([tx, 0 * tx, ty], axis=1), np.stack([0 * tx, ty, tx], axis=1)
        given = 0 * given
    bases = [T] * 3
    if condition == "MUBC":  # xx and yy: normal displacements are given on the sides; xy: tangential ones
        across_x, across_y = (I == 0) | (I == NX), (J == 0) | (J == NY)
        normal, shear = (columns(~np.stack(held, axis=1).ravel()) for held in ((across_x, across_y), (across_y, across_x)))
        bases = [normal, normal, shear]
    u = np.stack([given[:, k] + T @ np.linalg.lstsq(T.T @ K @ T, T.T @ (loads - K @ given)[:, k], rcond=1e-12)[0] for k, T in enumerate(bases)],
                 axis=1)
    strains = np.einsum("ij,cjk->cik", MEAN, u[DOFS])
    stress = np.einsum("cij,cjk->ik", matrices(constants)[phases], strains) / len(DOFS)
    if condition == "MUBC":
        return stress * [[1, 1, 0], [1, 1, 0], [0, 0, 1]]  # couplings of shear are not determined
    return stress @ np.linalg.inv(strains.mean(axis=0))


def modes(phases, constants, top, bottom):
    """Frequencies (Hz) and effective masses along x and y, rigid motions left out. Under the platen the u_y of the top row are one
    unknown, the last: T^t K T x = omega^2 (T^t M T + platen) x."""
    K, mass = assemble(phases, constants)
    held = np.zeros((len(I), 2), bool)
    held[J == NY] = [top != "free", top in ("held", "platen")]
    held[J == 0, 1] = bottom == "held"
    T = columns(~held.ravel())
    if top == "platen":
        T = np.hstack([T, np.stack([0 * J, J == NY], axis=1).reshape(-1, 1)])
    K, M = T.T @ K @ T, T.T @ (mass[:, None] * T)
    total = [mass[0::2].sum(), mass[1::2].sum()]
    if top == "platen":
        M[-1, -1] += PLATEN_MASS
        total[1] += PLATEN_MASS
    root = np.diag(1 / np.sqrt(np.diag(M)))
    squares, vectors = np.linalg.eigh(root @ K @ root)
    vibrating = squares > 1e-9 * squares[-1]
    shapes = (root @ vectors)[:, vibrating]
    rigid = [T[c::2].any(axis=0).astype(float) for c in (0, 1)]
    return np.sqrt(squares[vibrating]) / (2 * np.pi), np.array([(r @ M @ shapes) ** 2 / t for r, t in zip(rigid, total)])


def run(folder, program, name, settings):
    folder.write(name + ".prm", prm(settings))
    folder.run(0, program, name + ".prm", "--output", name, "--quiet")


def check_stiffness(folder, phases, constants):
    np.savetxt(folder("map.txt"), phases.reshape(NY, NX)[::-1], fmt="%d")  # an image: top row first
    settings = {"Grid/Cells": f"{NX}, {NY}", "Grid/Spacing": f"{HX}, {HY}", "Phases/Names": "a, b, c", "Microstructure/Type": "image",
                "Microstructure/File": "map.txt", "Microstructure/Oblong pixels": "true",
                "Homogenization/Boundary conditions": "KUBC, SUBC, PBC, MUBC", "Homogenization/Tolerance": 1e-11}
    for name, d, density in zip("abc", constants, DENSITY):
        settings |= {f"Phases/{name}/Type": "stiffness", f"Phases/{name}/Stiffness": ", ".join(map(str, d)), f"Phases/{name}/Density": density}
    expected = {condition: effective(phases, constants, condition) for condition in ("KUBC", "SUBC", "PBC", "MUBC")}
    for solver in ("multigrid", "jacobi", "ml", "divided"):
        run(folder, "rve_homogenization", "rve", {**settings, "Homogenization/Solver": solver})
        found = folder.summary("rve")["stiffness"]
        for name, D in expected.items():
            error = np.abs(np.array(found[name]) - D).max() / np.abs(D).max()
            print(f"{solver:10s} {name}  {error:.1e}")
            assert error < 1e-8, f"{solver} {name}: {found[name]} instead of {D}"


def check_modes(folder, phases, constants):
    tops = {"platen": {"Supports/Top/Kind": "platen", "Supports/Top/Platen mass": PLATEN_MASS}, "held": {"Supports/Top/Kind": "held"},
            "lateral": {"Supports/Top/Kind": "pressure", "Supports/Top/Held": "u_x"}, "free": {"Supports/Top/Kind": "pressure"}}
    for top, settings in tops.items():
        run(folder, "contact_dynamics", top, {"Analysis": "modal", "Body/Material": "heterogeneous", "Body/RVE file": "rve/rve.h5",
                                              "Modal/Number of modes": N_MODES, **settings})
        table = list(csv.DictReader(folder.read(top, "modes.csv").decode().splitlines()))
        for bottom in ("free", "held"):
            rows = [row for row in table if row["bottom"] == bottom]
            frequencies, effective_masses = modes(phases, constants, top, bottom)
            found = np.array([float(row["frequency [Hz]"]) for row in rows])
            error = np.abs(found / frequencies[:N_MODES] - 1).max()
            shares = np.array([[float(row[f"effective_mass_{c} [-]"]) for row in rows] for c in "xy"])
            difference = np.abs(shares - effective_masses[:, :N_MODES]).max()
            print(f"top {top:8s} bottom {bottom:5s} {found[0]:10.1f} to {found[-1]:.1f} Hz: {error:.1e}, effective masses {difference:.1e}")
            assert error < 1e-8 and difference < 1e-6, f"top {top}, bottom {bottom}: {found} instead of {frequencies[:N_MODES]}"


def main():
    print("seed", SEED)
    phases = np.random.default_rng(SEED).choice(3, size=NX * NY, p=[0.5, 0.3, 0.2])
    for constants in (ORDINARY, WITH_RUBBER):
        with tempfile.TemporaryDirectory() as path:
            for check in (check_stiffness, check_modes):
                check(Folder(path), phases, constants)


if __name__ == "__main__":
    main()
