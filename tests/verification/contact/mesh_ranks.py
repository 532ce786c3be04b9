"""Homogenization, contact runs, statics and modes of one distorted mesh in 3D on 1, 2, 4 and 8 ranks: every number that they leave in HDF5."""

import os
import tempfile

import numpy as np

from comparison import content_of_h5
from mesh_files import Box
from scenes import Folder, prm

RANKS, LIMIT = (2, 4, 8), 1e-9
BODY = "set Dimension = 3\n" + prm({
    "Mesh/File": "body.msh", "Mesh/Scale": 0.001, "Phases/Names": "resin, fibre", "Phases/resin/Young modulus": "3.5e9",
    "Phases/resin/Poisson ratio": 0.35, "Phases/resin/Density": 1200, "Phases/fibre/Young modulus": "70e9",
    "Phases/fibre/Poisson ratio": 0.22, "Phases/fibre/Density": 2500})
# What tells of solvers, and what is left of an energy balance that closes.
SKIPPED = ("/summary", "residual", "iterations")

PROGRAMS = {
    "volume": ("rve_homogenization", {"Homogenization/Boundary conditions": "KUBC, SUBC, PBC", "Homogenization/Tolerance": 1e-11}),
    "contact": ("contact_dynamics", {
        "Flat/Velocity": 2, "Flat/Gap": 1e-7, "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 5e6, "Friction/Coefficient": 0.4,
        "Body/Initial velocity": "0.5, 1, -1", "Time/Rayleigh beta": 1e-8, "Time/End time": 6e-5, "Snapshots/Interval": 1e-5,
        "Observation/History interval": 1, "Observation/Energy interval": 1}),
    "statics": ("contact_dynamics", {
        "Analysis": "static contact", "Flat/Velocity": 2, "Supports/Top/Pressure": 5e6, "Friction/Coefficient": 0.4, "Static contact/Tolerance": 1e-11}),
    "modes": ("contact_dynamics", {"Analysis": "modal", "Modal/Number of modes": 3, "Modal/Tolerance": 1e-11, "Modal/Bottom": "held in z", "Supports/Top/Kind": "platen"})}


def distorted():
    """A brick of hexahedra whose inner points are moved; no two edges are alike, so that no frequency is double."""
    box = Box([6, 5, 4], [6, 5, 4], lambda x: "fibre" if (x[0] - 3) ** 2 + (x[2] - 1.7) ** 2 < 2 else "resin")
    inside = np.all((box.points > 0) & (box.points < [6, 5, 4]), axis=1)
    box.points[inside] += np.random.default_rng(7).uniform(-0.2, 0.2, (inside.sum(), 3))
    return box.name_side("Contact", 2, False).name_side("Top", 2, True)


def numbers(folder, run):
    """Names and arrays of floating point numbers; modes with the sign that makes their largest value positive."""
    found = {}
    for name in sorted(os.listdir(folder(run))):
        if name.endswith(".h5"):
            for key, values in content_of_h5(folder(run, name)).items():
                if values.dtype.kind == "f" and values.size and not any(word in key for word in SKIPPED):
                    if key.endswith("/shape"):
                        flat = values.reshape(len(values), -1)
                        values = flat * np.sign(np.take_along_axis(flat, np.abs(flat).argmax(axis=1)[:, None], axis=1))
                    found[f"{name}:{key}"] = values
    return found


def check(folder, name):
    program, settings = PROGRAMS[name]
    folder.write(name + ".prm", BODY + prm(settings))
    folder.run(0, program, name + ".prm", "--output", name + "1")
    one = numbers(folder, name + "1")
    assert len(one) >= 7, one.keys()
    for ranks in RANKS:
        folder.run(0, program, name + ".prm", "--output", f"{name}{ranks}", ranks=ranks)
        assert folder.summary(f"{name}{ranks}")["ranks"] == ranks
        other, worst = numbers(folder, f"{name}{ranks}"), (0.0, "")
        assert one.keys() == other.keys(), one.keys() ^ other.keys()
        for key, values in one.items():
            assert values.shape == other[key].shape and np.all(np.isfinite(values)), key
            scale, difference = np.abs(values).max(), np.abs(values - other[key]).max()
            assert difference <= LIMIT * scale, (name, ranks, key, difference, scale)
            worst = max(worst, (difference / scale if scale > 0 else 0.0, key))
        print(f"{name} on {ranks} ranks: {len(one)} arrays, the largest difference {worst[0]:.1e} in {worst[1]}")
        if name == "contact":
            summary = folder.summary(f"{name}{ranks}")
            assert summary["energy_balance_residual"] < 1e-11 and summary["slip_fraction"] > 0.05, summary


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        distorted().write(folder("body.msh"))
        for name in PROGRAMS:
            check(folder, name)


if __name__ == "__main__":
    main()
