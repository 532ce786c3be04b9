#!/usr/bin/env python3
"""Maps of the paper's pin over pressure and friction, with all its fibres and homogenized: where it slips, sticks and separates, and what
homogenization gets right. Writes doc/maps/pin.md with its pictures and tables from maps of contact_dynamics."""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.normpath(os.path.join(HERE, "..", "..", "..", ".."))
sys.path[:0] = [HERE, os.path.join(HERE, ".."), os.path.join(HERE, "..", ".."), os.path.join(HERE, "..", "..", "python")]

import map_page  # noqa: E402
from mesoslip.maps import settings_of  # noqa: E402
from study import Study, parse_arguments  # noqa: E402

SEEDS = (1, 2)
PRESSURE, FRICTION, VELOCITY, END = (0.5e6, 2e6, 8e6), (0.1, 0.25, 0.4), 2, 2e-3
PRM = os.path.join(TOP, "prm", "prediction")


def sweep():
    """Keys of section Sweep."""
    axes = {"pressure": ("Supports/Top/Pressure", PRESSURE), "friction": ("Friction/Coefficient", FRICTION)}
    keys = {key: ", ".join(map(str, value)) if isinstance(value, list) else value for key, value in settings_of(axes).items()}
    return {**keys, "Body/Initial velocity": "0.5, 0", "Time/End time": END, "Flat/Velocity": VELOCITY, "Observation/Steady from": END / 2}


def add_maps(study):
    """The morphologies, and a map of each with all fibres and homogenized."""
    for seed in SEEDS:
        study.add(f"rve-{seed}", "rve_homogenization", os.path.join(PRM, "rve_homogenization-morphology.prm"), {"Microstructure/Random fibres/Seed": seed})
    for seed in SEEDS:
        body = {"Body/RVE file": f"{{rve-{seed}}}/rve.h5", **sweep()}
        study.add(f"homogenized-{seed}", "contact_dynamics", os.path.join(PRM, "contact_dynamics-homogeneous.prm"),
                  {**body, "Body/Stiffness from": "effective", "Body/Cells": "140, 40"})
        study.add(f"fibres-{seed}", "contact_dynamics", os.path.join(PRM, "contact_dynamics-heterogeneous.prm"), body)


def main():
    arguments = parse_arguments(__doc__, "maps", ("pin",))
    # A map takes all cores by itself.
    study = Study(arguments.output, arguments.programs, 1, arguments.keep)
    add_maps(study)
    results = study.run()
    failed = [name for name in study.cases if name not in results or results[name].status != 0]
    if failed:
        sys.exit(f"run.sh maps: {', '.join(failed)} did not end well")
    map_page.write(os.path.join(TOP, "doc", "maps"), {name: result.folder for name, result in results.items()}, SEEDS, END)
    print("doc/maps/pin.md")


if __name__ == "__main__":
    main()
