"""Homogenized friction of boxes and meshes in 3D: fractions of the contact and moduli of nodes counted from the voxels, pressures at rest by
node, the same on a box and on a mesh of it."""

import tempfile

import h5py
import numpy as np

from boxes import BOX, MATERIALS, MESH, prepare
from scenes import Folder, prm, sets

LANDING = {"Supports/Top/Pressure": 1e7, "Supports/Top/Kind": "platen", "Flat/Velocity": 2, "Body/Acceleration": "0, 0, 0", "Time/End time": 6e-5,
           "Observation/Steady from": 1e-5, "Snapshots/Interval": 0}
BODIES = {"box": (BOX, {"Body/Material": "heterogeneous", "Body/RVE file": "rve/rve.h5"}), "mesh": (MESH, {"Mesh/File": "mesh.msh", **MATERIALS})}


def homogenized(folder, name):
    """Summary of the analysis, from a run and a static contact of the body."""
    text, body = BODIES[name]
    folder.write("run.prm", text)
    folder.run(0, "contact_dynamics", "run.prm", "--output", name, *sets(LANDING))
    folder.write("rest.prm", "set Dimension = 3\n" + prm({
        "Analysis": "static contact", **body, "Supports/Top/Pressure": 1e7, "Supports/Top/Kind": "platen", "Flat/Velocity": 2,
        "Friction/Coefficient from": "phases", "Friction/Node rule": "mean"}))
    folder.run(0, "contact_dynamics", "rest.prm", "--output", name + "-rest", ranks=2)
    folder.write("law.prm", prm({"Analysis": "friction homogenization", "Friction homogenization/Heterogeneous run": name,
                                 "Friction homogenization/Static contact": name + "-rest"}))
    folder.run(0, "contact_dynamics", "law.prm", "--output", name + "-law")
    return folder.summary(name + "-law")


def shares_of_fibre(voxels):
    """Of each node of the contact, x fastest: the share of the fibre in the faces around it, and how many faces there are."""
    faces = np.pad(voxels[0].astype(float), 1, constant_values=np.nan)
    around = np.stack([faces[j:faces.shape[0] - 1 + j, i:faces.shape[1] - 1 + i] for j in (0, 1) for i in (0, 1)])
    return np.nanmean(around, axis=0).ravel(), np.isfinite(around).sum(axis=0).ravel()


def check_by_hand(folder, found, name):
    """Eqs (17) and (19) to (21) from the voxels."""
    voxels = np.load(folder("voxels.npy"))
    phases = {phase["name"]: phase for phase in found["contact_phases"]}
    E, mu = (np.array([phases[phase][key] for phase in ("matrix", "fibre")]) for key in ("youngs_modulus", "friction_coefficient"))
    fractions = np.array([1 - voxels[0].mean(), voxels[0].mean()])
    assert np.abs(fractions - [phases[phase]["surface_fraction"] for phase in ("matrix", "fibre")]).max() < 1e-12
    of_volume = np.array([1 - voxels.mean(), voxels.mean()])
    share, area = shares_of_fibre(voxels)
    share = np.array([1 - share, share])
    moduli, of_node = E @ share, mu @ share
    with h5py.File(folder(name + "-rest", "dynamics.h5")) as file:
        group = file["static_contact"]
        place = np.lexsort([np.round(group[axis][()] / 1e-7) for axis in "xy"])
        pressure = group["pressure"][()][place]
    assert pressure.std() > 0.1 * pressure.mean(), "no pressures of nodes"
    expected = {"surface fractions": fractions * E @ mu / (fractions @ E), "volume fractions": of_volume * E @ mu / (of_volume @ E),
                "nodes": area * moduli @ of_node / (area @ moduli), "nodes in static contact": area * pressure @ of_node / (area @ pressure)}
    for estimate in found["estimates"]:
        if estimate["pressures"] in expected:
            assert abs(estimate["mu_homo"] - expected[estimate["pressures"]]) < 1e-9, (name, estimate, expected)
    assert len(found["estimates"]) == len(expected) + 1, found["estimates"]


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        prepare(folder)
        box, mesh = (homogenized(folder, name) for name in BODIES)
        check_by_hand(folder, box, "box")
        check_by_hand(folder, mesh, "mesh")
        for one, other in zip(box["estimates"], mesh["estimates"]):
            assert one["pressures"] == other["pressures"] and abs(one["delta"] - other["delta"]) < 1e-6 * one["delta"], (one, other)


if __name__ == "__main__":
    main()
