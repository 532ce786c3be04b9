"""Random supports at the left, the right and the top against a dense code written apart, in numpy: modes, the static body pressed on the flat, and
every step of runs that land on it, of random phase maps as a plane grid and as a mesh of the same cells, on one rank and on two or three.

Each side is free, held, under a pressure, on springs with dashpots, mass and a far end that moves, absorbs waves, or is a platen, also on springs.
Every pair of kinds meets at opposite sides. Damping is that of all phases or differs by phase, and bodies about whose steady sliding complex modes vibrate are dragged by friction. Modes
agree to 1e-8, static displacements to 1e-7 and steps to 1e-10 of the largest, in single precision to 2e-5."""

import csv
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import Folder, prm

SEED, N_BODIES = 2044, 10
NX, NY, HX, HY = 6, 5, 1.0e-3, 0.6e-3
STIFFNESS = [[32e9, 8e9, 32e9, 12e9], [80e9, 20e9, 70e9, 30e9]]  # D11, D12, D22, D33
DENSITY = [1770.0, 2500.0]
PRESSURE, GAP, PLATEN_MASS = 4e6, 2e-9, 0.004
DT, N_STEPS = 2e-8, 150
HIGHEST, FASTEST = 5e5, 1e6  # of complex modes (Hz, 1/s)
BETA, ALPHA = 3e-9, 2e4
BY_PHASE = ((3e-9, 1.1e-8), (5e4, 1e4))  # beta (s), alpha (1/s)


class Body:
    """Of two phases in cells of hx x HY from x = @p first and y = @p lowest on; node k = j (columns + 1) + i, degree of freedom 2 k + c."""

    def __init__(self, random, rows=NY, lowest=0.0, columns=NX, hx=HX, first=0.0):
        self.rows, self.lowest, self.columns, self.hx, self.first = rows, lowest, columns, hx, first
        self.phases = random.choice(2, size=(rows, columns))
        self.i, self.j = (a.ravel() for a in np.meshgrid(np.arange(columns + 1), np.arange(rows + 1)))
        n = 2 * len(self.i)
        self.K, self.mass, self.K_beta, self.alpha_mass = np.zeros((n, n)), np.zeros(n), np.zeros((n, n)), np.zeros(n)
        self.betas, self.alphas = ([of_phases, (of_all, of_all)][random.choice(2)] for of_phases, of_all in zip(BY_PHASE, (BETA, ALPHA)))
        points = (0.5 - 0.5 / 3**0.5, 0.5 + 0.5 / 3**0.5)
        for row in range(rows):
            for column in range(columns):
                a, b, c, d = STIFFNESS[self.phases[row, column]]
                first = row * (columns + 1) + column
                nodes = np.array([first, first + 1, first + columns + 1, first + columns + 2])
                dofs = (2 * nodes[:, None] + np.arange(2)).ravel()
                for x in points:
                    for y in points:
                        B = np.zeros((3, 8))
                        B[0, 0::2] = B[2, 1::2] = np.array([y - 1, 1 - y, -y, y]) / hx
                        B[1, 1::2] = B[2, 0::2] = np.array([x - 1, -x, 1 - x, x]) / HY
                        of_cell = hx * HY / 4 * B.T @ np.array([[a, b, 0], [b, c, 0], [0, 0, d]]) @ B
                        self.K[np.ix_(dofs, dofs)] += of_cell
                        self.K_beta[np.ix_(dofs, dofs)] += self.betas[self.phases[row, column]] * of_cell
                mass = DENSITY[self.phases[row, column]] * hx * HY / 4
                self.mass[dofs] += mass
                self.alpha_mass[dofs] += self.alphas[self.phases[row, column]] * mass

    def drags(self, added):
        """alpha M; that of all phases acts on masses of supports as well."""
        return self.alpha_mass + (ALPHA if self.alphas[0] == self.alphas[1] else 0) * added

    def damping_keys(self):
        """One value for all phases, or a list."""
        values = [", ".join(map(str, of_phases)) if of_phases[0] != of_phases[1] else of_phases[0] for of_phases in (self.betas, self.alphas)]
        return {"Time/Rayleigh beta": values[0], "Body/Rayleigh alpha": values[1]}

    def dragged(self, mu, touching):
        """What adds to the forces on nodes that slide along x the friction of their reactions."""
        drag = np.eye(len(self.mass))
        for node in np.flatnonzero(self.j == 0)[touching]:
            drag[2 * node, 2 * node + 1] = -mu
        return drag

    def side(self, name):
        """Its nodes, their lengths, the axis of its normal, the sign of the normal into the body, and the diagonals of its impedances."""
        axis = 1 if name in ("Top", "Bottom") else 0
        at = {"Left": self.i == 0, "Right": self.i == self.columns, "Top": self.j == self.rows, "Bottom": self.j == 0}[name]
        nodes, h = np.flatnonzero(at), self.hx if axis else HY
        cells = {"Left": self.phases[:, 0], "Right": self.phases[:, -1], "Top": self.phases[-1], "Bottom": self.phases[0]}[name]
        waves = np.array([np.sqrt(DENSITY[p] * np.array([STIFFNESS[p][2 * axis], STIFFNESS[p][3]])) for p in cells])  # P, S
        if axis:
            waves = waves[:, ::-1]
        length, impedance = np.zeros(len(nodes)), np.zeros((len(nodes), 2))
        for cell, Z in enumerate(waves):
            for node in (cell, cell + 1):
                length[node] += h / 2
                impedance[node] += h / 2 * Z
        return nodes, length, axis, 1 if name in ("Left", "Bottom") else -1, impedance / length[:, None]

    def carried(self, support):
        """side() of what carries the load of a support: platens at the left and the right move all but the corners, and have the whole side."""
        nodes, length, axis, sign, impedance = self.side(support.name)
        if support.kind == "platen" and support.name != "Top":
            nodes, length, impedance = nodes[1:-1], length[1:-1] * length.sum() / length[1:-1].sum(), impedance[1:-1]
        return nodes, length, axis, sign, impedance

    def write(self, folder):
        Box([NX * HX * 1e3, NY * HY * 1e3], [NX, NY], lambda x: "ab"[self.phases[min(int(x[1] / HY * 1e-3), NY - 1), min(int(x[0] / HX * 1e-3), NX - 1)]],
            "cube").name_side("Contact", 1, False).name_side("Top", 1, True).name_side("Left", 0, False).name_side("Right", 0, True).write(folder("body.msh"))


class Support:
    """What one side stands on."""

    def __init__(self, name, kind, random):
        self.name, self.kind = name, kind
        self.k, self.z, self.mass, self.motion, self.pressure, self.held = np.zeros(2), np.zeros(2), 0.0, [0.0, 0.0], 0.0, []
        self.shear, self.rate = np.zeros(2), np.zeros(2)  # traction: shear[c] (1 + 100 x + 200 y) + rate[c] t
        if kind == "springs":
            self.k, self.z = 10 ** random.uniform(11, 13.5, 2), 10 ** random.uniform(4, 7, 2)
            self.mass, self.motion = random.choice([0.0, 1.5]), [random.uniform(-1e-8, 1e-8), random.uniform(-1e-2, 1e-2)]
        if kind in ("springs", "pressure", "absorbing", "platen"):
            self.pressure = PRESSURE if name == "Top" else random.uniform(-0.3, 0.5) * PRESSURE * (kind != "platen" or random.random() < 0.5)
            if kind != "platen" and random.random() < 0.5:
                self.shear, self.rate = random.uniform(-0.2, 0.2, 2) * PRESSURE * (random.random(2) < 0.7), random.uniform(-1e11, 1e11, 2) * (random.random(2) < 0.7)
        if kind == "platen" and random.random() < 0.7:
            self.k = 10 ** random.uniform(11, 13.5, 2) * (random.random(2) < 0.7)
            self.z, self.motion = 10 ** random.uniform(4, 6, 2) * (self.k > 0), [random.uniform(-1e-8, 1e-8), random.uniform(-1e-2, 1e-2)]
        if kind == "held":
            self.held = [0, 1]
        elif kind == "platen":
            across = 0 if name == "Top" else 1
            self.held = [across] if self.k[across] == 0 else []
        elif random.random() < 0.3 and (name != "Top" or kind in ("pressure", "springs", "absorbing")):
            self.held = [0] if name == "Top" or kind == "free" else [1]
            for values in (self.k, self.z, self.shear, self.rate):  # where it is held they would have no effect
                values[self.held[0]] = 0.0
            if name == "Top":
                self.k[0] = 0.0

    def far(self, t):
        """Displacement of the far end."""
        return np.array([self.motion[0] + self.motion[1] * t, self.motion[0] - self.motion[1] * t])

    def traction(self, x, y, t):
        """By component, at places."""
        return [self.shear[c] * (1 + 100 * x + 200 * y) + self.rate[c] * t for c in range(2)]

    def keys(self, analysis):
        start = f"Supports/{self.name}/"
        result = {start + "Kind": "free" if self.kind == "pressure" and analysis == "modal" and self.name != "Top" else self.kind}
        if self.kind == "platen" and analysis != "static contact":
            result[start + "Platen mass"] = PLATEN_MASS
        if self.held and self.kind not in ("held", "platen"):
            result[start + "Held"] = ", ".join("u_" + "xy"[c] for c in self.held)
        if self.pressure and analysis != "modal":
            result[start + "Pressure"] = self.pressure
        if analysis != "modal" and (self.shear.any() or self.rate.any()):
            result[start + "Traction"] = "; ".join(" + ".join([f"{s:.17g}*(1 + 100*x + 200*y)"] * bool(s) + [f"{r:.17g}*t"] * bool(r)) or "0"
                                                   for s, r in zip(self.shear, self.rate)).replace("+ -", "- ")
        if self.kind == "springs":
            result[start + "Mass"] = self.mass
        if self.kind == "springs" or self.k.any():
            result[start + "Spring stiffness"] = "%.17g, %.17g" % tuple(self.k)
            if analysis != "modal":
                moves = ("%.17g + %.17g*t" % tuple(self.motion), "%.17g - %.17g*t" % tuple(self.motion))
                result[start + "Motion"] = "; ".join(text if self.k[c] > 0 else "0" for c, text in enumerate(moves))
            if analysis in ("transient", "complex modes"):
                result[start + "Dashpot"] = "%.17g, %.17g" % tuple(self.z)
        return result


def supports_of(body, supports):
    """Springs, dashpots and added masses of all degrees of freedom, which are held, and the force of pressures and far ends at a time."""
    n = len(body.mass)
    springs, dashpots, added, held = np.zeros(n), [], np.zeros(n), np.zeros(n, bool)
    for support in supports:
        nodes, length, axis, sign, impedance = body.carried(support)
        for c in range(2):
            dofs = 2 * nodes + c
            springs[dofs] += length * support.k[c]
            dashpots.append((dofs, length * (impedance[:, c] if support.kind == "absorbing" else support.z[c]), support, c))
            added[dofs] += length * support.mass
            held[dofs] |= c in support.held

    def load(t):
        force = np.zeros(n)
        for support in supports:
            nodes, length, axis, sign, _ = body.carried(support)
            force[2 * nodes + axis] += sign * length * support.pressure
            for c in range(2):
                force[2 * nodes + c] += length * (support.k[c] * support.far(t)[c] + support.traction(body.first + body.i[nodes] * body.hx, body.lowest + body.j[nodes] * HY, t)[c])
        return force

    return springs, dashpots, added, held, load


def moved_by_platens(body, supports):
    """For each component in which a platen moves its support, the component, and the degrees of freedom that are one."""
    return [(support, c, 2 * body.carried(support)[0] + c) for support in supports for c in range(2) if support.kind == "platen" and c not in support.held]


def basis(body, supports, held):
    """From unknowns to degrees of freedom; the last unknowns are those of platens."""
    together = [np.isin(np.arange(len(held)), dofs) for _, _, dofs in moved_by_platens(body, supports)]
    return np.hstack([np.eye(len(held))[:, ~held & ~np.any([held & False, *together], axis=0)], *[some[:, None] for some in together]])


def with_platens(mass, body, supports):
    """The masses of the unknowns of basis()."""
    n = len(moved_by_platens(body, supports))
    return mass + PLATEN_MASS * (np.arange(len(mass)) >= len(mass) - n)


def modes(body, supports):
    springs, _, added, held, _ = supports_of(body, supports)
    T = basis(body, supports, held)
    mass = with_platens(T.T @ (body.mass + added), body, supports)
    root = 1 / np.sqrt(mass)
    squares = np.linalg.eigvalsh(root[:, None] * (T.T @ (body.K + np.diag(springs)) @ T) * root)
    return np.sqrt(squares[squares > 1e-9 * squares[-1]]) / (2 * np.pi)


def statics(body, supports, weight, mu=0.0):
    """Displacement on a flat that slides, and which bottom nodes touch it: they leave it where they would be pulled. None where a part of the
    body may float."""
    springs, _, added, held, load = supports_of(body, supports)
    K, force, bottom = body.K + np.diag(springs), load(0.0) + (body.mass + added) * np.tile(weight, len(body.mass) // 2), 2 * np.flatnonzero(body.j == 0) + 1
    touching = np.ones(len(bottom), bool)
    for _ in range(100):
        fixed = held.copy()
        fixed[bottom[touching]] = True
        T, drag = basis(body, supports, fixed), body.dragged(mu, touching & ~held[bottom])
        A = T.T @ drag @ K @ T
        if np.linalg.cond(A) > 1e11:
            return None
        u = T @ np.linalg.solve(A, T.T @ drag @ force)
        reaction = (K @ u - force)[bottom]
        now = np.where(held[bottom], True, np.where(touching, reaction > 0, u[bottom] < 0))
        if now[~held[bottom]].sum() < 2:  # it lifts off, or tips
            return None
        if np.array_equal(now, touching):
            return u, touching
        touching = now
    return None


def complex_modes(body, supports, touching, mu):
    """Eigenvalues above the real axis (1/s) about sliding: no touching node leaves the flat."""
    springs, dashpots, added, held, _ = supports_of(body, supports)
    bottom = 2 * np.flatnonzero(body.j == 0) + 1
    fixed, C, drag = held.copy(), np.diag(body.drags(added)) + body.K_beta, body.dragged(mu, touching & ~held[bottom])
    fixed[bottom[touching]] = True
    for dofs, Z, _, _ in dashpots:
        C[dofs, dofs] += Z
    T = basis(body, supports, fixed)
    K, C, mass = T.T @ drag @ (body.K + np.diag(springs)) @ T, T.T @ drag @ C @ T, with_platens(T.T @ (body.mass + added), body, supports)
    n = len(mass)
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-K / mass[:, None], -C / mass[:, None]]])
    s = np.linalg.eigvals(A)
    return s[s.imag > 1e-6 * np.abs(s).max()]


def run(body, supports, velocity, weight):
    """Displacements before each step. Dashpots act on w + dt a / 2; without friction the flat pushes so that no node is below it after the step."""
    springs, dashpots, added, held, load = supports_of(body, supports)
    n, m, Z, pull = len(body.mass), body.mass + added, np.zeros(len(body.mass)), np.zeros(len(body.mass))
    for dofs, of_side, support, c in dashpots:
        Z[dofs] += of_side
        pull[dofs] += of_side * (support.far(1.0) - support.far(0.0))[c]
    drags = body.drags(added)
    inertia, bottom = m + 0.5 * DT * (drags + Z), 2 * np.flatnonzero(body.j == 0) + 1
    assert (DT * Z < 2 * m).all()
    platens = moved_by_platens(body, supports)
    v, g = np.tile(velocity, n // 2), np.tile(weight, n // 2)
    at_start = g + (load(0.0) + pull - Z * v) / m
    at_start -= drags / m * v
    for _, _, dofs in platens:
        at_start[dofs] = m[dofs] @ at_start[dofs] / (m[dofs].sum() + PLATEN_MASS)
    u, w = np.zeros(n), v - 0.5 * DT * at_start
    w[held] = 0
    states = [u]
    for step in range(N_STEPS):
        force = load(step * DT) + pull + m * g - springs * u - body.K @ u - body.K_beta @ w - (Z + drags) * w
        a = np.where(held, 0, force / inertia)
        for _, _, dofs in platens:
            a[dofs] = force[dofs].sum() / (inertia[dofs].sum() + PLATEN_MASS)
        for k in bottom[~held[bottom]]:
            a[k] = max(a[k], ((-GAP - u[k]) / DT - w[k]) / DT)
        w = w + DT * a
        u = u + DT * w
        states.append(u)
    return np.array(states)


KINDS = ["free", "pressure", "held", "springs", "absorbing", "platen"]


def random_supports(random, analysis, pair):
    """With this pair of kinds at the left and the right."""
    chosen = [Support(name, kind, random) for name, kind in zip(("Left", "Right"), pair)]
    kinds = KINDS if analysis in ("modal", "transient") else ["pressure", "springs", "platen"]
    top = Support("Top", random.choice([kind for kind in kinds if kind != "platen" or "held" not in pair]), random)
    for side in chosen:
        if top.kind == "platen" and side.kind != "platen":  # which moves the corners
            side.held = [c for c in side.held if c == 0 and c in top.held]
    return chosen + [top]


def keys(body, name, supports, analysis):
    result = {"Analysis": analysis}
    for support in supports:
        result |= support.keys(analysis)
    if name == "single":
        result["Time/Precision"] = name
    if name != "mesh":
        result |= {"Body/RVE file": "rve/rve.h5", "Body/Material": "heterogeneous"}
    else:
        result |= {"Mesh/File": "body.msh", "Mesh/Scale": 0.001, "Phases/Names": "a, b"}
        for phase in range(2):
            result |= {f"Phases/{'ab'[phase]}/Type": "stiffness", f"Phases/{'ab'[phase]}/Density": DENSITY[phase],
                       f"Phases/{'ab'[phase]}/Stiffness": ", ".join(map(str, STIFFNESS[phase]))}
    return result


def field(folder, run_name, body):
    """Snapshots [time][2 k + c] in the order of the nodes of the body."""
    with h5py.File(folder(run_name, "dynamics.h5")) as file:
        values = file["snapshots/displacement"][()]
        if "mesh" in file:
            points = file["mesh/points"][()]
            order = np.lexsort((np.round(points[:, 0] / HX), np.round(points[:, 1] / HY)))
            values = values[:, order]
    return values.reshape(len(values), -1)


def check(folder, random, number, pairs):
    """A body in each analysis, with a pair of kinds that is left or, when none is, any; removes from `pairs` what was compared."""
    body = Body(random)
    body.write(folder)
    np.savetxt(folder("map.txt"), body.phases[::-1], fmt="%d")  # an image: top row first
    settings = {"Grid/Cells": f"{NX}, {NY}", "Grid/Spacing": f"{HX}, {HY}", "Phases/Names": "a, b", "Microstructure/Type": "image",
                "Microstructure/File": "map.txt", "Microstructure/Oblong pixels": "true", "Homogenization/Boundary conditions": "KUBC"}
    for phase in range(2):
        settings |= {f"Phases/{'ab'[phase]}/Type": "stiffness", f"Phases/{'ab'[phase]}/Density": DENSITY[phase],
                     f"Phases/{'ab'[phase]}/Stiffness": ", ".join(map(str, STIFFNESS[phase]))}
    folder.write("rve.prm", prm(settings))
    folder.run(0, "rve_homogenization", "rve.prm", "--output", "rve", "--quiet")
    errors = {}
    for analysis in ("modal", "static contact", "complex modes", "transient"):
        open_pairs = [pair for pair in pairs if analysis != "modal" or "pressure" not in pair]  # modes know no pressure
        pair = open_pairs[0] if open_pairs else tuple(random.choice(KINDS, 2))
        supports = random_supports(random, analysis, pair)
        velocity, weight = random.uniform(-1, 1, 2) * [0.5, 1.0], random.uniform(-1, 1, 2) * 1e5
        if analysis == "modal":
            expected, more = modes(body, supports), {"Modal/Bottom": "free", "Modal/Number of modes": 5, "Modal/Tolerance": 1e-12}
        elif analysis == "static contact":
            expected, more = (statics(body, supports, 5 * weight) or [None])[0], {
                "Flat/Velocity": 0, "Friction/Coefficient": 0, "Static contact/Tolerance": 1e-11, "Body/Acceleration": "%.17g, %.17g" % tuple(5 * weight)}
        elif analysis == "complex modes":
            mu = random.choice([0.0, 0.25])
            state = statics(body, supports, 5 * weight, mu)
            expected = None if state is None else complex_modes(body, supports, state[1], mu)
            more = {"Friction/Coefficient": mu, "Friction/Regularization time": 0, **body.damping_keys(),
                    "Body/Acceleration": "%.17g, %.17g" % tuple(5 * weight), "Complex modes/Highest frequency": HIGHEST,
                    "Complex modes/Fastest decay": FASTEST}
        else:
            expected = run(body, supports, velocity, weight)
            more = {"Flat/Velocity": 1, "Flat/Gap": GAP, "Friction/Coefficient": 0, "Time/Time step": DT, "Time/End time": N_STEPS * DT,
                    **body.damping_keys(), "Body/Initial velocity": "%.17g, %.17g" % tuple(velocity),
                    "Body/Acceleration": "%.17g, %.17g" % tuple(weight), "Snapshots/Interval": DT, "Friction/Regularization time": 0}
        if expected is None:
            continue
        if pair in pairs:
            pairs.remove(pair)
        for name in ("grid", "single", "mesh") if analysis == "transient" else ("grid", "mesh"):
            for ranks in (1, 2 + number % 2):
                folder.write("run.prm", prm({**keys(body, name, supports, analysis), **more}))
                folder.run(0, "contact_dynamics", "run.prm", "--output", analysis, "--quiet", ranks=ranks)
                what = (number, analysis, name, ranks, [(s.name, s.kind, s.held) for s in supports])
                if analysis == "complex modes":
                    rows = list(csv.DictReader(folder.read(analysis, "complex_modes.csv").decode().splitlines()))
                    found = np.array([float(row["growth_rate [1/s]"]) + 2j * np.pi * float(row["frequency [Hz]"]) for row in rows])
                    wanted = expected[(expected.imag < 2 * np.pi * HIGHEST * 0.999) & (expected.real > -0.999 * FASTEST) & (expected.imag > 1.001 * -expected.real)]
                    error = max([np.abs(found / s - 1).min() for s in wanted] + [np.abs(expected / s - 1).min() for s in found] + [0.0])
                    assert error < 1e-6, (*what, found, wanted)
                elif analysis == "modal":
                    rows = csv.DictReader(folder.read(analysis, "modes.csv").decode().splitlines())
                    found = np.array([float(row["frequency [Hz]"]) for row in rows])
                    error = np.abs(found / expected[:len(found)] - 1).max()
                    assert len(found) == 5 and error < 1e-8, (*what, found, expected[:5])
                else:
                    found = field(folder, analysis, body)
                    wanted = expected[None] if analysis == "static contact" else expected[:len(found)]
                    error = np.abs(found - wanted).max() / np.abs(wanted).max()
                    assert error < (1e-7 if analysis == "static contact" else 2e-5 if name == "single" else 1e-10), (*what, error)
                kind = name if name == "single" else analysis
                errors[kind] = max(error, errors.get(kind, 0.0))
    print(number, errors, len(pairs), "pairs left")


def main():
    print("seed", SEED)
    random = np.random.default_rng(SEED)
    pairs = [(left, right) for left in KINDS for right in KINDS]
    random.shuffle(pairs)
    with tempfile.TemporaryDirectory() as path:
        for number in range(N_BODIES):
            check(Folder(path), random, number, pairs)
    assert not pairs, pairs


if __name__ == "__main__":
    main()
