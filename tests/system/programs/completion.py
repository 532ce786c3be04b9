#!/usr/bin/env python3
"""Bash completion: what it offers after a few beginnings of a command line."""

import os
import subprocess
import tempfile

from scenes import PROGRAMS, TOOLS, Folder, prm

LINE = f"""
source {TOOLS}/completion.bash
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_mesoslip "$1"
printf '%s\\n' "${{COMPREPLY[@]}}"
"""
PROBE = prm({"Observation/Probes": "spot", "Observation/spot/Position": "0.01, 0.01"})
# Words, and the completions of the last one.
CASES = [
    ([""], ["one.prm", "two.prm", "a pin.prm"]),
    (["--val"], ["--validate"]),
    (["--set", "Flat/V"], ["'Flat/Velocity="]),
    (["--set", "'Time/End"], ["Time/End time="]),
    (["--set", "'Supports/Top/Kind="], [f"Supports/Top/Kind={kind}" for kind in ("free", "pressure", "platen", "held", "springs", "absorbing")]),
    (["--set", "'Analysis=s"], ["Analysis=static contact"]),
    (["--set", "'Sides/Periodic in y="], ["Sides/Periodic in y=true", "Sides/Periodic in y=false"]),
    (["--set", "'Supports/Top/Pressure="], [""]),
    (["--set", "Top/Ki"], ["'Supports/Top/Kind="]),
    (["a pin.prm", "--set", "Observation/spot/P"], ["'Observation/spot/Position="]),
    (["--set", "Observation/spot/P"], [""]),
    (["one.prm", "--set", "Flat/V"], ["'Flat/Velocity="]),  # a file with mistakes: the keys without it
]


def main():
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"one": "subsection Nonsense\n", "two": "", "a pin": PROBE})
        folder.write("notes.txt", "")
        for words, expected in CASES:
            command = ["bash", "-c", LINE, "bash", os.path.join(PROGRAMS, "contact_dynamics"), *words]
            offered = subprocess.check_output(command, cwd=path, text=True).split("\n")[:-1]
            assert sorted(offered) == sorted(expected), f"{words}: {offered} instead of {expected}"


if __name__ == "__main__":
    main()
