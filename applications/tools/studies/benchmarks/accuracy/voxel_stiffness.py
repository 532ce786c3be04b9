"""Effective stiffness of spheres as staircases of voxels: error against voxels and time; a mesh of hexahedra that follows the sphere is the
independent path to the limit."""

import math
import os

import numpy as np

from common import require_ended
from fits import fitted_order, least_costs, richardson
from plots import curve, legend, logarithmic, panels

from mesh_files import AROUND
from meshes import inclusion

FRACTION = 0.25
RADIUS = (6 * FRACTION / math.pi) ** (1 / 3)  # in a cube of 2
ENTRIES = {"C11": (0, 0), "C12": (0, 1), "C44": (3, 3)}
DIAMETER = 0.25  # of the random spheres, edges of the box
PHASES = {"Phases/Names": "matrix, sphere", "Phases/matrix/Young modulus": "3e9", "Phases/matrix/Poisson ratio": 0.35,
          "Phases/sphere/Young modulus": "70e9", "Phases/sphere/Poisson ratio": 0.2, "Homogenization/Boundary conditions": "PBC",
          "Homogenization/Effective": "PBC", "Homogenization/Reuse": False, "Homogenization/Write concentration": False}
RANDOM = {"Microstructure/Type": "random inclusions", **{f"Microstructure/Random inclusions/{key}": value for key, value in {
    "Shape": "spheres", "Minimum diameter": DIAMETER * 1e-3, "Maximum diameter": DIAMETER * 1e-3, "Volume fraction": 0.2, "Sides": "periodic",
    "Seed": 1}.items()}}


def run(bench):
    study = bench.study("voxel_stiffness")
    study.jobs = 1  # times count
    os.makedirs(study.path("inputs"), exist_ok=True)
    meshes = [2, 4, 8] if bench.quick else [3, 6, 12]
    grids = [8, 16, 32] if bench.quick else [8, 12, 16, 24, 32, 48, 64, 96, 128]
    random = [16, 32, 48] if bench.quick else [16, 24, 32, 48, 64, 96, 128]
    add_runs(study, meshes, grids, random)
    results = study.run()
    require_ended(results)
    rows, limit = lattice(results, meshes, grids)
    rows += several(results, random)
    bench.write("voxel-stiffness", rows, f"spheres in a cube, PBC, contrast 23: largest error of C11, C12, C44; lattice: fraction {FRACTION}, against the "
                f"extrapolation of the meshes; random: {DIAMETER:g} of the edge in diameter, fraction 0.2, against a + b h through the four finest grids; "
                "cpu_s: whole program, six load cases")
    bench.write("voxel-stiffness-limits", limit, "limits of the lattice by Richardson's extrapolation of the meshes, and by a + b h through the four finest grids")
    bench.write("voxel-stiffness-cheapest", [best for kind, name in (("grid", "lattice, staircase"), ("mesh", "lattice, mesh"), ("random", "random, staircase"))
                                             for best in least_costs([row for row in rows if row["kind"] == kind], "largest_error", name, choice)],
                "least cost for a target")
    draw(bench, rows)


def choice(best):
    return f"{best['across']:.0f} cells across a sphere, {best['cells']:.0f} in all"


def add_runs(study, meshes, grids, random):
    prm = study.path(os.path.join("inputs", "cell.prm"))
    with open(prm, "w", encoding="utf-8") as file:
        file.write("set Dimension = 3\nset Output folder = output\n")
    add = lambda name, settings: study.add(name, "rve_homogenization", prm, {**PHASES, **settings})
    on_grid = lambda n: {"Grid/Cells": [n] * 3, "Grid/Size": [1e-3] * 3}
    for n in meshes:
        path = study.path(os.path.join("inputs", f"fitted-{n}.msh"))
        fitted(n).write(path)
        add(f"mesh-{n}", {"Mesh/File": path, "Mesh/Scale": 0.0005})
    for n in grids:
        path = study.path(os.path.join("inputs", f"grid-{n}.npy"))
        x2 = ((np.arange(n) + 0.5) * 2 / n - 1) ** 2
        np.save(path, (x2[:, None, None] + x2[:, None] + x2 < RADIUS ** 2).astype(np.uint8))
        add(f"grid-{n}", {**on_grid(n), "Microstructure/Type": "voxels", "Microstructure/File": path})
    for n in random:
        add(f"random-{n}", {**on_grid(n), **RANDOM})


def fitted(n):
    """A mesh whose inclusion, within the sphere as its corners lie on it, is made as large as the sphere."""
    make = lambda radius: inclusion(3, n, [radius], [n, n], ["sphere", "matrix"])
    mesh = make(RADIUS)
    return make(RADIUS * (FRACTION / (volume(mesh, "sphere") / 8)) ** (1 / 3))


def volume(mesh, group):
    """Of the hexahedra of a group, by eight points of Gauss."""
    corners = mesh.points[[cell for cell, name in zip(mesh.cells, mesh.groups) if name == group]]
    steps = 2 * np.array(AROUND[3]) - 1
    total = 0.0
    for point in steps / math.sqrt(3):
        gradients = np.stack([steps[:, d] * np.prod(np.delete(1 + steps * point, d, axis=1), axis=1) / 8 for d in range(3)], axis=1)
        total += np.linalg.det(np.einsum("cvi,vd->cid", corners, gradients)).sum()
    return total


def entries(result):
    """C11, C12 and C44, of a cube the means over the axes."""
    D = np.array(result.summary["stiffness"]["PBC"])
    return np.array([D[range(3), range(3)].mean(), (D[0, 1] + D[0, 2] + D[1, 2]) / 3, D[range(3, 6), range(3, 6)].mean()])


def linear_limit(found, sizes):
    """a of a + b / n through the four finest."""
    return np.polynomial.polynomial.polyfit([1 / n for n in sizes[-4:]], np.array(found[-4:]), 1)[0]


def rows_of(results, kind, sizes, found, limit, across):
    rows = []
    for n, values in zip(sizes, found):
        result = results[f"{kind}-{n}"]
        errors = values / limit - 1
        rows.append({"kind": kind, "n": n, "cells": result.summary["cells"], "across": across(n),
                     "fraction": result.summary["phases"][1]["volume_fraction"],
                     **{f"{name}_error": e for name, e in zip(ENTRIES, errors)}, "largest_error": np.abs(errors).max(), "cpu_s": result.cpu_seconds,
                     "peak_memory_MB": result.summary["peak_memory_bytes"] / 1e6})
    return rows


def lattice(results, meshes, grids):
    found = {kind: [entries(results[f"{kind}-{n}"]) for n in sizes] for kind, sizes in (("mesh", meshes), ("grid", grids))}
    extrapolated = [richardson([f[k] for f in found["mesh"]]) for k in range(3)]
    limit = np.array([value for value, _ in extrapolated])
    own = linear_limit(found["grid"], grids)
    limits = [{"entry": name, "meshes_Pa": value, "order_of_meshes": order, "grids_Pa": of_grids, "grids_over_meshes": of_grids / value - 1}
              for name, (value, order), of_grids in zip(ENTRIES, extrapolated, own)]
    rows = rows_of(results, "mesh", meshes, found["mesh"], limit, lambda n: 4 * n)
    return rows + rows_of(results, "grid", grids, found["grid"], limit, lambda n: RADIUS * n), limits


def several(results, sizes):
    found = [entries(results[f"random-{n}"]) for n in sizes]
    return rows_of(results, "random", sizes, found, linear_limit(found, sizes), lambda n: DIAMETER * n)


def draw(bench, rows):
    figure, (space, cost) = panels(2)
    logarithmic(space, "cells across a sphere", "largest error of C11, C12, C44 (%)", "by cells")
    logarithmic(cost, "CPU seconds (program, six load cases)", "largest error of C11, C12, C44 (%)", "by time")
    for k, (kind, name) in enumerate((("mesh", "lattice, hexahedra along the sphere, ml"), ("grid", "lattice, staircase, multigrid"),
                                      ("random", "random spheres, staircase, multigrid"))):
        own = [row for row in rows if row["kind"] == kind]
        errors = [100 * row["largest_error"] for row in own]
        order = fitted_order([1 / row["n"] for row in own], errors)
        curve(space, k, [row["across"] for row in own], errors, f"{name}: order {order:.2f} in h")
        curve(cost, k, [row["cpu_s"] for row in own], errors, name)
    for axes in (space, cost):
        legend(axes, 1)
    bench.draw("voxel-stiffness", figure)
