"""A pin, a box and a mesh slide for 1000 steps each: the numbers of their summaries and the end of their histories are those that are
stored. They are no truths, other tests have those; a change of them has to be meant.

    stored_runs.py <folder with the programs> [--update]
"""

import os
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import Folder, prm
from stored import check_stored

STORED = os.path.splitext(os.path.abspath(__file__))[0] + ".json"

COMMON = {"Flat/Velocity": 2, "Friction/Regularization time": 1e-6, "Observation/Energy interval": 1, "Observation/History interval": 10}
BODY = {"Body/Stiffness": "36.54e9, 9.1e9, 47.26e9, 13.785e9", "Body/Density": 1770}
STEEL = {"Phases/Names": "matrix, fibre", "Phases/matrix/Young modulus": "70e9", "Phases/matrix/Poisson ratio": 0.33, "Phases/matrix/Density": 2700,
         "Phases/fibre/Young modulus": "210e9", "Phases/fibre/Poisson ratio": 0.3, "Phases/fibre/Density": 7800}
SCENES = {
    "pin": prm({**COMMON, **BODY, "Body/Cells": "70, 20", "Body/Size": "0.0563, 0.0161", "Body/Initial velocity": "0.5, -0.2", "Supports/Top/Kind": "platen",
                "Supports/Top/Pressure": 5e5, "Friction/Coefficient": 0.25, "Time/Rayleigh beta": 4.4e-9, "Time/Time step": 1e-7, "Time/End time": 1e-4}),
    "box": "set Dimension = 3\n" + prm({**COMMON, "Body/Stiffness": "280e9, 120e9, 120e9, 280e9, 120e9, 280e9, 80e9, 80e9, 80e9", "Body/Density": 7800,
                                        "Body/Cells": "12, 8, 6", "Body/Size": "0.006, 0.004, 0.003", "Body/Initial velocity": "0.5, 1, -1",
                                        "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 5e7, "Friction/Coefficient": 0.4, "Time/Time step": 4e-8,
                                        "Time/End time": 4e-5}),
    "mesh": prm({**COMMON, **STEEL, "Mesh/File": "mesh.msh", "Supports/Left/Held": "u_x", "Flat/Gap": 1e-7, "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 5e6,
                 "Friction/Coefficient": 0.4, "Time/Time step": 4e-8, "Time/End time": 4e-5}),
}
KEYS = ("steps", "critical_time_step", "friction_energy", "slip_fraction", "stick_fraction", "separation_fraction", "global_interface_friction_coefficient",
        "largest_strain", "mean_apparent_friction_coefficient", "reference_node")
SERIES = ("contact_normal_force", "contact_tangential_force", "top_normal_force", "top_tangential_force", "slipping_nodes", "sticking_nodes", "separated_nodes",
          "friction_energy", "impact_energy")
SAMPLES = 5  # of each series, evenly until its end


def found_by(folder, name):
    """What the run says, as JSON has it."""
    summary = folder.summary(name)
    assert summary["steps"] == 1000, summary["steps"]
    numbers = {key: list(summary[key].values()) if isinstance(summary[key], dict) else summary[key] for key in KEYS}
    with h5py.File(folder(name, "dynamics.h5")) as file:
        for key in SERIES:
            values = file["history"][key][()]
            numbers["history/" + key] = values[np.linspace(0, len(values) - 1, SAMPLES).astype(int)].tolist()
    return numbers


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, SCENES)
        mesh = Box([0.012, 0.004], [24, 10], lambda x: "fibre" if (x[0] > 0.004) == (x[1] > 0.002) else "matrix", "simplex")
        for side, place in {"Left": (0, False), "Right": (0, True), "Contact": (1, False), "Top": (1, True)}.items():
            mesh.name_side(side, *place)
        mesh.write(folder("mesh.msh"))
        found = {}
        for name in SCENES:
            folder.run(0, "contact_dynamics", name + ".prm", "--output", name)
            found[name] = found_by(folder, name)
    check_stored(STORED, found, 1e-8)  # other compilers round otherwise, and contact multiplies it


if __name__ == "__main__":
    main()
