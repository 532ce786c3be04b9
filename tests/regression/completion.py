#!/usr/bin/env python3
"""Bash completion: what it offers after a few beginnings of a command line."""

import os
import subprocess
import sys
import tempfile

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "applications", "tools", "completion.bash")


def offered(programs, folder, *words):
    """The completions of the last word."""
    line = f"""
source {os.path.abspath(SCRIPT)}
COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_mesoslip "$1"
printf '%s\\n' "${{COMPREPLY[@]}}"
"""
    command = ["bash", "-c", line, "bash", os.path.join(programs, "contact_dynamics"), *words]
    done = subprocess.run(command, cwd=folder, stdout=subprocess.PIPE, text=True, check=True)
    return done.stdout.split("\n")[:-1]


def main():
    programs = os.path.abspath(sys.argv[1])
    with tempfile.TemporaryDirectory() as folder:
        for name in ("one.prm", "two.prm", "notes.txt"):
            with open(os.path.join(folder, name), "w", encoding="utf-8"):
                pass
        assert sorted(offered(programs, folder, "")) == ["one.prm", "two.prm"]
        assert offered(programs, folder, "--val") == ["--validate"]
        assert offered(programs, folder, "--set", "Flat/V") == ["'Flat/Velocity="]
        assert offered(programs, folder, "--set", "'Time/End") == ["Time/End time="]
        assert "'Friction/Regularization time=" in offered(programs, folder, "--set", "Friction/")
        with open(os.path.join(folder, "a pin.prm"), "w", encoding="utf-8") as file:
            file.write("subsection Observation\n  set Probes = spot\n  subsection spot\n    set Position = 0.01, 0.01\n  end\nend\n")
        assert offered(programs, folder, "a pin.prm", "--set", "Observation/spot/P") == ["'Observation/spot/Position="]
        assert not any(offered(programs, folder, "--set", "Observation/spot/P"))
        with open(os.path.join(folder, "one.prm"), "w", encoding="utf-8") as file:
            file.write("subsection Nonsense\n")
        assert offered(programs, folder, "one.prm", "--set", "Flat/V") == ["'Flat/Velocity="], "of a file with mistakes, the keys without it"
    print("ok")


if __name__ == "__main__":
    main()
