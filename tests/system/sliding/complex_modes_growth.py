"""Analysis complex modes against transient runs of the same body: frequency and growth rate of a small pin whose one growing mode takes
over, seen in the linear phase of a run, and what the time step changes of them, as the scheme's own eigenvalues have it; springs along
the flat; laws of the coefficient; participation of modes in snapshots."""

import math
import os
import sys
import tempfile

import h5py
import numpy as np

from scenes import TOOLS, Folder, prm, sets
from sliding_pin import SlidingPin

sys.path.append(os.path.join(TOOLS, "studies", "prediction"))
sys.path += [os.path.join(TOOLS, "python"), TOOLS]
import mesoslip  # noqa: E402
from measures import rates  # noqa: E402
from report.base.data import Chain  # noqa: E402
from report.runs import vibrating_modes  # noqa: E402
from mesoslip.participation import assurance, instability_index, participation  # noqa: E402

STIFFNESS, DENSITY, CELLS, SIZE = (36.54e9, 9.1e9, 47.26e9, 13.785e9), 1770, (24, 8), (0.012, 0.004)
MU, DELTA, BETA = 0.3, 4e-7, 4.4e-9
BODY = {"Body/Stiffness": ", ".join(map(str, STIFFNESS)), "Body/Density": DENSITY, "Body/Size": "0.012, 0.004", "Body/Cells": "24, 8",
        "Flat/Velocity": 50, "Supports/Top/Kind": "platen", "Supports/Top/Pressure": 5e6, "Friction/Coefficient": MU, "Friction/Regularization time": DELTA,
        "Time/Rayleigh beta": BETA}
MODES = {"Analysis": "complex modes", **BODY, "Complex modes/Highest frequency": 1.2e6, "Complex modes/Fastest decay": 20000}
# A smooth start leaves the pin sliding as in the static state, but for tiny vibrations.
RUN = {"Analysis": "transient", **BODY, "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 1e-4, "Time/End time": 4e-4, "Observation/Energy interval": 0,
       "Observation/Reference x": 0.002}
WINDOW, SAMPLED = (2e-4, 4e-4), 1.6e-7  # s: the linear phase; samples of the histories
STEPS = (4e-8, 2e-8, 1e-8)  # s


def text(settings):
    return prm({key: value for key, value in settings.items() if value is not None})


def eigenvalues(folder, settings):
    """s (1/s) of the modes, the fastest growing first."""
    folder.write("modes.prm", text({**MODES, **settings}))
    folder.run(0, "contact_dynamics", "modes.prm", "--output", "modes")
    summary = folder.summary("modes")
    assert summary["missing_modes"] == 0 and summary["separated_nodes"] == 0, summary
    return np.array([complex(mode["growth_rate"], 2 * math.pi * mode["frequency"]) for mode in summary["complex_modes"]])


def seen(folder, dt, settings):
    """s (1/s) of the fastest growing vibration of the reference node, while all nodes slide."""
    folder.write("run.prm", text({**RUN, **settings}))
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
    expect_order_two(s, errors)


def expect_order_two(s, errors):
    # Damping acts half a step early: beta omega^2 dt / 4 of the frequency, of order one. All else is of order two.
    rest = [error.imag / s.imag - BETA * s.imag**2 * dt / 4 for error, dt in zip(errors, STEPS)]
    orders = [np.log2(np.abs(np.divide(values[:-1], values[1:]))) for values in (rest, [error.real for error in errors])]
    print("orders of frequency and growth rate:", *orders)
    assert np.abs(orders[0] - 2).max() < 0.05 and orders[1].min() > 1.9, orders


def check_springs(folder):
    """On springs along the flat, which change the growth by eight times its own, where friction rises with the slip rate."""
    law = {"Friction/Coefficient": None, "Friction/Coefficient law": "expression",
           "Friction/Coefficient expression": "max(0.05, 0.3 + 0.003*(V - 50))"}
    springs = {**law, "Flat/Tangential stiffness": 2e11}
    without, s = eigenvalues(folder, law)[0], eigenvalues(folder, springs)[0]
    errors = [seen(folder, dt, springs) - s for dt in STEPS]
    print(f"on springs: growth {s.real:.2f} 1/s, without {without.real:.2f}; errors of runs {errors}")
    expect_order_two(s, errors)
    assert 0 < 8 * s.real < without.real and abs(errors[-1].real) < 1e-3 * abs(s - without), (s, without, errors)


LAWS = {
    "static and kinetic": {"Friction/Coefficient": 0.4, "Friction/Kinetic coefficient": 0.28, "Friction/Critical velocity": 20},
    "expression": {"Friction/Coefficient": None, "Friction/Coefficient expression": "0.24 + 0.1*p/1e7 + 0.5*x"},
    "rate and state": {"Friction/Coefficient": 0.9, "Friction/Rate and state/Direct effect": 0.01,
                       "Friction/Rate and state/Evolution effect": 0.044, "Friction/Rate and state/Length": 2e-5}}


def check_laws(folder):
    """To 0.1 % with coefficients that depend on the slip rate, on pressure and place, and on rate and state. Without their slopes the
    growth rates would be others."""
    for name, constants in LAWS.items():
        law = {"Friction/Coefficient law": name, **constants}
        growing = eigenvalues(folder, law)
        with h5py.File(folder("modes", "complex_modes.h5")) as file:
            mu = file["complex_modes/contact/friction_coefficient"][()]
        assert growing[0].real > 3 * max(growing[1].real, 1000), growing
        found, s = seen(folder, 1e-8, law), growing[0]
        print(f"{name}: growth {found.real:.2f} 1/s, mode {s.real:.2f}; frequency {found.imag / 2 / math.pi:.2f} Hz, mode "
              f"{s.imag / 2 / math.pi:.2f}; mu {mu.min():.4f} to {mu.max():.4f}")
        assert abs(found.real / s.real - 1) < 1e-3 and abs(found.imag / s.imag - 1) < 1e-3, (name, found, s)
        if name != "expression":
            constant = eigenvalues(folder, {"Friction/Coefficient": mu[0]})[0]
            assert abs(constant.real / s.real - 1) > 0.01, (name, constant, s)



class Synthetic:
    """Snapshots that modes and a static displacement make up, as participation() reads them."""
    path = "synthetic"

    def __init__(self, modes, amplitudes, times):
        self.time = times
        generator = np.random.default_rng(2)
        shapes = modes["complex_modes/shape_real"] + 1j * np.asarray(modes["complex_modes/shape_imaginary"])
        rates = np.asarray(modes["complex_modes/growth_rate"]) + 2j * np.pi * np.asarray(modes["complex_modes/frequency"])
        phases = np.exp(2j * np.pi * generator.random(len(rates)))
        self.static = 1e-5 * generator.standard_normal(shapes.shape[1:])
        self.values = [self.static + np.tensordot(amplitudes * phases * np.exp(rates * t), shapes, 1).real for t in times]

    def __getitem__(self, name):
        return {"snapshots/time": self.time}[name]

    def snapshots(self):
        yield from zip(self.time, self.values)


def check_participation(folder):
    """Known amplitudes are found again; in the run of above the growing mode takes over, at its own rate."""
    eigenvalues(folder, {"Complex modes/Number of shapes": 6})
    window = 2e-5
    with mesoslip.open(folder("modes")) as modes:
        rates_of = np.asarray(modes["complex_modes/growth_rate"])
        given = np.array([1e-9, 3e-10, 2e-9, 1e-10, 5e-10, 1e-9])
        found = participation(Synthetic(modes, given, np.arange(101) * 1e-6), modes, window)
        exact = given * np.exp(np.outer(found.time, rates_of))
        assert found.amplitude.shape == (5, 6) and np.abs(found.amplitude / exact - 1).max() < 1e-6, found.amplitude / exact
        assert np.abs(found.explained - 1).max() < 1e-9, found.explained
        # By the formula, with the amplitudes given.
        shapes = modes["complex_modes/shape_real"] + 1j * np.asarray(modes["complex_modes/shape_imaginary"])
        frequencies = np.asarray(modes["complex_modes/frequency"])
        energy = [(a * abs(r + 2j * np.pi * f)) ** 2 * (np.abs(shape) ** 2).sum() for a, r, f, shape in zip(exact[2], rates_of, frequencies, shapes)]
        index = np.asarray(instability_index(found, modes))
        assert np.abs(index[2] / (rates_of * energy / np.sum(energy)) - 1).max() < 1e-5, index
        # Modes one by one: each has its own shape and that of the others as far as these are alike.
        times = np.arange(4001) * 1e-7
        overlap = np.abs(np.einsum("aijk,bijk->ab", shapes.conj(), shapes)) ** 2
        overlap /= np.outer(np.diag(overlap), np.diag(overlap)) ** 0.5
        for k in (0, 3):
            alone = np.asarray(assurance(Synthetic(modes, 1e-9 * (np.arange(6) == k), times), modes, frequencies[k]))
            assert np.abs(alone - overlap[k]).max() < 1e-3, (k, alone, overlap[k])
        expect_refused(lambda: assurance(Synthetic(modes, given, np.arange(9) * 1e-6), modes, frequencies[0]), "ten periods")
        two = participation(Synthetic(modes, given * [1, 1, 0, 0, 0, 0], np.arange(101) * 1e-6), modes, window, [1, 2])
        assert two.amplitude.shape == (5, 2) and two.explained.max() < 0.5, two
        expect_refused(lambda: participation(Synthetic(modes, given, np.arange(9) * 1e-6), modes, 2.5e-6), "too few")
        expect_refused(lambda: participation(Synthetic(modes, given, np.arange(3) * 1e-6), modes, window), "shorter window")
        folder.write("run.prm", text({**RUN, "Time/Time step": 1e-8, "Time/End time": 7.01e-4, "Snapshots/From": 5e-4,
                                        "Snapshots/Interval": 5e-7}))
        folder.run(0, "contact_dynamics", "run.prm", "--output", "run")
        with mesoslip.open(folder("run")) as run:
            found = participation(run, modes, window)
        growth = np.polyfit(found.time, np.log(found.amplitude[:, 0]), 1)[0]
        print(f"participation: growth {growth:.1f} 1/s, mode {rates_of[0]:.1f}; amplitudes at the end {found.amplitude[-1]}, "
              f"explained {found.explained[0]:.6f} to {found.explained[-1]:.6f}")
        assert abs(growth / rates_of[0] - 1) < 2e-3 and found.amplitude[-1].argmax() == 0 and found.explained.min() > 0.99, found
    check_reported(folder)


class Captions:
    def figure(self, figure, caption):
        return caption


def check_reported(folder):
    """The report says which mode has the shape of the vibration at the main frequency: of one that decays slowly, as the other is still small."""
    pair, = vibrating_modes.pairs(Chain([folder("modes"), folder("run")]))
    said = vibrating_modes.vibrating_modes(Captions(), *pair)
    assert "main frequency of the run, 165.6 kHz" in said and "has the shape of the mode at 165.6 kHz" in said, said


def expect_refused(action, words):
    try:
        action()
    except ValueError as error:
        assert words in str(error), error
        return
    raise AssertionError("no ValueError")


with tempfile.TemporaryDirectory() as path:
    scene = Folder(path)
    check_growth(scene)
    check_springs(scene)
    check_laws(scene)
    check_participation(scene)
