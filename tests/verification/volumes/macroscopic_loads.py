"""Macroscopic loads of rve_homogenization against closed forms and a direct solve in numpy.

A laminate of two phases under uniaxial stress: strains, stresses, sigma_zz and von Mises stress of both phases are those of the closed
form (PBC, MUBC). A random map of three phases under mixed loads: strains and stresses of all cells are those of one
direct solve with the macroscopic strains (SUBC: stresses) as further unknowns. Means of the fields are what was prescribed, the modulus of
a uniaxial stress is the engineering constant. The report draws the loads. macroscopic_loads_kinds.py has the other kinds of volumes.
"""

import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

import independent_finite_elements as plane
from independent_finite_elements import HX, HY, I, J, NODES, NX, NY

from scenes import TOOLS, Folder, prm

E, NU = np.array([30e9, 240e9]), np.array([0.3, 0.2])
LAME, SHEAR = E * NU / (1 + NU) / (1 - 2 * NU), E / 2 / (1 + NU)
PHASES = {"Phases/Names": "soft, stiff", "Homogenization/Tolerance": 1e-12,
          **{f"Phases/{name}/{key}": value for name, e, nu in zip(("soft", "stiff"), E, NU)
             for key, value in (("Young modulus", e), ("Poisson ratio", nu))}}


def close(found, expected, tolerance, what, scale=None):
    error = np.abs(np.subtract(found, expected)).max() / (scale or np.abs(expected).max())
    print(f"{what:70s} {error:.1e}")
    assert error <= tolerance, f"{what}: {found} instead of {expected}"


def fields(folder, name, load, condition):
    """{dataset: values} of a load, cells in one row, and phases."""
    with h5py.File(folder(name, "loads.h5")) as file:
        group, phase = file["loads"][load][condition], file["phase/id"][()].ravel()
        return {key: data[()].reshape(len(phase), -1) for key, data in group.items() if isinstance(data, h5py.Dataset) and
                not key.startswith("macro")}, phase


def run(folder, name, settings, ranks=1):
    folder.write(name + ".prm", prm(settings) if isinstance(settings, dict) else settings)
    folder.run(0, "rve_homogenization", name + ".prm", "--output", f"{name}{ranks}", "--quiet", ranks=ranks)
    return folder.summary(f"{name}{ranks}")


def stiffness(dim):
    D = np.zeros((2, 3 * dim - 3, 3 * dim - 3))
    for p in range(2):
        D[p] = np.diag([2 * SHEAR[p]] * dim + [SHEAR[p]] * (2 * dim - 3))
        D[p][:dim, :dim] += LAME[p]
    return D


def laminate(dim, across, share, known_strain, known_stress):
    """Strains of both phases of layers across an axis: strains in the layers and stresses across them are common. Macroscopic strains or
    stresses are known, {component: value}."""
    D, v = stiffness(dim), 3 * dim - 3
    pairs = [(0, 0), (1, 1), (0, 1)] if dim == 2 else [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    rows, values = [], []
    for k, pair in enumerate(pairs):
        common = D[0][k], -D[1][k]
        rows.append(np.hstack(common if across in pair else [np.eye(v)[k], -np.eye(v)[k]]))
        values.append(0.0)
        if k in known_strain:
            rows.append(np.hstack([(1 - share) * np.eye(v)[k], share * np.eye(v)[k]]))
            values.append(known_strain[k])
        else:
            rows.append(np.hstack([(1 - share) * D[0][k], share * D[1][k]]))
            values.append(known_stress.get(k, 0.0))
    scale = np.abs(rows).max(axis=1)
    strains = np.linalg.solve(np.array(rows) / scale[:, None], np.array(values) / scale)
    return strains.reshape(2, v)


def von_mises(stress, zz=None):
    """Of stresses [n][3] in the plane with sigma_zz, or [n][6]."""
    s = np.zeros((len(stress), 3, 3))
    pairs = [(0, 0), (1, 1), (0, 1)] if zz is not None else [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    for k, (c, d) in enumerate(pairs):
        s[:, c, d] = s[:, d, c] = stress[:, k]
    if zz is not None:
        s[:, 2, 2] = zz
    deviator = s - np.trace(s, axis1=1, axis2=2)[:, None, None] / 3 * np.eye(3)
    return np.sqrt(1.5 * (deviator**2).sum(axis=(1, 2))), np.linalg.eigvalsh(s)[:, ::-1]


def check_laminate(folder):
    """Layers across y, two of five stiff, under uniaxial stress along and across them and a shear."""
    folder.write("layers.txt", "\n".join(" ".join([p] * 4) for p in "01001") + "\n")
    settings = {**PHASES, "Grid/Cells": "4, 5", "Grid/Size": "4e-3, 5e-3", "Microstructure/Type": "image", "Microstructure/File": "layers.txt",
                "Homogenization/Boundary conditions": "PBC, MUBC", "Homogenization/Effective": "PBC", "Loads/Names": "along, across, shear",
                "Loads/along/Stress xx": 100e6, "Loads/across/Stress yy": 80e6, "Loads/across/Strain xx": 1e-4, "Loads/shear/Stress xy": 30e6}
    summary = run(folder, "layers", settings)
    cases = {"along": ({}, {0: 100e6}), "across": ({0: 1e-4}, {1: 80e6}), "shear": ({}, {2: 30e6})}
    for load in summary["loads"]:
        name, condition = load["name"], load["condition"]
        strains = laminate(2, 1, 0.4, *cases[name])
        local, phase = fields(folder, "layers1", name, condition)
        stress = np.einsum("pij,pj->pi", stiffness(2), strains)
        zz = LAME * strains[:, :2].sum(axis=1)
        what = f"laminate {name}, {condition}: "
        for found, expected, of in ((local["strain"], strains, "strain"), (local["stress"], stress, "stress")):
            close(found, expected[phase], 1e-10, what + of)
        close(local["stress_zz"].ravel(), zz[phase], 1e-10, what + "sigma_zz", np.abs(stress).max())
        close(local["von_mises"].ravel(), von_mises(stress, zz)[0][phase], 1e-10, what + "von Mises")
        for p, phase_name in enumerate(("soft", "stiff")):
            numbers = load["phases"][phase_name]["von_mises"]
            assert numbers["standard_deviation"] < 1e-9 * numbers["mean"] and numbers["maximum"] <= numbers["mean"] * (1 + 1e-9)
        close(list(map(load["strain"].get, ("xx", "yy", "xy"))), 0.6 * strains[0] + 0.4 * strains[1], 1e-10, what + "macroscopic strain")
    along = next(load for load in summary["loads"] if load["name"] == "along")
    close(along["stress"]["xx"] / along["strain"]["xx"], summary["engineering_constants"]["E_x"], 1e-12, "E_x of PBC")


def direct(phases, condition, strain, stress):
    """Strains of all cells [n][3] with the macroscopic strains and stresses given, {component: value}, in one solve: the other macroscopic
    strains (SUBC: the tractions of the other stresses) are unknowns."""
    K, _ = plane.assemble(phases, plane.ORDINARY)
    x, y, volume = I * HX, J * HY, NX * NY * HX * HY
    affine = np.zeros((len(K), 3))
    affine[0::2], affine[1::2] = np.stack([x, 0 * x, y / 2], axis=1), np.stack([0 * x, y, x / 2], axis=1)
    if condition == "SUBC":
        tx = ((I == NX) * 1.0 - (I == 0)) * HY * np.where((J == 0) | (J == NY), 0.5, 1)
        ty = ((J == NY) * 1.0 - (J == 0)) * HX * np.where((I == 0) | (I == NX), 0.5, 1)
        f = np.zeros((len(K), 3))
        f[0::2], f[1::2] = np.stack([tx, 0 * tx, ty], axis=1), np.stack([0 * tx, ty, tx], axis=1)
        unknown = sorted(strain)
        # K u = f S; the mean strain f_k . u / V is given where the stress is not.
        size = np.abs(np.diag(K)).max()
        A = np.block([[K / size, -f[:, unknown]], [-f[:, unknown].T, np.zeros((len(unknown),) * 2)]])
        b = np.concatenate([f @ [stress.get(k, 0.0) / size for k in range(3)], [-strain[k] * volume for k in unknown]])
        u = np.linalg.lstsq(A, b, rcond=1e-13)[0][: len(K)]
    else:
        T = plane.columns(~np.repeat(plane.BORDER, 2))
        if condition == "PBC":
            T = plane.columns(np.repeat((I < NX) & (J < NY), 2))
            T = T[(2 * NODES[J % NY, I % NX][:, None] + np.arange(2)).ravel()]
        free = [k for k in range(3) if k not in strain]
        given = affine @ [strain.get(k, 0.0) for k in range(3)]
        T = np.hstack([T, affine[:, free] / np.abs(affine).max()])
        loads = np.zeros(T.shape[1])
        loads[T.shape[1] - len(free) :] = [volume * stress.get(k, 0.0) / np.abs(affine).max() for k in free]
        u = given + T @ np.linalg.lstsq(T.T @ K @ T, loads - T.T @ (K @ given), rcond=1e-13)[0]
    return np.einsum("ij,cj->ci", plane.MEAN, u[plane.DOFS])


def check_direct(folder):
    phases = np.random.default_rng(plane.SEED).choice(3, size=NX * NY, p=[0.5, 0.3, 0.2])
    np.savetxt(folder("map.txt"), phases.reshape(NY, NX)[::-1], fmt="%d")
    cases = {"uniaxial": ({}, {0: 100e6}), "confined": ({1: 0.0}, {0: 50e6, 2: -20e6}), "strained": ({0: 1e-3, 1: -2e-4, 2: 5e-4}, {})}
    settings = {"Grid/Cells": f"{NX}, {NY}", "Grid/Spacing": f"{HX}, {HY}", "Phases/Names": "a, b, c", "Microstructure/Type": "image",
                "Microstructure/File": "map.txt", "Microstructure/Oblong pixels": "true", "Loads/Names": ", ".join(cases),
                "Homogenization/Boundary conditions": "KUBC, SUBC, PBC", "Homogenization/Tolerance": 1e-13}
    for name, d in zip("abc", plane.ORDINARY):
        settings |= {f"Phases/{name}/Type": "stiffness", f"Phases/{name}/Stiffness": ", ".join(map(str, d))}
    for name, (strain, stress) in cases.items():
        for kind, of in (("Strain", strain), ("Stress", stress)):
            settings |= {f"Loads/{name}/{kind} {('xx', 'yy', 'xy')[k]}": value for k, value in of.items()}
    summary = run(folder, "random", settings)
    assert any("sigma_zz" in sentence for sentence in summary["warnings"]), "the plane stiffness says nothing of sigma_zz"
    for load in summary["loads"]:
        strain, stress = cases[load["name"]]
        local, _ = fields(folder, "random1", load["name"], load["condition"])
        assert set(local) == {"strain", "stress"}
        expected = direct(phases, load["condition"], strain, stress)
        what = f"random {load['name']}, {load['condition']}: "
        close(local["strain"], expected, 1e-8, what + "strains of a direct solve")
        close(local["stress"], np.einsum("cij,cj->ci", plane.matrices(plane.ORDINARY)[phases], expected), 1e-8, what + "stresses")
        for kind, given, mean in (("strain", strain, local["strain"].mean(axis=0)), ("stress", stress, local["stress"].mean(axis=0))):
            for k in range(3):
                if k in given or (kind == "stress" and k not in strain):
                    error = abs(mean[k] - given.get(k, 0.0)) / np.abs(mean).max()
                    assert error < 1e-10, f"{what} mean {kind} {k} is off by {error}"
        assert load["hill_mandel_residual"] < 1e-10 and load["mean_strain_residual"] < 1e-10 and load["mean_stress_residual"] < 1e-10, load


def check_report(folder, names):
    """The report draws the loads of these results."""
    for name in names:
        done = subprocess.run([sys.executable, "-B", os.path.join(TOOLS, "report", "make_report.py"), folder(name), "--output", folder("report.html")],
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=True)
        page, n = folder.read("report.html").decode(), len(folder.summary(name)["loads"])
        for words in ("How stresses of the cells", "under the load "):  # as caption and instead of the picture
            assert page.count(words) == 2 * n, (name, words, page.count(words), n, done.stdout)


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_laminate(folder)
        check_direct(folder)
        check_report(folder, ("layers1", "random1"))


if __name__ == "__main__":
    main()
