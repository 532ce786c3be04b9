"""Growth of steady sliding: all modes that grow, of homogeneous pins over delta and of each morphology at its delta."""

import concurrent.futures
import dataclasses
import hashlib
import os
import time

import numpy as np
from scipy.optimize import linear_sum_assignment

import delta_rules
import sliding_search
from measures import sliding_rates
from mixture import coarsen, read_cells
from sliding_modes import SlidingPin

CELLS, FINER = (140, 40), ((280, 80), (560, 160))
SIZE = (0.056, 0.016)
LIMIT = 2 * np.pi * 350e3  # 1/s; searched at every delta
COUNTED = 2 * np.pi * 300e3  # 1/s; here the modes are counted as well
KEPT = -1e4  # 1/s; shapes of modes that decay faster are not stored
DELTAS = (0.5e-6, 0.75e-6, 1e-6, 1.25e-6, 1.5e-6, 1.75e-6, 2e-6, 2.5e-6, 3e-6)
START = 1.5e-6  # the morphologies' delta; the branches are followed from here
AT = DELTAS.index(START)
ALIKE = 0.9  # overlap of the shapes of one branch at neighbouring deltas, at least
MU, BETA, DENSITY = 0.25, 4.4e-9, 1770.
# A run of the homogeneous pin that keeps sliding: its growth is that of the eigenvalues from WINDOW on, until nodes leave the flat.
RAMPED = {"Flat/Velocity": 50, "Top/Ramp": "smooth", "Top/Ramp time": 1e-3, "Time/Time step": 4e-9, "Observation/History interval": 500,
          "Observation/Energy interval": 0}
WINDOW = (1.05e-3, 1.6e-3)  # s


@dataclasses.dataclass
class Found:
    """What a search left: modes that decay slower than KEPT, the fastest growing first."""
    eigenvalues: np.ndarray
    shapes: np.ndarray
    residual: float  # the largest of all modes found
    searched: float
    bound: float
    cpu_seconds: float

    @property
    def growing(self):
        return self.eigenvalues[self.eigenvalues.real > 0]


@dataclasses.dataclass
class Growth:
    """Eigenvalues (1/s) of pins that slide steadily. `paper` (eq. (10)) and `mean` (the mean stiffness of the morphologies):
    [deltas][branches], those that grow at one of the deltas, by frequency. `fastest`: largest growth of `mean` at each delta.
    `morphologies` {seed: the mode nearest in shape to each branch of `mean` that grows at START}, `overlaps` of these shapes,
    `leading` {seed: all growing modes}. `refined` {cells: the branches of `paper` that grow at START}, `seen` these in a run.
    `missed`: growing modes of `paper` at START up to COUNTED that the count has and the search has not."""
    paper: np.ndarray
    mean: np.ndarray
    fastest: np.ndarray
    morphologies: dict
    overlaps: dict
    leading: dict
    refined: dict
    seen: np.ndarray
    missed: int
    residual: float
    searched: float
    bound: float


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


def digest(pin, *others):
    """Of all that determines a result."""
    return _digest((pin.mass, pin.stiffness, pin.friction), pin.mu, pin.delta, pin.beta, *others)


def _digest(sparse_matrices, *others):
    result = hashlib.sha256(repr(others).encode())
    for matrix in sparse_matrices:
        for part in (matrix.data, matrix.indices, matrix.indptr):
            result.update(part.tobytes())
    return result.hexdigest()[:16]


def stored(folder, name, compute):
    """The arrays {name: array} that `compute` returns, or those it returned before."""
    path = os.path.join(folder, name + ".npz")
    if not os.path.exists(path):
        found = compute()
        os.makedirs(folder, exist_ok=True)
        part = f"{path}.{os.getpid()}.npz"  # another process may compute the same
        np.savez(part, **found)
        os.replace(part, path)
    with np.load(path) as file:
        return dict(file)


def radius_of(folder, pin):
    name = "radius-" + _digest((pin.stiffness, pin.friction))
    return float(stored(folder, name, lambda: {"radius": sliding_search.numerical_radius(pin)})["radius"])


def solved(folder, pin, limit=LIMIT):
    """The modes of the pin with frequencies up to `limit`, from `folder` where they are there."""
    def compute():
        begin = time.process_time()
        modes = sliding_search.search(pin, limit, radius_of(folder, pin))
        kept = modes.eigenvalues.real > KEPT
        return {"eigenvalues": modes.eigenvalues[kept], "shapes": modes.shapes[:, kept].astype(np.complex64),
                "residual": modes.residuals.max(), "searched": modes.searched, "bound": modes.bound,
                "cpu_seconds": time.process_time() - begin}
    return Found(**{name: value if value.ndim else float(value)
                    for name, value in stored(folder, "modes-" + digest(pin, limit, KEPT), compute).items()})


def counted(folder, stiffness):
    """How many growing modes up to COUNTED the search misses, by the argument principle."""
    pin = homogeneous_pin(stiffness, START)
    def compute():
        modes = sliding_search.search(pin, LIMIT).eigenvalues
        return {"missed": sliding_search.missed(pin, np.concatenate([modes, modes.conj()]), COUNTED)}
    return int(stored(folder, "count-" + digest(pin, COUNTED), compute)["missed"])


def finer(folder, stiffness, cells, eigenvalue):
    """The eigenvalue of the homogeneous pin on `cells` nearest to that on CELLS, at START."""
    pin = homogeneous_pin(stiffness, START, cells)
    name = "finer-" + digest(pin, complex(eigenvalue))
    return complex(stored(folder, name, lambda: {"eigenvalue": pin.eigenvalue(complex(eigenvalue))[0]})["eigenvalue"])


def overlap(first, second, mass):
    """|u^H M v| of the shapes in the columns of the two; 1 for equal ones."""
    return abs(first.conj().T @ (mass[:, None] * second))


def follow(searches, mass):
    """[deltas][branches] of `searches`, one a delta: the modes at START, each to its like at the next delta. Those that grow
    at some delta, by frequency at START; RuntimeError when one that grows belongs to none."""
    start = searches[AT]
    chains = {k: {AT: k} for k in range(len(start.eigenvalues))}  # {mode at START: {delta: mode there}}
    for steps in (range(AT + 1, len(searches)), range(AT - 1, -1, -1)):
        for here in steps:
            before = here - 1 if here > AT else here + 1
            alike = overlap(searches[before].shapes, searches[here].shapes, mass)
            for chain in chains.values():
                if before in chain and alike[chain[before]].max() > ALIKE:
                    chain[here] = int(np.argmax(alike[chain[before]]))
    lines = [[searches[i].eigenvalues[chain[i]] if i in chain else complex(np.nan, np.nan) for i in range(len(searches))]
             for chain in chains.values()]
    branches = np.array(sorted((line for line in lines if np.nanmax(np.real(line)) > 0), key=lambda line: line[AT].imag)).T
    for delta, found, line in zip(DELTAS, searches, branches):
        if sorted(line[line.real > 0], key=abs) != sorted(found.growing, key=abs) or np.isnan(line).any():
            raise RuntimeError(f"branches are not clear at delta = {delta:g} s: {line} for {found.growing}")
    return branches


def counterparts(found, branches, mean, mass):
    """The modes of `found` that are most like the modes `branches` (1/s) of `mean`, each taken once, and the overlaps."""
    columns = [int(np.argmin(abs(mean.eigenvalues - s))) for s in branches]
    alike = overlap(mean.shapes[:, columns], found.shapes, mass)
    rows, modes = linear_sum_assignment(-alike**2)
    return found.eigenvalues[modes], alike[rows, modes]


def add_run(study, prm):
    study.add("ramped", "contact_dynamics", prm, {"Body/Cells": list(CELLS), "Friction/Regularization time": START, **RAMPED,
                                                  "Time/End time": WINDOW[1]})


def compute(folder, jobs, paper, mean, rves, run):
    """Growth of pins with the stiffnesses `paper` and `mean` (D11, D12, D22, D33 in Pa) and the morphologies `rves`
    {seed: file}; `run` is the folder of add_run's. What is in `folder` already is taken from there."""
    with concurrent.futures.ProcessPoolExecutor(jobs) as pool:
        bodies = {name: [homogeneous_pin(stiffness, delta) for delta in DELTAS] for name, stiffness in (("paper", paper), ("mean", mean))}
        mass = bodies["paper"][0].mass.diagonal()
        whole = pool.submit(solved, folder, bodies["paper"][AT], np.inf)
        searches = {name: [pool.submit(solved, folder, pin) for pin in pins] for name, pins in bodies.items()}
        pins = {seed: pool.submit(solved, folder, heterogeneous_pin(rve, START)) for seed, rve in rves.items()}
        missed = pool.submit(counted, folder, paper)
        searches = {name: [task.result() for task in tasks] for name, tasks in searches.items()}
        branches = {name: follow(found, mass) for name, found in searches.items()}
        growing = [s for s in branches["paper"][AT] if s.real > 0]
        refined = {cells: [pool.submit(finer, folder, paper, cells, s) for s in growing] for cells in FINER}
        refined = {cells: np.array([task.result() for task in tasks]) for cells, tasks in refined.items()}
        pins = {seed: task.result() for seed, task in pins.items()}
    if len(whole.result().growing) != len(growing):
        raise RuntimeError(f"modes above {LIMIT / (2 * np.pi):g} Hz grow: {whole.result().growing}")
    start = branches["mean"][AT]
    rates = sliding_rates(run, *WINDOW)
    seen = np.array([rates[np.argmin(abs(rates - s))] for s in growing])
    matched = {seed: counterparts(found, start[start.real > 0], searches["mean"][AT], mass) for seed, found in pins.items()}
    every = [whole.result(), *searches["paper"], *searches["mean"], *pins.values()]
    return Growth(branches["paper"], branches["mean"][:, start.real > 0],
                  np.array([found.eigenvalues[0].real for found in searches["mean"]]),
                  {seed: values for seed, (values, _) in matched.items()}, {seed: overlaps for seed, (_, overlaps) in matched.items()},
                  {seed: found.growing for seed, found in pins.items()}, refined, seen, missed.result(),
                  max(found.residual for found in every), min(found.searched for found in every), whole.result().bound)


def matching_delta(growth, mode, eigenvalue):
    """delta (s) at which the homogeneous pin's mode grows as `eigenvalue`, by the slope at START; kept in the range of DELTAS."""
    slope = (growth.mean[AT + 1, mode].real - growth.mean[AT - 1, mode].real) / (DELTAS[AT + 1] - DELTAS[AT - 1])
    return float(np.clip(START + (eigenvalue.real - growth.mean[AT, mode].real) / slope, DELTAS[0], DELTAS[-1]))


def matching_delta_of_fastest(growth, seed):
    """delta (s) at which the fastest mode of the homogeneous pin, whichever it is, grows as that of the morphology."""
    return delta_rules.nearest_root(np.array(DELTAS), growth.fastest - growth.leading[seed][0].real)
