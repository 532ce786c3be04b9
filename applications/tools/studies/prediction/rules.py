"""The rules of the study applied to its runs: which delta* each gives for each morphology."""

import dataclasses

import numpy as np

import delta_rules
import growth
import seeds
from measures import measure

SHORT = (2.5e-4, 5e-4)
WINDOWS = {"early": seeds.EARLY, "late": seeds.LATE}
MU = 0.25


@dataclasses.dataclass
class Data:
    """Results of the parts `seeds` and `growth`."""
    results: dict
    growth: growth.Growth

    def sweep(self, load, window, cells=seeds.COARSE):
        names = {d: seeds.hom_name(load, d, cells) for d in seeds.SWEEP}
        found = [(d, measure(self.results[n].folder, *window)) for d, n in names.items() if self._ended(n)]
        return delta_rules.Sweep(np.array([d for d, _ in found]), [m for _, m in found])

    def heterogeneous(self, load, window, times=1):
        """{seed: Measures} of the runs that ended well."""
        names = {s: seeds.het_name(s, load, times) for s in seeds.SEEDS}
        return {s: measure(self.results[n].folder, *window) for s, n in names.items() if self._ended(n)}

    def _ended(self, name):
        return name in self.results and self.results[name].status == 0

    def cost(self, load, times):
        """Mean CPU seconds of a heterogeneous run."""
        return np.mean([self.results[seeds.het_name(s, load, times)].cpu_seconds for s in seeds.SEEDS
                        if seeds.het_name(s, load, times) in self.results])

    def contact_duration(self, seed, load):
        return self.results[seeds.het_name(seed, load, 1)].summary.get("mean_contact_duration")


def by_growth(data, mode):
    """{seed: delta*} that gives this mode of the homogeneous pin the growth rate of its like in the morphology."""
    return {s: growth.matching_delta(data.growth, mode, values[mode]) for s, values in data.growth.morphologies.items()}


def by_fastest(data):
    """{seed: delta*} that gives the fastest mode of the homogeneous pin the growth rate of that of the morphology."""
    return {s: growth.matching_delta_of_fastest(data.growth, s) for s in data.growth.leading}


def mode_near(data, frequency):
    return int(np.argmin(np.abs(data.growth.mean[growth.AT].imag / (2 * np.pi) - frequency)))


def matched(data, load, window, times, cells):
    """{seed: delta*} with which the homogeneous pin on `cells` has the mu_inter of the heterogeneous one in `window`."""
    sweep = data.sweep(load, window, cells)
    return {s: sweep.delta_for(m.mu) for s, m in data.heterogeneous(load, window, times).items()}


def all_rules(data, load, window):
    """{rule: (what it needs of the heterogeneous pin, share of the cost of its run or None, {seed: delta*})}"""
    references = data.heterogeneous(load, window)
    best, other = (matched(data, of, window, 1, seeds.COARSE) for of in (load, seeds.other_load(load)))
    coarse = data.cost(load, 2) / data.cost(load, 1)
    return {
        "δ* = δ": ("nothing", 0., {s: seeds.DELTA for s in references}),
        "growth, 41.6 kHz mode": ("eigenvalue", None, by_growth(data, mode_near(data, 41.6e3))),
        "growth, fastest mode": ("eigenvalue", None, by_fastest(data)),
        "short run": ("run of 0.5 ms", SHORT[1] / seeds.END, matched(data, load, SHORT, 1, seeds.COARSE)),
        "coarse run": ("run on cells of 0.4 mm", coarse, matched(data, load, window, 2, seeds.COARSER)),
        "other morphologies": ("full runs of the others, once for all", 0., {s: np.mean([d for t, d in best.items() if t != s]) for s in best}),
        "other pressure": (f"full run at {seeds.other_load(load).pressure / 1e6:g} MPa", 1., other),
        "eq. (13)": ("full run", 1., {s: delta_rules.equation_13(m.mu, MU, data.contact_duration(s, load))
                                      for s, m in references.items()}),
        "best δ*": ("full run", 1., best),
    }
