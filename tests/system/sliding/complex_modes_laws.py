"""Analysis complex modes with laws of the coefficient of friction: the shear vibration of a layer that a falling coefficient feeds, in
closed form, and what is said where it falls too fast; coefficients that do not change; the same pin in 3D; springs along the flat; friction that relaxes
slowly; what is refused."""

import cmath
import math
import tempfile

import h5py
import numpy as np
import scipy.linalg

from scenes import Folder, prm
from sliding_pin import SlidingPin

# The stiffness is that of eq. (10), of which the shear modulus takes part.
HEIGHT, DENSITY, SHEAR, PRESSURE, VELOCITY, TOP = 0.016, 1770, 13.785e9, 5e7, 2., 200e3
SPEED = math.sqrt(SHEAR / DENSITY)
LAYER = {"Analysis": "complex modes", "Body/Stiffness": f"36.54e9, 9.1e9, 47.26e9, {SHEAR}", "Body/Density": DENSITY,
         "Body/Size": f"{HEIGHT / 10}, {HEIGHT}", "Sides/Periodic": "true", "Supports/Top/Kind": "pressure", "Supports/Top/Held": "u_x",
         "Supports/Top/Pressure": PRESSURE, "Flat/Velocity": VELOCITY, "Complex modes/Highest frequency": TOP, "Complex modes/Fastest decay": 2000}
FALLING = {"Friction/Coefficient law": "static and kinetic", "Friction/Coefficient": 0.3, "Friction/Kinetic coefficient": 0.1,
           "Friction/Critical velocity": 1.}
STATE = {"Friction/Coefficient law": "rate and state", "Friction/Coefficient": 0.9, "Friction/Rate and state/Direct effect": 0.01,
         "Friction/Rate and state/Evolution effect": 0.05, "Friction/Rate and state/Length": 4e-6}
PLAIN, DAMPED = {"Friction/Regularization time": 0, "Time/Rayleigh beta": 0}, {"Friction/Regularization time": 1e-6, "Time/Rayleigh beta": 4.4e-9}


def modes(folder, settings, missing=0):
    folder.write("layer.prm", prm(settings))
    folder.run(0, "contact_dynamics", "layer.prm", "--output", "layer")
    summary = folder.summary("layer")
    assert summary["missing_modes"] == missing, summary
    return np.array([complex(mode["growth_rate"], 2 * math.pi * mode["frequency"]) for mode in summary["complex_modes"]])


def exact(slope, late, tau, law, order):
    """s (1/s) of u = sinh(k (H - y)) exp(s t), k = s/(c sqrt(1 + beta s)), whose shear stress at the flat is -d(s) times its velocity, in
    series with springs: sqrt(1 + beta s) rho c coth(k H) = -d/(1 + s delta + s d/k_t), d = p (slope + late/(1 + s tau))."""
    delta, beta, springs = law["Friction/Regularization time"], law["Time/Rayleigh beta"], law.get("Flat/Tangential stiffness", math.inf)

    def boundary(s):
        root, drag = cmath.sqrt(1 + beta * s), PRESSURE * (slope + late / (1 + s * tau))
        k = s / (SPEED * root)
        return root * DENSITY * SPEED * cmath.cosh(k * HEIGHT) + drag / (1 + s * delta + s * drag / springs) * cmath.sinh(k * HEIGHT)

    s = complex(0, (2 * order + 1) * math.pi * SPEED / (2 * HEIGHT))
    for _ in range(60):
        step = 1e-6 * abs(s)
        s -= boundary(s) * 2 * step / (boundary(s + step) - boundary(s - step))
    assert abs(boundary(s)) < 1e-7 * DENSITY * SPEED
    return s


def check_layer(folder):
    """Order two in the cells for laws of the rate and of rate and state, with and without regularization and damping."""
    impedance = DENSITY * SPEED
    falling, ageing = (-0.2 * math.exp(-2), 0, 0), (0.01 / VELOCITY, -0.05 / VELOCITY, 4e-6 / VELOCITY)
    closed = SPEED / HEIGHT * math.atanh(-PRESSURE * falling[0] / impedance)
    assert abs(exact(*falling, PLAIN, 0).real / closed - 1) < 1e-9, closed
    slip = {**STATE, "Friction/Rate and state/Evolution": "slip law"}
    # On springs so soft that friction alone would vibrate at 173 kHz, and on some that shift the frequency by a few per cent.
    soft, springs = {**PLAIN, "Flat/Tangential stiffness": 6.5e11, "Complex modes/Fastest decay": 3.2e5}, {**DAMPED, "Flat/Tangential stiffness": 1e13}
    for name, law, slopes, regularized in (("falling", FALLING, falling, PLAIN), ("falling, regularized and damped", FALLING, falling, DAMPED),
                                           ("falling, on springs", FALLING, falling, springs), ("rate and state, on springs", STATE, ageing, soft),
                                           ("rate and state", STATE, ageing, PLAIN), ("slip law, regularized and damped", slip, ageing, DAMPED)):
        wanted = [s for s in (exact(*slopes, regularized, order) for order in range(3)) if s.real > 0 and s.imag < 2 * math.pi * TOP]
        assert len(wanted) >= 1, wanted
        errors = []
        for n in (20, 40):
            found = modes(folder, {**LAYER, **law, **regularized, "Body/Cells": f"{n // 10}, {n}"})
            errors.append([abs(found - s).min() / abs(s) for s in wanted])
        orders = np.log2(np.divide(*errors))
        print(f"{name}: {wanted[0].real:.1f} 1/s at {wanted[0].imag / 2 / math.pi:.1f} Hz; errors {errors}, orders {orders}")
        assert np.abs(orders - 2).max() < 0.05 and errors[1][0] < 1e-4, (name, errors)


def check_impedance(folder):
    """Friction that falls by more than rho c with the slip rate: analysis and run warn, and name what regularization and damping leave, the s
    with sqrt(1 + beta s) (1 + delta s) = r; by less: nothing is said and the growth is c/H artanh r."""
    impedance = DENSITY * SPEED

    def law(r):
        return {**LAYER, **PLAIN, "Body/Cells": "2, 20", "Friction/Coefficient law": "expression",
                "Friction/Coefficient expression": f"0.3 - {r * impedance / PRESSURE!r}*(V - {VELOCITY})"}

    found = modes(folder, law(0.9))
    summary = folder.summary("layer")
    assert abs(found.real / (SPEED / HEIGHT * math.atanh(0.9)) - 1).min() < 0.01, found
    assert abs(summary["shear_impedance"] / impedance - 1) < 1e-12 and abs(summary["steepest_friction_fall"] / (0.9 * impedance) - 1) < 1e-6
    assert not any("shear waves" in warning for warning in summary["warnings"]), summary["warnings"]
    # Much of this grows without vibrating, on the real axis; what vibrates and grows faster than is counted is not said to be missing.
    for settings, bound, words, missing in ((PLAIN, None, "without a limit", None),
                                            ({**PLAIN, "Time/Rayleigh beta": 1e-6}, (1.2**2 - 1) / 1e-6, None, None),
                                            ({**PLAIN, "Friction/Regularization time": 1e-6}, 0.2 / 1e-6, None, 0)):
        modes(folder, {**law(1.2), **settings}, missing)
        said, = (warning for warning in folder.summary("layer")["warnings"] if "shear waves" in warning)
        assert f"{impedance:.3g} Pa s/m" in said and (words or f"by up to {bound:.3g} 1/s") in said, said
    run = {**law(1.2), "Analysis": "transient", "Time/End time": 1e-4}
    for settings, warned in (({}, True), ({"Friction/Regularization time": 1e-6}, False), ({"Supports/Top/Pressure": 0.8 * PRESSURE}, False)):
        given = {key: value for key, value in {**run, **settings}.items() if not key.startswith("Complex modes/")}
        folder.write("run.prm", prm(given))
        said = folder.run(0, "contact_dynamics", "run.prm", "--validate")
        assert ("shear waves into the body" in said) == warned, (settings, said)


def check_limits(folder):
    """A law that does not change in steady sliding is its constant."""
    grid = {**LAYER, **DAMPED, "Body/Cells": "2, 20", "Complex modes/Fastest decay": 20000}
    constant = modes(folder, {**grid, "Friction/Coefficient": 0.2})
    for law in ({"Friction/Coefficient law": "linear slip weakening", "Friction/Coefficient": 0.5, "Friction/Kinetic coefficient": 0.2},
                {"Friction/Coefficient law": "exponential slip weakening", "Friction/Coefficient": 0.5, "Friction/Kinetic coefficient": 0.2},
                {"Friction/Coefficient law": "expression", "Friction/Coefficient expression": "0.2"}):
        found = modes(folder, {**grid, **law})
        assert len(found) == len(constant) and np.abs(found / constant - 1).max() < 1e-9, (law, found, constant)
    rising = modes(folder, {**grid, "Friction/Coefficient law": "expression", "Friction/Coefficient expression": "0.18 + 0.01*V"})
    s = exact(0.01, 0, 0, DAMPED, 0)
    assert s.real < -5000 and abs(rising - s).min() < 1e-3 * abs(s), (rising, s)


PIN = {"Analysis": "complex modes", "Body/Stiffness": "36.54e9, 9.1e9, 47.26e9, 13.785e9", "Body/Density": DENSITY, "Body/Size": "0.012, 0.004",
       "Body/Cells": "24, 8", "Supports/Top/Kind": "platen", "Supports/Top/Pressure": 5e6, "Flat/Velocity": VELOCITY, "Friction/Regularization time": 4e-7,
       "Complex modes/Highest frequency": 1e6, "Complex modes/Fastest decay": 20000}
SLICE = {**PIN, "Body/Stiffness": "36.54e9, 8e9, 9.1e9, 40e9, 9e9, 47.26e9, 12e9, 13.785e9, 11e9", "Body/Size": "0.012, 0.0005, 0.004",
         "Body/Cells": "24, 1, 8"}


def check_slice(folder):
    """The modes of a plane pin are among those of a slice in 3D that is held across, with coefficients of slip rate, pressure and place."""
    law = {"Friction/Coefficient law": "expression", "Friction/Coefficient expression": "0.15 + 0.1*p/1e7 + 0.3*exp(-V) + 3*x"}
    plane = modes(folder, {**PIN, **law})
    folder.write("slice.prm", "set Dimension = 3\n" + prm({**SLICE, **law, "Supports/Front/Held": "u_y", "Supports/Back/Held": "u_y"}))
    for ranks in (1, 2):
        folder.run(0, "contact_dynamics", "slice.prm", "--output", "slice", ranks=ranks)
        summary = folder.summary("slice")
        found = np.array([complex(mode["growth_rate"], 2 * math.pi * mode["frequency"]) for mode in summary["complex_modes"]])
        assert summary["missing_modes"] == 0 and len(plane) >= 5, summary
        for s in plane:
            assert abs(found - s).min() < 1e-6 * abs(s), (ranks, s, found)


def dense(law, slopes, springs):
    """All s (1/s) of a small PIN on springs along the flat, by numpy: the form linear in u, v = s u, friction q and its part z by the state, with
    the drags of the nodes' static forces."""
    mu, (slope, late, tau), (nx, ny), beta, delta = law["mu"], slopes, (12, 4), 4.4e-9, PIN["Friction/Regularization time"]
    pin = SlidingPin.build(np.zeros((ny, nx), int), [[[36.54e9, 9.1e9, 0], [9.1e9, 47.26e9, 0], [0, 0, 13.785e9]]], DENSITY, (0.012, 0.004), mu, delta, beta)
    mass, stiffness, friction = (matrix.toarray() for matrix in (pin.mass, pin.stiffness, pin.friction))
    rows, n = np.flatnonzero(np.abs(friction).sum(1)), len(mass)
    load, area = np.zeros(n), np.full(nx + 1, 0.012 / nx)
    load[-1], area[[0, -1]] = -5e6 * 0.012, 0.006 / nx  # the platen is the last unknown
    G = mu * friction[rows]
    forces = G @ np.linalg.solve(stiffness - mu * friction, load) / mu
    E, one, w, scale = np.eye(n)[:, rows], np.eye(nx + 1), 2 * math.pi * 1e5, stiffness.diagonal().mean()
    at_once, delayed, slack = np.diag(forces * slope), np.diag(forces * late), np.diag(1 / (springs * area))
    zero = np.zeros((nx + 1, n))
    A = np.block([[np.zeros((n, n)), w * np.eye(n), zero.T, zero.T],
                  [-stiffness / w, -beta * stiffness, E * scale / w, zero.T],
                  [G / scale, w * (beta * G - at_once @ E.T) / scale, -one, one],
                  [zero, -w * delayed @ E.T / scale, 0 * one, -one]])
    B = scipy.linalg.block_diag(np.eye(n), mass, np.zeros((2 * nx + 2, 2 * nx + 2)))
    B[2 * n:, 2 * n:] = np.block([[delta * one + slack @ at_once, 0 * one], [slack @ delayed, tau * one]])
    values = scipy.linalg.eigvals(A, B)
    return values[np.isfinite(values)]


def check_springs(folder):
    """On springs along the flat all modes are those of numpy, where friction falls or lags behind a state, also on springs so soft that the state
    alone makes friction vibrate; with stiffer springs they come to those without in proportion to 1/k_t."""
    fallen = 0.1 + 0.2 * math.exp(-0.2)
    falling = {"mu": fallen, **FALLING, "Friction/Critical velocity": 10.}, (-0.02 * math.exp(-0.2), 0, 1e-6)
    law = {**STATE, "Friction/Coefficient": 0.4, "Friction/Rate and state/Direct effect": 0.02, "Friction/Rate and state/Evolution effect": 0.03}
    state = {"mu": None, **law}, (0.02 / VELOCITY, -0.03 / VELOCITY, 4e-6 / VELOCITY)
    small = {**PIN, "Body/Cells": "12, 4"}
    # Below p |mu'|/delta at the edges, or p b/L, springs let friction grow alone, which is not ruled out.
    for (law, slopes), springs, ranks, missing in ((falling, 1e12, 2, 0), (falling, 3e11, 1, None), (state, 1e12, 3, 0), (state, 5e10, 1, None)):
        given = {key: value for key, value in {**small, **law, "Flat/Tangential stiffness": springs}.items() if key != "mu"}
        folder.write("pin.prm", prm(given))
        folder.run(0, "contact_dynamics", "pin.prm", "--output", "pin", ranks=ranks)
        summary = folder.summary("pin")
        found = np.array([complex(mode["growth_rate"], 2 * math.pi * mode["frequency"]) for mode in summary["complex_modes"]])
        assert summary["separated_nodes"] == 0 and summary["missing_modes"] == missing, summary
        grows = any("Flat/Tangential stiffness times the regularization time" in warning for warning in summary["warnings"])
        assert grows == (springs == 3e11), summary["warnings"]
        with h5py.File(folder("pin", "complex_modes.h5")) as file:
            law["mu"] = law["mu"] or file["complex_modes/contact/friction_coefficient"][0]
        wanted = dense(law, slopes, springs)
        wanted = wanted[(wanted.real > -2e4) & (wanted.imag < 2e6 * math.pi) & (wanted.imag > -wanted.real) & (wanted.imag > 1)]
        errors = [abs(found - s).min() / abs(s) for s in wanted] + [abs(wanted - s).min() / abs(s) for s in found]
        print(f"{law['Friction/Coefficient law']}, springs of {springs:g} Pa/m: {len(found)} modes, errors {max(errors):.1e}")
        assert len(found) == len(wanted) >= 4 and max(errors) < 1e-8, (law, springs, found, wanted)
    for first, body in (("", {**small, **falling[0]}), ("set Dimension = 3\n", {**SLICE, "Body/Cells": "12, 1, 4", "Flat/Velocity": "0.03, 0.04"})):
        changes, rigid = [], None
        for springs in ("auto", 1e14, 1e15, 1e16):
            given = {key: value for key, value in {**body, "Flat/Tangential stiffness": springs}.items() if key != "mu"}
            folder.write("pin.prm", first + prm(given))
            folder.run(0, "contact_dynamics", "pin.prm", "--output", "pin")
            summary = folder.summary("pin")
            s = np.array([complex(mode["growth_rate"], 2 * math.pi * mode["frequency"]) for mode in summary["complex_modes"]])[:3]
            rigid = s if rigid is None else rigid
            changes.append(np.abs(s - rigid) / np.abs(rigid))
            assert summary["missing_modes"] == 0, summary
        print("changes by springs", changes[1:])
        assert np.abs(np.log10(np.divide(changes[2], changes[3])) - 1).max() < 0.02 and changes[1].max() > 1e-5, changes


def check_slow_friction(folder):
    """Friction that relaxes within a millisecond, as scipy has it by inverse iteration; within a second, as without friction. In 3D a
    flat so slow that it holds the nodes across its motion."""
    low = {"Complex modes/Lowest frequency": 5e3}
    for delta, tolerance in ((1e-3, 1e-8), (1, 1e-6)):
        found = modes(folder, {**PIN, **low, "Friction/Regularization time": delta})
        assert len(found) >= 4, found
        if delta < 1:  # the search, of a smaller pin as it is long, finds the same without a lowest frequency
            small = {**PIN, "Body/Cells": "12, 4", "Friction/Regularization time": delta}
            some, others = modes(folder, {**small, **low}), np.array(modes(folder, small))
            assert len(others) == len(some) >= 4 and all(abs(others - s).min() < 1e-9 * abs(s) for s in some), (others, some)
        pin = SlidingPin.build(np.zeros((8, 24), int), [[[36.54e9, 9.1e9, 0], [9.1e9, 47.26e9, 0], [0, 0, 13.785e9]]], DENSITY, (0.012, 0.004),
                               0.25 if delta < 1 else 0, delta, 4.4e-9)
        for s in found:
            other, _ = pin.eigenvalue(complex(s) * (1 + 1e-3))
            assert abs(other - s) < tolerance * abs(s), (delta, s, other)
    for settings, status in (({}, 3), (low, 0)):
        folder.write("slow.prm", "set Dimension = 3\n" + prm({**SLICE, "Body/Cells": "12, 1, 4", **settings, "Flat/Velocity": 1e-6}))
        said = folder.run(status, "contact_dynamics", "slow.prm", "--output", "slow")
        assert status == 0 or "Lowest frequency" in said, said
    assert folder.summary("slow")["missing_modes"] == 0 and len(folder.summary("slow")["complex_modes"]) >= 4


def check_refused(folder):
    expression = {"Friction/Coefficient law": "expression"}
    for settings, words in (({**expression, "Friction/Coefficient expression": "0.2 + t"}, ["Coefficient law", "depends on the time"]),
                            ({**expression, "Friction/Coefficient expression": "0.2 + 0.1*exp(-D)"}, ["Coefficient law", "goes on changing"]),
                            ({**expression, "Friction/Coefficient expression": "0.2 - 0.2*V"}, ["coefficient", "speed of the flat"]),
                            ({**FALLING, "Complex modes/Sweep": "friction coefficient", "Complex modes/Sweep values": "0.1"}, ["Sweep", "Coefficient law"]),
                            ({**FALLING, "Supports/Top/Kind": "held", "Supports/Top/Held": None}, ["Coefficient law", "top is held"]),
                            ({"Complex modes/Lowest frequency": 2 * TOP}, ["Lowest frequency", "Highest frequency"])):
        given = {**LAYER, "Body/Cells": "2, 20", **settings}
        folder.write("bad.prm", prm({key: value for key, value in given.items() if value is not None}))
        said = folder.run(2, "contact_dynamics", "bad.prm", "--validate")
        assert all(word in said for word in words), (settings, said)


def check_sweep_of_pressure(folder):
    """Each value as a run of its own, in the closed form of the layer: s = (c/H) artanh(-p mu'/(rho c)) for the fastest growth."""
    pressures, law = (1e7, 3e7), {**LAYER, **FALLING, **PLAIN, "Body/Cells": "4, 40"}
    folder.write("sweep.prm", prm({**law, "Complex modes/Sweep": "pressure", "Complex modes/Sweep values": ", ".join(map(str, pressures))}))
    folder.run(0, "contact_dynamics", "sweep.prm", "--output", "sweep")
    sweep = {case["value"]: case["complex_modes"] for case in folder.summary("sweep")["sweep"]}
    for pressure in pressures:
        alone = modes(folder, {**law, "Supports/Top/Pressure": pressure})
        swept = np.array([complex(mode["growth_rate"], 2 * math.pi * mode["frequency"]) for mode in sweep[pressure]])
        assert len(swept) and np.abs(swept - alone).max() < 1e-9 * np.abs(alone).max(), (pressure, swept, alone)
        closed = SPEED / HEIGHT * math.atanh(pressure * 0.2 * math.exp(-2) / (DENSITY * SPEED))
        assert abs(swept.real.max() / closed - 1) < 0.01, (pressure, swept, closed)


with tempfile.TemporaryDirectory() as path:
    scene = Folder(path)
    check_refused(scene)
    check_layer(scene)
    check_impedance(scene)
    check_limits(scene)
    check_slice(scene)
    check_springs(scene)
    check_slow_friction(scene)
    check_sweep_of_pressure(scene)
