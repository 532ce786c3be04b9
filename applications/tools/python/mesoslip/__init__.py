"""Runs mesoslip's programs and opens their results as numpy arrays with units.

    import mesoslip
    with mesoslip.open("results/30-contact_dynamics-heterogeneous") as run:
        t = run["history/time"]                  # Array, t.unit == "s"
        mu = run.history["apparent_friction"]
        x, y = run.grid.nodes()                  # m; on a mesh run.mesh.points, run.mesh.cells
        for time, u in run.snapshots():          # one at a time: files may exceed the memory
            ...
        run.summary["main_frequency"]            # summary.json beside the file

    with mesoslip.run("pin.prm", {"Supports/Top/Pressure": 4e5}) as run: ...
    with mesoslip.sweep("pin.prm", {"Supports/Top/Pressure": [1e6, 2e6, 3e6]}) as run:
        run.map["global_interface_friction_coefficient"]
    with mesoslip.run_chain("prm/examples/image") as chain:
        chain["localization"].von_mises("mean_stress", volume=chain["rve"]).to("MPa")

doc/python.md describes it all, doc/file_formats.md what the files hold. SI units; rows from the bottom, the last axis along x.
"""

from . import participation, wear
from .array import Array
from .derived import principal, von_mises
from .files import FormatError, Grid, Mesh, ResultFile
from .folders import Chain, RunFolder
from .folders import open_folder as open  # noqa: A004  (mesoslip.open, as h5py.File)
from .maps import SweepMap
from .programs import RunError, find_program, run, run_chain, sweep

__version__ = "0.2.0"

__all__ = ["Array", "Chain", "FormatError", "Grid", "Mesh", "ResultFile", "RunError", "RunFolder", "SweepMap", "find_program", "open", "participation", "principal",
           "run", "run_chain", "sweep", "von_mises", "wear"]
