"""Numbers from sequences of errors, refinements and blocks of time; no files, no pictures."""

import math

import numpy as np
from scipy import stats


def fitted_order(sizes, errors):
    """Slope of log |error| over log size (h, dt or cost) by least squares; needs two points that are not zero."""
    sizes, errors = np.asarray(sizes, float), np.abs(np.asarray(errors, float))
    if not (len(sizes) > 1 and (sizes > 0).all() and (errors > 0).all()):
        raise ValueError("an order needs two or more positive sizes and errors that are not zero")
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


def richardson(values, ratio=2.0):
    """(limit, order) of the last three values of a sequence refined by `ratio` each time, from
    value = limit + c h^order. Raises ValueError where the differences do not fall."""
    a, b, c = (float(v) for v in values[-3:])
    steps = (a - b) / (b - c) if b != c else math.inf
    if not 1 < steps < math.inf:
        raise ValueError("the values do not converge monotonically; there is nothing to extrapolate")
    order = math.log(steps) / math.log(ratio)
    return c - (b - c) / (steps - 1), order


def half_width(samples):
    """95 % half width of the mean of independent samples; infinity for a single one."""
    n = len(samples)
    if n < 2:
        return math.inf
    return float(stats.t.ppf(0.975, n - 1) * stats.sem(samples))


def block_rates(time, integral, begin, end, blocks):
    """Mean rate of a running integral in each of `blocks` equal parts of [begin, end]."""
    edges = np.linspace(begin, end, blocks + 1)
    if not (time[0] <= begin and end <= time[-1] + (time[1] - time[0])):
        raise ValueError(f"the record ends at {time[-1]} s, before {end} s")
    return np.diff(np.interp(edges, time, integral)) / np.diff(edges)


def main_frequency(time, signal, lowest=1e3):
    """Hz; highest peak of the Hann-windowed spectrum above `lowest`, by a parabola through three logarithms."""
    time, signal = np.asarray(time, float), np.asarray(signal, float)
    interval = (time[-1] - time[0]) / (len(time) - 1)
    n = 4 * len(time)
    trend = np.polyval(np.polyfit(time - time[0], signal, 1), time - time[0])
    amplitude = np.abs(np.fft.rfft((signal - trend) * np.hanning(len(time)), n))
    first = max(1, int(math.ceil(lowest * n * interval)))
    k = first + int(np.argmax(amplitude[first:-1]))
    a, b, c = np.log(amplitude[k - 1:k + 2])
    return (k + 0.5 * (a - c) / (a - 2 * b + c)) / (n * interval)


def cheapest(rows, error, cost, target):
    """The row of least cost whose |error| is at most `target`, or None. NaN is never good enough."""
    good = [row for row in rows if abs(row[error]) <= target]
    return min(good, key=lambda row: row[cost]) if good else None


TARGETS = (0.01, 0.001)


def least_costs(rows, error, quantity, choice, otherwise=lambda target: "none of these"):
    """Rows of a NAME-cheapest.csv: what costs least for each target, `choice` being its words."""
    found = []
    for target in TARGETS:
        best = cheapest(rows, error, "cpu_s", target)
        found.append({"quantity": quantity, "target": target, "choice": choice(best) if best else otherwise(target),
                      "error": abs(best[error]) if best else "", "cpu_s": best["cpu_s"] if best else ""})
    return found


def median(values):
    """One of the values."""
    return sorted(values)[len(values) // 2]


def spread(name, values):
    """{name: median, name_low, name_high} of repetitions."""
    return {name: median(values), name + "_low": min(values), name + "_high": max(values)}
