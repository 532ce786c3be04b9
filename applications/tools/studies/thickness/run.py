#!/usr/bin/env python3
"""The paper's homogeneous pin as a body of finite thickness with free faces against plane strain and plane stress: runs prm/thickness
in some settings and writes doc/paper/thickness.md with its picture and tables. The part `fine`, on request, has the paper's fibres of
0.1 mm in a thin pin: about an hour on one core."""

import os
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:0] = [HERE, os.path.join(HERE, "..")]

import fibres  # noqa: E402
import modes  # noqa: E402
import thickness_page  # noqa: E402
from pages import write_csv  # noqa: E402
from observed import RUN_COLUMNS, difference, moduli, profile, row  # noqa: E402
from settings import LOADS, STARTS, TOP, loading, prm  # noqa: E402
from study import Study, parse_arguments  # noqa: E402

THICKNESSES = (0.5, 1, 2, 4, 8, 16)  # mm
PLANE_STRESS = "35.027e9, 7.232e9, 44.953e9, 13.785e9"  # of the stiffness in 30-contact_dynamics-thickness.prm with sigma_yy = 0
COLUMNS_OF_LAYER = ["time [ms]", "relative difference [-]"]
COLUMNS_OF_PROFILE = ["thickness [mm]", "distance from the middle plane over half the thickness [-]", "mean pressure over P [-]"]


def cells_across(thickness, spacing):
    """Of half the body; a thin one has two at least, or one of 0.25 mm."""
    return max(1 if thickness <= 0.5 else 2, round(thickness / 2 / spacing))


def add_runs(study):
    """{name: (body, thickness or None, spacing, load, start)}"""
    runs = {}
    for spacing in (1, 0.5):
        nx, nz = round(56 / spacing), round(16 / spacing)
        for load in LOADS:
            for start in STARTS if spacing == 1 else (0.5,):
                for body, stiffness in (("plane strain", None), ("plane stress", PLANE_STRESS)):
                    name = f"{body.replace(' ', '_')}-{spacing:g}mm-{load:g}MPa-{start:g}"
                    settings = {"Body/Cells": (nx, nz), **loading(load, start, 2)}
                    study.add(name, "contact_dynamics", prm("20-contact_dynamics-plane"), {**settings, **({"Body/Stiffness": stiffness} if stiffness else {})})
                    runs[name] = (body, None, spacing, load, start)
                for thickness in THICKNESSES:
                    if spacing == 0.5 and (load != 0.5 or thickness > 8):
                        continue
                    name = f"thick-{thickness:g}mm-{spacing:g}mm-{load:g}MPa-{start:g}"
                    study.add(name, "contact_dynamics", prm("30-contact_dynamics-thickness"), {
                        "Body/Cells": (nx, cells_across(thickness, spacing), nz), "Body/Size": (56e-3, thickness * 0.5e-3, 16e-3),
                        **loading(load, start, 3)})
                    runs[name] = ("free faces", thickness, spacing, load, start)
    same = {"Time/Time step": 75e-9, "Observation/History interval": 1}
    study.add("plane-same_step", "contact_dynamics", prm("20-contact_dynamics-plane"), same)
    study.add("layer-same_step", "contact_dynamics", prm("30-contact_dynamics-thickness"), {
        **same, "Body/Cells": (112, 1, 32), "Body/Size": (56e-3, 5e-4, 16e-3), "Supports/Back/Held": "u_y"})
    study.add("moduli", "rve_homogenization", prm("10-rve_homogenization-long_bars"))
    return runs


def add_all(study):
    """The homogeneous pins and those with fibres, as add_runs of either returns them."""
    fibres.add_plane_morphologies(study)
    homogeneous, heterogeneous = add_runs(study), fibres.add_runs(study)
    modes.add_modes(study)
    return homogeneous, heterogeneous


def extruded(study):
    """Long bars, of the paper's morphology and of wider fibres, for the runs that read them."""
    fibres.add_plane_morphologies(study)
    study.run()
    fibres.extrude(study.path(fibres.PAPER), os.path.join(TOP, "prm", "thickness", "long_bars.npy"), 1)
    fibres.extrude(study.path(fibres.PLANE), os.path.join(study.path(fibres.PLANE), "long_bars.npy"), 2)
    fibres.extrude(study.path(fibres.PAPER), os.path.join(study.path(fibres.PAPER), "long_bars.npy"), fibres.FINE_LAYERS)


def results_of(study):
    """Of all its runs, which have to end well."""
    results = study.run()
    failed = [name for name in study.cases if name not in results or results[name].status != 0]
    if failed:
        sys.exit(f"run.sh thickness: {', '.join(failed)} did not end well")
    return results


def write_fine(study, folder):
    """The paper's fibres in a thin pin."""
    fibres.add_plane_morphologies(study)
    runs = fibres.add_fine_runs(study)
    results = results_of(study)
    write_fibres(folder, "fine.csv", runs, results)


def write_fibres(folder, name, runs, results):
    write_csv(folder, name, fibres.FIBRE_COLUMNS + RUN_COLUMNS[5:], [[*of, *row(results[run])] for run, of in runs.items()])


def write_all(study, folder):
    runs, with_fibres = add_all(study)
    results = results_of(study)
    write_csv(folder, "runs.csv", RUN_COLUMNS, [[body, *rest, *row(results[name])] for name, (body, *rest) in runs.items()])
    write_csv(folder, "layer.csv", COLUMNS_OF_LAYER, difference(results["plane-same_step"].folder, results["layer-same_step"].folder))
    write_csv(folder, "layer_means.csv", RUN_COLUMNS[5:], [row(results[name]) for name in ("plane-same_step", "layer-same_step")])
    write_csv(folder, "profile.csv", COLUMNS_OF_PROFILE, [
        [t, *line] for t in THICKNESSES[2:5] for line in profile(results[f"thick-{t:g}mm-0.5mm-0.5MPa-0.5"].folder, 0.5e6)])
    write_fibres(folder, "fibres.csv", with_fibres, results)
    write_csv(folder, "modes.csv", modes.MODE_COLUMNS, modes.mode_rows(results))
    write_csv(folder, "moduli.csv", ["entry", "PBC [GPa]", "closed form [GPa]"], moduli(results["moduli"].summary))
    write_csv(folder, "cost.csv", ["runs", "processor time [s]"], [[len(results), round(sum(r.cpu_seconds for r in results.values()))]])


def main():
    arguments = parse_arguments(__doc__, "thickness", ("all",), on_request=("fine",))
    options = arguments.output, arguments.programs, arguments.jobs, arguments.keep
    doc = os.path.join(TOP, "doc", "paper")
    extruded(Study(*options))
    for part in arguments.parts:
        {"all": write_all, "fine": write_fine}[part](Study(*options), os.path.join(doc, "thickness"))
    thickness_page.write(doc)
    print("doc/paper/thickness.md")


if __name__ == "__main__":
    main()
