"""Complex modes of a layer between a flat without friction and a top that absorbs, against its dispersion relation: waves of every angle meet
the dashpots rho c_P and rho c_S of the top, so that decay and frequency tell how much of each they send back. Of second order, on grids and meshes (modes of
still larger decay, of waves that come along the normal, belong to the cells: they decay the faster the finer these are).

With P waves A cos(p y) and S waves B sin(q y), times exp(i k x + s t), p^2 = -s^2/c_P^2 - k^2 and q^2 = -s^2/c_S^2 - k^2, the flat is free of shear and
holds u_y; sigma_yy + rho c_P s u_y = 0 and sigma_xy + rho c_S s u_x = 0 at the top are two equations for A and B.

Coefficients of reflection at real angles, in runs: a wavy flat that moves with V below the layer sends up P and S waves exp(i k (x - V t)) at the angles
sin t = c/V to the normal, and what the top sends down has to be R times what arrives there: with the traction s of unit waves, s_down R + s_up =
i k V Z (u_down R + u_up). Layers of two heights, in which P and S waves arrive in other shares, tell all four coefficients. Where V < c_P the P waves vanish with
the height, and S waves alone arrive at the angles of which P waves know none."""

import csv
import tempfile

import h5py
import numpy as np

from mesh_files import Box
from scenes import Folder, prm

HEIGHT, LENGTH, DENSITY, YOUNG, POISSON = 4e-3, 20e-3, 1770.0, 36e9, 0.25
LAME, SHEAR = YOUNG * POISSON / ((1 + POISSON) * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
P, S = np.sqrt((LAME + 2 * SHEAR) / DENSITY), np.sqrt(SHEAR / DENSITY)
HIGHEST, FASTEST = 5.9e5, 1.2e6  # Hz, 1/s
ROWS = (5, 10, 20)


def determinant(s, k):
    p, q = np.sqrt(-(s / P) ** 2 - k * k + 0j), np.sqrt(-(s / S) ** 2 - k * k + 0j)
    cp, sp, cq, sq = np.cos(p * HEIGHT), np.sin(p * HEIGHT), np.cos(q * HEIGHT), np.sin(q * HEIGHT)
    normal = [-(LAME + 2 * SHEAR) * p * p * cp - LAME * k * k * cp - DENSITY * P * s * p * sp,
              -2 * SHEAR * 1j * k * q * cq - DENSITY * P * s * 1j * k * sq]
    shear = [-2 * SHEAR * 1j * k * p * sp + DENSITY * S * s * 1j * k * cp, SHEAR * (k * k - q * q) * sq + DENSITY * S * s * q * cq]
    return normal[0] * shear[1] - normal[1] * shear[0]


def root(s, k):
    """By the secant method; None if it does not settle."""
    before, value = s * (1 + 1e-4), determinant(s * (1 + 1e-4), k)
    for _ in range(60):
        now = determinant(s, k)
        if now == value:
            break
        before, value, s = s, now, s - now * (s - before) / (now - value)
        if abs(s - before) < 1e-13 * abs(s):
            return s
    return None


def elastic():
    return {"Body/Stiffness": f"{LAME + 2 * SHEAR:.17g}, {LAME:.17g}, {LAME + 2 * SHEAR:.17g}, {SHEAR:.17g}", "Body/Density": DENSITY, "Sides/Periodic": "true"}


def modes(folder, rows, mesh):
    columns = round(rows * LENGTH / HEIGHT)
    plane = {**elastic(), "Body/Size": f"{LENGTH}, {HEIGHT}", "Body/Cells": f"{columns}, {rows}"}
    if mesh:
        box = Box([LENGTH * 1e3, HEIGHT * 1e3], [columns, rows], lambda x: "body", "cube")
        box.name_side("Contact", 1, False).name_side("Top", 1, True).name_side("left", 0, False).name_side("right", 0, True).write(folder("layer.msh"))
        plane = {"Mesh/File": "layer.msh", "Mesh/Scale": 0.001, "Mesh/Periodic in x": "left, right", "Phases/Names": "body",
                 "Phases/body/Young modulus": YOUNG, "Phases/body/Poisson ratio": POISSON, "Phases/body/Density": DENSITY}
    folder.write("layer.prm", prm({**plane, "Analysis": "complex modes", "Supports/Top/Kind": "absorbing", "Supports/Top/Pressure": 1e6,
                                   "Friction/Coefficient": 0, "Friction/Regularization time": 0, "Time/Rayleigh beta": 0,
                                   "Complex modes/Highest frequency": HIGHEST, "Complex modes/Fastest decay": FASTEST}))
    folder.run(0, "contact_dynamics", "layer.prm", "--output", f"{rows}{mesh}", "--quiet")
    rows_of = csv.DictReader(folder.read(f"{rows}{mesh}", "complex_modes.csv").decode().splitlines())
    return np.array([float(row["growth_rate [1/s]"]) + 2j * np.pi * float(row["frequency [Hz]"]) for row in rows_of])


class Waves:
    """P and S waves of a moving flat with one wave a LENGTH, of unit amplitude, that go up (sign 1) or down (-1)."""

    def __init__(self, speed):
        self.speed, self.k = speed, 2 * np.pi / LENGTH
        self.normals = self.k * np.sqrt((speed / np.array([P, S]))**2 - 1 + 0j)  # p and q

    def amplitudes(self, sign):
        """[u_x, u_y][P, S] of a potential of each."""
        p, q = sign * self.normals
        return np.array([[1j * self.k, 1j * q], [1j * p, -1j * self.k]]) * [P, S] / (self.k * self.speed)

    def balance(self, sign):
        """[x, y][P, S]: what the dashpots at the top do not balance."""
        u = self.amplitudes(sign)
        x, y = 1j * self.k * u, 1j * sign * self.normals * u  # derivatives
        stress = np.array([SHEAR * (y[0] + x[1]), LAME * x[0] + (LAME + 2 * SHEAR) * y[1]])
        return stress - 1j * self.k * self.speed * DENSITY * np.array([[S], [P]]) * u

    def reflection(self):
        return -np.linalg.solve(self.balance(-1), self.balance(1))

    def at_top(self, folder, cells, height):
        """Amplitudes that arrive there and that come from there, in a run on cells of 1/cells of the waves along x and y."""
        h = 2 * np.pi / self.normals.real.max() / cells
        rows, period = round(height * cells), LENGTH / self.speed
        folder.write("angle.prm", prm({
            **elastic(), "Body/Size": f"{LENGTH}, {rows * h:.17g}", "Body/Cells": f"{cells}, {rows}", "Supports/Top/Kind": "absorbing", "Supports/Top/Pressure": 1e7,
            "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 2 * period, "Friction/Coefficient": 0, "Time/Rayleigh beta": 0, "Flat/Velocity": self.speed,
            "Flat/Gap": 1e-10, "Flat/Profile": f"1e-10*sin({self.k:.17g}*x)", "Time/End time": 100 * period, "Snapshots/Interval": 25 * period,
            "Observation/Energy interval": 0}))
        folder.run(0, "contact_dynamics", "angle.prm", "--output", "angle", "--quiet")
        with h5py.File(folder("angle", "dynamics.h5")) as file:
            u = file["snapshots/displacement"][-1].reshape(rows + 1, -1, 2)[:, :cells]
        u = (u * np.exp(-2j * np.pi * np.arange(cells) / cells)[:, None]).mean(1).ravel()
        depth = h * (np.arange(rows + 1)[:, None, None] - rows)
        shapes = np.concatenate([self.amplitudes(sign) * np.exp(1j * sign * self.normals * depth) for sign in (1, -1)], 2).reshape(-1, 4)
        sizes = np.abs(shapes).max(0)
        found = np.linalg.lstsq(shapes / sizes, u, rcond=None)[0] / sizes
        return found[:2], found[2:]


def check_angles(folder):
    """At 60 degrees, where S waves are at 30 for this ratio of Poisson, all four are 1 - sqrt(3)/2; along the normal nothing comes back."""
    assert np.abs(np.abs(Waves(2 * P / np.sqrt(3)).reflection()) - (1 - np.sqrt(0.75))).max() < 1e-12 and np.abs(Waves(1e6 * P).reflection()).max() < 1e-5
    for kind, speed, angles in (("P", P, (15, 30, 45, 60)), ("S", S, (45, 60))):
        for angle in angles:
            waves, errors = Waves(speed / np.sin(np.radians(angle))), []
            exact = waves.reflection()
            for cells in (12, 24):
                up, down = np.transpose([waves.at_top(folder, cells, height) for height in ((0.75, 1.75) if kind == "P" else (0.75,))], (1, 2, 0))
                if kind == "P":
                    found = down @ np.linalg.inv(up)
                    errors.append(np.abs(found - exact).max())
                    assert np.linalg.cond(up) < 5, up
                else:
                    found = down[1] / up[1]
                    errors.append(np.abs(down - exact @ up).max() / np.abs(up[1]).max())
            order = np.log2(errors[0] / errors[1])
            print(f"{kind} waves at {angle} degrees: reflects {np.round(np.abs(found), 4).tolist()}, exact {np.round(np.abs(exact if kind == 'P' else exact[1:, 1]), 4).tolist()}, errors "
                  f"{errors[0]:.1e}, {errors[1]:.1e}, order {order:.2f}")
            assert abs(order - 2) < 0.4 and errors[1] < (0.01 if kind == "P" else 0.04), (kind, angle, errors)


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_angles(folder)
        found = [modes(folder, rows, False) for rows in ROWS]
        roots = []
        for s in found[-1]:
            near = [(n, root(s * start, 2 * np.pi * n / LENGTH)) for n in range(8) for start in (1, 0.99, 1.01, 1 + 0.01j, 1 - 0.01j)]
            n, exact = min(((n, r) for n, r in near if r is not None), key=lambda item: abs(item[1] - s))
            roots.append((n, exact))
            errors = [np.abs(of_grid / exact - 1).min() for of_grid in (*found[:-1], s)]
            order = np.log2(errors[-2] / errors[-1])
            print(f"n = {n}: {exact.imag / 2e3 / np.pi:8.3f} kHz, decay {-exact.real:10.1f} 1/s, errors " + ", ".join(f"{e:.1e}" for e in errors) + f", order {order:.2f}")
            assert errors[-1] < 1e-2 and 1.8 < order < 2.2, (n, exact, errors)
        assert len(roots) == 8 and {n for n, _ in roots} == {1, 2}, roots  # two of each, along x and against it
        on_mesh = modes(folder, ROWS[0], True)
        assert len(on_mesh) == len(found[0]) and np.abs(np.sort_complex(on_mesh) / np.sort_complex(found[0]) - 1).max() < 1e-7, (on_mesh, found[0])


if __name__ == "__main__":
    main()
