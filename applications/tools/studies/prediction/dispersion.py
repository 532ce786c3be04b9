"""Exact growth of steady sliding: an elastic layer of height H on the moving flat, periodic in x.

Perturbations exp(i k x + s t); top: u_x = 0 and no normal stress; bottom: u_y = 0 and the shear stress of the regularized
law, sigma_xy = mu / (1 + s delta) sigma_yy. Orthotropic, C = beta K. s = growth rate + i angular frequency."""

import dataclasses

import numpy as np


@dataclasses.dataclass
class Layer:
    """stiffness: D11, D12, D22, D33 (Pa); density (kg/m^3); height (m); mu; delta, beta (s)."""
    stiffness: tuple
    density: float
    height: float
    mu: float
    delta: float
    beta: float

    def residual(self, k, s):
        """Dimensionless left side of the dispersion relation at the wave number k (1/m): zero for an eigenvalue s (1/s)."""
        d11, d12, d22, d33 = self.stiffness
        inertia = self.density * s * s / (1 + self.beta * s)
        # u_x = A sinh(q (H - y)), u_y = B cosh(q (H - y)): a quadratic for q^2, B = ratio A.
        p = d22 * (d11 * k**2 + inertia) + d33 * (d33 * k**2 + inertia) - (d12 + d33)**2 * k**2
        squares = np.roots([d22 * d33, -p, (d11 * k**2 + inertia) * (d33 * k**2 + inertia)])
        q = np.sqrt(squares.astype(complex))
        ratio = 1j * k * (d12 + d33) * q / (d22 * squares - d33 * k**2 - inertia)
        amplitude = np.array([ratio[1], -ratio[0]])  # A cosh(q H), so that u_y = 0 below
        normal = np.sum(amplitude * np.tanh(q * self.height) * (1j * k * d12 - d22 * q * ratio))
        shear = -d33 * np.sum(q * amplitude)
        return (shear - self.mu / (1 + s * self.delta) * normal) / (d33 * k * (abs(ratio).sum() + 1e-300))

    def root(self, k, start):
        """The eigenvalue near `start` by the secant method; nan when there is none."""
        s, previous = start, start * (1 + 1e-4)
        f, f_previous = self.residual(k, s), self.residual(k, previous)
        for _ in range(100):
            if f == f_previous:
                break
            s, previous, f_previous = s - f * (s - previous) / (f - f_previous), s, f
            if not np.isfinite(s):
                break
            f = self.residual(k, s)
            if abs(s - previous) < 1e-13 * abs(s):
                return s
        return complex(np.nan, np.nan)

    def fastest(self, k, frequencies=np.arange(20e3, 320e3, 4e3)):
        """The eigenvalue that grows fastest among those near `frequencies` (Hz), both ways of travelling."""
        best = complex(-np.inf, 0)
        for frequency in frequencies:
            for sign in (1, -1):
                s = self.root(k, complex(1e4, sign * 2 * np.pi * frequency))
                inside = frequencies[0] / 2 < abs(s.imag) / (2 * np.pi) < 1.5 * frequencies[-1]
                if inside and s.real > best.real and abs(s.real) < abs(s.imag):
                    best = s
        return best


def isotropic_layer(c_transversal, poisson_ratio, height, mu, delta, beta, density=1770.):
    """The layer of an isotropic solid, from its transversal wave speed (m/s)."""
    shear = density * c_transversal**2
    first = 2 * shear * poisson_ratio / (1 - 2 * poisson_ratio)
    return Layer((first + 2 * shear, first, first + 2 * shear, shear), density, height, mu, delta, beta)
