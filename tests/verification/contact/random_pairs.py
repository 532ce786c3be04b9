"""Random pairs of bodies that slide on each other against a dense code written apart, in numpy, step by step: two plane grids of random phases
on random supports, with and without friction, that meet in some steps, on one rank and on two, and continued from the middle.

Partners are nodes at the same place. With the inertias m1 and m2 a contact force f changes their relative acceleration by (1/m1 + 1/m2) f: the normal one
is that with which the gap is not negative after the step, the tangential one that with which the relative velocity is that of the flat, up to mu times
the normal one. Displacements of both bodies agree to 1e-10 of the largest."""

import tempfile

import h5py
import numpy as np

from random_supports import DENSITY, HY, STIFFNESS, Body, Support, supports_of
from scenes import Folder, prm

SEED, N_PAIRS = 44, 12
DT, N_STEPS, GAP, VELOCITY = 2e-8, 200, 2e-9, 2.0
ROWS = (5, 3)  # of the body and of the counter body


def random_side(name, random, kinds):
    support = Support(name, random.choice(kinds), random)
    support.pressure *= 0 if name == "Bottom" else 1
    if support.kind == "pressure" and not (support.pressure or support.shear.any() or support.rate.any()):
        support.kind = "free"
    return support


class Half:
    """One of the two bodies, with its supports, as matrices."""

    def __init__(self, random, is_counter, **columns):
        self.body = Body(random, ROWS[is_counter], -ROWS[is_counter] * HY if is_counter else 0.0, **columns)
        self.supports = [random_side(name, random, ["free", "pressure", "springs", "absorbing"]) for name in ("Left", "Right")]
        kinds = ["held", "springs", "absorbing"] if is_counter else ["pressure", "springs", "absorbing"]
        self.supports.append(random_side("Bottom" if is_counter else "Top", random, kinds))
        for support in self.supports:
            support.held = [] if support.kind != "held" else [0, 1]
        self.velocity = random.uniform(-1, 1, 2) * [0.5, 1.0]
        self.springs, self.dashpots, self.added, self.held, self.load = supports_of(self.body, self.supports)
        n = len(self.body.mass)
        self.Z, self.pull = np.zeros(n), np.zeros(n)
        for dofs, of_side, support, c in self.dashpots:
            self.Z[dofs] += of_side
            self.pull[dofs] += of_side * (support.far(1.0) - support.far(0.0))[c]
        self.m = self.body.mass + self.added
        assert (DT * self.Z < 2 * self.m).all()
        self.drags = self.body.drags(self.added)
        self.inertia = self.m + 0.5 * DT * (self.drags + self.Z)
        self.inverse = np.where(self.held, 0, 1 / self.inertia)
        row = ROWS[1] if is_counter else 0
        self.contact = np.flatnonzero(self.body.j == row)

    def start(self, weight):
        self.g = np.tile(weight, len(self.m) // 2)
        v = np.tile(self.velocity, len(self.m) // 2)
        a = self.g + (self.load(0.0) + self.pull - (self.Z + self.drags) * v) / self.m
        self.u, self.w = np.zeros(len(v)), np.where(self.held, 0, v - 0.5 * DT * a)

    def free(self, t):
        """Accelerations without contact."""
        body = self.body
        force = self.load(t) + self.pull + self.m * self.g - self.springs * self.u - body.K @ self.u - body.K_beta @ self.w - (self.Z + self.drags) * self.w
        return force * self.inverse

    def move(self, a):
        self.w = self.w + DT * a
        self.u = self.u + DT * self.w

    def keys(self, is_counter):
        start = "Counter body/" if is_counter else ""
        keys = {}
        for support in self.supports:
            keys |= {start + key: value for key, value in support.keys("transient").items()}
        damping = self.body.damping_keys()
        if is_counter:
            keys |= {start + key.partition("/")[2]: value for key, value in damping.items()}
            keys |= {start + "RVE file": "counter/rve.h5", start + "Material": "heterogeneous", start + "Initial velocity": "%.17g, %.17g" % tuple(self.velocity)}
        else:
            keys |= {**damping, "Body/RVE file": "body/rve.h5", "Body/Material": "heterogeneous", "Body/Initial velocity": "%.17g, %.17g" % tuple(self.velocity)}
        return keys


def run(first, second, mu):
    """Displacements of both before each step."""
    states, touched = [(first.u, second.u)], 0
    for step in range(N_STEPS):
        a, b = first.free(step * DT), second.free(step * DT)
        for one, other in zip(first.contact, second.contact):
            x, y, z, t = 2 * one, 2 * one + 1, 2 * other, 2 * other + 1
            inverse_x, inverse_y = first.inverse[x] + second.inverse[z], first.inverse[y] + second.inverse[t]
            after = first.w[y] - second.w[t] + DT * (a[y] - b[t])
            normal = max(0.0, ((-GAP - first.u[y] + second.u[t]) / DT - after) / (DT * inverse_y))
            slips = first.w[x] - second.w[z] + DT * (a[x] - b[z]) - VELOCITY
            tangential = np.clip(-slips / (DT * inverse_x), -mu * normal, mu * normal)
            touched += normal > 0
            a[x], a[y] = a[x] + first.inverse[x] * tangential, a[y] + first.inverse[y] * normal
            b[z], b[t] = b[z] - second.inverse[z] * tangential, b[t] - second.inverse[t] * normal
        first.move(a)
        second.move(b)
        states.append((first.u, second.u))
    return states, touched


def write_volume(folder, name, half):
    np.savetxt(folder("map.txt"), half.body.phases[::-1], fmt="%d")  # an image: top row first
    settings = {"Grid/Cells": f"{half.body.columns}, {half.body.rows}", "Grid/Spacing": f"{half.body.hx!r}, {HY}", "Phases/Names": "a, b", "Microstructure/Type": "image",
                "Microstructure/File": "map.txt", "Microstructure/Oblong pixels": "true", "Homogenization/Boundary conditions": "KUBC"}
    for phase in range(2):
        settings |= {f"Phases/{'ab'[phase]}/Type": "stiffness", f"Phases/{'ab'[phase]}/Density": DENSITY[phase],
                     f"Phases/{'ab'[phase]}/Stiffness": ", ".join(map(str, STIFFNESS[phase]))}
    folder.write("rve.prm", prm(settings))
    folder.run(0, "rve_homogenization", "rve.prm", "--output", name, "--quiet")


def field(folder, name, of_run="run"):
    with h5py.File(folder(of_run, name)) as file:
        values = file["snapshots/displacement"][()]
        assert name == "dynamics.h5" or abs(file["grid"].attrs["origin"][1] + ROWS[1] * HY) < 1e-15
    return values.reshape(len(values), -1)


def keys_of(first, second, weight, mu):
    return {**first.keys(False), **second.keys(True), "Flat/Velocity": VELOCITY, "Flat/Gap": GAP, "Friction/Coefficient": mu, "Friction/Law": "coulomb",
            "Time/Time step": DT, "Time/End time": N_STEPS * DT, "Body/Acceleration": "%.17g, %.17g" % tuple(weight), "Snapshots/Interval": DT,
            "Observation/Energy interval": 1, "Checkpoints/Keep": "true"}


def compare(folder, keys, expected, note):
    """Runs on one rank and on two, and one that is continued, with the displacements @p expected of both bodies; the largest difference and the residual."""
    folder.write("run.prm", prm(keys))
    worst = 0.0
    for ranks in (1, 2, 0):
        if ranks:
            folder.run(0, "contact_dynamics", "run.prm", "--output", "run", "--quiet", ranks=ranks)
        else:
            folder.run(0, "contact_dynamics", "run.prm", "--output", "run", "--quiet", "--set", f"Time/End time={N_STEPS // 2 * DT}")
            folder.run(0, "contact_dynamics", "run.prm", "--output", "run", "--quiet", "--resume")
        for k, name in enumerate(("dynamics.h5", "counter_body.h5")):
            found, wanted = field(folder, name), np.array([state[k] for state in expected])
            error = np.abs(found - wanted[:len(found)]).max() / np.abs(wanted).max()
            assert error < 1e-10 and len(found) >= N_STEPS, (note, name, ranks, error)
            worst = max(worst, error)
        residual = folder.summary("run")["energy_balance_residual"]
        assert residual < 1e-11, (note, residual)
    return worst, residual


def prepare(folder, random, first, second):
    """Weight and friction of a pair, whose volumes are written and which starts under that weight."""
    weight = random.uniform(-1, 1, 2) * 1e5
    for half, name in ((first, "body"), (second, "counter")):
        half.start(weight)
        write_volume(folder, name, half)
    return weight, random.choice([0.0, 0.3])


def check_all(check, seed, n_pairs):
    print("seed", seed)
    random = np.random.default_rng(seed)
    with tempfile.TemporaryDirectory() as path:
        for number in range(n_pairs):
            check(Folder(path), random, number)


def check(folder, random, number):
    first, second = Half(random, False), Half(random, True)
    weight, mu = prepare(folder, random, first, second)
    expected, touched = run(first, second, mu)
    kinds = [(s.name, s.kind) for s in first.supports + second.supports]
    error, residual = compare(folder, keys_of(first, second, weight, mu), expected, (number, mu, kinds))
    print(number, mu, f"{touched / N_STEPS / len(first.contact):.2f} touch, {error:.1e}, balance {residual:.1e}", [kind for _, kind in kinds])


if __name__ == "__main__":
    check_all(check, SEED, N_PAIRS)
