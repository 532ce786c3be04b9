"""Random inclusions in a box of voxels: what the programs print and write, ensembles, orientations, refusals.

The mean, deviation and interval of an ensemble have to be those of runs of its seeds one by one; on two and five ranks as on one. Each
rank places the inclusions in its planes: they lie where they lie on one. Fractions of rve.h5 are those printed. Continuous fibres along an
axis have that axis stiffest, and turning all with the orientation of an anisotropic phase turns the stiffness. What has no room or
contradicts itself is refused with exit status 2.
"""

import os
import tempfile

import h5py
import numpy as np
from scipy import stats

from scenes import Folder, prm

INCLUSIONS = "Microstructure/Random inclusions/"
SHAPES = {"spheres": {}, "ellipsoids": {"Axis ratios": "1.5, 1, 0.5", "Orientation": "random"}, "cylinders": {"Axis": "x"},
          "bars": {"Axis": "y", "Minimum length": 6e-3, "Maximum length": 9e-3}}


def settings_of(more=(), **inclusions):
    return {"Dimension": 3, "Grid/Cells": "20, 16, 12", "Grid/Spacing": 1e-3, "Phases/matrix/Young modulus": 3e9,
            "Phases/fibre/Young modulus": 70e9, "Homogenization/Boundary conditions": "KUBC, PBC", "Homogenization/Effective": "PBC",
            "Homogenization/Tolerance": 1e-10, "Microstructure/Type": "random inclusions", INCLUSIONS + "Minimum diameter": 4e-3,
            INCLUSIONS + "Maximum diameter": 5e-3, **dict(more), **{INCLUSIONS + key: value for key, value in inclusions.items()}}


def run(folder, settings, name, ranks=1):
    folder.write(name + ".prm", prm(settings))
    return folder.run(0, "rve_homogenization", name + ".prm", "--output", name, ranks=ranks)


def stiffness(folder, name):
    return np.array(folder.summary(name)["stiffness"]["PBC"])


def check_shapes(folder):
    loose = {"Homogenization/Tolerance": 1e-4, "Homogenization/Reuse": "false"}
    for number, (shape, more) in enumerate(SHAPES.items()):
        for sides in ("periodic", "cut", "inside"):
            said = run(folder, settings_of(loose, Shape=shape, Sides=sides, **more), "shape")
            with h5py.File(folder("shape", "rve.h5")) as file:
                fraction = file["phase/id"][...].mean()
            printed = float(said.split("20 % wanted, ")[1].split(" %")[0])
            assert abs(printed - 100 * fraction) < 1e-2 and abs(fraction - 0.2) < 0.055, said  # half a cylinder is 5 %
            assert ("too few" in said) == (abs(fraction - 0.2) > 0.01), said
            print(f"{shape:12s}{sides:10s} 20 % wanted, {printed} % reached")
        sides, overlap = (("periodic", "false"), ("cut", "true"))[number % 2]
        found, lines = [], []
        for ranks in (1, 5):
            said = run(folder, settings_of(loose, Shape=shape, Sides=sides, **more, **{"Allow overlap": overlap}), "shape", ranks)
            with h5py.File(folder("shape", "rve.h5")) as file:
                found.append(file["phase/id"][...])
            lines.append([line.strip() for line in said.splitlines() if line.strip().startswith(("Morphology", "Phase", "Corners", "Slices"))])
        assert len(lines[0]) == 7 and lines[1] == lines[0], "\n".join(map(str, lines))
        assert (found[0] == found[1]).all(), (shape, sides)
    for axis in range(3):
        run(folder, settings_of(Shape="cylinders", Axis="xyz"[axis]), "along")
        moduli = np.diag(stiffness(folder, "along"))[:3]
        assert np.argmax(moduli) == axis, moduli


def check_bounds(folder):
    """Hill-Mandel, SUBC <= PBC <= KUBC between Reuss and Voigt, and a cubic array of spheres within the bounds of Hashin and Shtrikman."""
    run(folder, settings_of({"Homogenization/Boundary conditions": "KUBC, SUBC, PBC"}), "volume")
    summary = folder.summary("volume")
    D, bounds = {name: np.array(summary["stiffness"][name]) for name in ("KUBC", "SUBC", "PBC")}, summary["bounds"]
    ascending = [np.array(bounds["reuss"]), D["SUBC"], D["PBC"], D["KUBC"], np.array(bounds["voigt"])]
    assert all(np.linalg.eigvalsh(upper - lower).min() > 0 for lower, upper in zip(ascending, ascending[1:])), ascending
    assert max(summary["hill_mandel_residual"].values()) < 1e-8, summary["hill_mandel_residual"]

    n, K, G = 16, np.array([3e9, 70e9]) / 1.2, np.array([3e9, 70e9]) / 2.6  # nu = 0.3
    middle = np.indices((n, n, n)) - (n - 1) / 2
    np.save(folder("spheres.npy"), (np.sum(middle**2, axis=0) < 36).astype("u1"))
    for swapped in (False, True):
        run(folder, {"Dimension": 3, "Grid/Cells": f"{n}, {n}, {n}", "Grid/Spacing": 1e-3, "Phases/Names": "a, b", "Microstructure/Type": "voxels",
                     "Microstructure/File": "spheres.npy", **{f"Phases/{p}/Young modulus": 70e9 if (p == "b") != swapped else 3e9 for p in "ab"},
                     **{f"Phases/{p}/Poisson ratio": 0.3 for p in "ab"}, "Homogenization/Boundary conditions": "PBC",
                     "Homogenization/Effective": "PBC", "Homogenization/Tolerance": 1e-10}, "array")
        summary, stiffer = folder.summary("array"), 0 if swapped else 1
        fractions = [phase["volume_fraction"] for phase in summary["phases"]]
        c = np.array([fractions[1 - stiffer], fractions[stiffer]])  # of the soft phase and of the stiff one
        lower, upper = (1 / (c / (K + 4 / 3 * g)).sum() - 4 / 3 * g for g in G)
        found = np.array(summary["stiffness"]["PBC"])[:3, :3].mean()
        for name, due in (("hashin_shtrikman_lower", lower), ("hashin_shtrikman_upper", upper)):
            assert abs(np.array(summary["bounds"][name])[:3, :3].mean() / due - 1) < 1e-12, (name, due)
        print(f"cubic array, bulk modulus {found / 1e9:.3f} GPa between {lower / 1e9:.3f} and {upper / 1e9:.3f}")
        assert lower < found < upper and abs(found / (upper if swapped else lower) - 1) < 0.05, (lower, found, upper)


def check_ensemble(folder):
    n, confidence = 4, 0.9
    found = []
    for seed in range(7, 7 + n):
        run(folder, settings_of(Seed=seed), f"seed{seed}")
        found.append(stiffness(folder, f"seed{seed}"))
    for ranks in (1, 2, 5):
        run(folder, settings_of({"Ensemble/Members": n, "Ensemble/Confidence": confidence}, Seed=7), f"all{ranks}", ranks=ranks)
        summary = folder.summary(f"all{ranks}")["ensemble"]
        deviation = np.std(found, axis=0, ddof=1)
        half = stats.t.ppf(0.5 + 0.5 * confidence, n - 1) * deviation / n**0.5
        assert summary["seeds"] == [7, 8, 9, 10], summary["seeds"]
        for name, expected in (("mean", np.mean(found, axis=0)), ("standard_deviation", deviation), ("confidence_half_width", half)):
            error = np.abs(np.array(summary["PBC"][name]) - expected).max() / np.abs(np.mean(found, axis=0)).max()
            print(f"{name} of the ensemble on {ranks} ranks: {error:.1e}")
            assert error < 1e-9
        with h5py.File(folder("seed7", "rve.h5")) as one, h5py.File(folder(f"all{ranks}", "rve.h5")) as all_members:
            assert (one["phase/id"][...] == all_members["phase/id"][...]).all(), "rve.h5 is not that of the first seed"


def check_orientation(folder):
    """A box of one anisotropic phase has its stiffness; that of two layers turns with them."""
    base = {"Dimension": 3, "Grid/Cells": "2, 2, 2", "Grid/Spacing": 1e-3, "Phases/Names": "ply", "Microstructure/Type": "homogeneous",
            "Phases/ply/Type": "orthotropic", "Phases/ply/Young moduli": "140e9, 10e9, 9e9", "Phases/ply/Poisson ratios": "0.3, 0.3, 0.4",
            "Phases/ply/Shear moduli": "5e9, 4e9, 3e9", "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC",
            "Homogenization/Effective symmetry": "full"}
    run(folder, base, "straight")
    D = stiffness(folder, "straight")
    pairs = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))
    C = np.zeros((3, 3, 3, 3))
    for a, (i, j) in enumerate(pairs):
        for b, (k, l) in enumerate(pairs):
            C[i, j, k, l] = C[j, i, k, l] = C[i, j, l, k] = C[j, i, l, k] = D[a, b]
    c1, s1, c, s, c2, s2 = (f(np.radians(angle)) for angle in (30, 50, -70) for f in (np.cos, np.sin))
    g = np.array([[c1 * c2 - s1 * s2 * c, s1 * c2 + c1 * s2 * c, s2 * s],
                  [-c1 * s2 - s1 * c2 * c, -s1 * s2 + c1 * c2 * c, c2 * s], [s1 * s, -c1 * s, c]])  # Bunge (1982)
    turned = np.einsum("pi,qj,rk,sl,pqrs->ijkl", g, g, g, g, C)
    expected = np.array([[turned[i, j, k, l] for k, l in pairs] for i, j in pairs])
    for more in ({"Euler angles": "30, 50, -70"}, {"Axis 1": ", ".join(map(repr, g[0].tolist())), "Axis 2": ", ".join(map(repr, (5 * g[1]).tolist()))}):
        run(folder, base | {"Phases/ply/" + key: value for key, value in more.items()}, "turned")
        error = np.abs(stiffness(folder, "turned") - expected).max() / np.abs(expected).max()
        print(f"turned by {', '.join(more)}: {error:.1e}")
        assert error < 1e-9
    for more, words in (({"Euler angles": "30, 50"}, ["Euler angles", "give three"]), ({"Axis 1": "1, 0, 0"}, ["together"]),
                        ({"Axis 1": "1, 0, 0", "Axis 2": "1, 1, 0"}, ["45 degrees"]),
                        ({"Euler angles": "1, 2, 3", "Angle": 1}, ["contradicts Angle"]),
                        ({"Euler angles": "1, 2, 3", "Axis 1": "1, 0, 0"}, ["contradicts Axis 1"])):
        refuse(folder, base | {"Phases/ply/" + key: value for key, value in more.items()}, words)
    refuse(folder, {"Phases/matrix/Young modulus": 1e9, "Phases/matrix/Euler angles": "1, 2, 3"}, ["Euler angles", "no effect"])
    refuse(folder, {"Phases/Names": "ply", "Phases/ply/Type": "stiffness", "Phases/ply/Stiffness": "4e9, 1e9, 4e9, 1e9",
                    "Phases/ply/Axis 1": "1, 0, 0", "Microstructure/Type": "homogeneous"}, ["Axis 1", "Dimension = 3"])


def refuse(folder, settings, words):
    folder.write("bad.prm", prm(settings))
    said = folder.run(2, "rve_homogenization", "bad.prm", "--output", "bad", "--quiet")
    print(said, end="")
    assert all(word in said for word in words) and not os.path.exists(folder("bad", "rve.h5")), f"{words} not in: {said}"
    assert said.count("\n") == 1, said


def check_refusals(folder):
    for inclusions, words in (
            ({"Volume fraction": 0.7}, ["Volume fraction", "70 % cannot be reached", "spheres of seed 1"]),
            ({"Minimum diameter": 6e-3}, ["Minimum diameter", "swap"]),
            ({"Minimum diameter": 0.5e-3}, ["Minimum diameter", "less than a cell"]),
            ({"Maximum diameter": 13e-3}, ["Maximum diameter", "along z", "0.012"]),
            ({"Maximum diameter": 13e-3, "Sides": "inside"}, ["Maximum diameter", "Sides = cut"]),
            ({"Allow overlap": "true", "Minimum gap": 1e-4}, ["Minimum gap", "contradicts"]),
            ({"Axis ratios": "1, 2, 3"}, ["Axis ratios", "no effect"]),
            ({"Shape": "ellipsoids", "Axis": "x"}, ["Axis", "no effect"]),
            ({"Shape": "bars", "Maximum length": 4e-3}, ["Minimum length", "0 for both"]),
            ({"Shape": "cylinders", "Axis": "x", "Minimum length": 1e-3, "Maximum length": 30e-3}, ["Maximum length", "along x"]),
            ({"Phase": "matrix"}, ["Phase", "background"]),
            ({"Phase": "void"}, ["Phase", "void"])):
        refuse(folder, settings_of(**inclusions), words)
    refuse(folder, settings_of({"Dimension": 2, "Grid/Cells": "4, 4"}), ["Type", "Dimension = 3"])
    refuse(folder, settings_of({"Microstructure/Type": "homogeneous"}), ["Random inclusions", "no effect"])


def main():
    with tempfile.TemporaryDirectory() as path:
        for check in (check_refusals, check_orientation, check_shapes, check_bounds, check_ensemble):
            check(Folder(path))


main()
