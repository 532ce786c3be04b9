"""Analysis complex modes against transient runs of the same body: frequency and growth rate of a small pin whose one growing mode takes
over, seen in the linear phase of a run, and what the time step changes of them, as the scheme's own eigenvalues have it."""

import math
import os
import sys
import tempfile

import h5py
import numpy as np

from scenes import TOOLS, Folder, prm, sets

sys.path.append(os.path.join(TOOLS, "studies", "prediction"))
from measures import rates  # noqa: E402
from sliding_modes import SlidingPin  # noqa: E402

STIFFNESS, DENSITY, CELLS, SIZE = (36.54e9, 9.1e9, 47.26e9, 13.785e9), 1770, (24, 8), (0.012, 0.004)
MU, DELTA, BETA = 0.3, 4e-7, 4.4e-9
BODY = {"Body/Stiffness": ", ".join(map(str, STIFFNESS)), "Body/Density": DENSITY, "Body/Size": "0.012, 0.004", "Body/Cells": "24, 8",
        "Flat/Velocity": 50, "Top/Kind": "platen", "Top/Pressure": 5e6, "Friction/Coefficient": MU, "Friction/Regularization time": DELTA,
        "Time/Rayleigh beta": BETA}
MODES = {"Analysis": "complex modes", **BODY, "Complex modes/Highest frequency": 1.2e6, "Complex modes/Fastest decay": 20000}
# A smooth start leaves the pin sliding as in the static state, but for tiny vibrations.
RUN = {"Analysis": "transient", **BODY, "Top/Ramp": "smooth", "Top/Ramp time": 1e-4, "Time/End time": 4e-4, "Observation/Energy interval": 0,
       "Observation/Reference x": 0.002}
WINDOW, SAMPLED = (2e-4, 4e-4), 1.6e-7  # s: the linear phase; samples of the histories
STEPS = (4e-8, 2e-8, 1e-8)  # s


def eigenvalues(folder, settings):
    """s (1/s) of the modes, the fastest growing first."""
    folder.write("modes.prm", prm({**MODES, **settings}))
    folder.run(0, "contact_dynamics", "modes.prm", "--output", "modes")
    summary = folder.summary("modes")
    assert summary["missing_modes"] == 0 and summary["separated_nodes"] == 0, summary
    return np.array([complex(mode["growth_rate"], 2 * math.pi * mode["frequency"]) for mode in summary["complex_modes"]])


def seen(folder, dt, settings):
    """s (1/s) of the fastest growing vibration of the reference node, while all nodes slide."""
    folder.write("run.prm", prm({**RUN, **settings}))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run",
               *sets({"Time/Time step": dt, "Observation/History interval": round(SAMPLED / dt)}))
    with h5py.File(folder("run", "dynamics.h5")) as file:
        time, displacement = file["reference/time"][()], file["reference/displacement"][:, 0]
        history, sliding = file["history/time"][()], file["history/slipping_nodes"][()]
    assert sliding[history >= WINDOW[0]].min() == CELLS[0] + 1, "not all nodes slide"
    inside = (time >= WINDOW[0]) & (time <= WINDOW[1])
    found = rates(displacement[inside], time[1] - time[0])
    found = found[found.imag > 1e4]
    return found[np.argmax(found.real)]


def of_scheme(start, dt):
    """The eigenvalue near `start` of the time scheme: leapfrog, damping of the velocity half a step before, and friction that follows
    a normal force that is linear in time within a step (doc/theory.md, sections 2 and 3)."""
    d11, d12, d22, d33 = STIFFNESS
    pin = SlidingPin.build(np.zeros(CELLS[::-1], int), [[[d11, d12, 0], [d12, d22, 0], [0, 0, d33]]], DENSITY, SIZE, MU, DELTA, BETA)
    mass, stiffness, friction = (matrix.toarray() for matrix in (pin.mass, pin.stiffness, pin.friction))
    border = np.random.default_rng(1).standard_normal(len(mass))

    def singular(s):  # zero where the matrix is singular
        inertia = (2 / dt * np.sinh(s * dt / 2)) ** 2 / (1 + BETA * (1 - np.exp(-s * dt)) / dt)
        q, before = math.exp(-dt / DELTA), np.exp(-s * dt)
        mean = (1 - q) * DELTA / dt
        lag = (1 - mean + (mean - q) * before) / (1 - q * before)
        return 1 / (border @ np.linalg.solve(inertia * mass + stiffness - MU * lag * friction, border))

    a, b = start, start * (1 + 1e-5)
    value = singular(a)
    for _ in range(20):
        a, b, value = b, b - (following := singular(b)) * (b - a) / (following - value), following
        if abs(b - a) < 1e-11 * abs(b):
            return b
    raise AssertionError("the secant method did not converge")


def check_growth(folder):
    """To 0.1 % each of frequency and growth rate; the time step changes them as it does the scheme's eigenvalue."""
    growing = eigenvalues(folder, {})
    assert growing[0].real > 5000 and growing[1].real < 0, growing
    s, errors = growing[0], []
    for dt in STEPS:
        found, exact = seen(folder, dt, {}), of_scheme(growing[0], dt)
        errors.append(found - s)
        print(f"dt = {1e9 * dt:g} ns: growth {found.real:.2f} 1/s, scheme {exact.real:.2f}, mode {s.real:.2f}; frequency "
              f"{found.imag / 2 / math.pi:.2f} Hz, scheme {exact.imag / 2 / math.pi:.2f}, mode {s.imag / 2 / math.pi:.2f}")
        assert abs(found.real / exact.real - 1) < 2e-5 and abs(found.imag / exact.imag - 1) < 1e-7, (dt, found, exact)
    assert abs(found.real / s.real - 1) < 1e-3 and abs(found.imag / s.imag - 1) < 1e-3, (found, s)
    # Damping acts half a step early: beta omega^2 dt / 4 of the frequency, of order one. All else is of order two.
    rest = [error.imag / s.imag - BETA * s.imag**2 * dt / 4 for error, dt in zip(errors, STEPS)]
    orders = [np.log2(np.abs(np.divide(values[:-1], values[1:]))) for values in (rest, [error.real for error in errors])]
    print("orders of frequency and growth rate:", *orders)
    assert np.abs(orders[0] - 2).max() < 0.05 and orders[1].min() > 1.9, orders


with tempfile.TemporaryDirectory() as path:
    check_growth(Folder(path))
