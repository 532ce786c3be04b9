"""A chain is checked before it runs, by the programs themselves: what only the last file has wrong, what an earlier one decides, and
what it says of time, memory and disk."""

import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
import types
from unittest import mock

import h5py
import numpy as np

from scenes import ENVIRONMENT, PROGRAMS, TOOLS, TOP, Folder, prm, served

sys.path.insert(0, TOOLS)

import run_chain as script  # noqa: E402
from chain.plan import Estimate, sum_text  # noqa: E402

IMAGE = os.path.join(TOP, "prm", "examples", "image")
RUNS = ("10-rve_homogenization", "20-contact_dynamics-homogeneous", "30-contact_dynamics-heterogeneous")
LAST = "40-stress_localization"
WRONG = [  # file, text in it, what it is replaced by, words of the only sentence
    ("40-stress_localization.prm", "Edge distance", "Edge distanc", "run.sh: 40-stress_localization.prm:11: there is no key"),
    ("40-stress_localization.prm", "homogeneous/dynamics.h5", "homogeneous/rve.h5", "but 20-contact_dynamics-homogeneous makes dynamics.h5"),
    # What the drafts of the runs before do not have.
    ("40-stress_localization.prm", "subsection Comparison", "subsection Window\n  set From = 6e-4\nend\nsubsection Comparison",
     "20-contact_dynamics-homogeneous/dynamics.h5: the probe bulk has no sample after 6e-04 s"),
    ("40-stress_localization.prm", "subsection Comparison", "subsection Window\n  set From = 1e-4\n  set To = 3e-4\nend\nsubsection Comparison",
     "20-contact_dynamics-homogeneous/dynamics.h5: no snapshot lies between 1e-04 and 3e-04 s"),
    ("40-stress_localization.prm", "subsection Comparison", "subsection Localization\n  set Concentration = PBC\nend\nsubsection Comparison",
     "run rve_homogenization with PBC among its boundary conditions"),
    ("10-rve_homogenization.prm", "set Boundary conditions = KUBC, SUBC", "set Boundary conditions = KUBC, SUBC\n  set Write concentration = false",
     "and its concentration tensors written"),
    ("40-stress_localization.prm", "subsection Comparison", "subsection Probes\n  set Of the run = contakt\nend\nsubsection Comparison",
     "names 'contakt', but the probes of 20-contact_dynamics-homogeneous/dynamics.h5 are: bulk, contact"),
    ("40-stress_localization.prm", "subsection Comparison", "subsection Probes\n  set Further = far\n  subsection far\n    set Position = 1, 1\n  end\n"
     "end\nsubsection Comparison", "Probes/far/Position: (1, 1) m lies outside the body"),
    ("30-contact_dynamics-heterogeneous.prm", "set Pressure = 5e6", "set Pressure = 6e6", "were made under different conditions (pressure is"),
    # The volume is 8 x 4 mm: that is in file 10 alone.
    ("30-contact_dynamics-heterogeneous.prm", "0.00405, 0.00205", "0.00405, 0.02", "Observation/bulk"),
    ("20-contact_dynamics-homogeneous.prm", "10-rve_homogenization/", "11-rve_homogenization/", "no step of this chain is called 11-rve_homogenization; did you mean 10-rve_homogenization/rve.h5?"),
    ("20-contact_dynamics-homogeneous.prm", "10-rve_homogenization/", "10-rve/", "called 10-rve; did you mean 10-rve_homogenization/rve.h5?"),
    ("20-contact_dynamics-homogeneous.prm", "10-rve_homogenization/", "elsewhere/", "there is no file elsewhere/rve.h5"),
]


def run_chain(source, target, *options):
    return subprocess.run([sys.executable, "-B", os.path.join(TOOLS, "run_chain.py"), source, "--programs", PROGRAMS, "--output", target,
                           *options], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=ENVIRONMENT)


def refused_here(source, target):
    """Exit status and what run_chain.py says, in this process, of a chain of which nothing is to run."""
    with mock.patch("chain.plan.subprocess", types.SimpleNamespace(run=served)), \
            mock.patch.object(sys, "argv", ["run_chain.py", source, "--programs", PROGRAMS, "--output", target]), \
            contextlib.redirect_stdout(io.StringIO()) as said, contextlib.redirect_stderr(said):
        try:
            script.main()
        except SystemExit as end:
            return end.code, said.getvalue()


def check_wrong(folder):
    """One sentence, and nothing has run."""
    for name, old, new, words in WRONG:
        source = shutil.copytree(IMAGE, folder("wrong"), dirs_exist_ok=True)
        text = folder.read("wrong", name).decode().replace("include load.inc", folder.read("wrong", "load.inc").decode())
        assert old in text, (name, old)
        folder.write("wrong/" + name, text.replace(old, new))
        status, said = refused_here(source, folder("out"))
        assert status == 2 and said.count("\n") == 1 and words in said, (words, status, said)
        assert "mesoslip-" not in said, f"the folder of the check is named: {said}"
        assert not os.path.exists(folder("out")), "something was written"


def check_draft(folder):
    """The draft has the grid and phases of the result, a stiffness between the bounds of Voigt and Reuss, and says what it is."""
    volume = os.path.join(IMAGE, "10-rve_homogenization.prm")
    folder.run(0, "rve_homogenization", volume, "--validate", "--draft", "draft")
    folder.run(0, "rve_homogenization", volume, "--quiet", "--output", "rve")
    assert not os.path.exists(folder("output")), "--validate has run"
    with h5py.File(folder("draft", "rve.h5")) as draft, h5py.File(folder("rve", "rve.h5")) as made:
        for name in ("phase/id", "phase/stiffness", "phase/density"):
            assert np.array_equal(draft[name], made[name]), name
        fractions = np.bincount(made["phase/id"][...].ravel()) / made["phase/id"].size
        c = made["phase/stiffness"][...]
        voigt = np.einsum("p,pij->ij", fractions, c)
        reuss = np.linalg.inv(np.einsum("p,pij->ij", fractions, np.linalg.inv(c)))
        assert np.allclose(draft["stiffness/effective"], 0.5 * (voigt + reuss), rtol=1e-12)
    kept = folder.read("rve", "rve.h5")
    assert "there is a file rve/rve.h5 already" in folder.run(2, "rve_homogenization", volume, "--validate", "--draft", "rve")
    assert folder.read("rve", "rve.h5") == kept
    folder.run(2, "rve_homogenization", volume, "--draft", "elsewhere")
    body = os.path.join(IMAGE, "20-contact_dynamics-homogeneous.prm")
    said = folder.run(0, "contact_dynamics", body, "--set=Body/RVE file=draft/rve.h5", "--validate", "--output", "con")
    assert "is a draft for --validate" in said, said
    folder.run(0, "rve_homogenization", volume, "--quiet", "--output", "draft")
    with h5py.File(folder("draft", "rve.h5")) as made:
        assert "concentration/KUBC" in made, "the draft was taken for the result"


def disk_told(line):
    """Bytes."""
    number, unit = re.search(r"([\d.]+) ([kM])B on the disk", line).groups()
    return float(number) * {"k": 1e3, "M": 1e6}[unit]


def check_sums():
    """What is not in a sum is named, with the reason."""
    told = [Estimate("rve", "18 load cases, about 160 MB\n34.5 MB on the disk"), Estimate("box", "112 MB on the disk, 973 kB of memory", 1e8),
            Estimate("plane", "40 MB on the disk, 5 MB of memory", 1e8), Estimate("later")]
    for estimate in told[:3]:
        estimate.seconds = 10.0
    assert told[1].text() == "101 MB of memory, 112 MB on the disk, about 10 s on one core", told[1].text()
    first, *others = sum_text(told, 2).splitlines()
    assert first == "In sum: about 30 s on one core, 186 MB on the disk, 265 MB of memory with 2 side by side", first
    assert others == ["  not in the sum, as what it reads has yet to be made: later"], others
    assert sum_text(told[::2], 1).count("\n") == 0, sum_text(told[::2], 1)


def check_told(folder):
    """--validate leaves nothing; disk and steps are those of the runs, up to the guess of the stiffness. A step that fails as it runs
    leaves a report of those before it."""
    source, last, run = shutil.copytree(IMAGE, folder("case")), f"case/{LAST}.prm", f"case/{RUNS[2]}.prm"
    done = run_chain(source, folder("out"), "--validate")
    assert done.returncode == 0 and not os.path.exists(folder("out")), done.stdout
    lines = done.stdout.splitlines()
    for name in (*RUNS, LAST):
        assert any(re.match(rf"{name}: valid; \d+ MB of memory, [\d.]+ [kM]B on the disk, about \d+ s on one core$", line) for line in lines), lines
    assert re.fullmatch(r"In sum: about \d+ s on one core, [\d.]+ MB on the disk, \d+ MB of memory with \d+ side by side", lines[-1]), lines
    text, of_run = folder.read(last).decode(), folder.read(run).decode()
    folder.write(run, of_run + prm({"Time/Time step": 1e-7, "Time/Check time step": "false"}))  # it blows up
    done = run_chain(source, folder("out"), "--jobs", "1")
    assert done.returncode == 3 and "blew up" in done.stdout and "Report so far: " in done.stdout, done.stdout
    assert os.path.getsize(folder("out", "report.html")) > 1e5 and done.stdout.count(": done in") == 2, done.stdout
    folder.write(run, of_run)
    done = run_chain(source, folder("out"), "--no-report")
    assert done.returncode == 0, done.stdout
    told = {line.split(":")[0]: line for line in lines}
    for name in RUNS:
        said = disk_told(told[name])
        found = sum(os.path.getsize(folder("out", name, file)) for file in os.listdir(folder("out", name)))
        assert 0.5 * found < said < 2 * found, (name, said, found)
    found = os.path.getsize(folder("out", LAST, "localization.h5"))
    assert abs(disk_told(told[LAST]) - found) < 0.05 * found, (told[LAST], found)
    # With the results there the last file is checked with them.
    os.remove(folder("out", LAST, "localization.h5"))
    folder.write(last, text + prm({"Probes/Further": "far", "Probes/far/Position": "1, 1"}))
    done = run_chain(source, folder("out"))
    assert done.returncode == 2 and done.stdout.count("\n") == 1 and "Probes/far" in done.stdout, done.stdout
    folder.write(last, text)
    again = run_chain(source, folder("out"), "--validate").stdout
    assert again.count("up to date") == 3 and re.search(rf"{LAST}: valid; \d+ MB of memory, [\d.]+ kB on the disk, about \d+ s", again), again
    assert run_chain(source, folder("out"), "--no-report").returncode == 0
    assert run_chain(source, folder("out"), "--validate").stdout.count("up to date") == 4
    os.remove(folder("out", RUNS[0], "rve.h5"))  # it is made again; those after it are as good as before
    again = run_chain(source, folder("out"), "--validate").stdout
    assert again.count("up to date") == 3 and again.startswith(RUNS[0] + ": valid; "), again
    again = run_chain(source, folder("out"), "--no-report").stdout
    assert again.count("up to date") == 3 and RUNS[0] + ": done" in again, again


def main():
    check_sums()
    with tempfile.TemporaryDirectory() as path:
        for check in (check_wrong, check_draft, check_told):
            folder = Folder(os.path.join(path, check.__name__))
            os.makedirs(folder.path)
            check(folder)
            print(f"{check.__name__}: ok")


if __name__ == "__main__":
    main()
