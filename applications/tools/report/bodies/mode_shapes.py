"""Shapes of modes: the deformed body with its outline at rest, on plane grids and meshes as they are, in 3D its surface seen from an angle."""

import dataclasses

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize

from report.base.data import Missing
from report.base.figures import GREY, WIDTH, plt
from report.bodies import mesh_maps

LINES = 60  # of a grid, along a side, that are drawn at most
AZIMUTH, ELEVATION = np.radians(30), np.radians(25)  # from which a body in 3D is seen; z points upwards
DEFORMED = 0.07  # of the body's size, by which the largest displacement is drawn
EDGE = 0.75  # cosine of the angle between two faces, below which they meet in an edge of the outline
# Corners of the faces of tetrahedra and hexahedra in /mesh/topology.
FACES = {6: [(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)],
         9: [(0, 1, 2, 3), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]}


@dataclasses.dataclass
class Skin:
    """What is drawn of a body: points [n][dim] (mm), their numbers among its nodes, triangles [m][3] and outline [k][2] of these points."""
    points: np.ndarray
    nodes: np.ndarray
    triangles: np.ndarray
    outline: np.ndarray


def triangulated(faces):
    """Triangles of faces with three or four corners each."""
    faces = np.asarray(faces)
    return faces if faces.shape[1] == 3 else np.concatenate([faces[:, [0, 1, 2]], faces[:, [0, 2, 3]]])


def once(faces):
    """Those of the faces (or edges) that belong to one cell alone."""
    _, first, counts = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
    return faces[first[counts == 1]]


def edges_of(triangles):
    return np.concatenate([triangles[:, pair] for pair in ([0, 1], [1, 2], [2, 0])])


def normals(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normal = np.cross(b - a, c - a)
    return normal / np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]


def sharp_edges(points, triangles):
    """Edges in which the surface has a bend."""
    pairs, owners = edges_of(triangles), np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort(np.sort(pairs, axis=1).T)
    pairs, owners = np.sort(pairs[order], axis=1), owners[order]
    same = np.all(pairs[1:] == pairs[:-1], axis=1)
    normal = normals(points, triangles)
    bend = np.abs(np.einsum("ki,ki->k", normal[owners[1:]], normal[owners[:-1]])) < EDGE
    return pairs[1:][same & bend]


def _used(points, triangles, outline):
    """A Skin without the points that none of its triangles has."""
    nodes, triangles = np.unique(triangles, return_inverse=True)
    place = np.full(len(points), -1)
    place[nodes] = np.arange(len(nodes))
    return Skin(points[nodes], nodes, triangles.reshape(-1, 3), place[outline])


def _mesh_skin(run):
    points, cells = mesh_maps.cells_of(run)
    if points.shape[1] == 2:
        triangles = np.concatenate([triangulated(corners) for *_, corners in cells])
        around = [corners[:, [k, (k + 1) % corners.shape[1]]] for *_, corners in cells for k in range(corners.shape[1])]
        return _used(points, triangles, once(np.concatenate(around)))
    by_corners = {}
    for kind, _, corners in cells:
        for face in FACES[kind]:
            by_corners.setdefault(len(face), []).append(corners[:, face])
    triangles = np.concatenate([triangulated(once(np.concatenate(faces))) for faces in by_corners.values()])
    return _used(points, triangles, sharp_edges(points, triangles))


def _grid_skin(run):
    """The nodes of a plane grid, or those on the sides of a box; of fine grids some of them."""
    cells = run.grid()[0].astype(int)
    lines = [np.unique(np.append(np.arange(0, n + 1, max(1, n // LINES)), n)) for n in cells]
    numbers = np.arange(np.prod(cells + 1)).reshape(cells[::-1] + 1)[np.ix_(*lines[::-1])]
    sheets = [numbers] if len(cells) == 2 else [np.take(numbers, end, axis=axis) for axis in range(3) for end in (0, -1)]
    squares = [np.stack([sheet[:-1, :-1], sheet[:-1, 1:], sheet[1:, 1:], sheet[1:, :-1]], axis=-1).reshape(-1, 4) for sheet in sheets]
    triangles = triangulated(np.concatenate(squares))
    points = mesh_maps.points_of(run)
    return _used(points, triangles, once(edges_of(triangles)) if len(cells) == 2 else sharp_edges(points, triangles))


def skin(run):
    if run.members("/mesh"):
        return _mesh_skin(run)
    if run.grid() is None:
        raise Missing(f"{run.name} has neither a mesh nor a grid")
    return _grid_skin(run)


def projected(points):
    """Places [n][2] on the page, and how near to the eye [n] they are; points in a plane stay."""
    if points.shape[1] == 2:
        return points, np.zeros(len(points))
    x, y, z = points.T
    across, along = x * np.cos(AZIMUTH) - y * np.sin(AZIMUTH), x * np.sin(AZIMUTH) + y * np.cos(AZIMUTH)
    return np.stack([across, z * np.cos(ELEVATION) + along * np.sin(ELEVATION)], axis=1), z * np.sin(ELEVATION) - along * np.cos(ELEVATION)


def _draw(axis, body, shape, largest, scale):
    """`shape` [nodes][dim] of the body's skin, real or complex: the real part is drawn, `scale` mm long where it is the `largest`, the amplitude is
    the colour."""
    size = np.linalg.norm(shape, axis=1) / largest
    moved = shape.real * scale / largest
    places, near = projected(body.points + moved)
    if body.points.shape[1] == 2:
        axis.tripcolor(*places.T, body.triangles, size, shading="gouraud", cmap="viridis", vmin=0, vmax=1, rasterized=True)
    else:
        order = np.argsort(near[body.triangles].mean(axis=1))
        triangles = body.triangles[order]
        light = 0.65 + 0.35 * np.abs(normals(body.points + moved, triangles) @ np.array([0.5, 0.4, 0.77]))
        colours = plt.get_cmap("viridis")(size[triangles].mean(axis=1))
        colours[:, :3] *= light[:, None]
        axis.add_collection(PolyCollection(places[triangles], facecolors=colours, edgecolors=colours, linewidths=0.3, rasterized=True))
    rest, _ = projected(body.points)
    axis.add_collection(LineCollection(rest[body.outline], colors=GREY, linewidths=0.8, linestyles=":"))
    axis.set_aspect("equal")
    axis.autoscale_view()


def _draw_mode(axis, bodies, shapes):
    """One mode of all `bodies`, of which each has a shape [...][dim], on one scale."""
    parts = [shape.reshape(-1, body.points.shape[1])[body.nodes] for body, shape in zip(bodies, shapes)]
    largest = max(np.linalg.norm(part, axis=1).max() for part in parts) or 1.0
    scale = DEFORMED * np.ptp(bodies[0].points, axis=0).max()
    for body, part in zip(bodies, parts):
        _draw(axis, body, part, largest, scale)


def figure(run, columns, shown=3, below=None):
    """`columns` [(titles [mode], shapes [modes][...][dim])], the lowest `shown` modes of each below one another; `below`: a counter body, and its shapes of the
    modes of the only column."""
    bodies = [skin(run)] + ([skin(below[0])] if below else [])
    rows = min(shown, max(len(shapes) for _, shapes in columns))
    width, height = np.ptp(np.concatenate([projected(body.points)[0] for body in bodies]), axis=0)
    high = 1.15 * height / width * WIDTH / len(columns)
    figure, axes = plt.subplots(rows, len(columns), figsize=(WIDTH, rows * (0.35 + min(high, 3.2)) + 1.0), squeeze=False)
    for column, (titles, shapes) in zip(axes.T, columns):
        for k, axis in enumerate(column):
            axis.axis("off")
            if k < len(shapes):
                _draw_mode(axis, bodies, [shapes[k]] + ([below[1][k]] if below else []))
                axis.set_title(titles[k], fontsize=10, loc="left")
    bar = figure.colorbar(ScalarMappable(Normalize(0, 1), "viridis"), ax=axes, orientation="horizontal", shrink=0.4, aspect=25, ticks=[0, 0.5, 1])
    bar.set_label("amplitude over the largest")
    bar.outline.set_visible(False)
    return figure


def caption(run):
    seen = ", its surface seen from an angle, x to the right, z upwards" if run.is_solid() else ""
    return f"the deformed body{' and counter body' if run.below() else ''}{seen}, coloured by the amplitude; the dotted outline is the body at rest."
