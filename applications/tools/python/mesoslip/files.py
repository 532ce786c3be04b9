"""The HDF5 files of the three programs."""

import builtins
import collections
import json
import os

import h5py
import numpy as np

from .array import Array
from .closing import Closing
from .derived import Derived
from .labelled import to_xarray
from .maps import SweepMap

NAMES = ("dynamics.h5", "localization.h5", "rve.h5", "modal.h5", "complex_modes.h5", "map.h5")
FORMATS = ("mesoslip-rve", "mesoslip-loads", "mesoslip-dynamics", "mesoslip-localization", "mesoslip-modal", "mesoslip-dynamics-mesh",
           "mesoslip-modal-mesh", "mesoslip-complex-modes", "mesoslip-complex-modes-mesh",
           "mesoslip-map")
VERSIONS = (1, 2)


class FormatError(ValueError):
    """The file is not one of mesoslip's, or of a version that this module does not know."""


class Grid(collections.namedtuple("Grid", "cells spacing origin")):
    """The uniform grid: `cells` (nx, ny), of voxels (nx, ny, nz), `spacing` and `origin` (m)."""

    def __repr__(self):
        """Without the round-off of a length over a number of cells: 5e-05 and not 4.9999999999999996e-05."""
        spacing, origin = (", ".join(f"{length:.12g}" for length in lengths) for lengths in (self.spacing, self.origin))
        return f"Grid(cells={tuple(self.cells)}, spacing=({spacing}) m, origin=({origin}) m)"

    def nodes(self):
        """Coordinates x [nx+1], y [ny+1] and, of voxels, z [nz+1] of the nodes."""
        return tuple(Array(o + h * np.arange(n + 1), "m") for n, h, o in zip(*self))

    def centres(self):
        """Coordinates x [nx], y [ny] and, of voxels, z [nz] of the centres of the cells."""
        return tuple(Array(o + h * (np.arange(n) + 0.5), "m") for n, h, o in zip(*self))


# Kinds of cells in /mesh/topology, by their numbers in XDMF: name and number of corners.
KINDS = {4: ("triangle", 3), 5: ("quadrilateral", 4), 6: ("tetrahedron", 4), 9: ("hexahedron", 8)}


class Mesh(collections.namedtuple("Mesh", "points cells numbers")):
    """A mesh: `points` [n][dim] (m); by kind ("triangle", "quadrilateral", "tetrahedron", "hexahedron") `cells`, the points of their
    corners [m][corners], those of quadrilaterals and hexahedra around their faces, and `numbers` [m], their places in arrays by cell."""

    def centres(self):
        """Mean of the corners of each cell [cells][dim], in the order of arrays by cell."""
        centres = np.empty((sum(len(numbers) for numbers in self.numbers.values()), self.points.shape[1]))
        for kind, corners in self.cells.items():
            centres[self.numbers[kind]] = np.asarray(self.points)[corners].mean(axis=1)
        return Array(centres, "m")


def read_mesh(points, topology):
    """The Mesh of /mesh/points and /mesh/topology."""
    cells, numbers = collections.defaultdict(list), collections.defaultdict(list)
    at = number = 0
    while at < len(topology):
        kind, n_corners = KINDS[int(topology[at])]
        cells[kind].append(topology[at + 1 : at + 1 + n_corners])
        numbers[kind].append(number)
        at, number = at + 1 + n_corners, number + 1
    return Mesh(points, {kind: np.array(c) for kind, c in cells.items()}, {kind: np.array(n) for kind, n in numbers.items()})


class ResultFile(Closing, Derived):
    """A mapping from the names of datasets to arrays, with shortcuts to what is used most, and quantities that follow from them
    (derived.py)."""

    def __init__(self, path):
        self.path = path
        try:
            self.hdf5 = h5py.File(path, "r")
        except OSError as error:
            raise FormatError(f"{path} cannot be read as HDF5: {error}") from error
        try:
            self.format = self._check_format()
        except FormatError:
            self.close()
            raise

    def close(self):
        self.hdf5.close()

    def __repr__(self):
        """Format, path, all datasets with shape and unit, and the keys of the summary."""
        if not self.hdf5:
            return f"<{self.format} {self.path}, closed>"
        lines = [f"  {name}  {list(self.hdf5[name].shape)} {self.unit(name)}".rstrip() for name in self]
        lines += [f"  summary: {', '.join(self.summary)}"] if self.summary else []
        return "\n".join([f"<{self.format} {self.path}", *lines]) + ">"

    def __contains__(self, name):
        return name in self.hdf5

    def __iter__(self):
        """The names of all datasets, without a leading slash."""
        names = []
        self.hdf5.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
        return iter(names)

    def __getitem__(self, name):
        """The whole dataset as an Array. Raises KeyError naming what stands in its group."""
        item = self._item(name, "dataset", h5py.Dataset)
        if h5py.check_string_dtype(item.dtype):
            return [text.decode() for text in item[...].ravel()]
        return Array(item[...], self.unit(name), name)

    def _item(self, name, kind, types):
        """The object of that name. Raises KeyError naming what stands in its group unless it is of one of `types`."""
        item = self.hdf5.get(name)
        if isinstance(item, types):
            return item
        group = item if isinstance(item, h5py.Group) else self.hdf5.get(os.path.dirname(name.rstrip("/")) or "/")
        there = f"there is: {', '.join(group)}" if isinstance(group, h5py.Group) else f"there is no group '{os.path.dirname(name)}' either"
        raise KeyError(f"{self.path} has no {kind} '{name}'; {there}")

    def unit(self, name):
        """Unit of a dataset, "" for pure numbers, without reading it."""
        unit = self._item(name, "dataset", h5py.Dataset).attrs.get("unit", "")
        unit = unit.decode() if isinstance(unit, bytes) else str(unit)
        return "" if unit in ("-", "1") else unit

    def attributes(self, name="/"):
        """Attributes of a group or dataset as a dict."""
        return {key: value.decode() if isinstance(value, bytes) else value for key, value in
                self._item(name, "group or dataset", (h5py.Group, h5py.Dataset)).attrs.items()}

    @property
    def mesh(self):
        """The Mesh of a body or volume on a mesh. Raises KeyError for one on a grid."""
        return read_mesh(self["mesh/points"], np.asarray(self["mesh/topology"]))

    @property
    def grid(self):
        """The Grid of a body or volume on a grid. Raises KeyError for one on a mesh."""
        if "grid" not in self.hdf5:
            raise KeyError(f"{self.path} has no grid; it has a mesh: use .mesh" if "mesh" in self.hdf5 else f"{self.path} has no grid")
        attributes = self.hdf5["grid"].attrs
        return Grid(*(tuple(attributes[key].tolist()) for key in ("cells", "spacing", "origin")))

    @property
    def summary(self):
        """summary.json beside the file; {} for a run that did not end."""
        try:
            with builtins.open(os.path.join(os.path.dirname(self.path), "summary.json"), encoding="utf-8") as file:
                return json.load(file)
        except FileNotFoundError:
            return {}

    def group(self, name):
        """All arrays of a group as {name: Array}, such as group("contact")."""
        return {key: self[f"{name}/{key}"] for key, item in self._item(name, "group", h5py.Group).items()
                if isinstance(item, h5py.Dataset)}

    @property
    def history(self):
        """The histories of a transient run: {name: Array [samples]}."""
        return self.group("history")

    @property
    def probes(self):
        """Probes of a run or a localization: {name: {dataset: Array}}."""
        return {name: self.group(f"probes/{name}") for name in self.hdf5.get("probes", {})}

    @property
    def contact_map(self):
        """The ContactMap of a transient run. Raises KeyError for one without."""
        if "contact_map/time" not in self.hdf5:
            raise KeyError(f"{self.path} has no map of the contact; set 'Contact map/Interval' in the run's .prm")
        return ContactMap(self)

    @property
    def map(self):
        """The SweepMap of a run with section Sweep. Raises KeyError for another run."""
        if "axes" not in self.hdf5:
            raise KeyError(f"{self.path} is no map; set 'Sweep/Axes' in the run's .prm")
        return SweepMap(self)

    @property
    def loads(self):
        """Macroscopic loads of loads.h5: {name: [boundary conditions]}; the fields are in group(f"loads/{name}/{condition}")."""
        return {name: list(conditions) for name, conditions in self.hdf5.get("loads", {}).items()}

    def to_xarray(self, name):
        """A dataset as xarray.DataArray, a group as xarray.Dataset, with named axes, coordinates and units (labelled.py)."""
        return to_xarray(self, name)

    def snapshots(self, step=1):
        """Yields time (s) and displacement (m) of every `step`th snapshot, read one at a time: [ny+1][nx+1][2], in 3D
        [nz+1][ny+1][nx+1][3], on a mesh [points][dim]."""
        if "snapshots/displacement" not in self.hdf5:
            raise KeyError(f"{self.path} has no snapshots; set 'Snapshots/Interval' in the run's .prm")
        data, times = self.hdf5["snapshots/displacement"], self.hdf5["snapshots/time"][...]
        for k in range(0, len(times), step):
            yield float(times[k]), Array(data[k], self.unit("snapshots/displacement"), f"snapshots/displacement[{k}]")

    def _check_format(self):
        found, digest = (self._text_of(name) for name in ("format", "digest"))
        if found not in FORMATS:
            raise FormatError(f"{self.path} is not a file of mesoslip: its attribute 'format' is '{found}'")
        version = int(self.hdf5.attrs.get("format_version", 0))
        if version not in VERSIONS:
            raise FormatError(f"{self.path} has format_version {version}, but this module reads {VERSIONS[0]} to {VERSIONS[-1]}")
        if digest == "draft":
            raise FormatError(f"{self.path} is a draft for --validate, in which nothing was computed; do the run that makes the result")
        return found

    def _text_of(self, attribute):
        found = self.hdf5.attrs.get(attribute, "")
        return found.decode() if isinstance(found, bytes) else str(found)


class ContactMap:
    """What all contact nodes did over time: a mapping from names of fields to arrays [samples][nodes], of vectors in 3D with a last
    axis for x and y. A field is read when it is asked for; `rows()` reads some samples of a long map."""

    def __init__(self, file):
        self._file = file

    def __iter__(self):
        return (name for name in self._file.hdf5["contact_map"] if name != "time")

    def __contains__(self, name):
        return name != "time" and name in self._file.hdf5["contact_map"]

    def __getitem__(self, name):
        return self._file[f"contact_map/{name}"]

    def rows(self, name, rows):
        """Some samples of a field, `rows` being a slice of their numbers."""
        full = f"contact_map/{name}"
        return Array(self._file._item(full, "dataset", h5py.Dataset)[rows], self._file.unit(full), full)

    @property
    def time(self):
        """Times of the samples [samples]."""
        return self["time"]

    @property
    def area(self):
        """Tributary area of each contact node [nodes]; with periodic sides of a grid the last node is the first one
        again, and each has half."""
        return self._file["contact/area"]

    @property
    def position(self):
        """Of each contact node: x [nodes] on a grid, coordinates [nodes][dim] on a mesh."""
        return self._file["contact/position" if "contact/position" in self._file else "contact/x"]

    def __repr__(self):
        fields = ", ".join(f"{name} ({self._file.unit(f'contact_map/{name}') or 'number'})" for name in self)
        return f"<ContactMap of {len(self.time)} samples of {self.area.shape[0]} nodes: {fields}>"
