"""Growth of steady sliding: all modes that grow, of homogeneous pins over delta and of each morphology at its delta, by the
analysis of complex modes of contact_dynamics."""

import csv
import dataclasses
import os

import h5py
import numpy as np
from scipy.optimize import linear_sum_assignment

import delta_rules
from measures import sliding_rates
from mixture import write_coarse

CELLS, FINER = (140, 40), ((280, 80), (560, 160))
SIZE = (0.056, 0.016)
DELTAS = (0.5e-6, 0.75e-6, 1e-6, 1.25e-6, 1.5e-6, 1.75e-6, 2e-6, 2.5e-6, 3e-6)
START = 1.5e-6  # the morphologies' delta; the branches are named by their frequency here
AT = DELTAS.index(START)
# A run of the homogeneous pin that keeps sliding: its growth is that of the eigenvalues from WINDOW on, until nodes leave the flat.
RAMPED = {"Flat/Velocity": 50, "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 1e-3, "Time/Time step": 4e-9, "Observation/History interval": 500,
          "Observation/Energy interval": 0}
WINDOW = (1.05e-3, 1.6e-3)  # s


@dataclasses.dataclass
class Modes:
    """What a run of complex modes left: eigenvalues (1/s), the fastest growing first, and their shapes [modes][values], of
    which |first . conj(second)| is 1 for equal ones. `searched` and `bound` (Hz): all modes up to the first are known, none
    above the second can grow. `missing`: modes that the argument principle counts beside these."""
    eigenvalues: np.ndarray
    shapes: np.ndarray
    residual: float
    searched: float
    bound: float
    missing: int
    separated: int

    @classmethod
    def of(cls, result):
        summary, modes = result.summary, result.summary["complex_modes"]
        with h5py.File(os.path.join(result.folder, "complex_modes.h5"), "r") as file:
            shapes = file["complex_modes/shape_real"][()] + 1j * file["complex_modes/shape_imaginary"][()]
        shapes *= np.sqrt(_mass_of_nodes(*shapes.shape[1:3]))[..., None]
        shapes = shapes.reshape(len(shapes), -1)
        return cls(np.array([_eigenvalue(mode) for mode in modes]), shapes / np.linalg.norm(shapes, axis=1)[:, None],
                   max(mode["residual"] for mode in modes), summary["highest_frequency"], summary["nothing_grows_above"],
                   summary["missing_modes"], summary["separated_nodes"])

    @property
    def growing(self):
        return self.eigenvalues[self.eigenvalues.real > 0]


def _eigenvalue(mode):
    return complex(mode["growth_rate"], 2 * np.pi * mode["frequency"])


def _mass_of_nodes(rows, columns):
    """Up to a factor: a quarter of each cell at a node."""
    cells_at = [np.r_[1, np.full(n - 2, 2), 1] for n in (rows, columns)]
    return np.outer(*cells_at).astype(float)


@dataclasses.dataclass
class Growth:
    """Eigenvalues (1/s) of pins that slide steadily. `paper` (eq. (10)) and `mean` (the mean stiffness of the morphologies):
    [deltas][branches], those that grow at one of the deltas, by frequency. `fastest`: largest growth of `mean` at each delta.
    `morphologies` {seed: the mode nearest in shape to each branch of `mean` that grows at START}, `overlaps` of these shapes,
    `leading` {seed: all growing modes}. `refined` {cells: the branches of `paper` that grow at START}, `seen` these in a run.
    `separated` {cells or seed: contact nodes that are separated in the static state}. `missing`, `residual`, `searched` and
    `bound`: as in Modes, the worst of all; `searched` and `bound` of `paper`. `searched_morphologies` (Hz): up to there the
    modes of all morphologies are known."""
    paper: np.ndarray
    mean: np.ndarray
    fastest: np.ndarray
    morphologies: dict
    overlaps: dict
    leading: dict
    refined: dict
    seen: np.ndarray
    separated: dict
    missing: int
    residual: float
    searched: float
    bound: float
    searched_morphologies: float


def branches_of(result):
    """[deltas][branches] of a sweep: the curves that grow at some delta, by frequency at START. RuntimeError when one of them
    does not reach over all deltas."""
    curves = {}
    with open(os.path.join(result.folder, "complex_modes_sweep.csv"), encoding="ascii") as file:
        for row in csv.DictReader(file):
            s = complex(float(row["growth_rate [1/s]"]), 2 * np.pi * float(row["frequency [Hz]"]))
            curves.setdefault(row["curve [-]"], {})[float(row["regularization_time [s]"])] = s
    growing = [curve for curve in curves.values() if max(s.real for s in curve.values()) > 0]
    for curve in growing:
        if sorted(curve) != sorted(DELTAS):
            raise RuntimeError(f"a mode that grows is not followed over all delta: {curve}")
    return np.array([[curve[delta] for delta in DELTAS] for curve in sorted(growing, key=lambda curve: curve[START].imag)]).T


def counterparts(found, branches, mean):
    """The modes of `found` that are most like the modes `branches` (1/s) of `mean`, each taken once, and the overlaps."""
    rows = [_nearest(mean.eigenvalues, s) for s in branches]
    alike = abs(mean.shapes[rows].conj() @ found.shapes.T)
    rows, modes = linear_sum_assignment(-alike**2)
    return found.eigenvalues[modes], alike[rows, modes]


def _nearest(eigenvalues, s):
    return int(np.argmin(abs(eigenvalues - s)))


def add_runs(study, modes_prm, run_prm, paper, mean, rves):
    """Pins with the stiffnesses `paper` and `mean` (D11, D12, D22, D33 in Pa), the morphologies `rves` {seed: file} on CELLS,
    and a run of the first that keeps sliding."""
    def stiff(stiffness, cells=CELLS):
        return {"Body/Stiffness": [float(f"{d:.6g}") for d in stiffness], "Body/Cells": list(cells)}
    sweep = {"Complex modes/Sweep": "regularization time", "Complex modes/Sweep values": list(DELTAS)}
    for name, stiffness in (("paper", paper), ("mean", mean)):
        study.add(name, "contact_dynamics", modes_prm, {**stiff(stiffness), **sweep})
    for cells in FINER:
        study.add(f"paper-{cells[0]}", "contact_dynamics", modes_prm, {
            **stiff(paper, cells), "Complex modes/Highest frequency": 200e3, "Complex modes/Fastest decay": 0})
    for seed, rve in rves.items():
        study.add(f"rve-{seed}", "rve_homogenization", write_coarse(rve, study.path(f"map-{seed}"), 2))
        study.add(f"morphology-{seed}", "contact_dynamics", modes_prm,
                  {"Body/RVE file": f"{{rve-{seed}}}/rve.h5", "Body/Material": "heterogeneous"})
    study.add("ramped", "contact_dynamics", run_prm, {"Body/Cells": list(CELLS), "Friction/Regularization time": START, **RAMPED,
                                                      "Time/End time": WINDOW[1]})


def collect(results):
    """Growth of the runs of add_runs()."""
    paper, mean = branches_of(results["paper"]), branches_of(results["mean"])
    growing = paper[AT][paper[AT].real > 0]
    whole = {"paper": Modes.of(results["paper"]), "mean": Modes.of(results["mean"])}
    finer = {cells: Modes.of(results[f"paper-{cells[0]}"]) for cells in FINER}
    pins = {int(name.split("-")[1]): Modes.of(result) for name, result in results.items() if name.startswith("morphology-")}
    rates = sliding_rates(results["ramped"].folder, *WINDOW)
    matched = {seed: counterparts(found, mean[AT][mean[AT].real > 0], whole["mean"]) for seed, found in pins.items()}
    swept = [case for name in ("paper", "mean") for case in results[name].summary["sweep"]]
    every = [*whole.values(), *finer.values(), *pins.values()]
    return Growth(paper, mean[:, mean[AT].real > 0], np.max(mean.real, axis=1),
                  {seed: values for seed, (values, _) in matched.items()}, {seed: overlaps for seed, (_, overlaps) in matched.items()},
                  {seed: found.growing for seed, found in pins.items()},
                  {cells: np.array([found.growing[_nearest(found.growing, s)] for s in growing]) for cells, found in finer.items()},
                  np.array([rates[_nearest(rates, s)] for s in growing]),
                  {CELLS: whole["paper"].separated, **{key: found.separated for key, found in (*finer.items(), *pins.items())}},
                  sum(found.missing for found in every) + sum(case["missing_modes"] for case in swept),
                  max(found.residual for found in every), whole["paper"].searched, whole["paper"].bound, min(found.searched for found in pins.values()))


def matching_delta(growth, mode, eigenvalue):
    """delta (s) at which the homogeneous pin's mode grows as `eigenvalue`, by the slope at START; kept in the range of DELTAS."""
    slope = (growth.mean[AT + 1, mode].real - growth.mean[AT - 1, mode].real) / (DELTAS[AT + 1] - DELTAS[AT - 1])
    return float(np.clip(START + (eigenvalue.real - growth.mean[AT, mode].real) / slope, DELTAS[0], DELTAS[-1]))


def matching_delta_of_fastest(growth, seed):
    """delta (s) at which the fastest mode of the homogeneous pin, whichever it is, grows as that of the morphology."""
    return delta_rules.nearest_root(np.array(DELTAS), growth.fastest - growth.leading[seed][0].real)
