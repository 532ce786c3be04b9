"""The parts of the prediction study against exact answers; growth of steady sliding also against a run."""

import os
import re
import sys
import tempfile
import types

import numpy as np

from scenes import TOOLS, TOP, Folder, sets
from sliding_pin import SlidingPin, friction_factors

sys.path[:0] = [os.path.join(TOOLS, "studies"), os.path.join(TOOLS, "studies", "prediction")]

import growth  # noqa: E402
import growth_page  # noqa: E402
import measures  # noqa: E402
import mixture  # noqa: E402
import redraw  # noqa: E402
from dispersion import Layer, isotropic_layer  # noqa: E402
from study import Result  # noqa: E402

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


def every_eigenvalue(pin):
    """Of the linear problem of sliding_pin.py, by dense matrices."""
    rows, reactions = (part if isinstance(part, np.ndarray) else part.toarray() for part in friction_factors(pin))
    n, m, per_mass = pin.mass.shape[0], len(rows), 1 / pin.mass.diagonal()[:, None]
    omega, force = 1e6, 1e10  # scale velocities and forces
    unit = np.zeros((n, m))
    unit[rows, np.arange(m)] = 1
    stiffness = per_mass * pin.stiffness.toarray()
    return np.linalg.eigvals(np.block([
        [np.zeros((n, n)), omega * np.eye(n), np.zeros((n, m))],
        [-stiffness / omega, -pin.beta * stiffness, pin.mu * force / omega * per_mass * unit],
        [reactions / (force * pin.delta), pin.beta * omega / (force * pin.delta) * reactions, -np.eye(m) / pin.delta]]))


def modes_of_the_study(folder, cells, delta):
    """The modes of the pin of eq. (10) as the study has them."""
    Folder(TOP).run(0, "contact_dynamics", "prm/prediction/contact_dynamics-modes.prm", "--output", folder, "--quiet", *sets(
        {"Body/Stiffness": ", ".join(map(repr, PAPER)), "Body/Cells": cells, "Friction/Regularization time": delta}))
    return growth.Modes.of(Result(folder, 0, 0., 0., ""))


def search_is_complete():
    """A small pin: every eigenvalue that grows, by the program and by dense matrices; shapes are those of unlike modes."""
    d = np.array([[PAPER[0], PAPER[1], 0], [PAPER[1], PAPER[2], 0], [0, 0, PAPER[3]]])
    dense = every_eigenvalue(SlidingPin.build(np.zeros((8, 28), int), [d], 1770., growth.SIZE, 0.25, 1.5e-6, 4.4e-9))
    growing = dense[(dense.real > 0) & (dense.imag > 0)]
    growing = growing[np.argsort(-growing.real)]
    with tempfile.TemporaryDirectory() as folder:
        found = modes_of_the_study(folder, "28, 8", 1.5e-6)
    assert np.all(growing.imag < 2 * np.pi * min(found.bound, found.searched)) and not found.missing, growing
    assert len(found.growing) == len(growing), (found.eigenvalues, growing)
    for one, exact in zip(found.growing, growing):
        close(f"growing mode at {exact.imag / 2e3 / np.pi:.2f} kHz", one, exact, 1e-8)
    alike = abs(found.shapes.conj() @ found.shapes.T)
    assert np.allclose(alike.diagonal(), 1), alike
    assert alike[~np.eye(len(alike), dtype=bool)].max() < 0.9, "two modes have one shape"


def growth_of_a_run():
    """contact_dynamics after a slow ramp, all nodes sliding: growth and frequency of the fastest mode and of that near 41.6 kHz."""
    delta, begin, end = 2.5e-6, 1.1e-3, 3e-3
    settings = {**growth.RAMPED, "Body/Cells": "28, 8", "Friction/Regularization time": delta, "Time/End time": end}
    with tempfile.TemporaryDirectory() as folder:
        Folder(TOP).run(0, "contact_dynamics", "prm/prediction/contact_dynamics-homogeneous.prm", "--output", folder, "--quiet", *sets(settings))
        seen = measures.sliding_rates(folder, begin, end)
    with tempfile.TemporaryDirectory() as folder:
        modes = modes_of_the_study(folder, "28, 8", delta).eigenvalues
    for s in (modes[0], modes[np.argmin(abs(modes.imag - 2 * np.pi * 41.6e3))]):
        line = seen[np.argmin(abs(seen - s))]
        close(f"growth of the run at {s.imag / 2e3 / np.pi:.2f} kHz", line.real, s.real, 1e-4)
        close("its frequency", line.imag, s.imag, 1e-5)


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


def growth_section():
    """The section of the page, from its table: numbers of the modes and the sentence on the search, as the page has them. What is in no
    table (the homogeneous pin's other delta, its shapes) is made up."""
    folder = os.path.join(TOP, "doc", "paper", "prediction")
    eigenvalue = lambda row: complex(float(row["growth [1/s]"]), 2 * np.pi * float(row["frequency [Hz]"]))
    lines, overlaps, leading, separated = {}, {}, {}, {1: 0, 6: 0, 8: 2}
    for row in redraw.rows_of(folder, "growth.csv"):
        seed = int(row["seed"])
        if row["mode"] == "fastest":
            leading[seed] = np.array([eigenvalue(row)])
            continue
        lines.setdefault(seed, []).append(eigenvalue(row))
        overlaps.setdefault(seed, []).append(float(row["overlap with the homogeneous pin's mode [-]"]))
    page = Folder(TOP).read("doc", "paper", "prediction.md").decode()
    rows = re.findall(r"^\| ([\d.]+) \| ([\d.]+ ± [\d.]+) \| ([\d.]+ to [\d.]+) \| (\d+) \| (\d+ ± \d+) \| (\d+) \|", page, re.MULTILINE)
    mean = np.array([complex(float(row[3]), 2e3 * np.pi * float(row[0])) for row in rows])
    slopes = mean * (1 - 0.1 * np.arange(-growth.AT, len(growth.DELTAS) - growth.AT))[:, None]
    found = growth.Growth(slopes, slopes, slopes.real.max(axis=1), {s: np.array(line) for s, line in lines.items()}, overlaps, leading, {}, mean,
                          {seed: separated.get(seed, 1) for seed in lines}, 0, 1e-12, 350e3, 2e6, 230e3)
    _, text, table, *_ = growth_page.prediction_section(types.SimpleNamespace(growth=found), [], {})
    assert len(rows) == 6 and all("| " + " | ".join(row) + " |" in table for row in rows), table
    sentence = "The modes of the morphologies were " + text.split("The modes of the morphologies were ")[1]
    assert sentence in page.replace("\n", " "), sentence


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
    growth_section()
    search_is_complete()
    growth_of_a_run()
