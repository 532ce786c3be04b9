"""A finite element code for boxes of quadratic cells, straight or curved, in scipy: triangles, tetrahedra, quadrilaterals and hexahedra,
under KUBC, SUBC and PBC; changes of volume in some phases are projected to linear functions in a cell, of simplices to constants."""

import itertools

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.linalg import splu

PAIRS = {2: ((0, 0), (1, 1), (0, 1)), 3: ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))}


class Reference:
    """Nodes and monomials of a unit cell whose corners are in the order of Gmsh; values and slopes of shape functions anywhere."""

    def __init__(self, kind, dim):
        exponents = np.array(list(itertools.product(range(3), repeat=dim)))
        self.exponents = exponents if kind == "cube" else exponents[exponents.sum(axis=1) <= 2]
        self.nodes = self.exponents / 2
        self.linear = np.array(list(itertools.product(range(2), repeat=dim))) if kind == "cube" else np.vstack([np.zeros(dim, int), np.eye(dim, dtype=int)])
        if kind == "cube":  # of Gmsh: around the lower face, then around the upper one
            around = [(0, 0), (1, 0), (1, 1), (0, 1)]
            self.corners = np.array(around if dim == 2 else [(*xy, z) for z in (0, 1) for xy in around])
        else:
            self.corners = self.linear
        one, weights = np.polynomial.legendre.leggauss(3 if kind == "cube" else 4)
        one, weights = (one + 1) / 2, weights / 2
        points = np.array(list(itertools.product(one, repeat=dim)))
        self.weights = np.prod(list(itertools.product(weights, repeat=dim)), axis=1)
        if kind == "simplex":  # the cube folded into it
            for d in range(1, dim):
                for e in range(d):
                    self.weights *= 1 - points[:, e]
            folded = points.copy()
            for d in range(1, dim):
                folded[:, d] *= np.prod(1 - points[:, :d], axis=1)
            points = folded
        self.points = points

    def _at(self, exponents, nodes, x):
        power = lambda p: np.prod(p[:, None] ** exponents, axis=2)  # noqa: E731
        inverse = np.linalg.inv(power(nodes))
        slopes = []
        for d in range(exponents.shape[1]):
            lower = exponents.copy()
            lower[:, d] = np.maximum(lower[:, d] - 1, 0)
            slopes.append(exponents[:, d] * np.prod(x[:, None] ** lower, axis=2) @ inverse)
        return power(x) @ inverse, np.stack(slopes, axis=2)

    def quadratic(self, x):
        return self._at(self.exponents, self.nodes, x)

    def straight(self, x):
        """Of the corners."""
        return self._at(self.linear, self.corners.astype(float), x)


def project(B, weights, basis, dim):
    """Replaces in B [q][cell][strain][dof] the sum of normal strains by its projection to the functions `basis` [q][cell][n]."""
    volume = B[:, :, :dim].sum(axis=2)
    mass = np.einsum("qc,qci,qcj->cij", weights, basis, basis)
    projected = np.einsum("qci,cij,rc,rcj,rca->qca", basis, np.linalg.inv(mass), weights, basis, volume, optimize=True)
    B[:, :, :dim] += ((projected - volume) / dim)[:, :, None]


def effective(mesh, stiffness, condition, mean_dilatation=()):
    """The stiffness of a mesh (mesh_files.Cells) whose groups are the keys of `stiffness` [n][n]."""
    dim = mesh.points.shape[1]
    pairs, reference = PAIRS[dim], Reference(mesh.kind, dim)
    corners = mesh.points[np.array(mesh.cells)]
    around = reference.straight(reference.nodes)[0]
    places = np.einsum("na,cad->cnd", around, corners)
    for cell, nodes in zip(mesh.cells, places if mesh.middles else ()):
        for node, share in enumerate(around):
            key = tuple(sorted(np.array(cell)[share > 1e-6]))
            nodes[node] = mesh.middles.get(key, nodes[node])
    size = mesh.points.max(axis=0)
    points, number = np.unique(np.round(places.reshape(-1, dim) / size, 9), axis=0, return_inverse=True)
    number, points = number.reshape(places.shape[:2]), points * size
    dofs = (dim * number[:, :, None] + np.arange(dim)).reshape(len(number), -1)
    values, shape = reference.quadratic(reference.points)
    n, m = dim * len(points), dofs.shape[1]
    loads, given = np.zeros((n, len(pairs))), np.zeros((n, len(pairs)))
    C = np.array([stiffness[group] for group in mesh.groups])
    all_B, weights, basis = [], [], []
    for q, weight in enumerate(reference.weights):
        J = np.einsum("cnd,ne->cde", places, shape[q])
        gradient = np.einsum("ne,ced->cnd", shape[q], np.linalg.inv(J))
        B = np.zeros((len(number), len(pairs), m))
        for row, (c, d) in enumerate(pairs):
            B[:, row, c::dim] += gradient[:, :, d]
            if c != d:
                B[:, row, d::dim] += gradient[:, :, c]
        all_B.append(B)
        weights.append(weight * np.abs(np.linalg.det(J)))
        x = np.einsum("n,cnd->cd", values[q], places) - corners[:, 0]
        basis.append(np.hstack([np.ones((len(number), 1)), x]) if mesh.kind == "cube" else np.ones((len(number), 1)))
    B, weights, basis = np.array(all_B), np.array(weights), np.array(basis)
    soft = np.isin(mesh.groups, mean_dilatation)
    changed = B[:, soft]
    project(changed, weights[:, soft], basis[:, soft], dim)
    B[:, soft] = changed
    K = np.einsum("qc,qcia,cij,qcjb->cab", weights, B, C, B, optimize=True)
    np.add.at(loads, dofs, np.einsum("qc,qcia->cai", weights, B))
    K = coo_matrix((K.ravel(), (np.repeat(dofs, m, axis=1).ravel(), np.tile(dofs, m).ravel())), shape=(n, n)).tocsr()
    for k, (c, d) in enumerate(pairs):
        for a, b in {(c, d), (d, c)}:
            given[a::dim, k] += points[:, b] * (1 if c == d else 0.5)
    border = (points < 1e-9 * size) | (points > (1 - 1e-9) * size)
    first = {tuple(np.round(p / size, 7)): k for k, p in enumerate(points)}
    original = np.array([first[tuple(np.round(p / size, 7) % 1)] for p in points]) if condition == "PBC" else np.arange(len(points))
    free = ~border.any(axis=1) if condition == "KUBC" else original == np.arange(len(points))
    at = lambda *place: first[tuple(map(float, place))]  # noqa: E731
    held = []  # just enough against rigid motions
    if condition != "KUBC":
        held += [dim * at(*[0] * dim) + c for c in range(dim)]
    if condition == "SUBC":
        held += [dim * at(*np.eye(dim)[axis]) + c for axis in range(dim - 1) for c in range(axis + 1, dim)]
    kept = np.setdiff1d(np.flatnonzero(np.repeat(free, dim)), held)
    column = np.full(n, -1)
    column[kept] = np.arange(len(kept))
    column = column[(dim * original[:, None] + np.arange(dim)).ravel()]
    has = column >= 0
    T = csr_matrix((np.ones(has.sum()), (np.flatnonzero(has), column[has])), shape=(n, len(kept)))
    if condition == "SUBC":
        given[:] = 0
    right = loads if condition == "SUBC" else -(K @ given)
    u = T @ splu((T.T @ K @ T).tocsc()).solve(T.T @ right) + given
    mean = np.einsum("qc,qcia,cak->ik", weights, B, u[dofs], optimize=True)
    stress = np.einsum("qc,cij,qcja,cak->ik", weights, C, B, u[dofs], optimize=True)
    return stress @ np.linalg.inv(mean)
