"""rve_homogenization on meshes: a grid handed in as a mesh, on 1, 2 and 3 ranks; three dimensions; ensembles; what is refused."""

import itertools
import os
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import PHASES, SMALL_RVE, TOP, Folder, prm, sets

CONDITIONS = {"Homogenization/Boundary conditions": "KUBC, SUBC, PBC", "Homogenization/Tolerance": 1e-12}
MESH = PHASES + prm({"Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, **CONDITIONS})
SOLID = "set Dimension = 3\n" + MESH + prm({"Homogenization/Effective": "PBC"})
STRIPES = Box([2, 1], [4, 2], lambda x: "fibre" if x[0] > 1 else "matrix")


def check_grid_as_mesh(folder):
    """Stiffness and tensors of a random morphology on a grid, and on a mesh in mm of the same cells."""
    folder.write("grid.prm", SMALL_RVE + prm(CONDITIONS))
    folder.run(0, "rve_homogenization", "grid.prm", "--output", "grid")
    with h5py.File(folder("grid", "rve.h5")) as file:
        phase = file["phase/id"][()]
        grid = {of: file[of][()] for of in ("concentration/KUBC", "concentration/PBC", "stress_concentration/SUBC")}
    ny, nx = phase.shape
    Box([2, 1], [nx, ny], lambda x: ("matrix", "fibre")[phase[int(x[1] * ny), int(x[0] * nx / 2)]]).write(folder("mesh.msh"))
    folder.write("mesh.prm", MESH)
    expected = folder.summary("grid")
    order = np.argsort(phase.ravel() == 0, kind="stable")  # of the file: the group of the fibres comes first
    for ranks in (1, 2, 3):
        folder.run(0, "rve_homogenization", "mesh.prm", "--output", f"mesh{ranks}", ranks=ranks)
        found = folder.summary(f"mesh{ranks}")
        assert found["dim"] == 2 and found["cells"] == nx * ny and found["dofs"] == expected["dofs"] and found["ranks"] == ranks
        for of in ("KUBC", "SUBC", "PBC", "effective"):
            difference = np.abs(np.subtract(found["stiffness"][of], expected["stiffness"][of])).max() / expected["stiffness"][of][0][0]
            assert difference < 1e-10, (ranks, of, difference)
        for one, other in zip(found["phases"], expected["phases"]):
            assert one["name"] == other["name"] and abs(one["volume_fraction"] - other["volume_fraction"]) < 1e-12
        with h5py.File(folder(f"mesh{ranks}", "rve.h5")) as file:
            assert np.array_equal(file["phase/id"][()], phase.ravel()[order])
            for of, tensors in grid.items():
                difference = np.abs(file[of][()] - tensors.reshape(-1, 3, 3)[order]).max()
                assert difference < 1e-8, (ranks, of, difference)
    assert "up to date" in folder.run(0, "rve_homogenization", "mesh.prm", "--output", "mesh1")


def check_contact_takes_stiffness(folder):
    """A homogeneous body may come from a mesh; its cells have to be given."""
    body = prm({"Body/RVE file": "mesh1/rve.h5", "Time/End time": 2e-8})
    folder.write("body.prm", body)
    cells = "--set=Body/Cells=40, 20"
    folder.run(0, "contact_dynamics", "body.prm", "--output", "body", cells)
    text = folder.run(2, "contact_dynamics", "body.prm", "--output", "none")
    assert "Body/Cells is empty" in text and "holds a mesh" in text, text
    text = folder.run(2, "contact_dynamics", "body.prm", "--output", "none", cells, "--set=Body/Material=heterogeneous")
    assert "holds a volume on a mesh" in text, text
    with h5py.File(folder("body", "dynamics.h5")) as file:
        stiffness = file["material/phase/stiffness" if "material/phase" in file else "material/stiffness"][()].reshape(-1)[:9]
    assert np.allclose(stiffness, np.ravel(folder.summary("mesh1")["stiffness"]["effective"]), rtol=1e-12)


def check_laminate_in_space(folder):
    """Layers along z: exact on hexahedra and tetrahedra under PBC, see theory of laminates; D33 is the harmonic mean, D11 follows."""
    lame = {}
    for name, modulus in (("matrix", 30e9), ("fibre", 240e9)):
        lame[name] = modulus * 0.2 / (1.2 * 0.6), modulus / 2.4
    M = {name: l + 2 * mu for name, (l, mu) in lame.items()}
    mean = lambda value: sum(value(name) for name in lame) / 2
    D33 = 1 / mean(lambda name: 1 / M[name])
    D13 = D33 * mean(lambda name: lame[name][0] / M[name])
    D11 = mean(lambda name: M[name] - lame[name][0] ** 2 / M[name]) + D13**2 / D33
    D44 = 1 / mean(lambda name: 1 / lame[name][1])
    D66 = mean(lambda name: lame[name][1])
    folder.write("solid.prm", SOLID)
    for kind, ranks in itertools.product(("cube", "simplex"), (1, 2)):
        Box([1, 1, 1], [2, 2, 4], lambda x: "fibre" if x[2] > 0.5 else "matrix", kind).write(folder("mesh.msh"))
        folder.run(0, "rve_homogenization", "solid.prm", "--output", "solid", ranks=ranks)
        summary = folder.summary("solid")
        D = np.array(summary["stiffness"]["PBC"])
        assert summary["dim"] == 3 and D.shape == (6, 6)
        for (i, j), exact in {(2, 2): D33, (0, 2): D13, (1, 2): D13, (0, 0): D11, (1, 1): D11, (3, 3): D44, (4, 4): D44, (5, 5): D66,
                              (0, 3): 0, (3, 5): 0}.items():
            assert abs(D[i, j] - exact) < 1e-9 * D11, (kind, ranks, i, j, D[i, j], exact)
        kubc, subc = (np.array(summary["stiffness"][of]) for of in ("KUBC", "SUBC"))
        assert np.linalg.eigvalsh(kubc - D).min() > -1e-9 * D11 and np.linalg.eigvalsh(D - subc).min() > -1e-9 * D11
        with h5py.File(folder("solid", "rve.h5")) as file:
            L, phase = file["concentration/PBC"][()], file["phase/id"][()]
            assert np.allclose(L.mean(axis=0), np.eye(6), atol=1e-9)  # cells of equal volume
            assert np.allclose(L[phase == 1, 2, 2], D33 / M["fibre"], atol=1e-9)
    constants = summary["engineering_constants"]
    assert abs(constants["G_xy"] - D66) < 1e-9 * D66 and "E_z" in constants


def check_turned_phase(folder):
    """An orthotropic phase turned by a right angle about z swaps the moduli along x and y."""
    Box([1, 1, 1], [1, 1, 1], lambda x: "matrix").write(folder("mesh.msh"))
    text = "set Dimension = 3\n" + prm({"Mesh/File": "mesh.msh", "Mesh/Scale": 1, "Phases/Names": "matrix"}) + prm(
        {"Phases/matrix/" + key: value for key, value in {"Type": "orthotropic", "Young moduli": "10e9, 20e9, 30e9",
                                                          "Poisson ratios": "0.1, 0.15, 0.2", "Shear moduli": "4e9, 5e9, 6e9"}.items()})
    folder.write("turned.prm", text)
    folder.run(0, "rve_homogenization", "turned.prm", "--output", "turned", "--set=Phases/matrix/Angle=1.5707963267948966")
    found = folder.summary("turned")["engineering_constants"]
    for name, value in {"E_x": 20e9, "E_y": 10e9, "E_z": 30e9, "G_xy": 4e9, "G_yz": 5e9, "G_xz": 6e9, "nu_yx": 0.1}.items():
        assert abs(found[name] - value) < 1e-9 * value, (name, found[name])


def check_ensemble(folder):
    """Two meshes: mean and deviation of the two, named in the summary."""
    for name, middle in (("a", 1.0), ("b", 1.5)):
        Box([2, 1], [8, 4], lambda x, m=middle: "fibre" if x[0] > m else "matrix").write(folder(name + ".msh"))
    folder.write("ensemble.prm", PHASES + prm({"Mesh/File": "a.msh, b.msh", "Mesh/Scale": 0.001, **CONDITIONS}))
    folder.run(0, "rve_homogenization", "ensemble.prm", "--output", "both")
    single = []
    for name in "ab":
        folder.run(0, "rve_homogenization", "ensemble.prm", "--output", name, f"--set=Mesh/File={folder(name)}.msh")
        single.append(folder.summary(name)["stiffness"]["PBC"][0][0])
    both = folder.summary("both")["ensemble"]
    assert [os.path.basename(mesh) for mesh in both["meshes"]] == ["a.msh", "b.msh"]
    assert abs(both["PBC"]["mean"][0][0] - np.mean(single)) < 1e-9 * single[0]
    assert abs(both["PBC"]["standard_deviation"][0][0] - np.std(single, ddof=1)) < 1e-9 * single[0]


def refused_meshes():
    """Name, mesh, words of the sentence."""
    flat, doubled, twisted = (Box([2, 1], [4, 2], lambda x: "matrix") for _ in range(3))
    flat.points[6] = flat.points[5]
    doubled.cells.append(doubled.cells[0])
    doubled.groups.append("matrix")
    twisted.points[6], twisted.points[7] = twisted.points[7].copy(), twisted.points[6].copy()
    apart = Box([2, 1], [4, 2], lambda x: "matrix")
    apart.points[-1] += [0, 0]
    n = len(apart.points)
    apart.points = np.vstack([apart.points, apart.points + [5, 0]])
    apart.cells += [[c + n for c in cell] for cell in apart.cells]
    apart.groups *= 2
    hole = Box([3, 3], [3, 3], lambda x: "matrix")
    del hole.cells[4], hole.groups[4]
    shifted = Box([2, 1], [4, 2], lambda x: "matrix")
    shifted.points[5][1] += 0.1
    folded = Box([2, 1], [4, 2], lambda x: "matrix")
    folded.cells = [half for a, b, c, d in folded.cells for half in ([a, b, c], [a, c, d])]
    folded.groups = [group for group in folded.groups for _ in range(2)]
    folded.points[6] += [0, 0.6]
    folded.kind = "simplex"
    other = Box([2, 1], [4, 2], lambda x: "fiber")
    solid = Box([1, 1, 1], [1, 1, 1], lambda x: "matrix")
    return [("flat", flat, ["flat"]), ("doubled", doubled, ["share the edge", "there twice"]),
            ("twisted", twisted, ["twisted"]), ("apart", apart, ["in 2 pieces"]), ("hole", hole, ["no side of the bounding box"]),
            ("folded", folded, ["same side", "overlap"]), ("shifted", shifted, ["the sides at both ends of x", "not opposite"]),
            ("other", other, ["'fiber'", "there are matrix, fibre"]), ("solid", solid, ["Dimension"])]


def check_refusals(folder):
    folder.write("case.prm", MESH)
    for name, mesh, words in refused_meshes():
        mesh.write(folder("mesh.msh"))
        for option in ("--validate", "--output=none"):
            text = folder.run(2, "rve_homogenization", "case.prm", option)
            assert all(word in text for word in words) and text.count("\n") == 1, (name, text)
    STRIPES.write(folder("mesh.msh"))
    name, mesh, _ = next(iter(refused_meshes()))
    mesh.write(folder("second.msh"))
    text = folder.run(2, "rve_homogenization", "case.prm", "--validate", "--set=Mesh/File=mesh.msh, second.msh")
    assert "second.msh" in text and "mesh.msh of" not in text, (name, text)
    for settings, words in [
            (["Mesh/Tolerance=1"], ["Mesh/Tolerance", "0.1"]), (["Mesh/Scale=1000"], None), (["Grid/Cells=3, 3"], ["Grid/Cells", "Mesh/File is given"]),
            (["Homogenization/Solver=jacobi"], ["Solver", "ml"]), (["Dimension=4"], ["Dimension"]), (["Mesh/Scale=0"], ["Scale"]),
            (["Mesh/File="], ["Mesh/Scale"]), (["Mesh/File=no.msh"], ["Mesh/File", "no.msh"]),
            (["Mesh/File=case.prm"], ["case.prm", ".msh"]), (["Ensemble/Members=3"], ["Ensemble/Members", "Mesh/File"]),
            (["Dimension=3"], ["Dimension"])]:
        status = 0 if words is None else 2
        text = folder.run(status, "rve_homogenization", "case.prm", "--validate", *sets(settings))
        assert words is None or all(word in text for word in words), (settings, text)
    text = folder.run(0, "rve_homogenization", "case.prm", "--validate", "--set=Mesh/Scale=1000")
    assert "warning: Mesh/Scale: the body along x" in text and "is it in mm?" in text, text
    folder.write("no_scale.prm", PHASES + prm({"Mesh/File": "large.msh"}))
    Box([56, 16], [4, 2], lambda x: "matrix").write(folder("large.msh"))
    text = folder.run(2, "rve_homogenization", "no_scale.prm", "--validate")
    assert "Mesh/Scale" in text and "0.001 for mm" in text, text
    folder.write("no_mesh.prm", "set Dimension = 3\n" + PHASES)
    text = folder.run(2, "rve_homogenization", "no_mesh.prm", "--validate")
    assert "Dimension" in text and "Mesh/File" in text, text


def check_seven_digits(folder):
    """Points off by a tenth of a thousandth of an edge are on their sides, and the log tells by how much."""
    exact, rough = (Box([2, 1], [40, 20], lambda x: "fibre" if 0.5 < x[0] < 1.1 and x[1] > 0.4 else "matrix") for _ in range(2))
    rough.points = rough.points + 5e-6 * np.random.default_rng(3).uniform(-1, 1, rough.points.shape)
    D = []
    folder.write("digits.prm", MESH)
    for mesh in (exact, rough):
        mesh.write(folder("mesh.msh"))
        text = folder.run(0, "rve_homogenization", "digits.prm", "--output", "digits")
        D.append(np.array(folder.summary("digits")["stiffness"]["PBC"]))
    assert np.abs(D[1] - D[0]).max() < 2e-4 * D[0].max()
    text = folder.run(0, "rve_homogenization", "digits.prm", "--validate")
    assert "Sides at both ends of x: plane within" in text and "Sides at both ends of y: 41 points each, opposite within" in text, text
    text = folder.run(2, "rve_homogenization", "digits.prm", "--validate", "--set=Mesh/Tolerance=1e-6")
    assert "no side of the bounding box" in text and "Mesh/Tolerance = 1e-06" in text, text


def check_validate(folder):
    """The table of a mesh of Gmsh, with phases, boundaries, box, worst cell and periodicity."""
    text = folder.run(0, "rve_homogenization", os.path.join(TOP, "prm", "examples", "mesh", "spheres.prm"), "--validate")
    for word in ("tetrahedra of spheres.msh", "Bounding box: x from 0 to 0.001", "worst cell at", "particle: ", "m^3", "GPa", "MB",
                 "Sides at both ends of z", "periodic"):
        assert word in text, (word, text)


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_grid_as_mesh(folder)
        check_contact_takes_stiffness(folder)
        check_laminate_in_space(folder)
        check_turned_phase(folder)
        check_ensemble(folder)
        check_refusals(folder)
        check_seven_digits(folder)
        check_validate(folder)


if __name__ == "__main__":
    main()
