"""The paper's pin on finer and finer cells with plain Coulomb friction and with the regularized law (figure 5)."""

import os

import h5py
import numpy as np
import stress
from prediction.dispersion import Layer

DELTAS = (0.0, 1.5e-6)
CELLS_MM = {4.4e-9: (0.4, 0.2, 0.1, 0.05), 0.0: (0.4, 0.2, 0.1)}  # by beta, the paper's and none
END, STEADY = 6e-4, 3e-4  # s
# To the limit cycle.
LONG_MM = {4.4e-9: (0.4, 0.2, 0.1), 0.0: (0.4, 0.2, 0.1)}
LONG_END, LONG_STEADY = 3e-3, 2e-3  # s
STIFFNESS, DENSITY, HEIGHT = (36.54e9, 9.1e9, 47.26e9, 13.785e9), 1770.0, 0.016  # eq. (10); table 1; m
FAST = 400e3  # Hz; beyond it there is nothing but what friction excites in the shortest waves


def run(study, cells, end, steady, folder="refinement"):
    """{(beta, delta, h in mm): Result} of runs until `end`, evaluated from `steady` on (s); `cells` (mm) by beta."""
    names = {}
    for beta, delta in ((beta, delta) for beta in cells for delta in DELTAS):
        for h in cells[beta]:
            names[beta, delta, h] = f"{folder}/{beta * 1e9:g}-{delta * 1e9:g}ns-{h:g}mm"
            study.add(names[beta, delta, h], "contact_dynamics", stress.PIN, {
                "Body/Cells": [round(56 / h), round(16 / h)], "Friction/Regularization time": delta, "Time/Rayleigh beta": beta,
                "Time/End time": end, "Observation/Steady from": steady, "Observation/Energy interval": 1000,
                "Observation/History interval": 2})
    results = study.run()
    failed = [name for name in names.values() if results[name].status != 0]
    if failed:
        raise RuntimeError(f"{failed[0]}: {results[failed[0]].message}")
    return {case: results[name] for case, name in names.items()}


def growth_rates(wave_numbers=(1, 4, 16, 64, 256)):
    """[[beta, delta, fastest growth (1/s) at each k H]] of steady sliding of a layer as tall and stiff as the pin; None where
    nothing grows."""
    rows = []
    for beta, delta in ((beta, delta) for beta in CELLS_MM for delta in DELTAS):
        layer = Layer(STIFFNESS, DENSITY, HEIGHT, 0.25, delta, beta)
        row = [beta, delta]
        for k in (number / HEIGHT for number in wave_numbers):
            shear = np.sqrt(STIFFNESS[3] / DENSITY) * k / (2 * np.pi)  # Hz
            with np.errstate(all="ignore"):
                rate = layer.fastest(k, np.linspace(0.5 * shear + 5e3, 3 * shear + 40e3, 24)).real
            row.append(float(rate) if rate > 0 else None)
        rows.append(row)
    return [[2 * np.pi * HEIGHT / number for number in wave_numbers], rows]


class Node:
    """What the middle contact node did, from dynamics.h5."""

    def __init__(self, result):
        self.summary = result.summary
        with h5py.File(os.path.join(result.folder, "dynamics.h5")) as file:
            reference = file["reference"]
            self.time = reference["time"][()]
            self.displacement = reference["displacement"][:, 0]
            self.velocity = reference["velocity"][:, 0]
            self.pressure = reference["traction"][:, 1]
            self.spectrum = (file["spectrum/frequency"][()], file["spectrum/amplitude"][()])
            self.cycle = tuple(file["phase_diagram"][name][()] for name in ("displacement", "velocity", "velocity_spread")) \
                if "phase_diagram" in file else None
        self.steady = self.time >= STEADY

    def fast_share(self):
        """Share of the mean square velocity beyond FAST."""
        velocity = self.velocity[self.steady]
        power = np.abs(np.fft.rfft((velocity - velocity.mean()) * np.hanning(velocity.size))) ** 2
        frequency = np.fft.rfftfreq(velocity.size, self.time[1] - self.time[0])
        return power[frequency > FAST].sum() / power.sum()

    def numbers(self):
        return {"mu_inter": self.summary["global_interface_friction_coefficient"],
                "main frequency (Hz)": self.summary["main_frequency"],
                "slip share": self.summary["slip_fraction"],
                "separated share": self.summary["separation_fraction"],
                "rms u_x (m)": float(np.std(self.displacement[self.steady])),
                "rms v_x (m/s)": float(np.std(self.velocity[self.steady])),
                "largest pressure (Pa)": float(self.pressure[self.steady].max()),
                "share of v_x above 400 kHz": float(self.fast_share())}
