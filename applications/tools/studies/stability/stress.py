"""One setting at a time far beyond the paper's: each run has to end stable or be stopped by the program."""

import os

from judge import Verdict

HERE = os.path.dirname(os.path.abspath(__file__))
PIN, COMPOSITE = os.path.join(HERE, "pin.prm"), os.path.join(HERE, "composite.prm")
FREE = {"Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 0}  # a body that nothing holds


OPENING = ("1e6 + 6e6*sin(2*pi*20000*t)", "1e6 + 2e7*sin(2*pi*40000*t)", "2e6 + 1e7*sin(2*pi*15000*t)")


def isotropic(young, poisson):
    """D11, D12, D22, D33 of an isotropic solid in plane strain (Pa)."""
    factor = young / ((1 + poisson) * (1 - 2 * poisson))
    return [factor * (1 - poisson), factor * poisson, factor * (1 - poisson), young / (2 * (1 + poisson))]


def rve(contrast):
    return f"composite-{contrast:g}"


def heterogeneous(contrast):
    return {"Body/Material": "heterogeneous", "Body/RVE file": "{" + rve(contrast) + "}/rve.h5", "Body/Cells": ""}


def material_groups():
    yield "beta2", "-", [(b, {"Time/Beta2": b}) for b in (0.5, 0.6, 0.75, 1.0)]
    # Strong damping needs small steps: a shorter time is as many of them.
    ends = {1e-6: 1e-4, 1e-5: 1e-5}
    yield "beta", "s", [(beta, {"Time/Rayleigh beta": beta, "Time/End time": ends.get(beta, 5e-4)})
                        for beta in (0.0, 1e-9, 4.4e-9, 1e-8, 1e-7, 1e-6, 1e-5)]
    yield "stiffness contrast", "-", [(c, heterogeneous(c)) for c in (1, 3, 10, 30, 100, 300, 1000)]
    yield "Poisson's ratio", "-", [(nu, {"Body/Stiffness": isotropic(30e9, nu)}) for nu in (0.0, 0.2, 0.3, 0.4, 0.45, 0.49)]
    yield "cell width : height", "-", [(f"{a}:{b}", {"Body/Cells": cells}) for a, b, cells in (
        (1, 10, [140, 4]), (1, 5, [140, 8]), (1, 2, [98, 14]), (2, 1, [50, 28]), (5, 1, [32, 46]), (10, 1, [22, 63]))]


def contact_groups():
    yield "delta", "s", [(d, {"Friction/Regularization time": d}) for d in (0.0, 5e-8, 2e-7, 5e-7, 1.5e-6, 4e-6)]
    yield "slip-rate law, L", "m", [(length, {"Friction/Law": "slip rate", "Friction/Length": length})
                                    for length in (1e-8, 1e-7, 1e-6, 1e-5)]
    yield "mu", "-", [(mu, {"Friction/Coefficient": mu}) for mu in (0.0, 0.1, 0.25, 0.5, 0.75, 1.0, 1.25, 1.5)]
    yield "impact velocity", "m/s", [(v, {**FREE, "Flat/Gap": 1e-5 * v, "Body/Initial velocity": [0, -v]})
                                     for v in (0.01, 0.1, 1.0, 10.0, 100.0)]
    reversing = [(text, {"Flat/Expression": text}) for text in (
        "2*cos(2*pi*5000*t)", "if(sin(2*pi*10000*t) > 0, 2, -2)", "if(t < 2.5e-4, 2, 0)")]
    yield "flat velocity", "m/s", [(v, {"Flat/Velocity": v}) for v in (0, 1e-3, 0.1, 2, 50, 500)] + reversing


def load_groups():
    yield "pressure, ramp", "-", [("step", {})] + [(ramp, {"Supports/Top/Ramp": ramp, "Supports/Top/Ramp time": 2e-4}) for ramp in ("linear", "smooth")]
    yield "pressure", "Pa", [(text, {"Supports/Top/Expression": text}) for text in (
        "if(t < 2.5e-4, 5e6, 1e5)", "2.5e6*(1 + cos(2*pi*20000*t))",
        # The whole contact opens and closes, again and again.
        *OPENING)]
    yield "top", "-", [("pressure", {"Supports/Top/Kind": "pressure"}), ("platen", {"Supports/Top/Kind": "platen"}),
                       ("held from 0.1 ms", {"Supports/Top/Hold from": 1e-4})]
    yield "sides", "-", [("periodic", {"Sides/Periodic": True}), ("held in x", {"Supports/Left/Held": "u_x", "Supports/Right/Held": "u_x"}),
                         ("held", {"Supports/Left/Held": "u_x, u_y", "Supports/Right/Held": "u_x, u_y", "Supports/Top/Kind": "pressure"})]
    yield "to be stopped", "-", [
        ("time step 1.05 of the limit", "1.05"),
        ("velocity sqrt(1e-4 - t)", {"Flat/Expression": "sqrt(1e-4 - t)"}),
        ("pressure 1/(t - 1e-4)^2 at t = 1e-4", {"Supports/Top/Expression": "if(t < 1e-4, 5e6, 1/0)"}),
        ("pressure 1e30 Pa", {"Supports/Top/Pressure": 1e30})]


def groups():
    """(name, unit, [(value, settings)]); a text as settings is a share of the critical time step."""
    yield from material_groups()
    yield from contact_groups()
    yield from load_groups()


def add_composite(study, contrast):
    if rve(contrast) not in study.cases:
        study.add(rve(contrast), "rve_homogenization", COMPOSITE, {"Phases/fibre/Young modulus": 30e9 * contrast})


def run(study, wanted=None):
    """{(group, value): Verdict} of all cases, or those for which wanted(group, value)."""
    study.add("stress/reference", "contact_dynamics", PIN)
    critical = study.run()["stress/reference"].summary["critical_time_step"]
    cases = {}
    for group, _, values in groups():
        for number, (value, settings) in enumerate(values):
            if wanted and not wanted(group, value):
                continue
            if isinstance(settings, str):
                settings = {"Time/Check time step": False, "Time/Time step": float(settings) * critical}
            if group == "stiffness contrast":
                add_composite(study, value)
            name = f"stress/{group.replace(' ', '_').replace(':', 'x').replace(chr(39), '')}-{number}"
            study.add(name, "contact_dynamics", PIN, {"Snapshots/Interval": 2.5e-5, **settings})
            cases[group, value] = name
    results = study.run()
    return {case: Verdict(results[name]) for case, name in cases.items()}
