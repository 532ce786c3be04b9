"""Cards of the effective material: CalculiX answers unit strains with the stresses of the stiffness and one kelvin with its thermal stress, for an
orthotropic and for a full stiffness; the other cards have the same numbers."""

import os
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np

from scenes import TOOLS, Folder, prm

SEED = 458
PHASES = {"Dimension": 3, "Grid/Cells": "4, 4, 4", "Grid/Spacing": "1e-3, 1e-3, 1e-3", "Microstructure/Type": "voxels", "Microstructure/File": "cells.npy",
          "Phases/Names": "matrix, wood", "Phases/matrix/Young modulus": 3e9, "Phases/matrix/Poisson ratio": 0.35, "Phases/matrix/Density": 1200,
          "Phases/matrix/Thermal expansion": 5e-5, "Phases/wood/Type": "orthotropic", "Phases/wood/Young moduli": "60e9, 15e9, 25e9",
          "Phases/wood/Poisson ratios": "0.25, 0.2, 0.15", "Phases/wood/Shear moduli": "8e9, 6e9, 5e9", "Phases/wood/Density": 700,
          "Phases/wood/Thermal expansion": "1e-6, 2e-5, 3e-5", "Homogenization/Boundary conditions": "PBC", "Homogenization/Tolerance": 1e-12}
ORDER = [0, 1, 2, 5, 4, 3]  # CalculiX prints xx, yy, zz, xy, xz, yz


def card(folder, volume, *words, status=0):
    done = subprocess.run([sys.executable, os.path.join(TOOLS, "material_card.py"), folder(volume), *words], capture_output=True, text=True, check=False)
    assert done.returncode == status, done
    return done.stdout if status == 0 else done.stderr


def cube(text):
    """Input of CalculiX: two cells along each axis with all nodes at the sides prescribed, one step for each unit strain and one of heat."""
    lines = ["*NODE, NSET=ALL"]
    corner = lambda i, j, k: 1 + i + 3 * (j + 3 * k)  # noqa: E731
    places = [(i, j, k) for k in range(3) for j in range(3) for i in range(3)]
    lines += [f"{corner(*p)}, {p[0] / 2}, {p[1] / 2}, {p[2] / 2}" for p in places]
    lines.append("*ELEMENT, TYPE=C3D8, ELSET=CELLS")
    for e, (i, j, k) in enumerate([(i, j, k) for k in range(2) for j in range(2) for i in range(2)]):
        nodes = [corner(i + a, j + b, k + c) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]
        lines.append(f"{e + 1}, " + ", ".join(map(str, nodes)))
    lines += [text, "*SOLID SECTION, ELSET=CELLS, MATERIAL=COMPOSITE", "*INITIAL CONDITIONS, TYPE=TEMPERATURE", "ALL, 0"]
    pairs = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    for step in range(7):
        lines += ["*STEP", "*STATIC", "*BOUNDARY, OP=NEW"]
        E = np.zeros((3, 3))
        if step < 6:
            a, b = pairs[step]
            E[a, b] += 0.5
            E[b, a] += 0.5
        for p in places:
            if p != (1, 1, 1):
                u = E @ (np.array(p) / 2)
                lines += [f"{corner(*p)}, {c + 1}, {c + 1}, {u[c]:.12e}" for c in range(3)]
        lines += ["*TEMPERATURE, OP=NEW", f"ALL, {1 if step == 6 else 0}", "*EL PRINT, ELSET=CELLS", "S", "*END STEP"]
    return "\n".join(lines) + "\n"


def stresses(folder, name, text):
    """Stresses [7][6] that CalculiX prints of the first cell."""
    folder.write(name + ".inp", cube(text))
    done = subprocess.run(["ccx", name], cwd=folder(""), capture_output=True, text=True, check=False)
    assert "*ERROR" not in done.stdout and done.returncode == 0, done.stdout
    with open(folder(name + ".dat"), encoding="utf-8") as file:
        blocks = file.read().split("stresses")[1:]
    rows = [re.findall(r"^\s+1\s+1\s+(.*)$", block, re.M)[0].split() for block in blocks]
    return np.array(rows, dtype=float)[:, ORDER]


def close(found, expected, tolerance, what):
    error = np.abs(np.subtract(found, expected)).max() / np.abs(expected).max()
    print(f"{what:70s} {error:.1e}")
    assert error <= tolerance, (what, found, expected)


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        np.save(folder("cells.npy"), np.random.default_rng(SEED).choice(2, size=(4, 4, 4)).astype(np.uint8))
        for name, more in (("orthotropic", {}), ("full", {"Homogenization/Effective symmetry": "full", "Phases/wood/Euler angles": "20, 30, 50"})):
            settings = {**PHASES, **more}
            keys = {key: value for key, value in settings.items() if "/" in key}
            folder.write(name + ".prm", f"set Dimension = {settings['Dimension']}\n" + prm(keys))
            folder.run(0, "rve_homogenization", name + ".prm", "--output", name)
            summary = folder.summary(name)
            D, alpha = np.array(summary["stiffness"]["effective"]), np.array(summary["expansion"]["effective"])
            if name == "full":  # two solids in different axes: the expansion of the composite has shears
                said = card(folder, name, "--to", "calculix", status=1)
                assert "the expansion has shears" in said, said
                settings.pop("Phases/matrix/Thermal expansion")
                settings.pop("Phases/wood/Thermal expansion")
                folder.write(name + ".prm", "set Dimension = 3\n" + prm({key: value for key, value in settings.items() if "/" in key}))
                folder.run(0, "rve_homogenization", name + ".prm", "--output", name)
                alpha = np.zeros(6)
            text = card(folder, name, "--to", "calculix")
            if shutil.which("ccx"):
                found = stresses(folder, name, text)
                close(found[:6], D.T, 2e-6, f"{name}: stresses of CalculiX under unit strains")
                if name == "orthotropic":
                    close(found[6], -D @ alpha, 2e-6, f"{name}: stresses of one kelvin")
            else:
                print("there is no ccx; the card of CalculiX is compared with numbers alone")
            numbers = [float(v) for v in re.search(r"TYPE=(?:ORTHO|ANISO)\n(.*?)(?:\n\*|\Z)", text, re.S)[1].replace("\n", ", ").split(",") if v.strip()]
            assert len(numbers) == (9 if name == "orthotropic" else 21)
            close(numbers[:6], [D[0, 0], D[0, 1], D[1, 1], D[0, 2], D[1, 2], D[2, 2]], 1e-9, f"{name}: entries of the card")
            other = card(folder, name, "--to", "abaqus", "--name", "M")
            assert "*MATERIAL, NAME=M" in other and ("TYPE=ORTHOTROPIC" if name == "orthotropic" else "TYPE=ANISOTROPIC") in other
            fractions = [phase["volume_fraction"] for phase in summary["phases"]]
            close([float(re.search(r"\*DENSITY\n(.*)", text)[1])], [1200 * fractions[0] + 700 * fractions[1]], 1e-9, f"{name}: density")
        values = dict(re.findall(r"(\w+)=([-\d.e+]+),", card(folder, "orthotropic", "--to", "aster")))
        constants = folder.summary("orthotropic")["engineering_constants"]
        for key, constant in (("E_L", "E_x"), ("E_T", "E_y"), ("E_N", "E_z"), ("NU_LT", "nu_xy"), ("NU_LN", "nu_xz"), ("NU_TN", "nu_yz"), ("G_LT", "G_xy"),
                              ("G_LN", "G_xz"), ("G_TN", "G_yz")):
            close([float(values[key])], [constants[constant]], 1e-8, f"code_aster: {key}")
        assert "ELAS_ORTH takes orthotropic" in card(folder, "full", "--to", "aster", status=1)
        folder.write("plane.prm", prm({"Grid/Cells": "4, 4", "Grid/Size": "1e-3, 1e-3", "Microstructure/Type": "homogeneous", "Phases/Names": "one",
                                       "Phases/one/Young modulus": 1e9}))
        folder.run(0, "rve_homogenization", "plane.prm", "--output", "plane")
        assert "voxels one cell deep" in card(folder, "plane", "--to", "abaqus", status=1)
        assert "no file or folder" in card(folder, "nothing", "--to", "abaqus", status=1)


if __name__ == "__main__":
    main()
