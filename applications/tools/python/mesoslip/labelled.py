"""Results as arrays of xarray, with named axes and coordinates, where that package is installed."""

import numpy as np

COMPONENTS = {3: ["xx", "yy", "xy"], 6: ["xx", "yy", "zz", "yz", "xz", "xy"]}


def to_xarray(file, name):
    """The DataArray of a dataset, or the Dataset of all arrays of a group, with their units in attrs["units"].

    Axes: `time` of what lies beside a dataset time, `z`, `y`, `x` (m) of the cells or nodes of a grid, `component` of stresses and strains,
    `axis` of vectors; others have no coordinates. Raises ImportError without xarray, KeyError without such an object."""
    try:
        import xarray
    except ImportError as error:
        raise ImportError("xarray is not installed: apt install python3-xarray, or pip install xarray") from error
    if name in file and hasattr(file.hdf5[name], "shape"):
        return _array(xarray, file, name)
    group = {key: values for key, values in file.group(name).items() if isinstance(values, np.ndarray)}
    return xarray.Dataset({key: _array(xarray, file, f"{name}/{key}") for key in group if key != "time"})


def _array(xarray, file, name):
    values = file[name]
    plain, unit = np.asarray(values), getattr(values, "unit", "")  # texts have none
    dims, coordinates = _axes(file, name, plain.shape)
    array = xarray.DataArray(plain, dims=dims, coords=coordinates, name=name.rpartition("/")[2], attrs={"units": unit})
    for dim in array.coords:
        if dim in ("x", "y", "z", "time"):
            array.coords[dim].attrs["units"] = "s" if dim == "time" else "m"
    return array


def _axes(file, name, shape):
    """Names of the axes and {name: coordinates}."""
    group, dims, coordinates = name.rpartition("/")[0], [], {}
    time = f"{group}/time"
    if group and time in file and shape and file.hdf5[time].shape == shape[:1]:
        dims, coordinates = ["time"], {"time": np.asarray(file[time])}
    rest = shape[len(dims):]
    if "grid" in file:
        for places in (file.grid.centres(), file.grid.nodes()):
            if rest[: len(places)] == tuple(len(p) for p in places[::-1]):
                dims += ["z", "y", "x"][-len(places):]
                coordinates.update({dim: np.asarray(p) for dim, p in zip("xyz", places)})
                rest = rest[len(places):]
                break
    return dims + _last_axes(name, rest, coordinates), coordinates


def _last_axes(name, rest, coordinates):
    if len(rest) == 1 and ("stress" in name or "strain" in name) and rest[0] in COMPONENTS:
        coordinates["component"] = COMPONENTS[rest[0]]
        return ["component"]
    if len(rest) == 1 and rest[0] in (2, 3):
        coordinates["axis"] = list("xyz")[: rest[0]]
        return ["axis"]
    return [f"axis_{k}" for k in range(len(rest))]
