#!/usr/bin/env python3
"""Studies repeat what changed, and with `keep` not what only other programs would change.

    studies.py <folder with the programs, not used>
"""

import os
import sys
import tempfile

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
sys.path.insert(0, os.path.join(TOP, "applications", "tools", "studies"))

from study import Study  # noqa: E402

# A stand-in for the three programs: counts its runs in the output folder, `--output DIR` being its second and third words.
PROGRAM = """#!/bin/sh
# build {build}
echo run >> "$3/runs"; echo '{{"build": {build}}}' > "$3/summary.json"
"""


def build(programs, number):
    path = os.path.join(programs, "contact_dynamics")
    with open(path, "w", encoding="utf-8") as file:
        file.write(PROGRAM.format(build=number))
    os.chmod(path, 0o755)


def runs(folder, programs, settings=None, keep=False):
    """How often the runs `first` and `second`, which needs it, have been made, after this call of the study."""
    study = Study(os.path.join(folder, "study"), programs, jobs=1, keep=keep)
    prm = os.path.join(folder, "file.prm")
    study.add("first", "contact_dynamics", prm, settings)
    study.add("second", "contact_dynamics", prm, {"Body/RVE file": "{first}/rve.h5"})
    results = study.run()
    assert [result.status for result in results.values()] == [0, 0]
    counts = []
    for name in results:
        with open(os.path.join(results[name].folder, "runs"), encoding="utf-8") as file:
            counts.append(len(file.readlines()))
    return counts


def main():
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "file.prm"), "w", encoding="utf-8"):
            pass
        build(folder, 1)
        assert runs(folder, folder) == [1, 1]
        assert runs(folder, folder) == [1, 1], "nothing changed"
        build(folder, 2)
        assert runs(folder, folder, keep=True) == [1, 1], "kept over another program"
        assert runs(folder, folder) == [2, 2], "another program"
        assert runs(folder, folder, {"Flat/Velocity": 3}, keep=True) == [3, 3], "other settings count with keep as well"
        build(folder, 3)
        assert runs(folder, folder, {"Flat/Velocity": 3}, keep=True) == [3, 3]
        assert runs(folder, folder, {"Flat/Velocity": 3}) == [4, 4], "what was kept is not taken for a run of these programs"
    print("ok")


if __name__ == "__main__":
    main()
