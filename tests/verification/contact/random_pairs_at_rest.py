"""Random pairs of bodies of random phases, pressed on each other on random supports, in static contact, complex modes and modes, on one rank and on two.

The static solution is checked by what makes it one, with matrices written apart: no node of either body has a force left but those of the contact, which are
opposite on partners, or have weights where nodes do not match; these press and slide with mu times their pressure, or are apart. Complex eigenvalues are those of a descriptor system with the normal reactions
as multipliers, s M v = -K u - C v + B_n N + B_t q, B_n^T u = 0, (1 + s delta) q = mu N, by the QZ algorithm; on springs between the bodies N is k times their depth. B_n and B_t have the weights.
Modes of bodies that are apart, or touch without friction, are those of dense matrices without the normal displacements of the upper contact nodes."""

import csv
import tempfile

import h5py
import numpy as np
import scipy.linalg

from random_pairs import ROWS, field, random_side, write_volume
from random_supports import HX, NX, PLATEN_MASS, Body, basis, moved_by_platens, supports_of
from random_surfaces import weights
from scenes import Folder, prm

SEED, N_PAIRS, N_UNMATCHED = 4, 10, 9
HIGHEST, FASTEST, N_MODES = 4e5, 4e5, 8


class Half:
    """One of the two bodies at rest."""

    def __init__(self, random, is_counter, **columns):
        self.is_counter = is_counter
        self.body = Body(random, ROWS[is_counter], -ROWS[is_counter] * 0.6e-3 if is_counter else 0.0, **columns)
        self.supports = [random_side(name, random, ["free", "pressure", "springs", "absorbing", "platen"]) for name in ("Left", "Right")]
        name, kinds = ("Bottom", ["held", "springs"]) if is_counter else ("Top", ["pressure", "springs"])
        self.supports.append(random_side(name, random, kinds))
        for support in self.supports:
            if support.kind == "platen":
                continue
            support.held = [0, 1] if support.kind == "held" else [0] if support.name == "Top" and support.kind == "pressure" else []
            if support.kind == "springs":
                support.k = 10 ** random.uniform(12, 13.5, 2)
            if support.held == [0]:
                for values in (support.k, support.z, support.shear, support.rate):
                    values[0] = 0.0
        self.springs, self.dashpots, self.added, self.held, self.load = supports_of(self.body, self.supports)
        self.K = self.body.K + np.diag(self.springs)
        self.mass = self.body.mass + self.added
        self.C = self.body.K_beta + np.diag(self.body.drags(self.added))
        for dofs, of_side, _, _ in self.dashpots:
            self.C[dofs, dofs] += of_side
        self.contact = np.flatnonzero(self.body.j == (ROWS[1] if is_counter else 0))
        self.T = basis(self.body, self.supports, self.held)
        self.platens = [dofs for _, _, dofs in moved_by_platens(self.body, self.supports)]
        self.platen_mass = PLATEN_MASS * np.repeat([0, 1], [self.T.shape[1] - len(self.platens), len(self.platens)])

    def reduced(self):
        """K, C and M of the unknowns, of which the last ones are platens."""
        K, C, M = (self.T.T @ matrix @ self.T for matrix in (self.K, self.C, np.diag(self.mass)))
        return K, C, M + np.diag(self.platen_mass)

    def keys(self, analysis):
        start = "Counter body/" if self.is_counter else ""
        keys = {start + key: value for support in self.supports for key, value in support.keys(analysis).items()}
        if analysis == "complex modes":
            keys |= {start + (key.partition("/")[2] if start else key): value for key, value in self.body.damping_keys().items()}
        return keys | ({start + "RVE file": "counter/rve.h5", start + "Material": "heterogeneous"} if start else {"Body/RVE file": "body/rve.h5", "Body/Material": "heterogeneous"})

    def left(self, u, weight):
        """Forces that u leaves; of a platen one, of all its nodes."""
        force = self.load(0.0) + self.mass * np.tile(weight, len(u) // 2) - self.K @ u
        for dofs in self.platens:
            assert np.ptp(u[dofs]) < 1e-15 * np.abs(u).max(), u[dofs]
            force[dofs[0]], force[dofs[1:]] = force[dofs].sum(), 0
        return np.where(self.held, 0, force)


def check_statics(first, second, W, u, v, mu, weight, stiffness, sliding=True):
    """Returns which contact nodes touch, above what @p W gives of the nodes below. Without `sliding` these stick or slip against their relative displacement."""
    a, b = first.left(u, weight), second.left(v, weight)
    scale = np.abs(np.where(first.held, first.K @ u, 0)).max() + np.abs(first.load(0.0)).max()
    x, z = 2 * first.contact, 2 * second.contact
    pressed, tangential, gap = -a[x + 1], -a[x], u[x + 1] - W @ v[z + 1]
    for force, dofs in ((a, (x, x + 1)), (b, (z, z + 1))):
        inner = np.delete(force, np.concatenate(dofs))
        assert np.abs(inner).max() < 1e-7 * scale, np.abs(inner).max() / scale
    free = ~second.held[z + 1]
    assert np.abs(W.T @ a[x + 1] + b[z + 1])[free].max(initial=0) < 1e-7 * scale and np.abs(W.T @ a[x] + b[z])[~second.held[z]].max(initial=0) < 1e-7 * scale
    touching = pressed > 1e-6 * scale
    wanted = -pressed / stiffness if stiffness is not None else 0 * gap
    assert (pressed > -1e-7 * scale).all() and (gap > wanted - 1e-7 * np.abs(u).max()).all(), (pressed, gap)
    assert np.abs(gap - wanted)[touching].max() < 1e-7 * np.abs(u).max()
    if sliding:
        assert np.abs(tangential - mu * pressed).max() < 1e-6 * scale
    else:
        slip, sticks = u[x] - W @ v[z], np.abs(tangential) < mu * pressed - 1e-6 * scale
        assert (np.abs(tangential) < mu * pressed + 1e-6 * scale).all() and np.abs(slip[sticks]).max(initial=0) < 1e-7 * np.abs(u).max()
        assert (tangential * slip)[touching & ~sticks].max(initial=0) < 1e-7 * scale * np.abs(u).max(), (tangential, slip)
    return touching


def eigenvalues(first, second, W, touching, mu, delta, stiffness):
    K, C, M = (scipy.linalg.block_diag(*pair) for pair in zip(first.reduced(), second.reduced()))
    nodes, n = np.flatnonzero(touching), len(K)
    m = len(nodes)
    along, normal = (np.hstack([first.T[2 * first.contact + c], -W @ second.T[2 * second.contact + c]])[nodes].T for c in range(2))
    # u, v, N, q
    eye, no = np.eye, np.zeros
    A = np.block([[no((n, n)), eye(n), no((n, 2 * m))], [-K, -C, normal, along],
                  [normal.T, no((m, n)), np.diag(1 / stiffness[nodes]) if stiffness is not None else no((m, m)), no((m, m))], [no((m, 2 * n)), mu * eye(m), -eye(m)]])
    B = scipy.linalg.block_diag(eye(n), M, no((m, m)), delta * eye(m))
    scale = 1e6  # 1/s: balances u and v
    rows = np.concatenate([np.ones(n), 1 / np.full(n, np.abs(M).max() * scale), np.full(m, scale), np.ones(m)])
    A, B = rows[:, None] * A, rows[:, None] * B * scale
    columns = np.concatenate([np.full(n, 1 / scale), np.ones(n), np.full(2 * m, np.abs(M).max() * scale)])
    alpha, beta = scipy.linalg.eig(A * columns, B * columns, right=False, homogeneous_eigvals=True)
    finite = np.abs(beta) > 1e-9 * np.abs(alpha)
    s = scale * alpha[finite] / beta[finite]
    return s[(s.imag > 1e-3 * np.abs(s)) & (np.abs(s) < 1e9)]


def frequencies(first, second, W, touching):
    """In ascending order (Hz), with the number of rigid motions."""
    n = len(first.mass)
    K, M = scipy.linalg.block_diag(first.K, second.K), np.diag(np.concatenate([first.mass, second.mass]))
    T, normal = scipy.linalg.block_diag(first.T, second.T), 2 * first.contact + 1
    if touching:
        T[normal] = np.where(first.held[normal, None], 0, W @ T[n + 2 * second.contact + 1])
    used = np.abs(T).sum(0) > 0
    T, added = T[:, used], np.diag(np.concatenate([first.platen_mass, second.platen_mass])[used])
    squares = scipy.linalg.eigh(T.T @ K @ T, T.T @ M @ T + added, eigvals_only=True)
    n_rigid = (squares < 1e-9 * np.median(squares)).sum()
    return np.sqrt(squares[n_rigid:]) / (2 * np.pi), n_rigid


def check_modes(folder, first, second, W, ranks):
    """The largest error of the lowest frequencies."""
    folder.write("run.prm", prm({"Analysis": "modal", **first.keys("modal"), **second.keys("modal"), "Counter body/Position": repr(second.body.first),
                                 "Modal/Number of modes": N_MODES}))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "modal", "--quiet", ranks=ranks)
    summary, errors = folder.summary("modal"), []
    for bottom in ("free", "held"):
        wanted, n_rigid = frequencies(first, second, W, bottom == "held")
        assert summary["rigid_motions"][bottom] == n_rigid, (bottom, n_rigid)
        errors.append(np.abs(summary["frequencies"][bottom] / wanted[:N_MODES] - 1).max())
        assert errors[-1] < 1e-8, (bottom, errors, summary["frequencies"][bottom], wanted[:N_MODES])
    with h5py.File(folder("modal", "counter_body.h5")) as below, h5py.File(folder("modal", "modal.h5")) as above:
        u, v = above["modes/held/shape"][()].reshape(N_MODES, -1), below["modes/held/shape"][()].reshape(N_MODES, -1)
    assert np.abs(u[:, 2 * first.contact + 1] - v[:, 2 * second.contact + 1] @ W.T).max() < 1e-10
    return max(errors)


def check(folder, random, number, matched=True):
    columns = NX if matched else random.integers(2, 12)
    width = NX * HX + (0 if matched else random.choice([0.0, 1e-3]))
    first, second = Half(random, False), Half(random, True, columns=columns, hx=width / columns, first=(NX * HX - width) * random.random())
    places = [half.body.first + half.body.hx * half.body.i[half.contact] for half in (first, second)]
    W = np.eye(NX + 1) if matched else weights(*places, 0.0)
    weight = random.uniform(-1, 1, 2) * 1e6
    mu, delta = random.choice([0.0, 0.3]), random.choice([0.0, 2e-6])
    stiffness = random.choice([0, 1]) * np.where((np.arange(NX + 1) % NX) == 0, 0.5, 1) * HX * 2e13
    stiffness = stiffness if stiffness.any() and (matched or number % 3 == 0) else None
    for half, name in ((first, "body"), (second, "counter")):
        write_volume(folder, name, half)
    common = {"Flat/Velocity": 2, "Friction/Coefficient": mu, "Body/Acceleration": "%.17g, %.17g" % tuple(weight), "Static contact/Tolerance": 1e-10,
              "Counter body/Position": repr(second.body.first),
              **({} if stiffness is None else {"Flat/Normal stiffness": 2e13})}
    errors = []
    for ranks in (1, 2):
        of_modes = check_modes(folder, first, second, W, ranks)
        folder.write("run.prm", prm({"Analysis": "static contact", **first.keys("static contact"), **second.keys("static contact"), **common}))
        try:
            folder.run(0, "contact_dynamics", "run.prm", "--output", "run", "--quiet", ranks=ranks)
        except AssertionError as refusal:
            if ranks > 1 or not any(words in str(refusal) for words in ("lifts off or tips", "there is no equilibrium", "has to be positive (pressing)")):
                raise
            return 0
        u, v = (field(folder, name)[0] for name in ("dynamics.h5", "counter_body.h5"))
        touching = check_statics(first, second, W, u, v, mu, weight, stiffness)
        folder.run(0, "contact_dynamics", "run.prm", "--output", "still", "--quiet", "--set", "Flat/Velocity=0", ranks=ranks)
        still = [field(folder, name, "still")[0] for name in ("dynamics.h5", "counter_body.h5")]
        check_statics(first, second, W, *still, mu, weight, stiffness, False)
        folder.write("run.prm", prm({"Analysis": "complex modes", **first.keys("complex modes"), **second.keys("complex modes"), **common,
                                     **({"Friction/Regularization time": delta} if delta else {"Friction/Law": "coulomb"}), "Complex modes/Highest frequency": HIGHEST, "Complex modes/Fastest decay": FASTEST}))
        folder.run(0, "contact_dynamics", "run.prm", "--output", "modes", "--quiet", ranks=ranks)
        rows = list(csv.DictReader(folder.read("modes", "complex_modes.csv").decode().splitlines()))
        found = np.array([float(row["growth_rate [1/s]"]) + 2j * np.pi * float(row["frequency [Hz]"]) for row in rows])
        expected = eigenvalues(first, second, W, touching, mu, delta, stiffness)
        wanted = expected[(expected.imag < 2 * np.pi * HIGHEST * 0.999) & (expected.real > -0.999 * FASTEST) & (expected.imag > 1.001 * -expected.real)]
        errors.append(max([0.0] + [np.abs(found / s - 1).min() for s in wanted] + [np.abs(expected / s - 1).min() for s in found]))
        n_modes = len(found)
        what = (number, ranks, mu, delta, stiffness is not None, [(s.name, s.kind) for s in first.supports + second.supports])
        assert errors[-1] < 1e-6, (*what, errors, np.sort_complex(found), np.sort_complex(wanted))
        assert folder.summary("modes")["separated_nodes"] == len(touching) - touching.sum()
    print(number, f"mu {mu}, delta {delta}, {'' if matched else f'{columns} cells below on {1e3 * width:.2f} mm, '}{'springs, ' if stiffness is not None else ''}{touching.sum()} of {len(touching)} touch, {n_modes} complex modes, {max(errors):.1e}, modes {of_modes:.1e}",
          [s.kind for s in first.supports + second.supports])
    return n_modes


def main():
    print("seed", SEED)
    random = np.random.default_rng(SEED)
    with tempfile.TemporaryDirectory() as path:
        n_modes = [check(Folder(path), random, number, number < N_PAIRS) for number in range(N_PAIRS + N_UNMATCHED)]
    assert sum(n_modes[:N_PAIRS]) > N_PAIRS and sum(n_modes[N_PAIRS:]) > N_UNMATCHED, n_modes


if __name__ == "__main__":
    main()
