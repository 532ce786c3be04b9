"""The critical time step: predicted by the program against observed by bisection, and runs from half of it to beyond."""

import dataclasses
import functools

import held_body
import stress
from judge import Verdict

ROUNDS = 7
LOW, HIGH = 0.9, 1.1  # of the predicted limit
STEPS = 20000
SHARES = (0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99, 1.01, 1.02, 1.05, 1.1)
FEW_ROWS = "cells 1:10"
BETA2 = (0.5, 0.6, 0.75, 1.0)


@dataclasses.dataclass
class Limit:
    body: str
    beta2: float
    beta: float
    predicted: float  # s
    low: float  # the largest share of it that was stable
    high: float  # the smallest that was not
    cells: tuple = None  # of a homogeneous body that platen and flat hold

    @property
    def observed(self):
        """Share of the predicted limit."""
        return 0.5 * (self.low + self.high)

    @functools.cached_property
    def observed_over_held(self):
        """Share of the exact limit of the body as it is held, where that is known."""
        exact = self.cells and held_body.critical_time_step(self.cells, self.beta2, self.beta)
        return exact and self.observed * self.predicted / exact


def bodies():
    yield "homogeneous", {}, BETA2, (0.0, 4.4e-9, 1e-7, 1e-6)
    yield "composite 1:8", stress.heterogeneous(8), (0.5, 1.0), (0.0, 4.4e-9, 1e-7)
    yield "composite 1:1000", stress.heterogeneous(1000), (0.5,), (0.0, 4.4e-9)
    yield "cells 10:1", {"Body/Cells": [22, 63]}, (0.5, 1.0), (0.0, 4.4e-9)
    # Four rows of cells: the platen holds a good part of the stiffest mode, which a free top does not.
    yield FEW_ROWS, {"Body/Cells": [140, 4]}, (0.5, 1.0), (0.0, 4.4e-9)
    yield FEW_ROWS + ", free top", {"Body/Cells": [140, 4], "Supports/Top/Kind": "pressure"}, (0.5, 1.0), (0.0, 4.4e-9)


def cells_if_held(settings):
    """Of a homogeneous body under a platen."""
    return tuple(settings.get("Body/Cells", (70, 20))) if "Body/RVE file" not in settings and "Supports/Top/Kind" not in settings else None


def at(settings, limit, share, steps=STEPS):
    step = share * limit.predicted
    return {**settings, "Time/Beta2": limit.beta2, "Time/Rayleigh beta": limit.beta, "Time/Check time step": False,
            "Time/Time step": step, "Time/End time": steps * step}


def predict(study, chosen):
    """[(Limit, settings)]: the program's own critical time steps."""
    begun = []
    for body, settings, beta2s, betas in chosen:
        if "Body/RVE file" in settings:
            stress.add_composite(study, int(body.split(":")[1]))
        for beta2 in beta2s:
            for beta in betas:
                name = f"limit/{body}/{beta2:g}-{beta:g}/predicted".replace(" ", "_").replace(":", "-")
                study.add(name, "contact_dynamics", stress.PIN, {
                    **settings, "Time/Beta2": beta2, "Time/Rayleigh beta": beta, "Time/End time": 1e-9,
                    "Observation/Energy interval": 0})
                begun.append((name, Limit(body, beta2, beta, 0.0, LOW, HIGH, cells_if_held(settings)), settings))
    results = study.run()
    for name, limit, _ in begun:
        limit.predicted = results[name].summary["critical_time_step"]
    return [(limit, settings, name.rsplit("/", 1)[0]) for name, limit, settings in begun]


def bisect(study, chosen=None, rounds=ROUNDS):
    """Observed limits of the pin as it slides on the flat: [Limit]."""
    limits = predict(study, chosen or bodies())
    for _ in range(rounds):
        tried = []
        for limit, settings, name in limits:
            share = limit.observed
            study.add(f"{name}/{share:.6f}", "contact_dynamics", stress.PIN,
                      {**at(settings, limit, share), "Observation/Energy interval": 0, "Observation/History interval": 1000})
            tried.append((limit, share, f"{name}/{share:.6f}"))
        results = study.run()
        for limit, share, name in tried:
            verdict = Verdict(results[name])
            if not verdict.good:
                raise RuntimeError(f"{name}: {verdict.outcome}")
            if verdict.outcome == "stable":
                limit.low = share
            else:
                limit.high = share
    return [limit for limit, _, _ in limits]


def sweep(study):
    """{(beta2, share): Verdict} of the homogeneous pin without damping but that of the scheme."""
    names = {}
    for limit, settings, name in predict(study, [("homogeneous sweep", {}, BETA2, (0.0,))]):
        for share in SHARES:
            names[limit.beta2, share] = f"{name}/share-{share:g}"
            study.add(names[limit.beta2, share], "contact_dynamics", stress.PIN, at(settings, limit, share, 5000))
    results = study.run()
    return {case: Verdict(results[name]) for case, name in names.items()}

