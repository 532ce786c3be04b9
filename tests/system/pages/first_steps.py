#!/usr/bin/env python3
"""doc/first_steps.md by the letter: its commands run, what it says is printed is printed, and one's own picture gets to localized
stresses with the edits that it names."""

import os
import re
import shutil
import tempfile

import h5py
import numpy as np
from PIL import Image

from scenes import TOP, Folder, run_chain

NUMBER = re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")


def tokens(line):
    """Words and numbers; a percent sign, bracket or comma does not belong to a number."""
    return [float(w) if NUMBER.match(w) else w for w in re.sub(r"([%(),;:=])", r" \1 ", line).split()]


def same(said, printed):
    """The same words; numbers within 2 % (or 0.001 where they are small), as other compilers round otherwise."""
    a, b = tokens(said), tokens(printed)
    return len(a) == len(b) and all(abs(x - y) <= max(0.02 * abs(x), 1e-3) if isinstance(x, float) and isinstance(y, float)
                                    else x == y for x, y in zip(a, b))


def outputs(text):
    """The indented lines of the guide that are output of the chain, not commands, keys or code."""
    beginnings = r"\[[234]0-|KUBC|SUBC|effective|Stiffness \(|\d+ snapshots|mean_\w+ against|limit cycle:"
    return [line.strip() for line in text.split("\n") if re.match(rf" {{4,}}({beginnings})", line)]


def check_outputs(text, printed, fewest=13):
    said = outputs(text)
    assert len(said) >= fewest, "the guide's outputs are not found"
    lines = [re.sub(r"^\[\S+\] (limit cycle)", r"\1", line.strip()) for line in printed.split("\n")]
    missing = [line for line in said if not any(same(line, other) for other in lines)]
    assert not missing, "the guide says what is not printed:\n" + "\n".join(missing)
    errors = [line for line in lines if re.match(r"mean_\w+ against", line)]
    left_out = [line for line in errors if not any(same(other, line) for other in said)]
    assert errors and not left_out, "the guide leaves out:\n" + "\n".join(left_out)


def check_validation(text):
    """The block below the command with --validate is all that it prints."""
    found = re.search(r"^ {4}build/applications/(\w+) --validate (\S+)\n\n((?: {4}\S.*\n)+)", text, re.MULTILINE)
    assert found, "the guide's --validate is not found"
    program, prm, said = found.groups()
    printed = Folder(TOP).run(0, program, "--validate", prm).splitlines()
    said = [line.strip() for line in said.splitlines()]
    assert len(said) == len(printed) and all(map(same, said, printed)), f"the guide says\n{said}\nprinted is\n{printed}"


def table_rows(text):
    """(probe, component, localized, direct) in MPa of the guide's table."""
    return [(p, c, float(a), float(b)) for p, c, a, b in
            re.findall(r"^\| (bulk|contact) \| (sigma_\w+) \| ([-\d.]+) \| ([-\d.]+) \|", text, re.MULTILINE)]


def check_table(text, results):
    rows = table_rows(text)
    assert len(rows) == 6
    with h5py.File(os.path.join(results, "40-stress_localization", "localization.h5")) as file:
        for probe, component, localized, direct in rows:
            k = ("sigma_xx", "sigma_yy", "sigma_xy").index(component)
            for name, said in (("stress", localized), ("direct_stress", direct)):
                found = 1e-6 * file[f"probes/{probe}/{name}"][:, k].mean()
                assert abs(found - said) <= 0.02 * abs(said) + 0.01, (probe, component, name, found, said)


def own_picture(text, folder):
    """A copy of the example with grains of one's own and the edits of section 6."""
    mine = os.path.join(folder, "mine")
    shutil.copytree(os.path.join(TOP, "prm", "examples", "image"), mine)
    os.remove(os.path.join(mine, "phases.txt"))
    x, y = np.meshgrid(np.arange(120) + 0.5, np.arange(60) + 0.5)
    phase = np.where((x % 30 - 15) ** 2 + (y % 20 - 10) ** 2 < 49, 200, 40)
    Image.fromarray(phase.astype("uint8")).save(os.path.join(mine, "grains.png"))
    edits = re.findall(r"^ {6}set (\w+)\s*= (.*)$", text[text.index("**Your own picture.**"):], re.MULTILINE)
    assert [key for key, _ in edits] == ["Cells", "Size", "File"], edits
    path, name = Folder(mine), "10-rve_homogenization.prm"
    prm = path.read(name).decode()
    for key, value in edits:
        prm, count = re.subn(rf"set {key}(\s*)= .*", rf"set {key}\1= {value}", prm)
        assert count == 1, key
    path.write(name, prm)
    return mine, phase


def check_own(results, phase):
    with h5py.File(os.path.join(results, "10-rve_homogenization", "rve.h5")) as file:
        assert np.array_equal(file["phase/id"][...], np.flipud(phase == 200)), "rows from the bottom"
    with h5py.File(os.path.join(results, "40-stress_localization", "localization.h5")) as file:
        stress = file["mean_stress"][..., 1]
        assert stress.shape == (60, 120) and np.all(np.isfinite(stress))
        # Vertical equilibrium: the mean is the platen's 5 MPa, whatever the grains.
        assert abs(stress.mean() + 5e6) < 0.02 * 5e6, stress.mean()
    assert os.path.getsize(os.path.join(results, "report.html")) > 1e5


def main():
    text = Folder(TOP).read("doc", "first_steps.md").decode()
    with tempfile.TemporaryDirectory() as folder:
        check_validation(text)
        results = os.path.join(folder, "image")
        check_outputs(text, run_chain(os.path.join(TOP, "prm", "examples", "image"), "--output", results, "--no-report"))
        check_table(text, results)
        mine, phase = own_picture(text, folder)
        run_chain(mine, "--output", os.path.join(folder, "results"))
        check_own(os.path.join(folder, "results"), phase)
    print("ok")


if __name__ == "__main__":
    main()
