"""Folders that runs and chains leave."""

import collections.abc
import json
import os

import numpy as np

from .closing import Closing
from .files import NAMES, FormatError, ResultFile


def open_folder(path):
    """What a path holds: a ResultFile, the Chain of a folder with runs in it, or the RunFolder of a run that leaves no HDF5.

    Raises FileNotFoundError, or FormatError naming what is wrong."""
    path = os.fspath(path)
    if not os.path.exists(path):
        raise FileNotFoundError(f"there is no file or folder {path}")
    if not os.path.isdir(path):
        return ResultFile(path)
    for name in NAMES:
        if os.path.exists(os.path.join(path, name)):
            return ResultFile(os.path.join(path, name))
    if os.path.exists(os.path.join(path, "summary.json")):
        return RunFolder(path)
    if runs_in(path):
        return Chain(path)
    raise FileNotFoundError(f"the folder {path} holds neither a run, one of {', '.join(NAMES)}, nor folders of runs")


def runs_in(folder):
    """Names of the runs below a folder, in the order of names."""
    return [name for name in sorted(os.listdir(folder))
            if any(os.path.exists(os.path.join(folder, name, file)) for file in ("summary.json", *NAMES))]


class RunFolder(Closing):
    """A run without an HDF5 file, such as a homogenization of friction: `summary`, and its tables (CSV)."""

    def __init__(self, path):
        self.path = path
        with open(os.path.join(path, "summary.json"), encoding="utf-8") as file:
            self.summary = json.load(file)
        if self.summary.get("draft"):
            raise FormatError(f"{path} was made with --try from what may be drafts, in which nothing was computed; do the run that makes the result")
        self.tables = [name for name in sorted(os.listdir(path)) if name.endswith(".csv")]

    def table(self, name):
        """{column: array of numbers, or of texts where one is none} of a CSV file; what is not known is NaN."""
        if name not in self.tables:
            raise KeyError(f"{self.path} has no table '{name}'; there is: {', '.join(self.tables)}")
        with open(os.path.join(self.path, name), encoding="utf-8") as file:
            rows = [line.rstrip("\n").split(",") for line in file]
        return {column: _numbers([row[k] for row in rows[1:]]) for k, column in enumerate(rows[0])}

    def close(self):
        """Nothing is open; so that it can be used as a ResultFile."""

    def __repr__(self):
        return f"<RunFolder {self.path}: summary with {', '.join(self.summary)}; tables {', '.join(self.tables) or 'none'}>"


def _numbers(texts):
    try:
        return np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        return np.array(texts)


class Chain(Closing, collections.abc.Mapping):
    """The results of a chain: a mapping from the names of its runs to what open() gives, opened when asked for and then kept.

    A part of a name does when it is that of one run: chain["rve"], chain["localization"]."""

    def __init__(self, path):
        self.path = os.fspath(path)
        self._open = {}

    def __iter__(self):
        return iter(runs_in(self.path))

    def __len__(self):
        return len(runs_in(self.path))

    def __getitem__(self, name):
        names = runs_in(self.path)
        found = [name] if name in names else [n for n in names if name in n]
        if len(found) != 1:
            raise KeyError(f"{self.path} has {'no run' if not found else 'several runs'} '{name}'; there is: {', '.join(found or names)}")
        if found[0] not in self._open:
            self._open[found[0]] = open_folder(os.path.join(self.path, found[0]))
        return self._open[found[0]]

    @property
    def summaries(self):
        """{name of the run: its summary.json}; of one that did not end {}."""
        return {name: self[name].summary for name in self}

    def close(self):
        for results in self._open.values():
            results.close()
        self._open.clear()

    def __repr__(self):
        return f"<Chain {self.path}: {', '.join(self)}>"
