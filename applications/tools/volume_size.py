#!/usr/bin/env python3
"""How large must a volume element be, or how many of them?

    python3 applications/tools/volume_size.py FILE.prm --sizes 0.25,0.5,1 --members 32,16,8 --error 0.02

FILE.prm is that of one volume for rve_homogenization whose morphology is random (random fibres, random inclusions) or
a file of voxels. It is computed in several sizes, factors of all edges with the same cells, each with several
morphologies: further seeds, or as many pieces of the voxels as fit side by side. Of each property Z of the composite
the table has mean and standard deviation, the number of volumes of this size whose mean has the relative error that
is wanted, n = (2 s / (error Z))^2 (Kanit and others 2003), and of the volume fraction the integral range A,
var = p (1 - p) A / V. The picture shows means and deviations over the volume. Runs that are there are not repeated.
"""

import argparse
import csv
import json
import math
import os
import subprocess
import sys

sys.dont_write_bytecode = True  # leave no __pycache__ in a source tree
HERE = os.path.dirname(os.path.abspath(__file__))
sys.path += [HERE, os.path.join(HERE, "studies")]

from study import Study  # noqa: E402

PROGRAM = "rve_homogenization"
SEEDS = {"random fibres": "Microstructure/Random fibres/Seed", "random inclusions": "Microstructure/Random inclusions/Seed"}


SHOWN = ("E_iso", "G_iso", "E_x", "G_xy", "expansion_xx")  # in the picture; the table has all


class SizeError(Exception):
    """One sentence for the user."""


def read_keys(programs, prm, fixed):
    """{"Section/Key": text} of all keys, as the program has them with the `fixed` ones."""
    done = subprocess.run([os.path.join(programs, PROGRAM), prm, "--print-parameters", *(word for item in fixed.items() for word in ("--set", "=".join(item)))], capture_output=True, text=True, check=False)
    if done.returncode:
        raise SizeError(done.stderr.strip() or f"{PROGRAM} does not run")
    keys, sections = {}, []
    for line in done.stdout.splitlines():
        words = line.split("#")[0].strip()
        if words.startswith("subsection "):
            sections.append(words.split(None, 1)[1])
        elif words == "end":
            sections.pop()
        elif words.startswith("set "):
            key, _, value = words[4:].partition("=")
            keys["/".join([*sections, key.strip()])] = value.strip()
    return keys


def numbers(text):
    return [float(part) for part in text.split(",") if part.strip()]


class Volume:
    """What the .prm says of the volume, and the settings of another size of it."""

    def __init__(self, keys):
        if keys.get("Mesh/File"):
            raise SizeError("Mesh/File is set: a mesh has one size; take a grid")
        self.dim = int(keys["Dimension"])
        self.cells = [int(n) for n in numbers(keys["Grid/Cells"])]
        self.spacing = numbers(keys.get("Grid/Spacing", ""))
        self.size = [n * h for n, h in zip(self.cells, self.spacing)] if self.spacing else numbers(keys["Grid/Size"])
        if len(self.size) != self.dim or len(self.cells) != self.dim:
            raise SizeError(f"Grid/Cells and Grid/Size (or Spacing) have to have {self.dim} numbers")
        self.type = keys["Microstructure/Type"]
        if self.type in SEEDS:
            self.seed = int(keys[SEEDS[self.type]])
        elif self.type == "voxels":
            if not (keys.get("Microstructure/Image values") or keys.get("Microstructure/Thresholds")):
                raise SizeError("Microstructure/Image values is empty: a small piece may have fewer phases than the file, so say which value is which phase, "
                                "such as 0, 1")
            self.coarsening = int(keys["Microstructure/Coarsening"])
            self.start = [int(n) for n in numbers(keys["Microstructure/Crop from"])] or [0, 0, 0]
            self.whole = [int(n) for n in numbers(keys["Microstructure/Crop size"])] or [n * self.coarsening for n in self.cells]
        else:
            raise SizeError(f"Microstructure/Type is {self.type}; its sizes and members can be varied for {', '.join(SEEDS)} and voxels")

    def in_cells(self, factor):
        cells = [max(1, round(factor * n)) if n > 1 else 1 for n in self.cells]
        if self.type == "voxels" and any(n > m for n, m in zip(cells, self.cells)):
            raise SizeError(f"--sizes: {factor} is larger than the voxels of the file; take factors up to 1")
        return cells

    def measure(self, cells):
        """Volume in 3D (m^3), area in 2D (m^2)."""
        return math.prod(edge * n / whole for edge, n, whole in zip(self.size, cells, self.cells))

    def members(self, factor, wanted):
        """Settings of each morphology of a size."""
        cells = self.in_cells(factor)
        edges = [edge * n / whole for edge, n, whole in zip(self.size, cells, self.cells)]
        common = {"Grid/Cells": cells, **({} if self.spacing else {"Grid/Size": edges})}
        if self.type in SEEDS:
            # Sizes have seeds of their own, so that they are independent.
            first = self.seed + 1000003 * round(1000 * factor)
            return [{**common, SEEDS[self.type]: first + m} for m in range(wanted)]
        piece = [n * self.coarsening for n in cells]
        places = [[]]
        for start, whole, part in zip(self.start, self.whole, piece):
            places = [[*place, start + k * part] for place in places for k in range(whole // part)]
        return [{**common, "Microstructure/Crop from": place, "Microstructure/Crop size": piece} for place in places[:wanted]]


def properties(summary):
    """{name: (value, unit)} of a run: the fraction of the phases but the first, the moduli and the expansion."""
    found = {f"fraction of {phase['name']}": (phase["volume_fraction"], "-") for phase in summary["phases"][1:]}
    for name, value in summary["engineering_constants"].items():
        if name[:2] in ("E_", "G_"):
            found[name] = (value, "Pa")
    for name, value in zip(("xx", "yy", "zz"), summary.get("expansion", {}).get("effective", [])[:3 if summary["dim"] == 3 else 2]):
        found[f"expansion_{name}"] = (value, "1/K")
    return found


def statistics(values):
    """Mean, standard deviation of a volume, and of the mean."""
    n = len(values)
    mean = sum(values) / n
    deviation = math.sqrt(sum((v - mean)**2 for v in values) / (n - 1)) if n > 1 else math.nan
    if deviation <= 1e-12 * abs(mean):
        deviation = 0.0  # round-off
    return mean, deviation, deviation / math.sqrt(n)


def slope(rows):
    """Exponent of the variance over the volume, by least squares on logarithms with the weights of the members; NaN with fewer than two sizes
    that have a deviation."""
    points = [(math.log(r["volume"]), math.log(r["deviation"]**2), r["members"] - 1) for r in rows if r["deviation"] > 0]
    weight = sum(w for _, _, w in points)
    if len(points) < 2:
        return math.nan
    x, y = (sum(w * p[k] for p, w in ((q, q[2]) for q in points)) / weight for k in range(2))
    square = sum(w * (a - x)**2 for a, _, w in points)
    return sum(w * (a - x) * (b - y) for a, b, w in points) / square if square > 0 else math.nan


def evaluate(volume, runs, error):
    """Rows of the table: one a property and size."""
    rows = []
    for factor, summaries in runs.items():
        cells = volume.in_cells(factor)
        for name, (_, unit) in properties(summaries[0]).items():
            values = [properties(summary)[name][0] for summary in summaries]
            mean, deviation, of_mean = statistics(values)
            measure = volume.measure(cells)
            row = {"property": name, "unit": unit, "size": factor, "volume": measure, "members": len(values), "mean": mean,
                   "deviation": deviation, "relative_error": 2 * of_mean / abs(mean) if mean else math.nan,
                   "needed": max(1, math.ceil((2 * deviation / (error * mean))**2)) if mean and deviation == deviation else None}
            if volume.type == "voxels" and name.startswith("fraction") and 0 < mean < 1:  # random placements meet their fraction
                row["integral_range"] = deviation**2 * measure / (mean * (1 - mean))
            rows.append(row)
    return rows


def say(rows, error, dim):
    unit = "m3" if dim == 3 else "m2"
    names = list(dict.fromkeys(row["property"] for row in rows))
    for name in names:
        own = [row for row in rows if row["property"] == name]
        power = slope(own)
        tail = f": variance falls with the volume to the power {power:.2f} (-1 for sizes beyond the range of correlations)" if power == power else ""
        print(f"{name} ({own[0]['unit']}){tail}")
        for row in own:
            needed = f"{row['needed']} volume{'s' * (row['needed'] > 1)} for {100 * error:g} %" if row["needed"] is not None else "one morphology says nothing of deviations"
            extra = f", integral range {row['integral_range']:.3g} {unit}" if "integral_range" in row else ""
            if row["deviation"] != row["deviation"]:
                print(f"  size {row['size']:<6g} {row['volume']:.3g} {unit}, one member: {row['mean']:.5g}, which says nothing of deviations")
                continue
            relative = f" ({100 * row['deviation'] / abs(row['mean']):.2g} %)" if row["mean"] else ""
            print(f"  size {row['size']:<6g} {row['volume']:.3g} {unit}, {row['members']} members: mean {row['mean']:.5g}, deviation "
                  f"{row['deviation']:.2g}{relative}, {needed}{extra}")
        drift = [abs(a["mean"] - b["mean"]) > 3 * math.hypot(a["deviation"] / math.sqrt(a["members"]), b["deviation"] / math.sqrt(b["members"]))
                 for a, b in zip(own, own[1:])]
        if drift and drift[-1]:
            print("  the means of the two largest sizes differ by more than three standard errors: the conditions at the sides still matter; take larger volumes, or PBC")


def draw(rows, error, path, dim):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import matplotlib.ticker

    figure, (left, right) = plt.subplots(1, 2, figsize=(11.5, 4.4), layout="constrained")
    names = [name for name in dict.fromkeys(row["property"] for row in rows) if name.startswith("fraction") or name in SHOWN]
    rows, scale = [row for row in rows if row["property"] in names], 1e3**dim
    for k, name in enumerate(names):
        own = [row for row in rows if row["property"] == name and row["mean"] and row["deviation"] > 0]
        if not own:
            continue
        x, last = [scale * row["volume"] for row in own], own[-1]["mean"]
        shift = 1 + 0.02 * (k - len(names) / 2)  # so that bars do not hide each other
        left.errorbar([v * shift for v in x], [row["mean"] / last for row in own], [abs(2 * row["deviation"] / math.sqrt(row["members"]) / last) for row in own],
                      marker="o", ms=4, capsize=3, lw=1, color=f"C{k % 10}", label=name)
        right.loglog(x, [abs(row["deviation"] / row["mean"]) for row in own], "o-", ms=4, lw=1, color=f"C{k % 10}", label=name)
    volumes = sorted({scale * row["volume"] for row in rows})
    top = max((abs(row["deviation"] / row["mean"]) for row in rows if row["mean"] and row["deviation"] == row["deviation"]), default=1)
    if len(volumes) > 1:
        right.loglog(volumes, [top * math.sqrt(volumes[0] / v) for v in volumes], "k--", lw=1, label="slope $-1/2$")
    right.axhline(error / 2, color="0.6", lw=1, ls=":", label=f"one volume has {100 * error:g} %")
    of = f"{'volume' if dim == 3 else 'area'} (mm$^{dim}$)"
    left.set(xlabel=of, ylabel="mean over that of the largest size", xscale="log", title="Means, with twice their standard error")
    right.set(xlabel=of, ylabel="standard deviation over mean", title="Deviation of one volume")
    for axes in (left, right):
        axes.grid(alpha=0.3)
    right.xaxis.set_minor_formatter(matplotlib.ticker.NullFormatter())
    right.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), fontsize="small", frameon=False)
    figure.savefig(path, dpi=130)
    plt.close(figure)


def write(rows, runs, error, folder):
    columns = ["property", "unit", "size", "volume", "members", "mean", "deviation", "relative_error", "needed", "integral_range"]
    with open(os.path.join(folder, "volume_size.csv"), "w", newline="", encoding="utf-8") as file:
        table = csv.DictWriter(file, columns, restval="")
        table.writeheader()
        table.writerows(rows)
    slopes = {name: slope([row for row in rows if row["property"] == name]) for name in dict.fromkeys(row["property"] for row in rows)}
    with open(os.path.join(folder, "volume_size.json"), "w", encoding="utf-8") as file:
        finite = [{key: None if isinstance(value, float) and not math.isfinite(value) else value for key, value in row.items()} for row in rows]
        json.dump({"error": error, "sizes": list(runs), "rows": finite, "exponent_of_variance": {k: v if v == v else None for k, v in slopes.items()}}, file,
                  indent=1)


def study_in(arguments, programs):
    """The runs, which the program repeats where an input has changed."""
    if arguments.jobs < 1:
        raise SizeError("--jobs has to be at least 1")
    if os.path.exists(arguments.output) and not os.path.isdir(arguments.output):
        raise SizeError(f"--output: {arguments.output} is a file")
    return Study(arguments.output, programs, arguments.jobs, always=True)


def results_of(study):
    """{name: Result} of all runs, none of which failed."""
    results = study.run()
    failed = [f"{name}: {result.message}" for name, result in results.items() if result.status]
    if failed:
        raise SizeError(f"{len(failed)} of {len(results)} runs failed; {failed[0]}")
    return results


def list_of(text, kind, what):
    try:
        found = [kind(part) for part in text.split(",")]
    except ValueError:
        raise SizeError(f"{what}: '{text}' is no list of numbers such as 0.25,0.5,1") from None
    if not found or any(not 0 < value < math.inf for value in found):
        raise SizeError(f"{what}: all numbers have to be above 0")
    return found


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("prm", help="parameters of rve_homogenization")
    parser.add_argument("--sizes", default="0.25,0.5,1", help="factors of all edges of the volume in the file (default: 0.25,0.5,1)")
    parser.add_argument("--members", default="16", help="morphologies of each size, one number for all or one each (default: 16)")
    parser.add_argument("--error", type=float, default=0.02, help="relative error that is wanted of the mean, two standard deviations (default: 0.02)")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="another value of a key, as of the programs")
    parser.add_argument("--output", metavar="DIR", default="output/volume_size", help="folder of the runs (default: output/volume_size)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="runs side by side (default: all cores)")
    parser.add_argument("--programs", metavar="DIR", default=None, help="folder of the programs (default: where they are built or installed)")
    return parser.parse_args()


def find_programs(given):
    """As run_chain.py does: beside an installed script, or where they are built."""
    for folder in [given] if given else [os.path.join(HERE, "..", "..", "build", "applications"), os.path.join(HERE, "..", "..", "..", "..", "bin")]:
        if os.path.exists(os.path.join(folder, PROGRAM)):
            return os.path.normpath(folder)
    raise SizeError(f"there is no {PROGRAM}; build it, or name its folder with --programs")


def main():
    arguments = parse_arguments()
    try:
        if not 0 < arguments.error < 1:
            raise SizeError("--error has to be a number between 0 and 1, such as 0.02")
        if not os.path.isfile(arguments.prm):
            raise SizeError(f"there is no file {arguments.prm}")
        programs = find_programs(arguments.programs)
        sizes = list_of(arguments.sizes, float, "--sizes")
        members = list_of(arguments.members, int, "--members")
        if len(members) not in (1, len(sizes)):
            raise SizeError(f"--members: {len(members)} numbers for {len(sizes)} sizes; give one, or one each")
        if len({f"{size:g}" for size in sizes}) < len(sizes):
            raise SizeError("--sizes: two of them are equal")
        sizes, members = zip(*sorted(zip(sizes, members * len(sizes) if len(members) == 1 else members)))
        fixed = {}
        for setting in arguments.set:
            key, sign, value = setting.partition("=")
            if not sign:
                raise SizeError(f"--set {setting}: give KEY=VALUE")
            fixed[key.strip()] = value.strip()
        volume = Volume(read_keys(programs, arguments.prm, fixed))
        for key in ("Ensemble/Members", "Homogenization/Write concentration"):
            if key in fixed:
                raise SizeError(f"--set {key}: volume_size.py sets it itself")
        study = study_in(arguments, programs)
        names = {}
        for k, size in enumerate(sizes):
            names[size] = []
            for m, settings in enumerate(volume.members(size, members[k])):
                names[size].append(f"size{size:g}-{m + 1}")
                study.add(names[size][-1], PROGRAM, arguments.prm,
                          {**fixed, "Homogenization/Write concentration": False, "Ensemble/Members": 1, **settings})
        results = results_of(study)
    except SizeError as error:
        sys.exit(f"volume_size.py: {error}")
    runs = {size: [results[name].summary for name in own] for size, own in names.items()}
    rows = evaluate(volume, runs, arguments.error)
    write(rows, runs, arguments.error, arguments.output)
    draw(rows, arguments.error, os.path.join(arguments.output, "volume_size.png"), volume.dim)
    say(rows, arguments.error, volume.dim)
    print(f"table and picture: {os.path.join(arguments.output, 'volume_size.csv')}, volume_size.png")


if __name__ == "__main__":
    main()
