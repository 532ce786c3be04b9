"""Complex moduli over the frequency: a laminate of an elastic phase and one whose modulus and loss factor change has those of the closed form."""

import csv
import os
import subprocess
import sys
import tempfile

import numpy as np

from scenes import PROGRAMS, TOOLS, Folder, prm

LAYERS = {"Grid/Cells": "10, 2", "Grid/Size": "1e-3, 2e-4", "Microstructure/Type": "image", "Microstructure/File": "layers.txt",
          "Homogenization/Boundary conditions": "PBC", "Homogenization/Effective": "PBC", "Homogenization/Tolerance": 1e-12,
          "Phases/Names": "epoxy, fibre", "Phases/epoxy/Young modulus": 1e9, "Phases/epoxy/Poisson ratio": 0.3, "Phases/fibre/Young modulus": 240e9,
          "Phases/fibre/Poisson ratio": 0.3, "Phases/fibre/Loss factor": 0.001}
TABLE = "frequency,modulus,loss_factor\n1,2e9,0.01\n100,4e9,0.04\n1e4,5e9,0.02\n"


def run(folder, *words, status=0):
    done = subprocess.run([sys.executable, os.path.join(TOOLS, "complex_moduli.py"), folder("layers.prm"), "--programs", PROGRAMS, "--output", folder("found"),
                           *words], capture_output=True, text=True, check=False)
    assert done.returncode == status, done
    return done.stdout if status == 0 else done.stderr


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        folder.write("layers.txt", "1 0 0 0 0 0 0 0 0 0\n" * 2)
        folder.write("layers.prm", prm(LAYERS))
        folder.write("epoxy.csv", TABLE)
        table = "epoxy=" + folder("epoxy.csv")
        said = run(folder, "--phase", table, "--frequencies", "1,10,100,1000,10000")
        with open(folder("found", "complex_moduli.csv"), encoding="utf-8") as file:
            rows = {(float(row["frequency"]), row["result"]): complex(float(row["real"]), float(row["imaginary"])) for row in csv.DictReader(file)}
        per_modulus = 0.7 / (1.3 * 0.4)  # C11 / E
        for frequency, modulus, loss in ((1, 2e9, 0.01), (10, 8**0.5 * 1e9, 0.02), (100, 4e9, 0.04), (1000, 20**0.5 * 1e9, 8**0.5 / 100), (1e4, 5e9, 0.02)):
            exact = per_modulus / (0.9 / (modulus * (1 + 1j * loss)) + 0.1 / (240e9 * (1 + 0.001j)))
            found = rows[frequency, "D11"]
            print(f"{frequency:g} Hz: {found:.6g}, exact {exact:.6g}")
            assert abs(found.imag / found.real / (exact.imag / exact.real) - 1) < 1e-7 and abs(found.real / exact.real - 1) < 1e-7
        assert "1e+04 Hz: E_x" in said or "10000 Hz: E_x" in said, said
        assert os.path.getsize(folder("found", "complex_moduli.png")) > 10000
        for words, what in ((("--phase", table, "--frequencies", "0.5"), "is outside of"), (("--phase", "epoxy", "--frequencies", "1"), "NAME=FILE.csv"),
                            (("--phase", "epoxy=none.csv", "--frequencies", "1"), "cannot be read"), (("--phase", table, "--frequencies", "x"), "no list of numbers"),
                            (("--phase", "glue=" + folder("epoxy.csv"), "--frequencies", "1"), "Phases/glue")):
            assert what in run(folder, *words, status=1), what


if __name__ == "__main__":
    main()
