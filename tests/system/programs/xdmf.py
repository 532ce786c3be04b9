"""ParaView opens what the programs leave, in the plane and of volumes: times, size of the body, and every value as in the HDF5 files.

Without pvpython (Debian: python3-paraview) the test is skipped (exit status 77).
"""

import os
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy as np

from files import run_chain
from scenes import PHASES, Folder, prm

# File, HDF5 file, {array of ParaView: dataset, rows of it}
SHOWN = [
    ("rve/rve.xdmf", "rve.h5", {"cell:phase": ("/phase/id", ()),
                                "cell:concentration/KUBC_yy_xx": ("/concentration/KUBC", (..., 1, 0))}),
    ("homogeneous/dynamics.xdmf", "dynamics.h5", {"node:displacement": ("/snapshots/displacement", -1)}),
    ("heterogeneous/dynamics.xdmf", "dynamics.h5", {"node:displacement": ("/snapshots/displacement", -1)}),
    ("heterogeneous/dynamics-phases.xdmf", "dynamics.h5", {"cell:phase": ("/material/phase_id", ())}),
    ("modal/modal-phases.xdmf", "modal.h5", {"cell:phase": ("/material/phase_id", ())}),
    ("local/localization.xdmf", "localization.h5", {"cell:mean_von_mises": ("/mean_von_mises", ()),
                                                    "cell:mean_stress_xy": ("/mean_stress", (..., 2)),
                                                    "cell:direct/mean_stress_yy": ("/direct/mean_stress", (..., 1))}),
    ("box/rve.xdmf", "rve.h5", {"cell:phase": ("/phase/id", ()), "cell:concentration/KUBC_yz_zz": ("/concentration/KUBC", (..., 3, 2))}),
    ("box_slides/dynamics.xdmf", "dynamics.h5", {"node:displacement": ("/snapshots/displacement", -1)}),
    ("box_slides/dynamics-phases.xdmf", "dynamics.h5", {"cell:phase": ("/material/phase_id", ())}),
    ("box_local/localization.xdmf", "localization.h5", {"cell:mean_von_mises": ("/mean_von_mises", ()),
                                                        "cell:mean_stress_xz": ("/mean_stress", (..., 4))}),
]


def run_box(path):
    """A chain of voxels in 3D, with other numbers of cells and other spacings along each axis."""
    solid = "set Dimension = 3\n"
    slide = prm({"Body/RVE file": "box/rve.h5", "Time/Time step": 5e-9, "Time/End time": 1e-6, "Supports/Top/Pressure": 5e6, "Flat/Velocity": "1, 0.5",
                 "Snapshots/Interval": 2e-7})
    folder = Folder(path, {
        "box": solid + PHASES + prm({"Grid/Cells": "6, 4, 5", "Grid/Size": "6e-4, 6e-4, 10e-4", "Microstructure/Type": "voxels",
                                     "Microstructure/File": "voxels.npy"}),
        "box_uniform": solid + slide, "box_slides": solid + slide + prm({"Body/Material": "heterogeneous"}),
        "box_local": prm({"Input/RVE file": "box/rve.h5", "Input/Homogeneous run": "box_uniform/dynamics.h5"})})
    np.save(folder("voxels.npy"), np.random.default_rng(3).integers(0, 2, (5, 4, 6), dtype=np.uint8))
    for name, program in (("box", "rve_homogenization"), ("box_uniform", "contact_dynamics"), ("box_slides", "contact_dynamics"),
                          ("box_local", "stress_localization")):
        folder.run(0, program, name + ".prm", "--output", name)


def read_with_paraview(folder, paths):
    pvpython = shutil.which("pvpython")
    if pvpython is None:
        print("skipped: ParaView is not installed")
        sys.exit(77)
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "xdmf_in_paraview.py")
    done = subprocess.run([pvpython, "--force-offscreen-rendering", script, folder, *paths], text=True,
                          env={**os.environ, "QT_QPA_PLATFORM": "offscreen"}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert done.returncode == 0 and "rror" not in done.stdout, done.stdout
    return [np.load(os.path.join(folder, f"{number}.npz")) for number in range(len(paths))]


def check(name, seen, path, shown):
    with h5py.File(path) as file:
        for array, (dataset, rows) in shown.items():
            stored = np.asarray(file[dataset][rows])
            values = seen[array]
            if stored.shape[-1] == 2 and values.ndim == 2:
                assert not values[:, 2].any(), f"{name}: {array} leaves the plane"
                values = values[:, :2]
            assert np.array_equal(values.reshape(stored.shape), stored), f"{name}: {array} is not {dataset}"
        times = file["/snapshots/time"][:] if "/snapshots/time" in file and "phases" not in name else []
        np.testing.assert_allclose(seen["times"], times, rtol=1e-15, err_msg=name)
        if "/grid" in file:
            grid = file["/grid"].attrs
            lower, upper = grid["origin"], grid["origin"] + grid["cells"] * grid["spacing"]
        else:
            lower, upper = file["/mesh/points"][...].min(axis=0), file["/mesh/points"][...].max(axis=0)
        size = np.column_stack([lower, upper]).ravel()
        np.testing.assert_allclose(seen["bounds"][:len(size)], size, rtol=1e-12, err_msg=name)
        if len(size) == 6:
            np.testing.assert_allclose(size, [0, 6e-4, 0, 6e-4, 0, 1e-3], rtol=1e-12, err_msg=name)


def main():
    with tempfile.TemporaryDirectory() as folder:
        run_chain(folder, beside=False)
        run_box(folder)
        paths = [os.path.join(folder, name) for name, _, _ in SHOWN]
        for (name, hdf5, shown), seen in zip(SHOWN, read_with_paraview(folder, paths)):
            check(name, seen, os.path.join(os.path.dirname(os.path.join(folder, name)), hdf5), shown)
    print(f"ParaView reads {len(SHOWN)} files")


if __name__ == "__main__":
    main()
