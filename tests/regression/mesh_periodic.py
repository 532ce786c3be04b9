"""Periodic sides of meshes in contact_dynamics: a periodic grid handed in as a mesh, a solid whose phases are shifted across both
sides, going on from a checkpoint, and what is refused."""

import tempfile

import h5py
import numpy as np

from mesh_dynamics import BODY, COMMON, DENSITY, MESH, OBSERVED, PLANE_PROBES, STATES, STEEL, STIFFNESS, check_equal, check_same_summary, group
from mesh_files import Box
from scenes import Folder, prm

PERIODIC = {"Mesh/Periodic in x": "left, right"}
CELLS = [6, 4, 3]
SOLID = "set Dimension = 3\n" + MESH + prm({
    "Phases/Names": "body, core", **{key: value for key, value in STEEL.items() if key != "Phases/Names"},
    "Phases/core/Young modulus": "70e9", "Phases/core/Poisson ratio": 0.2, "Phases/core/Density": 2700, "Top/Kind": "pressure",
    "Body/Initial velocity": "0.5, 1, -1", "Snapshots/Interval": 1e-5, **PERIODIC, "Mesh/Periodic in y": "front, back"})


def box_with_sides(size, cells, phase, kind="cube"):
    box = Box(size, cells, phase, kind)
    names = [("left", "right"), ("front", "back")][:len(size) - 1] + [("Contact", "Top")]
    for axis, of_axis in enumerate(names):
        for upper, name in enumerate(of_axis):
            box.name_side(name, axis, bool(upper))
    return box


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
        summary = folder.summary(f"mesh{ranks}")
        check_same_summary(folder.summary("grid"), summary, 1e-9, ranks, but=("dofs",))
        assert summary["energy_balance_residual"] < 1e-11, summary
        with h5py.File(folder(f"mesh{ranks}", "dynamics.h5")) as file:
            x, u = file["mesh/points"][...], file["snapshots/displacement"][-1]
            sides = [u[np.abs(x[:, 0] - end) < 1e-9][np.argsort(x[np.abs(x[:, 0] - end) < 1e-9][:, 1])] for end in (0, 0.012)]
            assert len(sides[0]) == 11 and np.array_equal(*sides) and np.abs(sides[0]).max() > 0.1 * np.abs(u).max()


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
    def phase(shift):
        return lambda x: "core" if (int(x[0] / 0.5 + shift) % CELLS[0], int(x[1] / 0.5 + shift) % CELLS[1]) in ((0, 0), (2, 1), (1, 1)) else "body"

    fields = []
    for shift, ranks in ((0, 1), (0, 3), (2, 2)):
        box_with_sides([0.5 * n for n in CELLS], CELLS, phase(shift)).write(folder("mesh.msh"))
        folder.write("solid.prm", SOLID)
        folder.run(0, "contact_dynamics", "solid.prm", "--output", f"solid{shift}{ranks}", ranks=ranks)
        fields.append(np.roll(displacement(folder, f"solid{shift}{ranks}"), (shift, shift), (1, 2)))
    spread = np.ptp(fields[0][1, :, :, 2])  # the lowest nodes are on the flat
    assert spread > 1e-5 * np.abs(fields[0]).max(), spread  # the body as a whole moves far
    for other in fields[1:]:
        assert np.abs(other - fields[0]).max() < 1e-6 * spread, np.abs(other - fields[0]).max() / spread


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
    refused(["Mesh/Periodic in x", "has no effect, as Analysis is 'modal'"], "Analysis=modal")
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
        check_shifted(folder)
        check_resumed(folder)
        check_refused(folder)
    print("periodic sides of meshes: as on the grid, shifted with the phases, on several ranks, and continued")


if __name__ == "__main__":
    main()
