"""Static compression of the paper's pin: localized stress against the heterogeneous solution.

sigma_yy by cells with the KUBC tensor, the homogeneous body having the KUBC stiffness: below 1 % (relative L2)
from 1.6 mm inside the edges. The pressures under fibres and matrix are near the paper's table 4 (2 and 0.33 MPa).
"""

import csv
import os
import tempfile

from scenes import Folder, prm

PIN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "..", "prm", "pin", "10-rve_homogenization.prm")
COMPRESSION = {"Analysis": "static contact", "Body/RVE file": "rve/rve.h5", "Supports/Top/Kind": "platen", "Supports/Top/Pressure": 5e5, "Friction/Coefficient": 0}
LOCALIZATION = {"Input/RVE file": "rve/rve.h5", "Input/Homogeneous run": "homogeneous/dynamics.h5",
                "Input/Direct run": "heterogeneous/dynamics.h5", "Comparison/Edge distance": 1.6e-3}


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"homogeneous": prm({**COMPRESSION, "Body/Stiffness from": "KUBC"}), "localized": prm(LOCALIZATION),
                               "heterogeneous": prm({**COMPRESSION, "Body/Material": "heterogeneous"})})
        for program, file, name in (("rve_homogenization", PIN, "rve"), ("contact_dynamics", "homogeneous.prm", "homogeneous"),
                                   ("contact_dynamics", "heterogeneous.prm", "heterogeneous"),
                                   ("stress_localization", "localized.prm", "localized")):
            folder.run(0, program, file, "--output", name, "--quiet")
        with open(folder("localized", "field_errors.csv"), encoding="utf-8") as file:
            errors = {(r["quantity"], r["region"]): r["relative L2 difference [-]"] for r in csv.DictReader(file)}
        error = float(errors["mean_sigma_yy", "interior"])
        print(f"sigma_yy, interior: {100 * error:.2f} %", folder.summary("heterogeneous")["phase_contact_pressures"])
        assert error < 0.01
        # Twice the height of the pin: there is no interior, and no error of it.
        said = folder.run(0, "stress_localization", "localized.prm", "--quiet", "--set", "Comparison/Edge distance=32e-3", "--output", "cramped")
        assert said.count("no cell is Comparison/Edge distance away") == 1, said
        said = folder.run(0, "stress_localization", "localized.prm", "--validate", "--set", "Comparison/Edge distance=32e-3")
        assert said.count("more than half of the body's smallest side, ") == 1, said
        assert folder.summary("cramped")["field_errors"]["mean_von_mises"]["interior"] is None
        assert not folder.summary("localized")["warnings"], folder.summary("localized")["warnings"]


if __name__ == "__main__":
    main()
