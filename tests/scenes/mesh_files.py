"""Meshes of boxes, written as Gmsh writes them (format 2.2, text)."""

import itertools
import math

import numpy as np

GMSH_TYPE = {("simplex", 1): 1, ("cube", 1): 1, ("simplex", 2): 2, ("cube", 2): 3, ("simplex", 3): 4, ("cube", 3): 5}
# Of quadratic cells: number of the kind, and the corners around each node after the corners.
EDGES = {"triangle": [(0, 1), (1, 2), (2, 0)], "square": [(0, 1), (1, 2), (2, 3), (3, 0)],
         "cube": [(0, 1), (0, 3), (0, 4), (1, 2), (1, 5), (2, 3), (2, 6), (3, 7), (4, 5), (4, 7), (5, 6), (6, 7)]}
FACES = [(0, 3, 2, 1), (0, 1, 5, 4), (0, 4, 7, 3), (1, 2, 6, 5), (2, 3, 7, 6), (4, 5, 6, 7)]
QUADRATIC = {("simplex", 2): (9, EDGES["triangle"]), ("cube", 2): (10, [*EDGES["square"], (0, 1, 2, 3)]),
             ("simplex", 3): (11, [*EDGES["triangle"], (3, 0), (3, 2), (3, 1)]), ("cube", 3): (12, [*EDGES["cube"], *FACES, tuple(range(8))])}
# Corners of a square and a cube in the order of Gmsh, as steps along the axes.
AROUND = {2: [(0, 0), (1, 0), (1, 1), (0, 1)]}
AROUND[3] = [(*xy, z) for z in (0, 1) for xy in AROUND[2]]


def simplices(dim):
    """The unit cube cut into simplices: one for each order in which the axes lead from corner to corner."""
    cells = []
    for axes in itertools.permutations(range(dim)):
        corners = [np.zeros(dim, int)]
        for axis in axes:
            corners.append(corners[-1] + np.eye(dim, dtype=int)[axis])
        if np.linalg.det([corner - corners[0] for corner in corners[1:]]) < 0:
            corners[-2:] = corners[:-3:-1]
        cells.append([tuple(corner) for corner in corners])
    return cells


class Cells:
    """Points [n][dim], and corners (in the order of Gmsh) and group of each cell, all of one kind."""

    def __init__(self, kind, points, cells, groups):
        self.kind, self.points, self.cells, self.groups = kind, points, cells, groups
        self.faces = []  # corners (in the order of Gmsh) and group of faces (2D: edges)
        self.middles = {}  # of quadratic cells: from the corners around a node, in ascending order, where it is

    def write(self, path):
        dim = self.points.shape[1]
        names = [(dim, name) for name in sorted(set(self.groups))] + [(dim - 1, name) for name in sorted({name for _, name in self.faces})]
        points = np.vstack([self.points, *self.middles.values()])
        points = np.hstack([points, np.zeros((len(points), 3 - dim))])
        kinds, cells = GMSH_TYPE, self.cells
        if self.middles:
            number = {corners: len(self.points) + k for k, corners in enumerate(self.middles)}
            kinds = {(self.kind, dim): QUADRATIC[self.kind, dim][0]}
            cells = [[*cell, *(number[corners] for corners in self._around_middles(cell))] for cell in self.cells]
        with open(path, "w", encoding="ascii") as file:
            file.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%d\n" % len(names))
            for k, (of_dim, name) in enumerate(names, 1):
                file.write('%d %d "%s"\n' % (of_dim, k, name))
            file.write("$EndPhysicalNames\n$Nodes\n%d\n" % len(points))
            for k, point in enumerate(points, 1):
                file.write("%d %r %r %r\n" % (k, *map(float, point)))
            elements = [(self.kind, dim, *element) for element in zip(cells, self.groups)]
            elements += [(self.kind, dim - 1, *element) for element in self.faces]
            file.write("$EndNodes\n$Elements\n%d\n" % len(elements))
            for k, (kind, of_dim, corners, group) in enumerate(elements, 1):
                tag = names.index((of_dim, group)) + 1
                file.write(" ".join(map(str, [k, kinds[kind, of_dim], 2, tag, tag, *(c + 1 for c in corners)])) + "\n")
            file.write("$EndElements\n")

    def curve(self, move=lambda middle, corners: middle):
        """Makes the cells quadratic: a node in the middle of each edge, of cubes also of each face and cell, at `move`(the mean of its corners, them)."""
        for cell in self.cells:
            for key in self._around_middles(cell):
                if key not in self.middles:
                    self.middles[key] = move(self.points[list(key)].mean(axis=0), self.points[list(key)])
        return self

    def _around_middles(self, cell):
        return [tuple(sorted(cell[c] for c in corners)) for corners in QUADRATIC[self.kind, self.points.shape[1]][1]]

    def name_side(self, name, axis, upper):
        """Makes a group of the faces at one end of an axis."""
        level = self.points[:, axis].max() if upper else self.points[:, axis].min()
        dim = self.points.shape[1]
        for cell in self.cells:
            corners = [c for c in cell if self.points[c][axis] == level]
            if len(corners) == (dim if self.kind == "simplex" else 2 ** (dim - 1)):
                if len(corners) == 4 and axis < 2:
                    corners[2:] = corners[:1:-1]
                self.faces.append((corners, name))
        return self


class Box(Cells):
    """A box from 0 to `size` in `cells` along the axes, with a group of each cell by `group_of(middle)`."""

    def __init__(self, size, cells, group_of, kind="cube"):
        dim = len(cells)
        axes = [np.linspace(0, length, n + 1) for length, n in zip(size, cells)]
        super().__init__(kind, np.array([point[::-1] for point in itertools.product(*axes[::-1])]), [], [])
        stride = np.cumprod([1, *(n + 1 for n in cells)])[:-1]
        pieces = [AROUND[dim]] if kind == "cube" else simplices(dim)
        for place in itertools.product(*(range(n) for n in cells[::-1])):
            first = np.array(place[::-1])
            group = group_of([axis[k : k + 2].mean() for axis, k in zip(axes, first)])
            for piece in pieces:
                self.cells.append([int((first + step) @ stride) for step in np.array(piece)])
                self.groups.append(group)


def fitted_region(n, radius):
    """Quadrilaterals of the part of the quarter cell that is nearer to the fibre at the origin than to the one at (1, sqrt(3)) / 2: n x n
    cells in the fibre, n rings around them up to the circle and n more up to the sides. Points, and phase and corners of the cells."""
    share = np.linspace(0, 1, n + 1)[:, None]
    line = lambda a, b: (1 - share) * np.array(a) + share * np.array(b)
    # Two sides look at the other fibres; between them a corner at 30 degrees.
    corner = math.pi / 6
    arc = lambda a, b: radius * np.hstack([np.cos(a + share * (b - a)), np.sin(a + share * (b - a))])
    joined = lambda one, other: np.vstack([one, other[1:]])
    kernel = 0.55 * radius * np.array([[1, 0], [math.cos(corner), math.sin(corner)], [0, 1]])
    inner = joined(line(kernel[0], kernel[1]), line(kernel[1], kernel[2]))
    circle = joined(arc(0, corner), arc(corner, math.pi / 2))
    tip = [0.5, 0.5 / math.sqrt(3)]
    outer = joined(line([0.5, 0], tip), line(tip, [0, 1 / math.sqrt(3)]))
    block = [x * y * kernel[1] + x * (1 - y) * kernel[0] + (1 - x) * y * kernel[2] for y in share[:, 0] for x in share[:, 0]]
    rings = [(1 - s) * inner + s * circle for s in share] + [(1 - s) * circle + s * outer for s in share[1:]]
    cells = []
    for columns, rows, first, phase_of in ((n, n, 0, lambda row: "glass"),
                                           (2 * n, 2 * n, len(block), lambda row: "glass" if row < n else "resin")):
        for row in range(rows):
            for column in range(columns):
                a = first + row * (columns + 1) + column
                b = a + columns + 1
                # In the block columns go to the right, in the rings around the fibre.
                cells.append((phase_of(row), [a, a + 1, b + 1, b] if first == 0 else [a, b, b + 1, a + 1]))
    return np.vstack([block, *rings]), cells


def hexagonal_cell(n, fraction):
    """A rectangle of 1 x sqrt(3) with a fibre in its middle and four quarters at its corners: fibres in a hexagonal lattice."""
    size = np.array([0.5, math.sqrt(3) / 2])
    radius = math.sqrt(fraction * 4 * size.prod() / (2 * math.pi))
    points, cells = fitted_region(n, radius)
    images = []
    for x_sign, y_sign, turned in itertools.product((1, -1), (1, -1), (False, True)):
        images.append(((size - points if turned else points) * [x_sign, y_sign], x_sign * y_sign < 0))
    merged, number = np.unique(np.round(np.vstack([image for image, _ in images]), 9), axis=0, return_inverse=True)
    plane = [(phase, [int(number.ravel()[k * len(points) + c]) for c in (corners[::-1] if mirrored else corners)])
             for k, (_, mirrored) in enumerate(images) for phase, corners in cells]
    return Cells("cube", merged, [corners for _, corners in plane], [phase for phase, _ in plane])


def on_circles(mesh):
    """Makes the cells of a hexagonal_cell(), extruded or not, quadratic, with the middles of edges between two points of a circle on it."""
    low, high = mesh.points.min(axis=0)[:2], mesh.points.max(axis=0)[:2]
    centres = [low + (high - low) * share for share in ((0.5, 0.5), (0, 0), (1, 0), (0, 1), (1, 1))]
    radius = min(np.linalg.norm(mesh.points[cell][:, :2] - centre, axis=1).min()
                 for cell, group in zip(mesh.cells, mesh.groups) if group == "resin" for centre in centres)

    def move(middle, corners):
        middle = middle.copy()
        for centre in centres:
            distances = np.linalg.norm(corners[:, :2] - centre, axis=1)
            if np.all(np.abs(distances - radius) < 1e-6 * radius):
                away = middle[:2] - centre
                middle[:2] = centre + radius * away / np.linalg.norm(away)
        return middle

    return mesh.curve(move)


def extruded(plane, height, layers=1):
    """Layers of hexahedra over quadrilaterals."""
    n = len(plane.points)
    points = np.vstack([np.hstack([plane.points, np.full((n, 1), z)]) for z in np.linspace(0, height, layers + 1)])
    cells = [[c + k * n for c in (*corners, *(c + n for c in corners))] for k in range(layers) for corners in plane.cells]
    return Cells("cube", points, cells, plane.groups * layers)


def mesh_of_blocks(kind, blocks, group):
    """One mesh of blocks of quadrilaterals, arrays [rows][columns][2] of points, which share the points on their sides."""
    flat = np.vstack([block.reshape(-1, 2) for block in blocks])
    _, first, number = np.unique(np.round(flat / np.abs(flat).max(), 9), axis=0, return_index=True, return_inverse=True)
    cells, begin = [], 0
    for block in blocks:
        rows, columns = block.shape[:2]
        index = number.ravel()[begin : begin + rows * columns].reshape(rows, columns)
        begin += rows * columns
        for j, i in itertools.product(range(rows - 1), range(columns - 1)):
            corners = [int(index[j, i]), int(index[j, i + 1]), int(index[j + 1, i + 1]), int(index[j + 1, i])]
            if kind == "cube":
                cells.append(corners)
            else:
                cells += [corners[:3], [corners[0], *corners[2:]]] if (i + j) % 2 else [[*corners[:2], corners[3]], corners[1:]]
    return Cells(kind, flat[first], cells, [group] * len(cells))


def disc(n, radius, group):
    """Quadrilaterals of a circle: 2 n x 2 n in a square with bulging sides, and n rings of 8 n around it."""
    along = np.linspace(-1, 1, 2 * n + 1)
    x, y = np.meshgrid(along, along)
    bulge = 0.5 * radius * (1 - 0.1 * (x**2 + y**2 - 1))[..., None]
    square = bulge * np.stack([x, y], axis=-1)
    angle = math.pi / 4 * along
    arc = radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    share = np.linspace(0, 1, n + 1)[:, None, None]
    # Along the side x = 1 of the square and the quarter of the circle beside it; rows go outwards, columns clockwise.
    side = ((1 - share) * square[:, -1] + share * arc)[:, ::-1]
    turn = np.array([[0, 1], [-1, 0]])
    return mesh_of_blocks("cube", [square, *(side @ np.linalg.matrix_power(turn, k) for k in range(4))], group)
