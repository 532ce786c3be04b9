"""Analysis static contact of many small solids of tetrahedra on a flat at rest, where friction has any direction: an equilibrium is found for each
of them, and the forces that the program tells are those of its displacements by a stiffness of numpy, and Coulomb's. Of free bodies with little
friction a quarter has no end of its active sets. Half of them stand on springs along the flat. An argument is the number of bodies.

    random_resting_solids.py <folder with the programs> [bodies]
"""

import csv
import sys
import tempfile

import numpy as np

from mesh_files import Box
from scenes import Folder, prm

YOUNG, POISSON, PRESSURE = 210e9, 0.3, 50e6
HELD = {"left": {"Supports/Left/Held": "u_x"}, "front": {"Supports/Front/Held": "u_y"}, "lateral": {"Supports/Top/Held": "u_x, u_y"}}
SIDES = (("Contact", 2, False), ("Top", 2, True), ("Left", 0, False), ("Front", 1, False))


def stiffness_of(points, cells):
    """Of tetrahedra, N/m."""
    lame, shear = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
    total = np.zeros((3 * len(points), 3 * len(points)))
    for cell in cells:
        corners = np.hstack([np.ones((4, 1)), points[cell]])
        g, volume = np.linalg.inv(corners)[1:].T, abs(np.linalg.det(corners)) / 6
        block = volume * (lame * np.einsum("ai,bj->aibj", g, g) + shear * np.einsum("aj,bi->aibj", g, g)
                          + shear * np.einsum("ab,ij->aibj", g @ g.T, np.eye(3))).reshape(12, 12)
        dofs = (3 * np.array(cell)[:, None] + np.arange(3)).ravel()
        total[np.ix_(dofs, dofs)] += block
    return total


class Scene:
    """A block whose bottom is not quite plane, with a coefficient of friction from 0.003 to 1."""

    def __init__(self, seed):
        rng = np.random.default_rng(seed)
        cells = [*rng.integers(2, 4, 2), 2]
        size = rng.uniform(0.5, 2, 3) * cells
        mesh = self.mesh = Box(size, cells, lambda x: "steel", kind="simplex")
        for name, axis, upper in SIDES:
            mesh.name_side(name, axis, upper)
        x, y, z = mesh.points.T
        shape = (cells[0] + 1, cells[1] + 1)
        lift, bottom = 1e-3 * rng.uniform(0, 1, shape) * rng.choice([0, 1], shape), z == 0
        z[bottom] += lift[np.round(x[bottom] / size[0] * cells[0]).astype(int), np.round(y[bottom] / size[1] * cells[1]).astype(int)]
        self.top = rng.choice(["free"] * 3 + ["platen", *HELD])
        self.mu = 10 ** rng.uniform(-2.5, 0)
        self.along = 10 ** rng.uniform(12, 16) if seed % 2 else None  # springs along the flat
        self.points = mesh.points * 1e-3
        self.group = {name: np.array(sorted({c for corners, of in mesh.faces if of == name for c in corners})) for name, *_ in SIDES}

    def settings(self):
        return {"Dimension": 3, "Analysis": "static contact", "Mesh/File": "mesh.msh", "Mesh/Scale": 0.001, "Phases/Names": "steel",
                "Phases/steel/Young modulus": YOUNG, "Phases/steel/Poisson ratio": POISSON, "Phases/steel/Density": 7800,
                "Flat/Velocity": 0, "Supports/Top/Kind": "platen" if self.top == "platen" else "pressure", "Supports/Top/Pressure": PRESSURE,
                "Friction/Coefficient": self.mu,
                **({"Flat/Tangential stiffness": self.along} if self.along else {}), **HELD.get(self.top, {})}

    def areas(self, name):
        """Of the points, as seen along z (m^2)."""
        areas, points = np.zeros(len(self.points)), self.points
        for a, b, c in (corners for corners, of in self.mesh.faces if of == name):
            areas[[a, b, c]] += abs(np.cross((points[b] - points[a])[:2], (points[c] - points[a])[:2])) / 6
        return areas

    def forces(self, u):
        """Of the flat on the nodes of the contact, displaced by u [node, 3] (N), and which components a side holds."""
        n = len(self.points)
        stiffness, load = stiffness_of(self.points, self.mesh.cells), np.zeros(3 * n)
        load[2::3] -= PRESSURE * self.areas("Top")
        top, basis, held = self.group["Top"], np.eye(3 * n), []
        if self.top == "platen":
            basis[3 * top + 2, 3 * top[0] + 2] = 1
            held += [*(3 * top[1:] + 2)]
        if self.top in ("platen", "lateral"):
            held += [*(3 * top), *(3 * top + 1)]
        held += [*(3 * self.group["Left"])] * (self.top == "left") + [*(3 * self.group["Front"] + 1)] * (self.top == "front")
        contact = (3 * self.group["Contact"][:, None] + np.arange(3)).ravel()
        inner = np.setdiff1d(np.arange(3 * n), [*held, *contact])
        stiffness, load = basis.T @ stiffness @ basis, basis.T @ load
        whole = np.zeros(3 * n)
        whole[contact] = u.ravel()
        whole[inner] = np.linalg.solve(stiffness[np.ix_(inner, inner)], (load - stiffness @ whole)[inner])
        return (stiffness @ whole - load)[contact].reshape(-1, 3), np.isin(contact, held).reshape(-1, 3)


def check(folder, seed):
    scene = Scene(seed)
    scene.mesh.write(folder("mesh.msh"))
    folder.write("block.prm", prm(scene.settings()))
    folder.run(0, "contact_dynamics", "block.prm", "--output", "block")
    with open(folder("block", "static_contact.csv"), encoding="ascii") as file:
        rows = list(csv.DictReader(file))

    def columns(*names):
        return np.array([[float(row[name]) for name in names] for row in rows])

    nodes, where = scene.group["Contact"], columns("x [m]", "y [m]")
    order = [int(np.argmin(np.linalg.norm(where - scene.points[k, :2], axis=1))) for k in nodes]
    areas = scene.areas("Contact")[nodes]
    u = columns("displacement_x [m]", "displacement_y [m]", "displacement_z [m]")[order]
    told = columns("shear_traction [Pa]", "shear_traction_y [Pa]", "pressure [Pa]")[order] * areas[:, None]
    force, held = scene.forces(u)
    total, free = force[:, 2].sum(), ~held[:, :2]
    what = (seed, scene.top, scene.mu, scene.along)
    assert np.abs(np.where(np.column_stack([free, [True] * len(nodes)]), force - told, 0)).max() < 1e-6 * total, what
    opened = (scene.points[nodes, 2] - scene.points[nodes, 2].min() + u[:, 2]) * YOUNG * 1e-3  # as a force
    assert np.abs(np.minimum(force[:, 2], opened)).max() < 1e-6 * total, what
    # f = P(f - c u) with the projection P on the circle of radius mu p says stick, slip and the direction of friction.
    friction, slip = np.where(free, force[:, :2], 0), np.where(free, u[:, :2], 0)
    if scene.along:
        slip += friction / (scene.along * areas[:, None])
    trial = friction - YOUNG * 1e-3 * slip
    size, limit = np.linalg.norm(trial, axis=1), scene.mu * np.maximum(0, force[:, 2])
    projected = trial * np.minimum(1, limit / np.maximum(size, 1e-300))[:, None]
    assert np.abs(friction - projected).max() < 1e-6 * total, (*what, np.abs(friction - projected).max() / total)
    assert abs(total / (PRESSURE * scene.areas("Top").sum()) - 1) < 1e-6, what


with tempfile.TemporaryDirectory() as path:
    scenes = Folder(path)
    for number in range(int((sys.argv + ["40"])[2])):
        check(scenes, number)
