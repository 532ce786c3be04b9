"""Colours and carriage returns go to terminals only."""

import os
import pty
import signal
import tempfile

from scenes import ENVIRONMENT, Folder, prm

# Lines of progress come every ten seconds or tenths; the run is stopped after some.
PRM = prm({"Body/Cells": "280, 80", "Time/End time": 1e-2})
CONTROLS = (b"\r", b"\033")
COLOURED, PLAIN = b"\r\033[36mSliding", b"\rSliding"


def output_of(folder, words, terminal, ranks=1, **environment):
    """What the program writes until it has told its progress three times (once into a file), and its exit status."""
    master, slave = pty.openpty() if terminal else os.pipe()
    env = {k: v for k, v in ENVIRONMENT.items() if k != "NO_COLOR"} | environment
    child = folder.start("contact_dynamics", *words, ranks=ranks, env=env, stdout=slave, stderr=slave)
    os.close(slave)
    output = b""
    while True:
        try:
            chunk = os.read(master, 4096)
        except OSError:  # a terminal that the program has left
            chunk = b""
        if not chunk:
            return output, child.wait()
        output += chunk
        if words[0] == "case.prm" and output.count(b"Sliding") >= (3 if terminal else 1):
            child.send_signal(signal.SIGTERM)


def main():
    run, problems = ["case.prm", "--output", "out"], []
    # Words, terminal or file, options of the start, how often what is there at least, what is not there, exit status.
    cases = [("in a file", run, False, {}, {b"Sliding": 1}, CONTROLS, 130),
             ("under mpirun in a file", run, False, {"ranks": 2}, {}, CONTROLS, None),  # which gives each process a terminal
             ("on a terminal", run, True, {}, {COLOURED: 3, b"\033[0m": 1}, (), 130),
             ("NO_COLOR", run, True, {"NO_COLOR": "1"}, {PLAIN: 3}, (b"\033[36m",), 130),
             ("keys", ["--print-parameters"], False, {}, {b"subsection": 1}, CONTROLS, 0)]
    with tempfile.TemporaryDirectory() as path:
        folder = Folder(path, {"case": PRM})
        for what, words, terminal, options, there, absent, status in cases:
            output, found = output_of(folder, words, terminal, **options)
            log = folder.read("out", "log.txt")
            if status not in (None, found) or any(output.count(text) < n for text, n in there.items()) or any(
                    text in output for text in absent) or any(text in log for text in CONTROLS):
                problems.append(f"{what}: exit status {found}: {output}; log.txt: {log}")
    assert not problems, "\n".join(problems)


if __name__ == "__main__":
    main()
