"""The first steps of contact_dynamics: loads that act at once move all kinds of bodies to second order in the time step from the first step on,
on one rank and on two. A body that falls has g t^2 / 2 after every step."""

import tempfile

import numpy as np

from mesh_dynamics import group, probes
from mesh_files import Box
from scenes import Folder, prm

STEP, STEPS = 4e-8, 32  # s; the largest step
PHASE = {"Young modulus": 30e9, "Poisson ratio": 0.2, "Density": 1800}
COMMON = {"Flat/Gap": 1e-3, "Flat/Velocity": 0, "Time/End time": STEP * STEPS, "Observation/History interval": 1,
          "Observation/Probe interval": 1, "Observation/Energy interval": 1, "Body/Acceleration": "3e5, -2e5",
          "Time/Rayleigh beta": 0}  # damping acts half a step late
TOPS = {"platen": {"Supports/Top/Kind": "platen", "Supports/Top/Platen mass": 2e-3, "Supports/Top/Pressure": 5e6}, "pressure": {"Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 5e6},
        "none": {"Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 0}}
SPACE = {"Body/Acceleration": "3e5, 1e5, -2e5"}
BODIES = {  # dimension, keys
    "grid": (2, {"Body/Size": "6e-3, 4e-3", "Body/Cells": "6, 4", "Body/Stiffness": "33.3e9, 8.3e9, 33.3e9, 12.5e9", "Body/Density": 1800}),
    "box": (3, {"Body/Size": "4e-3, 2e-3, 3e-3", "Body/Cells": "4, 2, 3", "Body/Density": 1800, **SPACE,
                "Body/Stiffness": "33.3e9, 8.3e9, 8.3e9, 33.3e9, 8.3e9, 33.3e9, 12.5e9, 12.5e9, 12.5e9"}),
    "triangles": (2, {"Mesh/File": "plane.msh"}), "tetrahedra": (3, {"Mesh/File": "solid.msh", **SPACE})}


def history(folder, body, top, refined, ranks):
    """Displacements of top and probe at the times of the largest step, from time 0 on."""
    dim, keys = BODIES[body]
    phases = {"Phases/Names": "matrix", **{f"Phases/matrix/{key}": value for key, value in PHASE.items()}} if "Mesh/File" in keys else {}
    position = ", ".join(("0.0013", "0.0011", "0.0017")[:dim])
    folder.write("run.prm", f"set Dimension = {dim}\n" + prm({**COMMON, **phases, **TOPS[top], **keys, "Time/Time step": STEP / refined})
                 + probes(inside=position))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run", ranks=ranks)
    assert folder.summary("run")["energy_balance_residual"] < 1e-12
    probe = {key: value for key, value in group(folder, "run", "probes").items() if "displacement" in key}
    return [group(folder, "run")["top_displacement"][::refined], *(value.T[-1 if value.ndim > 1 else ...][..., ::refined] for value in probe.values())]


def check_order(folder, body, top, ranks):
    runs = [history(folder, body, top, refined, ranks) for refined in (1, 2, 4)]
    for k, (one, two, four) in enumerate(zip(*runs)):
        fall = np.abs(two - one).max() / max(np.abs(four - two).max(), 1e-300)
        print(f"{body}, {top}, {ranks} ranks, series {k}: errors fall by {fall:.2f}")
        assert np.abs(two - one).max() < 1e-12 * np.abs(four).max() or fall > 3.5, (body, top, k)


def check_fall(folder, body, ranks):
    top = history(folder, body, "none", 1, ranks)[0]
    fallen = -2e5 / 2 * (STEP * np.arange(len(top))) ** 2
    error = np.abs(top - fallen).max() / np.abs(fallen).max()
    print(f"{body}, {ranks} ranks: fall off by {error:.1e}")
    assert error < 1e-12, (body, error)


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        for name, size, n in (("plane", (6e-3, 4e-3), (6, 4)), ("solid", (4e-3, 2e-3, 3e-3), (4, 2, 3))):
            mesh = Box(size, n, lambda x: "matrix", "simplex")
            mesh.name_side("Contact", len(n) - 1, False)
            mesh.name_side("Top", len(n) - 1, True)
            mesh.write(folder(name + ".msh"))
        for body in BODIES:
            for ranks in (1, 2):
                check_fall(folder, body, ranks)
                for top in ("platen", "pressure"):
                    check_order(folder, body, top, ranks)


if __name__ == "__main__":
    main()
