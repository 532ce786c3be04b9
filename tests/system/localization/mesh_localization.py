"""stress_localization where volume or body are meshes: a chain on a mesh equals that on the grid, on 1, 2 and 3 ranks and in any
combination; tetrahedra against numpy; fields of a volume element at points of a larger body; what is refused."""

import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import PHASES, SMALL_RVE, Folder, prm

FIELDS = ("mean_von_mises", "mean_stress", "deviation_stress")
RUN = {"Flat/Velocity": 2, "Supports/Top/Pressure": 5e6, "Friction/Coefficient": 0.3, "Time/Time step": 2e-9, "Time/End time": 1e-6,
       "Snapshots/Interval": 1e-7}
MESH = {"Mesh/File": "mesh.msh", "Mesh/Scale": 0.001}
PBC = {"Homogenization/Boundary conditions": "KUBC", "Homogenization/Tolerance": 1e-12}
PLACES = {"Probes/Further": "A, B", "Probes/A/Position": "1.23e-3, 0.47e-3", "Probes/B/Position": "0.16e-3, 0.81e-3"}


def localization(**more):
    return prm({"Input/RVE file": "rve", "Input/Homogeneous run": "homogeneous", "Window/From": 0, "Localization/Variant": "both",
                "Localization/Fields": "mean von Mises, mean stress, deviation of stress", **more})


def fields(folder, run, order=slice(None)):
    """Every field and probe, cells along the first axis."""
    result = {}
    with h5py.File(folder(run, "localization.h5")) as file:
        for group in ("/", "direct", "difference", "mean_strain_variant"):
            for name in FIELDS if group in file else ():
                values = file[group][name][()]
                components = (3,) if name != "mean_von_mises" else ()
                result[group + name] = values.reshape(-1, *components)[order]
        for probe in ("A", "B"):
            for name in ("time", "stress", "direct_stress"):
                result[probe + name] = file["probes"][probe][name][()]
    return result


def check_equal(one, other, limit, what):
    assert set(one) == set(other), (what, set(one) ^ set(other))
    for name, values in one.items():
        scale = np.abs(one[name.replace("difference", "direct/") if "/" in name else name]).max() if name in one else 1
        difference = np.abs(values - other[name]).max() / scale
        assert difference < limit, (what, name, difference)


def check_phases(folder, dimension, typed, rve, run):
    """A mesh whose groups have the phases of an rve.h5 moves as the run with the phases of section Phases."""
    folder.write("phases.prm", dimension + prm({**MESH, "Body/RVE file": rve + "/rve.h5", "Body/Material": "heterogeneous", **run}))
    folder.run(0, "contact_dynamics", "phases.prm", "--output", "phases-" + rve)
    with h5py.File(folder(typed, "dynamics.h5")) as one, h5py.File(folder("phases-" + rve, "dynamics.h5")) as other:
        for name in ("material/phase_id", "snapshots/displacement", "contact/area"):
            assert np.array_equal(one[name][()], other[name][()]), (rve, name)
    assert folder.summary("phases-" + rve)["material"] == "heterogeneous"


def check_chain(folder):
    """Volume and runs as grids, as meshes, and mixed."""
    folder.write("grid.prm", SMALL_RVE + prm(PBC))
    folder.run(0, "rve_homogenization", "grid.prm", "--output", "rve-grid")
    with h5py.File(folder("rve-grid", "rve.h5")) as file:
        phase = file["phase/id"][()]
    ny, nx = phase.shape
    box = Box([2, 1], [nx, ny], lambda x: ("matrix", "fibre")[phase[int(x[1] * ny), int(x[0] * nx / 2)]])
    box.name_side("Contact", 1, False).name_side("Top", 1, True).write(folder("mesh.msh"))
    order = np.argsort(phase.ravel() == 0, kind="stable")  # of the file: the group of the fibres comes first
    folder.write("mesh.prm", PHASES + prm({**MESH, **PBC}))
    folder.run(0, "rve_homogenization", "mesh.prm", "--output", "rve-mesh")
    for kind, body in (("grid", {}), ("mesh", MESH)):
        folder.write("body.prm", prm({"Body/RVE file": "rve-grid/rve.h5", **body, **RUN}))
        folder.run(0, "contact_dynamics", "body.prm", "--output", f"homogeneous-{kind}")
    folder.write("direct.prm", prm({"Body/RVE file": "rve-grid/rve.h5", "Body/Material": "heterogeneous", **RUN}))
    folder.run(0, "contact_dynamics", "direct.prm", "--output", "direct-grid")
    folder.write("direct.prm", PHASES + prm({**MESH, **RUN}))
    folder.run(0, "contact_dynamics", "direct.prm", "--output", "direct-mesh")

    check_phases(folder, "", "direct-mesh", "rve-mesh", RUN)
    check_phases(folder, "", "direct-mesh", "rve-grid", RUN)

    inputs = lambda volume, run: {"Input/RVE file": f"rve-{volume}", "Input/Homogeneous run": f"homogeneous-{run}",
                                  "Input/Direct run": f"direct-{volume}", "Comparison/Surface depth": 2.5e-4,
                                  "Comparison/Edge distance": 1e-4, **PLACES}
    folder.write("localize.prm", localization(**inputs("grid", "grid")))
    folder.run(0, "stress_localization", "localize.prm", "--output", "grid")
    expected = fields(folder, "grid")
    errors = folder.summary("grid")["field_errors"]
    for volume, run, ranks in (("mesh", "mesh", 1), ("mesh", "mesh", 2), ("mesh", "mesh", 3), ("grid", "mesh", 2), ("mesh", "grid", 1)):
        what = (volume, run, ranks)
        folder.write("localize.prm", localization(**inputs(volume, run)))
        folder.run(0, "stress_localization", "localize.prm", "--output", "other", ranks=ranks)
        found = fields(folder, "other", np.argsort(order) if volume == "mesh" else slice(None))
        check_equal(expected, found, 1e-7, what)
        summary = folder.summary("other")
        assert summary["dim"] == 2 and summary["cells"] == nx * ny and summary["snapshots"] == 10, what
        for quantity, regions in errors.items():
            for region, error in regions.items():
                assert abs(summary["field_errors"][quantity][region] - error) < 1e-6 * max(1, error), (what, quantity, region)


def gradients(points, cells):
    """Gradients [n][4][3] of the linear shape functions of tetrahedra."""
    edges = points[cells[:, 1:]] - points[cells[:, :1]]
    inner = np.linalg.inv(edges).transpose(0, 2, 1)
    return np.concatenate([-inner.sum(axis=1, keepdims=True), inner], axis=1)


def strains(points, cells, u):
    """Voigt strains [time][n][6] of tetrahedra."""
    H = np.einsum("tnvc,nvd->tncd", u[:, cells], gradients(points, cells))
    E = 0.5 * (H + H.transpose(0, 1, 3, 2))
    return np.stack([E[..., 0, 0], E[..., 1, 1], E[..., 2, 2], 2 * E[..., 1, 2], 2 * E[..., 0, 2], 2 * E[..., 0, 1]], axis=-1)


def check_solid(folder):
    """Tetrahedra: eq. (24) in numpy."""
    box = Box([3, 2, 2], [3, 2, 2], lambda x: "fibre" if x[2] > 1 else "matrix", "simplex")
    box.name_side("Contact", 2, False).name_side("Top", 2, True).write(folder("mesh.msh"))
    solid = "set Dimension = 3\n" + prm(MESH)
    folder.write("rve.prm", solid + PHASES + prm(PBC))
    folder.run(0, "rve_homogenization", "rve.prm", "--output", "rve")
    thrown = {**RUN, "Time/Time step": 5e-9, "Body/Initial velocity": "0, 1, 0"}
    folder.write("typed.prm", solid + PHASES + prm(thrown))
    folder.run(0, "contact_dynamics", "typed.prm", "--output", "typed")
    check_phases(folder, "set Dimension = 3\n", "typed", "rve", thrown)
    folder.write("body.prm", solid + prm({"Body/RVE file": "rve/rve.h5", **thrown}))
    folder.run(0, "contact_dynamics", "body.prm", "--output", "homogeneous", ranks=2)
    with h5py.File(folder("homogeneous", "dynamics.h5")) as file, h5py.File(folder("rve", "rve.h5")) as rve:
        points, cells = file["mesh/points"][()], file["mesh/topology"][()].reshape(-1, 5)[:, 1:]
        E = strains(points, cells, file["snapshots/displacement"][()])
        assert np.abs(E).max() > 1e-6
        C = rve["phase/stiffness"][()][rve["phase/id"][()]]
        L = rve["concentration/KUBC"][()]
        stress = np.einsum("nij,njk,tnk->tni", C, L, E)
    xx, yy, zz, yz, xz, xy = np.moveaxis(stress, -1, 0)
    expected = {"mean_stress": stress.mean(axis=0), "deviation_stress": stress.std(axis=0),
                "mean_von_mises": np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) +
                                          3 * (yz**2 + xz**2 + xy**2)).mean(axis=0)}
    middle = points[cells[7]].mean(axis=0)
    probe = {"Probes/Further": "A", "Probes/A/Position": ", ".join(map(repr, map(float, middle)))}
    folder.write("localize.prm", localization(**{**probe, "Localization/Variant": "local strain"}))
    for ranks in (1, 3):
        folder.run(0, "stress_localization", "localize.prm", "--output", "solid", ranks=ranks)
        with h5py.File(folder("solid", "localization.h5")) as file:
            for name, values in expected.items():
                assert np.abs(file[name][()] - values).max() < 1e-10 * np.abs(values).max(), (ranks, name)
            assert np.abs(file["probes/A/stress"][()] - stress[:, 7]).max() < 1e-10 * np.abs(stress).max()
        assert folder.summary("solid")["dim"] == 3 and folder.summary("solid")["probes"][0]["z"] == middle[2]
        assert folder.read("solid", "localization.xdmf").decode().count('Center="Cell"') == 13


def check_points(folder):
    """A volume element in a body of three times its size: at a point sigma = C L E(t), E being that of the cell of the grid."""
    folder.write("body.prm", prm({"Body/RVE file": "rve-mesh/rve.h5", "Body/Size": "0.006, 0.003", "Body/Cells": "12, 6", **RUN}))
    folder.run(0, "contact_dynamics", "body.prm", "--output", "large")
    folder.write("points.prm", localization(**{"Input/RVE file": "rve-mesh", "Input/Homogeneous run": "large", "Probes/Of the run": "",
                                               "Volume element/Points": "P, Q", "Volume element/P/Position": "2.75e-3, 0.25e-3",
                                               "Volume element/Q/Position": "5.25e-3, 1.75e-3"}))
    with h5py.File(folder("large", "dynamics.h5")) as file, h5py.File(folder("rve-mesh", "rve.h5")) as rve:
        u = file["snapshots/displacement"][()]
        C = rve["phase/stiffness"][()][rve["phase/id"][()]]
        L = rve["concentration/KUBC"][()]
    for ranks in (1, 2):
        folder.run(0, "stress_localization", "points.prm", "--output", "points", ranks=ranks)
        assert [point["name"] for point in folder.summary("points")["points"]] == ["P", "Q"]
        with h5py.File(folder("points", "localization.h5")) as file:
            for name, i, j in (("P", 5, 0), ("Q", 10, 3)):
                corners = [[u[:, j + b, i + a] for a in (0, 1)] for b in (0, 1)]
                dx = ((corners[0][1] - corners[0][0]) + (corners[1][1] - corners[1][0])) / 2 / 5e-4
                dy = ((corners[1][0] - corners[0][0]) + (corners[1][1] - corners[0][1])) / 2 / 5e-4
                E = np.stack([dx[:, 0], dy[:, 1], dx[:, 1] + dy[:, 0]], axis=-1)
                stress = np.einsum("nij,njk,tk->tni", C, L, E)
                group = file["points"][name]
                assert np.abs(group["mean_stress"][()] - stress.mean(axis=0)).max() < 1e-9 * np.abs(stress).max()
                assert np.abs(group["deviation_stress"][()] - stress.std(axis=0)).max() < 1e-9 * np.abs(stress).max()


def check_refused(folder):
    def refused(words, *settings, prm_file="points.prm"):
        said = folder.run(2, "stress_localization", prm_file, "--output", "none", *("--set=" + setting for setting in settings))
        assert all(word in said for word in words), said

    folder.write("none.prm", localization(**{"Input/RVE file": "rve-mesh", "Input/Homogeneous run": "large"}))
    refused(["covers the box from (0, 0) m to (0.006, 0.003) m", "Volume element/Points"], prm_file="none.prm")
    for run in ("direct-mesh", "phases-rve-mesh"):
        refused(["heterogeneous body"], f"Input/Homogeneous run={run}", prm_file="none.prm")
    refused(["is 3D", "2D"], "Input/Homogeneous run=homogeneous", prm_file="none.prm")
    refused(["Probes/Of the run names 'M'"], "Input/Homogeneous run=homogeneous-mesh", "Probes/Of the run=M", prm_file="none.prm")
    refused(["Volume element/P/Position: (9, 0) m", "outside the body"], "Volume element/P/Position=9, 0")
    refused(["Volume element/P/Position has 3 numbers", "2 dimensions"], "Volume element/P/Position=0, 0, 0")
    refused(["neither probes nor a direct run"], "Input/Direct run=large")
    refused(["direct run", "72 cells"], "Input/Homogeneous run=homogeneous-mesh", "Input/Direct run=large",
            prm_file="none.prm")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as place:
        here = Folder(place)
        check_chain(here)
        check_points(here)
        check_solid(here)
        check_refused(here)
