"""Maps of volumes on meshes and of voxels: phases and von Mises stress, of a plane mesh as it is, of a solid one in three sections through its middle."""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import ListedColormap
from matplotlib.patches import Patch

from data import Missing
from figures import STRESSES, WIDTH, scaled
from maps import DIFFERENCE_MAP, PHASE_COLOURS, STRESS_MAP, phase_names

# Kinds of cells in /mesh/topology: number of corners, edges between them.
CORNERS = {4: 3, 5: 4, 6: 4, 9: 8}
EDGES = {6: [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)],
         9: [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]}
AXES = "xyz"


def cells_of(run):
    """Points [n][dim] (mm), and kind and corners of each cell."""
    points, topology = run.need("/mesh/points", "/mesh/topology")
    cells, at = [], 0
    while at < len(topology):
        n = CORNERS[int(topology[at])]
        cells.append((int(topology[at]), topology[at + 1 : at + 1 + n]))
        at += 1 + n
    return 1e3 * points, cells


def section(points, cells, axis):
    """Polygons in which the middle plane of an axis cuts the cells, and the numbers of these cells."""
    level = 0.5 * (points[:, axis].min() + points[:, axis].max()) + 1e-9 * np.ptp(points[:, axis])
    others = [d for d in range(3) if d != axis]
    polygons, numbers = [], []
    for number, (kind, corners) in enumerate(cells):
        height = points[corners, axis] - level
        if height.min() > 0 or height.max() < 0:
            continue
        cut = []
        for i, j in EDGES[kind]:
            if height[i] * height[j] < 0:
                share = height[i] / (height[i] - height[j])
                cut.append((1 - share) * points[corners[i]][others] + share * points[corners[j]][others])
        if len(cut) > 2:
            around = np.array(cut) - np.mean(cut, axis=0)
            polygons.append(np.array(cut)[np.argsort(np.arctan2(around[:, 1], around[:, 0]))])
            numbers.append(number)
    return polygons, numbers


def voxel_section(run, axis):
    """Rectangles (mm) of the layer of voxels just above the middle of an axis, and the numbers of these cells."""
    if run.grid() is None:
        raise Missing(f"{run.name} has neither a mesh nor a grid")
    n, h, origin = run.grid()[0].astype(int), *(1e3 * lengths for lengths in run.grid()[1:])
    numbers = np.take(np.arange(np.prod(n, dtype=int)).reshape(n[::-1]), n[axis] // 2, axis=2 - axis).ravel()
    places = np.stack([numbers % n[0], numbers // n[0] % n[1], numbers // (n[0] * n[1])], axis=1)
    others = [d for d in range(3) if d != axis]
    corners = places[:, None, others] + np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    return origin[others] + h[others] * corners, numbers


def views(run):
    """Labels of the axes, polygons and numbers of cells of each picture."""
    labels = [("y", "z"), ("x", "z"), ("x", "y")]
    if not run.members("/mesh"):
        return [(*labels[axis], *voxel_section(run, axis)) for axis in range(3)]
    points, cells = cells_of(run)
    if points.shape[1] == 2:
        return [("x", "y", [points[corners] for _, corners in cells], np.arange(len(cells)))]
    return [(*labels[axis], *section(points, cells, axis)) for axis in range(3)]


def draw(run, *rows):
    """Figure, its axes and the collection that comes last in each row of (values by cell, colours, limits)."""
    pictures = views(run)
    extents = [np.ptp(np.concatenate(polygons), axis=0) for _, _, polygons, _ in pictures]
    ratio = max(high / wide for wide, high in extents)
    height = ratio * 0.8 * WIDTH / len(pictures) + (1.4 if len(rows) == 1 else 1.0)
    figure, axes = plt.subplots(len(rows), len(pictures), figsize=(WIDTH, len(rows) * min(height, 1.4 * WIDTH)), squeeze=False)
    collections = []
    for row, (line, (values, colours, limits)) in enumerate(zip(axes, rows), 1):
        for axis, (across, up, polygons, numbers) in zip(line, pictures):
            # Edges in the colour of the cell close the gaps between polygons.
            collection = PolyCollection(polygons, array=values[numbers], cmap=colours, edgecolors="face", linewidths=0.3)
            collection.set_clim(*limits)
            axis.add_collection(collection)
            axis.autoscale_view()
            axis.margins(0)
            axis.set(aspect="equal", xlabel=f"{across} in mm" if row == len(rows) else "", ylabel=f"{up} in mm")
            axis.grid(False)
        collections.append(collection)
    return figure, axes, collections


def add_bar(figure, axes, collection, label, extend="neither"):
    bar = figure.colorbar(collection, ax=list(axes), orientation="horizontal", aspect=40, pad=0.02, shrink=0.8, extend=extend)
    bar.set_label(label)
    bar.outline.set_visible(False)


def von_mises_of(stress, stiffness):
    """Of stresses [n][3] or [n][6]; `stiffness` is that of each cell, which in plane strain tells the stress along z."""
    if stress.shape[1] == 3:
        # Of an isotropic phase.
        nu = stiffness[:, 0, 1] / (stiffness[:, 1, 1] + stiffness[:, 0, 1])
        stress = np.stack([stress[:, 0], stress[:, 1], nu * (stress[:, 0] + stress[:, 1]), *np.zeros((2, len(stress))), stress[:, 2]], axis=1)
    xx, yy, zz = stress[:, :3].T
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (stress[:, 3:] ** 2).sum(axis=1))


def stress_figure(run, field):
    """One field of von Mises stresses (Pa)."""
    factor, unit = scaled(field, units=STRESSES)
    limit = np.percentile(field, 99.5) / factor
    figure, axes, (collection,) = draw(run, (field / factor, STRESS_MAP, (0, limit)))
    add_bar(figure, axes[0], collection, f"von Mises stress in {unit}", "max" if field.max() > limit * factor else "neither")
    return figure


def morphology(run):
    ids = run.need("/phase/id").ravel()
    n = int(ids.max()) + 1
    colours = ListedColormap((PHASE_COLOURS * (n // len(PHASE_COLOURS) + 1))[:n])
    figure, (axes,), _ = draw(run, (ids, colours, (-0.5, n - 0.5)))
    shares = run.need("/phase/volume_fraction") if run.members("/mesh") else [np.mean(ids == i) for i in range(n)]
    handles = [Patch(facecolor=colours(i), edgecolor="#adb5bd", label=f"{name} ({100 * share:.1f} %)")
               for i, (name, share) in enumerate(zip(phase_names(run, n), shares))]
    legend = axes[len(axes) // 2].legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1.02), ncol=4)
    legend.set_in_layout(len(axes) == 1)
    return figure


def von_mises(run, pressure=0.5e6):
    """Under the uniform strain that a mean stress of -pressure along the last axis alone needs, of KUBC or PBC; and which of the two."""
    condition = next((name for name in ("PBC", "KUBC") if name in run.members("/concentration")), None)
    if condition is None:
        raise Missing(f"{run.name} holds no strain concentration tensors")
    ids, stiffness, tensors, effective = run.need("/phase/id", "/phase/stiffness", f"/concentration/{condition}",
                                                  f"/stiffness/{condition}")
    n = effective.shape[0]
    ids, tensors = ids.ravel(), tensors.reshape(-1, n, n)
    dim = 2 if n == 3 else 3
    mean = np.zeros(n)
    mean[dim - 1] = -pressure
    stress = np.einsum("cij,cj->ci", stiffness[ids], tensors @ np.linalg.solve(effective, mean))
    return stress_figure(run, von_mises_of(stress, stiffness[ids])), condition


# Signs of the reference coordinates at the corners of quadrilaterals and hexahedra.
CORNER_SIGNS = {5: np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])}
CORNER_SIGNS[9] = np.array([[*xy, z] for z in (-1, 1) for xy in CORNER_SIGNS[5]])


def middle_strain(points, cells, displacement):
    """Voigt strains [n][3 or 6] in the middles of the cells; lengths of both arguments in the same unit."""
    dim = points.shape[1]
    pairs = [(0, 0), (1, 1), (0, 1)] if dim == 2 else [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    strains = np.empty((len(cells), len(pairs)))
    for number, (kind, corners) in enumerate(cells):
        if kind in CORNER_SIGNS:
            shape = CORNER_SIGNS[kind] / len(corners)
        else:
            shape = np.vstack([-np.ones(dim), np.eye(dim)])
        gradient = displacement[corners].T @ shape @ np.linalg.inv(points[corners].T @ shape)
        strains[number] = [gradient[c, c] if c == d else gradient[c, d] + gradient[d, c] for c, d in pairs]
    return strains


def snapshot_von_mises(run):
    """Of the last snapshot."""
    displacement = run.last("/snapshots/displacement")
    ids, stiffness = run.need("/material/phase_id", "/material/stiffness")
    points, cells = cells_of(run)
    strain = middle_strain(points, cells, 1e3 * displacement)
    by_cell = stiffness[ids]
    return stress_figure(run, von_mises_of(np.einsum("cij,cj->ci", by_cell, strain), by_cell))


def mean_von_mises(run):
    """Localized and, if there are any, direct stresses and their difference; (figure, relative L2 difference over the cells)."""
    localized, direct = run.need("/mean_von_mises"), run.get("/direct/mean_von_mises")
    factor, unit = scaled(localized, units=STRESSES)
    both = localized if direct is None else np.stack([localized, direct])
    limit = np.percentile(both, 99.5) / factor
    rows = [(field / factor, STRESS_MAP, (0, limit)) for field in (localized, direct) if field is not None]
    titles = ["localized (homogeneous run)", "direct (heterogeneous run)", "localized − direct"]
    error = None
    if direct is not None:
        gap = (localized - direct) / factor
        bound = np.percentile(np.abs(gap), 99.5) or 1.0
        rows.append((gap, DIFFERENCE_MAP, (-bound, bound)))
        error = float(np.linalg.norm(localized - direct) / np.linalg.norm(direct))
    figure, axes, collections = draw(run, *rows)
    for line, title in zip(axes, titles):
        line[0].set_title(title, loc="left")
    add_bar(figure, axes[min(1, len(rows) - 1)], collections[0], f"mean von Mises stress in {unit}", "max")
    if direct is not None:
        add_bar(figure, axes[2], collections[2], f"difference in {unit}", "both")
    return figure, error


def point_von_mises(run, name):
    return stress_figure(run, run.need(f"/points/{name}/mean_von_mises"))
