"""--profile of the three programs: what there is to be told apart, and rows that sum to the row that they are in.

    profile_rows.py <folder with the programs>
"""

import os
import re
import subprocess
import sys
import tempfile

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
RVE, RUN = "10-rve_homogenization", "20-contact_dynamics-homogeneous"
ROUNDING = 0.5e-3  # s, of each row
ROW = re.compile(r"^( *)(\S.*?)\s{2,}(?:(\d+)\s+)?([\d.]+)\s+([\d.]+) %$", re.M)


def profile(programs, folder, name, settings, ranks=1):
    """[(depth, name, seconds)] that a run of prm/pin/NAME.prm prints; it ends in `folder`/NAME."""
    program = name.split("-")[1]
    command = [os.path.join(programs, program), os.path.join(TOP, "prm", "pin", name + ".prm"), "--quiet", "--profile",
               "--output", os.path.join(folder, name)]
    for key, value in settings.items():
        command += ["--set", f"{key}={value}"]
    if ranks > 1:
        command = ["mpirun", "--oversubscribe", "-np", str(ranks)] + command
    environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    printed = subprocess.run(command, cwd=folder, env=environment, text=True, stdout=subprocess.PIPE, check=True).stdout
    rows = [(len(indent) // 2, row, float(seconds)) for indent, row, _, seconds, _ in ROW.findall(printed)]
    assert rows and rows[0][:2] == (0, "total"), f"{name} printed no profile:\n{printed}"
    return rows


def children(rows, index):
    depth = rows[index][0]
    for row in rows[index + 1:]:
        if row[0] <= depth:
            return
        if row[0] == depth + 1:
            yield row


def check_sums(rows):
    for index, (_, name, seconds) in enumerate(rows):
        inside = list(children(rows, index))
        if inside:
            total = sum(row[2] for row in inside)
            assert abs(total - seconds) <= ROUNDING * (len(inside) + 1), f"what is inside of {name} takes {total} of its {seconds} s"


def check_rows(rows, path, expected):
    """The names directly inside of `path`; the last one is what remains."""
    index = 0
    for name in path.split("/"):
        index = next(k for k in range(index, len(rows)) if rows[k][1] == name)
    found = [row[1] for row in children(rows, index)]
    assert sorted(found[:-1]) == sorted(expected[:-1]) and found[-1] == expected[-1], f"{path} has {found} instead of {expected}"


def check_homogenization(programs, folder):
    rows = profile(programs, folder, RVE, {
        "Grid/Cells": "70, 20", "Microstructure/Random fibres/Fibre width": 8e-4})
    check_sums(rows)
    check_rows(rows, "total", ["Microstructure", "Load cases", "Output", "other"])
    check_rows(rows, "Load cases", ["KUBC", "SUBC", "Responses", "other"])


def check_dynamics(programs, folder, ranks):
    """Rank 0 has the contact; the top is its own only if it is alone."""
    rows = profile(programs, folder, RUN, {
        "Body/RVE file": os.path.join(folder, RVE, "rve.h5"), "Body/Cells": "140, 40", "Time/End time": 1e-3, "Checkpoints/Interval": 1e-5, "Checkpoints/Keep": "true"}, ranks)
    check_sums(rows)
    check_rows(rows, "total", ["Critical time step", "Time loop", "Checkpoints", "Evaluation and output", "other"])
    check_rows(rows, "Time loop", ["Stability monitor", "Strains", "Energies", "Probes", "Snapshots", "Steps", "Limit cycle, requests",
                                   "Checkpoints", "other"])
    check_rows(rows, "Snapshots", ["Writing snapshots", "other"])
    check_rows(rows, "Steps", ["Contact and its histories", "Top and its histories" if ranks == 1 else "Exchange between ranks",
                               "Elastic body"])


def check_localization(programs, folder):
    rows = profile(programs, folder, "40-stress_localization", {
        "Input/RVE file": os.path.join(folder, RVE, "rve.h5"), "Input/Homogeneous run": os.path.join(folder, RUN, "dynamics.h5"),
        "Input/Direct run": "", "Probes/Of the run": ""})
    check_sums(rows)
    check_rows(rows, "total", ["Localization", "Output", "other"])
    check_rows(rows, "Localization", ["Stress map", "Waiting for snapshots", "Averaging", "Probes and errors", "other"])


def main():
    with tempfile.TemporaryDirectory() as folder:
        check_homogenization(sys.argv[1], folder)
        for ranks in (2, 1):
            check_dynamics(sys.argv[1], folder, ranks)
        check_localization(sys.argv[1], folder)


if __name__ == "__main__":
    main()
