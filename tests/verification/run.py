#!/usr/bin/env python3
"""The page of the verification problems: runs the tests that hold them, collects what they measured, and writes
doc/verification.md with its tables, a picture of convergence and CSV. A test that fails stops it. The part `pictures` only
redraws the picture from convergence.csv."""

import csv
import json
import os
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
TOP = os.path.dirname(os.path.dirname(HERE))
sys.path[:0] = [HERE, os.path.join(TOP, "tests", "scenes"), os.path.join(TOP, "applications", "tools", "studies"),
                os.path.join(TOP, "applications", "tools")]

import mesh_pin  # noqa: E402
import numpy as np  # noqa: E402
import problems  # noqa: E402
from pages import number, save_picture, table, write_csv, write_page  # noqa: E402
from report.base.figures import RUN_COLOURS, plt  # noqa: E402  (figures chooses the backend)
from study import Study, parse_arguments  # noqa: E402

EXECUTABLES = ("unit_serial", "unit_ranks", "verification_serial", "verification_ranks")

MARKS = (("o", "-"), ("s", "--"), ("^", "-."))  # a round of colours each


class Measured:
    """`tests`: those that passed, as "executable: Suite.Name"; `series` {(test, name): {size: error}};
    `numbers` {(test, name): (expected, found)}."""

    def __init__(self):
        self.tests, self.series, self.numbers = set(), {}, {}

    def add(self, tests):
        for name, test in tests:
            if "failures" in test:
                raise SystemExit(f"verification: {name} fails; no page is written")
            self.tests.add(name)
            for key, value in test.items():
                kind, _, rest = key.partition("|")
                if kind == "error":
                    series, size = rest.split("|")
                    self.series.setdefault((name, series), {})[float(size)] = abs(float(value))
                elif kind == "found":
                    self.numbers[name, rest] = (float(test["expected|" + rest]), float(value))

    def order(self, key):
        """Of the two finest refinements."""
        (coarse, before), (fine, last) = sorted(self.series[key].items())[-2:]
        return float(np.log(before / last) / np.log(fine / coarse))


def tests_of(folder, *options):
    """("executable: Suite.Name", entry of GoogleTest's report) of all tests of the executables in `folder`, started with `options`."""
    with tempfile.TemporaryDirectory() as reports:
        for executable in EXECUTABLES:
            report = os.path.join(reports, executable + ".json")
            subprocess.run([os.path.join(folder, executable), f"--gtest_output=json:{report}", *options], cwd=reports,
                           stdout=subprocess.DEVNULL, check=False)
            if not os.path.exists(report):
                raise SystemExit(f"verification: {executable} in {folder} left no report; build the tests")
            with open(report, encoding="utf-8") as file:
                suites = json.load(file)["testsuites"]
            for suite in suites:
                for test in suite["testsuite"]:
                    yield f"{executable}: {suite['name'].split('/')[-1]}.{test['name'].split('/')[0]}", test


def numbers_of(measured, tests):
    """[(quantity, expected, found)] of the tests of a problem, without the residuals; with six digits, as in numbers.csv."""
    six = lambda value: float(f"{value:.6g}")
    return [(what, six(expected), six(found)) for (test, what), (expected, found) in measured.numbers.items()
            if test in tests and not what.startswith("residual: ")]


def observed(measured, tests):
    """What the tests of a problem measured, as text: orders of convergence without the series of problems.ORDERS, which have their own table; the
    largest deviation from numbers other than 0; what should be 0; the largest of the numbers "residual: ..."."""
    in_table = {series for names in problems.ORDERS.values() for series in names}
    of_problem = [(test, series) for test, series in measured.series if test in tests]
    groups = {}
    for test, series in of_problem:
        if series not in in_table:
            order = measured.order((test, series))
            groups.setdefault(min((2, 1, 0.5), key=lambda predicted: abs(predicted - order)), []).append(f"{order:.2f}")
    said = [f"order {min(found)}" + (f" to {max(found)}" if min(found) != max(found) else "") + (f" ({len(found)} series)" if len(found) > 1 else "")
            for _, found in sorted(groups.items(), reverse=True)]
    residuals = [found for (test, what), (_, found) in measured.numbers.items() if test in tests and what.startswith("residual: ")]
    if residuals:
        said.append(f"largest of {len(residuals)} residuals: {max(residuals):.2g}")
    numbers = numbers_of(measured, tests)
    off = [abs(found / expected - 1) for _, expected, found in numbers if expected]
    if len(off) > 1:
        said.append(f"{len(off)} numbers within {100 * max(off):.1g} %")
    said += [f"{what}: {found:.6g} for {expected:.6g}" for what, expected, found in numbers if expected and len(off) == 1]
    said += [f"{what}: {found:.2g}" for what, expected, found in numbers if not expected]
    return "<br>".join(said) or ("order" if of_problem else "holds")


def names_of(tests):
    """The tests, each executable before its first one."""
    lines, last = [], None
    for executable, name in (test.split(": ") for test in tests):
        lines.append(f"`{name}`" if executable == last else f"`{executable}`: `{name}`")
        last = executable
    return "<br>".join(lines)


def convergence(series, path):
    """Errors over refinement, a panel for each expected order and what it is of; dotted: that order, through the coarsest grid of the series.
    `series` {name: {size: error}}."""
    figure, axes = plt.subplots(2, len(problems.ORDERS), figsize=(11.5, 7.2), width_ratios=(1.2, 1.2, 1.2, 0.8), height_ratios=(2, 0.8),
                                sharey="row")
    for letter, (column, ((order, what), names)) in zip("abcd", enumerate(problems.ORDERS.items())):
        axis, below = axes[:, column]
        shown = [name for name in series if name in names]
        for k, name in enumerate(shown):
            sizes, errors = (np.array(x) for x in zip(*sorted(series[name].items())))
            times = sizes / sizes[0]
            mark, line = MARKS[k // len(RUN_COLOURS) % len(MARKS)]
            axis.loglog(times, errors, marker=mark, ls=line, color=RUN_COLOURS[k % len(RUN_COLOURS)], label=name, markersize=5)
            axis.loglog(times, errors[0] * times**-order, ":", color="black", linewidth=1.0)
        axis.set(xlabel="refinement (times)", xticks=(1, 2, 4, 8), xticklabels=("1", "2", "4", "8"), xlim=(0.9, 9))
        axis.set_title(f"({letter}) order {order:g}{what}", loc="left")
        axis.minorticks_off()
        below.axis("off")
        below.legend(*axis.get_legend_handles_labels(), loc="upper left", bbox_to_anchor=(-0.15, 1.0), fontsize=9.5, borderaxespad=0)
    low, high = axes[0, 0].get_ylim()
    axes[0, 0].set_ylim(10 ** np.floor(np.log10(low)), 10 ** np.ceil(np.log10(high)))
    axes[0, 0].set_ylabel("relative error")
    save_picture(figure, os.path.dirname(path), os.path.basename(path), colours=64, dpi=100)


def kept_series(folder):
    """What write() left in convergence.csv."""
    series = {}
    with open(os.path.join(folder, "convergence.csv"), encoding="utf-8", newline="") as file:
        for row in csv.DictReader(file):
            series.setdefault(row["series"], {})[float(row["size [-]"])] = float(row["error [-]"])
    return series


def check_names(folder):
    """SystemExit unless every test that the page names exists in the executables of `folder`."""
    known = {name for name, _ in tests_of(folder, "--gtest_list_tests")}
    for missing in (test for _, _, tests in problems.PROBLEMS for test in tests if test not in known):
        raise SystemExit(f"verification: there is no test '{missing}'; correct tests/verification/problems.py")


def write(measured, pin):
    doc = os.path.join(TOP, "doc")
    convergence({name: values for (_, name), values in measured.series.items()}, os.path.join(doc, "verification", "convergence.png"))
    write_csv(os.path.join(doc, "verification"), "convergence.csv", ["test", "series", "size [-]", "error [-]"],
              [[test, series, number(size, 6), number(value, 6)] for (test, series), values in measured.series.items()
               for size, value in sorted(values.items())])
    write_csv(os.path.join(doc, "verification"), "numbers.csv", ["problem", "quantity", "expected", "observed"],
              [[problem, what, f"{expected:.6g}", f"{found:.6g}" if expected else f"{found:.2g}"] for problem, _, tests in problems.PROBLEMS
               for what, expected, found in numbers_of(measured, tests)])
    rows = [[problem, claim, names_of(tests), observed(measured, tests)] for problem, claim, tests in problems.PROBLEMS]
    orders = [[series, f"{predicted:g}", f"{measured.order((test, series)):.2f}", f"{min(measured.series[test, series].values()):.1e}"]
              for (predicted, _), names in problems.ORDERS.items() for test, series in measured.series if series in names]
    write_page(doc, "verification.md", problems.PAGE.format(
        problems=table(["problem", "expected result", "test", "observed"], rows),
        orders=table(["series", "predicted order", "observed", "finest error"], list(dict.fromkeys(map(tuple, orders)))),
        pin=table(["", *(f"{n} rank{'s' * (n > 1)}" for n in mesh_pin.RANKS)],
                  [[what, *(f"{value:.0e}" for value in values)] for what, values in pin.items()])))


def main():
    arguments = parse_arguments(__doc__, "verification", ["page"], on_request=("pictures",))
    if arguments.parts == ["pictures"]:
        folder = os.path.join(TOP, "doc", "verification")
        convergence(kept_series(folder), os.path.join(folder, "convergence.png"))
        return
    build = os.path.dirname(os.path.abspath(arguments.programs))
    subprocess.run(["cmake", "--build", build, "--target", *EXECUTABLES], stdout=subprocess.DEVNULL, check=True)
    tests = os.path.join(build, "tests")
    check_names(tests)
    measured = Measured()
    measured.add(tests_of(tests))
    study = Study(arguments.output, arguments.programs, jobs=1, keep=arguments.keep)
    write(measured, mesh_pin.differences(study))
    print("doc/verification.md")


if __name__ == "__main__":
    main()
