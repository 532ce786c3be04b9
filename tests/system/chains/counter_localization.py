"""Stresses in the phases of a counter body: its counter_body.h5 is localized as the dynamics.h5 of a body is. The same file put where its volume was, as that of a body on
the flat, gives the same stresses; the surface that is compared apart is the one at the contact, above. Grids, boxes and meshes, in runs and at rest."""

import csv
import shutil
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import Folder, prm, rve

DEPTH = 4e-4  # m: four rows
STEEL = {2: "2.8e11, 1.2e11, 2.8e11, 0.8e11", 3: "2.8e11, 1.2e11, 1.2e11, 2.8e11, 1.2e11, 2.8e11, 0.8e11, 0.8e11, 0.8e11"}
PHASES = {"Phases/Names": "matrix, fibre", **{f"Phases/{name}/{key}": value for name, young in (("matrix", 30e9), ("fibre", 240e9))
                                             for key, value in (("Young modulus", young), ("Poisson ratio", 0.2), ("Density", 1770))}}
RUN = {"Supports/Top/Kind": "platen", "Supports/Top/Pressure": 5e6, "Flat/Velocity": 2}


def result(folder, name):
    with h5py.File(folder(name, "localization.h5")) as file:
        fields = {key: file[key][()] for key in ("mean_von_mises", "mean_stress", "direct/mean_von_mises")}
    rows = list(csv.reader(folder.read(name, "field_errors.csv").decode().splitlines()))
    return fields, rows


def copy_as_upper(folder, run):
    """A copy of a run whose counter_body.h5 is that of a body on the flat."""
    shutil.copytree(folder(run), folder("upper-" + run))
    with h5py.File(folder("upper-" + run, "counter_body.h5"), "r+") as file:
        if "grid" in file:
            file["grid"].attrs["origin"] = [0.0] * len(file["grid"].attrs["origin"])
        del file["run"].attrs["contact_side"]


def box_of_voxels(folder):
    np.save(folder("voxels.npy"), (np.random.default_rng(1).random((6, 6, 10)) < 0.2).astype(np.uint8))
    size, cells = "5e-3, 3e-3, 3e-3", "10, 6, 6"
    volume = {"Dimension": 3, "Grid/Cells": cells, "Grid/Size": size, **PHASES, "Microstructure/Type": "voxels", "Microstructure/File": "voxels.npy"}
    return volume, {"Dimension": 3, "Body/Size": size, "Body/Cells": cells, "Body/Stiffness": STEEL[3], "Body/Density": 7800}


def plane_mesh(folder):
    """The volume is meshed where the counter body is, below the body."""
    below = Box([6, 3], [12, 6], lambda x: "fibre" if (int(x[0] * 2) + int(x[1] * 2)) % 3 == 0 else "matrix", "cube")
    below.name_side("Bottom", 1, False).name_side("Contact", 1, True)
    below.points[:, 1] -= 3
    below.write(folder("below.msh"))
    Box([6, 4], [12, 8], lambda x: "body", "cube").name_side("Contact", 1, False).name_side("Top", 1, True).write(folder("body.msh"))
    volume = {"Mesh/File": "below.msh", "Mesh/Scale": 0.001, **PHASES}
    return volume, {"Mesh/File": "body.msh", "Mesh/Scale": 0.001, "Phases/Names": "body", "Phases/body/Type": "stiffness", "Phases/body/Density": 7800,
                    "Phases/body/Stiffness": STEEL[2], "Counter body/Mesh/File": "below.msh", "Counter body/Mesh/Scale": 0.001}


def check_kind(folder, volume, pair, analysis):
    folder.write("volume.prm", prm({**volume, "Homogenization/Boundary conditions": "KUBC"}))
    folder.run(0, "rve_homogenization", "volume.prm", "--output", "volume", "--quiet")
    for material in ("homogeneous", "heterogeneous"):
        folder.write("run.prm", prm({**pair, **RUN, **analysis, "Counter body/RVE file": "volume/rve.h5", "Counter body/Material": material}))
        folder.run(0, "contact_dynamics", "run.prm", "--output", material, "--quiet")
        copy_as_upper(folder, material)
    found, surface = [], []
    for start in ("", "upper-"):
        folder.write("local.prm", prm({"Input/RVE file": "volume/rve.h5", "Input/Homogeneous run": f"{start}homogeneous/counter_body.h5",
                                       "Input/Direct run": f"{start}heterogeneous/counter_body.h5"}))
        folder.run(0, "stress_localization", "local.prm", "--output", start + "local", "--quiet")
        fields, rows = result(folder, start + "local")
        found.append(fields)
        surface.append([row for row in rows if "surface" in row])
    for key, values in found[0].items():
        assert np.abs(values).max() > 1e6 and np.abs(values - found[1][key]).max() <= 1e-12 * np.abs(values).max(), (key, analysis)
    assert surface[0] and surface[0] != surface[1], surface


def main():
    for kind in (box_of_voxels, plane_mesh):
        for analysis in ({"Time/End time": 1e-5, "Snapshots/Interval": 1e-6}, {"Analysis": "static contact"}):
            with tempfile.TemporaryDirectory() as path:
                check_kind(Folder(path), *kind(Folder(path)), analysis)
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"rve": rve("60, 24", "0.006, 0.0024", 2e-4, 6e-4, **{"Microstructure/Random fibres/Cut by border": "true",
                                                                                  "Homogenization/Boundary conditions": "KUBC"})})
        folder.run(0, "rve_homogenization", "rve.prm", "--output", "rve")
        pair = {"Body/Size": "0.006, 0.0024", "Body/Cells": "30, 12", "Body/Stiffness": STEEL[2], "Body/Density": 7800, **RUN,
                "Counter body/RVE file": "rve/rve.h5", "Time/End time": 3e-5, "Time/Time step": 8e-9, "Snapshots/Interval": 1e-6}
        for material in ("homogeneous", "heterogeneous"):
            folder.write("run.prm", prm({**pair, "Counter body/Material": material}))
            folder.run(0, "contact_dynamics", "run.prm", "--output", material)
            copy_as_upper(folder, material)
        found = {}
        for start in ("", "upper-"):
            folder.write("local.prm", prm({"Input/RVE file": "rve/rve.h5", "Input/Homogeneous run": f"{start}homogeneous/counter_body.h5",
                                           "Input/Direct run": f"{start}heterogeneous/counter_body.h5", "Comparison/Surface depth": DEPTH, "Comparison/Edge distance": 5e-4}))
            folder.run(0, "stress_localization", "local.prm", "--output", start + "local")
            found[start] = result(folder, start + "local")
        for key, values in found[""][0].items():
            assert np.abs(values).max() > 0 and np.abs(values - found["upper-"][0][key]).max() <= 1e-12 * np.abs(values).max(), key
        ours, theirs = (field[-4:] for field in (found[""][0]["mean_von_mises"], found[""][0]["direct/mean_von_mises"]))
        wanted = np.sqrt(((ours - theirs) ** 2).sum() / (theirs**2).sum())
        surfaces = {start: [row for row in found[start][1] if "surface" in row and "mean_von_mises" in " ".join(row)] for start in found}
        assert any(abs(float(value) / wanted - 1) < 1e-6 for row in surfaces[""] for value in row if value.replace(".", "").replace("e-", "").isdigit()), (surfaces, wanted)
        assert surfaces[""] != surfaces["upper-"], surfaces
        print("error of the surface", wanted)


if __name__ == "__main__":
    main()
