"""Modes of random phase maps under each kind of top against a dense eigenproblem written apart, in numpy.

    independent_modes.py <folder with the programs>

The cells, phases and stiffness matrices of independent_finite_elements.py, a density for each phase, lumped masses. Under
the platen the u_y of the top row are one unknown, by a rectangular matrix T: T^t K T x = omega^2 (T^t M T + platen) x.
Frequencies agree to 1e-8, effective masses to 1e-6.
"""

import csv
import os
import subprocess
import sys
import tempfile

import numpy as np

from independent_finite_elements import HX, HY, NX, NY, SEED, STIFFNESS, assemble, plain

DENSITY = [1770.0, 2500.0, 1100.0]
PLATEN_MASS = 0.05  # kg/m; the body has about 0.12
N_MODES = 6


def lumped_mass(phases):
    mass = np.zeros(2 * (NX + 1) * (NY + 1))
    for j in range(NY):
        for i in range(NX):
            for n in (plain(i, j), plain(i + 1, j), plain(i, j + 1), plain(i + 1, j + 1)):
                mass[[2 * n, 2 * n + 1]] += DENSITY[phases[j, i]] * HX * HY / 4
    return mass


def transformation(top, bottom):
    """Columns: free degrees of freedom, with a platen the u_y of the top row as the last."""
    row = lambda j: [plain(i, j) for i in range(NX + 1)]
    held = set()
    if top != "free":
        held |= {2 * n for n in row(NY)}
    if top in ("held", "platen"):
        held |= {2 * n + 1 for n in row(NY)}
    if bottom == "held":
        held |= {2 * n + 1 for n in row(0)}
    T = np.delete(np.eye(2 * (NX + 1) * (NY + 1)), sorted(held), axis=1)
    if top == "platen":
        column = np.zeros((len(T), 1))
        column[[2 * n + 1 for n in row(NY)]] = 1
        T = np.hstack([T, column])
    return T


def modes(phases, top, bottom):
    """Frequencies (Hz) and effective masses along x and y, rigid motions at 0 Hz left out."""
    mass = lumped_mass(phases)
    T = transformation(top, bottom)
    K = T.T @ assemble(phases, plain, (NX + 1) * (NY + 1)) @ T
    M = T.T @ (mass[:, None] * T)
    total = [mass[0::2].sum(), mass[1::2].sum()]
    if top == "platen":
        M[-1, -1] += PLATEN_MASS
        total[1] += PLATEN_MASS
    root = np.diag(1 / np.sqrt(np.diag(M)))
    squares, vectors = np.linalg.eigh(root @ K @ root)
    vibrating = squares > 1e-9 * squares[-1]
    shapes = (root @ vectors)[:, vibrating]
    rigid = [T[c::2].any(axis=0).astype(float) for c in (0, 1)]
    effective = [(r @ M @ shapes) ** 2 / t for r, t in zip(rigid, total)]
    return np.sqrt(squares[vibrating]) / (2 * np.pi), np.array(effective), int((~vibrating).sum())


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def morphology(folder, phases):
    np.savetxt(os.path.join(folder, "map.txt"), phases[::-1], fmt="%d")  # an image: top row first
    text = f"subsection Grid\n set Cells = {NX}, {NY}\n set Spacing = {HX}, {HY}\nend\nsubsection Phases\n set Names = a, b, c\n"
    for name, d, density in zip("abc", STIFFNESS, DENSITY):
        text += f" subsection {name}\n  set Type = stiffness\n  set Stiffness = {', '.join(map(str, d))}\n"
        text += f"  set Density = {density}\n end\n"
    text += "end\nsubsection Microstructure\n set Type = image\n set File = map.txt\n set Oblong pixels = true\nend\n"
    text += "subsection Homogenization\n set Boundary conditions = KUBC\n set Effective = KUBC\nend\n"
    write(folder, "rve.prm", text)


def top_keys(top):
    return {"platen": f"set Kind = platen\n set Platen mass = {PLATEN_MASS}", "held": "set Kind = held",
            "lateral": "set Kind = pressure\n set Lateral held = true", "free": "set Kind = pressure"}[top]


def program(programs, folder, top):
    text = "set Analysis = modal\nsubsection Body\n set Material = heterogeneous\n set RVE file = rve/rve.h5\nend\n"
    text += f"subsection Top\n {top_keys(top)}\nend\nsubsection Modal\n set Number of modes = {N_MODES}\nend\n"
    write(folder, "modal.prm", text)
    subprocess.run([os.path.join(programs, "contact_dynamics"), "modal.prm", "--output", top, "--quiet"], cwd=folder, check=True)
    with open(os.path.join(folder, top, "modes.csv"), encoding="utf-8") as file:
        return list(csv.DictReader(file))


def compare(table, phases, top, bottom):
    frequencies, effective, _ = modes(phases, top, bottom)
    rows = [row for row in table if row["bottom"] == bottom]
    assert len(rows) == N_MODES, rows
    found = np.array([float(row["frequency [Hz]"]) for row in rows])
    error = np.abs(found / frequencies[:N_MODES] - 1).max()
    shares = np.array([[float(row[f"effective_mass_{c} [-]"]) for row in rows] for c in "xy"])
    difference = np.abs(shares - effective[:, :N_MODES]).max()
    print(f"top {top:8s} bottom {bottom:5s} {found[0]:10.1f} to {found[-1]:.1f} Hz: {error:.1e}, effective masses {difference:.1e}")
    assert error < 1e-8 and difference < 1e-6, f"top {top}, bottom {bottom}: {found} instead of {frequencies[:N_MODES]}"


def main():
    print("seed", SEED)
    phases = np.random.default_rng(SEED).choice(3, size=(NY, NX), p=[0.5, 0.3, 0.2])
    with tempfile.TemporaryDirectory() as folder:
        morphology(folder, phases)
        subprocess.run([os.path.join(sys.argv[1], "rve_homogenization"), "rve.prm", "--output", "rve", "--quiet"], cwd=folder, check=True)
        for top in ("platen", "held", "lateral", "free"):
            table = program(sys.argv[1], folder, top)
            for bottom in ("free", "held"):
                compare(table, phases, top, bottom)


if __name__ == "__main__":
    main()
