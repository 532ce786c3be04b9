"""What the programs leave out where a scene does not need it: each shortcut as two settings of one scene that have to give
the same answer. `skips.py` measures the time saved, `tests/system/chains/shortcuts.py` the answers, on smaller grids."""

import dataclasses
import math
import os

from common import TOP, prm, read_csv

E, NU = 30e9, 0.2  # Pa; the matrix of the pin
PLANE_STRAIN = [E * (1 - NU) / (1 + NU) / (1 - 2 * NU), E * NU / (1 + NU) / (1 - 2 * NU),
                E * (1 - NU) / (1 + NU) / (1 - 2 * NU), E / 2 / (1 + NU)]
AREA = 0.056 * 0.016  # m^2
FRICTION = ("friction_energy", "slip_fraction", "separation_fraction")
STATES = ("slip_fraction", "separation_fraction", "reference_node")  # counted in every step, whatever is observed
MU = ("global_interface_friction_coefficient",)
SAME = 1e-9  # relative: round-off, grown by contacts that close and open


@dataclasses.dataclass
class Shortcut:
    """`short` and `full` are the settings with and without it, `base` and those of `small` (the test) go to both.
    In the test `small_full` goes to the run without it, too. `compared` are paths in summary.json that agree within `tolerance`,
    relative; of a whole table: its largest number. A tolerance of None: by the fit of work_precision.md, see `promise`."""
    name: str
    scene: str
    program: str
    file: str
    short: dict
    full: dict
    compared: tuple
    tolerance: float | None = SAME
    base: dict = dataclasses.field(default_factory=dict)
    small: dict = dataclasses.field(default_factory=dict)
    small_full: dict = dataclasses.field(default_factory=dict)


STOP = "stop at the limit cycle"
QUIET = {"Snapshots/Interval": 0, "Observation/Steady from": "auto", "Observation/Stop at limit cycle": False}
FINE = {**QUIET, "Observation/Steady from": 5e-5, "Body/Cells": [560, 160], "Body/RVE file": "{rve}/rve.h5", "Time/End time": 2e-4}
COARSE = {**FINE, "Observation/Steady from": 7.5e-4, "Body/Cells": [280, 80], "Time/End time": 1.5e-3}
# The stiffness of eq. (10), in Pa: with it the pin stays in its limit cycle (doc/paper/reading.md).
PAPER = {"Body/Stiffness": [36.54e9, 9.1e9, 47.26e9, 13.785e9], "Body/Density": 1770, "Body/Size": [0.056, 0.016], "Body/RVE file": ""}
LASTING = {**COARSE, **PAPER, "Observation/Steady from": "auto", "Time/End time": 4e-3}
CYCLE_TOLERANCE = 0.02  # of the criterion for a limit cycle (lib/observation/steady_state.h)
SMALL = {"Body/Cells": [70, 20], "Time/End time": 1e-4}
SMALL_MOTION = {**PAPER, "Body/Cells": [140, 40]}
HOMOGENEOUS, HETEROGENEOUS = "pin/20-contact_dynamics-homogeneous.prm", "pin/30-contact_dynamics-heterogeneous.prm"
RVE, LOCALIZATION = "pin/10-rve_homogenization.prm", "pin/40-stress_localization.prm"
NO_PROBES = {"Observation/Probe interval": 1000000}
LOCALIZED = {"Input/RVE file": "{rve}/rve.h5", "Input/Homogeneous run": "{run}/dynamics.h5", "Input/Direct run": "",
             "Window/From": 0, "Window/To": "auto"}


def contact(name, scene, short, full, compared=FRICTION, tolerance=SAME, base=None, small=None, small_full=None):
    return Shortcut(name, scene, "contact_dynamics", HOMOGENEOUS, short, full, compared, tolerance, FINE if base is None else base,
                    SMALL if small is None else small, small_full or {})


def shortcuts():
    alike = {**PAPER, "Body/Material": "homogeneous", "Body/Stiffness": PLANE_STRAIN}
    return [
        contact("homogeneous material", "the pin of matrix alone, 0.2 ms", alike,
                {"Body/Material": "heterogeneous", "Body/RVE file": "{alike}/rve.h5"}, base={**FINE, "Body/Initial velocity": [0.5, 0]}),
        contact("beta = 0", "homogeneous pin, 0.2 ms; the other: beta = 1e-30 s", {"Time/Rayleigh beta": 0}, {"Time/Rayleigh beta": 1e-30}),
        contact("no observers", "homogeneous pin, 0.2 ms; the other: histories, probes and energies in every step",
                {"Observation/History interval": 1000000, "Observation/Energy interval": 0, **NO_PROBES},
                {"Observation/History interval": 1, "Observation/Energy interval": 1, "Observation/Probe interval": 1}, STATES),
        contact("observers now and then", "the same; histories and probes every 10, energies every 200 steps",
                {}, {"Observation/History interval": 1, "Observation/Energy interval": 1, "Observation/Probe interval": 1}, STATES),
        contact("several steps in flight", "homogeneous pin on 4480 x 1280 cells, 0.001 ms", {}, {"Performance/Temporal blocking": 1}, tolerance=0.0,
                base={**FINE, "Body/Cells": [4480, 1280], "Time/End time": 1e-6, "Observation/Steady from": 5e-7}, small={"Body/Cells": [560, 160], "Time/End time": 1e-5}),
        contact("larger automatic dt", "homogeneous pin, 280 x 80 cells, 1.5 ms; the other: 5 ns, as in the paper", {},
                {"Time/Time step": 5e-9}, MU, None, base=COARSE, small=SMALL_MOTION),
        contact("coarser macroscopic grid", "homogeneous pin, 1.5 ms; 280 x 80 instead of 560 x 160 cells", {},
                {"Body/Cells": [560, 160]}, MU, None, base=COARSE, small=SMALL_MOTION, small_full={"Body/Cells": [280, 80]}),
        contact(STOP, "pin with the stiffness of eq. (10), 280 x 80 cells; the other goes on to 4 ms",
                {"Observation/Stop at limit cycle": True}, {}, MU, CYCLE_TOLERANCE, base=LASTING,
                small={"Body/Cells": [140, 40], "Time/End time": 5e-3}),
        Shortcut("fewer boundary conditions", "KUBC alone; the other: KUBC, SUBC and PBC", "rve_homogenization", RVE,
                 {"Homogenization/Boundary conditions": "KUBC"}, {"Homogenization/Boundary conditions": "KUBC, SUBC, PBC"},
                 ("stiffness.KUBC",), 1e-12, {"Homogenization/Effective": "KUBC", "Homogenization/Reuse": False},
                 {"Grid/Cells": [140, 40], "Grid/Size": [0.014, 0.004]}),
        Shortcut("no concentration tensors", "KUBC and SUBC of the pin", "rve_homogenization", RVE,
                 {"Homogenization/Write concentration": False}, {}, ("stiffness.KUBC", "stiffness.SUBC"), 1e-12,
                 {"Homogenization/Reuse": False}, {"Grid/Cells": [140, 40], "Grid/Size": [0.014, 0.004]}),
        Shortcut("probes only", "localization of 100 snapshots; the other: all fields", "stress_localization", LOCALIZATION,
                 {"Localization/Fields": ""}, {}, ("probes",), 1e-12, LOCALIZED),
    ]


def add_needs(study, small):
    """The runs that the others read: the pin's morphology, one whose phases are alike, and a run with snapshots."""
    size = {"Grid/Cells": [70, 20], "Microstructure/Random fibres/Fibre width": 8e-4} if small else {}
    study.add("rve", "rve_homogenization", prm(RVE), size)
    study.add("alike", "rve_homogenization", prm(RVE), {**size, "Phases/fibre/Young modulus": E, "Homogenization/Boundary conditions": "KUBC",
                                                        "Homogenization/Write concentration": False})
    cells = SMALL["Body/Cells"] if small else [280, 80]
    study.add("run", "contact_dynamics", prm(HOMOGENEOUS), {**FINE, "Body/Cells": cells, "Time/End time": 1e-4, "Snapshots/From": 0,
                                                            "Snapshots/To": "auto", "Snapshots/Interval": 1e-6})


def add(study, shortcut, which, name, small=False):
    settings = {**shortcut.base, **(shortcut.small if small else {}), **getattr(shortcut, which)}
    if small and which == "full":
        settings.update(shortcut.small_full)
    study.add(name, shortcut.program, prm(shortcut.file), settings)


def difference(shortcut, short, full):
    """Largest relative difference of what two summaries say of `compared`; inf where something is missing."""
    worst = 0.0
    for path in shortcut.compared:
        a, b = (numbers(entry(summary, path)) for summary in (short, full))
        if not a or len(a) != len(b):
            return float("inf")
        scale = max(abs(x) for x in b)
        distance = max(abs(x - y) for x, y in zip(a, b))
        if not all(map(math.isfinite, a + b)):
            return float("inf")
        worst = max(worst, distance / scale if scale > 0 else float(distance > 0))
    return worst


def promise(shortcut, short, full):
    """What the answers may differ by: the tolerance, or the part of h and dt by the fit value + a h^2 + b dt to the nine runs of
    the pin in work_precision.md, which is a harder case."""
    if shortcut.tolerance is not None:
        return shortcut.tolerance
    fit = next(row for row in read_csv(os.path.join(TOP, "doc", "performance", "pin-limit.csv"))[0] if row["quantity"] == "mu_inter")
    part = [fit["per_mm2"] * 1e6 * AREA / summary["cells"] + fit["per_ns"] * 1e9 * summary["time_step"] for summary in (short, full)]
    return abs(part[0] - part[1]) / fit["value"]


def entry(summary, path):
    for key in path.split("."):
        summary = summary.get(key) if isinstance(summary, dict) else None
    return summary


def numbers(value):
    if isinstance(value, dict):
        return [x for key in sorted(value) for x in numbers(value[key])]
    if isinstance(value, list):
        return [x for part in value for x in numbers(part)]
    return [float(value)] if isinstance(value, (int, float)) and not isinstance(value, bool) else []
