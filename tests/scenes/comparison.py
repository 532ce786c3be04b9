"""Whether two folders hold the same results: every dataset, attribute, number, text and file, without a list of them.

Nothing is skipped silently: a file of an unknown kind is a difference.
"""

import csv
import json
import os
import re

import h5py
import numpy as np


def content_of_h5(path):
    """{"/group/dataset" or "/group/dataset@attribute": array} of a whole file."""
    content = {}
    with h5py.File(path, "r") as file:
        def visit(name, item):
            name = "/" + name.strip("/")
            if isinstance(item, h5py.Dataset):
                content[name] = item[...]
            for key, value in item.attrs.items():
                content[name + "@" + key] = np.asarray(value)
        visit("/", file["/"])
        file.visititems(visit)
    return content


def content_of_json(text):
    """{"key/key[index]": number or text}; an empty list or object is an entry, too."""
    content = {}

    def visit(name, node):
        if isinstance(node, dict) and node:
            for key, child in node.items():
                visit(f"{name}/{key}" if name else key, child)
        elif isinstance(node, list) and node:
            for k, child in enumerate(node):
                visit(f"{name}[{k}]", child)
        else:
            content[name] = np.asarray(node if isinstance(node, (bool, int, float)) else json.dumps(node))
    visit("", json.loads(text))
    return content


def content_of_csv(path):
    """{"column": values}: numbers where all are, else texts."""
    with open(path, encoding="utf-8", newline="") as file:
        heading, *rows = list(csv.reader(file))
    assert all(len(row) == len(heading) for row in rows), f"{path}: rows of different lengths"
    columns = {name: [row[k] for row in rows] for k, name in enumerate(heading)}
    assert len(columns) == len(heading), f"{path}: two columns of the same name"
    for name, texts in columns.items():
        try:
            columns[name] = np.array([float(text) for text in texts])
        except ValueError:
            columns[name] = np.array(texts)
    return columns


def lines_of(path):
    with open(path, encoding="utf-8") as file:
        return {f"line {k}": np.asarray(line.rstrip("\n")) for k, line in enumerate(file, 1)}


def content(path, skipped_lines):
    """What a file holds, by names; None for a kind of file that is not known."""
    name = os.path.basename(path)
    if name.endswith(".h5"):
        found = content_of_h5(path)
        for key in [key for key, value in found.items() if value.dtype.kind in "OS" and key == "/summary"]:
            text = np.atleast_1d(found.pop(key))[0]
            found.update({f"{key}:{k}": v for k, v in content_of_json(text).items()})
        return found
    if name.endswith(".json"):
        with open(path, encoding="utf-8") as file:
            return content_of_json(file.read())
    if name.endswith(".csv"):
        return content_of_csv(path)
    if name == "log.txt":
        kept = [v for v in lines_of(path).values() if not skipped_lines.search(str(v))]
        return {f"line {k}": v for k, v in enumerate(kept, 1)}
    if name.endswith((".xdmf", ".prm")):
        return lines_of(path)
    return None


class Comparison:
    """How results may differ.

    skipped_files, skipped_values, skipped_lines: regular expressions of names of files, of "file:value" and of lines of
    log.txt that are not compared.
    tolerances: [(regular expression of "file:value", how far values may be apart relative to the largest one of the
    dataset or column, absolute floor)]; the first that fits counts. Without one the values have to be equal bit by bit.
    """

    def __init__(self, skipped_files, skipped_values, skipped_lines, tolerances=()):
        self.skipped_files, self.skipped_values = re.compile(skipped_files), re.compile(skipped_values)
        self.skipped_lines = re.compile(skipped_lines)
        self.tolerances = [(re.compile(name), relative, floor) for name, relative, floor in tolerances]
        self.n_compared = 0

    def differences(self, one, two):
        """Sentences about all that distinguishes the results in two folders."""
        names = {name for folder in (one, two) for name in os.listdir(folder) if not self.skipped_files.fullmatch(name)}
        wrong = []
        for name in sorted(names):
            paths = [os.path.join(folder, name) for folder in (one, two)]
            if not all(os.path.isfile(path) for path in paths):
                wrong.append(f"{name} is in one folder only")
                continue
            contents = [content(path, self.skipped_lines) for path in paths]
            if contents[0] is None:
                wrong.append(f"{name} is not compared: its kind is not known")
            elif not contents[0]:
                wrong.append(f"{name} holds nothing to compare")
            else:
                wrong += self._differences(name, *contents)
        return wrong

    def _differences(self, file, one, two):
        wrong = []
        for key in sorted(one.keys() | two.keys()):
            name = f"{file}:{key}"
            if self.skipped_values.search(name):
                continue
            if key not in one or key not in two:
                wrong.append(f"{name} is in one folder only")
                continue
            self.n_compared += 1
            said = self._difference(name, one[key], two[key])
            if said:
                wrong.append(f"{name}: {said}")
        return wrong

    def _difference(self, name, x, y):
        if x.dtype.kind != y.dtype.kind or x.shape != y.shape:
            return f"{x.dtype} {x.shape} and {y.dtype} {y.shape}"
        if x.dtype.kind != "f":
            return "" if np.array_equal(x, y) else f"{x} and {y}"
        if np.array_equal(x, y, equal_nan=True):
            return ""
        with np.errstate(all="ignore"):
            difference = np.max(np.abs(x - y))
            largest = max(np.max(np.abs(x)), np.max(np.abs(y)))
        relative, floor = next(((r, f) for pattern, r, f in self.tolerances if pattern.search(name)), (0.0, 0.0))
        if difference <= max(relative * largest, floor):  # false for NaN in one of them
            return ""
        return f"{difference:.3g} apart, {difference / largest:.2g} of the largest value"
