"""Opens the result files of mesoslip as numpy arrays with units.

    import mesoslip
    with mesoslip.open("results/30-contact_dynamics-heterogeneous") as run:
        t = run["history/time"]                  # Array, t.unit == "s"
        mu = run.history["apparent_friction"]
        x, y = run.grid.nodes()                  # m; on a mesh run.mesh.points, run.mesh.cells
        for time, u in run.snapshots():          # one at a time: files may exceed the memory
            ...
        run.summary["main_frequency"]            # summary.json beside the file

What the files hold is described in doc/file_formats.md. SI units; rows from the bottom, the last axis along x.
"""

from .array import Array
from .files import FormatError, Grid, Mesh, ResultFile, open  # noqa: A004  (mesoslip.open, as h5py.File)

__all__ = ["Array", "FormatError", "Grid", "Mesh", "ResultFile", "open"]
