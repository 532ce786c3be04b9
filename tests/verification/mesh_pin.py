"""The paper's pin on a mesh of deal.II against the grid: ML on 1, 2 and 4 ranks (METIS) and multigrid give the same stiffness,
frequencies and contact forces to 1e-8. For the page; `system/programs/ranks` has smaller bodies."""

import os

import h5py
import numpy as np

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
RANKS = (1, 2, 4)
BODY = {"Body/RVE file": "{rve-grid}/rve.h5", "Body/Material": "heterogeneous"}
# Name: program, file of prm/paper, settings, key of the solver, {what is compared: dataset}.
CASES = {
    "rve": ("rve_homogenization", "10-rve_homogenization", {}, "Homogenization/Solver",
            {"stiffness, " + c: "rve.h5:stiffness/" + c for c in ("KUBC", "SUBC")}),
    "modes": ("contact_dynamics", "20-contact_dynamics-modes", {}, "Performance/Static solver",
              {f"frequencies, bottom {b}": f"modal.h5:modes/{b}/frequency" for b in ("free", "held")}),
    "contact": ("contact_dynamics", "41-contact_dynamics-static_contact", BODY, "Performance/Static solver",
                {"static contact, " + words: "dynamics.h5:static_contact/" + name
                 for words, name in (("pressure", "pressure"), ("friction", "shear_traction"))}),
}


def differences(study, rows=160):
    """{what is compared: largest differences from the grid over the largest value, one for each of RANKS}, of a pin with that many
    rows of cells; AssertionError for one of 1e-8 or more."""
    for name, (program, file, settings, solver, _) in CASES.items():
        prm = os.path.join(TOP, "prm", "paper", file + ".prm")
        settings = {**settings, ("Grid/Cells" if name == "rve" else "Body/Cells"): [7 * rows // 2, rows]}
        if name == "rve":
            settings["Microstructure/Random fibres/Fibre width"] = 0.016 / rows
        study.add(f"{name}-grid", program, prm, settings)
        for ranks in RANKS:
            study.add(f"{name}-{ranks}", program, prm, {**settings, solver: "ml"}, ranks)
    results, found = study.run(), {}
    for name, (*_, compared) in CASES.items():
        for what, place in compared.items():
            file, dataset = place.split(":")
            values = {}
            for which in ("grid", *RANKS):
                with h5py.File(os.path.join(results[f"{name}-{which}"].folder, file)) as data:
                    values[which] = data[dataset][...]
            found[what] = [np.abs(values[n] - values["grid"]).max() / np.abs(values["grid"]).max() for n in RANKS]
            assert max(found[what]) < 1e-8, f"{what}: {found[what]}"
    return found
