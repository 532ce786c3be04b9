"""Stresses of a change of temperature in localization: those of the load of the same temperature in the volume that expands freely, beside those of
the run. In 2D on a grid and a mesh with sigma_zz, in 3D on voxels; probes; on 1 and 2 ranks."""

import re
import sys
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import TOOLS, Folder, prm

sys.path.append(TOOLS)
from report.base.data import Run  # noqa: E402
from report.runs import heat  # noqa: E402

SEED, HEATING = 453, -80
PHASES = {"Phases/Names": "soft, stiff", "Phases/soft/Young modulus": 3e9, "Phases/soft/Poisson ratio": 0.35, "Phases/soft/Density": 1200,
          "Phases/soft/Thermal expansion": 6e-5, "Phases/stiff/Young modulus": 70e9, "Phases/stiff/Poisson ratio": 0.2, "Phases/stiff/Density": 2500,
          "Phases/stiff/Thermal expansion": 5e-6, "Homogenization/Boundary conditions": "KUBC, PBC", "Homogenization/Tolerance": 1e-12,
          "Homogenization/Effective": "PBC", "Loads/Names": "cold", "Loads/cold/Temperature change": HEATING}
CELLS = np.random.default_rng(SEED).choice(2, size=(6, 8))
DEEP = np.random.default_rng(SEED).choice(2, size=(4, 5, 6))
RUN = {"Body/RVE file": "rve/rve.h5", "Time/End time": 2e-5, "Snapshots/Interval": 4e-6, "Snapshots/From": 1e-5, "Flat/Velocity": 1,
       "Supports/Top/Pressure": 5e6, "Observation/Probes": "inner"}


def write(folder, name, settings):
    plain = "".join(f"set {key} = {value}\n" for key, value in settings.items() if "/" not in key)
    folder.write(name + ".prm", plain + prm({key: value for key, value in settings.items() if "/" in key}))


def close(found, expected, tolerance, what):
    error = np.abs(np.subtract(found, expected)).max() / np.abs(expected).max()
    print(f"{what:60s} {error:.1e}")
    assert error <= tolerance, (what, found, expected)


def check(folder, kind, volume, position):
    write(folder, "rve", {**PHASES, **volume})
    folder.run(0, "rve_homogenization", "rve.prm", "--output", "rve", "--quiet")
    check_reported(folder)
    dim = volume.get("Dimension", 2)
    body = {"Mesh/File": volume["Mesh/File"], "Mesh/Scale": 1e-3} if "Mesh/File" in volume else {}
    write(folder, "run", {**({"Dimension": 3} if dim == 3 else {}), **RUN, **body, "Observation/inner/Position": position})
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run", "--quiet")
    for condition in ("KUBC", "PBC"):
        with h5py.File(folder("rve", "loads.h5")) as file:
            load = {key: file[f"loads/cold/{condition}/{key}"][()] for key in ("stress", "von_mises")}
        settings = {"Input/RVE file": "rve/rve.h5", "Input/Homogeneous run": "run", "Localization/Concentration": condition, "Window/From": 1e-5,
                    "Localization/Fields": "mean von Mises, mean stress, deviation of stress", "Probes/Of the run": "inner"}
        fields = {}
        for ranks in (1, 2):
            for name, heating in (("plain", 0), ("heated", HEATING), ("much", 1e6 * HEATING)):
                write(folder, name, {**settings, "Localization/Temperature change": heating})
                folder.run(0, "stress_localization", name + ".prm", "--output", name, "--quiet", ranks=ranks)
                with h5py.File(folder(name, "localization.h5")) as file:
                    fields[name] = {}
                    file.visititems(lambda key, item, name=name: fields[name].update({key: item[()]} if isinstance(item, h5py.Dataset) else {}))
            what = f"{kind}, {condition}, {ranks} ranks: "
            mean, of_mises = (next(key for key in fields["plain"] if key.endswith(end)) for end in ("mean_stress", "mean_von_mises"))
            deviation, probe = (next(key for key in fields["plain"] if key.endswith(end)) for end in ("deviation_stress", "inner/stress"))
            close(fields["heated"][mean] - fields["plain"][mean], load["stress"], 1e-9, what + "mean stress")
            close(fields["heated"][deviation], fields["plain"][deviation], 1e-9, what + "its deviation")
            added = fields["heated"][probe] - fields["plain"][probe]
            close(added, np.broadcast_to(added[0], added.shape), 1e-9, what + "a probe gets one stress")
            distance = np.abs(load["stress"].reshape(-1, added.shape[1]) - added[0]).max(axis=1)
            assert distance.min() < 1e-9 * np.abs(added[0]).max(), "that of its cell"
            # So much heat that the run does not matter.
            close(fields["much"][of_mises], 1e6 * load["von_mises"], 1e-5, what + "von Mises stress with sigma_zz")
    write(folder, "direct", {**settings, "Input/Direct run": "run", "Localization/Temperature change": 10})
    assert "knows no heat" in folder.run(2, "stress_localization", "direct.prm", "--output", "direct")
    cold = {key: value for key, value in {**PHASES, **volume}.items() if "expansion" not in key and "Loads" not in key}
    write(folder, "none", cold)
    folder.run(0, "rve_homogenization", "none.prm", "--output", "none", "--quiet")
    write(folder, "without", {**settings, "Input/RVE file": "none/rve.h5", "Localization/Temperature change": 10})
    assert "Thermal expansion" in folder.run(2, "stress_localization", "without.prm", "--output", "without")


def check_reported(folder):
    """The report has a row for each component, with the effective value last."""
    summary = folder.summary("rve")
    html = heat.heat(None, Run(folder("rve"), summary))
    rows = [[re.sub("<[^>]+>", "", cell) for cell in re.findall("<td.*?</td>", row)] for row in re.findall("<tr>.*?</tr>", html) if "<td" in row]
    effective = np.array(summary["expansion"]["effective"])
    assert len(rows) == len(effective) and list(summary["expansion"])[-1] == "effective", (rows, summary["expansion"])
    found = np.array([float(row[-1].replace("−", "-")) for row in rows])
    close(1e-6 * found, effective, 1e-3, "effective expansion in the report")


def main():
    for kind in ("grid", "mesh", "voxels"):
        with tempfile.TemporaryDirectory() as path:
            folder = Folder(path)
            folder.write("cells.txt", "\n".join(" ".join(map(str, row)) for row in CELLS[::-1]) + "\n")
            np.save(folder("cells.npy"), DEEP.astype(np.uint8))
            box = Box([8.0, 6.0], [8, 6], lambda x: ("soft", "stiff")[CELLS[int(x[1]), int(x[0])]], "simplex")
            box.name_side("Contact", 1, False).name_side("Top", 1, True).write(folder("volume.msh"))
            volumes = {"grid": {"Grid/Cells": "8, 6", "Grid/Size": "8e-3, 6e-3", "Microstructure/Type": "image", "Microstructure/File": "cells.txt"},
                       "mesh": {"Mesh/File": "volume.msh", "Mesh/Scale": 1e-3},
                       "voxels": {"Dimension": 3, "Grid/Cells": "6, 5, 4", "Grid/Spacing": "1e-3, 1e-3, 1e-3", "Microstructure/Type": "voxels",
                                  "Microstructure/File": "cells.npy"}}
            check(folder, kind, volumes[kind], "2.5e-3, 2.5e-3" + (", 1.5e-3" if kind == "voxels" else ""))


if __name__ == "__main__":
    main()
