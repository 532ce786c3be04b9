"""Stresses in the phases of a counter body: its counter_body.h5 is localized as the dynamics.h5 of a body is. The same file put where its volume was, as that of a body on
the flat, gives the same stresses; the surface that is compared apart is the one at the contact, above."""

import csv
import shutil
import tempfile

import h5py
import numpy as np

from scenes import Folder, prm, rve

DEPTH = 4e-4  # m: four rows


def result(folder, name):
    with h5py.File(folder(name, "localization.h5")) as file:
        fields = {key: file[key][()] for key in ("mean_von_mises", "mean_stress", "direct/mean_von_mises")}
    rows = list(csv.reader(folder.read(name, "field_errors.csv").decode().splitlines()))
    return fields, rows


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"rve": rve("60, 24", "0.006, 0.0024", 2e-4, 6e-4, **{"Microstructure/Random fibres/Cut by border": "true",
                                                                                  "Homogenization/Boundary conditions": "KUBC"})})
        folder.run(0, "rve_homogenization", "rve.prm", "--output", "rve")
        pair = {"Body/Size": "0.006, 0.0024", "Body/Cells": "30, 12", "Body/Stiffness": "2.8e11, 1.2e11, 2.8e11, 0.8e11", "Body/Density": 7800,
                "Counter body/RVE file": "rve/rve.h5", "Time/End time": 3e-5, "Time/Time step": 8e-9, "Snapshots/Interval": 1e-6, "Supports/Top/Kind": "platen",
                "Supports/Top/Pressure": 5e6, "Flat/Velocity": 2}
        for material in ("homogeneous", "heterogeneous"):
            folder.write("run.prm", prm({**pair, "Counter body/Material": material}))
            folder.run(0, "contact_dynamics", "run.prm", "--output", material)
            shutil.copytree(folder(material), folder("upper-" + material))
            with h5py.File(folder("upper-" + material, "counter_body.h5"), "r+") as file:
                file["grid"].attrs["origin"] = [0.0, 0.0]
                del file["run"].attrs["contact_side"]
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
