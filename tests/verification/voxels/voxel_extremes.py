"""rve_homogenization on voxels where something is known exactly, and where the solver has it hard.

Equal shear moduli: the bulk modulus is exact for any shape (Hill 1963), so that of a cube in a box converges to it, and the shear
moduli are those of the phases on any grid. A map whose axes are exchanged has the stiffness with exchanged axes. Contrasts of 1e4, pores
(1e-6), a nearly incompressible phase and oblong cells: the stiffness is that of the finite element code in scipy, the conditions keep
their order, and each solve takes at most a stated number of iterations.
"""

import itertools
import tempfile

import numpy as np

from brick_elements import PAIRS, effective
from meshes import Phase, order
from scenes import Folder, prm

GPA, SEED = 1e9, 815
CONDITIONS = ("KUBC", "PBC", "SUBC")  # from stiff to soft
# Of KUBC and PBC; of SUBC. Stiff inclusions cost many (doc/voxels.md); these are some 1.5 times those that were counted.
MOST_ITERATIONS = {"contrast 1e4": (180, 680), "contrast 1e-4": (16, 30), "pores": (16, 30), "nu 0.499": (95, 195), "oblong": (24, 27),
                   "oblong, 1e4": (260, 700)}
random = np.random.default_rng(SEED)


def homogenized(folder, phases, moduli, h, conditions=("PBC",), ranks=1):
    """Summary of a run on voxels of two isotropic phases, moduli: their Phase."""
    np.save(folder("voxels.npy"), phases.astype(np.uint8))
    folder.write("cell.prm", prm({
        "Dimension": 3, "Microstructure/Type": "voxels", "Microstructure/File": "voxels.npy", "Phases/Names": "a, b",
        **moduli[0].keys("a"), **moduli[1].keys("b"), "Grid/Cells": ", ".join(map(str, phases.shape[::-1])),
        "Grid/Spacing": ", ".join(map(str, h)), "Homogenization/Boundary conditions": ", ".join(conditions),
        "Homogenization/Effective": conditions[0], "Homogenization/Tolerance": 1e-11, "Homogenization/Write concentration": "false"}))
    folder.run(0, "rve_homogenization", "cell.prm", "--output", "cell", ranks=ranks)
    return folder.summary("cell")


def stiffness(phase):
    D = np.diag([2 * phase.G] * 3 + [phase.G] * 3)
    D[:3, :3] += phase.lame
    return D


def of_young(young, poisson):
    return Phase(3, young / 3 / (1 - 2 * poisson), young / 2 / (1 + poisson))


def check_equal_shear_moduli(folder):
    moduli, G = (Phase(3, 10 * GPA, 12 * GPA), Phase(3, 90 * GPA, 12 * GPA)), 12 * GPA
    sizes, errors = (4, 8, 16, 32), []
    exact = 1 / sum(share / (phase.k + 4 / 3 * G) for share, phase in zip((7 / 8, 1 / 8), moduli)) - 4 / 3 * G
    for n in sizes:
        phases = np.zeros((n, n, n), int)
        phases[: n // 2, : n // 2, : n // 2] = 1
        D = np.array(homogenized(folder, phases, moduli, (1e-3,) * 3)["stiffness"]["PBC"])
        shear = [*np.diag(D)[3:], *((D[i, i] - D[i, (i + 1) % 3]) / 2 for i in range(3))]
        assert np.abs(np.divide(shear, G) - 1).max() < 1e-9 and np.abs(D[:3, 3:]).max() < 1e-9 * exact, D
        errors.append(D[:3, :3].sum() / 9 / exact - 1)
    orders = order(np.array(errors), sizes)
    print("equal shear moduli: bulk modulus off by", errors, "orders", orders)
    # As in the plane the order falls short of 2 by a logarithm, of the edges of the cube.
    assert np.all(np.array(errors) > 0) and np.all((orders > 1.3) & (orders < 2.1)) and errors[-1] < 2e-3, (errors, orders)


def check_exchanged_axes(folder):
    phases = (random.random((6, 5, 4)) < 0.4).astype(int)  # [z][y][x]
    h, moduli = np.array([1e-3, 0.7e-3, 1.4e-3]), (of_young(30 * GPA, 0.3), of_young(240 * GPA, 0.2))
    turned = {}
    for axes in itertools.permutations(range(3)):  # the new axis k is the old axis axes[k]
        array = phases.transpose([2 - axes[2 - k] for k in range(3)])
        found = homogenized(folder, array, moduli, h[list(axes)], CONDITIONS)["stiffness"]
        turned[axes] = {condition: np.array(found[condition]) for condition in CONDITIONS}
    for axes, found in turned.items():
        rows = [PAIRS.index(tuple(sorted((axes[c], axes[d])))) for c, d in PAIRS]
        for condition in CONDITIONS:
            expected = turned[0, 1, 2][condition][np.ix_(rows, rows)]
            error = np.abs(found[condition] - expected).max() / np.abs(expected).max()
            print(f"axes {axes}, {condition}: {error:.1e}")
            assert error < 1e-9, (axes, condition, error)


def check_hard(folder):
    ordinary, cubes = of_young(70 * GPA, 0.3), (1e-3, 1e-3, 1e-3)
    cases = {"contrast 1e4": (Phase(3, 1e4 * ordinary.k, 1e4 * ordinary.G), cubes),
             "contrast 1e-4": (Phase(3, 1e-4 * ordinary.k, 1e-4 * ordinary.G), cubes),
             "pores": (Phase(3, 1e-6 * ordinary.k, 1e-6 * ordinary.G), cubes), "nu 0.499": (of_young(3 * GPA, 0.499), cubes),
             "oblong": (of_young(240 * GPA, 0.2), (1e-3, 1e-3, 4e-3)),
             "oblong, 1e4": (Phase(3, 1e4 * ordinary.k, 1e4 * ordinary.G), (1e-3, 1e-3, 4e-3))}
    maps = {n: (random.random((n, n, n)) < 0.3).astype(int) for n in (6, 16)}
    for name, (other, h) in cases.items():
        for n, phases in maps.items():
            summary = homogenized(folder, phases, (ordinary, other), h, CONDITIONS)
            found = {condition: np.array(summary["stiffness"][condition]) for condition in CONDITIONS}
            print(f"{name}, {n}^3: iterations", summary["iterations"])
            for condition, counts in summary["iterations"].items():
                assert max(counts) <= MOST_ITERATIONS[name][condition == "SUBC"], (name, n, condition, counts)
            for stiff, soft in (("KUBC", "PBC"), ("PBC", "SUBC")):
                difference = found[stiff] - found[soft]
                assert np.linalg.eigvalsh(difference + difference.T).min() > -1e-8 * np.abs(found[stiff]).max(), (name, n, stiff, soft)
            for condition in CONDITIONS if n == 6 else ():
                expected, _ = effective(phases, np.array([stiffness(ordinary), stiffness(other)]), h, condition, (1,) if name == "nu 0.499" else ())
                error = np.abs(found[condition] - expected).max() / np.abs(expected).max()
                print(f"{name}, {condition} against scipy: {error:.1e}")
                assert error < 1e-8, (name, condition, error)


def main():
    print("seed", SEED)
    with tempfile.TemporaryDirectory() as path:
        for check in (check_equal_shear_moduli, check_exchanged_axes, check_hard):
            check(Folder(path))


if __name__ == "__main__":
    main()
