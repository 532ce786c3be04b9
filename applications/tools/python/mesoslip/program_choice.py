"""Which program a .prm file is for, and what that program says when it checks the file."""

import os
import re
import subprocess

PROGRAMS = ("rve_homogenization", "contact_dynamics", "stress_localization")


class Refused(Exception):
    """No program accepts the file. Its text is the sentence of the program, or of all of them; `status` the exit status."""

    def __init__(self, sentence, status):
        super().__init__(sentence)
        self.status = status


def sentence_of(errors):
    """The last line that is no warning, without the program's name."""
    lines = [line for line in errors.strip().splitlines() if ": warning: " not in line and not line.startswith("---")]
    said = [line for line in lines if re.match(r"[\w.]+( \(process \d+\))?: ", line)]
    return said[-1].partition(": ")[2] if said else " ".join(" ".join(lines).split()) or "it said nothing"


def program_for(prm, words, find, program=None, folder=None):
    """(path, text): the program, and what it says when it checks the file with the options `words` in the working directory `folder`.

    The program is `program`, or the one in the name of the file, or the one that accepts the file. `find` gives the path of a program by
    its name. Raises Refused."""
    named = [name for name in PROGRAMS if name in os.path.basename(prm)]
    candidates = [program] if program else named[:1] or PROGRAMS
    refusals = []
    for name in candidates:
        path = find(name)
        done = subprocess.run([path, "--validate", prm, *words], capture_output=True, text=True, check=False, cwd=folder)
        if done.returncode == 0:
            return path, done.stdout
        refusals.append(Refused(sentence_of(done.stderr), done.returncode))
    if len(refusals) > 1 and os.path.isfile(os.path.join(folder or "", prm)):
        raise Refused(f"none of the programs accepts {prm}: " + "; ".join(f"{name}: {error}" for name, error in zip(candidates, refusals)), 2)
    raise refusals[0]


def results_folder(said):
    """The folder of the results, from what a program says when it checks a file."""
    return re.search(r"; the results would go to (.*)$", said, re.MULTILINE)[1]
