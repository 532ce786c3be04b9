"""The data of a figure as CSV: what its curves, areas, histograms and maps show, in the units of their labels. Of what is larger than
MOST_POINTS or MOST_VALUES a part is kept, which a comment in the CSV says."""

import csv
import io

import numpy as np
from matplotlib.collections import PolyCollection, QuadMesh, TriMesh

from report.base.data import thinned

MOST_POINTS, MOST_VALUES = 1500, 4000  # of a curve; of a map


def words_of(text):
    """A label without the marks of mathematics."""
    for mark in ("$", "\\mathrm", "{", "}", "\\"):
        text = text.replace(mark, "")
    return " ".join(text.replace("\n", " ").split())


def curves_of(axes):
    """(name, how many points there are, x, y) of lines and steps."""
    for line in axes.get_lines():
        x, y = (np.asarray(values, dtype=float) for values in line.get_data())
        if len(x) > 1 and line.get_transform() == axes.transData:
            name = line.get_label()
            yield name if not name.startswith("_") else "", len(x), *thinned(x, y, MOST_POINTS)
    for k, patch in enumerate(axes.patches):
        if hasattr(patch, "get_data"):  # of a histogram
            values, edges, _ = patch.get_data()
            yield patch.get_label() or f"histogram {k + 1}", len(values), 0.5 * (edges[1:] + edges[:-1]), values
    areas = [c for c in axes.collections if isinstance(c, PolyCollection) and c.get_array() is None]
    for k, area in enumerate(areas):  # stacked, each by its upper edge
        path = area.get_paths()[0].vertices
        half = len(path) // 2
        yield f"upper edge of area {k + 1}", half, *thinned(path[half:, 0], path[half:, 1], MOST_POINTS)


def coarse(rows, columns):
    """Every n-th of these so that few enough values are left."""
    step = max(1, int(np.ceil(np.sqrt(len(rows) * len(columns) / MOST_VALUES))))
    return rows[min(step // 2, len(rows) - 1)::step], columns[min(step // 2, len(columns) - 1)::step]


def within(axes, x, y):
    """Which places lie in the panel."""
    (left, right), (low, top) = sorted(axes.get_xlim()), sorted(axes.get_ylim())
    return (left <= x) & (x <= right), (low <= y) & (y <= top)


def quantity_of(mappable):
    """What the colours of a map stand for, by its colour bar or the label of its axes."""
    bar = mappable.colorbar
    labels = (bar.ax.get_ylabel(), bar.ax.get_xlabel(), bar.ax.get_title()) if bar else (mappable.axes.get_label(),)
    return words_of(" ".join(label for label in labels if label))


def maps_of(axes):
    """(name, how many values there are, x, y, value) of images, and of polygons by their middles, in the panel. An image of mixed colours
    has the shares that it mixes in an attribute `shares`, {name: [rows][columns]}."""
    for image in axes.get_images():
        for name, values in getattr(image, "shares", {quantity_of(image): np.ma.filled(image.get_array().astype(float), np.nan)}).items():
            left, right, low, top = image.get_extent()
            x = left + (np.arange(values.shape[1]) + 0.5) * (right - left) / values.shape[1]
            y = low + (np.arange(values.shape[0]) + 0.5) * (top - low) / values.shape[0]
            columns, rows = (np.flatnonzero(inside) for inside in within(axes, x, y))
            if len(rows) and len(columns):
                count = len(rows) * len(columns)
                rows, columns = coarse(rows, columns)
                yield name, count, *(grid.ravel() for grid in np.meshgrid(x[columns], y[rows])), values[np.ix_(rows, columns)].ravel()
    for found in axes.collections:
        if isinstance(found, QuadMesh) and found.get_array() is not None:
            middle = found.get_coordinates()
            middle = 0.25 * (middle[1:, 1:] + middle[1:, :-1] + middle[:-1, 1:] + middle[:-1, :-1])
            values = np.reshape(found.get_array(), middle.shape[:2]) if found.get_array().size == middle[..., 0].size else None
            if values is not None:
                picked = np.ix_(*coarse(*map(np.arange, values.shape)))
                yield quantity_of(found), values.size, middle[..., 0][picked].ravel(), middle[..., 1][picked].ravel(), values[picked].ravel()
        elif isinstance(found, TriMesh):
            at = found._triangulation
            yield quantity_of(found), len(at.x), at.x, at.y, np.asarray(found.get_array())
        elif isinstance(found, PolyCollection) and found.get_array() is not None:
            values = np.asarray(found.get_array())
            middles = np.array([path.vertices[:-1].mean(axis=0) for path in found.get_paths()])
            inside = np.flatnonzero(np.logical_and(*within(axes, middles[:, 0], middles[:, 1])))
            picked = inside[::max(1, -(-len(inside) // MOST_VALUES))]
            yield quantity_of(found), len(inside), middles[picked, 0], middles[picked, 1], values[picked]


def label_along(axes, axis):
    """Of x or y; the panels of a figure may have one label for all, or that of the lowest."""
    figure = axes.figure
    label = getattr(axes, f"get_{axis}label")()
    shared = getattr(figure, f"_sup{axis}label", None)
    shared = shared.get_text() if shared else next((getattr(other, f"get_{axis}label")() for other in reversed(figure.axes)
                                                    if not hasattr(other, "_colorbar") and getattr(other, f"get_{axis}label")()), "")
    return words_of(label or shared) or axis


def panel_of(axes):
    title = words_of(axes.get_title("left") or axes.get_title() or axes.get_title("right"))
    return f"{f' ({title})' if title else ''}: x is {label_along(axes, 'x')}, y is {label_along(axes, 'y')}"


def csv_of(figure):
    """Text of the CSV, empty if the figure shows nothing but shapes: lines with # say what the numbers of panels and curves stand for."""
    names, rows = [], io.StringIO()
    writer, number = csv.writer(rows, lineterminator="\n"), 0
    for axes in figure.axes:
        if hasattr(axes, "_colorbar"):
            continue
        number += 1
        shown = [*curves_of(axes), *maps_of(axes)]
        names += [f"# panel {number}{panel_of(axes)}"] * bool(shown)
        for k, (name, count, x, y, *value) in enumerate(shown, 1):
            part = f"; {len(x)} of {count} values, see the results for all" if len(x) < count else ""
            names.append(f"# panel {number}, curve {k}{': ' * bool(name)}{words_of(name)}{part}")
            writer.writerows((number, k, *(f"{entry:.5g}" for entry in entries)) for entries in zip(x, y, *value))
    return "\n".join(names + ["panel,curve,x,y,value", rows.getvalue()]) if names else ""
