"""Macroscopic loads of rve_homogenization on all kinds of volumes, against themselves.

Statistics, histograms and shares are those of the fields, and 1, 2 and 3 ranks agree, on grids, meshes and voxels. Strains under uniaxial
stresses are the engineering constants. Ensembles have the means and deviations of their members; the report and the Python module read the
files. macroscopic_loads.py has closed forms and direct solves.
"""

import csv
import os
import sys
import tempfile

import h5py
import numpy as np

import independent_finite_elements as plane
from macroscopic_loads import PHASES, check_report, close, fields, run, von_mises

from mesh_files import Box
from scenes import TOOLS, Folder, prm, rve

sys.path.append(os.path.join(TOOLS, "python"))
import mesoslip  # noqa: E402

KINDS = {
    "grid": {"Grid/Cells": "8, 6", "Grid/Size": "8e-3, 6e-3", "Microstructure/Type": "image", "Microstructure/File": "plane.txt"},
    "gridml": {"Grid/Cells": "8, 6", "Grid/Size": "8e-3, 6e-3", "Microstructure/Type": "image", "Microstructure/File": "plane.txt",
               "Homogenization/Solver": "ml"},
    "divided": {"Grid/Cells": "8, 6", "Grid/Size": "8e-3, 6e-3", "Microstructure/Type": "image", "Microstructure/File": "plane.txt",
                "Homogenization/Solver": "divided"},
    "plane": {"Mesh/File": "plane.msh", "Mesh/Scale": 1e-3},
    "bricks": {"Mesh/File": "bricks.msh", "Mesh/Scale": 1e-3},
    "tetrahedra": {"Mesh/File": "tetrahedra.msh", "Mesh/Scale": 1e-3},
    "voxels": {"Grid/Cells": "4, 5, 6", "Grid/Spacing": "0.5e-3, 0.5e-3, 0.5e-3", "Microstructure/Type": "voxels",
               "Microstructure/File": "solid.npy"}}


def dimension(kind):
    return 2 if kind in ("grid", "gridml", "divided", "plane") else 3


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
                same_energy(a, b, f"{kind} on {ranks} ranks")
                x, y = (fields(folder, f"{kind}{n}", a["name"], a["condition"])[0] for n in (ranks, 1))
                for key in y:
                    close(x[key], y[key], 1e-9, f"{kind} {a['name']} {a['condition']} {key} on {ranks} ranks")
        if kind != "tetrahedra":
            check_statistics(folder, kind + "1", dim)
    for one, other in (("grid", "gridml"), ("grid", "divided"), ("grid", "plane"), ("bricks", "voxels")):
        for a in first[one]:
            for b in first[other]:
                if (a["name"], a["condition"]) == (b["name"], b["condition"]):
                    same_numbers(a["phases"], b["phases"], f"{one} and {other}", 1)
                    same_energy(a, b, f"{one} and {other}")


def same_energy(a, b, what):
    """A load under MUBC superposes unit cases that hold other components: the energy of two of them is that of no stiffness."""
    what += f" {a['name']} {a['condition']}: "
    close(a["energy_density"], b["energy_density"], 1e-8, what + "energy")
    close(a["hill_mandel_residual"], b["hill_mandel_residual"], 1e-8, what + "Hill and Mandel", 1.0)


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


def check_module(folder):
    """The Python module reads the loads."""
    with mesoslip.open(folder("grid1", "loads.h5")) as file:
        assert file.loads["pull"] == ["KUBC", "MUBC", "PBC", "SUBC"] and file.unit("loads/pull/PBC/stress") == "Pa"
        assert np.array_equal(file.group("loads/pull/PBC")["von_mises"].ravel(), fields(folder, "grid1", "pull", "PBC")[0]["von_mises"].ravel())


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_ranks(folder)
        check_constants(folder)
        check_ensemble(folder)
        check_report(folder, ("grid1", "plane1", "tetrahedra1", "voxels1"))
        check_module(folder)


if __name__ == "__main__":
    main()
