"""P waves through layers in an explicit heterogeneous run against Rytov's dispersion relation.

With layers of the thicknesses l1, l2, wave speeds c1, c2 and impedances z1, z2, and a = omega l1 / c1, b = omega l2 / c2,

    cos(q L) = cos a cos b - (z1 / z2 + z2 / z1) / 2 sin a sin b.

A column of the paper's phases, 0.1 and 0.9 mm, is driven at its top with 500 kHz; the phase between probes that are ten periods apart is that of
q, before anything comes back from the bottom. The speed is 1.54e-4 below the static one; grids converge with order two, and their limit has
the speed of the relation within 1e-6.
"""

import math
import tempfile

import h5py
import numpy as np

from scenes import Folder, prm

FREQUENCY = 500e3
THICKNESS, YOUNG, POISSON, DENSITY = np.array([0.1e-3, 0.9e-3]), np.array([240e9, 30e9]), 0.2, 1770.0
MODULUS = YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON))
SPEED, PERIOD, N_PERIODS = np.sqrt(MODULUS / DENSITY), THICKNESS.sum(), 100
FIRST, LAST = 6, 26  # periods below the top of the probes


def wave_number(omega):
    a, b = omega * THICKNESS / SPEED
    r = SPEED[0] / SPEED[1]  # of the impedances, as the densities are equal
    return math.acos(math.cos(a) * math.cos(b) - (r + 1 / r) / 2 * math.sin(a) * math.sin(b)) / PERIOD


def measured(folder, cells_in_thin):
    """q of a run with so many cells in the thin layer."""
    h = THICKNESS[0] / cells_in_thin
    cells = [2, round(N_PERIODS * PERIOD / h)]
    of_period = ["fibre"] * cells_in_thin + ["matrix"] * (9 * cells_in_thin)
    layers = (of_period * N_PERIODS)
    name = f"layers{cells_in_thin}"
    folder.write(name + ".txt", "\n".join("1 1" if layer == "fibre" else "0 0" for layer in layers) + "\n")
    phases = {"Phases/Names": "matrix, fibre", **{f"Phases/{phase}/{key}": value for phase, young in (("matrix", 30e9), ("fibre", 240e9))
                                                  for key, value in (("Young modulus", young), ("Poisson ratio", POISSON), ("Density", DENSITY))}}
    grid = {"Grid/Cells": ", ".join(map(str, cells)), "Grid/Size": f"{2 * h:.17g}, {N_PERIODS * PERIOD:.17g}", "Microstructure/Type": "image",
            "Microstructure/File": name + ".txt"}
    folder.write(name + "-rve.prm", prm({**phases, **grid, "Homogenization/Boundary conditions": "KUBC", "Homogenization/Write concentration": "false",
                                         "Homogenization/Tolerance": 1e-2}))
    folder.run(0, "rve_homogenization", name + "-rve.prm", "--output", name + "-rve", "--quiet")
    top, arrival = N_PERIODS * PERIOD, LAST * PERIOD / 4300
    back = (2 * N_PERIODS - LAST) * PERIOD / 4600
    step = 0.9 * h / SPEED[0] / math.sqrt(2)
    periods = math.floor((back - arrival) * FREQUENCY) - 6
    samples = math.ceil(1 / FREQUENCY / step / 4) * 4  # steps in a period of the wave
    step = 1 / FREQUENCY / samples
    end = (math.ceil(arrival * FREQUENCY) + 5 + periods) / FREQUENCY
    drive = f"0; 1e6 * sin({2 * math.pi * FREQUENCY:.17g} * t) * if(t < 4e-6, (1 - cos({math.pi / 4e-6:.17g} * t)) / 2, 1)"
    folder.write(name + ".prm", prm({
        "Body/RVE file": name + "-rve/rve.h5", "Body/Material": "heterogeneous", "Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 0,
        "Supports/Top/Traction": drive, "Supports/Left/Held": "u_x", "Supports/Right/Held": "u_x", "Flat/Gap": 1e-3, "Flat/Velocity": 0,
        "Time/Time step": step, "Time/End time": end, "Time/Rayleigh beta": 0, "Observation/History interval": samples // 4, "Observation/Probe interval": samples // 4,
        "Observation/Probes": "near, far", "Observation/near/Position": f"{h:.17g}, {top - FIRST * PERIOD:.17g}",
        "Observation/far/Position": f"{h:.17g}, {top - LAST * PERIOD:.17g}"}))
    folder.run(0, "contact_dynamics", name + ".prm", "--output", name, "--quiet")
    with h5py.File(folder(name, "dynamics.h5")) as file:
        phase = []
        for probe in ("near", "far"):
            time, u = file[f"probes/{probe}/time"][()], file[f"probes/{probe}/displacement"][:, 1]
            last = len(time) - 1
            own = slice(last - 4 * periods, last)
            phase.append(np.angle((u[own] * np.exp(-2j * np.pi * FREQUENCY * time[own])).sum()))
    turns = wave_number(2 * math.pi * FREQUENCY) * (LAST - FIRST) * PERIOD
    lag = phase[0] - phase[1]
    lag += 2 * math.pi * round((turns - lag) / (2 * math.pi))
    return lag / ((LAST - FIRST) * PERIOD)


def main():
    omega = 2 * math.pi * FREQUENCY
    static = 1 / (math.sqrt((THICKNESS / MODULUS).sum() / PERIOD * DENSITY))
    q = wave_number(omega)
    print(f"speed over the static one: {omega / q / static - 1:.4e}, at 40 kHz {2 * math.pi * 40e3 / wave_number(2 * math.pi * 40e3) / static - 1:.4e}")
    assert abs((omega / q / static - 1) / -1.539e-4 - 1) < 1e-3
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        found = [measured(folder, n) for n in (1, 2, 4)]
    errors = [f / q - 1 for f in found]
    print("distances from the relation", errors, "orders", np.log2(np.divide(errors[:-1], errors[1:])))
    limit = found[2] + (found[2] - found[1]) / 3
    print(f"limit: speed over the static one {omega / limit / static - 1:.4e}, distance {limit / q - 1:.1e}")
    assert np.abs(np.log2(np.divide(errors[:-1], errors[1:])) - 2).max() < 0.02 and abs(limit / q - 1) < 1e-6


if __name__ == "__main__":
    main()
