#!/usr/bin/env python3
"""Past the paper: which regimes the pin has, what the open choices do, and whether the homogeneous model's
regularization time can be predicted. Leaves doc/paper/regimes.md and doc/paper/prediction.md with pictures and tables.
The part `pictures` only redraws the pictures from the tables that are there."""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [os.path.join(HERE, ".."), HERE]

import cycle_life  # noqa: E402
import growth  # noqa: E402
import open_choices  # noqa: E402
import prediction_page  # noqa: E402
import redraw  # noqa: E402
import regime_map  # noqa: E402
import regimes_page  # noqa: E402
import rules  # noqa: E402
import seeds  # noqa: E402
from study import Study, parse_arguments  # noqa: E402

TOP = os.path.normpath(os.path.join(HERE, "..", "..", "..", ".."))
PRM = os.path.join(TOP, "prm", "prediction")


def prm(name):
    return os.path.join(PRM, name + ".prm")


def study_of(arguments, part):
    return Study(os.path.join(arguments.output, part), arguments.programs, arguments.jobs, arguments.keep)


def run_map(arguments):
    study = study_of(arguments, "map")
    regime_map.add_runs(study, prm("contact_dynamics-homogeneous"))
    return study.run()


def run_choices(arguments):
    study = study_of(arguments, "choices")
    open_choices.add_runs(study, prm("contact_dynamics-homogeneous"))
    open_choices.add_placements(study, prm("rve_homogenization-morphology"))
    return study.run()


def run_cycles(arguments):
    study = study_of(arguments, "cycles")
    cycle_life.add_runs(study, prm("contact_dynamics-homogeneous"))
    return study.run()


def run_seeds(arguments):
    study = study_of(arguments, "seeds")
    seeds.add_morphologies(study, prm("rve_homogenization-morphology"))
    results = study.run()
    seeds.add_homogeneous(study, prm("contact_dynamics-homogeneous"), results)
    for times in (2, 1):
        seeds.add_coarse(study, prm("contact_dynamics-heterogeneous"), results, times)
    study.run()
    seeds.add_fine(study, prm("contact_dynamics-homogeneous"), prm("contact_dynamics-heterogeneous"), results)
    return study.run()


def run_growth(arguments):
    """Eigenvalues of the homogeneous pins and of the morphologies; of runs it needs these and one of a homogeneous pin."""
    study = study_of(arguments, "seeds")
    seeds.add_morphologies(study, prm("rve_homogenization-morphology"))
    results = study.run()
    mean, _ = seeds.mean_stiffness(results)
    files = {seed: os.path.join(results[f"rve-{seed}"].folder, "rve.h5") for seed in seeds.SEEDS}
    eigenvalues = study_of(arguments, "growth")
    growth.add_runs(eigenvalues, prm("contact_dynamics-modes"), prm("contact_dynamics-homogeneous"), open_choices.PAPER_STIFFNESS, mean, files)
    return growth.collect(eigenvalues.run())


def write_pages(arguments):
    """Both pages; runs that are missing are made first."""
    folder = os.path.join(TOP, "doc", "paper")
    results = run_seeds(arguments)
    data = rules.Data(results, run_growth(arguments))
    choices = run_choices(arguments)
    regimes_page.write(folder, regime_map.collect(run_map(arguments)), choices,
                       cycle_life.collect(run_cycles(arguments)), data)
    prediction_page.write(folder, data)
    print(os.path.join(folder, "regimes.md"), os.path.join(folder, "prediction.md"), sep="\n")


def redraw_pictures(_):
    """All pictures, from the tables beside them; nothing is run."""
    regimes, prediction = (os.path.join(TOP, "doc", "paper", name) for name in ("regimes", "prediction"))
    redraw.regimes(regimes, prediction)
    redraw.prediction(prediction)


PARTS = {"map": run_map, "choices": run_choices, "cycles": run_cycles, "seeds": run_seeds, "growth": run_growth,
         "pages": write_pages}
ON_REQUEST = {"pictures": redraw_pictures}


def main():
    arguments = parse_arguments(__doc__, "prediction", tuple(PARTS), on_request=tuple(ON_REQUEST))
    for part in arguments.parts:
        {**PARTS, **ON_REQUEST}[part](arguments)


if __name__ == "__main__":
    main()
