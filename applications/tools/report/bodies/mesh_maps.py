"""Maps of volumes on meshes and of voxels: phases and von Mises stress, of a plane mesh as it is, of a solid one in three sections through its middle."""

import numpy as np

from report.base.data import Missing
from report.bodies.orientations import materials_of
from report.bodies.projections import View, draw
from report.bodies.stress_maps import compared, phase_figure, stress_group

PLANES = (1, 0, 2)  # axes across the sections, in the order of a technical drawing
THIN = 0.1  # shortest over second shortest side, below which a body is a plate
# Kinds of cells in /mesh/topology: number of corners, edges between them.
CORNERS = {4: 3, 5: 4, 6: 4, 9: 8}
EDGES = {6: [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)],
         9: [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]}


def points_of(run):
    """Points [n][dim] (mm) of a mesh or the nodes of a grid, x fastest."""
    if run.members("/mesh"):
        return 1e3 * run.need("/mesh/points")
    if run.grid() is None:
        raise Missing(f"{run.name} has neither a mesh nor a grid")
    n, h, origin = run.grid()
    axes = [1e3 * (o + step * np.arange(int(cells) + 1)) for cells, step, o in zip(n, h, origin)]
    return np.stack([place.ravel() for place in np.meshgrid(*axes[::-1], indexing="ij")[::-1]], axis=1)


def shown_cells(run):
    """Numbers of those cells of a grid in 3D that pictures show: in the middle of each axis and at the contact."""
    n = run.grid()[0].astype(int)
    numbers = np.arange(np.prod(n, dtype=int)).reshape(n[::-1])
    layers = [np.take(numbers, n[axis] // 2, axis=2 - axis) for axis in range(3)] + [numbers[0]]
    return np.unique(np.concatenate([layer.ravel() for layer in layers]))


def bricks_of(run):
    """The cells of a grid in 3D that pictures show, as cells_of() has them."""
    numbers, n = shown_cells(run), run.grid()[0].astype(int)
    columns, plane = n[0] + 1, (n[0] + 1) * (n[1] + 1)
    first = numbers % n[0] + numbers // n[0] % n[1] * columns + numbers // (n[0] * n[1]) * plane
    around = np.array([0, 1, columns + 1, columns])
    return [(9, numbers, first[:, None] + np.concatenate([around, around + plane]))]


def cells_of(run):
    """Points [n][dim] (mm), and the cells by kind: (kind, numbers of the cells, corners of each)."""
    if not run.members("/mesh"):
        return points_of(run), bricks_of(run)
    points, topology = run.need("/mesh/points", "/mesh/topology")
    stride = 1 + CORNERS[int(topology[0])]
    if len(topology) % stride == 0 and np.all(topology[::stride] == topology[0]):
        return 1e3 * points, [(int(topology[0]), np.arange(len(topology) // stride), topology.reshape(-1, stride)[:, 1:])]
    found, at, number = {}, 0, 0
    while at < len(topology):
        n = CORNERS[int(topology[at])]
        found.setdefault(int(topology[at]), []).append((number, topology[at + 1 : at + 1 + n]))
        at, number = at + 1 + n, number + 1
    return 1e3 * points, [(kind, *(np.array(part) for part in zip(*cells))) for kind, cells in found.items()]


def area(polygon):
    x, y = polygon.T
    return 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))


def section(points, cells, axis):
    """Polygons in which the middle plane of an axis cuts the cells, and the numbers of these cells."""
    level = 0.5 * (points[:, axis].min() + points[:, axis].max()) + 1e-9 * np.ptp(points[:, axis])
    others = [d for d in range(3) if d != axis]
    polygons, numbers = [], []
    for kind, of_kind, corners_of_kind in cells:
        heights = points[corners_of_kind, axis] - level
        for k in np.flatnonzero((heights.min(axis=1) < 0) & (heights.max(axis=1) > 0)):
            height, corners, cut = heights[k], corners_of_kind[k], []
            for i, j in EDGES[kind]:
                if height[i] * height[j] < 0:
                    share = height[i] / (height[i] - height[j])
                    cut.append((1 - share) * points[corners[i]][others] + share * points[corners[j]][others])
            if len(cut) > 2:
                around = np.array(cut) - np.mean(cut, axis=0)
                polygon = np.array(cut)[np.argsort(np.arctan2(around[:, 1], around[:, 0]))]
                # Else the plane only touches the cell.
                if area(polygon - polygon[0]) > 1e-7 * np.ptp(points[:, axis]) * np.ptp(polygon, axis=0).max():
                    polygons.append(polygon)
                    numbers.append(of_kind[k])
    return polygons, np.array(numbers, dtype=int)


def voxel_section(run, axis):
    """Rectangles (mm) of the layer of voxels just above the middle of an axis, and the numbers of these cells."""
    n, h, origin = run.grid()[0].astype(int), *(1e3 * lengths for lengths in run.grid()[1:])
    numbers = np.take(np.arange(np.prod(n, dtype=int)).reshape(n[::-1]), n[axis] // 2, axis=2 - axis).ravel()
    places = np.stack([numbers % n[0], numbers // n[0] % n[1], numbers // (n[0] * n[1])], axis=1)
    others = [d for d in range(3) if d != axis]
    corners = places[:, None, others] + np.array([[0, 0], [1, 0], [1, 1], [0, 1]])
    return origin[others] + h[others] * corners, numbers


def planes(bounds):
    """Axes of the sections through a body: all, or the short one of a plate, which has little to show across the others."""
    extents = np.ptp(bounds, axis=0)
    shortest, second = np.sort(extents)[:2]
    return [int(np.argmin(extents))] if shortest < THIN * second else PLANES


def views(run):
    """Of a plane mesh the whole, of a body in 3D the sections through its middle."""
    if not run.members("/mesh"):
        if run.grid() is None:
            raise Missing(f"{run.name} has neither a mesh nor a grid")
        n, h, origin = run.grid()
        bounds = 1e3 * np.array([origin, origin + n * h])
        return [View(bounds, axis, *voxel_section(run, axis)) for axis in planes(bounds)]
    points, cells = cells_of(run)
    bounds = np.array([points.min(axis=0), points.max(axis=0)])
    if points.shape[1] == 3:
        return [View(bounds, axis, *section(points, cells, axis)) for axis in planes(bounds)]
    polygons = [polygon for *_, corners in cells for polygon in points[corners]]
    return [View(bounds, None, polygons, np.concatenate([numbers for _, numbers, _ in cells]))]


def von_mises_of(stress, stiffness):
    """Of stresses [n][3] or [n][6]; `stiffness` is that of each cell, which in plane strain tells the stress along z."""
    if stress.shape[1] == 3:
        # Of an isotropic phase.
        nu = stiffness[:, 0, 1] / (stiffness[:, 1, 1] + stiffness[:, 0, 1])
        stress = np.stack([stress[:, 0], stress[:, 1], nu * (stress[:, 0] + stress[:, 1]), *np.zeros((2, len(stress))), stress[:, 2]], axis=1)
    xx, yy, zz = stress[:, :3].T
    return np.sqrt(0.5 * ((xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2) + 3 * (stress[:, 3:] ** 2).sum(axis=1))


def stress_figure(run, field, limit=None):
    return draw(views(run), [stress_group(field, limit=limit)])


def morphology(run):
    ids = run.need("/phase/id").ravel()
    shares = run.need("/phase/volume_fraction") if run.members("/mesh") else [np.mean(ids == i) for i in range(ids.max() + 1)]
    return phase_figure(views(run), run, ids, [f" ({100 * share:.1f} %)" for share in shares])


def phases_of_run(run):
    ids, names = run.need("/material/phase_id", "/material/name")
    return phase_figure(views(run), run, ids.ravel(), [""] * len(names))


def von_mises(run, pressure):
    """Under the uniform strain that a mean stress of -pressure (Pa) along the last axis alone needs, of KUBC or PBC; and which of the two."""
    condition = next((name for name in ("PBC", "KUBC") if name in run.members("/concentration")), None)
    if condition is None:
        raise Missing(f"{run.name} holds no strain concentration tensors")
    ids, stiffness = materials_of(run, "/phase/id", "/phase/stiffness")
    tensors, effective = run.need(f"/concentration/{condition}", f"/stiffness/{condition}")
    n = effective.shape[0]
    tensors = tensors.reshape(-1, n, n)
    dim = 2 if n == 3 else 3
    mean = np.zeros(n)
    mean[dim - 1] = -pressure
    stress = np.einsum("cij,cj->ci", stiffness[ids], tensors @ np.linalg.solve(effective, mean))
    return stress_figure(run, von_mises_of(stress, stiffness[ids])), condition


# Signs of the reference coordinates at the corners of quadrilaterals and hexahedra.
CORNER_SIGNS = {5: np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])}
CORNER_SIGNS[9] = np.array([[*xy, z] for z in (-1, 1) for xy in CORNER_SIGNS[5]])


def middle_strain(points, cells, displacement):
    """Voigt strains [n][3 or 6] in the middles of the cells, by their number; lengths of both arguments in the same unit."""
    dim = points.shape[1]
    pairs = [(0, 0), (1, 1), (0, 1)] if dim == 2 else [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]
    strains = np.empty((1 + max(numbers.max() for _, numbers, _ in cells), len(pairs)))
    for kind, numbers, corners in cells:
        if kind in CORNER_SIGNS:
            shape = CORNER_SIGNS[kind] / corners.shape[1]
        else:
            shape = np.vstack([-np.ones(dim), np.eye(dim)])
        slopes = [np.einsum("cki,kj->cij", field[corners], shape) for field in (displacement, points)]
        gradient = slopes[0] @ np.linalg.inv(slopes[1])
        strains[numbers] = np.stack([gradient[:, c, d] + (c != d) * gradient[:, d, c] for c, d in pairs], axis=1)
    return strains


def snapshot_von_mises(run):
    """Pa [cells]; of the last snapshot, NaN in the cells of a grid that pictures do not show."""
    displacement = run.last("/snapshots/displacement")
    ids, stiffness = materials_of(run, "/material/phase_id", "/material/stiffness")
    points, cells = cells_of(run)
    strain = middle_strain(points, cells, 1e3 * displacement.reshape(points.shape))
    numbers = np.concatenate([of_kind for _, of_kind, _ in cells])
    by_cell = stiffness[ids[numbers]]
    field = np.full(len(strain), np.nan)
    field[numbers] = von_mises_of(np.einsum("cij,cj->ci", by_cell, strain[numbers]), by_cell)
    return field


def mean_von_mises(run):
    localized, direct = run.need("/mean_von_mises"), run.get("/direct/mean_von_mises")
    return compared(views(run), localized.ravel(), None if direct is None else direct.ravel(), "mean von Mises stress")


def point_von_mises(run, name):
    return stress_figure(run, run.need(f"/points/{name}/mean_von_mises").ravel())
