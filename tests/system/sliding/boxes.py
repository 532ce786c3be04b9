"""contact_dynamics on boxes of voxels: as on a mesh of the same cells, on 1, 2 and 3 ranks; one layer as a plane grid; periodic; going on
from a checkpoint; localized stresses; what is refused."""

import re
import tempfile

import h5py
import numpy as np

from mesh_dynamics import check_equal, check_same_summary, group, probes
from mesh_files import Box
from scenes import Folder, prm

CELLS, SIZE = (9, 5, 6), (0.0045, 0.002, 0.0036)  # no cubes
MATERIALS = {"Phases/Names": "matrix, fibre", "Phases/matrix/Young modulus": "30e9", "Phases/matrix/Poisson ratio": 0.2,
             "Phases/matrix/Density": 1800, "Phases/fibre/Type": "orthotropic", "Phases/fibre/Young moduli": "240e9, 60e9, 90e9",
             "Phases/fibre/Poisson ratios": "0.2, 0.25, 0.3", "Phases/fibre/Shear moduli": "40e9, 30e9, 50e9", "Phases/fibre/Density": 2600,
             "Phases/fibre/Friction coefficient": 0.5}
COMMON = {"Flat/Velocity": "2, 0.3", "Supports/Top/Pressure": 5e7, "Friction/Coefficient from": "phases", "Friction/Node rule": "mean",
          "Time/Time step": 1.5e-8, "Time/End time": 1.2e-5, "Observation/History interval": 1, "Observation/Energy interval": 1,
          "Body/Acceleration": "5, 7, -10", "Snapshots/Interval": 2e-6}
BOX = "set Dimension = 3\n" + prm({"Body/Material": "heterogeneous", "Body/RVE file": "rve/rve.h5", **COMMON})
MESH = "set Dimension = 3\n" + prm({"Mesh/File": "mesh.msh", **MATERIALS, **COMMON})
PROBES = probes(inside="0.0011, 0.0009, 0.0021", contact="0.0022, 0.0011, 0")
SIDES = {"Left": (0, False), "Right": (0, True), "Front": (1, False), "Back": (1, True), "Contact": (2, False), "Top": (2, True)}
BY_PHASE = {"Time/Rayleigh beta": "2e-9, 7e-9", "Body/Rayleigh alpha": "4e4, 1e4"}
# What is held: of the box and of the mesh; and sides that are one.
SUPPORTS = {"held": (prm({"Supports/Left/Held": "u_x, u_z", "Supports/Back/Held": "u_y", "Supports/Top/Kind": "pressure"}),
                     prm({"Supports/Left/Held": "u_x, u_z", "Supports/Back/Held": "u_y", "Supports/Top/Kind": "pressure"})),
            "platen": (prm({"Supports/Top/Kind": "platen"}),) * 2,
            "damped": (prm({**BY_PHASE, "Supports/Top/Kind": "springs", "Supports/Top/Spring stiffness": "1e13, 2e13, 3e13", "Supports/Left/Kind": "absorbing"}),) * 2,
            "lossy": (prm({"Time/Rayleigh beta": "2e-9, 7e-9", "Body/Rayleigh alpha": 3e4, "Supports/Top/Kind": "pressure", "Supports/Right/Held": "u_x"}),) * 2,
            "periodic": (prm({"Sides/Periodic": "true", "Sides/Periodic in y": "true", "Supports/Top/Kind": "platen"}),
                         prm({"Mesh/Periodic in x": "Left, Right", "Mesh/Periodic in y": "Front, Back", "Supports/Top/Kind": "platen"}))}


def prepare(folder):
    """The volume of random voxels, and a mesh of the same cells."""
    voxels = np.random.default_rng(3).integers(0, 2, CELLS[::-1], dtype=np.uint8)
    np.save(folder("voxels.npy"), voxels)
    folder.write("rve.prm", "set Dimension = 3\n" + prm({"Grid/Cells": "%d, %d, %d" % CELLS, "Grid/Size": "%g, %g, %g" % SIZE,
                                                         "Microstructure/Type": "voxels", "Microstructure/File": "voxels.npy", **MATERIALS}))
    folder.run(0, "rve_homogenization", "rve.prm", "--output", "rve")

    def phase(middle):
        i, j, k = (int(x / length * n) for x, length, n in zip(middle, SIZE, CELLS))
        return ("matrix", "fibre")[voxels[k, j, i]]

    mesh = Box(SIZE, CELLS, phase)
    for name, (axis, upper) in SIDES.items():
        mesh.name_side(name, axis, upper)
    mesh.write(folder("mesh.msh"))


def displacements(file):
    """Of all snapshots [k][points][3], points by their places: Gmsh numbers them in its own way, those of boxes are in order."""
    u = file["snapshots/displacement"][()]
    if "mesh" in file:
        return u[:, np.lexsort(np.round(file["mesh/points"][()] / 1e-7).T)]
    assert "grid" in file and tuple(file["grid"].attrs["cells"]) == CELLS and file.attrs["format"] == b"mesoslip-dynamics", file.attrs["format"]
    assert u.shape[1:] == (*(n + 1 for n in CELLS[::-1]), 3), u.shape
    return u.reshape(len(u), -1, 3)


def check_as_mesh(folder):
    for name, (of_box, of_mesh) in SUPPORTS.items():
        folder.write("mesh.prm", MESH + of_mesh + PROBES)
        folder.run(0, "contact_dynamics", "mesh.prm", "--output", "mesh")
        folder.write(f"{name}.prm", BOX + of_box + PROBES)
        for ranks in (1, 2, 3):
            run = f"{name}{ranks}"
            said = folder.run(0, "contact_dynamics", f"{name}.prm", "--output", run, ranks=ranks)
            assert "Grid: 9 x 5 x 6 cells" in said, said
            for what in ("history", "energy", "probes", "reference"):
                # Residuals are rounding of what vanishes.
                one, two = ({key: v for key, v in group(folder, r, what).items() if key not in ("residual", "scheme", "potential")}
                            for r in (run, "mesh"))
                check_equal(one, two, 1e-9, (name, ranks, what))
            summary = folder.summary(run)
            check_same_summary(summary, folder.summary("mesh"), 1e-8, (name, ranks), but=("inputs", "critical_time_step"))
            assert summary["energy_balance_residual"] < 1e-12, summary["energy_balance_residual"]
            with h5py.File(folder(run, "dynamics.h5")) as file, h5py.File(folder("mesh", "dynamics.h5")) as other:
                u, v = displacements(file), displacements(other)
                assert u.shape == v.shape and np.abs(u - v).max() < 1e-9 * np.abs(v).max() > 0, (name, ranks)
        assert folder.summary(f"{name}1")["slip_fraction"] > 0.01


def check_one_layer(folder):
    """A layer whose sides are held across y is the plane grid."""
    common = {"Time/Time step": 2e-8, "Time/End time": 2e-5, "Flat/Velocity": 1.5, "Supports/Top/Pressure": 5e6, "Body/Density": 1800,
              "Observation/History interval": 1, "Observation/Energy interval": 1}
    folder.write("plane.prm", prm({**common, "Body/Size": "8e-3, 4e-3", "Body/Cells": "40, 20",
                                   "Body/Stiffness": "66.667e9, 16.667e9, 66.667e9, 25e9"}))
    folder.write("solid.prm", "set Dimension = 3\n" + prm({
        **common, "Body/Size": "8e-3, 1, 4e-3", "Body/Cells": "40, 1, 20", "Supports/Front/Held": "u_y", "Supports/Back/Held": "u_y",
        "Body/Stiffness": "66.667e9, 16.667e9, 16.667e9, 66.667e9, 16.667e9, 66.667e9, 25e9, 25e9, 25e9"}))
    for run in ("plane", "solid"):
        folder.run(0, "contact_dynamics", run + ".prm", "--output", run)
    for what, names in (("history", ("contact_normal_force", "contact_tangential_force", "top_displacement", "friction_energy")),
                        ("energy", ("kinetic", "elastic", "damping", "friction"))):
        plane, solid = (group(folder, run, what) for run in ("plane", "solid"))
        for name in names:
            assert np.abs(plane[name] - solid[name]).max() < 1e-12 * np.abs(plane[name]).max() > 0, name


def check_resumed(folder):
    half = ("--set=Checkpoints/Keep=true", "--set=Time/End time=6e-6")
    for ranks in (1, 3):
        folder.run(0, "contact_dynamics", "platen.prm", "--output", "half", *half, ranks=ranks)
        folder.run(0, "contact_dynamics", "platen.prm", "--output", "half", "--resume", ranks=ranks)
        for what in ("history", "energy", "probes"):
            for key, values in group(folder, f"platen{ranks}", what).items():
                assert np.array_equal(values, group(folder, "half", what)[key]), (ranks, what, key)


def check_localized(folder):
    """Voxels with their stresses in the homogeneous body: stiffness of the phase times L times the strain of the body at its middle."""
    folder.write("homogeneous.prm", "set Dimension = 3\n" + prm({
        "Body/RVE file": "rve/rve.h5", "Supports/Top/Kind": "platen", "Supports/Top/Pressure": 5e7, "Time/End time": 6e-6, "Snapshots/Interval": 1e-6}))
    folder.run(0, "contact_dynamics", "homogeneous.prm", "--output", "homogeneous")
    folder.write("localization.prm", prm({"Input/RVE file": "rve/rve.h5", "Input/Homogeneous run": "homogeneous/dynamics.h5",
                                          "Localization/Fields": "mean stress"}))
    for ranks in (1, 2):
        folder.run(0, "stress_localization", "localization.prm", "--output", f"localized{ranks}", ranks=ranks)
    with h5py.File(folder("localized1", "localization.h5")) as one, h5py.File(folder("localized2", "localization.h5")) as two:
        names = []
        one.visititems(lambda name, item: names.append(name) if name.endswith("mean_stress") else None)
        assert names
        for name in names:
            assert np.abs(one[name][()] - two[name][()]).max() <= 1e-12 * np.abs(one[name][()]).max() > 0, name


def check_other_analyses(folder):
    """Modes and static contact on the box and on the mesh of its cells."""
    modal = prm({"Analysis": "modal", "Modal/Number of modes": 3})
    static = prm({"Analysis": "static contact", "Friction/Coefficient from": "constant", "Friction/Coefficient": 0.2})
    drop = ("Time/", "Observation/", "Snapshots/", "Body/Acceleration", "Flat/Velocity", "Friction/")
    common = {key: value for key, value in COMMON.items() if not key.startswith(drop)}
    own = ("inputs", "rve_digest", "iterations", "state_changes", "solver_iterations", "residual", "friction_change", "phase_pressure_imbalance")
    for name, sides, mesh_sides in (("modal", *SUPPORTS["platen"]), ("modal", *SUPPORTS["periodic"]), ("static", *SUPPORTS["platen"]),
                                    ("rest", *SUPPORTS["platen"])):
        settings = modal if name == "modal" else static + prm({**common, "Flat/Velocity": 1 if name == "static" else 0})
        folder.write("box_other.prm", "set Dimension = 3\n" + prm({"Body/Material": "heterogeneous", "Body/RVE file": "rve/rve.h5"}) + sides + settings)
        folder.write("mesh_other.prm", "set Dimension = 3\n" + prm({"Mesh/File": "mesh.msh", **MATERIALS}) + mesh_sides + settings)
        for run, ranks in (("mesh", 1), *([("box", 3), ("box", 2)] if name == "rest" else []), ("box", 1)):
            folder.run(0, "contact_dynamics", f"{run}_other.prm", "--output", f"{run}_{name}", ranks=ranks)
            if run == "box":
                check_same_summary(folder.summary(f"box_{name}"), folder.summary(f"mesh_{name}"), 1e-6, (name, ranks), but=own)
        with h5py.File(folder(f"box_{name}", "modal.h5" if name == "modal" else "dynamics.h5")) as file:
            field = file["modes/free/shape" if name == "modal" else "snapshots/displacement"]
            assert field.shape[1:] == (*(n + 1 for n in CELLS[::-1]), 3) and np.isfinite(field[()]).all(), field.shape


def check_automatic_step(folder):
    """Time step = auto is the same number on any number of ranks, and so is all that follows from it."""
    folder.write("auto.prm", BOX + prm({"Supports/Top/Kind": "pressure", "Supports/Left/Held": "u_x, u_z", "Supports/Back/Held": "u_y"}) + PROBES)
    runs = []
    for ranks in (1, 2, 3):
        folder.run(0, "contact_dynamics", "auto.prm", "--output", "auto", "--set=Time/Time step=auto", "--set=Time/End time=2e-6", ranks=ranks)
        probed = group(folder, "auto", "probes")
        runs.append((folder.summary("auto")["time_step"], {key: value for key, value in probed.items() if "displacement" in key or "velocity" in key}))
    for step, values in runs[1:]:
        assert step == runs[0][0] and len(values) > 1, (step, runs[0][0])
        assert all((value == runs[0][1][key]).all() for key, value in values.items()), {
            key: np.abs(value - runs[0][1][key]).max() / np.abs(value).max() for key, value in values.items()}


def check_refused(folder):
    def refused(words, *settings, prm_file="platen.prm", ranks=1):
        said = folder.run(2, "contact_dynamics", prm_file, "--output", "none", *("--set=" + setting for setting in settings), ranks=ranks)
        assert all(word in said for word in words), said

    refused(["Body/Cells: 9 x 5 x 7 is no multiple of the 9 x 5 x 6 cells of"], "Body/Cells=9, 5, 7")
    refused(["Body/Cells: 2 numbers found, three (x, y, z) are needed"], "Body/Cells=9, 5")
    refused(["Body/Size is 0.01 x 0.01 x 0.01 m, but the volume in"], "Body/Size=0.01, 0.01, 0.01")
    refused(["Sides/Periodic in y", "Front and Back have to be free"], "Sides/Periodic in y=true", "Supports/Back/Held=u_x")
    refused(["Supports/Left/Held", "u_z is held, but the platen"], "Supports/Left/Held=u_z")
    refused(["Observation/inside/Position", "lies outside the body"], "Observation/inside/Position=0.1, 0, 0")
    refused(["5 layers of cells along y", "not 6"], ranks=6)
    refused(["Supports/wall: the body is a grid, whose sides are Left"], "Supports/wall/Held=u_x")
    refused(["Performance/Temporal blocking has no effect, as the body is no plane grid"], "Performance/Temporal blocking=4")
    refused(["Time/Rayleigh beta has 3 values, but the body has 2 phases, matrix, fibre", "one for each phase in this order"], "Time/Rayleigh beta=1e-9, 2e-9, 3e-9")
    refused(["Body/Rayleigh alpha has 3 values, but"], "Time/Rayleigh beta=1e-9, 2e-9", "Body/Rayleigh alpha=1, 1, 1")
    refused(["Rayleigh beta", "numbers >= 0"], "Time/Rayleigh beta=1e-9, -1e-9")
    refused(["Supports/Top/Hold from", "alpha by phase"], "Body/Rayleigh alpha=1, 2", "Supports/Top/Hold from=1e-6")
    refused(["of memory, but the machine has", "cells would fit; reduce Body/Cells"], "Body/Cells=9000, 5000, 6000")
    for name in ("platen", "mesh"):
        told = [folder.run(0, "contact_dynamics", name + ".prm", "--validate", ranks=ranks) for ranks in (1, 2)]
        assert re.search(r"B of memory$", told[0], re.MULTILINE) and re.search(r"B of memory on rank 0, .* on each other$", told[1], re.MULTILINE), told
    refused(["Supports/Front/Held has no effect, as the body is plane"], "Supports/Front/Held=u_y", prm_file="plane.prm")
    refused(["Supports/Left/Held", "u_z is held, but Dimension is 2"], "Supports/Left/Held=u_z", prm_file="plane.prm")
    folder.write("bare.prm", "set Dimension = 3\n")
    refused(["Body/Stiffness: it is not given", "9 or 21 numbers"], prm_file="bare.prm")
    refused(["Body/Size is empty", "three numbers along x, y, z"], "Body/Stiffness=3, 1, 1, 3, 1, 3, 1, 1, 1", prm_file="bare.prm")
    refused(["Body/Stiffness", "9 of an orthotropic material or all 21"], "Body/Stiffness=1, 2, 3, 4", prm_file="bare.prm")


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        prepare(folder)
        check_as_mesh(folder)
        check_one_layer(folder)
        check_resumed(folder)
        check_localized(folder)
        check_other_analyses(folder)
        check_automatic_step(folder)
        check_refused(folder)
    print("contact_dynamics on boxes of voxels: as on meshes and plane grids, on several ranks, continued, localized")


if __name__ == "__main__":
    main()
