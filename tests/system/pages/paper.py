"""./run.sh paper: every table and figure of the paper is listed, the settings of every run are accepted, and some parts
come out on a coarse grid with their pictures.

    paper.py <folder with the programs> [--all]

--all makes the whole page (a minute).
"""

import glob
import os
import re
import sys
import tempfile

from scenes import PROGRAMS, TOOLS, TOP, Folder, sets

sys.path.insert(0, os.path.join(TOOLS, "studies", "paper"))

import run  # noqa: E402
from study import Study  # noqa: E402

WANTED = (["equation-10"] + [f"figure-{n}" for n in (2, 4, 5, 6, 7, 8, 9, 11, 12, 13, 14, 15, 16)]
          + [f"table-{n}" for n in (2, 3, 4, 5, 6)])

CELLS, END = "140, 40", 3e-4
DYNAMIC = {"Body/Cells": CELLS, "Time/End time": END, "Observation/Steady from": 1e-4}
SNAPSHOTS = {"Snapshots/From": 2e-4, "Snapshots/Interval": 1e-5, "Observation/Probe interval": 1,
             "Observation/element_A/Position": "0.0266, 0.0002", "Observation/element_B/Position": "0.0282, 0.0082"}
COARSE = {
    "10-rve_homogenization": {"Grid/Cells": CELLS, "Microstructure/Random fibres/Fibre width": 4e-4,
                              "Microstructure/Random fibres/Minimum height": 1.2e-3},
    "20-contact_dynamics-modes": {"Body/Cells": CELLS},
    "30-contact_dynamics-homogeneous": DYNAMIC,
    "31-contact_dynamics-homogeneous_1700ns": {**DYNAMIC, **SNAPSHOTS},
    "32-contact_dynamics-homogeneous_regime_2": DYNAMIC,
    "40-contact_dynamics-heterogeneous": {**DYNAMIC, **SNAPSHOTS},
}


SOME = ["equation-10", "figure-2", "figure-9", "table-4", "figure-14"]  # all programs and analyses but the modes


def page_failures(folder, parts):
    """What goes wrong when the parts are run and written on a coarse grid."""
    study, doc = Study(os.path.join(folder, "runs"), PROGRAMS), os.path.join(folder, "doc")
    found = [sentence for sentence in run.make(study, parts, doc, COARSE) if "not run yet" not in sentence]
    with open(os.path.join(doc, "README.md"), encoding="utf-8") as file:
        page = file.read()
    pictures = re.findall(r"\]\(([\w-]+\.png)\)", page)
    found += [f"the page has no section '{run.PARTS[key].title}'" for key in parts if f"## {run.PARTS[key].title}\n" not in page]
    found += [f"{name} is linked but missing" for name in pictures if not os.path.isfile(os.path.join(doc, name))]
    found += [f"{key} has no picture" for key in set(parts) & set(WANTED) if not any(name.startswith(key) for name in pictures)]
    return found + (["the page holds a nan"] if re.search(r"\bnan\b", page) else [])


def settings_failures():
    """Which settings a program refuses, and which files of prm/paper no run uses."""
    study = Study(os.path.join(TOP, "results", "paper"), PROGRAMS)
    for part in run.PARTS.values():
        part.runs(run.Cases(study))
    found, kinds = [], {(case.prm, *case.settings): case for case in study.cases.values()}
    for case in kinds.values():  # runs that differ in values alone are of one kind
        status, _, said = Folder(os.getcwd()).end(case.program, case.prm, "--print-parameters", *sets(case.settings))
        if status != 0:
            found.append(f"{case.name}: {said.strip()}")
    used = {case.prm for case in study.cases.values()}
    return found + [f"no run uses {path}" for path in glob.glob(os.path.join(TOP, "prm", "paper", "*.prm")) if path not in used]


def main():
    found = [f"run.sh paper has no part {key}" for key in WANTED if key not in run.PARTS]
    found += settings_failures()
    with tempfile.TemporaryDirectory() as folder:
        found += page_failures(folder, list(run.PARTS) if "--all" in sys.argv else SOME)
    for sentence in found:
        print(sentence)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
