"""The stiffness of voxels beside that of FANS, a solver by Fourier transforms of its own authors (github.com/DataAnalyticsEngineering/FANS), with the same
elements: trilinear bricks with eight Gauss points (its HEX8), periodic. All 21 entries on three maps, and the time of both.

    ./run.sh benchmarks fans --fans PATH/OF/FANS

FANS is built apart, as its README says. Its own homogenized_tangent stops at a residual of 1e-6; here the columns are the mean
stresses of six load cases. It counts strains as 11, 22, 33, 12, 13, 23 in Mandel's notation and reads arrays [z][y][x], as we do.
"""

import json
import os
import subprocess

import h5py
import numpy as np

from common import cpu_seconds
from fits import median

VOIGT = ("xx", "yy", "zz", "yz", "xz", "xy")
FROM_MANDEL = [0, 1, 2, 5, 4, 3]
FACTOR = np.array([1, 1, 1, 2**0.5, 2**0.5, 2**0.5])
MATRIX, SPHERE, SOFT = (3.0, 0.3), (24.0, 0.2), (0.5, 0.4)  # GPa, -
STIFF = (300.0, 0.2)
TIGHT, USUAL = {"fans": 1e-10, "own": 1e-12}, {"fans": 1e-8, "own": 1e-8}
REPETITIONS = {64: 3, 128: 1}


def spheres(shape, number=14):
    """Overlapping spheres, periodic, some 30 %: 0 and 1 [z][y][x]."""
    random = np.random.default_rng(7)
    edges = np.array(shape) / max(shape)
    at = np.stack(np.meshgrid(*((np.arange(n) + 0.5) / max(shape) for n in shape), indexing="ij"), axis=-1)
    inside = np.zeros(shape, np.uint8)
    for centre, radius in zip(random.random((number, 3)) * edges, random.uniform(0.12, 0.21, number)):
        away = np.abs(at - centre)
        inside |= ((np.minimum(away, edges - away) ** 2).sum(axis=-1) < radius**2).astype(np.uint8)
    return inside


def three_phases(shape):
    return np.random.default_rng(11).choice(3, size=shape, p=(0.5, 0.3, 0.2)).astype(np.uint8)


# Map: phases [z][y][x], edges of a voxel along x, y, z in mm, moduli of the phases.
MAPS = {"spheres, contrast 8": (spheres((32, 40, 48)), (1, 1, 1), (MATRIX, SPHERE)),
        "three phases at random": (three_phases((28, 20, 24)), (1, 0.7, 1.4), (MATRIX, SPHERE, SOFT)),
        "spheres, contrast 100": (spheres((32, 40, 48)), (1, 1, 1), (MATRIX, STIFF))}


def run(bench):
    if not os.path.exists(bench.fans):
        raise SystemExit(f"benchmarks: --fans names the program FANS, '{bench.fans}' is none; build it as its README says")
    folder = os.path.join(bench.runs, "fans")
    os.makedirs(folder, exist_ok=True)
    rows, entries = [], []
    for name, (phases, h, moduli) in MAPS.items():
        a, b = of_mesoslip(bench, folder, phases, h, moduli, TIGHT["own"]), of_fans(bench, folder, phases, h, moduli, TIGHT["fans"])
        difference = np.abs(a.D - b.D)
        rows.append({"map": name, "cells": " x ".join(map(str, phases.shape[::-1])), "largest_GPa": np.abs(b.D).max(), "smallest_GPa": np.abs(b.D).min(),
                     "difference_over_largest": difference.max() / np.abs(b.D).max(), "largest_relative_difference": (difference / np.abs(b.D)).max()})
        entries += [{"map": name, "entry": f"{VOIGT[i]} {VOIGT[j]}", "mesoslip_GPa": f"{a.D[i, j]:.12g}", "FANS_GPa": f"{b.D[i, j]:.12g}"}
                    for i in range(6) for j in range(i, 6)]
    bench.write("fans", rows, f"stiffness of voxels under PBC, 21 entries of mesoslip (tolerance {TIGHT['own']:g}) against FANS {version(bench)} (HEX8, residual over the "
                f"first {TIGHT['fans']:g})")
    bench.write("fans-entries", entries, "the entries of fans.csv")
    bench.write("fans-time", [time(bench, folder, n) for n in ((64,) if bench.quick else REPETITIONS)],
                "whole programs, six load cases, spheres, contrast 8, seconds of the processor in turns on one core, medians; error: largest against mesoslip at "
                f"{TIGHT['own']:g}, over the largest entry", repetitions=", ".join(f"{k} at {n}^3" for n, k in REPETITIONS.items()))


def time(bench, folder, n):
    case = spheres((n, n, n)), (1, 1, 1), (MATRIX, SPHERE)
    exact = of_mesoslip(bench, folder, *case, TIGHT["own"])
    turns = [(of_mesoslip(bench, folder, *case, USUAL["own"]), of_fans(bench, folder, *case, USUAL["fans"])) for _ in range(REPETITIONS[n])]
    error = lambda found: np.abs(found.D - exact.D).max() / np.abs(exact.D).max()  # noqa: E731
    return {"edge": n, "mesoslip_cpu_s": median([a.seconds for a, _ in turns]), "FANS_cpu_s": median([b.seconds for _, b in turns]),
            "ratio": median([b.seconds / a.seconds for a, b in turns]), "mesoslip_error": error(turns[0][0]), "FANS_error": error(turns[0][1])}


class Found:
    """`D` [6][6] in GPa in Voigt's order and engineering shears, and `seconds` of the processor."""

    def __init__(self, D, seconds):
        self.D, self.seconds = D, seconds


def of_mesoslip(bench, folder, phases, h, moduli, tolerance):
    np.save(os.path.join(folder, "phases.npy"), phases)
    names = [f"p{k}" for k in range(len(moduli))]
    settings = {"Phases/Names": ", ".join(names), "Grid/Cells": ", ".join(map(str, phases.shape[::-1])),
                "Grid/Size": ", ".join(repr(1e-3 * e * n) for e, n in zip(h, phases.shape[::-1])), "Microstructure/Type": "voxels",
                "Microstructure/File": os.path.join(folder, "phases.npy"), "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC",
                "Homogenization/Tolerance": tolerance, "Homogenization/Write concentration": "false", "Homogenization/Reuse": "false", "Homogenization/Effective symmetry": "full"}
    for name, (young, poisson) in zip(names, moduli):
        settings |= {f"Phases/{name}/Young modulus": 1e9 * young, f"Phases/{name}/Poisson ratio": poisson}
    prm = os.path.join(folder, "own.prm")
    with open(prm, "w", encoding="utf-8") as file:
        file.write("set Dimension = 3\n")
    command = [os.path.join(bench.programs, "rve_homogenization"), prm, "--quiet", "--output", os.path.join(folder, "own")]
    seconds = cpu_seconds(command + [word for key, value in settings.items() for word in ("--set", f"{key}={value}")])
    with open(os.path.join(folder, "own", "summary.json"), encoding="utf-8") as file:
        return Found(1e-9 * np.array(json.load(file)["stiffness"]["PBC"]), seconds)


def of_fans(bench, folder, phases, h, moduli, tolerance):
    with h5py.File(os.path.join(folder, "phases.h5"), "w") as file:
        file["phases"] = phases.astype(np.uint16)
    edges = [e * n / max(phases.shape) for e, n in zip(h, phases.shape[::-1])]
    case = {"microstructure": {"filepath": os.path.join(folder, "phases.h5"), "datasetname": "/phases", "L": edges}, "results_prefix": "run",
            "problem_type": "mechanical", "strain_type": "small", "FE_type": "HEX8", "method": "cg", "n_it": 5000, "results": ["stress_average"],
            "materials": [{"phases": list(range(len(moduli))), "matmodel": "LinearElasticIsotropic", "material_properties": {
                "bulk_modulus": [E / 3 / (1 - 2 * nu) for E, nu in moduli], "shear_modulus": [E / 2 / (1 + nu) for E, nu in moduli]}}],
            "error_parameters": {"measure": "Linfinity", "type": "relative", "tolerance": tolerance},
            "macroscale_loading": [[[float(k == j) for j in range(6)]] for k in range(6)]}
    with open(os.path.join(folder, "fans.json"), "w", encoding="utf-8") as file:
        json.dump(case, file)
    results = os.path.join(folder, "fans.h5")
    if os.path.exists(results):
        os.remove(results)
    seconds = cpu_seconds([bench.fans, os.path.join(folder, "fans.json"), results])
    with h5py.File(results) as file:
        mandel = np.stack([file[f"phases_results/run/load{k}/time_step0/stress_average"][()].ravel() for k in range(6)], axis=1)
    mandel = mandel[np.ix_(FROM_MANDEL, FROM_MANDEL)]
    return Found(mandel / np.outer(FACTOR, FACTOR), seconds)


def version(bench):
    return subprocess.run([bench.fans, "--version"], text=True, stdout=subprocess.PIPE, check=True).stdout.split()[-1]
