"""The parts of the prediction study that need no run of the programs, against exact answers.

    prediction.py <folder with the programs, not used>
"""

import os
import sys

import numpy as np

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
sys.path.insert(0, os.path.join(TOP, "applications", "studies", "prediction"))

import measures  # noqa: E402
import mixture  # noqa: E402
from dispersion import Layer, isotropic_layer  # noqa: E402
from sliding_modes import SlidingPin  # noqa: E402

HEIGHT = 0.016
PAPER = (36.54e9, 9.1e9, 47.26e9, 13.785e9)  # eq. (10)


def close(what, found, expected, tolerance):
    error = abs(found - expected) / abs(expected)
    print(f"{what}: {found:.9g}, expected {expected:.9g}, off by {error:.1e}")
    assert error < tolerance, what


def dispersion_relation():
    """Growth rates and frequencies of the isotropic layer that are known independently."""
    for kh, delta, beta, growth, frequency in ((1.15, 0., 0., 30030.410, 49264.050),
                                               (1., 1.5e-6, 4.4e-9, 23574.532, 45632.343)):
        layer = isotropic_layer(2560., 0.2, HEIGHT, 0.25, delta, beta)
        s = layer.root(kh / HEIGHT, complex(2e4, 2 * np.pi * 47e3))
        close(f"growth at kH = {kh}", s.real, growth, 1e-7)
        close(f"frequency at kH = {kh}", s.imag / (2 * np.pi), frequency, 1e-7)


def pin_converges_to_layer():
    """Cells of one wave length against the dispersion relation, isotropic and eq. (10): second order."""
    for layer in (isotropic_layer(2560., 0.2, HEIGHT, 0.25, 1.5e-6, 4.4e-9),
                  Layer(PAPER, 1770., HEIGHT, 0.25, 1.5e-6, 4.4e-9)):
        exact = layer.fastest(1. / HEIGHT, np.arange(40e3, 60e3, 4e3))
        assert exact.real > 1e3, exact
        d = layer.stiffness
        matrix = np.array([[d[0], d[1], 0], [d[1], d[2], 0], [0, 0, d[3]]])
        errors = []
        for n in (8, 16):
            pin = SlidingPin.build(np.zeros((n, 6 * n), int), [matrix], layer.density, (2 * np.pi * HEIGHT, HEIGHT),
                                   layer.mu, layer.delta, layer.beta, periodic=True, platen=False)
            found, _ = pin.eigenvalue(complex(exact.real, abs(exact.imag)))
            errors.append(abs(found - complex(exact.real, abs(exact.imag))))
        order = np.log2(errors[0] / errors[1])
        print(f"growth of {exact.real:.1f} 1/s at {abs(exact.imag) / 2 / np.pi:.1f} Hz, order of the cells {order:.3f}")
        assert 1.9 < order < 2.1, order


def mixtures():
    """Laminates with exact answers, and that every cell finds its mixture."""
    def plane_strain(e, nu=0.2):
        factor = e / ((1 + nu) * (1 - 2 * nu))
        return [factor * (1 - nu), factor * nu, factor * (1 - nu), e / (2 * (1 + nu))]
    soft, stiff = plane_strain(30e9), plane_strain(240e9)
    exact = [59.259259e9, 14.814815e9, 144.328704e9, 22.222222e9]
    for found, expected in zip(mixture.layers(soft, stiff, 0), exact):
        close("laminate normal to x", found, expected, 1e-7)
    turned = mixture.layers(soft, stiff, 1)
    assert np.allclose([turned[2], turned[1], turned[0], turned[3]], exact, rtol=1e-7), turned
    field = np.array([[soft, soft, soft, soft], [soft, stiff, soft, soft]])
    end_of_fibre = mixture.layers(soft, mixture.layers(soft, stiff, 1), 0)
    assert np.allclose(mixture.coarsen(field), [[end_of_fibre, soft]], rtol=1e-12), mixture.coarsen(field)
    assert np.allclose(mixture.coarsen(np.array([[stiff, soft]] * 2)), [[exact]], rtol=1e-7)


def spectrum():
    """A line between the bins, on a drift."""
    time = np.arange(0, 1e-3, 2e-7)
    frequency, amplitude = measures.main_line(time, 3e-6 * np.cos(2 * np.pi * 41234. * time) + 1e-3 * time + 1e-5)
    close("frequency of a line", frequency, 41234., 1e-5)
    close("its amplitude", amplitude, 3e-6, 2e-3)


if __name__ == "__main__":
    dispersion_relation()
    pin_converges_to_layer()
    mixtures()
    spectrum()
