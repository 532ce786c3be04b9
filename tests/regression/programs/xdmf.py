"""ParaView opens what the programs leave: times, size of the body, and every value as in the HDF5 files.

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
]


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
        grid = file["/grid"].attrs
        lower = grid["origin"]
        size = np.column_stack([lower, lower + grid["cells"] * grid["spacing"]]).ravel()
        np.testing.assert_allclose(seen["bounds"][:4], size, rtol=1e-12, err_msg=name)


def main():
    with tempfile.TemporaryDirectory() as folder:
        run_chain(folder)
        paths = [os.path.join(folder, name) for name, _, _ in SHOWN]
        for (name, hdf5, shown), seen in zip(SHOWN, read_with_paraview(folder, paths)):
            check(name, seen, os.path.join(os.path.dirname(os.path.join(folder, name)), hdf5), shown)
    print(f"ParaView reads {len(SHOWN)} files")


if __name__ == "__main__":
    main()
