"""The same solid as a plane grid, a box of bricks, and meshes in 2D and 3D, 4 mm high, whose sides are held along their normals."""

import h5py
import numpy as np

from mesh_files import Box
from scenes import prm

MATERIAL = {"Type": "stiffness", "Density": 1770}
PLANE, SOLID = "36.54e9, 9.1e9, 47.26e9, 13.785e9", "36.54e9, 9e9, 9.1e9, 36.54e9, 9.1e9, 47.26e9, 13.785e9, 13.785e9, 12e9"


def bodies(folder):
    """Name, first line, and keys of each kind of body, of which the sides are held along their normals."""
    yield "grid", "", {"Body/Stiffness": PLANE, "Body/Density": 1770, "Body/Size": "0.006, 0.004", "Body/Cells": "12, 9", "Supports/Left/Held": "u_x",
                       "Supports/Right/Held": "u_x"}
    yield "box", "set Dimension = 3\n", {"Body/Stiffness": SOLID, "Body/Density": 1770, "Body/Size": "0.003, 0.002, 0.004", "Body/Cells":
                                         "5, 4, 8", "Supports/Left/Held": "u_x", "Supports/Right/Held": "u_x", "Supports/Front/Held": "u_y", "Supports/Back/Held": "u_y"}
    for dim, kind, size, cells in ((2, "simplex", [6, 4], [9, 8]), (3, "cube", [3, 2, 4], [5, 4, 6])):
        name = f"mesh{dim}"
        box = Box(size, cells, lambda x: "body", kind)
        for side, axis, upper in [("Contact", dim - 1, False), ("Top", dim - 1, True), ("Left", 0, False), ("Right", 0, True),
                                  ("Front", 1, False), ("Back", 1, True)][:2 * dim]:
            box.name_side(side, axis, upper)
        box.write(folder(name + ".msh"))
        held = {"Supports/Left/Held": "u_x", "Supports/Right/Held": "u_x", **({"Supports/Front/Held": "u_y", "Supports/Back/Held": "u_y"} if dim == 3 else {})}
        yield name, f"set Dimension = {dim}\n", {"Mesh/File": name + ".msh", "Mesh/Scale": 0.001, "Phases/Names": "body",
                                                 "Phases/body/Stiffness": SOLID if dim == 3 else PLANE,
                                                 **{f"Phases/body/{key}": value for key, value in MATERIAL.items()}, **held}


def bricks(folder):
    """Keys of the mesh of the bricks of the box in bodies(), whose nodes and faces are found in another way; nothing holds it."""
    box = Box([3, 2, 4], [5, 4, 8], lambda x: "body", "cube")
    for side, axis, upper in [("Contact", 2, False), ("Top", 2, True), ("Left", 0, False), ("Right", 0, True), ("Front", 1, False), ("Back", 1, True)]:
        box.name_side(side, axis, upper)
    box.write(folder("bricks.msh"))
    return {"Mesh/File": "bricks.msh", "Mesh/Scale": 0.001, "Phases/Names": "body", "Phases/body/Type": "stiffness", "Phases/body/Density": 1770,
            "Phases/body/Stiffness": SOLID}


def check_alike(folder, *scenes):
    """Runs of two scenes in 3D, each of its keys, are the same but for round-off."""
    found = []
    for number, keys in enumerate(scenes):
        folder.write("alike.prm", "set Dimension = 3\n" + prm({**keys, "Time/Time step": 5e-8}))
        folder.run(0, "contact_dynamics", "alike.prm", "--output", f"alike{number}")
        found.append(histories(folder, f"alike{number}"))
    for key, values in found[0].items():
        size = max(np.abs(values).max(), np.abs(found[0]["energy/elastic"]).max() if "energy" in key else 0)
        assert np.abs(values - found[1][key]).max() <= 1e-10 * size, (key, np.abs(values - found[1][key]).max() / size)


def histories(folder, run):
    with h5py.File(folder(run, "dynamics.h5")) as file:
        return {f"{group}/{name}": values[()] for group in ("history", "energy") for name, values in file[group].items()}


def check_ranks_and_restart(folder, what):
    """Of the run in run1: the same on 2 and 3 ranks, and continued from the middle bit for bit. Returns its histories."""
    one = histories(folder, "run1")
    scale = np.abs(one["energy/elastic"]).max()
    for ranks in (2, 3):
        folder.run(0, "contact_dynamics", "run.prm", "--output", "run", ranks=ranks)
        for key, values in histories(folder, "run").items():
            size = max(np.abs(one[key]).max(), scale if "energy" in key else 0)
            assert np.abs(values - one[key]).max() <= 1e-9 * size, (what, ranks, key, np.abs(values - one[key]).max(), size)
    folder.run(0, "contact_dynamics", "run.prm", "--output", "half", "--set", "Time/End time=1e-5")
    folder.run(0, "contact_dynamics", "run.prm", "--output", "half", "--resume")
    for key, values in histories(folder, "half").items():
        assert np.array_equal(values, one[key]), (what, key)
    return one


def refuses(folder, words, *settings):
    """Whether run.prm with these --set is refused in a sentence with these words."""
    found = folder.run(2, "contact_dynamics", "run.prm", "--validate", *[arg for text in settings for arg in ("--set", text)])
    assert words in found, (words, found)
    return True
