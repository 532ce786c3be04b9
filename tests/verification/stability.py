"""A short form of the study ./run.sh stability: time steps just below and above the limit, settings far beyond the
paper's, many steps without damping. Each run ends stable or is stopped with step, time, place and cause."""

import os
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [os.path.join(TOP, "applications", "tools", "studies", *folder) for folder in (("stability",), ())]

import limit  # noqa: E402
import long_runs  # noqa: E402
import stress  # noqa: E402
from judge import Verdict  # noqa: E402
from served_study import ServedStudy  # noqa: E402

BODIES = [("homogeneous", {}, (0.5, 1.0), (4.4e-9,)), ("composite 1:8", stress.heterogeneous(8), (0.6,), (1e-7,)),
          ("cells 10:1", {"Body/Cells": [22, 63]}, (0.5,), (0.0,)), (limit.FEW_ROWS, {"Body/Cells": [140, 4]}, (0.5,), (4.4e-9,))]
CHOSEN = {"beta": (0.0, 1e-6), "stiffness contrast": (1000,), "Poisson's ratio": (0.49,), "cell width : height": ("1:10",),
          "delta": (0.0,), "mu": (1.5,), "impact velocity": (100.0,), "flat velocity": (0, 500, "2*cos(2*pi*5000*t)"),
          "pressure": stress.OPENING[:1]}


def just_around_the_limit(study):
    """0.995 of the predicted limit is stable, 1.01 of it is not. On a few rows the limit is that of the body as it is held."""
    names = {}
    for case, settings, folder in limit.predict(study, BODIES):
        if case.body == limit.FEW_ROWS:
            case.predicted = limit.held_body.critical_time_step(case.cells, case.beta2, case.beta)
        for share in (0.995, 1.01):
            names[case.body, case.beta2, share] = f"{folder}/{share:g}"
            study.add(f"{folder}/{share:g}", "contact_dynamics", stress.PIN,
                      {**limit.at(settings, case, share), "Observation/Energy interval": 0, "Observation/History interval": 1000})
    results = study.run()
    for (body, beta2, share), name in names.items():
        outcome = Verdict(results[name]).outcome
        yield f"{body}, beta2 {beta2:g} at {share:g} of the limit", outcome, "stable" if share < 1 else "stopped"


def far_out(study):
    verdicts = stress.run(study, lambda group, value: group == "to be stopped" or value in CHOSEN.get(group, ()))
    for (group, value), verdict in verdicts.items():
        yield f"{group} {value}", verdict.outcome, "stopped" if group == "to be stopped" else "stable"
        if value in stress.OPENING:
            yield f"{group} {value}: the contact opens", str(verdict.openings > 1), "True"


def many_steps(study):
    for case, (verdict, _) in long_runs.run(study, 50000).items():
        yield case, verdict.outcome, "stable"


def main():
    failures = 0
    with tempfile.TemporaryDirectory() as folder:
        study = ServedStudy(folder, sys.argv[1], jobs=1)
        for part in (just_around_the_limit, far_out, many_steps):
            for case, found, expected in part(study):
                if found != expected:
                    failures += 1
                    print(f"{case}: expected {expected}, found {found}")
        print(f"{len(study.cases)} runs, {failures} failures")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
