"""Analysis static contact of many small bodies against all combinations of states of their contact nodes in numpy: bevelled blocks of
triangles under any top, on a flat that slides to either side or rests, mu up to 1, half of them on springs along the normal, and half of those at rest along the flat. Where an equilibrium exists it is found, and where there
is none the program says so; a block that tips beyond mu = 0.5, and one whose active sets go round in circles. An argument is the number of
bodies."""

import csv
import itertools
import sys
import tempfile

import numpy as np

from mesh_files import Box
from scenes import Folder, prm

YOUNG, POISSON, PRESSURE = 210e9, 0.3, 50e6
TOPS = ("platen", "lateral", "left", "right", "free")


def block(rng, nx, ny):
    """A block (mm) with bevels at both ends of the contact, and a lifted middle; groups Contact, Top, Left and Right."""
    size = rng.uniform(0.5, 2, 2) * [nx, ny]
    mesh = Box(size, [nx, ny], lambda x: "steel", kind="simplex")
    for name, axis, upper in (("Contact", 1, False), ("Top", 1, True), ("Left", 0, False), ("Right", 0, True)):
        mesh.name_side(name, axis, upper)
    x, y = mesh.points.T
    lift = 1e-3 * rng.uniform(0, 1, nx + 1) * rng.choice([0, 1], nx + 1)
    y += (1 - y / size[1]) * lift[np.round(x / size[0] * nx).astype(int)]
    return mesh


def stiffness_of(points, cells):
    """Triangles in plane strain, N/m of a thickness of 1 m."""
    factor = YOUNG / ((1 + POISSON) * (1 - 2 * POISSON))
    material = factor * np.array([[1 - POISSON, POISSON, 0], [POISSON, 1 - POISSON, 0], [0, 0, 0.5 - POISSON]])
    total = np.zeros((2 * len(points), 2 * len(points)))
    for cell in cells:
        gradients = np.linalg.inv(np.hstack([np.ones((3, 1)), points[cell]]))[1:]
        area = abs(np.linalg.det(np.hstack([np.ones((3, 1)), points[cell]]))) / 2
        b = np.zeros((3, 6))
        b[0, 0::2], b[1, 1::2], b[2, 0::2], b[2, 1::2] = gradients[0], gradients[1], gradients[1], gradients[0]
        dofs = np.array([[2 * c, 2 * c + 1] for c in cell]).ravel()
        total[np.ix_(dofs, dofs)] += area * b.T @ material @ b
    return total


class Scene:
    """One problem: its files, and its equilibria by enumeration."""

    def __init__(self, rng, top, sliding, mu, springs=None, along=None):
        self.top, self.sliding, self.mu, self.springs, self.along = top, sliding, mu, springs, along
        nx, ny = (rng.integers(3, 7), rng.integers(2, 4)) if sliding else (rng.integers(2, 5), rng.integers(2, 4))
        self.mesh = block(rng, nx, ny)
        self.points = self.mesh.points * 1e-3
        self.group = {name: sorted({c for corners, of in self.mesh.faces if of == name for c in corners})
                      for name in ("Contact", "Top", "Left", "Right")}

    def settings(self):
        held = {"left": {"Supports/Left/Held": "u_x"}, "right": {"Supports/Right/Held": "u_x"}, "lateral": {"Supports/Top/Held": "u_x"}}
        return {"Analysis": "static contact", "Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, "Phases/Names": "steel",
                "Phases/steel/Young modulus": YOUNG, "Phases/steel/Poisson ratio": POISSON, "Phases/steel/Density": 7800,
                "Flat/Velocity": 2 * self.sliding, "Supports/Top/Kind": "platen" if self.top == "platen" else "pressure", "Supports/Top/Pressure": PRESSURE,
                "Friction/Coefficient": self.mu, **({"Flat/Normal stiffness": self.springs} if self.springs else {}),
                **({"Flat/Tangential stiffness": self.along} if self.along else {}), **held.get(self.top, {})}

    def areas(self):
        """Along x, of each point of the contact."""
        areas, contact = np.zeros(len(self.points)), sorted(self.group["Contact"], key=lambda k: self.points[k, 0])
        for a, b in zip(contact, contact[1:]):
            areas[[a, b]] += (self.points[b, 0] - self.points[a, 0]) / 2
        return areas[self.group["Contact"]]

    def condensed(self):
        """S and f: forces S d - f on the contact nodes displaced by d, (x, y) of each in turn; and their gaps. Unknowns that remain free,
        as a body that only its contact holds, are kept: columns behind, with rows that have to be zero."""
        n = len(self.points)
        stiffness, load = stiffness_of(self.points, np.array(self.mesh.cells)), np.zeros(2 * n)
        x, top = self.points[:, 0], sorted(self.group["Top"], key=lambda k: self.points[k, 0])
        for a, b in zip(top, top[1:]):
            load[[2 * a + 1, 2 * b + 1]] -= PRESSURE * (x[b] - x[a]) / 2
        basis = np.eye(2 * n)
        if self.top == "platen":
            basis[:, 2 * top[0] + 1] = sum(np.eye(2 * n)[2 * k + 1] for k in top)
        held = [2 * k + 1 for k in top[1:]] if self.top == "platen" else []
        held += [2 * k for k in {"platen": top, "lateral": top, "left": self.group["Left"], "right": self.group["Right"]}.get(self.top, [])]
        contact = [d for k in self.group["Contact"] for d in (2 * k, 2 * k + 1)]
        fixed = [d for d in contact if d in held]
        inner = [d for d in range(2 * n) if d not in held and d not in contact]
        stiffness, load = basis.T @ stiffness @ basis, basis.T @ load
        solve = np.linalg.solve(stiffness[np.ix_(inner, inner)], np.column_stack([stiffness[np.ix_(inner, contact)], load[inner]]))
        s = stiffness[np.ix_(contact, contact)] - stiffness[np.ix_(contact, inner)] @ solve[:, :-1]
        f = load[contact] - stiffness[np.ix_(contact, inner)] @ solve[:, -1]
        height = self.points[self.group["Contact"], 1]
        return s, f, height - height.min(), [d in fixed for d in contact]

    def equilibria(self):
        """Normal forces of all of them."""
        s, f, gap, fixed = self.condensed()
        n, scale = len(gap), abs(s).max()
        softness = 1 / (self.springs * self.areas()) if self.springs else np.zeros(n)
        slack = 1 / (self.along * self.areas()) if self.along else np.zeros(n)
        states = ("separated", "slip") if self.sliding else ("separated", "stick", "left", "right")
        found, signs = [], {"left": -1, "right": 1, "slip": self.sliding}
        pressed = abs(f).sum()
        for combination in itertools.product(states, repeat=n):
            matrix, right = np.zeros((2 * n, 2 * n)), np.zeros(2 * n)
            for k, state in enumerate(combination):
                t, w = 2 * k, 2 * k + 1
                if state == "separated":
                    matrix[w], right[w] = s[w], f[w]
                else:
                    matrix[w, w], right[w] = scale, scale * (softness[k] * f[w] - gap[k])
                    matrix[w] += scale * softness[k] * s[w]
                if fixed[t] or state == "stick":
                    matrix[t, t] = scale
                    if not fixed[t]:
                        matrix[t] += scale * slack[k] * s[t]
                        right[t] = scale * slack[k] * f[t]
                elif state == "separated":
                    matrix[t], right[t] = s[t], f[t]
                else:
                    matrix[t], right[t] = s[t] - signs[state] * self.mu * s[w], f[t] - signs[state] * self.mu * f[w]
            if np.linalg.cond(matrix) > 1e11:
                continue
            d = np.linalg.solve(matrix, right)
            force, small = s @ d - f, 1e-9 * pressed
            good = True
            for k, state in enumerate(combination):
                t, w = 2 * k, 2 * k + 1
                if state == "separated":
                    good &= d[w] + gap[k] > -small / scale
                else:
                    good &= force[w] > -small
                if state == "stick" and not fixed[t]:
                    good &= abs(force[t]) < self.mu * force[w] + small
                if state in ("left", "right") and not fixed[t]:
                    good &= (d[t] + slack[k] * force[t]) * signs[state] < small / scale
            if good:
                found.append(force[1::2])
        return np.array(found)


def check(folder, scene, counts):
    expected = scene.equilibria()
    scene.mesh.write(folder("mesh.msh"))
    folder.write("block.prm", prm(scene.settings()))
    status, out, err = folder.end("contact_dynamics", "block.prm", "--output", "block")
    what = (scene.top, scene.sliding, scene.mu, scene.springs, scene.along, len(expected), (out + err)[-600:])
    assert status == (0 if len(expected) else 3), what
    counts[status, "slides" if scene.sliding else "rests"] = counts.get((status, "slides" if scene.sliding else "rests"), 0) + 1
    if status:
        assert "static contact:" in err, what
        return
    with open(folder("block", "static_contact.csv"), encoding="ascii") as file:
        rows = {round(float(row["x [m]"]), 9): row for row in csv.DictReader(file)}
    pressure = [float(rows[round(scene.points[k, 0], 9)]["pressure [Pa]"]) for k in scene.group["Contact"]]
    force = np.array(pressure) * scene.areas()
    error = abs(expected - force).max(axis=1).min() / force.sum()
    assert error < 1e-6, (*what, error)


def check_bevel(folder):
    """10 x 6 mm, contact on 2 to 8 mm, where active sets go round in circles from mu = 0.2 on. Forces and moments balance: the resultant of
    the contact is at 5 mm - mu 6 mm. Beyond 2 mm from the middle, mu = 0.5, there is no equilibrium."""
    mesh = Box([10, 6], [20, 12], lambda x: "steel", kind="simplex")
    mesh.name_side("Contact", 1, False).name_side("Top", 1, True)
    mesh.faces = [face for face in mesh.faces if face[1] == "Top" or all(2 <= mesh.points[c, 0] <= 8 for c in face[0])]
    x, y = mesh.points.T
    y += (1 - y / 6) * np.maximum(0, abs(x - 5) - 3) / 2
    mesh.write(folder("mesh.msh"))
    scene = Scene(np.random.default_rng(1), "lateral", 1, 0)
    for mu in (0.1, 0.2, 0.3, 0.4, 0.45):
        folder.write("block.prm", prm({**scene.settings(), "Friction/Coefficient": mu}))
        folder.run(0, "contact_dynamics", "block.prm", "--output", "block")
        with open(folder("block", "static_contact.csv"), encoding="ascii") as file:
            rows = sorted((float(row["x [m]"]), float(row["pressure [Pa]"])) for row in csv.DictReader(file))
        place, pressure = np.array(rows).T
        force = pressure * np.where((place < 2.1e-3) | (place > 7.9e-3), 0.25e-3, 0.5e-3)
        print(f"mu {mu}: {np.count_nonzero(force)} nodes touch, resultant {force.sum():.6g} N/m at {1e3 * force @ place / force.sum():.6f} mm")
        assert abs(force.sum() / 5e5 - 1) < 1e-6 and abs(force @ place / force.sum() - (5e-3 - mu * 6e-3)) < 1e-7, (mu, force)
    folder.write("block.prm", prm({**scene.settings(), "Friction/Coefficient": 0.55}))
    assert "there is no equilibrium" in folder.run(3, "contact_dynamics", "block.prm", "--output", "block")


with tempfile.TemporaryDirectory() as path:
    scenes, rng, numbers, n_bodies = Folder(path), np.random.default_rng(7), {}, int((sys.argv + ["100"])[2])
    for k in range(n_bodies):
        moves = [1, -1, 1, 0][k % 4]
        springs = [None, 10 ** np.random.default_rng(k).uniform(11, 16)][k // 4 % 2]
        along = [None, 10 ** np.random.default_rng(k + 1000).uniform(11, 16)][k // 8 % 2] if moves == 0 else None
        check(scenes, Scene(rng, TOPS[rng.integers(5 if moves == 0 else 4)], moves, rng.uniform(0, 1), springs, along), numbers)
    check_bevel(scenes)
    print(numbers)
    assert numbers[0, "slides"] > n_bodies / 5 and numbers[3, "slides"] > n_bodies / 50 and numbers[0, "rests"] > n_bodies / 8, numbers
