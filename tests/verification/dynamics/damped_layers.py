"""Decay of a column of two layers with damping of their own against its complex frequency.

In a layer whose stress is M (1 + beta d/dt) of the strain, waves exp(i k y + s t) have k^2 = -rho s^2 / (M (1 + beta s)). The lower layer is held
below, the upper one free above, so that

    M1 (1 + beta1 s) k1 cot(k1 h1) = M2 (1 + beta2 s) k2 tan(k2 h2).

The lowest complex mode and the decay of a run after its top was loaded agree with the root, of second order in the cells.

Of layers that are damped by their mass alone s (s + alpha) takes the place of s^2: a mode of the frequency omega decays with alpha/2 at
sqrt(omega^2 - alpha^2/4), on every grid with its own omega.
"""

import csv
import os
import sys
import tempfile

import h5py
import numpy as np

from scenes import TOOLS, Folder, prm

sys.path.append(os.path.join(TOOLS, "studies", "prediction"))
from measures import rates  # noqa: E402

HEIGHTS, YOUNG, POISSON, DENSITY, BETA = np.array([3e-3, 5e-3]), np.array([30e9, 240e9]), 0.2, 1770.0, np.array([1.5e-7, 2e-8])
MODULUS = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
FIRST = 16 / HEIGHTS.sum()  # cells a metre of the coarsest grid


def mismatch(s, beta=BETA):
    moduli = MODULUS * (1 + beta * s)
    k = np.sqrt(-DENSITY * s**2 / moduli + 0j)
    return moduli[0] * k[0] / np.tan(k[0] * HEIGHTS[0]) - moduli[1] * k[1] * np.tan(k[1] * HEIGHTS[1])


def root(beta=BETA):
    """The lowest one, by the secant method from that of undamped layers."""
    omega = np.linspace(1e4, 2e6, 20000)
    undamped = [(MODULUS[0] * a / np.tan(a * HEIGHTS[0]) - MODULUS[1] * b * np.tan(b * HEIGHTS[1]))
                for a, b in (omega[:, None] * np.sqrt(DENSITY / MODULUS)).tolist()]
    s = 1j * omega[np.flatnonzero(np.diff(np.sign(undamped)))[0]]
    before, value = s * (1 + 1e-4), mismatch(s * (1 + 1e-4), beta)
    for _ in range(50):
        now = mismatch(s, beta)
        if now == value:
            break
        before, value, s = s, now, s - now * (s - before) / (now - value)
    assert abs(mismatch(s, beta)) < 1e-9 * MODULUS[0] / HEIGHTS[0]
    return s


def settings(folder, factor):
    rows = round(FIRST * HEIGHTS.sum() * factor)
    h = HEIGHTS.sum() / rows
    lower = round(HEIGHTS[0] / h)
    folder.write(f"layers{factor}.txt", "1 1\n" * (rows - lower) + "0 0\n" * lower)
    phases = {"Phases/Names": "soft, stiff", **{f"Phases/{name}/{key}": value for name, young in zip(("soft", "stiff"), YOUNG)
                                                for key, value in (("Young modulus", young), ("Poisson ratio", POISSON), ("Density", DENSITY))}}
    folder.write("rve.prm", prm({**phases, "Grid/Cells": f"2, {rows}", "Grid/Size": f"{2 * h:.17g}, {HEIGHTS.sum():.17g}", "Microstructure/Type": "image",
                                 "Microstructure/File": f"layers{factor}.txt", "Homogenization/Boundary conditions": "KUBC",
                                 "Homogenization/Tolerance": 1e-3, "Homogenization/Write concentration": "false"}))
    folder.run(0, "rve_homogenization", "rve.prm", "--output", f"rve{factor}", "--quiet")
    return {"Body/RVE file": f"rve{factor}/rve.h5", "Body/Material": "heterogeneous", "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 1e6,
            "Supports/Left/Held": "u_x", "Supports/Right/Held": "u_x", "Friction/Coefficient": 0, "Friction/Regularization time": 0,
            "Time/Rayleigh beta": ", ".join(map(str, BETA)), "Time/Beta2": 0.5}


def mode(folder, factor, body):
    folder.write("modes.prm", prm({**body, "Analysis": "complex modes", "Complex modes/Highest frequency": 3e5, "Complex modes/Fastest decay": 5e5}))
    folder.run(0, "contact_dynamics", "modes.prm", "--output", f"modes{factor}", "--quiet")
    rows = csv.DictReader(folder.read(f"modes{factor}", "complex_modes.csv").decode().splitlines())
    found = [float(row["growth_rate [1/s]"]) + 2j * np.pi * float(row["frequency [Hz]"]) for row in rows]
    return min((s for s in found if s.imag > 0), key=lambda s: s.imag)


def of_top(folder, factor, body, period):
    """Times and displacements of a run."""
    step = period / 40 / (40 * factor**2)
    every = round(period / 40 / step)
    folder.write("run.prm", prm({**body, "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 3 * period, "Flat/Velocity": 0, "Time/Time step": step,
                                 "Time/End time": 12 * period, "Observation/History interval": every, "Observation/Probes": "top",
                                 "Observation/Probe interval": every, "Observation/top/Position": f"0, {HEIGHTS.sum():.17g}"}))
    folder.run(0, "contact_dynamics", "run.prm", "--output", f"run{factor}", "--quiet")
    with h5py.File(folder(f"run{factor}", "dynamics.h5")) as file:
        time, u = file["probes/top/time"][()], file["probes/top/displacement"][:, 1]
    return time, u


def decay(folder, factor, body, period):
    """From the displacement of the top: u_{n+1} + a u_n + b u_{n-1} = c holds for a single decaying vibration about rest."""
    time, u = of_top(folder, factor, body, period)
    u, lag = u[time > 6 * period], 8
    A = np.column_stack([u[lag:-lag], u[: -2 * lag], np.ones(len(u) - 2 * lag)])
    a, b, _ = np.linalg.lstsq(A / np.abs(u).max(), u[2 * lag:] / np.abs(u).max(), rcond=None)[0]
    z = np.roots([1, -a, -b])[0]
    s = np.log(z) / (lag * (time[1] - time[0]))
    return complex(s.real, abs(s.imag))


def check_damped_by_mass(folder):
    omega = root(np.zeros(2)).imag
    alpha = 0.4 * omega
    decays = lambda omega: -alpha / 2 + 1j * np.sqrt(omega**2 - alpha**2 / 4)
    errors = []
    for factor in (1, 2):
        body, period = {**settings(folder, factor), "Time/Rayleigh beta": 0}, 2 * np.pi / omega
        of_grid = decays(mode(folder, factor, body).imag)
        body["Body/Rayleigh alpha"] = alpha
        found = mode(folder, factor, body)
        time, u = of_top(folder, factor, body, period)
        of_run = rates(u[time > 3.1 * period], time[1] - time[0], 60, 1e-9)  # higher modes decay as slowly
        of_run = of_run[np.argmin(abs(of_run - of_grid))]
        errors.append(abs(found / decays(omega) - 1))
        print(f"damped by mass: mode {found:.2f}, {abs(found / of_grid - 1):.1e} from that of the grid, {errors[-1]:.2e} from the exact one; run {of_run:.2f}, "
              f"{abs(of_run / of_grid - 1):.1e} from that of the grid")
        assert abs(found / of_grid - 1) < 1e-11 and abs(of_run / of_grid - 1) < 2e-6, (found, of_run, of_grid)
    assert abs(np.log2(errors[0] / errors[1]) - 2) < 0.01, errors


def main():
    exact = root()
    print(f"exact: growth {exact.real:.6g} 1/s, frequency {exact.imag / 2 / np.pi:.6g} Hz")
    with tempfile.TemporaryDirectory() as path:
        folder, errors = Folder(path), {"mode": [], "run": []}
        for factor in (1, 2, 4):
            body = settings(folder, factor)
            errors["mode"].append(mode(folder, factor, body) / exact - 1)
            errors["run"].append(decay(folder, factor, body, 2 * np.pi / exact.imag) / exact - 1)
        for what, found in errors.items():
            sizes = np.abs(found)
            print(what, "distances", sizes, "orders", np.log2(sizes[:-1] / sizes[1:]))
            assert sizes[-1] < 5e-4 and np.log2(sizes[:-1] / sizes[1:]).min() > 1.8, what
        check_damped_by_mass(folder)


if __name__ == "__main__":
    main()
