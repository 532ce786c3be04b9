"""The paper's pin on a mesh of deal.II against the grid: `Solver = ml` on 1, 2 and 4 ranks (METIS) and multigrid give the same
stiffness, frequencies and contact forces to 1e-8.

    mesh_pin.py <folder with the programs> [<cells along the height>]

160 cells along the height are those of the paper; the test takes fewer.
"""

import os
import sys
import tempfile

import h5py
import numpy as np

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
sys.path.insert(0, os.path.join(TOP, "applications", "tools", "studies"))

from study import Study  # noqa: E402

RANKS = (1, 2, 4)
PRM = os.path.join(TOP, "prm", "paper")
BODY = {"Body/RVE file": "{rve-grid}/rve.h5", "Body/Material": "heterogeneous"}
# Name: program, file of prm/paper, settings, key of the solver, datasets that are compared.
CASES = {
    "rve": ("rve_homogenization", "10-rve_homogenization", {}, "Homogenization/Solver",
            ["rve.h5:stiffness/KUBC", "rve.h5:stiffness/SUBC"]),
    "modes": ("contact_dynamics", "20-contact_dynamics-modes", {}, "Performance/Static solver",
              ["modal.h5:modes/free/frequency", "modal.h5:modes/held/frequency"]),
    "contact": ("contact_dynamics", "41-contact_dynamics-static_contact", BODY, "Performance/Static solver",
                ["dynamics.h5:static_contact/pressure", "dynamics.h5:static_contact/shear_traction"]),
}


def main():
    rows = int(sys.argv[2]) if len(sys.argv) > 2 else 40
    cells = [7 * rows // 2, rows]
    with tempfile.TemporaryDirectory() as folder:
        study = Study(sys.argv[3] if len(sys.argv) > 3 else folder, sys.argv[1], jobs=1)
        for name, (program, file, settings, solver, _) in CASES.items():
            settings = {**settings, ("Grid/Cells" if name == "rve" else "Body/Cells"): cells}
            if name == "rve":
                settings["Microstructure/Random fibres/Fibre width"] = 0.016 / rows
            study.add(f"{name}-grid", program, os.path.join(PRM, file + ".prm"), settings)
            for ranks in RANKS:
                study.add(f"{name}-{ranks}", program, os.path.join(PRM, file + ".prm"), {**settings, solver: "ml"}, ranks)
        results = study.run()
        worst = 0
        for name, (*_, datasets) in CASES.items():
            for dataset in datasets:
                file, dataset = dataset.split(":")
                def read(which):
                    with h5py.File(os.path.join(results[f"{name}-{which}"].folder, file)) as data:
                        return data[dataset][...]
                expected = read("grid")
                errors = [np.abs(read(ranks) - expected).max() / np.abs(expected).max() for ranks in RANKS]
                worst = max(worst, *errors)
                print(f"{name}, {dataset}: {', '.join(f'{e:.1e}' for e in errors)} on {', '.join(map(str, RANKS))} ranks")
        print(f"CPU seconds {sum(r.cpu_seconds for r in results.values()):.1f}, seconds {sum(r.seconds for r in results.values()):.1f}")
        assert worst < 1e-8, worst


if __name__ == "__main__":
    main()
