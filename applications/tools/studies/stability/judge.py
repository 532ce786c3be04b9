"""How a run of contact_dynamics ended, judged from what it left."""

import os
import re

import h5py
import numpy as np

# What a run that is stopped has to say (lib/sliding/run_plan.cc).
STOPPED = re.compile(r"(?P<cause>likely cause: .*|(Flat|Top)/Expression .*?) in step (?P<step>\d+) at t = (?P<time>\S+) s\b")
PLACE = re.compile(r"node \(\d+, \d+\)|cell \(\d+, \d+\) around|which spoiled the run")
BLOWN_UP = re.compile(r"its energy is (\S+) J/m where at most (\S+) J/m")
ROUND_OFF = 1e-9  # of the largest energy; what the balance may miss with a sample in every step


class Verdict:
    """`outcome` is "stable", "stopped" or "broken: ..." with the reason; `residual` the largest error of the
    energy balance over the largest energy; `growth` the largest energy over the largest that was put in, and
    `openings` how often the whole contact opened."""

    def __init__(self, result, closes=ROUND_OFF):
        self.status, self.message, self.summary = result.status, result.message, result.summary
        self.residual = self.growth = self.step = self.openings = None
        self.cause = ""
        spoiled = [name for file in ("dynamics.h5", "dynamics.h5.part")
                   for name in not_finite(os.path.join(result.folder, file))]
        if result.status == 3:
            self._stopped()
        elif result.status == 0:
            self._ended(os.path.join(result.folder, "dynamics.h5"), closes)
        else:
            self.outcome = f"broken: exit status {result.status}, {result.message}"
        if spoiled:
            self.outcome = "broken: not finite: " + ", ".join(spoiled)

    def _stopped(self):
        found = STOPPED.search(self.message) if PLACE.search(self.message) else None
        self.outcome = "stopped" if found else f"broken: no step, time, place and cause in '{self.message}'"
        if found:
            self.step = int(found["step"])
            self.cause = found["cause"].split(";")[0].removeprefix("likely cause: ")
        energies = BLOWN_UP.search(self.message)
        if energies and float(energies[2]) > 0.0:
            self.growth = float(energies[1]) / float(energies[2])

    def _ended(self, path, closes):
        self.outcome = "stable"
        with h5py.File(path) as file:
            if "energy" not in file:
                return
            energy = {name: file["energy"][name][()] for name in file["energy"]}
            initial = float(file["energy"].attrs["initial"])
            open_everywhere = file["history/separated_nodes"][()] == file["contact/slip"].size
            self.openings = int(np.count_nonzero(open_everywhere[1:] & ~open_everywhere[:-1]))
        held = energy["kinetic"] + energy["elastic"]
        supply = np.max(initial + energy["external_work"] - energy["friction"] - energy["impact"] - energy["potential"])
        scale = max(np.max(np.abs(energy[name])) for name in ("kinetic", "elastic", "external_work", "friction", "impact"))
        if scale > 0.0:
            self.residual = float(np.max(np.abs(energy["residual"])) / scale)
            self.growth = float(np.max(held) / supply) if supply > 0.0 else None
            if not self.residual <= closes:
                self.outcome = f"broken: the energy balance misses {self.residual:.1e}"
            if self.growth is not None and not self.growth <= 1.0 + closes:
                self.outcome = f"broken: {self.growth:.6f} times the energy that was put in"

    @property
    def good(self):
        return not self.outcome.startswith("broken")


def not_finite(path):
    """Names of the datasets of an HDF5 file that hold NaN or infinity; none when there is no file."""
    names = []

    def visit(name, item):
        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" and not np.isfinite(item[()]).all():
            names.append(name)

    if os.path.exists(path):
        with h5py.File(path) as file:
            file.visititems(visit)
    return names
