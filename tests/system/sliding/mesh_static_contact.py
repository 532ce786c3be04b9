"""Analysis static contact on meshes: a grid handed in as a mesh, on 1, 2 and 3 ranks; a layer of hexahedra with u_y held; what is
refused."""

import csv
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import Folder, prm

STIFFNESS, DENSITY = "36.54e9, 9.1e9, 47.26e9, 13.785e9", 1770
LOADS = {"Analysis": "static contact", "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 1e6, "Supports/Top/Held": "u_x",
         "Static contact/Tolerance": 1e-9, "Friction/Coefficient": 0.2}
MESH = {"Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, "Phases/Names": "body", "Phases/body/Young modulus": 40e9,
        "Phases/body/Poisson ratio": 0.3, "Phases/body/Density": DENSITY}


def columns(folder, run, *names):
    """Columns of the table of contact nodes in ascending x, of equal x in ascending y."""
    with open(folder(run, "static_contact.csv"), encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    rows.sort(key=lambda row: (round(float(row["x [m]"]), 9), float(row.get("y [m]", 0))))
    return [np.array([float(row[name]) for row in rows]) for name in names], [row["state"] for row in rows]


def assert_close(one, other, tolerance):
    for a, b in zip(one, other):
        assert a.shape == b.shape and np.abs(a - b).max() <= tolerance * np.abs(a).max(), np.abs(a - b).max() / np.abs(a).max()


def check_grid_as_mesh(folder, velocity, top, steps=None):
    """Pressure, shear and states of a sliding or resting body to the tolerance, and what the flat carries after each of the `steps`."""
    names = ("pressure [Pa]", "displacement_x [m]")
    common = {**LOADS, "Flat/Velocity": velocity, "Supports/Top/Kind": top, **(steps or {})}
    if top == "platen":
        del common["Supports/Top/Held"]
    folder.write("grid.prm", prm({**common, "Body/Stiffness": STIFFNESS, "Body/Density": DENSITY, "Body/Size": "0.012, 0.004",
                                  "Body/Cells": "24, 10"}))
    folder.run(0, "contact_dynamics", "grid.prm", "--output", "grid")
    box = Box([12, 4], [24, 10], lambda x: "body")
    box.name_side("Contact", 1, False).name_side("Top", 1, True).write(folder("mesh.msh"))
    folder.write("mesh.prm", prm({**common, "Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, "Phases/Names": "body",
                                  "Phases/body/Type": "stiffness", "Phases/body/Stiffness": STIFFNESS, "Phases/body/Density": DENSITY}))
    expected, states = columns(folder, "grid", *names, "shear_traction [Pa]")
    for ranks in (1, 2, 3):
        folder.run(0, "contact_dynamics", "mesh.prm", "--output", "mesh", ranks=ranks)
        found, others = columns(folder, "mesh", *names, "shear_traction [Pa]")
        assert_close(expected, found, 1e-6)
        assert states == others, (ranks, states, others)
        assert_same_pressures(folder, 1e-6)
        if steps:
            assert_close(load_steps(folder, "grid"), load_steps(folder, "mesh"), 1e-6)


def load_steps(folder, run):
    """Displacements, forces and areas of load_steps.csv."""
    with open(folder(run, "load_steps.csv"), encoding="ascii") as file:
        rows = list(csv.reader(file))
    return [np.array([float(row[column]) for row in rows[1:]]) for column in range(rows[0].index("iterations [-]"))]


def assert_same_pressures(folder, tolerance):
    """What follows from the pressures of the only phase, eqs (17) and (19)."""
    grid, mesh = folder.summary("grid"), folder.summary("mesh")
    for key in ("surface_fractions", "phase_contact_pressures", "phase_pressures_eq_19", "homogenized_friction_coefficient"):
        assert len(grid[key]) == len(mesh[key]) > 0
        for one, other in zip(grid[key].values(), mesh[key].values()):
            assert abs(one - other) <= tolerance * abs(one), (key, one, other)
    assert abs(grid["phase_pressure_imbalance"] - mesh["phase_pressure_imbalance"]) <= tolerance


def check_two_phases(folder):
    """Columns of two phases without Poisson's ratio under a platen are compressed alike, as eq. (19) says."""
    phases = {"Phases/Names": "soft, stiff", "Friction/Coefficient from": "phases"}
    for name, modulus, friction in (("soft", 10e9, 0.1), ("stiff", 30e9, 0.5)):
        phases.update({f"Phases/{name}/{key}": value for key, value in (
            ("Young modulus", modulus), ("Poisson ratio", 0), ("Density", DENSITY), ("Friction coefficient", friction))})
    folder.write("columns.prm", "set Dimension = 3\n" + prm({
        "Analysis": "static contact", "Supports/Top/Kind": "platen", "Supports/Top/Pressure": 1e6, "Flat/Velocity": 0, "Mesh/File": "mesh.msh",
        "Mesh/Scale": 0.001, **phases}))
    box = Box([8, 2, 3], [8, 2, 3], lambda x: "soft" if x[0] < 6 else "stiff")
    box.name_side("Contact", 2, False).name_side("Top", 2, True).write(folder("mesh.msh"))
    for ranks in (1, 2):
        folder.run(0, "contact_dynamics", "columns.prm", "--output", "columns", ranks=ranks)
        found = folder.summary("columns")
        assert_close([np.array([0.75, 0.25]), np.array([2 / 3 * 1e6, 2e6]), np.array([2 / 3 * 1e6, 2e6]), np.array([0.3, 0.3])],
                     [np.array(list(found[key].values())) for key in (
                         "surface_fractions", "phase_contact_pressures", "phase_pressures_eq_19", "homogenized_friction_coefficient")], 1e-6)
        assert found["phase_pressure_imbalance"] < 1e-6


def check_node_rules(folder):
    """Between two phases a node has the coefficient of either, or a mean of both."""
    box = Box([8, 2, 3], [8, 2, 3], lambda x: "soft" if x[0] < 6 else "stiff")
    box.name_side("Contact", 2, False).name_side("Top", 2, True).write(folder("mesh.msh"))
    for rule, between in (("largest", 0.5), ("smallest", 0.1), ("mean", 0.3), ("stiffness", (10 * 0.1 + 30 * 0.5) / 40)):
        folder.run(0, "contact_dynamics", "columns.prm", "--output", "rules", f"--set=Friction/Node rule={rule}", ranks=2)
        (x, mu), _ = columns(folder, "rules", "x [m]", "friction_coefficient [-]")
        expected = np.where(x < 0.0059, 0.1, np.where(x > 0.0061, 0.5, between))
        assert np.abs(mu - expected).max() < 1e-12, (rule, mu)


def check_steps(folder):
    """Where nothing but the size of the load changes steps are as good as one; back and forth again; the same on 1, 2 and 3 ranks."""
    names = ("pressure [Pa]", "displacement_x [m]", "shear_traction [Pa]")
    common = {**LOADS, **MESH, "Supports/Top/Kind": "platen", "Flat/Velocity": 0}
    del common["Supports/Top/Held"]
    Box([6, 2], [12, 5], lambda x: "body").name_side("Contact", 1, False).name_side("Top", 1, True).write(folder("mesh.msh"))
    folder.write("steps.prm", prm(common))
    tables = {}
    for steps in (1, 3):
        folder.run(0, "contact_dynamics", "steps.prm", "--output", "steps", f"--set=Static contact/Load steps={steps}")
        tables[steps] = columns(folder, "steps", *names)
    assert_close(tables[1][0], tables[3][0], 1e-5)
    assert tables[1][1] == tables[3][1], tables
    moved = []
    for ranks in (1, 2, 3):
        folder.run(0, "contact_dynamics", "steps.prm", "--output", "steps", "--set=Static contact/Load steps=2",
                   "--set=Static contact/Flat displacement=1e-8", ranks=ranks)
        moved.append(columns(folder, "steps", *names))
        assert_close(moved[0][0], moved[-1][0], 1e-6)
        assert moved[0][1] == moved[-1][1]
    with open(folder("steps", "load_steps.csv"), encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["flat_displacement_x [m]"]) for row in rows] == [0, 0, 5e-9, 1e-8]
    force = [float(row["tangential_force [N/m]"]) for row in rows]
    assert abs(force[1]) < 1e-5 * force[3] and 0 < force[2] < force[3] <= 0.2 * 6000 * (1 + 1e-6), force
    for words, named in ((["Flat/Velocity=2", "Static contact/Flat displacement=1e-7"], "Flat displacement"),
                         (["Static contact/Flat displacement=1e-7, 1e-7"], "Flat displacement"),
                         (["Static contact/Load steps=0"], "Load steps"),
                         (["Supports/Top/Kind=pressure", "Static contact/Flat displacement=1e-7"], "Flat displacement")):
        said = folder.run(2, "contact_dynamics", "steps.prm", "--validate", *["--set=" + word for word in words])
        assert named in said, said


def check_held_side(folder):
    """A side that is held along the normal of the flat under a pressure: its nodes stay where they are, and grid and mesh agree."""
    common = {**LOADS, "Flat/Velocity": 2}
    folder.write("side_grid.prm", prm({**common, "Body/Stiffness": STIFFNESS, "Body/Density": DENSITY, "Body/Size": "0.012, 0.004",
                                       "Body/Cells": "24, 10", "Supports/Left/Held": "u_x, u_y"}))
    box = Box([12, 4], [24, 10], lambda x: "body")
    box.name_side("Contact", 1, False).name_side("Top", 1, True).name_side("left", 0, False).write(folder("mesh.msh"))
    folder.write("side_mesh.prm", prm({**common, "Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, "Phases/Names": "body",
                                       "Phases/body/Type": "stiffness", "Phases/body/Stiffness": STIFFNESS, "Phases/body/Density": DENSITY,
                                       "Supports/left/Held": "u_x, u_y"}))
    names = ("pressure [Pa]", "displacement_x [m]")
    for run in ("side_grid", "side_mesh"):
        folder.run(0, "contact_dynamics", run + ".prm", "--output", run)
    (expected, states), (found, others) = (columns(folder, run, *names) for run in ("side_grid", "side_mesh"))
    assert_close(expected, found, 1e-6)
    assert states == others and expected[0].max() > 0, (states, others)
    with h5py.File(folder("side_grid", "dynamics.h5")) as file:
        assert not file["snapshots/displacement"][-1, :, 0].any()


def check_layer(folder):
    """One layer of hexahedra with u_y held is the plane body."""
    folder.write("flat.prm", prm({**LOADS, **MESH, "Flat/Velocity": 2}))
    Box([6, 2], [12, 5], lambda x: "body").name_side("Contact", 1, False).name_side("Top", 1, True).write(folder("mesh.msh"))
    folder.run(0, "contact_dynamics", "flat.prm", "--output", "flat")
    folder.write("layer.prm", "set Dimension = 3\n" + prm({**LOADS, **MESH, "Flat/Velocity": 2, "Supports/front/Held": "u_y", "Supports/back/Held": "u_y"}))
    box = Box([6, 1, 2], [12, 1, 5], lambda x: "body")
    box.name_side("Contact", 2, False).name_side("Top", 2, True).name_side("front", 1, False).name_side("back", 1, True)
    box.write(folder("mesh.msh"))
    folder.run(0, "contact_dynamics", "layer.prm", "--output", "layer", ranks=2)
    names = ("pressure [Pa]", "shear_traction [Pa]", "displacement_x [m]")
    plane, states = columns(folder, "flat", *names)
    layer, others = columns(folder, "layer", *names)
    for side in (0, 1):
        assert_close(plane, [column[side::2] for column in layer], 1e-6)
        assert states == others[side::2]


def check_along_the_motion(folder):
    """The force of a body that slides all over is along the motion of the flat; its components are along x and y."""
    box = Box([6, 6, 2], [4, 4, 2], lambda x: "body")
    box.name_side("Contact", 2, False).name_side("Top", 2, True).write(folder("mesh.msh"))
    for direction in ((1, 0), (0, -1), (0.6, 0.8)):
        folder.write("askew.prm", "set Dimension = 3\n" + prm({**LOADS, **MESH, "Flat/Velocity": "%g, %g" % direction, "Supports/Top/Held": "u_x, u_y"}))
        folder.run(0, "contact_dynamics", "askew.prm", "--output", "askew")
        found = folder.summary("askew")
        force = np.array([found["tangential_force"], found["tangential_force_y"]]) / found["normal_force"]
        assert np.abs(force - 0.2 * np.array(direction)).max() < 1e-7, (direction, force)


def check_standing_faces(folder):
    """Faces of the contact that stand on the flat are told."""
    folder.write("edge.prm", prm({**MESH, "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 1e6}))
    for standing in (False, True):
        box = Box([6, 4], [6, 4], lambda x: "body")
        box.name_side("Contact", 1, False)
        if standing:
            box.name_side("Contact", 0, False)
            box.faces = [(corners, name) for corners, name in box.faces if box.points[corners][:, 1].max() < 4]  # below the top
        box.name_side("Top", 1, True)
        box.write(folder("mesh.msh"))
        said = folder.run(0, "contact_dynamics", "edge.prm", "--validate")
        assert ("3 of 10 nodes of 'Contact' have no area" in said) == standing, said


def check_refused(folder):
    for key, value, said in (("Supports/Top/Kind", "held", "Supports/Top/Kind"), ("Supports/Top/Pressure", 0, "Supports/Top/Pressure"), ("Flat/Gap", 1e-6, "Flat/Gap"),
                             ("Supports/Top/Held", "", "Nothing holds the body")):
        settings = {**LOADS, **MESH, "Flat/Velocity": 2, key: value}
        if key == "Supports/Top/Kind":
            del settings["Supports/Top/Held"]
        folder.write("bad.prm", "set Dimension = 3\n" + prm(settings))
        assert said in folder.run(2, "contact_dynamics", "bad.prm", "--output", "bad"), key


def main():
    with tempfile.TemporaryDirectory() as path:
        scenes = Folder(path)
        check_grid_as_mesh(scenes, 2, "pressure")
        check_grid_as_mesh(scenes, 0, "pressure")
        check_grid_as_mesh(scenes, 2, "platen")
        for top in ("pressure", "platen"):
            check_grid_as_mesh(scenes, 0, top, {"Static contact/Load steps": 3, "Static contact/Flat displacement": 1e-7})
        check_steps(scenes)
        check_held_side(scenes)
        check_layer(scenes)
        check_refused(scenes)
        check_along_the_motion(scenes)
        check_standing_faces(scenes)
        check_two_phases(scenes)
        check_node_rules(scenes)


if __name__ == "__main__":
    main()
