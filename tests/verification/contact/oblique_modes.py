"""Analysis complex modes in 3D against waves at an angle to the sliding of a layer, on a rigid flat and on springs: the continuous closed form, of which the error
is of order two in the cells, and the same cells in numpy, where a wave in a periodic layer leaves three unknowns a level."""

import cmath
import dataclasses
import math
import tempfile

import numpy as np

from scenes import Folder, prm

HEIGHT, DENSITY, SPEED, PRESSURE, VELOCITY = 0.016, 1900, 2560., 5e6, 4.
SHEAR = DENSITY * SPEED**2
LAME = 2 / 3 * SHEAR  # Poisson's ratio is 0.2
COMMON = {"Analysis": "complex modes", "Body/Density": DENSITY, "Sides/Periodic": "true", "Sides/Periodic in y": "true", "Supports/Top/Kind": "pressure",
          "Supports/Top/Held": "u_x, u_y", "Supports/Top/Pressure": PRESSURE, "Complex modes/Lowest frequency": 40e3,
          "Complex modes/Highest frequency": 50e3}
STIFFNESS = [[LAME + 2 * SHEAR * (i == j) if max(i, j) < 3 else SHEAR * (i == j) for j in range(6)] for i in range(6)]
DIAGONAL = (STIFFNESS[0][0], LAME, LAME, STIFFNESS[0][0], LAME, STIFFNESS[0][0], SHEAR, SHEAR, SHEAR)  # as Body/Stiffness has it
ANGLES = (0, 30, 45, 60)


@dataclasses.dataclass(frozen=True)
class Sliding:
    """Friction with delta (s) on springs of the flat (Pa/m), normal and tangential, beta (s), and the number k (1/m) of the wave."""
    delta: float = 0.
    beta: float = 2e-8
    springs: float = math.inf
    mu: float = 0.4
    number: float = 1 / HEIGHT
    along: float = math.inf

    def keys(self):
        """Of the program."""
        springs = {"Flat/Normal stiffness": self.springs, "Flat/Tangential stiffness": self.along}
        return {"Friction/Coefficient": self.mu, "Friction/Regularization time": self.delta, "Time/Rayleigh beta": self.beta,
                **{key: value for key, value in springs.items() if value < math.inf}}


PLAIN, REGULARIZED = Sliding(), Sliding(1.5e-6, 4.4e-9)


def closed(s, angle, law):
    """Zero for a wave exp(i k (x cos t + y sin t) + s t) of the layer that slides along x: a wave in the vertical plane along its direction
    and one of shear across it, which meet in the friction alone (the balance of both tangential forces at the flat). In the plane a
    dilatation A sinh(a z) / cosh(a H) and a shear B cosh(b z) / cosh(b H), z from the top down, have sigma_zz = springs u_z at the flat. The
    tangential springs are in series with the drag of friction."""
    k, softening = law.number, 1 + law.beta * s
    inertia = s * s / softening
    a, b = cmath.sqrt(k**2 + inertia / (SPEED**2 * 1.6 / 0.6)), cmath.sqrt(k**2 + inertia / SPEED**2)
    friction, shear = law.mu / (1 + s * law.delta), SHEAR * softening
    drag, ta, tb = law.mu * PRESSURE / VELOCITY * s, cmath.tanh(a * HEIGHT), cmath.tanh(b * HEIGHT)
    drag /= 1 + s * law.delta + drag / law.along
    # u_z = -(a A + i k B), sigma_zz = shear ((b^2 + k^2) ta A + 2 i k b tb B)
    A, B = -1j * k - shear / law.springs * 2j * k * b * tb, a + shear / law.springs * (b**2 + k**2) * ta
    u, slope = (1j * k * ta * A - b * tb * B) / a, (-2j * k * a * A + (b**2 + k**2) * B) / a
    pressure = -shear * ((b**2 + k**2) * ta * A + 2j * k * b * tb * B) / a
    along, across = math.cos(angle), math.sin(angle)
    return (-(along * shear * slope + friction * pressure) * along * (shear * b + drag * tb)
            - across * (shear * slope - drag * u) * across * shear * b)


def zero(function, s, tolerance=1e-13):
    """By the secant method."""
    before, s = s, s * (1 + 1e-5)
    last, value = function(before), function(s)
    for _ in range(60):
        if value == last or abs(s - before) < tolerance * abs(s):
            break
        before, s, last = s, s - value * (s - before) / (value - last), value
        value = function(s)
    return s


def exact(law):
    """s (1/s) at all ANGLES, followed from 0 degrees, where the wave is the fastest of all at this length."""
    found, s = {}, complex(40e3, 2 * math.pi * 45.5e3)
    for degree in range(ANGLES[-1] + 1):
        s = zero(lambda z, t=math.radians(degree): closed(z, t, law), s)
        found[degree] = s
    return {degree: found[degree] for degree in ANGLES}


def cell_stiffness(h):
    """Of a brick, trilinear with 2 x 2 x 2 points of Gauss; and the places of its corners, x the fastest."""
    corners = [(i, j, k) for k in (0, 1) for j in (0, 1) for i in (0, 1)]
    total = np.zeros((24, 24))
    for point in np.array(corners) / math.sqrt(3) + (1 - 1 / math.sqrt(3)) / 2:
        strain = np.zeros((6, 24))
        for n, corner in enumerate(corners):
            value = [x if c else 1 - x for x, c in zip(point, corner)]
            dx, dy, dz = ((1 if corner[d] else -1) / h[d] * value[(d + 1) % 3] * value[(d + 2) % 3] for d in range(3))
            strain[:, 3 * n:3 * n + 3] = [[dx, 0, 0], [0, dy, 0], [0, 0, dz], [0, dz, dy], [dz, 0, dx], [dy, dx, 0]]
        total += strain.T @ np.array(STIFFNESS) @ strain * np.prod(h) / 8
    return total, corners


def in_numpy(wave, h, n, start, law=PLAIN):
    """s (1/s) nearest to `start` under friction without delta along x, of displacements that have the phase exp(i wave.x) from one point to the
    next, on `n` levels of cells: [s^2 M + s beta K' + K'] u = f with K' = K - N, and drag across x that is f + s (C/k) f = -C s u."""
    cells, corners = cell_stiffness(h)
    phases = np.zeros((24, 6), complex)
    for c, corner in enumerate(corners):
        for d in range(3):
            phases[3 * c + d, 3 * corner[2] + d] = cmath.exp(1j * (wave[0] * h[0] * corner[0] + wave[1] * h[1] * corner[1]))
    of_cell, size = phases.conj().T @ cells @ phases, 3 * (n + 1)
    stiffness, across, mass = np.zeros((size, size), complex), np.zeros((size, 1)), np.full(size, DENSITY * np.prod(h))
    for level in range(n):
        stiffness[3 * level:3 * level + 6, 3 * level:3 * level + 6] += of_cell
    mass[:3] /= 2
    mass[-3:] /= 2
    stiffness[0] -= law.mu * stiffness[2]
    across[1], drag = 1, law.mu * PRESSURE * h[0] * h[1] / VELOCITY
    free = np.delete(np.arange(size), [2, size - 3, size - 2])
    stiffness, across, mass = stiffness[np.ix_(free, free)], across[free], mass[free, np.newaxis]
    zero, push = np.zeros_like(stiffness), across / mass
    if law.along == math.inf:
        linear = np.block([[zero, np.eye(len(free))], [-stiffness / mass, -law.beta * stiffness / mass - drag * push @ across.T]])
    else:
        yields, w = law.along * h[0] * h[1], 3e5 * mass[0, 0]  # f in the unit w
        linear = np.block([[zero, np.eye(len(free)), 0 * across], [-stiffness / mass, -law.beta * stiffness / mass, w * push],
                           [0 * across.T, -yields / w * across.T, np.array([[-yields / drag]])]])
    values = np.linalg.eigvals(linear)
    return values[np.argmin(abs(values - start))]


def nearest(folder, size, cells, direction, law, expected, ranks=1, count="true"):
    """The eigenvalue of the program nearest to `expected`, or to that which runs the other way."""
    expected = complex(expected.real, abs(expected.imag))
    folder.write("layer.prm", "set Dimension = 3\n" + prm({
        **COMMON, "Body/Stiffness": ", ".join(map(repr, DIAGONAL)), "Body/Size": ", ".join(map(repr, size)),
        "Body/Cells": "%d, %d, %d" % cells, "Flat/Velocity": ", ".join(repr(VELOCITY * d) for d in direction),
        **law.keys(), "Complex modes/Count modes": count}))
    folder.run(0, "contact_dynamics", "layer.prm", "--output", "layer", ranks=ranks)
    summary = folder.summary("layer")
    assert summary["missing_modes"] == (0 if count == "true" else None) and summary["separated_nodes"] == 0, summary
    found = np.array([complex(mode["growth_rate"], 2 * math.pi * mode["frequency"]) for mode in summary["complex_modes"]])
    return found[np.argmin(abs(found - expected))], expected


def found_along(folder, degree, law, s, n):
    """s of a wave along x under a flat that moves at an angle to it, so that one cell across is enough. Modes are counted on the coarse cells."""
    length, angle = 2 * math.pi / law.number, math.radians(degree)
    return nearest(folder, (length, length / (2 * n), HEIGHT), (2 * n, 1, n), (math.cos(angle), -math.sin(angle)), law, s, count="true" if n == 8 else "false")


def check_order(folder):
    for law, degrees in ((PLAIN, ANGLES), (REGULARIZED, ANGLES), (Sliding(springs=1e13), (45,)), (Sliding(1.5e-6, 4.4e-9, 3e13), (30, 60)),
                         (Sliding(1.5e-6, 4.4e-9, 3e13, along=3e11), (30, 60))):
        for degree in degrees:
            s, errors = exact(law)[degree], []
            for n in (8, 16):
                found, expected = found_along(folder, degree, law, s, n)
                errors.append(abs(found - expected) / abs(s))
            order = math.log2(errors[0] / errors[1])
            print(f"{degree} degrees, delta {law.delta:g} s, springs {law.springs:g}, {law.along:g} Pa/m: growth {found.real:.1f} (exact {s.real:.1f}) 1/s at "
                  f"{found.imag / 2 / math.pi:.1f} ({abs(s.imag) / 2 / math.pi:.1f}) Hz; errors {errors[0]:.2%}, {errors[1]:.2%} of s, order {order:.3f}")
            assert abs(order - 2) < 0.05 and errors[1] < 0.003 and abs(found.real / s.real - 1) < 0.01, (degree, law, errors)


def check_known(folder):
    """Of a derivation by others, for G = 12.5 GPa: growth (1/s) and frequency (Hz) along x of kH = 1.15 on three flats. Extrapolated to no cells, and
    what the springs change to a thousandth."""
    rigid = error_of_rigid = 0
    for springs, growth, frequency in ((math.inf, 30030.410, 49264.050), (1e15, 30025.295, 49227.795), (1e13, 28061.032, 45707.747)):
        law = Sliding(0, 0, springs * SHEAR / 12.5e9, 0.25, 1.15 / HEIGHT)
        s = zero(lambda z, law=law: closed(z, 0., law), complex(30e3, 2 * math.pi * 48e3))
        assert abs(s - complex(growth, 2 * math.pi * frequency)) < 0.01, (springs, s)
        coarse, fine = (found_along(folder, 0, law, s, n)[0] for n in (8, 16))
        order, limit = math.log2(abs(coarse - s) / abs(fine - s)), fine + (fine - coarse) / 3
        if springs == math.inf:
            rigid, error_of_rigid = s, limit - s
        change = abs(limit - s - error_of_rigid) / max(abs(s - rigid), 1)
        print(f"springs {springs:g} Pa/m: {limit.real:.1f} (known {growth}) 1/s at {limit.imag / 2 / math.pi:.1f} ({frequency}) Hz, order {order:.3f}, "
              f"{abs(limit - s) / abs(s):.1e} of s from it, change from the rigid flat within {change:.1e}")
        assert abs(order - 2) < 0.05 and abs(limit - s) < 5e-5 * abs(s) and change < 1e-3, (springs, limit, s, change)


def check_count(folder):
    """All modes up to 200 kHz of a layer full of waves in all directions: the count takes some factorizations a shift, not hundreds."""
    wave = (PLAIN.number * math.cos(math.pi / 6), PLAIN.number * math.sin(math.pi / 6))
    size = (2 * math.pi / wave[0], 2 * math.pi / wave[1], HEIGHT)
    folder.write("layer.prm", "set Dimension = 3\n" + prm({
        **COMMON, "Body/Stiffness": ", ".join(map(repr, DIAGONAL)), "Body/Size": ", ".join(map(repr, size)), "Body/Cells": "5, 5, 3",
        "Flat/Velocity": f"{VELOCITY}, 0", "Friction/Coefficient": PLAIN.mu, "Friction/Regularization time": 0, "Time/Rayleigh beta": PLAIN.beta,
        "Complex modes/Lowest frequency": 0, "Complex modes/Highest frequency": 200e3}))
    folder.run(0, "contact_dynamics", "layer.prm", "--output", "layer")
    summary = folder.summary("layer")
    print({key: summary[key] for key in ("missing_modes", "shifts", "factorizations", "solves")})
    assert summary["missing_modes"] == 0 and summary["factorizations"] < 30 * summary["shifts"], summary


def check_cells(folder):
    """Waves at 30 and 45 degrees to the sides of the cells as numpy has them; what is left to the closed form is that of the cells."""
    soft = Sliding(along=3e11)
    for law, degree, cells, ranks in ((PLAIN, 30, (8, 6, 4), 1), (PLAIN, 30, (8, 6, 4), 2), (PLAIN, 45, (7, 7, 5), 3), (soft, 30, (8, 6, 4), 1),
                                      (soft, 45, (7, 7, 5), 3)):
        s, angle = exact(law)[degree], math.radians(degree)
        wave = (PLAIN.number * math.cos(angle), PLAIN.number * math.sin(angle))
        size = (2 * math.pi / wave[0], 2 * math.pi / wave[1], HEIGHT)
        cell = tuple(length / n for length, n in zip(size, cells))
        of_cells = in_numpy(wave, cell, cells[2], s, law)
        found, expected = nearest(folder, size, cells, (1, 0), law, of_cells, ranks, "false")
        print(f"{degree} degrees, {law.along:g} Pa/m, {cells} cells, {ranks} ranks: {abs(found - expected) / abs(s):.1e} from numpy, "
              f"{abs(of_cells - s) / abs(s):.2%} from the closed form")
        assert abs(found - expected) < 1e-8 * abs(s), (degree, found, expected)


def check_discretization():
    """In numpy, cells at an angle to the wave: order two down to fine ones."""
    s, angle = exact(PLAIN)[30], math.radians(30)
    wave, errors = (PLAIN.number * math.cos(angle), PLAIN.number * math.sin(angle)), []
    for n in (8, 16, 32, 64):
        cell = (math.pi / wave[0] / n, math.pi / wave[1] / n, HEIGHT / n)
        errors.append(abs(in_numpy(wave, cell, n, s) - s) / abs(s))
    print("30 degrees, 2n x 2n x n cells, n = 8, 16, 32, 64: errors", ", ".join(f"{error:.3%}" for error in errors))
    assert abs(np.log2(np.divide(errors[:-1], errors[1:])) - 2).max() < 0.03 and errors[-1] < 5e-4, errors


if __name__ == "__main__":
    check_discretization()
    with tempfile.TemporaryDirectory() as path:
        scene = Folder(path)
        check_order(scene)
        check_known(scene)
        check_count(scene)
        check_cells(scene)
