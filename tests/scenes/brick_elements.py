"""A finite element code for boxes of bricks, in scipy: Q1 with 2x2x2 Gauss points, under KUBC, SUBC and PBC, some phases with mean
dilatation (B-bar)."""

import numpy as np
from scipy.sparse import coo_matrix, csr_matrix
from scipy.sparse.linalg import spsolve

PAIRS = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))  # xx, yy, zz, yz, xz, xy
CORNERS = np.array([(x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1)])


def strain_matrix(at, h):
    """B [6][24] of a brick with edges h at a point of the unit cube."""
    values = np.where(CORNERS == 1, at, 1 - np.asarray(at))
    B = np.zeros((6, 24))
    for v, corner in enumerate(CORNERS):
        gradient = [(2 * corner[d] - 1) / h[d] * np.prod(np.delete(values[v], d)) for d in range(3)]
        for row, (c, d) in enumerate(PAIRS):
            B[row, 3 * v + c] += gradient[d]
            if c != d:
                B[row, 3 * v + d] += gradient[c]
    return B


def effective(phases, stiffness, h, condition, mean_dilatation=()):
    """The stiffness [6][6] of a box of phases [nz][ny][nx] with stiffnesses [n][6][6] under KUBC, SUBC or PBC, and the concentration
    tensors [nz][ny][nx][6][6]."""
    n = np.array(phases.shape[::-1])
    index = np.stack([a.ravel() for a in np.meshgrid(*(np.arange(m + 1) for m in n[::-1]), indexing="ij")], axis=1)[:, ::-1]
    number = lambda ijk: (ijk[..., 2] * (n[1] + 1) + ijk[..., 1]) * (n[0] + 1) + ijk[..., 0]  # noqa: E731
    cells = index[(index < n).all(axis=1)]
    dofs = (3 * number(cells[:, None] + CORNERS)[:, :, None] + np.arange(3)).reshape(-1, 24)
    points = [0.5 - 0.5 / 3**0.5, 0.5 + 0.5 / 3**0.5]
    B = np.array([strain_matrix((x, y, z), h) for x in points for y in points for z in points])
    means = np.zeros((6, 6))
    means[:3, :3] = 1 / 3
    kinds = np.array([B + means @ (B.mean(axis=0) - B) if phase in mean_dilatation else B for phase in range(len(stiffness))])
    brick = np.einsum("pqia,pij,pqjb->pab", kinds, stiffness, kinds) * np.prod(h) / 8
    values, id = brick[phases.ravel()], phases.ravel()
    K = coo_matrix((values.ravel(), (np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, 24).ravel()))).tocsr()
    given, loads = np.zeros((2, K.shape[0], 6))
    border = (index == 0) | (index == n)
    for k, (c, d) in enumerate(PAIRS):
        for a, b in {(c, d), (d, c)}:
            given[a::3, k] += index[:, b] * h[b] * (1 if c == d else 0.5)
            face = np.prod(np.where(border, 0.5, 1)[:, [e for e in range(3) if e != b]], axis=1) * np.prod(np.delete(h, b))
            loads[a::3, k] += face * ((index[:, b] == n[b]) * 1.0 - (index[:, b] == 0))
    free = {"KUBC": ~border.any(axis=1), "PBC": (index < n).all(axis=1), "SUBC": np.ones(len(index), bool)}[condition]
    original = number(index % n) if condition == "PBC" else np.arange(len(index))
    kept = np.flatnonzero(np.repeat(free, 3))
    column = np.full(K.shape[0], -1)
    column[kept] = np.arange(len(kept))
    column = column[(3 * original[:, None] + np.arange(3)).ravel()]
    has = column >= 0
    T = csr_matrix((np.ones(has.sum()), (np.flatnonzero(has), column[has])), shape=(K.shape[0], len(kept)))
    right = T.T @ (loads if condition == "SUBC" else -(K @ given))
    # Rigid motions: hold one point, under SUBC also two turns of the edge along x and one of that along y.
    last_x, last_y = number(np.array([n[0], 0, 0])), number(np.array([0, n[1], 0]))
    held = {"KUBC": [], "PBC": [0, 1, 2], "SUBC": [0, 1, 2, 3 * last_x + 1, 3 * last_x + 2, 3 * last_y + 2]}[condition]
    solved = np.setdiff1d(np.arange(len(kept)), column[held]) if held else np.arange(len(kept))
    x = np.zeros((len(kept), 6))
    x[solved] = spsolve((T.T @ K @ T).tocsc()[solved][:, solved], right[solved])
    u = T @ x + (0 if condition == "SUBC" else given)
    strains = np.einsum("ij,cjk->cik", B.mean(axis=0), u[dofs])
    stresses = np.einsum("cij,cjk->cik", stiffness[id], strains)
    tensors = stresses if condition == "SUBC" else strains
    return stresses.mean(axis=0) @ np.linalg.inv(strains.mean(axis=0)), tensors.reshape(*phases.shape, 6, 6)
