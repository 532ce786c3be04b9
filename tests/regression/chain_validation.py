"""A chain is checked before it runs, by the programs themselves: what only the last file has wrong, what an earlier one decides, and
what it says of time, memory and disk."""

import os
import re
import shutil
import subprocess
import sys
import tempfile

import h5py
import numpy as np

from scenes import ENVIRONMENT, PROGRAMS, TOOLS, TOP, Folder

IMAGE = os.path.join(TOP, "prm", "examples", "image")
WRONG = [  # file, text in it, what it is replaced by, words of the only sentence
    ("40-stress_localization.prm", "Edge distance", "Edge distanc", "run.sh: 40-stress_localization.prm:11: there is no key"),
    ("40-stress_localization.prm", "homogeneous/dynamics.h5", "homogeneous/rve.h5", "but 20-contact_dynamics-homogeneous makes dynamics.h5"),
    # The volume is 8 x 4 mm: that is in file 10 alone.
    ("30-contact_dynamics-heterogeneous.prm", "0.00405, 0.00205", "0.00405, 0.02", "Observation/bulk"),
    ("20-contact_dynamics-homogeneous.prm", "10-rve_homogenization/", "11-rve_homogenization/", "there is no file 11-rve_homogenization/rve.h5"),
]


def run_chain(source, target, *options):
    return subprocess.run([sys.executable, "-B", os.path.join(TOOLS, "run_chain.py"), source, "--programs", PROGRAMS, "--output", target,
                           "--no-report", *options], text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env=ENVIRONMENT)


def check_wrong(folder):
    """One sentence, and nothing has run."""
    for name, old, new, words in WRONG:
        source = shutil.copytree(IMAGE, folder("wrong"), dirs_exist_ok=True)
        text = folder.read("wrong", name).decode()
        assert old in text, (name, old)
        folder.write("wrong/" + name, text.replace(old, new))
        done = run_chain(source, folder("out"))
        assert done.returncode == 2 and done.stdout.count("\n") == 1 and words in done.stdout, (words, done.returncode, done.stdout)
        assert "mesoslip-" not in done.stdout, f"the folder of the check is named: {done.stdout}"
        assert not os.path.exists(folder("out")), "something was written"


def check_draft(folder):
    """The draft has the grid and phases of the result, a stiffness between the bounds of Voigt and Reuss, and says what it is."""
    prm = os.path.join(IMAGE, "10-rve_homogenization.prm")
    folder.run(0, "rve_homogenization", prm, "--validate", "--draft", "draft")
    folder.run(0, "rve_homogenization", prm, "--quiet", "--output", "rve")
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
    assert "there is a file rve/rve.h5 already" in folder.run(2, "rve_homogenization", prm, "--validate", "--draft", "rve")
    assert folder.read("rve", "rve.h5") == kept
    folder.run(2, "rve_homogenization", prm, "--draft", "elsewhere")
    body = os.path.join(IMAGE, "20-contact_dynamics-homogeneous.prm")
    said = folder.run(0, "contact_dynamics", body, "--set=Body/RVE file=draft/rve.h5", "--set=Time/End time=1e-6", "--set=Snapshots/From=0",
                      "--output", "con")
    assert "is a draft for --validate" in said, said
    folder.run(0, "rve_homogenization", prm, "--quiet", "--output", "draft")
    with h5py.File(folder("draft", "rve.h5")) as made:
        assert "concentration/KUBC" in made, "the draft was taken for the result"


def check_told(folder):
    """--validate leaves nothing; disk and steps are those of the runs, up to the guess of the stiffness."""
    done = run_chain(IMAGE, folder("out"), "--validate")
    assert done.returncode == 0 and not os.path.exists(folder("out")), done.stdout
    lines = done.stdout.splitlines()
    for name in ("10-rve_homogenization", "20-contact_dynamics-homogeneous", "30-contact_dynamics-heterogeneous"):
        assert any(re.match(rf"{name}: valid; \d+ MB of memory, [\d.]+ [kM]B on the disk, about \d+ s on one core$", line) for line in lines), lines
    assert "40-stress_localization: keys and values are valid" in lines, lines
    assert re.match(r"In sum: about \d+ s on one core \(1 of 4 not known\)", lines[-1]), lines
    assert run_chain(IMAGE, folder("out")).returncode == 0
    told = {line.split(":")[0]: line for line in lines}
    for name, factor in (("10-rve_homogenization", 1e3), ("20-contact_dynamics-homogeneous", 1e6), ("30-contact_dynamics-heterogeneous", 1e6)):
        said = factor * float(re.search(r"([\d.]+) .B on the disk", told[name])[1])
        found = sum(os.path.getsize(folder("out", name, file)) for file in os.listdir(folder("out", name)))
        assert 0.5 * found < said < 2 * found, (name, said, found)
    again = run_chain(IMAGE, folder("out"), "--validate").stdout
    assert again.count("up to date") == 4, again
    # With the results there the last file is checked as a whole.
    source = shutil.copytree(IMAGE, folder("changed"))
    text = folder.read("changed", "40-stress_localization.prm").decode()
    folder.write("changed/40-stress_localization.prm", text.replace("4e-4", "3e-4"))
    os.remove(folder("out", ".chain"))
    os.remove(folder("out", "40-stress_localization.prm"))
    again = run_chain(source, folder("out"), "--validate").stdout
    assert again.count("up to date") == 3 and re.search(r"40-stress_localization: valid; \d+ MB of memory, about \d+ s", again), again


def main():
    with tempfile.TemporaryDirectory() as path:
        for check in (check_wrong, check_draft, check_told):
            folder = Folder(os.path.join(path, check.__name__))
            os.makedirs(folder.path)
            check(folder)
            print(f"{check.__name__}: ok")


if __name__ == "__main__":
    main()
