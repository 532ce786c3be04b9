"""Thermal expansion and stresses of a volume.

A laminate has the thermal stress of the closed form on grids, voxels and meshes. Of two isotropic phases the effective thermal stress is
Levin's, a unidirectional composite expands as Rosen and Hashin say, and the stresses of the cells are those of the uniform field that leaves
the phases without a difference (Dvorak). Of several phases, turned, full or nearly incompressible, the solved case agrees with reciprocity
under every condition. Phases that expand alike have no stress when they are heated, under whatever condition. Stresses of the cells of a
plane grid are those of a direct solve in numpy. One, two and three ranks agree.
"""

import csv
import tempfile

import h5py
import numpy as np

import independent_finite_elements as plane
from independent_finite_elements import HX, HY, I, J, NODES, NX, NY
from macroscopic_loads import close, fields, run, stiffness

from derivatives import VOXELS, constants, keys
from mesh_files import Box
from scenes import Folder, prm

SEED = 453
CONDITIONS = ("KUBC", "SUBC", "PBC", "MUBC")
COMMON = {"Homogenization/Boundary conditions": ", ".join(CONDITIONS), "Homogenization/Effective": "PBC", "Homogenization/Tolerance": 1e-12,
          "Homogenization/Effective symmetry": "full"}
TWO = {"Phases/Names": "soft, stiff", "Phases/soft/Young modulus": 30e9, "Phases/soft/Poisson ratio": 0.3, "Phases/stiff/Young modulus": 240e9,
       "Phases/stiff/Poisson ratio": 0.2}
ALPHA = np.array([5e-6, 1e-6])  # soft, stiff
EXPAND = {"Phases/soft/Thermal expansion": ALPHA[0], "Phases/stiff/Thermal expansion": ALPHA[1]}
PLANE = {"Grid/Cells": "10, 12", "Grid/Size": "10e-3, 12e-3", "Microstructure/Type": "image", "Microstructure/File": "two.txt"}
SPACE = {"Dimension": 3, "Grid/Cells": "5, 4, 3", "Grid/Spacing": "1e-3, 1.3e-3, 0.8e-3", "Microstructure/Type": "voxels",
         "Microstructure/File": "two.npy"}
CELLS = np.random.default_rng(SEED).choice(2, size=(12, 10))  # from above


def thermal_stress(dim):
    """Of both phases, Pa/K: in 2D of plane strain."""
    D = stiffness(3)[:, :3, :3] @ np.ones(3)
    beta = np.zeros((2, 3 * dim - 3))
    beta[:, :dim] = (D * ALPHA[:, None])[:, :dim]
    return beta


def check_laminate(folder):
    """A tenth of layers across x of the phases of the paper."""
    paper = {**TWO, **EXPAND, "Phases/soft/Poisson ratio": 0.2, "Homogenization/Boundary conditions": "PBC, MUBC", "Homogenization/Effective": "PBC",
             "Homogenization/Tolerance": 1e-12}
    folder.write("layers.txt", "1 0 0 0 0 0 0 0 0 0\n" * 2)
    np.save(folder("layers.npy"), np.tile((np.arange(10) == 0).astype(np.uint8), (2, 2, 1)))
    volumes = {"grid": {"Grid/Cells": "10, 2", "Grid/Size": "1e-3, 2e-4", "Microstructure/Type": "image", "Microstructure/File": "layers.txt"},
               "voxels": {"Dimension": 3, "Grid/Cells": "10, 2, 2", "Grid/Spacing": "1e-4, 1e-4, 1e-4", "Microstructure/Type": "voxels",
                          "Microstructure/File": "layers.npy"}}
    for dim, kind in ((2, "cube"), (2, "simplex"), (3, "cube"), (3, "simplex")):
        size, name = (10, 2, 2)[:dim], f"{kind}{dim}"
        Box([float(m) for m in size], size, lambda x: ("soft", "stiff")[int(x[0] < 1)], kind).write(folder(name + ".msh"))
        volumes[name] = {"Dimension": dim, "Mesh/File": name + ".msh", "Mesh/Scale": 1e-4}
    for name, volume in volumes.items():
        found = run(folder, "laminate" + name, {**paper, **volume})
        for condition in ("PBC", "MUBC"):
            beta = found["thermal_stress"][condition]
            close(beta[:2], [0.25205479e6, 0.26176370e6], 1e-7, f"thermal stress of a laminate, {name}, {condition}")
            assert np.abs(beta[-1]) < 1e-6 * beta[0] and found["expansion_residual"][condition] < 1e-9
        if name in ("grid", "cube2", "simplex2"):
            close(found["expansion"]["effective"][:2], [5.964706e-6, 3.741176e-6], 1e-6, f"its expansion, {name}")


def levin(D, C, beta, share):
    mean = (1 - share) * beta[0] + share * beta[1]
    return mean + (D - (1 - share) * C[0] - share * C[1]) @ np.linalg.solve(C[1] - C[0], beta[1] - beta[0])


def uniform_field(name, folder, condition, dim):
    """Stresses of the cells from the concentration tensors: with the strain E of C_1 E - beta_1 = C_2 E - beta_2, a uniform stress, less the
    unit cases that this state of the sides is."""
    C, beta = stiffness(dim), thermal_stress(dim)
    E = np.linalg.solve(C[1] - C[0], beta[1] - beta[0])
    with h5py.File(folder(name, "rve.h5")) as file:
        phase = file["phase/id"][()].ravel()
        found = file[f"thermal_stress/{condition}"][()].reshape(len(phase), -1)
        group = "stress_concentration" if condition == "SUBC" else "concentration"
        tensor = file[f"{group}/{condition}"][()].reshape(len(phase), *C[0].shape)
        assert file[f"thermal_stress/{condition}"].attrs["unit"] in ("Pa/K", b"Pa/K")
    uniform = C[0] @ E - beta[0]
    taken = tensor @ uniform if condition == "SUBC" else np.einsum("nij,nj->ni", C[phase], tensor @ E)
    return found, uniform - taken


def check_two_phases(folder):
    folder.write("two.txt", "\n".join(" ".join(map(str, row)) for row in CELLS) + "\n")
    two = (VOXELS > 0).astype(np.uint8)
    np.save(folder("two.npy"), two)
    volumes = [(f"plane_{solver}", 2, CELLS.mean(), {**PLANE, "Homogenization/Solver": solver}) for solver in ("multigrid", "jacobi", "divided", "ml")]
    volumes.append(("space", 3, two.mean(), SPACE))
    for name, dim, share, volume in volumes:
        for ranks in ((1, 2) if dim == 2 else (1, 2, 3)):
            found = run(folder, name, {**TWO, **EXPAND, **COMMON, **volume}, ranks)
            for condition in CONDITIONS:
                what = f"{name}, {condition}, {ranks} ranks: "
                D, beta = np.array(found["stiffness"][condition]), np.array(found["thermal_stress"][condition])
                if condition != "MUBC":  # which has the normal components alone
                    close(beta, levin(D, stiffness(dim), thermal_stress(dim), share), 1e-8, what + "Levin")
                close(np.array(found["expansion"][condition]), np.linalg.solve(D, beta), 1e-10, what + "expansion")
                assert found["expansion_residual"][condition] < 1e-8, found["expansion_residual"]
                local, expected = uniform_field(f"{name}{ranks}", folder, condition, dim)
                if condition != "MUBC":
                    close(local, expected, 1e-8, what + "stresses of the cells")


def check_unidirectional(folder):
    """Round fibres along z on voxels one cell deep: Rosen and Hashin (1970) with the moduli found."""
    n = 12
    x, y = np.meshgrid(*(np.arange(n) + 0.5 - n / 2,) * 2)
    np.save(folder("fibre.npy"), (x**2 + y**2 < 16)[None].astype(np.uint8))
    found = run(folder, "fibre", {**TWO, **EXPAND, **COMMON, "Dimension": 3, "Grid/Cells": f"{n}, {n}, 1", "Grid/Spacing": "1e-3, 1e-3, 1e-3",
                                  "Microstructure/Type": "voxels", "Microstructure/File": "fibre.npy", "Homogenization/Boundary conditions": "PBC"})
    share, moduli = (x**2 + y**2 < 16).mean(), found["engineering_constants"]
    K = np.array([30e9 / (3 * 0.4), 240e9 / (3 * 0.6)])
    mean_alpha, mean_1_K = ((1 - share) * a[0] + share * a[1] for a in (ALPHA, 1 / K))
    slope = (ALPHA[1] - ALPHA[0]) / (1 / K[1] - 1 / K[0])
    nu, E = moduli["nu_zx"], moduli["E_z"]
    along = mean_alpha + slope * (3 * (1 - 2 * nu) / E - mean_1_K)
    transverse_k = 1 / (1 / np.array(found["stiffness"]["PBC"])[:2, :2].mean())  # D11 + D12 over two
    across = mean_alpha + slope * (3 / (2 * transverse_k) - 3 * nu * (1 - 2 * nu) / E - mean_1_K)
    close(found["expansion"]["PBC"][:3], [across, across, along], 1e-8, "unidirectional composite: Rosen and Hashin")


def check_kinds(folder):
    """Three phases of all types; reciprocity against the solved case, and phases that expand alike."""
    folder.write("cells.txt", "\n".join(" ".join(map(str, row)) for row in np.vstack(VOXELS)) + "\n")
    np.save(folder("cells.npy"), VOXELS.astype(np.uint8))
    np.save(folder("angles.npy"), np.random.default_rng(SEED).uniform((0, 0, 0), (360, 180, 360), (3, 4, 5, 3)))
    voxels = {"Dimension": 3, "Grid/Cells": "5, 4, 3", "Grid/Spacing": "1e-3, 1.3e-3, 0.8e-3", "Microstructure/Type": "voxels",
              "Microstructure/File": "cells.npy"}
    volumes = {"flat": (2, {"Grid/Cells": "5, 12", "Grid/Size": "5e-3, 9e-3", "Microstructure/Type": "image", "Microstructure/File": "cells.txt",
                            "Microstructure/Oblong pixels": "true"}),
               "voxels": (3, voxels), "grains": (3, {**voxels, "Microstructure/Orientation file": "angles.npy"})}
    for dim, kind, degree in ((2, "cube", 1), (2, "simplex", 2), (3, "cube", 1), (3, "simplex", 2)):
        size, name = (5, 4, 3)[:dim] if degree == 1 else (3, 2, 2)[:dim], f"mesh{kind}{dim}"
        Box([float(m) for m in size], size, lambda x: ("soft", "wood", "crystal")[VOXELS[tuple(np.resize(np.floor(x).astype(int), 3) % 3)]],
            kind).write(folder(name + ".msh"))
        volumes[name] = (dim, {"Dimension": dim, "Mesh/File": name + ".msh", "Mesh/Scale": 1e-3, "Mesh/Degree": degree})
    heated = {"Loads/Names": "free", "Loads/free/Temperature change": 80, "Loads/Boundary conditions": "KUBC, SUBC, PBC"}
    for name, (dim, volume) in volumes.items():
        phases = constants(dim, 0.49)
        settings = {**COMMON, **volume, "Phases/Names": "soft, wood, crystal"}
        for phase, (kind, values, more) in phases.items():
            if dim == 2 and kind == "stiffness":  # says nothing of z
                kind, values = "isotropic", {"E": 40e9, "nu": 0.1}
            settings |= {f"Phases/{phase}/{key}": value for key, value in {"Type": kind, **keys(kind, values), **more}.items()}
        own = {"Phases/soft/Thermal expansion": 3e-5, "Phases/wood/Thermal expansion": "1e-6, 2e-5, 3e-5",
               "Phases/crystal/Thermal expansion": "-1e-6, 4e-6, 9e-6" if dim == 3 else 4e-6}
        for ranks in (1, 2):
            found = run(folder, name, {**settings, **own, **heated}, ranks)
            for condition in CONDITIONS:
                print(f"{name}, {condition}, {ranks} ranks: reciprocity and the solved case {found['expansion_residual'][condition]:.1e}")
                assert found["expansion_residual"][condition] < 1e-9
            for load in found["loads"]:
                what = f"{name}, {load['condition']}, {ranks} ranks: "
                assert max(load["mean_strain_residual"], load["mean_stress_residual"], load["hill_mandel_residual"]) < 1e-9, (what, load)
                close(list(load["strain"].values()) if dim == 2 else [load["strain"][c] for c in ("xx", "yy", "zz", "yz", "xz", "xy")],
                      80 * np.array(found["expansion"][load["condition"]])[[0, 2, 1] if dim == 2 else slice(None)], 1e-9, what + "free expansion")
        alike = {f"Phases/{phase}/Thermal expansion": 7e-6 for phase in phases}
        found = run(folder, name + "alike", {**settings, **alike, **heated})
        for load in found["loads"]:
            largest = max(abs(load["phases"]["all"][f"stress_{c}"][end]) for c in ("xx", "yy", "xy") for end in ("minimum", "maximum"))
            what = f"{name}, {load['condition']}: stress where all phases expand alike"
            if dim == 3:
                print(f"{what} {largest:.1e} Pa")
                assert largest < 1e-9 * 80 * 7e-6 * 60e9 * 10 and abs(load["energy_density"]) < 1e-9 * 60e9 * (80 * 7e-6)**2, (what, largest)
                close([load["strain"][c] for c in ("xx", "yy", "zz")], 80 * 7e-6, 1e-9, "its strain")


def check_direct(folder):
    """The stresses of heat on a plane grid of three phases, from K u = f in numpy."""
    phases = np.random.default_rng(SEED).choice(3, size=(NY, NX))
    E, nu, alpha = np.array([30e9, 240e9, 5e9]), np.array([0.3, 0.2, 0.4]), np.array([5e-6, 1e-6, 4e-5])
    lame, shear = E * nu / (1 + nu) / (1 - 2 * nu), E / 2 / (1 + nu)
    C = np.array([[[m + 2 * g, m, 0], [m, m + 2 * g, 0], [0, 0, g]] for m, g in zip(lame, shear)])
    beta = (3 * lame + 2 * shear)[:, None] * alpha[:, None] * np.array([1.0, 1, 0])
    names = ["a", "b", "c"]
    folder.write("random.txt", "\n".join(" ".join(map(str, row)) for row in phases[::-1]) + "\n")
    settings = {**COMMON, "Phases/Names": ", ".join(names), "Grid/Cells": f"{NX}, {NY}", "Grid/Size": f"{NX * HX}, {NY * HY}",
                "Microstructure/Type": "image", "Microstructure/File": "random.txt", "Microstructure/Oblong pixels": "true",
                "Homogenization/Boundary conditions": "KUBC, SUBC, PBC", "Loads/Names": "warm", "Loads/warm/Temperature change": 50,
                "Loads/warm/Strain xx": 1e-3, "Loads/warm/Stress xy": 2e7}
    for p, name in enumerate(names):
        settings |= {f"Phases/{name}/Young modulus": E[p], f"Phases/{name}/Poisson ratio": nu[p], f"Phases/{name}/Thermal expansion": alpha[p]}
    found = run(folder, "direct", settings)
    B = np.zeros((3, 8))  # of the mean strain, corners 00, 10, 01, 11
    for n, (x, y) in enumerate(((-1, -1), (1, -1), (-1, 1), (1, 1))):
        B[0, 2 * n] = B[2, 2 * n + 1] = x / (2 * HX)
        B[1, 2 * n + 1] = B[2, 2 * n] = y / (2 * HY)
    K, f, dofs = np.zeros((2 * NODES.size,) * 2), np.zeros(2 * NODES.size), {}
    gauss = np.array([-1, 1]) / np.sqrt(3)
    for j in range(NY):
        for i in range(NX):
            nodes = [NODES[j, i], NODES[j, i + 1], NODES[j + 1, i], NODES[j + 1, i + 1]]
            dof = dofs[j, i] = np.array([2 * n + c for n in nodes for c in range(2)])
            for a in gauss:
                for b in gauss:
                    G = np.zeros((3, 8))
                    for n, (x, y) in enumerate(((-1, -1), (1, -1), (-1, 1), (1, 1))):
                        G[0, 2 * n] = G[2, 2 * n + 1] = x * (1 + y * b) / (2 * HX)
                        G[1, 2 * n + 1] = G[2, 2 * n] = y * (1 + x * a) / (2 * HY)
                    K[np.ix_(dof, dof)] += HX * HY / 4 * G.T @ C[phases[j, i]] @ G
            f[dof] += HX * HY * B.T @ beta[phases[j, i]]
    for condition in ("KUBC", "SUBC", "PBC"):
        if condition == "SUBC":
            u = np.linalg.lstsq(K, f, rcond=1e-13)[0]
        else:
            T = plane.columns(~np.repeat(plane.BORDER, 2))
            if condition == "PBC":
                T = plane.columns(np.repeat((I < NX) & (J < NY), 2))
                T = T[(2 * NODES[J % NY, I % NX][:, None] + np.arange(2)).ravel()]
            u = T @ np.linalg.lstsq(T.T @ K @ T, T.T @ f, rcond=1e-13)[0]
        stress = np.array([C[phases[cell]] @ B @ u[dofs[cell]] - beta[phases[cell]] for cell in np.ndindex(NY, NX)])
        with h5py.File(folder("direct1", "rve.h5")) as file:
            close(file[f"thermal_stress/{condition}"][()].reshape(-1, 3), stress, 1e-9, f"{condition}: stresses of a direct solve")
        # The load by superposition, and sigma_zz.
        load = next(one for one in found["loads"] if one["condition"] == condition)
        local, phase = fields(folder, "direct1", "warm", condition)
        close(load["strain"]["xx"], 1e-3, 1e-12, f"{condition}: prescribed strain")
        close([load["stress"]["xy"], load["stress"]["yy"]], [2e7, 0], 1e-9, f"{condition}: prescribed stresses")
        zz = lame[phase] * local["strain"][:, :2].sum(axis=1) - 50 * beta[phase, 0]
        close(local["stress_zz"].ravel(), zz, 1e-10, f"{condition}: sigma_zz")
        D, beta_eff = np.array(found["stiffness"][condition]), np.array(found["thermal_stress"][condition])
        S = D @ [load["strain"][c] for c in ("xx", "yy", "xy")] - 50 * beta_eff
        close([load["stress"][c] for c in ("xx", "yy", "xy")], S, 1e-9, f"{condition}: S = D E - 50 K beta")


def check_plane_energy(folder):
    """A body in plane strain that is free in the plane has sigma_zz = -E alpha T alone. A phase whose stiffness says nothing of z may lie beside one that
    expands, one that expands may have no cells."""
    one = {"Phases/Names": "one", "Phases/one/Young modulus": 3e9, "Phases/one/Poisson ratio": 0.3, "Phases/one/Thermal expansion": 5e-5,
           "Grid/Cells": "4, 3", "Grid/Size": "4e-3, 3e-3", "Microstructure/Type": "homogeneous", "Loads/Names": "warm", "Loads/warm/Temperature change": 10}
    for condition in CONDITIONS:
        found = run(folder, "one", {**one, "Homogenization/Boundary conditions": condition, "Homogenization/Effective": condition})
        load = found["loads"][0]
        close(load["energy_density"], 3e9 * 5e-4**2 / 2, 1e-9, f"energy of a homogeneous body, {condition}")
        close(load["phases"]["one"]["stress_zz"]["mean"], -3e9 * 5e-4, 1e-9, "its sigma_zz")
        close(found["expansion"]["effective"][:2], 1.3 * 5e-5, 1e-9, "its expansion in the plane")
    turned = {**one, "Phases/one/Type": "orthotropic", "Phases/one/Young moduli": "60e9, 15e9, 25e9", "Phases/one/Poisson ratios": "0.25, 0.2, 0.15",
              "Phases/one/Shear moduli": "8e9, 6e9, 5e9", "Phases/one/Angle": 0.4, "Phases/one/Thermal expansion": "1e-6, 2e-5, 3e-5", **COMMON}
    turned = {key: value for key, value in turned.items() if key not in ("Phases/one/Young modulus", "Phases/one/Poisson ratio")}
    for solver in ("multigrid", "divided", "ml"):
        found = run(folder, "turned", {**turned, "Homogenization/Solver": solver})
        assert max(found["expansion_residual"].values()) < 1e-9, (solver, found["expansion_residual"])
    plain = {**TWO, **EXPAND, **PLANE, "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC"}
    unknown = {key: value for key, value in plain.items() if key not in ("Phases/stiff/Young modulus", "Phases/stiff/Poisson ratio",
                                                                      "Phases/stiff/Thermal expansion")}
    run(folder, "unknown", {**unknown, "Phases/stiff/Type": "stiffness", "Phases/stiff/Stiffness": "80e9, 20e9, 70e9, 30e9"})
    with h5py.File(folder("unknown1", "rve.h5")) as file:
        assert "thermal_stress/PBC" in file and "thermal_stress_zz" not in file
    absent = {"Phases/Names": "soft, stiff, absent", "Phases/absent/Young modulus": 1e9, "Phases/absent/Thermal expansion": 1e-3, "Loads/Names": "warm",
              "Loads/warm/Temperature change": 10, "Microstructure/Image values": "0, 1, 2"}
    found = run(folder, "absent", {**{key: value for key, value in plain.items() if "expansion" not in key}, **absent})
    assert np.abs(found["expansion"]["PBC"]).max() == 0 and found["loads"][0]["hill_mandel_residual"] == 0


def check_sentences(folder):
    base = {**TWO, **COMMON, **PLANE, "Loads/Names": "hot", "Loads/hot/Temperature change": 10}
    for name, more, said in (("nothing", {}, "no phase has a Thermal expansion"),
                             ("zero", {"Phases/soft/Thermal expansion": 0}, "no phase has a Thermal expansion"),
                             ("axes", {"Phases/soft/Thermal expansion": "1e-6, 2e-6, 3e-6"}, "differs along axes"), ("two", {"Phases/soft/Thermal expansion": "1e-6, 2e-6"}, "two numbers"),
                             ("full", {"Phases/soft/Thermal expansion": 1e-6, "Phases/soft/Type": "stiffness",
                                       "Phases/soft/Stiffness": "3e10, 1e10, 3e10, 1e10"}, "stiffness along z")):
        settings = {key: value for key, value in {**base, **more}.items() if not (name == "full" and key in ("Phases/soft/Young modulus",
                                                                                                         "Phases/soft/Poisson ratio"))}
        folder.write(name + ".prm", prm(settings))
        out = folder.run(2, "rve_homogenization", name + ".prm", "--output", name)
        assert said in out, out


def check_table(folder):
    with open(folder("plane_multigrid1", "expansion.csv"), encoding="utf-8") as file:
        rows = {row["of"]: row for row in csv.DictReader(file)}
    summary = folder.summary("plane_multigrid1")
    for of, expansion in summary["expansion"].items():
        close([float(rows[of][f"expansion_{c} [1/K]"]) for c in ("xx", "yy", "xy")], expansion, 1e-12, f"expansion.csv, {of}")


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_laminate(folder)
        check_two_phases(folder)
        check_table(folder)
        check_unidirectional(folder)
        check_kinds(folder)
        check_direct(folder)
        check_plane_energy(folder)
        check_sentences(folder)


if __name__ == "__main__":
    main()
