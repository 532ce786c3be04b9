"""Static solves that fail, and results that cannot be trusted: what the program says, and whether its advice helps."""

import math
import os
import shutil
import tempfile

from scenes import Folder, sets

problems = []


def phase(name, text):
    return f" subsection {name}\n" + "".join(f"  set {line}\n" for line in text) + " end\n"


def isotropic(modulus, ratio):
    return [f"Young modulus = {modulus}", f"Poisson ratio = {ratio}"]


def case(cells, a, b, rows):
    """A .prm and its map; rows from the top."""
    folder = Folder(os.getcwd())
    folder.write("map.txt", "".join(" ".join(map(str, row)) + "\n" for row in rows))
    folder.write("case.prm", f"subsection Grid\n set Cells = {cells}, {cells}\n set Spacing = 1e-4, 1e-4\nend\n"
                 + "subsection Phases\n set Names = a, b\n" + phase("a", a) + phase("b", b) + "end\n"
                 + "subsection Microstructure\n set Type = image\n set File = map.txt\nend\n")


def run(status, words, *settings):
    """Starts the program, compares exit status and words, returns summary.json (None: there is none)."""
    shutil.rmtree("out", ignore_errors=True)
    folder = Folder(os.getcwd())
    said = folder.run(status, "rve_homogenization", "case.prm", "--output", "out", "--quiet",
                      *sets("Homogenization/" + setting for setting in ("Reuse=false", *settings)))
    print(settings, said)
    missing = [word for word in words if word not in said]
    if missing or (not words and said):
        problems.append(f"{settings}: lacks {missing}: {said}")
    written = [name for name in ("summary.json", "rve.h5", "stiffness.csv") if os.path.exists("out/" + name)]
    assert len(written) == (0 if status else 3), f"{settings}: {written} written"
    begun = [name for name in os.listdir("out") if name.endswith(".part")] if os.path.isdir("out") else []
    assert not begun, f"{settings}: {begun} left"
    return None if status else folder.summary("out")


def square(n):
    return [[int(n // 4 <= i < 3 * n // 4 and n // 4 <= j < 3 * n // 4) for i in range(n)] for j in range(n)]


def chessboard(n):
    return [[(i + j) % 2 for i in range(n)] for j in range(n)]


def near(value, expected, relative, what):
    if not abs(value - expected) <= relative * abs(expected):
        problems.append(f"{what}: {value} instead of {expected}")


def failures():
    case(24, isotropic(30e9, 0.499999999), isotropic(300e9, 0.499999999), square(24))
    conditions = ["Boundary conditions=SUBC", "Effective=SUBC", "Mean dilatation=never"]
    run(3, ["SUBC xx: ", "set Homogenization/Solver = multigrid"], *conditions, "Solver=ml")
    run(0, ["nearly incompressible"], *conditions, "Solver=multigrid")


def digits():
    case(24, isotropic(30e9, 0.2), isotropic(30e15, 0.2), square(24))
    conditions = ["Boundary conditions=KUBC", "Effective=KUBC"]
    run(3, ["KUBC: ", "contradict", "Homogenization/Tolerance"], *conditions, "Tolerance=0.5")
    told = run(0, ["KUBC: ", "about 2 digits hold", "lower Homogenization/Tolerance (now 1e-07)"], *conditions, "Tolerance=1e-7")
    if not any("digits" in warning for warning in told["warnings"]):
        problems.append("the summary lacks the warning")
    exact = run(0, [], *conditions, "Tolerance=1e-13")["stiffness"]["KUBC"]
    near(told["stiffness"]["KUBC"][0][1], exact[0][1], 1e-6, "D12 from the energy")
    # Moduli beyond single precision.
    case(8, isotropic(1e-30, 0.2), isotropic(8e-30, 0.2), chessboard(8))
    tiny = run(0, ["8.33e-31 Pa"])["stiffness"]["KUBC"]
    case(8, isotropic(1e9, 0.2), isotropic(8e9, 0.2), chessboard(8))
    usual = run(0, [])["stiffness"]["KUBC"]
    near(tiny[0][0] * 1e39, usual[0][0], 1e-9, "D11 of 1e-30 Pa")


def hidden():
    # Fibres of 150 GPa at 45 degrees in 10 GPa, as one orthotropic phase: D13 from the rotation of the stiffness.
    fibres = ["Type = orthotropic", "Young moduli = 150e9, 10e9, 10e9", "Poisson ratios = 0.3, 0.3, 0.3",
              "Shear moduli = 5e9, 5e9, 5e9", f"Angle = {math.pi / 4}"]
    case(8, fibres, fibres, chessboard(8))
    told = run(0, ["Effective symmetry = orthotropic", "D13", "D23"])
    D = told["stiffness"]["KUBC"]
    share = 100 * D[0][2] / math.sqrt(D[0][0] * D[2][2])
    if not any(f"{share:.3g} %" in warning for warning in told["warnings"]):
        problems.append(f"{share} % is not in {told['warnings']}")
    run(0, [], "Effective symmetry=full")
    # Holes that cut the body in two.
    case(16, isotropic(30e9, 0.2), isotropic(30e3, 0.2), [[int(i == 8) for i in range(16)] for _ in range(16)])
    told = run(0, ["mean of KUBC and SUBC", "factor", "D11 ="])
    for condition in ("KUBC", "SUBC"):
        value = told["stiffness"][condition][0][0] * 1e-9
        if not any(f"{value:.4g} GPa" in warning for warning in told["warnings"]):
            problems.append(f"{value} GPa is not in {told['warnings']}")
    run(0, ["soft rubber"], "Boundary conditions=PBC", "Effective=PBC")


def main():
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        failures()
        digits()
        hidden()
        os.chdir("/")
    assert not problems, "\n".join(problems)


if __name__ == "__main__":
    main()
