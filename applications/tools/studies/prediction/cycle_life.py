"""How long the cycle of regime 1 lasts: the pushed homogeneous pin for 10 ms, its stiffness changed from eq. (10), above all D22,
by which the computed effective stiffness differs most."""

import dataclasses

import numpy as np

from measures import measure
from open_choices import PAPER_STIFFNESS
from regime_map import CELLS
from seeds import COARSE, LOADS
from pages import table

LOAD = LOADS[0]
ENTRIES = ("D11", "D12", "D22", "D33")
SHIPPED = dict(zip(ENTRIES, (36.504e9, 9.229e9, 47.907e9, 13.730e9)))  # of prm/pin, as `rve_homogenization` has it
D22 = (45e9, 46e9, 47e9, 47.26e9, 47.5e9, 47.75e9, 48e9, 48.5e9, 49e9, 50e9, 51e9)
FINER = (47.26e9, 48e9)  # D22 on COARSE as well
SHEAR = ((48e9, 1.04), (47.26e9, 0.98), (47.26e9, 0.96))  # D22, and a factor on D33
BEGIN, END, WINDOW = 1e-3, 10e-3, 1e-3


@dataclasses.dataclass(frozen=True)
class Case:
    """Eq. (10) but for `changes`, pairs (entry, value in Pa)."""
    cells: tuple
    changes: tuple

    @property
    def stiffness(self):
        return {**dict(zip(ENTRIES, map(float, PAPER_STIFFNESS))), **dict(self.changes)}

    @property
    def name(self):
        return f"cycle-{self.cells[0]}-" + "-".join(f"{entry}-{value / 1e9:.6g}" for entry, value in self.changes)

    @property
    def label(self):
        return ", ".join(f"{entry} = {value / 1e9:.5g}" for entry, value in self.changes)


CASES = [*(Case(CELLS, (("D22", d),)) for d in D22), *(Case(COARSE, (("D22", d),)) for d in FINER),
         *(Case(CELLS, (("D22", d), ("D33", factor * float(PAPER_STIFFNESS[3])))) for d, factor in SHEAR),
         *(Case(CELLS, ((entry, SHIPPED[entry]),)) for entry in ENTRIES if entry != "D22")]


def add_runs(study, prm):
    for case in CASES:
        study.add(case.name, "contact_dynamics", prm, {"Body/Stiffness": list(case.stiffness.values()), "Body/Cells": list(case.cells),
                                                       **LOAD.settings, "Time/End time": END})


def windows():
    return np.arange(BEGIN, END - 0.5 * WINDOW, WINDOW)


def collect(results):
    """{Case: Measures of every window}"""
    return {case: [measure(results[case.name].folder, begin, begin + WINDOW) for begin in windows()] for case in CASES}


def over_d22(found):
    """{D22 (Pa): Measures of every window} of the coarser cells."""
    return {case.stiffness["D22"]: line for case, line in found.items() if case.cells == CELLS and len(case.changes) == 1
            and case.changes[0][0] == "D22"}


# Changes of CASES in the table of the page, in GPa.
SHOWN = ("D22 = 45", "D22 = 47.26", "D22 = 48", "D22 = 51", "D22 = 48, D33 = 14.336", "D22 = 47.26, D33 = 13.234")


def section(found):
    rows = [[case.label, *(f"{m.mu:.4f}" for m in (line[1], line[-1])), f"{100 * abs(line[-1].middle[2]):.0f}"]
            for case, line in found.items() if case.cells == CELLS and case.label in SHOWN]
    # Left: less friction at the end than the errors of both windows explain.
    left = min(d22 for d22, line in over_d22(found).items() if line[1].mu - line[-1].mu > 2 * (line[1].mu_error + line[-1].mu_error))
    return ["## How long the cycle of regime 1 lasts",
            f"With eq. (10) the cycle lasts {END * 1e3:g} ms at least. From D22 = {left / 1e9:g} GPa on, {100 * (left / float(PAPER_STIFFNESS[2]) - 1):.1f} "
            f"% above eq. (10), the pin changes within {END * 1e3:g} ms, the sooner the larger D22 is, to a modulated "
            f"cycle with less friction. The shipped pin has D22 = {SHIPPED['D22'] / 1e9:.1f} GPa. Runs: {LOAD.label}, "
            "cells of 0.4 mm. A larger D33 keeps the cycle. [cycle_life.csv](regimes/cycle_life.csv) has more stiffnesses, cells of 0.2 mm and every millisecond.",
            table(["eq. (10) but [GPa]", "μ_inter, 2 to 3 ms", "9 to 10 ms", "M separated, 9 to 10 ms [%]"], rows),
            "![mu_inter over time for each D22, and at the end over D22](regimes/cycle_life.png)"]
