"""How large a volume must be: the random checkerboard, whose fraction has the variance p (1 - p) a / V, and runs on pieces of voxels and with
further seeds."""

import csv
import os
import subprocess
import sys
import tempfile

import numpy as np

from scenes import PROGRAMS, TOOLS, Folder, prm

sys.path.insert(0, TOOLS)
import volume_size  # noqa: E402

SEED = 456
PHASES = {"Phases/Names": "matrix, hard", "Phases/matrix/Young modulus": 3e9, "Phases/hard/Young modulus": 60e9,
          "Homogenization/Boundary conditions": "PBC", "Homogenization/Tolerance": 1e-8}
VOXELS = {**PHASES, "Grid/Cells": "16, 16, 1", "Grid/Spacing": "1e-3, 1e-3, 1e-3", "Microstructure/Type": "voxels", "Microstructure/File": "cells.npy",
          "Microstructure/Image values": "0, 1"}
FIBRES = {**PHASES, "Grid/Cells": "40, 20", "Grid/Size": "4e-3, 2e-3", "Microstructure/Type": "random fibres", "Microstructure/Random fibres/Seed": 5,
          "Microstructure/Random fibres/Fibre width": 1e-4, "Microstructure/Random fibres/Minimum height": 4e-4,
          "Microstructure/Random fibres/Maximum height": 8e-4, "Microstructure/Random fibres/Area fraction": 0.1}


def keys_of(cells):
    return {"Mesh/File": "", "Dimension": "3", "Grid/Cells": cells, "Grid/Spacing": "1e-3, 1e-3, 1e-3", "Microstructure/Type": "voxels",
            "Microstructure/Coarsening": "1", "Microstructure/Crop from": "", "Microstructure/Image values": "0, 1", "Microstructure/Crop size": ""}


def check_checkerboard():
    """Of many volumes without solving anything: the statistics of their fractions."""
    rng, share, n = np.random.default_rng(SEED), 0.3, 4000
    volume = volume_size.Volume(keys_of("32, 32, 1"))
    runs = {}
    for factor in (0.25, 0.5, 1.0):
        cells = np.prod(volume.in_cells(factor))
        fractions = rng.binomial(cells, share, n) / cells
        runs[factor] = [{"dim": 3, "phases": [{"name": "a", "volume_fraction": 1 - f}, {"name": "b", "volume_fraction": f}], "engineering_constants": {}}
                        for f in fractions]
    rows = volume_size.evaluate(volume, runs, 0.02)
    for row in rows:
        found = row["integral_range"] / 1e-9  # over the volume of a cell
        expected = (2 / 0.02) ** 2 * (1 - share) / share * 1e-9 / row["volume"]
        print(f"size {row['size']}: integral range of {found:.3f} cells, {row['needed']} volumes, {expected:.1f} expected")
        assert abs(found - 1) < 5 * np.sqrt(2 / n) and abs(row["needed"] / expected - 1) < 0.15, row
    exponent = volume_size.slope(rows)
    print(f"variance falls with the power {exponent:.3f} of the volume")
    assert abs(exponent + 1) < 0.03
    needed = [row["needed"] for row in rows]
    assert needed[0] > 3.5 * needed[1] > 12 * needed[2] > 0  # edges twice as long: a quarter of the volumes


def run(folder, name, *words, status=0):
    done = subprocess.run([sys.executable, os.path.join(TOOLS, "volume_size.py"), folder(name + ".prm"), "--programs", PROGRAMS, "--output", folder(name),
                           "--jobs", "2", *words], capture_output=True, text=True, check=False)
    assert done.returncode == status, (done.stdout, done.stderr)
    return done.stdout if status == 0 else done.stderr


def table(folder, name):
    with open(folder(name, "volume_size.csv"), encoding="utf-8") as file:
        return {(row["property"], float(row["size"])): row for row in csv.DictReader(file)}


def check_pieces(folder):
    cells = np.random.default_rng(SEED).choice(2, size=(1, 16, 16), p=[0.6, 0.4]).astype(np.uint8)
    np.save(folder("cells.npy"), cells)
    folder.write("pieces.prm", "set Dimension = 3\n" + prm(VOXELS))
    said = run(folder, "pieces", "--sizes", "0.5,0.25", "--members", "4,16", "--error", "0.05")
    rows = table(folder, "pieces")
    for size, edge, n in ((0.25, 4, 16), (0.5, 8, 4)):
        means = cells[0].reshape(16 // edge, edge, 16 // edge, edge).mean(axis=(1, 3)).ravel()
        row = rows["fraction of hard", size]
        assert int(row["members"]) == n and len(means) == n
        for key, expected in (("mean", means.mean()), ("deviation", means.std(ddof=1)), ("volume", edge**2 * 1e-9),
                              ("integral_range", means.var(ddof=1) * edge**2 * 1e-9 / (means.mean() * (1 - means.mean())))):
            assert abs(float(row[key]) / expected - 1) < 1e-9, (key, row, expected)
        stiffness = [folder.summary(f"pieces/size{size:g}-{m + 1}")["engineering_constants"]["E_x"] for m in range(n)]
        assert abs(float(rows["E_x", size]["mean"]) / np.mean(stiffness) - 1) < 1e-9 and np.std(stiffness) > 0
        assert int(rows["E_x", size]["needed"]) == np.ceil((2 * np.std(stiffness, ddof=1) / (0.05 * np.mean(stiffness))) ** 2)
    assert "E_x (Pa): variance falls" in said and os.path.getsize(folder("pieces", "volume_size.png")) > 10000
    run(folder, "pieces", "--sizes", "0.5", "--members", "1", "--set", "Homogenization/Boundary conditions=KUBC", "--set", "Homogenization/Effective=KUBC")
    assert table(folder, "pieces")["E_x", 0.5]["needed"] == "" and "NaN" not in folder.read("pieces", "volume_size.json").decode()
    assert "larger than the voxels" in run(folder, "pieces", "--sizes", "2", status=1)
    assert "one each" in run(folder, "pieces", "--sizes", "0.5,0.25", "--members", "1,2,3", status=1)


def check_seeds(folder):
    folder.write("fibres.prm", prm(FIBRES))
    run(folder, "fibres", "--sizes", "0.5,1", "--members", "3", "--set", "Homogenization/Tolerance=1e-6")
    rows = table(folder, "fibres")
    assert abs(float(rows["E_x", 0.5]["volume"]) / 2e-6 - 1) < 1e-9 and int(rows["E_x", 1.0]["members"]) == 3
    digests = {str(folder.summary(f"fibres/size{size}-{m}")["stiffness"]["effective"]) for size in ("0.5", "1") for m in (1, 2, 3)}
    assert len(digests) == 6, "all morphologies differ"
    folder.write("one.prm", prm({**PHASES, "Grid/Cells": "4, 4", "Grid/Size": "1e-3, 1e-3", "Microstructure/Type": "homogeneous"}))
    assert "its sizes and members can be varied for" in run(folder, "one", status=1)


def main():
    check_checkerboard()
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_pieces(folder)
        check_seeds(folder)


if __name__ == "__main__":
    main()
