#!/usr/bin/env python3
"""Maps of the paper's pin over load, friction and damping: where it slips, sticks and separates, with all its fibres and homogenized, on a
spring and on a disc. Writes doc/maps/pin.md with its pictures and tables from maps of contact_dynamics."""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.normpath(os.path.join(HERE, "..", "..", "..", ".."))
sys.path[:0] = [HERE, os.path.join(HERE, ".."), os.path.join(HERE, "..", ".."), os.path.join(HERE, "..", "..", "python")]

import map_page  # noqa: E402
from study import Study, parse_arguments  # noqa: E402

PRM = os.path.join(TOP, "prm", "prediction")
SEEDS = (1, 2, 3, 4)
DRAWN, STOPPED = 7, 100  # random points of the comparison and of the check of early ends

PRESSURE, VELOCITY, FRICTION = "Supports/Top/Pressure", "Flat/Velocity", "Friction/Coefficient"
DELAY, DAMPING, SPRING = "Friction/Regularization time", "Time/Rayleigh beta", "Supports/Top/Spring stiffness"
# Keys and ends of the axes.
RANGES = {"pressure": (PRESSURE, 0.25e6, 8e6), "velocity": (VELOCITY, 0.25, 8), "friction": (FRICTION, 0.05, 0.4),
          "delta": (DELAY, 1.5e-7, 1.5e-5), "beta": (DAMPING, 4.4e-10, 4.4e-8), "slow": (VELOCITY, 0.02, 2), "stiffness": (SPRING, 3e9, 1e11)}

PUSHED = {"Body/Initial velocity": "0.5, 0"}
COMPARED = {**PUSHED, "Time/End time": 2e-3, "Observation/Steady from": 1e-3}
LONG = {**PUSHED, "Time/End time": 8e-3, "Observation/Stop at limit cycle": True}
COARSE = {"Body/Cells": "70, 20"}
ON_SPRING = {**COARSE, "Time/End time": 12e-3, "Observation/Steady from": 6e-3, "Supports/Top/Platen mass": 2.8, "Supports/Top/Pressure": 1e6,
             "Flat/Ramp": "smooth", "Flat/Ramp time": 3e-3, "Friction/Law": "coulomb", "Friction/Coefficient law": "linear slip weakening",
             "Friction/Coefficient": 0.3, "Friction/Kinetic coefficient": 0.2, "Friction/Critical slip": 1e-7, "Friction/Healing": "sticking"}
STEEL_DISC = {"Counter body/Stiffness": "282.69e9, 121.15e9, 282.69e9, 80.77e9", "Counter body/Density": 7800, "Counter body/Size": "56e-3, 10e-3",
              "Counter body/Cells": "70, 12", "Counter body/Rayleigh beta": 4.4e-9, "Counter body/Supports/Left/Kind": "absorbing",
              "Counter body/Supports/Right/Kind": "absorbing"}


def axes(**numbers):
    """Keys of section Sweep for axes with so many values each, equally spaced in their logarithms except friction coefficients."""
    keys = {"Sweep/Axes": list(numbers)}
    for name, number in numbers.items():
        key, first, last = RANGES[name]
        keys |= {f"Sweep/{name}/Key": key, f"Sweep/{name}/From": first, f"Sweep/{name}/To": last, f"Sweep/{name}/Number": number}
        if name != "friction":
            keys[f"Sweep/{name}/Spacing"] = "logarithmic"
    return keys


def drawn(number):
    """Random points in pressure, velocity, friction, regularization time and damping."""
    names = ("pressure", "velocity", "friction", "delta", "beta")
    keys = axes(**dict.fromkeys(names, 2))
    return {**{key: value for key, value in keys.items() if not key.endswith("/Number")}, "Sweep/Points": "random", "Sweep/Random points": number}


def homogenized(study, name, settings, seed=1):
    study.add(name, "contact_dynamics", os.path.join(PRM, "contact_dynamics-homogeneous.prm"),
              {"Body/RVE file": f"{{rve-{seed}}}/rve.h5", "Body/Stiffness from": "effective", "Body/Cells": "140, 40", **settings})


def add_morphologies(study):
    """The random points for each morphology, with all fibres and homogenized. Steps of the pin with fibres are in single precision."""
    for seed in SEEDS:
        homogenized(study, f"homogenized-{seed}", {**drawn(DRAWN), **COMPARED}, seed)
    homogenized(study, "fine", {**drawn(DRAWN), **COMPARED, "Body/Cells": "560, 160", "Time/Precision": "single"}, SEEDS[0])
    for seed in SEEDS:
        study.add(f"fibres-{seed}", "contact_dynamics", os.path.join(PRM, "contact_dynamics-heterogeneous.prm"),
                  {"Body/RVE file": f"{{rve-{seed}}}/rve.h5", **drawn(DRAWN), **COMPARED, "Time/Precision": "single"})


def add_maps(study):
    for seed in SEEDS:
        study.add(f"rve-{seed}", "rve_homogenization", os.path.join(PRM, "rve_homogenization-morphology.prm"), {"Microstructure/Random fibres/Seed": seed})
    with_modes = {**LONG, **COARSE, "Sweep/Complex modes": True, "Complex modes/Fastest decay": 50000}
    homogenized(study, "pressure-friction", {**with_modes, **axes(pressure=11, friction=8)})
    homogenized(study, "pressure-velocity", {**LONG, **COARSE, **axes(pressure=11, velocity=11)})
    homogenized(study, "delta-friction", {**with_modes, **axes(delta=9, friction=8)})
    homogenized(study, "beta-friction", {**with_modes, **axes(beta=9, friction=8)})
    homogenized(study, "spring", {**ON_SPRING, **axes(slow=11, stiffness=9)})
    homogenized(study, "disc", {**LONG, **COARSE, **STEEL_DISC, **axes(pressure=11, friction=8)})
    homogenized(study, "stopped", {**LONG, **COARSE, **drawn(STOPPED)})
    homogenized(study, "whole", {**LONG, **COARSE, **drawn(STOPPED), "Observation/Stop at limit cycle": False})
    add_morphologies(study)


def main():
    arguments = parse_arguments(__doc__, "maps", ("pin",))
    # A map takes all cores by itself.
    study = Study(arguments.output, arguments.programs, 1, arguments.keep)
    add_maps(study)
    results = study.run()
    failed = [name for name in study.cases if name not in results or results[name].status != 0]
    if failed:
        sys.exit(f"run.sh maps: {', '.join(failed)} did not end well")
    map_page.write(os.path.join(TOP, "doc", "maps"), {name: result.folder for name, result in results.items() if not name.startswith("rve")}, SEEDS)
    print("doc/maps/pin.md")


if __name__ == "__main__":
    main()
