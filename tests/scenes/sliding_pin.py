"""Growth of steady sliding of a pin of finite width, homogeneous or not: a nonlinear eigenproblem on its cells.

    [ s^2 / (1 + beta s) M + K - mu / (1 + s delta) N ] u = 0

N moves the normal reaction of each contact node to its tangential row; contact nodes have u_y = 0, the top u_x = 0 and one
common u_y (platen). Bilinear cells and the lumped mass of the programs (doc/theory.md, section 1). With v = s u and q, the
lagged normal force of the contact nodes, the eigenproblem is linear:

    s u = v,    s M v = -K (u + beta v) + mu E q,    s delta q = R (u + beta v) - q,    N = E R."""

import dataclasses

import numpy as np
import scipy.sparse as sparse
import scipy.sparse.linalg as linalg

REFERENCE = 2 * np.pi * 100e3  # 1/s; scales v, so that u and v weigh alike


def cell_matrix(d, hx, hy):
    """Stiffness of a bilinear cell, constant strain and hourglass parts; d: 3 x 3 (Pa). Nodes lower left, lower right,
    upper left, upper right; x and y of each in turn."""
    dx, dy = np.array([-1, 1, -1, 1]) / (2 * hx), np.array([-1, -1, 1, 1]) / (2 * hy)
    b, g = np.zeros((3, 8)), np.zeros((2, 8))
    b[0, 0::2], b[1, 1::2], b[2, 0::2], b[2, 1::2] = dx, dy, dy, dx
    g[0, 0::2] = g[1, 1::2] = [1, -1, -1, 1]
    h = np.array([[d[0, 0] / hx**2 + d[2, 2] / hy**2, d[0, 2] / hx**2 + d[1, 2] / hy**2],
                  [d[0, 2] / hx**2 + d[1, 2] / hy**2, d[1, 1] / hy**2 + d[2, 2] / hx**2]])
    return hx * hy * (b.T @ d @ b + g.T @ h @ g / 12)


@dataclasses.dataclass
class SlidingPin:
    """The matrices above without the held unknowns. `ids` [ny][nx] are indices into `stiffness` [n][3][3]; `periodic`: the
    sides are one; `platen`: one common u_y of the top, else it is free."""
    mass: sparse.csr_matrix
    stiffness: sparse.csr_matrix
    friction: sparse.csr_matrix
    mu: float
    delta: float
    beta: float

    @classmethod
    def build(cls, ids, stiffness, density, size, mu, delta, beta, periodic=False, platen=True):
        ny, nx = ids.shape
        hx, hy = size[0] / nx, size[1] / ny
        columns = nx if periodic else nx + 1
        node = (np.arange(ny + 1)[:, None] * columns + np.arange(nx + 1)[None, :] % columns)
        corners = np.stack([node[:-1, :-1], node[:-1, 1:], node[1:, :-1], node[1:, 1:]], axis=-1).reshape(-1, 4)
        unknowns = np.stack([2 * corners, 2 * corners + 1], axis=-1).reshape(-1, 8)
        cells = np.array([cell_matrix(np.asarray(d), hx, hy) for d in stiffness])[ids.ravel()]
        n = 2 * columns * (ny + 1)
        k = sparse.coo_matrix((cells.ravel(), (np.repeat(unknowns, 8, axis=1).ravel(), np.tile(unknowns, 8).ravel())),
                              shape=(n, n)).tocsr()
        m = np.bincount(unknowns.ravel(), minlength=n) * density * hx * hy / 4
        contact, top = np.unique(node[0]), np.unique(node[-1])
        moved = sparse.coo_matrix((np.ones(len(contact)), (2 * contact, 2 * contact + 1)), shape=(n, n)).tocsr()
        reduce = _kept_unknowns(n, contact, top, platen)
        project = lambda a: (reduce.T @ a @ reduce).tocsc()  # noqa: E731
        return cls(project(sparse.diags(m)), project(k), project(moved @ k), mu, delta, beta)

    def operator(self, s):
        return (s**2 / (1 + self.beta * s) * self.mass + self.stiffness
                - self.mu / (1 + s * self.delta) * self.friction).tocsc()

    def eigenvalue(self, start, tolerance=1e-9, start_vector=None):
        """The eigenvalue s (1/s) nearest to `start` and its vector; residual inverse iteration with one factorization."""
        solve = linalg.splu(self.operator(start)).solve
        x = start_vector if start_vector is not None else np.random.default_rng(1).standard_normal(self.mass.shape[0]) + 0j
        for _ in range(3):
            x = solve(self.mass @ x)
            x /= np.linalg.norm(x)
        s, left = start, x.conj()
        for _ in range(200):
            previous, s = s, self._scalar_root(s, left, x, solve)
            x = x - solve(self.operator(s) @ x)
            x /= np.linalg.norm(x)
            if abs(s - previous) < tolerance * abs(s):
                return s, x
        return complex(np.nan, np.nan), x

    def _scalar_root(self, s, left, x, solve):
        """s with left . A(start)^-1 A(s) x = 0, by Newton's method."""
        parts = [left @ solve((matrix @ x).astype(complex)) for matrix in (self.mass, self.stiffness, self.friction)]
        for _ in range(20):
            g, lag = 1 + self.beta * s, 1 + s * self.delta
            value = s**2 / g * parts[0] + parts[1] - self.mu / lag * parts[2]
            slope = (2 * s / g - s**2 * self.beta / g**2) * parts[0] + self.mu * self.delta / lag**2 * parts[2]
            step = value / slope
            s = s - step
            if abs(step) < 1e-13 * abs(s):
                break
        return s


def _kept_unknowns(n, contact, top, platen):
    """Matrix from the kept unknowns to all: no u_y at the contact, no u_x on top, one u_y there under a platen."""
    held = np.zeros(n, bool)
    held[2 * contact + 1] = held[2 * top] = True
    if platen:
        held[2 * top + 1] = True
    kept = np.flatnonzero(~held)
    rows, cols = kept, np.arange(len(kept))
    if platen:
        rows = np.concatenate([rows, 2 * top + 1])
        cols = np.concatenate([cols, np.full(len(top), len(kept))])
    return sparse.coo_matrix((np.ones(len(rows)), (rows, cols)), shape=(n, len(kept) + int(platen))).tocsr()


def friction_factors(pin):
    """The contact rows, and R [contact rows][unknowns] with N = E R; E has a one in each contact row."""
    by_rows = pin.friction.tocsr()
    rows = np.flatnonzero(np.diff(by_rows.indptr))
    return rows, by_rows[rows]


def nearest(pin, shift, count):
    """The `count` eigenvalues nearest to `shift`, in the order of their distance, and their shapes."""
    rows, reactions = friction_factors(pin)
    n, mass = pin.mass.shape[0], pin.mass.diagonal()
    lag, damped = 1 + shift * pin.delta, 1 + shift * pin.beta
    scale = np.repeat([1., REFERENCE, pin.stiffness.diagonal().mean()], [n, n, len(rows)])
    solve = linalg.splu(pin.operator(shift)).solve

    def shifted_inverse(x):
        u, v, q = np.split(scale * x.ravel(), [n, 2 * n])
        right = -mass * (v + shift * u) - pin.beta * (pin.stiffness @ u)
        right[rows] += pin.mu / lag * (pin.beta * (reactions @ u) - pin.delta * q)
        new_u = solve(right) / damped
        new_v = u + shift * new_u
        return np.concatenate([new_u, new_v, (reactions @ (new_u + pin.beta * new_v) - pin.delta * q) / lag]) / scale

    size = len(scale)
    inverse = linalg.LinearOperator((size, size), shifted_inverse, dtype=complex)
    start = np.random.default_rng(1).standard_normal(size) + 0j
    inverted, shapes = linalg.eigs(inverse, count, which="LM", ncv=min(2 * count + 10, size - 1), v0=start, tol=1e-12)
    order = np.argsort(-abs(inverted))
    return shift + 1 / inverted[order], shapes[:n, order]
