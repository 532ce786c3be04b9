"""Orientations of cells, from files: boxes of voxels against the finite element code in scipy and closed forms.

Stiffnesses are turned as tensors of rank four with Bunge's matrix. One phase with another orientation in each cell, and two phases with
more materials than fit a byte (angles of the isotropic one are nan): KUBC, SUBC, PBC on one, two and three ranks, stiffness to 1e-10 of
the largest entry, tensors of all cells to 1e-8, phase means and stresses under a load. The same orientation everywhere gives the bits of
the turned phase, a laminate of two grains the exact stiffness, a polycrystal of cubic crystals Reuss <= SUBC <= PBC <= KUBC <= Voigt.
Rounded angles are those of NumPy. All kinds of files give the same; what is wrong is refused.
"""

import os
import tempfile

import h5py
import numpy as np

from brick_elements import PAIRS, effective
from scenes import Folder, prm

SEED = 815
CONDITIONS = ("KUBC", "SUBC", "PBC")
H = (1e-3, 0.7e-3, 1.4e-3)  # m
CRYSTAL = {"Type": "orthotropic", "Young moduli": "240e9, 60e9, 90e9", "Poisson ratios": "0.2, 0.25, 0.3", "Shear moduli": "40e9, 30e9, 50e9"}
SOFT = {"Young modulus": "30e9", "Poisson ratio": 0.3}


def orthotropic(moduli, ratios, shear):
    S = np.diag([1 / m for m in (*moduli, shear[2], shear[1], shear[0])])
    for (i, j), nu in zip(((0, 1), (0, 2), (1, 2)), ratios):
        S[i, j] = S[j, i] = -nu / moduli[i]
    return np.linalg.inv(S)


STIFFNESS = orthotropic((240e9, 60e9, 90e9), (0.2, 0.25, 0.3), (40e9, 30e9, 50e9))
ISOTROPIC = orthotropic((30e9,) * 3, (0.3,) * 3, (30e9 / 2.6,) * 3)


def turned(D, angles):
    """D turned by Bunge's angles (degrees), as 81 entries."""
    phi1, Phi, phi2 = np.radians(angles)
    about_z = lambda a: np.array([[np.cos(a), np.sin(a), 0], [-np.sin(a), np.cos(a), 0], [0, 0, 1]])  # noqa: E731
    about_x = np.array([[1, 0, 0], [0, np.cos(Phi), np.sin(Phi)], [0, -np.sin(Phi), np.cos(Phi)]])
    g = about_z(phi2) @ about_x @ about_z(phi1)  # from the box to the crystal
    C = np.zeros((3, 3, 3, 3))
    for I, (i, j) in enumerate(PAIRS):
        for J, (k, m) in enumerate(PAIRS):
            for a, b in ((i, j), (j, i)):
                for c, d in ((k, m), (m, k)):
                    C[a, b, c, d] = D[I, J]
    C = np.einsum("ia,jb,kc,md,ijkm->abcd", g, g, g, g, C)
    return np.array([[C[(*p, *q)] for q in PAIRS] for p in PAIRS])


def settings_of(shape, phases, conditions=CONDITIONS, h=H, **more):
    settings = {"Dimension": 3, "Phases/Names": ", ".join(phases), "Homogenization/Boundary conditions": ", ".join(conditions),
                "Homogenization/Effective": conditions[-1], "Homogenization/Effective symmetry": "full", "Homogenization/Tolerance": 1e-12,
                "Grid/Cells": ", ".join(map(str, shape[::-1])), "Grid/Spacing": ", ".join(map(str, h)), "Microstructure/Type": "homogeneous"}
    for name, keys in phases.items():
        settings |= {f"Phases/{name}/{key}": value for key, value in keys.items()}
    return settings | more


def run(folder, name, settings, ranks=1):
    folder.write(f"{name}.prm", prm(settings))
    folder.run(0, "rve_homogenization", f"{name}.prm", "--output", name, "--quiet", ranks=ranks)
    return folder.summary(name)


def close(found, expected, tolerance, what):
    error = np.abs(np.asarray(found) - expected).max() / np.abs(expected).max()
    print(f"{what:48s} {error:.1e}")
    assert error < tolerance, f"{what}: {found} instead of {expected}"


def check_against_elements(folder, name, ids, stiffness, settings, phase, all_ranks):
    """@p ids [nz][ny][nx] are those of the stiffnesses, @p phase that of each."""
    expected = {condition: effective(ids, stiffness, H, condition) for condition in CONDITIONS}
    macro = np.array([1e-3, -2e-4, 0, 3e-4, 0, 5e-4])
    load = {"Loads/Names": "pull"} | {f"Loads/pull/Strain {name}": strain for name, strain in zip(("xx", "yy", "zz", "yz", "xz", "xy"), macro)}
    for ranks in all_ranks:
        summary = run(folder, f"{name}{ranks}", settings | load, ranks)
        for condition in CONDITIONS:
            D, tensors = expected[condition]
            close(summary["stiffness"][condition], D, 1e-10, f"{name}, {condition}, {ranks} ranks")
            with h5py.File(folder(f"{name}{ranks}", "rve.h5")) as file:
                stored = ("/stress_concentration/" if condition == "SUBC" else "/concentration/") + condition
                close(file[stored][...], tensors, 1e-8, f"tensors of {condition}")
                angles = file["orientation/euler_angles"][...][file["orientation/id"][...]]
                assert file.attrs["format_version"] == 2 and (file["phase/id"][...] == phase[ids]).all() and angles.shape == (*ids.shape, 3)
            amplitude = D @ macro if condition == "SUBC" else macro
            local = tensors @ amplitude
            stress = local if condition == "SUBC" else np.einsum("zyxij,zyxj->zyxi", stiffness[ids], local)
            with h5py.File(folder(f"{name}{ranks}", "loads.h5")) as file:
                close(file[f"loads/pull/{condition}/stress"][...], stress, 1e-8, "stresses under a load")
            check_table(folder, f"{name}{ranks}", condition, stress, phase[ids])


def check_ranks(folder, name, all_ranks):
    """Materials have the numbers that one rank gives them, in its file and in a draft."""
    for ranks in all_ranks:
        folder.run(0, "rve_homogenization", f"{name}{ranks}.prm", "--validate", "--draft", f"draft-{name}{ranks}", ranks=ranks)
        for made in (f"{name}{ranks}", f"draft-{name}{ranks}"):
            with h5py.File(folder(f"{name}1", "rve.h5")) as one, h5py.File(folder(made, "rve.h5")) as other:
                for dataset in ("phase/id", "orientation/id", "orientation/phase", "orientation/euler_angles"):
                    assert (one[dataset][...] == other[dataset][...]).all() and one[dataset].dtype == other[dataset].dtype, (made, dataset)


def check_table(folder, name, condition, stress, phases):
    """Means of the stresses over the phases."""
    with open(folder(name, "loads.csv")) as file:
        rows = [line.rstrip().split(",") for line in file]
    column = {heading: k for k, heading in enumerate(rows[0])}
    for number, phase in enumerate(("soft", "crystal")[-(phases.max() + 1):]):
        means = [float(row[column["mean"]]) for row in rows[1:]
                 if row[column["condition"]] == condition and row[column["phase"]] == phase and row[column["quantity"]].startswith("stress_")]
        close(means[:6], stress[phases == number].mean(axis=0), 1e-8, f"mean stress in {phase}")


def random_angles(shape, seed=SEED):
    return np.random.default_rng(seed).uniform((0, 0, 0), (360, 180, 360), (*shape, 3))


def check_one_phase(folder):
    angles = random_angles((6, 5, 4))
    np.save(folder("angles.npy"), angles)
    stiffness = np.array([turned(STIFFNESS, a) for a in angles.reshape(-1, 3)])
    settings = settings_of((6, 5, 4), {"crystal": CRYSTAL}) | {"Microstructure/Orientation file": "angles.npy"}
    check_against_elements(folder, "one", np.arange(120).reshape(6, 5, 4), stiffness, settings, np.zeros(120, int), (1, 2, 3))
    check_ranks(folder, "one", (1, 2, 3))
    said = folder.run(0, "rve_homogenization", "one1.prm", "--validate")
    assert "Orientations: angles of angles.npy, 120 different pairs of phase and orientation" in said, said
    bounds = folder.summary("one1")["bounds"]
    close(bounds["voigt"], stiffness.mean(axis=0), 1e-12, "Voigt's bound")
    close(bounds["reuss"], np.linalg.inv(np.linalg.inv(stiffness).mean(axis=0)), 1e-12, "Reuss' bound")


def check_many_materials(folder):
    """More than 255, for which the kernels have two bytes a cell."""
    shape = (6, 7, 8)
    angles = random_angles(shape)
    phases = (np.random.default_rng(SEED).random(shape) < 0.9).astype(np.uint8)
    angles[phases == 0] = np.nan
    np.save(folder("many_angles.npy"), angles)
    np.save(folder("phases.npy"), phases)
    stiffness = np.array([ISOTROPIC if np.isnan(a[0]) else turned(STIFFNESS, a) for a in angles.reshape(-1, 3)])
    settings = settings_of(shape, {"soft": SOFT, "crystal": CRYSTAL}) | {
        "Microstructure/Type": "voxels", "Microstructure/File": "phases.npy", "Microstructure/Orientation file": "many_angles.npy"}
    check_against_elements(folder, "many", np.arange(phases.size).reshape(shape), stiffness, settings, phases.ravel(), (1, 2))
    check_ranks(folder, "many", (1, 2))
    said = folder.run(0, "rve_homogenization", "many1.prm", "--validate")
    n = int(phases.sum()) + 1
    assert n > 255 and f"{n} different pairs" in said and "isotropic phases do not count: soft" in said, said


def check_same(folder):
    """One orientation is that of the phase, bit by bit; an own orientation of the phase comes first."""
    h, angles = H, (30, 50, -70)
    np.save(folder("same.npy"), np.broadcast_to(np.array(angles, float), (4, 4, 4, 3)))
    np.save(folder("zero.npy"), np.zeros((4, 4, 4, 3)))
    phases = np.random.default_rng(SEED).integers(0, 2, (4, 4, 4)).astype(np.uint8)
    np.save(folder("two.npy"), phases)
    of_voxels = {"Microstructure/Type": "voxels", "Microstructure/File": "two.npy"}
    of_phase = {"soft": SOFT, "crystal": CRYSTAL | {"Euler angles": "%d, %d, %d" % angles}}
    expected = run(folder, "phase", settings_of(phases.shape, of_phase, h=h) | of_voxels)
    for name, phase, file in (("cells", {"soft": SOFT, "crystal": CRYSTAL}, "same.npy"), ("zeros", of_phase, "zero.npy")):
        found = run(folder, name, settings_of(phases.shape, phase, h=h) | of_voxels | {"Microstructure/Orientation file": file})
        assert found["stiffness"] == expected["stiffness"], (found["stiffness"], expected["stiffness"])


def check_laminate(folder):
    """Layers of two grains across each axis: the stress across them and the strains along them are uniform."""
    grains = {7: (20.0, 35.0, -50.0), -2: (100.0, 70.0, 10.0)}
    with open(folder("grains.csv"), "w") as file:
        file.write("grain,phi1 [degrees],Phi [degrees],phi2 [degrees]\n" + "".join(f"{n},{a},{b},{c}\n" for n, (a, b, c) in grains.items()))
    stiffness = [turned(STIFFNESS, angles) for angles in grains.values()]
    for axis in range(3):
        ids = np.full((3, 4, 5), 7, np.int16)
        np.moveaxis(ids, 2 - axis, 0)[1] = -2
        np.save(folder("grains.npy"), ids)
        f = 1 / ids.shape[2 - axis]
        across = [row for row, pair in enumerate(PAIRS) if axis in pair]
        along = [row for row in range(6) if row not in across]
        mean = lambda values: (1 - f) * values[0] + f * values[1]  # noqa: E731
        inverse = [np.linalg.inv(D[np.ix_(across, across)]) for D in stiffness]
        A = np.linalg.inv(mean(inverse))
        coupling = [i @ D[np.ix_(across, along)] for i, D in zip(inverse, stiffness)]
        expected = np.zeros((6, 6))
        expected[np.ix_(across, across)] = A
        expected[np.ix_(across, along)] = A @ mean(coupling)
        expected[np.ix_(along, across)] = (A @ mean(coupling)).T
        expected[np.ix_(along, along)] = mean([D[np.ix_(along, along)] - D[np.ix_(along, across)] @ c for D, c in zip(stiffness, coupling)]) \
            + mean(coupling).T @ A @ mean(coupling)
        settings = settings_of(ids.shape, {"crystal": CRYSTAL}, ("PBC",)) | {
            "Microstructure/Orientation file": "grains.npy", "Microstructure/Orientation table": "grains.csv"}
        close(run(folder, "laminate", settings)["stiffness"]["PBC"], expected, 1e-9, "laminate across " + "xyz"[axis])
    said = folder.run(0, "rve_homogenization", "laminate.prm", "--validate")
    assert "2 grains of grains.npy with the angles of grains.csv, 2 different pairs" in said, said


def check_polycrystal(folder):
    """Copper: Reuss <= SUBC <= PBC <= KUBC <= Voigt, as matrices and strictly where the crystals differ."""
    copper = {"Type": "stiffness", "Stiffness": "168e9, 121e9, 121e9, 168e9, 121e9, 168e9, 75e9, 75e9, 75e9"}
    np.save(folder("copper.npy"), random_angles((7, 7, 7)).astype(np.float32))
    summary = run(folder, "copper", settings_of((7, 7, 7), {"copper": copper}, h=(1e-4,) * 3) | {"Microstructure/Orientation file": "copper.npy"})
    D = {name: np.array(value) for name, value in summary["stiffness"].items() if value is not None}
    chain = [("Reuss", np.array(summary["bounds"]["reuss"])), *((name, D[name]) for name in ("SUBC", "PBC", "KUBC")),
             ("Voigt", np.array(summary["bounds"]["voigt"]))]
    for (lower_name, lower), (upper_name, upper) in zip(chain, chain[1:]):
        values = np.linalg.eigvalsh(upper - lower + (upper - lower).T) / 2
        print(f"{upper_name} - {lower_name}: eigenvalues from {values.min() / 1e9:.3f} to {values.max() / 1e9:.3f} GPa")
        assert values.min() > -1e-6 * np.abs(upper).max() and values.max() > 1e-3 * np.abs(upper).max(), (lower_name, upper_name, values)
    # The bulk modulus of a cubic crystal is that of all its polycrystals.
    close([value[:3, :3].sum() / 9 for _, value in chain], np.full(5, 410e9 / 3), 1e-8, "bulk modulus")


def check_rounded(folder):
    angles = random_angles((3, 3, 3), 4)
    np.save(folder("exact.npy"), angles)
    rounded = 7.5 * np.round(angles / 7.5)
    np.save(folder("rounded.npy"), rounded)
    settings = settings_of((3, 3, 3), {"crystal": CRYSTAL})
    expected = run(folder, "rounded", settings | {"Microstructure/Orientation file": "rounded.npy"})["stiffness"]["PBC"]
    exact = {**settings, "Microstructure/Orientation file": "exact.npy", "Microstructure/Orientation step": 7.5}
    close(run(folder, "exact", exact)["stiffness"]["PBC"], np.array(expected), 1e-12, "rounded angles")
    axes = [np.array([[turned_axes(a) for a in field.reshape(-1, 3)]])[0] for field in (angles, rounded)]
    largest = max(np.degrees(np.arccos(min(1, (np.trace(a.T @ b) - 1) / 2))) for a, b in zip(*axes))
    said = folder.run(0, "rve_homogenization", "exact.prm", "--validate")
    assert f"angles rounded to 7.5 degrees, which turns a cell by up to {largest:.4g} degrees" in said, (largest, said)


def turned_axes(angles):
    """Axes of the material as columns."""
    phi1, Phi, phi2 = np.radians(angles)
    about_z = lambda a: np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])  # noqa: E731
    return about_z(phi1) @ np.array([[1, 0, 0], [0, np.cos(Phi), -np.sin(Phi)], [0, np.sin(Phi), np.cos(Phi)]]) @ about_z(phi2)


def check_files(folder):
    """Every kind of file, and a part of the voxels."""
    angles = np.round(random_angles((4, 3, 5), 6))
    np.save(folder("plain.npy"), angles)
    np.save(folder("fortran.npy"), np.asfortranarray(angles.astype(">f4")))
    angles.tofile(folder("plain.raw"))
    angles.astype(np.int16).tofile(folder("short.raw"))
    angles.astype(">f4").tofile(folder("big.raw"))
    np.save(folder("radians.npy"), np.radians(angles))
    with h5py.File(folder("plain.h5"), "w") as file:
        file["a/angles"] = angles
    all_voxels = np.zeros((6, 5, 9, 3))
    all_voxels[1:5, 2:5, 3:8] = angles
    np.save(folder("all.npy"), all_voxels)
    np.save(folder("all_phases.npy"), np.arange(270).reshape(6, 5, 9) % 2)
    cropped = {"Microstructure/Type": "voxels", "Microstructure/File": "all_phases.npy", "Phases/soft/Young modulus": "30e9",
               "Phases/Names": "soft, crystal", "Microstructure/Crop from": "3, 2, 1", "Microstructure/Crop size": "5, 3, 4"}
    np.save(folder("part.npy"), (np.arange(270).reshape(6, 5, 9) % 2)[1:5, 2:5, 3:8])
    part = cropped | {"Microstructure/File": "part.npy", "Microstructure/Crop from": "", "Microstructure/Crop size": ""}
    settings = settings_of((4, 3, 5), {"crystal": CRYSTAL}, ("PBC",))

    def stiffness(file, more):
        return run(folder, "file", settings | {"Microstructure/Orientation file": file} | more)["stiffness"]["PBC"]

    expected = stiffness("plain.npy", {})
    for file, more in (("fortran.npy", {}), ("plain.raw", {}), ("short.raw", {"Microstructure/Orientation raw type": "int16"}),
                       ("big.raw", {"Microstructure/Orientation raw type": "float32", "Microstructure/Orientation raw byte order": "big"}),
                       ("plain.h5", {"Microstructure/Orientation dataset": "a/angles"})):
        assert stiffness(file, more) == expected, file
    folder.write("bad.prm", prm(settings | {"Microstructure/Orientation file": "big.raw", "Microstructure/Orientation raw type": "float32"}))
    said = folder.run(2, "rve_homogenization", "bad.prm", "--output", "bad", "--quiet")
    assert "check Orientation raw type and Orientation raw byte order" in said, said
    folder.write("radians.prm", prm(settings | {"Microstructure/Orientation file": "radians.npy"}))
    assert "are they radians?" in folder.run(0, "rve_homogenization", "radians.prm", "--validate")
    assert stiffness("all.npy", cropped) == stiffness("plain.npy", part) != expected


def check_refused(folder):
    good = np.zeros((3, 3, 3, 3))
    settings = settings_of((3, 3, 3), {"crystal": CRYSTAL})
    bad = good.copy()
    bad[2, 0, 1, 1] = np.nan
    grains = np.ones((3, 3, 3), int)
    heading = "grain,phi1 [degrees],Phi [degrees],phi2 [degrees]\n"
    table = {"Microstructure/Orientation table": "bad.csv"}
    for array, text, more, words in (
            (bad, "", {}, ["voxel [2][0][1]", "nan or infinity"]),
            (good[..., 0], "", {}, ["[3][3][3]", "[z][y][x][3]"]),
            (good[..., :2], "", {}, ["[3][3][3][2]", "[z][y][x][3]"]),
            (good[:2], "", {}, ["array [2][3][3] of voxels", "those of the phases are [3][3][3]"]),
            (good, "", {"Phases/crystal/Type": "isotropic", "Phases/crystal/Young modulus": "1e9", "Phases/crystal/Young moduli": "",
                        "Phases/crystal/Poisson ratios": "", "Phases/crystal/Shear moduli": ""}, ["all phases are isotropic"]),
            (good, heading + "1, 0, 0, 0\n", table, ["three axes"]),
            (grains.astype(float), heading + "1, 0, 0, 0\n", table, ["grains are whole numbers"]),
            (grains, heading + "2, 0, 0, 0\n", table, ["voxel [0][0][0] is of grain 1, which has no line in"]),
            (grains, heading + "1, 0, 0, 0\n1, 0, 0, 0\n", table, ["bad.csv:3", "grain 1 stands in two lines"]),
            (grains, heading + "2.5, 0, 0, 0\n", table, ["bad.csv:2", "grain 2.5 is no whole number"]),
            (grains, "grain,phi1\n1,2\n", table, ["no column 'phi1 [degrees]'"]),
            (good + 721, "", {}, ["voxel [0][0][0] has the angle 721 degrees", "two turns are 720"]),
            (grains, heading + "1, 0, 0, 1e30\n", table, ["bad.csv:2", "beyond two turns"]),
            (good, "", {"Microstructure/Orientation dataset": "a"}, ["Orientation dataset", "does not end in .h5"]),
            (good, "", {"Microstructure/Orientation step": -1}, ["Orientation step"])):
        np.save(folder("bad.npy"), array)
        folder.write("bad.csv", text)
        folder.write("bad.prm", prm(settings | {"Microstructure/Orientation file": "bad.npy"} | more))
        said = folder.run(2, "rve_homogenization", "bad.prm", "--output", "bad", "--quiet")
        assert all(word in said for word in words) and not os.path.exists(folder("bad", "rve.h5")), f"{words} not in: {said}"
    folder.write("bad.prm", prm(settings | {"Microstructure/Orientation step": 1}))
    assert "Orientation file is empty" in folder.run(2, "rve_homogenization", "bad.prm", "--output", "bad")
    # Too many, and what helps.
    n = 41
    np.save(folder("bad.npy"), random_angles((n, n, n)))
    crowd = settings_of((n, n, n), {"crystal": CRYSTAL}) | {"Microstructure/Orientation file": "bad.npy"}
    folder.write("bad.prm", prm(crowd))
    said = folder.run(2, "rve_homogenization", "bad.prm", "--output", "bad")
    assert f"{n**3} different pairs" in said and "up to 65535" in said and "set Microstructure/Orientation step" in said, said
    folder.write("bad.prm", prm(crowd | {"Microstructure/Orientation step": 10}))
    assert "rounded to 10 degrees" in folder.run(0, "rve_homogenization", "bad.prm", "--validate")


def main():
    print("seed", SEED)
    with tempfile.TemporaryDirectory() as path:
        for check in (check_refused, check_files, check_same, check_rounded, check_laminate, check_polycrystal, check_one_phase,
                      check_many_materials):
            check(Folder(path))


main()
