"""Maps: map.h5 of a run with section Sweep."""

import re

import numpy as np

from .array import Array


class SweepMap:
    """What was found at all points of a map: a mapping from names of numbers in the summaries of the points to arrays of the shape of the
    map, with NaN where a point has no such number. Random points and pairs are in one row."""

    def __init__(self, file):
        self._file = file
        self.shape = tuple(int(n) for n in np.atleast_1d(file.attributes("axes")["shape"]))

    def __iter__(self):
        return iter(self._file.hdf5.get("numbers", ()))

    def __contains__(self, name):
        return name in self._file.hdf5.get("numbers", ())

    def __getitem__(self, name):
        if name in self.texts:
            return np.array(self._file[f"texts/{name}"]).reshape(self.shape)
        found = self._file[f"numbers/{name}"]
        known = self._file.hdf5[f"known/{name}"][...].astype(bool)
        return Array(np.where(known, np.asarray(found), np.nan).reshape(self.shape), found.unit, name)

    @property
    def texts(self):
        """Names of what is told in words, such as the regime."""
        return list(self._file.hdf5.get("texts", ()))

    @property
    def axes(self):
        """{name: Array of the values along the axis of a grid, else of each point}, in the order of the axes."""
        names = sorted(self._file.hdf5["axes"], key=lambda name: self._file.attributes(f"axes/{name}")["number"])
        found = {name: self._file[f"axes/{name}"] for name in names}
        if len(self.shape) < len(names) or len(names) == 1:
            return found
        return {name: Array(np.moveaxis(np.asarray(values).reshape(self.shape), k, 0).reshape(self.shape[k], -1)[:, 0], values.unit, name)
                for k, (name, values) in enumerate(found.items())}

    @property
    def border(self):
        """{name: Array of the values along the axis} of the points where the fastest complex mode neither grows nor decays, and under "along"
        the name of the axis along which each was found; None if the map has no border."""
        if "border" not in self._file.hdf5:
            return None
        return {name: np.array(self._file["border/along"]) if name == "along" else self._file[f"border/{name}"] for name in [*self.axes, "along"]}

    def is_logarithmic(self, name):
        """Whether the values along an axis are equally spaced in their logarithms."""
        return bool(self._file.attributes(f"axes/{name}")["logarithmic"])

    @property
    def status(self):
        """Of each point: "done", "skipped" (not run, as its complex modes decay), "failed" or "not computed"."""
        return np.array(self._file["status"]).reshape(self.shape)

    @property
    def messages(self):
        """Why points failed; empty of others."""
        return np.array(self._file["message"]).reshape(self.shape)

    @property
    def folders(self):
        """Folder of each point, below that of the map; mesoslip.open() opens it."""
        return np.array(self._file["folder"]).reshape(self.shape)

    def __repr__(self):
        axes = ", ".join(f"{name} [{values.unit or '-'}]" for name, values in self.axes.items())
        return f"<SweepMap {self.shape} over {axes}: {', '.join(self)}>"


def settings_of(axes):
    """The keys of section Sweep for {"Section/Key": values} or {name: ("Section/Key", values)}."""
    named = {}
    for name, given in axes.items():
        key, values = given if isinstance(given, tuple) and isinstance(given[0], str) else (name, given)
        named[re.sub(r"\[(\d+)\]$", r"_\1", name.rpartition("/")[2]).lower()] = (key, values)
    if len(named) < len(axes):
        raise ValueError("two axes would have one name; give names: {name: (key, values)}")
    settings = {"Sweep/Axes": list(named)}
    for name, (key, values) in named.items():
        settings |= {f"Sweep/{name}/Key": key, f"Sweep/{name}/Values": [values] if np.ndim(values) == 0 else list(values)}
    return settings
