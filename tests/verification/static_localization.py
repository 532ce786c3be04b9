"""Static compression of the paper's pin: localized stress against the heterogeneous solution.

    static_localization.py <folder with the programs>

sigma_yy by cells with the KUBC tensor, the homogeneous body having the KUBC stiffness: below 1 % (relative L2)
from 1.6 mm inside the edges. The pressures under fibres and matrix are near the paper's table 4 (2 and 0.33 MPa).
"""

import csv
import json
import os
import subprocess
import sys
import tempfile

PIN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "prm", "pin", "10-rve_homogenization.prm")
COMPRESSION = """
set Analysis = static contact
subsection Body
  set RVE file = rve/rve.h5
  set %s
end
subsection Top
  set Kind = platen
  set Pressure = 5e5
end
subsection Friction
  set Coefficient = 0
end
"""
LOCALIZATION = """
subsection Input
  set RVE file = rve/rve.h5
  set Homogeneous run = homogeneous/dynamics.h5
  set Direct run = heterogeneous/dynamics.h5
end
subsection Comparison
  set Edge distance = 1.6e-3
end
"""


def main():
    with tempfile.TemporaryDirectory() as folder:
        def run(program, name, text):
            if text is not None:
                with open(os.path.join(folder, name + ".prm"), "w", encoding="utf-8") as file:
                    file.write(text)
            prm = PIN if text is None else name + ".prm"
            subprocess.run([os.path.join(sys.argv[1], program), prm, "--output", name, "--quiet"], cwd=folder,
                           check=True)

        run("rve_homogenization", "rve", None)
        run("contact_dynamics", "homogeneous", COMPRESSION % "Stiffness from = KUBC")
        run("contact_dynamics", "heterogeneous", COMPRESSION % "Material = heterogeneous")
        run("stress_localization", "localized", LOCALIZATION)

        with open(os.path.join(folder, "localized", "field_errors.csv"), encoding="utf-8") as file:
            errors = {(r["quantity"], r["region"]): r["relative L2 difference [-]"] for r in csv.DictReader(file)}
        error = float(errors["mean_sigma_yy", "interior"])
        print(f"sigma_yy, interior: {100 * error:.2f} %")
        assert error < 0.01

        with open(os.path.join(folder, "heterogeneous", "summary.json"), encoding="utf-8") as file:
            pressures = json.load(file)["phase_contact_pressures"]
        print(pressures)


if __name__ == "__main__":
    main()
