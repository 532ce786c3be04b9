"""Periodic sides of meshes in contact_dynamics, transient, modal and static contact: a periodic grid handed in as a mesh, a solid whose
phases are shifted across both sides; going on from a checkpoint, and what is refused."""

import csv
import tempfile

import h5py
import numpy as np

from mesh_dynamics import BODY, COMMON, DENSITY, MESH, OBSERVED, PLANE_PROBES, STATES, STEEL, STIFFNESS, check_equal, check_same_summary, group, probes
from mesh_files import Box
from mesh_static_contact import LOADS, columns
from scenes import Folder, prm

PERIODIC = {"Mesh/Periodic in x": "left, right"}
CELLS = [6, 4, 3]
SOLID_BODY = "set Dimension = 3\n" + prm({
    "Phases/Names": "body, core", **{key: value for key, value in STEEL.items() if key != "Phases/Names"},
    "Phases/core/Young modulus": "70e9", "Phases/core/Poisson ratio": 0.2, "Phases/core/Density": 2700})
SOLID = SOLID_BODY + MESH + prm({
    "Supports/Top/Kind": "pressure", "Body/Initial velocity": "0.5, 1, -1", "Snapshots/Interval": 1e-5, **PERIODIC, "Mesh/Periodic in y": "front, back"})


def box_with_sides(size, cells, phase, kind="cube"):
    box = Box(size, cells, phase, kind)
    names = [("left", "right"), ("front", "back")][:len(size) - 1] + [("Contact", "Top")]
    for axis, of_axis in enumerate(names):
        for upper, name in enumerate(of_axis):
            box.name_side(name, axis, bool(upper))
    return box


def shifted_box(shift):
    def phase(x):
        return "core" if (int(x[0] / 0.5 + shift) % CELLS[0], int(x[1] / 0.5 + shift) % CELLS[1]) in ((0, 0), (2, 1), (1, 1)) else "body"

    return box_with_sides([0.5 * n for n in CELLS], CELLS, phase)


def check_grid_as_mesh(folder):
    """All that is observed but the states of the last node, which grids have twice."""
    folder.write("grid.prm", prm({**COMMON, "Body/Stiffness": STIFFNESS, "Body/Density": DENSITY, "Body/Size": "0.012, 0.004",
                                  "Body/Cells": "24, 10", "Sides/Periodic": "true", "Observation/Reference x": 0.0031}) + PLANE_PROBES)
    folder.run(0, "contact_dynamics", "grid.prm", "--output", "grid")
    box_with_sides([12, 4], [24, 10], lambda x: "body").write(folder("mesh.msh"))
    folder.write("mesh.prm", MESH + prm({**BODY, **PERIODIC, "Observation/Reference x": 0.0031, "Snapshots/Interval": 1e-5}) + PLANE_PROBES)
    for ranks in (1, 2, 3):
        folder.run(0, "contact_dynamics", "mesh.prm", "--output", f"mesh{ranks}", ranks=ranks)
        for name in OBSERVED:
            of_grid, of_mesh = (group(folder, run, name) for run in ("grid", f"mesh{ranks}"))
            if name == "contact":
                of_grid = {key: of_grid[key] if key == "blocks/time" else of_grid[key][..., :-1] for key in STATES}
                of_mesh = {key: of_mesh[key] for key in STATES}
            if name == "energy":  # rounding of what nearly vanishes
                of_grid, of_mesh = ({key: values[key] for key in values if key not in ("residual", "scheme")} for values in (of_grid, of_mesh))
            check_equal(of_grid, of_mesh, 1e-9, (ranks, name))
        assert "Periodic in x: 11 points each, opposite within 0 m" in folder.read(f"mesh{ranks}", "log.txt").decode()
        summary = folder.summary(f"mesh{ranks}")
        check_same_summary(folder.summary("grid"), summary, 1e-9, ranks, but=("dofs",))
        assert summary["energy_balance_residual"] < 1e-11, summary
        with h5py.File(folder(f"mesh{ranks}", "dynamics.h5")) as file:
            x, u = file["mesh/points"][...], file["snapshots/displacement"][-1]
            sides = [u[np.abs(x[:, 0] - end) < 1e-9][np.argsort(x[np.abs(x[:, 0] - end) < 1e-9][:, 1])] for end in (0, 0.012)]
            assert len(sides[0]) == 11 and np.array_equal(*sides) and np.abs(sides[0]).max() > 0.1 * np.abs(u).max()


def check_seam(folder):
    """The reference node and a probe at the end of the period are those at its start, on the grid and on the mesh."""
    grid = prm({**COMMON, "Body/Stiffness": STIFFNESS, "Body/Density": DENSITY, "Body/Size": "0.012, 0.004", "Body/Cells": "24, 10",
                "Sides/Periodic": "true"})
    mesh = MESH + prm({**BODY, **PERIODIC})
    each_step = ("--set=Observation/Probe interval=1", "--set=Observation/History interval=1")
    for text in (grid, mesh):
        folder.write("seam.prm", text + probes(seam="0.012, 0"))
        seen = []
        for x in (0, 0.012):
            folder.run(0, "contact_dynamics", "seam.prm", "--output", "seam", f"--set=Observation/Reference x={x}", *each_step)
            seen.append(group(folder, "seam", "reference"))
        check_equal(seen[0], seen[1], 0, "reference node")
        traction = group(folder, "seam", "probes/seam")["traction"]
        assert np.abs(traction - seen[0]["traction"]).max() <= 1e-12 * np.abs(traction).max() and traction.any(), "probe"


def displacement(folder, run):
    """[z][y][x][component] in the last snapshot, without the sides that are there twice."""
    with h5py.File(folder(run, "dynamics.h5")) as file:
        x, u = file["mesh/points"][...], file["snapshots/displacement"][-1]
    places = np.rint(x / x.max(axis=0) * CELLS).astype(int)
    field = np.empty([n + 1 for n in CELLS[::-1]] + [3])
    field[places[:, 2], places[:, 1], places[:, 0]] = u
    assert np.array_equal(field[:, :, 0], field[:, :, -1]) and np.array_equal(field[:, 0], field[:, -1])
    return field[:, :-1, :-1]


def check_shifted(folder):
    """Phases that are shifted across the sides shift what happens."""
    fields = []
    for shift, ranks in ((0, 1), (0, 3), (2, 2)):
        shifted_box(shift).write(folder("mesh.msh"))
        folder.write("solid.prm", SOLID)
        folder.run(0, "contact_dynamics", "solid.prm", "--output", f"solid{shift}{ranks}", ranks=ranks)
        fields.append(np.roll(displacement(folder, f"solid{shift}{ranks}"), (shift, shift), (1, 2)))
    spread = np.ptp(fields[0][1, :, :, 2])  # the lowest nodes are on the flat
    assert spread > 1e-5 * np.abs(fields[0]).max(), spread  # the body as a whole moves far
    for other in fields[1:]:
        assert np.abs(other - fields[0]).max() < 1e-6 * spread, np.abs(other - fields[0]).max() / spread


def check_modes_of_grid(folder):
    """Frequencies and effective masses, of modes in pairs their sum, under a platen with mass."""
    modal = {"Analysis": "modal", "Modal/Number of modes": 8, "Modal/Tolerance": 1e-12, "Supports/Top/Platen mass": 0.05}
    folder.write("grid.prm", prm({**modal, "Body/Stiffness": STIFFNESS, "Body/Density": DENSITY, "Body/Size": "0.012, 0.004",
                                  "Body/Cells": "24, 10", "Sides/Periodic": "true"}))
    folder.run(0, "contact_dynamics", "grid.prm", "--output", "grid_modal")
    box_with_sides([12, 4], [24, 10], lambda x: "body").write(folder("mesh.msh"))
    folder.write("mesh.prm", prm({**modal, **BODY, **PERIODIC, "Mesh/File": "mesh.msh", "Mesh/Scale": 0.001}))

    def of(run):
        with open(folder(run, "modes.csv"), encoding="ascii") as file:
            rows = list(csv.DictReader(file))
        frequency = np.array([float(row["frequency [Hz]"]) for row in rows])
        masses = [sum(float(row[f"effective_mass_{axis} [-]"]) for row in rows) for axis in "xy"]
        assert np.sum(np.diff(frequency) < 1e-9 * frequency[1:]) >= 4, frequency  # pairs
        return frequency, masses

    expected = of("grid_modal")
    for ranks in (1, 2, 3):
        folder.run(0, "contact_dynamics", "mesh.prm", "--output", "mesh_modal", ranks=ranks)
        found = of("mesh_modal")
        assert np.abs(found[0] / expected[0] - 1).max() < 1e-9, (ranks, found, expected)
        assert np.allclose(found[1], expected[1], rtol=0, atol=1e-8), (ranks, found, expected)
        assert folder.summary("mesh_modal")["rigid_motions"] == folder.summary("grid_modal")["rigid_motions"]


def check_static_of_grid(folder):
    """Gravity along the flat, which rests: a layer that sticks; and one on a flat that slides."""
    for load in ({"Flat/Velocity": 0, "Body/Acceleration": "3e3, -2e4"}, {"Flat/Velocity": -2, "Supports/Top/Held": "u_x"}):
        common = {**LOADS, "Supports/Top/Held": "", **load}
        folder.write("grid.prm", prm({**common, "Body/Stiffness": STIFFNESS, "Body/Density": DENSITY, "Body/Size": "0.012, 0.004",
                                      "Body/Cells": "24, 10", "Sides/Periodic": "true"}))
        folder.run(0, "contact_dynamics", "grid.prm", "--output", "grid_static")
        folder.write("mesh.prm", prm({**common, **BODY, **PERIODIC, "Mesh/File": "mesh.msh", "Mesh/Scale": 0.001}))
        names = ("pressure [Pa]", "shear_traction [Pa]", "displacement_x [m]")
        expected, states = columns(folder, "grid_static", *names)
        for ranks in (1, 2, 3):
            folder.run(0, "contact_dynamics", "mesh.prm", "--output", "mesh_static", ranks=ranks)
            found, others = columns(folder, "mesh_static", *names)
            assert states[:-1] == others and len(others) == 24
            for one, other in zip(expected, found):
                assert np.abs(one[:-1] - other).max() <= 1e-7 * np.abs(one).max() + 1e-18, (ranks, one, other)
            for key in ("normal_force", "tangential_force"):
                one, other = folder.summary("grid_static")[key], folder.summary("mesh_static")[key]
                assert abs(one - other) <= 1e-7 * abs(folder.summary("grid_static")["normal_force"]), (key, one, other)


def check_shifted_statics(folder):
    """Phases that are shifted across the sides shift the equilibrium and leave the frequencies as they are."""
    solid = SOLID_BODY + prm({"Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, **PERIODIC, "Mesh/Periodic in y": "front, back"})
    folder.write("static.prm", solid + prm({**LOADS, "Supports/Top/Held": "u_x, u_y", "Flat/Velocity": "1, -2"}))
    folder.write("rest.prm", solid + prm({**LOADS, "Supports/Top/Held": "", "Flat/Velocity": 0, "Body/Acceleration": "1e3, 2e3, -1e4"}))
    folder.write("modal.prm", solid + prm({"Analysis": "modal", "Modal/Number of modes": 6, "Supports/Top/Kind": "pressure", "Modal/Tolerance": 1e-12}))
    fields, frequencies = {"static": [], "rest": []}, []
    for shift, ranks in ((0, 1), (0, 3), (2, 2)):
        shifted_box(shift).write(folder("mesh.msh"))
        for name, found in fields.items():
            folder.run(0, "contact_dynamics", name + ".prm", "--output", name, ranks=ranks)
            found.append(np.roll(displacement(folder, name), (shift, shift), (1, 2)))
            assert len(columns(folder, name, "pressure [Pa]")[1]) == CELLS[0] * CELLS[1]
        folder.run(0, "contact_dynamics", "modal.prm", "--output", "modal", ranks=ranks)
        assert folder.summary("modal")["rigid_motions"] == {"free": 3, "held": 2}, folder.summary("modal")["rigid_motions"]
        with h5py.File(folder("modal", "modal.h5")) as file:
            frequencies.append(np.concatenate([file["modes"][bottom]["frequency"][()] for bottom in ("free", "held")]))
    for found in fields.values():
        spread = np.ptp(found[0][1, :, :, 2])
        assert spread > 0.01 * np.abs(found[0][..., 2]).max(), spread
        for other in found[1:]:
            assert np.abs(other - found[0]).max() < 1e-6 * spread, np.abs(other - found[0]).max() / spread
    for other in frequencies[1:]:
        assert np.abs(other / frequencies[0] - 1).max() < 1e-9, other / frequencies[0] - 1


def check_resumed(folder):
    half = ("--set=Checkpoints/Keep=true", "--set=Time/End time=2e-5")
    folder.run(0, "contact_dynamics", "solid.prm", "--output", "half", *half, ranks=2)
    folder.run(0, "contact_dynamics", "solid.prm", "--output", "half", "--resume", ranks=2)
    assert np.array_equal(displacement(folder, "half"), displacement(folder, "solid22"))


def check_refused(folder):
    def refused(words, *settings, prm_file="solid.prm"):
        said = folder.run(2, "contact_dynamics", prm_file, "--output", "none", *("--set=" + setting for setting in settings))
        assert all(word in said for word in words), said

    refused(["Mesh/Periodic in x", "1 groups", "name two"], "Mesh/Periodic in x=left")
    refused(["Mesh/Periodic in x", "'side' is no physical group"], "Mesh/Periodic in x=left, side")
    refused(["Mesh/Periodic in x", "second group lie between -0.003"], "Mesh/Periodic in x=right, left")
    refused(["both ends of x", "20 and 35 points"], "Mesh/Periodic in x=left, Top")
    bent = box_with_sides([0.5 * n for n in CELLS], CELLS, lambda x: "core" if x[0] > 1 else "body")
    right = bent.points[:, 0] == bent.points[:, 0].max()
    bent.points[right, 0] += 0.05 * bent.points[right, 2]
    bent.write(folder("mesh.msh"))
    refused(["Mesh/Periodic in x", "lie between 0.003 and 0.003075 m"])
    bent.points[right, 0] -= 0.05 * bent.points[right, 2]
    bent.points[right & (bent.points[:, 2] == 0.5), 2] += 0.1
    bent.write(folder("mesh.msh"))
    refused(["both ends of x", "not opposite", " m apart"])


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_grid_as_mesh(folder)
        check_seam(folder)
        check_modes_of_grid(folder)
        check_static_of_grid(folder)
        check_shifted_statics(folder)
        check_shifted(folder)
        check_resumed(folder)
        check_refused(folder)
    print("periodic sides of meshes: as on the grid, shifted with the phases, on several ranks, and continued")


if __name__ == "__main__":
    main()
