"""Macroscopic loads of rve_homogenization against closed forms, a direct solve in numpy and themselves.

A laminate of two phases under uniaxial stress: strains, stresses, sigma_zz and von Mises stress of both phases are those of the closed
form (PBC, MUBC; voxels in 3D by PBC). A random map of three phases under mixed loads: strains and stresses of all cells are those of one
direct solve with the macroscopic strains (SUBC: stresses) as further unknowns. Means of the fields are what was prescribed, the modulus of
a uniaxial stress is the engineering constant, statistics, histograms and shares are those of the fields, and 1, 2 and 3 ranks agree, on
grids, meshes and voxels. Ensembles have the means and deviations of their members; the report and the Python module read the files.
"""

import csv
import os
import subprocess
import sys
import tempfile

import h5py
import numpy as np

import independent_finite_elements as plane
from independent_finite_elements import HX, HY, I, J, NODES, NX, NY

from mesh_files import Box  # noqa: E402
from scenes import TOOLS, Folder, prm, rve  # noqa: E402

sys.path.append(os.path.join(TOOLS, "python"))
import mesoslip  # noqa: E402

E, NU = np.array([30e9, 240e9]), np.array([0.3, 0.2])
LAME, SHEAR = E * NU / (1 + NU) / (1 - 2 * NU), E / 2 / (1 + NU)
PHASES = {"Phases/Names": "soft, stiff", "Homogenization/Tolerance": 1e-12,
          **{f"Phases/{name}/{key}": value for name, e, nu in zip(("soft", "stiff"), E, NU)
             for key, value in (("Young modulus", e), ("Poisson ratio", nu))}}


KINDS = {
    "grid": {"Grid/Cells": "8, 6", "Grid/Size": "8e-3, 6e-3", "Microstructure/Type": "image", "Microstructure/File": "plane.txt"},
    "gridml": {"Grid/Cells": "8, 6", "Grid/Size": "8e-3, 6e-3", "Microstructure/Type": "image", "Microstructure/File": "plane.txt",
               "Homogenization/Solver": "ml"},
    "plane": {"Mesh/File": "plane.msh", "Mesh/Scale": 1e-3},
    "bricks": {"Mesh/File": "bricks.msh", "Mesh/Scale": 1e-3},
    "tetrahedra": {"Mesh/File": "tetrahedra.msh", "Mesh/Scale": 1e-3},
    "voxels": {"Grid/Cells": "4, 5, 6", "Grid/Spacing": "0.5e-3, 0.5e-3, 0.5e-3", "Microstructure/Type": "voxels",
               "Microstructure/File": "solid.npy"}}

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


def dimension(kind):
    return 2 if kind in ("grid", "gridml", "plane") else 3


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
    K, _ = plane.assemble(phases)
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
    for name, d in zip("abc", plane.D11_D12_D22_D33):
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
        close(local["stress"], np.einsum("cij,cj->ci", plane.STIFFNESS[phases], expected), 1e-8, what + "stresses")
        for kind, given, mean in (("strain", strain, local["strain"].mean(axis=0)), ("stress", stress, local["stress"].mean(axis=0))):
            for k in range(3):
                if k in given or (kind == "stress" and k not in strain):
                    error = abs(mean[k] - given.get(k, 0.0)) / np.abs(mean).max()
                    assert error < 1e-10, f"{what} mean {kind} {k} is off by {error}"
        assert load["hill_mandel_residual"] < 1e-10 and load["mean_strain_residual"] < 1e-10 and load["mean_stress_residual"] < 1e-10, load


def check_statistics(folder, name, dim, volumes=None):
    """What summary.json, loads.csv and the histograms say of the fields."""
    table = list(csv.DictReader(folder.read(name, "loads.csv").decode().splitlines()))
    components = ("xx", "yy", "xy") if dim == 2 else ("xx", "yy", "zz", "yz", "xz", "xy")
    for load in folder.summary(name)["loads"]:
        local, phase = fields(folder, name, load["name"], load["condition"])
        weight = np.ones(len(phase)) if volumes is None else volumes
        mises, principal = von_mises(local["stress"], local["stress_zz"].ravel() if dim == 2 else None)
        close(local["von_mises"].ravel(), mises, 1e-13, f"{name} {load['name']}: von Mises of the stresses")
        values = {**{f"stress_{c}": local["stress"][:, k] for k, c in enumerate(components)},
                  **{f"strain_{c}": local["strain"][:, k] for k, c in enumerate(components)},
                  "von_mises": mises, **{f"principal_{k + 1}": principal[:, k] for k in range(3)}, "hydrostatic": principal.mean(axis=1)}
        for p, part in enumerate(("soft", "stiff", "all")):
            chosen = phase == p if p < 2 else phase >= 0
            w = weight[chosen] / weight[chosen].sum()
            for quantity, of in values.items():
                x, found = of[chosen], load["phases"][part][quantity]
                scale = np.abs(of).max()
                for key, expected in (("mean", w @ x), ("minimum", x.min()), ("maximum", x.max()),
                                      ("standard_deviation", np.sqrt(w @ (x - w @ x) ** 2))):
                    assert abs(found[key] - expected) <= 1e-12 * scale, (name, load["name"], part, quantity, key, found[key], expected)
                row = next(r for r in table if (r["load"], r["condition"], r["phase"], r["quantity"]) ==
                           (load["name"], load["condition"], part, quantity))
                assert float(row["mean"]) == found["mean"] and float(row["maximum_at_x [m]"]) == found["maximum_at"][0]
            if p < 2:
                share = load["share_beyond_limit"]["von_mises"][part]
                assert abs(share - w @ (mises[chosen] > (60e6, 120e6)[p])) < 1e-12, (name, part, share)
                with h5py.File(folder(name, "loads.h5")) as file:
                    group = file["loads"][load["name"]][load["condition"]]["histogram"][part]
                    place = [t.decode().rstrip("\0") for t in file["quantity/stress"][()]].index("von_mises")
                    edges, shares = group["stress_edges"][place], group["stress_share"][place]
                assert abs(shares.sum() - 1) < 1e-12 and edges[0] == load["phases"][part]["von_mises"]["minimum"]
                inner = np.arange(3, len(edges) - 3)  # cumulated, so that a value on an edge may fall to either side
                below = np.array([w @ (mises[chosen] < edge) for edge in edges])
                assert np.abs(np.cumsum(shares)[inner - 1] - below[inner]).max() < 0.02
                extreme = load["phases"][part]["von_mises"]["maximum_at"]
                assert len(extreme) == dim


def check_ranks(folder):
    """Grid, mesh of its cells, tetrahedra and voxels on 1, 2 and 3 ranks."""
    rng = np.random.default_rng(plane.SEED)
    loads = {"Loads/Names": "pull, twist", "Loads/pull/Stress xx": 100e6, "Loads/twist/Strain xy": 1e-3, "Loads/twist/Strain yy": -2e-4,
             "Loads/Von Mises limit": "60e6, 120e6", "Loads/Histogram bins": 20}
    plane_map, solid_map = rng.choice(2, size=(6, 8), p=[0.7, 0.3]), rng.choice(2, size=(6, 5, 4), p=[0.7, 0.3])
    np.savetxt(folder("plane.txt"), plane_map[::-1], fmt="%d")
    np.save(folder("solid.npy"), solid_map.astype(np.uint8))
    group_2d = lambda x: ("soft", "stiff")[plane_map[int(x[1]), int(x[0])]]  # noqa: E731
    group_3d = lambda x: ("soft", "stiff")[solid_map[int(x[2] * 2), int(x[1] * 2), int(x[0] * 2)]]  # noqa: E731
    Box([8, 6], [8, 6], group_2d).write(folder("plane.msh"))
    Box([2, 2.5, 3], [4, 5, 6], group_3d).write(folder("bricks.msh"))
    Box([2, 2.5, 3], [4, 5, 6], group_3d, "simplex").write(folder("tetrahedra.msh"))
    first = {}
    for kind, settings in KINDS.items():
        dim = dimension(kind)
        conditions = "KUBC, SUBC, PBC, MUBC"
        text = f"set Dimension = {dim}\n" + prm({**PHASES, **settings, **loads, "Homogenization/Boundary conditions": conditions})
        for ranks in (1, 3) if kind in ("gridml", "tetrahedra") else (1, 2, 3):
            found = run(folder, kind, text, ranks)["loads"]
            one = first.setdefault(kind, found)
            assert [(a["name"], a["condition"]) for a in found] == [(a["name"], a["condition"]) for a in one] and len(found) == 2 * len(
                conditions.split(","))
            for a, b in zip(found, one):
                same_numbers(a["phases"], b["phases"], kind, ranks)
                x, y = (fields(folder, f"{kind}{n}", a["name"], a["condition"])[0] for n in (ranks, 1))
                for key in y:
                    close(x[key], y[key], 1e-9, f"{kind} {a['name']} {a['condition']} {key} on {ranks} ranks")
        if kind != "tetrahedra":
            check_statistics(folder, kind + "1", dim)
    for one, other in (("grid", "gridml"), ("grid", "plane"), ("bricks", "voxels")):
        for a in first[one]:
            for b in first[other]:
                if (a["name"], a["condition"]) == (b["name"], b["condition"]):
                    same_numbers(a["phases"], b["phases"], f"{one} and {other}", 1)


def same_numbers(a, b, what, ranks):
    for part, quantities in b.items():
        for quantity, numbers in quantities.items():
            family = "strain" if quantity.startswith("strain") else "stress"
            scale = max(abs(other[key]) for name, other in quantities.items() if ("strain" if name.startswith("strain") else "stress") == family
                        for key in ("minimum", "maximum"))
            for key, value in numbers.items():
                size = 1.0 if key.endswith("_at") else scale
                assert np.allclose(a[part][quantity][key], value, rtol=0, atol=1e-9 * size), (what, ranks, part, quantity, key,
                                                                                             a[part][quantity][key], value)


def check_constants(folder):
    """Strains under uniaxial stresses and shears are the engineering constants of the stiffness, in 2D and 3D, and KUBC those of KUBC."""
    axes = {2: ("xx", "yy", "xy"), 3: ("xx", "yy", "zz", "yz", "xz", "xy")}
    names = {"xx": "E_x", "yy": "E_y", "zz": "E_z", "yz": "G_yz", "xz": "G_xz", "xy": "G_xy"}
    for kind, dim in (("grid", 2), ("voxels", 3)):
        text = f"set Dimension = {dim}\n" + prm({
            **PHASES, **KINDS[kind], "Loads/Names": ", ".join("load " + c for c in axes[dim]), "Loads/Boundary conditions": "KUBC",
            "Homogenization/Boundary conditions": "KUBC, PBC", "Homogenization/Effective": "KUBC", "Homogenization/Effective symmetry": "full",
            **{f"Loads/load {c}/Stress {c}": 1e6 for c in axes[dim]}})
        summary = run(folder, kind + "constants", text)
        for load in summary["loads"]:
            c = load["name"][-2:]
            constants = summary["engineering_constants"]
            close(load["stress"][c] / load["strain"][c], constants[names[c]], 1e-12, f"{kind} {names[c]}")
            for d in axes[dim]:  # the strain d that the load c makes: Poisson's ratios, mutual influence, Chentsov's coefficients
                if c != d:
                    normal = c[0] == c[1] and d[0] == d[1]
                    short = [e[0] if e[0] == e[1] else e for e in (d, c)]
                    name, sign = (f"nu_{short[1]}{short[0]}", -1) if normal else (f"eta_{short[0]}_{short[1]}", 1)
                    close(sign * load["strain"][d] / load["strain"][c], constants[name], 1e-12, f"{kind} {name}", 1.0)


def check_ensemble(folder):
    """Four morphologies on 1, 2 and 3 ranks: means and deviations of those computed one by one; what is up to date is kept."""
    loads = {"Loads/Names": "pull", "Loads/pull/Stress xx": 1e8, "Loads/pull/Strain yy": 0}
    text = rve("20, 10", "0.002, 0.001", 2e-4, 4e-4, **loads)
    single = []
    for seed in range(1, 5):
        single.append(run(folder, f"seed{seed}", text + prm({"Microstructure/Random fibres/Seed": seed}))["loads"])
    for ranks in (1, 2, 3):
        found = run(folder, "ensemble", text + prm({"Microstructure/Random fibres/Seed": 1, "Ensemble/Members": 4}), ranks)["loads"]
        table = list(csv.DictReader(folder.read(f"ensemble{ranks}", "loads_ensemble.csv").decode().splitlines()))
        for k, load in enumerate(found):
            same_numbers(load["phases"], single[0][k]["phases"], "first of the ensemble", ranks)
            for of in ("strain", "stress"):
                for component in ("xx", "yy", "xy"):
                    values = [one[k][of][component] for one in single]
                    for key, expected in (("mean", np.mean(values)), ("standard_deviation", np.std(values, ddof=1))):
                        assert abs(load["ensemble"][of][key][component] - expected) <= 1e-12 * np.abs(values).max(), (ranks, of, component, key)
            for part, quantity, of, key in (("fibre", "von_mises", "maximum", "maximum"), ("all", "stress_xx", "mean", "mean")):
                values = [one[k]["phases"][part][quantity][key] for one in single]
                row, = (r for r in table if (r["condition"], r["phase"], r["quantity"], r["of"]) == (load["condition"], part, quantity, of))
                assert np.isclose(float(row["mean"]), np.mean(values), rtol=1e-12) and np.isclose(
                    float(row["standard_deviation"]), np.std(values, ddof=1), rtol=1e-9, atol=1e-6), (ranks, row)
    again = lambda: folder.run(0, "rve_homogenization", "seed1.prm", "--output", "seed11")  # noqa: E731
    text = again()
    assert "up to date" in text and "Load pull, KUBC" in text and folder.summary("seed11")["loads"] == single[0], text
    os.remove(folder("seed11", "loads.h5"))
    assert "up to date" not in again() and os.path.exists(folder("seed11", "loads.h5"))


def check_readers(folder):
    """The report draws the loads of all kinds of volumes, and the Python module reads them."""
    for name in ("layers1", "random1", "grid1", "plane1", "tetrahedra1", "voxels1"):
        done = subprocess.run([sys.executable, "-B", os.path.join(TOOLS, "report", "make_report.py"), folder(name), "--output", folder("report.html")],
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=True)
        page, n = folder.read("report.html").decode(), len(folder.summary(name)["loads"])
        for words in ("How stresses of the cells", "under the load "):  # as caption and instead of the picture
            assert page.count(words) == 2 * n, (name, words, page.count(words), n, done.stdout)
    with mesoslip.open(folder("grid1", "loads.h5")) as file:
        assert file.loads["pull"] == ["KUBC", "MUBC", "PBC", "SUBC"] and file.unit("loads/pull/PBC/stress") == "Pa"
        assert np.array_equal(file.group("loads/pull/PBC")["von_mises"].ravel(), fields(folder, "grid1", "pull", "PBC")[0]["von_mises"].ravel())


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_laminate(folder)
        check_direct(folder)
        check_ranks(folder)
        check_constants(folder)
        check_ensemble(folder)
        check_readers(folder)


if __name__ == "__main__":
    main()
