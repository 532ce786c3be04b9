"""Voxels as input of FANS and DAMASK: the files hold the volume, in their orders and notations; periodic boundary conditions of the exported FANS volume
were compared with FANS itself (doc/composites.md)."""

import base64
import json
import os
import re
import subprocess
import sys
import tempfile

import h5py
import numpy as np

from scenes import TOOLS, Folder, prm

CELLS = np.random.default_rng(458).choice(2, size=(4, 3, 5)).astype(np.uint8)
BASE = {"Grid/Cells": "5, 3, 4", "Grid/Spacing": "1e-3, 1.2e-3, 0.8e-3", "Microstructure/Type": "voxels", "Microstructure/File": "cells.npy",
        "Phases/Names": "matrix, wood", "Phases/matrix/Young modulus": 3e9, "Phases/wood/Young modulus": 9e9,
        "Homogenization/Boundary conditions": "PBC", "Homogenization/Tolerance": 1e-4}
WOOD = {"Phases/wood/Type": "orthotropic", "Phases/wood/Young moduli": "60e9, 15e9, 25e9", "Phases/wood/Poisson ratios": "0.25, 0.2, 0.15",
        "Phases/wood/Shear moduli": "8e9, 6e9, 5e9"}


def export(folder, volume, to, status=0):
    done = subprocess.run([sys.executable, os.path.join(TOOLS, "export_volume.py"), folder(volume), "--to", to, "--output", folder(f"{volume}-{to}")],
                          capture_output=True, text=True, check=False)
    assert done.returncode == status, done
    return done.stdout + done.stderr


def volume(folder, name, more):
    settings = {key: value for key, value in {**BASE, **more}.items() if not (more and key == "Phases/wood/Young modulus")}
    folder.write(name + ".prm", "set Dimension = 3\n" + prm(settings))
    folder.run(0, "rve_homogenization", name + ".prm", "--output", name)


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        np.save(folder("cells.npy"), CELLS)
        angles = np.zeros((*CELLS.shape, 3))
        angles[..., 2] = 90.0 * CELLS  # wood turned by a quarter: axes 1 and 2 change places
        np.save(folder("angles.npy"), angles)
        volume(folder, "plain", {})
        volume(folder, "wood", WOOD)
        volume(folder, "grains", {**WOOD, "Microstructure/Orientation file": "angles.npy"})
        for name in ("plain", "wood", "grains"):
            export(folder, name, "fans")
            given = json.loads(folder.read(f"{name}-fans", "fans.json"))
            with h5py.File(folder(f"{name}-fans", "volume.h5")) as file, h5py.File(folder(name, "rve.h5")) as rve:
                phases = CELLS if name != "grains" else rve["orientation/phase"][()][file["material"][()]]
                assert np.array_equal(phases, CELLS) and file["material"].attrs["permute_order"] == "zyx"
                material = int(file["material"][()][CELLS == 1][0])
                D = rve["phase/stiffness"][1]
            constants = given["materials"][0]["material_properties"]
            assert given["microstructure"]["L"] == [5 * 1e-3, 3 * 1.2e-3, 4 * 0.8e-3] and given["FE_type"] == "HEX8"
            C = {key: values[material] for key, values in constants.items()}
            if name == "grains":  # a quarter turn about z
                D = D[np.ix_([1, 0, 2, 4, 3, 5], [1, 0, 2, 4, 3, 5])]
            # Mandel's notation, xx, yy, zz, xy, xz, yz.
            expected = {"C_11": D[0, 0], "C_12": D[0, 1], "C_13": D[0, 2], "C_22": D[1, 1], "C_33": D[2, 2], "C_44": 2 * D[5, 5], "C_55": 2 * D[4, 4],
                        "C_66": 2 * D[3, 3], "C_14": 0}
            for key, value in expected.items():
                assert abs(C[key] - value) < 1e-9 * D[0, 0], (name, key, C[key], value)
        export(folder, "plain", "damask")
        text = folder.read("plain-damask", "grid.vti").decode()
        raw = base64.b64decode(re.search(r"<DataArray[^>]*>\n(.*)\n</DataArray>", text)[1])
        assert np.array_equal(np.frombuffer(raw[8:], "<i4").reshape(CELLS.shape), CELLS) and int.from_bytes(raw[:8], "little") == 4 * CELLS.size
        assert 'WholeExtent="0 5 0 3 0 4"' in text and 'Spacing="0.001 0.0012 0.0008"' in text
        material = folder.read("plain-damask", "material.yaml").decode()
        assert re.search(r"  \"wood\":\n    lattice: cI\n.*\n.*\n      elastic: \{type: Hooke, C_11: 1\.0", material), material
        assert "is not cubic" in export(folder, "wood", "damask", status=1)
        folder.write("plane.prm", prm({"Grid/Cells": "4, 4", "Grid/Size": "1e-3, 1e-3", "Microstructure/Type": "homogeneous", "Phases/Names": "one",
                                       "Phases/one/Young modulus": 1e9}))
        folder.run(0, "rve_homogenization", "plane.prm", "--output", "plane")
        assert "is no volume of voxels" in export(folder, "plane", "fans", status=1)


if __name__ == "__main__":
    main()
