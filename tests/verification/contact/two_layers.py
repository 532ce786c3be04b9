"""Sliding layers on each other: complex growth of the fastest waves against the dispersion relation, of order two, and bars that meet.

Waves exp(i k x + s t) in a layer whose far side holds u_x under a constant pressure: with p^2 = k^2 + s^2/c_P^2 and q^2 = k^2 + s^2/c_S^2 the displacements at the
contact follow from the tractions there. Friction is mu times the normal stress on both sides, so that u_y of both is the same where
C1_yy + mu C1_yx = C2_yy + mu C2_yx with the compliances C of the layers."""

import tempfile

import h5py
import numpy as np

from scenes import Folder, prm

MU, KH, HEIGHT, PRESSURE = 0.25, 1.15, 16e-3, 5e6
SHEAR, POISSON, SPEED = 12.5e9, 0.2, 2560.0
STEEL = {"young": 210e9, "poisson": 0.3, "density": 7800.0, "height": 10e-3}
LAYER = {"young": 2 * SHEAR * (1 + POISSON), "poisson": POISSON, "density": SHEAR / SPEED**2, "height": HEIGHT}
K = KH / HEIGHT
# Of the issue of the dispersion relation, by others: (growth in 1/s, frequency in Hz).
KNOWN = {"steel": (32581.173, -82220.890), "steel second": (21210.085, 52334.526)}


def moduli(layer):
    young, nu = layer["young"], layer["poisson"]
    lame, shear = young * nu / ((1 + nu) * (1 - 2 * nu)), young / (2 * (1 + nu))
    return lame, shear


def compliance(layer, s, side, k, held):
    """u_y at the contact y = 0 by sigma_yy = 1 and by sigma_xy = 1; the far side at y = side * height is under a constant pressure, or held along y, too."""
    lame, shear = moduli(layer)
    rho, far = layer["density"], side * layer["height"]
    p, q = np.sqrt(k * k + rho * s * s / (lame + 2 * shear) + 0j), np.sqrt(k * k + rho * s * s / shear + 0j)

    def fields(y):
        """u_x, u_y, sigma_yy, sigma_xy of the four partial waves: phi = exp(+-p y), psi = exp(+-q y), u_x = i k phi + psi', u_y = phi' - i k psi."""
        columns = []
        for sign in (1, -1):
            e = np.exp(sign * p * y)
            ux, uy, uy_y, ux_y = 1j * k * e, sign * p * e, p * p * e, 1j * k * sign * p * e
            columns.append([ux, uy, (lame + 2 * shear) * uy_y + lame * 1j * k * ux, shear * (ux_y + 1j * k * uy)])
        for sign in (1, -1):
            e = np.exp(sign * q * y)
            ux, uy, uy_y, ux_y = sign * q * e, -1j * k * e, -1j * k * sign * q * e, q * q * e
            columns.append([ux, uy, (lame + 2 * shear) * uy_y + lame * 1j * k * ux, shear * (ux_y + 1j * k * uy)])
        return np.array(columns).T

    near, at_far = fields(0.0), fields(far)
    system = np.array([at_far[0], at_far[1 if held else 2], near[2], near[3]])
    return [(near[1] @ np.linalg.solve(system, np.array(load, complex))) for load in ([0, 0, 1, 0], [0, 0, 0, 1])]


def mismatch(s, counter, k, held):
    of_first, of_second = compliance(LAYER, s, 1, k, False), compliance(counter, s, -1, k, held)
    return of_first[0] + MU * of_first[1] - of_second[0] - MU * of_second[1]


def root(guess, counter, k=K, held=False):
    """The wave next to the guess, by secants; `held`: the far side of the counter body does not move."""
    s, before = guess, guess * (1 + 1e-4)
    value = mismatch(before, counter, k, held)
    for _ in range(60):
        now = mismatch(s, counter, k, held)
        if now == value:
            break
        s, before, value = s - now * (s - before) / (now - value), s, now
        if abs(s - before) < 1e-12 * abs(s):
            break
    return s


def stiffness(layer):
    lame, shear = moduli(layer)
    return f"{lame + 2 * shear:.17g}, {lame:.17g}, {lame + 2 * shear:.17g}, {shear:.17g}"


def bodies(rows, counter):
    """Keys of two layers one wave long."""
    length = 2 * np.pi / K
    cells = round(length / HEIGHT * rows)
    return {"Body/Stiffness": stiffness(LAYER), "Body/Density": LAYER["density"], "Body/Size": f"{length:.17g}, {HEIGHT}", "Body/Cells": f"{cells}, {rows}",
            "Counter body/Stiffness": stiffness(counter), "Counter body/Density": counter["density"], "Counter body/Size": f"{length:.17g}, {counter['height']}",
            "Counter body/Cells": f"{cells}, {round(rows * counter['height'] / HEIGHT)}", "Sides/Periodic": "true",
            "Supports/Top/Kind": "pressure", "Supports/Top/Held": "u_x", "Supports/Top/Pressure": PRESSURE, "Flat/Velocity": 10, "Friction/Coefficient": MU,
            "Friction/Law": "coulomb", "Time/Rayleigh beta": 0}


def growth(folder, rows, counter, guesses):
    """The fastest waves of a run: of the Fourier coefficient of the pressure, which is a sum of exponentials (the matrix pencil of its samples)."""
    length = 2 * np.pi / K
    cells = round(length / HEIGHT * rows)
    wave = f"sin({K:.17g}*x)*exp(-((t-2e-5)/6e-6)^2)"
    keys = {**bodies(rows, counter), "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 1e-5,
            "Counter body/Supports/Bottom/Kind": "pressure", "Counter body/Supports/Bottom/Held": "u_x", "Counter body/Supports/Bottom/Pressure": PRESSURE,
            "Counter body/Supports/Bottom/Ramp": "smooth", "Counter body/Supports/Bottom/Ramp time": 1e-5,
            "Counter body/Supports/Bottom/Traction": f"0; 100*{wave}", "Time/End time": 2.6e-4, "Time/Safety factor": 0.5, "Contact map/Interval": 1e-6,
            "Contact map/Fields": "pressure", "Observation/Energy interval": 0}
    folder.write("run.prm", prm(keys))
    folder.run(0, "contact_dynamics", "run.prm", "--output", "run", "--quiet")
    with h5py.File(folder("run", "dynamics.h5")) as file:
        pressure, time = file["contact_map/pressure"][()][:, :cells], file["contact_map/time"][()]
    assert pressure[time > 1.2e-5].min() > 0, "all nodes touch"
    x = np.arange(cells) * length / cells
    late = time > 6e-5
    signal, dt = pressure[late] @ np.exp(-1j * K * x) / cells, time[1] - time[0]
    n = len(signal) // 2
    hankel = np.array([signal[i:i + n] for i in range(len(signal) - n)])
    left, sizes, right = np.linalg.svd(hankel, full_matrices=False)
    rank = max(8, (sizes > 1e-7 * sizes[0]).sum())
    V = right[:min(rank, 24)].conj().T
    s = np.log(np.linalg.eigvals(np.linalg.pinv(V[:-1]) @ V[1:]).conj()) / dt
    return [s[np.argmin(np.abs(s - guess))] for guess in guesses]


def check_layers(folder):
    exact = [root(complex(known[0], 2 * np.pi * known[1]), STEEL) for known in KNOWN.values()]
    for s, (rate, frequency) in zip(exact, KNOWN.values()):
        assert abs(s.real / rate - 1) < 1e-6 and abs(s.imag / (2 * np.pi * frequency) - 1) < 1e-8, (s, rate, frequency)
    errors = []
    for rows in (8, 16):  # finer grids let short waves grow out of round-off
        found = growth(folder, rows, STEEL, exact)
        errors.append([abs(a - b) / abs(b) for a, b in zip(found, exact)])
        print(f"{rows} rows: " + ", ".join(f"{s.real:.0f} 1/s at {s.imag / 2e3 / np.pi:.3f} kHz" for s in found) + f", errors {errors[-1][0]:.2%}, {errors[-1][1]:.2%}")
    orders = np.log2(np.divide(*errors))
    assert max(errors[1]) < 1.2e-3 and (abs(orders - 2) < 0.15).all(), (errors, orders)


def check_complex_modes(folder):
    """The fastest complex modes above a counter body whose bottom is held, of which each is a wave one, two or three times in the length; identical layers of
    which both far sides are held alike do not grow."""
    errors = []
    for rows in (8, 16, 32):
        folder.write("modes.prm", prm({"Analysis": "complex modes", **bodies(rows, STEEL), "Complex modes/Highest frequency": 1e5}))
        folder.run(0, "contact_dynamics", "modes.prm", "--output", "modes", "--quiet")
        found = [complex(mode["growth_rate"], 2 * np.pi * mode["frequency"]) for mode in folder.summary("modes")["complex_modes"]]
        assert len(found) == 4, found
        errors.append([])
        for s in found:  # waves along x and against it
            with np.errstate(all="ignore"):  # of guesses that lead nowhere
                waves = [root(guess, STEEL, number * K, True) for number in (1, 2, 3) for guess in (s, s.conjugate())]
            errors[-1].append(min(min(abs(wave - s), abs(wave.conjugate() - s)) for wave in waves if np.isfinite(wave)) / abs(s))
        print(f"{rows} rows: " + ", ".join(f"{s.real:.0f} 1/s at {s.imag / 2e3 / np.pi:.3f} kHz" for s in found) + ", errors " + ", ".join(f"{e:.1e}" for e in errors[-1]))
    orders = np.log2(np.divide(*errors[1:]))
    assert max(errors[-1]) < 6e-4 and (abs(orders - 2) < 0.1).all(), (errors, orders)
    keys = {**bodies(12, LAYER), "Supports/Top/Kind": "held", "Complex modes/Highest frequency": 1e5}
    del keys["Supports/Top/Held"], keys["Supports/Top/Pressure"]
    folder.write("modes.prm", prm({"Analysis": "complex modes", **keys}))
    folder.run(0, "contact_dynamics", "modes.prm", "--output", "modes", "--quiet")
    assert all(mode["growth_rate"] < 1e-3 * mode["frequency"] for mode in folder.summary("modes")["complex_modes"]), folder.summary("modes")["complex_modes"]


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as path:
        check_complex_modes(Folder(path))
        check_layers(Folder(path))
