"""Runs that fail in a folder with results of an earlier one: those stay, and are told apart; nothing computed is lost.

    earlier_results.py <folder with the programs>
"""

import os
import shutil
import struct
import subprocess
import sys
import tempfile
import warnings

import h5py
import numpy as np

from scenes import SMALL_RVE as RVE

TOP = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
sys.path.insert(0, os.path.join(TOP, "applications", "python"))
sys.path.insert(1, os.path.join(TOP, "applications", "report"))
import mesoslip
from data import Chain

PROGRAMS = os.path.abspath(sys.argv[1])
CONTACT = """
subsection Body
  set RVE file = rve/rve.h5
end
subsection Time
  set End time = 1e-5
end
subsection Snapshots
  set Interval = 1e-6
end
"""
LOCALIZATION = """
subsection Input
  set RVE file = rve/rve.h5
  set Homogeneous run = run/dynamics.h5
end
"""
LIST = "earlier_results.txt"
FAILS = ["--set", "Flat/Expression=sqrt(5e-6 - t)"]


class Folder:
    def __init__(self, path):
        self.path = path
        for name, text in (("rve_homogenization", RVE), ("contact_dynamics", CONTACT), ("stress_localization", LOCALIZATION)):
            with open(self(name + ".prm"), "w", encoding="utf-8") as file:
                file.write(text)

    def __call__(self, *names):
        return os.path.join(self.path, *names)

    def run(self, status, program, output, *options):
        done = subprocess.run([os.path.join(PROGRAMS, program), program + ".prm", "--output", output, *options], cwd=self.path,
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        assert done.returncode == status, f"{program} {options}: exit status {done.returncode}: {done.stdout}{done.stderr}"
        return done.stdout + done.stderr

    def read(self, *names):
        with open(self(*names), "rb") as file:
            return file.read()


def check_failed_run(folder):
    """The old results stay, are listed, and are not read unawares; the next good run clears up."""
    folder.run(0, "rve_homogenization", "rve")
    folder.run(0, "contact_dynamics", "run")
    assert not os.path.exists(folder("run", LIST))
    folder.run(0, "stress_localization", "local")
    results = ["dynamics.h5", "dynamics.xdmf", "energy.csv", "history.csv"]
    before = {name: folder.read("run", name) for name in results}

    folder.run(3, "contact_dynamics", "run", *FAILS)
    assert before == {name: folder.read("run", name) for name in results}, "an old result was touched"
    assert folder.read("run", LIST).decode().splitlines()[1:] == results
    for options in ([], ["--validate"]):
        said = folder.run(2, "stress_localization", "local", *options)
        assert "Input/Homogeneous run" in said and "run/dynamics.h5 is older than the run" in said, said
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        mesoslip.open(folder("run")).close()
    assert len(caught) == 1 and "older than the run" in str(caught[0].message), caught
    assert any(folder("run") in note and "has failed" in note for note in Chain([folder.path]).notes), "the report is silent"

    folder.run(0, "contact_dynamics", "run", "--set", "Observation/Energy interval=0")
    assert folder.read("run", LIST).decode().splitlines()[1:] == ["energy.csv"], "an old result is not told apart"
    assert folder.read("run", "energy.csv") == before["energy.csv"], "a file was lost"
    folder.run(0, "contact_dynamics", "run")
    assert not os.path.exists(folder("run", LIST))
    folder.run(0, "stress_localization", "local")


def check_reuse(folder):
    """An rve.h5 that is up to date is its run's result, though it was there before."""
    folder.run(2, "rve_homogenization", "rve", "--set", "Homogenization/Boundary conditions=")
    assert not os.path.exists(folder("rve", LIST)), "a run that did not begin left a trace"
    assert "rve.h5 is up to date" in folder.run(0, "rve_homogenization", "rve")
    assert not os.path.exists(folder("rve", LIST))


def fnv(state, data):
    """64-bit FNV-1a of bytes, going on from `state`."""
    for byte in data:
        state = ((state ^ byte) * 0x100000001b3) % 2**64
    return state


def digested_parameters(path):
    """What alone identified an rve.h5 before the computation had a revision: the keys with their values, in their order."""
    sections, text = [], ""
    with open(path, encoding="utf-8") as file:
        for line in (line.strip() for line in file):
            if line.startswith("subsection "):
                sections.append(line[len("subsection "):].strip())
            elif line == "end":
                sections.pop()
            elif line.startswith("set "):
                key, value = (part.strip() for part in line[len("set "):].split("=", 1))
                key = "/".join([*sections, key])
                if key not in ("Output folder", "Homogenization/Reuse"):
                    text += f"{key} = {value}\n"
    data = text.encode()
    return data + struct.pack("<Q", len(data))


def check_revision(folder):
    """An rve.h5 is made again when its program or the revision of the computation is another, with the same parameters."""
    start, parameters = 0xcbf29ce484222325, digested_parameters(folder("rve", "parameters.prm"))
    with h5py.File(folder("rve", "rve.h5"), "r+") as file:
        version = file.attrs["program_version"]
        program = fnv(start, version + struct.pack("<Q", len(version)))
        assert file.attrs["digest"].decode() in {f"{fnv(fnv(program, struct.pack('<d', k)), parameters):016x}" for k in range(2, 100)}
        file.attrs.modify("digest", np.bytes_(f"{fnv(start, parameters):016x}"))
    assert "up to date" not in folder.run(0, "rve_homogenization", "rve")
    assert "rve.h5 is up to date" in folder.run(0, "rve_homogenization", "rve")


def check_output_that_fails(folder):
    """What was computed is in the checkpoint: --resume writes it, the same as without the failure."""
    os.mkdir(folder("late"))
    os.mkdir(folder("late", "history.csv"))
    said = folder.run(2, "contact_dynamics", "late")
    assert "history.csv" in said and "--resume" in said, said
    os.rmdir(folder("late", "history.csv"))
    said = folder.run(0, "contact_dynamics", "late", "--resume")
    assert "Resumed at step" in said, said
    for name in ("history.csv", "energy.csv"):
        assert folder.read("late", name) == folder.read("run", name), name
    with mesoslip.open(folder("late")) as late, mesoslip.open(folder("run")) as run:
        assert sorted(late) == sorted(run)
        assert all((late[name] == run[name]).all() for name in run if not name.startswith("material/name"))
    shutil.rmtree(folder("late"))


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path)
        check_failed_run(folder)
        check_reuse(folder)
        check_revision(folder)
        check_output_that_fails(folder)


if __name__ == "__main__":
    main()
