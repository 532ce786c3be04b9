"""The data of a figure as CSV: what its curves, areas, histograms and maps show, in the units of their labels."""

import csv
import io

import numpy as np
from matplotlib.collections import PolyCollection, QuadMesh, TriMesh

from report.base.data import thinned

MOST_POINTS, MOST_VALUES = 500, 2000  # of a curve; of a map


def words_of(text):
    """A label without the marks of mathematics."""
    for mark in ("$", "\\mathrm", "{", "}", "\\"):
        text = text.replace(mark, "")
    return " ".join(text.replace("\n", " ").split())


def curves_of(axes):
    """(name, x, y) of lines and steps."""
    for k, line in enumerate(axes.get_lines()):
        x, y = (np.asarray(values, dtype=float) for values in line.get_data())
        if len(x) > 1 and line.get_transform() == axes.transData:
            name = line.get_label()
            yield name if not name.startswith("_") else f"curve {k + 1}", *thinned(x, y, MOST_POINTS)
    for k, patch in enumerate(axes.patches):
        if hasattr(patch, "get_data"):  # of a histogram
            values, edges, _ = patch.get_data()
            yield patch.get_label() or f"histogram {k + 1}", 0.5 * (edges[1:] + edges[:-1]), values
    areas = [c for c in axes.collections if isinstance(c, PolyCollection) and c.get_array() is None]
    for k, area in enumerate(areas):  # stacked, each by its upper edge
        path = area.get_paths()[0].vertices
        half = len(path) // 2
        yield f"upper edge of area {k + 1}", *thinned(path[half:, 0], path[half:, 1], MOST_POINTS)


def coarse(values):
    """Every n-th row and column so that few enough are left."""
    step = max(1, int(np.ceil(np.sqrt(values.shape[0] * values.shape[1] / MOST_VALUES))))
    return [np.arange(step // 2, n, step) for n in values.shape[:2]]


def maps_of(axes):
    """(name, x, y, value) of images, and of polygons by their middles. An image of mixed colours has the shares that it mixes in an
    attribute `shares`, {name: [rows][columns]}."""
    for image in axes.get_images():
        for name, values in getattr(image, "shares", {"cells": np.ma.filled(image.get_array().astype(float), np.nan)}).items():
            left, right, low, top = image.get_extent()
            rows, columns = coarse(values)
            x = left + (columns + 0.5) * (right - left) / values.shape[1]
            y = low + (rows + 0.5) * (top - low) / values.shape[0]
            yield name, *(grid.ravel() for grid in np.meshgrid(x, y)), values[np.ix_(rows, columns)].ravel()
    for found in axes.collections:
        if isinstance(found, QuadMesh) and found.get_array() is not None:
            middle = found.get_coordinates()
            middle = 0.25 * (middle[1:, 1:] + middle[1:, :-1] + middle[:-1, 1:] + middle[:-1, :-1])
            values = np.reshape(found.get_array(), middle.shape[:2]) if found.get_array().size == middle[..., 0].size else None
            if values is not None:
                picked = np.ix_(*coarse(values))
                yield "cells", middle[..., 0][picked].ravel(), middle[..., 1][picked].ravel(), values[picked].ravel()
        elif isinstance(found, TriMesh):
            at = found._triangulation
            yield "nodes", at.x, at.y, np.asarray(found.get_array())
        elif isinstance(found, PolyCollection) and found.get_array() is not None:
            values = np.asarray(found.get_array())
            step = max(1, len(values) // MOST_VALUES)
            middles = np.array([path.vertices[:-1].mean(axis=0) for path in found.get_paths()[::step]])
            yield "cells", middles[:, 0], middles[:, 1], values[::step]


def panel_of(axes):
    words = [words_of(text) for text in (axes.get_title("left") or axes.get_title() or axes.get_title("right"), axes.get_ylabel()) if text]
    return f" ({', '.join(words)})" if words else ""


def csv_of(figure):
    """Text of the CSV, empty if the figure shows nothing but shapes: lines with # say what the numbers of panels and curves stand for."""
    names, rows = [], io.StringIO()
    writer, number = csv.writer(rows, lineterminator="\n"), 0
    for axes in figure.axes:
        if hasattr(axes, "_colorbar"):
            continue
        number += 1
        for k, (name, x, y, *value) in enumerate([*curves_of(axes), *maps_of(axes)], 1):
            names.append(f"# panel {number}{panel_of(axes)}, curve {k}: {words_of(name)}")
            writer.writerows((number, k, *(f"{entry:.5g}" for entry in entries)) for entries in zip(x, y, *value))
    return "\n".join(names + ["panel,curve,x,y,value", rows.getvalue()]) if names else ""
