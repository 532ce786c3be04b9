"""--profile of the three programs: what there is to be told apart, and rows that sum to the row that they are in."""

import os
import re
import tempfile

from scenes import TOP, Folder, prm, sets

RVE, RUN = "10-rve_homogenization", "20-contact_dynamics-homogeneous"
ROUNDING = 0.5e-3  # s, of each row
START = ["Start of MPI", "Reading and checking"]  # of each program
ROW = re.compile(r"^( *)(\S.*?)\s{2,}(?:(\d+)\s+)?([\d.]+)\s+([\d.]+) %$", re.M)


def profile(folder, name, settings, ranks=1, path=None, program=None):
    """[(depth, name, seconds)] that a run of prm/pin/NAME.prm, or of the file `path`, prints; it ends in `folder`/NAME."""
    path = path or os.path.join(TOP, "prm", "pin", name + ".prm")
    printed = folder.run(0, program or name.split("-")[1], path, "--quiet", "--profile", "--output", name, *sets(settings), ranks=ranks)
    rows = [(len(indent) // 2, row, float(seconds)) for indent, row, _, seconds, _ in ROW.findall(printed)]
    assert rows and rows[0][:2] == (0, "total"), f"{name} printed no profile:\n{printed}"
    for index, (_, row, seconds) in enumerate(rows):
        inside = [part[2] for part in children(rows, index)]
        assert not inside or abs(sum(inside) - seconds) <= ROUNDING * (len(inside) + 1), \
            f"what is inside of {row} takes {sum(inside)} of its {seconds} s"
    return rows


def children(rows, index):
    depth = rows[index][0]
    for row in rows[index + 1:]:
        if row[0] <= depth:
            return
        if row[0] == depth + 1:
            yield row


def check_rows(rows, path, expected):
    """The names directly inside of `path`; the last one is what remains."""
    index = 0
    for name in path.split("/"):
        index = next(k for k in range(index, len(rows)) if rows[k][1] == name)
    found = [row[1] for row in children(rows, index)]
    assert sorted(found[:-1]) == sorted(expected[:-1]) and found[-1] == expected[-1], f"{path} has {found} instead of {expected}"


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        rows = profile(folder, RVE, {"Grid/Cells": "70, 20", "Microstructure/Random fibres/Fibre width": 8e-4})
        check_rows(rows, "total", [*START, "Microstructure", "Load cases", "Output", "other"])
        check_rows(rows, "Load cases", ["KUBC", "SUBC", "Responses", "other"])
        for ranks in (2, 1):  # rank 0 has the contact; the top is its own only if it is alone
            rows = profile(folder, RUN, {
                "Body/RVE file": folder(RVE, "rve.h5"), "Body/Cells": "140, 40", "Time/End time": 1e-3, "Checkpoints/Interval": 1e-5,
                "Checkpoints/Keep": "true"}, ranks)
            check_rows(rows, "total", [*START, "Start of the run", "Time loop", "Checkpoints", "Evaluation and output", "other"])
            check_rows(rows, "Time loop", ["Stability monitor", "Strains", "Energies", "Probes", "Snapshots", "Steps",
                                           "Limit cycle, requests", "Checkpoints", "other"])
            check_rows(rows, "Snapshots", ["Writing snapshots", "other"])
            check_rows(rows, "Steps", ["Contact and its histories", "Top and its histories" if ranks == 1 else "Exchange between ranks",
                                       "Elastic body"])
        folder.write("box.prm", "set Dimension = 3\n" + prm({
            "Body/Stiffness": "283e9, 121e9, 121e9, 283e9, 121e9, 283e9, 81e9, 81e9, 81e9", "Body/Density": 7800, "Time/End time": 4e-5,
            "Body/Size": "0.004, 0.002, 0.004", "Body/Cells": "16, 8, 16", "Snapshots/Interval": 1e-5}))
        rows = profile(folder, "box", {}, path=folder("box.prm"), program="contact_dynamics")
        check_rows(rows, "Time loop", ["Stability monitor", "Strains", "Energies", "Snapshots", "Steps", "Limit cycle, requests", "other"])
        check_rows(rows, "Steps", ["Contact and its histories", "Top and its histories", "Elastic body"])
        rows = profile(folder, "40-stress_localization", {
            "Input/RVE file": folder(RVE, "rve.h5"), "Input/Homogeneous run": folder(RUN, "dynamics.h5"), "Input/Direct run": "",
            "Probes/Of the run": ""})
        check_rows(rows, "total", [*START, "Localization", "Output", "other"])
        check_rows(rows, "Localization", ["Stress map", "Waiting for snapshots", "Averaging", "Probes and errors", "other"])


if __name__ == "__main__":
    main()
