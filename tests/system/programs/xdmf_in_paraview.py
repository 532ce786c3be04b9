"""For pvpython: what ParaView's XDMF Reader makes of each file, as <folder>/<number>.npz.

    xdmf_in_paraview.py <folder> <file.xdmf>...
"""

import os
import sys

import numpy as np
from paraview import servermanager
from paraview.simple import XDMFReader
from vtkmodules.util.numpy_support import vtk_to_numpy


def arrays(data, kind):
    return {f"{kind}:{data.GetArrayName(k)}": vtk_to_numpy(data.GetArray(k)).copy() for k in range(data.GetNumberOfArrays())}


def read(path):
    """Times, bounds, and all arrays at the last time."""
    reader = XDMFReader(FileNames=[path])
    reader.UpdatePipelineInformation()
    times = np.atleast_1d(np.array(reader.TimestepValues, dtype=float))
    reader.UpdatePipeline(times[-1] if times.size else 0.0)
    data = servermanager.Fetch(reader)
    return {"times": times, "bounds": np.array(data.GetBounds()),
            **arrays(data.GetPointData(), "node"), **arrays(data.GetCellData(), "cell")}


for number, name in enumerate(sys.argv[2:]):
    np.savez(os.path.join(sys.argv[1], f"{number}.npz"), **read(name))
