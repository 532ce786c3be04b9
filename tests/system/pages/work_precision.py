"""Helpers of the benchmarks on data whose answers are known."""

import math
import os
import sys

import numpy as np

from scenes import TOP

sys.path[:0] = [os.path.join(TOP, "applications", "tools", "studies", "benchmarks", *folder) for folder in ((), ("accuracy",))]

import fits  # noqa: E402
import pin  # noqa: E402

SIZES = [0.4, 0.2, 0.1, 0.05]


def close(found, expected, tolerance):
    assert abs(found - expected) <= tolerance, f"{found} instead of {expected}"


def refuses(call, *arguments):
    try:
        call(*arguments)
    except ValueError:
        return
    raise AssertionError(f"{call.__name__} accepted {arguments}")


def test_orders():
    close(fits.fitted_order(SIZES, [3 * h ** 1.5 for h in SIZES]), 1.5, 1e-12)
    close(fits.fitted_order(SIZES, [-0.1 * h ** 2 for h in SIZES]), 2.0, 1e-12)
    refuses(fits.fitted_order, SIZES, [1.0, 0.1, 0.0, 0.1])
    limit, order = fits.richardson([7 + 2 * h ** 1.3 for h in SIZES])
    close(limit, 7, 1e-12)
    close(order, 1.3, 1e-10)
    limit, order = fits.richardson([5 - h ** 2 for h in (9.0, 3.0, 1.0)], ratio=3.0)
    close(limit, 5, 1e-12)
    close(order, 2, 1e-12)
    refuses(fits.richardson, [1.0, 2.0, 1.0])
    refuses(fits.richardson, [1.0, 1.0, 1.0])


def test_statistics():
    close(fits.half_width([1, 2, 3, 4, 5]), 2.7764451 * math.sqrt(2.5 / 5), 1e-7)
    assert math.isinf(fits.half_width([1.0]))
    # A steady rate of 3 with an oscillation: whole periods see the rate alone.
    time = np.linspace(0, 2, 20001)
    rates = fits.block_rates(time, 3 * time + 0.1 * np.sin(2 * math.pi * 8 * time), 1.0, 2.0, 4)
    close(np.abs(rates - 3).max(), 0, 1e-9)
    refuses(fits.block_rates, time, time, 1.0, 2.5, 4)
    time = np.linspace(0, 1e-3, 5001)
    signal = 4 * time + 2e-7 * np.sin(2 * math.pi * 41200 * time) + 5e-8 * np.sin(2 * math.pi * 82400 * time)
    close(fits.main_frequency(time, signal), 41200, 5)
    rows = [{"e": 0.02, "c": 1.0}, {"e": -0.004, "c": 3.0}, {"e": 0.001, "c": 9.0}, {"e": math.nan, "c": 0.1}]
    assert fits.cheapest(rows, "e", "c", 0.01)["c"] == 3.0
    assert fits.cheapest(rows, "e", "c", 1e-4) is None
    assert fits.spread("s", [3.0, 1.0, 2.0]) == {"s": 2.0, "s_low": 1.0, "s_high": 3.0}


def test_limit_of_the_pin():
    """value + a h^2 + b dt is found from runs that obey it."""
    rows = [{"name": f"{h}{dt}", "material": "homogeneous", "beta2": 0.5, "h_mm": h, "dt_s": dt,
             **{q: 0.2 + 0.01 * h * h + 1e6 * dt for q in pin.QUANTITIES}}
            for h in SIZES for dt in (1e-8 * h, 2e-8 * h)]
    limit = pin.continuum(rows)["mu_inter"]
    close(limit["value"], 0.2, 1e-12)
    close(limit["per_mm2"], 0.01, 1e-9)
    close(limit["per_ns"], 1e-3, 1e-9)


def main():
    test_orders()
    test_statistics()
    test_limit_of_the_pin()


if __name__ == "__main__":
    main()
