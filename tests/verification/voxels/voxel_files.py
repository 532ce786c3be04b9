"""Kinds of files of voxels, cropping, coarsening and thresholds, against NumPy.

A random array is written as .npy (both orders of axes and bytes, whole and floating point numbers), .raw, HDF5, PNG and TIFF stacks, and
every one has to give the phases of the .npy in rve.h5. Cells of several voxels are compared with a majority written apart, ties included.
Both also on several ranks, of which each reads its planes, and of which some may have none.
What does not fit is refused with exit status 2 before anything is computed.
"""

import os
import re
import tempfile

import h5py
import numpy as np
from PIL import Image

from scenes import Folder, prm

SEED = 4711
NAMES = ("soft", "middle", "stiff")


def settings_of(cells, names=NAMES, **more):
    """A box of cells (nx, ny, nz)."""
    settings = {"Dimension": 3, "Phases/Names": ", ".join(names), "Homogenization/Boundary conditions": "KUBC", "Homogenization/Tolerance": 0.5,
                "Homogenization/Effective": "KUBC", "Homogenization/Write concentration": "false", "Homogenization/Reuse": "false",
                "Grid/Cells": ", ".join(map(str, cells)), "Grid/Spacing": 1e-3, "Microstructure/Type": "voxels"}
    for k, name in enumerate(names):
        settings[f"Phases/{name}/Young modulus"] = 10e9 * (k + 1)
    return settings | {f"Microstructure/{key}": value for key, value in more.items()}


def phases(folder, cells, ranks=1, **more):
    """Phases [z][y][x] of rve.h5 and what the program says."""
    folder.write("rve.prm", prm(settings_of(cells, **more)))
    said = folder.run(0, "rve_homogenization", "rve.prm", "--output", "rve", ranks=ranks)
    with h5py.File(folder("rve", "rve.h5")) as file:
        return file["phase/id"][...], said


def write_stack(folder, name, array, end):
    os.makedirs(folder(name), exist_ok=True)
    for z, plane in enumerate(array):
        Image.fromarray(plane).save(folder(name, f"slice_{z:03d}.{end}"))


def check_kinds(folder):
    """No two extents are equal, and with its bytes turned round 1 is more than 256."""
    random = np.random.default_rng(SEED)
    expected = random.integers(0, 3, (9, 5, 7))
    expected[0, 0, 0:3] = 0, 1, 2
    for values, raw in (((0, 1, 2), np.uint8), ((3, 258, 512), np.uint16), ((-5, 1, 256), np.int32)):
        array = np.array(values)[expected].astype(raw)
        kinds = {"c.npy": {}, "fortran.npy": {}, "big.npy": {}, "bits.npy": {}, "plain.raw": {"Raw shape": "7, 5, 9", "Raw type": np.dtype(raw).name},
                 "big.RAW": {"Raw shape": "7, 5, 9", "Raw type": np.dtype(raw).name, "Raw byte order": "big"},
                 "file.h5": {"Dataset": "some/voxels"}}
        np.save(folder("c.npy"), array)
        np.save(folder("fortran.npy"), np.asfortranarray(array))
        np.save(folder("big.npy"), array.astype(np.dtype(raw).newbyteorder(">")))
        np.save(folder("bits.npy"), array.astype(np.int64))
        array.tofile(folder("plain.raw"))
        array.astype(np.dtype(raw).newbyteorder(">")).tofile(folder("big.RAW"))
        with h5py.File(folder("file.h5"), "w") as file:
            file.create_dataset("some/voxels", data=array, chunks=(2, 5, 7), compression="gzip")
        for name in ("file.dream3d", "file.mat", "file.nc"):
            with h5py.File(folder(name), "w") as file:
                file["FeatureIds"] = array[..., None]
            kinds[name] = {"Dataset": "FeatureIds"}
        np.save(folder("fourth.npy"), array[..., None])
        kinds["fourth.npy"] = {}
        write_stack(folder, "tiffs", array, "tif")
        images = [Image.fromarray(plane) for plane in array]
        images[0].save(folder("pages.tiff"), save_all=True, append_images=images[1:], compression="tiff_lzw")
        kinds |= {"tiffs": {}, "tiffs/slice_*.tif": {}, "pages.tiff": {}}
        if values[0] >= 0:
            write_stack(folder, "pngs", array, "png")
            kinds |= {"pngs": {}, "pngs/slice_00?.png": {}}
        for name, more in kinds.items():
            for ranks in (1, 4) if raw == np.uint16 else (1,):
                found, said = phases(folder, (7, 5, 9), ranks, File=name, **more)
                assert (found == expected).all() and found.dtype == np.uint8, f"{name} of {raw} on {ranks} ranks gives other phases: {said}"
                assert "Corners: (x- y- z-) soft, (x+ y- z-) " + NAMES[expected[0, 0, 6]] in said, said
                assert "(x+ y+ z+) " + NAMES[expected[-1, -1, -1]] in said and places(said) == places_of(expected), said
                print(f"{name:20s} {np.dtype(raw).name:8s} the same phases on {ranks} ranks")


def places(said):
    """Shares of the last phase (%) in slices across each axis."""
    return [[float(share) for share in re.findall(r"([\d.e-]+) %", line)] for line in said.splitlines() if line.startswith("Slices across")]


def places_of(phases):
    slices = []
    for axis, n in ((2, phases.shape[2]), (1, phases.shape[1]), (0, phases.shape[0])):
        last = np.moveaxis(phases == 2, axis, 0)
        slices.append([float(f"{100 * last[np.arange(n) * 4 // n == s].mean():.4g}") for s in range(4)])
    return slices


def check_thresholds(folder):
    random = np.random.default_rng(SEED)
    grey = random.normal(size=(4, 5, 6))
    grey[0, 0, 0] = 0.25  # a value on a threshold is of the upper phase
    expected = np.digitize(grey, (-0.5, 0.25))
    assert expected[0, 0, 0] == 2
    np.save(folder("grey.npy"), grey)
    np.save(folder("single.npy"), np.asfortranarray(grey.astype(np.float32)))
    grey.astype(">f4").tofile(folder("grey.raw"))
    with h5py.File(folder("grey.h5"), "w") as file:
        file["grey"] = grey
    write_stack(folder, "grey", grey.astype(np.float32), "tif")
    for name, more in (("grey.npy", {}), ("single.npy", {}), ("grey.h5", {"Dataset": "/grey"}), ("grey", {}),
                       ("grey.raw", {"Raw shape": "6, 5, 4", "Raw type": "float32", "Raw byte order": "big"})):
        found, _ = phases(folder, (6, 5, 4), File=name, Thresholds="-0.5, 0.25", **more)
        assert (found == expected).all(), name
    np.save(folder("bytes.npy"), (100 * grey).astype(np.int16))
    found, _ = phases(folder, (6, 5, 4), File="bytes.npy", Thresholds="-50, 25")
    assert (found == np.digitize((100 * grey).astype(np.int16), (-50, 25))).all()


def majority(array, n):
    """Cells of n x n x n voxels; ties go to the phase furthest below its share so far, then to the first."""
    shape = [extent // n for extent in array.shape]
    cells, missing = np.zeros(shape, int), np.zeros(3, int)
    ties = 0
    for at in np.ndindex(*shape):
        block = array[tuple(slice(n * a, n * (a + 1)) for a in at)]
        counts = np.bincount(block.ravel(), minlength=3)
        missing += counts
        best = np.flatnonzero(counts == counts.max())
        ties += len(best) > 1
        cells[at] = max(best, key=lambda p: (missing[p], -p))
        missing[cells[at]] -= n**3
    return cells, ties


def check_coarsening(folder):
    array = np.random.default_rng(SEED).integers(0, 3, (12, 18, 24))
    np.save(folder("fine.npy"), array)
    for n in (2, 3, 6):
        expected, ties = majority(array, n)
        for ranks in (1, 2, 3, 5):  # 12 / 6 planes are too few for three
            found, said = phases(folder, expected.shape[::-1], ranks, File="fine.npy", Coarsening=n)
            assert (found == expected).all() and f"{n} x {n} x {n} per cell" in said, (ranks, said)
        print(f"cells of {n}^3 voxels, {ties} ties of {expected.size}")
        assert ties > 0 or n > 2
    inner = array[1:11, 4:14, 9:17]
    found, said = phases(folder, (4, 5, 5), **{"File": "fine.npy", "Coarsening": 2, "Crop from": "9, 4, 1", "Crop size": "8, 10, 10"})
    assert (found == majority(inner, 2)[0]).all() and "8 x 10 x 10 of them from (9, 4, 1) on" in said, said
    found, _ = phases(folder, (15, 14, 11), **{"File": "fine.npy", "Crop from": "9, 4, 1"})
    assert (found == array[1:, 4:, 9:]).all()
    sparse = np.zeros((4, 4, 4), int)
    sparse[::2, ::2, ::2] = 1
    np.save(folder("sparse.npy"), sparse)
    folder.write("rve.prm", prm(settings_of((2, 2, 2), ("soft", "stiff"), File="sparse.npy", Coarsening=2)))
    said = folder.run(0, "rve_homogenization", "rve.prm", "--validate")
    assert "phase 'stiff' is 12.5 % of the voxels and 0 % of the cells" in said, said


def elsewhere(folder, array):
    """Datasets whose numbers lie in other files: one is not there, the other one a byte too short."""
    layout = h5py.VirtualLayout(array.shape, array.dtype)
    for z, name in enumerate(("part.h5", "gone.h5")):
        with h5py.File(folder(name), "w") as file:
            file["part"] = array[2 * z:2 * z + 2]
        layout[2 * z:2 * z + 2] = h5py.VirtualSource(name, "part", (2, *array.shape[1:]))
    with h5py.File(folder("virtual.h5"), "w") as file:
        file.create_virtual_dataset("voxels", layout)
    os.remove(folder("gone.h5"))
    with h5py.File(folder("external.h5"), "w") as file:
        file.create_dataset("voxels", array.shape, array.dtype, external=[(folder("numbers.bin"), 0, array.nbytes)])
    array.ravel()[:-1].tofile(folder("numbers.bin"))


def check_refusals(folder):
    good = np.zeros((4, 3, 2), np.uint8)
    good[1], good[2:] = 1, 2
    np.save(folder("good.npy"), good)
    np.save(folder("float.npy"), good.astype(np.float32))
    np.save(folder("nan.npy"), np.where(good == 2, np.nan, good))
    good.tofile(folder("good.raw"))
    with h5py.File(folder("good.h5"), "w") as file:
        file["voxels"], file["plane"], file["float"], file["texts"] = good, good[0], good / 2, np.full(good.shape, b"a")
        file.create_dataset("lzf", data=good, compression="lzf")
    for name, end in (("pngs", "png"), ("tiffs", "tif"), ("sizes", "png"), ("mixed", "png"), ("order", "png"), ("damaged", "tif")):
        write_stack(folder, name, good, end)
    Image.fromarray(good[0].T).save(folder("sizes", "slice_002.png"))
    Image.fromarray(good[0]).save(folder("mixed", "slice_009.tif"))
    os.rename(folder("order", "slice_000.png"), folder("order", "slice_10.png"))
    os.rename(folder("order", "slice_001.png"), folder("order", "slice_9.png"))
    with open(folder("damaged", "slice_001.tif"), "r+b") as file:
        file.truncate(20)
    Image.fromarray(np.zeros((3, 2, 3), np.uint8)).save(folder("colour.tif"))
    for name in ("depths", "gap"):
        write_stack(folder, name, good, "png")
    Image.fromarray(good[1].astype(np.uint16)).save(folder("depths", "slice_001.png"))
    os.remove(folder("gap", "slice_001.png"))
    elsewhere(folder, good)
    for name, more in (("turned", {"tiffinfo": {274: 3}}), ("blurred", {"compression": "jpeg"})):
        Image.fromarray(good[0]).save(folder(name + ".tif"), **more)
    os.makedirs(folder("empty"), exist_ok=True)
    for name in ("x.vti", "text.npy"):
        folder.write(name, "<VTKFile/>")
    h5, raw = {"File": "good.h5"}, {"File": "good.raw"}
    for more, words in (
            ({"File": "missing.npy"}, ["missing.npy", "no file"]),
            ({"File": "text.npy"}, ["no array of NumPy"]),
            ({"File": "x.vti"}, ["numpy.save"]),
            ({"File": "float.npy"}, ["'<f4'", "whole numbers", "Thresholds"]),
            ({"File": "nan.npy", "Thresholds": "0.5, 1.5"}, ["[2][0][0]", "nan"]),
            ({"File": "good.npy", "Thresholds": "1"}, ["Thresholds", "3 phases"]),
            ({"File": "good.npy", "Thresholds": "1, 1"}, ["Thresholds", "ascending"]),
            ({"File": "good.npy", "Thresholds": "1, 2", "Image values": "0, 1, 2"}, ["Image values", "Thresholds"]),
            ({"File": "good.npy", "Image values": "0, 1, 3"}, ["[2][0][0]", "value 2"]),
            ({"File": "good.npy", "Crop size": "2, 3, 5"}, ["Crop size", "along z"]),
            ({"File": "good.npy", "Crop from": "2, 0, 0"}, ["Crop from", "along x"]),
            ({"File": "good.npy", "Crop from": "1, 0, 0"}, ["set Grid/Cells = 1, 3, 4"]),
            ({"File": "good.npy", "Crop size": "1, 1"}, ["Crop size", "give three"]),
            ({"File": "good.npy", "Coarsening": 2}, ["Coarsening", "set Crop size = 2, 2, 4"]),
            ({"File": "good.npy", "Coarsening": 5}, ["Coarsening", "reduce it"]),
            ({"File": "good.npy", "Dataset": "voxels"}, ["Dataset", "no effect"]),
            ({"File": "good.npy", "Raw type": "int8"}, ["Raw type", "no effect"]),
            (raw, ["Raw shape is empty"]),
            (raw | {"Raw shape": "2, 3, 5"}, ["24 bytes", "30"]),
            (raw | {"Raw shape": "2, 3, 4", "Raw type": "uint16"}, ["24 bytes", "48"]),
            (raw | {"Raw shape": "2, 3, 4", "Raw type": "half"}, ["Raw type", "uint8"]),
            (raw | {"Raw shape": "4, 3, 2"}, ["Grid/Cells", "mend Microstructure/Raw shape", "set Grid/Cells = 4, 3, 2"]),
            ({"File": "virtual.h5", "Dataset": "voxels"}, ["virtual.h5", "the file gone.h5, which is not there"]),
            ({"File": "external.h5", "Dataset": "voxels"}, ["numbers.bin", "has 23 of the 24 bytes"]),
            ({"File": "depths"}, ["slice_001.png has grey levels of 16 bits", "slice_000.png has 8 bits"]),
            ({"File": "gap"}, ["slice_001.png is missing between slice_000.png and slice_002.png"]),
            (h5, ["Dataset is empty"]),
            (h5 | {"Dataset": "nowhere"}, ["nowhere"]),
            (h5 | {"Dataset": "lzf"}, ["the filter 'lzf' (number 32000)", "gzip"]),
            (h5 | {"Dataset": "plane"}, ["[3][2]", "three axes"]),
            (h5 | {"Dataset": "float"}, ["'float'", "Thresholds"]),
            (h5 | {"Dataset": "texts"}, ["texts", "numbers"]),
            ({"File": "empty"}, ["holds no pictures"]),
            ({"File": "nothing_*.png"}, ["matches no file"]),
            ({"File": "sizes"}, ["slice_002.png", "3 x 2 pixels"]),
            ({"File": "mixed"}, ["slice_009.tif", "another kind"]),
            ({"File": "order"}, ["slice_10.png comes before slice_9.png"]),
            ({"File": "damaged"}, ["slice_001.tif"]),
            ({"File": "turned.tif"}, ["turned.tif", "Orientation is 3", "with Orientation 1"]),
            ({"File": "blurred.tif"}, ["blurred.tif", "JPEG", "without loss"]),
            ({"File": "colour.tif"}, ["3 numbers of 8 bits"])):
        folder.write("bad.prm", prm(settings_of((2, 3, 4), **more)))
        said = folder.run(2, "rve_homogenization", "bad.prm", "--output", "bad", "--quiet")
        print(said, end="")
        assert all(word in said for word in words) and not os.path.exists(folder("bad", "rve.h5")), f"{words} not in: {said}"
        assert said.count("\n") == 1, said
    for more, words in (({"Image values": "0, 1, 3"}, "[2][0][0] has the value 2"), ({"Image values": "0, 1, 3", "Coarsening": 1}, "[2][0][0] has"),
                        ({"Image values": "0, 5, 2"}, "[1][0][0] has the value 1")):
        folder.write("bad.prm", prm(settings_of((2, 3, 4), File="good.npy", **more)))
        for ranks in (2, 4):
            status, _, said = folder.end("rve_homogenization", "bad.prm", "--output", "bad", "--quiet", ranks=ranks)
            assert status == 2 and words in said and said.count("rve_homogenization: ") == 1, said
    np.save(folder("double.npy"), np.repeat(np.repeat(np.repeat(good, 2, 0), 2, 1), 2, 2))
    folder.write("bad.prm", prm(settings_of((2, 3, 4), **{"File": "double.npy", "Coarsening": 2, "Image values": "0, 5, 2"})))
    for ranks in (1, 3):  # a rank that waits for the majorities of the one that fails
        status, _, said = folder.end("rve_homogenization", "bad.prm", "--output", "bad", "--quiet", ranks=ranks)
        assert status == 2 and "[2][0][0] has the value 1" in said and said.count("rve_homogenization: ") == 1, said
    large = np.lib.format.open_memmap(folder("large.npy"), mode="w+", dtype=np.uint8, shape=(1200, 1200, 1200))  # no blocks on the disk
    del large
    folder.write("bad.prm", prm(settings_of((1200, 1200, 1200), File="large.npy")))
    said = folder.run(2, "rve_homogenization", "bad.prm", "--output", "bad", "--quiet")
    assert "of memory" in said and "would fit" in said, said
    print(said)


def main():
    print("seed", SEED)
    with tempfile.TemporaryDirectory() as path:
        for check in (check_refusals, check_kinds, check_thresholds, check_coarsening):
            check(Folder(path))


main()
