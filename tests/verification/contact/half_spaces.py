"""Half spaces of equal density that slide on each other: complex modes of bodies two waves deep, whose far sides absorb waves, against the interface waves of Adams
(1995) and Ranjith and Rice (2001), which grow by friction alone; and, without friction, the generalized Rayleigh wave.

Waves exp(i k x + s t) that vanish far from the contact, with s = k c_s1 S: u_y and sigma_yy are the same on both sides, sigma_xy is mu sigma_yy. In bodies
of finite depth waves come back from their far sides, with dashpots and springs there; the modes have to converge to these. How deep a body has to be
follows from the closed forms: two waves for 0.03 % of the speed of both waves at c_s2 / c_s1 = 1.1, 2.1 for 1 % of the growth, 1/130 of the angular
frequency. At 1.3 it takes six: the wave is as fast as S waves of the slower body, decays slowly with the depth, and meets the dashpots at a grazing angle."""

import tempfile

import numpy as np

from scenes import Folder, prm

MU, POISSON, DENSITY, SPEED, LENGTH, DEPTH, SPRINGS = 0.25, 0.25, 2000.0, 2000.0, 10e-3, 2, 1e10
K = 2 * np.pi / LENGTH
PRESSURE_OVER_SHEAR = np.sqrt(2 * (1 - POISSON) / (1 - 2 * POISSON))  # of the wave speeds
# Of the literature, for c_s2 / c_s1: S with friction, and the speed without.
KNOWN = {1.1: (0.007151 + 0.958558j, 0.958669), 1.3: (0.007921 + 1.001535j, 0.998005)}


def waves(body, ratio, s):
    """Shear modulus, impedances along x and y, and decay with the depth of P and S waves of a body, and the side of the contact on which it lies."""
    speed, side = ((SPEED, 1), (ratio * SPEED, -1))[body]
    p, q = np.sqrt(K * K + s * s / (speed * PRESSURE_OVER_SHEAR)**2 + 0j), np.sqrt(K * K + s * s / speed**2 + 0j)
    return DENSITY * speed**2, DENSITY * speed * np.array([1, PRESSURE_OVER_SHEAR]), p, q, side


def determinant(s, ratio, mu, depth=None):
    """Of the conditions at the contact; with a depth (in waves) those at the far sides, too, to which the waves grow that come from there."""
    kinds = 2 if depth is None else 4
    conditions = np.zeros((2 * kinds, 2 * kinds), complex)
    for body in range(2):
        shear, impedances, p, q, side = waves(body, ratio, s)
        decays, one, of_shear = np.array([p, q, -p, -q])[:kinds], np.ones(kinds), np.arange(kinds) % 2
        # phi = A exp(-side p y), psi = B exp(-side q y), u_x = phi_x + psi_y, u_y = phi_y - psi_x; over K and rho c_s1^2 K^2
        u = np.where(of_shear, [-side * decays, -1j * K * one], [1j * K * one, -side * decays]) / K
        normal, along = (q * q + K * K) * one, 2j * K * side * decays
        stress = shear * np.where(of_shear, [normal, along], [-along, normal]) / (DENSITY * SPEED**2 * K * K)
        at = lambda y, decays=decays: np.exp(-decays * LENGTH * (y - np.where(np.arange(kinds) < 2, 0, depth or 0)))
        own = slice(kinds * body, kinds * (body + 1))
        conditions[0, own], conditions[1, own] = side * u[1] * at(0), side * stress[1] * at(0)
        conditions[2 + body, own] = (stress[0] - mu * stress[1]) * at(0)
        if depth is not None:
            carried = (SPRINGS + impedances * s)[:, None] / (DENSITY * SPEED**2 * K) * u
            conditions[4 + 2 * body:6 + 2 * body, own] = (side * stress + carried) * at(depth)
    return np.linalg.det(conditions)


def root(ratio, mu, guess, depth=None):
    """S by secants."""
    s = guess * K * SPEED
    before, value = s * (1 + 1e-4), determinant(s * (1 + 1e-4), ratio, mu, depth)
    for _ in range(60):
        now = determinant(s, ratio, mu, depth)
        if now == value or abs(s - before) < 1e-14 * abs(s):
            break
        s, before, value = s - now * (s - before) / (now - value), s, now
    return s / (K * SPEED)


def modes(folder, ratio, mu, cells):
    """S of the modes about the speed of interface waves."""
    keys = {"Analysis": "complex modes", "Sides/Periodic": "true", "Flat/Velocity": 10, "Friction/Coefficient": mu, "Friction/Law": "coulomb", "Time/Rayleigh beta": 0,
            "Complex modes/Lowest frequency": 0.85 * K * SPEED / (2 * np.pi), "Complex modes/Highest frequency": 1.06 * K * SPEED / (2 * np.pi),
            "Complex modes/Fastest decay": 2000}
    for body, side, speed in (("", "Top", SPEED), ("Counter body/", "Bottom", ratio * SPEED)):
        shear = DENSITY * speed**2
        along = shear * PRESSURE_OVER_SHEAR**2
        keys |= {f"{body or 'Body/'}{key}": value for key, value in {
            "Stiffness": f"{along}, {along - 2 * shear}, {along}, {shear}", "Density": DENSITY, "Size": f"{LENGTH}, {DEPTH * LENGTH}",
            "Cells": f"{cells}, {DEPTH * cells}"}.items()}
        # Absorbing, and on soft springs, which carry the load.
        keys |= {f"{body}Supports/{side}/{key}": value for key, value in {
            "Kind": "springs", "Spring stiffness": f"{SPRINGS}, {SPRINGS}", "Pressure": 5e6,
            "Dashpot": f"{DENSITY * speed}, {DENSITY * speed * PRESSURE_OVER_SHEAR}"}.items()}
    folder.write("modes.prm", prm(keys))
    folder.run(0, "contact_dynamics", "modes.prm", "--output", "modes", "--quiet")
    return np.array([complex(mode["growth_rate"], 2 * np.pi * mode["frequency"]) for mode in folder.summary("modes")["complex_modes"]]) / (K * SPEED)


def check_depth():
    """Without runs: what comes back from the far sides falls with exp(-2 q H) of the slower S waves, q^2 = K^2 + s^2 / c_S^2."""
    for ratio, mu, depth, of_growth, of_speed in ((1.1, MU, 2, 0.014, 3e-4), (1.1, MU, 2.1, 0.01, 2e-4), (1.1, 0.0, 2, None, 3e-4), (1.3, MU, 6, 0.01, 1e-4)):
        exact = root(ratio, mu, KNOWN[ratio][0] if mu else 1j * KNOWN[ratio][1])
        found, deeper = (root(ratio, mu, exact, d) for d in (depth, 1.5 * depth))
        growth, speed = found.real / exact.real - 1 if mu else 0.0, found.imag / exact.imag - 1
        falls = np.log(abs((found - exact) / (deeper - exact))) / (2 * np.pi * depth * np.sqrt(1 + exact**2).real)
        print(f"c_s2 / c_s1 {ratio}, mu {mu}, {depth} waves deep: errors {growth:.2%} of the growth, {speed:.3%} of the speed; they fall with {falls:.3f} of the rate")
        assert abs(growth) < (of_growth or 1) and abs(speed) < of_speed and abs(falls - 1) < 0.05, (ratio, mu, depth, growth, speed, falls)
    assert abs(root(1.3, MU, KNOWN[1.3][0], 5).real / root(1.3, MU, KNOWN[1.3][0]).real - 1) > 0.01


def main():
    for ratio, (known, rayleigh) in KNOWN.items():
        assert abs(root(ratio, MU, known) - known) < 1e-6 and abs(root(ratio, 0.0, 1j * rayleigh) - 1j * rayleigh) < 1e-6, ratio
    check_depth()
    with tempfile.TemporaryDirectory() as path:
        for mu, start in ((MU, KNOWN[1.1][0]), (0.0, 1j * KNOWN[1.1][1])):
            exact, errors = root(1.1, mu, start, DEPTH), []
            for cells in (10, 20):
                found = modes(Folder(path), 1.1, mu, cells)
                S = found[np.argmin(np.abs(found - exact))]
                errors.append((S.real / exact.real - 1, S.imag / exact.imag - 1))
                print(f"mu {mu}, {cells} cells a wave: S = {S:.6f}, exact {exact:.6f}, errors {errors[-1][0]:.2%} of the growth, {errors[-1][1]:.3%} of the speed")
            orders = np.log2(np.abs(np.divide(*errors)))
            assert np.abs(errors[1]).max() < 0.013 and abs(orders[1] - 2) < 0.05, (mu, errors, orders)
            # Without friction what little the dashpots take is the same on all cells to half a percent.
            assert abs(orders[0] - 2) < 0.05 and S.real == found.real.max() if mu else abs(errors[1][0]) < 0.005, (mu, found, errors, orders)


if __name__ == "__main__":
    main()
