"""Load cases on a plane grid whose rows the ranks divide (Homogenization/Solver = divided), against the multigrid of the plane grid, of which
each rank has the whole.

Odd and even numbers of cells that are no squares, four phases, one of them anisotropic, contrast 1e3; KUBC, SUBC and PBC on one, two and
three ranks: all nine entries of the stiffness, phase means, the concentration tensors of all cells and the fields of macroscopic loads. The
two solvers share neither operator nor multigrid; independent_finite_elements.py compares the other one with scipy. Ranks agree to 1e-12.
A slender volume under SUBC, where single
precision cancels, converges. A laminate has its closed form. An ensemble has the members of the other solver. What does not fit into the memory that the environment
grants is divided, or refused with a sentence; so are more than 255 phases.
"""

import os
import tempfile

import h5py
import numpy as np

from macroscopic_loads import PHASES, close, laminate, stiffness

import scenes
from scenes import Folder, prm

SEED = 4711
CONDITIONS = ("KUBC", "SUBC", "PBC", "MUBC")
RANKS = (1, 2, 3)
MIXED = {"Phases/Names": "soft, matrix, stiff, turned", "Homogenization/Boundary conditions": ", ".join(CONDITIONS),
         "Homogenization/Tolerance": 1e-12, "Phases/soft/Young modulus": 0.24e9, "Phases/soft/Poisson ratio": 0.35,
         "Phases/matrix/Young modulus": 3e9, "Phases/matrix/Poisson ratio": 0.3, "Phases/stiff/Young modulus": 240e9,
         "Phases/stiff/Poisson ratio": 0.2, "Phases/turned/Type": "stiffness",
         "Phases/turned/Stiffness": "40e9, 9e9, 7e9, 22e9, -3e9, 12e9",
         "Loads/Names": "pull", "Loads/pull/Stress xx": 1e6, "Loads/pull/Strain yy": 1e-4, "Loads/pull/Stress xy": 2e5}


def run(folder, name, solver, ranks=1, status=0, memory=None, options=(), **settings):
    """What the program says."""
    folder.write(name + ".prm", prm({**settings, "Homogenization/Solver": solver}))
    granted = {"env": dict(scenes.ENVIRONMENT, MESOSLIP_MEMORY=str(memory))} if memory else {}
    return folder.run(status, "rve_homogenization", name + ".prm", "--output", f"{name}{ranks}", *options, ranks=ranks, **granted)


def results(folder, name):
    """{name: array} of everything that both solvers have to give."""
    with h5py.File(folder(name, "rve.h5")) as file:
        found = {key: value[...] for group in ("stiffness", "concentration", "stress_concentration") if group in file
                 for key, value in ((f"{group}/{k}", v) for k, v in file[group].items())}
    if os.path.exists(folder(name, "loads.h5")):
        with h5py.File(folder(name, "loads.h5")) as file:
            file.visititems(lambda key, item: found.update({key: item[...]}) if isinstance(item, h5py.Dataset) and key.startswith("loads")
                            and item.dtype.kind == "f" else None)
    return found


def check_same(one, two, tolerance, what):
    assert one.keys() == two.keys() and len(one) >= 3, (sorted(one), sorted(two))
    worst = {key: np.abs(one[key] - two[key]).max() / np.abs(one[key]).max() for key in one}
    key = max(worst, key=worst.get)
    print(f"{what:60s} {len(one)} arrays, {worst[key]:.1e} in {key}")
    assert worst[key] <= tolerance, f"{what}: {worst}"


def image(folder, cells, size, n_phases, seed=SEED):
    random = np.random.default_rng(seed)
    np.savetxt(folder("map.txt"), random.integers(0, n_phases, cells[::-1]), fmt="%d")
    return {"Grid/Cells": "%d, %d" % cells, "Grid/Size": "%g, %g" % size, "Microstructure/Type": "image", "Microstructure/File": "map.txt",
            "Microstructure/Oblong pixels": "true"}


def check_random(folder):
    for number, (cells, size) in enumerate((((37, 23), (3.7e-3, 3.5e-3)), ((6, 64), (0.6e-3, 3.2e-3)))):
        settings = {**MIXED, **image(folder, cells, size, 4, SEED + number)}
        run(folder, "whole", "multigrid", **settings)
        expected = results(folder, "whole1")
        for ranks in RANKS:
            run(folder, "parts", "divided", ranks, **settings)
            found = results(folder, f"parts{ranks}")
            check_same(expected, found, 1e-8, f"{cells[0]} x {cells[1]}, {ranks} ranks, against the multigrid")
            if ranks == 1:
                first = found
            check_same(first, found, 1e-10, f"{cells[0]} x {cells[1]}, {ranks} ranks, against one")
            one, two = (folder.summary(name)["stiffness"] for name in ("whole1", f"parts{ranks}"))
            for condition in CONDITIONS:
                close(two[condition], one[condition], 1e-10, f"{condition} on {ranks} ranks")


def check_slender(folder):
    """Where the residual was computed anew less often, yy took 122 iterations."""
    numbers = {"Homogenization/Boundary conditions": "SUBC", "Homogenization/Effective": "SUBC", "Homogenization/Tolerance": 1e-8}
    settings = {**PHASES, **numbers, **image(folder, (40, 1000), (4e-4, 1e-2), 2)}
    run(folder, "slender", "divided", 2, **settings)
    taken = folder.summary("slender2")["iterations"]["SUBC"]
    print(f"slender volume: {taken} iterations")
    assert max(taken) <= 70, taken


def check_laminate(folder):
    for across in range(2):
        rows = np.zeros((6, 6), int)
        rows[[1, 4]] = 1
        np.savetxt(folder("map.txt"), rows if across else rows.T, fmt="%d")
        settings = {**PHASES, "Grid/Cells": "6, 6", "Grid/Size": "6e-3, 3e-3", "Microstructure/Type": "image", "Microstructure/File": "map.txt",
                    "Microstructure/Oblong pixels": "true", "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC"}
        run(folder, "laminate", "divided", 2, **settings)
        D, columns = stiffness(2), []
        for k in range(3):
            strains = laminate(2, across, 1 / 3, {j: float(j == k) for j in range(3)}, {})
            columns.append(2 / 3 * D[0] @ strains[0] + 1 / 3 * D[1] @ strains[1])
        close(folder.summary("laminate2")["stiffness"]["PBC"], np.array(columns).T, 1e-10, f"layers across {'xy'[across]}")


def check_ensemble(folder):
    settings = {**PHASES, "Phases/Names": "matrix, fibre", "Grid/Cells": "30, 25", "Grid/Size": "3e-3, 2.5e-3", "Ensemble/Members": 3,
                "Phases/matrix/Young modulus": 30e9, "Phases/fibre/Young modulus": 240e9,
                "Microstructure/Random fibres/Minimum height": 2e-4, "Microstructure/Random fibres/Maximum height": 5e-4}
    settings = {key: value for key, value in settings.items() if not key.startswith(("Phases/soft", "Phases/stiff"))}
    run(folder, "whole", "multigrid", 2, **settings)
    run(folder, "parts", "divided", 2, **settings)
    one, two = folder.summary("whole2")["ensemble"], folder.summary("parts2")["ensemble"]
    assert one["seeds"] == two["seeds"] and len(one["seeds"]) == 3
    for condition in ("KUBC", "SUBC"):
        for key in ("mean", "standard_deviation"):
            close(two[condition][key], one[condition][key], 1e-9, f"ensemble, {key} of {condition}")


def check_memory(folder):
    """The grid below is estimated to need more than the environment grants, whole, and less, divided."""
    settings = {**MIXED, **image(folder, (300, 200), (3e-3, 2e-3), 4), "Homogenization/Tolerance": 1e-3,
                "Homogenization/Boundary conditions": "KUBC, SUBC, PBC",
                "Homogenization/Write concentration": "false"}
    said = run(folder, "auto", "multigrid", 1, memory=165e6, **settings)
    assert "Homogenization/Solver: divided, as multigrid would need about 17" in said, said
    assert "rows divided" in run(folder, "auto", "multigrid", 1, memory=165e6, options=["--validate"], **settings)
    assert "divided" not in run(folder, "auto", "multigrid", 1, options=["--validate"], **settings)
    # Two ranks of one machine share what is granted.
    for ranks, memory in ((1, 180e6), (2, 330e6)):
        said = run(folder, "auto", "multigrid", ranks, memory=memory, options=["--validate"], **settings)
        assert ("rows divided" in said) == (ranks == 2), said
    for solver, memory, words in (("multigrid", 150e6, "take more machines, among which"), ("divided", 150e6, "take more machines"),
                                  ("jacobi", 159e6, "set Homogenization/Solver = divided"), ("multigrid", "a lot", "MESOSLIP_MEMORY is 'a lot'")):
        said = run(folder, "refused", solver, 1, 2, memory, ["--validate"], **settings)
        assert words in said and len(said.splitlines()) == 1, said


def check_refusals(folder):
    settings = {**MIXED, **image(folder, (6, 4), (6e-3, 4e-3), 4)}
    names = [f"p{k}" for k in range(256)]
    many = {**{key: value for key, value in settings.items() if not key.startswith(("Phases/", "Microstructure/"))},
            "Phases/Names": ", ".join(names), **{f"Phases/{name}/Young modulus": 1e9 for name in names}, "Microstructure/Type": "rectangles", "Microstructure/File": "none.csv"}
    folder.write("none.csv", "x_left_mm,y_bottom_mm,width_mm,height_mm,phase\n0,0,1,1,1\n")
    said = run(folder, "refused", "divided", 1, 2, **many)
    assert "up to 255 phases" in said, said


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        for check in (check_random, check_slender, check_laminate, check_ensemble, check_memory, check_refusals):
            check(folder)


if __name__ == "__main__":
    main()
