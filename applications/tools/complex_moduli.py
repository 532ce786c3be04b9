#!/usr/bin/env python3
"""Complex moduli of a composite over the frequency, from those of its phases.

    python3 applications/tools/complex_moduli.py FILE.prm --phase epoxy=epoxy.csv --frequencies 1e2,1e3,1e4,1e5

epoxy.csv has the columns frequency, modulus, loss_factor and, if it changes, poisson_ratio: Hz, real part of Young's modulus in Pa, imaginary over real part.
Between its rows the logarithms of modulus and loss factor are linear in that of the frequency. FILE.prm is that of one volume for rve_homogenization, which
runs once a frequency with the moduli that the phase has there; other phases keep theirs. The table complex_moduli.csv has real part, imaginary part and loss
factor of the moduli of the composite, a picture shows them with those of the phases. Runs that are there are not repeated.
"""

import argparse
import csv
import math
import os
import sys

sys.dont_write_bytecode = True  # leave no __pycache__ in a source tree
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path += [HERE, os.path.join(HERE, "studies")]

from volume_size import PROGRAM, SizeError, find_programs, list_of, results_of, study_in  # noqa: E402

SHOWN = ("E_x", "G_xy")


class Phase:
    """Moduli of a phase over the frequency."""

    def __init__(self, name, path):
        self.name, self.path = name, path
        try:
            with open(path, encoding="utf-8", newline="") as file:
                rows = list(csv.DictReader(file))
        except OSError as error:
            raise SizeError(f"{path} cannot be read: {error.strerror}") from None
        missing = [column for column in ("frequency", "modulus", "loss_factor") if not rows or column not in rows[0]]
        if missing:
            raise SizeError(f"{path} has no column {missing[0]}; give frequency, modulus and loss_factor in Hz, Pa and 1")
        try:
            self.rows = sorted([float(row[column]) for column in ("frequency", "modulus", "loss_factor")] + [float(row.get("poisson_ratio") or "nan")] for row in rows)
        except ValueError as error:
            raise SizeError(f"{path}: {error}") from None
        if any(not value > 0 for row in self.rows for value in row[:3]):
            raise SizeError(f"{path}: frequencies, moduli and loss factors have to be above 0")

    def at(self, frequency):
        """Settings of the phase at a frequency within the table."""
        rows = self.rows
        if not rows[0][0] * (1 - 1e-9) <= frequency <= rows[-1][0] * (1 + 1e-9):
            raise SizeError(f"{frequency:g} Hz is outside of {self.path}, which goes from {rows[0][0]:g} to {rows[-1][0]:g} Hz")
        k = min(max((n for n, row in enumerate(rows) if row[0] <= frequency), default=0), max(len(rows) - 2, 0))
        below, above = rows[k], rows[min(k + 1, len(rows) - 1)]
        part = 0.0 if below[0] == above[0] else math.log(frequency / below[0]) / math.log(above[0] / below[0])
        modulus, loss = (below[c] * (above[c] / below[c]) ** part for c in (1, 2))
        settings = {f"Phases/{self.name}/Young modulus": modulus, f"Phases/{self.name}/Loss factor": loss}
        ratio = below[3] + part * (above[3] - below[3])
        return settings if math.isnan(ratio) else {**settings, f"Phases/{self.name}/Poisson ratio": ratio}


def table_of(frequencies, summaries):
    """Rows {frequency, result, unit, real, imaginary, loss_factor}."""
    rows = []
    for frequency, summary in zip(frequencies, summaries):
        for name, varied in summary["varied"].items():
            if varied["unit"] == "Pa" and "imaginary" in varied:
                real, imaginary = varied["real"], varied["imaginary"]
                rows.append({"frequency": frequency, "result": name, "unit": "Pa", "real": real, "imaginary": imaginary,
                             "loss_factor": imaginary / real if real else math.nan})
    return rows


def draw(rows, phases, frequencies, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, (left, right) = plt.subplots(1, 2, figsize=(10.5, 4.2), layout="constrained")
    for k, name in enumerate(SHOWN):
        own = [row for row in rows if row["result"] == name]
        for axes, column, unit in ((left, "real", 1e9), (right, "loss_factor", 1)):
            axes.loglog([row["frequency"] for row in own], [row[column] / unit for row in own], "o-", ms=4, lw=1.2, color=f"C{k}", label=f"{name} of the composite")
    for k, phase in enumerate(phases):
        values = [phase.at(frequency) for frequency in frequencies]
        for axes, key, unit in ((left, "Young modulus", 1e9), (right, "Loss factor", 1)):
            axes.loglog(frequencies, [value[f"Phases/{phase.name}/{key}"] / unit for value in values], "--", lw=1, color=f"C{k + len(SHOWN)}", label=f"E of {phase.name}")
    left.set(xlabel="frequency (Hz)", ylabel="real part (GPa)", title="Moduli")
    right.set(xlabel="frequency (Hz)", ylabel="loss factor", title="Imaginary over real part")
    for axes in (left, right):
        axes.grid(alpha=0.3)
    right.legend(fontsize="small")
    figure.savefig(path, dpi=130)
    plt.close(figure)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("prm", help="parameters of rve_homogenization")
    parser.add_argument("--phase", action="append", required=True, metavar="NAME=FILE.csv", help="moduli of a phase over the frequency; may be given several times")
    parser.add_argument("--frequencies", required=True, help="in Hz, separated by commas")
    parser.add_argument("--output", metavar="DIR", default="output/complex_moduli", help="folder of the runs (default: output/complex_moduli)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="runs side by side (default: all cores)")
    parser.add_argument("--programs", metavar="DIR", default=None, help="folder of the programs (default: where they are built or installed)")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    try:
        if not os.path.isfile(arguments.prm):
            raise SizeError(f"there is no file {arguments.prm}")
        pairs = [pair.partition("=") for pair in arguments.phase]
        if any(not sign for _, sign, _ in pairs):
            raise SizeError("--phase wants NAME=FILE.csv")
        phases = [Phase(name.strip(), path.strip()) for name, _, path in pairs]
        frequencies = sorted(set(list_of(arguments.frequencies, float, "--frequencies")))
        study = study_in(arguments, find_programs(arguments.programs))
        for frequency in frequencies:
            settings = {key: value for phase in phases for key, value in phase.at(frequency).items()}
            study.add(f"{frequency:g}Hz", PROGRAM, arguments.prm, {"Homogenization/Write concentration": False, "Homogenization/Loss": "complex", **settings})
        results = results_of(study)
    except SizeError as error:
        sys.exit(f"complex_moduli.py: {error}")
    rows = table_of(frequencies, [result.summary for result in results.values()])
    with open(os.path.join(arguments.output, "complex_moduli.csv"), "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, list(rows[0]))
        table.writeheader()
        table.writerows(rows)
    draw(rows, phases, frequencies, os.path.join(arguments.output, "complex_moduli.png"))
    for frequency in frequencies:
        own = {row["result"]: row for row in rows if row["frequency"] == frequency}
        print(f"{frequency:g} Hz: " + "; ".join(f"{name} = {own[name]['real'] / 1e9:.4g} GPa, loss factor {own[name]['loss_factor']:.3g}" for name in SHOWN))
    print(f"table and picture: {os.path.join(arguments.output, 'complex_moduli.csv')}, complex_moduli.png")


if __name__ == "__main__":
    main()
