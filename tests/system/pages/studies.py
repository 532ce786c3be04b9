#!/usr/bin/env python3
"""Studies repeat what changed, and with `keep` not what only other programs would change."""

import os
import tempfile

from scenes import Folder

from study import Study

# A stand-in for the three programs: counts its runs in the output folder, `--output DIR` being its second and third words.
PROGRAM = """#!/bin/sh
# build {build}
echo run >> "$3/runs"; echo '{{"build": {build}}}' > "$3/summary.json"
"""


def build(programs, number):
    Folder(programs).write("contact_dynamics", PROGRAM.format(build=number))
    os.chmod(os.path.join(programs, "contact_dynamics"), 0o755)


def runs(folder, programs, settings=None, keep=False):
    """How often the runs `first` and `second`, which needs it, have been made, after this call of the study."""
    study = Study(os.path.join(folder, "study"), programs, jobs=1, keep=keep)
    prm = os.path.join(folder, "file.prm")
    study.add("first", "contact_dynamics", prm, settings)
    study.add("second", "contact_dynamics", prm, {"Body/RVE file": "{first}/rve.h5"})
    results = study.run()
    assert [result.status for result in results.values()] == [0, 0]
    return [Folder(result.folder).read("runs").count(b"\n") for result in results.values()]


def main():
    with tempfile.TemporaryDirectory() as folder:
        Folder(folder, {"file": ""})
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
