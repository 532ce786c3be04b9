"""Growth rates of steady sliding: of the homogeneous pin over delta, and of each morphology at its delta."""

import csv
import os

import numpy as np

from mixture import coarsen, read_cells
from sliding_modes import SlidingPin, unstable_modes

CELLS = (140, 40)
SIZE = (0.056, 0.016)
FREQUENCIES = np.arange(36e3, 220e3, 4.5e3)  # where modes are looked for
DELTAS = (0.5e-6, 0.75e-6, 1e-6, 1.25e-6, 1.5e-6, 1.75e-6, 2e-6, 2.5e-6, 3e-6)
START, MODES = 1.5e-6, 5  # the modes are found here, and followed from here
MU, BETA, DENSITY = 0.25, 4.4e-9, 1770.


def homogeneous_pin(stiffness, delta, cells=CELLS):
    """stiffness: D11, D12, D22, D33 (Pa)."""
    d = matrices(np.array([stiffness]))
    return SlidingPin.build(np.zeros(cells[::-1], int), d, DENSITY, SIZE, MU, delta, BETA)


def heterogeneous_pin(rve, delta, cells=CELLS):
    """The morphology in the file `rve`, on coarser cells."""
    field, density, size = read_cells(rve)
    while field.shape[1] > cells[0]:
        field = coarsen(field)
    return SlidingPin.build(np.arange(field[..., 0].size).reshape(field.shape[:2]), matrices(field.reshape(-1, 4)), density,
                            size, MU, delta, BETA)


def matrices(stiffness):
    d = np.zeros((len(stiffness), 3, 3))
    d[:, 0, 0], d[:, 0, 1], d[:, 1, 1], d[:, 2, 2] = stiffness.T
    d[:, 1, 0] = d[:, 0, 1]
    return d


def find_modes(stiffness):
    """The MODES eigenvalues (1/s) of the homogeneous pin that grow fastest at START, by frequency."""
    return sorted(unstable_modes(homogeneous_pin(stiffness, START), FREQUENCIES)[:MODES], key=lambda s: s.imag)


def follow(stiffness, modes):
    """[delta][mode] eigenvalues of the homogeneous pin, each delta from its neighbour nearer to START."""
    found = {START: modes}
    for ordered in ([d for d in DELTAS if d > START], [d for d in DELTAS if d < START][::-1]):
        previous = modes
        for delta in ordered:
            pin = homogeneous_pin(stiffness, delta)
            previous = [pin.eigenvalue(s)[0] for s in previous]
            found[delta] = previous
    return np.array([found[d] for d in DELTAS])


def table(folder, stiffness, rves):
    """Computes or reads growth.csv: rows (name, delta, mode, growth, frequency); `rves` {seed: file}. Returns
    (modes [deltas][modes], {seed: [modes]})."""
    path = os.path.join(folder, "growth.csv")
    key = ",".join(f"{d:.6g}" for d in stiffness) + f";{sorted(rves)};{CELLS};{DELTAS};{MODES}"
    if not (os.path.exists(path) and _key_of(path) == key):
        modes = find_modes(stiffness)
        rows = [("homogeneous", delta, k, s) for delta, line in zip(DELTAS, follow(stiffness, modes))
                for k, s in enumerate(line)]
        for seed, rve in rves.items():
            pin = heterogeneous_pin(rve, START)
            rows += [(seed, START, k, pin.eigenvalue(s)[0]) for k, s in enumerate(modes)]
        os.makedirs(folder, exist_ok=True)
        with open(path, "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(["body", "delta [s]", "mode", "growth [1/s]", "frequency [Hz]", key])
            writer.writerows([n, d, k, repr(s.real), repr(s.imag / (2 * np.pi))] for n, d, k, s in rows)
    return _read(path)


def _key_of(path):
    with open(path, encoding="utf-8") as file:
        return next(csv.reader(file))[-1]


def _read(path):
    homogeneous, morphologies = np.full((len(DELTAS), MODES), complex(np.nan)), {}
    with open(path, encoding="utf-8") as file:
        for name, delta, mode, growth, frequency in list(csv.reader(file))[1:]:
            s = complex(float(growth), 2 * np.pi * float(frequency))
            if name == "homogeneous":
                homogeneous[[abs(d - float(delta)) < 1e-12 for d in DELTAS].index(True), int(mode)] = s
            else:
                morphologies.setdefault(int(name), np.full(MODES, complex(np.nan)))[int(mode)] = s
    return homogeneous, morphologies


def matching_delta(homogeneous, eigenvalue, mode):
    """delta (s) at which the homogeneous pin's mode grows as `eigenvalue`, by the slope at START; kept in the range
    of DELTAS."""
    k = DELTAS.index(START)
    slope = (homogeneous[k + 1, mode].real - homogeneous[k - 1, mode].real) / (DELTAS[k + 1] - DELTAS[k - 1])
    return float(np.clip(START + (eigenvalue.real - homogeneous[k, mode].real) / slope, DELTAS[0], DELTAS[-1]))
