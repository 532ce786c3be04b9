"""The table of ranks.py: what is run on which numbers of ranks, and how far results may be apart."""

import dataclasses
import re

from scenes import PHASES, prm

# One rank works, or all do the same: one other number of ranks is enough.
ALL, FEW, NONE = (2, 3, 5), (3,), ()
ENSEMBLE_RANKS = {"KUBC": ALL, "SUBC": (2, 3), "PBC": (2, 3), "mean": ALL}

FILES = {
    "rectangles.csv": "x_left_mm,y_bottom_mm,width_mm,height_mm\n0.3,0.2,0.3,0.6\n1.1,0.0,0.2,0.5\n1.5,0.7,0.4,0.4\n",
    "map.txt": "\n".join(" ".join(str(int((3 * i + 5 * j) % 7 < 2)) for i in range(20)) for j in range(12)) + "\n",
}


@dataclasses.dataclass
class Run:
    """In a setting `{name-1}` is the folder of the run of that name on one rank and `<files>` that of FILES. The results on
    `ranks` are compared with those on one, bit by bit but for `tolerances` (see comparison.py); with a `reference` those on
    one and on `ranks` with that run on one, but for what tells of the solver."""
    name: str
    program: str
    text: str
    settings: dict
    ranks: tuple = ALL
    tolerances: tuple = ()
    reference: str = ""

    def __post_init__(self):
        texts = [str(value) for value in self.settings.values()]
        self.needs = {self.reference} - {""} | {name for text in texts for name in re.findall(r"\{([^}]+)-1\}", text)}


VOLUME = PHASES + prm({"Grid/Cells": "20, 12", "Grid/Size": "0.002, 0.0012", "Phases/fibre/Friction coefficient": 0.1,
                       "Homogenization/Boundary conditions": "KUBC, SUBC, PBC"})
RANDOM = VOLUME + prm({"Microstructure/Random fibres/Minimum height": 2e-4, "Microstructure/Random fibres/Maximum height": 4e-4,
                       "Microstructure/Random fibres/Cut by border": "true"})
ALONE = prm({"Body/RVE file": "here"})
BODY = ALONE + prm({
    "Time/End time": 2e-6, "Time/Time step": 5e-9, "Observation/Energy interval": 7, "Observation/Probes": "contact, between, top",
    "Observation/contact/Position": "0.00105, 0.00005", "Observation/between/Position": "0.00105, 0.00062",
    "Observation/top/Position": "0.0003, 0.0012", "Snapshots/From": 1e-6, "Snapshots/Interval": 1e-7})
LOCALIZATION = prm({"Input/RVE file": "here"})

# Energies are summed over the slabs of the ranks: round-off of the terms, which are below 0.01 J/m here, and in the
# residual that of their difference. Two to four parts in 1e16 were measured.
SUMS = (
    (r"^(energy\.csv:|dynamics\.h5:/energy/)residual", 0.0, 1e-16),
    (r"^(energy\.csv:|dynamics\.h5:/energy[/@])", 1e-14, 0.0),
    (r"^summary\.json:energy_balance_residual$", 0.0, 1e-14),
)
# Errors of fields are summed over the cells of the ranks; three parts in 1e16 were measured.
ERRORS = ((r"^(summary\.json:(mean_strain_variant/)?field_errors/|field_errors\.csv:)", 1e-14, 0.0),)


def rve(name, ranks=ALL, text=VOLUME, **settings):
    return Run(name, "rve_homogenization", text, settings, ranks)


def ensemble(effective):
    return rve("ensemble-" + effective, ENSEMBLE_RANKS[effective], RANDOM, **{"Ensemble/Members": 4, "Homogenization/Effective": effective})


def contact(name, ranks=ALL, tolerances=SUMS, text=BODY, **settings):
    return Run(name, "contact_dynamics", text, {"Body/RVE file": "{rve-random-1}/rve.h5", **settings}, ranks, tolerances)


def localization(name, **settings):
    return Run(name, "stress_localization", LOCALIZATION,
               {"Input/RVE file": "{rve-random-1}/rve.h5", "Input/Homogeneous run": "{homogeneous-platen-1}/dynamics.h5", **settings}, FEW, ERRORS)


RECTANGLES = {"Microstructure/Type": "rectangles", "Microstructure/File": "<files>/rectangles.csv", "Homogenization/Tolerance": 1e-12}
MODAL = {"Analysis": "modal", "Modal/Number of modes": 2}
STATIC = {"Analysis": "static contact", "Static contact/Tolerance": 1e-11}
BY_ML = {"Performance/Static solver": "ml", "Body/RVE file": "{rve-random-1}/rve.h5"}


def ml(name, program, text, **settings):
    """The run `name` once more on a mesh that METIS divides: the same problem, solved in another way."""
    return Run(name + "-ml", program, text, settings, (2, 4), ((r"", 1e-8, 1e-8),), name)


HETEROGENEOUS = {"Body/Material": "heterogeneous", "Friction/Coefficient from": "phases"}
# Nodes have to lift off; only the friction homogenization needs it.
LONG = {"Time/End time": 2e-5, "Observation/Steady from": 2e-6, "Snapshots/Interval": 0}

RUNS = [
    rve("rve-random", text=RANDOM),
    rve("rve-rectangles", (2,), **RECTANGLES),
    ml("rve-rectangles", "rve_homogenization", VOLUME, **RECTANGLES, **{"Homogenization/Solver": "ml"}),
    Run("rve-rectangles-divided", "rve_homogenization", VOLUME, {**RECTANGLES, "Homogenization/Solver": "divided"}, (2, 4), ((r"", 1e-8, 1e-8),),
        "rve-rectangles"),
    rve("rve-image", FEW, **{"Microstructure/Type": "image", "Microstructure/File": "<files>/map.txt",
                        "Homogenization/Solver": "jacobi"}),
    *(ensemble(effective) for effective in ("KUBC", "SUBC", "PBC", "mean")),
    contact("homogeneous-platen", **{"Supports/Top/Hold from": 1.2e-6, "Supports/Top/Platen mass": 0.02, "Flat/Ramp": "smooth",
                                     "Flat/Ramp time": 1e-6}),
    contact("heterogeneous-pressure", **HETEROGENEOUS, **{"Supports/Top/Kind": "pressure", "Supports/Top/Held": "u_x", "Supports/Left/Held": "u_x",
                                                         "Friction/Law": "slip rate", "Friction/Node rule": "mean"}),
    contact("friction-laws", **HETEROGENEOUS, **{
        "Friction/Coefficient law": "rate and state", "Friction/Coefficient": 0.3, "Friction/Rate and state/Length": 1e-8,
        "Friction/Normal stress": "slip rate"}),
    contact("periodic-held", **{"Sides/Periodic": True, "Supports/Top/Kind": "held", "Body/Acceleration": [0, -1e7], "Time/Beta2": 0.6,
                                "Flat/Gap": 1e-9, "Body/Cells": [40, 24], "Performance/Temporal blocking": 3}),
    contact("long-homogeneous", NONE, **LONG),
    contact("long-heterogeneous", NONE, **LONG, **HETEROGENEOUS),
    contact("modal", FEW, text=ALONE, **MODAL),
    contact("static", FEW, text=ALONE, **HETEROGENEOUS, **STATIC),
    ml("modal", "contact_dynamics", ALONE, **BY_ML, **MODAL),
    ml("static", "contact_dynamics", ALONE, **BY_ML, **HETEROGENEOUS, **STATIC),
    Run("friction", "contact_dynamics", prm({"Analysis": "friction homogenization"}), {
        "Friction homogenization/Calibrate": True, "Friction homogenization/Static contact": "{static-1}",
        "Friction homogenization/Heterogeneous run": "{long-heterogeneous-1}",
        "Friction homogenization/Homogeneous run": "{long-homogeneous-1}"}, FEW, SUMS),
    localization("localization-alone", **{"Probes/Further": "A", "Probes/A/Position": "0.0005, 0.0006"}),
    localization("localization-direct", **{"Input/Direct run": "{heterogeneous-pressure-1}/dynamics.h5", "Input/Allow different loads": True, "Window/From": 1.2e-6,
                                           "Comparison/Edge distance": 2e-4, "Comparison/Surface depth": 2e-4,
                                           "Localization/Variant": "both", "Localization/Concentration": "PBC"}),
]
