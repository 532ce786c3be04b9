"""Half spaces of equal density that slide on each other: complex modes of bodies three waves deep, whose far sides absorb waves, against the interface waves of Adams
(1995) and Ranjith and Rice (2001), which grow by friction alone; and, without friction, the generalized Rayleigh wave.

Waves exp(i k x + s t) that vanish far from the contact, with s = k c_s1 S: u_y and sigma_yy are the same on both sides, sigma_xy is mu sigma_yy."""

import tempfile

import numpy as np

from scenes import Folder, prm

MU, POISSON, DENSITY, SPEED, LENGTH, DEPTH = 0.25, 0.25, 2000.0, 2000.0, 10e-3, 3
K = 2 * np.pi / LENGTH
PRESSURE_OVER_SHEAR = np.sqrt(2 * (1 - POISSON) / (1 - 2 * POISSON))  # of the wave speeds
# Of the literature, for c_s2 / c_s1: S with friction, and the speed without.
KNOWN = {1.1: (0.007151 + 0.958558j, 0.958669), 1.3: (0.007921 + 1.001535j, 0.998005)}


def determinant(s, ratio, mu):
    conditions = np.zeros((4, 4), complex)
    for body, (speed, side) in enumerate(((SPEED, 1), (ratio * SPEED, -1))):
        shear = DENSITY * speed**2
        p, q = np.sqrt(K * K + s * s / (speed * PRESSURE_OVER_SHEAR)**2 + 0j), np.sqrt(K * K + s * s / speed**2 + 0j)
        # phi = A exp(-side p y), psi = B exp(-side q y), u_x = phi_x + psi_y, u_y = phi_y - psi_x
        uy = np.array([-side * p, -1j * K]) / K
        syy = shear * np.array([q * q + K * K, 2j * K * side * q]) / (DENSITY * SPEED**2 * K * K)
        sxy = shear * np.array([-2j * K * side * p, q * q + K * K]) / (DENSITY * SPEED**2 * K * K)
        own = slice(2 * body, 2 * body + 2)
        conditions[0, own], conditions[1, own], conditions[2 + body, own] = side * uy, side * syy, sxy - mu * syy
    return np.linalg.det(conditions)


def root(ratio, mu, guess):
    """S by secants."""
    s = guess * K * SPEED
    before, value = s * (1 + 1e-4), determinant(s * (1 + 1e-4), ratio, mu)
    for _ in range(60):
        now = determinant(s, ratio, mu)
        if now == value or abs(s - before) < 1e-14 * abs(s):
            break
        s, before, value = s - now * (s - before) / (now - value), s, now
    return s / (K * SPEED)


def fastest(folder, ratio, mu, cells):
    """S of the mode that grows most."""
    keys = {"Analysis": "complex modes", "Sides/Periodic": "true", "Flat/Velocity": 10, "Friction/Coefficient": mu, "Friction/Law": "coulomb", "Time/Rayleigh beta": 0,
            "Complex modes/Highest frequency": 1.06 * K * SPEED / (2 * np.pi)}
    for body, side, speed in (("", "Top", SPEED), ("Counter body/", "Bottom", ratio * SPEED)):
        shear = DENSITY * speed**2
        along = shear * PRESSURE_OVER_SHEAR**2
        keys |= {f"{body or 'Body/'}{key}": value for key, value in {
            "Stiffness": f"{along}, {along - 2 * shear}, {along}, {shear}", "Density": DENSITY, "Size": f"{LENGTH}, {DEPTH * LENGTH}",
            "Cells": f"{cells}, {DEPTH * cells}"}.items()}
        # Absorbing, and on soft springs, which carry the load.
        keys |= {f"{body}Supports/{side}/{key}": value for key, value in {
            "Kind": "springs", "Spring stiffness": "1e10, 1e10", "Pressure": 5e6,
            "Dashpot": f"{DENSITY * speed}, {DENSITY * speed * PRESSURE_OVER_SHEAR}"}.items()}
    folder.write("modes.prm", prm(keys))
    folder.run(0, "contact_dynamics", "modes.prm", "--output", "modes", "--quiet")
    mode = max(folder.summary("modes")["complex_modes"], key=lambda mode: mode["growth_rate"])
    return complex(mode["growth_rate"], 2 * np.pi * mode["frequency"]) / (K * SPEED)


def main():
    with tempfile.TemporaryDirectory() as path:
        for ratio, (known, rayleigh) in KNOWN.items():
            assert abs(root(ratio, MU, known) - known) < 1e-6 and abs(root(ratio, 0.0, 1j * rayleigh) - 1j * rayleigh) < 1e-6, ratio
        exact, errors = root(1.1, MU, KNOWN[1.1][0]), []
        for cells in (12, 24):
            S = fastest(Folder(path), 1.1, MU, cells)
            errors.append((S.real / exact.real - 1, S.imag / exact.imag - 1))
            print(f"{cells} cells a wave: S = {S:.6f}, errors {errors[-1][0]:.2%} of the growth, {errors[-1][1]:.3%} of the speed")
        orders = np.log2(np.divide(*errors))
        assert np.abs(errors[1]).max() < 0.01 and (np.abs(orders - 2) < 0.2).all(), (errors, orders)


if __name__ == "__main__":
    main()
