"""Strains that are not small are told, and a cell that is inside out ends a run.

A column that is compressed alone, so that the largest strain is P / D22 when the pressure grows slowly, and the
compliance times the pressure in a static analysis with free sides: the summary says so, on two ranks as well.
"""

import os
import tempfile

import numpy as np

from scenes import Folder, prm, sets

D11, D12, D22, D33 = 36.54e9, 9.1e9, 47.26e9, 13.785e9
CASE = prm({"Body/Cells": "20, 10", "Body/Size": "0.002, 0.001", "Friction/Coefficient": 0})
COLUMN = {"Time/End time": 1.2e-5, "Supports/Left/Held": "u_x", "Supports/Right/Held": "u_x", "Supports/Top/Ramp": "smooth", "Supports/Top/Ramp time": 1e-5}
STATIC = {"Analysis": "static contact", "Supports/Top/Kind": "pressure", "Flat/Velocity": 0}


def run(settings, ranks=1):
    """Exit status, errors and warnings, summary."""
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"case": CASE})
        status, _, said = folder.end("contact_dynamics", "case.prm", "--output", "out", "--quiet", *sets(settings), ranks=ranks)
        return status, said, folder.summary("out") if os.path.exists(folder("out", "summary.json")) else {}


def near(found, expected, tolerance, what):
    print(f"{what}: {found:.6g}, expected {expected:.6g}")
    assert abs(found / expected - 1) < tolerance, what


def column():
    for strain in (0.04, 0.06):
        found = []
        for ranks in (1, 2):
            status, said, summary = run({**COLUMN, "Supports/Top/Pressure": strain * D22}, ranks)
            assert status == 0, said
            near(summary["largest_strain"], strain, 2e-3, f"column on {ranks} ranks")
            assert ("the strain is" in said) == (strain > 0.05), said
            found.append(summary["largest_strain"])
            if strain > 0.05:
                assert "step" in said and "cell (" in said and "Supports/Top/Pressure" in said and "5 %" in said, said
                assert said.count("the strain is") == 1 and len(summary["warnings"]) == 2, said  # that of the pressure as well
        near(found[1], found[0], 1e-12, "two ranks for one")


def static():
    compliance = np.linalg.inv(np.array([[D11, D12, 0], [D12, D22, 0], [0, 0, D33]]))
    for pressure in (1e8, 4e9):
        exx, eyy, gxy = compliance @ [0, -pressure, 0]
        expected = np.sqrt(exx ** 2 + eyy ** 2 + gxy ** 2 / 2)
        status, said, summary = run({**STATIC, "Supports/Top/Pressure": pressure})
        assert status == 0, said
        near(summary["largest_strain"], expected, 1e-6, f"static, {pressure:g} Pa")
        assert ("the strain is" in said) == (expected > 0.05), said


def turning():
    """A body that falls over its edge turns, without strain."""
    status, said, summary = run({"Supports/Top/Kind": "pressure", "Supports/Top/Pressure": 0, "Body/Initial velocity": "100, -100", "Friction/Coefficient": 1,
                                 "Time/End time": 4e-6})
    assert status == 0 and summary["largest_strain"] < 0.05 and "the rotation is" in said, said


def inside_out():
    for settings in ({"Time/End time": 1e-5}, {"Analysis": "static contact"}):
        status, said, summary = run({**settings, "Supports/Top/Pressure": 1e12})
        assert status == 3 and not summary, (status, said)
        for word in ("cell (", "inside out", "Supports/Top/Pressure = 1e+12 Pa", "2116 %"):
            assert word in said, f"'{word}' is missing in: {said}"
    assert "static contact" in said, said
    status, said, _ = run({"Time/End time": 1e-5, "Body/Initial velocity": "0, -1e5"})
    assert status == 3 and "Body/Initial velocity = 1e+05 m/s" in said, said


def main():
    column()
    static()
    turning()
    inside_out()


if __name__ == "__main__":
    main()
