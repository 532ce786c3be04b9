"""Stresses in a volume element at points of a larger body, beside those of a direct run in the box that the volume fills around each point."""

import os

import numpy as np

from report.base.data import settings
from report.base.page import difference, escape, number, quantities, table
from report.bodies.mesh_maps import CORNER_SIGNS, cells_of, middle_strain, points_of, von_mises_of
from report.bodies.orientations import materials_of
from report.runs.verdict import pairs


def direct_run(run, dynamics):
    """The run of `dynamics` with every phase under the loads of the homogeneous run that was localized; None if there is none with snapshots."""
    name = os.path.basename(os.path.dirname(settings(run.folder).get("Input/Homogeneous run", "")))
    return next((direct for homogeneous, direct in pairs(dynamics) if homogeneous.name == name and direct.members("/snapshots")), None)


def grid_cells(run):
    """Points (mm) and all cells of a grid, as cells_of() has them."""
    n = run.grid()[0].astype(int)
    nodes = np.arange(np.prod(n + 1)).reshape(n[::-1] + 1)
    first = nodes[tuple(slice(-1) for _ in n)].ravel()
    around = np.array([0, 1, n[0] + 2, n[0] + 1])
    around = around if len(n) == 2 else np.concatenate([around, around + (n[0] + 1) * (n[1] + 1)])
    return points_of(run), [(5 if len(n) == 2 else 9, np.arange(len(first)), first[:, None] + around)]


def measure(points, kind, corners):
    """Area or volume of each cell, from the slopes in its middle."""
    dim = points.shape[1]
    shape = CORNER_SIGNS[kind] / corners.shape[1] if kind in CORNER_SIGNS else np.vstack([-np.ones(dim), np.eye(dim)])
    factor = 2**dim if kind in CORNER_SIGNS else 1 / (2 if dim == 2 else 6)
    return factor * np.abs(np.linalg.det(np.einsum("cki,kj->cij", points[corners], shape)))


def all_cells(run):
    return cells_of(run) if run.members("/mesh") else grid_cells(run)


def in_box(points, cells, low, high):
    """Those cells whose middle lies in a box (mm), and the measures of their kinds."""
    chosen = [(kind, numbers[inside], corners[inside]) for kind, numbers, corners in cells
              for inside in [np.all((points[corners].mean(axis=1) >= low) & (points[corners].mean(axis=1) < high), axis=1)] if inside.any()]
    return chosen, [measure(points, kind, corners) for kind, _, corners in chosen]


def mean_in_box(direct, low, high, window):
    """Mean von Mises stress and mean stress along the normal of the flat (Pa) over cells and snapshots, and the share of the box that the body
    fills."""
    points, cells = all_cells(direct)
    chosen, measures = in_box(points, cells, low, high)
    weights = np.concatenate(measures) if measures else np.zeros(0)
    ids, stiffness = materials_of(direct, "/material/phase_id", "/material/stiffness")
    numbers = np.concatenate([of_kind for _, of_kind, _ in chosen]) if chosen else np.zeros(0, dtype=int)
    by_cell = stiffness[np.ravel(ids)[numbers]]
    times = direct.need("/snapshots/time")
    shown = np.flatnonzero((times >= window[0]) & (times <= window[1]))
    if not len(shown) or not weights.sum():
        return None, None, 0.0
    sums = np.zeros(2)
    for k in shown:
        displacement = direct.get("/snapshots/displacement", int(k))
        strain = middle_strain(points, chosen, 1e3 * displacement.reshape(points.shape))[numbers]
        stress = np.einsum("cij,cj->ci", by_cell, strain)
        sums += [weights @ von_mises_of(stress, by_cell), weights @ stress[:, points.shape[1] - 1]]
    return *(sums / weights.sum() / len(shown)).tolist(), float(weights.sum() / np.prod(high - low))


def mean_at_point(run, name):
    """The same two means of the localized stress, None where there is no such field."""
    points, cells = all_cells(run)
    numbers = np.concatenate([of_kind for _, of_kind, _ in cells])
    weights = np.concatenate([measure(points, kind, corners) for kind, _, corners in cells])
    mises, stress = run.get(f"/points/{name}/mean_von_mises"), run.get(f"/points/{name}/mean_stress")
    mean = lambda field: None if field is None else float(weights @ field[numbers] / weights.sum())
    normal = None if stress is None else stress.reshape(-1, stress.shape[-1])[:, points.shape[1] - 1]
    return mean(None if mises is None else mises.ravel()), mean(normal)


def comparison(run, dynamics):
    """HTML of a table, "" without a direct run."""
    direct, window = direct_run(run, dynamics), run.summary.get("window")
    if direct is None or not isinstance(window, list) or len(window) != 2:
        return ""
    size = np.ptp(points_of(run), axis=0)
    rows = []
    for name in run.members("/points"):
        middle = 1e3 * run.attribute(f"/points/{name}", "position")
        *theirs, filled = mean_in_box(direct, middle - 0.5 * size, middle + 0.5 * size, window)
        for what, mine, other in zip(("von Mises", f"σ<sub>{'yy' if len(size) == 2 else 'zz'}</sub>"), mean_at_point(run, name), theirs):
            rows.append([escape(name), what, *quantities([mine, other], "Pa", 3), difference(mine, other), f"{number(100 * filled, 3)} %"])
    return table(["point", "mean stress", "localized", "direct", "difference", "of the box"], rows, (0, 1)) + (
        f'<p class="lead">Means over the volume and over time, beside those of the {escape(direct.label)} run over the cells with their middle in '
        "the box that the volume fills around the point; the last column is the share of it that these cells are.</p>")
