"""Rules for delta* of the homogeneous model, and how far each gets.

The homogeneous model is known over delta (a sweep); what it does at delta* is interpolated between the runs of the sweep."""

import dataclasses

import numpy as np
from scipy import stats
from scipy.optimize import brentq

DELTA = 1.5e-6
RANGE = (1e-6, 3e-6)


@dataclasses.dataclass
class Sweep:
    """The homogeneous model over delta (s): Measures of each run, in one window."""
    deltas: np.ndarray
    measures: list

    def at(self, delta, what):
        return float(np.interp(delta, self.deltas, [what(m) for m in self.measures]))

    def delta_for(self, mu):
        """delta nearest to DELTA at which the sweep has this mu_inter; where it has none, the one that comes closest."""
        return nearest_root(self.deltas, np.array([m.mu for m in self.measures]) - mu)


def nearest_root(deltas, values):
    """delta in RANGE nearest to DELTA at which `values` [deltas] are zero, linear between the deltas; where they have no zero,
    the one with the smallest."""
    inside = (deltas >= RANGE[0]) & (deltas <= RANGE[1])
    d, v = deltas[inside], values[inside]
    crossings = [d[i] - v[i] * (d[i + 1] - d[i]) / (v[i + 1] - v[i]) for i in range(len(d) - 1)
                 if v[i] * v[i + 1] <= 0 and v[i] != v[i + 1]]
    return float(min(crossings, key=lambda x: abs(x - DELTA)) if crossings else d[np.argmin(np.abs(v))])


def mean_over_contact(delta, duration):
    """mu_bar / mu of eq. (13)."""
    return 1 - delta / duration * -np.expm1(-duration / delta)


def equation_13(mu_inter, mu, duration):
    """delta of eq. (13) from mu_inter and T_G of the heterogeneous run; nan without a solution."""
    if duration is None or not 0 < mu_inter < mu:
        return np.nan
    return brentq(lambda d: mu * mean_over_contact(d, duration) - mu_inter, 1e-12, 1e-2)


def mu_of(m):
    return m.mu


def slip_of(m):
    return m.shares[0]


def nearest(sweep, delta):
    """The run of the sweep nearest to delta: frequencies jump between branches and are not interpolated."""
    return sweep.measures[int(np.argmin(np.abs(sweep.deltas - delta)))]


def errors(sweep, deltas, references):
    """Errors of the homogeneous model with delta*[seed] against the heterogeneous Measures[seed]: dict of arrays
    mu (difference), frequency (relative), slip (difference)."""
    seeds = [s for s in references if np.isfinite(deltas[s])]
    return {"mu": np.array([sweep.at(deltas[s], mu_of) - mu_of(references[s]) for s in seeds]),
            "frequency": np.array([nearest(sweep, deltas[s]).frequency / references[s].frequency - 1 for s in seeds]),
            "slip": np.array([sweep.at(deltas[s], slip_of) - slip_of(references[s]) for s in seeds])}


def interval(values, confidence=0.95):
    """Mean, standard deviation and half width of the confidence interval of the mean."""
    values = np.asarray(values, float)
    n = len(values)
    if n < 2:
        return (values.mean() if n else np.nan), np.nan, np.nan
    deviation = values.std(ddof=1)
    return values.mean(), deviation, stats.t.ppf((1 + confidence) / 2, n - 1) * deviation / np.sqrt(n)


def rms(values):
    return float(np.sqrt(np.mean(np.square(values)))) if len(values) else np.nan


def rms_interval(values, resamples=4000, confidence=0.95):
    """Bootstrap interval of the root mean square over the seeds."""
    values = np.asarray(values, float)
    if len(values) < 2:
        return np.nan, np.nan
    draws = np.random.default_rng(0).choice(values, (resamples, len(values)))
    return tuple(np.quantile(np.sqrt(np.mean(draws**2, axis=1)), [(1 - confidence) / 2, (1 + confidence) / 2]))
