"""Mixed uniform boundary conditions (MUBC) on grids and meshes.

Laminates along every axis have the exact stiffness, on grids, quadrilaterals, triangles, bricks and tetrahedra. A volume that is symmetric
about its middle planes has that of PBC. Of any volume, the blocks of normal strains and the shear moduli are not above those of KUBC, and
not below the inverse of the blocks of the compliance of SUBC; where nothing couples them these are the quadratic forms SUBC <= MUBC <=
KUBC. One, two and three ranks agree. Axes that are not those of orthotropy are warned of. Voxels have the stiffness and the local fields
of meshes of the same cells, isotropic or not, of any edges.
"""

import tempfile

import h5py
import numpy as np

from macroscopic_loads import PHASES, close, fields, laminate, run, stiffness

from mesh_files import Box
from scenes import Folder, prm

SEED = 20261
CONDITIONS = {"Homogenization/Boundary conditions": "KUBC, SUBC, PBC, MUBC"}
ONE = {"Homogenization/Boundary conditions": "MUBC", "Homogenization/Effective": "MUBC"}
EDGES = [1., 1.3, 0.8]  # mm
LOAD = {"Loads/Names": "shear", "Loads/Boundary conditions": "MUBC", "Loads/shear/Stress xy": 1e6, "Loads/shear/Strain zz": 1e-4,
        "Loads/shear/Stress yy": 2e6}


def without_axes():
    """PHASES with a full stiffness of the second phase that has no symmetry."""
    D, noise = stiffness(3)[1], np.random.default_rng(SEED).uniform(-1, 1, (6, 6))
    D = D + 2e10 * (noise + noise.T)
    assert np.linalg.eigvalsh(D)[0] > 1e10
    return {**{key: value for key, value in PHASES.items() if not key.startswith("Phases/stiff/")}, "Phases/stiff/Type": "stiffness",
            "Phases/stiff/Stiffness": ", ".join(map(repr, D[np.triu_indices(6)].tolist()))}


def exact(dim, across, share):
    """Stiffness of a laminate: stresses of unit strains."""
    D, v = stiffness(dim), 3 * dim - 3
    columns = []
    for k in range(v):
        strains = laminate(dim, across, share, {j: float(j == k) for j in range(v)}, {})
        columns.append((1 - share) * D[0] @ strains[0] + share * D[1] @ strains[1])
    return np.array(columns).T


def mesh(folder, name, dim, n, group_of, kind="cube", ranks=1):
    """Summary of a box of unit cells, whose group is 0 or 1 at a place."""
    Box([float(m) for m in n], n, lambda x: ("soft", "stiff")[group_of(np.floor(x).astype(int))], kind).write(folder(name + ".msh"))
    return run(folder, name, f"set Dimension = {dim}\n" + prm({**PHASES, **CONDITIONS, "Mesh/File": name + ".msh", "Mesh/Scale": 1e-3}), ranks)


def check_laminates(folder):
    for dim, kind in ((2, "cube"), (2, "simplex"), (3, "cube"), (3, "simplex")):
        for across in range(dim):
            n = [5 if d == across else 3 for d in range(dim)]
            name = f"laminate{dim}{kind}{across}"
            found = mesh(folder, name, dim, n, lambda x: int(x[across] in (1, 4)), kind)
            close(found["stiffness"]["MUBC"], exact(dim, across, 0.4), 1e-9, f"MUBC of layers across {'xyz'[across]}, {dim}D, {kind}")


def check_symmetric(folder):
    """A quarter (an eighth) of random cells, mirrored."""
    for dim, ranks in ((2, (1,)), (3, (1, 2, 3))):
        part = np.random.default_rng(SEED).choice(2, size=(3,) * dim, p=[0.6, 0.4])
        for axis in range(dim):
            part = np.concatenate([part, np.flip(part, axis)], axis)
        for n in ranks:
            found = mesh(folder, f"symmetric{dim}", dim, part.shape, lambda x: part[tuple(x)], ranks=n)["stiffness"]
            close(found["MUBC"], found["PBC"], 1e-9, f"MUBC of a symmetric volume in {dim}D on {n} ranks: PBC")
        for upper, lower in (("KUBC", "MUBC"), ("MUBC", "SUBC")):
            values = np.linalg.eigvalsh(np.subtract(found[upper], found[lower])) / found["KUBC"][0][0]
            print(f"{dim}D {upper} - {lower}: smallest and largest eigenvalue {values[0]:.1e} {values[-1]:.1e}")
            assert values[0] > -1e-9 and values[-1] > 1e-3


def check_bounds(folder):
    """Random cells: nothing is symmetric."""
    for dim, kind in ((2, "cube"), (3, "cube"), (3, "simplex")):
        cells = np.random.default_rng(SEED).choice(2, size=(5, 4, 3)[:dim], p=[0.7, 0.3])
        summary = mesh(folder, f"random{dim}{kind}", dim, cells.shape, lambda x: cells[tuple(x)], kind)
        found = {name: np.array(summary["stiffness"][name]) for name in ("KUBC", "SUBC", "MUBC")}
        compliance, v = np.linalg.inv(found["SUBC"]), 3 * dim - 3
        for block in [slice(0, dim), *(slice(k, k + 1) for k in range(dim, v))]:
            mixed = found["MUBC"][block, block]
            above = np.linalg.eigvalsh(found["KUBC"][block, block] - mixed)[0] / mixed[0, 0]
            below = np.linalg.eigvalsh(mixed - np.linalg.inv(compliance[block, block]))[0] / mixed[0, 0]
            print(f"{dim}D {kind} {block}: KUBC - MUBC {above:.1e}, MUBC - SUBC {below:.1e}")
            assert above > -1e-10 and below > -1e-10
        couplings = found["MUBC"] - np.where(np.eye(v) > 0, found["MUBC"], 0)
        couplings[:dim, :dim] = 0
        assert not couplings.any() and any("MUBC: shear is coupled" in text for text in summary["warnings"]), summary["warnings"]
        assert summary["hill_mandel_residual"]["MUBC"] < 1e-9 and summary["two_phase_residual"]["MUBC"] < 1e-8, summary


def voxels(folder, name, cells, ranks=1, phases=PHASES, **more):
    """Summary of cells [x][y][z] with the edges 1, 1.3 and 0.8 mm."""
    np.save(folder(name + ".npy"), cells.T.astype(np.uint8))
    edges = more.pop("edges", "1e-3, 1.3e-3, 0.8e-3")
    return run(folder, name, "set Dimension = 3\n" + prm({
        **phases, **CONDITIONS, "Grid/Cells": ", ".join(map(str, cells.shape)), "Grid/Spacing": edges, "Microstructure/Type": "voxels",
        "Microstructure/File": name + ".npy", **more}), ranks)


def voxel_of_cells(file, shape):
    """Numbers, x fastest, of the voxels [x][y][z] that the cells of a mesh are."""
    with h5py.File(file) as data:
        corners = data["mesh/topology"][()].reshape(np.prod(shape), -1)[:, 1:]
        middle = data["mesh/points"][()][corners].mean(axis=1)
    return np.ravel_multi_index(np.floor(middle / np.multiply(EDGES, 1e-3)).astype(int)[:, ::-1].T, shape[::-1])


def check_voxels(folder):
    """The solver of voxels holds components of nodes of its own; meshes of the same cells take Trilinos."""
    cells = np.zeros((5, 5, 5), int)
    cells[[1, 4]] = 1
    for across in range(3):
        found = voxels(folder, f"layers{across}", np.moveaxis(cells, 0, across))
        close(found["stiffness"]["MUBC"], exact(3, across, 0.4), 1e-9, f"MUBC of layers of voxels across {'xyz'[across]}")
    part = np.random.default_rng(SEED).choice(2, size=(4, 3, 5), p=[0.6, 0.4])
    for axis in range(3):
        part = np.concatenate([part, np.flip(part, axis)], axis)
    for edges in ("1e-3, 1e-3, 1e-3", "1e-3, 1.3e-3, 0.8e-3"):
        found = voxels(folder, "mirrored", part, edges=edges)["stiffness"]
        close(found["MUBC"], found["PBC"], 1e-9, f"MUBC of symmetric voxels of {edges}: PBC")
    for name, shape, phases in (("isotropic", (7, 5, 8), PHASES), ("full", (6, 7, 5), without_axes()), ("odd", (19, 17, 23), PHASES)):
        cells = np.random.default_rng(SEED).choice(2, size=shape, p=[0.7, 0.3])
        Box(np.multiply(shape, EDGES), shape, lambda x: ("soft", "stiff")[cells[tuple(np.floor(np.divide(x, EDGES)).astype(int))]],
            "cube").write(folder(name + ".msh"))
        wanted = run(folder, "mesh" + name, "set Dimension = 3\n" + prm({
            **phases, **ONE, **LOAD, "Mesh/File": name + ".msh", "Mesh/Scale": 1e-3}))
        for ranks in (1, 2, 3):
            found = voxels(folder, name, cells, ranks, phases, **ONE, **LOAD)
            what = f"MUBC of {name} voxels on {ranks} ranks:"
            close(found["stiffness"]["MUBC"], wanted["stiffness"]["MUBC"], 1e-9, what + " mesh of the same cells")
            for of in ("hill_mandel_residual", "symmetry_residual"):
                assert found[of]["MUBC"] < 1e-9, found[of]
            for key, scale in (("energy_density", None), ("hill_mandel_residual", 1.0)):
                close(found["loads"][0][key], wanted["loads"][0][key], 1e-8, f"{what} {key}", scale)
            other, numbers = fields(folder, f"mesh{name}1", "shear", "MUBC")[0], voxel_of_cells(folder(f"mesh{name}1", "loads.h5"), shape)
            for key, values in fields(folder, f"{name}{ranks}", "shear", "MUBC")[0].items():
                close(values[numbers], other[key], 1e-8, what + " " + key)


def main():
    print("seed", SEED)
    with tempfile.TemporaryDirectory() as path:
        for check in (check_laminates, check_symmetric, check_bounds, check_voxels):
            check(Folder(path))


if __name__ == "__main__":
    main()
