"""doc/parameters is what the programs print, and every .prm file under prm/ is accepted.

    parameter_reference.py <folder with the programs> [--update]

--update renews the pages. A .prm file whose input an earlier step leaves may fail, but only on that missing file.
"""

import glob
import os
import re
import sys

from scenes import TOP, Folder

PAGES = os.path.join(TOP, "doc", "parameters")
PROGRAMS = ("rve_homogenization", "contact_dynamics", "stress_localization")
MISSING_INPUT = re.compile(r"there is no (file|folder) (\S+)")


def check_page(name, printed, update):
    """A sentence when the page of a program is stale, else nothing."""
    pages = Folder(PAGES)
    if update:
        pages.write(name + ".prm", printed)
    return [] if pages.read(name + ".prm").decode() == printed else [
        f"doc/parameters/{name}.prm differs from {name} --print-parameters; "
            "parameter_reference.py <programs> --update renews it"]


NUMERIC = re.compile(r"\bnumbers?\b")
UNIT = re.compile(r"\[[^\]]+\](?=;)")


def check_keys(name, printed):
    """A sentence for every key that does not say what it means and what it may be, and for numbers in which unit."""
    wrong, sections, words = [], [], []
    for line in printed.splitlines():
        line = line.strip()
        if line.startswith("#"):
            words.append(line[1:].strip())
            continue
        if line.startswith("set "):
            meaning, _, allowed = " ".join(words).rpartition("; ")
            key = name + ": " + "/".join(sections + [line[4:].split("=")[0].strip()])
            if len(meaning) < 8 or not allowed:
                wrong.append(f"{key} does not state its meaning or its range")
            if NUMERIC.search(allowed) and not UNIT.search(meaning + ";"):
                wrong.append(f"{key} does not state its unit ([-] if it has none)")
        elif line.startswith("subsection "):
            sections.append(line[len("subsection "):])
        elif line == "end":
            sections.pop()
        words = []
    return wrong


def program_of(path):
    """The program in a file's name, or the first that its comments name."""
    text = Folder(TOP).read(path).decode()
    named = [p for p in PROGRAMS if p in os.path.basename(path)]
    named += sorted((p for p in PROGRAMS if p in text), key=text.index)
    return named[0] if named else None


def is_left_by_a_run(path):
    """Whether a missing input is what a run leaves: an HDF5 file or a folder of results, not a file to be shipped."""
    return path.endswith(".h5") or "." not in os.path.basename(path)


def check_file(path):
    shown = os.path.relpath(path, TOP)
    name = program_of(path)
    if name is None:
        return [f"{shown}: names no program, neither in its name nor in its comments"]
    # Names of sections and keys, the form of the values, and what these mean together.
    status, _, said = Folder(TOP).end(name, "--validate", path)
    if status == 0:
        return []
    missing = MISSING_INPUT.search(said)
    if status != 2 or not missing or not is_left_by_a_run(missing.group(2).rstrip(";,.")):
        return [f"{shown}: exit status {status}: {said.strip()}"]
    # As far as it goes without the inputs.
    status, _, said = Folder(TOP).end(name, "--print-parameters", path)
    return [f"{shown}: {said.strip()}"] if status else []


def main():
    printed = {name: Folder(TOP).run(0, name, "--print-parameters") for name in PROGRAMS}
    problems = [p for name, text in printed.items() for p in check_page(name, text, "--update" in sys.argv) + check_keys(name, text)]
    files = sorted(glob.glob(os.path.join(TOP, "prm", "**", "*.prm"), recursive=True))
    assert files, "no .prm file under prm/"
    for path in files:
        problems += check_file(path)
    print("\n".join(problems) or f"{len(PROGRAMS)} pages and {len(files)} files")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
