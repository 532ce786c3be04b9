"""The map (P/V, delta, start) -> regime of the homogeneous pin, and the search for the paper's regime 2.

With the flat touching at t = 0 the map (u, P, V) -> (s u, s P, s V) takes solutions into solutions, so that P and V count by
P/V alone; the start, too, has to scale (the pushes below are proportional to P)."""

import itertools

from measures import measure

CELLS = (140, 40)
END = 3e-3
EARLY, LATE = (2.5e-4, 1e-3), (2e-3, 3e-3)  # the paper's steady state from 0.25 ms on; what it turns into
VELOCITY = 2.0
PRESSURES = (0.4e6, 0.5e6, 2e6, 3e6, 4e6, 5e6, 6e6, 7e6, 10e6, 20e6)
DELTAS = (0, 0.25e-6, 0.5e-6, 0.75e-6, 1e-6, 1.5e-6, 2e-6, 3e-6)
IMPEDANCE = 1770 * (13.785e9 / 1770) ** 0.5  # rho c_T of eq. (10), Pa s/m
PRESS_TIME, DRAG_AT = 2e-4, 3e-4

# Velocity along x with which the pin starts, over P / (rho c_T): a push that scales with P. The 0.5 m/s of doc/paper are 4.94 at
# 0.5 MPa and 6.2 at 0.4 MPa.
PUSHES = {"struck": 2, "pushed less": 4.94, "pushed": 6.2, "pushed hard": 15}
STARTS = ("at once", "ramped", "pressed, then dragged", *PUSHES)


def start_settings(start, pressure, velocity=VELOCITY):
    """Settings of a start. at once: P and V from the first step. ramped: P grows smoothly in 0.2 ms under the moving flat.
    pressed, then dragged: P likewise on the flat at rest, which moves at once from 0.3 ms on. Those of
    PUSHES: at once, and the pin starts with a velocity along x."""
    ramp = {"Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": PRESS_TIME}
    if start == "at once":
        return {}
    if start == "ramped":
        return ramp
    if start == "pressed, then dragged":
        return {**ramp, "Flat/Expression": f"if(t > {DRAG_AT!r}, {velocity!r}, 0)"}
    if start in PUSHES:
        return {"Body/Initial velocity": f"{PUSHES[start] * pressure / IMPEDANCE!r}, 0"}
    raise ValueError(f"no start named {start}")


def settings(pressure, delta, start, cells=CELLS, velocity=VELOCITY, end=END):
    return {"Body/Cells": f"{cells[0]}, {cells[1]}", "Supports/Top/Pressure": pressure, "Flat/Velocity": velocity,
            "Friction/Regularization time": delta, "Time/End time": end, **start_settings(start, pressure, velocity)}


def name_of(pressure, delta, start):
    return f"map-P{pressure / 1e6:g}-d{delta * 1e9:g}-{start.split(',')[0].replace(' ', '_')}"


def points():
    """All (P, delta, start) of the map."""
    return list(itertools.product(PRESSURES, DELTAS, STARTS))


def add_runs(study, prm):
    for pressure, delta, start in points():
        study.add(name_of(pressure, delta, start), "contact_dynamics", prm, settings(pressure, delta, start))


def collect(results):
    """{(P, delta, start): (early, late)} of the runs that ended well."""
    found = {}
    for point in points():
        result = results.get(name_of(*point))
        if result and result.status == 0:
            found[point] = (measure(result.folder, *EARLY), measure(result.folder, *LATE))
    return found
