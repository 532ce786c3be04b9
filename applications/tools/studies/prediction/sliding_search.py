"""Every mode of a sliding pin that can grow: a region outside which none does, and shift-invert Arnoldi over this region.

With v = s u and q, the lagged normal force of the contact nodes, the eigenproblem of sliding_modes.py is linear:

    s u = v,    s M v = -K (u + beta v) + mu E q,    s delta q = R (u + beta v) - q,    N = E R."""

import dataclasses

import numpy as np
import scipy.linalg as dense
import scipy.sparse as sparse
import scipy.sparse.linalg as linalg

SAME = 1e-7  # relative distance of eigenvalues that two shifts found of one mode
REFERENCE = 2 * np.pi * 100e3  # 1/s; scales v, so that u and v weigh alike


@dataclasses.dataclass
class Disc:
    """All eigenvalues (1/s) nearer to `centre` than `radius` are known."""
    centre: complex
    radius: float
    eigenvalues: np.ndarray

    def holds(self, s, margin=0.):
        return abs(s - self.centre) < (1 - margin) * self.radius


@dataclasses.dataclass
class Modes:
    """The eigenvalues (1/s) with Im s > |Re s| in the discs of a search, the fastest growing first, and their shapes
    [unknowns][modes] with u^H M u = 1; `residuals` are relative to the terms of the operator. All eigenvalues with
    Re s >= 0 and 0 <= Im s <= `searched` (1/s) are among them, and none has Re s >= 0 and Im s > `bound` (1/s)."""
    eigenvalues: np.ndarray
    shapes: np.ndarray
    residuals: np.ndarray
    discs: list
    searched: float
    bound: float

    @property
    def growing(self):
        """How many grow."""
        return int(np.sum(self.eigenvalues.real > 0))


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


def numerical_radius(pin, directions=33):
    """Bound of |u^H N u| / u^H K u over all u: the polygon around the numerical range of N in the energy of K."""
    rows, reactions = friction_factors(pin)
    n, m = pin.mass.shape[0], len(rows)
    unit = sparse.coo_matrix((np.ones(m), (rows, np.arange(m))), shape=(n, m))
    sides = sparse.hstack([unit, reactions.T]).toarray()
    energy = sides.T @ linalg.splu(pin.stiffness).solve(sides)
    sizes, vectors = dense.eigh((energy + energy.T) / 2)
    kept = sizes > 1e-13 * sizes[-1]
    basis = vectors[:, kept] / np.sqrt(sizes[kept])
    range_of = basis.T @ energy[:, :m] @ energy[m:] @ basis
    even, odd = (range_of + range_of.T) / 2, (range_of - range_of.T) / 2
    angles = np.linspace(0, np.pi, directions)
    support = [dense.eigvalsh(np.cos(a) * even + 1j * np.sin(a) * odd)[-1] for a in angles]
    return max(support) / np.cos(angles[1] / 2)


class Region:
    """Where an eigenvalue with Re s >= 0 can be. u^H [...] u = 0 says that -s^2 / (1 + beta s) is a positive multiple of
    1 - mu z / (1 + s delta) with |z| <= the numerical radius, so that, with s = a + i w,

        2 atan(a / w) + atan(beta w / (1 + beta a)) <= asin(mu radius / |1 + s delta|).

    The left side grows with a, and for a = 0 with w; the right side falls."""

    def __init__(self, pin, radius=None):
        """`radius`: numerical_radius(pin), which does not depend on mu, delta and beta, where it is known."""
        self.beta, self.delta, self.strength = pin.beta, pin.delta, pin.mu * (radius or numerical_radius(pin))
        if not self.strength < 1:
            raise ValueError(f"mu times the numerical radius of friction is {self.strength:g}; below 1 growth is bounded")
        low, high = 0., 1.
        while self._angle(high) > np.arctan(self.beta * high):
            low, high = high, 2 * high
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if self._angle(middle) > np.arctan(self.beta * middle) else (low, middle)
        self.bound = high  # 1/s; no mode of higher frequency grows

    def _angle(self, omega):
        return np.arcsin(self.strength / abs(1 + 1j * omega * self.delta))

    def width(self, low, high):
        """Bound of Re s for Im s from `low` to `high` (1/s)."""
        undamped = high * np.tan(self._angle(low) / 2)
        damping = np.arctan(self.beta * low / (1 + self.beta * undamped))
        return high * np.tan(max(0., self._angle(low) - damping) / 2)


def count_at(omega):
    """How many modes a shift: few at low frequencies, where a disc of more reaches the many overdamped ones at -1 / delta."""
    return int(np.clip(omega / (2 * np.pi * 10e3), 4, 40))


def search(pin, limit=np.inf, radius=None):
    """Modes of the region up to Im s = `limit` (1/s), by overlapping discs."""
    region = Region(pin, radius)
    end, edge, reach, discs, shapes = min(limit, region.bound), 0., 2 * np.pi * 20e3, [], []
    while edge < end:
        middle = edge + 0.85 * reach
        width = region.width(edge, middle + reach)
        centre = complex(width / 2, middle)
        eigenvalues, vectors = nearest(pin, centre, count_at(middle))
        disc = Disc(centre, abs(eigenvalues[-1] - centre), eigenvalues[:-1])
        covered = min(reach, np.sqrt(max(0., disc.radius**2 - width**2 / 4)))  # to both sides, over the width of the region
        if middle - covered > edge:
            reach = max(0.9 * covered, 0.5 * reach)
            continue
        discs.append(disc)
        shapes.append(vectors[:, :-1])
        edge, reach = middle + covered, 1.4 * covered
    _check_overlaps(discs)
    return _modes(pin, discs, shapes, edge, region.bound)


def _check_overlaps(discs):
    """What one disc found within another has to be found there as well."""
    for disc in discs:
        for other in discs:
            for s in disc.eigenvalues:
                if other.holds(s, 1e-3) and not np.any(abs(other.eigenvalues - s) < SAME * abs(s)):
                    raise RuntimeError(f"the eigenvalue {s:.6g} 1/s was not found from the shift {other.centre:.6g} 1/s")


def _modes(pin, discs, shapes, searched, bound):
    found, vectors = [], []
    for disc, columns in zip(discs, shapes):
        for s, u in zip(disc.eigenvalues, columns.T):
            if s.imag > abs(s.real) and not any(abs(s - other) < SAME * abs(s) for other in found):
                found.append(s)
                vectors.append(u / np.sqrt(np.vdot(u, pin.mass @ u).real))
    order = np.argsort([-s.real for s in found])
    eigenvalues, vectors = np.array(found)[order], np.array(vectors)[order].T
    residuals = np.array([residual(pin, s, u) for s, u in zip(eigenvalues, vectors.T)])
    return Modes(eigenvalues, vectors, residuals, discs, searched, bound)


def residual(pin, s, u):
    """|A(s) u| over the sum of the sizes of its three terms."""
    terms = [s**2 / (1 + pin.beta * s) * (pin.mass @ u), pin.stiffness @ u, -pin.mu / (1 + s * pin.delta) * (pin.friction @ u)]
    return np.linalg.norm(sum(terms)) / sum(np.linalg.norm(term) for term in terms)


def missed(pin, known, high, spacing=2 * np.pi * 5e3, largest=0.4):
    """How many eigenvalues with Re s > 0 and 0 < Im s < `high` (1/s) are not among `known`, by the argument principle: turns
    of det A(s) over the product of (s - known) around the region. Steps are halved until the phase turns less than
    `largest` (radians) in both halves."""
    region, bands = Region(pin), np.linspace(0, high, 21)
    right = max(region.width(*band) for band in zip(bands[:-1], bands[1:]))
    corners = [0j, complex(right, 0), complex(right, high), complex(0, high), 0j]
    turned = 0.
    for begin, end in zip(corners[:-1], corners[1:]):
        points = np.linspace(begin, end, 1 + max(8, int(abs(end - begin) / spacing)))
        phases = [_phase(pin, known, s) for s in points]
        turned += sum(_turned(pin, known, largest, *ends) for ends in zip(points[:-1], points[1:], phases[:-1], phases[1:]))
    return int(np.rint(turned / (2 * np.pi)))


def _turned(pin, known, largest, a, b, phase_a, phase_b):
    if abs(b - a) < 1e-6:
        raise RuntimeError(f"an eigenvalue lies on the contour at {a:.6g} 1/s")
    middle = (a + b) / 2
    phase = _phase(pin, known, middle)
    turns = np.angle([phase / phase_a, phase_b / phase])
    if max(abs(turns)) < largest:
        return turns.sum()
    return (_turned(pin, known, largest, a, middle, phase_a, phase)
            + _turned(pin, known, largest, middle, b, phase, phase_b))


def _phase(pin, known, s):
    """Of det A(s) over the product of (s - known), a number of size 1."""
    factors = linalg.splu(pin.operator(s))
    diagonal = factors.U.diagonal()
    away = s - known
    sign = _parity(factors.perm_r) * _parity(factors.perm_c)
    return sign * np.exp(1j * (np.angle(diagonal).sum() - np.angle(away).sum()))


def _parity(permutation):
    """+1 or -1."""
    left, cycles = np.ones(len(permutation), bool), 0
    for first in range(len(permutation)):
        if left[first]:
            cycles += 1
            while left[first]:
                left[first] = False
                first = permutation[first]
    return 1 - 2 * ((len(permutation) - cycles) % 2)
