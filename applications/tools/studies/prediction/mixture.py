"""Morphologies on coarser cells: each coarse cell is the mixture of the 2 x 2 cells it replaces.

The two cells of a column are layered in y, then the two columns in x. This is exact for layers, so that a fibre that
fills a column keeps its stiffness along its axis. Stiffnesses are orthotropic: D11, D12, D22, D33 (Pa)."""

import os

import h5py
import numpy as np


def layers(first, second, normal):
    """Stiffness [..., 4] of equal layers of two materials [..., 4], normal to axis 0 or 1."""
    order = [0, 1, 2, 3] if normal == 0 else [2, 1, 0, 3]
    c11, c12, c22, c33 = np.moveaxis(np.array(np.broadcast_arrays(first, second), float)[..., order], -1, 0)
    d11 = 1 / np.mean(1 / c11, axis=0)
    ratio = np.mean(c12 / c11, axis=0)
    d22 = np.mean(c22 - c12**2 / c11, axis=0) + ratio**2 * d11
    return np.stack([d11, ratio * d11, d22, 1 / np.mean(1 / c33, axis=0)], axis=-1)[..., order]


def coarsen(field):
    """Stiffnesses [ny/2][nx/2][4] from those [ny][nx][4] of cells half as large."""
    columns = layers(field[0::2], field[1::2], 1)
    return layers(columns[:, 0::2], columns[:, 1::2], 0)


def read_cells(rve):
    """Stiffness of each cell [ny][nx][4] (Pa), density (kg/m^3) and size (m) of the morphology in an rve.h5."""
    with h5py.File(rve, "r") as file:
        c = file["phase/stiffness"][:]
        phases = np.stack([c[:, 0, 0], c[:, 0, 1], c[:, 1, 1], c[:, 2, 2]], axis=-1)
        grid = file["grid"].attrs
        return phases[file["phase/id"][:]], float(file["phase/density"][0]), grid["cells"] * grid["spacing"]


def write_coarse(rve, folder, times=1):
    """Writes the morphology of the file `rve` coarsened so many times, phases.txt (top row first), and the .prm that makes its
    rve.h5; returns the path of the .prm. Files that would not change stay untouched."""
    field, density, size = read_cells(rve)
    coarse = field
    for _ in range(times):
        coarse = coarsen(coarse)
    phases, cells = np.unique(coarse.reshape(-1, 4).round(0), axis=0, return_inverse=True)
    cells = cells.reshape(coarse.shape[:2])
    names = [f"mixture{k}" for k in range(len(phases))]
    lines = ["# Written by the study: each cell is the mixture of those of a finer morphology.",
             "subsection Grid", f"  set Cells = {cells.shape[1]}, {cells.shape[0]}",
             f"  set Size = {float(size[0])!r}, {float(size[1])!r}", "end",
             "subsection Phases", "  set Names = " + ", ".join(names)]
    for name, stiffness in zip(names, phases):
        lines += [f"  subsection {name}", "    set Type = stiffness", f"    set Density = {density!r}",
                  "    set Stiffness = " + ", ".join(repr(float(d)) for d in stiffness), "  end"]
    lines += ["end", "subsection Microstructure", "  set Type = image", "  set File = phases.txt",
              "  set Image values = " + ", ".join(str(k) for k in range(len(names))), "end", "subsection Homogenization",
              "  set Boundary conditions = KUBC, SUBC", "  set Write concentration = false", "end", ""]
    os.makedirs(folder, exist_ok=True)
    _write(os.path.join(folder, "phases.txt"), "\n".join(" ".join(map(str, row)) for row in cells[::-1]) + "\n")
    _write(os.path.join(folder, "coarse.prm"), "\n".join(lines))
    return os.path.join(folder, "coarse.prm")


def _write(path, text):
    if os.path.exists(path):
        with open(path, encoding="utf-8") as file:
            if file.read() == text:
                return
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
