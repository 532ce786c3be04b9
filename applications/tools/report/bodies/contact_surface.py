"""Maps of the contact surface of bodies in 3D, seen along z: shares of time of its nodes, and pressure of the cells at it."""

import functools
import itertools

import numpy as np

from report.base.common_scales import ends
from report.base.data import Missing
from report.base.figures import STRESSES, scaled
from report.bodies.mesh_maps import area, cells_of, middle_strain, points_of
from report.bodies.orientations import materials_of
from report.bodies.projections import Group, View, draw
from report.bodies.stress_maps import STRESS_MAP, compared

# Corners of the faces of each kind of cells in /mesh/topology, in turn.
FACES = {6: list(itertools.combinations(range(4), 3)),
         9: [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]}


def node_of_point(run, points):
    """Number of the contact node of each point of the mesh, -1 where there is none. Of points that periodic sides join only one
    is a node: the others are where it is, a period away."""
    nodes = np.full(len(points), -1)
    contact = run.need("/contact/point").astype(int)
    nodes[contact] = np.arange(len(contact))
    if run.attribute("/run", "periodic") in (b"yes", "yes"):
        period = np.ptp(points, axis=0)
        key = lambda place: tuple(np.round(place / period.max(), 7) + 0.0)
        known = {key(place): number for number, place in enumerate(points[contact])}
        at_upper_ends = (points[:, :2] > points[:, :2].max(axis=0) - 1e-7 * period.max()).any(axis=1)
        for point in np.flatnonzero(at_upper_ends & (nodes < 0)):
            for shift in ([1, 0, 0], [0, 1, 0], [1, 1, 0]):
                nodes[point] = max(nodes[point], known.get(key(points[point] - shift * period), -1))
    return nodes


def contact_faces(run):
    """Points of the mesh (mm), and (corners, nodes of the corners, numbers of the cells) of the faces of the contact, by kind."""
    points, cells = cells_of(run)
    nodes = node_of_point(run, points)
    found = []
    for kind, numbers, corners in cells:
        near = np.flatnonzero((nodes[corners] >= 0).sum(axis=1) > 2)
        faces = np.concatenate([corners[near][:, face] for face in FACES[kind]])
        owners = np.tile(numbers[near], len(FACES[kind]))
        at = (nodes[faces] >= 0).all(axis=1)
        faces, owners = faces[at], owners[at]
        # What two cells share is inside the body.
        _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
        outer = first[count == 1]
        found.append((faces[outer], nodes[faces[outer]], owners[outer]))
    if not sum(len(faces) for faces, *_ in found):
        raise Missing(f"the contact nodes of {run.name} span no faces of its mesh")
    return points, found


def bounds_of(points, faces):
    seen = points[np.concatenate([corners.ravel() for corners, *_ in faces]), :2]
    return np.array([seen.min(axis=0), seen.max(axis=0)])


def nodes_view(run):
    """Each node with its share of the faces around it, whose borders are the middles of edges and faces."""
    points, faces = contact_faces(run)
    polygons, numbers = [], []
    for corners, nodes, _ in faces:
        place = points[corners, :2]
        middle = np.broadcast_to(place.mean(axis=1, keepdims=True), place.shape)
        after = 0.5 * (place + np.roll(place, -1, axis=1))
        shares = np.stack([place, after, middle, np.roll(after, 1, axis=1)], axis=2)
        polygons.append(shares.reshape(-1, 4, 2))
        numbers.append(nodes.ravel())
    return View(bounds_of(points, faces), None, np.concatenate(polygons), np.concatenate(numbers))


def cells_view(run):
    """The faces of the contact, and the numbers of their cells."""
    points, faces = contact_faces(run)
    polygons = [polygon for corners, *_ in faces for polygon in points[corners, :2]]
    return View(bounds_of(points, faces), None, polygons, np.concatenate([owners for *_, owners in faces]))


def shares(run):
    """Shares of time (%) that the contact nodes slip, stick and are separated; (figure, states that never occur, which it leaves out)."""
    found = {name: 100 * run.need(f"/contact/{name}") for name in ("slip", "stick", "separated")}
    groups = [Group(share, STRESS_MAP, (0, 100), f"{name}, mean {share.mean():.1f} %", "share of time (%)")
              for name, share in found.items() if share.any()]
    return draw([nodes_view(run)], groups, title=run.title), [name for name, share in found.items() if not share.any()]


@functools.lru_cache(maxsize=None)
def mean_pressure(run):
    """View, values (Pa) and number of snapshots of the mean of −σ_zz over the steady part in the cells at the contact."""
    time = run.need("/snapshots/time")
    ids, stiffness = materials_of(run, "/material/phase_id", "/material/stiffness")
    points, cells = cells_of(run)
    view = cells_view(run)
    at = [(kind, numbers[pick], corners[pick]) for kind, numbers, corners in cells
          for pick in [np.isin(numbers, view.numbers)] if pick.any()]
    steady = np.flatnonzero(time >= run.steady_from())
    if not steady.size:
        raise Missing(f"{run.name} has no snapshot of its steady part")
    moved = lambda row: 1e3 * run.get("/snapshots/displacement", int(row)).reshape(points.shape)
    strain = sum(middle_strain(points, at, moved(row))[view.numbers] for row in steady)
    mean = -np.einsum("cj,cj->c", stiffness[ids[view.numbers], 2], strain) / len(steady)
    view.numbers = np.arange(len(view.numbers))
    return view, mean, len(steady)


def pressure_ends(run):
    low, high = np.percentile(mean_pressure(run)[1], (0.5, 99.5))
    return min(low, 0), max(high, 0)


def pressure(run, runs):
    """Mean over the snapshots of the steady part of the stress −σ_zz in the cells at the contact, on the scale of `runs`; (figure, number
    of snapshots)."""
    view, mean, count = mean_pressure(run)
    low, high, _ = ends(pressure_ends, runs)
    factor, unit = scaled(np.array([low, high]), units=STRESSES)
    total = np.average(mean, weights=[area(polygon - polygon[0]) for polygon in view.polygons]) / factor
    group = Group(mean / factor, STRESS_MAP, (low / factor, high / factor), f"mean over the surface {total:.3g} {unit}",
                  rf"mean of $-\sigma_\mathrm{{zz}}$ ({unit})")
    return draw([view], [group], title=run.title), count


def nominal_pressure(run):
    """Pa; normal force on the contact, mean over the steady part, per area seen along z; None where it is not known."""
    time, force, areas = (run.get(name) for name in ("/history/time", "/history/contact_normal_force", "/contact/area"))
    if any(array is None for array in (time, force, areas)) or len(time) != len(force) or time[-1] < run.steady_from():
        return None
    return float(force[time >= run.steady_from()].mean() / areas.sum())


def localized_pressure(run, dynamics):
    """Localized and direct −σ_zz in the cells at the contact, which a run on the same cells tells; (figure, L2 difference)."""
    points = points_of(run)
    same = lambda other: other.shape == points.shape and np.allclose(other, points, atol=1e-9 * np.ptp(points))
    source = next((other for other in dynamics if other.has_surface() and same(points_of(other))), None)
    if source is None:
        raise Missing(f"no run of contact_dynamics on the cells of {run.name} tells its contact surface")
    view = cells_view(source)
    localized, direct = run.need("/mean_stress"), run.get("/direct/mean_stress")
    take = lambda stress: None if stress is None else -stress.reshape(-1, 6)[view.numbers, 2]
    seen = View(view.bounds, None, view.polygons, np.arange(len(view.numbers)))
    return compared([seen], take(localized), take(direct), r"mean of $-\sigma_\mathrm{zz}$")
