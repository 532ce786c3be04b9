"""Random pairs of bodies whose nodes do not match, at rest below each other or sliding on, against a dense code written apart, in numpy, step by step: plane grids of
random phases, widths and numbers of cells on random supports, with and without friction, on one rank and on two, and continued from the middle.

Weights are integrals by the trapezoids' corners of both surfaces and Gauss' rule between them, with the dual functions of each edge by its 2 x 2 system; forces of a
step are found by trying which nodes touch, and which of these stick, until all conditions hold. Displacements of both bodies agree to 1e-10 of the largest."""

import numpy as np

from random_pairs import DT, GAP, N_STEPS, Half, check_all, compare, keys_of, prepare

SEED, N_PAIRS = 45, 12
WIDTH, VELOCITY = 6e-3, 400.0  # of the body; of the flat, so that it comes over more than a node


def edges_of(x, by=0.0):
    return [((k, k + 1), (x[k] + by, x[k + 1] + by)) for k in range(len(x) - 1)]


def weights(upper, lower, way):
    """W of nodes at @p upper over those at @p lower, which moved by @p way."""
    n, m = len(upper), len(lower)
    below = edges_of(lower, way)
    points, shares = np.polynomial.legendre.leggauss(3)
    W, area = np.zeros((n, m)), np.zeros(n)
    for (i, k), (a, b) in edges_of(upper):
        squares, products = np.zeros((2, 2)), np.zeros((2, m))
        for nodes, (c, d) in below:
            start, end = max(a, c), min(b, d)
            for point, share in zip(points, shares):
                if end > start:
                    x = (start + end) / 2 + point * (end - start) / 2
                    phi = np.array([b - x, x - a]) / (b - a)
                    squares += share * (end - start) / 2 * np.outer(phi, phi)
                    for node, value in zip(nodes, ((d - x) / (d - c), (x - c) / (d - c))):
                        products[:, node] += share * (end - start) / 2 * phi * value
        psi = np.linalg.solve(squares, np.diag(squares.sum(axis=1))).T
        W[[i, k]] += psi @ products
        area[[i, k]] += squares.sum(axis=1)
    return W / area[:, None]


def pushed(G, gap):
    """Normal forces f >= 0 with gap + G f >= 0, one of which is 0 at each node."""
    touching = gap < 0
    for _ in range(200):
        f = np.zeros(len(gap))
        f[touching] = np.linalg.solve(G[np.ix_(touching, touching)], -gap[touching])
        after = gap + G @ f
        wrong = np.where(touching, f < 0, after < -1e-13 * np.abs(gap).max())
        if not wrong.any():
            return f
        touching = touching ^ wrong
    raise AssertionError("no normal forces")


def dragged(G, slip, limit):
    """Tangential forces within the limit, with which what slips is 0 or drags as much as it may."""
    kind = np.zeros(len(slip), int)  # 0: sticks, else the sign of the force
    for _ in range(500):
        f = kind * limit
        sticks = kind == 0
        f[sticks] = np.linalg.solve(G[np.ix_(sticks, sticks)], -(slip + G @ f)[sticks])
        after = slip + G @ f
        rounding = 1e-13 * np.abs(slip).max()
        new = np.where(sticks, np.where(np.abs(f) > limit, np.sign(f), 0), np.where(kind * after > rounding, 0, kind)).astype(int)
        if (new == kind).all():
            return f
        kind = new
    raise AssertionError("no tangential forces")


def run(first, second, mu, slides):
    """Displacements of both before each step."""
    upper, lower = (half.body.first + half.body.hx * half.body.i[half.contact] for half in (first, second))
    states, touched, way = [(first.u, second.u)], 0, 0.0
    W = weights(upper, lower, 0.0)
    for step in range(N_STEPS):
        if slides:
            way += VELOCITY * DT
            W = weights(upper, lower, way)
        a, b = first.free(step * DT), second.free(step * DT)
        force = []
        for c in (1, 0):
            x, y = 2 * first.contact + c, 2 * second.contact + c
            G = np.diag(first.inverse[x]) + W @ np.diag(second.inverse[y]) @ W.T
            rate = first.w[x] + DT * a[x] - W @ (second.w[y] + DT * b[y])
            if c == 1:
                force.append(pushed(G, (GAP + first.u[x] - W @ second.u[y] + DT * rate) / DT**2))
            else:
                force.append(dragged(G, (rate - VELOCITY) / DT, mu * force[0]))
        touched += (force[0] > 0).sum()
        for c, f in zip((1, 0), force):
            a[2 * first.contact + c] += first.inverse[2 * first.contact + c] * f
            y = 2 * second.contact + c
            b[y] -= second.inverse[y] * (W.T @ f)
        first.move(a)
        second.move(b)
        states.append((first.u, second.u))
    return states, touched


def check(folder, random, number):
    slides = number % 3 > 0
    way = VELOCITY * DT * N_STEPS if slides else 0.0
    columns, width = random.integers(3, 12), WIDTH + way + random.choice([0.0, 1e-3])
    position = -way - (width - way - WIDTH) * random.random()
    first = Half(random, False)
    second = Half(random, True, columns=columns, hx=width / columns, first=position)
    weight, mu = prepare(folder, random, first, second)
    expected, touched = run(first, second, mu, slides)
    keys = {**keys_of(first, second, weight, mu), "Flat/Velocity": VELOCITY, "Counter body/Position": repr(position), "Counter body/Sliding": "finite" if slides else "small"}
    error, residual = compare(folder, keys, expected, (number, mu, slides, columns, [(s.name, s.kind) for s in first.supports + second.supports]))
    print(number, mu, f"{columns} cells on {1e3 * width:.2f} mm", f"{touched / N_STEPS / len(first.contact):.2f} touch, {error:.1e}, balance {residual:.1e}")


if __name__ == "__main__":
    check_all(check, SEED, N_PAIRS)
