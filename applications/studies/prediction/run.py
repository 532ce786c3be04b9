#!/usr/bin/env python3
"""Past the paper: which regimes the pin has, what the open choices do, and whether the homogeneous model's
regularization time can be predicted. Leaves doc/paper/regimes.md and doc/paper/prediction.md with pictures and tables."""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), HERE]

import open_choices  # noqa: E402
import regime_map  # noqa: E402
import seeds  # noqa: E402
from study import Study, parse_arguments  # noqa: E402

TOP = os.path.normpath(os.path.join(HERE, "..", "..", ".."))
PRM = os.path.join(TOP, "prm", "prediction")


def prm(name):
    return os.path.join(PRM, name + ".prm")


def run_map(arguments):
    study = Study(os.path.join(arguments.output, "map"), arguments.programs, arguments.jobs, arguments.keep)
    regime_map.add_runs(study, prm("contact_dynamics-homogeneous"))
    study.run()


def run_seeds(arguments):
    study = Study(os.path.join(arguments.output, "seeds"), arguments.programs, arguments.jobs, arguments.keep)
    seeds.add_morphologies(study, prm("rve_homogenization-morphology"))
    results = study.run()
    seeds.add_heterogeneous(study, prm("contact_dynamics-heterogeneous"))
    seeds.add_coarse(study, prm("contact_dynamics-heterogeneous"), results)
    seeds.add_homogeneous(study, prm("contact_dynamics-homogeneous"), results)
    study.run()


def run_choices(arguments):
    study = Study(os.path.join(arguments.output, "choices"), arguments.programs, arguments.jobs, arguments.keep)
    open_choices.add_runs(study, prm("contact_dynamics-homogeneous"))
    study.run()


PARTS = {"map": run_map, "choices": run_choices, "seeds": run_seeds}


def main():
    arguments = parse_arguments(__doc__, "prediction", tuple(PARTS))
    for part in arguments.parts:
        PARTS[part](arguments)


if __name__ == "__main__":
    main()
